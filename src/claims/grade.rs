//! The grade of the evidence, computed from the findings that decide: that of the weakest of them.
//!
//! ```text
//!     exact            all are rational
//!     certified        one is held within a derived bound
//!     measured         one is the outcome of an experiment
//!     cited            one was looked up: in a package at its version, in stored facts, by an identifier
//!     not decidable    the sentence is an opinion on one of them
//! ```

use super::Evidence;
use crate::checks::{Finding, FindingOrigin, Voice};

/// The grade that follows from the findings.
pub fn grade(findings: &[Finding]) -> Evidence {
    let of = |finding: &Finding| match (finding.bearing.voice, finding.bearing.origin) {
        (Voice::Opinion(_), _) => Evidence::NotDecidable,
        (_, FindingOrigin::LookUp) => Evidence::Cited,
        (_, FindingOrigin::Experiment) => Evidence::Measured,
        (_, FindingOrigin::Computed) if finding.is_held_exactly() => Evidence::Exact,
        (_, FindingOrigin::Computed) => Evidence::Certified,
    };
    findings.iter().filter(|finding| !finding.bearing.context).map(of).max().unwrap_or(Evidence::NotDecidable)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weakest_finding_that_decides_gives_the_grade() {
        let exact = || Finding::count("a", 1, 1);
        let rounded = || Finding::equal("b", 1.0, 1.0, 0.5, "m");
        assert_eq!(grade(&[exact()]), Evidence::Exact);
        assert_eq!(grade(&[exact(), rounded()]), Evidence::Certified);
        assert_eq!(grade(&[exact(), rounded().context()]), Evidence::Exact);
        assert_eq!(grade(&[rounded(), exact().experiment()]), Evidence::Measured);
        assert_eq!(grade(&[exact().looked_up(), rounded().experiment()]), Evidence::Cited);
        assert_eq!(grade(&[exact().looked_up(), exact().opinion("what is elegant")]), Evidence::NotDecidable);
        assert_eq!(grade(&[exact().says(1.0)]), Evidence::Certified, "what the sentence says is rounded");
        assert_eq!(grade(&[exact().context()]), Evidence::NotDecidable);
    }
}
