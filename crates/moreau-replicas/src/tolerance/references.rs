//! Tolerances of the comparison with stored engine runs.

use nalgebra::{DMatrix, DVector};

/// Relative natural map that our solvers must reach on a stored step. It is the tolerance asked of Clarabel, the weakest of the stopping
/// rules in [`moreau_contact::tolerance::solvers`]. Polishing is only kept if it improves on it.
/// Derived.
pub const OUR_SOLVERS: f64 = 1e-10;

/// Rounding of an engine's own formulas: at most some tens of operations on numbers of one size, 64 ε, and a cancellation of
/// four digits where a depth of 1e-4 m is read from positions of 1 m.
/// Derived.
pub const ENGINE_ROUNDING: f64 = 64.0 * 1e4 * f64::EPSILON;

/// Largest gradient ‖M(q̈ − q̈₀) − Jᵀf‖ \[N\] at which MuJoCo's primal solvers stop: the scaled gradient ‖g‖/(m̄ nv) < `tolerance`,
/// with m̄ the mean of diag(M) (`stat.meaninertia`). With m̄ nv = tr M this is `tolerance` · tr M.
/// Derived.
pub fn mujoco_gradient(tolerance: f64, mass: &DMatrix<f64>) -> f64 {
    tolerance * mass.trace()
}

/// How near a stored step of MuJoCo's Newton is to the minimiser, relative to the velocity change and to the impulses: it stops where the
/// gradient over tr M falls below `tolerance` = 1e-8 m/s², while the change of acceleration is of the size of gravity; with the inertia of
/// a rotation two hundred times below the mass that is 1e-8/9.81·√200.
/// Derived.
pub const REPLAYED_STEP: f64 = 1.5e-8;

/// `tolerance` of the stored runs of MuJoCo's Newton that go on until rounding is nearly all that is left: their gradient is below 1e-9 N
/// where forces are 10 N, measured over all of them.
/// Set.
pub const CONVERGED_MUJOCO: f64 = 1e-20;

/// Error of a step of MuJoCo's Newton, run to the end, relative to accelerations and forces, as docs/results.md promises it. The steps end
/// in a quadratic zone or close to it. The last step leaves less than the relative gradient 1e-10 of [`CONVERGED_MUJOCO`].
/// Required: of our replica, by docs/results.md.
pub const CONVERGED_STEP: f64 = 1e-9;

/// Error of a motion of 500 steps \[m\] of an engine that was run to the end, as docs/results.md promises it.
/// Required: of our replica, by docs/results.md.
pub const REPLAYED_MOTION: f64 = 1e-8;

pub use moreau_forms::tolerance::SAP_RELATIVE;

/// Largest momentum residual \[N·s\] at which SAP stops: ‖D g‖ ≤ 1e-6 max(‖D M v‖, ‖D Jᵀγ‖) with D = diag(M)^{-1/2}, hence ‖g‖ is at most
/// that over min D.
/// Derived.
pub fn sap_gradient(mass: &DMatrix<f64>, momentum: &DVector<f64>, contact_impulse: &DVector<f64>) -> f64 {
    let scale = mass.diagonal().map(|m| 1.0 / m.sqrt());
    let size = |vector: &DVector<f64>| scale.component_mul(vector).norm();
    SAP_RELATIVE * size(momentum).max(size(contact_impulse)) / scale.min()
}

/// Kinetic distance ‖v − v*‖_M \[kg^½·m/s\] at which SAP may stop: its objective is strongly convex with M, so that the distance is at most
/// ‖g‖_{M⁻¹} ≤ λ_max(D⁻¹ M⁻¹ D⁻¹)^½ ‖D g‖, and ‖D g‖ is at most 1e-6 of the larger of ‖D M v‖ and ‖D Jᵀγ‖.
/// Derived.
pub fn sap_velocity(mass: &DMatrix<f64>, momentum: &DVector<f64>, contact_impulse: &DVector<f64>) -> f64 {
    let scale = mass.diagonal().map(|m| 1.0 / m.sqrt());
    let size = |vector: &DVector<f64>| scale.component_mul(vector).norm();
    let scaled = DMatrix::from_fn(mass.nrows(), mass.ncols(), |i, j| scale[i] * mass[(i, j)] * scale[j]);
    SAP_RELATIVE * size(momentum).max(size(contact_impulse)) / scaled.symmetric_eigenvalues().min().sqrt()
}

