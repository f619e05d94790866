//! Polyhedral laws as complementary pairs 0 ≤ z ⟂ w ≥ 0 per contact.
//!
//! Stewart–Trinkle, λ = r_n, r_t = Σ Dⱼβⱼ:
//! ```text
//!     0 ≤ λ ⟂ y_n ≥ 0 ,    0 ≤ βⱼ ⟂ Dⱼ·y_t + σ ≥ 0 ,    0 ≤ μλ − Σβⱼ ⟂ σ ≥ 0 .
//! ```
//! Polyhedral associated, r = Σ fⱼ (n + μDⱼ): `0 ≤ fⱼ ⟂ y_n + μ Dⱼ·y_t + Rⱼ fⱼ ≥ 0`.
//!
//! Where a solution does not give β, f or σ they are recovered. σ = max_j(−Dⱼ·y_t)₊ is the smallest that makes every Dⱼ·y_t + σ ≥ 0. β is
//! the decomposition of r_t along the two directions beside it, the one with the smallest Σβⱼ: when σ > 0 only the
//! directions with Dⱼ·y_t + σ = 0 may carry β, and r_t on the boundary of the polygon has no other decomposition; when σ = 0 and
//! r_t is inside, y_t = 0 and every decomposition does.

use super::residuals::{AtContact, worst};
use crate::cones::polyhedral::{direction, neighbours};
use crate::problem::{Compliance, ContactProblem, Coordinates, Solution};
use crate::{Error, Result};

/// One complementary pair; z is an impulse \[N·s\] and w a velocity \[m/s\].
struct Pair {
    z: f64,
    w: f64,
}

pub(super) fn stewart_trinkle(
    problem: &ContactProblem,
    solution: &Solution,
    d: usize,
    contact: usize,
    r: &[f64],
    y: &[f64],
    rho: f64,
) -> AtContact {
    let part = |vector: &nalgebra::DVector<f64>| vector.as_slice()[contact * d..(contact + 1) * d].to_vec();
    let beta = solution.beta.as_ref().map_or_else(|| along_neighbours(tangent(r), d), part);
    let against: Vec<f64> = (0..d).map(|j| dot(direction(j, d), tangent(y))).collect();
    let slip = || against.iter().fold(0.0, |slip, velocity| worst(slip, -velocity));
    let sigma = solution.sigma.as_ref().map_or_else(slip, |sigma| sigma[contact]);
    let mut pairs = vec![Pair { z: r[0], w: y[0] }];
    pairs.extend(beta.iter().zip(&against).map(|(&z, velocity)| Pair { z, w: velocity + sigma }));
    pairs.push(Pair { z: problem.friction[contact] * r[0] - beta.iter().sum::<f64>(), w: sigma });
    judge(&pairs, mismatch(tangent(r), &beta, 1.0), rho)
}

/// The natural map of Stewart–Trinkle's law at one contact with three rows and d ≥ 3, β and σ recovered from r and y as above.
pub(super) fn natural_map(friction: f64, r: &[f64], y: &[f64], rho: f64, d: usize) -> f64 {
    let against = |j: usize| dot(direction(j, d), tangent(y));
    let sigma = (0..d).fold(0.0, |slip, j| worst(slip, -against(j)));
    let (j, beta) = neighbours(tangent(r), d);
    let friction_left = smaller(friction * r[0] - beta[0] - beta[1], rho * sigma);
    let along = |j: usize, beta: f64| smaller(beta, rho * (against(j) + sigma));
    let parts = [smaller(r[0], rho * y[0]), friction_left, along(j, beta[0]), along((j + 1) % d, beta[1])];
    parts.iter().map(|part| part * part).sum::<f64>().sqrt()
}

