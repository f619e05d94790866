//! Readers of `contact-problem/1` and `solution/1`.

use super::{refused, same, with};
use crate::finding::Finding;
use moreau_contact::problem::{Compliance, ContactProblem, Coordinates, Law, Solution};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

/// A reader of contact problems.
pub type ReadsProblem = fn(&str) -> Result<ContactProblem>;

/// A reader of solutions.
pub type ReadsSolution = fn(&str) -> Result<Solution>;

/// Two contacts in the plane; W is not symmetric, and every number occurs once.
pub(crate) const PLANAR: &str = r#"{"schema": "contact-problem/1", "name": "two", "dimension": 2, "law": "coulomb",
    "friction": [0.5, 0.25], "free_velocity": [-1, 2, -3, 0.1], "shift": [0.125, 0, 0.375, 0],
    "delassus": {"shape": [4, 4], "rows": [[1, 0.01, 0.02, 0.03], [0.04, 1.5, 0.05, 0.06], [0.07, 0.08, 2, 0.09], [0.11, 0.12, 0.13, 3]]},
    "compliance": {"coordinates": "contact", "diagonal": [0.21, 0.22, 0.23, 0.24]}, "bodies": [[0, null], [0, 1]]}"#;

/// One contact in space by mass and Jacobian, whose entries are told one by one.
pub(crate) const SPATIAL: &str = r#"{"schema": "contact-problem/1", "name": "one", "dimension": 3, "law": "coulomb", "friction": [0.5],
    "free_velocity": [-1, 2, 3], "mass": {"shape": [3, 3], "triplets": {"row": [0, 1, 2], "column": [0, 1, 2], "value": [2, 4, 8]}},
    "jacobian": {"shape": [3, 3], "triplets": {"row": [0, 0, 1, 2], "column": [0, 1, 1, 2], "value": [1, 2, 1, 1]}}}"#;

/// A soft pyramid.
pub(crate) const PYRAMID: &str = r#"{"schema": "contact-problem/1", "name": "pyramid", "dimension": 3, "law": "polyhedral-associated",
    "directions": 5, "friction": [0.5], "free_velocity": [-1, 2, 3],
    "delassus": {"shape": [3, 3], "rows": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
    "compliance": {"coordinates": "edge", "diagonal": [1, 2, 3, 4, 5]}}"#;

/// Every number of three problems stands where the format says.
///
/// # Errors
/// None: a text that is not read fails every finding on it.
pub fn as_written(subject: &ReadsProblem) -> Result<Vec<Finding>> {
    let (planar, spatial, pyramid) = (subject(PLANAR), subject(SPATIAL), subject(PYRAMID));
    let w = dmatrix![1.0, 0.01, 0.02, 0.03; 0.04, 1.5, 0.05, 0.06; 0.07, 0.08, 2.0, 0.09; 0.11, 0.12, 0.13, 3.0];
    let softness = Compliance { coordinates: Coordinates::Contact, diagonal: dvector![0.21, 0.22, 0.23, 0.24] };
    let edges = Compliance { coordinates: Coordinates::Edge, diagonal: dvector![1.0, 2.0, 3.0, 4.0, 5.0] };
    let jacobian = dmatrix![1.0, 2.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 1.0];
    // H M⁻¹ Hᵀ with M = diag(2, 4, 8)
    let from_mass = dmatrix![1.5, 0.5, 0.0; 0.5, 0.25, 0.0; 0.0, 0.0, 0.125];
    Ok(vec![
        same("rows per contact", &planar, ContactProblem::rows_per_contact, 2),
        same("law", &planar, ContactProblem::law, Law::Coulomb),
        same("friction", &planar, |p| p.friction().to_vec(), vec![0.5, 0.25]),
        same("free velocity", &planar, |p| p.free_velocity().clone(), dvector![-1.0, 2.0, -3.0, 0.1]),
        same("shift", &planar, |p| p.shift().clone(), dvector![0.125, 0.0, 0.375, 0.0]),
        same("Delassus operator", &planar, |p| p.dense().clone(), w),
        same("compliance", &planar, |p| p.compliance().cloned(), Some(softness)),
        same("bodies", &planar, |p| p.bodies().map(<[_]>::to_vec), Some(vec![[Some(0), None], [Some(0), Some(1)]])),
        same("free velocity in space", &spatial, |p| p.free_velocity().clone(), dvector![-1.0, 2.0, 3.0]),
        same("no shift", &spatial, |p| p.shift().clone(), DVector::zeros(3)),
        same("Jacobian", &spatial, |p| p.dynamics().map(|d| d.jacobian.clone()), Some(jacobian)),
        same("Delassus operator of the mass", &spatial, |p| p.dense().clone(), from_mass),
        same("directions", &pyramid, ContactProblem::law, Law::PolyhedralAssociated { directions: 5 }),
        same("edge compliance", &pyramid, |p| p.compliance().cloned(), Some(edges)),
        same("identity", &pyramid, |p| p.dense().clone(), DMatrix::identity(3, 3)),
    ])
}

