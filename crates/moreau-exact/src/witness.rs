//! Witnesses: what an exact decision was about and what came out, told to whoever collects, so that it can be decided again elsewhere.
//!
//! An exact function wraps its work in [`decided`]. Outside [`collect`] that costs one look at a thread's variable, and nothing is kept.
//! What a decision calls on its way is its own affair: only the outermost decision is told.

use crate::scalar::Rational;
use nalgebra::{DMatrix, DVector};
use std::any::Any;
use std::cell::RefCell;

/// One exact decision with all that is needed to decide it again.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// What was decided.
    pub kind: &'static str,
    /// The data and the answer, by name.
    pub parts: Vec<(&'static str, Part)>,
}

impl Witness {
    /// A witness of this kind with these parts.
    pub fn new(kind: &'static str, parts: Vec<(&'static str, Part)>) -> Self {
        Witness { kind, parts }
    }
}

/// A datum or an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A rational number.
    Number(Rational),
    /// Rational numbers.
    Vector(Vec<Rational>),
    /// Rational numbers, row by row.
    Matrix(Vec<Vec<Rational>>),
    /// A list of vectors.
    Vectors(Vec<Vec<Rational>>),
    /// A number of things, or places in a list.
    Counts(Vec<usize>),
    /// A word.
    Word(&'static str),
}

impl From<&Rational> for Part {
    fn from(number: &Rational) -> Self {
        Part::Number(number.clone())
    }
}

impl From<&[Rational]> for Part {
    fn from(numbers: &[Rational]) -> Self {
        Part::Vector(numbers.to_vec())
    }
}

impl From<bool> for Part {
    fn from(holds: bool) -> Self {
        Part::Word(if holds { "holds" } else { "fails" })
    }
}

impl From<&DMatrix<Rational>> for Part {
    fn from(matrix: &DMatrix<Rational>) -> Self {
        Part::Matrix(matrix.row_iter().map(|row| row.iter().cloned().collect()).collect())
    }
}

impl From<&DVector<Rational>> for Part {
    fn from(vector: &DVector<Rational>) -> Self {
        Part::Vector(vector.iter().cloned().collect())
    }
}

#[derive(Default)]
struct Collector {
    depth: usize,
    kept: Option<Vec<Witness>>,
}

thread_local! {
    static COLLECTOR: RefCell<Collector> = RefCell::default();
}

/// Runs something and keeps the witnesses of the exact decisions that it makes on this thread.
pub fn collect<R>(run: impl FnOnce() -> R) -> (R, Vec<Witness>) {
    let outer = COLLECTOR.with_borrow_mut(|collector| std::mem::replace(collector, Collector { depth: 0, kept: Some(Vec::new()) }));
    let result = run();
    let inner = COLLECTOR.with_borrow_mut(|collector| std::mem::replace(collector, outer));
    (result, inner.kept.unwrap_or_default())
}

/// Runs a decision; if somebody collects and no other decision asked for it, its witness is kept.
pub fn decided<R>(decide: impl FnOnce() -> R, witness: impl FnOnce(&R) -> Option<Witness>) -> R {
    if !COLLECTOR.with_borrow(|collector| collector.kept.is_some()) {
        return decide();
    }
    COLLECTOR.with_borrow_mut(|collector| collector.depth += 1);
    let result = decide();
    let outermost = COLLECTOR.with_borrow_mut(|collector| {
        collector.depth -= 1;
        collector.depth == 0
    });
    if let Some(witness) = outermost.then(|| witness(&result)).flatten() {
        COLLECTOR.with_borrow_mut(|collector| collector.kept.as_mut().expect("it collects").push(witness));
    }
    result
}

/// The value as one in rationals, if it is one.
pub fn rational<V: Any, R: Any>(value: &V) -> Option<&R> {
    (value as &dyn Any).downcast_ref()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::ratio;

    fn say(kind: &'static str) -> Witness {
        Witness { kind, parts: vec![("x", Part::Number(ratio(1, 2)))] }
    }

    #[test]
    fn only_the_outermost_decision_is_kept_and_only_while_somebody_collects() {
        let decision = || decided(|| decided(|| 1, |_| Some(say("inner"))) + 1, |_| Some(say("outer")));
        assert_eq!(decision(), 2);
        assert_eq!(collect(decision), (2, vec![say("outer")]));
        assert_eq!(collect(|| 5), (5, vec![]));
    }

    #[test]
    fn collections_nest() {
        let inner = || decided(|| (), |_| Some(say("inner")));
        let (((), inside), outside) = collect(|| collect(inner));
        assert_eq!((inside.len(), outside.len()), (1, 0));
    }

    #[test]
    fn a_decision_without_a_witness_is_not_kept() {
        assert_eq!(collect(|| decided(|| 3, |_| None)), (3, vec![]));
    }
}
