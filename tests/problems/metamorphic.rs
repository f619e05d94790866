//! What may not change an answer: order, tangents, units, a contact that stands twice, how W is stored; and what friction tends to.

use super::transform::{angle, by_blocks, in_units, select, selected, turn, turned};
use super::{is_campaign, stored};
use moreau::certificate::residuals;
use moreau::problems::{Known, Record, near};
use moreau::solvers::{Auto, ContactSolver};
use moreau::tolerance::certificate::CERTIFY;
use moreau::{ContactProblem, Law};
use nalgebra::{DMatrix, DVector, dvector};

/// Contacts of the problems by default.
const CONTACTS: usize = 6;
/// Difference of two accepted velocities, of the largest one.
const SAME: f64 = 1e-6;

/// u of an accepted answer; none where there is none.
pub fn velocity(problem: &ContactProblem) -> Option<DVector<f64>> {
    let answer = Auto.solve(problem, None).ok()?;
    residuals(problem, &answer).expect("an answer that fits").is_solution(CERTIFY).then_some(answer.velocity)
}

/// Hard problems with their records and whether they were solved as they stand.
fn subjects() -> Vec<(ContactProblem, Record, Option<DVector<f64>>)> {
    let most = if is_campaign() { 30 } else { CONTACTS };
    let hard = stored(most).filter(|(_, problem, _)| problem.compliance().is_none());
    let found: Vec<_> = hard.map(|(_, problem, record)| (velocity(&problem), problem, record)).map(|(u, p, r)| (p, r, u)).collect();
    assert!(found.len() > 40, "{} problems", found.len());
    found
}

/// How far u of an accepted answer may be from a solution, as is proved, at any contact; zero where nothing is proved.
fn radius(problem: &ContactProblem) -> f64 {
    let answer = Auto.solve(problem, None).expect("it was accepted");
    let near = near(problem, &answer).expect("an answer that fits").proved();
    near.map_or(0.0, |radius| radius.worst().map_or(0.0, |(_, velocity)| velocity))
}

/// Holds the problem in another guise, W dense and by blocks, against what it is: the verdict is the same, and u where it is the only one.
#[track_caller]
fn unchanged(what: &str, subject: &(ContactProblem, Record, Option<DVector<f64>>), other: &ContactProblem, wanted: Option<DVector<f64>>) {
    let (_, record, before) = subject;
    for (stored, problem) in [("dense", other.clone()), ("blocks", by_blocks(other))] {
        let after = velocity(&problem);
        assert_eq!(after.is_some(), before.is_some(), "{}: {what}, {stored}: the verdict", record.name);
        if let (Some(after), Some(wanted), Known::Unique) = (after, &wanted, record.uniqueness.velocity) {
            let (apart, scale) = ((&after - wanted).amax(), wanted.amax().max(other.free_velocity().amax()));
            // where an accepted residual leaves u less sure, the proved distances from the one velocity tell how much; both are in one unit
            let as_sure = || {
                let own = radius(&subject.0) * scale / subject.2.as_ref().map_or(scale, |u| u.amax().max(subject.0.free_velocity().amax()));
                own + radius(&problem)
            };
            assert!(apart <= SAME * scale || apart <= as_sure(), "{}: {what}, {stored}: u differs by {apart}", record.name);
        }
    }
}

#[test]
fn the_order_of_contacts_and_one_that_stands_twice_change_nothing() {
    for subject in subjects() {
        let (problem, _, before) = &subject;
        let n = problem.contacts();
        let reversed: Vec<usize> = (0..n).rev().collect();
        let twice: Vec<usize> = (0..n).chain([n / 2]).collect();
        for (what, contacts) in [("reversed", reversed), ("twice", twice)] {
            let wanted = before.as_ref().map(|u| select(problem, &contacts, u));
            unchanged(what, &subject, &selected(problem, &contacts), wanted);
        }
    }
}

