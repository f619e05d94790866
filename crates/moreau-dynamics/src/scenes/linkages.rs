//! Built-in scenes whose bodies are hinged to each other, which `scene/1` cannot say.

use super::Staged;
use crate::mechanics::{Mechanism, Plane, RodChain, SliderCrank, SliderCrankData, State};
use moreau_exact::Result;
use nalgebra::{DVector, dvector};

/// A mechanism and where it starts.
type Made = Result<(Box<dyn Mechanism>, State)>;

/// A scene that is a mechanism from the start.
pub struct Linkage {
    /// Its name.
    pub name: &'static str,
    /// What happens in it.
    pub description: &'static str,
    make: fn() -> Made,
    duration: f64,
}

/// Standard gravity of the scenes \[m/s²\].
const GRAVITY: f64 = 9.81;

/// Every one of them.
pub const LINKAGES: [Linkage; 3] = [
    Linkage {
        name: "double-pendulum",
        description: "Two hinged rods of 1 m and 1 kg swing against a rough wall; e = 1/2, friction 0.3.",
        make: double_pendulum,
        duration: 2.0,
    },
    Linkage {
        name: "slider-crank",
        description: "A crank at 150 rad/s drives a slider with 1 mm of clearance in its guide; e = 0.4, friction 0.01.",
        make: slider_crank,
        duration: 0.1,
    },
    Linkage {
        name: "five-link-chain",
        description: "Five hinged rods of 0.3 m, let go stretched out level, fall onto a rough floor 0.25 m below their hinge; e = 0.2.",
        make: five_link_chain,
        duration: 1.0,
    },
];

/// The linkage of this name, if there is one.
pub fn linkage(name: &str) -> Option<&'static Linkage> {
    LINKAGES.iter().find(|linkage| linkage.name == name)
}

impl Linkage {
    /// The scene ready to run.
    ///
    /// # Errors
    /// None: the data are constants that their mechanism takes.
    pub fn staged(&self) -> Result<Staged> {
        let (mechanism, start) = (self.make)()?;
        Ok(Staged { name: self.name.into(), mechanism, start, exact: None, gravity: GRAVITY, duration: self.duration })
    }
}

fn at(position: DVector<f64>, velocity: DVector<f64>) -> State {
    State { time: 0.0, position, velocity }
}

/// Drawn back by 50° from the vertical, away from a wall that is 0.5 m beside the hinge.
fn double_pendulum() -> Made {
    let wall = Plane::new(dvector![-1.0, 0.0], -0.5, 0.3, 0.5)?;
    let angle = (-90f64 - 50.0).to_radians();
    let mechanism = RodChain::new("double-pendulum", &[(1.0, 1.0); 2], GRAVITY, wall)?;
    Ok((Box::new(mechanism), at(dvector![angle, angle], DVector::zeros(2))))
}

/// The data of Flores, Leine and Glocker (2010), Table 1, as Siconos's example has them.
fn slider_crank() -> Made {
    let mechanism = SliderCrank::new(SliderCrankData {
        lengths: [0.153, 0.306],
        masses: [0.038, 0.038, 0.076],
        inertias: [0.000_074, 0.000_59, 0.000_002_7],
        half_extents: [0.05, 0.025],
        clearance: 0.001,
        friction: 0.01,
        restitution: 0.4,
        gravity: GRAVITY,
    })?;
    Ok((Box::new(mechanism), at(DVector::zeros(3), dvector![150.0, -75.0, 0.0])))
}

fn five_link_chain() -> Made {
    let floor = Plane::new(dvector![0.0, 1.0], -0.25, 0.5, 0.2)?;
    let mechanism = RodChain::new("five-link-chain", &[(0.2, 0.3); 5], GRAVITY, floor)?;
    Ok((Box::new(mechanism), at(DVector::zeros(5), DVector::zeros(5))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_linkage_starts_without_penetration_and_is_found_by_its_name() {
        for known in &LINKAGES {
            let staged = linkage(known.name).expect("listed").staged().expect("constants");
            let contacts = staged.mechanism.contacts(&staged.start.position);
            assert!(contacts.iter().all(|contact| contact.gap > 0.0), "{}", known.name);
            assert_eq!(staged.start.velocity.len(), staged.mechanism.degrees_of_freedom());
        }
        assert!(linkage("bouncing-ball").is_none());
    }

    #[test]
    fn the_crank_has_the_mass_matrix_of_its_source() {
        let staged = linkage("slider-crank").and_then(|linkage| linkage.staged().ok()).expect("listed");
        let (crank, rod) = (0.4f64, -0.2f64);
        let mass = staged.mechanism.mass_matrix(&dvector![crank, rod, 0.1]);
        let (m1, m2, m3, l1, l2) = (0.038, 0.038, 0.076, 0.153, 0.306);
        let expected = [
            (0, 0, 7.4e-5 + (0.25 * m1 + m2 + m3) * l1 * l1),
            (0, 1, (0.5 * m2 + m3) * l1 * l2 * (rod - crank).cos()),
            (1, 1, 5.9e-4 + (0.25 * m2 + m3) * l2 * l2),
            (2, 2, 2.7e-6),
            (0, 2, 0.0),
        ];
        for (row, column, value) in expected {
            assert!((mass[(row, column)] - value).abs() <= moreau_exact::tolerance::rounding(16, 0.02), "M{row}{column}");
        }
    }
}
