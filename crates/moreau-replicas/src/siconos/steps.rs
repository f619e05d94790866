//! Stored steps of Siconos, taken again by our schemes from each of Siconos's own states.
//!
//! ```text
//!     (q_k, v_k) stored ──► one step of ours ──► |q − q_{k+1}| , |v − v_{k+1}| , |r − r_{k+1}|
//! ```
//! Siconos's solvers were direct ones, so that nothing but rounding may lie between. Two things differ, and are modelled here. For a
//! nonlinear constraint `MoreauJeanOSI` of 4.4.0 takes H at q_k + h v_k, not at q_k. `SchatzmanPaoliOSI` keeps positions only,
//! ```text
//!     M (q_{k+1} − 2 q_k + q_{k−1}) = h² F(q_k) + h Hᵀr ,   0 ≤ r ⟂ φ(q_{k+1}) + e φ(q_{k−1}) ≥ 0 ,      q_1 = q_0 + h v_0 ,
//! ```
//! which is our scheme with v_k = (q_k − q_{k−1})/h; the velocity it shows is (q_k − q_{k−2})/(2h) instead, and a step from q_0 to q_1 is
//! never one with contact.

use crate::tolerance::references::{siconos_double_sum, siconos_run, siconos_step};
use moreau_contact::contact::Contact;
use moreau_contact::solvers::{Auto, ContactSolver, LemkePivoting};
use moreau_dynamics::mechanics::{
    BallChain, BeadInCircle, LinearForce, Mechanism, OscillatorWithStop, Plane, PointMass, State, answers_as,
};
use moreau_dynamics::schemes::{MoreauJean, MoreauJeanProjection, SchatzmanPaoli, Scheme, step};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DVector, dvector};
use serde::Deserialize;

/// A run of Siconos, format `siconos-steps/1`.
#[derive(Clone, Debug, Deserialize)]
pub struct SiconosSteps {
    system: Stored,
    scheme: Integrator,
    /// h \[s\].
    pub time_step: f64,
    /// q at the start and after every step.
    pub positions: Vec<Vec<f64>>,
    /// v likewise.
    pub velocities: Vec<Vec<f64>>,
    /// r of every contact in every step \[N·s\], normal first.
    pub impulses: Vec<Vec<f64>>,
    provenance: Provenance,
}

/// A system with its parameters.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(super) enum Stored {
    Ball { mass: f64, gravity: f64, restitution: f64 },
    Block { mass: f64, gravity: [f64; 2], friction: f64, restitution: f64 },
    Puck { mass: f64, gravity: [f64; 3], friction: f64, restitution: f64 },
    Stop { mass: f64, stiffness: f64, stop: f64, restitution: f64 },
    Chain { masses: Vec<f64>, radii: Vec<f64>, restitution: f64 },
    Bead { mass: f64, radius: f64, gravity: f64, restitution: f64 },
}

#[derive(Clone, Debug, Deserialize)]
struct Integrator {
    class: String,
    theta: f64,
}

#[derive(Clone, Debug, Deserialize)]
pub(super) struct Provenance {
    pub(super) version: String,
}

impl Stored {
    /// The mechanism itself.
    pub(super) fn mechanism(&self) -> Result<Box<dyn Mechanism>> {
        Ok(match self {
            Stored::Ball { mass, gravity, restitution } => {
                let floor = Plane::new(dvector![1.0], 0.0, 0.0, *restitution)?;
                Box::new(PointMass::new("ball", *mass, dvector![-gravity], vec![floor])?)
            }
            Stored::Block { mass, gravity: [along, down], friction, restitution } => {
                let slope = Plane::new(dvector![0.0, 1.0], 0.0, *friction, *restitution)?;
                Box::new(PointMass::new("block", *mass, dvector![*along, -down], vec![slope])?)
            }
            Stored::Puck { mass, gravity: [along, across, down], friction, restitution } => {
                let slope = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, *friction, *restitution)?;
                Box::new(PointMass::new("puck", *mass, dvector![*along, *across, -down], vec![slope])?)
            }
            Stored::Stop { mass, stiffness, stop, restitution } => {
                Box::new(OscillatorWithStop::new(*mass, *stiffness, 0.0, *stop, *restitution)?)
            }
            Stored::Chain { masses, radii, restitution } => Box::new(BallChain::new(masses.clone(), radii.clone(), *restitution)?),
            Stored::Bead { mass, radius, gravity, restitution } => {
                Box::new(BeadInCircle::new(*mass, *radius, *gravity, 0.0, *restitution)?)
            }
        })
    }
}

