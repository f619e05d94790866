//! Family 3: projection on the friction cone, `r = P_K(z)` with `K = K_μ`.
//!
//! Moreau's decomposition characterises the projection: `r` is the nearest point of K to `z` if and only if
//! ```text
//!     r ∈ K ,     z − r ∈ K° ,     r·(z − r) = 0 .
//! ```
//! The other properties follow from it, and each catches a mistake of its own. Nothing here calls the reference
//! projection: memberships are evaluated from the data, and the comparison values come from exact rationals or Clarabel.

mod clarabel;
mod rational;
mod subject;

pub use self::clarabel::{equals_clarabel, minimiser};
pub use self::rational::{RationalPoint, decided_exactly};
pub(crate) use self::subject::apply;
pub use self::subject::{Projection, cone_excess, difference, dot, norm, polar_excess};

use crate::finding::Finding;
use crate::tolerance::cone_projection as tolerance;

/// Moreau's decomposition: `r ∈ K`, `z − r ∈ K°`, `r·(z − r) = 0`.
///
/// ```
/// use moreau_checks::cone_projection::moreau_decomposition;
/// use moreau_contact::cones::second_order;
///
/// let (point, friction) = ([1.0, 3.0, 0.0], 0.5);
/// assert!(moreau_decomposition(second_order::project, &point, friction).iter().all(|finding| finding.holds()));
/// // shortening friction to μ r_n ends in the cone too, at another point than the nearest
/// let clip = |z: &mut [f64], mu: f64| z[1] = mu * z[0];
/// assert!(!moreau_decomposition(clip, &point, friction).iter().all(|finding| finding.holds()));
/// ```
pub fn moreau_decomposition(subject: Projection, z: &[f64], mu: f64) -> Vec<Finding> {
    let r = apply(subject, z, mu);
    let rest = difference(z, &r);
    let (size, bound) = (norm(z), tolerance::position(norm(z)));
    vec![
        Finding::at_most("projection lies in the cone: excess", cone_excess(&r, mu), bound, "N·s"),
        Finding::at_most("remainder lies in the polar cone: excess", polar_excess(&rest, mu), bound, "N·s"),
        Finding::equal("projection orthogonal to remainder", dot(&r, &rest), 0.0, tolerance::product(size, size), "N²·s²"),
    ]
}

/// The variational inequality `(z − r)·(k − r) ≤ 0` for a point `k` of the cone.
pub fn variational_inequality(subject: Projection, z: &[f64], mu: f64, cone_point: &[f64]) -> Vec<Finding> {
    let r = apply(subject, z, mu);
    let product = dot(&difference(z, &r), &difference(cone_point, &r));
    let bound = tolerance::product(norm(z), norm(z) + norm(cone_point));
    vec![Finding::at_most("angle to a cone point, (z−r)·(k−r)", product, bound, "N²·s²")]
}

/// `P(P(z)) = P(z)`.
pub fn idempotent(subject: Projection, z: &[f64], mu: f64) -> Vec<Finding> {
    let once = apply(subject, z, mu);
    let twice = apply(subject, &once, mu);
    let change = norm(&difference(&twice, &once));
    vec![Finding::at_most("second projection moves the point by", change, tolerance::position(norm(z)), "N·s")]
}

/// `‖P(z) − P(w)‖ ≤ ‖z − w‖`.
pub fn non_expansive(subject: Projection, z: &[f64], w: &[f64], mu: f64) -> Vec<Finding> {
    let images = norm(&difference(&apply(subject, z, mu), &apply(subject, w, mu)));
    let bound = norm(&difference(z, w)) + tolerance::position(norm(z) + norm(w));
    vec![Finding::at_most("distance of the images", images, bound, "N·s")]
}

/// `P(s z) = s P(z)` for a scale `s > 0`.
pub fn homogeneous(subject: Projection, z: &[f64], scale: f64, mu: f64) -> Vec<Finding> {
    let scaled: Vec<f64> = z.iter().map(|entry| scale * entry).collect();
    let expected: Vec<f64> = apply(subject, z, mu).iter().map(|entry| scale * entry).collect();
    let change = norm(&difference(&apply(subject, &scaled, mu), &expected));
    vec![Finding::at_most("scaling first or last differs by", change, tolerance::position(norm(&scaled)), "N·s")]
}

/// `P(Q z) = Q P(z)` for the rotation `Q` about the normal by `angle`; in two dimensions the reflection of the tangent.
pub fn equivariant(subject: Projection, z: &[f64], angle: f64, mu: f64) -> Vec<Finding> {
    let rotate = |point: &[f64]| match *point {
        [normal, first, second] => {
            let (sine, cosine) = angle.sin_cos();
            vec![normal, cosine * first - sine * second, sine * first + cosine * second]
        }
        [normal, tangent] => vec![normal, -tangent],
        _ => point.to_vec(),
    };
    let change = norm(&difference(&apply(subject, &rotate(z), mu), &rotate(&apply(subject, z, mu))));
    vec![Finding::at_most("rotating first or last differs by", change, tolerance::position(norm(z)), "N·s")]
}

/// The whole family on a fixed battery: every property at points of all three cases, below and above the plane z_n = 0.
///
/// # Errors
/// If Clarabel does not accept or does not solve one of the small problems.
pub fn battery(subject: Projection) -> moreau_exact::Result<Vec<Finding>> {
    const POINTS: [[f64; 3]; 7] =
        [[3.0, 0.5, -0.25], [-0.25, 1.0, 0.5], [-0.1, 0.0, 1.0], [1.0, -3.0, 2.0], [-4.0, 0.25, 0.5], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let mut findings = Vec::new();
    for mu in [0.0, 0.25, 1.0, 2.0] {
        for (index, z) in POINTS.iter().enumerate() {
            let other = POINTS[(index + 1) % POINTS.len()];
            findings.extend(moreau_decomposition(subject, z, mu));
            findings.extend(variational_inequality(subject, z, mu, &[1.0, 0.6 * mu, -0.8 * mu]));
            findings.extend(idempotent(subject, z, mu));
            findings.extend(non_expansive(subject, z, &other, mu));
            findings.extend(homogeneous(subject, z, 1.0 / 4096.0, mu));
            findings.extend(equivariant(subject, z, 1.0, mu));
            findings.extend(equals_clarabel(subject, z, mu)?);
        }
    }
    for point in RationalPoint::around_the_boundaries() {
        findings.extend(decided_exactly(subject, &point));
    }
    Ok(findings)
}
