//! Our engines through the engine's door.

use super::*;
use moreau_contact::problem::Law as ContactLaw;
use moreau_contact::solvers::{ProjectedGaussSeidel, SolverEntry};
use moreau_contact::tolerance::solvers::STOP;
use moreau_dynamics::scenes::named;
use moreau_exact::tolerance::rounding;
use nalgebra::{DMatrix, dvector};
use serde_json::json;

fn options(value: Value) -> Options {
    value.as_object().expect("an object").clone()
}

fn short(scene: &str, h: f64, steps: usize) -> Scene {
    Scene { duration: steps as f64 * h, ..named(scene).expect("built in") }
}

fn simulated(mut engine: OwnEngine, scene: &str, h: f64, steps: usize, every: usize) -> Trajectory {
    engine.simulate(&short(scene, h, steps), h, every, &Options::new()).expect("expressible")
}

#[test]
fn every_engine_moves_a_block_and_reports_the_weight_it_carries() {
    for name in NAMES {
        let (h, steps) = (1.0 / 240.0, 24);
        let trajectory = simulated(by_name(name).expect("listed"), "incline-stick", h, steps, steps);
        let [contact] = &trajectory.contacts[..] else { panic!("{:?}", trajectory.contacts) };
        let weight = 9.81 * steps as f64 * h;
        // Each step's impulses are off by STOP relative to the largest of them.
        let bound = 16.0 * STOP * weight;
        assert!((contact.impulse[2] - weight).abs() <= bound && contact.impulse[0].abs() <= bound, "{name}: {:?}", contact.impulse);
    }
}

#[test]
fn impulses_between_samples_add_up_to_those_of_the_steps() {
    let (h, steps) = (1.0 / 128.0, 32);
    let engine = || by_name("anitescu").expect("listed");
    let (fine, coarse) = (simulated(engine(), "box-stack", h, steps, 1), simulated(engine(), "box-stack", h, steps, 8));
    assert_eq!((fine.times.len(), coarse.times.len()), (33, 5));
    for contact in &coarse.contacts {
        let [first, second] = &contact.bodies;
        assert!(second == "ground" || first < second, "the name that comes first comes first");
        let within = |sample: usize| sample.div_ceil(8) == contact.sample;
        let parts = fine.contacts.iter().filter(|part| part.bodies == contact.bodies && within(part.sample));
        let sum = parts.fold(0.0, |sum, part| sum + part.impulse[2]);
        assert!((sum - contact.impulse[2]).abs() <= rounding(64, contact.impulse[2].abs()), "{:?}", contact.bodies);
        let along: f64 = contact.normal.iter().zip(contact.impulse).map(|(normal, impulse)| normal * impulse).sum();
        assert!(along > 0.0, "the normal points to the body that is pushed");
    }
}

#[test]
fn descriptions_say_what_the_options_change_and_refuse_the_others() {
    let mut engine = by_name("moreau-jean").expect("listed");
    let plain = engine.describe(&Options::new()).expect("no options");
    assert_eq!((plain.contact_model.law.as_deref(), plain.restitution, plain.friction), (Some("coulomb"), true, Friction::Cone));
    let changed = options(json!({"theta": 1.0, "activation": "gap", "solver": "pgs"}));
    let other = engine.describe(&changed).expect("known options");
    assert_eq!(other.options, options(json!({"solver": "pgs", "theta": 1.0, "activation": "gap"})));
    assert_eq!(engine.describe(&Options::new()).expect("no options"), plain, "a request changes nothing for the next");

    let mut pyramid = by_name("stewart-trinkle").expect("listed");
    let described = pyramid.describe(&options(json!({"directions": 16}))).expect("a parameter");
    assert_eq!((described.contact_model.number("directions"), described.friction), (Some(16.0), Friction::Pyramid));
    assert!(!described.restitution && described.reports_contacts);
    assert_eq!(
        by_name("anitescu").expect("listed").describe(&Options::new()).expect("none").contact_model.law.as_deref(),
        Some("anitescu")
    );

    for wrong in [json!({"thetta": 1}), json!({"theta": 2}), json!({"theta": "one"}), json!({"solver": "gauss"}), json!({"directions": 8})]
    {
        assert!(matches!(engine.describe(&options(wrong.clone())), Err(Refusal::Errored(_))), "{wrong}");
    }
    assert!(matches!(pyramid.describe(&options(json!({"directions": 2.5}))), Err(Refusal::Errored(_))));
    assert!(by_name("euler").is_err());
}

#[test]
fn plastic_schemes_refuse_restitution_and_say_why() {
    for (name, expressible) in [("moreau-jean", true), ("stewart-trinkle", false), ("anitescu", false)] {
        let answer = by_name(name).expect("listed").simulate(&short("bouncing-ball", 0.01, 2), 0.01, 1, &Options::new());
        match answer {
            Ok(_) => assert!(expressible, "{name}"),
            Err(Refusal::Unsupported(reason)) => assert!(!expressible && reason.contains("restitution"), "{name}: {reason}"),
            Err(Refusal::Errored(cause)) => panic!("{name}: {cause}"),
        }
    }
}

