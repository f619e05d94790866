//! A mass matrix with its factor: of free bodies by its blocks, of linkages as it is.

use super::delassus::{MassFactor, UNMOVED};
use crate::memory::spare::{self, Spare};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::sync::OnceLock;

/// A mass matrix M, symmetric positive definite, by what couples its velocities.
#[derive(Clone, Debug, PartialEq)]
pub enum Mass {
    /// Nothing couples them: free bodies in principal axes. An entry may be +∞, that of a velocity which nothing changes: M⁻¹ is 0 there.
    Diagonal(DVector<f64>),
    /// Square blocks on the diagonal, one after the other.
    Blocks(Vec<DMatrix<f64>>),
    /// Anything may couple them.
    Dense(DMatrix<f64>),
}

impl Mass {
    /// nv, the number of velocities.
    pub fn size(&self) -> usize {
        match self {
            Mass::Diagonal(diagonal) => diagonal.len(),
            Mass::Blocks(blocks) => blocks.iter().map(DMatrix::nrows).sum(),
            Mass::Dense(dense) => dense.nrows(),
        }
    }

    /// Whether no velocity has the inertia +∞.
    pub fn is_finite(&self) -> bool {
        match self {
            Mass::Diagonal(diagonal) => diagonal.iter().all(|m| m.is_finite()),
            // their factors refuse what is not finite
            Mass::Blocks(_) | Mass::Dense(_) => true,
        }
    }

    /// M with its zeros, nv × nv.
    pub fn to_dense(&self) -> DMatrix<f64> {
        match self {
            Mass::Diagonal(diagonal) => DMatrix::from_diagonal(diagonal),
            Mass::Blocks(blocks) => {
                let (mut dense, mut first) = (DMatrix::zeros(self.size(), self.size()), 0);
                for block in blocks {
                    dense.view_mut((first, first), block.shape()).copy_from(block);
                    first += block.nrows();
                }
                dense
            }
            Mass::Dense(dense) => dense.clone(),
        }
    }

    /// M_ii of every velocity.
    pub fn diagonal(&self) -> DVector<f64> {
        match self {
            Mass::Diagonal(diagonal) => diagonal.clone(),
            Mass::Blocks(blocks) => {
                let of = |block: &DMatrix<f64>| (0..block.nrows()).map(|i| block[(i, i)]).collect::<Vec<_>>();
                DVector::from_vec(blocks.iter().flat_map(of).collect())
            }
            Mass::Dense(dense) => dense.diagonal(),
        }
    }

    /// max |M_ij|.
    pub fn largest(&self) -> f64 {
        match self {
            Mass::Diagonal(diagonal) => diagonal.amax(),
            Mass::Blocks(blocks) => blocks.iter().map(DMatrix::amax).fold(0.0, f64::max),
            Mass::Dense(dense) => dense.amax(),
        }
    }

    /// M v.
    ///
    /// # Panics
    /// If v has another size.
    pub fn times(&self, velocity: &DVector<f64>) -> DVector<f64> {
        match self {
            Mass::Diagonal(diagonal) => diagonal.component_mul(velocity),
            Mass::Blocks(blocks) => {
                let (mut product, mut first) = (DVector::zeros(velocity.len()), 0);
                for block in blocks {
                    product.rows_mut(first, block.nrows()).gemv(1.0, block, &velocity.rows(first, block.nrows()), 0.0);
                    first += block.nrows();
                }
                product
            }
            Mass::Dense(dense) => dense * velocity,
        }
    }
}

/// A mass matrix M̂ with its factorisation, so that it is factored only once.
#[derive(Clone, Debug)]
pub struct Inertia {
    mass: Mass,
    factor: MassFactor<f64>,
    /// M̂ with its zeros, once something asked for it.
    dense: OnceLock<DMatrix<f64>>,
}

impl Inertia {
    /// Factors a dense M̂.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if it is not symmetric positive definite.
    pub fn new(matrix: DMatrix<f64>) -> Result<Self> {
        Inertia::of(Mass::Dense(matrix))
    }

    /// Factors M̂, block by block where it has blocks.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if it is not symmetric positive definite.
    pub fn of(mass: Mass) -> Result<Self> {
        let factor = match &mass {
            Mass::Diagonal(diagonal) => MassFactor::diagonal(diagonal)?,
            Mass::Blocks(blocks) => MassFactor::of_blocks(blocks)?,
            Mass::Dense(dense) => MassFactor::new(dense)?,
        };
        Ok(Inertia { mass, factor, dense: OnceLock::new() })
    }

