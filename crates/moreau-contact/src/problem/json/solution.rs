//! `solution/1`: a proposed answer, read beside its problem or as a start for another one.

use super::file::{KeyFile, read_keys, text, write_keys};
use crate::files::{printable, read_json, read_schema};
use crate::problem::carried::by_keys;
use crate::problem::contact_problem::finite;
#[cfg(feature = "fclib")]
use crate::problem::fclib;
use crate::problem::{ContactKey, ContactProblem, Posed, Solution, keys};
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

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
    /// β of Stewart–Trinkle, or edge impulses \[N·s\]; where it is given, it is judged with the impulses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    beta: Option<Vec<f64>>,
    /// σ of Stewart–Trinkle \[m/s\]; judged where it is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sigma: Option<Vec<f64>>,
    /// Which contact each is, in the order of `impulse`: by these a start finds its contacts in another list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    keys: Option<Vec<KeyFile>>,
    /// The solver's name.
    #[serde(default)]
    solver: String,
    /// Iterations or pivots used; absent where there were none, or nobody knows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    iterations: Option<usize>,
    /// False where a time limit ended the solver: another run need not find this answer again. Absent where nobody says so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    reproducible: Option<bool>,
    /// Residuals, for people; not trusted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    residuals: Option<serde_json::Value>,
}

/// Impulses to begin from, and which contacts they are of.
#[derive(Clone, Debug, PartialEq)]
pub struct WarmStart {
    /// One for each row of the problem \[N·s\].
    pub impulse: DVector<f64>,
    /// How many contacts the start knew by their keys, the others being zero; `None` where impulses go by position.
    pub matched: Option<usize>,
}

impl Solution {
    /// Reads a file `solution/1`, or the group `solution` of an FCLIB file, that answers this problem; residuals stored in it are not
    /// trusted and not kept.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::InFile`] around what [`Solution::from_json`] says, or around [`Error::Invalid`] where the file names
    /// another problem or other keys.
    pub fn read(file: &Path, problem: &ContactProblem) -> Result<Self> {
        Self::read_with(file, problem.name(), problem.keys(), |impulse| {
            problem.require_size("impulse", impulse.len())?;
            Ok(problem.doubled_velocity(impulse))
        })
    }

    /// [`Solution::read`] of an answer to a problem with joints or without.
    ///
    /// # Errors
    /// Those of [`Solution::read`].
    pub fn read_posed(file: &Path, problem: &Posed) -> Result<Self> {
        match problem {
            Posed::Contacts(problem) => Self::read(file, problem),
            Posed::Jointed(problem) => Self::read_with(file, problem.name(), problem.keys(), |impulse| {
                problem.require_rows("impulse", impulse.len())?;
                Ok(problem.doubled_velocity(impulse))
            }),
        }
    }

    /// The answer of a file to the problem of this name and these keys, in which impulses have this velocity.
    fn read_with(
        file: &Path,
        problem: &str,
        keys: Option<&[ContactKey]>,
        velocity: impl FnOnce(&DVector<f64>) -> Result<DVector<f64>>,
    ) -> Result<Self> {
        #[cfg(feature = "fclib")]
        if fclib::is_hdf5(file) {
            return fclib::read_solution(file).map_err(|error| error.in_file(file));
        }
        let answer = SolutionFile::read(file)?;
        let checked = answer.answers(problem).and_then(|()| answer.is_in_order(keys));
        checked.and_then(|()| answer.with_velocity(velocity)).map_err(|error| error.in_file(file))
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
            keys: self.keys.as_deref().map(write_keys),
            solver: self.solver.clone(),
            iterations: Some(self.iterations).filter(|iterations| *iterations > 0),
            reproducible: self.reproducible,
            residuals,
        })
    }
}

impl SolutionFile {
    fn read(file: &Path) -> Result<Self> {
        let read = |text: &str| -> Result<Self> {
            let answer: Self = read_schema(text, SOLUTION_SCHEMA)?;
            printable("solver", &answer.solver)?;
            printable("problem", answer.problem.as_deref().unwrap_or_default())?;
            Ok(answer)
        };
        read(&read_json(file)?).map_err(|error| error.in_file(file))
    }

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

