//! Stewart–Trinkle: the gap at the end of the step is part of the complementarity, friction is polyhedral.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r ,   0 ≤ r_n ⟂ φ/h + u_n⁺ ≥ 0 ,   r_t = Σ Dⱼβⱼ opposes sliding,
//!     q⁺ = q + h v⁺ .
//! ```
//! Every contact candidate takes part: a contact that cannot be reached within the step has φ/h + u_n⁺ > 0 and hence
//! no impulse, so leaving it out would change nothing, and keeping it needs no bound on the unknown v⁺.
//! All forces are explicit, the linear ones too, as in the chapter. There is no restitution: e of the mechanism is not used (a plastic
//! impact law).
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ r_n φ/h − ½ rᵀW r ,      ΔẼ ≤ −Σ r_n φ/h + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! A depth is paid back as speed: −r_n φ/h > 0 where φ < 0; an open contact that acts takes energy (`moreau::checks::energy_balance`).

use super::assembly::{self, Candidate, Rules, normal_only};
use super::{Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use crate::tolerance::limits::DIRECTIONS;
use moreau_contact::contact::Components;
use moreau_contact::problem::Law;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The scheme of Stewart and Trinkle.
///
/// # Source
/// Chapter §4; Stewart and Trinkle, *An implicit time-stepping scheme for rigid body dynamics with inelastic
/// collisions and Coulomb friction* (1996).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StewartTrinkle {
    /// d ≥ 3 friction directions of a spatial contact; a planar contact has the two senses of its tangent.
    pub directions: usize,
}

impl Default for StewartTrinkle {
    fn default() -> Self {
        StewartTrinkle { directions: 8 }
    }
}

impl StewartTrinkle {
    /// Checks d.
    ///
    /// # Errors
    /// If d < 3 or d > [`DIRECTIONS`].
    pub fn validate(&self) -> Result<()> {
        if (3..=DIRECTIONS).contains(&self.directions) {
            return Ok(());
        }
        let cure = format!("use a whole number from 3 to {DIRECTIONS} (planar contacts always have the two senses of their tangent)");
        Err(Error::invalid("directions", format!("is {}", self.directions), cure))
    }
}

impl Rules for StewartTrinkle {
    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
        normal_only(candidate.contact.gap / h, candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        match rows_per_contact {
            1 => Law::Frictionless,
            2 => Law::PolyhedralCoulomb { directions: 2 },
            _ => Law::PolyhedralCoulomb { directions: self.directions },
        }
    }
}

impl Scheme for StewartTrinkle {
    fn name(&self) -> String {
        format!("stewart-trinkle directions={}", self.directions)
    }

    fn has_restitution(&self) -> bool {
        false
    }

    passes_the_waist!();
}

impl Waist for StewartTrinkle {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        self.validate()?;
        assembly::assemble("stewart-trinkle", self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        at.mechanism().integrate(&at.state().position, velocity_post, at.h())
    }
}
