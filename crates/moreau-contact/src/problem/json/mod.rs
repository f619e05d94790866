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
use super::{ConstraintKind, ContactProblem, Coordinates, Posed, siconos};
use crate::files::{printable, read_object, read_problem, schema_of, write_atomically};
use crate::memory;
use crate::operator::SparseDynamics;
use crate::tolerance::problem::DENSE_ROWS;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::path::Path;

mod by_bodies;
mod file;
mod jointed;
mod lcp;
mod matrix;
mod solution;
mod sparse_rows;
mod streamed;

pub use file::ProblemFile;
use file::{ComplianceFile, PROBLEM_SCHEMA, read_compliance, read_keys, read_kinds, read_law, read_operator, text, write_keys, written};
pub use lcp::LcpFile;
use matrix::MatrixFile;
pub use solution::{SolutionFile, WarmStart};
use streamed::{NUMBER_BYTES, READING, commas};

/// The text of a problem may take this part of the memory: its numbers and matrices take the rest.
const TEXT_SHARE: u64 = 4;

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
        let limit = memory::limit() / TEXT_SHARE;
        if let Some(fields) = streamed::read(file, limit) {
            return Self::of_fields(fields).map_err(|error| error.in_file(file));
        }
        let more = format!("allow {TEXT_SHARE} times the size of the file with {}", memory::raised_by());
        let text = match read_problem(file, limit, &more) {
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
        memory::require(READING, NUMBER_BYTES * commas(text.as_bytes()))?;
        if schema_of(text, &[PROBLEM_SCHEMA, lcp::LCP_SCHEMA])? == lcp::LCP_SCHEMA {
            return lcp::read(text).map(Self::contacts);
        }
        Self::of_fields(read_object(text, PROBLEM_SCHEMA)?)
    }

    fn of_fields(mut file: ProblemFile) -> Result<Self> {
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
        printable("name", &file.name)?;
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
            .keys(file.keys.map(read_keys))
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
            keys: self.keys().map(write_keys),
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
