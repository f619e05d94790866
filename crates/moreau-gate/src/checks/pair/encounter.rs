//! Two bodies of any shape that meet in free fall along x and slip along no axis and no diagonal, listed in either order.
//!
//! ```text
//!     n = x ,   s = (0, 4, 3)/5 :    p_t = μ p_n s  on the second body, also as the sum over a plate's corners, which all slip along s
//!     spheres, and a ball at the middle of a face:   L_i = l_i × p_i ,   so that L_i·n = 0 : a point does not drill
//! ```

use crate::checks::pair::ball_on_box::{BALL, BOX, HALF, RADIUS};
use crate::checks::pair::compliant::{self, Approach, restitution};
use crate::checks::pair::meeting::{DURATION, GAP, Meeting, SPEED, lasting, moments_of, opening};
use crate::checks::pair::spheres::{MASSES, RADII};
use crate::checks::pair::{friction, spheres};
use crate::checks::scenery::{cuboid, over_floor, sphere};
use crate::description::Friction;
use crate::model::normal::Normal;
use crate::tolerance::pair as tolerance;
use crate::{Bench, Expectation, Measurement};
use moreau_dynamics::scenes::{Body, Ground, Scene};
use moreau_dynamics::trajectory::Trajectory;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Spins about the normal \[rad/s\].
const DRILLS: [f64; 2] = [1.0, -0.5];
/// Of two plates \[kg\] and \[m\]: the smaller one meets the larger one with its face, and stays on it. They are thin, so that friction
/// neither tips nor turns them much.
const PLATES: [(f64, [f64; 3]); 2] = [(1.0, [1.0, 8.0, 8.0]), (4.0, [1.0, 16.0, 16.0])];
/// Height from one encounter to the next \[m\].
const APART: f64 = 60.0;
/// Depth of the floor \[m\] under the first encounter: no turned plate reaches it, and no body is farther from it than 50 m, where adapters
/// end a floor that they make of a box.
const DEPTH: f64 = 30.0;

/// s, the direction of the slip.
pub(super) fn across() -> Vector3<f64> {
    Vector3::new(0.0, 4.0, 3.0) / 5.0
}

/// What meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shapes {
    Spheres,
    BallAndBox,
    Plates,
}

/// Two bodies that meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encounter {
    pub words: &'static str,
    pub shapes: Shapes,
    /// Whether the scene lists the second, heavier body first; boxes are then turned about the normal.
    pub swapped: bool,
    pub friction: f64,
    pub restitution: f64,
    /// \[m/s\]; it does not end.
    pub slip: f64,
}

impl Encounter {
    /// Names of both bodies in the `index`-th encounter of a scene.
    pub fn names(index: usize) -> [String; 2] {
        ["first", "second"].map(|name| format!("{name}{index}"))
    }

    /// Both bodies at a height of `index` times [`APART`], as the scene lists them.
    pub fn listed(&self, index: usize) -> [Body; 2] {
        let [mut first, mut second] = self.bodies();
        [first.name, second.name] = Encounter::names(index);
        for body in [&mut first, &mut second] {
            body.position[2] += index as f64 * APART;
        }
        if self.swapped { [second, first] } else { [first, second] }
    }

    /// The first flies at the second along x.
    fn bodies(&self) -> [Body; 2] {
        let [mut first, second] = match self.shapes {
            Shapes::Spheres => [0, 1].map(|k| spun(sphere("", MASSES[k], RADII[k], [0.0; 3]), 0.5 * self.slip / RADII[k], DRILLS[k])),
            Shapes::BallAndBox => {
                [spun(sphere("", BALL, RADIUS, [0.0; 3]), self.slip / RADIUS, DRILLS[0]), self.turned(cuboid("", BOX, HALF, [0.0; 3]))]
            }
            Shapes::Plates => PLATES.map(|(mass, half)| self.turned(cuboid("", mass, half, [0.0; 3]))),
        };
        let [reach, other] = self.levers();
        // plates slip by their flight, and meet with their middles
        let flight = if self.shapes == Shapes::Plates { across() * self.slip } else { Vector3::zeros() };
        first.position = (Vector3::x() * -(reach + other + GAP) - flight * (GAP / SPEED)).into();
        first.linear_velocity = (Vector3::x() * SPEED + flight).into();
        [first, second]
    }

    fn turned(&self, body: Body) -> Body {
        let (sine, cosine) = (PI / 12.0).sin_cos();
        if self.swapped { Body { orientation: [cosine, sine, 0.0, 0.0], ..body } } else { body }
    }

    /// From both centres to where the surfaces meet \[m\].
    fn levers(&self) -> [f64; 2] {
        match self.shapes {
            Shapes::Spheres => RADII,
            Shapes::BallAndBox => [RADIUS, HALF[0]],
            Shapes::Plates => PLATES.map(|(_, half)| half[0]),
        }
    }

