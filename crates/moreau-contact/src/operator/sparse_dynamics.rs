//! W by blocks from a sparse mass matrix and a sparse Jacobian, without a matrix of all velocities or of all contacts.
//!
//! ```text
//!     M̂ = diag(M₁, M₂, …) ,   M_b = L D Lᵀ ,   Y_kb = L⁻¹ H_kbᵀ ,   W_jk = Σ_b Y_jbᵀ D⁻¹ Y_kb
//! ```
//! with b over the groups of velocities that M̂ does not couple: the bodies of a pile, the linkages of a robot.

use super::mass_block::{Factor, Halves};
use super::{BlockRows, BlockSparse, MatrixFree, Sparse, lost_digits};
use crate::memory;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// What bodies and contacts have to do with each other: M̂ factored by groups of velocities, and H by contacts and groups.
#[derive(Clone, Debug)]
pub struct SparseDynamics {
    rows_per_contact: usize,
    /// Rows of each group in M̂.
    velocities: Vec<Vec<usize>>,
    masses: Vec<DMatrix<f64>>,
    factors: Vec<Factor>,
    /// Of each contact the groups it touches, and H there, rows of the contact × velocities of the group.
    jacobian: Vec<Vec<(usize, DMatrix<f64>)>>,
    size: usize,
}

impl SparseDynamics {
    /// M̂ and H. M̂ may be asymmetric where its symmetric part is definite; so is W then.
    ///
    /// # Errors
    /// [`Error::Invalid`] if sizes do not fit, or M̂ is not definite.
    /// ```
    /// use moreau_contact::nalgebra::{dmatrix, dvector};
    /// use moreau_contact::operator::{Sparse, SparseDynamics};
    ///
    /// // a mass of 2 kg on the floor and one of 4 kg on top of it
    /// let mass = Sparse { shape: [2, 2], entries: vec![(0, 0, 2.0), (1, 1, 4.0)] };
    /// let jacobian = Sparse { shape: [2, 2], entries: vec![(0, 0, 1.0), (1, 0, -1.0), (1, 1, 1.0)] };
    /// let stack = SparseDynamics::new(&mass, &jacobian, 1)?;
    /// assert_eq!(stack.delassus()?.to_dense(), dmatrix![0.5, -0.5; -0.5, 0.75]);
    /// assert_eq!(stack.solve(&dvector![1.0, 1.0]), dvector![0.5, 0.25]);
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn new(mass: &Sparse, jacobian: &Sparse, rows_per_contact: usize) -> Result<Self> {
        let size = mass.shape[0];
        let shape = |field: &str, wanted: [usize; 2], found: [usize; 2]| {
            let cure = format!("use the shape {}×{}", wanted[0], wanted[1]);
            if found == wanted { Ok(()) } else { Err(Error::invalid(field, format!("has shape {}×{}", found[0], found[1]), cure)) }
        };
        shape("mass", [size, size], mass.shape)?;
        shape("jacobian", [jacobian.shape[0], size], jacobian.shape)?;
        let group = groups(mass, size);
        let mut velocities: Vec<Vec<usize>> = Vec::new();
        let mut place = vec![(0, 0); size];
        let mut number = vec![usize::MAX; size];
        for (row, &root) in group.iter().enumerate() {
            if number[root] == usize::MAX {
                number[root] = velocities.len();
                velocities.push(Vec::new());
            }
            place[row] = (number[root], velocities[number[root]].len());
            velocities[number[root]].push(row);
        }
        let need = velocities.iter().map(|rows| memory::matrix(rows.len(), rows.len())).fold(0, u128::saturating_add);
        memory::require("the mass matrix of this mechanism", need.saturating_mul(2))?;
        let mut masses: Vec<DMatrix<f64>> = velocities.iter().map(|rows| DMatrix::zeros(rows.len(), rows.len())).collect();
        for &(row, column, value) in mass.entries.iter().filter(|(.., value)| *value != 0.0) {
            masses[place[row].0][(place[row].1, place[column].1)] += value;
        }
        let factors = masses.iter().map(Factor::new).collect::<Result<_>>()?;
        let mut touched: Vec<Vec<(usize, DMatrix<f64>)>> = vec![Vec::new(); jacobian.shape[0] / rows_per_contact];
        for &(row, column, value) in jacobian.entries.iter().filter(|(.., value)| *value != 0.0) {
            let (contact, (group, column)) = (&mut touched[row / rows_per_contact], place[column]);
            let at = contact.iter().position(|(other, _)| *other == group).unwrap_or_else(|| {
                contact.push((group, DMatrix::zeros(rows_per_contact, velocities[group].len())));
                contact.len() - 1
            });
            contact[at].1[(row % rows_per_contact, column)] += value;
        }
        touched.iter_mut().for_each(|contact| contact.sort_by_key(|(group, _)| *group));
        Ok(SparseDynamics { rows_per_contact, velocities, masses, factors, jacobian: touched, size })
    }

