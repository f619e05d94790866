//! W = H M̂⁻¹ Hᵀ that is never formed: an impulse moves bodies, and bodies move contacts.
//!
//! ```text
//!     M̂ = diag(M₁, M₂, …) ,   M_b = L_b D_b L_bᵀ ,   Y_kb = L_b⁻¹ H_kbᵀ
//!     w_b = D_b⁻¹ Σ_k Y_kb r_k ,      (W r)_k = Σ_b Y_kbᵀ w_b                                               [m/s]
//! ```
//! w_b = L_bᵀ M_b⁻¹(Hᵀr)_b are the velocities of body b in coordinates in which its mass is D_b. Where M_b is not symmetric, w_b =
//! M_b⁻¹(Hᵀr)_b, with H_kbᵀ and M_b⁻¹H_kbᵀ in place of the two Y. Memory and a sweep grow with the number of contacts, however many meet at
//! one body.

use super::mass_block::Factor;
use super::slot::{Slot, slots};
use super::{BlockRows, BlockSparse, ContactOperator, lost_digits};
use crate::memory;
use crate::tolerance::certificate::{VELOCITIES, row_rounding};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DMatrixView};
use std::collections::HashMap;

/// W by the bodies that contacts touch.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixFree {
    /// M_b, column by column, body after body \[kg\].
    masses: Vec<f64>,
    /// Where each M_b begins.
    mass_starts: Vec<usize>,
    jacobian: BlockRows,
    /// Y_kb in the places of H_kb, or nothing where H_kb itself stands in its place.
    left: Option<Vec<f64>>,
    /// M_b⁻¹H_kbᵀ in the same places, where some M_b is not symmetric; D is the identity then.
    right: Option<Vec<f64>>,
    /// D_b⁻¹ \[1/kg\] of every velocity.
    inverse: Vec<f64>,
    /// W_kk, column by column \[1/kg\].
    diagonal: Vec<f64>,
    /// Of every contact, [`ContactOperator::write_terms`] without what the masses lose.
    terms: Vec<usize>,
    /// What the masses of its bodies lose when they are factored, in terms.
    lost: Vec<usize>,
}