/// Texts that break the format in one place are refused.
///
/// # Errors
/// None.
pub fn refusals(subject: &ReadsProblem) -> Result<Vec<Finding>> {
    let texts = [
        ("another version", with(PLANAR, "contact-problem/1", "contact-problem/2")),
        ("a law without a name", with(PLANAR, "coulomb", "coulombs")),
        ("an unknown field", with(PLANAR, "\"shift\"", "\"shifts\"")),
        ("a velocity too few", with(PLANAR, "[-1, 2, -3, 0.1]", "[-1, 2, -3]")),
        ("a velocity that is not a number", with(PLANAR, "[-1, 2,", "[-1, NaN,")),
        ("a velocity without a value", with(PLANAR, "[-1, 2,", "[-1, null,")),
        ("a negative coefficient of friction", with(PLANAR, "[0.5, 0.25]", "[-0.5, 0.25]")),
        ("a negative softness", with(PLANAR, "0.21", "-0.21")),
        ("a row too short", with(PLANAR, "[1, 0.01, 0.02, 0.03]", "[1, 0.01, 0.02]")),
        ("a text cut short", PLANAR[..PLANAR.len() - 1].to_string()),
        ("a text that goes on", format!("{PLANAR} {{}}")),
        ("a place told twice", with(SPATIAL, "\"row\": [0, 0, 1, 2]", "\"row\": [0, 0, 0, 2]")),
        ("a place outside the matrix", with(SPATIAL, "\"column\": [0, 1, 1, 2]", "\"column\": [0, 1, 1, 3]")),
        ("a mass without a Jacobian", with(SPATIAL, "\"jacobian\"", "\"provenance\"")),
        ("a pyramid without directions", with(PYRAMID, "\"directions\": 5,", "")),
        ("a number beyond all numbers", with(PYRAMID, "[-1, 2, 3]", "[-1e999, 2, 3]")),
    ];
    Ok(refused(subject, texts))
}

/// An answer to two planar contacts, every number once.
pub(crate) const ANSWER: &str = r#"{"schema": "solution/1", "problem": "two", "impulse": [1, -0.5, 3, 0.25],
    "velocity": [0, 1.5, -0.375, 2.5], "beta": [0, 0.5, 0.25, 0], "sigma": [1.5, 2.5], "solver": "by hand", "iterations": 7}"#;

/// Every number of an answer stands where the format says.
///
/// # Errors
/// None.
pub fn answer_as_written(subject: &ReadsSolution) -> Result<Vec<Finding>> {
    let answer = subject(ANSWER);
    Ok(vec![
        same("impulse", &answer, |s| s.impulse.clone(), dvector![1.0, -0.5, 3.0, 0.25]),
        same("velocity", &answer, |s| s.velocity.clone(), dvector![0.0, 1.5, -0.375, 2.5]),
        same("β", &answer, |s| s.beta.clone(), Some(dvector![0.0, 0.5, 0.25, 0.0])),
        same("σ", &answer, |s| s.sigma.clone(), Some(dvector![1.5, 2.5])),
        same("iterations", &answer, |s| s.iterations, 7),
    ])
}

/// Answers that break the format in one place are refused.
///
/// # Errors
/// None.
pub fn answer_refusals(subject: &ReadsSolution) -> Result<Vec<Finding>> {
    let texts = [
        ("another version", with(ANSWER, "solution/1", "solution/2")),
        ("an answer without velocities", with(ANSWER, "\"velocity\"", "\"residuals\"")),
        ("an impulse that is not a number", with(ANSWER, "[1, -0.5,", "[NaN, -0.5,")),
        ("an unknown field", with(ANSWER, "\"solver\"", "\"solvers\"")),
        ("a text cut short", ANSWER[..ANSWER.len() - 1].to_string()),
    ];
    Ok(refused(subject, texts))
}
