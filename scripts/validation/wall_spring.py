# SPDX-License-Identifier: GPL-2.0-or-later
"""Cyclic law of a wall for the lumped-mass model, written from docs/theory.md (walls) without code of the package.

For steps that are small against the lines of the law; without a pinched stiffness, reloading from a share of the slack.
"""
import numpy as np

ELASTIC = 1.05
"""Of the drift at which the backbone meets the friction force, up to which a wall is elastic on it. [-]"""


class WallSpring:
    """A wall between drift [rad] and shear [N]. points: backbone behind the origin [(rad, N)], its last shear remains;
    friction [N]; share of the slack from which it reloads, target over the largest drift [-]."""

    def __init__(self, stiffness, points, friction, share, target):
        self.stiffness, self.friction, self.share, self.target = stiffness, friction, share, target
        self.drifts, self.forces = np.array([(0.0, 0.0), *points]).T
        self.peak = self.drifts[np.argmax(self.forces)]
        start = np.argmax(self.forces >= friction)
        self.meeting = float(np.interp(friction, self.forces[:start + 1], self.drifts[:start + 1]))
        self.drift = self.force = 0.0
        self.tangent = stiffness  # of the last step, never negative [N/rad]
        self.largest, self.reversed = {1: 0.0, -1: 0.0}, {1: 0.0, -1: 0.0}

    def backbone(self, drift):
        """[N]"""
        return float(np.interp(drift, self.drifts, self.forces))

    def _friction(self):
        """Less where the backbone has fallen below it. [N]"""
        return min([self.friction, *(self.backbone(drift) for drift in self.largest.values() if drift > self.peak)])

    def _bound(self, drift, turned):
        """Upper bound towards a side that has returned from the drift `turned`. [N]"""
        friction, aim = self._friction(), self.target * turned
        if aim <= self.meeting or drift >= aim or self.backbone(aim) <= friction:
            return max(friction, self.backbone(drift)) if drift <= self.peak else self.backbone(drift)
        slack = turned - (self.backbone(turned) - friction) / self.stiffness
        start = max(self.meeting, self.share * slack)
        if drift <= start:
            return friction
        return friction + (self.backbone(aim) - friction) * (drift - start) / (aim - start)

    def shear(self, drift):
        """After a further step to this drift. [N]"""
        if drift == self.drift:
            return self.force
        side, before = (1 if drift > self.drift else -1), self.force
        if max(self.largest.values()) <= ELASTIC * self.meeting and abs(drift) <= ELASTIC * self.meeting:
            self.force = np.copysign(self.backbone(abs(drift)), drift)
        else:
            trial = side * self.force + self.stiffness * side * (drift - self.drift)
            self.force = side * min(trial, self._bound(side * drift, self.reversed[side]))
        self.tangent = min(max((self.force - before) / (drift - self.drift), 0.0), self.stiffness)
        self.drift = drift
        self.largest[side] = max(self.largest[side], side * drift)
        turned = self.largest[-side]
        if turned > self.reversed[-side] and -side * self.force <= self._bound(-side * drift, turned):
            self.reversed[-side] = turned
        return self.force
