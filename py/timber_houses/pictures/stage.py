# SPDX-License-Identifier: GPL-2.0-or-later
"""A recorded run in 3D at any time, with shadows, ground, sky and the marks of damaged joints, for films."""
import numpy as np
from matplotlib.colors import to_rgb

from ..base import colors
from . import camera
from .panels import STATES, mark_anchors, marks, plates, states
from .renderer import Bodies, Canvas, context, program, put

SHADOW_PIXELS = 1024
HORIZON, ZENITH = (0.93, 0.945, 0.94), (0.72, 0.82, 0.90)
AMBIENT, DIRECT = (0.80, 0.62), 0.42
"""Brightness of faces that look up and down, and that the sun adds. [-]"""
HAZE_DEPTH = 60.0
"""Distance behind a house at which the haze is HAZE; farther behind a town. [m]"""
HAZE = 0.5
EDGE_INK, EDGE_WIDTH = (0.16, 0.13, 0.10, 0.7), 1.2
"""Colour and opacity, and width [pixel] of the lines along edges."""
GROUND_REACH = 60.0
"""Distance from a house at which the ground has faded into the sky; farther from a town. [m]"""
HOUSE_SIZE = 30.0
"""Largest plan of a house. [m]"""
MARK_SIZE, MARK_PIXELS = 0.25, (9.0, 26.0)
"""Size of a mark [m], and its limits [pixel]."""
HIDDEN = 0.3
"""Opacity of a mark behind a member. [-]"""
SQUARE, UPPER_HALF = np.array([[0, 0, 1, 0, 0, 1, 1, 1], [-1, 0, 1, 0, -1, 1, 1, 1]], "f4")


def stages(runs, size, view):
    """A Stage of each run (Frames), all with one light and one camera, VIEW of camera.CAMERAS. size: of each [pixel]"""
    starts = [corners(run) for run in runs]
    shown = np.concatenate([camera.shown_points(start, corners(run, -1)) for run, start in zip(runs, starts)])
    seen, light = camera.look(view, shown, size[0] / size[1]), camera.sun(np.concatenate(starts))
    return [Stage(run, size, seen, light) for run in runs]


def corners(run, frame=None):
    """(P, 3) corners of all elements but the ground in a frame, or (None) before the first step. [m]"""
    bodies = run.all_corners(frame)
    return np.concatenate([bodies[k] for k in run.shown])


