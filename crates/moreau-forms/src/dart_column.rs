//! One step of DART's contact between bodies on each other along a line: gaps φ, velocities v (away from the ground), interface i below
//! body i.
//!
//! ```text
//!     v_free = v − h g ;      where δ_i = −φ_i ≥ 0 :     0 ≤ r ⟂ H(v_free + M⁻¹Hᵀ r) + c (W_i/n_i) r − t ≥ 0 ,
//!     t_i = max( e |u_i| , min(ERP δ_i/h, v_max) ) ,     u = H v_free ,     φ⁺ = φ + h H v⁺
//! ```
//! c is the force mixing (CFM), W_i the normal response of one of the n_i equal points that share r_i. e |u_i| counts from a threshold on,
//! and v_max is lifted in islands of three or more movable bodies. Off its diagonal H M⁻¹ Hᵀ has no positive entry: a row that lacks
//! velocity needs an impulse whatever the others do, and letting in all such rows until none lacks any solves the problem (Chandrasekaran).
//!
//! A body that rebounds leaves with (1 + e)/(1 + c) − 1 times its free speed, gravity of the step included; one at rest on n points sits c
//! W/n m g h²/ERP deep.
//!
//! # Source
//! DART 6.20: `ContactConstraint::getInformation`, `getVelocityChange`.

use nalgebra::{DMatrix, DVector};

/// Movable bodies of an island from which on the speed of the correction is not limited.
const UNLIMITED: usize = 3;

/// DART's numbers for all contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColumnParameters {
    /// ERP.
    pub error_reduction: f64,
    /// v_max \[m/s\].
    pub correction_speed: f64,
    /// c.
    pub force_mixing: f64,
    /// Rebound speed \[m/s\] up to which e = 0.
    pub rebound_threshold: f64,
}

/// What carries one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// n, equal points.
    pub points: f64,
    /// W of one of them \[1/kg\]: n·M⁻¹n with the rotations it causes in both bodies.
    pub response: f64,
}

/// Bodies on each other, the first on the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// h \[s\].
    pub time_step: f64,
    /// Gravity against the line \[m/s²\].
    pub gravity: f64,
    /// e.
    pub restitution: f64,
    /// ERP, v_max, c and the threshold of rebounds.
    pub parameters: ColumnParameters,
    /// \[kg\], from the ground on.
    pub masses: Vec<f64>,
    /// Below every body.
    pub interfaces: Vec<Interface>,
}

impl Column {
    /// Moves the gaps \[m\] and velocities \[m/s\] by one step and returns the impulses r \[N·s\] of the interfaces.
    pub fn step(&self, gaps: &mut DVector<f64>, velocities: &mut DVector<f64>) -> DVector<f64> {
        velocities.add_scalar_mut(-self.time_step * self.gravity);
        let rows = self.rows();
        let approach = &rows * &*velocities;
        let lacking = DVector::from_fn(gaps.len(), |i, _| self.target(gaps, i, approach[i]) - approach[i]);
        let impulses = self.impulses(gaps, &rows, &lacking);
        let received = rows.tr_mul(&impulses);
        for (k, mass) in self.masses.iter().enumerate() {
            velocities[k] += received[k] / mass;
        }
        *gaps += &rows * &*velocities * self.time_step;
        impulses
    }

    /// H: the velocity of every body relative to the one below it.
    fn rows(&self) -> DMatrix<f64> {
        let bodies = self.masses.len();
        DMatrix::from_fn(bodies, bodies, |i, j| if i == j { 1.0 } else { -f64::from(u8::from(i == j + 1)) })
    }

    /// t_i.
    fn target(&self, gaps: &DVector<f64>, interface: usize, approach: f64) -> f64 {
        let ColumnParameters { error_reduction, correction_speed, rebound_threshold, .. } = self.parameters;
        let unlimited = error_reduction * -gaps[interface] / self.time_step;
        let push = if island(gaps, interface) < UNLIMITED { unlimited.min(correction_speed) } else { unlimited };
        let rebound = -approach * self.restitution;
        if rebound > rebound_threshold { push.max(rebound) } else { push }
    }

    fn impulses(&self, gaps: &DVector<f64>, rows: &DMatrix<f64>, lacking: &DVector<f64>) -> DVector<f64> {
        let inverse = DMatrix::from_diagonal(&DVector::from_iterator(self.masses.len(), self.masses.iter().map(|m| 1.0 / m)));
        let soft = self.interfaces.iter().map(|one| self.parameters.force_mixing * one.response / one.points);
        let matrix = rows * inverse * rows.transpose() + DMatrix::from_diagonal(&DVector::from_iterator(gaps.len(), soft));
        let (mut impulses, mut pressed) = (DVector::zeros(gaps.len()), Vec::new());
        loop {
            let gained = &matrix * &impulses;
            let lacks = |i: &usize| gaps[*i] <= 0.0 && !pressed.contains(i) && gained[*i] < lacking[*i];
            let entering: Vec<usize> = (0..gaps.len()).filter(lacks).collect();
            if entering.is_empty() {
                return impulses;
            }
            pressed.extend(entering);
            let part = matrix.select_rows(&pressed).select_columns(&pressed);
            // positive definite: a principal part of one that is
            let Some(factor) = part.cholesky() else { return impulses.map(|_| f64::NAN) };
            let solved = factor.solve(&lacking.select_rows(&pressed));
            pressed.iter().zip(&solved).for_each(|(&i, &impulse)| impulses[i] = impulse);
        }
    }
}

