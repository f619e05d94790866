//! Stick and slide with μ within a fiftieth of the limit: a plate, and a ball, whose only contact shares its load with no other.
//!
//! ```text
//!     plate    μ = tan α (1 ± 1/50)               rest, or v_t + μ v_n = g (sin α − μ cos α) t
//!     ball     7/2 μ = tan α (1 − 1/50)           u = v − ωR :   u + 7/2 μ v_n = g (sin α − 7/2 μ cos α) t
//! ```

use crate::checks::incline::stick::either_side;
use crate::checks::limits::rim;
use crate::checks::limits::sloping::{MARGIN, MASS, RADIUS, ball_on_slope};
use crate::checks::motion::{Sample, Slope, samples};
use crate::checks::scenery::schedule;
use crate::description::Friction;
use crate::model::addition::Addition;
use crate::model::sliding::{SPHERE, hops};
use crate::model::{Model, RigidLimits, damping};
use crate::tolerance::{flight, incline, limits as tolerance};
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use moreau_contact::cones::polyhedral;
use moreau_dynamics::scenes::Scene;
use nalgebra::Vector3;

/// So flat that the loads of its corners differ by c/a tan α = 0.9 %, less than [`MARGIN`].
const PLATE: [f64; 3] = [0.4, 0.3, 0.01];
/// Duration of its motion \[s\].
const DURATION: f64 = 0.25;

pub(super) fn stick(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut measured = either_side(bench, h, MARGIN, PLATE)?;
    measured.push(ball(bench, h)?);
    measured.extend(rim::ball(bench, h)?);
    Ok(measured)
}

/// A ball on a slope of 20°, with too little friction to roll.
fn slipping(bench: &Bench, h: f64) -> Scene {
    ball_on_slope(bench, h, "ball about to roll", (1.0 - MARGIN) * 20f64.to_radians().tan() / SPHERE)
}

fn ball(bench: &mut Bench, h: f64) -> Reply<Measurement> {
    let scene = slipping(bench, h);
    let slope = Slope::of(&scene).ok_or_else(|| Refusal::errored("the scene has no plane"))?;
    let (steps, every) = schedule(DURATION, 8, h);
    let states = samples(&bench.simulate(&scene, h, steps, every)?.bodies[0]);
    let (end, time) = (states[states.len() - 1], steps as f64 * h);
    let full = SPHERE * scene.material.friction * slope.press;
    let slip = slip(&end, &slope) + SPHERE * scene.material.friction * end.velocity.dot(&slope.normal);
    let depth = states.iter().map(|state| (RADIUS - slope.height(&state.position)).abs()).fold(0.0, f64::max);
    let error = incline::momentum(slope.press) + tolerance::lever(full, depth, RADIUS);
    let exact = slope.pull - full;
    let ideal = Expectation::equal(exact, error, "g (sin α − 7/2 μ cos α), whatever the normal impulses");
    let law = law(bench, [slope.pull, full], h, time).map(|law| Expectation { tolerance: law.tolerance + error, ..law });
    let held = (Addition::StaticFriction.declared(bench.description()) * full >= slope.pull).then(|| {
        let rolling = slope.pull * (1.0 - 1.0 / SPHERE);
        let allowed = incline::momentum(slope.press) + tolerance::rim(rolling, depth, RADIUS);
        Expectation::equal(0.0, allowed, "the declared static friction holds it: it rolls")
    });
    Ok(Measurement::new("(u + 7/2 μ v_n)/T of a ball with 7/2 μ below tan α", "m/s^2", slip / time, ideal).predicted(held.or(law)))
}

/// Velocity of the ball's lowest point down the slope \[m/s\].
fn slip(state: &Sample, slope: &Slope) -> f64 {
    let lever: Vector3<f64> = slope.normal * -RADIUS;
    state.velocity_at(lever).dot(&slope.down)
}

