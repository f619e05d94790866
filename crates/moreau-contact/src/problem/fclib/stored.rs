//! What a file of FCLIB holds beside its problem: a solution, and guesses to start from.
//!
//! ```text
//!     solution    r, u                guesses    number_of_guesses, and groups 1, 2, … with r, u each
//! ```
//! Global problems and problems with bilateral rows store v and λ besides, for which a local problem of contacts has no place.

use super::datasets::{integers, numbers, text};
use super::{is_hdf5, open};
use crate::problem::Solution;
use hdf5_pure::File;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::path::Path;

/// The answers beside a problem, every number bit for bit.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StoredAnswers {
    /// r and u of the solution.
    pub solution: Option<Solution>,
    /// r and u of each guess.
    pub guesses: Vec<Solution>,
    /// The texts that describe the problem, each with its name – title, description, math_info –, where they say more than what is written
    /// without them.
    pub info: Vec<(String, String)>,
    /// The datasets that a local problem of contacts has no place for, by their paths; of the problem itself, those of a global one,
    /// and attributes.
    pub left_out: Vec<String>,
}

/// What a global problem has in place of W and q.
const GLOBAL: [&str; 4] = ["M", "H", "vectors/f", "vectors/w"];
/// What answers have besides r and u.
const BESIDES: [&str; 2] = ["v", "l"];
/// The groups of a problem and its answers, whose attributes are not read.
const GROUPS: [&str; 8] =
    ["/", "fclib_local", "fclib_local/info", "fclib_local/W", "fclib_global", "fclib_global/info", "solution", "guesses"];
/// The texts that describe a problem, each with what is written where nothing is known.
pub(super) const INFO: [(&str, &str); 3] = [("title", "unnamed"), ("description", "written by moreau"), ("math_info", "unknown")];

impl StoredAnswers {
    /// The answers that a file holds; none where it is no HDF5.
    ///
    /// # Errors
    /// [`Error::InFile`] around [`Error::Invalid`] naming the dataset that is missing.
    /// ```
    /// use moreau_contact::nalgebra::{DMatrix, dvector};
    /// use moreau_contact::prelude::*;
    /// use moreau_contact::problem::StoredAnswers;
    ///
    /// let block = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]).build()?;
    /// let file = std::env::temp_dir().join(format!("moreau-stored-{}.hdf5", std::process::id()));
    /// std::fs::write(&file, block.to_fclib(None, Some(&dvector![1.0, 0.0, 0.0]))?).expect("a folder for temporary files");
    /// let stored = StoredAnswers::read(&file)?;
    /// assert!(stored.solution.is_none() && stored.guesses[0].velocity == dvector![0.0, 2.0, 0.0]);
    /// assert_eq!(block.to_fclib_with(&stored)?, std::fs::read(&file).expect("it was written"));
    /// # std::fs::remove_file(&file).expect("it was written");
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn read(file: &Path) -> Result<Self> {
        if is_hdf5(file) { open(file).and_then(|open| Self::of(&open)).map_err(|error| error.in_file(file)) } else { Ok(Self::default()) }
    }

    fn of(file: &File) -> Result<Self> {
        let has = |group: &str| file.group(group).is_ok();
        let mut stored = Self { info: info(file), ..Self::default() };
        let has_attributes = |group: &&&str| file.group(group).and_then(|group| group.attrs()).is_ok_and(|found| !found.is_empty());
        stored.left_out.extend(GROUPS.iter().filter(has_attributes).map(|group| format!("attributes of {group}")));
        if has("fclib_global") {
            stored.left_out.extend(GLOBAL.map(|name| format!("fclib_global/{name}")));
        }
        if has("solution") {
            stored.solution = Some(stored.pair(file, "solution")?);
        }
        if has("guesses") {
            let path = "guesses/number_of_guesses";
            let count = match integers(file, path)?[..] {
                [count] if count >= 0 => count,
                ref other => return Err(Error::invalid(path, format!("is {other:?}"), "give one number ≥ 0")),
            };
            for guess in 1..=count {
                let guess = stored.pair(file, &format!("guesses/{guess}"))?;
                stored.guesses.push(guess);
            }
        }
        Ok(stored)
    }

    /// r and u of a group; what else it has is left out.
    fn pair(&mut self, file: &File, group: &str) -> Result<Solution> {
        let besides = BESIDES.map(|name| format!("{group}/{name}"));
        self.left_out.extend(besides.into_iter().filter(|path| file.dataset(path).is_ok()));
        let [impulse, velocity] = ["r", "u"].map(|name| numbers(file, &format!("{group}/{name}")).map(DVector::from_vec));
        Ok(Solution::new("stored", impulse?, velocity?, 0))
    }
}

/// The texts of a problem that say something.
fn info(file: &File) -> Vec<(String, String)> {
    let of = |group: &str, (name, nothing): (&str, &str)| {
        let found = text(file, &format!("{group}/info/{name}")).filter(|text| !text.is_empty() && text != nothing);
        found.map(|text| (name.to_string(), text))
    };
    ["fclib_local", "fclib_global"].into_iter().flat_map(|group| INFO.into_iter().filter_map(move |one| of(group, one))).collect()
}
