//! All solutions of a problem whose contacts fall into parts that share nothing: any solution of each part together.

use super::all_solutions::{All, End, Enumerated, Part, named, told};
use crate::certificate::separate::{Separate, separate};
use crate::certificate::uniqueness::uniqueness;
use crate::problem::ContactProblem;
use crate::tolerance::proof::PARTS_WORK;

/// Velocities that are listed, of a product of parts.
const LISTED: usize = 1000;

/// Why nothing is known of a part that is not tried.
const LEFT: &str = "the parts before it took as much as is tried of all together";

/// What the enumeration of a problem's solutions shows: of each of its parts, if they share nothing.
pub(super) fn enumerated(problem: &ContactProblem) -> Enumerated {
    match separate(problem) {
        Ok(parts) if !parts.is_empty() => by_parts(problem, &parts, PARTS_WORK),
        _ => Enumerated::of(problem),
    }
}

/// What the enumeration of each part shows of the whole; once they took more than `most`, no further part is tried.
fn by_parts(problem: &ContactProblem, parts: &[Separate], most: usize) -> Enumerated {
    let (mut found, mut work) = (Vec::new(), 0);
    for part in parts {
        let is_tried = work <= most;
        let mut own = if is_tried { Enumerated::of(&part.problem) } else { Enumerated::default() };
        work += own.work;
        if own.all.as_ref().is_some_and(|all| all.velocities == 0) {
            own.all = own.all.take().map(|all| All { parts: vec![counted(part, &all)], ..all });
            return own;
        }
        let unique = own.unique.take().unwrap_or_else(|| told(uniqueness(&part.problem)));
        own.unique = Some(match own.or_counted(unique) {
            ("unknown", _) if !is_tried => ("unknown", LEFT.into()),
            known => known,
        });
        found.push(own);
    }
    let (all, continuum) = (product(problem, parts, &found), together(problem, parts, &found));
    let undecided = found.iter().zip(parts).flat_map(|(own, part)| {
        let contacts = named(&part.contacts);
        own.undecided.iter().map(move |reason| format!("{contacts}: {reason}"))
    });
    Enumerated { unique: Some(unique(parts, &found)), undecided: undecided.collect(), all, continuum, work, ..Enumerated::default() }
}

fn counted(part: &Separate, all: &All) -> Part {
    Part { contacts: part.contacts.clone(), velocities: all.velocities, continuum: all.continuum }
}

/// The weakest of what is unique, with the reasons of all parts, or the first part of which nothing is known.
fn unique(parts: &[Separate], found: &[Enumerated]) -> (&'static str, String) {
    let known = || found.iter().filter_map(|own| own.unique.as_ref());
    if let Some((part, (_, reason))) = parts.iter().zip(known()).find(|(_, (what, _))| *what == "unknown") {
        return ("unknown", format!("of {}: {reason}", named(&part.contacts)));
    }
    let what = if known().all(|(what, _)| *what == "solution") { "solution" } else { "velocity" };
    let mut reasons: Vec<&str> = Vec::new();
    for (_, reason) in known() {
        if !reasons.contains(&reason.as_str()) {
            reasons.push(reason);
        }
    }
    (what, format!("of each of {} parts that share nothing, {}", parts.len(), reasons.join("; ")))
}

/// All solutions, where those of every part are known, and so many that they can be counted.
fn product(problem: &ContactProblem, parts: &[Separate], enumerated: &[Enumerated]) -> Option<All> {
    let every: Vec<&All> = enumerated.iter().map(|own| own.all.as_ref()).collect::<Option<_>>()?;
    let velocities = every.iter().try_fold(1usize, |product, all| product.checked_mul(all.velocities))?;
    let sum = |of: fn(&All) -> Option<usize>| every.iter().filter_map(|all| of(all)).reduce(usize::saturating_add);
    let mut found = vec![vec![0.0; problem.rows()]];
    for (all, part) in every.iter().zip(parts) {
        let with = |before: &Vec<f64>, own: &Vec<f64>| {
            let mut whole = before.clone();
            place(&mut whole, part, problem.rows_per_contact(), own);
            whole
        };
        found = found.iter().flat_map(|before| all.found.iter().map(move |own| with(before, own))).take(LISTED).collect();
    }
    Some(All {
        patterns: sum(|all| Some(all.patterns)).unwrap_or_default(),
        pieces: sum(|all| all.pieces),
        sets: sum(|all| all.sets),
        velocities,
        continuum: every.iter().any(|all| all.continuum),
        found,
        parts: parts.iter().zip(&every).map(|(part, all)| counted(part, all)).collect(),
    })
}

/// Both ends of the first part that is a continuum, beside one solution of each other part, where all have one.
fn together(problem: &ContactProblem, parts: &[Separate], found: &[Enumerated]) -> Option<[End; 2]> {
    let moving = found.iter().position(|own| own.continuum.is_some())?;
    let end = |which: usize| {
        let mut whole = End { impulse: vec![0.0; problem.rows()], velocity: vec![0.0; problem.rows()] };
        for (number, (own, part)) in found.iter().zip(parts).enumerate() {
            let one = if number == moving { own.continuum.as_ref().map(|ends| &ends[which]) } else { own.one.as_ref() }?;
            place(&mut whole.impulse, part, problem.rows_per_contact(), &one.impulse);
            place(&mut whole.velocity, part, problem.rows_per_contact(), &one.velocity);
        }
        Some(whole)
    };
    Some([end(0)?, end(1)?])
}

