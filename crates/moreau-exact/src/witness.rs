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

/// Puts back what was collected before, also when what runs panics.
struct Outer(Option<Collector>);

impl Drop for Outer {
    fn drop(&mut self) {
        if let Some(outer) = self.0.take() {
            COLLECTOR.set(outer);
        }
    }
}

/// Runs something and keeps the witnesses of the exact decisions that it makes on this thread.
///
/// ```
/// use moreau_exact::witness::{Witness, collect, decided};
///
/// let decide = || decided(|| 6 * 7, |found| Some(Witness::new("product", vec![("is-even", (found % 2 == 0).into())])));
/// let (answer, witnesses) = collect(decide);
/// assert_eq!((answer, witnesses.len()), (42, 1));
/// ```
pub fn collect<R>(run: impl FnOnce() -> R) -> (R, Vec<Witness>) {
    let mut outer = Outer(Some(COLLECTOR.replace(Collector { depth: 0, kept: Some(Vec::new()) })));
    let result = run();
    let inner = COLLECTOR.replace(outer.0.take().unwrap_or_default());
    (result, inner.kept.unwrap_or_default())
}

/// One decision more that is under way, until it ends or panics.
struct Within;

impl Within {
    fn enter() -> Self {
        COLLECTOR.with_borrow_mut(|collector| collector.depth += 1);
        Within
    }
}

impl Drop for Within {
    fn drop(&mut self) {
        COLLECTOR.with_borrow_mut(|collector| collector.depth -= 1);
    }
}

/// Runs a decision; if somebody collects and no other decision asked for it, its witness is kept.
pub fn decided<R>(decide: impl FnOnce() -> R, witness: impl FnOnce(&R) -> Option<Witness>) -> R {
    if !COLLECTOR.with_borrow(|collector| collector.kept.is_some()) {
        return decide();
    }
    let within = Within::enter();
    let result = decide();
    drop(within);
    let outermost = COLLECTOR.with_borrow(|collector| collector.depth == 0);
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
    fn a_panic_leaves_the_next_collection_and_the_one_around_it_whole() {
        let panicking = || std::panic::catch_unwind(|| collect(|| decided(|| panic!("on purpose"), |(): &()| None))).is_err();
        let decision = || decided(|| (), |_| Some(say("one")));
        assert!(panicking());
        assert!(COLLECTOR.with_borrow(|collector| collector.kept.is_none()), "nobody collects");
        let (failed, around) = collect(|| {
            let failed = panicking() && std::panic::catch_unwind(|| decided(|| panic!("on purpose"), |(): &()| None)).is_err();
            decision();
            failed
        });
        assert_eq!((failed, around), (true, vec![say("one")]));
    }

    #[test]
    fn a_decision_without_a_witness_is_not_kept() {
        assert_eq!(collect(|| decided(|| 3, |_| None)), (3, vec![]));
    }
}
