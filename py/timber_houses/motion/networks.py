# SPDX-License-Identifier: GPL-2.0-or-later
"""Formats of other networks and other kinds of files, which are not read: their names, and what to do instead."""
import struct

PLAIN_CSV = ("a plain CSV: a line '# dt: 0.01' (time step in s), a line 'ns [gal],ew [gal],ud [gal]', then a row of"
             " numbers for each sample")
"""What every record can be converted to."""
HEAD_LINES = 12  # lines in which the words of a format are searched
TEXTS = (("COSMOS", ("(format v", "cosmos")),
         ("GeoNet V1 to V3", ("geonet", "institute of geological and nuclear sciences")),
         ("SMC (USGS)", ("1 uncorrected accelerogram", "2 corrected accelerogram")),
         ("CSMIP V1 to V3", ("corrected accelerogram", "accelerogram data", "csmip")),
         ("ESM or ITACA", ("event_name:", "database_version:", "itaca")),
         ("AFAD", ("strong ground motion records of turk", "place:")),
         ("CWA (Taiwan)", ("stationcode:", "station code:")), ("GSE2", ("wid2 ",)),
         ("SLIST or TSPAIR", ("timeseries ",)), ("SAC in letters", ("-12345.0",)))
"""Name of a format, words of its header in lower case. The first that fits counts."""
BINARIES = (
    (*("archive or workbook", "unpack it and give the files in it, or save the sheet as CSV"),
     (b"\x1f\x8b", b"PK\x03\x04", b"BZh", b"\xfd7zXZ", b"7z\xbc\xaf")),
    ("old Excel workbook", "save the sheet as CSV", (b"\xd0\xcf\x11\xe0",)),
    ("UTF-16 text", "save it as UTF-8", (b"\xff\xfe", b"\xfe\xff")),
    ("HDF5", "", (b"\x89HDF",)),
    ("SEED", "", (b"000001V ", b"MS\x03")),
)
"""Name of a kind of file, what to do with it besides a conversion, its first bytes."""
MINISEED_QUALITIES = b"DRQM"
SAC_VERSION_AT, SAC_VERSIONS = 304, (6, 7)
"""Place and values of a binary SAC file's version, a whole number of 4 bytes in either order."""


def other_text(lines):
    """What a text file of another network is, and what to do with it: the end of a message."""
    head = "\n".join(lines[:HEAD_LINES]).lower()
    name = next((name for name, words in TEXTS if any(word in head for word in words)), None)
    return f"{f'{name} format, which is not read' if name else 'unknown record format'}; convert it to {PLAIN_CSV}"


def other_binary(raw):
    """The same for a file that is no text."""
    name, remedy = next(((name, remedy) for name, remedy, starts in BINARIES if raw.startswith(starts)), (None, ""))
    if raw[:6].isdigit() and raw[6:7] in MINISEED_QUALITIES and len(raw) > 6:
        name = "miniSEED"
    elif len(raw) >= SAC_VERSION_AT + 4:
        versions = (struct.unpack_from(f"{order}i", raw, SAC_VERSION_AT)[0] for order in "<>")
        name = name or ("SAC" if any(version in SAC_VERSIONS for version in versions) else None)
    about = (f"{name}, which is not read" if name
             else "empty or not a text file; a record must be text in UTF-8 or CP932")
    return f"{about}; {remedy or f'convert it to {PLAIN_CSV}'}"