/// (u + 7/2 μ v_n)/T \[m/s²\] under the declared law, where it is not g sin α − 7/2 μ g cos α = `pull` − `full`.
fn law(bench: &Bench, [pull, full]: [f64; 2], h: f64, time: f64) -> Option<Expectation> {
    let exact = pull - full;
    let between = |low: f64, high: f64, why: &str| Expectation::equal(0.5 * (low + high), 0.5 * (high - low), why);
    match Model::of(bench.description()) {
        _ if hops(bench.description()) => {
            Some(Expectation::at_least(exact, 0.0, "friction up to μ p_n: a landing may stop the slip with less"))
        }
        Model::Coulomb(limits) if limits.linear_damping + limits.angular_damping + limits.error_reduction > 0.0 => {
            let (value, error) = damped(&limits, [pull, full], h, time);
            // A push out of the slope is a normal impulse, whose friction may be more than what is left of the slip: it stops with less.
            let pushed = limits.error_reduction * full * h / time;
            let why = "g (sin α − 7/2 μ cos α) under the declared damping and error reduction";
            Some(between(value - error, value + error + pushed, why))
        }
        Model::StewartTrinkle { directions } => {
            Some(between(exact, exact + full * polyhedral::strength_error(directions), "friction between μ cos(π/d) and μ"))
        }
        Model::DrakeRegularised { stiction_tolerance, .. } => {
            let late = full * h / time + incline::unsaturated(full, stiction_tolerance, exact, time);
            Some(between(exact, exact + late, "friction saturates at most this much too late"))
        }
        Model::SpringDamper { stiffness, .. } => {
            // Friction grows with the spring along the slope, as stiff as that across it: x'' = pull − 7/2 k x/m lacks pull/ω of it.
            let late = pull / (SPHERE * stiffness / MASS).sqrt() / time;
            Some(between(exact, exact + late, "friction of a spring that is loaded first"))
        }
        _ if bench.description().friction == Friction::Pyramid => Some(between(0.0, exact, "a pyramid around the cone may hold the ball")),
        _ => None,
    }
}

/// Mean u̇ of v̇ = `pull` − 2/7 `full` − c v and (ωR)˙ = 5/7 `full` − c' ωR, with its error of first order. The slip u is concave in time
/// where damping slows the ball, so that it has ended, and the ball sticks, where this mean would be negative.
fn damped(limits: &RigidLimits, [pull, full]: [f64; 2], h: f64, time: f64) -> (f64, f64) {
    let driven = |rate: f64, acceleration: f64| {
        let (_, velocity) = damping::flight(rate, &Vector3::new(acceleration, 0.0, 0.0), &Vector3::zeros(), time);
        (velocity.x, flight::damped_velocity(rate, acceleration, acceleration * time, time, h))
    };
    let (moved, off) = driven(limits.linear_damping, pull - full / SPHERE);
    let (turned, turned_off) = driven(limits.angular_damping, full - full / SPHERE);
    (((moved - turned) / time).max(0.0), (off + turned_off) / time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge_declaring;
    use crate::runner::SWEEP;

    #[test]
    fn a_ball_whose_slip_the_declared_damping_ends_sticks() {
        let slowed = |rate: f64| damped(&RigidLimits { linear_damping: rate, ..Default::default() }, [3.355, 3.288], 1e-3, 0.5).0;
        assert!(slowed(0.01) > 0.0 && slowed(0.01) < 0.067, "slower, and still slipping");
        assert_eq!(slowed(1.0), 0.0);
    }

    /// The verdict on the ball whose friction is `factor` of what it should be.
    fn verdict(h: f64, factor: f64) -> Verdict {
        verdict_declaring(h, factor, &[])
    }

    fn verdict_declaring(h: f64, factor: f64, declared: &[(&str, f64, &str)]) -> Verdict {
        let measured = judge_declaring("limits/stick", h, declared, |scene, _, _, t| {
            let slope = Slope::of(scene).expect("a plane");
            let body = &scene.bodies[0];
            let friction = factor * scene.material.friction * slope.press;
            let start = Vector3::from(body.position);
            let velocity = slope.down * ((slope.pull - friction) * t);
            let place = start + slope.down * (0.5 * (slope.pull - friction) * t * t);
            let spin = slope.side * (2.5 * friction / RADIUS * t);
            (place.into(), body.orientation, velocity.into(), spin.into())
        });
        measured[2].verdict()
    }

    #[test]
    fn a_ball_that_declared_static_friction_holds_rolls_and_one_that_it_does_not_hold_slips() {
        let rolls = 1.0 / (1.0 - MARGIN);
        for h in SWEEP {
            let of = |factor: f64, declared: f64| verdict_declaring(h, factor, &[("static_friction", declared, "1")]);
            assert_eq!((of(rolls, 1.05), of(1.0, 1.05)), (Verdict::Difference, Verdict::Fail), "{h}");
            assert_eq!((of(rolls, 1.01), of(1.0, 1.01)), (Verdict::Fail, Verdict::Pass), "{h}");
        }
    }

    #[test]
    fn a_ball_that_slips_as_it_should_passes_and_one_with_a_hundredth_more_friction_or_that_rolls_fails() {
        for h in SWEEP {
            assert_eq!(verdict(h, 1.0), Verdict::Pass, "{h}");
            for factor in [0.99, 1.01, 1.0 / (1.0 - MARGIN)] {
                assert_eq!(verdict(h, factor), Verdict::Fail, "{factor} at {h}");
            }
        }
    }
}
