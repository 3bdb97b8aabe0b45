// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactPhysics.hpp>
#include <bodies.hpp>
#include <validation.hpp>
#include <set>

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
		phys.mass = timber::reduced(massOf(b1), massOf(b2));
		phys.friction = std::min(friction1, friction2);
		phys.shearRatio = shearRatio;
		phys.dampingRatio = dampingRatio;
		phys.overlapLimit = shapeOf(b1).radius + shapeOf(b2).radius;
	}

	/// Contact stiffness of an element of snow; infinite for timber (SceneCheck.cpp refuses pairs without snow).
	/// [N/m]
	Real snowStiffness(const Material& material, const Body& body)
	{
		const auto snow = dynamic_cast<const SnowMat*>(&material);
		return snow ? snow->stiffnessPerMass * body.state->mass : std::numeric_limits<Real>::infinity();
	}

	/// The IPhys of a pair, if it is new or its materials or masses have changed since it was set; else null.
	template <class Phys> Phys* physToUpdate(Interaction& I, const Material& m1, const Material& m2)
	{
		const long changes
		        = static_cast<const ElementMat&>(m1).changes + static_cast<const ElementMat&>(m2).changes;
		const bool isNew = !I.phys;
		if (isNew) I.phys = shared_ptr<Phys>(new Phys);
		Phys& phys = *static_cast<Phys*>(I.phys.get());
		const bool isKnown = phys.materialChanges >= 0;
		if (!isNew && phys.materialChanges == changes) return nullptr;
		phys.materialChanges = changes;
		return isNew || isKnown ? &phys : nullptr;
	}

	/// Relative speed below which a new pair in contact was placed there, and has not flown there: it would get the
	/// energy of its overlap. [m/s]
	constexpr Real restSpeed = 0.1;

	/// Bodies may be fixed, freed or get another mass in a session.
	void updateMass(Interaction& I, const Body& b1, const Body& b2)
	{
		const Real mass = timber::reduced(massOf(b1), massOf(b2));
		// Else both are fixed: no contact force acts
		if (math::isfinite(mass)) static_cast<ManifoldPhys*>(I.phys.get())->mass = mass;
	}

	bool boundsOverlap(const Body& b1, const Body& b2)
	{
		return b1.bound && b2.bound && (b1.bound->min.array() <= b2.bound->max.array()).all()
		        && (b2.bound->min.array() <= b1.bound->max.array()).all();
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
		phys.power = Law::power;
		const timber::PairProperties pair = phys.properties();
		const bool isPlaced = I->isFresh(scene) && (b1.state->vel - b2.state->vel).norm() < restSpeed;
		phys.releasedEnergy = timber::elasticPair(law,
		        { pair, kinematics(*b1.state), kinematics(*b2.state), scene->dt, form, isPlaced },
		        geom.contactPoints, phys.records);
		phys.placedEnergy = phys.placedOverlap = 0;
		for (size_t k = 0; isPlaced && k < phys.records.size(); ++k) {
			phys.placedEnergy += phys.records[k].normalStored;
			phys.placedOverlap = math::max(phys.placedOverlap, Real(phys.records[k].overlap));
		}
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
		points.append(boost::python::make_tuple(
		        p.id.bits, Real(p.normalForce), Vector3r(p.shearForce), Vector3r(p.dashpotForce)));
	return points;
}

void Ip2_TimberMat_TimberMat_TimberPhys::go(
        const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& I)
{
	TimberPhys* phys = physToUpdate<TimberPhys>(*I, *m1, *m2);
	const TimberMat &t1 = *static_cast<TimberMat*>(m1.get()), &t2 = *static_cast<TimberMat*>(m2.get());
	const Body &b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
	updateMass(*I, b1, b2);
	if (!phys) return;
	const Real poisson = (t1.poisson + t2.poisson) / 2;
	setProperties(*phys, b1, b2, t1.friction, t2.friction, 1 / (2 * (1 + poisson)), dampingRatio);
	phys->modulus = timber::equivalentModulus(t1.young, t1.poisson, t2.young, t2.poisson);
	phys->radius = timber::reduced(
	        timber::equivalentRadius(shapeOf(b1).volume), timber::equivalentRadius(shapeOf(b2).volume));
}

void Ip2_ElementMat_ElementMat_SnowPhys::go(
        const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& I)
{
	SnowPhys* phys = physToUpdate<SnowPhys>(*I, *m1, *m2);
	const Body &b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
	updateMass(*I, b1, b2);
	// With the masses of now
	static_cast<SnowPhys*>(I->phys.get())->stiffness = math::min(snowStiffness(*m1, b1), snowStiffness(*m2, b2));
	if (phys)
		setProperties(*phys, b1, b2, static_cast<ElementMat*>(m1.get())->friction,
		        static_cast<ElementMat*>(m2.get())->friction, 1, dampingRatio);
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
