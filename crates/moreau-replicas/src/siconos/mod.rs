//! Siconos: its stored runs, made again by our scheme of the same law.

pub mod alpha;
pub mod events;
pub mod steps;
