//! Free flight, the bouncing ball, impacts and rest.

use super::{controls_pass_and_fail, judge, mistakes_are_caught, schemes_have_their_derived_verdicts};
use moreau::gate::runner::{QUICK, run};
use moreau::gate::{Options, Plan, Verdict, check, planted};

macro_rules! family {
    ($($test:ident: $name:literal;)*) => {$(
        mod $test {
            #[test]
            fn every_scheme_has_its_derived_verdict() {
                super::schemes_have_their_derived_verdicts($name);
            }

            #[test]
            fn every_check_can_pass_and_fail() {
                super::controls_pass_and_fail($name);
            }

            #[test]
            fn every_planted_mistake_is_caught_by_name() {
                super::mistakes_are_caught(&[$name]);
            }
        }
    )*};
}

family! {
    flight: "flight";
    ball: "ball";
    impact: "impact";
    rest: "rest";
}

#[test]
fn restitution_lost_at_large_steps_is_caught_by_the_sweep_and_missed_by_its_smallest_step() {
    let mistake = planted::find("ball/restitution-lost-at-large-steps").expect("planted");
    let checks = vec![check::find("ball/restitution").expect("registered")];
    assert_eq!(judge(&mistake.engine, checks.clone())[0].fails_at, QUICK[..2]);
    let smallest = Plan { checks, sweep: vec![QUICK[2]], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    assert_eq!(run(&mistake.engine, &smallest).expect("it describes itself").checks[0].verdict, Verdict::Pass);
}
