//! What a sweep of time steps sees and a single step does not.

use super::{judge, time_steps};
use moreau::gate::runner::{QUICK, run};
use moreau::gate::{Options, Plan, Verdict, checks, planted};

#[test]
fn restitution_lost_at_large_steps_is_caught_by_the_sweep_and_missed_by_its_smallest_step() {
    let mistake = planted::find("ball/restitution-lost-at-large-steps").expect("planted");
    let checks = vec![checks::find("ball/restitution").expect("registered")];
    let large: Vec<f64> = time_steps().into_iter().filter(|h| *h > QUICK[2]).collect();
    assert_eq!(judge(&mistake.subject.engine, checks.clone())[0].fails_at, large);
    let smallest = Plan { checks, sweep: vec![QUICK[2]], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    assert_eq!(run(&mistake.subject.engine, &smallest).expect("it describes itself").checks[0].verdict, Verdict::Pass);
}

#[test]
fn slow_growth_of_a_free_spin_is_caught_by_the_whole_sweep_and_missed_by_the_quick_one() {
    let mistake = planted::find("spin/slow-growth").expect("planted");
    let checks = vec![checks::find("spin/gyroscopic").expect("registered")];
    let quick = Plan { checks: checks.clone(), sweep: QUICK.to_vec(), options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    assert_eq!(run(&mistake.subject.engine, &quick).expect("it describes itself").checks[0].verdict, Verdict::Pass);
    let outcome = planted::judge(mistake, &checks).expect("it describes itself").checks.remove(0);
    assert_eq!(outcome.fails_at, [0.003]);
    let grown = |quantity: &str| quantity.starts_with("largest growth") && quantity.ends_with("turns");
    let failing = outcome.steps.iter().flat_map(|step| &step.measurements).filter(|one| one.verdict() == Verdict::Fail);
    assert!(failing.map(|one| one.quantity.as_str()).all(grown));
}
