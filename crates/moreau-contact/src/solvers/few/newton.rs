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
//! where several impulses give one velocity, as in [`nonsmooth_newton`](super::super::nonsmooth_newton).

use super::friction::Contacts;
use crate::operator::Operator;
use crate::problem::ContactProblem;

/// What a step starts from.
pub(super) struct Step<const D: usize> {
    /// The contacts that press, growing, and how many.
    pub pressing: [usize; super::MOST],
    pub count: usize,
    /// max |F| of the rows, in impulses \[N·s\].
    pub residual: f64,
}

/// One step with η from the impulses and y of `contacts`, of up to M rows that press; `None` where the system is singular.
pub(super) fn step<const D: usize, const M: usize>(
    problem: &ContactProblem,
    contacts: &Contacts<D>,
    step: &Step<D>,
    proximal: f64,
) -> Option<[f64; M]> {
    let pressing = &step.pressing[..step.count];
    let (mut matrix, mut x) = ([[0.0; M]; M], [0.0; M]);
    gather::<D, M>(problem, pressing, &mut matrix);
    for (place, &k) in pressing.iter().enumerate() {
        let first = place * D;
        contacts.linearise(k, proximal, &mut matrix[first..first + D], &mut x[first..first + D], first);
    }
    eliminate(&mut matrix, &mut x, step.count * D)?;
    Some(x)
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

/// Columns that the processor takes at once; M is a multiple of it.
const GROUP: usize = 4;

/// Replaces b by the x with A x = b, of the first `size` rows and columns; `None` if a pivot is zero or no number. Rows are exchanged, and
/// zeros passed over. A group of columns is taken whole: what stands left of the pivot in it is not read any more.
pub(super) fn eliminate<const M: usize>(matrix: &mut [[f64; M]; M], x: &mut [f64; M], size: usize) -> Option<()> {
    for k in 0..size {
        let larger = |best: usize, row: usize| if matrix[row][k].abs() > matrix[best][k].abs() { row } else { best };
        let pivot = (k + 1..size).fold(k, larger);
        if pivot != k {
            matrix.swap(k, pivot);
            x.swap(k, pivot);
        }
        let (above, below) = matrix.split_at_mut(k + 1);
        let row = &above[k];
        if !(row[k] != 0.0 && row[k].is_finite()) {
            return None;
        }
        let (inverse, top, groups) = (1.0 / row[k], x[k], (k + 1) / GROUP..size.div_ceil(GROUP));
        let row = row.as_chunks::<GROUP>().0.get(groups.clone()).unwrap_or_default();
        for (other, right) in below[..size - k - 1].iter_mut().zip(&mut x[k + 1..size]).filter(|(other, _)| other[k] != 0.0) {
            let factor = other[k] * inverse;
            for (entries, above) in other.as_chunks_mut::<GROUP>().0[groups.clone()].iter_mut().zip(row) {
                (0..GROUP).for_each(|place| entries[place] -= factor * above[place]);
            }
            *right -= factor * top;
        }
    }
    for k in (0..size).rev() {
        let row = &matrix[k];
        let known: f64 = row[k + 1..size].iter().zip(&x[k + 1..size]).map(|(entry, x)| entry * x).sum();
        x[k] = (x[k] - known) / row[k];
    }
    Some(())
}
