//! Whether anything moves on a polyhedron.
//!
//! ```text
//!     P = {x ≥ 0 : A x = b} ∋ v ,      T = {d : A d = 0 ,  d_j ≥ 0 where v_j = 0} ,      span T = {d : A d = 0 ,  d_J = 0}
//!     g·x is the same on P      ⇔      g·d = 0 for every d in T      ⇔      g is in the row space of A and of e_j, j in J
//! ```
//! J are the coordinates that are zero on all of P: of those that are zero at v, what no direction in T raises. Most often g is in the row
//! space of A alone, which elimination decides for all g at once; where it is in neither, one of g and −g has a direction with g·d = 1.

use super::feasibility::nonnegative_solution;
use super::planted::{Plant, planted};
use dashu_ratio::RBig;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// d with `system` d = 0, d_j ≥ 0 where the point has a zero, and g·d = ± 1 for the first gain g that moves; none if none does. What a gain
/// does not name has none.
pub(super) fn moving(
    system: &DMatrix<Rational>,
    point: &DVector<Rational>,
    gains: impl Iterator<Item = Vec<Rational>>,
) -> Option<DVector<Rational>> {
    let size = point.len();
    let mut span = Span::default();
    system.row_iter().for_each(|row| span.add(row.iter().cloned().collect()));
    let whole = |mut gain: Vec<Rational>| {
        gain.resize(size, RBig::ZERO);
        gain
    };
    let left: Vec<Vec<Rational>> = gains.map(whole).filter(|gain| !span.holds(gain)).collect();
    if left.is_empty() {
        return None;
    }
    for j in vanishing(system, point) {
        span.add((0..size).map(|i| ratio(i64::from(i == j), 1)).collect());
    }
    let gain = left.into_iter().find(|gain| !span.holds(gain))?;
    let against: Vec<Rational> = gain.iter().map(|g| -g).collect();
    [gain, against].iter().find_map(|gain| direction(system, point, gain))
}

/// The coordinates that are zero on all of the polyhedron.
fn vanishing(system: &DMatrix<Rational>, point: &DVector<Rational>) -> Vec<usize> {
    let mut zero: Vec<usize> = (0..point.len()).filter(|j| point[*j].is_zero()).collect();
    while !zero.is_empty() && !planted(Plant::Vanishing) {
        let raised: Vec<Rational> = (0..point.len()).map(|j| ratio(i64::from(zero.contains(&j)), 1)).collect();
        let Some(direction) = direction(system, point, &raised) else { break };
        zero.retain(|j| direction[*j].is_zero());
    }
    zero
}

/// d with `system` d = 0, d_j ≥ 0 where the point has a zero, and gain·d = 1; none if there is none.
fn direction(system: &DMatrix<Rational>, point: &DVector<Rational>, gain: &[Rational]) -> Option<DVector<Rational>> {
    let size = point.len();
    let free: Vec<usize> = (0..size).filter(|j| !point[*j].is_zero()).collect();
    let entry = |i: usize, j: usize| if i < system.nrows() { system[(i, j)].clone() } else { gain[j].clone() };
    let split =
        DMatrix::from_fn(system.nrows() + 1, size + free.len(), |i, j| if j < size { entry(i, j) } else { -entry(i, free[j - size]) });
    let right = DVector::from_fn(system.nrows() + 1, |i, _| ratio(i64::from(i == system.nrows()), 1));
    let found = nonnegative_solution(&split, &right).point()?;
    let mut direction = found.rows(0, size).into_owned();
    free.iter().enumerate().for_each(|(place, j)| direction[*j] -= found[size + place].clone());
    Some(direction)
}

/// The row space of some rows: one of each pivot, scaled to 1 there.
#[derive(Default)]
struct Span {
    rows: Vec<(usize, Vec<Rational>)>,
}

