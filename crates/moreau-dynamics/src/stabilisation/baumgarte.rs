//! Baumgarte: the violation obeys a damped oscillator, g̈ + 2α ġ + β² g = 0, here by the semi-implicit Euler rule.
//!
//! ```text
//!     ġ⁺ = ġ − h (2α ġ + β² g) ,   g⁺ = g + h ġ⁺ :      (g⁺, hġ⁺) = (1 − b², 1 − a; −b², 1 − a) (g, hġ) ,   a = 2αh ,   b = βh .
//! ```
//! The matrix has the determinant 1 − a and the trace 2 − a − b², so by Schur and Cohn the violation decays if and only if
//! a > 0, b > 0 and 2a + b² < 4. The trace squared equals four determinants where a = 2b − b²: critical damping of the *step* is
//! α = β (1 − βh/2), less than the α = β of the equation, and a = b = 1 ends every violation in two steps.
//!
//! On a linear constraint this is what happens exactly; on a curved one each step adds the sagitta of its arc.

use super::{Constrained, Stabilisation, constrain, free_velocity};
use crate::mechanics::State;
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};

/// Velocity bias (1 − 2αh) G v − h β² g.
///
/// # Source
/// Chapter §9, constraint drift, (1); Baumgarte 1972.
#[derive(Clone, Copy, Debug)]
pub struct Baumgarte {
    /// α \[1/s\].
    pub damping: f64,
    /// β \[1/s\].
    pub frequency: f64,
}

impl Baumgarte {
    /// The bias −ERP g/h: 2αh = 1 and β²h² = ERP at the step h \[s\].
    ///
    /// # Errors
    /// If ERP is not in (0, 1\].
    pub fn error_reduction(share: f64, h: f64) -> Result<Self> {
        if !(share > 0.0 && share <= 1.0) {
            return Err(Error::invalid("error_reduction", format!("is {share}"), "use a number above 0 and up to 1"));
        }
        Ok(Baumgarte { damping: 0.5 / h, frequency: share.sqrt() / h })
    }
}

impl Stabilisation for Baumgarte {
    fn name(&self) -> String {
        format!("Baumgarte α={} β={}", self.damping, self.frequency)
    }

    fn step(&self, system: &dyn Constrained, state: &State, h: f64) -> Result<State> {
        let jacobian = system.jacobian(&state.position);
        let rate = &jacobian * &state.velocity * (1.0 - 2.0 * self.damping * h);
        let bias = rate - system.violation(&state.position) * (h * self.frequency * self.frequency);
        let velocity = constrain(system, &jacobian, &free_velocity(system, state, h)?, &bias)?;
        Ok(State { time: state.time + h, position: &state.position + &velocity * h, velocity })
    }
}

/// What one step does to a violation, in any ordered field: a = 2αh and b² = β²h².
///
/// ```
/// use moreau_dynamics::stabilisation::ViolationStep;
/// use moreau_exact::scalar::ratio;
///
/// let critical = ViolationStep { damping: ratio(1, 1), stiffness: ratio(1, 1) };
/// let [violation, rate] = critical.advance(&critical.advance(&[ratio(5, 1), ratio(-2, 1)]));
/// assert_eq!((violation, rate), (ratio(0, 1), ratio(0, 1))); // every violation ends in two steps
/// assert!(!ViolationStep { damping: ratio(2, 1), stiffness: ratio(1, 1) }.decays()); // 2a + b² = 5 is not below 4
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ViolationStep<T> {
    /// a = 2αh.
    pub damping: T,
    /// b² = β²h².
    pub stiffness: T,
}

impl<T: Scalar> ViolationStep<T> {
    /// (g, hġ) after one step, both in the unit of g.
    pub fn advance(&self, [violation, rate]: &[T; 2]) -> [T; 2] {
        let rate = rate.clone() - self.damping.clone() * rate.clone() - self.stiffness.clone() * violation.clone();
        [violation.clone() + rate.clone(), rate]
    }

    /// Determinant and trace of the step.
    pub fn invariants(&self) -> [T; 2] {
        let [g, rate] = [[T::one(), T::zero()], [T::zero(), T::one()]].map(|unit| self.advance(&unit));
        [g[0].clone() * rate[1].clone() - g[1].clone() * rate[0].clone(), g[0].clone() + rate[1].clone()]
    }

    /// Whether every violation decays: both eigenvalues inside the unit circle, decided on the matrix by Schur and Cohn.
    pub fn decays(&self) -> bool {
        let [determinant, trace] = self.invariants();
        let size = if trace < T::zero() { -trace } else { trace };
        determinant < T::one() && size < T::one() + determinant
    }

    /// Whether violations decay through zero again and again: complex eigenvalues.
    pub fn oscillates(&self) -> bool {
        let [determinant, trace] = self.invariants();
        trace.clone() * trace < T::ratio(4, 1) * determinant
    }
}
