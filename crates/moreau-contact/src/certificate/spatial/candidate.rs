//! A candidate for the solution of a piece, by Newton's method on the directions of slip. It proves nothing.
//!
//! ```text
//!     d_k⊥·y_t = 0  at every sliding contact ,      the other unknowns by the linear equations of the piece
//! ```

use super::arc::{Direction, dot};
use super::bounds::{Slip, differences, pressing, velocity};
use super::piece::{Data, Doing, Rows, turned};
use crate::certificate::interval::Interval;
use crate::problem::Solution;
use crate::tolerance::proof::{CORRECTIONS, SMALLEST_BOX, UNDETERMINED};
use nalgebra::{DMatrix, DVector};

/// Impulses that may solve the problem, and the directions of slip.
pub(super) struct Candidate {
    pub answer: Solution,
    pub directions: Vec<[f64; 2]>,
}

/// The candidate that is met from the middle of a piece; none where an equation is singular or a sign is wrong.
pub(super) fn candidate(data: &Data, rows: &Rows, piece: &[Doing]) -> Option<Candidate> {
    let middle = |d: Direction| [d[0].middle(), d[1].middle()];
    let mut directions: Vec<[f64; 2]> = piece.iter().filter_map(|doing| doing.arc()).map(|arc| middle(arc.middle())).collect();
    let (free, sliding) = (rows.free.len(), rows.sliding.len());
    for _ in (0..2 * CORRECTIONS).filter(|_| sliding > 0) {
        let (unknown, slips) = linear(data, rows, &directions)?;
        let mut right = DVector::zeros(free + 2 * sliding);
        for (place, slip) in slips.iter().enumerate() {
            right[free + sliding + place] =
                -dot(turned(slip.direction), at(data, rows, &directions, &unknown, rows.sliding[place])).middle();
        }
        let turns = solved(&differences(data, rows, &slips), &right)?.rows(free + sliding, sliding).into_owned();
        for (direction, turn) in directions.iter_mut().zip(turns.iter()) {
            let (sin, cos) = turn.clamp(-1.0, 1.0).sin_cos();
            *direction = [cos * direction[0] - sin * direction[1], sin * direction[0] + cos * direction[1]];
        }
        if turns.amax() <= SMALLEST_BOX {
            break;
        }
    }
    let (unknown, slips) = linear(data, rows, &directions)?;
    if slips.iter().any(|slip| slip.pressed.low <= 0.0 || slip.speed.low <= 0.0) {
        return None;
    }
    let mut impulse = DVector::zeros(data.free.len());
    for (place, (k, d)) in rows.sliding.iter().zip(&directions).enumerate() {
        let (p, mu) = (unknown[free + place].middle(), data.friction(*k));
        (impulse[3 * k], impulse[3 * k + 1], impulse[3 * k + 2]) = (p, -mu * p * d[0], -mu * p * d[1]);
    }
    if rows.is_all {
        rows.free.iter().zip(&unknown).for_each(|(row, r)| impulse[*row] = r.middle());
    } else {
        spread(data, piece, &mut impulse)?;
    }
    let velocity = data.problem.velocity(&impulse);
    Some(Candidate { answer: Solution::new("enumeration", impulse, velocity, 0), directions })
}

fn at(data: &Data, rows: &Rows, directions: &[[f64; 2]], unknown: &[Interval], k: usize) -> Direction {
    let directions: Vec<Direction> = directions.iter().map(|d| d.map(Interval::point)).collect();
    [1, 2].map(|i| velocity(data, rows, &directions, unknown, 3 * k + i))
}

/// The unknowns of the linear equations for these directions, and what the contacts slide with.
fn linear(data: &Data, rows: &Rows, directions: &[[f64; 2]]) -> Option<(Vec<Interval>, Vec<Slip>)> {
    let points: Vec<Direction> = directions.iter().map(|d| d.map(Interval::point)).collect();
    let right = DVector::from_iterator(rows.equations().len(), rows.equations().iter().map(|row| -data.free[*row].middle()));
    let unknown: Vec<Interval> = solved(&pressing(data, rows, &points), &right)?.iter().map(|x| Interval::point(*x)).collect();
    let slip = |place: usize| {
        let [pressed, speed] =
            [unknown[rows.free.len() + place], dot(points[place], at(data, rows, directions, &unknown, rows.sliding[place]))];
        Slip { direction: points[place], cosine: Interval::ONE, pressed, speed: Interval::point(speed.middle()) }
    };
    let slips = (0..points.len()).map(slip).collect();
    Some((unknown, slips))
}

fn solved(matrix: &DMatrix<Interval>, right: &DVector<f64>) -> Option<DVector<f64>> {
    if right.is_empty() {
        return Some(DVector::zeros(0));
    }
    let solved = matrix.map(|entry| entry.middle()).lu().solve(right)?;
    solved.iter().all(|x| x.is_finite()).then_some(solved)
}

/// The least impulses of contacts that stick or press where others do as well.
fn spread(data: &Data, piece: &[Doing], impulse: &mut DVector<f64>) -> Option<()> {
    let own = |k: usize| if piece[k].arc().is_some() { 0 } else { piece[k].held() };
    let rows: Vec<usize> = (0..piece.len()).flat_map(|k| 3 * k..3 * k + own(k)).collect();
    let y = data.problem.law_velocity(impulse);
    let matrix = DMatrix::from_fn(rows.len(), rows.len(), |i, j| data.problem.entry(rows[i], rows[j]));
    let right = DVector::from_iterator(rows.len(), rows.iter().map(|row| -y[*row]));
    let size = matrix.amax();
    let found = matrix.svd(true, true).solve(&right, UNDETERMINED * size).ok()?;
    rows.iter().zip(found.iter()).for_each(|(row, r)| impulse[*row] = *r);
    Some(())
}
