//! A late resort for a few contacts: the problem without some of them.
//!
//! ```text
//!     r_j = 0  for j ∉ S ,     (u_S, r_S) solves the problem of S ,     u_j opens  for j ∉ S ,       for every S
//! ```
//! A body on points that are all but in a plane, with normals that are all but the same, moves by 10⁻⁸ of its speed from one S to the next,
//! and a method that goes by residuals cannot tell them apart until it has the right one. Newton's method starts from what is known for
//! every S of the twelve that open slowest, all of them first, then without one, without two, …, and again from contacts of S that all
//! stick; where few are left out Fischer and Burmeister's equations follow. Of a million drawn problems of 2 to 12 such contacts 47 were
//! not solved before these equations and this.

use super::super::{ContactSolver, NonsmoothNewton, watch};
use super::{smoothing, stuck};
use crate::certificate::Judge;
use crate::problem::{Compliance, ContactProblem, Coordinates, Solution, island_rows};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Whether it has few enough contacts.
pub(super) fn fits(problem: &ContactProblem) -> bool {
    (2..=tolerance::CONTACTS_LEFT_OUT).contains(&problem.contacts()) && NonsmoothNewton::fits(problem)
}

/// The best answer over all sets of contacts, or the first within `stop`.
///
/// # Errors
/// A breakdown where no set has an answer made of numbers.
pub(super) fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>, stop: f64) -> Result<Solution> {
    let from = start.map_or_else(|| DVector::zeros(problem.rows()), Clone::clone);
    let newton = NonsmoothNewton { steps: tolerance::STEPS_LEFT_OUT, starts: 1, tolerance: stop, ..Default::default() };
    let (mut judge, mut iterations, mut best) = (Judge::default(), 0, None);
    judge.prepare(problem);
    let nearest = nearest(problem, &from);
    'sets: for members in sets(&nearest) {
        let (alone, known) = (of(problem, &members)?, island_rows(&from, &members, problem.rows_per_contact()));
        let few_are_left_out = nearest.len() - members.len() <= tolerance::LEFT_OUT_OF_SMOOTHED;
        let ways: [&dyn Fn() -> Result<Solution>; 3] =
            [&|| newton.solve(&alone, Some(&known)), &|| stuck::solve(&alone, stop), &|| smoothing::solve(&alone, None, stop)];
        for way in &ways[..2 + usize::from(few_are_left_out)] {
            let Ok(part) = watch::unnoted(way) else { continue };
            iterations += part.iterations;
            let impulse = spread(problem, &members, &part.impulse);
            let velocity = problem.velocity(&impulse);
            let solution = Solution::new(part.solver, impulse, velocity, 0);
            let relative = judge.judge_prepared(problem, &solution)?.relative();
            if !relative.is_nan() && best.as_ref().is_none_or(|(least, _)| relative < *least) {
                watch::note(relative);
                best = Some((relative, solution));
            }
            if relative <= stop || watch::is_over() {
                break 'sets;
            }
        }
    }
    best.map(|(_, solution)| Solution { iterations, ..solution })
        .ok_or_else(|| Error::breakdown(newton.name(), "no set of contacts has an answer"))
}

/// The contacts that open slowest at these impulses, in their order; all of them where they are not many.
fn nearest(problem: &ContactProblem, impulse: &DVector<f64>) -> Vec<usize> {
    let (velocity, rows) = (problem.law_velocity(impulse), problem.rows_per_contact());
    let mut nearest: Vec<usize> = (0..problem.contacts()).collect();
    nearest.sort_by(|j, k| velocity[j * rows].total_cmp(&velocity[k * rows]));
    nearest.truncate(tolerance::CONTACTS_IN_SETS);
    nearest.sort_unstable();
    nearest
}

/// All sets of these contacts but the empty one, those that leave out fewest first.
fn sets(contacts: &[usize]) -> Vec<Vec<usize>> {
    let of = |bits: usize| contacts.iter().enumerate().filter(move |(place, _)| bits >> place & 1 == 1).map(|(_, k)| *k);
    let mut sets: Vec<Vec<usize>> = (1..1usize << contacts.len()).map(|bits| of(bits).collect()).collect();
    sets.sort_by_key(|members| contacts.len() - members.len());
    sets
}

