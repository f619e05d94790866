//! Bodies that have rested for longer than engines wait before they let bodies sleep, and are hit; and one that moves slowly all the time.
//!
//! ```text
//!     without friction, on a floor or in space:    Σ m v_x stays ,    p = m̄ |u| (1 + e) ,  e = 0
//!     slow and free:                               v , ω stay
//! ```

use crate::checks::motion::{CLEARANCE, Sample, start_gap};
use crate::checks::pair::compliant::{self, Approach, restitution};
use crate::checks::pair::meeting::{DURATION, GAP, SPEED, in_space, undamped};
use crate::checks::scenery::{GRAVITY, over_floor, schedule, sphere};
use crate::tolerance::{flight, impact, incline};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;

/// How long a body rests before it is hit \[s\]: engines put to sleep what was slow for 0.5 to 2 s.
const REST: f64 = 2.1;
const RADIUS: f64 = 0.5;
/// Of all bodies \[kg\].
const MASS: f64 = 1.0;
/// \[m/s\] and \[rad/s\]: slower than what engines take for rest.
const SLOW: f64 = 0.01;

/// One ball that rests, and one that comes along x, with their centres at this height \[m\].
fn visited(height: f64) -> [Body; 2] {
    let far = 2.0 * RADIUS + GAP + SPEED * REST;
    let visitor = Body { linear_velocity: [SPEED, 0.0, 0.0], ..sphere("visitor", MASS, RADIUS, [-far, 0.0, height]) };
    [sphere("resting", MASS, RADIUS, [0.0, 0.0, height]), visitor]
}

fn free() -> Scene {
    let [resting, visitor] = visited(0.0);
    let slow =
        Body { linear_velocity: [0.0, SLOW, 0.0], angular_velocity: [SLOW, 0.0, 0.0], ..sphere("slow", MASS, RADIUS, [0.0, 10.0, 0.0]) };
    in_space("woken in space", vec![resting, visitor, slow], 0.0, 0.0)
}

/// As deep as they lie, by declaration.
fn on_the_floor(bench: &Bench, h: f64) -> Scene {
    let gap = start_gap(bench, h, (MASS, 1.0), GRAVITY, 0.0, 0.0);
    over_floor("woken on the floor", visited(RADIUS + gap + CLEARANCE).into(), 0.0)
}

pub(super) fn woken(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let (steps, _) = schedule(REST + DURATION, 1, h);
    let motion = bench.simulate(&free(), h, steps, steps)?;
    let ends = |motion: &moreau_dynamics::trajectory::Trajectory, body: usize| Sample::of(&motion.bodies[body], 1);
    let mut measured = hit(bench, h, ", in space", [0, 1].map(|body| ends(&motion, body).velocity.x), 0.0);
    let slow = ends(&motion, 2);
    let lost = (slow.velocity - Vector3::y() * SLOW).norm().max((slow.spin - Vector3::x() * SLOW).norm()) / SLOW;
    let kept = Expectation::at_most(0.0, flight::turning(steps, bench.epsilon()), "no force and no torque");
    measured.push(Measurement::new("change of a slow body's velocities over themselves", "1", lost, kept));
    let motion = bench.simulate(&on_the_floor(bench, h), h, steps, steps)?;
    let solved = incline::momentum(GRAVITY) * steps as f64 * h / SPEED;
    measured.extend(hit(bench, h, ", on the floor", [0, 1].map(|body| ends(&motion, body).velocity.x), solved));
    // the one place where bodies may sleep that rest: what is hit must wake
    if let Some(motion) = bench.simulate_sleeping(&on_the_floor(bench, h), h, steps, steps)? {
        measured.extend(hit(bench, h, ", on the floor, asleep", [0, 1].map(|body| ends(&motion, body).velocity.x), solved));
    }
    Ok(measured)
}

/// Velocities along x of the body that rested and of the one that came; a part `solved` of them may come from the floor.
fn hit(bench: &Bench, h: f64, words: &str, [woken, visitor]: [f64; 2], solved: f64) -> Vec<Measurement> {
    let allowed = (impact::velocity(bench.epsilon()) + solved) * MASS * SPEED;
    let change = (MASS * (woken + visitor - SPEED)).abs();
    let kept = Expectation::at_most(0.0, allowed, "the impulses of the impact are opposite, and nothing else acts along the floor");
    let mut measured = vec![Measurement::new(format!("change of momentum{words}"), "kg*m/s", change, kept)];
    let approach = Approach { gap: GAP + SPEED * REST, speed: SPEED, steps: schedule(REST + DURATION, 1, h).0 };
    let contact = compliant::balls(bench, [(MASS, RADIUS); 2], h);
    measured.extend(restitution(bench, h, (words, 0.0), 2.0 * woken / SPEED - 1.0, 2.0 * solved, 0.0, (&contact, approach)));
    measured
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;

    /// Both go on together, but what rested gets a part `woken` of its velocity only, what came a part `came`, and what is slow keeps a
    /// part `kept` of its own.
    fn verdict(h: f64, [woken, came]: [f64; 2], kept: f64) -> Verdict {
        let measured = judge("pair/woken", h, |scene, index, _, t| {
            let body = &scene.bodies[index];
            let hit = t >= REST + GAP / SPEED;
            let factor = if index == 0 { woken } else { came };
            let velocity = match (index, hit) {
                (2, _) => [0.0, if t > 0.0 { kept * SLOW } else { SLOW }, 0.0],
                (_, true) => [factor * 0.5 * SPEED, 0.0, 0.0],
                _ => body.linear_velocity,
            };
            (body.position, body.orientation, velocity, body.angular_velocity)
        });
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn what_is_hit_moves_on_and_what_sleeps_or_loses_a_thousandth_fails() {
        for h in SWEEP {
            assert_eq!(verdict(h, [1.0; 2], 1.0), Verdict::Pass, "{h}");
            // the third loses momentum, which the restitution of what rested does not see
            for (hit, kept) in [([0.0, 1.0], 1.0), ([0.99, 1.0], 1.0), ([1.0, 0.9], 1.0), ([1.0, 1.0], 0.0), ([1.0, 1.0], 0.999)] {
                assert_eq!(verdict(h, hit, kept), Verdict::Fail, "{hit:?}, {kept} at {h}");
            }
        }
    }
}
