//! A measured difference and how large it may be.

use moreau_checks::Expectation;

/// |a − b| with what is expected of it, in one unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The difference found.
    pub difference: f64,
    /// 0 with the largest difference allowed, from the module `tolerance` of the crate that the difference belongs to.
    pub expectation: Expectation,
}

impl Measured {
    /// A difference that may be as large as the tolerance.
    pub fn within(difference: f64, tolerance: f64) -> Self {
        Measured { difference, expectation: Expectation::equal(0.0, tolerance, "") }
    }

    /// Whether the difference is a number within the tolerance.
    pub fn holds(&self) -> bool {
        self.expectation.holds(self.difference)
    }

    /// How much of the tolerance the difference is; `None` if it must be 0.
    pub fn used(&self) -> Option<f64> {
        self.expectation.used(self.difference)
    }

    /// Of several comparisons the one that comes closest to its tolerance, or exceeds it most; one that is not a number before all others.
    ///
    /// ```
    /// use moreau_replicas::systems::Measured;
    ///
    /// let [near, far] = [Measured::within(1e-9, 1e-8), Measured::within(2e-9, 4e-9)];
    /// assert_eq!(Measured::worst([near, far.clone()]), Some(far)); // the one that uses most of its bound
    /// assert!(!Measured::within(f64::NAN, 1.0).holds());
    /// ```
    pub fn worst(comparisons: impl IntoIterator<Item = Measured>) -> Option<Measured> {
        let rank = |one: &Measured| if one.difference == 0.0 { 0.0 } else { one.used().unwrap_or(f64::INFINITY) };
        comparisons.into_iter().max_by(|a, b| rank(a).total_cmp(&rank(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_comparison_is_the_one_nearest_to_its_bound_or_beyond_it() {
        let of = Measured::within;
        assert_eq!(Measured::worst([of(3.0, 10.0), of(2.0, 4.0), of(0.0, 0.0)]), Some(of(2.0, 4.0)));
        assert!(!Measured::worst([of(3.0, 1.0), of(f64::NAN, 1.0)]).expect("two").holds());
        assert_eq!(Measured::worst([of(3.0, 1.0), of(1e-9, 0.0)]), Some(of(1e-9, 0.0)));
        assert!(Measured::worst([of(0.0, 0.0)]).expect("one").holds());
    }
}
