//! A few contacts under Coulomb's law on the way: impulses, velocities, what each is alone, and Alart and Curnier's equations of each.

use super::super::one_contact::{Coulomb, OneContact};
use super::super::projected_gauss_seidel::prepare;
use super::parts::MOST;
use crate::problem::ContactProblem;
use nalgebra::DVector;

/// The contacts on the way, with D rows each.
pub(super) struct Contacts<const D: usize> {
    pub count: usize,
    /// r \[N·s\].
    pub impulse: [[f64; D]; MOST],
    /// y = u_free + shift + (W + R) r \[m/s\].
    pub velocity: [[f64; D]; MOST],
    /// What each is alone, from when it closes first.
    alone: [Option<Coulomb>; MOST],
}

/// What a step of Newton's method starts from.
pub(super) struct Step {
    /// The contacts that press, growing, and how many.
    pub pressing: [usize; MOST],
    pub count: usize,
    /// max |F| of the rows, in impulses \[N·s\].
    pub residual: f64,
    /// Whether all of these stick, so that every row of the system asks for a velocity.
    pub all_stick: bool,
}

impl<const D: usize> Contacts<D> {
    /// At impulses that are given, or at zero.
    pub(super) fn new(problem: &ContactProblem, start: Option<&DVector<f64>>) -> Self {
        let (count, mut impulse, mut velocity) = (problem.contacts(), [[0.0; D]; MOST], [[0.0; D]; MOST]);
        match start {
            Some(start) => {
                impulse.as_flattened_mut()[..count * D].copy_from_slice(start.as_slice());
                problem.write_law_velocity(start.as_slice(), &mut velocity.as_flattened_mut()[..count * D]);
            }
            None => {
                let given = problem.free_velocity().as_slice().iter().zip(problem.shift().as_slice());
                velocity.as_flattened_mut().iter_mut().zip(given).for_each(|(y, (free, shift))| *y = free + shift);
            }
        }
        Contacts { count, impulse, velocity, alone: [const { None }; MOST] }
    }

    /// Solves every contact once; the largest change of an impulse, or `None` where a contact cannot be solved alone.
    pub(super) fn sweep(&mut self, problem: &ContactProblem) -> Option<f64> {
        let mut largest = 0.0f64;
        for k in 0..self.count {
            if self.velocity[k][0] >= 0.0 && self.impulse[k] == [0.0; D] {
                continue;
            }
            let alone = self.alone(problem, k)?;
            let (block, mut q) = (*alone.block(), [0.0; 3]);
            let (r, y) = (self.impulse[k], self.velocity[k]);
            (0..D).for_each(|row| q[row] = y[row] - (0..D).map(|column| block[3 * row + column] * r[column]).sum::<f64>());
            let new = self.alone[k].as_mut()?.solve(q);
            largest = largest.max(self.push(problem, k, std::array::from_fn(|row| new[row])));
        }
        Some(largest)
    }

    fn alone(&mut self, problem: &ContactProblem, k: usize) -> Option<&Coulomb> {
        if self.alone[k].is_none() {
            self.alone[k] = prepare(problem, k, Coulomb::new).ok();
        }
        self.alone[k].as_ref()
    }

    /// Gives contact k another impulse; the largest change.
    fn push(&mut self, problem: &ContactProblem, k: usize, new: [f64; D]) -> f64 {
        let change: [f64; D] = std::array::from_fn(|row| new[row] - self.impulse[k][row]);
        self.impulse[k] = new;
        if change != [0.0; D] {
            problem.add_contact(k, &change, &mut self.velocity.as_flattened_mut()[..self.count * D]);
        }
        change.iter().fold(0.0, |largest: f64, change| largest.max(change.abs()))
    }

    /// The largest number among the impulses.
    pub(super) fn largest(&self) -> f64 {
        self.impulse[..self.count].as_flattened().iter().fold(0.0, |largest, r| largest.max(r.abs()))
    }

