//! Drake's discrete contact: four laws at the contacts with φ < 0, one way to move on.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r(v⁺) ,     q⁺ = q + h v⁺ ,     contacts with φ(q) < 0
//!     w = ‖H_i diag(M)⁻¹ H_iᵀ‖_F / 3          a contact's response, from the diagonal of M in the mechanism's own velocities
//! ```
//! [`DrakeSap`] is the associated cone law with compliance; [`DrakeSimilar`] and [`DrakeLagged`] follow Hunt and Crossley with friction
//! regularised so that the step stays convex, and [`DrakeTamsi`] with friction that follows its own normal impulse, which is not.
//! w depends on the velocities M is written in. Drake writes a free body's in world axes
//! ([`SphereBodies`](moreau_dynamics::mechanics::SphereBodies)).
//!
//! # Source
//! Drake 1.51's `DiscreteContactApproximation`; the papers are named with each law.

use moreau_dynamics::schemes::Scheme;
use moreau_exact::{Error, Result};

mod hunt_crossley;
mod lagged;
mod material;
pub mod primal_newton;
pub mod replay;
mod sap;
pub mod semi_analytic_primal;
mod similar;
mod tamsi;
mod touching;

pub use hunt_crossley::Touch;
pub use lagged::DrakeLagged;
pub use material::{Material, SIGMA};
pub use sap::DrakeSap;
pub use semi_analytic_primal::SemiAnalyticPrimal;
pub use similar::DrakeSimilar;
pub use tamsi::{DrakeTamsi, law as tamsi_law};

/// The names of the four laws on the command line.
pub const NAMES: [&str; 4] = ["drake-sap", "drake-similar", "drake-lagged", "drake-tamsi"];

/// The scheme of Drake's law with this name, one of [`NAMES`].
///
/// # Errors
/// [`Error::Invalid`] for another name, or a material that is none.
///
/// ```
/// use moreau_replicas::drake::{Material, NAMES, by_name};
///
/// assert!(NAMES.iter().all(|name| by_name(name, Material::default()).is_ok()));
/// assert!(by_name("drake-sap", Material { stiffness: -1.0, ..Material::default() }).is_err());
/// ```
pub fn by_name(name: &str, material: Material) -> Result<Box<dyn Scheme>> {
    material.validate()?;
    match name {
        "drake-sap" => Ok(Box::new(DrakeSap { material })),
        "drake-similar" => Ok(Box::new(DrakeSimilar { material })),
        "drake-lagged" => Ok(Box::new(DrakeLagged { material })),
        "drake-tamsi" => Ok(Box::new(DrakeTamsi { material })),
        _ => Err(Error::invalid("scheme", format!("`{name}` is unknown"), format!("use one of {}", NAMES.join(", ")))),
    }
}
