// SPDX-License-Identifier: GPL-2.0-or-later
#include <TimberJoint.hpp>
#include <validation.hpp>
#include <numeric>

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

	/// Of vectors, of which there is at least one.
	Vector3r mean(const vector<Vector3r>& v)
	{
		return std::accumulate(v.begin(), v.end(), Vector3r(Vector3r::Zero())) / Real(v.size());
	}

	void requireAnchors(const char* attribute, const vector<Vector3r>& anchors)
	{
		for (const Vector3r& x : anchors)
			require(x.allFinite(), attribute, x.transpose(), "finite");
	}
}

void TimberJoint::validate() const
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
	if (!hasSprings && broken.empty()) return; // not complete yet
	require(anchors1.size() == anchors2.size(), "number of TimberJoint.anchors2", anchors2.size(),
	        "that of anchors1");
	require(broken.empty() || broken.size() == anchors1.size(), "number of TimberJoint.broken", broken.size(),
	        "that of anchors1");
}

void TimberJoint::validateLaw() const
{
	require(law == "brittle" || yields(), "TimberJoint.law", law, "brittle, slip or wall");
	require(frictionShare >= 0 && frictionShare <= 1, "TimberJoint.frictionShare", frictionShare, "in [0, 1]");
	require(softeningStretch > 0, "TimberJoint.softeningStretch", softeningStretch, "> 0");
	require(ultimateStretch > 0, "TimberJoint.ultimateStretch", ultimateStretch, "> 0");
	if (!yields() || std::isnan(kn)) return;
	if (isWall) return validateWall();
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
	const char* const unmet = isWall ? timber::WallLaw::unmetBy(wallCycles(1), envelopePoints(1))
	                                 : timber::SlipLaw::unmetBy(kn, envelopePoints(1));
	require(!unmet, "TimberJoint.envelope", points.str(), unmet ? unmet : "");
	require(math::abs(strength - largest) <= 1e-9 * largest, "TimberJoint.strength", strength,
	        "the largest force of TimberJoint.envelope");
}

void TimberJoint::postLoad(TimberJoint&)
{
	storeSprings();
	if (packed) packed->isCurrent = false;
	packed.reset();
	if (isRead) modes.state.springs = 0; // computed for other attributes
	isRead = true;
	isSlip = law == "slip";
	isWall = law == "wall";
	validate();
	const bool hasSprings = !anchors1.empty() && !anchors2.empty();
	if (hasSprings) broken.resize(anchors1.size(), 0);
	intact = size_t(std::count(broken.begin(), broken.end(), 0));
	if (!hasSprings) return;
	mean1 = mean(anchors1);
	mean2 = mean(anchors2);
	forces.resize(anchors1.size(), Vector3r::Zero());
	stretches.resize(anchors1.size(), Vector3r::Zero());
	if (isStiff()) halfStretches.resize(anchors1.size(), Vector3r::Zero());
	if (isWall) {
		wall = { wallCycles(share()), backbone() };
		wallHistories.resize(anchors1.size());
	}
	if (isSlip) {
		slip = { stiffness().normal, frictionShare, backbone() };
		plasticStretches.resize(anchors1.size(), Vector3r::Zero());
		largestStretches.resize(anchors1.size(), 0);
	}
	for (size_t k = 0; k < broken.size(); ++k)
		if (broken[k]) breakSpring(k);
}

void TimberJoint::breakSpring(size_t spring)
{
	const timber::JointSprings changed = springs();
	if (!broken[spring]) --intact;
	broken[spring] = 1;
	forces[spring] = stretches[spring] = Vector3r::Zero();
	if (packed) packed->set(index, changed);
}

std::unique_ptr<timber::SpringLaw> TimberJoint::springLaw()
{
	if (isWall) return std::make_unique<timber::WallSprings>(wallSprings());
	if (isSlip) return std::make_unique<timber::SlipSprings>(slipSprings());
	return std::make_unique<timber::BrittleSprings>(stiffness(), jointStrength(), normal);
}

timber::JointForce TimberJoint::yield(const timber::JointPlacement& placement)
{
	const auto forces = [&](timber::SpringLaw&& law) { return yieldingForces(law, placement, axis(), springs()); };
	return isWall ? forces(wallSprings()) : forces(slipSprings());
}

std::vector<timber::SpringBreak> TimberJoint::spentSprings(const Matrix3r& axes1)
{
	const auto spent = [&](const timber::SpringLaw& law) {
		return timber::spentSprings(law, stiffness(), axes1, normal, springs());
	};
	return isWall ? spent(wallSprings()) : spent(slipSprings());
}

void TimberJoint::stiffen()
{
	storeSprings();
	halfStretches.resize(anchors1.size(), Vector3r::Zero());
	if (packed) packed->joints[index].isStiff = true;
}

void TimberJoint::soften()
{
	halfStretches.clear();
	storedEnergy = 0;
	if (!packed) return;
	packed->set(index, { anchors1, anchors2, broken, stretches, forces });
	packed->joints[index].isStiff = false;
}

void TimberJoint::breakAll()
{
	for (size_t k = 0; k < broken.size(); ++k)
		breakSpring(k);
}

void TimberJoint::pack(const shared_ptr<timber::PackedJoints>& to)
{
	const timber::JointSprings unpacked = springs();
	packed = to;
	index = packed->joints.size();
	packed->add({ id1, id2, yields(), isStiff(), stiffness(), jointStrength(), normal }, unpacked);
}

TimberJoint::SpringVectors TimberJoint::lastSprings() const
{
	SpringVectors last { stretches, forces };
	if (isPacked()) timber::unpackSprings(packed->first(packed->joints[index]), last.stretches, last.forces);
	return last;
}

void TimberJoint::storeSprings()
{
	if (isPacked()) timber::unpackSprings(packed->first(packed->joints[index]), stretches, forces);
}

timber::JointSprings TimberJoint::springs()
{
	storeSprings();
	return { anchors1, anchors2, broken, stretches, forces };
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

Real TimberJoint::loadOf(const timber::JointForce& total) const
{
	return (perJoint ? total.sum : math::sqrt(total.largestSquared)) / strength;
}

Real TimberJoint::load() const
{
	timber::JointForce total;
	for (const Vector3r& f : springForces()) {
		total.sum += f.norm();
		total.largestSquared = math::max(total.largestSquared, Real(f.squaredNorm()));
	}
	return loadOf(total);
}

boost::python::list TimberJoint::pySprings() const
{
	const vector<Vector3r> pulling = springForces(), stretched = springStretches();
	boost::python::list rows;
	for (size_t k = 0; k < broken.size(); ++k) {
		boost::python::dict one;
		one["force"] = Vector3r(pulling[k]);
		one["stretch"] = stretched[k].norm();
		one["broken"] = bool(broken[k]);
		rows.append(one);
	}
	return rows;
}

boost::python::list TimberJoint::pyWallHistories() const
{
	boost::python::list rows;
	for (const timber::WallHistory& history : wallHistories) {
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
	return attributes;
}

} // namespace yade
