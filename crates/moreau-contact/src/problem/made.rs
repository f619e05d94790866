//! What W was made of, where a problem holds it formed and knows its mass and Jacobian, and velocities with twice the digits.
//!
//! ```text
//!     u = W r + u_free ,   W as it was given, or H M̂⁻¹ Hᵀ of M̂ and H as they were given                            [m/s]
//! ```

#[cfg(feature = "files")]
use super::JointedProblem;
use super::{ContactProblem, Dynamics};
use crate::operator::{MatrixFree, Sparse, SparseDynamics};
use moreau_exact::doubled::DoubledResiduals;
#[cfg(feature = "files")]
use nalgebra::DVector;

/// Mass and Jacobian that a W of single rows was formed of.
#[derive(Debug)]
pub(crate) struct Made {
    /// W that is not formed; none where there is no room for it.
    pub unformed: Option<MatrixFree>,
    /// Whether forming it lost digits, for the mass is nearly singular, or there is no room to see.
    pub loses_digits: bool,
}

impl Made {
    /// Of these.
    pub fn of(Dynamics { mass, jacobian }: &Dynamics) -> Self {
        match SparseDynamics::new(&Sparse::of(mass), &Sparse::of(jacobian), 1) {
            Ok(dynamics) => Made { unformed: dynamics.matrix_free().ok(), loses_digits: dynamics.loses_digits() },
            Err(_) => Made { unformed: None, loses_digits: true },
        }
    }
}

impl ContactProblem {
    /// Adds W r of twice the digits, of W as it was given or of what it was formed of, with a bound of what that is off by beside ε of the
    /// sums, row by row \[m/s\]; `None` where neither is known.
    pub(crate) fn add_doubled(&self, impulse: &[f64], sums: &mut DoubledResiduals<f64>) -> Option<Vec<f64>> {
        if self.knows_rows() && self.delassus().matrix_free().is_none() {
            self.unformed()?.add_doubled(impulse, sums)
        } else {
            self.delassus().add_doubled(impulse, sums)
        }
    }

    /// u of these impulses, summed with twice the digits where W is known to so many.
    #[cfg(feature = "files")]
    pub(crate) fn doubled_velocity(&self, impulse: &DVector<f64>) -> DVector<f64> {
        let mut sums = DoubledResiduals::new(self.free_velocity().as_slice());
        match self.add_doubled(impulse.as_slice(), &mut sums) {
            Some(_) => DVector::from_vec(sums.values()),
            None => self.velocity(impulse),
        }
    }
}

#[cfg(feature = "files")]
impl JointedProblem {
    /// u of these impulses, summed with twice the digits where W is known to so many.
    pub(crate) fn doubled_velocity(&self, impulse: &DVector<f64>) -> DVector<f64> {
        let mut sums = DoubledResiduals::new(self.free_velocity().as_slice());
        match self.dynamics().map(Made::of) {
            Some(Made { unformed: Some(free), .. }) => {
                if free.add_doubled(impulse.as_slice(), &mut sums).is_none() {
                    return self.velocity(impulse);
                }
            }
            Some(_) => return self.velocity(impulse),
            None => {
                self.delassus().column_iter().zip(impulse).for_each(|(w, r)| sums.subtract(w.clone_owned().as_slice(), &-r));
            }
        }
        DVector::from_vec(sums.values())
    }
}