impl MatrixFree {
    /// W of bodies with the masses M_b and of the rows of H. An M_b may be asymmetric where its symmetric part is definite; so is W then.
    ///
    /// # Errors
    /// [`Error::Invalid`] if sizes do not fit, a number is not finite, some M_b is not definite, or W takes more memory than is allowed.
    /// ```
    /// use moreau_contact::nalgebra::{dmatrix, dvector};
    /// use moreau_contact::operator::{BlockRows, MatrixFree, Operator};
    ///
    /// // a mass of 2 kg on the floor and one of 4 kg on top of it
    /// let mut jacobian = BlockRows::new(1, [1, 1])?;
    /// jacobian.push(&[(0, &[1.0])])?;
    /// jacobian.push(&[(0, &[-1.0]), (1, &[1.0])])?;
    /// let stack = Operator::from(MatrixFree::new(&[dmatrix![2.0], dmatrix![4.0]], jacobian)?);
    /// assert_eq!(stack.apply(&dvector![1.0, 2.0]), dvector![-0.5, 1.0]);
    /// assert_eq!(stack.dense(), &dmatrix![0.5, -0.5; -0.5, 0.75]);
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn new(masses: &[DMatrix<f64>], jacobian: BlockRows) -> Result<Self> {
        if masses.len() != jacobian.body_count() {
            let problem = format!("has {}", counted(masses.len(), "block"));
            return Err(Error::invalid("mass", problem, format!("give {}, one per body of the Jacobian", jacobian.body_count())));
        }
        let entries = jacobian.values().len() as u128;
        memory::require("the operator of this problem by bodies", entries.saturating_mul(24))?;
        let (mut kept, mut mass_starts, mut factors) = (Vec::new(), vec![0], Vec::with_capacity(masses.len()));
        for (body, mass) in masses.iter().enumerate() {
            let size = jacobian.velocities(body).len();
            if mass.shape() != (size, size) {
                let problem = format!("has a block of {}×{} at body {body}", mass.nrows(), mass.ncols());
                return Err(Error::invalid("mass", problem, format!("use {size}×{size}, as the Jacobian has velocities of this body")));
            }
            factors.push(Factor::new(mass)?);
            kept.extend_from_slice(mass.as_slice());
            mass_starts.push(kept.len());
        }
        if let Some(entry) = jacobian.values().iter().find(|entry| !entry.is_finite()) {
            return Err(Error::invalid("jacobian", format!("has the entry {entry}"), "use finite numbers"));
        }
        let rows = jacobian.rows_per_contact();
        let (terms, lost) = (terms(&jacobian), lost(&jacobian, &cancelling(masses, &factors)));
        let mut made = MatrixFree {
            masses: kept,
            mass_starts,
            left: None,
            right: None,
            inverse: vec![1.0; jacobian.velocity_count()],
            diagonal: Vec::new(),
            terms,
            lost,
            jacobian,
        };
        if factors.iter().all(Factor::is_symmetric) {
            made.set_symmetric(masses, &factors);
        } else {
            made.right = Some(made.transformed(|body, transposed| factors[body].solve_columns(transposed)));
        }
        made.diagonal = Vec::with_capacity(rows * rows * made.contacts());
        let mut block = vec![0.0; rows * rows];
        for k in 0..made.contacts() {
            made.write_block(k, k, &mut block);
            made.diagonal.extend_from_slice(&block);
        }
        if let Some(place) = made.diagonal.iter().position(|entry| !entry.is_finite()) {
            let problem = format!("makes W infinite at contact {}", place / (rows * rows).max(1));
            return Err(Error::invalid("mass", problem, "rescale the units of the problem: some mass is too small for a number"));
        }
        Ok(made)
    }

    fn set_symmetric(&mut self, masses: &[DMatrix<f64>], factors: &[Factor]) {
        for (body, factor) in factors.iter().enumerate() {
            let range = self.jacobian.velocities(body);
            self.inverse[range].iter_mut().zip(factor.pivots()).for_each(|(inverse, pivot)| *inverse = 1.0 / pivot);
        }
        let is_diagonal = |mass: &DMatrix<f64>| (0..mass.len()).all(|place| place % (mass.nrows() + 1) == 0 || mass[place] == 0.0);
        if !masses.iter().all(is_diagonal) {
            self.left = Some(self.transformed(|body, transposed| factors[body].forward_columns(transposed)));
        }
    }

    /// Every H_kbᵀ, changed in place, in the places of H_kb.
    fn transformed(&self, change: impl Fn(usize, &mut DMatrix<f64>)) -> Vec<f64> {
        let mut found = Vec::with_capacity(self.jacobian.values().len());
        for (body, block) in (0..self.contacts()).flat_map(|k| self.jacobian.contact(k)) {
            let size = self.jacobian.velocities(body).len();
            let mut transposed = DMatrix::from_column_slice(size, self.rows_per_contact(), block);
            change(body, &mut transposed);
            found.extend_from_slice(transposed.as_slice());
        }
        found
    }

    /// Rows of each contact.
    pub fn rows_per_contact(&self) -> usize {
        self.jacobian.rows_per_contact()
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.jacobian.contacts()
    }

    /// H by contacts and bodies.
    pub fn jacobian(&self) -> &BlockRows {
        &self.jacobian
    }

