// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactPhys.hpp>
#include <bodies.hpp>

namespace yade {

YADE_PLUGIN((ManifoldPhys)(TimberPhys)(SnowPhys)(Ip2_TimberMat_TimberMat_TimberPhys)(Ip2_ElementMat_ElementMat_SnowPhys)(Law2_ManifoldGeom_TimberPhys_Hertz)(
        Law2_ManifoldGeom_SnowPhys_Linear));

namespace {

	const RoundedPolyhedron& shapeOf(const Body& body) { return *static_cast<RoundedPolyhedron*>(body.shape.get()); }

	/// A fixed body counts as infinitely heavy.
	Real massOf(const Body& body) { return isFree(*body.state) ? body.state->mass : std::numeric_limits<Real>::infinity(); }

	void setPair(ManifoldPhys& phys, const Body& b1, const Body& b2, Real friction1, Real friction2, Real shearRatio, Real dampingRatio)
	{
		phys.mass         = timber::reduced(massOf(b1), massOf(b2));
		phys.friction     = std::min(friction1, friction2);
		phys.shearRatio   = shearRatio;
		phys.dampingRatio = dampingRatio;
		phys.overlapLimit = shapeOf(b1).radius + shapeOf(b2).radius;
	}

	/// Contact stiffness that an element brings along, if it is of snow. [N/m]
	Real snowStiffness(const Material& material, const Body& body)
	{
		const auto snow = dynamic_cast<const SnowMat*>(&material);
		return snow ? snow->stiffnessPerMass * body.state->mass : std::numeric_limits<Real>::infinity();
	}

	/// Relative motion at a contact point, from the velocities that led to the present placement. They belong to the middle of
	/// the last step, and so do the arms: with those of now, a pair that turns as a whole would seem to slide, by h/2 omega^2 per
	/// metre between the centres.
	timber::PointMotion motionAt(const Vector3r& x, const State& s1, const State& s2, Real h)
	{
		const auto velocity = [&](const State& s) {
			const Vector3r arm = x - s.pos;
			return Vector3r(s.vel + s.angVel.cross(arm - h / 2 * s.angVel.cross(arm)));
		};
		return { velocity(s2) - velocity(s1), (s1.angVel + s2.angVel) / 2 };
	}

	bool boundsOverlap(const Body& b1, const Body& b2)
	{
		return b1.bound && b2.bound && (b1.bound->min.array() <= b2.bound->max.array()).all() && (b2.bound->min.array() <= b1.bound->max.array()).all();
	}

	bool sameFeatures(const std::vector<timber::ContactPoint>& points, const std::vector<timber::PointState>& states)
	{
		return std::equal(points.begin(), points.end(), states.begin(), states.end(), [](const auto& p, const auto& s) { return p.id == s.id; });
	}

	/// Elastic step of all points of a pair. States of features that no longer meet go; their energy is booked as lost.
	template <class Law> class PairStep {
		const Law&                        law;
		const timber::PairProperties      pair;
		const State &                     s1, &s2;
		const Real                        dt;
		const timber::NormalForm          form;
		const bool                        placed; ///< the pair is new: its bodies were put where they are, overlap and all

		void step(const timber::ContactPoint& point, timber::PointState& state) const
		{
			timber::elasticStep(law, pair, point, motionAt(point.position, s1, s2, dt), dt, form, state);
		}
		/// Energy that goes with a point. Its normal spring has given its own back when the bodies simply parted. [J]
		Real leaving(const timber::PointState& s) const { return (s.overlap + s.closing > 0 ? s.energy : 0) + timber::shearEnergy(s, pair); }

		/// Gives a new point the overlap it may start with; returns what it takes of `energy`. [J]
		Real bear(const timber::ContactPoint& point, Real energy, timber::PointState& state) const
		{
			const Real approach = math::max(Real(0), Real(-motionAt(point.position, s1, s2, dt).velocity.dot(point.normal) * dt));
			const Real counted  = timber::bornOverlap(law, point.overlap, approach, energy);
			state.excess        = point.overlap - counted;
			return law.energy(counted) - law.energy(math::min(counted, approach));
		}

	public:
		PairStep(const Law& l, const timber::PairProperties& p, const State& a, const State& b, Real h, timber::NormalForm f, bool isPlaced)
		        : law(l)
		        , pair(p)
		        , s1(a)
		        , s2(b)
		        , dt(h)
		        , form(f)
		        , placed(isPlaced)
		{
		}
		/// Returns the energy lost with points that ceased to exist, less what points born under load took of it. [J]
		Real run(const std::vector<timber::ContactPoint>& points, std::vector<timber::PointState>& states) const
		{
			if (!sameFeatures(points, states)) return runChanged(points, states);
			for (size_t k = 0; k < points.size(); ++k)
				step(points[k], states[k]);
			return 0;
		}

	private:
		Real runChanged(const std::vector<timber::ContactPoint>& points, std::vector<timber::PointState>& states) const
		{
			std::vector<timber::PointState> next(points.size());
			Real                            lost = 0;
			auto                            old  = states.begin();
			for (size_t k = 0; k < next.size(); ++k) {
				for (; old != states.end() && old->id < points[k].id; ++old)
					lost += leaving(*old);
				if (old != states.end() && old->id == points[k].id) next[k] = *old++;
			}
			for (; old != states.end(); ++old)
				lost += leaving(*old);
			for (size_t k = 0; k < next.size(); ++k) {
				if (!placed && !(next[k].id == points[k].id)) lost -= bear(points[k], lost, next[k]);
				next[k].id = points[k].id;
				step(points[k], next[k]);
			}
			states.swap(next);
			return lost;
		}
	};

