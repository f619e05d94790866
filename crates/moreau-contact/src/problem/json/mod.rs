//! Files `contact-problem/1`, `lcp/1` and `solution/1`.
//!
//! ```json
//! {"schema": "contact-problem/1", "name": "block on the floor", "dimension": 2, "law": "coulomb", "friction": [0.5],
//!  "free_velocity": [-0.1, 0.2], "shift": [0, 0], "delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}}
//! ```
//! Numbers in SI. `dimension` is the number of rows per contact. A matrix is `rows`, or `triplets` {row, column, value}
//! counted from 0, each place at most once; W may be `blocks` {row, column, value}, of the contacts that meet. Instead of
//! `delassus` a file may give `mass` and `jacobian`; with `diagonal_blocks` of the mass and `sparse_rows` of the Jacobian W is not formed,
//! and by triplets and with more than 240 rows they make W by blocks and are not kept. Optional: `keys` (bodies and features of each
//! contact, by which impulses are carried to a changed list), `shift` (default 0), `directions` (polyhedral laws), `compliance`
//! {coordinates: contact | edge, diagonal}, `bodies` (the two bodies of each contact, the ground as null), `provenance` (anything).

use super::{Compliance, ContactKey, ContactProblem, Coordinates, Dynamics, Law, Solution, siconos};
use crate::contact::delassus::delassus;
use crate::files::{names_schema, read_json, read_problem, read_schema, write_atomically};
use crate::memory;
use crate::operator::{Operator, SparseDynamics};
use crate::tolerance::problem::DENSE_ROWS;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

mod by_bodies;
mod lcp;
mod matrix;
mod sparse_rows;

pub use lcp::LcpFile;
use matrix::MatrixFile;

/// Schema name of a contact problem.
pub const PROBLEM_SCHEMA: &str = "contact-problem/1";
/// The text of a problem may take this part of the memory: its numbers and matrices take the rest.
const TEXT_SHARE: u64 = 4;
/// A number of a text that is read: in its list, which may be twice as long as it is full, and in its matrix \[bytes\].
const NUMBER_BYTES: u128 = 24;
/// Schema name of a solution.
pub const SOLUTION_SCHEMA: &str = "solution/1";

/// One step's contact problem: u = W r + u_free, y = u + shift + R r, and (r, y) in the law, contact by contact.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ContactProblem", extend("oneOf" = [{"required": ["delassus"]}, {"required": ["mass", "jacobian"]}]))]
pub struct ProblemFile {
    /// Always `contact-problem/1`.
    #[schemars(extend("const" = PROBLEM_SCHEMA))]
    schema: String,
    /// A name for messages.
    name: String,
    /// Rows per contact: 1 (normal), 2 (normal, tangent) or 3 (normal, tangent 1, tangent 2).
    #[schemars(range(min = 1, max = 3))]
    dimension: usize,
    /// The contact law.
    #[schemars(extend("enum" = ["frictionless", "coulomb", "associated", "polyhedral-coulomb", "polyhedral-associated"]))]
    law: String,
    /// Number of friction directions, of polyhedral laws only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    directions: Option<usize>,
    /// μ ≥ 0 per contact.
    friction: Vec<f64>,
    /// u_free \[m/s\], `dimension` entries per contact.
    free_velocity: Vec<f64>,
    /// What the scheme adds for the law \[m/s\]; 0 if absent.
    #[serde(default)]
    shift: Option<Vec<f64>>,
    /// W \[1/kg\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    delassus: Option<MatrixFile>,
    /// M̂, in place of W.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mass: Option<MatrixFile>,
    /// H, with `mass`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    jacobian: Option<MatrixFile>,
    /// R, of soft contacts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    compliance: Option<ComplianceFile>,
    /// The two bodies of each contact, numbered from 0, the ground as null: contacts of one pair are judged by one size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bodies: Option<Vec<[Option<usize>; 2]>>,
    /// What tells each contact from the others in any list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    keys: Option<Vec<KeyFile>>,
    /// How the problem was made; opaque here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    provenance: Option<serde_json::Value>,
}

/// Which contact it is.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ContactKey")]
struct KeyFile {
    /// The two bodies, numbered from 0, the ground as null.
    bodies: [Option<usize>; 2],
    /// Which features of the two touch.
    features: [u32; 2],
}

/// Diagonal softness R \[1/kg\].
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Compliance")]
struct ComplianceFile {
    /// Where its entries act: on contact rows, or on the edges of a polyhedral cone.
    #[schemars(extend("enum" = ["contact", "edge"]))]
    coordinates: String,
    /// Its entries, all ≥ 0.
    diagonal: Vec<f64>,
}

