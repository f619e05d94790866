//! Claims on MuJoCo's soft contact (§6).

use super::super::solvers::STOP;

/// Error of the forces \[N\] of the two contacts of `S6.dual` and `S6.same-optimum`, given ‖f‖ and the largest |a_u| + |a_ref|, when each
/// contact's natural map fᵢ − (fᵢ − ρᵢgᵢ)₊ is at most [`STOP`] times max(‖f‖, ‖ρ(a_u − a_ref)‖).
///
/// Strong monotony of H = A + R gives ‖f − f*‖ ≤ (1/ρ + ‖H‖)/λ_min(H) times the natural map. Here H = (4/5, 2/5; 2/5, 8/5 + 1/19): trace
/// below 5/2, determinant above 1.16, so that λ_min > 2/5, and 1/ρᵢ = Hᵢᵢ between 4/5 and 5/3; (5/3 + 5/2)·5/2 < 11, and ‖ρ(a_u − a_ref)‖ ≤
/// √2·5/4 < 2 times its largest entry.
/// Derived.
pub fn two_contacts(force: f64, acceleration: f64) -> f64 {
    11.0 * STOP * force.max(2.0 * acceleration)
}

/// How far a number that an engine computed for `references/facts` may move between processors, as `scripts/reference/facts.py` has it, for
/// numbers of size 1.
/// Required: of every stored fact, by scripts/reference/facts.py.
pub const COMPUTED: f64 = 1e-6;

/// Change \[m/s²\] of an acceleration that an engine's numbers show: five orders above [`COMPUTED`].
/// Derived.
pub const CHANGED: f64 = 1e5 * COMPUTED;

/// Distance \[m/s²\] of accelerations of about 140 m/s² that solvers find which run until their cost stands still: the cost is known to ε,
/// the acceleration to √ε of its size, and ten times that with the conditioning of a dual method (R is a tenth of A).
/// Derived.
pub const SAME_OPTIMUM: f64 = 10.0 * 140.0 / 67_108_864.0;

/// What “a few” iterations are.
/// Set.
pub const FEW: f64 = 10.0;

/// Relative distance of five iterates of conjugate gradients from an engine's: line searches exact to 2⁻⁴⁰ each, and a condition number of
/// a thousand between step length and iterate.
/// Derived.
pub const ITERATES: f64 = 1000.0 / (1u64 << 40) as f64;

/// Relative gradient, natural map or distance of an answer at rest: a hundred times [`STOP`], for a distance is the residual times (A +
/// R)/R, of the order of a hundred.
/// Derived.
pub const SOLVED: f64 = 100.0 * STOP;

/// Accuracy of the change of velocity for which the work of a solver is counted.
/// Set.
pub const COUNTED: f64 = 1e-6;

/// What “low accuracy” is: a tenth of the change of velocity, in the norm of M.
/// Set.
pub const LOW: f64 = 0.1;

/// What cannot be told apart: a hundredth of the change of velocity, in the norm of M.
/// Set.
pub const INDISTINGUISHABLE: f64 = 0.01;

/// Gaps \[m\] at which a ball is just in touch, or just not.
/// Set.
pub const TOUCH: [f64; 2] = [1e-12, 1e-15];

/// Change of v⁺ \[m/s\] of a ball of 1 kg under MuJoCo's default contact over 2·10⁻¹² m of depth between 0 and 2 mm, |v| ≤ 1 m/s: v⁺
/// has the derivative h (d (k d δ)′ + d′ (k d δ + b|v| + g)) in δ, with d ≤ 1 and d′ ≤ 2 (d_w − d₀)/width = 100 m⁻¹, hence (k d δ)′ ≤
/// k (1 + 100 δ); and two velocities of size 1 m/s are rounded.
/// Derived.
pub fn inside_contact(h: f64, stiffness: f64, damping: f64) -> f64 {
    let (rate, deep) = (100.0, 0.002);
    let derivative = h * (stiffness * (1.0 + rate * deep) + rate * (stiffness * deep + damping + 10.0));
    2.0 * TOUCH[0] * derivative + super::super::rounding(16, 1.0)
}

/// Relative error of a jump at such a depth δ against that at δ = 0: (d − d₀)/d₀ ≤ (δ/width)²/d₀ and k d δ over b v + g ≈ 115 m/s² are
/// below 3e-11, and the rounding of v⁺ is below 1e-14.
/// Derived.
pub const AT_TOUCH: f64 = 1e-8;

/// Difference of W \[1/kg\] of a ball of 1 kg, r = 0.1 m, I = ⅖ r², that is [`TOUCH`] deep: a scheme takes H at a lever between r − δ
/// and r, and r² − (r − δ)² over I is below 2rδ/I = 5δ/r; the rounding of 1 + r²/I = 3.5 by 16 operations is far below.
/// Derived.
pub const SAME_LEVER: f64 = 5.0 * 1e-12 / 0.1;

/// Distance \[m\] from its start of a ball that fell freely from 2 m for 250 steps and back: 500 steps, each of which rounds a place
/// below 2 m and a velocity below 5 m/s that acts for at most one second.
/// Derived.
pub const TURNED_ROUND: f64 = 2.0 * 500.0 * (2.0 + 5.0) * f64::EPSILON;
