//! Files: read with errors that name the field, written whole or not at all.

mod atomic;
mod schema;

pub use atomic::write_atomically;
pub use schema::read_schema;
