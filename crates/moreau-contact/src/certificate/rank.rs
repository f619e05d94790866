//! The rank of a matrix of binary numbers, decided in whole numbers modulo primes.
//!
//! ```text
//!     rank_p ≤ rank        for every prime p
//!     rank ≤ s             if rank_p ≤ s for primes whose product exceeds every minor of s + 1 rows
//! ```
//! Every row is scaled by a power of two so that its numbers are whole; by Hadamard's inequality a minor is at most the product of its
//! rows' lengths. A minor that is divisible by primes whose product exceeds it is zero. One prime is enough where the rows are independent.

use crate::tolerance::proof::RANK_STEPS;

/// An entry: the sum of two numbers.
pub(crate) type Entry = [f64; 2];

/// A factor: the product of two numbers.
pub(crate) type Factor = [f64; 2];

/// The rank of these rows, all equally long; none if deciding it would take too long.
pub(crate) fn rank(rows: &[Row]) -> Option<usize> {
    let mut bits: Vec<f64> = rows.iter().map(|row| row.bits).collect();
    bits.sort_by(|a, b| b.total_cmp(a));
    let (mut found, mut below, mut steps) = (0, 0.0, 0.0);
    for prime in primes() {
        let modulus = Modulus::new(prime);
        let here = modulus.rank(rows.iter().map(|row| row.modulo(&modulus)).collect());
        if here > found {
            (found, below) = (here, 0.0);
        }
        if here == rows.len() {
            return Some(here);
        }
        below += 60.0; // every prime is above 2⁶⁰
        if below > bits.iter().take(found + 1).sum::<f64>() {
            return Some(found);
        }
        steps += (rows.len() * (here + 1) * rows.first().map_or(0, Row::len)) as f64;
        if steps > RANK_STEPS {
            break;
        }
    }
    None
}

/// The places of rows that are independent, each of those before it in this order: all that are so modulo one prime.
pub(crate) fn independent(rows: &[Row], order: &[usize]) -> Vec<usize> {
    let modulus = Modulus::new(primes().next().expect("there is one"));
    let (mut echelon, mut kept): (Vec<(usize, Vec<u64>)>, Vec<usize>) = (Vec::new(), Vec::new());
    for &place in order {
        let mut row = rows[place].modulo(&modulus);
        echelon.iter().for_each(|(column, above)| modulus.eliminate(&mut row, above, *column));
        if let Some(column) = row.iter().position(|x| *x != 0) {
            echelon.push((column, row));
            kept.push(place);
        }
    }
    kept
}

/// ± m 2^k: sign, m and k.
type Binary = (bool, u64, i32);

/// A row Σ c x of rows x of entries, each with a factor c, all of it times one power of two so that its numbers are whole.
pub(crate) struct Row {
    parts: Vec<Part>,
    /// The binary logarithm of its length, at least.
    bits: f64,
}

/// One c x, the exponents of c in those of x.
struct Part {
    factor: [Binary; 2],
    entries: Vec<[Binary; 2]>,
}

impl Row {
    /// The row of these entries.
    ///
    /// # Panics
    /// If a number is not finite.
    pub(crate) fn new(row: &[Entry]) -> Self {
        Row::sum(&[([1.0, 1.0], row)])
    }

    /// Σ c x, the x equally long.
    ///
    /// # Panics
    /// If a number is not finite.
    pub(crate) fn sum(terms: &[(Factor, &[Entry])]) -> Self {
        let mut parts: Vec<Part> = terms.iter().map(|(factor, row)| Part::new(*factor, row)).collect();
        let least = parts.iter().flat_map(Part::nonzero).map(|(_, _, k)| *k).min().unwrap_or(0);
        let all = parts.iter_mut().flat_map(|part| part.entries.iter_mut().flatten());
        all.for_each(|(_, m, k)| *k = if *m == 0 { 0 } else { *k - least });
        let length = terms.first().map_or(0, |(_, row)| row.len()) as f64;
        // in each part twice the largest number, times the root of their number
        let most = parts.iter().map(Part::bits).fold(0.0, f64::max);
        let bits = most + 2.0 + 0.5 * length.log2().max(0.0) + (terms.len() as f64).log2().max(0.0);
        Row { parts, bits }
    }

