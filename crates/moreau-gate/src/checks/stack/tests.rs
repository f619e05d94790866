//! How stacks start, and what they may move by.

use super::pile::{GAP, HALF, NARROWER, Pile, Start, WIDTH, corner, sprung_depths, width};
use super::rest::{rise, tipped};
use super::{pile, standing};
use crate::checks::scenery::GRAVITY;
use crate::model::Model;
use crate::runner::SWEEP;
use crate::tolerance::stack as tolerance;
use crate::{Bench, Kind};
use moreau_dynamics::scenes::Scene;
use moreau_exact::tolerance::rounding;

/// A small step and a larger one \[s\].
const SMALL: f64 = 1.0 / 1024.0;
const STEP: f64 = 0.01;

#[test]
fn a_corner_of_the_lowest_box_feels_its_turn_and_of_the_next_both_boxes() {
    // A box of half extents a, a, c: 1/m + 2 a²/J with J = m (a² + c²)/3.
    let alone = |mass: f64, arm: f64, width: f64| (1.0 + 6.0 * arm * arm / (width * width + HALF * HALF)) / mass;
    let masses = [2.0, 3.0];
    let [lowest, next] = [0, 1].map(|k| corner(&masses, k, 0.0));
    let next_width = width(1, 2, 0.0);
    assert!((lowest.inverse_mass - alone(2.0, WIDTH, WIDTH)).abs() <= rounding(16, lowest.inverse_mass));
    let both = alone(3.0, next_width, next_width) + alone(2.0, next_width, WIDTH);
    assert!((next.inverse_mass - both).abs() <= rounding(16, both));
    assert!((lowest.load - 1.25 * GRAVITY).abs() <= rounding(8, GRAVITY) && lowest.on_ground && !next.on_ground);
}

/// What a bench of our engine finds that declares this law with these parameters.
fn declared<T>(law: &str, kind: Kind, parameters: &[(&str, f64)], find: impl FnOnce(&mut Bench) -> T) -> T {
    use crate::Engine;
    let mut engine = crate::own::by_name("moreau-jean").expect("listed");
    let options = crate::Options::new();
    let mut description = engine.describe(&options).expect("describes itself");
    (description.contact_model.kind, description.contact_model.law) = (kind, Some(law.into()));
    for (name, value) in parameters {
        let (value, unit) = (crate::description::OneOrMany::One(*value), crate::description::OneOrMany::One("1".into()));
        description.contact_model.parameters.insert((*name).into(), crate::Parameter { value, unit });
    }
    find(&mut Bench::new(&mut engine, &description, &options))
}

#[test]
fn a_pile_is_not_asked_of_an_engine_whose_declared_correction_lets_boxes_hop() {
    let refused = |parameters: &[(&str, f64)]| {
        let reply = declared("coulomb", Kind::Rigid, parameters, |bench| standing(bench, 0.01, &[1.0; 2], 20));
        matches!(reply, Err(crate::Refusal::Unsupported(reason)) if reason.contains("error_reduction"))
    };
    assert!(refused(&[("error_reduction", 0.4)]));
    assert!(!refused(&[("error_reduction", 0.3)]) && !refused(&[]));
    assert!(!refused(&[("error_reduction", 0.4), ("penetration_allowance", 0.001)]));
}

#[test]
fn springs_too_soft_for_the_boxes_say_no_place() {
    assert_eq!(Start::Swallowed.gaps(2), Start::Apart.gaps(2));
    assert_eq!(Start::Sprung(vec![0.01, 0.02]).gaps(2), [-0.01, -0.02]);
}

/// By how much the half width of each box differs from that of the next one \[m\].
fn ledges(scene: &Scene) -> Vec<f64> {
    let widths: Vec<f64> = scene.bodies.iter().filter_map(|body| body.cuboid).map(|cuboid| cuboid.half_extents[0]).collect();
    assert!((widths[widths.len() - 1] - WIDTH * (1.0 - NARROWER * (widths.len() - 1) as f64)).abs() <= rounding(16, WIDTH));
    widths.windows(2).map(|pair| pair[0] - pair[1]).collect()
}

#[test]
fn a_corner_found_late_is_farther_from_the_side_of_the_box_below_than_from_its_top() {
    for (h, levels) in SWEEP.into_iter().flat_map(|h| [2, 5, 10].map(|levels| (h, levels))) {
        let scene = declared("coulomb", Kind::Rigid, &[], |bench| Pile::of(bench, &vec![1.0; levels], h).scene());
        let ledge = tolerance::found_depth(GRAVITY, GAP, levels, h).max(NARROWER * WIDTH);
        let ledges = ledges(&scene);
        assert_eq!(ledges.len(), levels - 1);
        assert!(ledges.iter().all(|one| (one - ledge).abs() <= rounding(16, 1.0)), "{ledges:?} at {h}");
    }
}

#[test]
fn so_is_one_that_declared_springs_let_in() {
    let masses = [1.0, 1000.0];
    let springs = |stiffness: f64| [("stiffness", stiffness), ("damping", 100.0)];
    let of = |stiffness| declared("spring-damper", Kind::Compliant, &springs(stiffness), |bench| Pile::of(bench, &masses, SMALL).scene());
    let swing = |stiffness: f64| {
        let rest = 250.0 * GRAVITY / stiffness;
        rest + (rest * rest + 2.0 * rest * 2.0 * GAP).sqrt()
    };
    for stiffness in [2e5, 4e5, 1e6] {
        let ledge = ledges(&of(stiffness))[0];
        assert!(ledge > swing(stiffness) && ledge < 2.0 * swing(stiffness), "{ledge} of {}", swing(stiffness));
    }
    assert!(ledges(&of(1e3))[0] <= HALF + tolerance::found_depth(GRAVITY, GAP, 2, SMALL), "deeper in, other faces touch");
    // springs of a frequency that sink by 22 mm: the boxes start there, and a wider box sinks as deep as is said of it
    let frequency = [("contact_frequency", 5.0), ("ground_contact_frequency", 5.0)];
    declared("coulomb", Kind::Rigid, &frequency, |bench| {
        let pile = Pile::of(bench, &[1.0; 2], SMALL);
        let Start::Sprung(depths) = &pile.start else { panic!("starts on its springs") };
        assert!(depths[1] > NARROWER * WIDTH && ledges(&pile.scene())[0] > depths[1], "{depths:?}");
        assert_eq!(sprung_depths(bench, &[1.0; 2], pile.ledge).as_deref(), Some(&depths[..]));
    });
}

