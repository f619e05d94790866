//! The material of Drake's schemes on the command line.

use crate::schemes::drake::Material;
use crate::{Error, Result};

/// One option per number of [`Material`].
#[derive(clap::Args)]
pub struct DrakeOptions {
    /// Stiffness k of a pair for Drake's schemes [N/m].
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    stiffness: Option<f64>,
    /// Relaxation time τ of a pair for drake-sap [s].
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    relaxation_time: Option<f64>,
    /// Hunt and Crossley's dissipation d for drake-similar, drake-lagged and drake-tamsi [s/m].
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    dissipation: Option<f64>,
    /// Slip below which drake-similar, drake-lagged and drake-tamsi regularise friction [m/s].
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    stiction_tolerance: Option<f64>,
}

impl DrakeOptions {
    /// The material, each number Drake's default unless given.
    ///
    /// # Errors
    /// An option that does nothing in this scheme, or a number that is none of a material.
    pub fn material(&self, scheme: &str) -> Result<Material> {
        let [all, sap, regularised]: [&[&str]; 3] = [
            &["drake-sap", "drake-similar", "drake-lagged", "drake-tamsi"],
            &["drake-sap"],
            &["drake-similar", "drake-lagged", "drake-tamsi"],
        ];
        let own = [
            ("--stiffness", self.stiffness, all),
            ("--relaxation-time", self.relaxation_time, sap),
            ("--dissipation", self.dissipation, regularised),
            ("--stiction-tolerance", self.stiction_tolerance, regularised),
        ];
        if let Some((option, _, owners)) = own.iter().find(|(_, given, owners)| given.is_some() && !owners.contains(&scheme)) {
            return Err(Error::invalid(*option, format!("does nothing in {scheme}"), format!("it belongs to {}", owners.join(", "))));
        }
        let default = Material::default();
        Ok(Material {
            stiffness: self.stiffness.unwrap_or(default.stiffness),
            relaxation_time: self.relaxation_time.unwrap_or(default.relaxation_time),
            dissipation: self.dissipation.unwrap_or(default.dissipation),
            stiction_tolerance: self.stiction_tolerance.unwrap_or(default.stiction_tolerance),
        })
    }
}