/// A proposed solution of a contact problem.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Solution")]
pub struct SolutionFile {
    /// Always `solution/1`.
    #[schemars(extend("const" = SOLUTION_SCHEMA))]
    schema: String,
    /// The problem's name; an answer that names another problem is refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    problem: Option<String>,
    /// r \[N·s\], ordered (normal, tangent 1, tangent 2) per contact.
    impulse: Vec<f64>,
    /// u = W r + u_free \[m/s\], without `shift`.
    velocity: Vec<f64>,
    /// β of Stewart–Trinkle, or edge impulses \[N·s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    beta: Option<Vec<f64>>,
    /// σ of Stewart–Trinkle \[m/s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sigma: Option<Vec<f64>>,
    /// The solver's name.
    #[serde(default)]
    solver: String,
    /// Iterations or pivots used; absent where there were none, or nobody knows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    iterations: Option<usize>,
    /// Residuals, for people; not trusted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    residuals: Option<serde_json::Value>,
}

impl ContactProblem {
    /// Reads and validates a file `contact-problem/1` or `lcp/1`, or a text file `.dat` of Siconos, or – with the feature
    /// `fclib` – an HDF5 file of FCLIB; its first byte tells which.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::InFile`] around what [`ContactProblem::from_json`] says.
    /// ```
    /// use moreau_contact::ContactProblem;
    /// use moreau_contact::nalgebra::{dmatrix, dvector};
    ///
    /// let block = ContactProblem::new(dmatrix![1.0], dvector![-1.0]).name("block").rows_per_contact(1).build()?;
    /// let file = std::env::temp_dir().join(format!("moreau-block-{}.json", std::process::id()));
    /// block.write(&file)?;
    /// assert_eq!(ContactProblem::read(&file)?, block);
    /// # std::fs::remove_file(&file).expect("it was written");
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn read(file: &Path) -> Result<Self> {
        #[cfg(feature = "fclib")]
        if super::fclib::is_hdf5(file) {
            return super::fclib::read(file).map_err(|error| error.in_file(file));
        }
        let text = read_problem(file, memory::limit() / TEXT_SHARE, "or allow more with --max-memory")?;
        let read = match text.trim_start().bytes().next() {
            Some(b'0'..=b'9') => siconos::read(&text, &file.file_stem().unwrap_or_default().to_string_lossy()),
            _ => Self::from_json(&text),
        };
        read.map_err(|error| error.in_file(file))
    }

    /// Reads and validates the text of a `contact-problem/1` or an `lcp/1`.
    ///
    /// # Errors
    /// [`Error::Json`], or [`Error::Invalid`] naming the field and the cure.
    pub fn from_json(text: &str) -> Result<Self> {
        memory::require("reading this problem", NUMBER_BYTES * text.bytes().filter(|byte| *byte == b',').count() as u128)?;
        if text.contains(lcp::LCP_SCHEMA) && names_schema(text, lcp::LCP_SCHEMA) {
            return lcp::read(text);
        }
        let file: ProblemFile = read_schema(text, PROBLEM_SCHEMA)?;
        if !(1..=3).contains(&file.dimension) {
            return Err(Error::invalid("dimension", format!("is {}", file.dimension), "use 1 (normal rows only), 2 or 3"));
        }
        let rows = file.dimension * file.friction.len();
        let law = read_law(&file.law, file.directions)?;
        let (delassus, dynamics) = read_operator(file.delassus, file.mass, file.jacobian, [file.dimension, rows])?;
        ContactProblem::new(delassus, DVector::from_vec(file.free_velocity))
            .name(file.name)
            .law(law)
            .rows_per_contact(file.dimension)
            .friction(file.friction)
            .shift(file.shift.map_or_else(|| DVector::zeros(rows), DVector::from_vec))
            .compliance(file.compliance.map(read_compliance).transpose()?)
            .dynamics(dynamics)
            .bodies(file.bodies)
            .keys(file.keys.map(|keys| keys.into_iter().map(|KeyFile { bodies, features }| ContactKey { bodies, features }).collect()))
            .build()
    }