/// Writes the rows of a part to their places.
fn place(whole: &mut [f64], part: &Separate, rows: usize, own: &[f64]) {
    for (k, own) in part.contacts.iter().zip(own.chunks_exact(rows)) {
        whole[k * rows..(k + 1) * rows].copy_from_slice(own);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Law, Solution};
    use nalgebra::{DMatrix, DVector};

    /// Painlevé's rod in the plane or in space, which lifts off, slides or is jammed from 1 m/s, and in one way from −1 m/s.
    fn rods(free: &[f64], rows: usize) -> ContactProblem {
        let n = rows * free.len();
        let own = [[1.0, 2.0, 0.0], [2.0, 5.0, 0.0], [0.0, 0.0, 1.0]];
        let w = DMatrix::from_fn(n, n, |i, j| if i / rows == j / rows { own[i % rows][j % rows] } else { 0.0 });
        let tangential = |free: f64| if free > 0.0 { 4.0 } else { 1.0 };
        let given = DVector::from_fn(n, |i, _| [free[i / rows], tangential(free[i / rows]), 0.0][i % rows]);
        ContactProblem::new(w, given).rows_per_contact(rows).friction(vec![1.0; free.len()]).build().expect("sizes fit")
    }

    #[test]
    fn velocities_of_parts_are_counted_together() {
        for (rows, free) in [(2, &[1.0; 7][..]), (3, &[1.0; 4])] {
            let problem = rods(free, rows);
            let all = enumerated(&problem).all.expect("each rod is small");
            assert_eq!((all.velocities, all.parts.len(), all.continuum), (3usize.pow(free.len() as u32), free.len(), false));
            assert!(
                all.line().contains(&format!("exactly {} velocities, those of {} parts", all.velocities, free.len())),
                "{}",
                all.line()
            );
            assert_eq!(all.found.len(), all.velocities.min(LISTED));
            for velocity in &all.found {
                let open = velocity.chunks(rows).filter(|u| u[0] == 1.0 && u[1] == 4.0).count();
                let held = velocity.chunks(rows).filter(|u| u[0].abs() < 1e-12).count();
                assert_eq!(open + held, free.len(), "{velocity:?}");
            }
            let different = |one: usize| all.found[..one].iter().all(|other| *other != all.found[one]);
            assert!((0..all.found.len().min(100)).all(different));
        }
        // more than 2⁶⁴ are not counted
        let many = enumerated(&rods(&[1.0; 41], 2));
        assert!(many.all.is_none() && many.is_open());
        assert_eq!(enumerated(&rods(&[1.0; 40], 2)).all.map(|all| all.velocities), Some(3usize.pow(40)));
    }

    #[test]
    fn one_velocity_of_each_part_is_one_of_all_and_another_part_keeps_it_unknown() {
        let unique = |problem: &ContactProblem| enumerated(problem).unique.expect("it is told");
        let (what, why) = unique(&rods(&[-1.0; 9], 2));
        assert!(what == "velocity" && why.starts_with("of each of 9 parts that share nothing, all patterns were tried"), "{what} {why}");
        let free = [-1.0, -1.0, 1.0, -1.0, -1.0, -1.0, -1.0];
        let (what, why) = unique(&rods(&free, 2));
        assert!(what == "unknown" && why.starts_with("of contact 2: "), "{what} {why}");
        // where nothing pushes along, both are proved without patterns
        let blocks = ContactProblem::new(DMatrix::identity(24, 24), DVector::from_element(24, -1.0)).friction(vec![0.5; 8]).build();
        assert_eq!(unique(&blocks.expect("sizes fit")).0, "solution");
    }

    #[test]
    fn a_part_that_is_not_tried_is_named_and_nothing_is_counted() {
        let problem = rods(&[1.0; 3], 2);
        let parts = parts_of(&problem);
        let left = by_parts(&problem, &parts, 0);
        let (what, why) = left.unique.as_ref().expect("it is told");
        assert!(left.all.is_none() && left.is_open() && *what == "unknown" && why.starts_with("of contact 0: "), "{what} {why}");
        let blocks = rods(&[-1.0; 3], 2);
        let (what, why) = by_parts(&blocks, &parts_of(&blocks), 0).unique.expect("it is told");
        assert!(what == "unknown" && why.contains("contact 1: the parts before it took"), "{what} {why}");
        assert!(by_parts(&problem, &parts, PARTS_WORK).all.is_some_and(|all| all.velocities == 27));
    }

    fn parts_of(problem: &ContactProblem) -> Vec<Separate> {
        separate(problem).expect("sizes fit")
    }

    #[test]
    fn a_continuum_of_one_part_is_one_of_all_beside_a_solution_of_the_others() {
        // a block between walls that it slides along, at all speeds between, and seven that rest
        let rows = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 1.0]];
        let own = DMatrix::from_fn(4, 4, |i, j| rows[i][0] * rows[j][0] + rows[i][1] * rows[j][1]);
        let mut w = DMatrix::identity(18, 18);
        w.view_mut((0, 0), (4, 4)).copy_from(&own);
        let free = DVector::from_fn(18, |i, _| [0.0, 2.0, 0.0, 2.0].get(i).copied().unwrap_or(-1.0));
        let problem = ContactProblem::new(w, free).rows_per_contact(2).friction(vec![0.5; 9]).build().unwrap();
        let found = enumerated(&problem);
        assert!(found.all.is_some_and(|all| all.continuum && all.parts[0].continuum && !all.parts[1].continuum));
        let [one, other] = found.continuum.expect("jammed as hard as one likes");
        assert!(one.velocity != other.velocity);
        for end in [one, other] {
            let answer = Solution::new("", DVector::from_vec(end.impulse), DVector::from_vec(end.velocity), 0);
            assert!(crate::certificate::residuals(&problem, &answer).unwrap().is_solution(1e-12));
        }
        assert_eq!(problem.law(), Law::Coulomb);
    }
}