	/// Returns false when the pair is out of reach for good: no points, nothing lost, bounding boxes apart.
	template <class Phys> bool lawStep(IGeom* g, IPhys* p, Interaction* I, Scene* scene, timber::NormalForm form)
	{
		const ManifoldGeom& geom = *static_cast<ManifoldGeom*>(g);
		Phys&               phys = *static_cast<Phys*>(p);
		const Body &        b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
		if (geom.contactPoints.empty() && phys.states.empty()) {
			phys.lostEnergy = 0;
			return boundsOverlap(b1, b2);
		}
		const auto law  = phys.law();
		phys.lostEnergy = PairStep<decltype(law)>(law, phys.properties(), *b1.state, *b2.state, scene->dt, form, I->isFresh(scene)).run(geom.contactPoints, phys.states);
		return true;
	}

} // namespace

boost::python::list ManifoldPhys::pyStates() const
{
	boost::python::list all;
	for (const timber::PointState& s : states)
		all.append(boost::python::make_tuple(s.id.bits, Real(s.normal), Vector3r(s.shear), Vector3r(s.dashpot)));
	return all;
}

void Ip2_TimberMat_TimberMat_TimberPhys::go(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& I)
{
	if (I->phys) return;
	const TimberMat &     t1 = *static_cast<TimberMat*>(m1.get()), &t2 = *static_cast<TimberMat*>(m2.get());
	const Body &          b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
	shared_ptr<TimberPhys> phys(new TimberPhys);
	const Real            poisson = (t1.poisson + t2.poisson) / 2;
	setPair(*phys, b1, b2, t1.friction, t2.friction, 1 / (2 * (1 + poisson)), dampingRatio);
	phys->modulus = timber::equivalentModulus(t1.young, t1.poisson, t2.young, t2.poisson);
	phys->radius  = timber::reduced(timber::equivalentRadius(shapeOf(b1).volume), timber::equivalentRadius(shapeOf(b2).volume));
	I->phys       = phys;
}

void Ip2_ElementMat_ElementMat_SnowPhys::go(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& I)
{
	if (I->phys) return;
	const Body &         b1 = *Body::byId(I->getId1(), scene), &b2 = *Body::byId(I->getId2(), scene);
	shared_ptr<SnowPhys> phys(new SnowPhys);
	setPair(*phys, b1, b2, static_cast<ElementMat*>(m1.get())->friction, static_cast<ElementMat*>(m2.get())->friction, 1, dampingRatio);
	phys->stiffness = math::min(snowStiffness(*m1, b1), snowStiffness(*m2, b2));
	I->phys         = phys;
}

bool Law2_ManifoldGeom_TimberPhys_Hertz::go(shared_ptr<IGeom>& g, shared_ptr<IPhys>& p, Interaction* I)
{
	return lawStep<TimberPhys>(g.get(), p.get(), I, scene, increment ? timber::NormalForm::Increment : timber::NormalForm::Closed);
}

bool Law2_ManifoldGeom_SnowPhys_Linear::go(shared_ptr<IGeom>& g, shared_ptr<IPhys>& p, Interaction* I)
{
	return lawStep<SnowPhys>(g.get(), p.get(), I, scene, timber::NormalForm::Closed);
}

} // namespace yade
