// SPDX-License-Identifier: GPL-2.0-or-later
/// Properties and history of a pair in contact (IPhys), made by Ip2, and the elastic part of the contact laws (Law2).
/// Dashpots, friction and the forces on the bodies: ContactForces.
#pragma once
#include <ContactGeometry.hpp>
#include <Materials.hpp>
#include <kernel/contact_pair.hpp>
#include <pkg/common/NormShearPhys.hpp>
#include <array>
#include <boost/serialization/array.hpp>

namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, timber::ImpactState& i, const unsigned int)
	{
		ar& make_nvp("timeLeft", i.timeLeft) & make_nvp("rebound", i.rebound) & make_nvp("load", i.load);
	}
	template <class Archive> void serialize(Archive& ar, timber::PointRecord& p, const unsigned int)
	{
		ar& make_nvp("id", p.id.bits) & make_nvp("unloadedOverlap", p.unloadedOverlap)
		        & make_nvp("crushed", p.crushed) & make_nvp("overlap", p.overlap)
		        & make_nvp("stiffness", p.stiffness);
		ar& make_nvp("normal", p.normalForce) & make_nvp("energy", p.energy) & make_nvp("shear", p.shearForce)
		        & make_nvp("dashpot", p.dashpotForce) & make_nvp("normalStored", p.normalStored)
		        & make_nvp("shearStored", p.shearStored) & make_nvp("impact", p.impact);
	}
}
}

namespace yade {

using SourceNumbers = std::array<Real, 9>; ///< of ManifoldPhys

/// Base of all contact laws' IPhys. YADE's functions read the attributes of NormShearPhys: the forces of the last step.
class ManifoldPhys : public NormShearPhys {
public:
	void postLoad(ManifoldPhys&) { ManifoldPhys::validate(); }
	void validate() const;
	/// Of bodies that were placed in contact, in this step only: of all springs [J], of the deepest point [m]
	Real placedEnergy = 0, placedOverlap = 0;
	timber::BearingStrength strength; ///< of each point, in this step
	bool isActing = true; ///< whether one of the points is not idle in this step
	bool isMoved = false; ///< one of the bodies was moved by hand before this step, with points in contact
	/// No contact points, and no energy released in the last step.
	bool isIdle() const { return records.empty() && releasedEnergy == 0; }
	timber::PairProperties properties() const
	{
		return { mass, friction, shearRatio, overlapLimit, dampingRatio, exponent, strength };
	}
	/// Contact points as tuples, see ``yade_timber.contacts``.
	boost::python::list pyPoints() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ManifoldPhys, NormShearPhys, "Properties of a pair in contact and the history "
		"of its points. ``normalForce`` and ``shearForce`` [N]: sums over the points in the last step.",
		((Real, mass, NaN, Attr::triggerPostLoad, "Equivalent mass of the two elements. [kg] (paper, Eq. 43)"))
		((Real, friction, NaN, Attr::triggerPostLoad, "Coulomb friction coefficient. [-]"))
		((Real, shearRatio, NaN, Attr::triggerPostLoad, "K_s / K_n. [-] (paper, Eq. 40)"))
		((Real, dampingRatio, 1, Attr::triggerPostLoad, "Share of critical damping, C = 2 ratio sqrt(m K). [-] "
			"(paper, Eqs. 41-42: 1)"))
		((Real, overlapLimit, NaN, Attr::triggerPostLoad, "Overlap beyond which the normal force is constant: "
			"the cores touch. [m]"))
		((Real, bearing, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Bearing strength of "
			"the weaker material; infinite: elastic. [Pa]"))
		((Real, bearingRadius, 0, Attr::triggerPostLoad, "Smaller rounding radius of the two elements. [m]"))
		((Real, exponent, timber::HertzLaw::exponent, Attr::readonly, "Exponent of the contact law. [-]"))
		((vector<timber::PointRecord>, records, , Attr::hidden, "History of the contact points, sorted by "
			"feature id. [-]"))
		((SourceNumbers, source, , Attr::hidden, "Numbers of the materials and of the Ip2 functor from which the "
			"attributes were computed."))
		((Real, releasedEnergy, 0, Attr::readonly, "Elastic energy released in the last step with loaded "
			"points that ceased to exist, minus the energy given to new points. [J]")),
		createIndex();,
		.add_property("points", &ManifoldPhys::pyPoints, "Forces at the contact points on body 2, world frame: "
			"list of (feature id, elastic normal force [N], elastic shear force [N], dashpot force [N], "
			"plastic overlap [m]).")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ManifoldPhys, NormShearPhys);
};
REGISTER_SERIALIZABLE(ManifoldPhys);