#[test]
fn steps_that_do_not_fit_the_duration_are_errors() {
    let mut engine = by_name("moreau-jean").expect("listed");
    for (h, every) in [(0.03, 1), (0.0, 1), (-0.01, 1), (f64::NAN, 1), (0.01, 0), (1e-12, 1)] {
        let answer = engine.simulate(&short("ball-drop", 0.01, 100), h, every, &Options::new());
        assert!(matches!(answer, Err(Refusal::Errored(_))), "h = {h}, every {every}");
    }
}

#[test]
fn the_same_question_gets_the_same_answer_bit_for_bit() {
    let run = || simulated(by_name("moreau-jean").expect("listed"), "box-stack", 0.01, 20, 1);
    assert_eq!(run(), run());
}

#[test]
fn problems_are_solved_for_the_laws_that_are_declared() {
    let mut engine = by_name("moreau-jean").expect("listed");
    let problem = |law| {
        ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).name("block").law(law).friction(vec![0.5]).build().unwrap()
    };
    let solution = engine.solve(&problem(ContactLaw::Coulomb), &Options::new()).expect("declared");
    assert!((solution.impulse - dvector![1.0, -0.5, 0.0]).amax() <= rounding(16, 1.0));
    let refused = engine.solve(&problem(ContactLaw::Coulomb), &options(json!({"solver": "lemke"})));
    assert!(matches!(refused, Err(Refusal::Unsupported(_))));
    // a law that the solver takes, in a problem that it refuses: hard, without mass
    let refused = engine.solve(&problem(ContactLaw::Associated), &options(json!({"solver": "newton"})));
    assert!(matches!(refused, Err(Refusal::Unsupported(_))), "{refused:?}");
    for law in engine.describe(&Options::new()).expect("none").laws {
        let law = match law.as_str() {
            "frictionless" => ContactLaw::Frictionless,
            "coulomb" => ContactLaw::Coulomb,
            "associated" => ContactLaw::Associated,
            "polyhedral-coulomb" => ContactLaw::PolyhedralCoulomb { directions: 8 },
            _ => ContactLaw::PolyhedralAssociated { directions: 8 },
        };
        engine.solve(&problem(law), &Options::new()).unwrap_or_else(|refusal| panic!("{law:?}: {refusal}"));
    }
}

#[test]
fn points_are_projected_and_bad_ones_are_errors() {
    let mut engine = by_name("moreau-jean").expect("listed");
    let mut project = |friction: f64, points: &[Vec<f64>]| engine.project(friction, points, &Options::new());
    // μ = 3/4 and (−1, 6, 8): r = (104, 46.8, 62.4)/25
    let projected = project(0.75, &[vec![-1.0, 6.0, 8.0]]).expect("a point");
    assert!(projected[0].iter().zip([4.16, 1.872, 2.496]).all(|(one, other)| (one - other).abs() <= rounding(16, 10.0)));
    assert!(project(-1.0, &[vec![1.0, 0.0]]).is_err() && project(f64::NAN, &[]).is_err() && project(0.5, &[vec![]]).is_err());
}

#[test]
fn every_part_can_be_exchanged_and_the_exchange_shows() {
    let base = || by_name("moreau-jean").expect("listed");
    let moved = |engine: OwnEngine| simulated(engine, "ball-drop", 1.0 / 64.0, 64, 1).bodies[0].position.clone();
    let plain = moved(base());
    let weightless = OwnEngine { mechanism: |scene| Scene { gravity: [0.0; 3], ..scene.clone() }.spatial_mechanism(), ..base() };
    let implicit = OwnEngine { scheme: |_| moreau_jean(&OwnParameters { theta: 1.0, ..OwnParameters::default() }), ..base() };
    assert!(moved(weightless) != plain && moved(implicit) != plain);
    let mut lazy = OwnEngine { project: |_, _| (), ..base() };
    assert_eq!(lazy.project(0.5, &[vec![-1.0, 1.0]], &Options::new()).expect("a point"), [vec![-1.0, 1.0]]);
}

#[test]
fn a_run_with_a_step_that_the_certificate_rejects_is_an_error_with_step_and_residual() {
    // one sweep carries a stack no better than a planted solver would
    let lazy = |certified: bool| OwnEngine {
        certified,
        solvers: Solvers::of(&[SolverEntry {
            name: "auto",
            default: || Box::new(ProjectedGaussSeidel { sweeps: 1, ..Default::default() }),
            limited: None,
        }]),
        ..by_name("moreau-jean").expect("listed")
    };
    let stack = short("box-stack", 1.0 / 60.0, 20);
    let refused = lazy(true).simulate(&stack, 1.0 / 60.0, 1, &Options::new()).expect_err("rejected").to_string();
    assert!(["certificate", "step ", "residual", "limit"].iter().all(|word| refused.contains(word)), "{refused}");
    // a planted engine is let through, so that the checks see its motion
    let trajectory = lazy(false).simulate(&stack, 1.0 / 60.0, 1, &Options::new()).expect("a motion");
    assert!(trajectory.steps.expect("certified").accepted.contains(&false));
}
