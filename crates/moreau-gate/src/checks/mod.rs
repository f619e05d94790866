//! The checks, one family per file.

use crate::Check;
use crate::check::Expected;

pub mod ball;
pub mod contact;
pub mod determinism;
pub mod energy;
pub mod flight;
pub mod impact;
pub mod incline;
pub mod isotropy;
pub mod metamorphic;
mod motion;
pub mod painleve;
pub mod projection;
pub mod rest;
pub mod rocking;
pub mod rolling;
mod scenery;
pub mod solver;
pub mod stack;
pub mod tumbling;

/// The families, in the order of the report.
pub const FAMILIES: &[&[Check]] = &[
    flight::CHECKS,
    ball::CHECKS,
    impact::CHECKS,
    rest::CHECKS,
    stack::CHECKS,
    determinism::CHECKS,
    metamorphic::CHECKS,
    solver::CHECKS,
    projection::CHECKS,
    incline::CHECKS,
    rolling::CHECKS,
    isotropy::CHECKS,
    contact::CHECKS,
    energy::CHECKS,
    rocking::CHECKS,
    painleve::CHECKS,
    tumbling::CHECKS,
];

/// The derived verdicts of our schemes that are not `pass`, family by family.
pub const EXPECTED: &[&[Expected]] = &[
    ball::EXPECTED,
    impact::EXPECTED,
    metamorphic::EXPECTED,
    incline::EXPECTED,
    rolling::EXPECTED,
    isotropy::EXPECTED,
    contact::EXPECTED,
    energy::EXPECTED,
    tumbling::EXPECTED,
];
