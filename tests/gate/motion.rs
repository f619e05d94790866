//! Determinism, transformed scenes, stacks, contact problems and projections.

use super::{controls_pass_and_fail, mistakes_are_caught, schemes_have_their_derived_verdicts};

macro_rules! family {
    ($($test:ident: $name:literal;)*) => {$(
        mod $test {
            #[test]
            fn every_scheme_has_its_derived_verdict() {
                super::schemes_have_their_derived_verdicts($name);
            }

            #[test]
            fn every_check_can_pass_and_fail() {
                super::controls_pass_and_fail($name);
            }

            #[test]
            fn every_planted_mistake_is_caught_by_name() {
                super::mistakes_are_caught(&[$name]);
            }
        }
    )*};
}

family! {
    determinism: "determinism";
    metamorphic: "metamorphic";
    stack: "stack";
    rocking: "rocking";
    painleve: "painleve";
    solver: "solver";
    projection: "projection";
}
