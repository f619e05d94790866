//! Tolerances of the gate, one file per family of checks.
//!
//! Two kinds: the derived error of a sound discretisation at a step h (an allowance of the ideal), and the accuracy with which a
//! declared law predicts (an allowance of the model). Both grow by the rounding of the engine's own precision where that is coarser.

pub mod ball;
pub mod bounce;
pub mod conformance;
pub mod contact;
pub mod conveyor;
pub mod flight;
pub mod impact;
pub mod incline;
pub mod isotropy;
pub mod limits;
pub mod metamorphic;
pub mod painleve;
pub mod pair;
pub mod projection;
pub mod rest;
pub mod rocking;
pub mod rolling;
pub mod solver;
pub mod spin;
pub mod stack;
pub mod tumbling;

/// The part of a step's impulse that the step's solver may leave unsolved, √2⁻²³ = 3.5e-4. Every family that asks how well a step is
/// solved rests
/// on it: at rest, in stacks, on slopes, in the reported impulses, between transformed scenes.
///
/// This is a requirement of the gate, not the documented accuracy of an engine. It cannot be less than what an engine in single precision
/// can
/// do: a minimised energy that is known to ε of itself gives velocities to √ε, and ε = 2⁻²³ is the coarsest in use. It is coarser than the
/// documented stopping rules (`docs/engines/`), each as a part of the impulse m g h of one body at rest:
/// ```text
///     Drake SAP, Similar, Lagged    1e-6        rel_tolerance of SapSolverParameters, ‖D∇ℓ‖ ≤ 1e-6 max(‖D p‖, ‖D Jᵀγ‖)
///     Siconos NSGS                  1e-4        SICONOS_DPARAM_TOL by default; 1e-10 in our adapter
///     MuJoCo                        2.5e-5      opt.tolerance 1e-8 m²/s⁴: ½ m δa² ≤ 1e-8 tr M ≈ 3e-8 m leaves δa = √6e-8 m/s² of g
/// ```
/// MuJoCo's line holds for the acceleration; the force it reports is `impratio`^½ times as far off along the tangents. Its rule bounds
/// what the last iteration gained, so that PGS, which converges slowly, may leave more. That a solver which leaves 1e-3 is
/// caught and one that leaves 1e-4 is not, is shown by [`crate::planted`].
/// Required: of every engine, by the gate.
pub const SOLVED: f64 = 0.000_345_266_983_001_243_9;

/// How far the time of a sample may be from k h, relative to the duration. The protocol uses the same accuracy for "h divides the
/// duration".
/// Required: of every engine, by the protocol.
pub const SAME_TIME: f64 = 1e-9;

/// Relative change of gravity and velocities between repeated measurements, 2⁻³⁰ ≈ 1e-9. It is far below every allowance of the checks and
/// far above the rounding of double precision. So the spread shows how much an engine amplifies a small change of its input.
/// Set.
pub const PERTURBATION: f64 = 1.0 / (1u64 << 30) as f64;

/// A value is worse than its baseline only if it is so by more than this many times its spread. With three values, this many half ranges
/// cover the error of the mean with 95 % (Student, two degrees of freedom: 4.3).
/// Derived.
pub const SPREADS: f64 = 4.3;

/// A value is worse than its baseline only if it is so by more than this part of the ideal's allowance, too. A smaller change is the
/// rounding of another processor.
/// Required: of a baseline that is compared on another processor, by its users.
pub const NEWS: f64 = 1.0 / 1024.0;

/// What a value may change by in any case, in its unit: eight roundings of a number of size one, as positions, velocities and masses of the
/// checks are. The allowance of what a prescribed body does is rounding itself, and the 1024th part of that would be less than a last
/// digit.
/// Derived.
pub const LAST_DIGITS: f64 = 8.0 * moreau_exact::tolerance::EPSILON;

/// Part of the momentum that goes into an interval which its reported impulses may leave unaccounted for, where nothing more exact is
/// asked: a sign, a missing record or another body leave all of a term, and what a solver leaves is [`SOLVED`].
/// Set.
pub const UNACCOUNTED: f64 = 0.5;

/// Part of the way of a body by which its poses may be elsewhere than its reported velocities lead, where nothing more exact is asked: a
/// sign, another body or another frame miss all of it or more.
/// Set.
pub const UNMOVED: f64 = 0.5;

/// The turn of a step \[rad\] up to which the orientations at its ends tell it: one of more than π looks like one the other way, and half
/// of the way is left to what a scheme makes of a turn while its axis moves.
/// Set.
pub const FOLLOWED: f64 = 2.0;

/// Orders up to this are called constant: half the smallest order that a proven bound here has (½, the graph distance of a plastic impact).
/// Derived.
pub const CONSTANT_ORDER: f64 = 0.25;

/// Rounding of a quantity that an engine sums up from terms of this size in its own precision: 64 operations per term, as a contact of
/// three
/// rows over two bodies of six velocities makes at most.
/// Derived.
pub fn audit_rounding(epsilon: f64, size: f64) -> f64 {
    64.0 * epsilon * size
}
