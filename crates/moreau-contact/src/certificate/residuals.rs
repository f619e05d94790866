//! Residuals of a proposed solution, each in its own unit and at its own contact: how far r is from its cone, ŷ from the dual cone, and
//! both from being complementary.
//!
//! ```text
//!     primal            dist(r, K)                              [N·s]
//!     dual              dist(ŷ, K*)                             [m/s]     ŷ = y + μ‖y_t‖n for Coulomb, y otherwise
//!     complementarity   |r·ŷ|                                   [J]
//!     normal            min(r_n, ρ_n w)                         [N·s]     the natural map in two parts, see `judge`
//!     tangential        ‖r_t − P_disk(μ r_n)(r_t − ρ_t y_t)‖    [N·s]
//!     velocity          |u − (W r + u_free)|                    [m/s]     the stored u against the impulses
//! ```
//! y = u_free + shift + (W + R) r is computed from r here; a solution's own velocity is only compared. Polyhedral laws are judged by their
//! complementary pairs (`polyhedral`). Contact by contact each residual is held against max(τ · scale, floor), see `scales`: a light
//! contact beside a heavy one is judged by its own size.
//!
//! For comparison with other programs there are norms over all contacts that decide nothing: ‖r − P_K(r − ρŷ)‖ with ρ = rows/tr(W_kk +
//! R_kk), and with ρ = 1 kg by Siconos's size and by FCLIB's.

use super::at_contact::{Here, worst};
use super::judge::{Judge, check_sizes};
use super::judged::Judged;
use super::natural_map::{self, OneKilogram};
use super::polyhedral::Pairs;
use super::scales::Unheld;
use crate::problem::{ContactProblem, Law, Solution};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// The residuals of a proposed solution, and their scales.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Residuals {
    /// Each residual with its scale, at the contact where it is worst.
    pub judged: Judged,
    /// max over contacts of dist(r, K) \[N·s\].
    pub primal: f64,
    /// max over contacts of dist(ŷ, K*) \[m/s\].
    pub dual: f64,
    /// max over contacts of |r·ŷ| \[J\].
    pub complementarity: f64,
    /// max |u − (W r + u_free)| for the stored u \[m/s\].
    pub velocity: f64,
    /// ‖r − P_K(r − ρŷ)‖ over all contacts \[N·s\]; shown for comparison.
    pub natural_map: f64,
    /// The natural map with ρ = 1 kg by Siconos's size and by FCLIB's, which mix units; shown for comparison.
    pub one_kilogram: OneKilogram,
    /// ‖r‖ \[N·s\].
    pub impulse_scale: f64,
    /// ‖u_free + shift‖ \[m/s\].
    pub velocity_scale: f64,
    /// max(‖r‖, ‖ρ(u_free + shift)‖ over the contacts with an impulse or a residual) \[N·s\], the size of the natural map: it does not
    /// vanish with r, and a contact that merely separates fast does not raise it.
    pub natural_map_scale: f64,
}

/// The residuals of `solution` as an answer to `problem`.
///
/// # Errors
/// [`Error::Invalid`](moreau_exact::Error::Invalid) if the solution has another size than the problem, or if an edge compliance makes the
/// answer depend on edge impulses that it does not give.
/// A block of 1 kg slides at 2 m/s and arrives at 1 m/s, μ = ½; friction that is a tenth too strong is no solution:
/// ```
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::prelude::*;
///
/// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
/// let answer = |r_t: f64| {
///     let impulse = dvector![1.0, r_t];
///     Solution::new("by hand", impulse.clone(), block.velocity(&impulse), 0)
/// };
/// assert!(residuals(&block, &answer(-0.5))?.is_solution(1e-8));
/// let wrong = residuals(&block, &answer(-0.6))?;
/// assert!(!wrong.is_solution(1e-8) && (wrong.judged.tangential.largest - 0.1).abs() < 1e-15); // [N·s]
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn residuals(problem: &ContactProblem, solution: &Solution) -> Result<Residuals> {
    of_held(problem, solution, Unheld::default())
}

/// The same of contacts whose given velocities are what joints leave of others.
pub(super) fn of_held(problem: &ContactProblem, solution: &Solution, unheld: Unheld) -> Result<Residuals> {
    check_sizes(problem, solution)?;
    let judged = Judge::default().judge_held(problem, solution, unheld)?;
    let impulse = &solution.impulse;
    let data = problem.free_velocity() + problem.shift();
    let map = NaturalMap::new(problem, solution)?;
    let velocity = problem.velocity(impulse);
    Ok(Residuals {
        judged,
        primal: judged.primal.largest,
        dual: judged.dual.largest,
        complementarity: judged.complementarity.largest,
        velocity: judged.velocity.largest,
        natural_map: map.own_mass,
        one_kilogram: OneKilogram::new(map.one_kilogram, [&data, impulse, &velocity].map(|vector| norm(vector.as_slice()))),
        impulse_scale: norm(impulse.as_slice()),
        velocity_scale: norm(data.as_slice()),
        natural_map_scale: worst(norm(impulse.as_slice()), map.data),
    })
}

