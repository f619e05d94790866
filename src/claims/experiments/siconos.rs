//! What is stored of Siconos: facts about its release, read from the Debian packages by a script, and its own steps.

use super::facts::Document;
use crate::checks::siconos_alpha::{FirstImpact, SiconosAlpha};
use crate::checks::siconos_steps::SiconosSteps;
use crate::mechanics::Mechanism;
use crate::problem::Law;
use crate::schemes::step;
use crate::solvers::{Auto, ContactSolver};
use crate::stored::{RUNS, read, read_by};
use crate::{Error, Result};
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;

const FACTS: &str = "facts/siconos.json";
const ELASTIC: &str = "siconos/ball_elastic__moreau-jean__h0.01.json";
const ELASTIC_PROJECTED: &str = "siconos/ball_elastic__projection__h0.01.json";
const CHAIN_PROJECTED: &str = "siconos/chain__projection__h0.01.json";
const ALPHA_FALL: &str = "siconos/fall__generalised-alpha__h0.05.json";
const SLIDE: &str = "siconos/block_slide__moreau-jean__h0.01.json";
const STICK: &str = "siconos/block_stick__moreau-jean__h0.01.json";
const BALL: &str = "siconos/ball__moreau-jean__h0.01.json";
const BALL_PROJECTED: &str = "siconos/ball__projection__h0.01.json";

/// What the Debian packages of Siconos hold.
#[derive(Debug, Deserialize)]
pub struct Facts {
    /// Headers of integrators, laws and simulations, without extension.
    pub headers: Vec<String>,
}

fn document() -> Result<Document<Facts>> {
    read(&RUNS, FACTS)
}

/// Version of the packages that the facts are of.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn version() -> Result<String> {
    Ok(document()?.version)
}

impl Facts {
    /// The stored facts.
    ///
    /// # Errors
    /// If the stored file is not what it should be.
    pub fn stored() -> Result<Self> {
        Ok(document()?.stated)
    }

    /// Whether there is a header of this class.
    pub fn has(&self, class: &str) -> bool {
        self.headers.iter().any(|name| name == class)
    }
}

/// E_end/E_0 of Siconos's elastic ball under combined projection over 5 s, and Σ m g q_k/E_0 over the steps that were projected from q_k.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn projected_energy() -> Result<[f64; 2]> {
    energy(ELASTIC_PROJECTED)
}

/// The same of Siconos's elastic ball without projection, and over the steps that an impulse ended.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn unprojected_energy() -> Result<[f64; 2]> {
    energy(ELASTIC)
}

fn energy(file: &str) -> Result<[f64; 2]> {
    let run = read_by(&RUNS, file, SiconosSteps::from_json)?;
    let mechanism = run.mechanism()?;
    let start = mechanism.energy(&run.state(0));
    let last = run.impulses.len();
    let hits = (0..last).filter(|k| run.impulses[*k][0] > 0.0);
    let taken: f64 = hits.map(|k| mechanism.potential_energy(&run.state(k).position)).sum();
    Ok([mechanism.energy(&run.state(last)) / start, taken / start])
}

/// What moves the balls of a chain out of each other at the end of the step of its impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Siconos's, as stored.
    Stored,
    /// The least move in the kinetic metric, along M⁻¹H_nᵀ, computed from the same step.
    InKineticMetric,
}

/// The step of Siconos's chain of masses 1, 2, 4 kg in which it collides.
struct ChainImpact {
    mechanism: Box<dyn Mechanism>,
    masses: DVector<f64>,
    /// Where the balls are before the projection, and after it.
    places: [DVector<f64>; 2],
    /// The contacts with an impulse.
    hits: Vec<usize>,
}

impl ChainImpact {
    fn stored() -> Result<Self> {
        let run = read_by(&RUNS, CHAIN_PROJECTED, SiconosSteps::from_json)?;
        let hit = run.impulses.iter().position(|r| r[0] > 0.0).ok_or_else(|| Error::Unsupported("the chain collides".into()))?;
        let (before, after, mechanism) = (run.state(hit), run.state(hit + 1), run.mechanism()?);
        let masses = mechanism.mass_matrix(&before.position).diagonal();
        let reached = &before.position + (&before.velocity + &after.velocity) * (0.5 * run.time_step);
        let hits = (0..run.impulses[hit].len()).filter(|contact| run.impulses[hit][*contact] > 0.0).collect();
        Ok(ChainImpact { mechanism, masses, places: [reached, after.position], hits })
    }

    /// Siconos's moves \[m\].
    fn moves(&self) -> DVector<f64> {
        &self.places[1] - &self.places[0]
    }

