//! One run of the grid: what `moreau simulate` computes for it, sample by sample, in the digits that the page shows.
//!
//! ```text
//!     channels, each with a number for the start and one for every step:
//!     of every body       x, z [m], angle [rad], v_x, v_z [m/s], ω [rad/s], and y [m], by which it leaves the plane in space
//!     of the whole        T + V [J], smallest gap [m], natural map [N·s], relative residual, its verdict, its word
//!     of every contact    whether it was active, r_n, r_t₁, r_t₂ [N·s], u_n, u_t₁, u_t₂, ŷ_n, ŷ_t₁, ŷ_t₂ [m/s]
//! ```
//! u is the velocity at the contact after the step, ŷ = y + μ‖y_t‖n that of Coulomb's law and y that of an associated one: K ∋ r ⟂ ŷ ∈ K*.

use super::code::{encode, fixed, residual};
use super::grid::{Choice, scene};
use moreau_contact::certificate::{Judgement, StepResidual, natural_map, residuals};
use moreau_contact::contact::Place;
use moreau_contact::problem::{ContactProblem, Law};
use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::schemes::{Certified, Step, run_certified};
use moreau_exact::{Error, Result};
use moreau_replicas::staging::{for_scheme, plastic_if_needed};
use serde::Serialize;
use std::f64::consts::TAU;

/// Channels of a body, of the whole, and of a contact.
pub const WIDTHS: [usize; 3] = [7, 6, 10];

/// A run as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Run {
    /// The scheme with its parameters.
    pub scheme: String,
    /// `coulomb` or `associated`: what ŷ is.
    pub law: &'static str,
    /// h \[s\].
    pub h: f64,
    /// How many steps there are.
    pub steps: usize,
    /// The largest relative residual that is accepted.
    pub limit: f64,
    /// The contacts that were active, in the order of their channels.
    pub contacts: Vec<Slot>,
    /// The words of the residuals, which their channel counts.
    pub words: Vec<String>,
    /// The channels, as `encode` writes them.
    pub data: String,
}

/// A contact: its first body, its second one (−1: the ground), and which corners or faces touch.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Slot(pub usize, pub isize, pub [u32; 2]);

/// The scene and the note of a point of the grid: what a scheme without restitution changes.
///
/// # Errors
/// Those of the scheme's parameters.
pub fn posed(choice: &Choice) -> Result<(Scene, Option<&'static str>)> {
    let scene = scene(choice.scene)?.with(choice.friction, choice.restitution)?;
    Ok(plastic_if_needed(scene, choice.scheme()?.as_ref(), choice.scheme, None))
}

/// Simulates a point of the grid in the scene that it poses.
///
/// # Errors
/// Those of the steps: what the scheme refuses.
pub fn compute(choice: &Choice, scene: &Scene) -> Result<Run> {
    let (scheme, h) = (choice.scheme()?, choice.h()?);
    let staged = for_scheme(scene, choice.scheme)?;
    let mechanism = staged.mechanism.as_ref();
    let steps = (staged.duration / h).round() as usize;
    let mut table = Table::new(mechanism, &staged.start)?;
    let certified = Certified::new(&Auto);
    run_certified(scheme.as_ref(), &certified, mechanism, staged.start, h, steps, |step| table.push(step, scheme.is_truncated()))?;
    Ok(Run {
        scheme: scheme.name(),
        law: table.law,
        h,
        steps,
        limit: certified.tolerance(),
        data: encode(&table.channels()),
        contacts: table.slots,
        words: table.words,
    })
}

/// The channels of a run while it is computed.
struct Table<'a> {
    mechanism: &'a dyn Mechanism,
    samples: usize,
    law: &'static str,
    bodies: Vec<[Vec<i64>; WIDTHS[0]]>,
    whole: [Vec<i64>; WIDTHS[1]],
    slots: Vec<Slot>,
    contacts: Vec<[Vec<i64>; WIDTHS[2]]>,
    words: Vec<String>,
}

impl<'a> Table<'a> {
    fn new(mechanism: &'a dyn Mechanism, start: &State) -> Result<Self> {
        let count = mechanism.bodies(&start.position, &start.velocity).len();
        let mut table = Table {
            mechanism,
            samples: 0,
            law: "associated",
            bodies: vec![Default::default(); count],
            whole: Default::default(),
            slots: Vec::new(),
            contacts: Vec::new(),
            words: Vec::new(),
        };
        table.sample(start, [0; 4])?;
        Ok(table)
    }

    fn channels(&self) -> Vec<Vec<i64>> {
        self.bodies.iter().flatten().chain(&self.whole).chain(self.contacts.iter().flatten()).cloned().collect()
    }

