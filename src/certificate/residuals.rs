//! Residuals of a proposed solution, each in its own unit: how far r is from its cone, ŷ from the dual cone, and both from being
//! complementary.
//!
//! ```text
//!     primal            max dist(r, K)                 [N·s]
//!     dual              max dist(ŷ, K*)                [m/s]     ŷ = y + μ‖y_t‖n for Coulomb, y otherwise
//!     complementarity   max |r·ŷ|                      [J]
//!     natural map       ‖r − P_K(r − ρŷ)‖              [N·s]     ρ = rows/tr(W_kk + R_kk) per contact
//!     velocity          max |u − (W r + u_free)|       [m/s]     the stored u against the impulses
//! ```
//! y = u_free + shift + (W + R) r is computed from r here; a solution's own velocity is only compared. Polyhedral laws
//! are judged through their complementary pairs (`polyhedral`). Each number is also held against the scale of its unit, because a
//! single relative residual hides errors.

use super::{natural_map, polyhedral};
use crate::cones::second_order;
use crate::problem::{ContactProblem, Law, Solution};
use crate::{Error, Result};
use nalgebra::{DMatrix, DVector};
use serde::{Serialize, Serializer, ser::SerializeMap};

/// The residuals of a proposed solution, and the scales they are held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residuals {
    /// max over contacts of dist(r, K) \[N·s\].
    pub primal: f64,
    /// max over contacts of dist(ŷ, K*) \[m/s\].
    pub dual: f64,
    /// max over contacts of |r·ŷ| \[J\].
    pub complementarity: f64,
    /// ‖r − P_K(r − ρŷ)‖ over all contacts \[N·s\].
    pub natural_map: f64,
    /// max |u − (W r + u_free)| for the stored u \[m/s\].
    pub velocity: f64,
    /// Siconos's number: the natural map with ρ = 1 kg over max(‖q‖, ‖r‖, ‖u‖), which mixes units; shown for comparison.
    pub siconos: f64,
    /// ‖r‖ \[N·s\].
    pub impulse_scale: f64,
    /// ‖u_free + shift‖ \[m/s\].
    pub velocity_scale: f64,
    /// max(‖r‖, ‖ρ(u_free + shift)‖ over the contacts with an impulse or a residual) \[N·s\], the scale of the natural map: it does not
    /// vanish with r, and a contact that merely separates fast does not raise it.
    pub natural_map_scale: f64,
}

/// The residuals of one contact, or of one contact's complementary pairs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AtContact {
    pub primal: f64,
    pub dual: f64,
    pub complementarity: f64,
    pub natural_map: f64,
    pub natural_map_unit: f64,
}

/// The residuals of `solution` as an answer to `problem`.
///
/// # Errors
/// [`Error::Invalid`] if the solution has another size than the problem, or if an edge compliance makes the answer depend on edge impulses
/// that it does not give.
pub fn residuals(problem: &ContactProblem, solution: &Solution) -> Result<Residuals> {
    problem.validate()?;
    sizes(problem, solution)?;
    let (rows, impulse) = (problem.rows_per_contact, &solution.impulse);
    let law_velocity = problem.law_velocity(impulse);
    let rho = natural_map::scales(problem);
    let data = &problem.free_velocity + &problem.shift;
    let mut total = AtContact::default();
    let mut weighted_data = 0.0;
    for (k, &rho) in rho.iter().enumerate() {
        let range = k * rows..(k + 1) * rows;
        let (r, y) = (&impulse.as_slice()[range.clone()], &law_velocity.as_slice()[range.clone()]);
        let here = match problem.law {
            Law::PolyhedralCoulomb { directions } => polyhedral::stewart_trinkle(problem, solution, directions, k, r, y, rho),
            Law::PolyhedralAssociated { directions } => polyhedral::edges(problem, solution, directions, k, r, y, rho)?,
            law => second_order_contact(law, problem.friction[k], r, y, rho),
        };
        total.primal = worst(total.primal, here.primal);
        total.dual = worst(total.dual, here.dual);
        total.complementarity = worst(total.complementarity, here.complementarity);
        total.natural_map += here.natural_map.powi(2);
        total.natural_map_unit += here.natural_map_unit.powi(2);
        if here.natural_map != 0.0 || r.iter().any(|&r| r != 0.0) {
            weighted_data += data.as_slice()[range].iter().map(|q| (rho * q).powi(2)).sum::<f64>();
        }
    }
    let velocity = problem.velocity(impulse);
    let unit_scale = worst(data.norm(), worst(impulse.norm(), velocity.norm()));
    Ok(Residuals {
        primal: total.primal,
        dual: total.dual,
        complementarity: total.complementarity,
        natural_map: total.natural_map.sqrt(),
        velocity: (&velocity - &solution.velocity).iter().fold(0.0, |largest, difference| worst(largest, difference.abs())),
        siconos: if unit_scale > 0.0 { total.natural_map_unit.sqrt() / unit_scale } else { total.natural_map_unit.sqrt() },
        impulse_scale: impulse.norm(),
        velocity_scale: data.norm(),
        natural_map_scale: worst(impulse.norm(), weighted_data.sqrt()),
    })
}

