//! Files `contact-problem/1`, `lcp/1` and `solution/1`.
//!
//! ```json
//! {"schema": "contact-problem/1", "name": "block on the floor", "dimension": 2, "law": "coulomb", "friction": [0.5],
//!  "free_velocity": [-0.1, 0.2], "shift": [0, 0], "delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}}
//! ```
//! Numbers in SI. `dimension` is the number of rows per contact. A matrix is `rows`, or `triplets` {row, column, value}
//! counted from 0, each place at most once; W may be `blocks` {row, column, value}, of the contacts that meet. Instead of
//! `delassus` a file may give `mass` and `jacobian`; with `diagonal_blocks` of the mass and `sparse_rows` of the Jacobian W is not formed,
//! and by triplets and with more than 240 rows they make W by blocks. Optional: `keys` (bodies and features of each
//! contact, by which impulses are carried to a changed list), `shift` (default 0), `directions` (polyhedral laws), `compliance`
//! {coordinates: contact | edge, diagonal}, `bodies` (the two bodies of each contact, the ground as null), `kinds` (contacts, limits of one
//! row and bilateral constraints of 1 to 6 rows, in any order), `provenance` (anything).

use super::contact_problem::ROWS;
use super::{ConstraintKind, ContactKey, ContactProblem, Coordinates, Posed, Solution, siconos};
use crate::files::{read_json, read_object, read_problem, read_schema, schema_of, write_atomically};
use crate::memory;
use crate::operator::SparseDynamics;
use crate::tolerance::problem::DENSE_ROWS;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

mod by_bodies;
mod file;
mod jointed;
mod lcp;
mod matrix;
mod sparse_rows;

pub use file::ProblemFile;
use file::{ComplianceFile, KeyFile, PROBLEM_SCHEMA, read_compliance, read_kinds, read_law, read_operator, text, written};
pub use lcp::LcpFile;
use matrix::MatrixFile;

/// The text of a problem may take this part of the memory: its numbers and matrices take the rest.
const TEXT_SHARE: u64 = 4;
/// A number of a text that is read: in its list, which may be twice as long as it is full, and in its matrix \[bytes\].
const NUMBER_BYTES: u128 = 24;
/// Schema name of a solution.
pub const SOLUTION_SCHEMA: &str = "solution/1";

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
    /// u = W r + u_free \[m/s\], without `shift`; if absent it is computed, and there is nothing to compare.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    velocity: Option<Vec<f64>>,
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

impl Posed {
    /// Reads and validates what [`ContactProblem::read`] reads, and files whose `kinds` name limits and bilateral constraints.
    ///
    /// # Errors
    /// Those of [`ContactProblem::read`].
    pub fn read(file: &Path) -> Result<Self> {
        #[cfg(feature = "fclib")]
        if super::fclib::is_hdf5(file) {
            return super::fclib::read(file).map_err(|error| error.in_file(file));
        }
        let ends = |end: &str| file.extension().is_some_and(|found| found.eq_ignore_ascii_case(end));
        let is_named_hdf5 = ends("hdf5") || ends("h5");
        let text = match read_problem(file, memory::limit() / TEXT_SHARE, "or allow more with --max-memory") {
            Err(Error::Read { .. }) if is_named_hdf5 && file.is_file() => return Err(no_hdf5().in_file(file)),
            read => read?,
        };
        let read = match text.trim_start().bytes().next() {
            Some(b'{') => Self::from_json(&text),
            Some(b'0'..=b'9') => Self::siconos(&text, file),
            _ if is_named_hdf5 => Err(no_hdf5()),
            _ if ends("dat") => Self::siconos(&text, file),
            _ => Self::from_json(&text),
        };
        read.map_err(|error| error.in_file(file))
    }

    /// Reads and validates the text of a `contact-problem/1` or an `lcp/1`.
    ///
    /// # Errors
    /// Those of [`ContactProblem::from_json`].
    pub fn from_json(text: &str) -> Result<Self> {
        memory::require("reading this problem", NUMBER_BYTES * text.bytes().filter(|byte| *byte == b',').count() as u128)?;
        if schema_of(text, &[PROBLEM_SCHEMA, lcp::LCP_SCHEMA])? == lcp::LCP_SCHEMA {
            return lcp::read(text).map(Self::contacts);
        }
        let mut file: ProblemFile = read_object(text, PROBLEM_SCHEMA)?;
        if !(1..=3).contains(&file.dimension) {
            return Err(Error::invalid("dimension", format!("is {}", file.dimension), ROWS));
        }
        match file.kinds.take() {
            None => ContactProblem::of_file(file).map(Self::contacts),
            Some(kinds) => {
                let kinds = read_kinds(&kinds)?;
                if kinds.len() == file.friction.len() && kinds.iter().all(|kind| *kind == ConstraintKind::Contact) {
                    return ContactProblem::of_file(file).map(Self::contacts);
                }
                jointed::read(file, kinds).map(|problem| Posed::Jointed(Box::new(problem)))
            }
        }
    }

    fn siconos(text: &str, file: &Path) -> Result<Self> {
        siconos::read(text, &file.file_stem().unwrap_or_default().to_string_lossy()).map(Self::contacts)
    }

    fn contacts(problem: ContactProblem) -> Self {
        Posed::Contacts(Box::new(problem))
    }
}

