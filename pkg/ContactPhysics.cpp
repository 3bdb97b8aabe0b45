// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactPhysics.hpp>
#include <Integrator.hpp>
#include <bodies.hpp>
#include <validation.hpp>
#include <set>
#include <utility>

namespace yade {

// clang-format off
YADE_PLUGIN((ManifoldPhys)(TimberPhys)(SnowPhys)(Ip2_TimberMat_TimberMat_TimberPhys)
	(Ip2_ElementMat_ElementMat_SnowPhys)(Law2_ManifoldGeom_TimberPhys_Hertz)(Law2_ManifoldGeom_SnowPhys_Linear));
// clang-format on

namespace {

	const RoundedPolyhedron& shapeOf(const Body& body)
	{
		return *static_cast<RoundedPolyhedron*>(body.shape.get());
	}

	/// A fixed body counts as infinitely heavy.
	Real massOf(const Body& body)
	{
		return isFree(*body.state) ? body.state->mass : std::numeric_limits<Real>::infinity();
	}

	void setProperties(ManifoldPhys& phys, const Body& b1, const Body& b2, Real friction1, Real friction2,
	        Real shearRatio, Real dampingRatio)
	{
		phys.friction = std::min(friction1, friction2);
		phys.shearRatio = shearRatio;
		phys.dampingRatio = dampingRatio;
		phys.overlapLimit = shapeOf(b1).radius + shapeOf(b2).radius;
		phys.bearingRadius = math::min(shapeOf(b1).radius, shapeOf(b2).radius);
	}

	/// Contact stiffness of an element of snow; infinite for timber (SceneCheck.cpp refuses pairs without snow).
	/// [N/m]
	Real snowStiffness(const Material& material, const Body& body)
	{
		const auto snow = dynamic_cast<const SnowMat*>(&material);
		return snow ? snow->stiffnessPerMass * body.state->mass : std::numeric_limits<Real>::infinity();
	}

	/// The IPhys of a pair with its present mass: bodies may be fixed, freed or get another mass in a session. It is
	/// made anew for a new pair, and after a body got a material of another law.
	template <class Phys> Phys& updatePhys(Interaction& I, const Body& b1, const Body& b2)
	{
		const bool isNew = !I.phys || I.phys->getClassIndex() != Phys::getClassIndexStatic();
		if (isNew) I.phys = shared_ptr<Phys>(new Phys);
		Phys& phys = *static_cast<Phys*>(I.phys.get());
		if (isNew) phys.source.fill(NaN);
		const Real mass = timber::reduced(massOf(b1), massOf(b2));
		if (isNew || math::isfinite(mass)) phys.mass = mass; // infinite: both are fixed, no contact force acts
		return phys;
	}

	/// Whether the numbers of the materials and the functor differ from those of the last call, which they replace.
	/// Attributes set by hand stay while the numbers do.
	bool haveChanged(ManifoldPhys& phys, std::initializer_list<Real> numbers)
	{
		if (std::equal(numbers.begin(), numbers.end(), phys.source.begin())) return false;
		std::copy(numbers.begin(), numbers.end(), phys.source.begin());
		return true;
	}

	bool boundsOverlap(const Body& b1, const Body& b2)
	{
		return b1.bound && b2.bound && (b1.bound->min.array() <= b2.bound->max.array()).all()
		        && (b2.bound->min.array() <= b1.bound->max.array()).all();
	}

	Real storedEnergy(const std::vector<timber::PointRecord>& records)
	{
		Real sum = 0;
		for (const timber::PointRecord& r : records)
			sum += r.normalStored + r.shearStored;
		return sum;
	}

	/// Energy and largest overlap of the points of bodies that were placed in contact, without points that the
	/// motion of a step explains: these store no energy yet. before: stored before the step [J]
	void sumPlaced(ManifoldPhys& phys, bool placed, Real before)
	{
		phys.placedEnergy = phys.placedOverlap = 0;
		if (!placed) return;
		const Real change = storedEnergy(phys.records) - before + phys.releasedEnergy;
		phys.placedEnergy = math::max(Real(0), change);
		phys.releasedEnergy -= math::min(Real(0), change);
		for (const timber::PointRecord& r : phys.records)
			if (r.normalStored > 0) phys.placedOverlap = math::max(phys.placedOverlap, Real(r.overlap));
	}