    fn len(&self) -> usize {
        self.parts.first().map_or(0, |part| part.entries.len())
    }

    fn modulo(&self, modulus: &Modulus) -> Vec<u64> {
        let mut sums = vec![0; self.len()];
        for Part { factor, entries } in &self.parts {
            let factor = modulus.product(modulus.binary(&factor[0]), modulus.binary(&factor[1]));
            for (sum, [one, other]) in sums.iter_mut().zip(entries) {
                let entry = modulus.sum(modulus.binary(one), modulus.binary(other));
                *sum = modulus.sum(*sum, modulus.product(factor, entry));
            }
        }
        sums
    }
}

impl Part {
    fn new(factor: Factor, row: &[Entry]) -> Self {
        let [(one, m, k), (other, n, l)] = factor.map(parts);
        let shifted = |x: f64| {
            let (negative, size, exponent) = parts(x);
            if m == 0 || n == 0 { (false, 0, 0) } else { (negative, size, exponent + k + l) }
        };
        Part { factor: [(one, m, 0), (other, n, 0)], entries: row.iter().map(|entry| entry.map(shifted)).collect() }
    }

    fn nonzero(&self) -> impl Iterator<Item = &Binary> {
        self.entries.iter().flatten().filter(|(_, m, _)| *m != 0)
    }

    /// The binary logarithm of its largest number, at least.
    fn bits(&self) -> f64 {
        let size = |m: u64| f64::from(64 - m.leading_zeros());
        let [(_, m, _), (_, n, _)] = self.factor;
        self.nonzero().map(|(_, own, k)| size(*own) + f64::from(*k) + size(m) + size(n)).fold(0.0, f64::max)
    }
}

/// Sign, odd whole part and exponent: x = ± m 2^k.
fn parts(x: f64) -> Binary {
    assert!(x.is_finite(), "only finite numbers are rational");
    if x == 0.0 {
        return (false, 0, 0);
    }
    let (bits, negative) = (x.abs().to_bits(), x < 0.0);
    let (raw, fraction) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    let (m, k) = if raw == 0 { (fraction, -1074) } else { (fraction | (1 << 52), raw - 1075) };
    (negative, m >> m.trailing_zeros(), k + m.trailing_zeros() as i32)
}

/// Calculation modulo a prime, numbers multiplied by 2⁶⁴ (Montgomery).
struct Modulus {
    prime: u64,
    /// −1/p modulo 2⁶⁴.
    inverse: u64,
    /// 2¹²⁸ modulo p.
    square: u64,
}

impl Modulus {
    fn new(prime: u64) -> Self {
        let mut inverse: u64 = 1;
        for _ in 0..6 {
            inverse = inverse.wrapping_mul(2_u64.wrapping_sub(prime.wrapping_mul(inverse)));
        }
        let once = (1_u128 << 64) % u128::from(prime);
        Modulus { prime, inverse: inverse.wrapping_neg(), square: (once * once % u128::from(prime)) as u64 }
    }

    fn enter(&self, number: u64) -> u64 {
        self.product(number, self.square)
    }

    /// ± m 2^k with k ≥ 0.
    fn binary(&self, (negative, m, k): &Binary) -> u64 {
        let size = self.enter(*m % self.prime);
        let size = if *k == 0 { size } else { self.product(size, self.power_of_two(*k as u32)) };
        if *negative && size != 0 { self.prime - size } else { size }
    }

    fn product(&self, a: u64, b: u64) -> u64 {
        let wide = u128::from(a) * u128::from(b);
        let part = (wide as u64).wrapping_mul(self.inverse);
        let reduced = ((wide + u128::from(part) * u128::from(self.prime)) >> 64) as u64;
        if reduced >= self.prime { reduced - self.prime } else { reduced }
    }

    fn sum(&self, a: u64, b: u64) -> u64 {
        let sum = a + b; // below 2⁶²
        if sum >= self.prime { sum - self.prime } else { sum }
    }