    /// nv, the number of velocities.
    pub fn size(&self) -> usize {
        self.mass.size()
    }

    /// M̂ as it is kept.
    pub fn mass(&self) -> &Mass {
        &self.mass
    }

    /// M̂ with its zeros, for what needs a matrix; blocks are written out, once.
    pub fn matrix(&self) -> &DMatrix<f64> {
        match &self.mass {
            Mass::Dense(dense) => dense,
            blocks => self.dense.get_or_init(|| blocks.to_dense()),
        }
    }

    /// [`Inertia::matrix`] for what computes with M itself, not with M⁻¹.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a velocity has the inertia +∞.
    pub fn finite_matrix(&self) -> Result<&DMatrix<f64>> {
        self.finite_mass().map(|_| self.matrix())
    }

    /// [`Inertia::mass`] for what computes with M itself, not with M⁻¹.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a velocity has the inertia +∞.
    pub fn finite_mass(&self) -> Result<&Mass> {
        if self.mass.is_finite() { Ok(&self.mass) } else { Err(Error::invalid("mass", "is infinite", UNMOVED)) }
    }

    /// Its factor.
    pub fn factor(&self) -> &MassFactor<f64> {
        &self.factor
    }

    /// M̂⁻¹ p.
    pub fn solve(&self, impulse: &DVector<f64>) -> DVector<f64> {
        self.factor.solve(impulse)
    }

    /// M̂⁻¹ p in the memory of p.
    pub fn solved(&self, mut impulse: DVector<f64>) -> DVector<f64> {
        self.factor.solve_in_place(&mut impulse);
        impulse
    }

    /// Whether M̂ couples no two velocities of different bodies, where each body has `width` velocities.
    pub(crate) fn is_made_of(&self, width: usize) -> bool {
        match &self.mass {
            Mass::Diagonal(_) => true,
            Mass::Blocks(blocks) => {
                let mut first = 0;
                blocks.iter().all(|block| {
                    let begins = first;
                    first += block.nrows();
                    block.nrows() == 0 || begins / width == (first - 1) / width
                })
            }
            Mass::Dense(_) => false,
        }
    }

    /// M̂ of the bodies that follow each other with so many velocities each; none where they do not, or a mass is infinite.
    pub(crate) fn bodies(&self, width: usize) -> Option<Vec<DMatrix<f64>>> {
        let mut bodies = vec![DMatrix::zeros(width, width); self.size() / width.max(1)];
        match &self.mass {
            mass if !(mass.is_finite() && self.is_made_of(width) && self.size().is_multiple_of(width)) => return None,
            Mass::Diagonal(diagonal) => {
                diagonal.iter().enumerate().for_each(|(v, mass)| bodies[v / width][(v % width, v % width)] = *mass);
            }
            Mass::Blocks(blocks) => {
                let mut first = 0;
                for block in blocks.iter().filter(|block| block.nrows() > 0) {
                    let place = (first % width, first % width);
                    bodies[first / width].view_mut(place, block.shape()).copy_from(block);
                    first += block.nrows();
                }
            }
            Mass::Dense(_) => return None,
        }
        Some(bodies)
    }
}

impl MassFactor<f64> {
    /// The factor of a diagonal matrix.
    ///
    /// # Errors
    /// [`Error::Invalid`] if an entry is not positive; +∞ is, and p/∞ = 0 for every p.
    fn diagonal(diagonal: &DVector<f64>) -> Result<Self> {
        let diagonal = diagonal.as_slice();
        // looked at without a way out, several at once
        if !diagonal.iter().fold(true, |all, m| all & (*m > 0.0)) {
            let j = diagonal.iter().position(|m| m.is_nan() || *m <= 0.0).unwrap_or(0);
            let problem = format!("is not positive definite (pivot {j} is {})", diagonal[j]);
            return Err(Error::invalid("mass", problem, "give every velocity a positive inertia"));
        }
        let mut pivots = spare::vector(diagonal.len());
        pivots.extend_from_slice(diagonal);
        Ok(MassFactor::from_pivots(pivots))
    }
}

impl Default for Inertia {
    /// That of no velocities.
    fn default() -> Self {
        let (mass, factor) = (Mass::Diagonal(Spare::nothing()), MassFactor::from_pivots(Vec::new()));
        Inertia { mass, factor, dense: OnceLock::new() }
    }
}