fn second_order_contact(law: Law, friction: f64, impulse: &[f64], law_velocity: &[f64], rho: f64) -> AtContact {
    let mu = natural_map::cone_friction(law, friction);
    let mut corrected = law_velocity.to_vec();
    natural_map::correct(law, friction, &mut corrected);
    AtContact {
        primal: second_order::distance(impulse, mu),
        dual: second_order::dual_distance(&corrected, mu),
        complementarity: impulse.iter().zip(&corrected).map(|(r, y)| r * y).sum::<f64>().abs(),
        natural_map: natural_map::natural_map(law, friction, impulse, law_velocity, rho),
        natural_map_unit: natural_map::natural_map(law, friction, impulse, law_velocity, 1.0),
    }
}

fn sizes(problem: &ContactProblem, solution: &Solution) -> Result<()> {
    // in the plane every cone is polyhedral, with the two senses of tangent₁ as directions
    let d = problem.law.directions().unwrap_or(if problem.rows_per_contact == 2 { 2 } else { 0 });
    let given = [
        ("impulse", Some(solution.impulse.len()), problem.rows()),
        ("velocity", Some(solution.velocity.len()), problem.rows()),
        ("beta", solution.beta.as_ref().map(DVector::len), d * problem.contacts()),
        ("sigma", solution.sigma.as_ref().map(DVector::len), problem.contacts()),
    ];
    match given.into_iter().find(|(_, size, needed)| size.is_some_and(|size| size != *needed)) {
        None => Ok(()),
        Some((field, size, needed)) => {
            Err(Error::invalid(field, format!("has size {}", size.unwrap_or(0)), format!("the problem `{}` needs {needed}", problem.name)))
        }
    }
}

/// The larger of two numbers, NaN if one is.
pub(super) fn worst(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
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
    /// Whether every residual is at most `tolerance` times the scale of its unit: impulses ‖r‖, velocities ‖u_free + shift‖,
    /// energies their product, the natural map its own scale. NaN is never a solution, and neither is an answer whose scales or
    /// residuals overflow: infinity is at most infinity, which shows nothing.
    pub fn is_solution(&self, tolerance: f64) -> bool {
        let judged = self.entries().into_iter().filter(|(name, ..)| *name != "siconos");
        judged.map(|(_, value, _)| value).all(f64::is_finite)
            && self.primal <= tolerance * self.impulse_scale
            && self.dual <= tolerance * self.velocity_scale
            && self.complementarity <= tolerance * self.impulse_scale * self.velocity_scale
            && self.natural_map <= tolerance * self.natural_map_scale
            && self.velocity <= tolerance * self.velocity_scale
    }

    /// Name, value and unit of every residual and scale, in the order of the fields.
    pub fn entries(&self) -> [(&'static str, f64, &'static str); 9] {
        [
            ("primal", self.primal, "N·s"),
            ("dual", self.dual, "m/s"),
            ("complementarity", self.complementarity, "J"),
            ("natural_map", self.natural_map, "N·s"),
            ("velocity", self.velocity, "m/s"),
            ("siconos", self.siconos, "1"),
            ("impulse_scale", self.impulse_scale, "N·s"),
            ("velocity_scale", self.velocity_scale, "m/s"),
            ("natural_map_scale", self.natural_map_scale, "N·s"),
        ]
    }
}

/// As a map of `{"value": …, "unit": …}`.
impl Serialize for Residuals {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Quantity {
            value: f64,
            unit: &'static str,
        }
        let mut map = serializer.serialize_map(Some(9))?;
        for (name, value, unit) in self.entries() {
            map.serialize_entry(name, &Quantity { value, unit })?;
        }
        map.end()
    }
}

#[cfg(test)]
#[path = "residuals_tests.rs"]
mod tests;