	/// Elastic step of a pair. Returns false when the interaction ends: no contact points, bounding boxes apart.
	template <class Law>
	bool elasticForces(const Law& law, IGeom* g, ManifoldPhys& phys, Interaction* I, Scene* scene,
	        timber::NormalForm form = timber::NormalForm::Closed)
	{
		const ManifoldGeom& geom = *static_cast<ManifoldGeom*>(g);
		const Body &b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
		if (geom.contactPoints.empty() && phys.records.empty()) {
			phys.releasedEnergy = 0;
			return boundsOverlap(b1, b2);
		}
		phys.exponent = Law::exponent;
		phys.strength = form == timber::NormalForm::Increment
		        ? timber::BearingStrength() // unlimited, as in the paper
		        : timber::bearingStrength(phys.bearing, phys.bearingRadius, geom.contactPoints);
		const timber::PairProperties pair = phys.properties();
		const bool moved = std::exchange(phys.isMoved, false),
		           placed = moved || (phys.records.empty() && (wasPlaced(*scene, b1) || wasPlaced(*scene, b2)));
		const Real before = placed ? storedEnergy(phys.records) : 0;
		phys.releasedEnergy = timber::elasticPair(law,
		        { pair, kinematics(*b1.state), kinematics(*b2.state), scene->dt, form, placed, moved },
		        geom.contactPoints, phys.records);
		sumPlaced(phys, placed, before);
		phys.isActing = !std::all_of(phys.records.begin(), phys.records.end(),
		        [](const timber::PointRecord& r) { return r.isIdle(); });
		if (!phys.isActing) phys.normalForce = phys.shearForce = Vector3r::Zero();
		return true;
	}

} // namespace

const std::vector<ContactLaw> contactLaws {
	{ "TimberMat", "TimberMat", "TimberMat", "TimberPhys", "Hertz" },
	{ "TimberMat", "SnowMat", "ElementMat", "SnowPhys", "Linear" },
	{ "SnowMat", "SnowMat", "ElementMat", "SnowPhys", "Linear" },
};

boost::python::list pyContactLaws()
{
	boost::python::list names;
	std::set<string> listed;
	for (const ContactLaw& law : contactLaws)
		if (listed.insert(law.phys).second)
			names.append(boost::python::make_tuple(law.ip2(), law.phys, law.law2()));
	return names;
}

void ManifoldPhys::validate() const
{
	require(mass > 0, "ManifoldPhys.mass", mass, "> 0");
	requireNonNegative("ManifoldPhys.friction", friction);
	requirePositive("ManifoldPhys.shearRatio", shearRatio);
	requireNonNegative("ManifoldPhys.dampingRatio", dampingRatio);
	requirePositive("ManifoldPhys.overlapLimit", overlapLimit);
	require(bearing > 0, "ManifoldPhys.bearing", bearing, "> 0");
	requireNonNegative("ManifoldPhys.bearingRadius", bearingRadius);
}

void TimberPhys::validate() const
{
	ManifoldPhys::validate();
	requirePositive("TimberPhys.modulus", modulus);
	requirePositive("TimberPhys.radius", radius);
}

void SnowPhys::validate() const
{
	ManifoldPhys::validate();
	requirePositive("SnowPhys.stiffness", stiffness);
}

void Ip2_TimberMat_TimberMat_TimberPhys::validate() const
{
	requireNonNegative("Ip2_TimberMat_TimberMat_TimberPhys.dampingRatio", dampingRatio);
}

void Ip2_ElementMat_ElementMat_SnowPhys::validate() const
{
	requireNonNegative("Ip2_ElementMat_ElementMat_SnowPhys.dampingRatio", dampingRatio);
}

boost::python::list ManifoldPhys::pyPoints() const
{
	boost::python::list points;
	for (const timber::PointRecord& p : records)
		points.append(boost::python::make_tuple(p.id.bits, Real(p.normalForce), Vector3r(p.shearForce),
		        Vector3r(p.dashpotForce), Real(p.crushed)));
	return points;
}

void Ip2_TimberMat_TimberMat_TimberPhys::go(
        const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& I)
{
	const TimberMat &t1 = *static_cast<TimberMat*>(m1.get()), &t2 = *static_cast<TimberMat*>(m2.get());
	const Body &b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
	TimberPhys& phys = updatePhys<TimberPhys>(*I, b1, b2);
	if (!haveChanged(phys,
	            { t1.friction, t1.young, t1.poisson, t1.bearing, t2.friction, t2.young, t2.poisson, t2.bearing,
	                    dampingRatio }))
		return;
	phys.bearing = math::min(t1.bearing, t2.bearing);
	const Real poisson = (t1.poisson + t2.poisson) / 2;
	setProperties(phys, b1, b2, t1.friction, t2.friction, 1 / (2 * (1 + poisson)), dampingRatio);
	phys.modulus = timber::equivalentModulus(t1.young, t1.poisson, t2.young, t2.poisson);
	phys.radius = timber::reduced(
	        timber::equivalentRadius(shapeOf(b1).volume), timber::equivalentRadius(shapeOf(b2).volume));
}

void Ip2_ElementMat_ElementMat_SnowPhys::go(
        const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& I)
{
	const Real friction1 = static_cast<ElementMat*>(m1.get())->friction,
	           friction2 = static_cast<ElementMat*>(m2.get())->friction;
	const Body &b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
	SnowPhys& phys = updatePhys<SnowPhys>(*I, b1, b2);
	phys.stiffness = math::min(snowStiffness(*m1, b1), snowStiffness(*m2, b2)); // masses may have changed
	if (haveChanged(phys, { friction1, friction2, dampingRatio }))
		setProperties(phys, b1, b2, friction1, friction2, 1, dampingRatio);
}

bool Law2_ManifoldGeom_TimberPhys_Hertz::go(shared_ptr<IGeom>& g, shared_ptr<IPhys>& p, Interaction* I)
{
	TimberPhys& phys = *static_cast<TimberPhys*>(p.get());
	return elasticForces(phys.law(), g.get(), phys, I, scene,
	        increment ? timber::NormalForm::Increment : timber::NormalForm::Closed);
}

bool Law2_ManifoldGeom_SnowPhys_Linear::go(shared_ptr<IGeom>& g, shared_ptr<IPhys>& p, Interaction* I)
{
	SnowPhys& phys = *static_cast<SnowPhys*>(p.get());
	return elasticForces(phys.law(), g.get(), phys, I, scene);
}

} // namespace yade
