//! Files `lcp/1`: a linear complementarity problem as frictionless contacts of one row.
//!
//! ```json
//! {"schema": "lcp/1", "name": "two rows", "matrix": {"shape": [2, 2], "rows": [[2, 1], [0, 1]]}, "vector": [-1, 2]}
//! ```
//! 0 ≤ z ⟂ M z + q ≥ 0 is Signorini's problem with W = M, u_free = q and r = z; M may be any square matrix.

use super::matrix::{PlainMatrix, given};
use crate::files::{printable, read_schema};
use crate::memory;
use crate::problem::{ContactProblem, Law};
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Schema name of a linear complementarity problem.
pub(super) const LCP_SCHEMA: &str = "lcp/1";

/// A linear complementarity problem 0 ≤ z ⟂ M z + q ≥ 0, solved and judged as frictionless contacts of one row: r = z, u = M z + q.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Lcp")]
pub struct LcpFile {
    /// Always `lcp/1`.
    #[schemars(extend("const" = LCP_SCHEMA))]
    schema: String,
    /// A name for messages.
    #[serde(default)]
    name: String,
    /// M, square.
    #[serde(deserialize_with = "given")]
    matrix: PlainMatrix,
    /// q, as many entries as M has rows.
    vector: Vec<f64>,
    /// How the problem was made; opaque here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    provenance: Option<serde_json::Value>,
}

/// Reads the text of an `lcp/1`.
pub(super) fn read(text: &str) -> Result<ContactProblem> {
    let file: LcpFile = read_schema(text, LCP_SCHEMA)?;
    let size = file.vector.len();
    match file.matrix.shape {
        [rows, columns] if rows != columns => {
            let problem = format!("has shape {rows}×{columns}");
            return Err(Error::invalid("matrix", problem, format!("give a square matrix, {size}×{size} for a `vector` of size {size}")));
        }
        [rows, _] if rows != size => {
            let cure = format!("give size {rows}, as `matrix` is {rows}×{rows}, or a matrix of shape {size}×{size}");
            return Err(Error::invalid("vector", format!("has size {size}"), cure));
        }
        _ => {}
    }
    printable("name", &file.name)?;
    memory::require("the matrix of this problem", memory::matrix(size, size).saturating_mul(2))?;
    let matrix = file.matrix.read("matrix")?;
    ContactProblem::new(matrix, DVector::from_vec(file.vector))
        .name(file.name)
        .law(Law::Frictionless)
        .rows_per_contact(1)
        .of_any_matrix()
        .build()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO: &str = r#"{"schema":"lcp/1","name":"two","matrix":{"shape":[2,2],"rows":[[2,1],[0,1]]},"vector":[-1,2]}"#;

    #[test]
    fn a_problem_is_read_as_frictionless_contacts_whatever_its_matrix() {
        let problem = ContactProblem::from_json(TWO).unwrap();
        assert_eq!((problem.law(), problem.rows_per_contact(), problem.contacts()), (Law::Frictionless, 1, 2));
        assert_eq!((problem.entry(0, 1), problem.entry(1, 0), problem.free_velocity()[0]), (1.0, 0.0, -1.0));
        assert_eq!(ContactProblem::from_json(&problem.to_json()).unwrap(), problem, "written as a contact problem, it is the same");
    }

    #[test]
    fn sizes_and_fields_that_do_not_fit_are_named() {
        let refused = |text: &str, word: &str| {
            let message = ContactProblem::from_json(text).unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        };
        refused(&TWO.replace("[-1,2]", "[-1]"), "field `vector`: has size 1; give size 2, as `matrix` is 2×2");
        refused(&TWO.replace("[-1,2]", "[-1,2,3]"), "field `vector`: has size 3; give size 2");
        refused(&TWO.replace("\"shape\":[2,2]", "\"shape\":[2,3]"), "field `matrix`: has shape 2×3; give a square matrix, 2×2");
        refused(&TWO.replace("[0,1]]", "[0]]"), "matrix.rows[1]");
        refused(&TWO.replace("{\"shape\":[2,2],\"rows\":[[2,1],[0,1]]}", "[[2,1],[0,1]]"), "give a matrix as {\"shape\"");
        refused(&TWO.replace("{\"shape\":[2,2],\"rows\":[[2,1],[0,1]]}", "null"), "null instead of a matrix");
        refused(&TWO.replace("vector", "vectr"), "vectr");
        refused(
            &TWO.replace("\"rows\":[[2,1],[0,1]]", "\"blocks\":{\"row\":[],\"column\":[],\"value\":[]}"),
            "field `matrix.blocks`: unknown",
        );
        refused(&TWO.replace("\"rows\":[[2,1],[0,1]]", "\"shape\":[2,2]").replacen("\"shape\":[2,2],", "", 1), "`rows` and `triplets`");
    }

    #[test]
    fn the_schema_and_the_reader_allow_the_same_forms_of_the_matrix() {
        let schema = serde_json::to_value(schemars::schema_for!(LcpFile)).unwrap();
        let allowed = &schema["$defs"]["PlainMatrix"]["properties"];
        let forms = [
            ("rows", "[[2,1],[0,1]]"),
            ("triplets", r#"{"row":[0,0,1],"column":[0,1,1],"value":[2,1,1]}"#),
            ("blocks", r#"{"row":[0,0,1],"column":[0,1,1],"value":[2,1,1]}"#),
            ("diagonal_blocks", "[[2],[1]]"),
            ("sparse_rows", r#"{"starts":[0,2,3],"column":[0,1,1],"value":[2,1,1]}"#),
        ];
        for (form, value) in forms {
            let text = TWO.replace("\"rows\":[[2,1],[0,1]]", &format!("\"{form}\":{value}"));
            assert_eq!(ContactProblem::from_json(&text).is_ok(), allowed.get(form).is_some(), "{form}");
        }
        assert_eq!(allowed.as_object().map(|allowed| allowed.len()), Some(3), "the shape, and two forms");
    }
}
