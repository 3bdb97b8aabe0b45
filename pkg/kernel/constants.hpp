// SPDX-License-Identifier: GPL-2.0-or-later
/// Tolerances and limits of the kernel: meaning, unit, and the effect of a larger or smaller value.
#pragma once
#include <cstddef>

namespace timber {

// --- shapes ---

/// Rounding radius as a fraction of the shortest edge (paper, section 2.2). [-]
constexpr double radiusShare = 0.10;

/// Maximum number of vertices of a polyhedron. [-] The search for the axis of least overlap takes a time that grows
/// with the square of this number: a step of two prisms with overlapping cores takes 2 us with 12 vertices, 50 us with
/// 64. A prism of 32 sides is admissible. Larger: slow steps; smaller: fewer admissible shapes.
constexpr std::size_t maxVertices = 64;

/// Admissible extent of a polyhedron. [m] Within these bounds the squared product of three lengths neither overflows
/// nor underflows.
constexpr double smallestSize = 1e-6, largestSize = 1e6;

/// Points closer to a plane than this fraction of the polyhedron's size lie in the plane. [-]
/// Larger: nearly flat corners are lost; smaller: vertices in single precision no longer give planar faces.
constexpr double planarShare = 1e-6;

/// Upper limit of planarShare for warped faces, e.g. of vertices rounded to the millimetre. Larger values than
/// planarShare are used only if corners of the core are too close to be two contacts. [-]
/// Larger: more warped input is accepted and the core deviates more from it; smaller: it is refused.
constexpr double warpShare = 1e-3;

/// Corners closer to their face's plane than this fraction of the polyhedron's size are in it but for rounding. [-]
/// Mass properties of bodies with other faces are those of the convex hull.
/// Larger: mass properties of warped faces depend on their diagonals; smaller: those of rotated boxes change in their
/// last digits.
constexpr double roundingShare = 1e-11;

// --- contact points ---

/// Two positions closer than this coincide: a vertex above the border of a face, a crossing at the end of an edge, two
/// vertices. [m] It is below any construction tolerance and far above rounding errors, so that flush contacts do not
/// depend on rounding.
/// Larger: a member slides farther beyond a border before it loses the support of a face; smaller: rounding decides
/// about flush contacts.
constexpr double flushTolerance = 1e-4;

/// Upper limit of the flush tolerance as a share of the contact distance of a pair. [-] It concerns bodies of some
/// centimetres and less, whose rounding radii are not large against flushTolerance.
/// Larger: the distances of small bodies are less accurate; smaller: rounding errors of pairs far from the origin decide
/// about flush contacts.
constexpr double flushShare = 0.02;

/// Rounding errors of lengths in a pair. [m] A closest point beyond the end of an edge by less than this is on it.
/// Larger: distances of vertices from edges are those from points beyond their ends; smaller: no feature is closest.
constexpr double roundingLength = 1e-9;

/// Edges are parallel, and have no crossing point, if the sine of their angle is smaller than this and vertex-edge
/// contacts are off. [-]
/// Larger: crossings are lost; smaller: the crossing of nearly parallel edges jumps along them.
constexpr double parallelSine = 5e-3;

/// The same with vertex-edge contacts: the ends of the edges carry. [-] The distance of edges of 1 m that cross at this
/// angle is that of their ends to 1e-11 m.
/// Larger: the ends of long edges are farther from each other than the edges; smaller: rounding decides where they cross.
constexpr double smallestSine = 1e-6;

/// Sine of the angle between two edges below which the ends of both have contacts, as the vertices of flush faces have.
/// [-] Larger: more points; smaller: the ends lose their points while these carry a load.
constexpr double lineSine = 0.05;

/// Points that coincide within twice the flush tolerance are one if the second is not deeper than the first by more than
/// this share of it. [-] Larger: overlaps are less accurate; smaller: two points at coincident corners of tilted faces.
constexpr double duplicateShare = 1e-3;

/// Minimum cosine between the normals of a point and of the one that it continues with other features. [-] Normals turn
/// with the bodies by less in a step.
/// Larger: springs are lost where features change; smaller: a spring acts in another direction after the change.
constexpr double successionCosine = 0.9;

/// Overlapping cores: minimum cosine between the normal of a contact point and the axis of least overlap. [-]
/// Larger: fewer points, or the single point of the cores instead; smaller: points with normals across the axis, which
/// rounding decides.
constexpr double deepNormalCosine = 0.5;

/// Components of unit normals along an edge up to which two edges may form a face of the Minkowski difference. [-]
/// Larger: more axes are tested; 0: rounding leaves out axes close to those of faces.
constexpr double arcTolerance = 1e-10;

// --- cache of candidate features; none of these values changes a result ---

/// Skin of the candidate search, as in Verlet lists: the candidates stay valid while the pair moves by less than this.
/// [m] Larger: fewer searches, more candidates in each step.
constexpr double candidateSkin = 4e-3;

/// Skin for pairs at rest: those whose displacement changed by less than half of it in restInterval updates. [m]
/// Larger: more candidates in each step; smaller: more searches. A search pays off within about 20 updates, or 40 with
/// the one that follows when the pair moves again.
constexpr double restSkin = candidateSkin / 20;
constexpr int restInterval = 100; ///< [updates]
static_assert(restSkin * restSkin > 2 * flushTolerance * flushTolerance,
        "the skin must cover the distance of a flush support from a corner");

/// A near pair without contact points is tested for a separating axis once in this many updates. [-] The test costs
/// about five updates, and many such pairs have none where vertex-edge contacts are off (the paper's houses).
/// Larger: separated pairs are recognised later; smaller: more tests.
constexpr int axisInterval = 24;

/// Candidates: the crossing of two edges is extrapolated to first order in the motion if the sine of their angle
/// exceeds this; otherwise the distance of the edges decides alone. [-]
/// Larger: more candidates; smaller: the shift of a crossing exceeds the first-order bound.
constexpr double crossingSine = 0.2;

/// Minimum radius of the region in which the motion of a pair is bounded, in skins. [-] It limits the rotation between
/// two searches to its inverse, 0.04 rad.
/// Larger: a search after smaller rotations; smaller: the small-angle bounds of the search no longer hold.
constexpr double minRegionSkins = 25;

/// Largest overlap with which bodies may be placed. [m] Loaded members of a house overlap by less than 0.1 mm.
/// Larger: springs of bodies placed in each other throw them apart; smaller: loaded bodies cannot be placed at rest.
constexpr double largestPlacedOverlap = 5e-4;

// --- contact solver ---

/// Convergence threshold of the first sweep of a step, as a share of the tolerance of the later sweeps. [-]
/// 1: the error of the warm start does not decay, and stiff loaded members (braces under snow, the foot of a stack, at
/// steps of 2.5e-4 s) jitter; 1e-4: the jitter is smaller by that factor (1e-8 of a stack's weight); 0: a second sweep
/// even where all is at rest.
constexpr double firstSweepShare = 1e-8;

/// Share of the changes of the first sweep of a step to which the later sweeps reduce them. [-] 1: the error of a step
/// is that of the next one, boards of 1 kg under blocks of 2 t jitter by 1e-3 to 1e-2 m/s and creep by 4e-5 m/s; 0.01:
/// more sweeps, no less motion.
constexpr double sweepReduction = 0.1;

/// Smallest convergence threshold of the sweeps after the first one, as a share of the points' impulses. [-] An island
/// at rest is solved to a share of its own residual changes, but not beyond this. 1e-3: braces of a loaded house at rest
/// oscillate at up to 1e-3 rad/s; 1e-6: by 1e-6 rad/s; 1e-7: more sweeps at rest, and no less motion.
constexpr double restTolerance = 1e-6;

/// Smallest convergence threshold as a share of the island's momenta. [-] Where a loose body has just touched, all
/// impulses are zero after the first sweep and give no threshold. 1e-8: two steps of a pile of the stress set do not
/// converge, at changes of 1e-19 J; larger: error of the impulses of soft contacts.
constexpr double roundingTolerance = 1e-7;

/// Decrease of the convergence threshold during the sweeps of a step from which on they go on with the new one. [-]
/// Where a warm start of 1 N s ends as 1e-4 N s, the threshold of the first sweep is larger than the impulses. 1:
/// more sweeps for changes of some per cent; 0: light members that are struck gain energy.
constexpr double thresholdDrop = 0.25;

/// Sweeps over changing pairs; accelerated ones follow. [-] Larger: more sweeps where light members are pressed between
/// heavy ones; smaller: accelerated sweeps, which visit all pairs, where a few more plain ones are enough.
constexpr int plainSweeps = 500;

/// Sweeps from which on the impulses of stiff joints go half of their way. [-] The force (2) of spring_step.hpp on a
/// spring that yields need not increase with its stretch across the path: visits of the joint and of its neighbours may
/// then alternate for ever, half steps do not. Larger: longer steps; smaller: slower convergence of stiff joints.
constexpr int relaxedSweeps = 100;

/// Accelerated sweeps before Newton's method is tried, and between two tries. [-] It takes as long as some 500 sweeps.
/// 100: where friction has several solutions, it may find one that sweeps do not (a board of the stress set is thrown
/// with 3.4 instead of 1.1 m/s); larger: longer steps.
constexpr int newtonInterval = 2000;

/// Most free bodies of an island that Newton's method solves. [-] Its matrix has six rows for each: the cost grows with
/// their cube.
constexpr int newtonBodies = 40;

/// Softness of a point whose account limits its impulse (point_law.hpp): in the first root of Newton's method, in the
/// last one, and by which it falls from root to root; roots that are tried at most. [-]
/// Last one larger: points return less than they have, by this share; 1e-8: rounding of the velocities decides.
/// Fall larger: more roots; smaller: the start of a root is too far off.
constexpr double firstSoftness = 0.1, leastSoftness = 1e-6, softnessShare = 0.01;
constexpr int softnessLevels = 12;

/// Most steps of Newton's method to a root, and |r| there over the momenta. [-] Ten steps are usual; rounding leaves
/// 1e-10.
constexpr int newtonSteps = 20;
constexpr double newtonTolerance = 1e-9;

/// Search along a direction of Newton's method: most trials, and the slope that ends them over that at the start. [-]
constexpr int lineSteps = 20;
constexpr double lineTolerance = 0.1;

/// Differences of velocities for the slope of an impulse, over the velocities. [-] Larger: the curvature counts; smaller:
/// rounding does.
constexpr double slopeShare = 1e-7;

/// Sweeps from which on the returned energy is checked: a small change of impulses does not mean a small error. [-]
/// 20: boards of 1 kg between blocks of 1 t gain 1e-2 of the energy put in, and walk out; 1: a pass over the points in
/// steps at rest, too.
constexpr int checkedSweeps = 2;

/// Energy that points may return beyond their accounts in a step of checkedSweeps or more, over the kinetic energy and
/// the accounts of the island. [-]
/// 1e-5: a slab on columns of 0.1 kg gains 2e-4 of the energy put in; 1e-7: more accelerated sweeps, no less gain.
constexpr double returnTolerance = 1e-6;

/// Duration of the longest impact whose velocity of separation is bounded, in steps. [-] Longer ones are resolved by
/// the steps: the restitution is right to 10 % at 20 steps for a critical dashpot.
/// Larger: points of a face that touch together keep the restitution of a single one at smaller steps; smaller: less
/// accurate impacts.
constexpr double impactSteps = 20;

/// Time for which the separation after a touch is bounded, in durations of the undamped impact. [-] Damped impacts that
/// act alone take at most one.
/// Larger: the velocity at which contacts with other loads separate is bounded for longer; smaller: impacts end without
/// their restitution.
constexpr double impactDurations = 1.5;

/// Velocity by which other contacts and forces press the surfaces together within the duration of an impact, or a step
/// if that is longer, over the touch speed, from which on the contact counts as loaded. [-] Larger: more bounds, which
/// contradict each other where members are wedged, and twice the sweeps; smaller: impacts of loaded members are left to
/// the step's scheme.
constexpr double impactLoadShare = 1;

/// Softness s of the bound of an impact. [-] Points of an edge have nearly the same equation and bounds that differ by
/// some per cent.
/// Larger: faces whose points share the impulse leave up to s times the touch speed faster than a single point; 0:
/// their impulses move from one point to another by 1e-4 a sweep.
constexpr double reboundSoftness = 0.02;

/// Most iterations of Newton's method for the elastic part of the overlap of a crushed contact [-], and the relative
/// change that ends them [-]. Ten suffice where the overlap is a hundredfold of the elastic one.
constexpr int yieldSteps = 40;
constexpr double yieldTolerance = 1e-13;

/// Steps of the Runge-Kutta method for the loading of an impact up to the strength. [-] The error of the velocity of
/// separation is below 1e-3 of it.
constexpr int crushingSteps = 64;

/// Rounding error of the strength of a contact. [-] What a point at its strength dissipates has been crushed.
constexpr double strengthRounding = 1e-9;

/// Sweeps over the pairs between two over the joints while pairs still change. [-] Larger: light members between stiff
/// joints and contacts converge slowly; smaller: longer sweeps.
constexpr int jointInterval = 4;

/// Rounding error of Coulomb's limit. [-] A point within it slides: its work is friction's.
constexpr double slidingRounding = 1e-9;

/// Most iterations of Newton's method for the hardening of a contact in a visit of its point [-], and the relative
/// error of the displacement that ends them [-].
/// Two or three suffice but for overlaps that grow a thousandfold.
constexpr int hardeningSteps = 40;
constexpr double hardeningTolerance = 1e-6;

/// Most iterations of Newton's method for the tangential impulse closest to one that returns too much [-], and the
/// excess over p S p, twice the work of the impulse's own velocity, that ends them [-].
/// Four in the mean, 29 where the responses of the tangents differ by 1e6. The rest of the excess shortens the impulse.
constexpr int projectionSteps = 30;
constexpr double projectionTolerance = 1e-6;

/// Closing displacement in a step, over the overlap, beyond which the hardening of a contact is taken into account. [-]
/// Larger: contacts that close fast gain energy; smaller: more computation.
constexpr double hardeningShare = 0.1;

/// Overlap that may be due to rounding. [m] Contacts below it do not harden within a step: flush bodies would move
/// differently with an overlap of zero and of 1e-16 m.
constexpr double roundingOverlap = 1e-9;

/// Product of the step and a joint's highest frequency above which its springs get Newmark's term. [-] Explicit springs
/// are stable below 2, several joints of a member together below less.
/// Larger: stiff joints of a member limit the step; smaller: more joints take part in the sweeps.
constexpr double stiffPhase = 1;
/// Share of it below which a stiff joint's springs are explicit again. [-] Modes change by some per cent as bodies turn.
constexpr double softPhase = 0.8;

/// Relative rounding of the stretches and forces of a backbone. [-] Larger: steeper lines than the stiffness are accepted.
constexpr double backboneRounding = 1e-9;

/// Change of a yielding spring's stretch in a step, over that at its strength with the initial stiffness, up to which
/// explicit springs may cross a corner of the law. [-] They err by up to a quarter of its square of the energy at the
/// strength. Larger: energy from nothing.
constexpr double yieldTravel = 0.05;
/// Energy by which explicit springs of a yielding joint may err in a step, over that of bodies and joints, from which on
/// the joint is solved as stiff ones are. [-] Smaller: walls of houses take part in the sweeps, four times the time of a
/// step.
constexpr double yieldError = 1e-5;

/// Share of the solver's tolerance for a joint that is just stiff; it falls with (h omega)^4. [-] 1: displacements of a
/// chain at h omega = 30 grow by 17 % in 100 steps; smaller: more sweeps.
constexpr double stiffToleranceShare = 0.1;

/// Newton's method of a stiff joint ends when the residual of its modal velocities is this share of them. [-]
constexpr double springTolerance = 1e-13;
/// Its largest number of iterations; linear springs need one, springs that yield two to six. [-]
constexpr int springIterations = 30;
/// Smallest share of a Newton step that is tried. [-]
constexpr double springLeastShare = 1e-3;

/// Rotation of a joint's bodies against each other from which on its vibration modes are computed again. [rad] The
/// modes vary only with it.
/// Larger: a damping ratio of an earlier placement; smaller: longer steps, 2 us for each computation.
constexpr double modeAngle = 0.05;
/// Factor of the error of a joint's impulse in a visit from which on they are computed again, too. [-] Larger: more
/// visits, which diverge from 1 on; smaller: more computations of modes.
constexpr double modeError = 0.25;

} // namespace timber
