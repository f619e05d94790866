//! Where a contact acts, read off its rows.
//!
//! ```text
//!     row of direction d at a body whose centre is c:   (d, L_d) ,   L_d = r × d ,   r = p − c
//!     in space, over (n, t₁, t₂):   Σ_d d × (r × d) = 2 r            in the plane, over (n, t):   Σ_d d × (r × d) = r
//! ```
//! *Derivation.* d × (r × d) = r − d (d·r) for a unit vector d; the d (d·r) of an orthonormal frame of the space, or of the plane that
//! holds r, add up to r.

use super::BodyState;
use moreau_contact::contact::Contact;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Velocities of a body in space, of which the last three are the angular velocity in its own frame.
const SPATIAL: usize = 6;
/// Velocities of a body in the plane, of which the last one is the angular velocity about ŷ.
const PLANAR: usize = 3;

/// The point of the first body of a contact at which its rows are taken, in the world \[m\]; `None` where the contact has no place, or
/// its rows do not tell. `bodies` are those of the configuration of the contact.
pub fn contact_point(contact: &Contact, bodies: &[BodyState]) -> Option<[f64; 3]> {
    let place = contact.place.as_ref()?;
    let body = bodies.get(place.bodies.0)?;
    let part = contact.jacobian.parts().find(|part| part.width > 0 && part.first == part.width * place.bodies.0)?;
    let [w, i, j, k] = body.orientation;
    let turn = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
    let lever = |row: &[f64]| match part.width {
        SPATIAL => turn * Vector3::new(row[3], row[4], row[5]),
        _ => Vector3::new(0.0, row[2], 0.0),
    };
    let rows: Vec<&[f64]> = part.entries.chunks_exact(part.width).collect();
    let share = match (part.width, rows.len()) {
        (SPATIAL, 3) => 0.5,
        (PLANAR, 2) => 1.0,
        _ => return None,
    };
    let arms = rows.iter().zip(place.frame).map(|(row, direction)| Vector3::from(direction).cross(&lever(row)));
    let arm = arms.fold(Vector3::zeros(), |sum, arm| sum + arm) * share;
    Some((Vector3::from(body.position) + arm).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{Mechanism, State};
    use crate::scenes::{Body, Scene, named};
    use moreau_exact::tolerance::rounding;

    fn points(mechanism: &dyn Mechanism, state: &State) -> Vec<[f64; 3]> {
        let bodies = mechanism.bodies(&state.position, &state.velocity);
        let found = mechanism.contacts(&state.position).iter().map(|contact| contact_point(contact, &bodies)).collect::<Option<_>>();
        found.expect("contacts of bodies")
    }

    fn are_near(found: &[[f64; 3]], expected: &[[f64; 3]]) -> bool {
        let near = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= rounding(32, 2.0));
        found.len() == expected.len() && expected.iter().all(|one| found.iter().any(|other| near(one, other)))
    }

    #[test]
    fn a_ball_touches_with_its_lowest_point_in_the_plane_and_in_space() {
        let scene = named("ball-drop").expect("built in");
        for (mechanism, state) in [scene.mechanism(), scene.spatial_mechanism()].map(|made| made.expect("both")) {
            let found = points(mechanism.as_ref(), &state);
            assert!(are_near(&found, &[[0.0, 0.0, 1.0]]), "{found:?}");
        }
    }

    #[test]
    fn a_turned_box_touches_with_its_corners() {
        let mut body = Body::cuboid("box", 1.0, [0.3, 0.2, 0.1], [0.4, 0.0, 1.0]);
        let (sine, cosine) = 0.4f64.sin_cos();
        body.orientation = [cosine, 0.0, sine, 0.0];
        let scene = Scene { bodies: vec![body], ..named("ball-drop").expect("built in") };
        let (s, c) = 0.8f64.sin_cos();
        let corner = |a: f64, b: f64| [0.4 + a * c + b * s, 1.0 - a * s + b * c];
        let flat = [(0.3, 0.1), (0.3, -0.1), (-0.3, 0.1), (-0.3, -0.1)].map(|(a, b)| corner(a, b));
        let (planar, state) = scene.mechanism().expect("planar");
        let found = points(planar.as_ref(), &state);
        assert!(are_near(&found, &flat.map(|[x, z]| [x, 0.0, z])), "{found:?}");
        let (spatial, state) = scene.spatial_mechanism().expect("spatial");
        let found = points(spatial.as_ref(), &state);
        let both: Vec<_> = flat.iter().flat_map(|[x, z]| [[*x, 0.2, *z], [*x, -0.2, *z]]).collect();
        assert!(are_near(&found, &both), "{found:?}");
    }

    #[test]
    fn the_point_of_a_pair_is_on_the_first_body_and_a_linkage_has_none() {
        let (mechanism, state) = named("two-ball-impact").and_then(|scene| scene.spatial_mechanism()).expect("built in");
        let found = points(mechanism.as_ref(), &state);
        assert!(are_near(&found, &[[-0.5, 0.0, 0.0]]), "{found:?}");
        let linkage = crate::scenes::linkage("double-pendulum").and_then(|linkage| linkage.staged().ok()).expect("built in");
        let bodies = linkage.mechanism.bodies(&linkage.start.position, &linkage.start.velocity);
        assert!(linkage.mechanism.contacts(&linkage.start.position).iter().all(|contact| contact_point(contact, &bodies).is_none()));
    }
}