    /// Rows of each contact.
    pub fn rows_per_contact(&self) -> usize {
        self.rows_per_contact
    }

    /// Number of velocities.
    pub fn velocity_count(&self) -> usize {
        self.size
    }

    /// W = H M̂⁻¹ Hᵀ \[1/kg\] by blocks, symmetric to the last bit if M̂ is.
    ///
    /// # Errors
    /// [`Error::Invalid`] if its blocks would take more memory than is allowed.
    pub fn delassus(&self) -> Result<BlockSparse> {
        let (d, contacts) = (self.rows_per_contact, self.jacobian.len());
        let mut members: Vec<Vec<(usize, usize)>> = vec![Vec::new(); self.velocities.len()];
        for (k, touched) in self.jacobian.iter().enumerate() {
            touched.iter().enumerate().for_each(|(place, (group, _))| members[*group].push((k, place)));
        }
        let most: u128 = members.iter().map(|contacts| (contacts.len() as u128).pow(2)).sum();
        memory::require("the Delassus blocks of this problem", most.saturating_mul((d * d * 8 + 16) as u128))?;
        let halves = self.halves();
        let mut made = BlockSparse::with_capacity(d, contacts, most as usize);
        let mut column: Vec<(usize, usize)> = Vec::new();
        for (k, touched) in self.jacobian.iter().enumerate() {
            column.clear();
            for (place, (group, _)) in touched.iter().enumerate() {
                column.extend(members[*group].iter().map(|&(j, other)| (j, (place << 32) | other)));
            }
            column.sort_unstable();
            let mut next = column.iter().peekable();
            while let Some(&(j, _)) = next.peek() {
                let mut block = DMatrix::zeros(d, d);
                while let Some(&(_, places)) = next.next_if(|(other, _)| other == j) {
                    let (own, other) = (&halves[k][places >> 32], &halves[*j][places & 0xffff_ffff]);
                    add_product(&mut block, &other.left, own);
                }
                made.push(*j, k, block.as_slice())?;
            }
        }
        made.finish(contacts);
        Ok(made)
    }

    /// W = H M̂⁻¹ Hᵀ \[1/kg\] that is never formed, by the groups of velocities that M̂ does not couple.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it would take more memory than is allowed.
    pub fn matrix_free(&self) -> Result<MatrixFree> {
        let mut rows = BlockRows::new(self.rows_per_contact, self.velocities.iter().map(Vec::len))?;
        for touched in &self.jacobian {
            let by_rows: Vec<(usize, DMatrix<f64>)> = touched.iter().map(|(group, block)| (*group, block.transpose())).collect();
            rows.push(&by_rows.iter().map(|(group, block)| (*group, block.as_slice())).collect::<Vec<_>>())?;
        }
        MatrixFree::new(&self.masses, rows)
    }

    /// Whether some group of velocities has a mass that is nearly singular, so that its factors, and W, lose digits.
    pub(crate) fn loses_digits(&self) -> bool {
        self.masses.iter().zip(&self.factors).any(|(mass, factor)| lost_digits::terms(mass, factor) > 0)
    }

    /// Number of entries of M̂ and H, zeros included.
    pub(crate) fn entries(&self) -> u128 {
        (self.size as u128).saturating_mul((self.size + self.rows_per_contact * self.jacobian.len()) as u128)
    }