/// √Σ x², in units of the largest number where the squares are none any more; NaN if a number is.
fn norm(numbers: &[f64]) -> f64 {
    let of = |unit: f64| numbers.iter().map(|x| (x / unit) * (x / unit)).sum::<f64>().sqrt();
    let (plain, largest) = (of(1.0), numbers.iter().fold(0.0, |largest, x| worst(largest, x.abs())));
    if plain.is_infinite() && largest.is_finite() { largest * of(largest) } else { plain }
}

/// Norms over all contacts \[N·s\].
struct NaturalMap {
    /// With ρ = rows/tr(W_kk + R_kk).
    own_mass: f64,
    /// With ρ = 1 kg.
    one_kilogram: f64,
    /// ρ(u_free + shift) over the contacts with an impulse or a residual.
    data: f64,
}

impl NaturalMap {
    fn new(problem: &ContactProblem, solution: &Solution) -> Result<Self> {
        let rows = problem.rows_per_contact();
        let law_velocity = problem.law_velocity(&solution.impulse);
        let (mut pairs, mut maps) = (Pairs::default(), [const { Vec::new() }; 3]);
        for (contact, &rho) in natural_map::scales(problem).iter().enumerate() {
            let range = contact * rows..(contact + 1) * rows;
            let (r, y) = (&solution.impulse.as_slice()[range.clone()], &law_velocity.as_slice()[range.clone()]);
            let friction = problem.friction()[contact];
            let here = Here { contact, friction, r, y, weights: [rho; 2], ..Default::default() };
            match problem.law() {
                Law::PolyhedralCoulomb { directions } => pairs.fill_stewart_trinkle(solution, directions, &here),
                Law::PolyhedralAssociated { directions } => pairs.fill_edges(problem, solution, directions, &here)?,
                _ => {}
            }
            let map = |rho: f64| match problem.law().directions() {
                Some(_) => pairs.natural_map(rho),
                None => natural_map::natural_map(problem.law(), friction, r, y, rho),
            };
            let own = map(rho);
            maps[0].push(own);
            maps[1].push(map(1.0));
            if own != 0.0 || r.iter().any(|&r| r != 0.0) {
                let moved: Vec<f64> = range.map(|row| rho * (problem.free_velocity()[row] + problem.shift()[row])).collect();
                maps[2].push(norm(&moved));
            }
        }
        let [own_mass, one_kilogram, data] = maps.map(|numbers| norm(&numbers));
        Ok(NaturalMap { own_mass, one_kilogram, data })
    }
}

/// ‖M̂(v⁺ − v) − hF − Hᵀr‖ \[N·s\], the momentum balance of a step.
///
/// - `mass`: M̂, nv × nv; `change`: v⁺ − v \[m/s\]; `force_impulse`: hF \[N·s\]; `jacobian`: H, rows × nv; `impulse`: r \[N·s\].
pub fn momentum(
    mass: &DMatrix<f64>,
    change: &DVector<f64>,
    force_impulse: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    impulse: &DVector<f64>,
) -> f64 {
    (mass * change - force_impulse - jacobian.tr_mul(impulse)).norm()
}

impl Residuals {
    /// Whether every residual is at most max(`tolerance` · scale, rounding) at every contact. NaN is never a solution, and neither is an
    /// answer whose norms are too large for a number: infinity is at most infinity, which shows nothing.
    pub fn is_solution(&self, tolerance: f64) -> bool {
        self.no_number().is_none() && self.judged.accepts(tolerance)
    }

    /// The first of the norms that must be numbers and is none, by its name: an answer with one is no solution, whatever its residuals are.
    /// ```
    /// use moreau_contact::nalgebra::{DMatrix, DVector};
    /// use moreau_contact::prelude::*;
    ///
    /// let open = |fast: f64| {
    ///     let problem = ContactProblem::new(DMatrix::identity(2, 2), DVector::from_element(2, fast)).rows_per_contact(1).build()?;
    ///     let nothing = DVector::zeros(2);
    ///     residuals(&problem, &Solution::new("by hand", nothing.clone(), problem.velocity(&nothing), 0))
    /// };
    /// assert!(open(1e200)?.is_solution(1e-8)); // the squares are no numbers, the norm is one
    /// assert_eq!(open(1.5e308)?.no_number(), Some("velocity_scale"));
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn no_number(&self) -> Option<&'static str> {
        let deciding = ["natural_map", "impulse_scale", "velocity_scale", "natural_map_scale"];
        let none = |(name, value, _): &(&'static str, f64, &str)| !value.is_finite() && deciding.contains(name);
        self.norms().into_iter().find(none).map(|(name, ..)| name)
    }

    /// What is shown for comparison and decides nothing: name, value and unit.
    pub fn norms(&self) -> [(&'static str, f64, &'static str); 6] {
        [
            ("natural_map", self.natural_map, "N·s"),
            ("siconos", self.one_kilogram.siconos, "1"),
            ("fclib", self.one_kilogram.fclib, "1"),
            ("impulse_scale", self.impulse_scale, "N·s"),
            ("velocity_scale", self.velocity_scale, "m/s"),
            ("natural_map_scale", self.natural_map_scale, "N·s"),
        ]
    }
}

#[cfg(test)]
#[path = "parts_tests.rs"]
mod parts_tests;

#[cfg(test)]
#[path = "residuals_tests.rs"]
mod tests;
