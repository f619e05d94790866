//! Schemes by name, for the command line.

use crate::bullet::Bullet;
use crate::chrono::Chrono;
use crate::drake::{self, Material};
use crate::mujoco::Mujoco;
use moreau_dynamics::event_driven::EventDriven;
use moreau_dynamics::schemes::{
    Activation, Anitescu, Euler, Events, GeneralisedAlpha, MoreauJean, MoreauJeanProjection, PositionBased, RestitutionRule,
    RungeKuttaFlip, SchatzmanPaoli, Scheme, Softness, StewartTrinkle, Variational,
};
use moreau_exact::{Error, Result};

/// The names [`by_name`] knows.
pub const NAMES: [&str; 20] = [
    "moreau-jean",
    "moreau-jean-projection",
    "schatzman-paoli",
    "generalised-alpha",
    "stewart-trinkle",
    "anitescu",
    "chrono",
    "bullet",
    "mujoco",
    "explicit-euler",
    "semi-implicit-euler",
    "runge-kutta-flip",
    "event-driven",
    "variational",
    "xpbd",
    "pbd",
    "drake-sap",
    "drake-similar",
    "drake-lagged",
    "drake-tamsi",
];

/// The parameters of all schemes; each scheme takes those it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// θ of Moreau–Jean, with projection and without.
    pub theta: f64,
    /// Activation rule of Moreau–Jean.
    pub activation: Activation,
    /// Restitution rule of Moreau–Jean.
    pub restitution: RestitutionRule,
    /// Friction directions of Stewart–Trinkle at spatial contacts.
    pub directions: usize,
    /// ρ of generalised-α.
    pub spectral_radius: f64,
    /// α of XPBD \[m/N\].
    pub compliance: f64,
    /// s of PBD.
    pub share: f64,
    /// Sweeps of XPBD and PBD; each its own number if absent.
    pub sweeps: Option<usize>,
    /// τ of the event-driven method \[s\].
    pub shortest_flight: f64,
    /// Cone and softness of MuJoCo.
    pub mujoco: Mujoco,
    /// Bodies, friction and margins of Bullet.
    pub bullet: Bullet,
    /// Compliant contact of Drake's schemes.
    pub drake: Material,
}

impl Default for Parameters {
    fn default() -> Self {
        let MoreauJean { theta, activation, restitution } = MoreauJean::default();
        Parameters {
            theta,
            activation,
            restitution,
            directions: StewartTrinkle::default().directions,
            spectral_radius: GeneralisedAlpha::default().spectral_radius(),
            compliance: 0.0,
            share: 0.5,
            sweeps: None,
            shortest_flight: EventDriven::default().shortest_flight,
            mujoco: Mujoco::default(),
            bullet: Bullet::default(),
            drake: Material::default(),
        }
    }
}

/// The scheme with this name.
///
/// # Errors
/// An unknown name (the message lists the known ones), θ outside \[0, 1\], fewer than three directions, a softness that cannot be meant or
/// a material that is none.
pub fn by_name(name: &str, parameters: Parameters) -> Result<Box<dyn Scheme>> {
    let Parameters { theta, activation, restitution, directions, spectral_radius, mujoco, bullet, drake: material, .. } = parameters;
    material.validate()?;
    match name {
        "moreau-jean" => {
            let scheme = MoreauJean { theta, activation, restitution };
            scheme.validate()?;
            Ok(Box::new(scheme))
        }
        "moreau-jean-projection" => {
            let scheme = MoreauJeanProjection { theta };
            scheme.validate()?;
            Ok(Box::new(scheme))
        }
        "generalised-alpha" => Ok(Box::new(GeneralisedAlpha::new(spectral_radius)?)),
        "schatzman-paoli" => Ok(Box::new(SchatzmanPaoli)),
        "stewart-trinkle" => {
            let scheme = StewartTrinkle { directions };
            scheme.validate()?;
            Ok(Box::new(scheme))
        }
        "anitescu" => Ok(Box::new(Anitescu)),
        "chrono" => Ok(Box::new(Chrono::default())),
        "bullet" => {
            bullet.validate()?;
            Ok(Box::new(bullet))
        }
        "mujoco" => {
            mujoco.validate()?;
            Ok(Box::new(mujoco))
        }
        "explicit-euler" => Ok(Box::new(Euler::Explicit)),
        "semi-implicit-euler" => Ok(Box::new(Euler::SemiImplicit)),
        "runge-kutta-flip" => Ok(Box::new(RungeKuttaFlip)),
        "xpbd" => {
            position_based(PositionBased { softness: Softness::Compliance(parameters.compliance), ..PositionBased::XPBD }, &parameters)
        }
        "pbd" => position_based(PositionBased { softness: Softness::Share(parameters.share), ..PositionBased::PBD }, &parameters),
        "event-driven" => {
            let method = EventDriven { shortest_flight: parameters.shortest_flight, ..EventDriven::default() };
            method.validate()?;
            Ok(Box::new(Events { method }))
        }
        "variational" => Ok(Box::new(Variational)),
        name if drake::NAMES.contains(&name) => drake::by_name(name, material),
        _ => Err(unknown("scheme", name, &NAMES)),
    }
}

fn position_based(scheme: PositionBased, parameters: &Parameters) -> Result<Box<dyn Scheme>> {
    let scheme = PositionBased { sweeps: parameters.sweeps.unwrap_or(scheme.sweeps), ..scheme };
    scheme.validate()?;
    Ok(Box::new(scheme))
}

fn unknown(field: &str, name: &str, known: &[&str]) -> Error {
    Error::invalid(field, format!("`{name}` is unknown"), format!("use one of {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_dynamics::tolerance::limits::DIRECTIONS;

    #[test]
    fn every_listed_name_is_a_scheme_and_starts_its_own_description() {
        for name in NAMES {
            let scheme = by_name(name, Parameters::default()).expect("a listed name");
            assert!(scheme.name().starts_with(name));
        }
    }

    #[test]
    fn unknown_names_are_answered_with_the_known_ones() {
        let message = |result: Result<Box<dyn Scheme>>| result.err().expect("must be refused").to_string();
        assert!(message(by_name("euler", Parameters::default())).contains("generalised-alpha, stewart-trinkle, anitescu"));
        assert!(message(by_name("moreau-jean", Parameters { theta: f64::NAN, ..Parameters::default() })).contains("theta"));
        let directed = |directions: usize| by_name("stewart-trinkle", Parameters { directions, ..Parameters::default() });
        for outside in [2, DIRECTIONS + 1] {
            assert!(message(directed(outside)).contains("`directions`") && message(directed(outside)).contains("from 3 to 1024"));
        }
        assert!(directed(3).is_ok() && directed(DIRECTIONS).is_ok());
    }
}
