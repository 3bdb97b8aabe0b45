// SPDX-License-Identifier: GPL-2.0-or-later
/// What a pair of bodies shares (Ip2) and the elastic part of the contact laws (Law2). Dashpots, sliding and the
/// forces on the bodies: ContactForces.
#pragma once
#include <ContactGeometry.hpp>
#include <Materials.hpp>
#include <kernel/contact_pair.hpp>

namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, timber::PointState& s, const unsigned int)
	{
		ar & BOOST_SERIALIZATION_NVP(s.id.bits);
		ar & boost::serialization::make_nvp("excess", s.excess) & boost::serialization::make_nvp("overlap", s.overlap);
		ar & boost::serialization::make_nvp("stiffness", s.stiffness) & boost::serialization::make_nvp("normal", s.normal) & boost::serialization::make_nvp("energy", s.energy) & boost::serialization::make_nvp("closing", s.closing);
		ar & boost::serialization::make_nvp("shear", s.shear) & boost::serialization::make_nvp("dashpot", s.dashpot);
		ar & boost::serialization::make_nvp("response", s.normalResponse) & boost::serialization::make_nvp("shearResponse", s.shearResponse) & boost::serialization::make_nvp("responseMass", s.responseMass);
	}
}
}

namespace yade {

/// Common to all contact laws: pair properties and the history of each contact point.
class ManifoldPhys : public IPhys {
public:
	/// Nothing is pressed, and nothing was lost in the last step.
	bool                   isIdle() const { return states.empty() && lostEnergy == 0; }
	timber::PairProperties properties() const { return { mass, friction, shearRatio, overlapLimit }; }
	/// Contact points as dictionaries, see ``yade_timber.contacts``.
	boost::python::list pyStates() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ManifoldPhys, IPhys, "Properties of a pair in contact and the history of its points.",
		((Real, mass, NaN, , "Equivalent mass of the two elements. [kg] (paper, Eq. 43)"))
		((Real, friction, NaN, , "Coulomb friction coefficient. [-]"))
		((Real, shearRatio, NaN, , "K_s / K_n. [-] (paper, Eq. 40)"))
		((Real, dampingRatio, 1, , "Share of critical damping, C = 2 ratio sqrt(m K). [-] (paper, Eqs. 41-42: 1)"))
		((Real, overlapLimit, NaN, , "Overlap beyond which the normal force stays constant: the cores touch. [m]"))
		((vector<timber::PointState>, states, , Attr::hidden, "History of the contact points, sorted by feature id. [-]"))
		((Real, lostEnergy, 0, Attr::readonly, "Elastic energy that went in the last step because a loaded point ceased to exist, minus that of points born under load. [J]")),
		createIndex();,
		.add_property("points", &ManifoldPhys::pyStates, "Forces at the contact points on body 2, world frame: list of (feature id, elastic normal force [N], elastic shear force [N], dashpot force [N]).")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ManifoldPhys, IPhys);
};
REGISTER_SERIALIZABLE(ManifoldPhys);

class TimberPhys : public ManifoldPhys {
public:
	timber::HertzLaw law() const { return { modulus, radius }; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(TimberPhys, ManifoldPhys, "Hertz contact between two timber elements.",
		((Real, modulus, NaN, , "Equivalent Young's modulus. [Pa] (paper, Eq. 35)"))
		((Real, radius, NaN, , "Relative radius of curvature, from spheres of the elements' volumes. [m] (paper, Eq. 36)")),
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(TimberPhys, ManifoldPhys);
};
REGISTER_SERIALIZABLE(TimberPhys);

class SnowPhys : public ManifoldPhys {
public:
	timber::LinearLaw law() const { return { stiffness }; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(SnowPhys, ManifoldPhys, "Linear contact of snow with snow or timber.",
		((Real, stiffness, NaN, , "K_n of each contact point. [N/m] (paper, Table 1)")),
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SnowPhys, ManifoldPhys);
};
REGISTER_SERIALIZABLE(SnowPhys);

class Ip2_TimberMat_TimberMat_TimberPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(TimberMat, TimberMat);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ip2_TimberMat_TimberMat_TimberPhys, IPhysFunctor, "Timber on timber (paper, section 3.1 (1)).",
		((Real, dampingRatio, 1, , "Share of critical damping. [-] (paper, Eqs. 41-42: 1)")));
	// clang-format on
};
REGISTER_SERIALIZABLE(Ip2_TimberMat_TimberMat_TimberPhys);

class Ip2_ElementMat_ElementMat_SnowPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(ElementMat, ElementMat);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ip2_ElementMat_ElementMat_SnowPhys, IPhysFunctor, "Snow on snow or timber (paper, section 3.1 (2)): stiffness by the mass of the snow element, the lighter one of two.",
		((Real, dampingRatio, 1, , "Share of critical damping. [-] (paper, Table 1: 1)")));
	// clang-format on
};
REGISTER_SERIALIZABLE(Ip2_ElementMat_ElementMat_SnowPhys);

class Law2_ManifoldGeom_TimberPhys_Hertz : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;
	FUNCTOR2D(ManifoldGeom, TimberPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Law2_ManifoldGeom_TimberPhys_Hertz, LawFunctor, "Elastic forces of timber contacts (paper, Eqs. 15-20, 37-40). They act through :yref:`ContactForces`.",
		((bool, increment, false, , "Whether the normal force is summed from increments (paper, Eq. 38) instead of the closed form (Eq. 37). [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(Law2_ManifoldGeom_TimberPhys_Hertz);

class Law2_ManifoldGeom_SnowPhys_Linear : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;
	FUNCTOR2D(ManifoldGeom, SnowPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC(Law2_ManifoldGeom_SnowPhys_Linear, LawFunctor, "Elastic forces of snow contacts (paper, Table 1). They act through :yref:`ContactForces`.");
	// clang-format on
};
REGISTER_SERIALIZABLE(Law2_ManifoldGeom_SnowPhys_Linear);

} // namespace yade
