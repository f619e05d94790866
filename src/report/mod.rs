//! Reports: text, JSON and pictures of what was found. Nothing here computes; nothing here prints.

mod all_solutions;
pub mod answers;
pub mod bench;
mod bound;
pub mod certificate;
pub mod comparison;
pub mod deepest;
pub mod explanation;
pub mod failures;
mod findings;
pub mod formats;
pub mod json;
pub mod lcp_proof;
pub mod matrix;
pub mod motion;
pub mod motion_page;
mod near;
pub mod no_answer;
pub mod peers;
pub mod problems;
pub mod profile;
pub mod proofs;
pub mod quantity;
mod sampled;
pub mod schemas;
pub mod site;
mod solutions_by_parts;
pub mod steps;
pub mod summary;
pub mod systems;
pub mod text;
pub mod witnesses;

pub use moreau_checks::plot;
pub use moreau_gate::report as gate;
