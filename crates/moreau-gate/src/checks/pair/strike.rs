//! A body strikes another one without friction, in one point or with faces whose centres are opposite.
//!
//! ```text
//!     W_n = Σ 1/m + (l × n)·J⁻¹(l × n) ,    W_n p = (1 + e) |u_n| ,    L = l × p n
//! ```
//! The striker does not spin and flies along n, which is therefore exact whenever the bodies meet.

use crate::checks::motion::yields;
use crate::checks::pair::compliant::{self, Approach};
use crate::checks::pair::meeting::{DURATION, GAP, Meeting, lasting, moments_of, returned};
use crate::checks::pair::view::{View, oriented};
use crate::checks::scenery::schedule;
use crate::description::Kind;
use crate::model::normal::Normal;
use crate::tolerance::pair as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;

/// One impact.
pub(in crate::checks) struct Strike<'a> {
    pub words: &'a str,
    /// Striker and target, which is [`GAP`] away along n.
    pub scene: Scene,
    pub normal: Vector3<f64>,
    /// From both centres to the place of contact \[m\].
    pub levers: [Vector3<f64>; 2],
    pub speed: f64,
    /// Distance \[m\] of the farthest of several points from the line of impact; 0 for one point.
    pub spread: f64,
    /// The compliant contact, or several that it may be, where a declared law replays it.
    pub springs: Vec<Normal>,
}

/// What the bodies do to the contact while it lasts.
struct Turning {
    /// Angle \[rad\] of the normal.
    angle: f64,
    /// Angular momentum \[kg·m²/s\] that its place moves by.
    slack: f64,
    /// Part of the impulse that comes later, or is another one when the bodies have turned.
    later: f64,
}

/// 1/R \[1/m\] of a round body, over which a contact turns its normal as it moves.
fn curvature(body: &Body) -> Option<f64> {
    let rod = body.capsule.map(|one| one.radius).or(body.cylinder.map(|one| one.radius));
    body.sphere.map(|one| one.radius).or(rod).map(f64::recip)
}

impl Strike<'_> {
    /// W_n \[1/kg\].
    pub fn inverse_mass(&self) -> f64 {
        (0..2).map(|k| 1.0 / self.scene.bodies[k].mass + self.moment(k).dot(&self.spin(k))).sum()
    }

    /// l × n \[m\].
    fn moment(&self, k: usize) -> Vector3<f64> {
        self.levers[k].cross(&self.normal)
    }

    /// J⁻¹(l × n) \[1/(kg·m)\].
    fn spin(&self, k: usize) -> Vector3<f64> {
        let turn = oriented(&self.scene.bodies[k]);
        turn * (turn.inverse() * self.moment(k)).component_div(&moments_of(&self.scene.bodies[k]))
    }

    /// The impact as seen by a view.
    pub fn measured(&self, bench: &mut Bench, h: f64, view: &View) -> Reply<Vec<Measurement>> {
        let time = GAP / self.speed + DURATION;
        let meeting = Meeting::viewed(bench, &self.scene, view, (self.normal, self.speed), (time, h))?;
        let pushed = meeting.gains[1].impulse;
        let turning = self.turning(bench, h);
        let off = tolerance::direction(bench.epsilon()) + turning.angle;
        let value = pushed.dot(&self.normal) * self.inverse_mass() / self.speed - 1.0;
        let angle = pushed.cross(&self.normal).norm().atan2(pushed.dot(&self.normal));
        let straight = Expectation::at_most(0.0, off, "without friction the impulse is along the normal");
        let momenta = meeting.momenta(self.words, turning.slack).into_iter();
        let mut measured: Vec<Measurement> = momenta.chain(meeting.moments(self.words, self.levers, turning.slack)).collect();
        let steps = schedule(time, 1, h).0;
        let law = compliant::rebound(bench, &self.springs, Approach { gap: GAP, speed: self.speed, steps }, turning.later);
        if law.is_some() || bench.description().contact_model.kind == Kind::Rigid {
            measured.push(returned(bench, h, (self.words, self.scene.material.restitution), (value, self.speed), turning.later, law));
        }
        measured.push(Measurement::new(format!("angle of the impulse to the normal{}", self.words), "rad", angle, straight));
        Ok(measured)
    }

    fn turning(&self, bench: &Bench, h: f64) -> Turning {
        let most = 2.0 * self.speed / self.inverse_mass();
        let solved = tolerance::ratio(bench.epsilon()) * most * self.spread;
        let spins = [0, 1].map(|k| most * self.spin(k).norm());
        let slides: f64 = (0..2).map(|k| spins[k] * self.levers[k].norm()).sum();
        let spin = spins[0] + spins[1];
        let round = self.scene.bodies.iter().filter_map(curvature).map(|curvature| slides * curvature).fold(0.0, f64::max);
        let closing = (3.0 * spin + round) * slides;
        // what parts with e > 0 is not pressed again, but an implicit step has turned the bodies already
        let parts = self.scene.material.restitution > 0.0 && !yields(bench);
        let later = tolerance::later(closing, if parts { h } else { DURATION }, self.speed);
        let time = lasting(bench, h) + later * DURATION;
        Turning { angle: (spin + round) * time, slack: solved + most * slides * time, later }
    }
}
