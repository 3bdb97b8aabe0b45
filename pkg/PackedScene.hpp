// SPDX-License-Identifier: GPL-2.0-or-later
/// The scene as packed arrays. A frame of a house takes one call instead of milliseconds of attribute access in Python.
#pragma once
#include <JointEngine.hpp>

namespace yade {

template <class T> boost::python::object bytes(const std::vector<T>& values)
{
	return boost::python::object(boost::python::handle<>(PyBytes_FromStringAndSize(
	        reinterpret_cast<const char*>(values.data()), Py_ssize_t(values.size() * sizeof(T)))));
}

/// (positions, orientations) of all bodies: bytes of float32 (n, 3) [m] and (n, 4) w, x, y, z [-]; NaN where a body was
/// erased.
boost::python::tuple packedPlacements();

/// (load, broken) of all joints: bytes of float32, the largest spring force (of a joint as a whole: their sum) over the
/// strength, and of uint8, the number of broken springs. [-]
boost::python::tuple packedJoints(const shared_ptr<JointEngine>&);

/// (pairs, positions, forces) of all contact points, ordered by body ids: bytes of int32 (n, 2) [-], float32 (n, 3) [m]
/// and float32 (n, 3), force of the last step on the second body [N]; world frame.
boost::python::tuple packedContacts();

/// (pairs, values) of the linearised springs of all contact points and joints: bytes of int32 (n, 2), body ids [-], and
/// of float64 (n, 14):
/// arms from both centres of mass [m], unit normal [-], normal and tangential stiffness [N/m], force on the second body
/// [N]; world frame.
boost::python::tuple packedSprings();

/// Power that the dashpots of all contact points and joints take from the bodies at these velocities and spins, with
/// contacts that neither slide nor open. velocities: float64 (bodies, 6), world frame [m/s, rad/s] [W]
Real pyDashpotPower(const boost::python::object& velocities);

} // namespace yade
