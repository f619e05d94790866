//! Planted mistakes in the projection on the friction cone.

use crate::cone_projection::battery;
use crate::planted::{Beside, Kind, Planted};
use moreau_contact::cones::second_order::{contains, polar_contains, project, tangential_norm};

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[
    Planted {
        name: "projection/negative-normal-is-open",
        mistake: "sends every point with z_n < 0 to the apex, instead of those with μ‖z_t‖ ≤ −z_n",
        kind: Kind::Projection,
        subject: Beside {
            check: "properties/cone-projection",
            defective: || battery(negative_normal_is_open),
            reference: || battery(project),
        },
    },
    Planted {
        name: "cone-projection/linear-denominator",
        mistake: "r_n = (z_n + μ‖z_t‖)/(1 + μ) instead of /(1 + μ²)",
        kind: Kind::Projection,
        subject: Beside { check: "properties/cone-projection", defective: || battery(linear_denominator), reference: || battery(project) },
    },
    Planted {
        name: "cone-projection/tangent-without-mu",
        mistake: "‖r_t‖ = r_n instead of ‖r_t‖ = μ r_n",
        kind: Kind::Projection,
        subject: Beside { check: "properties/cone-projection", defective: || battery(tangent_without_mu), reference: || battery(project) },
    },
    Planted {
        name: "cone-projection/dual-cone",
        mistake: "projects on the dual cone K_{1/μ} instead of K_μ",
        kind: Kind::Projection,
        subject: Beside { check: "properties/cone-projection", defective: || battery(dual_cone), reference: || battery(project) },
    },
    Planted {
        name: "projection/clamp-the-tangent",
        mistake: "keeps max(z_n, 0) and shortens the tangent to μ z_n",
        kind: Kind::Projection,
        subject: Beside { check: "properties/cone-projection", defective: || battery(clamp_the_tangent), reference: || battery(project) },
    },
    Planted {
        name: "cone-projection/box",
        mistake: "each tangential entry is clamped to ±μ z_n by itself, so the result depends on the tangent axes",
        kind: Kind::Projection,
        subject: Beside { check: "properties/cone-projection", defective: || battery(tangent_box), reference: || battery(project) },
    },
    Planted {
        name: "projection/absolute-threshold",
        mistake: "takes small impulses for zero, whatever the unit",
        kind: Kind::Projection,
        subject: Beside { check: "properties/cone-projection", defective: || battery(absolute_threshold), reference: || battery(project) },
    },
];

fn negative_normal_is_open(z: &mut [f64], mu: f64) {
    if z[0] < 0.0 { z.fill(0.0) } else { project(z, mu) }
}

/// The boundary case with given `(r_n, ‖r_t‖)`; the other two cases as they should be.
fn boundary(z: &mut [f64], mu: f64, target: impl Fn(f64, f64) -> (f64, f64)) {
    if contains(z, mu) || polar_contains(z, mu) {
        return project(z, mu);
    }
    let norm = tangential_norm(z);
    let (normal, radius) = target(z[0], norm);
    z[0] = normal;
    z[1..].iter_mut().for_each(|entry| *entry *= radius / norm);
}

fn linear_denominator(z: &mut [f64], mu: f64) {
    boundary(z, mu, |normal, norm| {
        let result = (normal + mu * norm) / (1.0 + mu);
        (result, mu * result)
    });
}

fn tangent_without_mu(z: &mut [f64], mu: f64) {
    boundary(z, mu, |normal, norm| {
        let result = (normal + mu * norm) / (1.0 + mu * mu);
        (result, result)
    });
}

fn dual_cone(z: &mut [f64], mu: f64) {
    moreau_contact::cones::second_order::project_dual(z, mu);
}

/// The tangent clamped to μ times the normal part, instead of the nearest point.
pub fn clamp_the_tangent(z: &mut [f64], mu: f64) {
    z[0] = z[0].max(0.0);
    let norm = tangential_norm(z);
    if norm > mu * z[0] {
        let factor = mu * z[0] / norm;
        z[1..].iter_mut().for_each(|entry| *entry *= factor);
    }
}

fn tangent_box(z: &mut [f64], mu: f64) {
    z[0] = z[0].max(0.0);
    let bound = mu * z[0];
    z[1..].iter_mut().for_each(|entry| *entry = entry.clamp(-bound, bound));
}

fn absolute_threshold(z: &mut [f64], mu: f64) {
    project(z, mu);
    if z[0] < 1.0 / 1024.0 {
        z.fill(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cone_projection::*;
    use crate::finding::Finding;

    fn fails(findings: Vec<Finding>) -> bool {
        !findings.iter().all(Finding::holds)
    }

    #[test]
    fn each_property_is_broken_by_a_defect_of_its_own() {
        let z = [-0.1, 0.0, 1.0];
        assert!(fails(moreau_decomposition(negative_normal_is_open, &z, 1.0)));
        assert!(fails(moreau_decomposition(linear_denominator, &[1.0, 3.0, 4.0], 0.5)));
        assert!(fails(moreau_decomposition(dual_cone, &[1.0, 3.0, 4.0], 0.5)));
        assert!(fails(variational_inequality(clamp_the_tangent, &[1.0, 3.0, 4.0], 0.5, &[2.0, 0.6, 0.8])));
        assert!(fails(idempotent(tangent_without_mu, &[1.0, 3.0, 4.0], 0.5)));
        assert!(fails(non_expansive(negative_normal_is_open, &[0.0, 0.0, 1.0], &[-0.1, 0.0, 1.0], 1.0)));
        assert!(fails(homogeneous(absolute_threshold, &[1.0, 0.0, 0.0], 1.0 / 4096.0, 0.5)));
        assert!(fails(equivariant(tangent_box, &[1.0, 2.0, 2.0], 0.5, 0.5)));
        assert!(fails(equals_clarabel(negative_normal_is_open, &z, 1.0).expect("Clarabel solves three unknowns")));
        assert!(RationalPoint::around_the_boundaries().iter().any(|point| fails(decided_exactly(negative_normal_is_open, point))));
    }

    #[test]
    fn the_clamped_tangent_passes_everything_that_does_not_know_the_distance() {
        // Why the variational inequality is needed: this mistake is idempotent, homogeneous, equivariant and in the cone.
        let z = [1.0, 3.0, 4.0];
        assert!(!fails(idempotent(clamp_the_tangent, &z, 0.5)));
        assert!(!fails(homogeneous(clamp_the_tangent, &z, 8.0, 0.5)));
        assert!(!fails(equivariant(clamp_the_tangent, &z, 1.0, 0.5)));
    }
}
