//! The material of Drake's schemes on the command line.

use super::number;
use super::owned::Owned;
use crate::schemes::drake::Material;

const DRAKE: &str = "Options of drake-sap, drake-similar, drake-lagged and drake-tamsi";

/// One option per number of [`Material`].
#[derive(clap::Args)]
pub struct DrakeOptions {
    /// Stiffness k of a pair for Drake's schemes [N/m].
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = DRAKE)]
    stiffness: Option<f64>,
    /// Relaxation time τ of a pair for drake-sap [s].
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", allow_hyphen_values = true, help_heading = DRAKE)]
    relaxation_time: Option<f64>,
    /// Hunt and Crossley's dissipation d for drake-similar, drake-lagged and drake-tamsi [s/m].
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = DRAKE)]
    dissipation: Option<f64>,
    /// Slip below which drake-similar, drake-lagged and drake-tamsi regularise friction [m/s].
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = DRAKE)]
    stiction_tolerance: Option<f64>,
}

impl DrakeOptions {
    /// Which options were given.
    pub fn owned(&self) -> [Owned; 4] {
        let of = |option, given, owners| Owned { option, given, owners };
        let regularised = &["drake-similar", "drake-lagged", "drake-tamsi"];
        [
            of("--stiffness", self.stiffness.is_some(), &["drake-sap", "drake-similar", "drake-lagged", "drake-tamsi"][..]),
            of("--relaxation-time", self.relaxation_time.is_some(), &["drake-sap"]),
            of("--dissipation", self.dissipation.is_some(), regularised),
            of("--stiction-tolerance", self.stiction_tolerance.is_some(), regularised),
        ]
    }

    /// The material, each number Drake's default unless given.
    pub fn material(&self) -> Material {
        let default = Material::default();
        Material {
            stiffness: self.stiffness.unwrap_or(default.stiffness),
            relaxation_time: self.relaxation_time.unwrap_or(default.relaxation_time),
            dissipation: self.dissipation.unwrap_or(default.dissipation),
            stiction_tolerance: self.stiction_tolerance.unwrap_or(default.stiction_tolerance),
        }
    }
}