    /// M_b \[kg\].
    ///
    /// # Panics
    /// If there is no such body.
    pub fn mass(&self, body: usize) -> DMatrixView<'_, f64> {
        let size = self.jacobian.velocities(body).len();
        DMatrixView::from_slice(&self.masses[self.mass_starts[body]..self.mass_starts[body + 1]], size, size)
    }

    /// Whether every M_b is symmetric, and W with them.
    pub fn is_symmetric(&self) -> bool {
        self.right.is_none()
    }

    /// Y_kb of all blocks in the places of H_kb: with it bodies move contacts.
    pub(crate) fn left(&self) -> &[f64] {
        self.left.as_deref().unwrap_or(self.jacobian.values())
    }

    /// What impulses move bodies with, before D⁻¹.
    pub(crate) fn right(&self) -> &[f64] {
        self.right.as_deref().unwrap_or(self.left())
    }

    /// D⁻¹ of every velocity \[1/kg\].
    pub(crate) fn inverse(&self) -> &[f64] {
        &self.inverse
    }

    /// Adds to the velocities w what the impulse of one contact moves.
    pub(crate) fn push(&self, contact: usize, impulse: &[f64], velocity: &[impl Slot]) {
        self.push_with(contact, impulse, velocity, |number| number);
    }

    /// Adds to u what the velocities w make at one contact.
    pub(crate) fn add_velocity(&self, contact: usize, velocity: &[impl Slot], u: &mut [f64]) {
        self.add_velocity_with(contact, velocity, u, |number| number);
    }

    fn push_with(&self, contact: usize, impulse: &[f64], velocity: &[impl Slot], of: impl Fn(f64) -> f64) {
        let right = self.right();
        for (block, body) in self.jacobian.blocks(contact).zip(self.jacobian.bodies(contact)) {
            let range = self.jacobian.velocities(*body as usize);
            let (rows, inverse) = (&right[self.jacobian.place(block)], &self.inverse[range.clone()]);
            for (v, (w, inverse)) in velocity[range.clone()].iter().zip(inverse).enumerate() {
                let pushed: f64 = impulse.iter().enumerate().map(|(row, r)| of(rows[row * range.len() + v]) * of(*r)).sum();
                w.set(w.get() + inverse * pushed);
            }
        }
    }

    fn add_velocity_with(&self, contact: usize, velocity: &[impl Slot], u: &mut [f64], of: impl Fn(f64) -> f64) {
        let left = self.left();
        for (block, body) in self.jacobian.blocks(contact).zip(self.jacobian.bodies(contact)) {
            let own = &velocity[self.jacobian.velocities(*body as usize)];
            for (u, row) in u.iter_mut().zip(left[self.jacobian.place(block)].chunks_exact(own.len())) {
                *u += row.iter().zip(own).map(|(y, w)| of(*y) * w.get()).sum::<f64>();
            }
        }
    }

    /// w of all impulses.
    pub(crate) fn body_velocity(&self, impulse: &[f64]) -> Vec<f64> {
        self.body_velocity_with(impulse, |number| number)
    }

    /// Overwrites the velocities w with those of all impulses.
    pub(crate) fn write_body_velocity(&self, impulse: &[f64], velocity: &mut [f64]) {
        self.write_body_velocity_with(impulse, velocity, |number| number);
    }

    fn body_velocity_with(&self, impulse: &[f64], of: impl Fn(f64) -> f64 + Copy) -> Vec<f64> {
        let mut velocity = vec![0.0; self.inverse.len()];
        self.write_body_velocity_with(impulse, &mut velocity, of);
        velocity
    }

    fn write_body_velocity_with(&self, impulse: &[f64], velocity: &mut [f64], of: impl Fn(f64) -> f64 + Copy) {
        velocity.fill(0.0);
        let velocity = slots(velocity);
        for (k, r) in impulse.chunks_exact(self.rows_per_contact()).enumerate().filter(|(_, r)| r.iter().any(|r| *r != 0.0)) {
            self.push_with(k, r, velocity, of);
        }
    }

    /// Overwrites `block` with W_jk, column by column.
    pub(crate) fn write_block(&self, j: usize, k: usize, block: &mut [f64]) {
        let (d, left, right) = (self.rows_per_contact(), self.left(), self.right());
        block.fill(0.0);
        let (own, other) = (self.jacobian.bodies(j), self.jacobian.bodies(k));
        for (a, body) in own.iter().enumerate() {
            let Ok(b) = other.binary_search(body) else { continue };
            let range = self.jacobian.velocities(*body as usize);
            let (rows, columns) = (self.jacobian.blocks(j).start + a, self.jacobian.blocks(k).start + b);
            let (rows, columns) = (&left[self.jacobian.place(rows)], &right[self.jacobian.place(columns)]);
            for (i, row) in rows.chunks_exact(range.len()).enumerate() {
                for (c, column) in columns.chunks_exact(range.len()).enumerate() {
                    let terms = row.iter().zip(column).zip(&self.inverse[range.clone()]);
                    block[c * d + i] += terms.map(|((y, z), inverse)| (y * z) * inverse).sum::<f64>();
                }
            }
        }
    }

    /// W by blocks.
    ///
    /// # Errors
    /// [`Error::Invalid`] if its blocks would take more memory than is allowed.
    pub fn delassus(&self) -> Result<BlockSparse> {
        let (d, contacts) = (self.rows_per_contact(), self.contacts());
        let members = self.members();
        let most = self.require_blocks(&members)?;
        let mut made = BlockSparse::with_capacity(d, contacts, most as usize);
        let (mut column, mut block): (Vec<u32>, _) = (Vec::new(), vec![0.0; d * d]);
        for k in 0..contacts {
            column.clear();
            self.jacobian.bodies(k).iter().for_each(|body| column.extend_from_slice(&members[*body as usize]));
            column.sort_unstable();
            column.dedup();
            for &j in &column {
                self.write_block(j as usize, k, &mut block);
                made.push(j as usize, k, &block)?;
            }
        }
        made.finish(contacts);
        Ok(made)
    }

    /// Whether the blocks of W may take the memory that they need.
    pub(super) fn has_room_for_blocks(&self) -> bool {
        self.require_blocks(&self.members()).is_ok()
    }

    /// How many blocks there are at most, of these contacts of every body; refused where they need more memory than is allowed.
    fn require_blocks(&self, members: &[Vec<u32>]) -> Result<u128> {
        let d = self.rows_per_contact();
        let most: u128 = members.iter().map(|contacts| (contacts.len() as u128).pow(2)).sum();
        memory::require("the Delassus blocks of this problem", most.saturating_mul((d * d * 8 + 8) as u128))?;
        Ok(most)
    }

    /// γ of the row with most terms, of masses as they are given: nothing that factors lose.
    pub(super) fn most_rounding(&self) -> f64 {
        row_rounding(self.terms.iter().copied().max().unwrap_or(0))
    }

    /// The contacts of every body, growing.
    pub(crate) fn members(&self) -> Vec<Vec<u32>> {
        let mut members = vec![Vec::new(); self.jacobian.body_count()];
        for k in 0..self.contacts() {
            self.jacobian.bodies(k).iter().for_each(|body| members[*body as usize].push(k as u32));
        }
        members
    }

    /// W_ij of two rows \[1/kg\].
    pub(crate) fn entry(&self, row: usize, column: usize) -> f64 {
        let d = self.rows_per_contact();
        if row / d == column / d {
            return self.diagonal[row / d * d * d + column % d * d + row % d];
        }
        let mut block = vec![0.0; d * d];
        self.write_block(row / d, column / d, &mut block);
        block[column % d * d + row % d]
    }
}