impl SiconosSteps {
    /// Reads a stored run.
    ///
    /// # Errors
    /// If the text is not such a run, or its lists differ in length.
    pub fn from_json(text: &str) -> Result<Self> {
        let run: SiconosSteps = serde_json::from_str(text)?;
        let states = run.impulses.len() + 1;
        if run.positions.len() != states || run.velocities.len() != states || states == 1 {
            let problem = format!("has {} for {}", counted(run.positions.len(), "row"), counted(run.impulses.len(), "step"));
            return Err(Error::invalid("positions", problem, "store the start and one row per step"));
        }
        Ok(run)
    }

    /// The version of Siconos that made the run.
    pub fn version(&self) -> &str {
        &self.provenance.version
    }

    /// Whether the run was made with combined projection.
    pub fn is_projected(&self) -> bool {
        self.scheme.class == "MoreauJeanCombinedProjectionOSI"
    }

    /// Whether the run keeps two positions in place of position and velocity.
    pub fn is_two_step(&self) -> bool {
        self.scheme.class == "SchatzmanPaoliOSI"
    }

    /// Our scheme of the same name, with θ changed by `off` if it has one.
    ///
    /// # Errors
    /// If the run's integrator is none of ours.
    pub fn scheme(&self, off: f64) -> Result<Box<dyn Scheme>> {
        let theta = self.scheme.theta + off;
        match self.scheme.class.as_str() {
            "MoreauJeanOSI" => Ok(Box::new(MoreauJean { theta, ..MoreauJean::default() })),
            "MoreauJeanCombinedProjectionOSI" => Ok(Box::new(MoreauJeanProjection { theta })),
            "SchatzmanPaoliOSI" => Ok(Box::new(SchatzmanPaoli)),
            other => Err(Error::Unsupported(format!("no scheme of ours is Siconos's {other}"))),
        }
    }

    /// The mechanism itself.
    ///
    /// # Errors
    /// If a stored parameter is not valid.
    pub fn mechanism(&self) -> Result<Box<dyn Mechanism>> {
        self.system.mechanism()
    }

    /// The mechanism as Siconos sees it in a step from this state.
    fn seen_from(&self, state: &State) -> Result<Box<dyn Mechanism>> {
        let mechanism = self.mechanism()?;
        if self.is_projected() || !matches!(self.system, Stored::Bead { .. }) {
            return Ok(mechanism);
        }
        let position = mechanism.integrate(&state.position, &state.velocity, self.time_step);
        Ok(Box::new(Ahead { mechanism, position }))
    }

    /// The stored state after k steps; of a two-step scheme with the velocity (q_k − q_{k−1})/h, which it has from k = 1.
    pub fn state(&self, k: usize) -> State {
        let [position, mut velocity] = [&self.positions, &self.velocities].map(|rows| DVector::from_column_slice(&rows[k]));
        if self.is_two_step() && k > 0 {
            velocity = (&position - DVector::from_column_slice(&self.positions[k - 1])) / self.time_step;
        }
        State { time: k as f64 * self.time_step, position, velocity }
    }

    /// The first step that poses a contact problem.
    fn first_step(&self) -> usize {
        usize::from(self.is_two_step())
    }

    /// Lemke's method, which knows no spatial friction, and one contact to rounding where there is some.
    fn solver(&self) -> Box<dyn ContactSolver> {
        if matches!(self.system, Stored::Puck { .. }) { Box::new(Auto) } else { Box::new(LemkePivoting) }
    }

    /// The largest |v_k − (q_k − q_{k−2})/(2h)| \[m/s\], v_k being the velocities shown.
    pub fn distance_from_central_differences(&self) -> f64 {
        let apart = |k: usize| {
            let ends = self.positions[k].iter().zip(&self.positions[k - 2]);
            ends.zip(&self.velocities[k])
                .map(|((after, before), v)| (v - (after - before) / (2.0 * self.time_step)).abs())
                .fold(0.0, f64::max)
        };
        (2..self.positions.len()).map(apart).fold(0.0, f64::max)
    }

    /// The largest |Δq| \[m\], |Δv| \[m/s\] and |Δr| \[N·s\] of all single steps of a scheme against the stored ones.
    ///
    /// # Errors
    /// Those of the scheme.
    pub fn deviations(&self, scheme: &dyn Scheme) -> Result<[f64; 3]> {
        self.compare(|state| self.seen_from(state), scheme)
    }

