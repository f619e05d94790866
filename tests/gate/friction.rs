//! Families that ask for friction: incline, rolling, isotropy, contact; and energy.

use super::*;

const FAMILIES: [&str; 5] = ["incline", "rolling", "isotropy", "contact", "energy"];

#[test]
fn the_incline_judges_our_schemes_as_derived() {
    schemes_have_their_derived_verdicts("incline");
}

#[test]
fn rolling_judges_our_schemes_as_derived() {
    schemes_have_their_derived_verdicts("rolling");
}

#[test]
fn isotropy_judges_our_schemes_as_derived() {
    schemes_have_their_derived_verdicts("isotropy");
}

#[test]
fn reported_impulses_of_our_schemes_are_judged_as_derived() {
    schemes_have_their_derived_verdicts("contact");
}

#[test]
fn energy_judges_our_schemes_as_derived() {
    schemes_have_their_derived_verdicts("energy");
}

#[test]
fn every_check_of_friction_can_pass_and_can_fail() {
    FAMILIES.iter().for_each(|name| controls_pass_and_fail(name));
}

#[test]
fn every_mistake_of_friction_is_caught() {
    mistakes_are_caught(&FAMILIES);
}
