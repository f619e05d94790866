//! A bar that turns, its centre at rest or not, strikes the floor with a corner, a ball with a face, and another turning bar.
//!
//! ```text
//!     u_n = n·(v + ω × l) − … ,    p = (1 + e) |u_n|/W_nn ,    W_nn = Σ 1/m + ℓ²/J
//!     e = −Σ (p·v⁺ + L·ω⁺)/Σ (p·v⁻ + L·ω⁻) ,    p, L what each body gained: the impulse's power after over before, at any lever
//! ```
//! An engine whose restitution goes by the velocity of centres returns nothing where they are at rest, and too little where they approach,
//! too. The lever changes while a bar turns, so that an impulse is known as well as the place at which the contact is found, and the
//! approach may be that of an older place; the powers are known whatever the place of the impulse. Bars are square: every axis across one
//! is principal. One is rolled onto an edge, of which the corner touches alone.

use crate::checks::bounce::declared::Declared;
use crate::checks::bounce::scene::{PATIENCE, RESTITUTION, SPEED, weightless};
use crate::checks::motion::Sample;
use crate::checks::pair::meeting::{Gain, gained, undamped};
use crate::checks::pair::view::View;
use crate::checks::scenery::{between, cuboid, sphere};
use crate::description::Friction;
use crate::model::Model;
use crate::tolerance::bounce as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::Trajectory;
use std::f64::consts::{FRAC_PI_4, SQRT_2};

/// Half extents of a bar \[m\]: long, so that it turns slowly.
pub(super) const HALF: [f64; 3] = [8.0, 1.0, 1.0];
/// Of the first bar, and of what is not the floor \[kg\].
pub(super) const MASSES: [f64; 2] = [1.0, 2.0];
/// Of the ball \[m\].
pub(super) const RADIUS: f64 = 2.0;
/// Where along a bar a face is struck \[m\].
pub(super) const STRUCK: f64 = 7.5;
/// Angle \[rad\] by which a bar turns before it strikes: farther from everything than a contact margin that grows with the body, and no
/// step of a sweep ends there.
pub(super) const ANGLE: f64 = 0.02944;
/// Slope \[rad\] of the other bar's face when it is struck, against the first one's: nothing else of both is near.
pub(super) const TILT: f64 = 0.3;
/// μ of the rough floor.
const FRICTION: f64 = 0.3;

/// What the bar strikes, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// Its centre at rest.
    Floor,
    /// Half of the approach is its centre's.
    FloorFalling,
    /// The same as [`Target::Floor`], with friction.
    RoughFloor,
    /// At rest, over the bar's end.
    Ball,
    /// Another bar over the first one's end, which turns towards it.
    Bar,
}

/// J of a bar across itself \[kg·m²\].
pub(super) fn moment(mass: f64) -> f64 {
    mass * (HALF[0] * HALF[0] + HALF[2] * HALF[2]) / 3.0
}

/// A place along and across a bar \[m\] that has turned upwards by the angle of the contact.
pub(super) fn turned([along, across]: [f64; 2]) -> [f64; 2] {
    let (sine, cosine) = ANGLE.sin_cos();
    [along * cosine - across * sine, along * sine + across * cosine]
}

impl Target {
    const ALL: [(Target, &str); 5] = [
        (Target::Floor, "floor"),
        (Target::FloorFalling, "floor, falling"),
        (Target::RoughFloor, "rough floor"),
        (Target::Ball, "ball"),
        (Target::Bar, "turning bar"),
    ];

    fn is_floor(self) -> bool {
        matches!(self, Target::Floor | Target::FloorFalling | Target::RoughFloor)
    }

    /// From the first bar's centre to the contact, along it and across it \[m\], in its own axes.
    pub fn place(self) -> [f64; 2] {
        match self {
            Target::Floor | Target::FloorFalling | Target::RoughFloor => [HALF[0], -SQRT_2 * HALF[2]],
            Target::Ball => [STRUCK, HALF[2]],
            Target::Bar => [HALF[0], SQRT_2 * HALF[2]],
        }
    }

    /// ℓ \[m\] of the first bar when it has turned by this angle \[rad\], at what it strikes there.
    fn lever(self, angle: f64) -> f64 {
        let more = angle - ANGLE;
        match self {
            Target::Ball => STRUCK * more.cos() + (HALF[2] + RADIUS) * more.sin(),
            _ => HALF[0] * angle.cos() - SQRT_2 * HALF[2] * angle.sin(),
        }
    }

