//! A measured difference and how large it may be.

/// |a − b| with the bound that was derived for it, in one unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The difference found.
    pub difference: f64,
    /// The largest difference allowed, from the module `tolerance` of the crate that the difference belongs to.
    pub tolerance: f64,
}

impl Measured {
    /// Whether the difference is a number within the tolerance.
    pub fn holds(self) -> bool {
        self.difference <= self.tolerance
    }

    /// Of several comparisons the one that comes closest to its tolerance, or exceeds it most; one that is not a number before all others.
    pub fn worst(comparisons: impl IntoIterator<Item = Measured>) -> Option<Measured> {
        let share = |one: &Measured| if one.difference == 0.0 { 0.0 } else { one.difference / one.tolerance };
        let rank = |one: &Measured| if share(one).is_nan() { f64::INFINITY } else { share(one) };
        comparisons.into_iter().max_by(|a, b| rank(a).total_cmp(&rank(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_comparison_is_the_one_nearest_to_its_bound_or_beyond_it() {
        let of = |difference, tolerance| Measured { difference, tolerance };
        assert_eq!(Measured::worst([of(3.0, 10.0), of(2.0, 4.0), of(0.0, 0.0)]), Some(of(2.0, 4.0)));
        assert!(!Measured::worst([of(3.0, 1.0), of(f64::NAN, 1.0)]).expect("two").holds());
        assert!(Measured::worst([of(0.0, 0.0)]).expect("one").holds());
    }
}
