# SPDX-License-Identifier: GPL-2.0-or-later
"""Cyclic law of a wall for the lumped-mass model, written from docs/theory.md (walls) without code of the package.

For steps that are small against the lines of the law.
"""
import numpy as np

ELASTIC = 1.05
"""Of the drift at which the backbone meets the pinched line, up to which a wall is elastic on it. [-]"""


class WallSpring:
    """A wall between drift [rad] and shear [N]. points: backbone behind the origin [(rad, N)], its last shear remains;
    friction [N]; share of the slack from which it reloads, target over the largest drift [-]; pinched: slope of the
    pinched line [N/rad]; reload: in place of the share, (k0 [N/rad], d0 [rad], alpha), slope k0 (d0 / target)^alpha."""

    def __init__(self, stiffness, points, friction, share, target, pinched=0.0, reload=None):
        self.stiffness, self.friction, self.share, self.target = stiffness, friction, share, target
        self.pinched, self.reload = pinched, reload
        self.drifts, self.forces = np.array([(0.0, 0.0), *points]).T
        self.peak = self.drifts[np.argmax(self.forces)]
        above = self.forces - pinched * self.drifts - friction
        start = np.argmax(above >= 0)
        self.meeting = float(np.interp(0, above[:start + 1], self.drifts[:start + 1]))
        self.drift = self.force = 0.0
        self.tangent = stiffness  # of the last step, never negative [N/rad]
        self.largest, self.reversed = {1: 0.0, -1: 0.0}, {1: 0.0, -1: 0.0}

    def backbone(self, drift):
        """[N]"""
        return float(np.interp(drift, self.drifts, self.forces))

    def _pinched(self):
        """Slope and offset of the pinched line, less where the backbone has fallen below it. [N/rad, N]"""
        slope, offset = self.pinched, self.friction
        for drift in self.largest.values():
            if drift > self.peak:
                offset = min(offset, self.backbone(drift))
                slope = min(slope, (self.backbone(drift) - offset) / drift)
        return slope, offset

    def _bound(self, drift, turned):
        """Upper bound towards a side that has returned from the drift `turned`. [N]"""
        slope, offset = self._pinched()
        line, aim = slope * drift + offset, self.target * turned
        rise = self.backbone(aim) - slope * aim - offset  # of the target above the pinched line
        if aim <= self.meeting:
            return line if drift <= self.meeting else self.backbone(drift)
        if rise <= 0:
            return line if drift <= turned else min(line, self.backbone(drift))
        if drift >= aim:
            return self.backbone(drift)
        start = max(self.meeting, self._start(turned, aim, rise, slope, offset))
        if drift <= start:
            return line
        if self.reload:
            return max(line, self.backbone(aim) - self._steepness(aim) * (aim - drift))
        return line + rise * (drift - start) / (aim - start)

    def _start(self, turned, aim, rise, slope, offset):
        """Drift from which the wall reloads. [rad]"""
        if self.reload:
            steeper = self._steepness(aim) - slope
            return aim - rise / steeper if steeper > 0 else 0.0
        slack = turned - (self.backbone(turned) - slope * turned - offset) / (self.stiffness - slope)
        return self.share * slack

    def _steepness(self, aim):
        """Of the reloading line. [N/rad]"""
        stiffness, drift, power = self.reload
        return min(self.stiffness, stiffness * (drift / aim)**power)

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
