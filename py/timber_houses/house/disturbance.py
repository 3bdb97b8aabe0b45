# SPDX-License-Identifier: GPL-2.0-or-later
"""Disturbance of a built house that is too small to matter, and shows which results chance decides."""
import numpy as np

LARGEST = 1e-9
"""Largest displacement of a vertex. [m] It is far below the tolerance of flush contacts (1e-4 m) and of planar faces
(1e-6 of an element's size), so that shapes and contacts stay the same, and far above rounding errors (1e-15 m)."""


def disturb(model, seed):
    """Move each vertex of a HouseModel's free elements by a random vector in a cube, at most LARGEST long, in place.
    seed: whole number >= 1. Joints and masses that were computed before are left alone."""
    random = np.random.default_rng(seed)
    reach = LARGEST / np.sqrt(3)  # half an edge of the cube [m]
    for element in model.elements:
        if not element.fixed:
            element.vertices = element.vertices + random.uniform(-reach, reach, element.vertices.shape)
