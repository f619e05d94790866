//! What is looked up: facts about paths, versions, default values and literature, as rows of a table over stored facts.
//!
//! A row says which claim it belongs to, what is asked, of which package at its version, repository at its commit or record of literature,
//! what is expected, and what each control asks instead. One function makes the findings of a claim from its rows; the stored facts are
//! those that the scripts write.

mod bullet;
mod check;
mod chrono;
mod drake;
mod literature;
mod mujoco;
mod pinocchio;
mod query;
mod release;
mod row;
mod siconos;

pub(crate) use bullet::{ERP, SERVER_ERP};
pub(crate) use check::{check, looked_up};
pub(crate) use release::{BULLET, DZONOU, STEWART, STEWART_TRINKLE, year};