    /// The problem as text `contact-problem/1`. Mass and Jacobian are written in place of W if W follows from them bit for bit.
    pub fn to_json(&self) -> String {
        let follows = |dynamics: &&Dynamics| delassus(&dynamics.mass, &dynamics.jacobian).is_ok_and(|w| w == *self.dense());
        let [mass, jacobian] = match self.delassus().matrix_free() {
            Some(free) => by_bodies::written(free).map(Some),
            None => self
                .dynamics()
                .filter(follows)
                .map_or([None, None], |dynamics| [Some(MatrixFile::dense(&dynamics.mass)), Some(MatrixFile::dense(&dynamics.jacobian))]),
        };
        let file = ProblemFile {
            schema: PROBLEM_SCHEMA.into(),
            name: self.name().into(),
            dimension: self.rows_per_contact(),
            law: self.law().name().into(),
            directions: self.law().directions(),
            friction: self.friction().to_vec(),
            free_velocity: self.free_velocity().as_slice().to_vec(),
            shift: Some(self.shift().as_slice().to_vec()),
            delassus: mass.is_none().then(|| MatrixFile::operator(self.delassus())),
            mass,
            jacobian,
            compliance: self.compliance().map(|compliance| ComplianceFile {
                coordinates: if compliance.coordinates == Coordinates::Edge { "edge" } else { "contact" }.into(),
                diagonal: compliance.diagonal.as_slice().to_vec(),
            }),
            bodies: self.bodies().map(<[_]>::to_vec),
            keys: self.keys().map(|keys| keys.iter().map(|key| KeyFile { bodies: key.bodies, features: key.features }).collect()),
            provenance: None,
        };
        text(&file)
    }

    /// Writes the file `contact-problem/1`, completely or not at all.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, file: &Path) -> Result<()> {
        write_atomically(file, self.to_json().as_bytes())
    }
}

impl Solution {
    /// Reads a file `solution/1`, or the group `solution` of an FCLIB file, that answers this problem; residuals stored in it are not
    /// trusted and not kept.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::InFile`] around what [`Solution::from_json`] says, or around [`Error::Invalid`] where the file names
    /// another problem.
    pub fn read(file: &Path, problem: &ContactProblem) -> Result<Self> {
        #[cfg(feature = "fclib")]
        if super::fclib::is_hdf5(file) {
            return super::fclib::read_solution(file).map_err(|error| error.in_file(file));
        }
        let answer: Result<SolutionFile> = read_schema(&read_json(file)?, SOLUTION_SCHEMA);
        answer.and_then(|answer| answer.answers(problem).map(|()| Self::from(answer))).map_err(|error| error.in_file(file))
    }

    /// Reads the text of a `solution/1`; whether it fits a problem is the certificate's question.
    ///
    /// # Errors
    /// [`Error::Json`], or [`Error::Invalid`] naming the field and the cure.
    pub fn from_json(text: &str) -> Result<Self> {
        read_schema::<SolutionFile>(text, SOLUTION_SCHEMA).map(Self::from)
    }

    /// The solution as text `solution/1`, with the name of its problem and its residuals if given.
    pub fn to_json(&self, problem: Option<&str>, residuals: Option<serde_json::Value>) -> String {
        let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
        text(&SolutionFile {
            schema: SOLUTION_SCHEMA.into(),
            problem: problem.map(str::to_string),
            impulse: list(&self.impulse),
            velocity: list(&self.velocity),
            beta: self.beta.as_ref().map(list),
            sigma: self.sigma.as_ref().map(list),
            solver: self.solver.clone(),
            iterations: Some(self.iterations).filter(|iterations| *iterations > 0),
            residuals,
        })
    }
}

impl SolutionFile {
    /// Refuses an answer to a problem of another name; either may be without one.
    fn answers(&self, problem: &ContactProblem) -> Result<()> {
        match self.problem.as_deref() {
            Some(other) if !other.is_empty() && !problem.name().is_empty() && other != problem.name() => {
                let cure = format!("give the solution of the problem “{}”, or leave this name out", problem.name());
                Err(Error::invalid("problem", format!("is “{other}”"), cure))
            }
            _ => Ok(()),
        }
    }
}

impl From<SolutionFile> for Solution {
    fn from(file: SolutionFile) -> Self {
        Solution {
            impulse: DVector::from_vec(file.impulse),
            velocity: DVector::from_vec(file.velocity),
            beta: file.beta.map(DVector::from_vec),
            sigma: file.sigma.map(DVector::from_vec),
            solver: file.solver,
            iterations: file.iterations.unwrap_or_default(),
        }
    }
}