/// Momentum \[N·s\] that `steps` steps of SAP (also behind Similar and Lagged) may leave unbalanced at one body of mass `body`:
/// √m · 1e-6 ‖D p‖ per step, with p at most Σ m (v + g h).
/// Derived.
pub fn sap_momentum(body: f64, total: f64, speed: f64, steps: f64) -> f64 {
    SAP_RELATIVE * (body * total).sqrt() * speed * steps
}

/// Momentum \[N·s\] that `steps` steps of MuJoCo's CG may leave unbalanced at one body of mass `body`.
///
/// It stops where [`last_improvement`] says; √m of that is on one body.
/// Derived.
pub fn cg_momentum(tolerance: f64, rows: f64, mass_trace: f64, body: f64, h: f64, steps: f64) -> f64 {
    last_improvement(tolerance, rows, mass_trace) * body.sqrt() * h * steps
}

/// Gradient in the norm of M⁻¹ \[kg^½·m/s²\] that may be left where a step of MuJoCo's solvers improves the cost ½‖q̈ − q̈₀‖²_M + s(Jq̈ −
/// a_ref) by less than `tolerance` · tr M, which ends them.
///
/// A step improves it by at least ‖g‖²_{M⁻¹}/2L, what steepest descent would, with L = 1 + Σ A_ii/R_i. Here A_ii ≤ 4 Â_i (corners of these
/// boxes), R ≥ (1 − d_w)/d_w Â with d_w = 0.95, and there are at most 60 rows: ‖g‖_{M⁻¹} ≤ √(2 L tolerance tr M).
/// Derived.
pub fn last_improvement(tolerance: f64, rows: f64, mass_trace: f64) -> f64 {
    let lipschitz = 1.0 + 4.0 * rows * 0.95 / (1.0 - 0.95);
    (2.0 * lipschitz * tolerance * mass_trace).sqrt()
}

/// Relative accuracy of the sliding gap that is read from a SAP step. The gap is a sum of three terms, each with SAP's relative tolerance.
/// A term is at most 10 times as large as the gap.
/// Derived.
pub fn sap_sliding_gap() -> f64 {
    10.0 * SAP_RELATIVE
}

/// Relative error of a creep formula by the place of the contact points. The formula takes the levers of the undeformed corners. The depth,
/// at most 5 mm here, displaces a contact point by at most half of it, over a lever of 0.05 m or more. The creep depends on levers only
/// through the rotational part of w, and on depths through d.
/// Measured: scripts/measure_references.py, where formula and stored creep differ by up to 4e-5.
pub const CREEP_GEOMETRY: f64 = 1e-4;

/// Difference of a step from Siconos's that docs/results.md promises, in m, m/s and N·s. It is larger than rounding allows, see
/// [`siconos_step`].
/// Required: of our replica, by docs/results.md.
pub const SICONOS_PER_STEP: f64 = 1e-12;

/// Distance of one step from Siconos's with direct solvers on both sides, for numbers of the given size. It covers 64 operations, and the
/// 1e-14 m at which Siconos's projection ends. Siconos's iteration for spatial friction ends at 1e-15, a tenth of that. Its residual, the
/// natural map with ρ = 1 kg, is at least 1 − μ ≥ ½ times the error of the impulse of a mass of 1 kg.
/// Derived.
pub fn siconos_step(size: f64) -> f64 {
    moreau_exact::tolerance::rounding(64, size) + 1e-14
}

/// Distance of a whole run \[m\]. The distances of single steps add up. None of the stored motions makes a deviation grow: elastic impacts
/// keep it, other impacts and friction shrink it, and the bead swings in a bowl.
/// Derived.
pub fn siconos_run(steps: usize, step: f64) -> f64 {
    steps as f64 * step
}

/// Distance of a whole run \[m\] for a scheme that keeps two positions. An error δ of one step is an error δ/h of the velocity. It grows
/// to at most k δ in the k steps after it.
/// Derived.
pub fn siconos_double_sum(steps: usize, step: f64) -> f64 {
    (steps * steps) as f64 * step
}

/// Distance \[m/s\] of one step from Siconos's generalised-α, for velocities and gains of velocity of the given size: rounding, and what
/// Newton's iteration leaves of the momentum equation, whose tolerance \[N\] is h/m times an error of velocity.
/// Derived.
pub fn siconos_alpha_step(size: f64, newton: f64) -> f64 {
    siconos_step(size) + newton
}

