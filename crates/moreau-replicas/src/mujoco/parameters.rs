//! The parameters of MuJoCo's step.

use crate::mujoco::Softness;
use moreau_contact::contact::Contact;
use moreau_exact::{Error, Result};

/// The shape of the friction cone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cone {
    /// Four edges n ± μ t₁, n ± μ t₂; MuJoCo's default.
    #[default]
    Pyramidal,
    /// ‖r_t‖ ≤ μ r_n.
    Elliptic,
}

impl Cone {
    /// The cone with MuJoCo's name for it.
    ///
    /// # Errors
    /// An unknown name; the message lists the two.
    pub fn by_name(name: &str) -> Result<Self> {
        match name {
            "pyramidal" => Ok(Cone::Pyramidal),
            "elliptic" => Ok(Cone::Elliptic),
            _ => Err(Error::invalid("cone", format!("`{name}` is unknown"), "use pyramidal or elliptic")),
        }
    }
}

/// MuJoCo's step.
///
/// # Source
/// Chapter §6; MuJoCo documentation, *Computation* (3.17); Todorov, *Convex and analytically-invertible dynamics with contacts* (2014).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mujoco {
    /// The friction cone of contacts in space.
    pub cone: Cone,
    /// How soft the contacts are.
    pub softness: Softness,
    /// Friction against rotation at contacts in space.
    pub rotational: Rotational,
    /// How a step follows from the accelerations.
    pub integrator: Integrator,
}

/// One active contact with what MuJoCo knows of it.
pub(super) struct Soft {
    pub index: usize,
    pub contact: Contact,
    pub inverse_mass: f64,
}

/// Friction against rotation: `condim` 3, 4 or 6 in MuJoCo's words.
///
/// # Source
/// MuJoCo documentation, *Computation: contact* (3.17).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rotational {
    /// Torque about the normal over the normal force \[m\]; 0: none.
    pub torsional: f64,
    /// Torque about each tangent over the normal force \[m\]; 0: none.
    pub rolling: f64,
}

impl Rotational {
    /// Sliding friction only.
    pub const NONE: Rotational = Rotational { torsional: 0.0, rolling: 0.0 };

    /// Checks the lengths.
    ///
    /// # Errors
    /// [`Error::Invalid`] if one is negative or not finite, or if there is rolling friction without torsional.
    pub fn validate(&self) -> Result<()> {
        let Rotational { torsional, rolling } = *self;
        for (field, length) in [("torsional", torsional), ("rolling", rolling)] {
            if !(length >= 0.0 && length.is_finite()) {
                return Err(Error::invalid(field, format!("is {length}"), "use a length ≥ 0 m"));
            }
        }
        if rolling > 0.0 && torsional == 0.0 {
            return Err(Error::invalid("rolling", "comes without torsional friction", "give both lengths"));
        }
        Ok(())
    }

    pub(super) fn suffix(&self) -> &'static str {
        match self.coefficients().len() {
            0 => "",
            1 => " torsional",
            _ => " rolling",
        }
    }

    pub(super) fn coefficients(&self) -> Vec<f64> {
        match (self.torsional > 0.0, self.rolling > 0.0) {
            (_, true) => vec![self.torsional, self.rolling, self.rolling],
            (true, false) => vec![self.torsional],
            _ => Vec::new(),
        }
    }
}

/// MuJoCo's integrators that are rebuilt here.
///
/// # Source
/// MuJoCo documentation, *Computation: numerical integration* (3.17), and its change log, 3.11.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Semi-implicit, damping of joints implicit; MuJoCo's default.
    #[default]
    Euler,
    /// Implicit in damping and in the gyroscopic torques of free bodies.
    ImplicitFast,
    /// The classical Runge–Kutta method of order four, contacts in every stage.
    RungeKutta,
}

impl Integrator {
    /// The integrator with MuJoCo's name for it, in small letters.
    ///
    /// # Errors
    /// An unknown name; the message lists the three.
    pub fn by_name(name: &str) -> Result<Self> {
        match name {
            "euler" => Ok(Integrator::Euler),
            "implicitfast" => Ok(Integrator::ImplicitFast),
            "rk4" => Ok(Integrator::RungeKutta),
            _ => Err(Error::invalid("integrator", format!("`{name}` is unknown"), "use euler, implicitfast or rk4")),
        }
    }

    pub(super) fn suffix(self) -> &'static str {
        match self {
            Integrator::Euler => "",
            Integrator::ImplicitFast => " implicitfast",
            Integrator::RungeKutta => " rk4",
        }
    }
}