fn read_law(name: &str, directions: Option<usize>) -> Result<Law> {
    let law = match name {
        "frictionless" => Law::Frictionless,
        "coulomb" => Law::Coulomb,
        "associated" => Law::Associated,
        "polyhedral-coulomb" | "polyhedral-associated" => {
            let directions =
                directions.ok_or_else(|| Error::invalid("directions", "is missing", "give the number of friction directions"))?;
            return Ok(if name == "polyhedral-coulomb" {
                Law::PolyhedralCoulomb { directions }
            } else {
                Law::PolyhedralAssociated { directions }
            });
        }
        _ => {
            let cure = "use frictionless, coulomb, associated, polyhedral-coulomb or polyhedral-associated";
            return Err(Error::invalid("law", format!("is `{name}`"), cure));
        }
    };
    match directions {
        None => Ok(law),
        Some(_) => Err(Error::invalid("directions", format!("is given with the law `{name}`"), "leave it out, or use a polyhedral law")),
    }
}

fn read_operator(
    operator: Option<MatrixFile>,
    mass: Option<MatrixFile>,
    jacobian: Option<MatrixFile>,
    [rows_per_contact, rows]: [usize; 2],
) -> Result<(Operator, Option<Dynamics>)> {
    // sizes are compared before a matrix is made, so that a wrong shape cannot ask for all the memory
    let shape = |field: &str, matrix: &MatrixFile, wanted: [usize; 2]| {
        let problem = format!("has shape {}×{}", matrix.shape[0], matrix.shape[1]);
        let contacts = rows / rows_per_contact;
        let cure = format!("use the shape {}×{}, for {contacts} contacts with {rows_per_contact} rows each", wanted[0], wanted[1]);
        if matrix.shape == wanted { Ok(()) } else { Err(Error::invalid(field, problem, cure)) }
    };
    let room = |velocities: usize| {
        let matrices = [(2, rows, rows), (1, velocities, velocities), (2, rows, velocities)]
            .map(|(times, n, m)| memory::matrix(n, m).saturating_mul(times));
        memory::require("storing the matrices of this problem", matrices.into_iter().fold(0, u128::saturating_add))
    };
    match (operator, mass, jacobian) {
        (Some(operator), None, None) => {
            shape("delassus", &operator, [rows, rows])?;
            if !operator.has_blocks() {
                room(0)?;
            }
            Ok((operator.read_operator("delassus", rows_per_contact)?, None))
        }
        (None, Some(mass), Some(jacobian)) => {
            let velocities = mass.shape[0];
            if mass.triplets.as_ref().is_some_and(|triplets| triplets.value.len() < velocities) {
                return Err(Error::invalid("mass", "has an empty row", "give every velocity a positive inertia"));
            }
            shape("mass", &mass, [velocities, velocities])?;
            shape("jacobian", &jacobian, [rows, velocities])?;
            if let Some((field, _)) = [("mass", &mass), ("jacobian", &jacobian)].into_iter().find(|(_, matrix)| matrix.forms() != 1) {
                return Err(matrix::one_form(field));
            }
            if by_bodies::is_given(&mass, &jacobian) {
                return Ok((by_bodies::read(mass, jacobian, rows_per_contact)?.into(), None));
            }
            if rows > DENSE_ROWS && mass.triplets.is_some() && jacobian.triplets.is_some() {
                let (mass, jacobian) = (mass.read_sparse("mass")?, jacobian.read_sparse("jacobian")?);
                return Ok((SparseDynamics::new(&mass, &jacobian, rows_per_contact)?.delassus()?.into(), None));
            }
            room(velocities)?;
            let dynamics = Dynamics { mass: mass.read("mass")?, jacobian: jacobian.read("jacobian")? };
            Ok((delassus(&dynamics.mass, &dynamics.jacobian)?.into(), Some(dynamics)))
        }
        _ => Err(Error::invalid("delassus", "must stand alone, or `mass` and `jacobian` in its place", "give one of the two")),
    }
}

fn read_compliance(file: ComplianceFile) -> Result<Compliance> {
    let coordinates = match file.coordinates.as_str() {
        "contact" => Coordinates::Contact,
        "edge" => Coordinates::Edge,
        other => return Err(Error::invalid("compliance.coordinates", format!("is `{other}`"), "use `contact` or `edge`")),
    };
    Ok(Compliance { coordinates, diagonal: DVector::from_vec(file.diagonal) })
}

fn text(file: &impl Serialize) -> String {
    serde_json::to_string(file).expect("numbers, strings and lists always have a JSON form") + "\n"
}

#[cfg(test)]
mod tests;