/// Error of a flight between two of Siconos's events, in position and velocity alike: `theirs` steps of LSODAR, whose estimated error is
/// below the absolute tolerance and the relative one times the size, and ten of ours below
/// [`TOLERANCE`](moreau_dynamics::tolerance::event_driven::TOLERANCE) (1 + size). An error of velocity grows into one of position with the
/// duration \[s\].
/// Derived.
pub fn siconos_flight(theirs: usize, relative: f64, absolute: f64, size: f64, duration: f64) -> f64 {
    let steps = theirs as f64 * (absolute + relative * size) + 10.0 * moreau_dynamics::tolerance::event_driven::TOLERANCE * (1.0 + size);
    steps * (1.0 + duration)
}

/// Difference \[m/s\] up to which two solvers' velocities count as the same: contact velocities here are 0.01 to 10 m/s, so that five to
/// eight digits agree. Pinocchio's ADMM stops at residuals of 10⁻¹³, which fall by a factor q = 10^(−13/N) in each of N ≤ 1000 iterations:
/// what is left is at most 10⁻¹³/(1 − q) ≤ 4·10⁻¹², divided by its penalty and multiplied by ‖W + R‖, whose quotient the balance of the
/// residuals keeps below 10⁴.
/// Derived.
pub const SAME_VELOCITY: f64 = 1e-7;

/// Velocity error \[m/s\] that one step of ours leaves at speeds up to `speed`: the solver's stopping rule on data of that size, and 64
/// roundings.
/// Derived.
pub fn replayed_step(speed: f64) -> f64 {
    (moreau_contact::tolerance::solvers::STOP + 64.0 * f64::EPSILON) * speed
}

pub use crate::tolerance::solvers::BULLET_RESIDUAL;

/// Velocity error \[m/s\] of a body whose sweeps Bullet ended at the residual threshold `stop` \[m²/s²\]: the last sweep changed no row's
/// velocity by more than √stop, and sweeps over the twelve rows of four corners, whose error halves at least, leave at most twice as much.
/// Derived.
pub fn bullet_sweeps(stop: f64) -> f64 {
    2.0 * stop.sqrt()
}

/// Distance of one step from Bullet's with the same contact points, for velocities of the given size \[m/s\]: each of the `rows` rows reads
/// and writes a velocity of six entries in every sweep, 24 products, and what a sweep has rounded the following ones at most keep. Impulses
/// \[N·s\] are those velocities times 1 kg, and a body of the scenes is not heavier.
/// Derived.
pub fn bullet_step(sweeps: usize, rows: usize, size: f64) -> f64 {
    moreau_exact::tolerance::rounding(24 * rows * sweeps, size)
}

/// Headroom of the measured sensitivities: amplification and stopping effect come from one perturbation each, and a start differs
/// in at most 8 independent ways that matter (six velocities of a body, friction and normal data) from the one perturbed.
const HEADROOM: f64 = 8.0;

/// How far an engine determines a stored number of size at most `size`: rounding of `steps` steps amplified as measured when
/// the file was made, the measured effect of the engine's stopping tolerance, and the rounding of the number itself.
///
/// The same rule decides in `scripts/reference/tolerance.py` whether a regenerated file is the stored one.
/// Measured: scripts/generate_references.py, which stores amplification and effect of every file.
pub fn stored_number(amplification: f64, stopping: f64, steps: f64, size: f64) -> f64 {
    HEADROOM * (amplification * steps * f64::EPSILON + stopping) + 64.0 * f64::EPSILON * size
}

/// Distance in the kinetic norm \[kg^½·m/s\] that the stopping errors of all steps, Σ δ, may bring a motion away from its exact one: they
/// add up while the same contacts stay closed (see [`crate::drake::replay`]), with the headroom for contacts that open in one of the two
/// only.
/// Derived.
pub fn replayed(injected: f64) -> f64 {
    HEADROOM * injected
}

/// Rounding of `steps` steps from a stored sample, whose velocities and positions divided by h are of the given size \[m/s\]: a matrix of
/// six rows is factored in each.
/// Derived.
pub fn sample_rounding(steps: usize, size: f64) -> f64 {
    moreau_exact::tolerance::rounding(64 * steps, size)
}

/// Kinetic distance \[kg^½·m/s\] at which TAMSI may stop: an iteration that changes the contact velocities by less than v_s/100 is its
/// last. Newton's method then squares the error, of which no use is made; a contact velocity weighs at most the largest mass.
/// Derived.
pub fn tamsi_velocity(mass: &DMatrix<f64>, stiction_tolerance: f64) -> f64 {
    0.01 * stiction_tolerance * mass.diagonal().max().sqrt()
}
