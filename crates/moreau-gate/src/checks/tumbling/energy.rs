//! The energy law of a step.
//!
//! With p_b the impulse of all contacts on body b, p = Hᵀr, and E_σ = E − σ g h Σ m v_z the energy that a scheme keeps which moves on with
//! (½ + σ) v⁺ + (½ − σ) v:
//! ```text
//!     T(v⁺) − T(v_free) = r·u⁺ − ½ rᵀW r                                                       every scheme with one contact law per step
//!     ΔE_σ = r·u⁺ − Σ_b (½ ‖p_b‖²/m_b − ½ h g p_b,z) − ½ Σ_b ‖J_b^{-½} ℓ_b‖²                    ℓ_b the angular impulse
//!     r·u⁺ ≤ Σ_k r_k w_k                                                    w_k the speed that contact k asks for: 0 if e = 0
//!     y = u⁺ + e u⁻ ,  r·y ≤ 0 ,  μ = 0 :   the same bound times (1 − e)/(1 + e)
//!     u_k⁺ = 0 of contacts O that were opening, u_k⁻ > 0, and are pressed:   that, and e/(1 + e) Σ_O r_k u_k⁻
//! ```
//! The last line is Signorini's condition for a contact that opens: an engine returns e times an approach and asks no more of the others
//! than u ≥ 0, where Newton's law would let them close again with e u⁻. Then (1 + e) r·u⁺ = e (rᵀW r − h r·g_n) + e Σ_O r_k u_k⁻.
//!
//! So a step gains at most c Σ_b max(0, ½ h g p_b,z − ½ p_b,z²/m_b) ≤ c Σ m g² h²/8, c = (1 − e)/(1 + e), and w R with R = Σ r_n. What
//! rotation adds is bounded apart; see [`crate::tolerance::tumbling`]. Poses are taken to move with the velocities: what an engine pushes
//! out of a depth in the position alone rises by m g Δz and is counted. Allowed for is what is declared: a correction that the bodies keep
//! as a speed, one of the position by m g Δz, and a spring that lifts them out of a depth, by m g times what the depth loses.

use crate::checks::scenery::GRAVITY;
use crate::checks::tumbling::depth;
use crate::checks::tumbling::motion::Tumble;
use crate::checks::tumbling::parting;
use crate::checks::tumbling::scenes::{FRICTION, Throw, Thrown};
use crate::model::{Model, RigidLimits};
use crate::tolerance::tumbling as tolerance;
use crate::{Bench, Expectation, Kind, Measurement, Reply};

/// Duration of the motion \[s\].
const DURATION: f64 = 1.0;

const fn throw(thrown: Thrown, seed: u64, restitution: f64) -> Throw {
    Throw { thrown, seed, restitution }
}

const PASSIVE: [Throw; 5] = [
    throw(Thrown::Cube, 1, 0.0),
    throw(Thrown::Cube, 2, 0.0),
    throw(Thrown::Box, 3, 0.0),
    throw(Thrown::Pair, 4, 0.0),
    throw(Thrown::Heavy, 5, 0.0),
];

const BOUNCING: [Throw; 4] =
    [throw(Thrown::Cube, 1, 0.2), throw(Thrown::Box, 2, 0.5), throw(Thrown::Pair, 3, 0.8), throw(Thrown::Heavy, 4, 0.5)];

const ROUGH: [Throw; 4] =
    [throw(Thrown::Box, 5, 0.2), throw(Thrown::Box, 6, 0.5), throw(Thrown::Pair, 7, 0.2), throw(Thrown::Heavy, 8, 0.5)];

/// `tumbling/passive`: e = 0 with friction.
pub(super) fn passive(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let law = Law { loss: 1.0, returned: 0.0, kept: 0.0, friction: FRICTION };
    measured(bench, &PASSIVE, h, |_| law)
}

/// `tumbling/bouncing`: e > 0 without friction.
pub(super) fn bouncing(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    measured(bench, &BOUNCING, h, |throw| {
        let e = throw.restitution;
        Law { loss: (1.0 - e) / (1.0 + e), returned: 0.0, kept: e, friction: 0.0 }
    })
}

/// The rise of the energy with e > 0 and friction, where a contact may ask for e times the speed at which it arrives.
pub(super) fn rough(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    measured(bench, &ROUGH, h, |throw| Law { loss: 1.0, returned: throw.restitution, kept: 0.0, friction: FRICTION })
}

/// What a contact law allows.
#[derive(Clone, Copy)]
struct Law {
    /// c.
    loss: f64,
    /// The part of its speed of arrival that a contact may ask for against friction: Newton's e.
    returned: f64,
    /// e of contacts that part and may be kept from closing again, where the loss c is counted on.
    kept: f64,
    /// μ.
    friction: f64,
}