/// Of every body what its mass loses when it is factored, in terms.
fn cancelling(masses: &[DMatrix<f64>], factors: &[Factor]) -> Vec<usize> {
    masses.iter().zip(factors).map(|(mass, factor)| lost_digits::terms(mass, factor)).collect()
}

/// The most of any body that a contact touches.
fn lost(jacobian: &BlockRows, cancelling: &[usize]) -> Vec<usize> {
    let of = |k: usize| jacobian.bodies(k).iter().map(|body| cancelling[*body as usize]).max().unwrap_or(0);
    (0..jacobian.contacts()).map(of).collect()
}

/// Of every contact the rows of the contacts that touch one of its bodies, each contact once where none touches more than two bodies, and
/// what velocities beyond those of two bodies in space round.
fn terms(jacobian: &BlockRows) -> Vec<usize> {
    let (mut touching, mut both) = (vec![0; jacobian.body_count()], HashMap::<[u32; 2], usize>::new());
    for k in 0..jacobian.contacts() {
        let bodies = jacobian.bodies(k);
        bodies.iter().for_each(|body| touching[*body as usize] += 1);
        if let Ok(pair) = bodies.try_into() {
            *both.entry(pair).or_default() += 1;
        }
    }
    let of = |k: usize| {
        let bodies = jacobian.bodies(k);
        let twice = bodies.try_into().ok().and_then(|pair: [u32; 2]| both.get(&pair)).copied().unwrap_or(0);
        let joined = bodies.iter().map(|body| touching[*body as usize]).sum::<usize>() - twice;
        let velocities: usize = bodies.iter().map(|body| jacobian.velocities(*body as usize).len()).sum();
        jacobian.rows_per_contact() * joined.max(1) + velocities.saturating_sub(VELOCITIES).div_ceil(4)
    };
    (0..jacobian.contacts()).map(of).collect()
}

