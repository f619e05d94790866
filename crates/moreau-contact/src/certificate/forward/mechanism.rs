//! How far the exact W = H M̂⁻¹ Hᵀ may be from the stored one.
//!
//! ```text
//!     X ≈ M̂⁻¹ ,  R = I − X M̂ ,  α = ‖R‖∞ < 1 :      |M̂⁻¹ − X|_ij ≤ Σ_k |R_ik| · max_k |X_kj| / (1 − α)
//! ```
//! because M̂⁻¹ − X = R M̂⁻¹ and the columns of M̂⁻¹ are at most 1/(1 − α) times as large as those of X. M̂ is taken apart into the groups
//! of velocities that it couples; W then follows in intervals.

use crate::certificate::interval::Interval;
use crate::problem::{ContactProblem, Dynamics};
use crate::tolerance::proof::{enlarged, product};
use nalgebra::{DMatrix, DVector};

/// |H M̂⁻¹ Hᵀ − W| entry by entry, at most; none without M̂ and H, infinite where M̂ is too badly conditioned.
pub(in crate::certificate) fn uncertainty(problem: &ContactProblem) -> Option<DMatrix<f64>> {
    let Dynamics { mass, jacobian } = problem.dynamics()?;
    let mut exact = DMatrix::from_element(problem.rows(), problem.rows(), Interval::ZERO);
    for group in groups(mass) {
        let inverse = enclosed_inverse(&DMatrix::from_fn(group.len(), group.len(), |i, j| mass[(group[i], group[j])]));
        let touching: Vec<usize> = (0..problem.rows()).filter(|row| group.iter().any(|v| jacobian[(*row, *v)] != 0.0)).collect();
        for &column in &touching {
            let moved: Vec<Interval> = (0..group.len()).map(|i| along(&group, jacobian, column, |j| inverse[(i, j)])).collect();
            for &row in &touching {
                exact[(row, column)] = exact[(row, column)] + along(&group, jacobian, row, |j| moved[j]);
            }
        }
    }
    Some(DMatrix::from_fn(problem.rows(), problem.rows(), |i, j| exact[(i, j)].reach(problem.entry(i, j))))
}

/// |M̂⁻¹Hᵀ(r* − r)| of every velocity, for all r* of a box; none without M̂ and H, infinite where M̂ is too badly conditioned.
pub(super) fn moved(problem: &ContactProblem, boxed: &[Interval], impulse: &DVector<f64>) -> Option<Vec<f64>> {
    let Dynamics { mass, jacobian } = problem.dynamics()?;
    let apart: Vec<Interval> = boxed.iter().zip(impulse).map(|(one, other)| *one - Interval::point(*other)).collect();
    let pushed = |v: usize| {
        let column = jacobian.column(v);
        let terms = column.iter().zip(&apart).filter(|(entry, _)| **entry != 0.0);
        terms.fold(Interval::ZERO, |sum, (entry, apart)| sum + Interval::point(*entry) * *apart)
    };
    let mut found = vec![0.0; mass.nrows()];
    for group in groups(mass) {
        let inverse = enclosed_inverse(&DMatrix::from_fn(group.len(), group.len(), |i, j| mass[(group[i], group[j])]));
        let pushed: Vec<Interval> = group.iter().map(|v| pushed(*v)).collect();
        for (i, v) in group.iter().enumerate() {
            found[*v] = pushed.iter().enumerate().fold(Interval::ZERO, |sum, (j, p)| sum + inverse[(i, j)] * *p).magnitude();
        }
    }
    Some(found)
}

/// Σ_j H_row,j x_j over a group.
fn along(group: &[usize], jacobian: &DMatrix<f64>, row: usize, x: impl Fn(usize) -> Interval) -> Interval {
    let terms = group.iter().enumerate().filter(|(_, v)| jacobian[(row, **v)] != 0.0);
    terms.fold(Interval::ZERO, |sum, (j, v)| sum + Interval::point(jacobian[(row, *v)]) * x(j))
}

/// The velocities that M̂ couples, directly or through others.
pub(in crate::certificate) fn groups(mass: &DMatrix<f64>) -> Vec<Vec<usize>> {
    let mut group: Vec<usize> = (0..mass.nrows()).collect();
    for (i, j) in (0..mass.nrows()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        if (mass[(i, j)] != 0.0 || mass[(j, i)] != 0.0) && group[i] != group[j] {
            let [from, to] = [group[i].max(group[j]), group[i].min(group[j])];
            group.iter_mut().filter(|one| **one == from).for_each(|one| *one = to);
        }
    }
    let roots: Vec<usize> = (0..mass.nrows()).filter(|i| group[*i] == *i).collect();
    roots.into_iter().map(|root| (0..mass.nrows()).filter(|i| group[*i] == root).collect()).collect()
}

