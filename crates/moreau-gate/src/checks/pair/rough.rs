//! Two bodies meet with slip in one point that lies, for both, on the line of impact through their centres.
//!
//! ```text
//!     W_n = Σ 1/m ,   W_t = Σ 1/m + l²/J ,  uncoupled:   W_n p_n = (1 + e)|u_n| ,   ‖p_t‖ = min(μ p_n, ‖u_t‖/W_t) ,   L = l × p
//! ```
//! n = x, and friction on the second body acts along y.

use crate::checks::motion::yields;
use crate::checks::pair::compliant::{self, Approach, corner_radius, restitution};
use crate::checks::pair::friction;
use crate::checks::pair::meeting::{DURATION, Meeting, SPEED, lasting};
use crate::tolerance::pair as tolerance;
use crate::{Bench, Measurement};
use nalgebra::Vector3;

/// One impact; a floor is a second body of infinite mass and inertia.
pub(super) struct Rough<'a> {
    pub words: &'a str,
    pub mu: f64,
    pub e: f64,
    /// ‖u_t‖ \[m/s\].
    pub slip: f64,
    /// Whether the slip lasts to the end.
    pub slips: bool,
    pub masses: [f64; 2],
    /// From the centres to the point \[m\].
    pub levers: [f64; 2],
    /// J about z \[kg·m²\].
    pub moments: [f64; 2],
    /// Speed \[m/s\] at which the point moves along the second body before the impact.
    pub drift: f64,
    /// Whether the point is fixed to the first body, as a corner is, and turns with it.
    pub cornered: bool,
    /// The shortest length \[m\] that the errors of levers are parts of.
    pub size: f64,
}

impl Rough<'_> {
    fn inverse_mass(&self) -> f64 {
        self.masses.iter().map(|mass| 1.0 / mass).sum()
    }

    /// W_t \[1/kg\].
    fn across_mass(&self) -> f64 {
        self.inverse_mass() + (0..2).map(|k| self.levers[k] * self.levers[k] / self.moments[k]).sum::<f64>()
    }

    pub fn measured(&self, bench: &Bench, h: f64, meeting: &Meeting) -> Vec<Measurement> {
        let words = self.words;
        let [mean, still] = [1.0 / self.inverse_mass(), self.slip / self.across_mass()];
        let pushed = meeting.gains[1].impulse;
        let across = pushed.yz().norm();
        // both bodies turn, the point moves along the second, and a contact that stays closed presses on there
        let most = [2.0 * mean * SPEED, still];
        let turns = [0, 1].map(|k| self.levers[k] * most[1] / self.moments[k]);
        let along = most[1] / mean + self.drift;
        // a turning corner rises, so that no more than a second step presses it, or as long as it yields
        let presses = meeting.lasted.max(2.0 * h);
        let swing = if self.cornered { turns[0] * self.levers[0] } else { 0.0 };
        let closing = turns[1] * (2.0 * along + self.levers[1] * turns[1]);
        let later = tolerance::later(closing, DURATION, SPEED) + tolerance::later(turns[0] * swing, presses, SPEED);
        let pressed_on = if yields(bench) { 1.0 } else { later };
        let moved = h * (2.0 * self.drift + swing) + pressed_on * DURATION * (along + swing);
        let slack = meeting.apart * across + most[0] * moved;
        let levers = [Vector3::x() * self.levers[0], Vector3::x() * -self.levers[1]];
        let mut measured = Vec::new();
        let on_floor = self.masses[1].is_infinite();
        if !on_floor {
            measured.extend(meeting.momenta(words, slack));
        }
        measured.extend(meeting.moments(words, levers, slack).into_iter().take(if on_floor { 1 } else { 2 }));
        // a sphere at the corner touches later than the corner, and may have another point beside it
        let rounded = self.cornered && corner_radius(bench) > 0.0;
        let point = if rounded { Vec::new() } else { compliant::one_point(bench, self.inverse_mass(), &self.masses, h) };
        measured.extend(restitution(
            bench,
            h,
            (words, self.e),
            pushed.x / (mean * SPEED) - 1.0,
            later,
            self.mu * self.slip,
            (&point, Approach::usual(h)),
        ));
        let (ideal, law) = friction::opposed(bench);
        let angle = pushed.z.abs().atan2(pushed.y);
        measured.push(Measurement::new(format!("angle of friction to the slip{words}"), "rad", angle, ideal).predicted(law));
        if self.slips && friction::on_the_cone(bench) {
            let turned = turns[1] * (lasting(bench, h) + later * DURATION);
            let (ideal, law) = friction::slipping(bench, self.mu, tolerance::turned_ratio(turned, self.mu));
            let value = friction::ratio([pushed.x, across]);
            measured.push(Measurement::new(format!("friction over normal impulse{words}"), "1", value, ideal).predicted(law));
        } else if !self.slips && friction::sticks(bench) && !friction::opens(bench) {
            // what presses later may take along what friction it allows
            let (ideal, law) = friction::sticking(bench, meeting.apart / self.size, later * self.mu * most[0] / still);
            measured.push(Measurement::new(format!("friction over u_t/W_t{words}"), "1", across / still, ideal).predicted(law));
        }
        measured
    }
}
