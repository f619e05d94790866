//! The Python module `moreau_contact`: contact problems solved and certified, scenes simulated, claims judged, engines gated.
//!
//! ```text
//!     numpy, scipy.sparse ──► ContactProblem ──► Solution + Certificate ──► numpy
//!     a Python class ──► Engine ──► gate ──► Report
//! ```
//! This crate is the compiled half, `moreau_contact._native`; names, documentation and the pytest plugin stand in `python/`. It holds no
//! mathematics: everything it answers is the answer of the crates below.

mod arrays;
mod away;
mod certificate;
mod claims;
mod engine;
mod errors;
mod gate;
mod interrupt;
mod motion;
mod posing;
mod problem;
mod report;
mod solution;

use pyo3::prelude::*;

/// The compiled half of `moreau_contact`.
#[pymodule]
mod _native {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::away::close;
    #[pymodule_export]
    use super::certificate::{Certificate, certify};
    #[pymodule_export]
    use super::claims::{claims, verify};
    #[pymodule_export]
    use super::gate::{baseline_steps, checks, gate, protocol_check};
    #[pymodule_export]
    use super::motion::{Motion, scenes, simulate};
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::report::Report;
    #[pymodule_export]
    use super::solution::{Solution, seconds_of, solve, solvers};

    /// Runs the command `moreau` with these arguments, the first of which is its name, and returns its exit code.
    #[pyfunction]
    fn command(py: Python<'_>, arguments: Vec<String>) -> PyResult<u8> {
        crate::away::away(py, || moreau::cli::run_with(arguments))
    }

    /// Sets how many bytes one computation may take; what needs more is refused before it is begun.
    #[pyfunction]
    fn set_memory_limit(bytes: u64) {
        moreau::memory::set_limit(bytes);
    }

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
