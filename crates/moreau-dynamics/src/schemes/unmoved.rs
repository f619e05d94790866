//! A scheme that computes with the mass matrix itself, where a body that nothing moves has no finite mass: the error names both.

use crate::mechanics::{Mechanism, State};
use moreau_contact::contact::Mass;
use moreau_exact::Error;

/// The error of a step, in words of the scheme and the bodies where it is about an infinite mass.
pub(super) fn told(error: Error, scheme: &str, mechanism: &dyn Mechanism, state: &State) -> Error {
    match &error {
        Error::Invalid { field, .. } if field == "mass" => {}
        _ => return error,
    }
    let names = unmoved(mechanism, state);
    if names.is_empty() {
        return error;
    }
    let (of, verb) = match names.as_slice() {
        [one] => (format!("of body `{one}`"), "is"),
        all => (format!("of bodies {}", all.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")), "are"),
    };
    let problem = format!("{of} {verb} infinite, for nothing moves what is static or prescribed, and {scheme} needs finite masses");
    let cure = "give a finite mass in place of `static` or `prescribed`, or use a scheme that takes masses body by body, as `moreau-jean`";
    Error::invalid("mass", problem, cure)
}

/// The names of the bodies that have an infinite mass, each with as many velocities as the others.
fn unmoved(mechanism: &dyn Mechanism, state: &State) -> Vec<String> {
    let Mass::Diagonal(diagonal) = mechanism.mass(&state.position) else { return Vec::new() };
    let bodies = mechanism.bodies(&state.position, &state.velocity);
    let width = diagonal.len() / bodies.len().max(1);
    let is_unmoved = |k: &usize| diagonal.as_slice()[k * width..(k + 1) * width].iter().any(|mass| mass.is_infinite());
    (0..bodies.len()).filter(is_unmoved).map(|k| bodies[k].name.clone()).collect()
}
