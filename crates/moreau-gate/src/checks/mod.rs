//! The checks, one family per file.

use crate::Check;
use crate::check::Expected;

pub mod ball;
pub mod bounce;
pub mod contact;
pub mod conveyor;
pub mod determinism;
pub mod energy;
pub mod fixed;
pub mod flight;
pub mod impact;
pub mod incline;
pub mod isotropy;
pub mod limits;
pub mod metamorphic;
mod motion;
pub mod painleve;
pub mod pair;
pub mod projection;
pub mod rest;
pub mod rocking;
pub mod rolling;
pub mod round;
mod scenery;
pub mod solver;
pub mod spin;
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
    spin::CHECKS,
    limits::CHECKS,
    bounce::CHECKS,
    pair::CHECKS,
    fixed::CHECKS,
    conveyor::CHECKS,
    round::CHECKS,
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
    spin::EXPECTED,
    bounce::EXPECTED,
    pair::EXPECTED,
    fixed::EXPECTED,
    conveyor::EXPECTED,
    round::EXPECTED,
];

/// Every check, family by family.
pub fn all() -> impl Iterator<Item = &'static Check> {
    FAMILIES.iter().copied().flatten()
}

/// The check with this name.
pub fn find(name: &str) -> Option<&'static Check> {
    all().find(|check| check.name == name)
}

#[cfg(test)]
mod tests {
    use super::all;
    use crate::tolerance::SOLVED;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn derivations_quote_the_part_that_a_solver_may_leave_as_it_is() {
        let quoting: Vec<&str> = all().filter(|check| check.derivation.contains("√2⁻²³")).map(|check| check.name).collect();
        let square = 0.5f64.powi(23);
        let is_meant = (SOLVED * SOLVED - square).abs() <= rounding(1, square);
        assert!(is_meant && quoting.len() >= 3, "the texts of {quoting:?} say √2⁻²³ for {SOLVED}");
    }
}
