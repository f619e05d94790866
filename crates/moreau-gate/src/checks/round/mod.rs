//! Capsules and cylinders: rolling, standing, struck.
//!
//! ```text
//!     cylinder, lying       I = ½ m R²                      v̇ = 2/3 g sin α
//!     capsule, lying        I = ½ m_c R² + 2/5 m_s R²       v̇ = g sin α /(1 + I/(m R²)) ,   m_s/m = 2R/(3l + 2R) ,  m_c = m − m_s
//!     struck at d along     1/M + 1/m + d²/J = W_n          p = (1 + e) v/W_n ,   ω = d p/J across the axis
//!     standing              0 = m g + Σ r_n/h               nothing moves
//! ```

mod crossed;

use crate::check::{Control, Expected, Run};
use crate::checks::motion::{Sample, yields};
use crate::checks::pair::compliant::{self, Approach, restitution};
use crate::checks::pair::meeting::{DURATION, GAP, Meeting, SPEED, in_space, undamped};
use crate::checks::rest::taken_back;
use crate::checks::rolling::{self, RADIUS};
use crate::checks::scenery::{GRAVITY, angle_between, over_floor, sphere};
use crate::description::Kind;
use crate::model::solid::{capsule_moments, cylinder_moments};
use crate::tolerance::stack::sway;
use crate::tolerance::{pair, rest as tolerance};
use crate::{Bench, Check, Expectation, Level, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;
use std::f64::consts::FRAC_1_SQRT_2;

/// l \[m\] of the bodies that roll and stand.
const HALF_HEIGHT: f64 = 0.15;
/// Of the struck body \[m\], large against the motion of a step, and where it is struck beside its middle.
const LARGE: [f64; 2] = [2.0, 4.0];
const BESIDE: f64 = 3.0;
/// Of the sphere and of the body it strikes \[kg\].
const MASSES: [f64; 2] = [1.0, 2.0];
/// Steps of the cylinder that stands; an odd number apart from sample to sample.
const STEPS: usize = 301;
const EVERY: usize = 7;

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "round/cylinder-incline",
        level: Level::Simulate,
        question: "Does a cylinder roll down a 20° slope with 2/3 g sin α?",
        derivation: "The same as rolling/incline with I = ½ m R²: v̇ = g sin α/(1 + ½). Its line of contact may be any points: they \
            have one lever. Sticking needs 1/3 tan α ≤ μ, here 0.12 < 0.5.",
        source: "Newton–Euler: a = g sin α/(1 + I/mR²)",
        run: Run::EachStep(cylinder_rolls),
        control: Control { passes: "moreau-jean", fails: "round/hollow" },
    },
    Check {
        name: "round/capsule-incline",
        level: Level::Simulate,
        question: "Does a capsule roll down a 20° slope as its inertia says?",
        derivation: "The same as rolling/incline with the inertia of a cylinder and two half balls of one density: I/(m R²) = ½ − \
            m_s/(10 m), m_s/m = 2R/(3l + 2R) the part of the balls. Its line of contact has one lever.",
        source: "Newton–Euler: a = g sin α/(1 + I/mR²)",
        run: Run::EachStep(capsule_rolls),
        control: Control { passes: "moreau-jean", fails: "round/hollow" },
    },
    Check {
        name: "round/standing",
        level: Level::Simulate,
        question: "Does a cylinder that stands on its face stay where it is, still and upright?",
        derivation: "A body at rest stays at rest: velocities are 0 up to rounding and to the solver, which may leave a part √2⁻²³ of the \
            impulse m g h of each step, as everywhere in the gate; so is what it turns by. Which points of the rim carry it is open: \
            where a compliant law would rest is not predicted. Points whose depth is taken back by declaration open, fall for a step and \
            are pushed out, as in rest/drift and rest/jitter.",
        source: "equilibrium of Coulomb–Signorini contact",
        run: Run::EachStep(standing),
        control: Control { passes: "moreau-jean", fails: "round/one-point" },
    },
    Check {
        name: "round/struck",
        level: Level::Simulate,
        question: "What do a capsule and a cylinder in space have after a sphere has struck them beside their middle?",
        derivation: "Without friction the impulse is along the normal, across the axis: p = (1 + e) v/W_n with W_n = 1/M + 1/m + d²/J. It \
            acts at the lever d, so that L = d p; momentum and angular momentum of both bodies are kept. J across the axis is m (R²/4 + \
            l²/3) of the cylinder, and m_c (R²/4 + l²/3) + m_s (2/5 R² + l² + 3/4 l R) of the capsule. No gravity: no number depends on h.",
        source: "closed form of an eccentric impact without friction; Newton's law",
        run: Run::EachStep(struck),
        control: Control { passes: "moreau-jean", fails: "round/height-for-half" },
    },
    Check {
        name: "round/crossed",
        level: Level::Simulate,
        question: "Do two rods that lie across each other, capsules and cylinders, push and turn each other where they cross?",
        derivation: "Without friction the impulse is along the common normal of both axes: W_n = Σ 1/m + a²/J with the arms a from their \
            middles to where they cross, W_n p = (1 + e)|u_n|, L = l × p. The axes are at right angles, so that the place is the same at \
            every distance; contacts that last roll on both curves and press later. The scene is turned. A pair of shapes that the engine \
            does not know is left out.",
        source: "closed form of the impact at one point",
        run: Run::EachStep(crossed::crossed),
        control: Control { passes: "moreau-jean", fails: "round/sides-pass-through" },
    },
];

