// SPDX-License-Identifier: GPL-2.0-or-later
#include <TimberJoint.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((TimberJoint));

namespace {
	/// Stiffness and strength may be missing (NaN) as long as a joint has no springs: attributes are set one after
	/// the other.
	void requireGiven(bool hasSprings, const char* attribute, Real value, bool mayBeInfinite)
	{
		if (!hasSprings && std::isnan(value)) return;
		require(value > 0 && (mayBeInfinite || std::isfinite(value)), attribute, value,
		        mayBeInfinite ? "> 0" : "finite and > 0");
	}

	void requireAnchors(const char* attribute, const vector<Vector3r>& anchors)
	{
		for (const Vector3r& x : anchors)
			require(x.allFinite(), attribute, x.transpose(), "finite");
	}
}

void TimberJoint::validate(size_t springs) const
{
	const bool hasSprings = !anchors1.empty() && !anchors2.empty();
	requireGiven(hasSprings, "TimberJoint.kn", kn, false);
	if (hasSprings || !std::isnan(ks)) requireNonNegative("TimberJoint.ks", ks);
	requireGiven(hasSprings, "TimberJoint.strength", strength, true);
	require(dampingRatio >= 0 && dampingRatio <= 1, "TimberJoint.dampingRatio", dampingRatio, "between 0 and 1");
	requireNonNegative("TimberJoint.dampingTime", dampingTime);
	require(math::abs(normal.squaredNorm() - 1) < 1e-9, "TimberJoint.normal", normal.transpose(), "of length 1");
	requireAnchors("TimberJoint.anchors1", anchors1);
	requireAnchors("TimberJoint.anchors2", anchors2);
	validateLaw();
	if (!hasSprings && springs == 0) return; // not complete yet
	require(anchors1.size() == anchors2.size(), "number of TimberJoint.anchors2", anchors2.size(),
	        "that of anchors1");
	require(springs == 0 || springs == anchors1.size(), "number of TimberJoint.broken", springs,
	        "that of anchors1");
}

void TimberJoint::validateLaw() const
{
	require(law == "brittle" || law == "slip" || law == "wall", "TimberJoint.law", law, "brittle, slip or wall");
	require(frictionShare >= 0 && frictionShare <= 1, "TimberJoint.frictionShare", frictionShare, "in [0, 1]");
	require(softeningStretch > 0, "TimberJoint.softeningStretch", softeningStretch, "> 0");
	require(ultimateStretch > 0, "TimberJoint.ultimateStretch", ultimateStretch, "> 0");
	if (!yields() || std::isnan(kn)) return;
	if (law == "wall") return validateWall();
	require(kn == ks || ks == 0, "TimberJoint.ks", ks, "equal to kn, or 0, with the law slip");
	if (!envelope.empty()) return validateEnvelope();
	require(softeningStretch > strength / kn && std::isfinite(softeningStretch), "TimberJoint.softeningStretch",
	        softeningStretch, "finite and > strength / kn with the law slip");
	require(ultimateStretch > softeningStretch && std::isfinite(ultimateStretch), "TimberJoint.ultimateStretch",
	        ultimateStretch, "finite and > softeningStretch with the law slip");
}

void TimberJoint::validateWall() const
{
	require(ks == 0, "TimberJoint.ks", ks, "0 with the law wall, which acts along the normal only");
	requireNonNegative("TimberJoint.reloadStiffness", reloadStiffness);
	const bool reloadsFrom = reloadStiffness == 0;
	require(reloadsFrom || (reloadStretch > 0 && std::isfinite(reloadStretch)), "TimberJoint.reloadStretch",
	        reloadStretch, "finite and > 0 with reloadStiffness");
	require(reloadsFrom || (reloadPower > 0 && std::isfinite(reloadPower)), "TimberJoint.reloadPower", reloadPower,
	        "finite and > 0 with reloadStiffness");
	validateEnvelope();
}

void TimberJoint::validateEnvelope() const
{
	std::ostringstream points;
	Real largest = 0;
	for (const Vector2r& point : envelope) {
		points << (largest > 0 ? ", " : "") << point.x() << " " << point.y();
		largest = math::max(largest, point.y());
	}
	const char* const unmet = law == "wall" ? timber::WallLaw::unmetBy(wallCycles(1), envelopePoints(1))
	                                        : timber::SlipLaw::unmetBy(kn, envelopePoints(1));
	require(!unmet, "TimberJoint.envelope", points.str(), unmet ? unmet : "");
	require(math::abs(strength - largest) <= 1e-9 * largest, "TimberJoint.strength", strength,
	        "the largest force of TimberJoint.envelope");
}

