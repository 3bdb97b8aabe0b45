# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of convex bodies by OpenGL without a window. Needs no YADE.

moderngl draws on an EGL context: on a graphics card where there is one, else by Mesa's renderer on the processor. Needs no display.
Soft lines along all edges smooth the outlines of faces. World frame: x east, y north, z up [m].
"""
import threading
from functools import wraps

import numpy as np

from ..base.errors import RunError
from . import shaders

PACKAGES = "python3-moderngl libegl1 libegl-mesa0 libgl1-mesa-dri"
LAYOUT = ("3f 3f 3f", "place", "normal", "color")


def once_per_thread(make):
    """A function that keeps its results: an OpenGL context and all that belongs to it can be used by one thread only."""
    own = threading.local()

    @wraps(make)
    def found(*arguments):
        known = vars(own)
        if arguments not in known:
            known[arguments] = make(*arguments)
        return known[arguments]

    return found


_started = []


def used():
    """Whether this process has an OpenGL context: its threads would be missing in a copy of the process."""
    return bool(_started)


@once_per_thread
def context():
    """The OpenGL context of this thread. Raises RunError when there is none."""
    try:
        import moderngl

        _started.append(True)
        return moderngl.create_context(standalone=True, backend="egl", require=330)
    except Exception as problem:  # moderngl raises Exception itself
        raise RunError(f"pictures need OpenGL on EGL ({' '.join(str(problem).split()) or type(problem).__name__}): install {PACKAGES}") from None


@once_per_thread
def program(name):
    """The compiled program of the shaders NAME_VERTEX, NAME_GEOMETRY and NAME_FRAGMENT."""
    stages = {f"{stage}_shader": getattr(shaders, f"{name}_{stage.upper()}", None) for stage in ("vertex", "geometry", "fragment")}
    return context().program(**stages)


def put(made, **values):
    """Set those uniforms of a program that it uses; matrices (4, 4) by rows."""
    for name, value in values.items():
        if name in made:
            value = np.asarray(value, "f4")
            made[name].write((value.T if value.shape == (4, 4) else value).tobytes())


class Topology:
    """Faces of bodies as fans of triangles around their middles.

    faces: for each body its faces, lists of vertex numbers within the body; counts: number of vertices of each body
    """

    def __init__(self, faces, counts):
        first = np.cumsum([0, *counts[:-1]])
        flat = [face for body in faces for face in body]
        self.sizes = np.array([len(face) for face in flat], int)
        bodies = np.repeat(np.arange(len(faces)), [len(body) for body in faces])
        self.starts = np.concatenate([[0], np.cumsum(self.sizes)[:-1]]).astype(int)
        self.body = np.repeat(bodies, self.sizes)
        """(T,) body of each triangle."""
        self.a = np.array([vertex for face in flat for vertex in face], int) + first[self.body]
        following = np.arange(len(self.a)) + 1
        following[self.starts + self.sizes - 1] = self.starts
        self.b = self.a[following]
        once = self.a < self.b  # two faces share an edge
        self.edges = np.stack([self.a[once], self.b[once]], axis=1)
        """(E, 2) vertices of the edges."""

    def triangles(self, vertices):
        """(T, 3, 6) corners of the triangles (middle, a, b): place, unit normal [m]. vertices: (V, 3) of all bodies"""
        a, b = vertices[self.a], vertices[self.b]
        middle = np.repeat(np.add.reduceat(a, self.starts) / self.sizes[:, None], self.sizes, axis=0)
        across = np.cross(b - a, middle - a)
        made = np.empty((len(a), 3, 6), "f4")
        made[:, 0, :3], made[:, 1, :3], made[:, 2, :3] = middle, a, b
        made[:, :, 3:] = (across / np.maximum(np.sqrt((across * across).sum(1, keepdims=True)), 1e-30))[:, None]
        return made


class Bodies:
    """Bodies on the graphics card. colors: (N, 3) RGB of the bodies."""

    def __init__(self, topology, colors):
        self.topology = topology
        self.content = np.zeros((len(topology.a), 3, 9), "f4")
        self.content[:, :, 6:] = np.asarray(colors, "f4").reshape(-1, 3)[topology.body][:, None]
        made = context()
        self.corners = made.buffer(reserve=max(self.content.nbytes, 4), dynamic=True)
        self.ends = made.buffer(reserve=max(24 * len(topology.edges), 4), dynamic=True)
        self.faces = made.vertex_array(program("SOLID"), [(self.corners, *LAYOUT)])
        self.shadow = made.vertex_array(program("SHADOW"), [(self.corners, "3f 24x", "place")])
        self.edges = made.vertex_array(program("EDGE"), [(self.ends, "3f", "place")])

    def put(self, vertices):
        """Take over the vertices (V, 3) [m]."""
        if self.content.size:
            self.content[:, :, :6] = self.topology.triangles(vertices)
            self.corners.write(self.content)
            self.ends.write(vertices[self.topology.edges].astype("f4"))

    def render(self):
        """Draw faces and edges."""
        if self.content.size:
            self.faces.render()
            self.edges.render(mode=context().LINES)

    def release(self):
        for part in (self.faces, self.shadow, self.edges, self.corners, self.ends):
            part.release()


class Canvas:
    """A picture of (width, height) pixels in the making."""

    def __init__(self, width, height):
        made = context()
        self.size = int(width), int(height)
        self.frame = made.framebuffer([made.renderbuffer(self.size, 4)], made.depth_renderbuffer(self.size))

    def begin(self, color):
        """Make it empty and draw on it from now on."""
        self.frame.use()
        self.frame.clear(*color, alpha=0.0, depth=1.0)

    def pixels(self, components=3):
        """(height, width, components) uint8, the first row at the top."""
        data = self.frame.read(components=components, alignment=1)
        return np.frombuffer(data, np.uint8).reshape(*self.size[::-1], components)[::-1]

    def depths(self):
        """(height, width) float32, 0 near to 1 far, the first row at the top."""
        return np.frombuffer(self.frame.read(components=1, attachment=-1, dtype="f4", alignment=1), "f4").reshape(self.size[::-1])[::-1]


@once_per_thread
def canvas(width, height):
    """A Canvas of this size, which may have been used before: the panels of a sheet share one."""
    return Canvas(width, height)
