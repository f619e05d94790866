//! Planted mistakes of schemes that pose one contact problem a step: what they pose, what they move with, where they move to.

use crate::planted::{Kind, Planted};
use moreau_contact::contact::Jacobian;
use moreau_contact::problem::ContactProblem;
use moreau_dynamics::schemes::{Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// What a mistake changes of a step.
#[derive(Clone, Copy)]
pub struct Alteration {
    /// Changes what is posed.
    pub posed: fn(&StepContext, StepProblem) -> Result<StepProblem>,
    /// Changes the velocity v⁺ that positions move with.
    pub velocity: fn(&StepContext, DVector<f64>) -> DVector<f64>,
    /// Changes the new position, given v⁺.
    pub moved: fn(&StepContext, &DVector<f64>, DVector<f64>) -> DVector<f64>,
    /// Changes the position that a scheme has corrected.
    pub settled: fn(DVector<f64>) -> DVector<f64>,
}

impl Alteration {
    /// Nothing changed.
    pub const NONE: Alteration =
        Alteration { posed: |_, step| Ok(step), velocity: |_, v| v, moved: |_, _, position| position, settled: |position| position };

    /// The scheme with this mistake.
    pub fn of<S: Waist>(self, scheme: S) -> Mistaken<S> {
        Mistaken { scheme, alteration: self }
    }
}

/// A scheme with a mistake.
pub struct Mistaken<S> {
    /// The scheme without it.
    pub scheme: S,
    /// The mistake.
    pub alteration: Alteration,
}

impl<S: Waist> Scheme for Mistaken<S> {
    fn name(&self) -> String {
        self.scheme.name()
    }

    fn has_restitution(&self) -> bool {
        self.scheme.has_restitution()
    }

    fn is_truncated(&self) -> bool {
        self.scheme.is_truncated()
    }

    passes_the_waist!();
}

impl<S: Waist> Waist for Mistaken<S> {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        (self.alteration.posed)(at, self.scheme.assemble(at)?)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let velocity = (self.alteration.velocity)(at, velocity_post.clone());
        (self.alteration.moved)(at, velocity_post, self.scheme.advance(at, &velocity))
    }

    fn settle(&self, at: &StepContext, assembled: &StepProblem, position: DVector<f64>) -> Result<DVector<f64>> {
        Ok((self.alteration.settled)(self.scheme.settle(at, assembled, position)?))
    }
}

/// One constant per mistake, and the list of all.
macro_rules! mistakes {
    ($($constant:ident = $kind:ident $name:literal, $mistake:literal, $($field:ident: $change:expr),+;)*) => {
        $(
            #[doc = $mistake]
            pub const $constant: Planted<Alteration> = Planted {
                name: $name,
                mistake: $mistake,
                kind: Kind::$kind,
                subject: Alteration { $($field: $change,)+ ..Alteration::NONE },
            };
        )*
        /// Every mistake of this family.
        pub const PLANTED: &[Planted<Alteration>] = &[$($constant),*];
    };
}

mistakes! {
    HEAVY = Scheme "scheme/forces-too-strong", "forces 10 % too strong", posed: heavy;
    HALF_FRICTION = Assembly "scheme/half-friction", "half of every μ", posed: |_, step| {
        problem(step, |problem| {
            let friction = problem.friction().iter().map(|mu| 0.5 * mu).collect();
            problem.into_builder().friction(friction).build()
        })
    };
    AHEAD = Scheme "scheme/positions-ahead", "positions moved on by half the change of velocity as well",
        // only where positions have as many entries as velocities: not with quaternions
        moved: |at, velocity, position| {
            let change = velocity - &at.state().velocity;
            if change.len() == position.len() { position + change * (0.5 * at.h()) } else { position }
        },
        settled: |position| position.add_scalar(f64::EPSILON.sqrt());
    RESTITUTION_FORGOTTEN = Assembly "energy/restitution-forgotten",
        "the shift e v is left out: every impact is plastic",
        posed: |_, step| problem(step, restitution_forgotten);
    RESTITUTION_OF_FREE = Scheme "ball/restitution-of-the-free-velocity",
        "multiplies e with the velocity after gravity, so that every contact also reverses one step of gravity",
        posed: restitution_of_the_free_velocity;
    MASS_FOR_INVERSE = Assembly "energy/delassus-with-mass", "W = H M Hᵀ instead of H M⁻¹ Hᵀ: right only for m = 1",
        posed: |_, step| problem(step, mass_for_its_inverse);
    RESTITUTION_OF_THE_SLIP = Assembly "scheme/restitution-of-the-slip",
        "reverses a share e of the slip as well, where e is that of normals",
        posed: restitution_of_the_slip;
    BLIND_TO_FORCES = Assembly "scheme/contact-blind-to-forces",
        "poses the contact for v in place of v_free, without the forces of the step",
        posed: |at, step| {
            let free = &*step.jacobian * &at.state().velocity;
            problem(step, |problem| problem.into_builder().free_velocity(free).build())
        };
    ROWS_APART = Assembly "scheme/coupling-dropped", "leaves the coupling of rows and of contacts out of W",
        posed: |_, step| problem(step, rows_apart);
    FIRST_CONTACT = Assembly "scheme/first-contact-only",
        "holds the first of the active contacts and forgets the others",
        posed: first_contact;
    FRICTION_REVERSED = Scheme "scheme/friction-applied-in-reverse", "applies friction to the body in the sense it has for the ground",
        posed: |at, mut step| {
            let rows = at.mechanism().rows_per_contact();
            let tangential = (0..step.jacobian.nrows()).filter(|row| row % rows != 0);
            let mut turned = step.jacobian.to_dense();
            tangential.for_each(|row| turned.row_mut(row).neg_mut());
            step.jacobian = Arc::new(Jacobian::from_dense(&turned, rows));
            Ok(step)
        };
    IMPULSE_AS_FORCE = Scheme "scheme/impulse-as-force", "applies the impulse of the contact for the time of the step, as a force",
        posed: |at, mut step| {
            step.jacobian = Arc::new(Jacobian::from_dense(&(step.jacobian.to_dense() * at.h()), at.mechanism().rows_per_contact()));
            Ok(step)
        };
    THROUGH_CONTACT = Scheme "scheme/positions-through-contact", "moves positions as if there were no contact in this step",
        velocity: |at, velocity| at.forecast().cloned().unwrap_or(velocity);
    SINGLE = Scheme "metamorphic/single-precision-positions", "stores positions with 24 bits and declares double precision",
        moved: |_, _, position| position.map(|x| f64::from(x as f32));
    LIMITED = Scheme "metamorphic/absolute-speed-limit", "limits every speed to 100 of whatever unit the scene has",
        velocity: |_, velocity| velocity.map(|v| v.clamp(-100.0, 100.0));
    DAMPED = Scheme "metamorphic/damping-in-the-world", "takes 4 % a second from every velocity and does not declare it",
        posed: |at, step| damped(step, 1.0 - 0.04 * at.h());
    DAMPED_PER_STEP = Scheme "metamorphic/damping-per-step", "takes 1 % from every velocity in every step, however long the step is",
        posed: |_, step| damped(step, 0.99);
    BAUMGARTE = Scheme "energy/baumgarte", "pushes bodies out of the floor within one step, with a velocity that stays", posed: baumgarte;
}