/// Movable bodies that closed interfaces join with this one.
fn island(gaps: &DVector<f64>, interface: usize) -> usize {
    let below = (0..=interface).rev().take_while(|&i| gaps[i] <= 0.0).count();
    let above = (interface + 1..gaps.len()).take_while(|&i| gaps[i] <= 0.0).count();
    let reaches_ground = below > interface;
    below + above + usize::from(!reaches_ground)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    const H: f64 = 1.0 / 128.0;
    const G: f64 = 10.0;

    fn column(bodies: usize) -> Column {
        let parameters =
            ColumnParameters { error_reduction: 0.125, correction_speed: 0.25, force_mixing: 1.0 / 1024.0, rebound_threshold: 0.5 };
        let interface = Interface { points: 4.0, response: 2.5 };
        let masses = vec![2.0; bodies];
        Column { time_step: H, gravity: G, restitution: 0.5, parameters, masses, interfaces: vec![interface; bodies] }
    }

    #[test]
    fn a_body_rebounds_with_the_free_speed_softened_by_the_mixing() {
        let column = Column { interfaces: vec![Interface { points: 1.0, response: 0.5 }], ..column(1) };
        let (mut gaps, mut velocities) = (dvector![-0.01], dvector![-3.0]);
        column.step(&mut gaps, &mut velocities);
        let expected = (3.0 + H * G) * (1.5 / (1.0 + 1.0 / 1024.0) - 1.0);
        assert!((velocities[0] - expected).abs() <= rounding(16, 4.0), "{} {expected}", velocities[0]);
    }

    #[test]
    fn below_the_threshold_it_is_pushed_out_at_most_at_the_correction_speed() {
        let rigid = |mut column: Column| {
            column.parameters.force_mixing = 0.0;
            column
        };
        for (depth, expected) in [(0.5, 0.25), (1.0 / 1024.0, 0.125 / 1024.0 / H)] {
            let (mut gaps, mut velocities) = (dvector![-depth], dvector![-0.75]);
            rigid(column(1)).step(&mut gaps, &mut velocities);
            assert!((velocities[0] - expected).abs() <= rounding(16, 1.0), "{}", velocities[0]);
        }
        // three bodies: no limit; the second closed interface counts two bodies when the third is open
        let deep = |gaps: DVector<f64>| {
            let (mut gaps, mut velocities) = (gaps, DVector::zeros(3));
            rigid(column(3)).step(&mut gaps, &mut velocities);
            velocities
        };
        assert!((deep(dvector![-0.5, -0.5, -0.5])[0] - 0.125 * 0.5 / H).abs() <= rounding(64, 8.0));
        let open = deep(dvector![-0.5, -0.5, 0.5]);
        assert!((open[0] - 0.25).abs() <= rounding(64, 8.0) && (open[1] - 0.5).abs() <= rounding(64, 8.0), "{open}");
        // off the ground, two bodies joined by one interface
        assert_eq!(island(&dvector![0.5, -0.5, 0.5], 1), 2);
    }

    #[test]
    fn at_rest_the_mixing_carries_the_weight_by_depth() {
        let column = column(1);
        let depth = column.parameters.force_mixing * 2.5 / 4.0 * 2.0 * G * H * H / column.parameters.error_reduction;
        let (mut gaps, mut velocities) = (dvector![-depth], dvector![0.0]);
        let impulse = column.step(&mut gaps, &mut velocities)[0];
        assert!((impulse - 2.0 * G * H).abs() <= rounding(16, impulse));
        assert!(velocities[0].abs() <= rounding(16, G * H), "{}", velocities[0]);
    }

    #[test]
    fn every_step_solves_its_complementarity_problem() {
        // a state in which one interface closes hard and its neighbour must open
        let column = column(4);
        let (mut gaps, mut velocities) = (dvector![-0.02, -0.01, -0.03, 0.01], dvector![1.0, -0.25, 2.5, -1.0]);
        for _ in 0..50 {
            let (before, free) = (gaps.clone(), velocities.add_scalar(-H * G));
            let rows = column.rows();
            let approach = &rows * &free;
            let impulses = column.step(&mut gaps, &mut velocities);
            let reached = &rows * &velocities;
            for i in 0..4 {
                let soft = column.parameters.force_mixing * 2.5 / 4.0 * impulses[i];
                let slack = reached[i] + soft - column.target(&before, i, approach[i]);
                let error = rounding(256, 8.0);
                assert!(impulses[i] >= -error && (before[i] > 0.0 || slack >= -error), "{i}: {} {slack}", impulses[i]);
                assert!(impulses[i] * slack.abs() <= error * 8.0 && (before[i] <= 0.0 || impulses[i] == 0.0));
            }
        }
    }
}
