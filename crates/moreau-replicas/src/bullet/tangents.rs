//! Where Bullet lays the two friction rows of a contact, to which H's tangents are turned.
//!
//! ```text
//!     multibodies    d₁ = (0, −n_z, n_y)/|·| if |n_z| > 1/√2, (−n_y, n_x, 0)/|·| otherwise
//!     rigid bodies   d₁ = u_t/|u_t|, u after the forces, if |u_t|² > ε; else as above
//!     d₂ = n × d₁, at the ground −n × d₁ ;      box: t₁ = (d₁ + d₂)/√2 , t₂ = (d₂ − d₁)/√2
//! ```
//! Bullet's normal points to the body that was made first, and that is the ground: d₁ and n change their signs, n × d₁ does not. The only
//! one to notice is the end of a cone's sweeps, which looks at the sum of the changes along d₁ and d₂.
//!
//! The box |r·d₁| ≤ μ r_n, |r·d₂| ≤ μ r_n is the square with its corners on t₁ and t₂: the polyhedral law with four directions and √2 μ.

use moreau_contact::contact::Jacobian;
use moreau_contact::problem::{ContactProblemBuilder, Dynamics};
use moreau_dynamics::schemes::StepProblem;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
use std::sync::Arc;

/// Which of Bullet's two families of bodies steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bodies {
    /// `btMultiBodyConstraintSolver`: PyBullet's default.
    #[default]
    Multi,
    /// `btSequentialImpulseConstraintSolver`: PyBullet's `useMaximalCoordinates`, on both sides of a contact.
    Rigid,
}

/// Turns the tangents of every spatial contact of a step; for a box also by 45°, and μ becomes √2 μ.
pub(super) fn turn(step: &mut StepProblem, bodies: Bodies, boxed: bool) -> Result<()> {
    let Some(problem) = step.problem.take_if(|problem| problem.rows_per_contact() == 3) else { return Ok(()) };
    let mut turned = Turned {
        delassus: problem.dense().clone(),
        free_velocity: DMatrix::from_column_slice(problem.rows(), 1, problem.free_velocity().as_slice()),
        dynamics: problem.dynamics().cloned(),
    };
    let mut own_rows = step.jacobian.to_dense();
    for (k, place) in step.places.iter_mut().enumerate() {
        let slip = [1, 2].map(|row| turned.free_velocity[(3 * k + row, 0)]);
        let frame = place.as_ref().map(|place| &place.frame);
        let own = if bodies == Bodies::Rigid { along(slip) } else { None };
        let [x, y] = own.or_else(|| frame.map(fixed)).unwrap_or([1.0, 0.0]);
        let grounded = place.as_ref().is_some_and(|place| place.bodies.1.is_none());
        let across = if grounded { [y, -x] } else { [-y, x] };
        let rows = if boxed { [combined([x, y], across, 1.0), combined(across, [x, y], -1.0)] } else { [[x, y], across] };
        turned.turn(k, rows);
        if let Some(place) = place {
            let [t1, t2] = [place.frame[1], place.frame[2]];
            [place.frame[1], place.frame[2]] = rows.map(|[a, b]| [0, 1, 2].map(|i| a * t1[i] + b * t2[i]));
        }
        turn_rows(&mut own_rows, 3 * k + 1, rows);
    }
    step.jacobian = Arc::new(Jacobian::from_dense(&own_rows, 3));
    let factor = if boxed { SQRT_2 } else { 1.0 };
    let friction = problem.friction().iter().map(|friction| friction * factor).collect();
    step.problem = Some(turned.of(problem.into_builder().friction(friction)).build()?);
    Ok(())
}

/// (a + sign b)/√2.
fn combined(a: [f64; 2], b: [f64; 2], sign: f64) -> [f64; 2] {
    [0, 1].map(|i: usize| (a[i] + sign * b[i]) * FRAC_1_SQRT_2)
}

/// u_t/|u_t| in (t₁, t₂), unless the contact hardly slips.
fn along(slip: [f64; 2]) -> Option<[f64; 2]> {
    let squared = slip[0] * slip[0] + slip[1] * slip[1];
    (squared > f64::EPSILON).then(|| slip.map(|u| u / squared.sqrt()))
}

/// The d₁ of multibodies in (t₁, t₂) of a frame n, t₁, t₂.
fn fixed([n, t1, t2]: &[[f64; 3]; 3]) -> [f64; 2] {
    let direction = if n[2].abs() > FRAC_1_SQRT_2 { [0.0, -n[2], n[1]] } else { [-n[1], n[0], 0.0] };
    let [x, y] = [t1, t2].map(|t| t.iter().zip(direction).map(|(a, b)| a * b).sum::<f64>());
    let length = x.hypot(y);
    [x / length, y / length]
}

