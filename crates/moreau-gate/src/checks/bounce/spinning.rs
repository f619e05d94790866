//! A spinning ball that bounces with friction, slipping and sticking.

use crate::checks::bounce::declared::Declared;
use crate::checks::bounce::scene::{GAP, RESTITUTION, SPEED, steps_to_impact, weightless};
use crate::checks::motion::Sample;
use crate::checks::scenery::{between, sphere};
use crate::description::Friction;
use crate::model::addition::Addition;
use crate::tolerance::bounce as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use std::f64::consts::SQRT_2;

/// \[kg\]
const MASS: f64 = 1.0;
/// \[m\]; large against the way of a step.
pub(super) const RADIUS: f64 = 2.0;
/// μ.
const FRICTION: f64 = 0.3;
/// Speed along x \[m/s\].
const ALONG: f64 = 3.0;
/// Spins about y before the bounce \[rad/s\]: at −2 the contact point slips with 7 m/s and to the end, at 0.45 with 2.1 m/s and is stopped.
pub(super) const SPINS: [(&str, f64); 2] = [(", slipping", -2.0), (", sticking", 0.45)];

/// What an impact law has to go on.
#[derive(Clone, Copy)]
pub(super) struct Contact {
    /// e.
    pub restitution: f64,
    /// μ along x.
    pub friction: f64,
    /// ℓ \[m\].
    pub lever: f64,
    /// κ: the part of e with which the tangential velocity comes back where the contact sticks.
    pub tangential: f64,
}

impl Contact {
    /// Velocity along x and up \[m/s\] and spin about y \[rad/s\] after the impact.
    pub fn after(self, spin: f64) -> [f64; 3] {
        let inertia = 0.4 * MASS * RADIUS * RADIUS;
        let pressed = (1.0 + self.restitution) * MASS * SPEED;
        let stopping =
            (1.0 + self.tangential * self.restitution) * (ALONG - spin * self.lever) / (1.0 / MASS + self.lever * self.lever / inertia);
        let impulse = stopping.min(self.friction * pressed);
        [ALONG - impulse / MASS, self.restitution * SPEED, spin + self.lever * impulse / inertia]
    }
}

/// What is measured of the velocities after the impact: speed along x, spin, angle of the flight off the normal.
fn quantities([along, up, spin]: [f64; 3]) -> [f64; 3] {
    [along, spin, along.atan2(up)]
}

/// Ranges of these over all combinations of the ends of the ranges of e, μ and ℓ.
fn ranges(spin: f64, restitution: [f64; 2], friction: [f64; 2], lever: [f64; 2], tangential: f64) -> [[f64; 2]; 3] {
    let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
    for (restitution, friction) in restitution.into_iter().flat_map(|e| friction.map(|mu| (e, mu))) {
        for lever in lever {
            for (range, value) in ranges.iter_mut().zip(quantities(Contact { restitution, friction, lever, tangential }.after(spin))) {
                *range = [range[0].min(value), range[1].max(value)];
            }
        }
    }
    ranges
}

/// The ball before its bounce.
pub(super) fn ball(spin: f64) -> Body {
    let at_rest = sphere("ball", MASS, RADIUS, [0.0, 0.0, RADIUS + GAP]);
    Body { linear_velocity: [ALONG, 0.0, -SPEED], angular_velocity: [0.0, spin, 0.0], ..at_rest }
}

pub(super) fn spinning(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    spinning_over(bench, h, |scene| scene)
}

/// The same with what `surface` makes of the floor.
pub(in crate::checks) fn spinning_over(bench: &mut Bench, h: f64, surface: fn(Scene) -> Scene) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TangentialRestitution]);
    let mut measured = Vec::new();
    for (words, spin) in SPINS {
        let steps = steps_to_impact(bench, GAP, SPEED, h)?;
        let motion = bench.simulate(&surface(weightless("spinning ball", ball(spin), FRICTION)), h, steps, steps)?;
        let end = Sample::of(&motion.bodies[0], 1);
        measured.extend(judged(bench, words, spin, &end, steps as f64 * h, h));
    }
    Ok(measured)
}

fn judged(bench: &Bench, words: &str, spin: f64, end: &Sample, time: f64, h: f64) -> Vec<Measurement> {
    let part = tolerance::solved(bench.epsilon());
    let declared = Declared::of(bench, SPEED, time, h);
    let away = tolerance::away(SPEED, h);
    let lever = [RADIUS - away, RADIUS + away];
    let newton = Expectation::equal(RESTITUTION, 2.0 * part, "e acts on the normal velocity");
    let rebound = Measurement::new(format!("normal speed after over before{words}"), "1", end.velocity.z / SPEED, newton);
    let ideal = ranges(spin, [RESTITUTION; 2], [FRICTION; 2], lever, 0.0);
    // a pyramid's friction along x lies between that of an inscribed and of a circumscribed square
    let pyramid = bench.description().friction == Friction::Pyramid;
    let tangential = Addition::TangentialRestitution.declared(bench.description());
    let law = (declared.is_some() || pyramid || tangential != 0.0).then(|| {
        let friction = if pyramid { [FRICTION / SQRT_2, FRICTION * SQRT_2] } else { [FRICTION; 2] };
        ranges(spin, declared.as_ref().map_or([RESTITUTION; 2], |law| law.restitution), friction, lever, tangential)
    });
    let drag = declared.as_ref().map_or(0.0, |law| law.drag);
    let measured = quantities([end.velocity.x, end.velocity.z, end.spin.y]);
    // speeds that are added up, and what an error of one of them turns the flight by
    let [speed, turned] = [ALONG + spin.abs() * RADIUS + (1.0 + RESTITUTION) * SPEED, end.velocity.norm()];
    let sizes = [speed, speed / RADIUS, speed / turned];
    let named = [("speed along the floor", "m/s"), ("spin", "rad/s"), ("angle of the flight off the normal", "rad")];
    let mut all = vec![rebound.predicted(declared.map(|law| law.rebound(2.0 * part)))];
    for (index, (name, unit)) in named.into_iter().enumerate() {
        let why = "p_t = min(μ p_n, u_t/W_tt) at the lever the contact may have";
        let expected = between(ideal[index], 2.0 * part * sizes[index], why);
        let model = law.map(|law| {
            between(law[index], (2.0 * part + drag) * sizes[index], "the same with the declared law's e, cone and tangential restitution")
        });
        all.push(Measurement::new(format!("{name}{words}"), unit, measured[index], expected).predicted(model));
    }
    all
}