    /// m̄ \[kg\].
    fn reduced_mass(&self) -> f64 {
        let [first, second] = self.bodies().map(|body| 1.0 / body.mass);
        1.0 / (first + second)
    }

    /// The contact under a compliant law; plates are turned by their friction while their corners yield, and are not replayed.
    fn springs(&self, bench: &Bench, h: f64) -> Vec<Normal> {
        let masses = self.bodies().map(|body| body.mass);
        match self.shapes {
            Shapes::Spheres => compliant::balls(bench, [0, 1].map(|k| (masses[k], RADII[k])), h),
            Shapes::BallAndBox => compliant::one_point(bench, 1.0 / self.reduced_mass(), &masses, h),
            Shapes::Plates => Vec::new(),
        }
    }

    /// What is measured of this encounter, whose bodies are the `place`-th and the next of the scene.
    pub fn measured(&self, bench: &Bench, h: f64, (scene, motion, place): (&Scene, &Trajectory, usize)) -> Vec<Measurement> {
        let pair = if self.swapped { [place + 1, place] } else { [place, place + 1] };
        let (words, mu) = (format!(", {}", self.words), self.friction);
        let meeting = Meeting::between(bench, scene, motion, pair, Vector3::x(), SPEED + opening(bench, mu * self.slip));
        let pushed = meeting.gains[1].impulse;
        let [along, aside] = [across(), Vector3::x().cross(&across())].map(|direction| pushed.dot(&direction));
        let contact = self.contact(bench, h);
        let slack = (meeting.apart + contact.turned_arm) * pushed.yz().norm() + contact.moved * pushed.norm();
        let mut measured: Vec<Measurement> = meeting.momenta(&words, slack).into();
        if self.shapes != Shapes::Plates {
            let [reach, other] = self.levers();
            measured.extend(meeting.moments(&words, [Vector3::x() * reach, Vector3::x() * -other], slack));
        }
        let returned = pushed.x / (self.reduced_mass() * SPEED) - 1.0;
        measured.extend(restitution(
            bench,
            h,
            (&words, scene_restitution(scene, pair)),
            returned,
            contact.later,
            mu * self.slip,
            (&self.springs(bench, h), Approach::usual(h)),
        ));
        let (ideal, law) = friction::opposed(bench);
        let wider = |one: Expectation| Expectation { tolerance: one.tolerance + contact.aside, ..one };
        let angle = Measurement::new(format!("angle of friction to the slip{words}"), "rad", aside.abs().atan2(along), wider(ideal));
        measured.push(angle.predicted(law.map(wider)));
        measured.extend(self.slipping(bench, h, &words, [pushed.x, pushed.yz().norm()], meeting.apart / self.levers()[0], &contact));
        measured
    }

    fn slipping(&self, bench: &Bench, h: f64, words: &str, impulse: [f64; 2], lever: f64, contact: &Contact) -> Option<Measurement> {
        let turned = tolerance::turned_ratio(contact.turned, self.friction);
        let (ideal, law) = friction::slipping(bench, self.friction, turned);
        // the replay of a pyramid slips along one of its edges
        let replays = self.shapes == Shapes::Spheres && bench.description().friction != Friction::Pyramid;
        let replay = || friction::spheres_replayed(bench, h, [self.reduced_mass(), RADII[0]], self.friction, self.slip);
        let replayed = replays.then(replay).flatten();
        let law = replayed.map(|impulses| friction::of_the_replay(friction::ratio(impulses), lever, turned, bench)).or(law);
        let measured = || Measurement::new(format!("friction over normal impulse{words}"), "1", friction::ratio(impulse), ideal);
        friction::on_the_cone(bench).then(|| measured().predicted(law))
    }

    /// What happens while both touch.
    fn contact(&self, bench: &Bench, h: f64) -> Contact {
        let [moments, [reach, other]] = [self.bodies().map(|body| moments_of(&body).y), self.levers()];
        let across = self.reduced_mass() * spheres::past(bench, self.friction, self.slip);
        let along = across / self.reduced_mass();
        let (rate, passing, closing) = match self.shapes {
            Shapes::Spheres => (along / (reach + other), along, along * along / (reach + other)),
            Shapes::BallAndBox => {
                let rate = other * across / moments[1];
                (rate, along, rate * (2.0 * along + other * rate))
            }
            Shapes::Plates => {
                let rate = (reach * across / moments[0]).max(other * across / moments[1]);
                (rate, self.slip, rate * (2.0 * self.slip + (reach + other) * rate))
            }
        };
        let closes = if self.shapes == Shapes::Spheres { lasting(bench, h) } else { DURATION };
        let pressed = tolerance::later(closing, closes, SPEED);
        let time = lasting(bench, h) + pressed * DURATION;
        // plates that meet a step early or late touch beside their middles, and turn
        let beside = if self.shapes == Shapes::Plates { tolerance::later(rate * self.slip, 2.0 * h, SPEED) } else { 0.0 };
        let (moved, turned_arm) = match self.shapes {
            // both touch at the same corners, wherever that is
            Shapes::Plates => (tolerance::meanwhile(self.slip, h), 0.0),
            _ => (passing * time, tolerance::meanwhile(DRILLS[0], h) * reach.max(other)),
        };
        // a spin about the normal becomes a slip aside as the normal turns
        let drill = if self.shapes == Shapes::Plates { 0.0 } else { DRILLS[0] * reach.max(other) };
        let aside = tolerance::aside(drill, rate * time, self.slip);
        Contact { later: pressed + beside, turned: rate * time, moved, turned_arm, aside }
    }
}

