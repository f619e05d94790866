//! Mistakes of cone projections; those of [`moreau_checks::defects::cone_projection`], behind the engine's door.

use crate::Engine;
use crate::planted::parts::moreau_jean;
use crate::planted::{Faulty, Kind, Planted};
use moreau_checks::defects::cone_projection::clamp_the_tangent;
use moreau_contact::cones::second_order::{contains, polar_contains, project, tangential_norm};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "projection/negative-normal-is-open",
        mistake: "sends every point with z_n < 0 to the apex, instead of those with μ‖z_t‖ ≤ −z_n",
        kind: Kind::Projection,
        subject: Faulty {
            engine: || with_projection(|z, mu| if z[0] < 0.0 { z.fill(0.0) } else { project(z, mu) }),
            caught_by: &["projection/regions", "projection/optimality"],
        },
    },
    Planted {
        name: "projection/along-the-normal",
        mistake: "lifts a point along the normal until it is in the cone, instead of going the shortest way",
        kind: Kind::Projection,
        subject: Faulty { engine: || with_projection(along_the_normal), caught_by: &["projection/regions", "projection/optimality"] },
    },
    Planted {
        name: "projection/clamp-the-tangent",
        mistake: "keeps max(z_n, 0) and shortens the tangent to μ z_n",
        kind: Kind::Projection,
        subject: Faulty { engine: || with_projection(clamp_the_tangent), caught_by: &["projection/regions", "projection/optimality"] },
    },
    Planted {
        name: "projection/absolute-threshold",
        mistake: "takes small impulses for zero, whatever the unit",
        kind: Kind::Projection,
        subject: Faulty { engine: || with_projection(absolute_threshold), caught_by: &["projection/boundaries", "projection/optimality"] },
    },
];

fn with_projection(projection: fn(&mut [f64], f64)) -> Box<dyn Engine> {
    moreau_jean(|engine| engine.project = projection)
}

fn along_the_normal(z: &mut [f64], mu: f64) {
    if polar_contains(z, mu) {
        z.fill(0.0);
    } else if mu > 0.0 && !contains(z, mu) {
        z[0] = tangential_norm(z) / mu;
    } else {
        project(z, mu);
    }
}

fn absolute_threshold(z: &mut [f64], mu: f64) {
    project(z, mu);
    if z[0] < 1.0 / (1u64 << 30) as f64 {
        z.fill(0.0);
    }
}
