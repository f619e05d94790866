//! What Drake's laws know of a pair of bodies.

use moreau_exact::{Error, Result};

/// σ = R_t/w of SAP, which also widens the stiction tolerance of Similar and Lagged.
pub const SIGMA: f64 = 0.001;

/// The material of a pair of bodies; each law takes what it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// k \[N/m\].
    pub stiffness: f64,
    /// τ \[s\], of SAP.
    pub relaxation_time: f64,
    /// d \[s/m\], of Hunt and Crossley.
    pub dissipation: f64,
    /// v_s \[m/s\], of regularised friction.
    pub stiction_tolerance: f64,
}

impl Default for Material {
    /// k = 1e5 N/m, no dissipation, v_s = 1 mm/s.
    fn default() -> Self {
        Material { stiffness: 1e5, relaxation_time: 0.0, dissipation: 0.0, stiction_tolerance: 0.001 }
    }
}

impl Material {
    /// Checks the signs.
    ///
    /// # Errors
    /// [`Error::Invalid`] if k or v_s is not positive, τ or d negative, or a number not finite.
    pub fn validate(&self) -> Result<()> {
        let Material { stiffness, relaxation_time, dissipation, stiction_tolerance } = *self;
        for (field, value) in [("stiffness", stiffness), ("stiction tolerance", stiction_tolerance)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        for (field, value) in [("relaxation time", relaxation_time), ("dissipation", dissipation)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a number ≥ 0"));
            }
        }
        Ok(())
    }
}
