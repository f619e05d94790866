//! Files: read with errors that name the field, written whole or not at all.

mod atomic;
mod near;
mod schema;
mod text;
mod words;

pub use atomic::{is_same_file, write_atomically, write_together};
pub use near::{did_you_mean, near};
pub use schema::{read_object, read_schema, schema_of};
pub use text::{printable, read_json, read_problem, read_text};
pub use words::{Told, told};