/// The problem of these contacts alone.
fn of(problem: &ContactProblem, members: &[usize]) -> Result<ContactProblem> {
    let rows = problem.rows_per_contact();
    let place = |row: usize| members[row / rows] * rows + row % rows;
    let delassus = DMatrix::from_fn(members.len() * rows, members.len() * rows, |i, j| problem.entry(place(i), place(j)));
    let part = |whole: &DVector<f64>| island_rows(whole, members, rows);
    let mut alone = ContactProblem::new(delassus, part(problem.free_velocity()))
        .law(problem.law())
        .rows_per_contact(rows)
        .friction(members.iter().map(|k| problem.friction()[*k]).collect::<Vec<f64>>())
        .shift(part(problem.shift()));
    if let Some(Compliance { diagonal, .. }) = problem.compliance() {
        alone = alone.compliance(Compliance { coordinates: Coordinates::Contact, diagonal: part(diagonal) });
    }
    alone.build()
}

/// The impulses of all contacts, none at those that are left out.
fn spread(problem: &ContactProblem, members: &[usize], impulse: &DVector<f64>) -> DVector<f64> {
    let (rows, mut whole) = (problem.rows_per_contact(), DVector::zeros(problem.rows()));
    for (place, k) in members.iter().enumerate() {
        whole.rows_mut(k * rows, rows).copy_from(&impulse.rows(place * rows, rows));
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Law;
    use crate::solvers::test_problems::four_corners;
    use crate::tolerance::solvers::{ENOUGH, STOP};

    #[test]
    fn every_set_but_the_empty_one_comes_once_and_the_largest_first() {
        let sets = sets(&[2, 5, 7]);
        assert_eq!(sets[0], [2, 5, 7]);
        assert_eq!(sets.iter().map(Vec::len).collect::<Vec<_>>(), [3, 2, 2, 2, 1, 1, 1]);
        let different: std::collections::BTreeSet<&Vec<usize>> = sets.iter().collect();
        assert_eq!(different.len(), 7);
    }

    #[test]
    fn a_solution_without_some_contacts_solves_the_whole_where_they_open() {
        for law in [Law::Coulomb, Law::Associated] {
            for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
                let problem = four_corners(law, sideways, turning);
                let solution = solve(&problem, None, STOP).unwrap();
                assert!(residuals(&problem, &solution).unwrap().is_solution(ENOUGH), "{law:?} {sideways} {turning}");
            }
        }
    }

    #[test]
    fn what_is_seen_of_it_are_residuals_of_the_whole_that_fall() {
        let problem = four_corners(Law::Coulomb, 0.5, 1.0);
        let (answer, seen) = watch::watched(&watch::Interrupt::default(), || solve(&problem, None, 0.0).unwrap());
        assert!(seen.history.is_sorted_by(|one, next| next < one) && seen.history.len() < 15, "{:?}", seen.history);
        let whole = residuals(&problem, &Solution { iterations: 0, ..answer }).unwrap().judged.relative();
        assert_eq!(seen.history.last(), Some(&whole));
    }

    /// On the two corners of one edge the cube tips, and the other two close.
    #[test]
    fn what_is_left_out_may_not_close() {
        let problem = four_corners(Law::Coulomb, 0.1, 0.0);
        let alone = of(&problem, &[0, 2]).unwrap();
        assert_eq!((alone.contacts(), alone.friction()), (2, &[0.5; 2][..]));
        let part = NonsmoothNewton::default().solve(&alone, None).unwrap();
        assert!(residuals(&alone, &part).unwrap().is_solution(ENOUGH));
        let impulse = spread(&problem, &[0, 2], &part.impulse);
        let velocity = problem.velocity(&impulse);
        assert!(velocity[3] < 0.0 && velocity[9] < 0.0 && impulse.rows(3, 3).amax() == 0.0 && impulse.rows(9, 3).amax() == 0.0);
        assert!(!residuals(&problem, &Solution::new("tips", impulse, velocity, 0)).unwrap().is_solution(ENOUGH));
    }

    #[test]
    fn contacts_that_open_fastest_are_left_out_of_every_set() {
        let n = tolerance::CONTACTS_IN_SETS + 2;
        let q = DVector::from_fn(n, |k, _| if k == 1 || k == 4 { 2.0 } else { -1.0 });
        let problem = ContactProblem::new(DMatrix::identity(n, n), q).rows_per_contact(1).build().unwrap();
        let kept: Vec<usize> = (0..n).filter(|k| *k != 1 && *k != 4).collect();
        assert_eq!(nearest(&problem, &DVector::zeros(n)), kept);
        assert!(fits(&problem));
    }
}
