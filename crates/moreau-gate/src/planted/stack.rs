//! Mistakes that make stacks move or lose their weight.

use crate::planted::parts::with_mechanism;
use crate::planted::{Faulty, Kind, Planted};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[Planted {
    name: "stack/mass-ratio-clamped",
    mistake: "lightens bodies to a hundred times the lightest, so that the solver has it easier",
    kind: Kind::Reader,
    subject: Faulty {
        engine: || {
            with_mechanism(|scene| {
                let lightest = scene.bodies.iter().map(|body| body.mass).fold(f64::INFINITY, f64::min);
                let mut clamped = scene.clone();
                clamped.bodies.iter_mut().for_each(|body| body.mass = body.mass.min(100.0 * lightest));
                clamped.spatial_mechanism()
            })
        },
        caught_by: &["stack/mass-ratio"],
    },
}];