    fn power(&self, base: u64, mut exponent: u64) -> u64 {
        let (mut power, mut base) = (self.enter(1), base);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = self.product(power, base);
            }
            base = self.product(base, base);
            exponent >>= 1;
        }
        power
    }

    fn power_of_two(&self, exponent: u32) -> u64 {
        self.power(self.enter(2), u64::from(exponent))
    }

    /// Takes as much of a row off another one as makes its entry in this column zero.
    fn eliminate(&self, other: &mut [u64], row: &[u64], column: usize) {
        if other[column] == 0 {
            return;
        }
        let factor = self.prime - self.product(other[column], self.power(row[column], self.prime - 2));
        for (x, y) in other.iter_mut().zip(row).filter(|(_, y)| **y != 0) {
            *x = self.sum(*x, self.product(factor, *y));
        }
    }

    /// Row echelon form, pivots counted.
    fn rank(&self, mut rows: Vec<Vec<u64>>) -> usize {
        let columns = rows.first().map_or(0, Vec::len);
        let mut rank = 0;
        for column in 0..columns {
            let Some(pivot) = (rank..rows.len()).find(|&i| rows[i][column] != 0) else { continue };
            rows.swap(rank, pivot);
            let (above, below) = rows.split_at_mut(rank + 1);
            let row = &above[rank];
            below.iter_mut().for_each(|other| self.eliminate(other, row, column));
            rank += 1;
        }
        rank
    }
}

/// Primes between 2⁶⁰ and 2⁶¹, from above.
fn primes() -> impl Iterator<Item = u64> {
    (1_u64 << 60..1_u64 << 61).rev().step_by(2).filter(|candidate| is_prime(*candidate))
}