class TimberPhys : public ManifoldPhys {
public:
	void postLoad(TimberPhys&) { validate(); }
	void validate() const;
	timber::HertzLaw law() const { return { modulus, radius }; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(TimberPhys, ManifoldPhys, "Hertz contact between two timber elements.",
		((Real, modulus, NaN, Attr::triggerPostLoad, "Equivalent Young's modulus. [Pa] (paper, Eq. 35)"))
		((Real, radius, NaN, Attr::triggerPostLoad, "Relative radius of curvature, from spheres of the "
			"elements' volumes. [m] (paper, Eq. 36)")),
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(TimberPhys, ManifoldPhys);
};
REGISTER_SERIALIZABLE(TimberPhys);

class SnowPhys : public ManifoldPhys {
public:
	void postLoad(SnowPhys&) { validate(); }
	void validate() const;
	timber::LinearLaw law() const { return { stiffness }; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(SnowPhys, ManifoldPhys, "Linear contact of snow with snow or timber.",
		((Real, stiffness, NaN, Attr::triggerPostLoad, "K_n of each contact point. [N/m] (paper, Table 1)")),
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SnowPhys, ManifoldPhys);
};
REGISTER_SERIALIZABLE(SnowPhys);

class Ip2_TimberMat_TimberMat_TimberPhys : public IPhysFunctor {
public:
	void postLoad(Ip2_TimberMat_TimberMat_TimberPhys&) { validate(); }
	void validate() const;
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(TimberMat, TimberMat);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ip2_TimberMat_TimberMat_TimberPhys, IPhysFunctor, "Timber on timber (paper, section "
		"3.1 (1)).",
		((Real, dampingRatio, 1, Attr::triggerPostLoad, "Share of critical damping. [-] (paper, Eqs. 41-42: "
			"1)")));
	// clang-format on
};
REGISTER_SERIALIZABLE(Ip2_TimberMat_TimberMat_TimberPhys);

class Ip2_ElementMat_ElementMat_SnowPhys : public IPhysFunctor {
public:
	void postLoad(Ip2_ElementMat_ElementMat_SnowPhys&) { validate(); }
	void validate() const;
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(ElementMat, ElementMat);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ip2_ElementMat_ElementMat_SnowPhys, IPhysFunctor, "Snow on snow or timber (paper, "
		"section 3.1 (2)): stiffness by the mass of the snow element, the lighter one of two.",
		((Real, dampingRatio, 1, Attr::triggerPostLoad, "Share of critical damping. [-] (paper, Table 1: 1)")));
	// clang-format on
};
REGISTER_SERIALIZABLE(Ip2_ElementMat_ElementMat_SnowPhys);

class Law2_ManifoldGeom_TimberPhys_Hertz : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;
	FUNCTOR2D(ManifoldGeom, TimberPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Law2_ManifoldGeom_TimberPhys_Hertz, LawFunctor, "Elastic forces of timber contacts "
		"(paper, Eqs. 15-20, 37-40). They act through :yref:`ContactForces`.",
		((bool, increment, false, , "Whether the normal force is summed from increments (paper, Eq. 38) "
			"instead of the closed form (Eq. 37). [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(Law2_ManifoldGeom_TimberPhys_Hertz);

class Law2_ManifoldGeom_SnowPhys_Linear : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;
	FUNCTOR2D(ManifoldGeom, SnowPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC(Law2_ManifoldGeom_SnowPhys_Linear, LawFunctor, "Elastic forces of snow contacts (paper, "
		"Table 1). They act through :yref:`ContactForces`.");
	// clang-format on
};
REGISTER_SERIALIZABLE(Law2_ManifoldGeom_SnowPhys_Linear);

/// Contact law of two materials. Its functors have the names of their classes.
struct ContactLaw {
	const char *material1, *material2; ///< in either order
	const char* argument; ///< both materials of the Ip2 functor
	const char* phys; ///< IPhys that it makes
	const char* law; ///< end of the name of the Law2 functor
	string ip2() const { return string("Ip2_") + argument + "_" + argument + "_" + phys; }
	string law2() const { return string("Law2_ManifoldGeom_") + phys + "_" + law; }
};
/// The registration of all laws, from which engines() makes the functors, checkContacts() requires them, and the tests
/// take their attributes.
extern const std::vector<ContactLaw> contactLaws;
/// (Ip2, IPhys, Law2) of each IPhys: names of classes.
boost::python::list pyContactLaws();

} // namespace yade