    /// Refuses impulses of contacts in another order than the problem's; either may be without keys.
    fn is_in_order(&self, keys: Option<&[ContactKey]>) -> Result<()> {
        let (Some(own), Some(keys)) = (&self.keys, keys) else { return Ok(()) };
        if own.len() != keys.len() {
            let cure = format!("give {}, one for each contact of the problem, or leave them out", keys.len());
            return Err(Error::invalid("keys", format!("has size {}", own.len()), cure));
        }
        match write_keys(keys).iter().zip(own).position(|(wanted, own)| wanted != own) {
            None => Ok(()),
            Some(k) => {
                let cure = "give the contacts in the order of the problem; as a start, `moreau solve --start` takes them in any order";
                Err(Error::invalid(format!("keys[{k}]"), "is another contact than in the problem", cure))
            }
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
            keys: self.keys.map(read_keys),
            solver: self.solver,
            iterations: self.iterations.unwrap_or_default(),
            reproducible: self.reproducible,
        })
    }
}

impl WarmStart {
    /// The impulses of a file `solution/1` or of FCLIB's HDF5 as a start for a problem: by keys where both have them, whatever problem the
    /// file answers, by position elsewhere. Contacts that the start does not know begin at zero. Contacts with joints go by position.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::InFile`] around [`Error::Invalid`]: a wrong size, a key that is no key or stands twice, an impulse that
    /// is no finite number, or – by position – an answer to a problem of another name.
    pub fn read(file: &Path, problem: &Posed) -> Result<Self> {
        #[cfg(feature = "fclib")]
        if fclib::is_hdf5(file) {
            let found = fclib::read_solution(file).and_then(|answer| Self::by_position(answer.impulse, problem));
            return found.map_err(|error| error.in_file(file));
        }
        Self::of(SolutionFile::read(file)?, problem).map_err(|error| error.in_file(file))
    }

    /// The impulses of an answer as a start for a problem: as [`WarmStart::read`] takes them from a file, which may name its problem.
    ///
    /// # Errors
    /// [`Error::Invalid`]: a wrong size, a key that stands twice, or an impulse that is no finite number.
    /// ```
    /// use moreau_contact::nalgebra::{DMatrix, dvector};
    /// use moreau_contact::prelude::*;
    /// use moreau_contact::problem::{ContactKey, Posed, WarmStart};
    ///
    /// let key = |body: usize| ContactKey { bodies: [Some(body), None], features: [0, 0] };
    /// let mut answer = Solution::new("before", dvector![1.0, 2.0], dvector![0.0, 0.0], 0);
    /// answer.keys = Some(vec![key(5), key(7)]);
    /// let next = ContactProblem::new(DMatrix::identity(3, 3), dvector![0.0, 0.0, 0.0]).rows_per_contact(1);
    /// let next = next.keys(Some(vec![key(7), key(6), key(5)])).build()?;
    /// let start = WarmStart::of_solution(&answer, &Posed::Contacts(Box::new(next)))?;
    /// assert_eq!((start.impulse, start.matched), (dvector![2.0, 0.0, 1.0], Some(2)));
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn of_solution(answer: &Solution, problem: &Posed) -> Result<Self> {
        match (&answer.keys, problem) {
            (Some(own), Posed::Contacts(contacts)) if contacts.keys().is_some() => {
                keys::validate(own)?;
                let (impulse, matched) = by_keys(own, &answer.impulse, contacts)?;
                Ok(WarmStart { impulse, matched: Some(matched) })
            }
            _ => Self::by_position(answer.impulse.clone(), problem),
        }
    }

    fn of(answer: SolutionFile, problem: &Posed) -> Result<Self> {
        let goes_by_keys = answer.keys.is_some() && matches!(problem, Posed::Contacts(contacts) if contacts.keys().is_some());
        if !goes_by_keys {
            answer.answers(match problem {
                Posed::Contacts(contacts) => contacts.name(),
                Posed::Jointed(jointed) => jointed.name(),
            })?;
        }
        Self::of_solution(&answer.with_velocity(|_| Ok(DVector::zeros(0)))?, problem)
    }

    fn by_position(impulse: DVector<f64>, problem: &Posed) -> Result<Self> {
        match problem {
            Posed::Contacts(problem) => problem.require_size("impulse", impulse.len()),
            Posed::Jointed(problem) => problem.require_rows("impulse", impulse.len()),
        }?;
        finite("impulse", impulse.as_slice())?;
        Ok(WarmStart { impulse, matched: None })
    }
}