fn measured(bench: &mut Bench, throws: &[Throw], h: f64, law: impl Fn(&Throw) -> Law) -> Reply<Vec<Measurement>> {
    let one = |throw: &Throw| {
        let tumble = Tumble::of(bench, throw, law(throw).friction, h, DURATION)?;
        Ok(rise(bench, &tumble, throw.restitution, law(throw), format!("rise of the energy: {}", throw.words())))
    };
    throws.iter().map(one).collect()
}

/// The rise of the energy in a motion with friction and without restitution.
pub(in crate::checks) fn passive_rise(bench: &Bench, tumble: &Tumble, friction: f64, quantity: &str) -> Measurement {
    rise(bench, tumble, 0.0, Law { loss: 1.0, returned: 0.0, kept: 0.0, friction }, quantity.into())
}

fn rise(bench: &Bench, tumble: &Tumble, restitution: f64, law: Law, quantity: String) -> Measurement {
    let compliant = bench.description().contact_model.kind == Kind::Compliant;
    let ideal = worst_rise(tumble, &law, &RigidLimits::default(), bench.epsilon(), compliant);
    let why = "contacts do no work but what the discretisation of gravity and rotation allows";
    let measurement = Measurement::new(quantity, "J", ideal.rise, Expectation::at_most(0.0, ideal.allowed, why));
    match Model::of(bench.description()) {
        // A declared correction of depth is a speed that the bodies keep, a declared spring lifts them; contacts below a declared threshold
        // have another e than the rest.
        Model::Coulomb(limits)
            if limits.taken_back() + limits.linear_damping > 0.0
                || depth::is_sprung(&limits)
                || slowest_bounce(&limits, restitution) > 0.0 =>
        {
            let unequal = slowest_bounce(&limits, restitution) > 0.0;
            let law = Law { loss: 1.0, returned: if unequal { restitution } else { law.returned }, ..law };
            let declared = worst_rise(tumble, &law, &limits, bench.epsilon(), compliant);
            let bound = ideal.rise - declared.excess();
            measurement.predicted(Some(Expectation::at_most(0.0, bound, "the declared corrections, thresholds and damping")))
        }
        _ => measurement,
    }
}

fn slowest_bounce(limits: &RigidLimits, restitution: f64) -> f64 {
    limits.slowest_bounce(restitution.max(f64::MIN_POSITIVE))
}

/// The rise \[J\] of the energy over some interval of steps, and what is allowed over the same.
#[derive(Clone, Copy, Debug)]
struct Rise {
    rise: f64,
    allowed: f64,
}

impl Rise {
    fn excess(&self) -> f64 {
        self.rise - self.allowed
    }
}

/// The interval of steps whose rise of E_σ is farthest above what is allowed.
fn worst_rise(tumble: &Tumble, law: &Law, limits: &RigidLimits, epsilon: f64, from_start: bool) -> Rise {
    let (sigma, flight) = sigma(tumble);
    let step = |k: usize| {
        let change = tumble.upward(k) - tumble.upward(k - 1);
        let rise = tumble.energy(k) - tumble.energy(k - 1) - sigma * GRAVITY * tumble.h * change;
        let lifted = if limits.position_correction > 0.0 { lifted(tumble, limits.position_correction, sigma, k) } else { 0.0 };
        let allowed =
            allowed(tumble, law, limits, k, epsilon) + lifted + tolerance::sigma(flight, GRAVITY, tumble.h, epsilon) * change.abs();
        Rise { rise, allowed }
    };
    interval((1..tumble.states.len()).map(step), from_start)
}

/// Energy \[J\] that a declared correction of the position gives in step k: m g times what a body rises beyond its velocities, at most the
/// part r of the depths of all bodies below; and the turn that goes with it.
fn lifted(tumble: &Tumble, part: f64, sigma: f64, k: usize) -> f64 {
    let deepest = tolerance::depth(tumble.fastest(k - 1), GRAVITY, tumble.h) + tumble.depth(k - 1);
    let most = part * deepest * tumble.bodies.len() as f64;
    let one = |b: usize| {
        let [start, end] = [k - 1, k].map(|k| &tumble.states[k][b]);
        let moved = tumble.h * ((0.5 + sigma) * end.velocity.z + (0.5 - sigma) * start.velocity.z);
        let rise = (end.position.z - start.position.z - moved).clamp(0.0, most);
        let body = &tumble.bodies[b];
        body.mass * GRAVITY * rise + tolerance::turned_by_correction(body.mass, body.spread(), body.moments.min(), end.spin.norm(), most)
    };
    (0..tumble.bodies.len()).map(one).sum()
}