    /// The moves −A⁻¹H_nᵀ (H_n A⁻¹ H_nᵀ)⁻¹ φ \[m\] that close the gaps of these contacts, A with these weights on its diagonal.
    fn least_moves(&self, weights: &DVector<f64>) -> Result<DVector<f64>> {
        let contacts = self.mechanism.contacts(&self.places[0]);
        let closed: Vec<_> = self.hits.iter().map(|contact| &contacts[*contact]).collect();
        let gaps = DVector::from_iterator(closed.len(), closed.iter().map(|contact| contact.gap));
        let normals = DMatrix::from_fn(closed.len(), weights.len(), |row, column| closed[row].jacobian[(0, column)]);
        let moved = DMatrix::from_fn(weights.len(), closed.len(), |row, column| normals[(column, row)] / weights[row]);
        let lengths = (&normals * &moved).lu().solve(&-gaps);
        Ok(moved * lengths.ok_or_else(|| Error::Unsupported("the contacts are independent".into()))?)
    }
}

/// Σ Δq_i \[m\] and Σ m_i Δq_i \[kg·m\] of the moves by the projection in the impact of Siconos's chain.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn projected_moves(projection: Projection) -> Result<[f64; 2]> {
    let impact = ChainImpact::stored()?;
    let moves = match projection {
        Projection::Stored => impact.moves(),
        Projection::InKineticMetric => impact.least_moves(&impact.masses)?,
    };
    Ok([moves.sum(), moves.dot(&impact.masses)])
}

/// How Siconos's block slides in contact.
pub struct Slide {
    /// Largest |u_n⁺ + e u_n| \[m/s\].
    pub normal: f64,
    /// Smallest |u_t⁺| \[m/s\], and that of the start.
    pub tangential: [f64; 2],
    /// Largest |r_t/r_n + μ|.
    pub cone: f64,
}

/// The stored steps of the block that slides, or of the one that sticks, from the second half on, where its bounces are over: as Siconos
/// made them, or made again by our scheme from Siconos's states under this law.
///
/// # Errors
/// If the stored file is not what it should be, and those of the step.
pub fn slide(sticks: bool, again: Option<Law>) -> Result<Slide> {
    let run = read_by(&RUNS, if sticks { STICK } else { SLIDE }, SiconosSteps::from_json)?;
    let (mechanism, scheme) = (run.mechanism()?, run.scheme(0.0)?);
    let contact = mechanism.contacts(&run.state(0).position).swap_remove(0);
    let mut found = Slide { normal: 0.0, tangential: [f64::INFINITY, run.state(0).velocity[0].abs()], cone: 0.0 };
    for k in (run.impulses.len() / 2..run.impulses.len()).filter(|k| run.impulses[*k][0] > 0.0) {
        let (before, stored) = (run.state(k), run.state(k + 1).velocity);
        let ([normal, tangential], [press, drag]) = match again {
            None => ([stored[1], stored[0]], [run.impulses[k][0], run.impulses[k][1]]),
            Some(law) => {
                let problem = step(scheme.as_ref(), &Auto, mechanism.as_ref(), &before, run.time_step)?.assembled.problem;
                let problem = problem.ok_or_else(|| Error::Unsupported("the block touches".into()))?.into_builder().law(law).build()?;
                let answer = Auto.solve(&problem, None)?;
                ([answer.velocity[0], answer.velocity[1]], [answer.impulse[0], answer.impulse[1]])
            }
        };
        found.normal = found.normal.max((normal + contact.restitution * before.velocity[1]).abs());
        found.tangential[0] = found.tangential[0].min(tangential.abs());
        found.cone = found.cone.max((drag / press + contact.friction).abs());
    }
    Ok(found)
}

/// Depth \[m\] below the floor that Siconos's ball reaches, with combined projection or without.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn deepest(projected: bool) -> Result<f64> {
    let run = read_by(&RUNS, if projected { BALL_PROJECTED } else { BALL }, SiconosSteps::from_json)?;
    Ok(run.positions.iter().map(|place| -place[0]).fold(0.0, f64::max))
}

/// The impact that ends a run of `NewMarkAlphaOSI`.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn alpha_impact() -> Result<FirstImpact> {
    let run = read_by(&RUNS, ALPHA_FALL, SiconosAlpha::from_json)?;
    run.first_impact().ok_or_else(|| Error::Unsupported("the run ends with an impact".into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::rounding;

    #[test]
    fn siconos_moves_the_balls_to_the_nearest_place_in_the_coordinates() {
        let impact = ChainImpact::stored().expect("stored");
        let in_coordinates = impact.least_moves(&impact.masses.map(|_| 1.0)).expect("independent");
        assert!((impact.moves() - &in_coordinates).amax() <= rounding(64, 1.0), "{in_coordinates}");
        let in_kinetic_metric = impact.least_moves(&impact.masses).expect("independent");
        assert!(in_kinetic_metric.dot(&impact.masses).abs() <= rounding(64, 1.0), "{in_kinetic_metric}");
    }
}
