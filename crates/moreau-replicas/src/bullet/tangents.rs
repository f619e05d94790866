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
use moreau_contact::problem::ContactProblem;
use moreau_dynamics::schemes::StepProblem;
use moreau_exact::Result;
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
    let mut free_velocity = problem.free_velocity().clone();
    let mut turned = Vec::with_capacity(problem.contacts());
    for ((place, u), rows) in step.places.iter_mut().zip(free_velocity.as_mut_slice().chunks_exact_mut(3)).zip(step.jacobian.contacts()) {
        let slip = [u[1], u[2]];
        let frame = place.as_ref().map(|place| &place.frame);
        let own = if bodies == Bodies::Rigid { along(slip) } else { None };
        let [x, y] = own.or_else(|| frame.map(fixed)).unwrap_or([1.0, 0.0]);
        let grounded = place.as_ref().is_some_and(|place| place.bodies.1.is_none());
        let across = if grounded { [y, -x] } else { [-y, x] };
        let tangents = if boxed { [combined([x, y], across, 1.0), combined(across, [x, y], -1.0)] } else { [[x, y], across] };
        if let Some(place) = place {
            let [t1, t2] = [place.frame[1], place.frame[2]];
            [place.frame[1], place.frame[2]] = tangents.map(|[a, b]| [0, 1, 2].map(|i| a * t1[i] + b * t2[i]));
        }
        [u[1], u[2]] = tangents.map(|[a, b]| a * slip[0] + b * slip[1]);
        let [[a, b], [c, d]] = tangents;
        turned.push(rows.combined(&[&[1.0, 0.0, 0.0], &[0.0, a, b], &[0.0, c, d]]));
    }
    step.jacobian = Arc::new(Jacobian::new(3, step.jacobian.ncols(), turned));
    let factor = if boxed { SQRT_2 } else { 1.0 };
    let built = ContactProblem::from_free_velocity(&step.effective_mass, &step.jacobian, free_velocity)
        .name(problem.name())
        .law(problem.law())
        .friction(problem.friction().iter().map(|friction| friction * factor).collect())
        .shift(problem.shift().clone())
        .bodies(problem.bodies().map(<[_]>::to_vec));
    step.problem = Some(built.build()?);
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
