//! How well a step was solved.
//!
//! ```text
//!     relative residual ≤ limit  ⟺  accepted
//! ```
//! A scheme through the waist is judged by the certificate of its contact problems, one with a law of its own by its own residual and
//! stopping rule.

/// The worst residual of a step, relative to its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepResidual {
    /// The rule that judges the step: `certificate`, or the stopping rule of a scheme's own law.
    pub rule: &'static str,
    /// Which of its residuals is the worst.
    pub residual: &'static str,
    /// Its relative size.
    pub relative: f64,
    /// What is accepted.
    pub limit: f64,
    /// The contact, as an index into the contacts of the problem, where there is one.
    pub contact: Option<usize>,
    /// Its two bodies by number, the ground as `None`, where known.
    pub pair: Option<[Option<usize>; 2]>,
}

impl StepResidual {
    /// Whether the residual is within its limit; one that is not a number is not.
    pub fn is_accepted(&self) -> bool {
        self.relative <= self.limit
    }

    /// The one that exceeds its limit by the larger factor.
    pub fn worse(self, other: StepResidual) -> StepResidual {
        if other.is_worse_than(&self) { other } else { self }
    }

    /// Whether it is further beyond its limit, or not a number where the other one is.
    pub fn is_worse_than(&self, other: &StepResidual) -> bool {
        let excess = |one: &StepResidual| if one.limit > 0.0 { one.relative / one.limit } else { one.relative };
        let (own, others) = (excess(self), excess(other));
        !others.is_nan() && (own.is_nan() || own > others)
    }

    /// The worse of two that may be absent.
    pub fn worse_of(one: Option<StepResidual>, other: Option<StepResidual>) -> Option<StepResidual> {
        match (one, other) {
            (Some(one), Some(other)) => Some(one.worse(other)),
            (one, other) => one.or(other),
        }
    }
}

/// How a step ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// No residual above its limit, or nothing to solve.
    Accepted,
    /// Above its limit, by a scheme or solver whose algorithm is a declared number of sweeps and promises no more.
    Unconverged,
    /// Above its limit.
    Rejected,
}

impl Judgement {
    /// What a step's worst residual means; `truncated` if its scheme or solver declares a number of sweeps.
    pub fn of(residual: Option<StepResidual>, truncated: bool) -> Self {
        match residual {
            Some(residual) if !residual.is_accepted() && truncated => Judgement::Unconverged,
            Some(residual) if !residual.is_accepted() => Judgement::Rejected,
            _ => Judgement::Accepted,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn residual(relative: f64, limit: f64) -> StepResidual {
        StepResidual { rule: "certificate", residual: "normal", relative, limit, contact: None, pair: None }
    }

    #[test]
    fn a_residual_is_accepted_up_to_its_limit_and_what_is_not_a_number_is_rejected() {
        for (relative, accepted) in [(0.5, true), (0.5f64.next_up(), false), (f64::NAN, false), (f64::INFINITY, false)] {
            let of = |truncated| Judgement::of(Some(residual(relative, 0.5)), truncated);
            let otherwise = |judgement| if accepted { Judgement::Accepted } else { judgement };
            assert_eq!(of(false), otherwise(Judgement::Rejected));
            assert_eq!(of(true), otherwise(Judgement::Unconverged));
        }
        assert_eq!(Judgement::of(None, false), Judgement::Accepted);
    }

    #[test]
    fn the_worse_of_two_residuals_exceeds_its_own_limit_by_more() {
        let (small, large) = (residual(1e-9, 1e-8), residual(1e-7, 1e-5));
        assert_eq!(small.worse(large), small);
        assert!(large.worse(residual(f64::NAN, 1.0)).relative.is_nan() && residual(f64::NAN, 1.0).worse(large).relative.is_nan());
        assert_eq!(StepResidual::worse_of(None, Some(large)), Some(large));
    }
}