pub(super) fn edges(
    problem: &ContactProblem,
    solution: &Solution,
    d: usize,
    contact: usize,
    r: &[f64],
    y: &[f64],
    rho: f64,
) -> Result<AtContact> {
    let mu = problem.friction[contact];
    let softness = match &problem.compliance {
        Some(Compliance { coordinates: Coordinates::Edge, diagonal }) => Some(&diagonal.as_slice()[contact * d..(contact + 1) * d]),
        _ => None,
    };
    let edge_impulse = match &solution.beta {
        Some(beta) => beta.as_slice()[contact * d..(contact + 1) * d].to_vec(),
        None if softness.is_some() && d > 2 => {
            return Err(Error::invalid(
                "beta",
                "is missing",
                "an edge compliance judges the edge impulses, and they do not follow from `impulse`",
            ));
        }
        None => along_edges(r, mu, d),
    };
    let pairs: Vec<Pair> = edge_impulse
        .iter()
        .enumerate()
        .map(|(j, &z)| Pair { z, w: y[0] + mu * dot(direction(j, d), tangent(y)) + softness.map_or(0.0, |softness| softness[j] * z) })
        .collect();
    let normal = (r[0] - edge_impulse.iter().sum::<f64>()).abs();
    Ok(judge(&pairs, worst(normal, mismatch(tangent(r), &edge_impulse, mu)), rho))
}

/// The residuals of pairs; `mismatch` is how far the impulses are from what their parts add up to.
fn judge(pairs: &[Pair], mismatch: f64, rho: f64) -> AtContact {
    let mut at = AtContact { primal: mismatch, ..AtContact::default() };
    for Pair { z, w } in pairs {
        at.primal = worst(at.primal, -z);
        at.dual = worst(at.dual, -w);
        at.complementarity = worst(at.complementarity, (z * w).abs());
        at.natural_map += smaller(*z, rho * w).powi(2);
        at.natural_map_unit += smaller(*z, *w).powi(2);
    }
    at.natural_map = (at.natural_map + mismatch.powi(2)).sqrt();
    at.natural_map_unit = (at.natural_map_unit + mismatch.powi(2)).sqrt();
    at
}

/// z − (z − w)₊ = min(z, w), NaN if one is.
fn smaller(z: f64, w: f64) -> f64 {
    -worst(-z, -w)
}

/// ‖r_t − scale Σ Dⱼβⱼ‖.
fn mismatch(r: [f64; 2], beta: &[f64], scale: f64) -> f64 {
    let d = beta.len();
    let sum = beta.iter().enumerate().fold([0.0, 0.0], |sum, (j, b)| {
        let [first, second] = direction(j, d);
        [sum[0] + first * b, sum[1] + second * b]
    });
    (r[0] - scale * sum[0]).hypot(r[1] - scale * sum[1])
}

/// β ≥ 0 with Σ Dⱼβⱼ = r_t and the smallest sum: along the two directions beside r_t.
pub(super) fn along_neighbours(r: [f64; 2], d: usize) -> Vec<f64> {
    let mut beta = vec![0.0; d];
    if d == 2 {
        beta[usize::from(r[0] < 0.0)] = r[0].abs();
        return beta;
    }
    let (j, parts) = neighbours(r, d);
    beta[j] = parts[0];
    beta[(j + 1) % d] = parts[1];
    beta
}

/// f with Σ fⱼ(n + μDⱼ) = r: the neighbours carry r_t/μ, and what is left of r_n is spread evenly, which adds no tangential impulse.
fn along_edges(r: &[f64], mu: f64, d: usize) -> Vec<f64> {
    let [first, second] = tangent(r);
    let mut f = if mu > 0.0 { along_neighbours([first / mu, second / mu], d) } else { vec![0.0; d] };
    let rest = (r[0] - f.iter().sum::<f64>()) / d as f64;
    f.iter_mut().for_each(|edge| *edge += rest);
    f
}

fn tangent(z: &[f64]) -> [f64; 2] {
    [z.get(1).copied().unwrap_or(0.0), z.get(2).copied().unwrap_or(0.0)]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