/// The derived verdicts that are not `pass`: none. Without a coefficient of restitution the impact is the plastic one.
pub const EXPECTED: &[Expected] = &[];

/// The axis along y.
fn lying(body: Body) -> Body {
    Body { orientation: [FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0, 0.0], ..body }
}

fn cylinder_rolls(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let body = lying(Body::cylinder("cylinder", 1.0, RADIUS, HALF_HEIGHT, [0.0; 3]));
    Ok(vec![rolling::rolls_down(bench, h, &body, (0.5, 2.0), "2/3 g sin α, with the lever of the contact")?])
}

fn capsule_rolls(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let body = lying(Body::capsule("capsule", 1.0, RADIUS, HALF_HEIGHT, [0.0; 3]));
    let gyration = capsule_moments(1.0, [RADIUS, HALF_HEIGHT]).z / (RADIUS * RADIUS);
    Ok(vec![rolling::rolls_down(bench, h, &body, (gyration, 2.0), "g sin α/(1 + I/mR²), with the lever of the contact")?])
}

fn standing(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    if yields(bench) {
        return Err(Refusal::unsupported(
            "contacts yield by declaration: where they are on a face, and so the depth at rest, is not known",
        ));
    }
    let inside = tolerance::settled(STEPS, RADIUS, GRAVITY, h, bench.epsilon());
    let body = Body::cylinder("cylinder", 1.0, RADIUS, HALF_HEIGHT, [0.0, 0.0, HALF_HEIGHT - inside]);
    let motion = bench.simulate(&over_floor("standing cylinder", vec![body], 0.5), h, STEPS, EVERY)?;
    let track = &motion.bodies[0];
    let last = track.position.len() - 1;
    let [start, end] = [0, last].map(|k| Sample::of(track, k));
    let moved = (end.position - start.position).xy().norm();
    let allowed = tolerance::drift(STEPS, RADIUS, GRAVITY, h, bench.epsilon());
    let late = last / 2..=last;
    let count = late.clone().count() as f64;
    let square = |k: usize| {
        let state = Sample::of(track, k);
        state.velocity.norm_squared() + (state.spin * (0.5 * RADIUS)).norm_squared()
    };
    let speed = (late.map(square).sum::<f64>() / count).sqrt();
    let turned = angle_between(track.orientation[0], track.orientation[last]);
    let [slow, small] = [tolerance::velocity(GRAVITY, h), allowed / (0.5 * RADIUS)];
    // three points or more carry the end, whose base is as wide as the radius at least
    let swayed = taken_back(bench).map(|part| sway(part, 2.0 * HALF_HEIGHT, RADIUS, GRAVITY, h, STEPS));
    let opened = |most: Option<f64>, allowed: f64| {
        most.map(|most| Expectation::at_most(most, allowed, "points whose depth is taken back open and fall"))
    };
    let still = |allowed: f64| Expectation::at_most(0.0, allowed, "at rest");
    Ok(vec![
        Measurement::new("drift of the cylinder", "m", moved, still(allowed)).predicted(opened(swayed, allowed)),
        Measurement::new("mean speed of the cylinder", "m/s", speed, still(slow))
            .predicted(opened(swayed.map(|_| tolerance::pushed_velocity(GRAVITY, h)), slow)),
        Measurement::new("turn of the cylinder", "rad", turned, still(small))
            .predicted(opened(swayed.map(|most| most / (2.0 * HALF_HEIGHT)), small)),
    ])
}

