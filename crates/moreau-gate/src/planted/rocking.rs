//! Mistakes at impacts that turn a body: rocking blocks and Painlevé's rod.

use crate::planted::parts::with_mechanism;
use crate::planted::{Faulty, Kind, Planted};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    solver!(GLUED, &["rocking/impact", "solver/certificate"]),
    Planted {
        name: "rocking/full-edges",
        mistake: "takes half edges for edges in the box's moments of inertia, which become a quarter of the right ones",
        kind: Kind::Reader,
        subject: Faulty { engine: || with_mechanism(full_edges), caught_by: &["rocking/fall-time"] },
    },
    solver!(SLIP_FIXED, &["painleve/rod", "solver/certificate"]),
];

fn full_edges(scene: &Scene) -> Result<(Box<dyn Mechanism>, State)> {
    let mut scene = scene.clone();
    for body in &mut scene.bodies {
        if let (Some(cuboid), None) = (body.cuboid, body.inertia) {
            let [a, b, c] = cuboid.half_extents.map(|half| half * half);
            body.inertia = Some([b + c, a + c, a + b].map(|squares| body.mass * squares / 12.0));
        }
    }
    scene.spatial_mechanism()
}
