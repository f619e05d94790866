//! Functions on \[0, 1\] that rise from 0 to 1, and how much of that lies on the intervals of Cantor's set.

use crate::scalar::{Rational, ratio};
use moreau_exact::witness::{Part, Witness, decided};

/// A function that rises from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub enum Rise {
    /// Cantor's function.
    Cantor,
    /// x.
    Uniform,
    /// 0 before 1.
    Jump,
}

impl Rise {
    /// The value at a rational in \[0, 1\] whose ternary expansion ends.
    pub fn at(self, point: &Rational) -> Rational {
        match self {
            Rise::Cantor => cantor(point),
            Rise::Uniform => point.clone(),
            Rise::Jump if *point >= ratio(1, 1) => ratio(1, 1),
            Rise::Jump => ratio(0, 1),
        }
    }

    /// The rises on the 2ⁿ intervals of level n of Cantor's set: of all but the largest together, and the largest.
    pub fn on_cantors_set(self, level: usize) -> [Rational; 2] {
        decided(
            || self.interval_by_interval(level),
            |found| {
                let function = Part::Word(match self {
                    Rise::Cantor => "cantor",
                    Rise::Uniform => "uniform",
                    Rise::Jump => "jump",
                });
                let parts = vec![("function", function), ("level", Part::Counts(vec![level])), ("rises", found.as_slice().into())];
                Some(Witness::new("cantor-rises", parts))
            },
        )
    }

    fn interval_by_interval(self, level: usize) -> [Rational; 2] {
        let (mut intervals, mut length) = (vec![ratio(0, 1)], ratio(1, 1));
        for _ in 0..level {
            length *= ratio(1, 3);
            intervals = intervals.iter().flat_map(|start| [start.clone(), start + ratio(2, 1) * &length]).collect();
        }
        let rises: Vec<Rational> = intervals.iter().map(|start| self.at(&(start + &length)) - self.at(start)).collect();
        let largest = rises.iter().max().cloned().unwrap_or_default();
        let total = rises.into_iter().fold(ratio(0, 1), |sum, rise| sum + rise);
        [total - &largest, largest]
    }
}

/// The Cantor function at a rational in \[0, 1\] whose ternary expansion ends: digits 0, 2 become 0, 1; the first 1 ends it.
fn cantor(point: &Rational) -> Rational {
    let (mut rest, mut value, mut weight) = (point.clone(), ratio(0, 1), ratio(1, 1));
    while rest > ratio(0, 1) {
        if rest >= ratio(1, 1) {
            return value + weight;
        }
        rest *= ratio(3, 1);
        weight *= ratio(1, 2);
        if rest >= ratio(2, 1) {
            value += &weight;
            rest -= ratio(2, 1);
        } else if rest >= ratio(1, 1) {
            return value + weight;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cantor_function_has_its_known_values_and_is_constant_on_the_middle_third() {
        assert_eq!(cantor(&ratio(0, 1)), ratio(0, 1));
        assert_eq!(cantor(&ratio(1, 1)), ratio(1, 1));
        assert_eq!(cantor(&ratio(1, 3)), ratio(1, 2));
        assert_eq!(cantor(&ratio(4, 9)), ratio(1, 2));
        assert_eq!(cantor(&ratio(2, 3)), ratio(1, 2));
        assert_eq!(cantor(&ratio(2, 9)), ratio(1, 4));
        assert_eq!(cantor(&ratio(8, 9)), ratio(3, 4));
    }
}