    /// The largest differences as [`deviations`](Self::deviations) gives them, with H at q_k, where our schemes evaluate it.
    ///
    /// # Errors
    /// Those of the scheme.
    pub fn deviations_with_present_normals(&self, scheme: &dyn Scheme) -> Result<[f64; 3]> {
        self.compare(|_| self.mechanism(), scheme)
    }

    fn compare(&self, mechanism: impl Fn(&State) -> Result<Box<dyn Mechanism>>, scheme: &dyn Scheme) -> Result<[f64; 3]> {
        let mut worst = [0.0f64; 3];
        let solver = self.solver();
        for (k, stored) in self.impulses.iter().enumerate().skip(self.first_step()) {
            let (state, wanted) = (self.state(k), self.state(k + 1));
            let mechanism = mechanism(&state)?;
            let made = step(scheme, solver.as_ref(), mechanism.as_ref(), &state, self.time_step)?;
            let contacts = mechanism.contacts(&state.position).len();
            let rows = stored.len() / contacts;
            let mut impulses = vec![0.0; stored.len()];
            for one in &made.impulses {
                impulses[one.contact * rows..][..rows].copy_from_slice(&one.impulse[..rows]);
            }
            let apart = impulses.iter().zip(stored).map(|(ours, theirs)| (ours - theirs).abs()).fold(0.0, f64::max);
            let [position, velocity] = [(made.state.position - wanted.position).amax(), (made.state.velocity - wanted.velocity).amax()];
            for (largest, one) in worst.iter_mut().zip([position, velocity, apart]) {
                *largest = largest.max(one);
            }
        }
        Ok(worst)
    }

    /// The largest |Δq| \[m\] of a whole motion of a scheme from the stored start.
    ///
    /// # Errors
    /// Those of the scheme.
    pub fn whole_run(&self, scheme: &dyn Scheme) -> Result<f64> {
        let first = self.first_step();
        let (mut state, mut worst, solver) = (self.state(first), 0.0f64, self.solver());
        for k in first + 1..self.positions.len() {
            let mechanism = self.seen_from(&state)?;
            state = step(scheme, solver.as_ref(), mechanism.as_ref(), &state, self.time_step)?.state;
            worst = worst.max((&state.position - self.state(k).position).amax());
        }
        Ok(worst)
    }

    /// How far one step may be from the stored one, in each of the three units.
    pub fn tolerance(&self) -> f64 {
        let largest =
            [&self.positions, &self.velocities, &self.impulses].into_iter().flatten().flatten().fold(1.0, |a: f64, b| a.max(b.abs()));
        siconos_step(largest)
    }

    /// How far position, velocity and impulse may be from the stored ones after one step. A two-step scheme knows its velocity to the
    /// rounding of a position divided by h, and its impulse to m times that.
    pub fn tolerances(&self) -> [f64; 3] {
        let (one, h) = (self.tolerance(), self.time_step);
        if !self.is_two_step() {
            return [one; 3];
        }
        let heaviest = match &self.system {
            Stored::Chain { masses, .. } => masses.iter().copied().fold(0.0, f64::max),
            Stored::Ball { mass, .. } | Stored::Stop { mass, .. } | Stored::Bead { mass, .. } => *mass,
            Stored::Block { mass, .. } | Stored::Puck { mass, .. } => *mass,
        };
        [one, one / h, heaviest * one / h]
    }

    /// How far the position of a whole run may be from the stored one \[m\].
    pub fn run_tolerance(&self) -> f64 {
        let sum = if self.is_two_step() { siconos_double_sum } else { siconos_run };
        sum(self.impulses.len(), self.tolerance())
    }
}

/// A mechanism with its own gaps at q and its contact normals at another place: Siconos's q_k + h v_k.
struct Ahead {
    mechanism: Box<dyn Mechanism>,
    position: DVector<f64>,
}

impl Mechanism for Ahead {
    answers_as!(self, mechanism);

    fn linear_force(&self) -> Option<LinearForce> {
        self.mechanism.linear_force()
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let ahead = self.mechanism.contacts(&self.position).into_iter();
        self.mechanism.contacts(position).into_iter().zip(ahead).map(|(here, there)| Contact { jacobian: there.jacobian, ..here }).collect()
    }
}
