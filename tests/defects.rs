//! Every planted mistake is caught by the checks it names, every check catches one, and the reference beside a defect passes.

use moreau::checks::Finding;
use moreau::defects;
use moreau::gate::{Verdict, checks, matrix, planted};
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};

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
    for family in ["delassus", "stewart-trinkle", "cone-projection", "zeno", "energy", "energy-balance", "convergence"] {
        assert!(families.get(family).copied().unwrap_or(0) >= 2, "family {family} has fewer than two defects");
    }
}

/// The checks that a planted engine names, all of which must catch it.
fn catch(mistake: &planted::Planted) -> &'static [&'static str] {
    assert!(!mistake.caught_by.is_empty(), "{} is that no check catches: {}", mistake.name, mistake.mistake);
    let find = |name: &&str| checks::find(name).unwrap_or_else(|| panic!("{}: no check `{name}`", mistake.name));
    let checks: Vec<_> = mistake.caught_by.iter().map(find).collect();
    let report = matrix::judge(mistake, &checks).unwrap_or_else(|error| panic!("{}: {error}", mistake.name));
    for outcome in &report.checks {
        let why = outcome.reason.as_deref().unwrap_or("");
        assert_eq!(outcome.verdict, Verdict::Fail, "{} does not catch {}: {} {why}", outcome.check, mistake.name, mistake.mistake);
    }
    mistake.caught_by
}

#[test]
fn every_planted_engine_is_caught_and_every_check_of_the_gate_catches_one() {
    let planted: Vec<&planted::Planted> = planted::all().collect();
    assert!(planted.len() >= 25);
    let catching: BTreeSet<&str> = planted.par_iter().flat_map_iter(|mistake| catch(mistake)).copied().collect();
    let idle: Vec<&str> = checks::all().map(|check| check.name).filter(|name| !catching.contains(name)).collect();
    assert!(idle.is_empty(), "these checks catch no planted mistake: {}", idle.join(", "));
}
