# SPDX-License-Identifier: GPL-2.0-or-later
"""One minute at rest without skipped steps: house C and a stack of 20 blocks (section 6 of the accuracy page)."""
import yade_timber as yt
from assembly_cases import DT, load_on_fixed, stack_at_rest, weight
from planar_scene import advance, positions
from rows import Row, check
from timber_houses.scene import scenario


def test_stack():
    check(stack_at_rest(duration=60.0))


def test_house_c(half=30.0):
    scenario.build(scenario.Scenario("rest", "C", dt=DT, options={"skip_rest": False}))
    advance(half)
    settled = positions()
    advance(half)
    # The braces oscillate in their undamped joints until the contacts at their ends have dissipated the energy.
    check(
        [
            Row("6", "house C: creep from 30 s to 60 s [m]", 0, abs(positions() - settled).max(), bound=1e-5, dt=DT),
            Row("6", "house C: kinetic energy after 60 s [J]", 0, yt.energy()["kinetic"], bound=1e-9, dt=DT),
            Row("6", "house C: load on the foundation [N]", weight(), load_on_fixed(), bound=1e-6, dt=DT),
        ]
    )
