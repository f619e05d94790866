//! The energy balance of one step, for every scheme: what contact may do to the kinetic and to the total energy, and what is no theorem.
//!
//! ```text
//!     T(v⁺) = T(v_free) + r·u⁺ − ½ rᵀW r                              for every r: the velocity is the one the impulses make
//!     r·u⁺ ≤ −r·(shift + R r) + w ,    w = Σ_k max(0, r_k·y_k)        the law; w is what the step's residual adds, zero at a solution
//!     ΔẼ ≤ (1−e)/(1+e) · h²FᵀM⁻¹F/8 + …                               the total energy under a constant force, one e for all contacts
//! ```
//! The first two give T(v⁺) ≤ T(v_free) − r·(shift + R r) − ½ rᵀW r + w: with e = 0 never more than T(v_free), with Newton's restitution on
//! normals and friction at most −Σ e_k r_n u_n⁻ − ½ rᵀW r more. The third is the gain of the discretisation of gravity. Derivations: of the
//! law in `law.rs`, of the total energy in `total.rs`, of rotation in `gyroscopic.rs`, of linear forces (M̂ ≠ M) in `linear.rs`, of schemes
//! without a contact problem in `own.rs`, of distances in [`reach`].
//!
//! A balance takes one step as it was made: the state before, the [`Step`](moreau_dynamics::schemes::Step), the mechanism and h. It takes H
//! and M̂ from the step, the impulses that the step reports, and everything else – the shift, the force, the energies – from the mechanism.
//! Where no theorem bounds a quantity there is no finding on it.
//!
//! A step whose residual is too large for the certificate is told by the finding [`RESIDUAL`]; the other findings hold for it all the same,
//! with its w.

use crate::schemes::SchemeParameters;
use moreau_dynamics::schemes::{MoreauJean, RestitutionRule};
use moreau_exact::Result;
use position::Position;
use shift::Shift;
use waist::{Regularised, WaistLaw};

mod constant;
pub mod defects;
mod exchange;
mod gyroscopic;
mod judged;
mod law;
mod linear;
mod own;
mod position;
pub mod reach;
mod shift;
pub mod table;
#[cfg(test)]
mod tests;
mod through_waist;
mod total;
mod waist;

pub use judged::{GYROSCOPIC, GYROSCOPIC_ENERGY, IDENTITY, Judged, KINETIC, RESIDUAL, TOTAL, TOTAL_IDENTITY, Taken};

/// The balance of one scheme with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance(Kind);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Waist(WaistLaw),
    Variational,
    Events,
    NoTheorem,
}

/// A scheme whose forces are means over the step and whose contacts are stiff.
const fn waist(shift: Shift, position: Position) -> Kind {
    Kind::Waist(WaistLaw { shift, position, explicit: false, implicit: false, regularised: None })
}

impl Balance {
    /// The balance of the scheme with this name and these parameters.
    ///
    /// # Errors
    /// Those of [`crate::schemes::by_name`] for an unknown name or for parameters that are not valid.
    ///
    /// ```
    /// use moreau_replicas::energy_balance::Balance;
    /// use moreau_replicas::schemes::SchemeParameters;
    ///
    /// let parameters = SchemeParameters::default();
    /// assert!(Balance::of("moreau-jean", &parameters)?.is_theorem());
    /// assert!(Balance::of("no-such-scheme", &parameters).is_err());
    /// # Ok::<(), moreau_exact::Error>(())
    /// ```
    pub fn of(name: &str, parameters: &SchemeParameters) -> Result<Self> {
        crate::schemes::by_name(name, *parameters)?;
        let newton = Shift::Newton { full: false };
        let gap = Shift::Gap { relaxation: 0.0 };
        let kind = match name {
            "moreau-jean" => return Ok(parameters.moreau_jean()),
            "moreau-jean-projection" => waist(Shift::NewtonAtStart, Position::Corrected),
            "schatzman-paoli" => waist(Shift::SchatzmanPaoli, Position::Theta(1.0)),
            "generalised-alpha" => waist(newton, Position::Remembering),
            "stewart-trinkle" | "anitescu" => waist(gap, Position::Theta(1.0)),
            "chrono" => waist(Shift::Chrono(crate::chrono::Chrono::default()), Position::Theta(1.0)),
            "bullet" => {
                let split = parameters.bullet.bodies == crate::bullet::Bodies::Rigid;
                waist(Shift::Bullet(parameters.bullet), if split { Position::Corrected } else { Position::Theta(1.0) })
            }
            "mujoco" => {
                let shift = Shift::Mujoco(parameters.mujoco.softness);
                let plain =
                    crate::mujoco::Mujoco { cone: parameters.mujoco.cone, softness: parameters.mujoco.softness, ..Default::default() };
                let law = WaistLaw { shift, position: Position::Theta(1.0), explicit: true, implicit: false, regularised: None };
                if plain == parameters.mujoco { Kind::Waist(law) } else { Kind::NoTheorem }
            }
            "explicit-euler" => waist(newton, Position::Theta(0.0)),
            "semi-implicit-euler" => waist(newton, Position::Theta(1.0)),
            "runge-kutta-flip" => waist(Shift::NewtonOfFree, Position::Flight),
            "drake-sap" => waist(Shift::Gap { relaxation: parameters.drake.relaxation_time }, Position::Theta(1.0)),
            "drake-similar" | "drake-lagged" | "drake-tamsi" => {
                let drake = parameters.drake;
                let regularised = Some(Regularised { stiffness: drake.stiffness, damped: drake.dissipation > 0.0 });
                Kind::Waist(WaistLaw { shift: gap, position: Position::Theta(1.0), explicit: false, implicit: false, regularised })
            }
            "variational" => Kind::Variational,
            "event-driven" => Kind::Events,
            _ => Kind::NoTheorem,
        };
        Ok(Balance(kind))
    }

    /// The balance of Moreau–Jean.
    pub fn of_moreau_jean(scheme: &MoreauJean) -> Self {
        let full = scheme.restitution == RestitutionRule::FullVector;
        let (shift, position) = (Shift::Newton { full }, Position::Theta(scheme.theta));
        Balance(Kind::Waist(WaistLaw { shift, position, explicit: false, implicit: true, regularised: None }))
    }

    /// Whether there is any theorem on a step of this scheme.
    pub fn is_theorem(&self) -> bool {
        self.0 != Kind::NoTheorem
    }

    /// What the balance says of one step.
    ///
    /// # Errors
    /// If the step does not have the impulses of the contacts it assembled, or a mass matrix is not positive definite.
    pub fn judge(&self, taken: &Taken) -> Result<Judged> {
        match &self.0 {
            Kind::Waist(waist) => waist.judge(taken),
            Kind::Variational => own::variational(taken),
            Kind::Events => own::events(taken),
            Kind::NoTheorem => Ok(own::nothing()),
        }
    }
}

impl SchemeParameters {
    fn moreau_jean(&self) -> Balance {
        let SchemeParameters { theta, activation, restitution, .. } = *self;
        Balance::of_moreau_jean(&MoreauJean { theta, activation, restitution })
    }
}
