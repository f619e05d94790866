//! Cone, softness, friction against rotation and integrator of mujoco on the command line; the cone is bullet's, too.

use super::number;
use super::owned::{Owned, option};
use crate::number::counted;
use crate::schemes::mujoco::{Cone, Integrator, Rotational, Softness};
use crate::schemes::{Friction, Mujoco};
use crate::{Error, Result};

const MUJOCO: &str = "Options of mujoco; --cone is bullet's, too";

/// One option per parameter of [`Mujoco`].
#[derive(clap::Args)]
pub struct MujocoOptions {
    /// Friction cone in space, pyramidal or elliptic, of mujoco (pyramidal by default) or bullet (elliptic by default).
    #[arg(long, value_name = "NAME", help_heading = MUJOCO)]
    cone: Option<String>,
    /// solref of mujoco: time constant [s] and damping ratio, or −stiffness [1/s²] and −damping [1/s].
    #[arg(long, value_parser = number::real, value_name = "A,B", value_delimiter = ',', allow_hyphen_values = true, help_heading = MUJOCO)]
    solref: Option<Vec<f64>>,
    /// solimp of mujoco: impedance at the surface and beyond the width, width [m], midpoint, power.
    #[arg(long, value_parser = number::real, value_name = "D0,DW,WIDTH,MID,POWER", value_delimiter = ',')]
    #[arg(allow_hyphen_values = true, help_heading = MUJOCO)]
    solimp: Option<Vec<f64>>,
    /// impratio of mujoco, normal over tangential regularisation.
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = MUJOCO)]
    impratio: Option<f64>,
    /// margin of mujoco: gap below which a contact is active [m].
    #[arg(long, value_parser = number::real, value_name = "METRES", allow_hyphen_values = true, help_heading = MUJOCO)]
    margin: Option<f64>,
    /// Torsional friction of mujoco in space, torque about the normal over the normal force [m].
    #[arg(long, value_parser = number::real, value_name = "METRES", allow_hyphen_values = true, help_heading = MUJOCO)]
    torsional: Option<f64>,
    /// Rolling friction of mujoco in space, torque about a tangent over the normal force [m]; needs --torsional.
    #[arg(long, value_parser = number::real, value_name = "METRES", allow_hyphen_values = true, help_heading = MUJOCO)]
    rolling: Option<f64>,
    /// Integrator of mujoco: euler (default), implicitfast or rk4.
    #[arg(long, value_name = "NAME", help_heading = MUJOCO)]
    integrator: Option<String>,
}

impl MujocoOptions {
    /// Which options were given.
    pub fn owned(&self) -> [Owned; 8] {
        let of = |option, given| Owned { option, given, owners: &["mujoco"] };
        [
            Owned { option: "--cone", given: self.cone.is_some(), owners: &["mujoco", "bullet"] },
            of("--solref", self.solref.is_some()),
            of("--solimp", self.solimp.is_some()),
            of("--impratio", self.impratio.is_some()),
            of("--margin", self.margin.is_some()),
            of("--torsional", self.torsional.is_some()),
            of("--rolling", self.rolling.is_some()),
            of("--integrator", self.integrator.is_some()),
        ]
    }

    /// The parameters, each MuJoCo's default unless given.
    ///
    /// # Errors
    /// An unknown cone or integrator, or too few or too many numbers.
    pub fn mujoco(&self) -> Result<Mujoco> {
        let softness = Softness::default();
        Ok(Mujoco {
            cone: self.cone.as_deref().map_or(Ok(Cone::default()), Cone::by_name).map_err(option)?,
            softness: Softness {
                reference: self.solref.as_deref().map_or(Ok(softness.reference), |given| numbers("--solref", given))?,
                impedance: self.solimp.as_deref().map_or(Ok(softness.impedance), |given| numbers("--solimp", given))?,
                impedance_ratio: self.impratio.unwrap_or(softness.impedance_ratio),
                margin: self.margin.unwrap_or(softness.margin),
                ..softness
            },
            rotational: Rotational { torsional: self.torsional.unwrap_or(0.0), rolling: self.rolling.unwrap_or(0.0) },
            integrator: self.integrator.as_deref().map_or(Ok(Integrator::default()), Integrator::by_name).map_err(option)?,
        })
    }

    /// Bullet's friction under the cone of this name, its round one unless given.
    ///
    /// # Errors
    /// An unknown cone.
    pub fn friction(&self) -> Result<Friction> {
        let cone = self.cone.as_deref().map_or(Ok(Cone::Elliptic), Cone::by_name).map_err(option)?;
        Ok(if cone == Cone::Elliptic { Friction::Cone } else { Friction::Pyramid })
    }
}

/// As many numbers as there have to be.
fn numbers<const N: usize>(field: &str, given: &[f64]) -> Result<[f64; N]> {
    given.try_into().map_err(|_| {
        Error::invalid(field, format!("has {}", counted(given.len(), "number")), format!("give {N}, with commas between them"))
    })
}
