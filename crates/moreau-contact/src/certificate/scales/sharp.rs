//! Where rounding hides too much of y, y with twice the digits.

use super::super::joint_scales::Joints;
use super::{Scales, at_least, at_most};
use crate::cones::second_order::tangential_norm;
use crate::problem::ContactProblem;
use crate::tolerance::certificate::{HIDDEN, OFF_BY_FORMING, row_rounding};
use moreau_exact::doubled::DoubledResiduals;
use moreau_exact::tolerance::EPSILON;

impl Scales {
    /// Whether forming W of mass and Jacobian may have moved y of some contact: where rows are nearly orthogonal in M⁻¹ the terms of W_ij
    /// cancel, and what it is off by, γ √(W_ii W_jj), is not among the terms of the floor.
    ///
    /// ```text
    ///     γ_i √W_ii Σ_j √W_jj |r_j|  >  10⁻⁸ V                                                                    [m/s]
    /// ```
    pub fn is_made_doubtful(&self, problem: &ContactProblem) -> bool {
        self.reach != 0.0 && (0..self.contacts.len()).any(|k| self.made_rounding(problem, k) * HIDDEN > self.hidden(k) * OFF_BY_FORMING)
    }

    /// γ_i √W_ii Σ_j √W_jj |r_j|.
    fn made_rounding(&self, problem: &ContactProblem, contact: usize) -> f64 {
        problem.rounding()[contact * problem.rows_per_contact()] * self.contacts[contact].roots[2] * self.reach
    }

    /// Puts y of doubled precision to all rows, and its rounding to those of the contacts of which rounding hides too much.
    ///
    /// ```text
    ///     floor = ε|y| + γ² (Σ_j |W_kj||r_j| + |u_free| + |shift| + R_k|r_k|)                                        [m/s]
    /// ```
    #[cold]
    pub fn sharpen(&mut self, problem: &ContactProblem, impulse: &[f64], joints: Option<&Joints>, law_velocity: &mut [f64]) {
        let of_joints = |joints: &Joints| Some(joints.sharp_of_contacts());
        let rows = problem.rows_per_contact();
        let Some([sharp, floors]) = joints.map_or_else(|| self.sharp(problem, impulse), of_joints) else {
            // what forming W may have moved is rounding like other, for nothing tells it apart
            return (0..self.floors.len())
                .for_each(|row| self.floors[row] = at_least(self.floors[row], self.made_rounding(problem, row / rows)));
        };
        law_velocity.copy_from_slice(&sharp);
        self.stored.extend_from_slice(&self.floors);
        for k in 0..problem.contacts() {
            let own = k * rows..(k + 1) * rows;
            let lost = |row: usize| self.unrounded.get(row).copied().unwrap_or(0.0);
            let rounded: Vec<f64> = own.clone().map(|row| self.floors[row] - lost(row)).collect();
            let is_certain = rounded[0].max(self.contacts[k].lifts * tangential_norm(&rounded)) <= self.hidden(k);
            let made = self.made_rounding(problem, k);
            for row in own {
                // u itself is one double, and a sum of them
                let stored = at_least(self.floors[row], made);
                self.stored[row] = at_least(at_most(self.hidden(k), stored), floors[row]);
                // twice the digits of a mass that is nearly singular may tell less
                self.floors[row] = at_least(floors[row], if is_certain { self.floors[row] } else { 0.0 });
                if !is_certain {
                    self.unrounded.get_mut(row).into_iter().for_each(|lost| *lost = 0.0);
                }
            }
        }
    }

    /// y of doubled precision and its rounding, of W as it was given, or of the mass and Jacobian that it was formed of: then its entries
    /// are rounded themselves, by as much as the sum is. `None` where that is not known.
    fn sharp(&self, problem: &ContactProblem, impulse: &[f64]) -> Option<[Vec<f64>; 2]> {
        let softness = problem.row_compliances();
        let (free, shift) = (problem.free_velocity().as_slice(), problem.shift().as_slice());
        let mut sums = DoubledResiduals::new(free);
        for (row, (shift, r)) in shift.iter().zip(impulse).enumerate() {
            sums.subtract_unit(row, &-shift);
            softness.into_iter().for_each(|softness| sums.subtract_from(row, &softness[row..=row], &-r));
        }
        let off = problem.add_doubled(impulse, &mut sums)?;
        let sharp = sums.values();
        // u_free, shift and R r are three more terms of these sums
        let few = row_rounding(1).powi(2);
        let data = |row: usize| free[row].abs() + shift[row].abs() + softness.map_or(0.0, |softness| softness[row] * impulse[row].abs());
        let floors = (0..sharp.len()).map(|row| EPSILON * sharp[row].abs() + few * data(row) + off[row]).collect();
        Some([sharp, floors])
    }

    /// Whether y has twice the digits somewhere.
    pub fn is_sharp(&self) -> bool {
        !self.stored.is_empty()
    }
}
