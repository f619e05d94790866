//! The performance profile of Dolan and Moré.
//!
//! ```text
//!     ρ_s(τ) = #{ p : c_ps ≤ τ min_s c_ps } / #{ p }         c_ps  what the answer of solver s to problem p costs, ∞ where it has none
//! ```
//!
//! # Source
//! Dolan & Moré, Benchmarking optimization software with performance profiles, Mathematical Programming 91 (2002).

/// What an answer costs, ∞ where there is none, beside the least cost of any solver at that problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Of this solver.
    pub own: f64,
    /// Of the best.
    pub least: f64,
}

/// ρ(τ): the part of the problems that is answered at no more than τ times the least cost; none of none is 0.
pub fn within(factor: f64, costs: &[Cost]) -> f64 {
    let near = costs.iter().filter(|cost| cost.own.is_finite() && cost.own <= factor * cost.least).count();
    near as f64 / costs.len().max(1) as f64
}

/// Where ρ rises, with its value there: every τ at which another problem comes in, from 1.
pub fn rises(costs: &[Cost]) -> Vec<[f64; 2]> {
    let mut factors: Vec<f64> = costs.iter().map(|cost| cost.own / cost.least).filter(|factor| factor.is_finite()).collect();
    factors.push(1.0);
    factors.sort_by(f64::total_cmp);
    factors.dedup();
    // the quotient may round below what its own cost asks for
    factors.into_iter().map(|factor| [factor, within(factor * (1.0 + f64::EPSILON), costs)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const COSTS: [Cost; 4] = [
        Cost { own: 3.0, least: 3.0 },
        Cost { own: 12.0, least: 4.0 },
        Cost { own: f64::INFINITY, least: 5.0 },
        Cost { own: f64::INFINITY, least: f64::INFINITY },
    ];

    #[test]
    fn a_problem_without_an_answer_is_within_no_factor() {
        assert_eq!([1.0, 2.9, 3.0, 1e9].map(|factor| within(factor, &COSTS)), [0.25, 0.25, 0.5, 0.5]);
        assert_eq!(within(1.0, &[]), 0.0);
    }

    #[test]
    fn it_rises_where_a_problem_comes_in() {
        assert_eq!(rises(&COSTS), [[1.0, 0.25], [3.0, 0.5]]);
        // 1/3 and 7/3 round: their problems come in all the same
        let thirds = [Cost { own: 7.0, least: 3.0 }, Cost { own: 49.0, least: 3.0 }];
        assert_eq!(rises(&thirds).last().map(|[_, part]| *part), Some(1.0));
        assert_eq!(rises(&thirds)[0], [1.0, 0.0], "never the best");
    }
}
