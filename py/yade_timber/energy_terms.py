# SPDX-License-Identifier: GPL-2.0-or-later
"""Terms of the energy balance, as `yade_timber.energy` names them: all but SUPPLIED, minus these, are constant."""
ELASTIC = ("elastic_contacts", "elastic_joints")
DISSIPATED = ("dashpot_normal", "dashpot_shear", "friction", "crushing", "broken_springs", "lost_contacts",
              "joint_dashpot", "joint_yield")
IMPOSED = "imposed_velocity"
SUPPLIED = ("ground_motion", IMPOSED)