impl Span {
    /// What is left of a row when those of the space are taken off.
    fn reduced(&self, mut row: Vec<Rational>) -> Vec<Rational> {
        for (pivot, own) in &self.rows {
            if row[*pivot].is_zero() {
                continue;
            }
            let factor = row[*pivot].clone();
            row.iter_mut().zip(own).filter(|(_, own)| !own.is_zero()).for_each(|(x, own)| *x -= &factor * own);
        }
        row
    }

    fn holds(&self, row: &[Rational]) -> bool {
        self.reduced(row.to_vec()).iter().all(RBig::is_zero)
    }

    fn add(&mut self, row: Vec<Rational>) {
        let mut left = self.reduced(row);
        let Some(pivot) = left.iter().position(|x| !x.is_zero()) else { return };
        let scale = left[pivot].clone();
        left.iter_mut().for_each(|x| *x /= &scale);
        self.rows.push((pivot, left));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::draw::Draw;
    use crate::certificate::planted::with;

    fn numbers(numbers: &[i64]) -> Vec<Rational> {
        numbers.iter().map(|x| ratio(*x, 1)).collect()
    }

    #[test]
    fn a_coordinate_moves_up_from_one_end_and_down_from_the_other_and_a_sum_that_is_given_does_not() {
        // x₁ + x₂ = 1: the segment from (0, 1) to (1, 0)
        let system = DMatrix::from_row_slice(1, 2, &numbers(&[1, 1]));
        let from = |point: [i64; 2], gain: &[i64]| moving(&system, &DVector::from_vec(numbers(&point)), [numbers(gain)].into_iter());
        assert_eq!(from([0, 1], &[1]).expect("up").as_slice(), numbers(&[1, -1]));
        assert_eq!(from([1, 0], &[1]).expect("down").as_slice(), numbers(&[-1, 1]));
        assert_eq!((from([1, 0], &[1, 1]), from([0, 1], &[0, 0])), (None, None));
    }

    #[test]
    fn what_is_held_at_zero_does_not_move_though_the_equations_leave_it_free() {
        // x₁ + x₂ = 0: a point; x₃ is free
        let system = DMatrix::from_row_slice(1, 3, &numbers(&[1, 1, 0]));
        let point = DVector::from_vec(numbers(&[0, 0, 0]));
        assert_eq!(vanishing(&system, &point), [0, 1]);
        assert_eq!(moving(&system, &point, [numbers(&[1, 0, 0]), numbers(&[1, 2, 0])].into_iter()), None);
        assert_eq!(moving(&system, &point, [numbers(&[1]), numbers(&[5, 0, -2])].into_iter()).expect("up")[2], ratio(1, 2));
    }

    /// How often a drawn polyhedron moves otherwise than one linear program for each gain and each sign says, and how often it moves.
    fn compared() -> [usize; 2] {
        let (mut draw, mut different, mut moves) = (Draw(11), 0, 0);
        for _ in 0..300 {
            let system = DMatrix::from_fn(4, 6, |_, _| ratio(draw.whole(2), 1));
            let point = DVector::from_fn(6, |_, _| ratio(draw.whole(2).max(0), 1));
            let gains: Vec<Vec<Rational>> = (0..2).map(|_| (0..6).map(|_| ratio(draw.whole(1), 1)).collect()).collect();
            let both = gains.iter().flat_map(|gain| [gain.clone(), gain.iter().map(|g| -g).collect()]);
            let each = both.into_iter().find_map(|gain| direction(&system, &point, &gain));
            different += usize::from(moving(&system, &point, gains.into_iter()) != each);
            moves += usize::from(each.is_some());
        }
        [different, moves]
    }

    #[test]
    fn all_gains_at_once_say_what_a_linear_program_for_each_says() {
        let [different, moves] = with(None, compared);
        assert!(different == 0 && (50..250).contains(&moves), "{different} {moves}");
        assert!(with(Some(Plant::Vanishing), compared)[0] > 0, "coordinates that are zero at one point are not zero everywhere");
    }
}
