//! How many dimensions the impulses have that give the proved velocity.
//!
//! ```text
//!     { r of the law : W r = W r* }  =  r* + { e : W e = 0 , … } :      e = 0 where it is open ,  e ∝ (1, −μ d) where it slides
//!     at least     F − rank W_F ,      F = the rows of contacts that stick inside of their cones, or press
//!     at most      F + S − rank W_F  with S sliding contacts ;      G − rank W_G ,   G = all rows of contacts that may press
//! ```
//! The rank is decided in whole numbers: of the rows of H where M̂ is symmetric and positive definite, for then W e = 0 is Hᵀe = 0, else of
//! the columns of W. The slip d is no fraction, so that sliding contacts may leave the dimension between two bounds.

use super::forward::{ContactState, Radius};
use super::interval::Interval;
use super::rank::{Entry, Row, rank};
use crate::problem::{ContactProblem, Solution};

/// Bounds of the dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImpulseSet {
    /// The set has so many dimensions or more.
    pub at_least: usize,
    /// It has so many or fewer.
    pub at_most: usize,
}

/// The dimension of the impulses with the velocity of the solution near an answer; none if deciding a rank takes too long.
/// ```
/// use moreau_contact::certificate::forward::forward;
/// use moreau_contact::certificate::impulse_set::{ImpulseSet, impulse_set};
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Solution};
///
/// // one body that rests on two contacts at the same place: how they share its weight is not determined
/// let twice = ContactProblem::new(DMatrix::from_element(2, 2, 1.0), dvector![-1.0, -1.0]);
/// let twice = twice.rows_per_contact(1).friction(vec![0.0; 2]).build()?;
/// let answer = Solution::new("by hand", dvector![0.5, 0.5], dvector![0.0, 0.0], 0);
/// let radius = forward(&twice, &answer)?.proved().expect("it is a solution");
/// assert_eq!(impulse_set(&twice, &answer, &radius), Some(ImpulseSet { at_least: 1, at_most: 1 }));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn impulse_set(problem: &ContactProblem, answer: &Solution, radius: &Radius) -> Option<ImpulseSet> {
    let d = problem.rows_per_contact();
    let (mut inside, mut all, mut sliding, mut is_strict) = (Vec::new(), Vec::new(), 0, true);
    for k in 0..problem.contacts() {
        let rows = k * d..(k + 1) * d;
        let found = looked_at(problem, answer, radius, k);
        match found {
            Found::Open => {}
            Found::Inside(count) => {
                inside.extend(rows.clone().take(count));
                all.extend(rows.take(count));
            }
            Found::Sliding => {
                sliding += 1;
                all.extend(rows);
            }
            Found::Border => {
                is_strict = false;
                let smooth = problem.law().cone_friction(problem.friction()[k]) == 0.0;
                all.extend(rows.take(if smooth { 1 } else { d }));
            }
        }
    }
    let at_least = nullity(problem, &inside)?;
    let widest = nullity(problem, &all)?;
    let at_most = if is_strict { widest.min(at_least + sliding) } else { widest };
    Some(ImpulseSet { at_least, at_most })
}

/// What a contact leaves free.
enum Found {
    Open,
    /// So many of its first rows, and every small change of them obeys the law.
    Inside(usize),
    Sliding,
    /// Nothing is said of it.
    Border,
}

fn looked_at(problem: &ContactProblem, answer: &Solution, radius: &Radius, k: usize) -> Found {
    let (d, rows) = (problem.rows_per_contact(), problem.rows_per_contact() * k);
    let r = |i: usize| Interval::ball(answer.impulse[rows + i], radius.impulse[k]);
    let y = Interval::ball(answer.velocity[rows], radius.velocity[k])
        + Interval::point(problem.shift()[rows])
        + Interval::point(problem.row_compliance(rows)) * r(0);
    let friction = if d == 1 { 0.0 } else { problem.law().cone_friction(problem.friction()[k]) };
    let room = || {
        let mu = Interval::point(friction).square();
        (1..d).fold(mu * r(0).square(), |room, i| room - r(i).square())
    };
    match radius.states[k] {
        ContactState::Open if y.is_positive() && !problem.law().is_convex() => Found::Open,
        ContactState::Open if y.is_positive() && friction == 0.0 => Found::Open,
        ContactState::Joined => Found::Inside(1),
        // room in a polygon, and the two dimensions of its sides, are not looked at
        _ if d == 3 && friction > 0.0 && problem.law().directions().is_some() => Found::Border,
        ContactState::Pressing if r(0).is_positive() => Found::Inside(1),
        ContactState::Sticking if r(0).is_positive() && room().is_positive() => Found::Inside(d),
        ContactState::Sliding if r(0).is_positive() => Found::Sliding,
        _ => Found::Border,
    }
}

