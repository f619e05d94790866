//! Certificates: whether an answer is a solution, decided without knowing where it came from.
//!
//! This module imports no solver and no scheme.

pub mod natural_map;