#[test]
fn a_wider_box_yields_by_a_bounded_factor_more() {
    let yields = |ledge: f64| {
        (0..10)
            .map(|k| corner(&[1.0; 10], k, ledge).inverse_mass)
            .fold([f64::INFINITY, 0.0], |[low, high], one| [low.min(one), high.max(one)])
    };
    for ledge in [0.001, 0.01, 0.05] {
        for k in 0..10 {
            let [before, after] = [0.0, ledge].map(|ledge| corner(&[1.0; 10], k, ledge).inverse_mass);
            assert!(after <= tolerance::WIDER * before, "{k} {ledge}: {after} {before}");
        }
    }
    assert!(yields(1.0)[1] < 14.0 && yields(0.0)[0] > 5.0);
}

#[test]
fn tips_of_all_levels_lean_to_one_side_and_what_is_taken_back_decays() {
    let pile = Pile { masses: &[1.0; 3], start: Start::Apart, ledge: 0.0 };
    let [angle, shift, fall] = tipped(&pile, STEP);
    // 3/2 · 3/2 g h²
    let depth = 2.25 * GRAVITY * STEP * STEP;
    let one = |k: usize| depth / (2.0 * width(k, 3, 0.0));
    assert!((angle - 2.0 * (one(0) + one(1) + one(2))).abs() <= rounding(64, angle));
    assert!((shift - 4.0 * HALF * (3.0 * one(0) + 2.0 * one(1) + one(2))).abs() <= rounding(64, shift));
    assert!((fall - 3.0 * depth).abs() <= rounding(64, fall));
    let limits = crate::model::RigidLimits { error_reduction: 0.2, penetration_allowance: GAP, ..Default::default() };
    let slow = crate::model::RigidLimits { correction_speed: 0.1, ..limits };
    let [decayed, stays] = [limits, slow].map(|limits| rise(&Model::Coulomb(limits), 0.1, (3, 100), STEP));
    // r/h of the landings; of a depth 4/5 is left after each of the sixty steps of landing
    let whole = 0.2 * 0.1 / STEP;
    let left = whole * 0.8f64.powi(60);
    assert!((stays - whole).abs() <= rounding(8, whole) && (decayed - left).abs() <= rounding(256, left), "{stays} {decayed}");
    // a fifth of each depth is gone within a hundred steps, a hundredth is not, and nothing opens
    let opening = |error_reduction: f64| {
        rise(&Model::Coulomb(crate::model::RigidLimits { error_reduction, ..Default::default() }), 0.0, (3, 100), STEP)
    };
    assert!(opening(0.2) > 3.0 * GRAVITY * STEP && opening(0.01) == 0.0);
    // one that is taken back in the positions alone leaves a corner that opens, too, and pushes nothing
    let moved = crate::model::RigidLimits { position_correction: 0.2, ..Default::default() };
    let falling = 3.0 * tolerance::tipping_speed(0.0, GRAVITY, STEP);
    assert!((rise(&Model::Coulomb(moved), 0.1, (3, 100), STEP) - falling).abs() <= rounding(16, falling));
}

#[test]
fn a_pile_that_may_be_found_as_deep_as_a_box_or_that_springs_swallow_is_not_asked() {
    let refused = |law: &str, kind: Kind, parameters: &[(&str, f64)], masses: &[f64], h: f64| {
        declared(law, kind, parameters, |bench| matches!(pile(bench, masses, h), Err(crate::Refusal::Unsupported(_))))
    };
    for (levels, h, deep) in [(10, 1.0 / 30.0, true), (5, 1.0 / 30.0, false), (10, 1.0 / 60.0, false)] {
        assert_eq!(refused("coulomb", Kind::Rigid, &[], &vec![1.0; levels], h), deep, "{levels} at {h}");
    }
    for (stiffness, soft) in [(4e4, true), (6e4, false)] {
        let springs = [("stiffness", stiffness), ("damping", 100.0)];
        assert_eq!(refused("spring-damper", Kind::Compliant, &springs, &[1.0, 1000.0], SMALL), soft, "{stiffness}");
    }
}

#[test]
fn a_pile_that_sinks_while_its_velocities_are_zero_fails() {
    let verdict = |creep: f64| {
        let mut engine = crate::exact::Reporting(move |motion: &mut moreau_dynamics::trajectory::Trajectory| {
            for track in &mut motion.bodies {
                track.position.iter_mut().enumerate().for_each(|(k, place)| place[2] -= creep * k as f64);
            }
        });
        let options = crate::Options::new();
        let description = crate::Engine::describe(&mut engine, &options).expect("describes itself");
        let measured = standing(&mut Bench::new(&mut engine, &description, &options), 1.0 / 60.0, &[1.0; 5], 200).expect("answers");
        measured.into_iter().find(|one| one.quantity.contains("sinking")).expect("measured").verdict()
    };
    assert_eq!([verdict(0.0), verdict(0.2 * GAP)], [crate::Verdict::Pass, crate::Verdict::Fail]);
}