class Stage:
    """Draws a run (Frames) in pictures of (width, height) pixels from one camera. light: from `camera.sun`"""

    def __init__(self, frames, size, camera, light):
        self.frames, self.camera, (self.sun, self.light) = frames, camera, light
        e = frames.elements
        distance = np.linalg.norm(e.position[frames.shown] - camera.eye, axis=1)
        self.numbers = np.asarray(frames.shown)[np.argsort(distance, kind="stable")]  # hidden faces cost no shading
        places = e.position[self.numbers, :2]
        self.middle = (places.min(0) + places.max(0)) / 2
        self.spread = max(1.0, np.ptp(places, axis=0).max() / HOUSE_SIZE)
        self.plates, self.mark_anchors, self.sheets = plates(frames), mark_anchors(frames), None
        self.elements = Bodies([(k, e.vertices[k], e.faces[k], colors.of(e.kind[k])) for k in self.numbers])
        self.sheathing = Bodies([])
        self.canvas = Canvas(*size)
        gl = context()
        self.depth = gl.depth_texture((SHADOW_PIXELS, SHADOW_PIXELS))
        self.depth.compare_func = "<="
        self.depth.repeat_x = self.depth.repeat_y = False
        self.shadow = gl.framebuffer(depth_attachment=self.depth)
        flat = {"GROUND": SQUARE, "SHADE": SQUARE, "SKY": UPPER_HALF}
        self.ground, self.shade, self.sky = (gl.vertex_array(program(name), [(gl.buffer(form), "2f", "corner")])
                                             for name, form in flat.items())
        self.marks = gl.buffer(reserve=max(16 * len(frames.joints.name), 16), dynamic=True)
        self.points = gl.vertex_array(program("MARK"), [(self.marks, "3f 1f", "place", "state")])

    def picture(self, time):
        """Image (of Pillow) at a time [s]; positions are interpolated between frames, the ground moves as recorded."""
        position, orientation = placements(self.frames, time)
        self._sheathe(time)
        vertices = np.concatenate([bodies.place(position, orientation) for bodies in self._bodies])
        places = vertices[:, :2] - vertices[:, 2:] * (self.light[:2] / self.light[2])  # of the shadows on the ground
        self._prepare(ground_at(self.frames.motion, time), np.concatenate([places.min(0), places.max(0)]))
        self._draw_shadow()
        self.canvas.begin(HORIZON)
        for bodies in self._bodies:
            bodies.render_faces()
        self._draw_background()
        for bodies in self._bodies:
            bodies.render_edges()
        self._draw_marks(position, orientation, time)
        return self.canvas.image()

    @property
    def _bodies(self):
        return self.elements, self.sheathing

    def _sheathe(self, time):
        """Take the plates that show the states of the wall sheets at a time [s]. self.sheets: the states shown"""
        state = states(self.frames, frame_before(self.frames, time))
        if not np.array_equal(state, self.sheets):
            self.sheets = state
            self.sheathing.release()
            self.sheathing = Bodies([(plate.body, plate.vertices, plate.faces, colors.SHEETS[state[plate.sheet]])
                                     for plate in self.plates if plate.shows(state)])

    def _draw_background(self):
        """Sky, ground and the shadows on it, where no face is: their shading takes a third of the time of a picture."""
        gl = context()
        gl.enable_only(gl.DEPTH_TEST)
        self.canvas.frame.depth_mask = False
        self.sky.render(mode=gl.TRIANGLE_STRIP)
        gl.enable(gl.BLEND)
        self.ground.render(mode=gl.TRIANGLE_STRIP)
        self.shade.render(mode=gl.TRIANGLE_STRIP)
        self.canvas.frame.depth_mask = True

    def _draw_shadow(self):
        self.shadow.use()
        self.shadow.clear(depth=1.0)
        context().enable_only(context().DEPTH_TEST | context().CULL_FACE)
        for bodies in self._bodies:
            bodies.shadow.render()
        self.depth.use(0)

    def _prepare(self, moved, shadows):
        """Set the shaders for a displacement of the ground (3,) [m]. shadows: their west, south, east, north end [m]"""
        view, shift = self.camera, np.eye(4)
        shift[:3, 3] = moved
        ahead = view.target - view.eye
        ahead /= np.linalg.norm(ahead)
        width, height = self.canvas.size
        depth, reach = self.spread * HAZE_DEPTH, self.spread * GROUND_REACH
        shared = dict(camera=view.matrix @ shift, sun=self.sun, toward=(*-ahead, -ahead @ view.target), haze=HORIZON,
                      haziness=(HAZE, depth), shade=0)
        put(program("SHADOW"), sun=self.sun)
        put(program("SOLID"), **shared, light=self.light, ambient=AMBIENT, direct=DIRECT)
        put(program("EDGE"), **shared, eye=(*view.eye, 1), ink=EDGE_INK, size=(width, height), width=EDGE_WIDTH)
        put(program("GROUND"), **shared, bounds=np.concatenate([self.middle - 2 * reach, self.middle + 2 * reach]),
            reach=reach, middle=self.middle)
        put(program("SHADE"), **shared, bounds=shadows)
        put(program("SKY"), horizon=HORIZON, zenith=ZENITH)
        put(program("MARK"), **shared, size=MARK_SIZE * view.scale * height, sizes=MARK_PIXELS,
            partly=to_rgb(colors.AMBER), broken=to_rgb(colors.ORANGE))

    def _draw_marks(self, position, orientation, time):
        """Marks of the damaged joints, pale where a member hides them."""
        gl = context()
        places, damage = marks(self.frames, self.mark_anchors, frame_before(self.frames, time), position, orientation)
        points = np.column_stack([places, [STATES[state] for state in damage]]).astype("f4").reshape(-1, 4)
        points = points[np.isfinite(points).all(1)]
        if not len(points):
            return
        self.marks.write(points)
        gl.enable_only(gl.DEPTH_TEST | gl.BLEND | gl.PROGRAM_POINT_SIZE)
        self.canvas.frame.depth_mask = False
        for test, opacity in ((">", HIDDEN), ("<=", 1.0)):
            gl.depth_func = test
            program("MARK")["opacity"].value = opacity
            self.points.render(mode=gl.POINTS, vertices=len(points))
        gl.depth_func = "<"
        self.canvas.frame.depth_mask = True


def frame_before(frames, time):
    """Number of the last frame at or before a time [s], at least 0."""
    return max(0, int(np.searchsorted(frames.time, time + 1e-9, side="right")) - 1)


def placements(frames, time):
    """((N, 3) positions [m], (N, 4) orientations w, x, y, z) at a time [s]: linear and slerp between frames."""
    first = frame_before(frames, time)
    last = min(first + 1, len(frames.time) - 1)
    span = frames.time[last] - frames.time[first]
    share = min(max((time - frames.time[first]) / span, 0.0), 1.0) if span > 0 else 0.0
    a, b = (np.asarray(frames.position[k], float) for k in (first, last))
    return a + share * (b - a), slerp(np.asarray(frames.orientation[first], float),
                                      np.asarray(frames.orientation[last], float), share)


def slerp(a, b, share):
    """Unit quaternions (N, 4) on the shorter arc between a and b."""
    cosine = (a * b).sum(1, keepdims=True)
    b, cosine = np.where(cosine < 0, -b, b), np.minimum(abs(cosine), 1.0)
    angle = np.arccos(cosine)
    sine = np.sin(angle)
    small = sine < 1e-6
    sine = np.where(small, 1.0, sine)
    from_a = np.where(small, 1 - share, np.sin((1 - share) * angle) / sine)
    from_b = np.where(small, share, np.sin(share * angle) / sine)
    return from_a * a + from_b * b


def ground_at(motion, time):
    """(3,) displacement of the ground [m]; zero without a motion."""
    if motion is None:
        return np.zeros(3)
    return np.array([np.interp(time, motion.time, motion.displacement[:, k]) for k in range(3)])