/// The test of Miller and Rabin with the bases that decide all numbers of 64 bits (J. Sorenson, J. Webster 2017: the first twelve primes).
fn is_prime(odd: u64) -> bool {
    let modulus = Modulus::new(odd);
    let (one, twos) = (modulus.enter(1), (odd - 1).trailing_zeros());
    let minus_one = odd - one;
    [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37].into_iter().all(|base| {
        let first = modulus.power(modulus.enter(base), (odd - 1) >> twos);
        let mut squares = std::iter::successors(Some(first), |power| Some(modulus.product(*power, *power))).take(twos as usize);
        first == one || squares.any(|power| power == minus_one)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::elimination;
    use moreau_exact::scalar::{Rational, exact};
    use nalgebra::DMatrix;

    fn entries(matrix: &DMatrix<f64>) -> Vec<Row> {
        matrix.row_iter().map(|row| Row::new(&row.iter().map(|x| [*x, 0.0]).collect::<Vec<_>>())).collect()
    }

    fn rows(all: &[[Entry; 2]]) -> Vec<Row> {
        all.iter().map(|row| Row::new(row)).collect()
    }

    #[test]
    fn the_rank_is_that_of_elimination_in_fractions() {
        let mut state = 3_u64;
        let mut draw = |most: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % most
        };
        for size in 1..9 {
            for inner in 1..=size {
                let mut factor = |n, m| DMatrix::from_fn(n, m, |_, _| (draw(9) as f64 - 4.0) * 2.0_f64.powi(draw(40) as i32 - 20));
                let matrix = factor(size, inner) * factor(inner, size);
                let exactly: DMatrix<Rational> = matrix.map(exact);
                assert_eq!(rank(&entries(&matrix)), Some(elimination::rank(&exactly)), "{matrix}");
            }
        }
    }

    #[test]
    fn rows_are_kept_in_their_order_as_long_as_they_are_independent() {
        let all = entries(&DMatrix::from_row_slice(4, 3, &[1.0, 0.0, 0.1, 2.0, 0.0, 0.2, 0.0, 1.0, 0.0, 1.0, 1.0, 0.1]));
        for (order, kept) in [([0, 1, 2, 3], vec![0, 2]), ([3, 1, 0, 2], vec![3, 1]), ([2, 3, 1, 0], vec![2, 3])] {
            assert_eq!((independent(&all, &order), rank(&all)), (kept, Some(2)), "{order:?}");
        }
    }

    #[test]
    fn a_last_digit_makes_the_difference() {
        let near = |x: f64| DMatrix::from_row_slice(2, 2, &[0.1, 0.3, 0.2, x]);
        assert_eq!(rank(&entries(&near(0.6))), Some(elimination::rank(&near(0.6).map(exact))));
        assert_eq!((rank(&entries(&near(2.0 * 0.3))), rank(&entries(&near((2.0_f64 * 0.3).next_up())))), (Some(1), Some(2)));
        // a sum of two numbers that is none
        let sum = rows(&[[[1.0, 2.0_f64.powi(-60)], [1.0, 0.0]], [[1.0, 0.0], [1.0, 0.0]]]);
        assert_eq!(rank(&sum), Some(2));
        assert_eq!((rank(&[]), rank(&[Row::new(&[[0.0, 0.0]; 3])])), (Some(0), Some(0)));
    }

    #[test]
    fn sums_of_rows_with_factors_that_no_number_holds_are_those_of_fractions() {
        let mut state = 5_u64;
        let mut draw = |most: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % most
        };
        for columns in 1..6 {
            // of few numbers, so that many sums depend on each other
            let mut number = || [0.1, -0.3, 0.7, 0.0, 1.0, 3.0][draw(6) as usize];
            let base: Vec<Vec<Entry>> = (0..3).map(|_| (0..columns).map(|_| [number(), 2.0_f64.powi(-60) * number()]).collect()).collect();
            let factors: Vec<[Factor; 3]> = (0..5).map(|_| std::array::from_fn(|_| [number(), number()])).collect();
            let sum = |all: &[Factor; 3]| Row::sum(&std::array::from_fn::<_, 3, _>(|i| (all[i], base[i].as_slice())));
            let exactly = DMatrix::from_fn(5, columns, |i, j| {
                let term = |k: usize| {
                    let [[a, b], [one, other]] = [factors[i][k], base[k][j]];
                    exact(a) * exact(b) * (exact(one) + exact(other))
                };
                (0..3).fold(exact(0.0), |sum: Rational, k| sum + term(k))
            });
            assert_eq!(rank(&factors.iter().map(sum).collect::<Vec<_>>()), Some(elimination::rank(&exactly)), "{exactly}");
        }
        // 0.1 · 0.1 is no number: the rounded product makes another row
        let (unit, ten) = ([[1.0, 0.0], [0.0, 0.0]], [[0.1, 0.0], [0.1, 0.0]]);
        let product = Row::sum(&[([0.1, 0.1], &unit), ([0.1, 0.1], &[[0.0, 0.0], [1.0, 0.0]])]);
        assert_eq!(rank(&[product, Row::sum(&[([0.1, 1.0], &ten)])]), Some(1));
        let rounded = Row::sum(&[([0.1, 0.1], &unit), ([0.1 * 0.1, 1.0], &[[0.0, 0.0], [1.0, 0.0]])]);
        assert_eq!(rank(&[rounded, Row::sum(&[([0.1, 1.0], &ten)])]), Some(2));
        assert_eq!(rank(&[Row::sum(&[([0.0, 0.1], &ten), ([1.0, 1.0], &ten), ([-1.0, 1.0], &ten)])]), Some(0));
    }

    #[test]
    fn a_prime_that_divides_every_minor_does_not_decide() {
        // the minor is the first prime itself: modulo it the rank is one
        let prime = primes().next().unwrap();
        assert_eq!(prime, (1 << 61) - 1, "a prime of Mersenne");
        let [high, low] = [(1_u64 << 61) as f64, -1.0];
        let rows = rows(&[[[high, low], [0.0, 0.0]], [[0.0, 0.0], [1.0, 0.0]]]);
        assert_eq!(independent(&rows, &[0, 1]), [1]);
        assert_eq!(rank(&rows), Some(2));
    }

    #[test]
    fn primes_are_prime() {
        let small = |n: u64| (2..n).take_while(|d| d * d <= n).all(|d| !n.is_multiple_of(d));
        assert!((41..2000).step_by(2).all(|n| is_prime(n) == small(n)));
        assert!(!is_prime(3_215_031_751) && !is_prime((1 << 61) + 1), "a strong pseudoprime to 2, 3, 5 and 7; a multiple of 3");
    }
}
