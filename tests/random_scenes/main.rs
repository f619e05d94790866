//! Random scenes: no panic, no number that is not finite, the energy balance of every scheme at every step, and no body beyond the reach of its energy.

mod motion;
mod numbers;
mod report;
mod scenario;

use motion::CAUGHT;
use moreau::schemes;
use rayon::prelude::*;
use report::Report;
use scenario::Scenario;

/// Scenes of the default run.
const SCENES: u64 = 60;

/// Panics that are caught are told by the report alone.
fn quiet() {
    let loud = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if !CAUGHT.get() {
            loud(info);
        }
    }));
}

#[test]
fn random_scenes_keep_their_energy_balance_under_every_scheme() {
    quiet();
    let first: u64 = std::env::var("RS_FIRST").ok().and_then(|x| x.parse().ok()).unwrap_or(0);
    let started = std::time::Instant::now();
    let all = || (first..first+SCENES).into_par_iter();
    let runs = all().map(|seed| {
        let scenario = Scenario::new(seed);
        let one = |name: &&'static str| (*name, { let t = std::time::Instant::now(); let o = motion::run(name, &scenario); (o, t.elapsed().as_secs_f64()) });
        (scenario.seed, schemes::NAMES.iter().map(one).collect::<Vec<_>>())
    });
    let runs: Vec<_> = runs.collect();
    let mut report = Report::default();
    let mut times: std::collections::BTreeMap<&str, f64> = Default::default();
    for (seed, outcomes) in runs {
        for (name, (outcome, t)) in outcomes {
            *times.entry(name).or_default() += t;
            if t > 1.0 { println!("slow {name} {seed} {t:.2} s, {} steps", outcome.steps); }
            report.add(name, seed, &outcome);
        }
    }
    println!("{times:?}");
    println!("{report}\n{:.1} s", started.elapsed().as_secs_f64());
    let failures = report.failures();
    assert!(failures.is_empty(), "{} failures", failures.len());
}
