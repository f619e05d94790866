//! That a piece has no solution, by a vector that separates what its impulses make from what its velocities may be.
//!
//! ```text
//!     v = WᵀY ,      v·r ≥ 0  for all r of the piece ,      Y·y ≤ 0  for all y of the piece ,      Y·(u_free + shift) > 0
//! ```
//! Such a Y contradicts y = W r + u_free + shift. It is proposed by the nearest point of the cone {y − W r}, with every generator moved a
//! little towards the residual so that the inequalities are strict, and decided in intervals: a sticking contact by v_n ≥ μ‖v_t‖, a
//! sliding one at the corners of its arc. Neither W nor its columns need be regular.

use super::arc::dot;
use super::piece::{Data, Doing};
use crate::certificate::interval::Interval;
use crate::certificate::least::nonnegative;
use crate::tolerance::proof::{FACETS, LEAST_STEPS, MARGIN, SEPARATED};
use nalgebra::{DMatrix, DVector};

/// Whether a separating vector is found and proved.
pub(super) fn separated(data: &Data, piece: &[Doing]) -> bool {
    let rows: Vec<usize> = piece.iter().enumerate().flat_map(|(k, doing)| 3 * k..3 * k + asked(*doing)).collect();
    if rows.is_empty() {
        return false;
    }
    let mut generators: Vec<DVector<f64>> = Vec::new();
    for (k, doing) in piece.iter().enumerate() {
        velocities(*doing).into_iter().for_each(|y| {
            let place = rows.iter().position(|row| *row == 3 * k).expect("every contact is asked for its normal");
            let mut generator = DVector::zeros(rows.len());
            y.iter().enumerate().for_each(|(i, y)| generator[place + i] = *y);
            generators.push(generator);
        });
        for r in impulses(*doing, data.friction(k)) {
            let entry = |row: usize| -(0..3).map(|i| data.problem.entry(row, 3 * k + i) * r[i]).sum::<f64>();
            generators.push(DVector::from_iterator(rows.len(), rows.iter().map(|row| entry(*row))));
        }
    }
    generators.iter_mut().for_each(|generator| {
        generator.try_normalize_mut(f64::MIN_POSITIVE);
    });
    let free = DVector::from_iterator(rows.len(), rows.iter().map(|row| data.free[*row].middle()));
    let columns = |of: &[DVector<f64>]| DMatrix::from_fn(rows.len(), of.len(), |i, j| of[j][i]);
    let (_, residual) = nonnegative(&columns(&generators), &free, LEAST_STEPS);
    if residual.norm().is_nan() || residual.norm() <= SEPARATED * free.norm() {
        return false;
    }
    let towards = residual.normalize() * MARGIN;
    generators.iter_mut().for_each(|generator| *generator += &towards);
    let (_, residual) = nonnegative(&columns(&generators), &free, LEAST_STEPS);
    let mut vector = vec![0.0; data.free.len()];
    rows.iter().zip(residual.iter()).for_each(|(row, part)| vector[*row] = *part);
    proves(data, piece, &vector)
}

/// Whether this vector contradicts every solution in the piece.
pub(super) fn proves(data: &Data, piece: &[Doing], vector: &[f64]) -> bool {
    let y: Vec<Interval> = vector.iter().map(|part| Interval::point(*part)).collect();
    let sum = |terms: &dyn Fn(usize) -> Interval| (0..y.len()).fold(Interval::ZERO, |sum, row| sum + y[row] * terms(row));
    let holds = |k: usize| {
        let v: [Interval; 3] = std::array::from_fn(|i| sum(&|row| data.w[(row, 3 * k + i)]));
        let (own, mu) = ([y[3 * k], y[3 * k + 1], y[3 * k + 2]], Interval::point(data.friction(k)));
        let unmoved = own[1] == Interval::ZERO && own[2] == Interval::ZERO;
        match piece[k] {
            Doing::Open => own[0].high <= 0.0 && unmoved,
            Doing::Pressing => v[0].low >= 0.0 && unmoved,
            Doing::Sticking => v[0].low >= 0.0 && (v[0].square() - mu.square() * (v[1].square() + v[2].square())).low >= 0.0,
            Doing::Sliding(arc) => {
                let presses = arc.corners().into_iter().all(|d| (v[0] - mu * dot([v[1], v[2]], d)).low >= 0.0);
                presses && arc.ends().into_iter().all(|d| dot([own[1], own[2]], d).high <= 0.0)
            }
        }
    };
    sum(&|row| data.free[row]).is_positive() && (0..piece.len()).all(holds)
}

/// How many rows of the separating vector may differ from zero: where y is free it must vanish.
fn asked(doing: Doing) -> usize {
    match doing {
        Doing::Open | Doing::Pressing => 1,
        Doing::Sticking | Doing::Sliding(_) => 3,
    }
}

fn velocities(doing: Doing) -> Vec<Vec<f64>> {
    match doing {
        Doing::Open => vec![vec![1.0]],
        Doing::Pressing | Doing::Sticking => Vec::new(),
        Doing::Sliding(arc) => arc.ends().into_iter().map(|d| vec![0.0, d[0].middle(), d[1].middle()]).collect(),
    }
}

/// Generators of a cone around the impulses.
fn impulses(doing: Doing, mu: f64) -> Vec<[f64; 3]> {
    match doing {
        Doing::Open => Vec::new(),
        Doing::Pressing => vec![[1.0, 0.0, 0.0]],
        Doing::Sticking => {
            let part = std::f64::consts::PI / FACETS as f64;
            let around = |j: usize| (2.0 * part * j as f64).sin_cos();
            (0..FACETS).map(around).map(|(sin, cos)| [1.0, mu * cos / part.cos(), mu * sin / part.cos()]).collect()
        }
        Doing::Sliding(arc) => arc.corners().into_iter().map(|d| [1.0, -mu * d[0].middle(), -mu * d[1].middle()]).collect(),
    }
}