/// The number of these rows, less the rank of what their impulses do.
fn nullity(problem: &ContactProblem, rows: &[usize]) -> Option<usize> {
    let column = |row: usize| -> Vec<Entry> {
        let soft = |other: usize| if other == row { problem.row_compliance(row) } else { 0.0 };
        (0..problem.rows()).map(|other| [problem.entry(other, row), soft(other)]).collect()
    };
    let symmetric = problem.dynamics().filter(|dynamics| dynamics.mass == dynamics.mass.transpose() && problem.compliance().is_none());
    let row = |row: &usize| match &symmetric {
        Some(dynamics) => dynamics.jacobian.row(*row).iter().map(|entry| [*entry, 0.0]).collect(),
        None => column(*row),
    };
    let columns: Vec<Row> = rows.iter().map(|at| Row::new(&row(at))).collect();
    Some(rows.len() - rank(&columns)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::forward::forward;
    use nalgebra::{DMatrix, DVector, dvector};

    fn set(problem: &ContactProblem, impulse: DVector<f64>) -> ImpulseSet {
        let velocity = problem.velocity(&impulse);
        let answer = Solution::new("", impulse, velocity, 0);
        let radius = forward(problem, &answer).unwrap().proved().expect("it is a solution");
        impulse_set(problem, &answer, &radius).unwrap()
    }

    fn exactly(count: usize) -> ImpulseSet {
        ImpulseSet { at_least: count, at_most: count }
    }

    /// A body of mass and moments of inertia 1 on contacts at these places of the ground.
    fn table(places: &[[f64; 2]], mu: f64, push: f64) -> ContactProblem {
        let mut jacobian = DMatrix::zeros(3 * places.len(), 6);
        for (k, [x, z]) in places.iter().enumerate() {
            // velocity of the point (x, z) in the ground: v + ω × p, normal along y
            let rows = [[0.0, 1.0, 0.0, *z, 0.0, -x], [1.0, 0.0, 0.0, 0.0, *z, 0.0], [0.0, 0.0, 1.0, 0.0, -x, 0.0]];
            rows.iter().enumerate().for_each(|(i, row)| (0..6).for_each(|j| jacobian[(3 * k + i, j)] = row[j]));
        }
        let free = &jacobian * dvector![push, -1.0, 0.0, 0.0, 0.0, 0.0];
        ContactProblem::from_dynamics(DMatrix::identity(6, 6), jacobian, &dvector![push, -1.0, 0.0, 0.0, 0.0, 0.0])
            .friction(vec![mu; places.len()])
            .build()
            .inspect(|problem| assert!((problem.free_velocity() - &free).amax() < 1e-12))
            .unwrap()
    }

    fn shared(count: usize) -> DVector<f64> {
        DVector::from_fn(3 * count, |row, _| if row % 3 == 0 { 1.0 / count as f64 } else { 0.0 })
    }

    #[test]
    fn a_table_leaves_as_many_impulses_open_as_it_has_more_rows_than_velocities_that_they_stop() {
        // legs on a line stop 5 velocities, not the turn about the line; others all 6
        let square = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
        assert_eq!(set(&table(&square, 0.5, 0.0), shared(4)), exactly(12 - 6));
        let line = [[1.0, 0.0], [-1.0, 0.0]];
        assert_eq!(set(&table(&line, 0.5, 0.0), shared(2)), exactly(6 - 5));
        assert_eq!(set(&table(&[[0.0, 0.0]], 0.5, 0.0), shared(1)), exactly(0));
        let smooth = table(&square, 0.0, 0.0);
        assert_eq!(set(&smooth, shared(4)), exactly(4 - 3), "normal impulses alone stop three velocities");
        assert_eq!(set(&table(&line, 0.0, 0.0), shared(2)), exactly(0));
    }

    #[test]
    fn sliding_contacts_leave_it_between_bounds_that_hold_the_known_dimension() {
        // four legs of a table that slides along: r_n is one number less than determined, and the friction follows
        let square = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
        let problem = table(&square, 0.25, 2.0);
        let impulse = DVector::from_fn(12, |row, _| [0.25, -0.0625, 0.0][row % 3]);
        let found = set(&problem, impulse);
        assert!(found.at_least <= 1 && 1 <= found.at_most && found.at_most <= 4, "{found:?}");
    }

    #[test]
    fn an_open_contact_gives_none_and_one_on_the_border_is_not_said_to_be_inside() {
        let twice = |free: f64| ContactProblem::new(DMatrix::from_element(2, 2, 1.0), dvector![free, free]).rows_per_contact(1);
        let rest = twice(0.0).friction(vec![0.0; 2]).build().unwrap();
        assert_eq!(set(&rest, dvector![0.0, 0.0]), ImpulseSet { at_least: 0, at_most: 1 }, "only r = 0 presses with no sum");
        let open = twice(1.0).friction(vec![0.0; 2]).build().unwrap();
        assert_eq!(set(&open, dvector![0.0, 0.0]), exactly(0));
        let pressed = twice(-1.0).friction(vec![0.0; 2]).build().unwrap();
        assert_eq!(set(&pressed, dvector![0.25, 0.75]), exactly(1));
        // what is not seen to be inside of the law gives no bound from below: here an impulse is known to within one
        let answer = Solution::new("", dvector![0.25, 0.75], dvector![0.0, 0.0], 0);
        let states = vec![ContactState::Pressing; 2];
        let mut radius = Radius { velocity: vec![0.0; 2], impulse: vec![1.0; 2], states, dependent: Vec::new(), bodies: None };
        assert_eq!(impulse_set(&pressed, &answer, &radius), Some(ImpulseSet { at_least: 0, at_most: 1 }));
        // and a last digit of W leaves no other impulse: the rank is not that of rounded numbers
        radius.impulse = vec![0.0; 2];
        assert_eq!(impulse_set(&pressed, &answer, &radius), Some(exactly(1)));
        let w = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, 1.0 + f64::EPSILON]);
        let near = ContactProblem::new(w, dvector![-1.0, -1.0]).rows_per_contact(1).friction(vec![0.0; 2]).build().unwrap();
        assert_eq!(impulse_set(&near, &answer, &radius), Some(exactly(0)));
    }
}
