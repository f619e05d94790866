//! Newton's method on Alart and Curnier's equations of a few contacts under Coulomb's law, over the rows of those that press.
//!
//! ```text
//!     a = r_n − ρ_n y_n ,   z = r_t − ρ_t y_t ,   c = μ a/‖z‖ ,   ẑ = z/‖z‖ ,   P = 1 − ẑẑᵀ
//!     a ≤ 0                 d = −r                                                                  opens
//!     a > 0                 ρ_n (A d)_n = −ρ_n y_n                                                  presses
//!     ‖z‖ ≤ μ a             ρ_t (A d)_t = −ρ_t y_t                                                  sticks
//!     ‖z‖ > μ a             (1 − c P) d_t + c ρ_t P (A d)_t − μ ẑ d_n = μ r_n ẑ − r_t               slides
//! ```
//! The last line has (A d)_n = −y_n of the one above in it. η on the diagonal of the rows that ask for a velocity makes the system regular
//! where several impulses give one velocity, as in [`nonsmooth_newton`](super::super::nonsmooth_newton). Where all stick and the pivots
//! show that one impulse gives it, η is taken out of the answer again with the same factors: the step ends there.

use super::contacts::{Contacts, Step};
use super::elimination::{Eliminated, eliminate};
use crate::operator::Operator;
use crate::problem::ContactProblem;
use crate::tolerance::newton::{FEW_CORRECTIONS, REGULAR_PIVOT};

/// One step with η from the impulses and y of `contacts`, of up to M rows that press, on the way to a residual of `stop`; `None` where the
/// system is singular.
pub(super) fn step<const D: usize, const M: usize>(
    problem: &ContactProblem,
    contacts: &Contacts<D>,
    step: &Step,
    [proximal, stop]: [f64; 2],
) -> Option<[f64; M]> {
    let pressing = &step.pressing[..step.count];
    let (mut matrix, mut x) = ([[0.0; M]; M], [0.0; M]);
    gather::<D, M>(problem, pressing, &mut matrix);
    for (place, &k) in pressing.iter().enumerate() {
        let first = place * D;
        contacts.linearise(k, proximal, &mut matrix[first..first + D], &mut x[first..first + D], first);
    }
    let size = step.count * D;
    let found = eliminate(&mut matrix, &mut x, size)?;
    if step.all_stick && found.least >= REGULAR_PIVOT {
        without_proximal(&matrix, &found, &mut x, size, [proximal, stop]);
    }
    Some(x)
}

/// Takes η out of the answer where it is on every row and the system needs none: what is wrong with x is η x, and falls by η/σ each time,
/// until what is left would be below `stop` of x.
fn without_proximal<const M: usize>(
    matrix: &[[f64; M]; M],
    found: &Eliminated<M>,
    x: &mut [f64; M],
    size: usize,
    [proximal, stop]: [f64; 2],
) {
    let largest = |x: &[f64; M]| x[..size].iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let (mut change, mut before) = (*x, largest(x));
    for _ in 0..FEW_CORRECTIONS {
        change[..size].iter_mut().for_each(|change| *change *= proximal);
        found.solve(matrix, &mut change, size);
        x[..size].iter_mut().zip(&change).for_each(|(x, change)| *x += change);
        let changed = largest(&change);
        if changed * changed <= stop * before * largest(x) {
            break;
        }
        before = changed;
    }
}

/// A of these contacts, row by row.
fn gather<const D: usize, const M: usize>(problem: &ContactProblem, members: &[usize], matrix: &mut [[f64; M]; M]) {
    match problem.delassus() {
        Operator::Dense(dense) => {
            let (size, entries) = (dense.nrows(), dense.as_slice());
            for (place, &k) in members.iter().enumerate() {
                for column in 0..D {
                    let whole = &entries[(k * D + column) * size..][..size];
                    for (other, &j) in members.iter().enumerate() {
                        (0..D).for_each(|row| matrix[other * D + row][place * D + column] = whole[j * D + row]);
                    }
                }
            }
        }
        stored => {
            let blocks = stored.blocks().expect("only a W that is stored is taken");
            for (place, &k) in members.iter().enumerate() {
                for (j, block) in blocks.column(k) {
                    let Some(other) = members.iter().position(|member| *member == j) else { continue };
                    (0..D * D).for_each(|at| matrix[other * D + at % D][place * D + at / D] = block[at]);
                }
            }
        }
    }
    for (place, &k) in members.iter().enumerate() {
        (0..D).for_each(|row| matrix[place * D + row][place * D + row] += problem.row_compliance(k * D + row));
    }
}
