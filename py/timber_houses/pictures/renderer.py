# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of convex bodies by OpenGL, moderngl on EGL: no window, no display, at worst Mesa on the processor.

Soft lines along all edges smooth the outlines of faces. World frame: x east, y north, z up [m].
"""
import threading
from functools import cache, wraps
from pathlib import Path

import numpy as np
from PIL import Image

from ..base.errors import RunError
from ..recording.record import rotated

PACKAGES = "python3-moderngl libegl1 libegl-mesa0 libgl1-mesa-dri"
EGL_DEVICES = 8
"""Devices that are tried: graphics cards, and Mesa on the processor."""
SHADERS = Path(__file__).resolve().parents[1] / "data" / "shaders.glsl"
LAYOUT = ("3f 3f 3f", "place", "normal", "color")


def once_per_thread(make):
    """A function that keeps its results: one thread only can use an OpenGL context and all that belongs to it."""
    own = threading.local()

    @wraps(make)
    def kept(*arguments):
        results = vars(own)
        if arguments not in results:
            results[arguments] = make(*arguments)
        return results[arguments]

    return kept


class NoOpenGL(RunError):
    """This machine offers no OpenGL for pictures of bodies."""


@once_per_thread
def context():
    """The OpenGL context of this thread, of the first EGL device that has one. Raises NoOpenGL."""
    try:
        import moderngl
    except ImportError as problem:
        raise NoOpenGL(f"pictures of the house need OpenGL on EGL ({problem}): install {PACKAGES}") from None
    problems = []
    for device in range(EGL_DEVICES):
        try:
            return moderngl.create_context(standalone=True, backend="egl", require=330, device_index=device)
        except Exception as problem:  # moderngl raises Exception itself
            problems.append(" ".join(str(problem).split()) or type(problem).__name__)
    packages = f": install {PACKAGES}" if "not found" in problems[0] or "not load" in problems[0] else ""
    raise NoOpenGL(f"pictures of the house need OpenGL 3.3 on EGL ({problems[0]}){packages}")


@cache
def sections():
    """{NAME_STAGE: code} of SHADERS; the first line of a section has its names."""
    parts = (part.partition("\n") for part in SHADERS.read_text(encoding="utf-8").split("\n//// ")[1:])
    return {name: code for names, _, code in parts for name in names.split()}


@once_per_thread
def program(name):
    """The compiled program of the sections NAME_VERTEX, NAME_GEOMETRY and NAME_FRAGMENT, with NAME defined."""
    codes = {stage: sections().get(f"{name}_{stage.upper()}") for stage in ("vertex", "geometry", "fragment")}
    return context().program(**{f"{stage}_shader": code and f"#version 330\n#define {name}\n{code}"
                                for stage, code in codes.items()})


def put(shader, **values):
    """Set those uniforms of a program that it uses; matrices (4, 4) by rows."""
    for name, value in values.items():
        if name in shader:
            value = np.asarray(value, "f4")
            shader[name].write((value.T if value.shape == (4, 4) else value).tobytes())


class Bodies:
    """Convex bodies on the graphics card, their faces as fans of triangles.

    shapes: [(body, vertices in its frame [m], faces, RGB)]; surface: program of the faces, SOLID, or PLAIN (no shadows)
    """

    def __init__(self, shapes, surface="SOLID"):
        counts = np.array([len(vertices) for _, vertices, _, _ in shapes], int)
        self.body = np.repeat(np.array([body for body, *_ in shapes], int), counts)
        self.vertices = np.concatenate([np.empty((0, 3)), *(vertices for _, vertices, _, _ in shapes)])
        faces = [face for _, _, faces, _ in shapes for face in faces]
        shape = np.repeat(np.arange(len(shapes)), [len(faces) for _, _, faces, _ in shapes])  # of each face
        sizes = np.array([len(face) for face in faces], int)
        first = np.repeat((np.cumsum(counts) - counts)[shape], sizes)
        vertex = np.array([vertex for face in faces for vertex in face], int) + first
        starts, ends = np.cumsum(sizes) - sizes, np.cumsum(sizes) - 1
        following = np.arange(len(vertex)) + 1
        following[ends] = starts
        edges = np.column_stack([vertex, vertex[following]])
        self.edge_ends = edges[edges[:, 0] < edges[:, 1]]  # two faces share an edge
        self.fan = sizes - 2  # triangles of each face
        second = np.delete(np.arange(len(vertex)), np.concatenate([starts, ends]))
        self.triangles = vertex[np.column_stack([np.repeat(starts, self.fan), second, second + 1])]
        """(T, 3) their vertices, counter-clockwise from outside."""
        self.content = np.zeros((len(self.triangles), 3, 9), "f4")
        colors = np.array([color for *_, color in shapes], "f4").reshape(-1, 3)
        self.content[:, :, 6:] = colors[np.repeat(shape, self.fan)][:, None]
        gl = context()
        self.corners = gl.buffer(reserve=max(self.content.nbytes, 4), dynamic=True)
        self.ends = gl.buffer(reserve=max(24 * len(self.edge_ends), 4), dynamic=True)
        self.faces = gl.vertex_array(program(surface), [(self.corners, *LAYOUT)])
        self.shadow = gl.vertex_array(program("SHADOW"), [(self.corners, "3f 24x", "place")])
        self.edges = gl.vertex_array(program("EDGE"), [(self.ends, "3f", "place")])

    def place(self, position, orientation):
        """Put the shapes where the bodies are; returns their vertices [m], 0 of removed bodies."""
        vertices = position[self.body] + rotated(orientation[self.body], self.vertices)
        vertices = np.where(np.isfinite(vertices), vertices, 0.0)
        self.put(vertices)
        return vertices

    def put(self, vertices):
        """Take over the vertices (V, 3) in the world [m]."""
        if self.content.size:
            self.content[:, :, :6] = self._corners(vertices)
            self.corners.write(self.content)
            self.ends.write(vertices[self.edge_ends].astype("f4"))

    def _corners(self, vertices):
        """(T, 3, 6) corners of the triangles: place, unit normal of the face [m]."""
        places = vertices[self.triangles]
        u, v = (places[:, 1:] - places[:, :1]).transpose(1, 0, 2)
        area = u[:, [1, 2, 0]] * v[:, [2, 0, 1]] - u[:, [2, 0, 1]] * v[:, [1, 2, 0]]
        normal = np.add.reduceat(area, np.cumsum(self.fan) - self.fan)
        normal /= np.maximum(np.sqrt((normal * normal).sum(1, keepdims=True)), 1e-30)
        return np.concatenate([places, np.repeat(np.repeat(normal, self.fan, axis=0)[:, None], 3, axis=1)], axis=2)

    def render_faces(self):
        """Draw the faces that are turned towards the viewer."""
        if self.content.size:
            context().enable_only(context().DEPTH_TEST | context().CULL_FACE)
            self.faces.render()

    def render_edges(self):
        """Draw all edges that no face hides."""
        if self.content.size:
            context().enable_only(context().DEPTH_TEST | context().BLEND)
            self.edges.render(mode=context().LINES)

    def release(self):
        for part in (self.faces, self.shadow, self.edges, self.corners, self.ends):
            part.release()


class Canvas:
    """A picture of (width, height) pixels in the making."""

    def __init__(self, width, height):
        gl = context()
        self.size = int(width), int(height)
        self.whole = Image.new("RGB", self.size)
        self.frame = gl.framebuffer([gl.renderbuffer(self.size, 4)], gl.depth_renderbuffer(self.size))

    def begin(self, color):
        """Make it empty and draw on it from now on."""
        self.frame.use()
        self.frame.clear(*color, alpha=0.0, depth=1.0)

    def pixels(self):
        """(height, width, 4) uint8, the first row at the top."""
        return np.frombuffer(self.frame.read(components=4), np.uint8).reshape(*self.size[::-1], 4)[::-1]

    def image(self):
        """RGB image of Pillow."""
        self.whole.frombytes(self.frame.read(components=4), "raw", ("RGBX", 0, -1))
        return self.whole

    def depths(self):
        """(height, width) float32, 0 near to 1 far, the first row at the top."""
        return np.frombuffer(self.frame.read(components=1, attachment=-1, dtype="f4", alignment=1), "f4").reshape(
            self.size[::-1]
        )[::-1]


@once_per_thread
def canvas(width, height):
    """A Canvas of this size, which may have been used before: the panels of a sheet share one."""
    return Canvas(width, height)