impl Drop for Inertia {
    /// Leaves the memory of free bodies, whose mass every step has anew.
    fn drop(&mut self) {
        if let Mass::Diagonal(diagonal) = &mut self.mass {
            std::mem::replace(diagonal, Spare::nothing()).leave();
            self.factor.take_pivots().leave();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn it_solves_as_the_matrix_does() {
        let inertia = Inertia::new(dmatrix![2.0, 0.5; 0.5, 1.0]).expect("definite");
        let moved = inertia.solve(&dvector![1.0, -1.0]);
        assert!((inertia.matrix() * &moved - dvector![1.0, -1.0]).amax() <= moreau_exact::tolerance::rounding(8, 2.0));
        assert!(Inertia::new(dmatrix![0.0]).is_err());
    }

    #[test]
    fn a_mass_by_blocks_is_that_of_its_matrix_to_the_last_bit() {
        let blocks = vec![dmatrix![2.0, 0.5; 0.5, 1.0], dmatrix![3.0], dmatrix![0.7, 0.1; 0.1, 0.9]];
        let inertia = Inertia::of(Mass::Blocks(blocks)).expect("definite");
        let dense = Inertia::new(inertia.matrix().clone()).expect("definite");
        let impulse = dvector![1.0, -2.0, 0.3, 0.7, -0.2];
        assert_eq!(inertia.solve(&impulse), dense.solve(&impulse));
        assert_eq!(inertia.solved(impulse.clone()), inertia.solve(&impulse));
        assert!((inertia.mass().times(&impulse) - dense.mass().times(&impulse)).amax() <= moreau_exact::tolerance::rounding(8, 4.0));
        assert!(inertia.is_made_of(5) && !inertia.is_made_of(1) && !inertia.is_made_of(4));
        let diagonal = Inertia::of(Mass::Diagonal(dvector![2.0, 0.3])).expect("positive");
        assert_eq!(
            diagonal.solve(&dvector![0.7, -1.1]),
            Inertia::new(diagonal.matrix().clone()).expect("positive").solve(&dvector![0.7, -1.1])
        );
        for bad in [0.0, -1.0, f64::NAN] {
            assert!(Inertia::of(Mass::Diagonal(dvector![1.0, bad])).expect_err("not definite").to_string().contains("`mass`"));
            assert!(Inertia::of(Mass::Blocks(vec![dmatrix![1.0], dmatrix![bad]])).is_err());
        }
        assert!(Inertia::of(Mass::Blocks(vec![dmatrix![1.0], dmatrix![f64::INFINITY]])).is_err());
    }

    #[test]
    fn bodies_that_follow_each_other_have_their_own_blocks() {
        let blocks = Inertia::of(Mass::Blocks(vec![
            dmatrix![1.0],
            dmatrix![2.0, 0.5; 0.5, 3.0],
            dmatrix![],
            dmatrix![4.0, 0.0; 0.0, 5.0],
            dmatrix![6.0],
        ]));
        let three = blocks.expect("definite").bodies(3).expect("a block is within a body");
        assert_eq!(three, [dmatrix![1.0, 0.0, 0.0; 0.0, 2.0, 0.5; 0.0, 0.5, 3.0], dmatrix![4.0, 0.0, 0.0; 0.0, 5.0, 0.0; 0.0, 0.0, 6.0]]);
        let diagonal = |second: f64| Inertia::of(Mass::Diagonal(dvector![1.0, second])).expect("positive");
        assert_eq!(diagonal(2.0).bodies(1).expect("two bodies"), [dmatrix![1.0], dmatrix![2.0]]);
        assert!(diagonal(f64::INFINITY).bodies(1).is_none() && Inertia::new(dmatrix![1.0]).expect("positive").bodies(1).is_none());
    }

    #[test]
    fn no_impulse_moves_an_infinite_mass() {
        let inertia = Inertia::of(Mass::Diagonal(dvector![2.0, f64::INFINITY])).expect("positive");
        assert_eq!(inertia.solve(&dvector![3.0, -1e300]), dvector![1.5, 0.0]);
        assert!(inertia.finite_matrix().expect_err("infinite").to_string().contains("`moreau-jean`"));
        assert!(Inertia::of(Mass::Diagonal(dvector![2.0])).expect("positive").finite_matrix().is_ok());
    }
}
