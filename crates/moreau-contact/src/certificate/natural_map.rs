//! The natural map of one contact, r − P_K(r − ρ ŷ), with ŷ = y + μ‖y_t‖n for Coulomb's law and ŷ = y otherwise.
//!
//! It vanishes exactly at solutions, for every ρ > 0 \[kg\]. With ρ = 3/tr(W_kk + R_kk), or the number of rows instead of 3,
//! it is an impulse: a change of units scales it as it scales r, and a rotation of the tangents leaves its norm alone.

use crate::cones::{de_saxce, second_order};
use crate::problem::{ContactProblem, Law};
use moreau_exact::number::larger;
use nalgebra::DVector;

/// Replaces y by ŷ: y + μ‖y_t‖n for Coulomb's law, y for the others.
pub fn correct(law: Law, friction: f64, y: &mut [f64]) {
    if law == Law::Coulomb {
        de_saxce::correct(y, friction);
    }
}

/// ‖r − P_K(r − ρ ŷ)‖ \[N·s\] of one contact with impulse r \[N·s\] and law velocity y \[m/s\], both (n, t₁, t₂) as long as the contact has
/// rows; the law is frictionless, Coulomb or associated.
pub fn natural_map(law: Law, friction: f64, impulse: &[f64], law_velocity: &[f64], rho: f64) -> f64 {
    let rows = impulse.len();
    let mut corrected = [0.0; 3];
    corrected[..rows].copy_from_slice(law_velocity);
    correct(law, friction, &mut corrected[..rows]);
    let mut projected = [0.0; 3];
    for k in 0..rows {
        projected[k] = impulse[k] - rho * corrected[k];
    }
    second_order::project(&mut projected[..rows], law.cone_friction(friction));
    (0..rows).map(|k| (impulse[k] - projected[k]).powi(2)).sum::<f64>().sqrt()
}

/// ‖r − P_K(r − ŷ)‖ over all contacts with ρ = 1 kg, by the three sizes that collections of problems divide it by; all of them mix units
/// and change with the units of the problem. Shown for comparison; none decides.
///
/// # Source
/// Siconos, `fc3d_compute_error`; FCLIB, `MERIT_1` of `fclib_merit_local`, which has no other term without bilateral rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneKilogram {
    /// ‖r − P_K(r − ŷ)‖ itself.
    pub map: f64,
    /// Over ‖q‖, q = u_free + shift; none where q is zero.
    pub over_data: Option<f64>,
    /// Over max(‖q‖, ‖r‖, ‖u‖): Siconos's number; the map itself where all are zero.
    pub siconos: f64,
    /// Over 1 + √‖q‖: FCLIB's.
    pub fclib: f64,
}

impl OneKilogram {
    /// The three numbers from ‖r − P_K(r − ŷ)‖ and the sizes ‖q‖, ‖r‖, ‖u‖. NaN in any of them shows in the numbers that use it.
    pub fn new(map: f64, [data, impulse, velocity]: [f64; 3]) -> Self {
        let largest = larger(data, larger(impulse, velocity));
        OneKilogram {
            map,
            over_data: (data != 0.0).then(|| map / data),
            siconos: if largest == 0.0 { map } else { map / largest },
            fclib: map / (1.0 + data.sqrt()),
        }
    }

    /// The numbers of impulses that answer a problem; none for polyhedral laws, which their pairs judge.
    pub fn of(problem: &ContactProblem, impulse: &DVector<f64>) -> Option<Self> {
        if problem.law().directions().is_some() {
            return None;
        }
        let (rows, velocity) = (problem.rows_per_contact(), problem.law_velocity(impulse));
        let contacts = impulse.as_slice().chunks_exact(rows).zip(velocity.as_slice().chunks_exact(rows)).zip(problem.friction());
        let squares: f64 = contacts.map(|((r, y), mu)| natural_map(problem.law(), *mu, r, y, 1.0).powi(2)).sum();
        let data = (problem.free_velocity() + problem.shift()).norm();
        Some(Self::new(squares.sqrt(), [data, impulse.norm(), problem.velocity(impulse).norm()]))
    }
}

/// ‖r − P_K(r − ŷ)‖/‖q‖ over all contacts, with ρ = 1 kg: the number that other collections compare. It changes with the units of the
/// problem. None for polyhedral laws and where q is zero.
pub fn of_unit_mass(problem: &ContactProblem, impulse: &DVector<f64>) -> Option<f64> {
    OneKilogram::of(problem, impulse)?.over_data
}

/// ρ \[kg\] of every contact: rows/tr(W_kk + R_kk). A contact whose block has no positive trace takes the mean of the others, and 1 kg
/// if there is none: the zeros of the natural map do not depend on it.
pub fn scales(problem: &ContactProblem) -> Vec<f64> {
    let rows = problem.rows_per_contact();
    let trace =
        |contact: usize| -> f64 { (contact * rows..(contact + 1) * rows).map(|k| problem.entry(k, k) + problem.row_compliance(k)).sum() };
    let traces: Vec<f64> = (0..problem.contacts()).map(trace).collect();
    let positive: Vec<f64> = traces.iter().copied().filter(|&t| t > 0.0).collect();
    let fallback = if positive.is_empty() { rows as f64 } else { positive.iter().sum::<f64>() / positive.len() as f64 };
    traces.into_iter().map(|t| rows as f64 / if t > 0.0 { t } else { fallback }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dvector};

    #[test]
    fn the_three_normalisations_are_those_worked_out_by_hand() {
        // r = (1, −½) N·s and y = (0, 3/2) m/s solve it; half a newton second too much leaves y = (½, 3/2), ŷ = (5/4, 3/2),
        // r − ŷ = (¼, −2) and its projection on the cone of μ = ½: ((¼ + ½·2)/(1 + ¼))(1, −½) = (1, −½)
        let problem = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build();
        let problem = problem.unwrap();
        let found = OneKilogram::of(&problem, &dvector![1.5, -0.5]).unwrap();
        let q = 5.0_f64.sqrt();
        assert_eq!(found.map, 0.5);
        assert_eq!(found.over_data, Some(0.5 / q));
        assert_eq!(found.siconos, 0.5 / q, "‖q‖ is larger than ‖r‖ = ‖u‖ = √2.5");
        assert_eq!(found.fclib, 0.5 / (1.0 + q.sqrt()));
        assert_eq!(of_unit_mass(&problem, &dvector![1.5, -0.5]), found.over_data);
        let large = OneKilogram::new(0.5, [1.0, 4.0, 2.0]);
        assert_eq!((large.siconos, large.fclib), (0.125, 0.25));
        let nothing = OneKilogram::new(0.0, [0.0; 3]);
        assert_eq!((nothing.over_data, nothing.siconos, nothing.fclib), (None, 0.0, 0.0));
        assert!(OneKilogram::new(1.0, [f64::NAN, 1.0, 1.0]).siconos.is_nan());
    }
}