/// While two bodies touch.
struct Contact {
    /// Part of the normal impulse that comes later than the rest, or by a turn.
    later: f64,
    /// Angle \[rad\] by which the normal turns meanwhile.
    turned: f64,
    /// Distance \[m\] by which the place of contact moves from where the levers end, or the bodies in the step of the impact.
    moved: f64,
    /// Distance \[m\] by which the levers of friction turn with the spin about the normal, in engines that add torques in the body frame.
    turned_arm: f64,
    /// Angle \[rad\] by which the slip turns.
    aside: f64,
}

/// A sphere whose foremost point along x moves along s with `slip` times its radius, and that spins about x.
fn spun(body: Body, slip: f64, drill: f64) -> Body {
    Body { angular_velocity: (Vector3::x().cross(&across()) * slip + Vector3::x() * drill).into(), ..body }
}

/// e of two bodies of a scene.
fn scene_restitution(scene: &Scene, pair: [usize; 2]) -> f64 {
    let names = pair.map(|index| &scene.bodies[index].name);
    let own = scene.material.pairs.iter().find(|own| own.bodies.iter().all(|name| names.contains(&name)));
    own.and_then(|own| own.restitution).unwrap_or(scene.material.restitution)
}

/// Bodies in free fall, far over the floor.
pub(super) fn falling(name: &str, bodies: Vec<Body>, friction: f64, restitution: f64) -> Scene {
    let ground = Some(Ground { normal: [0.0, 0.0, 1.0], offset: -DEPTH });
    let mut scene = Scene { ground, ..over_floor(name, bodies, friction) };
    scene.material.restitution = restitution;
    scene
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::checks::scenery::GRAVITY;
    use crate::exact::RigidState;

    /// How an engine differs from the exact one: factors of friction, of its component along z, of the lever of the second body and of its
    /// restitution, and the part of the first body's spin about the normal that is lost.
    #[derive(Clone, Copy)]
    pub struct Wrong {
        pub friction: f64,
        pub upwards: f64,
        pub lever: f64,
        pub restitution: f64,
        pub drilled: f64,
    }

    pub const RIGHT: Wrong = Wrong { friction: 1.0, upwards: 1.0, lever: 1.0, restitution: 1.0, drilled: 0.0 };

    /// The exact motion of a body of an encounter, with μ and e of its pair, but for what is wrong.
    pub fn motion(scene: &Scene, index: usize, t: f64, [mu, e]: [f64; 2], wrong: Wrong) -> RigidState {
        let body = &scene.bodies[index];
        let first = body.name.starts_with("first");
        let number = body.name.trim_start_matches(char::is_alphabetic);
        let other = scene.bodies.iter().find(|one| one.name != body.name && one.name.ends_with(number)).expect("its partner");
        let mean = 1.0 / (1.0 / body.mass + 1.0 / other.mass);
        let pressed = (1.0 + e * wrong.restitution) * mean * SPEED;
        let mut impulse = Vector3::x() * pressed + across() * (mu * pressed * wrong.friction);
        impulse.z *= wrong.upwards;
        let reach = match (&body.sphere, &body.cuboid) {
            (Some(sphere), _) => sphere.radius,
            (_, cuboid) => cuboid.expect("a shape").half_extents[0],
        };
        let arm = Vector3::x() * if first { reach } else { -reach * wrong.lever };
        let impulse = if first { -impulse } else { impulse };
        let [before, spin] = [body.linear_velocity, body.angular_velocity].map(Vector3::from);
        let moments = moments_of(body);
        // friction alone turns a plate: the normal impulses of its corners are taken as equal, whatever follows from the turn
        let drilled = if first { spin.x * wrong.drilled } else { 0.0 };
        let turned = spin - Vector3::x() * drilled + arm.cross(&impulse) / moments.y;
        let (contact, fall) = (GAP / SPEED, Vector3::z() * -GRAVITY);
        let after = before + impulse / body.mass;
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0) + fall * (0.5 * t * t);
        let [velocity, spin] = if t < contact { [before, spin] } else { [after, turned] };
        (place.into(), body.orientation, (velocity + fall * t).into(), spin.into())
    }
}