/// The step with its contact problem changed.
fn problem(mut step: StepProblem, change: impl FnOnce(ContactProblem) -> Result<ContactProblem>) -> Result<StepProblem> {
    step.problem = step.problem.map(change).transpose()?;
    Ok(step)
}

/// A mistake: the shift e u⁻ is left out.
///
/// # Errors
/// None: a problem without a shift is valid.
pub fn restitution_forgotten(problem: ContactProblem) -> Result<ContactProblem> {
    let shift = DVector::zeros(problem.rows());
    problem.into_builder().shift(shift).build()
}

fn mass_for_its_inverse(problem: ContactProblem) -> Result<ContactProblem> {
    let Some(dynamics) = problem.dynamics() else { return Ok(problem) };
    let delassus = &dynamics.jacobian * &dynamics.mass * dynamics.jacobian.transpose();
    problem.into_builder().dynamics(None).delassus(delassus).build()
}

fn rows_apart(problem: ContactProblem) -> Result<ContactProblem> {
    let delassus = DMatrix::from_diagonal(&problem.dense().diagonal());
    problem.into_builder().dynamics(None).delassus(delassus).build()
}

fn heavy(at: &StepContext, mut step: StepProblem) -> Result<StepProblem> {
    let more = (&step.free_velocity - &at.state().velocity) * 0.1;
    step.free_velocity += &more;
    let moved = &*step.jacobian * &more;
    problem(step, |problem| {
        let free = problem.free_velocity() + moved;
        problem.into_builder().free_velocity(free).build()
    })
}

fn damped(mut step: StepProblem, factor: f64) -> Result<StepProblem> {
    step.free_velocity *= factor;
    let free = &*step.jacobian * &step.free_velocity;
    problem(step, |problem| problem.into_builder().free_velocity(free).build())
}

/// e v_free on the normal rows, with e from what the shift has there.
fn restitution_of_the_free_velocity(at: &StepContext, step: StepProblem) -> Result<StepProblem> {
    let before = &*step.jacobian * &at.state().velocity;
    problem(step, |problem| {
        let mut shift = problem.shift().clone();
        let normal = (0..problem.rows()).step_by(problem.rows_per_contact());
        normal.filter(|n| before[*n] != 0.0).for_each(|n| shift[n] *= problem.free_velocity()[n] / before[n]);
        problem.into_builder().shift(shift).build()
    })
}

/// e u_t on the tangential rows, with e from what the shift has on the normal one.
fn restitution_of_the_slip(at: &StepContext, step: StepProblem) -> Result<StepProblem> {
    let before = &*step.jacobian * &at.state().velocity;
    problem(step, |problem| {
        let rows = problem.rows_per_contact();
        let mut shift = problem.shift().clone();
        for n in (0..problem.rows()).step_by(rows).filter(|n| before[*n] != 0.0) {
            let e = shift[n] / before[n];
            (n + 1..n + rows).for_each(|row| shift[row] = e * before[row]);
        }
        problem.into_builder().shift(shift).build()
    })
}

/// The others are told as contacts that open fast.
fn first_contact(_: &StepContext, step: StepProblem) -> Result<StepProblem> {
    problem(step, |problem| {
        let mut shift = problem.shift().clone();
        let rows = problem.rows_per_contact();
        (rows..problem.rows()).step_by(rows).for_each(|n| shift[n] += 1e3);
        problem.into_builder().shift(shift).build()
    })
}

/// u_n ≥ −φ/h of every active contact below the floor.
fn baumgarte(at: &StepContext, step: StepProblem) -> Result<StepProblem> {
    let gaps: Vec<f64> = step.active.iter().map(|&contact| at.contacts().get(contact).map_or(0.0, |contact| contact.gap)).collect();
    problem(step, |problem| {
        let mut shift = problem.shift().clone();
        let rows = problem.rows_per_contact();
        gaps.iter().enumerate().for_each(|(k, gap)| shift[rows * k] += gap.min(0.0) / at.h());
        problem.into_builder().shift(shift).build()
    })
}
