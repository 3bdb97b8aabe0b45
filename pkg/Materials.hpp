// SPDX-License-Identifier: GPL-2.0-or-later
/// Materials of the elements.
#pragma once
#include <pch.hpp>

namespace yade {

/// Common base: YADE dispatches a pair of different materials in either order only through a base class.
class ElementMat : public Material {
public:
	void postLoad(ElementMat&) { validate(); }
	void validate() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ElementMat, Material, "Base class of :yref:`TimberMat` and :yref:`SnowMat`; not "
		"a material by itself.",
		((Real, friction, 0.5, Attr::triggerPostLoad, "Coulomb friction coefficient; a pair has the smaller "
			"one of its two materials. [-]")),
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ElementMat, Material);
};
REGISTER_SERIALIZABLE(ElementMat);

class TimberMat : public ElementMat {
public:
	void postLoad(TimberMat&) { validate(); }
	void validate() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(TimberMat, ElementMat, "Timber, or any other stiff material in Hertz contact "
		"(paper, section 3.1).",
		((Real, young, 90e3 * 9.8e4, Attr::triggerPostLoad, "Young's modulus: 90e3 kgf/cm2, with the paper's "
			"9.8 N per kgf. [Pa] (paper, section 3.1)"))
		((Real, poisson, 0.4, Attr::triggerPostLoad, "Poisson's ratio. [-] (paper, section 3.1)"))
		((Real, bearing, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Bearing strength, at "
			"which contacts yield: about 6e6 for softwood across the grain; infinite: elastic, as in the "
			"paper. [Pa]")),
		createIndex(); density = 340;
	);
	// clang-format on
	REGISTER_CLASS_INDEX(TimberMat, ElementMat);
};
REGISTER_SERIALIZABLE(TimberMat);

class SnowMat : public ElementMat {
public:
	void postLoad(SnowMat&) { validate(); }
	void validate() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(SnowMat, ElementMat, "Snow blocks with linear contact (paper, section 3.1 "
		"(2)).",
		((Real, stiffnessPerMass, 3.948e4, Attr::triggerPostLoad, "Contact stiffness, normal and tangential, "
			"per kilogram of the snow element. [N/m/kg] (paper, Table 1)")),
		createIndex(); density = 90;
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SnowMat, ElementMat);
};
REGISTER_SERIALIZABLE(SnowMat);

} // namespace yade