/// σ of the scheme, from the first body's flight until the first contact, and the steps of that flight:
/// z_n − z_0 = h Σ ½(v_k + v_{k−1}) + σ h (v_n − v_0). The last step before an impulse is left out: an engine may take a depth back in it
/// without one.
fn sigma(tumble: &Tumble) -> (f64, usize) {
    let flies = |k: &usize| {
        (0..tumble.bodies.len()).all(|b| tumble.impulse(b, *k).norm() <= tolerance::flight(tumble.bodies[b].mass, GRAVITY, tumble.h))
    };
    let steps = (1..tumble.states.len()).take_while(flies).count().saturating_sub(1);
    let at = |k: usize| (tumble.states[k][0].position.z, tumble.states[k][0].velocity.z);
    let ((start, first), (end, last)) = (at(0), at(steps));
    if steps == 0 {
        return (0.0, 0);
    }
    let mean: f64 = (1..=steps).map(|k| 0.5 * tumble.h * (at(k).1 + at(k - 1).1)).sum();
    ((((end - start) - mean) / (tumble.h * (last - first))).clamp(-0.5, 0.5), steps)
}

/// The interval with the greatest excess; every interval begins with the first step if `from_start`.
fn interval(steps: impl Iterator<Item = Rise>, from_start: bool) -> Rise {
    let mut best = Rise { rise: f64::NEG_INFINITY, allowed: 0.0 };
    let mut current = Rise { rise: 0.0, allowed: 0.0 };
    for step in steps {
        if current.excess() < 0.0 && !from_start {
            current = Rise { rise: 0.0, allowed: 0.0 };
        }
        current = Rise { rise: current.rise + step.rise, allowed: current.allowed + step.allowed };
        // What is not a number is the worst.
        if current.excess() > best.excess() || current.excess().is_nan() {
            best = current;
        }
    }
    best
}

/// What step k, counted from 1, may gain \[J\].
fn allowed(tumble: &Tumble, law: &Law, limits: &RigidLimits, k: usize, epsilon: f64) -> f64 {
    let h = tumble.h;
    let gravity: f64 =
        (0..tumble.bodies.len()).map(|b| tolerance::gravity(tumble.impulse(b, k).z, tumble.bodies[b].mass, GRAVITY, h)).sum();
    let before = tumble.kinetic(k - 1);
    let rotation: f64 = (0..tumble.bodies.len())
        .map(|b| {
            let body = &tumble.bodies[b];
            let most = (2.0 * before / body.moments.min()).sqrt();
            let [start, end] = [k - 1, k].map(|k| tumble.states[k][b].spin);
            let turned = (end - start).norm().min(2.0 * most);
            tolerance::rotation(body.spread(), body.moments.min(), start.norm().max(end.norm().min(most)), turned, h)
        })
        .sum();
    let speed = tumble.fastest(k - 1) + GRAVITY * h;
    let depth = if limits.error_reduction > 0.0 { tumble.depth(k - 1) } else { 0.0 };
    let lifted = if depth::is_sprung(limits) { (tumble.depth(k - 1) - tumble.depth(k)).max(0.0) } else { 0.0 };
    let weight: f64 = tumble.bodies.iter().map(|body| body.mass * GRAVITY).sum();
    let damped: f64 = (0..tumble.bodies.len())
        .map(|b| {
            let changed = (tumble.states[k][b].velocity - tumble.states[k - 1][b].velocity).norm();
            tolerance::damping(tumble.bodies[b].mass, GRAVITY, limits.linear_damping, changed, h)
        })
        .sum();
    let asked = law.returned * speed + turned_below(tumble, k) + limits.push(depth, h);
    let [floor, pair] = pressed(tumble, law.friction, k);
    let pressed = floor + pair;
    let [off_floor, apart] = parting::fastest(tumble, k - 1);
    let size = before + tumble.each(k - 1).map(|(body, state)| body.mass * GRAVITY * state.position.z.abs()).sum::<f64>();
    law.loss * gravity
        + rotation
        + asked * pressed
        + tolerance::opening(law.kept, floor * off_floor + pair * apart)
        + weight * lifted
        + damped
        + tolerance::unsolved(pressed, speed)
        + crate::tolerance::audit_rounding(epsilon, size)
}

/// ½ ω²ρ h \[m/s\]: the speed that takes corners back which turned below a surface within the step, summed over the bodies.
fn turned_below(tumble: &Tumble, k: usize) -> f64 {
    tumble.each(k - 1).map(|(body, state)| tolerance::turned_below(state.spin.norm(), body.radius(), tumble.h)).sum()
}

/// Bounds \[N·s\] on Σ r_n of step k, of the floor and of the pair, from the motion alone. One body: the upward part of its impulse. Two:
/// the floor's is S, the sum of both; the upper body's impulse p₂ is that of the other body and at most S√(1 + μ²) of the floor.
fn pressed(tumble: &Tumble, friction: f64, k: usize) -> [f64; 2] {
    let impulses: Vec<_> = (0..tumble.bodies.len()).map(|body| tumble.impulse(body, k)).collect();
    let floor = impulses.iter().map(|impulse| impulse.z).sum::<f64>().max(0.0);
    match impulses.as_slice() {
        [_, upper] => [floor, upper.norm() + floor * 1f64.hypot(friction)],
        _ => [floor, 0.0],
    }
}
