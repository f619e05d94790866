//! Every planted defect is caught by its family, and the reference beside it passes.

use moreau::checks::Finding;
use moreau::defects;
use std::collections::HashMap;

#[test]
fn every_defect_is_caught_and_every_reference_passes() {
    for defect in defects::all() {
        let reference = (defect.reference)().unwrap_or_else(|error| panic!("{}: reference: {error}", defect.name));
        assert!(!reference.is_empty(), "{}: the check found nothing", defect.name);
        for finding in &reference {
            assert!(finding.holds(), "{}: the reference fails: {finding}", defect.name);
        }
        let defective = (defect.defective)().unwrap_or_else(|error| panic!("{}: {error}", defect.name));
        assert!(!defective.iter().all(Finding::holds), "{} is not caught: {}", defect.name, defect.mistake);
    }
}

#[test]
fn every_family_has_at_least_two_defects() {
    let mut families: HashMap<&str, usize> = HashMap::new();
    for defect in defects::all() {
        *families.entry(defect.name.split('/').next().expect("split yields one part")).or_default() += 1;
    }
    for family in ["delassus", "stewart-trinkle", "cone-projection", "zeno", "energy", "convergence"] {
        assert!(families.get(family).copied().unwrap_or(0) >= 2, "family {family} has fewer than two defects");
    }
}
