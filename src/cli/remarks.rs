//! Remarks on a problem that is taken as it stands, though its operator is none of contacts between masses.
//!
//! ```text
//!     W = H M⁻¹ Hᵀ        is symmetric, and W_ii ≥ 0
//! ```
//! A linear complementarity problem may have any matrix. Nothing is refused here: the certificate judges with the W that is given.

use super::Format;
use super::kind::is_lcp;
use super::output::print_aside;
use crate::problem::Posed;
use crate::tolerance::solvers::SYMMETRY;
use std::path::Path;

/// Says on standard error what is unusual; in JSON nothing, for standard error may hold the answer.
pub(super) fn remark(file: &Path, posed: &Posed, format: Format) {
    if format == Format::Text && !is_lcp(file, posed) {
        remarks(posed).iter().for_each(|text| print_aside(&format!("remark: {}: {text}\n", file.display())));
    }
}

/// What is unusual of the operator of a contact problem, a sentence each; nothing where it is one of contacts between masses.
pub fn remarks(posed: &Posed) -> Vec<String> {
    let (asymmetry, negative) = match posed {
        // formed of masses and Jacobian it is neither
        Posed::Contacts(problem) if problem.delassus().matrix_free().is_some() => (0.0, None),
        Posed::Contacts(problem) => (problem.asymmetry(), (0..problem.rows()).find(|row| problem.entry(*row, *row) < 0.0)),
        Posed::Jointed(problem) => {
            let (w, largest) = (problem.delassus(), problem.delassus().amax());
            let asymmetry = if largest > 0.0 { (w - w.transpose()).amax() / largest } else { 0.0 };
            (asymmetry, (0..w.nrows()).find(|row| w[(*row, *row)] < 0.0))
        }
    };
    let skewed = (asymmetry > SYMMETRY).then(|| {
        let found = format!("W is not symmetric, max |W − Wᵀ| is {asymmetry:.1e} of max |W|");
        format!("field `delassus`: {found}; W of a mass and a Jacobian is, so look at its entries")
    });
    let falling = negative.map(|row| {
        format!("field `delassus`: W_ii < 0 in row {row} (from 0): an impulse there drives the bodies against itself; look at its sign")
    });
    skewed.into_iter().chain(falling).collect()
}