    /// M̂ and H, entry by entry, without zeros; by rows that grow.
    pub(crate) fn triplets(&self) -> [Sparse; 2] {
        let mut mass = Sparse { shape: [self.size; 2], entries: Vec::new() };
        for (rows, block) in self.velocities.iter().zip(&self.masses) {
            mass.entries.extend(Sparse::of(block).entries.into_iter().map(|(i, j, value)| (rows[i], rows[j], value)));
        }
        let d = self.rows_per_contact;
        let mut jacobian = Sparse { shape: [d * self.jacobian.len(), self.size], entries: Vec::new() };
        for (k, touched) in self.jacobian.iter().enumerate() {
            for (group, block) in touched {
                let own = Sparse::of(block).entries.into_iter();
                jacobian.entries.extend(own.map(|(i, j, value)| (k * d + i, self.velocities[*group][j], value)));
            }
        }
        for of in [&mut mass, &mut jacobian] {
            of.entries.sort_unstable_by_key(|(row, column, _)| (*row, *column));
        }
        [mass, jacobian]
    }

    /// Appends the columns of H that the rows of a contact touch, growing.
    pub(crate) fn push_touched(&self, contact: usize, columns: &mut Vec<usize>) {
        let first = columns.len();
        for (group, block) in &self.jacobian[contact] {
            let own = self.velocities[*group].iter().zip(block.column_iter());
            columns.extend(own.filter(|(_, rows)| rows.iter().any(|entry| *entry != 0.0)).map(|(column, _)| *column));
        }
        columns[first..].sort_unstable();
    }

    /// The halves of every contact, as many as it touches groups.
    fn halves(&self) -> Vec<Vec<Halves>> {
        self.jacobian.iter().map(|touched| touched.iter().map(|(group, block)| self.factors[*group].halves(block)).collect()).collect()
    }

    /// M̂⁻¹ p \[m/s\], of a generalised impulse p.
    ///
    /// # Panics
    /// If p has another size than M̂.
    pub fn solve(&self, impulse: &DVector<f64>) -> DVector<f64> {
        let mut velocity = DVector::zeros(self.size);
        for (rows, factor) in self.velocities.iter().zip(&self.factors) {
            let part = factor.solve(&DVector::from_iterator(rows.len(), rows.iter().map(|row| impulse[*row])));
            rows.iter().zip(part.iter()).for_each(|(row, v)| velocity[*row] = *v);
        }
        velocity
    }

    /// H v \[m/s\], of generalised velocities v.
    ///
    /// # Panics
    /// If v has another size than M̂.
    pub fn contact_velocity(&self, velocity: &DVector<f64>) -> DVector<f64> {
        let mut found = DVector::zeros(self.rows_per_contact * self.jacobian.len());
        for (k, touched) in self.jacobian.iter().enumerate() {
            for (group, block) in touched {
                let part = DVector::from_iterator(block.ncols(), self.velocities[*group].iter().map(|row| velocity[*row]));
                let mut rows = found.rows_mut(k * self.rows_per_contact, self.rows_per_contact);
                rows += block * part;
            }
        }
        found
    }
}

/// Adds leftᵀ D⁻¹ right; each product is formed in one order, so that W_kj is the transpose of W_jk bit for bit where M̂ is symmetric.
fn add_product(block: &mut DMatrix<f64>, left: &DMatrix<f64>, own: &Halves) {
    let d = block.nrows();
    for (i, j) in (0..d * d).map(|place| (place / d, place % d)) {
        let terms = own.pivots.iter().enumerate().map(|(v, pivot)| left[(v, i)] * own.right[(v, j)] / pivot);
        block[(i, j)] += terms.sum::<f64>();
    }
}

/// The first velocity of its group, for every velocity: those that entries of M̂ connect.
fn groups(mass: &Sparse, size: usize) -> Vec<usize> {
    let mut first: Vec<usize> = (0..size).collect();
    fn root(first: &mut [usize], mut of: usize) -> usize {
        while first[of] != of {
            first[of] = first[first[of]];
            of = first[of];
        }
        of
    }
    for &(row, column, value) in mass.entries.iter().filter(|(row, column, _)| row != column) {
        if value != 0.0 {
            let (one, other) = (root(&mut first, row), root(&mut first, column));
            first[one.max(other)] = one.min(other);
        }
    }
    (0..size).map(|row| root(&mut first, row)).collect()
}

