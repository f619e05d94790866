//! The report as a static site: pages that open from a folder, without network and without a server.
//!
//! ```text
//! what the command found ──► pages, pictures, explorer ──► a folder
//! ```
//! Nothing here decides a verdict: the pages show what they are given. The pictures and the explorer compute with the crates below.

pub mod explorer;
pub mod pages;
pub mod picture;
pub mod pictures;
#[cfg(test)]
mod punctuation;
pub mod words;

pub use picture::Picture;
pub use words::{Language, Words};