fn enclosed_inverse(mass: &DMatrix<f64>) -> DMatrix<Interval> {
    let n = mass.nrows();
    if n == 1 {
        return DMatrix::from_element(1, 1, Interval::ONE / Interval::point(mass[(0, 0)]));
    }
    let unknown = DMatrix::from_element(n, n, Interval { low: f64::NEG_INFINITY, high: f64::INFINITY });
    let Some(inverse) = mass.clone().try_inverse() else { return unknown };
    let (found, gamma) = (&inverse * mass, product(n));
    let sizes = mass.map(f64::abs) * DMatrix::from_element(n, 1, 1.0);
    let off: Vec<f64> = (0..n)
        .map(|i| {
            let differences: f64 = (0..n).map(|j| (f64::from(u8::from(i == j)) - found[(i, j)]).abs()).sum();
            let rounded: f64 = (0..n).map(|k| inverse[(i, k)].abs() * enlarged(sizes[k], n)).sum();
            enlarged(differences + gamma * enlarged(rounded, n), n)
        })
        .collect();
    let alpha = off.iter().copied().fold(0.0, f64::max);
    let room = (Interval::ONE - Interval::point(alpha)).low;
    // written so that a NaN is no room
    if !(room > 0.0 && off.iter().all(|off| off.is_finite())) {
        return unknown;
    }
    DMatrix::from_fn(n, n, |i, j| {
        let column = inverse.column(j).amax();
        Interval::ball(inverse[(i, j)], enlarged(off[i] * column / room, 2))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::delassus::delassus;
    use moreau_exact::scalar::{Rational, exact};

    #[test]
    fn the_exact_operator_is_within_the_bound_and_the_bound_is_rounding() {
        let coupled = DMatrix::from_fn(5, 5, |i, j| match (i, j) {
            (i, j) if i == j => 1.1 + i as f64,
            (0, 1) | (1, 0) => 0.3,
            (2, 4) | (4, 2) => -0.7,
            _ => 0.0,
        });
        let jacobian = DMatrix::from_fn(6, 5, |i, j| ((3 * i + 7 * j) % 5) as f64 * 0.1 - 0.2);
        let problem = ContactProblem::from_dynamics(coupled.clone(), jacobian.clone(), &DVector::zeros(5)).friction(vec![0.5; 2]);
        let problem = problem.build().unwrap();
        let bound = uncertainty(&problem).unwrap();
        let w: DMatrix<Rational> = delassus(&coupled.map(exact), &jacobian.map(exact)).unwrap();
        for (place, w) in w.iter().enumerate() {
            let stored = exact(problem.dense()[place]);
            let difference = if *w > stored { w - stored } else { stored - w };
            assert!(difference <= exact(bound[place]), "{place}");
        }
        assert!(bound.amax() <= 1e-14, "{}", bound.amax());
        assert_eq!(groups(&coupled), [vec![0, 1], vec![2, 4], vec![3]]);
    }

    #[test]
    fn bodies_move_as_far_as_fractions_say_and_not_at_all_where_impulses_hold_each_other() {
        let mass = DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 1.0]);
        let jacobian = DMatrix::from_row_slice(3, 2, &[1.0, 0.25, -1.0, -0.25, 0.0, 3.0]);
        let made = ContactProblem::from_dynamics(mass.clone(), jacobian.clone(), &DVector::zeros(2)).rows_per_contact(1);
        let problem = made.friction(vec![0.0; 3]).build().unwrap();
        let (here, there) = (DVector::from_row_slice(&[0.1, 0.2, 0.3]), DVector::from_row_slice(&[1.1, 0.7, 0.25]));
        let boxed: Vec<Interval> = there.iter().map(|r| Interval::point(*r)).collect();
        let found = moved(&problem, &boxed, &here).unwrap();
        let apart: DVector<Rational> = there.map(exact) - here.map(exact);
        let p: DVector<Rational> = jacobian.map(exact).transpose() * apart;
        // M̂⁻¹ of two rows: the determinant is 7/4
        let by = |a: f64, b: f64| (exact(a) * &p[0] + exact(b) * &p[1]) / exact(1.75);
        for (bound, v) in found.iter().zip([by(1.0, -0.5), by(-0.5, 2.0)]) {
            let size = if v < exact(0.0) { -v.clone() } else { v.clone() };
            assert!(size <= exact(*bound) && exact(bound - 1e-14) <= size, "{bound} {v}");
        }
        // the first two rows are opposite: one N·s at both moves nothing
        let held = DVector::from_row_slice(&[1.0, 1.0, 0.0]).map(Interval::point);
        assert_eq!(moved(&problem, held.as_slice(), &DVector::zeros(3)).unwrap(), [0.0, 0.0]);
    }

    #[test]
    fn without_a_mass_there_is_nothing_to_bound_and_a_singular_one_has_no_bound() {
        let problem = ContactProblem::new(DMatrix::identity(3, 3), DVector::zeros(3)).friction(vec![0.5]).build().unwrap();
        assert!(uncertainty(&problem).is_none());
        let near = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, 1.0 + f64::EPSILON]);
        assert!(enclosed_inverse(&near)[(0, 0)].magnitude() > 1e15);
    }
}
