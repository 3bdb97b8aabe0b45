# SPDX-License-Identifier: GPL-2.0-or-later
"""Entries of the logs to which runs and `record` append. Needs no YADE.

An entry: kind (1 byte), length of the content (uint32), time [s] (float64), CRC-32 of all three and the content
(uint32), content; little-endian. The first one has the kind RUN and tells whose log it is. What follows the last
complete entry, as after a kill, is not read."""
import struct
import zlib

import numpy as np

FIELDS, CHECKSUM = struct.Struct("<cId"), struct.Struct("<I")
RUN, SCENE, FRAME, CONTACTS = b"R", b"S", b"F", b"C"
OWN_SCENE = "yade-timber scene log 1"
"""Content of the entry RUN of a log of `record`. A SCENE follows it: JSON of its title and the tables `elements` and
`joints` (timber_houses/recording/frames.py) but group, storey and side; an infinite strength is Infinity."""


def packed(kind, time, *parts):
    """Bytes of an entry. parts: bytes, or arrays without gaps"""
    content = b"".join(parts)
    fields = FIELDS.pack(kind, len(content), time)
    return fields + CHECKSUM.pack(zlib.crc32(content, zlib.crc32(fields))) + content


def starts(lists):
    """[0, len of the first, len of the first two, ...]."""
    return np.cumsum([0, *map(len, lists)])


def flat_shapes(vertices, faces):
    """{'vertices', 'vertex_start', 'faces', 'face_start', 'element_start'}: arrays of the shapes of elements.
    vertices, faces: a list per element"""
    rings = [ring for element in faces for ring in element]
    return {"vertices": np.concatenate(vertices), "vertex_start": starts(vertices), "faces": np.concatenate(rings),
            "face_start": starts(rings), "element_start": starts(faces)}
