//! Reading contact impulses off the solver's points, for the versions that keep them.

use super::rapier::prelude::*;
use super::{Real, World, array, this};
use crate::recorder::ContactPoint;

/// A point that the contact solver has seen, and the numbers of its two bodies.
pub struct SolvedPoint<'a> {
    pub bodies: (u128, u128),
    /// From the first body to the second.
    pub normal: Vector,
    /// What the solver has left there.
    pub data: &'a ContactData,
    /// What the solver was given.
    #[cfg(feature = "v0_34")]
    pub given: &'a SolverContact,
}

impl World {
    /// The points of the last step's contact problem.
    pub fn solved_points(&self) -> impl Iterator<Item = SolvedPoint<'_>> {
        let number = |handle: ColliderHandle| self.colliders[handle].user_data;
        self.narrow_phase.contact_pairs().flat_map(move |pair| {
            let bodies = (number(pair.collider1), number(pair.collider2));
            this::solver_manifolds(pair).iter().flat_map(move |manifold| {
                manifold.data.solver_contacts.iter().map(move |given| SolvedPoint {
                    bodies,
                    normal: manifold.data.normal,
                    data: &manifold.points[this::index_of(given)].data,
                    #[cfg(feature = "v0_34")]
                    given,
                })
            })
        })
    }
}

/// Normal impulse and friction impulses of a point, as the contact problem orders them.
pub struct PointImpulse {
    pub normal: Real,
    pub tangent: [Real; 2],
}

/// The impulse on the first body: the normal part along d = −n, friction along t and d × t; n points from the first to the second.
pub fn on_first_body(normal: Vector, tangent: Vector, impulse: &PointImpulse) -> ContactPoint {
    let direction = -normal;
    let friction = tangent * impulse.tangent[0] + direction.cross(tangent) * impulse.tangent[1];
    ContactPoint { normal: array(direction), impulse: array(direction * impulse.normal + friction) }
}

/// Rapier's tangent to d when nothing else tells one (T. Duff et al., Building an Orthonormal Basis, Revisited, 2017; second vector).
pub fn orthonormal_vector(d: Vector) -> Vector {
    let sign = Real::copysign(1.0, d.z);
    let a = -1.0 / (sign + d.z);
    Vector::new(d.x * d.y * a, sign + d.y * d.y * a, -d.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_basis_is_orthonormal_for_every_direction() {
        for d in [Vector::X, Vector::Y, Vector::Z, -Vector::Z, Vector::new(0.6, 0.0, -0.8), Vector::new(0.48, -0.6, 0.64)] {
            let (t, tolerance) = (orthonormal_vector(d), 8.0 * Real::EPSILON);
            assert!((t.length() - 1.0).abs() <= tolerance && t.dot(d).abs() <= tolerance, "{d}: {t}");
        }
    }

    #[test]
    fn the_impulse_of_a_point_is_put_together_in_the_world_frame() {
        // The first body lies on the second: n points down, d up, t along x and d × t along y.
        let point = on_first_body(-Vector::Z, Vector::X, &PointImpulse { normal: 3.0, tangent: [1.0, 2.0] });
        assert_eq!((point.normal, point.impulse), ([0.0, 0.0, 1.0], [1.0, 2.0, 3.0]));
    }
}