impl ContactOperator for MatrixFree {
    fn diagonal_block(&self, contact: usize, block: &mut [f64]) {
        block.copy_from_slice(&self.diagonal[contact * block.len()..(contact + 1) * block.len()]);
    }

    fn add_product(&self, impulse: &[f64], velocity: &mut [f64]) {
        let mut moved = self.body_velocity(impulse);
        let moved = slots(&mut moved);
        velocity.chunks_exact_mut(self.rows_per_contact()).enumerate().for_each(|(k, u)| self.add_velocity(k, moved, u));
    }

    fn add_magnitudes(&self, impulse: &[f64], sums: &mut [f64]) {
        let mut moved = self.body_velocity_with(impulse, f64::abs);
        let moved = slots(&mut moved);
        sums.chunks_exact_mut(self.rows_per_contact()).enumerate().for_each(|(k, u)| self.add_velocity_with(k, moved, u, f64::abs));
    }

    fn add_contact(&self, contact: usize, impulse: &[f64], velocity: &mut [f64]) {
        let mut moved = vec![0.0; self.inverse.len()];
        let moved = slots(&mut moved);
        self.push(contact, impulse, moved);
        velocity.chunks_exact_mut(self.rows_per_contact()).enumerate().for_each(|(k, u)| self.add_velocity(k, moved, u));
    }

    fn bodies(&self, contact: usize) -> Option<&[u32]> {
        Some(self.jacobian.bodies(contact))
    }