impl PartialEq for SparseDynamics {
    /// Whether both are the same mass and Jacobian.
    fn eq(&self, other: &Self) -> bool {
        (self.size, &self.velocities, &self.masses, &self.jacobian) == (other.size, &other.velocities, &other.masses, &other.jacobian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::delassus::delassus;
    use nalgebra::{dmatrix, dvector};

    fn sparse(matrix: &DMatrix<f64>) -> Sparse {
        let places = (0..matrix.nrows()).flat_map(|i| (0..matrix.ncols()).map(move |j| (i, j)));
        Sparse { shape: [matrix.nrows(), matrix.ncols()], entries: places.map(|(i, j)| (i, j, matrix[(i, j)])).collect() }
    }

    #[test]
    fn blocks_of_a_coupled_mass_equal_the_dense_operator() {
        // the first and the third velocity are coupled, the second is a body of its own
        let mass = dmatrix![2.0, 0.0, 0.5; 0.0, 3.0, 0.0; 0.5, 0.0, 1.0];
        let jacobian = dmatrix![1.0, -1.0, 0.0; 0.25, 0.0, 2.0; 0.0, 1.0, 0.0; 0.0, -0.5, 0.0; 1.0, 0.0, 0.0; 0.0, 0.0, 1.0];
        let mechanism = SparseDynamics::new(&sparse(&mass), &sparse(&jacobian), 2).unwrap();
        let (found, dense) = (mechanism.delassus().unwrap(), delassus(&mass, &jacobian).unwrap());
        let rounding = moreau_exact::tolerance::rounding(16, dense.amax());
        assert!((found.to_dense() - &dense).amax() <= rounding);
        assert_eq!(found.asymmetry()[0], 0.0);
        assert_eq!(found.block_count(), 7, "the second contact does not meet the third");
        let impulse = dvector![1.0, -2.0, 0.5];
        assert!((&mass * mechanism.solve(&impulse) - &impulse).amax() <= rounding * mass.amax() * 4.0);
        assert_eq!(mechanism.contact_velocity(&impulse), &jacobian * impulse);
    }

    #[test]
    fn its_matrices_entry_by_entry_are_those_it_was_made_of() {
        let [mass, jacobian] = [dmatrix![2.0, 0.0, 0.5; 0.0, 3.0, 0.0; 0.5, 0.0, 1.0], dmatrix![0.0, -1.0, 4.0; 0.25, 0.0, 2.0]];
        let mechanism = SparseDynamics::new(&sparse(&mass), &sparse(&jacobian), 2).unwrap();
        assert_eq!(mechanism.triplets().map(|triplets| triplets.to_dense()), [mass, jacobian]);
        assert_eq!(mechanism.entries(), 3 * (3 + 2));
        let mut columns = vec![7];
        mechanism.push_touched(0, &mut columns);
        assert_eq!(columns, [7, 0, 1, 2]);
    }

    #[test]
    fn an_asymmetric_mass_makes_an_asymmetric_operator() {
        let [mass, jacobian] = [dmatrix![2.0, 0.5; -0.25, 1.0], dmatrix![1.0, 2.0; 0.0, 1.0]];
        let mechanism = SparseDynamics::new(&sparse(&mass), &sparse(&jacobian), 1).unwrap();
        let expected = &jacobian * mass.clone().try_inverse().unwrap() * jacobian.transpose();
        assert!((mechanism.delassus().unwrap().to_dense() - &expected).amax() <= moreau_exact::tolerance::rounding(16, 8.0));
        let impulse = dvector![1.0, -2.0];
        assert!((&mass * mechanism.solve(&impulse) - &impulse).amax() <= moreau_exact::tolerance::rounding(16, 8.0));
        assert!(SparseDynamics::new(&sparse(&dmatrix![1.0, 4.0; -4.0, -1.0]), &sparse(&jacobian), 1).is_err(), "not definite");
    }

    #[test]
    fn sizes_and_masses_that_do_not_fit_are_refused() {
        let [mass, row] = [sparse(&dmatrix![1.0, 0.0; 0.0, 1.0]), sparse(&dmatrix![1.0, 0.0])];
        let refused = |mass: &Sparse, jacobian: &Sparse| SparseDynamics::new(mass, jacobian, 1).unwrap_err().to_string();
        assert!(refused(&sparse(&dmatrix![1.0, 0.0]), &row).contains("`mass`"));
        assert!(refused(&mass, &sparse(&dmatrix![1.0])).contains("`jacobian`"));
        assert!(refused(&sparse(&dmatrix![1.0, 1.0; 1.0, 1.0]), &row).contains("positive definite"));
        assert!(refused(&sparse(&dmatrix![1.0, 0.0; 0.0, 0.0]), &row).contains("positive definite"), "a velocity without mass");
    }
}
