//! A position moved onto the contacts that a step holds.
//!
//! ```text
//!     q⁺ ← q⁺ + d ,    d = −H_nᵀ (H_n H_nᵀ)⁺ φ(q⁺)    until d is rounding
//! ```
//! d is the least of the moves that leave the least squares of the gaps φ, found island by island: normals that touch no common velocity,
//! not even through others, have no product, and what nothing moves, of an infinite mass, is where it is. No matrix of an island is made:
//! conjugate gradients on the least squares ask for products with H_n and H_nᵀ, and each of their iterates lies in the range of H_nᵀ, so
//! that their limit is the least move also where normals are dependent.
//!
//! # Source
//! Björck, *Numerical Methods for Least Squares Problems*, SIAM 1996, algorithm 7.4.1.

use crate::mechanics::Mechanism;
use crate::tolerance::schemes::{SOLVED_MOVE, projected};
use moreau_contact::contact::{BodyRows, Contact, Identity, Jacobian, Rows};
use moreau_contact::operator::islands_of;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::collections::HashMap;

/// Iterations of the projection: Newton's method on gaps that are closed to O(h²) needs some five.
const ITERATIONS: usize = 50;

/// Products with H_n and H_nᵀ for each normal of an island. Without rounding there are as many as normals; where that does not suffice,
/// the next iteration of the projection goes on from what was reached.
const PRODUCTS: usize = 4;

/// The bodies and features of a place, as [`moreau_contact::contact::Place::is_same`] compares them.
type Key = ((usize, Option<usize>), [u32; 2]);

/// A list of candidates in which another list's are found, as [`Identity::is_same`] compares them, without comparing all with all.
pub(super) struct Listed {
    by_place: HashMap<Key, usize>,
    by_index: HashMap<usize, usize>,
    by_index_without_place: HashMap<usize, usize>,
}

impl Listed {
    /// Of these, in their order.
    pub(super) fn of(list: impl Iterator<Item = Identity>) -> Self {
        let (by_place, by_index) = (HashMap::new(), HashMap::new());
        let mut listed = Listed { by_place, by_index, by_index_without_place: HashMap::new() };
        for (k, one) in list.enumerate() {
            listed.by_index.entry(one.index).or_insert(k);
            match one.place {
                Some(place) => listed.by_place.entry((place.bodies, place.features)).or_insert(k),
                None => listed.by_index_without_place.entry(one.index).or_insert(k),
            };
        }
        listed
    }

    /// Where the first that is the same stands.
    pub(super) fn position(&self, one: Identity) -> Option<usize> {
        let Some(place) = one.place else { return self.by_index.get(&one.index).copied() };
        let found = [self.by_place.get(&(place.bodies, place.features)), self.by_index_without_place.get(&one.index)];
        found.into_iter().flatten().min().copied()
    }
}

/// q moved onto φ = 0 of the contacts held; where they contradict each other, to the least squares of their gaps. A contact that is no
/// candidate any more has no gap to close.
///
/// # Errors
/// [`Error::Solver`] if a row or gap is not finite, or the contacts are not closed.
pub(super) fn project(mechanism: &dyn Mechanism, mut position: DVector<f64>, held: &[Identity]) -> Result<DVector<f64>> {
    let held = Listed::of(held.iter().copied());
    let mass = mechanism.mass(&position).diagonal();
    for _ in 0..ITERATIONS {
        let contacts = mechanism.contacts(&position);
        let is_held = |(k, contact): &(usize, &Contact)| held.position(Identity::of(*k, contact)).is_some();
        let own: Vec<&Contact> = contacts.iter().enumerate().filter(is_held).map(|(_, one)| one).collect();
        let normal = |contact: &&Contact| contact.jacobian.combined(&[&[1.0, 0.0, 0.0][..contact.jacobian.nrows()]]);
        let normals = Jacobian::new(1, mechanism.degrees_of_freedom(), own.iter().map(normal).collect());
        let gaps: Vec<f64> = own.iter().map(|contact| contact.gap).collect();
        let correction = -least_move(&normals, &gaps, &mass)?;
        if correction.amax() <= projected(position.amax()) {
            return Ok(position);
        }
        position = mechanism.integrate(&position, &correction, 1.0);
    }
    Err(Error::limit("projection", format!("the contacts were not closed in {ITERATIONS} iterations; use a smaller step")))
}

