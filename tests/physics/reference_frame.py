# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 9: a braced portal frame under ground motion, solved without YADE and without the package.

The scheme is the paper's own: Eqs. 1-9 with explicit dashpots and a small step, in the plane (planar_frame.py). Run as
a script it prints the history of the frame.
"""
import numpy as np
from planar_frame import GRAVITY, Frame, Part, Tie, rectangle

SPAN, HEIGHT, COLUMN = 1.82, 2.4, 0.105
"""Between the columns' axes, of the columns, their side. [m]"""
SAMPLE, START, LENGTH = 0.01, 0.3, 0.6
"""Step of the ground motion's samples, its first and its duration. [s]"""


def cut_brace(foot, head, run, rise):
    """Corners (6, 2) of a brace from the corner `foot` (lower left) to `head` (upper right); each end is cut by a
    horizontal face of length `run` and a vertical face of height `rise`. [m]"""
    (x0, z0), (x1, z1) = foot, head
    return np.array([[x0, z0], [x0 + run, z0], [x1, z1 - rise], [x1, z1], [x1 - run, z1], [x0, z0 + rise]])


def portal(beam=0.3):
    """Frame of a fixed plate, two columns, a beam (its depth and width [m]) and a brace supported by column and plate,
    and by beam and column."""
    half = COLUMN / 2
    run, rise = 0.08, 0.11
    brace = cut_brace((half, 0), (SPAN - half, HEIGHT), run, rise)
    parts = [
        Part("plate", rectangle(-4.0, -0.3, SPAN + 4.0, 0), 4.0, True),
        Part("left", rectangle(-half, 0, half, HEIGHT), COLUMN),
        Part("right", rectangle(SPAN - half, 0, SPAN + half, HEIGHT), COLUMN),
        Part("beam", rectangle(-0.4, HEIGHT, SPAN + 0.4, HEIGHT + beam), beam),
        Part("brace", brace, 0.045),
    ]
    ends = lambda x, z: np.array([[x - half, z], [x + half, z]])
    ties = [Tie("plate", "left", ends(0, 0), 58800.0), Tie("plate", "right", ends(SPAN, 0), 58800.0)]
    ties += [Tie("left", "beam", ends(0, HEIGHT), 58800.0), Tie("right", "beam", ends(SPAN, HEIGHT), 58800.0)]
    ties += [Tie("plate", "brace", brace[[0, 1]], 69580.0), Tie("brace", "beam", brace[[3, 4]], 69580.0)]
    pairs = [("plate", "left"), ("plate", "right"), ("left", "beam"), ("right", "beam")]
    pairs += [("plate", "brace"), ("left", "brace"), ("right", "brace"), ("beam", "brace")]
    return Frame(parts, ties, pairs, reach=0.03)


def ground_samples(peak=9.0, frequency=2.5):
    """Horizontal ground acceleration (n,) [m/s2], samples SAMPLE apart from START: a sine in a smooth window."""
    t = np.arange(0, LENGTH + SAMPLE / 2, SAMPLE)
    return peak * np.sin(2 * np.pi * frequency * t) * np.sin(np.pi * t / LENGTH) ** 2


class FrameMotion:
    """The frame in time: positions at full, velocities at half steps; contact history per candidate."""

    def __init__(self, frame, samples, dt):
        self.frame, self.samples, self.dt = frame, samples, dt
        n = len(frame.parts)
        self.time, self.position, self.angle = 0.0, frame.start.copy(), np.zeros(n)
        self.velocity, self.spin = np.zeros(n, complex), np.zeros(n)
        self.shear, self.stiffness = np.zeros(len(frame.of)), np.zeros(len(frame.of))
        self.slid, self.lifted = 0.0, 0.0

    def ground(self):
        """Ground acceleration now, linear between samples. [m/s2]"""
        t = (self.time - START) / SAMPLE
        k = int(t)
        if t < 0 or k + 1 >= len(self.samples):
            return 0.0
        return (1 - (t - k)) * self.samples[k] + (t - k) * self.samples[k + 1]

    def velocity_at(self, at, part, back=0.0):
        """Velocity of a part's material point that is at `at` now, with its arm of `back` steps ago. Velocities are
        those of half a step ago; a displacement is exact with the arm of the same time. [m/s]"""
        arm = at - self.position[part]
        return self.velocity[part] + 1j * self.spin[part] * arm * (1 - 1j * back * self.dt * self.spin[part])

    def contact_forces(self, at, overlap, normal):
        """Forces of each contact point on its corner's part (Eqs. 15-24, 37-43), friction included. [N]"""
        f = self.frame
        elastic, stiffness = f.normal_law(overlap)
        relative = (self.velocity_at(at, f.of) - self.velocity_at(at, f.on)) * normal.conj()
        separation, slip = relative.real, relative.imag
        sliding_distance = (self.dt * (self.velocity_at(at, f.of, 0.5) - self.velocity_at(at, f.on, 0.5)) *
                            normal.conj()).imag
        ratio = np.divide(stiffness, self.stiffness, out=np.zeros_like(stiffness), where=self.stiffness > 0)
        shear = np.minimum(1, ratio) * self.shear - f.shear_ratio * stiffness * sliding_distance
        damping = 2 * np.sqrt(f.pair_mass * stiffness)
        push = np.maximum(0, elastic - damping * separation)
        limit = f.timber.friction * push
        sliding = np.abs(shear) > limit
        self.slid += np.abs(sliding_distance[sliding & (limit > 0)]).sum()
        self.shear, self.stiffness = np.maximum(-limit, np.minimum(limit, shear)), stiffness
        drag = np.where(sliding, self.shear, self.shear - np.sqrt(f.shear_ratio) * damping * slip)
        return (push + 1j * np.maximum(-limit, np.minimum(limit, drag))) * normal

    def step(self):
        f = self.frame
        force = -f.mass * (self.ground() + 1j * GRAVITY)
        moment = np.zeros(len(f.parts))
        f.add_springs(self.position, self.angle, force, moment)
        overlap, at, normal = f.overlaps(self.position, self.angle)
        f.add_contacts(self.position, at, self.contact_forces(at, overlap, normal), force, moment)
        self.velocity += np.where(f.free, self.dt / f.mass, 0) * force
        self.spin += np.where(f.free, self.dt / f.inertia, 0) * moment
        self.position += self.dt * self.velocity
        self.angle += self.dt * self.spin
        self.time += self.dt


def history(dt, duration, every):
    """Displacements (m, parts) complex [m] and angles (m, parts) [rad] at multiples of `every` [s], 0 and duration
    included, and the FrameMotion."""
    motion = FrameMotion(portal(), ground_samples(), dt)
    displacements, angles = [], []
    for _ in range(round(duration / every) + 1):
        displacements.append(motion.position - motion.frame.start)
        angles.append(motion.angle.copy())
        for _ in range(round(every / dt)):
            motion.step()
    return np.array(displacements), np.array(angles), motion


if __name__ == "__main__":
    displacements, angles, last = history(2e-5, 1.0, 0.01)
    for k, (moved, angle) in enumerate(zip(displacements, angles)):
        print(
            f"{0.01 * k:.2f} s: beam {moved[3]: .6e} m, left column {angle[1]: .6e} rad, right foot up "
            f"{moved[2].imag: .6e} m"
        )
    print(f"total sliding distance {last.slid:.3e} m")
