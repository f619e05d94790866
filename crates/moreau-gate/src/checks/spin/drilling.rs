//! A ball that spins upright on the floor. It does not slide: in a step, an engine that adds torques in the body frame turns those of
//! sliding friction with the spin, and so the axis.

use crate::checks::motion::{Sample, start_gap};
use crate::checks::scenery::{GRAVITY, over_floor, schedule, sphere};
use crate::model::Model;
use crate::model::addition::Addition;
use crate::tolerance::{flight, spin as tolerance};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::Body;

/// Duration \[s\].
const DURATION: f64 = 0.5;
const RADIUS: f64 = 0.1;
const FRICTION: f64 = 0.5;
/// Spin about the normal \[rad/s\]. A ball with as much friction as its radius long would lose it in 0.17 s.
const SPIN: f64 = 20.0;

pub(super) fn drilling(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction, Addition::RollingFriction]);
    let torsion = Addition::TorsionalFriction.declared(bench.description());
    if torsion > 0.0 {
        bench.without_damping()?;
    }
    let gap = start_gap(bench, h, (1.0, 1.0), GRAVITY, FRICTION, 0.0);
    let ball = sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS + gap]);
    let scene = over_floor("ball that spins upright", vec![Body { angular_velocity: [0.0, 0.0, SPIN], ..ball }], FRICTION);
    let (steps, _) = schedule(DURATION, 1, h);
    let time = steps as f64 * h;
    let end = Sample::of(&bench.simulate(&scene, h, steps, steps)?.bodies[0], 1);
    // Friction of at most μ m g for the whole time at the lever R, over J ω with J = ⅖ m R².
    let turns = FRICTION * GRAVITY * time / (0.4 * RADIUS * SPIN);
    let allowed = flight::turning(steps, bench.epsilon()) + tolerance::lever(bench.epsilon(), turns);
    let damped = Model::of(bench.description()).damping().filter(|(_, angular)| *angular > 0.0);
    let model = damped.map(|(_, rate)| {
        let allowed = allowed + flight::damped_velocity(rate, 0.0, 1.0, time, h);
        Expectation::equal(-(-rate * time).exp_m1(), allowed, "the declared damping")
    });
    // J ω̇ = −a m g with J = ⅖ m R²
    let drilled = (torsion > 0.0).then(|| {
        let lost = (torsion * GRAVITY * time / (0.4 * RADIUS * RADIUS * SPIN)).min(1.0);
        Expectation::equal(lost, allowed + tolerance::torsion(lost), "the declared torsional friction")
    });
    let ideal = Expectation::equal(0.0, allowed, "a point has no friction against drilling");
    Ok(vec![Measurement::new("part of the upright spin that is lost", "1", (SPIN - end.spin.z) / SPIN, ideal).predicted(model.or(drilled))])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;

    #[test]
    fn a_ball_that_keeps_its_spin_passes_and_one_with_a_length_of_friction_fails() {
        for h in SWEEP {
            // ω̇ = −μ g a/(⅖ R²) with a length a of a ten-thousandth of the radius
            for (length, expected) in [(0.0, Verdict::Pass), (1e-4 * RADIUS, Verdict::Fail)] {
                let rate = FRICTION * GRAVITY * length / (0.4 * RADIUS * RADIUS);
                let measured = judge("spin/drilling", h, |scene, _, _, t| {
                    let body = &scene.bodies[0];
                    (body.position, [1.0, 0.0, 0.0, 0.0], body.linear_velocity, [0.0, 0.0, SPIN - rate * t])
                });
                assert!(measured[0].verdict() == expected, "{h}: {measured:?}");
            }
        }
    }
}
