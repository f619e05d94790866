//! Numbers that are the same on every machine: splitmix64 from a fixed seed.

use moreau::scalar::{Rational, ratio};

pub struct Random {
    state: u64,
    /// Only sums of a few powers of two, which f64 holds exactly.
    dyadic: bool,
}

impl Random {
    pub fn new(seed: u64, dyadic: bool) -> Self {
        Random { state: seed, dyadic }
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    /// A number from 1/8 to 9.
    pub fn number(&mut self) -> Rational {
        let numerator = 1 + self.below(if self.dyadic { 7 } else { 9 }) as i64;
        let denominator = if self.dyadic { [1, 2, 4, 8] } else { [1, 3, 7, 10] }[self.below(4)];
        ratio(numerator, denominator.min(8 * numerator))
    }

    /// A whole number from −3 to 3 that is not 0.
    pub fn arm(&mut self) -> Rational {
        let size = 1 + self.below(3) as i64;
        ratio(if self.below(2) == 0 { size } else { -size }, 1)
    }

    /// A power of two from ½ to 4 where the data are dyadic, any number otherwise.
    pub fn divisor(&mut self) -> Rational {
        if self.dyadic { ratio([1, 2, 4, 8][self.below(4)], 2) } else { self.number() }
    }

    /// A friction coefficient, now and then 0.
    pub fn friction(&mut self) -> Rational {
        let choices = if self.dyadic { [(1, 2), (1, 4), (1, 1), (2, 1), (1, 8)] } else { [(1, 2), (3, 10), (7, 5), (1, 10), (2, 3)] };
        match self.below(12) {
            0 => ratio(0, 1),
            k => ratio(choices[k % 5].0, choices[k % 5].1),
        }
    }
}