/// Writes rows k and k + 1 in two other directions.
fn turn_rows(matrix: &mut DMatrix<f64>, k: usize, rows: [[f64; 2]; 2]) {
    for column in 0..matrix.ncols() {
        let old = [matrix[(k, column)], matrix[(k + 1, column)]];
        for (i, [a, b]) in rows.into_iter().enumerate() {
            matrix[(k + i, column)] = a * old[0] + b * old[1];
        }
    }
}

/// What a problem says of its tangents; the shift acts on normals only.
struct Turned {
    delassus: DMatrix<f64>,
    /// One column.
    free_velocity: DMatrix<f64>,
    dynamics: Option<Dynamics>,
}

impl Turned {
    /// Turns everything of contact k.
    fn turn(&mut self, k: usize, rows: [[f64; 2]; 2]) {
        let row = 3 * k + 1;
        turn_rows(&mut self.delassus, row, rows);
        let mut transposed = self.delassus.transpose();
        turn_rows(&mut transposed, row, rows);
        self.delassus = transposed.transpose();
        turn_rows(&mut self.free_velocity, row, rows);
        if let Some(dynamics) = &mut self.dynamics {
            turn_rows(&mut dynamics.jacobian, row, rows);
        }
    }

    fn of(self, problem: ContactProblemBuilder) -> ContactProblemBuilder {
        let free_velocity = DVector::from_column_slice(self.free_velocity.as_slice());
        problem.delassus(self.delassus).free_velocity(free_velocity).dynamics(self.dynamics)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bullet::{Bullet, Friction};
    use moreau_contact::contact::delassus::delassus;
    use moreau_dynamics::scenes::named;
    use moreau_dynamics::schemes::{StepContext, Waist};
    use moreau_exact::tolerance::rounding;

    fn assembled(scheme: &Bullet, slip: [f64; 3]) -> StepProblem {
        let (mechanism, mut state) = named("incline-slide").and_then(|scene| scene.spatial_mechanism()).expect("built in");
        state.velocity.rows_mut(0, 3).copy_from_slice(&slip);
        scheme.assemble(&StepContext::new(mechanism.as_ref(), &state, 0.01).expect("valid")).expect("a block on a slope")
    }

    fn dot(one: [f64; 3], other: [f64; 3]) -> f64 {
        one.iter().zip(other).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn the_problem_in_the_turned_tangents_is_that_of_the_turned_rows() {
        for bodies in [Bodies::Multi, Bodies::Rigid] {
            for friction in [Friction::Cone, Friction::Pyramid] {
                let scheme = Bullet { bodies, friction, margin: 0.1, ..Bullet::default() };
                let step = assembled(&scheme, [0.3, 0.4, 0.0]);
                let problem = step.problem.expect("contacts");
                let again = delassus(step.effective_mass.matrix(), &step.jacobian.to_dense()).expect("definite");
                assert!((problem.dense() - again).amax() <= rounding(64, problem.dense().amax()), "{bodies:?}");
                assert!((problem.free_velocity() - &*step.jacobian * &step.free_velocity).amax() <= rounding(64, 1.0));
                assert_eq!(problem.dynamics().expect("given").jacobian, step.jacobian.to_dense());
                for place in step.places {
                    let [n, t1, t2] = place.expect("bodies").frame;
                    let products = [dot(n, t1), dot(n, t2), dot(t1, t2), dot(t1, t1) - 1.0, dot(t2, t2) - 1.0];
                    assert!(products.iter().all(|one| one.abs() <= rounding(16, 1.0)), "{products:?}");
                }
            }
        }
    }

    #[test]
    fn multibodies_have_their_rows_across_the_slope_and_rigid_bodies_along_the_slip() {
        let first = |bodies, slip| {
            let step = assembled(&Bullet { bodies, margin: 0.1, ..Bullet::default() }, slip);
            let frame = step.places[0].expect("a body").frame;
            (frame, step.problem.expect("contacts").free_velocity().clone())
        };
        let ([_, t1, _], _) = first(Bodies::Multi, [0.3, 0.4, 0.0]);
        assert!(dot(t1, [0.0, 1.0, 0.0]).abs() >= 1.0 - rounding(16, 1.0), "{t1:?}");
        // boxes of rigid bodies lie along the slip: both tangents see it under 45°
        let (_, free) = first(Bodies::Rigid, [0.3, 0.4, 0.0]);
        assert!((free[1].abs() - free[2].abs()).abs() <= rounding(64, 1.0) && free[1] > 0.3, "{free}");
    }
}
