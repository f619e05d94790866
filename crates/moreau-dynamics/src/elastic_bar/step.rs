//! One step of the bar, with A = M + ¼h²K and the contact's scalar complementarity.
//!
//! ```text
//!     average acceleration (Newmark β = ¼, γ = ½)      M a⁺ + K u⁺ = λ⁺e ,   0 ≤ λ⁺ ⟂ u_c⁺ + λ⁺/k ≥ 0
//!                                                       ΔE = ½(λ + λ⁺)(u_c⁺ − u_c), λ/k = 0
//!     midpoint                                          M ā + K ū = λ e ,     0 ≤ λ ⟂ u_c⁺ ≥ 0
//!                                                       ΔE = λ (u_c⁺ − u_c) ≤ 0 from u_c ≥ 0
//!     midpoint with persistency                         the same, but 0 ≤ λ ⟂ u_c⁺ − u_c ≥ 0 once u_c ≤ 0
//!                                                       ΔE = 0
//! ```
//! The identities follow from vᵀM and uᵀK times the mean of a step; they hold whatever the mesh.

use super::{BarState, FiniteElementBar};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// How contact is integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Newmark's average acceleration, contact at the end of the step.
    AverageAcceleration,
    /// The midpoint rule, contact at the end of the step.
    Midpoint,
    /// The midpoint rule with the persistency condition of Laursen and Chawla.
    Persistency,
}

impl FiniteElementBar {
    /// `steps` steps h, the last state of each shown to `observe`.
    ///
    /// # Errors
    /// If h is not positive, or the midpoint rules are asked for the redistributed mass, for whose massless end they are not written.
    pub fn run(&self, method: Method, h: f64, steps: usize, mut observe: impl FnMut(&BarState)) -> Result<BarState> {
        if method != Method::AverageAcceleration && self.compliance > 0.0 {
            return Err(Error::Unsupported("the redistributed mass is integrated by average acceleration".into()));
        }
        let matrix = nalgebra::DMatrix::from_diagonal(&self.mass) + &self.stiffness * (0.25 * h * h);
        let factor = matrix
            .cholesky()
            .filter(|_| h > 0.0)
            .ok_or_else(|| Error::invalid("time_step", format!("is {h}"), "use a positive number of seconds"))?;
        let unit = DVector::from_fn(self.mass.len(), |i, _| f64::from(i == 0));
        let answer = factor.solve(&unit);
        let mut state = self.arriving();
        for _ in 0..steps {
            let BarState { displacement: u, velocity: v, acceleration: a, .. } = &state;
            state = if method == Method::AverageAcceleration {
                let reach = u + v * h + a * (0.25 * h * h);
                let free = -factor.solve(&(&self.stiffness * &reach));
                let gap = reach[0] + 0.25 * h * h * free[0];
                let force = (-gap / (0.25 * h * h * answer[0] + self.compliance)).max(0.0);
                let acceleration = free + &answer * force;
                let velocity = v + (a + &acceleration) * (0.5 * h);
                BarState { displacement: reach + &acceleration * (0.25 * h * h), velocity, acceleration, force }
            } else {
                let free = -factor.solve(&(&self.stiffness * (u + v * (0.5 * h))));
                let moved = h * v[0] + 0.5 * h * h * free[0];
                let held = method == Method::Midpoint || u[0] <= 0.0;
                let gap = if method == Method::Midpoint { u[0] + moved } else { moved };
                let force = if held { (-gap / (0.5 * h * h * answer[0])).max(0.0) } else { 0.0 };
                let acceleration = free + &answer * force;
                BarState { displacement: u + v * h + &acceleration * (0.5 * h * h), velocity: v + &acceleration * h, acceleration, force }
            };
            observe(&state);
        }
        Ok(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use moreau_forms::ElasticBar;

    fn bar() -> ElasticBar {
        ElasticBar::new(2.0, 3.0, 48.0, 0.5, 0.25).expect("valid")
    }

    /// Energies and contact displacements step by step, with h = Δ/(2c).
    fn history(method: Method, redistributed: bool, elements: usize) -> Vec<(f64, f64, f64)> {
        let bar = bar();
        let mesh = FiniteElementBar::new(&bar, elements, redistributed).expect("fine enough");
        let h = 0.5 * bar.length / elements as f64 / bar.wave_speed();
        let mut rows = vec![(mesh.energy(&mesh.arriving()), 0.0, 0.0)];
        mesh.run(method, h, 6 * elements, |state| rows.push((mesh.energy(state), state.displacement[0], state.force))).expect("valid");
        rows
    }

    #[test]
    fn the_energy_of_every_step_is_the_work_of_the_contact_force() {
        for method in [Method::AverageAcceleration, Method::Midpoint, Method::Persistency] {
            let rows = history(method, false, 20);
            let scale = rows.iter().map(|row| row.0).fold(0.0, f64::max);
            for pair in rows.windows(2) {
                let [(before, u, force), (after, next, new)] = [pair[0], pair[1]];
                let work = if method == Method::AverageAcceleration { 0.5 * (force + new) } else { new } * (next - u);
                assert!((after - before - work).abs() <= rounding(4096, scale), "{method:?}");
            }
        }
    }

    #[test]
    fn the_mass_and_the_momentum_are_those_of_the_bar() {
        for redistributed in [false, true] {
            let mesh = FiniteElementBar::new(&bar(), 10, redistributed).expect("fine enough");
            assert!((mesh.mass.sum() - bar().mass()).abs() <= rounding(32, 3.0));
            assert!((mesh.momentum(&mesh.arriving()) + bar().mass() * 0.25).abs() <= rounding(32, 3.0));
        }
        assert!(FiniteElementBar::new(&bar(), 1, false).is_err());
    }

    #[test]
    fn momentum_changes_by_the_impulse_of_the_midpoint_force() {
        let bar = bar();
        let mesh = FiniteElementBar::new(&bar, 20, false).expect("fine enough");
        let (h, mut impulse) = (0.5 * bar.length / 20.0 / bar.wave_speed(), 0.0);
        let end = mesh.run(Method::Midpoint, h, 120, |state| impulse += h * state.force).expect("valid");
        assert!((mesh.momentum(&end) - mesh.momentum(&mesh.arriving()) - impulse).abs() <= rounding(120 * 64, 2.0));
    }

    #[test]
    fn the_redistributed_bar_hardly_changes_its_energy_and_is_refused_by_the_midpoint_rule() {
        let rows = history(Method::AverageAcceleration, true, 20);
        let worst = rows.iter().map(|row| (row.0 / rows[0].0 - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-3, "{worst}");
        let mesh = FiniteElementBar::new(&bar(), 20, true).expect("fine enough");
        assert!(mesh.run(Method::Midpoint, 0.01, 1, |_| ()).is_err());
    }
}
