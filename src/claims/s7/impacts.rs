//! The impacts on which the claims of this section are decided, in exact rationals.

use crate::Result;
use crate::impact_laws::poisson;
use crate::impact_laws::routh::Path;
use crate::problem::{PlanarProblem, Response};
use crate::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// An impact law of frictionless contacts, each with its own e.
pub type ContactsLaw = fn(&PlanarProblem<Rational>, &[Rational]) -> Result<Response<Rational>>;

/// An impact law of one planar contact with friction, along Routh's path.
pub type PathLaw = fn(&Path<Rational>, &Rational) -> Result<Response<Rational>>;

/// The end of Poisson's two phases.
pub fn two_phases(impact: &PlanarProblem<Rational>, restitution: &[Rational]) -> Result<Response<Rational>> {
    poisson::two_problems(impact, restitution).map(|phases| phases.end)
}

/// The impact with this W, row by row, and U⁻.
pub fn impact<const N: usize>(delassus: &[i64], before: [Rational; N]) -> PlanarProblem<Rational> {
    let entries: Vec<_> = delassus.iter().map(|&x| ratio(x, 1)).collect();
    PlanarProblem::new(DMatrix::from_row_slice(N, N, &entries), DVector::from_row_slice(&before))
}

/// Two frictionless contacts that drive each other down: a uniform rod of 2 kg above supports at its ends, W = (2, −1; −1, 2).
pub fn ends(before: [Rational; 2]) -> PlanarProblem<Rational> {
    impact(&[2, -1, -1, 2], before)
}

/// Two frictionless contacts that lift each other: supports near the middle, W = (2, 1; 1, 2).
pub fn middle(before: [Rational; 2]) -> PlanarProblem<Rational> {
    impact(&[2, 1, 1, 2], before)
}

/// Three equal balls of 1 kg, the first at 1 m/s: W = (2, −1; −1, 2), U⁻ = (−1, 0).
pub fn cradle() -> PlanarProblem<Rational> {
    ends([ratio(-1, 1), ratio(0, 1)])
}

/// A uniform rod (1 kg, 2 m) at 45° that hits with its end: W = (5, −3; −3, 5)/2, U⁻ = (−1, 3/5), T⁻ = 1/5 J.
pub fn rod() -> PlanarProblem<Rational> {
    let mut rod = impact(&[5, -3, -3, 5], [ratio(-1, 1), ratio(3, 5)]);
    rod.delassus *= ratio(1, 2);
    rod
}

/// The rod sliding the other way, which its coupling drives on: W_nt > 0.
pub fn pushed_rod() -> PlanarProblem<Rational> {
    let mut rod = impact(&[5, 3, 3, 5], [ratio(-1, 1), ratio(3, 5)]);
    rod.delassus *= ratio(1, 2);
    rod
}

/// Routh's path of the rod.
pub fn rod_path(friction: &Rational) -> Result<Path<Rational>> {
    Path::new(rod(), friction)
}

/// The same impact in floating point.
pub fn rounded(impact: &PlanarProblem<Rational>) -> PlanarProblem<f64> {
    PlanarProblem::new(impact.delassus.map(|x| x.to_f64().value()), impact.velocity.map(|x| x.to_f64().value()))
}

/// ΔT of an outcome on a path \[J\].
pub fn gain(path: &Path<Rational>, outcome: Result<Response<Rational>>) -> Result<Rational> {
    Ok(path.impact().energy_change(&outcome?))
}

/// Frictionless impacts of two coupled contacts, W positive definite, among whose velocities each sign occurs.
pub fn frictionless_grid(approaching_only: bool) -> Vec<PlanarProblem<Rational>> {
    let delassus = [[2, -1, -1, 2], [2, 1, 1, 2], [1, 3, 3, 10], [5, -2, -2, 1], [3, 0, 0, 2]];
    let before = [[-4, -4], [-4, -1], [-1, -4], [-4, 0], [-2, 1], [1, -4], [-3, 5]];
    let chosen = before.iter().filter(|velocities| !approaching_only || velocities.iter().all(|&u| u <= 0));
    chosen.flat_map(|&[a, b]| delassus.iter().map(move |w| impact(w, [ratio(a, 2), ratio(b, 2)]))).collect()
}

/// Planar impacts with friction: W, U⁻ and μ on a grid with slips that go on, stop for good and turn round.
pub fn rough_grid() -> Result<Vec<(Path<Rational>, Rational)>> {
    let mut paths = Vec::new();
    for w in [[2, 0, 0, 3], [5, -3, -3, 5], [5, 3, 3, 5], [2, 4, 4, 9], [2, -4, -4, 9], [9, 4, 4, 2]] {
        for velocity in [[-1, 1], [-1, -1], [-5, 3], [-1, 20], [-20, -1]] {
            for mu in [1, 2, 3, 7, 20] {
                let friction = ratio(mu, 4);
                let subject = impact(&w, velocity.map(|u| ratio(u, 1)));
                paths.push((Path::new(subject, &friction)?, friction));
            }
        }
    }
    Ok(paths)
}