    /// ω of every bar \[rad/s\] and speed of the first one's centre \[m/s\]: the contact closes at [`SPEED`].
    pub fn speeds(self) -> [f64; 2] {
        let lever = self.lever(ANGLE);
        match self {
            Target::Floor | Target::RoughFloor | Target::Ball => [SPEED / lever, 0.0],
            Target::FloorFalling => [0.5 * SPEED / lever, 0.5 * SPEED],
            Target::Bar => {
                let [along, across] = turned(self.place());
                [SPEED / (along * TILT.cos() - across * TILT.sin() + STRUCK), 0.0]
            }
        }
    }

    /// The bar level and turning: its end along x goes down to the floor, or up.
    pub fn scene(self) -> Scene {
        let (sine, cosine) = ANGLE.sin_cos();
        let [spin, fall] = self.speeds();
        let bar = |name: &str, mass: f64, place: [f64; 3], roll: f64, spin: f64| Body {
            orientation: [(0.5 * roll).cos(), (0.5 * roll).sin(), 0.0, 0.0],
            angular_velocity: [0.0, spin, 0.0],
            ..cuboid(name, mass, HALF, place)
        };
        let friction = if self == Target::RoughFloor { FRICTION } else { 0.0 };
        let [along, across] = self.place();
        if self.is_floor() {
            let height = along * sine - across * cosine + fall * ANGLE / spin;
            let falling = Body { linear_velocity: [0.0, 0.0, -fall], ..bar("bar", MASSES[0], [0.0, 0.0, height], FRAC_PI_4, spin) };
            return weightless("turning bar", falling, friction);
        }
        // where the first bar touches, and the way from there to the other centre
        let touched = turned([along, across]);
        let (roll, other, way) = match self {
            Target::Ball => (0.0, sphere("ball", MASSES[1], RADIUS, [0.0; 3]), [-RADIUS * sine, RADIUS * cosine]),
            _ => {
                let (slope, level) = TILT.sin_cos();
                let half = 0.5 * (TILT + ANGLE);
                let other = Body { orientation: [half.cos(), 0.0, half.sin(), 0.0], ..bar("other", MASSES[1], [0.0; 3], 0.0, -spin) };
                (FRAC_PI_4, other, [STRUCK * level + HALF[2] * slope, -STRUCK * slope + HALF[2] * level])
            }
        };
        let mut scene = weightless("turning bar and another body", bar("bar", MASSES[0], [0.0; 3], roll, -spin), friction);
        scene.bodies.push(Body { position: [touched[0] + way[0], 0.0, touched[1] + way[1]], ..other });
        scene.ground = None;
        scene
    }
}

pub(super) fn turning(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let mut measured = Vec::new();
    let rough = bench.description().friction != Friction::None;
    for (target, words) in Target::ALL.into_iter().filter(|(target, _)| rough || *target != Target::RoughFloor) {
        measured.extend(struck(bench, h, (target, words), &View::plain())?);
        if !target.is_floor() {
            measured.extend(struck(bench, h, (target, &format!("{words}, turned, it listed first")), &View::turned(true))?);
        }
    }
    Ok(measured)
}

/// One impact, judged.
struct Struck<'a> {
    words: &'a str,
    target: Target,
    motion: Trajectory,
    gains: Vec<Gain>,
    /// Angle \[rad\] between a place and the one at which the contact may be found.
    away: f64,
    allowed: f64,
    declared: Option<Declared>,
}

fn struck(bench: &mut Bench, h: f64, (target, words): (Target, &str), view: &View) -> Reply<Vec<Measurement>> {
    let spin = target.speeds()[0];
    let steps = (ANGLE / spin / h).ceil() as usize + PATIENCE;
    let scene = view.of(&target.scene());
    let motion = bench.simulate(&scene, h, steps, steps)?;
    let gains = (0..scene.bodies.len()).map(|index| gained(&scene, &motion, index)).collect();
    let margin = match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.contact_margin,
        _ => 0.0,
    };
    let away = tolerance::away(spin, h) + margin * spin / SPEED;
    let allowed = 2.0 * tolerance::solved(bench.epsilon());
    let declared = Declared::of(bench, SPEED, steps as f64 * h, h);
    let struck = Struck { words, target, motion, gains, away, allowed, declared };
    Ok(match target {
        Target::Floor | Target::Ball => vec![struck.by_powers(), struck.by_impulse()],
        Target::FloorFalling | Target::Bar => vec![struck.by_powers()],
        Target::RoughFloor => vec![struck.by_velocity()],
    })
}

