//! The flow of a body of unit masses across one impact: flight under a constant acceleration, v⁺ = (impact law)(v⁻), flight.
//!
//! ```text
//!     q(t) = q + t v + ½ t² a ,   φ(q(t₁)) = 0 ,   n = ∇φ(q(t₁)) ,     v⁺ = v⁻ − (1+e) (n·v⁻)/(n·n) (n − μ t)
//! ```
//! with t ⟂ n, |t| = |n|, t·v⁻ ≥ 0 the direction in which a body slides (μ = 0: no friction). Its Jacobian has determinant e²: the impact
//! map v⁻ ↦ v⁺ contributes −e, and the dependence of t₁ on the start the other factor −e.

use super::variational::ScalarField;
use super::{Phase, ahead};
use moreau_exact::scalar::{Rational, Scalar};
use nalgebra::DVector;

/// What an impact does to the velocity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tangent {
    /// No friction, n coordinates.
    Frictionless,
    /// In the plane: sliding friction against t, to the end of the impact.
    Sliding,
    /// The tangential velocity is lost.
    Sticking,
}

/// Flight, impact, flight.
#[derive(Clone, Debug)]
pub struct ImpactFlow<W> {
    /// φ, positive where the body may be.
    pub gap: W,
    /// a, constant \[m/s²\].
    pub acceleration: DVector<Rational>,
    /// e.
    pub restitution: Rational,
    /// What friction does.
    pub tangent: Tangent,
    /// μ of sliding.
    pub friction: Rational,
}

impl<W: ScalarField> ImpactFlow<W> {
    /// The state at `end`, for a start whose impact is at `impact` \[s\], or where the derivatives are those of such a start.
    pub fn map<T: Scalar>(&self, start: &Phase<T>, impact: &Rational, end: &Rational) -> Phase<T> {
        let guess = T::nearest(impact);
        let touching = self.fly(start, &guess);
        // one Newton step for t₁: zero from the true time, with the derivatives of the implicit function theorem
        let rate = self.gap.gradient(&touching.position).dot(&touching.velocity);
        let time = guess - self.gap.value(&touching.position) / rate;
        let Phase { position, velocity } = self.fly(start, &time);
        let velocity = self.impact(&self.gap.gradient(&position), &velocity);
        self.fly(&Phase { position, velocity }, &(T::nearest(end) - time))
    }

    /// φ at the time of impact of this start, zero if the time is right.
    pub fn gap_at<T: Scalar>(&self, start: &Phase<T>, time: &Rational) -> T {
        self.gap.value(&self.fly(start, &T::nearest(time)).position)
    }

    fn fly<T: Scalar>(&self, start: &Phase<T>, time: &T) -> Phase<T> {
        let gained = self.acceleration.map(|a| T::nearest(&a)) * time.clone();
        let mean = ahead(&start.velocity, &T::ratio(1, 2), &gained);
        Phase { position: ahead(&start.position, time, &mean), velocity: &start.velocity + gained }
    }

    fn impact<T: Scalar>(&self, normal: &DVector<T>, velocity: &DVector<T>) -> DVector<T> {
        let speed = normal.dot(velocity) / normal.dot(normal);
        let gained = (T::one() + T::nearest(&self.restitution)) * speed.clone();
        let mut direction = normal.clone();
        match self.tangent {
            Tangent::Frictionless => {}
            Tangent::Sliding => {
                let tangent = DVector::from_vec(vec![normal[1].clone(), -normal[0].clone()]);
                let along = if tangent.dot(velocity) < T::zero() { -tangent } else { tangent };
                direction -= along * T::nearest(&self.friction);
            }
            Tangent::Sticking => return normal * -(T::nearest(&self.restitution) * speed),
        }
        velocity - direction * gained
    }
}
