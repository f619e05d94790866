//! What the linear equations of a piece say of its solutions, and that it has one velocity at most.
//!
//! ```text
//!     (1)   y = 0 at the rows that stick or press ,  y_n = 0 where it slides :      linear in their impulses and in p where it slides
//!     (2)   two solutions:  e_n = Δp ,  e_t = −μ (c Δp d + p̄ σ d⊥) ,  f_t = c Δs d + s̄ σ d⊥ ,  f = W e
//! ```
//! In (2) p̄ and s̄ are means, d the direction of the mean of both slips, which is in the arc, c the cosine and σ twice the sine of half
//! of the angle between them. Both are exact, for d is orthogonal to the difference of two unit vectors. If the linear system f = 0,
//! f_n = 0, d⊥·f_t = s̄ σ for the impulses, Δp and σ is regular for all d, c, p̄, s̄ of the piece, both velocities are the same.

use super::arc::{Direction, cross, dot};
use super::piece::{Data, Doing, Rows, opposite, scaled, turned};
use super::system::Regular;
use crate::certificate::interval::Interval;
use nalgebra::DMatrix;

/// The impulses and velocities of all solutions of a piece.
pub(super) struct Bounds {
    /// The independent impulses, and p of the sliding contacts.
    pub unknown: Vec<Interval>,
    /// y of all rows.
    pub velocity: Vec<Interval>,
}

/// The matrix of (1).
pub(super) fn pressing(data: &Data, rows: &Rows, directions: &[Direction]) -> DMatrix<Interval> {
    let (equations, free) = (rows.equations(), rows.free.len());
    DMatrix::from_fn(equations.len(), equations.len(), |i, j| match j.checked_sub(free) {
        None => data.w[(equations[i], rows.free[j])],
        Some(place) => unit(data, equations[i], rows.sliding[place], directions[place]),
    })
}

/// What one unit of p makes of y in one row.
fn unit(data: &Data, row: usize, k: usize, direction: Direction) -> Interval {
    let friction = Interval::point(data.friction(k));
    data.moved(row, k, Interval::ONE, opposite(scaled(friction, direction)))
}

/// y in one row, for these unknowns.
pub(super) fn velocity(data: &Data, rows: &Rows, directions: &[Direction], unknown: &[Interval], row: usize) -> Interval {
    let (own, sliding) = unknown.split_at(rows.free.len());
    let sum = rows.free.iter().zip(own).fold(data.free[row], |sum, (free, r)| sum + data.w[(row, *free)] * *r);
    let each = rows.sliding.iter().zip(directions).zip(sliding);
    each.fold(sum, |sum, ((k, d), p)| sum + unit(data, row, *k, *d) * *p)
}

/// Bounds of all solutions of a piece; none if its linear equations are not seen to be regular.
pub(super) fn bounds(data: &Data, rows: &Rows, piece: &[Doing]) -> Option<Bounds> {
    let directions: Vec<Direction> = piece.iter().filter_map(|doing| doing.arc()).map(|arc| arc.all()).collect();
    let matrix = pressing(data, rows, &directions);
    let right: Vec<Interval> = rows.equations().iter().map(|row| -data.free[*row]).collect();
    let unknown = Regular::new(&matrix)?.solutions(&right);
    let at = |row: usize| match row % 3 < piece[row / 3].held() {
        true => Interval::ZERO,
        false => velocity(data, rows, &directions, &unknown, row),
    };
    let velocity = (0..data.free.len()).map(at).collect();
    Some(Bounds { unknown, velocity })
}

/// Whether these bounds contradict an inequality of the law.
pub(super) fn refuted(data: &Data, rows: &Rows, piece: &[Doing], bounds: &Bounds) -> bool {
    let impulse = |row: usize| rows.free.iter().position(|free| *free == row).map(|place| bounds.unknown[place]);
    (0..piece.len()).any(|k| {
        let y = &bounds.velocity[3 * k..3 * k + 3];
        match piece[k] {
            Doing::Open => y[0].high < 0.0,
            Doing::Pressing | Doing::Sticking if !rows.is_all => false,
            Doing::Pressing => impulse(3 * k).is_some_and(|p| p.high < 0.0),
            Doing::Sticking => {
                let r: Vec<Interval> = (3 * k..3 * k + 3).filter_map(impulse).collect();
                let room = Interval::point(data.friction(k)).square() * r[0].square() - r[1].square() - r[2].square();
                r[0].high < 0.0 || room.high < 0.0
            }
            Doing::Sliding(arc) => {
                let place = rows.free.len() + rows.sliding.iter().position(|sliding| *sliding == k).expect("it slides");
                let (slip, [one, other]) = ([y[1], y[2]], arc.ends());
                let beside = cross(one, slip).high < 0.0 || cross(slip, other).high < 0.0;
                bounds.unknown[place].high < 0.0 || dot(slip, arc.all()).high < 0.0 || beside
            }
        }
    })
}

/// One sliding contact in (2).
pub(super) struct Slip {
    pub direction: Direction,
    pub cosine: Interval,
    /// p̄ ≥ 0.
    pub pressed: Interval,
    /// s̄ ≥ 0.
    pub speed: Interval,
}

/// The matrix of (2).
pub(super) fn differences(data: &Data, rows: &Rows, slips: &[Slip]) -> DMatrix<Interval> {
    let (equations, free, sliding) = (rows.equations(), rows.free.len(), rows.sliding.len());
    let size = equations.len() + sliding;
    let pushed = |row: usize, j: usize| -> Interval {
        if j < free {
            return data.w[(row, rows.free[j])];
        }
        let (place, turns) = ((j - free) % sliding, j >= free + sliding);
        let (slip, k) = (&slips[place], rows.sliding[place]);
        let friction = Interval::point(data.friction(k));
        match turns {
            true => data.moved(row, k, Interval::ZERO, opposite(scaled(friction * slip.pressed, turned(slip.direction)))),
            false => data.moved(row, k, Interval::ONE, opposite(scaled(friction * slip.cosine, slip.direction))),
        }
    };
    DMatrix::from_fn(size, size, |i, j| match i.checked_sub(equations.len()) {
        None => pushed(equations[i], j),
        Some(place) => {
            let (k, across) = (rows.sliding[place], turned(slips[place].direction));
            let turn = if j == free + sliding + place { slips[place].speed } else { Interval::ZERO };
            dot(across, [pushed(3 * k + 1, j), pushed(3 * k + 2, j)]) - turn
        }
    })
}

/// Whether all solutions of a piece with these bounds have the same velocity.
pub(super) fn has_one_velocity(data: &Data, rows: &Rows, piece: &[Doing], bounds: &Bounds) -> bool {
    let slip = |place: usize| {
        let k = rows.sliding[place];
        let arc = piece[k].arc()?;
        let slip = [bounds.velocity[3 * k + 1], bounds.velocity[3 * k + 2]];
        let (pressed, speed) = (bounds.unknown[rows.free.len() + place].positive_part(), dot(slip, arc.all()).positive_part());
        Some(Slip { direction: arc.all(), cosine: arc.cosine(), pressed, speed })
    };
    let Some(slips) = (0..rows.sliding.len()).map(slip).collect::<Option<Vec<_>>>() else { return false };
    Regular::new(&differences(data, rows, &slips)).is_some()
}