    fn push(&mut self, step: &Step, truncated: bool) -> Result<()> {
        let posed = step.assembled.problem.as_ref().zip(step.solution.as_ref());
        let natural = match posed {
            Some((problem, solution)) => residual(residuals(problem, solution)?.natural_map),
            None => 0,
        };
        let judged = match step.residual {
            Some(worst) => [residual(worst.relative), verdict(step.judgement(truncated)), self.word(worst)],
            None => [0; 3],
        };
        self.sample(&step.state, [natural, judged[0], judged[1], judged[2]])?;
        if let Some((problem, solution)) = posed {
            self.law(problem.law());
            let y = problem.law_velocity(&solution.impulse);
            let rows = problem.rows_per_contact();
            let parts = solution.velocity.as_slice().chunks(rows).zip(y.as_slice().chunks(rows));
            for (k, (one, (u, y))) in step.impulses.iter().zip(parts).enumerate() {
                let place = one.place.ok_or_else(|| Error::Unsupported("a contact of a scene has a place".into()))?;
                self.contact(&place, [&one.impulse, u, &corrected(problem, k, y)]);
            }
        }
        Ok(())
    }

    fn sample(&mut self, state: &State, judged: [i64; 4]) -> Result<()> {
        for (channels, body) in self.bodies.iter_mut().zip(self.mechanism.bodies(&state.position, &state.velocity)) {
            let [x, y, z] = body.position;
            let [v_x, _, v_z] = body.linear_velocity;
            let before = channels[2].last().map_or(0.0, |angle| *angle as f64 / fixed(1.0) as f64);
            let values = [x, z, unwound(body.orientation, before), v_x, v_z, body.angular_velocity[1], y];
            channels.iter_mut().zip(values).for_each(|(channel, value)| channel.push(fixed(value)));
        }
        let gaps = self.mechanism.contacts(&state.position).into_iter().map(|contact| contact.gap);
        let gap = gaps.reduce(f64::min).ok_or_else(|| Error::Unsupported("the scene has no contact candidate".into()))?;
        let [natural, relative, verdict, word] = judged;
        let values = [fixed(self.mechanism.energy(state)), fixed(gap), natural, relative, verdict, word];
        self.whole.iter_mut().zip(values).for_each(|(channel, value)| channel.push(value));
        // a contact that is not active keeps its numbers, which then take no room
        for channels in &mut self.contacts {
            channels.iter_mut().for_each(|channel| channel.push(channel.last().copied().unwrap_or(0)));
            channels[0].last_mut().into_iter().for_each(|active| *active = 0);
        }
        self.samples += 1;
        Ok(())
    }

    /// r, u and ŷ of a contact that was active.
    fn contact(&mut self, place: &Place, parts: [&[f64]; 3]) {
        let slot = Slot(place.bodies.0, place.bodies.1.map_or(-1, |body| body as isize), place.features);
        // one that has acted in this step is another one with the same features
        let free = |at: &usize| self.slots[*at] == slot && self.contacts[*at][0].last() == Some(&0);
        let at = (0..self.slots.len()).find(free).unwrap_or_else(|| {
            self.slots.push(slot);
            self.contacts.push(std::array::from_fn(|_| vec![0; self.samples]));
            self.slots.len() - 1
        });
        let values = parts.into_iter().flat_map(|part| [0, 1, 2].map(|row| part.get(row).copied().unwrap_or(0.0))).map(fixed);
        let channels = self.contacts[at].iter_mut().zip(std::iter::once(1).chain(values));
        channels.for_each(|(channel, value)| channel.last_mut().into_iter().for_each(|last| *last = value));
    }

    fn law(&mut self, law: Law) {
        if matches!(law, Law::Coulomb | Law::PolyhedralCoulomb { .. }) {
            self.law = "coulomb";
        }
    }

    /// The place of the residual's word among those that were told.
    fn word(&mut self, worst: StepResidual) -> i64 {
        let word = match worst.rule {
            "certificate" => worst.residual.to_string(),
            rule => format!("{} of the {rule}", worst.residual),
        };
        let at = self.words.iter().position(|known| *known == word).unwrap_or_else(|| {
            self.words.push(word);
            self.words.len() - 1
        });
        at as i64
    }
}

/// 1, 2 and 3: accepted, unconverged by declaration, rejected; 0 is for nothing to solve.
fn verdict(judgement: Judgement) -> i64 {
    match judgement {
        Judgement::Accepted => 1,
        Judgement::Unconverged => 2,
        Judgement::Rejected => 3,
    }
}

/// ŷ: y with De Saxcé's term where the law is Coulomb's.
fn corrected(problem: &ContactProblem, contact: usize, y: &[f64]) -> Vec<f64> {
    let law = if matches!(problem.law(), Law::PolyhedralCoulomb { .. }) { Law::Coulomb } else { problem.law() };
    let mut corrected = y.to_vec();
    natural_map::correct(law, problem.friction()[contact], &mut corrected);
    corrected
}

/// The angle of a turn about ŷ nearest to the one before \[rad\].
pub fn unwound([w, _, y, _]: [f64; 4], before: f64) -> f64 {
    let angle = 2.0 * y.atan2(w);
    angle + TAU * ((before - angle) / TAU).round()
}
