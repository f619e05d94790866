//! A piece of the set of all r and y that obey the law: one case per contact, and an arc of directions where it slides.
//!
//! ```text
//!     open      r = 0 ,  y_n ≥ 0                      sticking   y = 0 ,  μ r_n ≥ ‖r_t‖
//!     pressing  r = (p, 0) ,  y_n = 0                 sliding    r = p (1, −μ d) ,  y = (0, s d) ,  p, s ≥ 0 ,  d in an arc
//! ```

use super::arc::{Arc, Direction};
use crate::certificate::forward::{independent_rows, uncertainty};
use crate::certificate::interval::Interval;
use crate::problem::ContactProblem;
use nalgebra::DMatrix;

/// What one contact may do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Doing {
    Open,
    Pressing,
    Sticking,
    Sliding(Arc),
}

impl Doing {
    /// Rows of y that vanish whatever the direction is.
    pub fn held(self) -> usize {
        match self {
            Doing::Open => 0,
            Doing::Pressing | Doing::Sliding(_) => 1,
            Doing::Sticking => 3,
        }
    }

    pub fn arc(self) -> Option<Arc> {
        if let Doing::Sliding(arc) = self { Some(arc) } else { None }
    }
}

/// The problem in intervals: W around the stored one and, where they are known, around H M̂⁻¹ Hᵀ.
pub(super) struct Data<'a> {
    pub problem: &'a ContactProblem,
    pub w: DMatrix<Interval>,
    /// u_free + shift.
    pub free: Vec<Interval>,
}

impl<'a> Data<'a> {
    pub fn new(problem: &'a ContactProblem) -> Self {
        let (rows, unsure) = (problem.rows(), uncertainty(problem));
        let entry = |i: usize, j: usize| Interval::ball(problem.entry(i, j), unsure.as_ref().map_or(0.0, |radius| radius[(i, j)]));
        let free = |row: usize| Interval::point(problem.free_velocity()[row]) + Interval::point(problem.shift()[row]);
        Data { problem, w: DMatrix::from_fn(rows, rows, entry), free: (0..rows).map(free).collect() }
    }

    pub fn friction(&self, k: usize) -> f64 {
        self.problem.friction()[k]
    }

    /// W r in one row, for r = p (n, t) of contact k.
    pub fn moved(&self, row: usize, k: usize, normal: Interval, tangential: Direction) -> Interval {
        self.w[(row, 3 * k)] * normal + self.w[(row, 3 * k + 1)] * tangential[0] + self.w[(row, 3 * k + 2)] * tangential[1]
    }
}

/// The rows of a pattern: which impulses are unknown one by one, and which contacts slide.
pub(super) struct Rows {
    /// Rows with an impulse of their own and y = 0, independent of each other.
    pub free: Vec<usize>,
    /// Whether those are all rows that stick or press.
    pub is_all: bool,
    pub sliding: Vec<usize>,
}

impl Rows {
    /// The rows of a pattern; none if it is not decided which of them are independent.
    pub fn new(problem: &ContactProblem, pattern: &[Doing]) -> Option<Self> {
        let own = |k: usize| if pattern[k].arc().is_some() { 0 } else { pattern[k].held() };
        let all: Vec<usize> = (0..pattern.len()).flat_map(|k| 3 * k..3 * k + own(k)).collect();
        let free = independent_rows(problem, &all)?;
        let sliding = (0..pattern.len()).filter(|k| pattern[*k].arc().is_some()).collect();
        Some(Rows { is_all: free.len() == all.len(), free, sliding })
    }

    /// Rows of the linear equations y = 0.
    pub fn equations(&self) -> Vec<usize> {
        self.free.iter().copied().chain(self.sliding.iter().map(|k| 3 * k)).collect()
    }
}

/// −x.
pub(super) fn opposite(x: Direction) -> Direction {
    [-x[0], -x[1]]
}

/// a x.
pub(super) fn scaled(a: Interval, x: Direction) -> Direction {
    [a * x[0], a * x[1]]
}

/// x turned by a quarter.
pub(super) fn turned(x: Direction) -> Direction {
    [-x[1], x[0]]
}