/// The state of the saved scene, or the present one with the attributes that were set, which are empty afterwards.
timber::SpringsState TimberJoint::takeState()
{
	const bool isSaved = !saved.broken.empty();
	timber::SpringsState state = isSaved ? saved : set->state(entry());
	if (!isSaved) { // of other attributes
		state.modes = {};
		state.half.clear();
		state.account = 0;
	}
	saved = {};
	const auto take = [](auto& from, auto& to) {
		if (!from.empty()) to = std::move(from);
		from.clear();
	};
	take(broken, state.broken);
	take(forces, state.forces);
	take(stretches, state.stretches);
	take(plasticStretches, state.plastic);
	take(largestStretches, state.largest);
	return state;
}

void TimberJoint::postLoad(TimberJoint&)
{
	timber::SpringsState state = takeState();
	validate(state.broken.size());
	if (!anchors1.empty() && !anchors2.empty())
		set->change(index, parameters(), anchors1, anchors2, std::move(state));
}

void TimberJoint::moveTo(const shared_ptr<timber::JointSet>& other)
{
	index = other->take(*set, index);
	set = other;
}

timber::JointEntry TimberJoint::parameters() const
{
	timber::JointEntry joint;
	joint.bodyA = id1;
	joint.bodyB = id2;
	joint.normal = normal;
	joint.stiffness = { share() * kn, share() * ks };
	joint.strength = { strength, perJoint };
	joint.damping = { dampingRatio, dampingTime };
	joint.initialDamping = initialDamping;
	if (law == "wall") joint.law = timber::WallSprings({ wallCycles(share()), backbone() }, normal);
	else if (law == "slip")
		joint.law = timber::SlipSprings({ joint.stiffness.normal, frictionShare, backbone() }, joint.axis());
	else joint.law = timber::BrittleSprings(joint.stiffness, joint.strength, normal);
	return joint;
}

void TimberJoint::setBroken(const vector<int>& flags)
{
	broken = flags;
	if (flags.empty()) broken.resize(springs().count, 0);
	postLoad(*this);
}

std::vector<timber::BackbonePoint> TimberJoint::envelopePoints(Real share) const
{
	std::vector<timber::BackbonePoint> points;
	for (const Vector2r& point : envelope)
		points.push_back({ point.x(), share * point.y() });
	return points;
}

timber::WallCycles TimberJoint::wallCycles(Real share) const
{
	return { share * kn, share * frictionForce, share * pinchedStiffness, reloadTarget, reloadShare,
		share * reloadStiffness, reloadStretch, reloadPower };
}

std::vector<timber::BackbonePoint> TimberJoint::backbone() const
{
	if (!envelope.empty()) return envelopePoints(share());
	return { { strength / kn, share() * strength }, { softeningStretch, share() * strength },
		{ ultimateStretch, 0 } };
}

boost::python::list TimberJoint::pySprings() const
{
	const timber::JointSprings all = springs();
	boost::python::list rows;
	for (size_t k = 0; k < all.count; ++k) {
		boost::python::dict one;
		one["force"] = all.force(k);
		one["stretch"] = all.stretch(k).norm();
		one["broken"] = !all.isIntact(k);
		rows.append(one);
	}
	return rows;
}

boost::python::list TimberJoint::pyWallHistories() const
{
	boost::python::list rows;
	for (const timber::WallHistory& history : set->state(entry()).wall) {
		boost::python::dict one;
		one["stretch"] = history.stretch;
		one["force"] = history.force;
		one["largest"] = boost::python::make_tuple(history.largest[0], history.largest[1]);
		one["reversed"] = boost::python::make_tuple(history.reversed[0], history.reversed[1]);
		rows.append(one);
	}
	return rows;
}

boost::python::dict TimberJoint::pyDictCustom() const
{
	boost::python::dict attributes;
	attributes["forces"] = springForces();
	attributes["stretches"] = springStretches();
	attributes["broken"] = areBroken();
	attributes["plasticStretches"] = plastic();
	attributes["largestStretches"] = largest();
	return attributes;
}

} // namespace yade
