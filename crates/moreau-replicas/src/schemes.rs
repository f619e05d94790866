//! Schemes by name.

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

/// The parameters of all schemes; each scheme takes those it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchemeParameters {
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

impl Default for SchemeParameters {
    fn default() -> Self {
        let MoreauJean { theta, activation, restitution } = MoreauJean::default();
        SchemeParameters {
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

/// One scheme of the table.
#[derive(Clone, Copy, Debug)]
pub struct SchemeEntry {
    /// Its name on the command line and in files; [`Scheme::name`] starts with it.
    pub name: &'static str,
    /// The scheme with these parameters, or why there is none.
    pub make: fn(&SchemeParameters) -> Result<Box<dyn Scheme>>,
}

/// Every scheme, in the order in which they are listed; a new one is one more line.
pub const ALL: &[SchemeEntry] = &[
    SchemeEntry {
        name: "moreau-jean",
        make: |p| {
            let scheme = MoreauJean { theta: p.theta, activation: p.activation, restitution: p.restitution };
            valid(scheme.validate(), scheme)
        },
    },
    SchemeEntry {
        name: "moreau-jean-projection",
        make: |p| {
            let scheme = MoreauJeanProjection { theta: p.theta };
            valid(scheme.validate(), scheme)
        },
    },
    SchemeEntry { name: "schatzman-paoli", make: |_| Ok(Box::new(SchatzmanPaoli)) },
    SchemeEntry { name: "generalised-alpha", make: |p| Ok(Box::new(GeneralisedAlpha::new(p.spectral_radius)?)) },
    SchemeEntry {
        name: "stewart-trinkle",
        make: |p| {
            let scheme = StewartTrinkle { directions: p.directions };
            valid(scheme.validate(), scheme)
        },
    },
    SchemeEntry { name: "anitescu", make: |_| Ok(Box::new(Anitescu)) },
    SchemeEntry { name: "chrono", make: |_| Ok(Box::new(Chrono::default())) },
    SchemeEntry { name: "bullet", make: |p| valid(p.bullet.validate(), p.bullet) },
    SchemeEntry { name: "mujoco", make: |p| valid(p.mujoco.validate(), p.mujoco) },
    SchemeEntry { name: "explicit-euler", make: |_| Ok(Box::new(Euler::Explicit)) },
    SchemeEntry { name: "semi-implicit-euler", make: |_| Ok(Box::new(Euler::SemiImplicit)) },
    SchemeEntry { name: "runge-kutta-flip", make: |_| Ok(Box::new(RungeKuttaFlip)) },
    SchemeEntry {
        name: "event-driven",
        make: |p| {
            let method = EventDriven { shortest_flight: p.shortest_flight, ..EventDriven::default() };
            valid(method.validate(), Events { method })
        },
    },
    SchemeEntry { name: "variational", make: |_| Ok(Box::new(Variational)) },
    SchemeEntry {
        name: "xpbd",
        make: |p| position_based(PositionBased { softness: Softness::Compliance(p.compliance), ..PositionBased::XPBD }, p),
    },
    SchemeEntry { name: "pbd", make: |p| position_based(PositionBased { softness: Softness::Share(p.share), ..PositionBased::PBD }, p) },
    SchemeEntry { name: "drake-sap", make: |p| drake::by_name("drake-sap", p.drake) },
    SchemeEntry { name: "drake-similar", make: |p| drake::by_name("drake-similar", p.drake) },
    SchemeEntry { name: "drake-lagged", make: |p| drake::by_name("drake-lagged", p.drake) },
    SchemeEntry { name: "drake-tamsi", make: |p| drake::by_name("drake-tamsi", p.drake) },
];

/// The names in [`ALL`].
pub const NAMES: [&str; ALL.len()] = {
    let mut names = [""; ALL.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = ALL[k].name;
        k += 1;
    }
    names
};

/// The scheme with this name.
///
/// # Errors
/// An unknown name (the message lists the known ones), or a parameter of the scheme outside its range: θ outside \[0, 1\], fewer than three
/// directions, a negative softness, a material with a negative stiffness.
///
/// ```
/// use moreau_replicas::schemes::{NAMES, SchemeParameters, by_name};
///
/// let parameters = SchemeParameters::default();
/// assert!(NAMES.iter().all(|name| by_name(name, parameters).is_ok()));
/// assert!(by_name("moreau-jean", parameters)?.has_restitution() && !by_name("anitescu", parameters)?.has_restitution());
/// assert!(by_name("moreau-jean", SchemeParameters { theta: 1.5, ..parameters }).is_err());
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn by_name(name: &str, parameters: SchemeParameters) -> Result<Box<dyn Scheme>> {
    let unknown = || Error::invalid("scheme", format!("`{name}` is unknown"), format!("use one of {}", NAMES.join(", ")));
    let entry = ALL.iter().find(|entry| entry.name == name).ok_or_else(unknown)?;
    (entry.make)(&parameters)
}

/// The scheme, unless its parameters were refused.
fn valid(checked: Result<()>, scheme: impl Scheme + 'static) -> Result<Box<dyn Scheme>> {
    checked.map(|()| Box::new(scheme) as Box<dyn Scheme>)
}

fn position_based(scheme: PositionBased, parameters: &SchemeParameters) -> Result<Box<dyn Scheme>> {
    let scheme = PositionBased { sweeps: parameters.sweeps.unwrap_or(scheme.sweeps), ..scheme };
    valid(scheme.validate(), scheme)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_dynamics::tolerance::limits::DIRECTIONS;

    #[test]
    fn every_listed_name_is_a_scheme_and_starts_its_own_description() {
        for name in NAMES {
            let scheme = by_name(name, SchemeParameters::default()).expect("a listed name");
            assert!(scheme.name().starts_with(name));
        }
    }

    #[test]
    fn unknown_names_are_answered_with_the_known_ones() {
        let message = |result: Result<Box<dyn Scheme>>| result.err().expect("must be refused").to_string();
        assert!(message(by_name("euler", SchemeParameters::default())).contains("generalised-alpha, stewart-trinkle, anitescu"));
        assert!(message(by_name("moreau-jean", SchemeParameters { theta: f64::NAN, ..SchemeParameters::default() })).contains("theta"));
        let directed = |directions: usize| by_name("stewart-trinkle", SchemeParameters { directions, ..SchemeParameters::default() });
        for outside in [2, DIRECTIONS + 1] {
            assert!(message(directed(outside)).contains("`directions`") && message(directed(outside)).contains("from 3 to 1024"));
        }
        assert!(directed(3).is_ok() && directed(DIRECTIONS).is_ok());
    }
}
