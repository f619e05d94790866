//! How much memory a step of a mechanism needs, before it is taken.
//!
//! ```text
//!     8 bytes × (4 nv² + 4 m nv + 8 m²) ,   m = rows · contacts
//! ```
//! nv²: M, M̂, the copy in the problem and one of its factors. m nv: the rows of every candidate, H, its copy in the problem and L⁻¹Hᵀ. m²:
//! W and what a solver and the certificate make of it. Everything is dense.

use super::Mechanism;
use moreau_contact::memory::{matrix, require};
use moreau_exact::Result;
use nalgebra::DVector;

/// Refuses a step with the candidates within `reach` if it needs more than [`moreau_contact::memory::limit`].
///
/// # Errors
/// [`moreau_exact::Error::Invalid`] with the size and the cure.
pub fn afford(mechanism: &dyn Mechanism, position: &DVector<f64>, reach: f64) -> Result<()> {
    let (freedoms, rows) = (mechanism.degrees_of_freedom(), mechanism.rows_per_contact());
    let needed = |contacts: usize| {
        let rows = rows.saturating_mul(contacts);
        let parts = [(4, matrix(freedoms, freedoms)), (4, matrix(rows, freedoms)), (8, matrix(rows, rows))];
        parts.into_iter().fold(0u128, |sum, (times, bytes)| sum.saturating_add(bytes.saturating_mul(times)))
    };
    require(&format!("a step of {}, {freedoms} velocities without any contact,", mechanism.name()), needed(0))?;
    match mechanism.most_candidates() {
        Some(most) if require("", needed(most)).is_err() => {
            let contacts = mechanism.count_within(position, reach);
            require(&format!("a step of {}, {freedoms} velocities and {contacts} contact candidates,", mechanism.name()), needed(contacts))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::spatial::{Shape, SpatialBody};
    use crate::mechanics::{Materials, SpatialBodies};

    /// Spheres of radius ½ m in a row, this far apart.
    fn row(count: usize, spacing: f64) -> (SpatialBodies, DVector<f64>) {
        let ball = |k: usize| SpatialBody::solid(format!("ball{k}"), Shape::Sphere { radius: 0.5 }, 1.0).expect("a ball");
        let materials = Materials::new(0.5, 0.0).expect("valid");
        let mechanism = SpatialBodies::without_ground("row", (0..count).map(ball).collect(), [0.0; 3], materials).expect("valid");
        let place = |k: usize| [k as f64 * spacing, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        (mechanism, DVector::from_iterator(7 * count, (0..count).flat_map(place)))
    }

    #[test]
    fn a_step_needs_what_is_near_and_not_what_there_could_be() {
        let (mechanism, position) = row(200, 1.25);
        // 19 900 pairs would need W of 59 700² numbers, 199 neighbours need little
        assert_eq!((mechanism.most_candidates(), mechanism.count_within(&position, 0.3)), (Some(19_900), 199));
        assert!(afford(&mechanism, &position, 0.3).is_ok());
        let message = afford(&mechanism, &position, f64::INFINITY).expect_err("all pairs").to_string();
        assert!(message.contains("19900 contact candidates") && message.contains("--max-memory"), "{message}");
    }

    #[test]
    fn a_mass_matrix_too_large_is_refused_before_the_pairs_are_counted() {
        let (mechanism, position) = row(20_000, 1.25);
        let message = afford(&mechanism, &position, 0.0).expect_err("120 000² numbers").to_string();
        assert!(message.contains("without any contact") && message.contains("460.8 GB"), "{message}");
    }
}