impl Struck<'_> {
    /// −power of the impulse after over before. The approach may be one with an older lever: ω × l of every bar turns with it, and so do
    /// the normal and the centre's place in it.
    fn by_powers(&self) -> Measurement {
        let power = |sample: usize| -> f64 {
            let states = self.motion.bodies.iter().map(|track| Sample::of(track, sample));
            self.gains.iter().zip(states).map(|(gain, state)| gain.impulse.dot(&state.velocity) + gain.moment.dot(&state.spin)).sum()
        };
        let older = RESTITUTION * self.older();
        let newton = Expectation::equal(
            RESTITUTION,
            self.allowed + older,
            "the impulse's power is −e times what it was, perhaps with an older lever",
        );
        let law = self.declared.as_ref().map(|law| law.rebound(self.allowed + older));
        Measurement::new(format!("restitution by the powers, {}", self.words), "1", -power(1) / power(0), newton).predicted(law)
    }

    /// By which part the approach may be another with an older place of the contact.
    fn older(&self) -> f64 {
        let first = |angle: f64| self.target.lever(angle) / self.target.lever(ANGLE) - 1.0;
        let most = |of: &dyn Fn(f64) -> f64| [-self.away, self.away].map(|turn| of(ANGLE + turn).abs()).into_iter().fold(0.0, f64::max);
        match self.target {
            // both turn alike, and the corner moves along the other bar by what they turn across its face
            Target::Bar => 2.0 * self.away * (HALF[0] * TILT.sin() + (1.0 + SQRT_2) * HALF[2]) / (HALF[0] + STRUCK),
            _ => most(&first),
        }
    }

    /// p W_nn/u_n − 1 for the lever at the angle of the contact.
    fn by_impulse(&self) -> Measurement {
        let impulse = self.gains.iter().map(|gain| gain.impulse.norm()).sum::<f64>() / self.gains.len() as f64;
        let at = |angle: f64| response(self.target, angle) / (self.target.speeds()[0] * self.target.lever(angle));
        let ends = [-self.away, self.away].map(|turn| at(ANGLE) / at(ANGLE + turn));
        let [least, most] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let placed = |[low, high]: [f64; 2]| [(1.0 + low) * least - 1.0, (1.0 + high) * most - 1.0];
        let allowed = self.allowed + RESTITUTION * self.older();
        let ideal = between(placed([RESTITUTION; 2]), allowed, "p = (1 + e) ω ℓ/W_nn at the lever the contact may have");
        let law = self.declared.as_ref().map(|law| {
            between(placed(law.restitution), allowed, "the same with the declared thresholds, force mixing and error reduction")
        });
        let value = impulse * at(ANGLE) - 1.0;
        Measurement::new(format!("restitution by the impulse, {}", self.words), "1", value, ideal).predicted(law)
    }

    /// Normal velocity of the corner after over before; friction has another lever than the normal, and the powers are not those of u_n.
    fn by_velocity(&self) -> Measurement {
        let end = Sample::of(&self.motion.bodies[0], 1);
        let after = |angle: f64| (end.velocity.z - end.spin.y * self.target.lever(angle)) / SPEED;
        let moved = [-self.away, self.away].map(|turn| (after(ANGLE + turn) - after(ANGLE)).abs()).into_iter().fold(0.0, f64::max);
        let allowed = self.allowed + moved + RESTITUTION * self.older();
        let newton = Expectation::equal(RESTITUTION, allowed, "u_n⁺ = −e u_n with friction, too, at the lever the contact may have");
        let law = self.declared.as_ref().map(|law| law.rebound(allowed));
        Measurement::new(format!("normal speed of the corner after over before, {}", self.words), "1", after(ANGLE), newton).predicted(law)
    }
}

/// W_nn \[1/kg\] of the floor or the ball when the bar has turned by this angle \[rad\].
fn response(target: Target, angle: f64) -> f64 {
    let other = if target == Target::Ball { 1.0 / MASSES[1] } else { 0.0 };
    1.0 / MASSES[0] + other + target.lever(angle).powi(2) / moment(MASSES[0])
}

#[cfg(test)]
pub(super) mod tests;
