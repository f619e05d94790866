//! How much memory a step of a mechanism needs, before it is taken.
//!
//! ```text
//!     linkages       8 bytes × (4 nv² + 4 m nv + 8 m²) ,   m = rows · contacts
//!     free bodies    8 bytes × 16 nv + size of a candidate · contacts
//! ```
//! Linkages: M, M̂, the copy in the problem and one of its factors; the rows of every candidate, H, its copy in the problem and L⁻¹Hᵀ; W
//! and what a solver and the certificate make of it. Free bodies have no such matrices: a few vectors, and the candidates. What the blocks
//! of W need is known, and checked, once the contacts are.

use super::Mechanism;
use moreau_contact::contact::Contact;
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
        let parts = if mechanism.is_free() {
            // a candidate, once more among those that the step holds, and its rows in H
            [(16, matrix(freedoms, 1)), (3, (contacts as u128).saturating_mul(size_of::<Contact>() as u128)), (0, 0)]
        } else {
            [(4, matrix(freedoms, freedoms)), (4, matrix(rows, freedoms)), (8, matrix(rows, rows))]
        };
        parts.into_iter().fold(0u128, |sum, (times, bytes)| sum.saturating_add(bytes.saturating_mul(times)))
    };
    require(format_args!("a step of {}, {freedoms} velocities without any contact,", mechanism.name()), needed(0))?;
    match mechanism.most_candidates() {
        Some(most) if require("", needed(most)).is_err() => {
            let contacts = mechanism.count_within(position, reach);
            require(
                format_args!("a step of {}, {freedoms} velocities and {contacts} contact candidates,", mechanism.name()),
                needed(contacts),
            )
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::spatial::{Shape, SpatialBody};
    use crate::mechanics::{BallChain, Materials, SpatialBodies};

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
        let (mechanism, position) = row(5000, 1.25);
        // 12 497 500 pairs are many, 4999 neighbours are few, whatever a matrix of all 30 000 velocities would need
        assert_eq!((mechanism.most_candidates(), mechanism.count_within(&position, 0.3)), (Some(12_497_500), 4999));
        assert!(afford(&mechanism, &position, 0.3).is_ok());
        let message = afford(&mechanism, &position, f64::INFINITY).expect_err("all pairs").to_string();
        assert!(message.contains("12497500 contact candidates") && message.contains("memory::set_limit"), "{message}");
    }

    #[test]
    fn a_mass_matrix_too_large_is_refused_before_the_contacts_are_counted() {
        let balls = 20_000;
        let chain = BallChain::new(vec![1.0; balls], vec![0.1; balls], 0.5).expect("valid");
        let message = afford(&chain, &DVector::zeros(balls), 0.0).expect_err("20 000² numbers").to_string();
        assert!(message.contains("without any contact") && message.contains("12.8 GB"), "{message}");
    }
}