    fn write_terms(&self, terms: &mut [usize]) {
        terms.iter_mut().zip(self.terms.iter().zip(&self.lost)).for_each(|(all, (terms, lost))| *all = terms.saturating_add(*lost));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    /// Three bodies of 6, 1 and 2 velocities, four contacts of d rows; the last touches one body. The masses are not diagonal.
    fn small(d: usize, asymmetry: f64) -> (MatrixFree, DMatrix<f64>) {
        let sizes = [6, 1, 2];
        let number = |i: usize, j: usize| (((i * 7 + j * 13) % 11) as f64 - 5.0) / 4.0;
        let mass = |size: usize| {
            DMatrix::from_fn(size, size, |i, j| if i == j { 4.0 + i as f64 } else { 0.25 + if i > j { asymmetry } else { -asymmetry } })
        };
        let masses = sizes.map(mass);
        let touched: [&[usize]; 4] = [&[0, 1], &[1, 2], &[0, 2], &[1]];
        let mut rows = BlockRows::new(d, sizes).unwrap();
        let mut jacobian = DMatrix::zeros(4 * d, 9);
        for (k, bodies) in touched.iter().enumerate() {
            let blocks: Vec<(usize, Vec<f64>)> =
                bodies.iter().map(|b| (*b, (0..d * sizes[*b]).map(|place| number(place + k, *b)).collect())).collect();
            for (body, block) in &blocks {
                let range = rows.velocities(*body);
                for (place, entry) in block.iter().enumerate() {
                    jacobian[(k * d + place / range.len(), range.start + place % range.len())] = *entry;
                }
            }
            rows.push(&blocks.iter().map(|(body, block)| (*body, block.as_slice())).collect::<Vec<_>>()).unwrap();
        }
        let mut mass = DMatrix::zeros(9, 9);
        let mut first = 0;
        for block in &masses {
            mass.view_mut((first, first), block.shape()).copy_from(block);
            first += block.nrows();
        }
        let dense = &jacobian * mass.try_inverse().unwrap() * jacobian.transpose();
        (MatrixFree::new(&masses, rows).unwrap(), dense)
    }

    #[test]
    fn acts_as_the_dense_matrix_for_every_number_of_rows() {
        for (d, asymmetry) in (1..=6).flat_map(|d| [(d, 0.0), (d, 0.125)]) {
            let (free, dense) = small(d, asymmetry);
            let impulse: Vec<f64> = (0..4 * d).map(|row| row as f64 - 3.0).collect();
            let bound = rounding(64, dense.amax() * 4.0 * d as f64 * 24.0);
            let product = &dense * nalgebra::DVector::from_column_slice(&impulse);
            let mut velocity = vec![0.0; 4 * d];
            free.add_product(&impulse, &mut velocity);
            let apart = |found: &[f64]| found.iter().zip(&product).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            assert!(apart(&velocity) <= bound, "{d} rows");
            velocity.fill(0.0);
            impulse.chunks_exact(d).enumerate().for_each(|(k, r)| free.add_contact(k, r, &mut velocity));
            assert!(apart(&velocity) <= bound, "{d} rows, contact by contact");
            assert!((free.delassus().unwrap().to_dense() - &dense).amax() <= bound);
            assert!((0..4 * d).all(|i| (0..4 * d).all(|j| (free.entry(i, j) - dense[(i, j)]).abs() <= bound)));
            let mut block = vec![0.0; d * d];
            free.diagonal_block(2, &mut block);
            assert_eq!(DMatrix::from_column_slice(d, d, &block), free.delassus().unwrap().to_dense().view((2 * d, 2 * d), (d, d)));
            let mut sums = vec![0.0; 4 * d];
            free.add_magnitudes(&impulse, &mut sums);
            let least = dense.abs() * nalgebra::DVector::from_column_slice(&impulse).abs();
            assert!(sums.iter().zip(&least).all(|(bound, least)| *bound >= *least * (1.0 - 1e-12)), "an upper bound");
            assert_eq!((free.bodies(1), free.is_symmetric()), (Some(&[1, 2][..]), asymmetry == 0.0));
        }
    }

    #[test]
    fn w_is_symmetric_to_the_last_bit_where_the_masses_are() {
        assert_eq!(small(3, 0.0).0.delassus().unwrap().asymmetry()[0], 0.0);
        assert!(small(3, 0.125).0.delassus().unwrap().asymmetry()[0] > 0.0);
    }

    #[test]
    fn masses_that_do_not_fit_or_are_not_definite_are_refused() {
        let rows = || {
            let mut rows = BlockRows::new(1, [1]).unwrap();
            rows.push(&[(0, &[1.0])]).unwrap();
            rows
        };
        let refused = |masses: &[DMatrix<f64>]| MatrixFree::new(masses, rows()).unwrap_err().to_string();
        assert!(refused(&[]).contains("0 blocks"));
        assert!(refused(&[DMatrix::identity(2, 2)]).contains("2×2"));
        assert!(refused(&[DMatrix::zeros(1, 1)]).contains("positive definite"));
        let mut infinite = BlockRows::new(1, [1]).unwrap();
        infinite.push(&[(0, &[f64::INFINITY])]).unwrap();
        assert!(MatrixFree::new(&[DMatrix::identity(1, 1)], infinite).unwrap_err().to_string().contains("finite"));
    }
}
