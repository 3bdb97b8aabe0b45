# SPDX-License-Identifier: GPL-2.0-or-later
"""Time steps and durations of runs."""
DEFAULT_DT = 5e-4  # time step of house runs. [s]
MAX_DT = 5e-4  # largest time step of house runs [s]: the error of standing houses is below 1 %
MIN_DT = 1e-7  # smallest time step of house runs [s]: a hundredth of the paper's
REST_STRIDE = 0.05  # time between computed steps at rest [s]: 30 of them in RestSkipper.restTime
MAX_DURATION = 1e5  # longest simulated time of a run. [s]


def rest_stride(dt):
    """Number of steps of dt [s] of which one is computed at rest."""
    return max(1, round(REST_STRIDE / dt))
