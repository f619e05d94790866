//! MuJoCo 3.17.0 as stored: what it says of itself (`references/facts`), and one step of a block that slides on an incline.

use crate::problem::ContactProblem;
use crate::schemes::mujoco::Cone;
use crate::stored::{RUNS, problem_and_answer, read};
use crate::{Error, Result};
use nalgebra::DVector;
use serde_json::Value;

const FACTS: &str = "facts/mujoco.json";
const ELLIPTIC: &str = "mujoco/block_slide__cg-elliptic__h0.002__step100.dump.json";
const PYRAMIDAL: &str = "mujoco/block_slide__cg-pyramidal__h0.002__step100.dump.json";

/// A stored JSON document.
pub struct Stored(Value);

/// The stored facts.
///
/// # Errors
/// If the file is not JSON.
pub fn facts() -> Result<Stored> {
    read(&RUNS, FACTS).map(Stored)
}

/// The stored step with this cone: its problem, and the document.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn sliding_block(cone: Cone) -> Result<(ContactProblem, Stored)> {
    let path = match cone {
        Cone::Elliptic => ELLIPTIC,
        Cone::Pyramidal => PYRAMIDAL,
    };
    Ok((problem_and_answer(&RUNS, path)?.0, Stored(read(&RUNS, path)?)))
}

impl Stored {
    fn at(&self, path: &[&str]) -> Result<&Value> {
        let found = path.iter().fold(&self.0, |value, key| key.parse().map_or_else(|_| &value[*key], |index: usize| &value[index]));
        if found.is_null() { Err(Error::invalid(path.join("/"), "is not stored", "run scripts/generate_references.py")) } else { Ok(found) }
    }

    /// The number at a path.
    ///
    /// # Errors
    /// If there is none.
    pub fn number(&self, path: &[&str]) -> Result<f64> {
        self.at(path)?.as_f64().ok_or_else(|| Error::invalid(path.join("/"), "is not a number", "see references/README.md"))
    }

    /// The numbers at a path, in the order of a list or of the keys.
    ///
    /// # Errors
    /// If there are none.
    pub fn numbers(&self, path: &[&str]) -> Result<DVector<f64>> {
        let found = self.at(path)?;
        let values: Vec<&Value> = match found {
            Value::Array(values) => values.iter().collect(),
            Value::Object(values) => values.values().collect(),
            _ => Vec::new(),
        };
        let numbers: Option<Vec<f64>> = values.into_iter().map(Value::as_f64).collect();
        numbers.map(DVector::from_vec).ok_or_else(|| Error::invalid(path.join("/"), "are not numbers", "see references/README.md"))
    }

    /// The text at a path, empty if there is none.
    pub fn text(&self, path: &[&str]) -> String {
        self.at(path).ok().and_then(Value::as_str).unwrap_or_default().to_string()
    }
}