/// H_n⁺ φ, the least d with the least ‖H_n d − φ‖, island by island; velocities of an infinite mass stay as they are.
fn least_move(normals: &Jacobian, gaps: &[f64], mass: &DVector<f64>) -> Result<DVector<f64>> {
    let mut least = DVector::zeros(normals.ncols());
    for members in islands_of(normals) {
        let own = members.iter().map(|k| gaps[*k]).collect();
        let island = Island::of(members.iter().map(|k| &normals.contacts()[*k]), mass);
        // a velocity of another island is among these where a row has a zero in the middle of its body
        island.velocities.iter().zip(&island.least_move(own)?).for_each(|(velocity, moved)| least[*velocity] += moved);
    }
    Ok(least)
}

/// The normals of an island over the velocities that they touch.
struct Island {
    /// Which velocities, growing.
    velocities: Vec<usize>,
    /// Of every normal, places among these velocities and the entries there.
    normals: Vec<Vec<(usize, f64)>>,
}

impl Island {
    fn of<'a>(rows: impl Iterator<Item = &'a Rows>, mass: &DVector<f64>) -> Self {
        let moved = |part: BodyRows<'_>| {
            let entry = |axis: usize| (part.first + axis, part.entries[axis]);
            (0..part.width).map(entry).filter(|(velocity, _)| mass[*velocity].is_finite()).collect::<Vec<_>>()
        };
        let entries: Vec<Vec<(usize, f64)>> = rows.map(|row| row.parts().flat_map(moved).collect()).collect();
        let mut velocities: Vec<usize> = entries.iter().flatten().map(|(velocity, _)| *velocity).collect();
        velocities.sort_unstable();
        velocities.dedup();
        let place = |(velocity, entry): &(usize, f64)| (velocities.partition_point(|one| one < velocity), *entry);
        let normals = entries.iter().map(|normal| normal.iter().map(place).collect()).collect();
        Island { velocities, normals }
    }

    /// H_n d.
    fn product(&self, moved: &DVector<f64>) -> DVector<f64> {
        let along = |normal: &Vec<(usize, f64)>| normal.iter().map(|(place, entry)| entry * moved[*place]).sum();
        DVector::from_iterator(self.normals.len(), self.normals.iter().map(along))
    }

    /// H_nᵀ φ.
    fn slope(&self, gaps: &DVector<f64>) -> DVector<f64> {
        let mut slope = DVector::zeros(self.velocities.len());
        for (normal, gap) in self.normals.iter().zip(gaps) {
            normal.iter().for_each(|(place, entry)| slope[*place] += entry * gap);
        }
        slope
    }

    /// H_n⁺ φ by conjugate gradients.
    fn least_move(&self, gaps: Vec<f64>) -> Result<DVector<f64>> {
        let (mut left, mut least) = (DVector::from_vec(gaps), DVector::zeros(self.velocities.len()));
        let mut slope = self.slope(&left);
        let (mut direction, mut size) = (slope.clone(), slope.norm_squared());
        let enough = size * SOLVED_MOVE.powi(2);
        for _ in 0..PRODUCTS * self.normals.len() {
            if size <= enough {
                break;
            }
            let change = self.product(&direction);
            let step = size / change.norm_squared();
            if !step.is_finite() {
                return Err(Error::breakdown("projection", "a contact's row or gap is not finite; use a smaller step"));
            }
            least.axpy(step, &direction, 1.0);
            left.axpy(-step, &change, 1.0);
            slope = self.slope(&left);
            let before = std::mem::replace(&mut size, slope.norm_squared());
            direction = &slope + direction * (size / before);
        }
        Ok(least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::contact::Place;
    use moreau_exact::tolerance::rounding;

    /// Contacts at bodies in space: two islands of three bodies, one with its contacts twice, and a body that meets the ground alone.
    fn normals() -> Jacobian {
        let part = |seed: usize| [std::array::from_fn::<f64, 6, _>(|axis| (((7 * seed + axis) * 7919 + 13) % 101) as f64 / 37.0 - 1.0)];
        let row = |(one, other): (usize, Option<usize>)| {
            let rows = Rows::zeros(1, 42).with(6 * one, part(one + 11));
            other.map_or(rows.clone(), |other| rows.with(6 * other, part(3 * one + other)))
        };
        let pairs = [(1, Some(0)), (3, None), (2, Some(1)), (5, Some(6)), (1, Some(0)), (4, Some(5)), (0, None), (2, Some(1)), (6, None)];
        Jacobian::new(1, 42, pairs.map(row).into())
    }

    #[test]
    fn islands_move_as_one_dense_matrix_says() {
        let (normals, gaps) = (normals(), [0.1, -0.2, 0.3, -0.4, 0.15, 0.6, -0.7, 0.2, 0.9]);
        assert_eq!(islands_of(&normals), [vec![0, 2, 4, 6, 7], vec![3, 5, 8], vec![1]]);
        let dense = normals.to_dense();
        let metric = &dense * dense.transpose();
        let singular = metric.clone().symmetric_eigen().eigenvalues;
        let smallest = singular.iter().copied().filter(|value| *value > 1e-9).fold(f64::INFINITY, f64::min);
        assert!(singular.iter().filter(|value| **value <= 1e-9).count() == 2, "two contacts stand twice: {singular}");
        let expected = dense.transpose() * metric.pseudo_inverse(1e-9).expect("not negative") * DVector::from_row_slice(&gaps);
        let found = least_move(&normals, &gaps, &DVector::from_element(42, 1.0)).expect("finite");
        assert!((&found - &expected).amax() <= rounding(64, expected.amax() * singular.amax() / smallest), "{found} {expected}");
    }

    #[test]
    fn what_is_the_same_is_found_where_it_stands_first() {
        let place = |feature| Some(Place { bodies: (0, Some(1)), features: [feature, 0], frame: [[0.0; 3]; 3] });
        let some = [(0, place(1)), (1, None), (2, place(2)), (3, None), (1, place(2))].map(|(index, place)| Identity { index, place });
        for list in [&some[..], &some[..1], &some[1..2], &some[2..], &[]] {
            let listed = Listed::of(list.iter().copied());
            for (index, place) in (0..5).flat_map(|index| [None, place(1), place(2), place(3)].map(|place| (index, place))) {
                let one = Identity { index, place };
                assert_eq!(listed.position(one), list.iter().position(|other| other.is_same(&one)), "{one:?}");
            }
        }
    }

    #[test]
    fn a_body_of_two_islands_moves_in_both() {
        // level between two bodies, and one of them on the ground: no velocity is common
        let level = Rows::zeros(1, 12).with(0, [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]]).with(6, [[-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]]);
        let ground = Rows::zeros(1, 12).with(0, [[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]);
        for (rows, gaps) in [(vec![level.clone(), ground.clone()], [1.0, 0.25]), (vec![ground, level], [0.25, 1.0])] {
            let moved = least_move(&Jacobian::new(1, 12, rows), &gaps, &DVector::from_element(12, 1.0)).expect("finite");
            assert_eq!([moved[0], moved[2], moved[6]], [0.5, 0.25, -0.5]);
        }
    }

    #[test]
    fn what_nothing_moves_stays_and_the_other_body_takes_the_whole_gap() {
        let between = Rows::zeros(1, 12).with(0, [[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]).with(6, [[0.0, 0.0, -1.0, 0.0, 0.0, 0.0]]);
        let mass = DVector::from_fn(12, |velocity, _| if velocity < 6 { 2.0 } else { f64::INFINITY });
        let moved = least_move(&Jacobian::new(1, 12, vec![between.clone()]), &[0.25], &mass).expect("finite");
        assert!(moved[2] == 0.25 && moved.rows_range(6..).amax() == 0.0, "{moved}");
        // of two that nothing moves neither does
        let fixed = DVector::from_element(12, f64::INFINITY);
        assert_eq!(least_move(&Jacobian::new(1, 12, vec![between]), &[0.25], &fixed).expect("finite"), DVector::zeros(12));
    }

    #[test]
    fn a_long_lever_elsewhere_does_not_make_a_normal_dependent() {
        let lever = Rows::zeros(1, 12).with(0, [[0.0, 0.0, 1.0, 1e9, 0.0, 0.0]]);
        let normals = Jacobian::new(1, 12, vec![lever, Rows::zeros(1, 12).with(6, [[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])]);
        assert_eq!(least_move(&normals, &[0.0, 0.25], &DVector::from_element(12, 1.0)).expect("finite")[8], 0.25);
    }
}