/// The error of a file that is named as HDF5 and is none.
fn no_hdf5() -> Error {
    let cure = "give a whole HDF5 file of FCLIB: it may be cut off or of another format";
    Error::invalid("HDF5", "is missing: the file does not begin as HDF5 files do", cure)
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
        without_joints(Posed::read(file)?).map_err(|error| error.in_file(file))
    }

    /// Reads and validates the text of a `contact-problem/1` or an `lcp/1`.
    ///
    /// # Errors
    /// [`Error::Json`], or [`Error::Invalid`] naming the field and the cure.
    pub fn from_json(text: &str) -> Result<Self> {
        without_joints(Posed::from_json(text)?)
    }

    fn of_file(file: ProblemFile) -> Result<Self> {
        file.check_counts()?;
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
            .known(dynamics)
            .bodies(file.bodies)
            .keys(file.keys.map(|keys| keys.into_iter().map(|KeyFile { bodies, features }| ContactKey { bodies, features }).collect()))
            .build()
    }

    /// The problem as text `contact-problem/1`. Mass and Jacobian are written in place of W if W follows from them bit for bit.
    pub fn to_json(&self) -> String {
        let [mass, jacobian] = match self.delassus().matrix_free() {
            Some(free) => by_bodies::written(free).map(Some),
            None if self.rows() > DENSE_ROWS && self.delassus().blocks().is_some() => self.written_triplets(),
            None => written(self.dynamics(), self.dense()),
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
            kinds: None,
            provenance: None,
        };
        text(&file)
    }

    /// M̂ and H entry by entry, if the W by blocks that they are read as is this one bit for bit.
    fn written_triplets(&self) -> [Option<MatrixFile>; 2] {
        let Some([mass, jacobian]) = self.triplets() else { return [None, None] };
        let read = SparseDynamics::new(&mass, &jacobian, self.rows_per_contact()).and_then(|listed| listed.delassus());
        let follows = read.is_ok_and(|w| self.delassus().blocks() == Some(&w));
        if follows { [mass, jacobian].map(|entries| Some(MatrixFile::sparse(entries))) } else { [None, None] }
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
        Self::read_with(file, problem.name(), |impulse| {
            problem.require_size("impulse", impulse.len())?;
            Ok(problem.velocity(impulse))
        })
    }

    /// [`Solution::read`] of an answer to a problem with joints or without.
    ///
    /// # Errors
    /// Those of [`Solution::read`].
    pub fn read_posed(file: &Path, problem: &Posed) -> Result<Self> {
        match problem {
            Posed::Contacts(problem) => Self::read(file, problem),
            Posed::Jointed(problem) => Self::read_with(file, problem.name(), |impulse| {
                problem.require_rows("impulse", impulse.len())?;
                Ok(problem.velocity(impulse))
            }),
        }
    }

    /// The answer of a file to the problem of this name, in which impulses have this velocity.
    fn read_with(file: &Path, problem: &str, velocity: impl FnOnce(&DVector<f64>) -> Result<DVector<f64>>) -> Result<Self> {
        #[cfg(feature = "fclib")]
        if super::fclib::is_hdf5(file) {
            return super::fclib::read_solution(file).map_err(|error| error.in_file(file));
        }
        let answer: Result<SolutionFile> = read_schema(&read_json(file)?, SOLUTION_SCHEMA);
        answer.and_then(|answer| answer.answers(problem).and_then(|()| answer.with_velocity(velocity))).map_err(|error| error.in_file(file))
    }

    /// Reads the text of a `solution/1` with its velocity; whether it fits a problem is the certificate's question.
    ///
    /// # Errors
    /// [`Error::Json`], or [`Error::Invalid`] naming the field and the cure.
    pub fn from_json(text: &str) -> Result<Self> {
        let absent = |_: &DVector<f64>| {
            Err(Error::invalid("velocity", "is missing", "give u = W r + u_free, or read the answer as a file beside its problem"))
        };
        read_schema::<SolutionFile>(text, SOLUTION_SCHEMA)?.with_velocity(absent)
    }

    /// The solution as text `solution/1`, with the name of its problem and its residuals if given.
    pub fn to_json(&self, problem: Option<&str>, residuals: Option<serde_json::Value>) -> String {
        let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
        text(&SolutionFile {
            schema: SOLUTION_SCHEMA.into(),
            problem: problem.map(str::to_string),
            impulse: list(&self.impulse),
            velocity: Some(list(&self.velocity)),
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
    fn answers(&self, problem: &str) -> Result<()> {
        match self.problem.as_deref() {
            Some(other) if !other.is_empty() && !problem.is_empty() && other != problem => {
                let cure = format!("give the solution of the problem “{problem}”, or leave this name out");
                Err(Error::invalid("problem", format!("is “{other}”"), cure))
            }
            _ => Ok(()),
        }
    }

    /// The answer with its own velocity, or that of its impulses.
    fn with_velocity(self, of: impl FnOnce(&DVector<f64>) -> Result<DVector<f64>>) -> Result<Solution> {
        let impulse = DVector::from_vec(self.impulse);
        Ok(Solution {
            velocity: self.velocity.map_or_else(|| of(&impulse), |velocity| Ok(DVector::from_vec(velocity)))?,
            impulse,
            beta: self.beta.map(DVector::from_vec),
            sigma: self.sigma.map(DVector::from_vec),
            solver: self.solver,
            iterations: self.iterations.unwrap_or_default(),
        })
    }
}

/// The contacts of a file, where it has nothing else.
fn without_joints(posed: Posed) -> Result<ContactProblem> {
    match posed {
        Posed::Contacts(problem) => Ok(*problem),
        Posed::Jointed(_) => {
            let cure = "`moreau solve`, `certify` and `bench` read it, and `Posed::read` in a program";
            Err(Error::invalid("kinds", "names limits or bilateral constraints, which are not read here", cure))
        }
    }
}

#[cfg(test)]
mod tests;