#[test]
fn turned_tangents_change_nothing() {
    for subject in subjects() {
        let (problem, _, before) = &subject;
        let is_even = problem.rows_per_contact() != 2 || problem.law().directions().is_none_or(|d| d.is_multiple_of(2));
        if problem.rows_per_contact() == 1 || !is_even {
            continue;
        }
        let t = turn(problem, angle(problem.law()));
        unchanged("turned", &subject, &turned(problem, &t), before.as_ref().map(|u| &t * u));
    }
}

#[test]
fn units_and_masses_change_nothing() {
    for subject in subjects() {
        let (problem, _, before) = &subject;
        // powers of 2 exactly, thousands, and masses a million times as large and as small
        for (speed, mass) in [(1024.0, 1.0 / 4096.0), (1e-3, 1e3), (1.0, 1e6), (1.0, 1e-6)] {
            let wanted = before.as_ref().map(|u| u * speed);
            unchanged(&format!("speed × {speed}, mass × {mass}"), &subject, &in_units(problem, speed, mass), wanted);
        }
    }
}

#[test]
fn vanishing_friction_tends_to_none() {
    let mut compared = 0;
    for (problem, record, _) in subjects() {
        if problem.law() != Law::Coulomb || record.uniqueness.velocity == Known::None {
            continue;
        }
        let smooth = problem.clone().into_builder().law(Law::Frictionless).build().expect("a valid problem");
        let Some(limit) = velocity(&smooth) else { continue };
        let scale = limit.amax().max(problem.free_velocity().amax()).max(f64::MIN_POSITIVE);
        let apart: Vec<f64> = [8, 16, 24]
            .into_iter()
            .filter_map(|power| {
                let friction = problem.friction().iter().map(|mu| mu / f64::from(1u32 << power)).collect();
                let weak = problem.clone().into_builder().friction(friction).build().expect("a valid problem");
                velocity(&weak).map(|u| (u - &limit).amax() / scale)
            })
            .collect();
        // without friction u is the only velocity, and the impulses that it takes are bounded by those of the frictionless problem
        assert!(apart.last().is_some_and(|last| *last <= 1e-4), "{}: {apart:?}", record.name);
        compared += 1;
    }
    assert!(compared > 20, "{compared} problems");
}

/// A point of 1 kg that arrives at 1 m/s and slides at 2 m/s in this direction from tangent₁, μ = ½.
fn sliding(law: Law, angle: f64) -> DVector<f64> {
    let free = dvector![-1.0, 2.0 * angle.cos(), 2.0 * angle.sin()];
    let problem = ContactProblem::new(DMatrix::identity(3, 3), free).law(law).friction(vec![0.5]).build().expect("a point");
    velocity(&problem).expect("one contact")
}

#[test]
fn polygons_tend_to_the_disk_with_the_square_of_their_sides_where_the_slip_is_across_a_side() {
    let apart =
        |directions: usize, angle: f64| (sliding(Law::PolyhedralCoulomb { directions }, angle) - sliding(Law::Coulomb, angle)).amax();
    let across = |d: usize| std::f64::consts::PI / d as f64;
    for d in [8, 16, 32, 64] {
        // the middle of a side is μ r_n (1 − cos(π/d)) inside the disk
        let expected = 0.5 * (1.0 - across(d).cos());
        let found = (sliding(Law::PolyhedralCoulomb { directions: d }, across(d)) - sliding(Law::Coulomb, across(d))).norm();
        assert!((found - expected).abs() <= 1e-9, "{d}: {found} for {expected}");
    }
    // elsewhere friction keeps to a corner, and the distance falls with the number of sides only
    for d in [8, 16, 32] {
        let (one, other) = (apart(d, 0.4 * across(d)), apart(2 * d, 0.4 * across(2 * d)));
        assert!(one / other < 3.0 && one / other > 1.5, "{d}: {one} and {other}");
    }
}
