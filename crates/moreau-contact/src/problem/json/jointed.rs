//! `kinds` of a file: contacts beside limits and bilateral constraints.
//!
//! ```json
//! "kinds": ["contact", "limit", {"bilateral": 3}]
//! ```

use super::file::{
    ComplianceFile, KindFile, PROBLEM_SCHEMA, ProblemFile, read_compliance, read_keys, read_law, read_operator, text, write_keys, written,
};
use super::matrix::MatrixFile;
use crate::files::printable;
use crate::problem::contact_problem::Known;
use crate::problem::jointed::{require_room, starts};
use crate::problem::{ConstraintKind, Coordinates, Dynamics, JointedProblem};
use crate::tolerance::problem::WRITTEN_OUT;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use serde_json::json;

/// The problem of a file with these kinds.
pub(super) fn read(file: ProblemFile, kinds: Vec<ConstraintKind>) -> Result<JointedProblem> {
    if kinds.len() != file.friction.len() {
        let problem = format!("has size {}", kinds.len());
        return Err(Error::invalid("kinds", problem, format!("give size {}, one for each of `friction`", file.friction.len())));
    }
    let rows = *starts(file.dimension, &kinds)?.last().expect("the end is there");
    require_room(rows)?;
    if file.delassus.as_ref().is_some_and(MatrixFile::has_blocks) {
        let problem = "has `blocks`, which are of contacts alone";
        return Err(Error::invalid("delassus", problem, "give `rows` or `triplets` with `kinds`"));
    }
    for (field, found) in [("delassus", &file.delassus), ("jacobian", &file.jacobian)] {
        if let Some(found) = found.as_ref().map(|matrix| matrix.shape[0]).filter(|found| *found != rows) {
            let cure = format!("give {rows}, as the {} `kinds` have", kinds.len());
            return Err(Error::invalid(field, format!("has {}", counted(found, "row")), cure));
        }
    }
    printable("name", &file.name)?;
    let law = read_law(&file.law, file.directions)?;
    let (operator, known) = read_operator(file.delassus, file.mass, file.jacobian, [1, rows])?;
    let by_bodies = operator.matrix_free().filter(|free| free.entries() <= WRITTEN_OUT).map(|free| Dynamics::of(free.triplets()));
    let mut problem = JointedProblem::new(file.dimension, kinds, operator.dense().clone(), DVector::from_vec(file.free_velocity))?
        .named(file.name)
        .law(law, file.friction)?
        .made_of(known.as_ref().and_then(Known::dense).cloned().or(by_bodies))?;
    if let Some(shift) = file.shift {
        problem = problem.shift(DVector::from_vec(shift))?;
    }
    if let Some(compliance) = file.compliance.map(read_compliance).transpose()? {
        if compliance.coordinates == Coordinates::Edge {
            return Err(Error::invalid("compliance.coordinates", "is `edge` with `kinds`", "use `contact`"));
        }
        problem = problem.softness(compliance.diagonal)?;
    }
    problem.between(file.bodies, file.keys.map(read_keys))
}

impl JointedProblem {
    /// The problem as text `contact-problem/1` with `kinds`, row by row: mass and Jacobian if W follows from them bit for bit, else W.
    pub fn to_json(&self) -> String {
        let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
        let soft = self.softnesses().iter().any(|soft| *soft != 0.0);
        let [mass, jacobian] = written(self.dynamics(), self.delassus());
        text(&ProblemFile {
            schema: PROBLEM_SCHEMA.into(),
            name: self.name().into(),
            dimension: self.rows_per_contact(),
            law: self.contact_law().name().into(),
            directions: self.contact_law().directions(),
            friction: self.friction().to_vec(),
            free_velocity: list(self.free_velocity()),
            shift: Some(list(self.shifts())),
            delassus: mass.is_none().then(|| MatrixFile::shorter(self.delassus())),
            mass,
            jacobian,
            compliance: soft.then(|| ComplianceFile { coordinates: "contact".into(), diagonal: list(self.softnesses()) }),
            bodies: self.bodies().map(<[_]>::to_vec),
            keys: self.keys().map(write_keys),
            kinds: Some(self.kinds().iter().map(|kind| json!(KindFile::from(*kind))).collect()),
            provenance: None,
        })
    }
}
