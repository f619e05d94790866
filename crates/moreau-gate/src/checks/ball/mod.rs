//! The bouncing ball, dropped from rest: Newton's v⁺ = −e v⁻ at every impact, and what follows from it.
//!
//! ```text
//!     speeds g t₁ eᵏ ,    apexes H e²ᵏ ,    rest from T∞ = t₁ (1+e)/(1−e) ,    gap ≥ 0 .
//! ```

mod bounce;
mod compliant;
mod scene;
mod settling;

use crate::check::{Control, Expected, Run};
use crate::{Check, Level};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "ball/restitution",
        level: Level::Simulate,
        question: "Does every impact of a dropped ball return e times its normal velocity?",
        derivation: "The velocities at the floor are those of the samples around the impact, carried to the floor by ballistics, at most \
            over \
                     one sample: exact for the exact motion. A step that reverses the velocity may leave out or add the gravity of a step \
                     before and after: each velocity is off by at most g (s + 2h), s the time between samples.",
        source: "Newton's impact law; chapter §0",
        run: Run::EachStep(bounce::restitution),
        control: Control { passes: "moreau-jean", fails: "ball/restitution-lost-at-large-steps" },
    },
    Check {
        name: "ball/energy",
        level: Level::Simulate,
        question: "Is the apex after a bounce e² of the apex before, and never higher if e = 1?",
        derivation: "Apex heights are gap + v²/2g at the slowest sample. A bounce keeps e² of ½v² to first order. An elastic bounce has no \
                     energy to give: a θ-scheme keeps E − (θ−½) g h v through flight and impact, which at an apex is E to ¼ g² h s.",
        source: "closed form of the elastic ball; E − (θ−½) m g h v is invariant for every θ",
        run: Run::EachStep(bounce::energy),
        control: Control { passes: "moreau-jean", fails: "ball/restitution-of-the-free-velocity" },
    },
    Check {
        name: "ball/zeno",
        level: Level::Simulate,
        question: "Does the ball come to rest after infinitely many bounces, at the time that the theory gives?",
        derivation: "T∞ = t₁ (1+e)/(1−e). Event capturing may absorb the ball O(log 1/h) steps early and a bounded number of steps late, \
            both \
                     proved for the rules A, B and D and θ from ½ to 1; the widest of these is allowed. Where every step is a sample, the \
                     number n of bounces is seen, and the ball is at most n ((1+e) Δ + 4) steps late, Δ the excess of a speed over the \
                     exact one.",
        source: "chapter §0, the Zeno example",
        run: Run::EachStep(settling::zeno),
        control: Control { passes: "moreau-jean", fails: "ball/asleep-at-the-apex" },
    },
    Check {
        name: "ball/penetration",
        level: Level::Simulate,
        question: "How deep does the ball get at its impact, and where does it rest?",
        derivation: "An impact is noticed at most one step late, at a depth of (v + g h) h. A trapezoidal update goes on for half a \
            step, which makes 3/2 (v + g h) h. The ball rests within 3 g h² of the floor; without restitution no \
            speed is left to bring it out, and it may rest as deep as its impact went. The depth of a compliant law is that of its \
            replayed discrete map.",
        source: "the activation rules of Moreau–Jean; the engines' documented force laws",
        run: Run::EachStep(settling::penetration),
        control: Control { passes: "moreau-jean", fails: "ball/contacts-every-fourth-step" },
    },
    Check {
        name: "ball/effective-restitution",
        level: Level::Simulate,
        question: "Which part of its speed does a ball without restitution keep?",
        derivation: "e = 0 leaves no velocity, up to the gravity of the steps around the impact. A compliant law rebounds with an \
            effective e, \
                     which is replayed step by step; as h → 0 a spring with damping ratio ζ gives exp(−ζ/√(1−ζ²)·acos(2ζ²−1)).",
        source: "MuJoCo's documentation, solver parameters; Drake's SAP and Hunt–Crossley models",
        run: Run::EachStep(compliant::effective_restitution),
        control: Control { passes: "moreau-jean", fails: "ball/baumgarte-velocity-kept" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected::without_restitution("stewart-trinkle", "ball/restitution"),
    Expected::without_restitution("stewart-trinkle", "ball/energy"),
    Expected::without_restitution("stewart-trinkle", "ball/zeno"),
    Expected::without_restitution("anitescu", "ball/restitution"),
    Expected::without_restitution("anitescu", "ball/energy"),
    Expected::without_restitution("anitescu", "ball/zeno"),
];

#[cfg(test)]
mod tests {
    use super::scene::RADIUS;
    use super::*;
    use crate::exact::{RigidState, judge};
    use crate::runner::{QUICK, SWEEP};
    use crate::{Measurement, Verdict};
    use moreau_dynamics::scenes::Scene;
    use moreau_forms::BouncingBall;

    /// The exact ball of the scene, with another restitution.
    fn exact(scene: &Scene, restitution: f64, t: f64) -> RigidState {
        let height = scene.bodies[0].position[2] - RADIUS;
        let (gap, velocity) = BouncingBall::new(-scene.gravity[2], height, restitution).expect("valid").state(t);
        ([0.0, 0.0, RADIUS + gap], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, velocity], [0.0; 3])
    }

    fn verdict(measured: &[Measurement]) -> Verdict {
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_exact_ball_passes_at_every_step_and_to_rounding_in_restitution() {
        for h in SWEEP {
            for check in CHECKS {
                let measured = judge(check.name, h, |scene, _, _, t| exact(scene, scene.material.restitution, t));
                assert_eq!(verdict(&measured), Verdict::Pass, "{} at {h}: {measured:?}", check.name);
                if check.name == "ball/restitution" {
                    // One sample before and one after each impact, both exact: only the square root cancels.
                    assert!(measured.iter().all(|one| one.ideal.miss(one.value) <= 1e-9), "{measured:?}");
                }
            }
        }
    }

    #[test]
    fn a_ball_that_squares_or_loses_its_restitution_fails_at_every_quick_step() {
        for h in QUICK {
            for (check, wrong) in [("ball/restitution", 0.0), ("ball/energy", 0.0), ("ball/zeno", 0.0)] {
                let measured = judge(check, h, |scene, _, _, t| exact(scene, wrong, t));
                assert_eq!(verdict(&measured), Verdict::Fail, "{check} at {h}: {measured:?}");
            }
            for check in ["ball/restitution", "ball/energy"] {
                let measured = judge(check, h, |scene, _, _, t| exact(scene, scene.material.restitution.powi(2), t));
                assert_eq!(verdict(&measured), Verdict::Fail, "{check} at {h}: {measured:?}");
            }
        }
    }

    #[test]
    fn a_rebound_and_a_deep_impact_fail_where_none_is_declared() {
        for h in QUICK {
            let bouncing = judge("ball/effective-restitution", h, |scene, _, _, t| exact(scene, 0.3, t));
            assert_eq!(verdict(&bouncing), Verdict::Fail, "{h}: {bouncing:?}");
            let deep = judge("ball/penetration", h, |scene, _, h, t| {
                let (mut position, q, v, w) = exact(scene, scene.material.restitution, t);
                position[2] -= 5.0 * h * h * 9.81;
                (position, q, v, w)
            });
            assert_eq!(verdict(&deep), Verdict::Fail, "{h}: {deep:?}");
        }
    }
}