    /// Opens what does not press, and lists what does.
    pub(super) fn begin(&mut self, problem: &ContactProblem) -> Option<Step> {
        let mut step = Step { pressing: [0; MOST], count: 0, residual: 0.0f64, all_stick: true };
        for k in 0..self.count {
            if self.velocity[k][0] >= 0.0 && self.impulse[k][0] <= 0.0 {
                step.residual = step.residual.max(self.push(problem, k, [0.0; D]));
                continue;
            }
            self.alone(problem, k)?;
            let [rho_n, _] = self.weights(k);
            if self.impulse[k][0] - rho_n * self.velocity[k][0] > 0.0 {
                step.pressing[step.count] = k;
                step.count += 1;
            } else {
                step.residual = step.residual.max(self.push(problem, k, [0.0; D]));
            }
        }
        for &k in &step.pressing[..step.count] {
            let Here { rho, slides, without } = self.here(k);
            let (r, y, mu) = (&self.impulse[k], &self.velocity[k], self.friction(k));
            step.all_stick &= slides.is_none() && !without;
            step.residual = step.residual.max((rho[0] * y[0]).abs());
            for row in 1..D {
                let off = slides.map_or(rho[1] * y[row], |[_, direction @ ..]| mu * r[0] * direction[row - 1] - r[row]);
                step.residual = step.residual.max(off.abs());
            }
        }
        Some(step)
    }

    /// Moves what presses.
    pub(super) fn take<const M: usize>(&mut self, problem: &ContactProblem, step: &Step, moved: [f64; M]) {
        for (place, &k) in step.pressing[..step.count].iter().enumerate() {
            let new = std::array::from_fn(|row| self.impulse[k][row] + moved[place * D + row]);
            self.push(problem, k, new);
        }
    }

    /// ρ_n and ρ_t of a contact that is prepared \[kg\].
    fn weights(&self, k: usize) -> [f64; 2] {
        self.alone[k].as_ref().map_or([0.0; 2], |alone| {
            let block = alone.block();
            let trace: f64 = (1..D).map(|row| block[4 * row]).sum();
            [1.0 / block[0], (D - 1) as f64 / trace]
        })
    }

    fn friction(&self, k: usize) -> f64 {
        self.alone[k].as_ref().map_or(0.0, Coulomb::friction)
    }

    fn here(&self, k: usize) -> Here {
        let (rho, r, y, mu) = (self.weights(k), &self.impulse[k], &self.velocity[k], self.friction(k));
        let mut z = [0.0; 2];
        (1..D).for_each(|row| z[row - 1] = r[row] - rho[1] * y[row]);
        let (radius, reach) = (mu * (r[0] - rho[0] * y[0]), (z[0] * z[0] + z[1] * z[1]).sqrt());
        let slides = (reach > radius && reach > 0.0).then(|| [radius / reach, z[0] / reach, z[1] / reach]);
        Here { rho, slides, without: reach == 0.0 && radius == 0.0 }
    }

    /// The rows of contact k of the system, given those of A, and its right side; the first column of its own is `first`.
    pub(super) fn linearise<const M: usize>(&self, k: usize, proximal: f64, rows: &mut [[f64; M]], right: &mut [f64], first: usize) {
        let (Here { rho, slides, without }, r, y, mu) = (self.here(k), &self.impulse[k], &self.velocity[k], self.friction(k));
        rows[0].iter_mut().for_each(|entry| *entry *= rho[0]);
        rows[0][first] += proximal;
        right[0] = -rho[0] * y[0];
        if without {
            // no friction, and none that is to be taken away
            for row in 1..D {
                rows[row].fill(0.0);
                (rows[row][first + row], right[row]) = (1.0, -r[row]);
            }
            return;
        }
        let Some([share, direction @ ..]) = slides else {
            for row in 1..D {
                rows[row].iter_mut().for_each(|entry| *entry *= rho[1]);
                rows[row][first + row] += proximal;
                right[row] = -rho[1] * y[row];
            }
            return;
        };
        let across = |i: usize, j: usize| f64::from(u8::from(i == j)) - direction[i] * direction[j];
        if D == 3 {
            let (upper, lower) = rows.split_at_mut(2);
            for (one, other) in upper[1].iter_mut().zip(&mut lower[0]) {
                let (first, second) = (*one * share * rho[1], *other * share * rho[1]);
                (*one, *other) = (across(0, 0) * first + across(0, 1) * second, across(1, 0) * first + across(1, 1) * second);
            }
        } else {
            rows[1].fill(0.0);
        }
        for row in 1..D {
            (1..D).for_each(|column| rows[row][first + column] += f64::from(u8::from(row == column)) - share * across(row - 1, column - 1));
            rows[row][first] -= mu * direction[row - 1];
            right[row] = mu * r[0] * direction[row - 1] - r[row];
        }
    }
}

/// Where a contact is: its weights \[kg\], and where it slides μ a/‖z‖ with the two components of ẑ.
struct Here {
    rho: [f64; 2],
    slides: Option<[f64; 3]>,
    /// Whether there is neither a radius nor anything beyond it.
    without: bool,
}