/// The struck body at the origin, its axis upright, and its moment across the axis \[kg·m²\].
fn targets() -> [(&'static str, Body, f64); 2] {
    let ([r, l], mass) = (LARGE, MASSES[1]);
    [
        (", capsule", Body::capsule("capsule", mass, r, l, [0.0; 3]), capsule_moments(mass, LARGE).x),
        (", cylinder", Body::cylinder("cylinder", mass, r, l, [0.0; 3]), cylinder_moments(mass, LARGE).x),
    ]
}

fn scene(target: Body, e: f64) -> Scene {
    let place = [-(2.0 * LARGE[0] + GAP), 0.0, BESIDE];
    let ball = Body { linear_velocity: [SPEED, 0.0, 0.0], ..sphere("ball", MASSES[0], LARGE[0], place) };
    in_space("struck beside the middle", vec![ball, target], 0.0, e)
}

fn struck(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let mut measured = Vec::new();
    for (words, target, moment) in targets() {
        for (word, e) in [(", e = 0", 0.0), (", e = ½", 0.5)] {
            if e > 0.0 && !bench.description().restitution {
                continue;
            }
            measured.extend(strike(bench, h, &format!("{words}{word}"), (&target, moment, e))?);
        }
    }
    Ok(measured)
}

fn strike(bench: &mut Bench, h: f64, words: &str, (target, moment, e): (&Body, f64, f64)) -> Reply<Vec<Measurement>> {
    let inverse_mass = 1.0 / MASSES[0] + 1.0 / MASSES[1] + BESIDE * BESIDE / moment;
    let meeting = Meeting::of(bench, &scene(target.clone(), e), Vector3::x(), SPEED, h)?;
    let most = 2.0 * SPEED / inverse_mass;
    // in a plastic impact they stay in touch: the target turns its normal, along which it then has another velocity
    let spin = most * BESIDE / moment;
    let later = pair::later(2.0 * LARGE[0] * spin * spin, DURATION, SPEED);
    let lasting = if bench.description().contact_model.kind == Kind::Compliant { 1.0 } else { later };
    let slack = most * spin * DURATION * (meeting.apart + lasting * 2.0 * LARGE[0]);
    let lever = Vector3::new(-LARGE[0], 0.0, BESIDE);
    let pushed = -meeting.gains[0].impulse;
    let mut measured: Vec<Measurement> = meeting.momenta(words, slack).into_iter().collect();
    measured.extend(meeting.moments(words, [Vector3::x() * LARGE[0], lever], slack));
    let point = compliant::one_point(bench, inverse_mass, &MASSES, h);
    measured.extend(restitution(bench, h, (words, e), pushed.x * inverse_mass / SPEED - 1.0, later, 0.0, (&point, Approach::usual(h))));
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;

    fn worst(measured: &[Measurement]) -> Verdict {
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    /// Rolls down with the acceleration `share` g sin α.
    fn rolling(check: &str, h: f64, share: f64) -> Verdict {
        let (sine, cosine) = 20f64.to_radians().sin_cos();
        let down = Vector3::new(cosine, 0.0, -sine);
        let measured = judge(check, h, |scene, index, _, t| {
            let body = &scene.bodies[index];
            let (speed, way) = (share * GRAVITY * sine * t, 0.5 * share * GRAVITY * sine * t * t);
            let place = Vector3::from(body.position) + down * way;
            (place.into(), body.orientation, (down * speed).into(), [0.0, speed / RADIUS, 0.0])
        });
        worst(&measured)
    }

    #[test]
    fn the_right_acceleration_passes_and_that_of_another_body_fails() {
        // a capsule of l = 1.5 R: 4/13 of its mass is in the balls
        let capsule = 1.0 / (1.5 - 0.1 * 2.0 / (3.0 * 1.5 + 2.0));
        for h in SWEEP {
            for (check, right, other) in [("round/cylinder-incline", 2.0 / 3.0, capsule), ("round/capsule-incline", capsule, 2.0 / 3.0)] {
                assert_eq!(rolling(check, h, right), Verdict::Pass, "{check} at {h}");
                for wrong in [0.5, 5.0 / 7.0] {
                    assert_eq!(rolling(check, h, wrong), Verdict::Fail, "{check}, {wrong} at {h}");
                }
                // the two differ by a seventieth, which a step of a thirtieth of a second allows for the lever of its gap
                if h <= 0.001 {
                    assert_eq!(rolling(check, h, other), Verdict::Fail, "{check} at {h}");
                }
            }
        }
    }

    #[test]
    fn stillness_passes_and_a_cylinder_that_moves_or_leans_fails() {
        for h in SWEEP {
            let verdict = |speed: f64, lean: f64| {
                let measured = judge("round/standing", h, move |scene, index, _, t| {
                    let late = if t > 0.0 { 1.0 } else { 0.0 };
                    let turn = [(0.5 * lean * late).cos(), (0.5 * lean * late).sin(), 0.0, 0.0];
                    (scene.bodies[index].position, turn, [late * speed, 0.0, 0.0], [0.0; 3])
                });
                worst(&measured)
            };
            assert_eq!((verdict(0.0, 0.0), verdict(1e-3 * GRAVITY * h, 0.0)), (Verdict::Pass, Verdict::Fail), "{h}");
            assert_eq!(verdict(0.0, 10.0 * tolerance::drift(STEPS, RADIUS, GRAVITY, h, f64::EPSILON) / RADIUS), Verdict::Fail, "{h}");
        }
    }

    /// After the impact with a part of the right impulse and of the right spin.
    fn after(scene: &Scene, index: usize, t: f64, [part, turned]: [f64; 2]) -> RigidState {
        let body = &scene.bodies[index];
        let name = &scene.bodies[1].name;
        let moment = targets().into_iter().find(|(_, target, _)| target.name == *name).expect("one of two").2;
        let inverse_mass = 1.0 / MASSES[0] + 1.0 / MASSES[1] + BESIDE * BESIDE / moment;
        let impulse = part * (1.0 + scene.material.restitution) * SPEED / inverse_mass;
        let (before, contact) = (body.linear_velocity[0], GAP / SPEED);
        let hit = t >= contact;
        let velocity = before + [-1.0, 1.0][index] * impulse / MASSES[index];
        let spin = if index == 1 { turned * BESIDE * impulse / moment } else { 0.0 };
        let [x, y, z] = body.position;
        let moved = before * t.min(contact) + velocity * (t - contact).max(0.0);
        let now = |value: f64, earlier: f64| if hit { value } else { earlier };
        ([x + moved, y, z], body.orientation, [now(velocity, before), 0.0, 0.0], [0.0, now(spin, 0.0), 0.0])
    }

    #[test]
    fn the_closed_form_of_the_impact_passes_and_another_impulse_or_spin_fails() {
        for h in SWEEP {
            let verdict = |parts: [f64; 2]| worst(&judge("round/struck", h, |scene, index, _, t| after(scene, index, t, parts)));
            assert_eq!(verdict([1.0, 1.0]), Verdict::Pass, "{h}");
            for wrong in [[0.9, 1.0], [1.1, 1.0], [1.0, 0.0], [1.0, 0.5], [0.0, 1.0]] {
                assert_eq!(verdict(wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
