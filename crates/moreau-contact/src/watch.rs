//! A running solver as its caller sees it: the residuals it has passed, and an early end.
//!
//! Iterations measure how good they are by the certificate's own residual; each such number is noted here, in order, whichever solver of a
//! chain measured it. When the caller interrupts, an iteration ends at its next look and gives the best it has: where that is depends on
//! the machine, so that such an answer is not reproducible. Sweeps look at each contact or each block of them, for where many contacts
//! share a body one sweep takes minutes. No clock is read here.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A word to end, given from any thread; a clone is the same one.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Ends what watches this word.
    pub fn now(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was given.
    pub fn is_given(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What was seen of a solver.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// The largest relative residual of a contact, look by look.
    pub history: Vec<f64>,
    /// Whether an iteration was ended early.
    pub interrupted: bool,
}

struct Watch {
    interrupt: Interrupt,
    seen: Seen,
}

thread_local! {
    static WATCH: RefCell<Option<Watch>> = const { RefCell::new(None) };
}

/// Runs `solve` on this thread, with what was seen of it; of watches within watches the inner one sees.
/// ```
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::prelude::*;
/// use moreau_contact::solvers::watch::{Interrupt, watched};
///
/// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
/// let (answer, seen) = watched(&Interrupt::default(), || Auto.solve(&block, None));
/// assert_eq!(answer?.impulse, dvector![1.0, -0.5]);
/// assert!(!seen.interrupted && seen.history.last() <= seen.history.first());
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn watched<T>(interrupt: &Interrupt, solve: impl FnOnce() -> T) -> (T, Seen) {
    let watch = Watch { interrupt: interrupt.clone(), seen: Seen::default() };
    let outer = WATCH.replace(Some(watch));
    let result = solve();
    let watch = WATCH.replace(outer);
    (result, watch.map_or_else(Seen::default, |watch| watch.seen))
}

/// Notes a residual.
pub(crate) fn note(relative: f64) {
    WATCH.with_borrow_mut(|watch| {
        if let Some(watch) = watch {
            watch.seen.history.push(relative);
        }
    });
}

/// Runs `solve` on another problem than the one that is watched, whose residuals are not noted; an interrupt ends it all the same.
/// ```
/// use moreau_contact::solvers::watch::{Interrupt, is_over, unnoted, watched};
///
/// let interrupt = Interrupt::default();
/// interrupt.now();
/// let (found, seen) = watched(&interrupt, || unnoted(is_over));
/// assert!(found && seen.interrupted && seen.history.is_empty());
/// ```
pub fn unnoted<T>(solve: impl FnOnce() -> T) -> T {
    let length = || WATCH.with_borrow(|watch| watch.as_ref().map_or(0, |watch| watch.seen.history.len()));
    let before = length();
    let result = solve();
    WATCH.with_borrow_mut(|watch| watch.iter_mut().for_each(|watch| watch.seen.history.truncate(before)));
    result
}

/// Whether the iteration that asks should end now. It costs next to nothing, so that a sweep may ask at each contact.
/// ```
/// use moreau_contact::solvers::watch::{Interrupt, is_over, watched};
///
/// let interrupt = Interrupt::default();
/// let (found, _) = watched(&interrupt, || (is_over(), interrupt.now(), is_over()));
/// assert_eq!((found.0, found.2), (false, true));
/// assert!(!is_over(), "nobody watches");
/// ```
pub fn is_over() -> bool {
    #[cfg(test)]
    tests::count_down();
    WATCH.with_borrow_mut(|watch| {
        watch.as_mut().is_some_and(|watch| {
            let given = watch.interrupt.is_given();
            watch.seen.interrupted |= given;
            given
        })
    })
}

/// Runs `work` whose end nobody may hasten: it tells something of the problem, which the time must not decide.
pub(crate) fn unwatched<T>(work: impl FnOnce() -> T) -> T {
    let watch = WATCH.replace(None);
    let result = work();
    WATCH.replace(watch);
    result
}

/// Whether an iteration that is watched was told to end, so that what it gives is not what another run need find.
/// ```
/// use moreau_contact::solvers::watch::{Interrupt, is_over, was_over, watched};
///
/// let interrupt = Interrupt::default();
/// interrupt.now();
/// assert_eq!(watched(&interrupt, || (was_over(), is_over(), was_over())).0, (false, true, true), "nobody had asked at first");
/// assert!(!was_over(), "nobody watches");
/// ```
pub fn was_over() -> bool {
    WATCH.with_borrow(|watch| watch.as_ref().is_some_and(|watch| watch.seen.interrupted))
}

#[cfg(test)]
pub(crate) use tests::watched_until;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{ContactProblem, Law};
    use crate::solvers::{AlternatingDirections, ContactSolver};
    use nalgebra::{DMatrix, DVector};

    thread_local! {
        static ASKS: std::cell::Cell<usize> = const { std::cell::Cell::new(usize::MAX) };
    }

    /// Gives the word when it was asked for often enough.
    pub(crate) fn count_down() {
        let left = ASKS.get();
        ASKS.set(left.saturating_sub(usize::from(left != usize::MAX)));
        if left == 0 {
            WATCH.with_borrow(|watch| watch.iter().for_each(|watch| watch.interrupt.now()));
        }
    }

    /// [`watched`], with the word given at the asking after `asks` others.
    pub(in super::super) fn watched_until<T>(asks: usize, solve: impl FnOnce() -> T) -> (T, Seen) {
        ASKS.set(asks);
        let found = watched(&Interrupt::default(), solve);
        ASKS.set(usize::MAX);
        found
    }

    fn block() -> ContactProblem {
        ContactProblem::new(DMatrix::identity(2, 2), DVector::from_vec(vec![-0.8, 0.6]))
            .law(Law::Associated)
            .rows_per_contact(2)
            .friction(vec![0.5])
            .build()
            .unwrap()
    }

    #[test]
    fn the_history_falls_to_the_tolerance_and_is_empty_where_nobody_watches() {
        let solver = AlternatingDirections::default();
        let (answer, seen) = watched(&Interrupt::default(), || solver.solve(&block(), None));
        assert!(seen.history.len() > 2 && *seen.history.last().unwrap() <= solver.tolerance, "{:?}", seen.history);
        assert_eq!(answer.unwrap(), solver.solve(&block(), None).unwrap(), "watching changes no bit");
        assert_eq!(watched(&Interrupt::default(), || ()).1, Seen::default());
    }

    #[test]
    fn the_residuals_of_another_problem_are_not_noted() {
        let (_, seen) = watched(&Interrupt::default(), || {
            note(0.5);
            unnoted(|| AlternatingDirections::default().solve(&block(), None).unwrap());
            note(0.25);
        });
        assert_eq!(seen.history, [0.5, 0.25]);
    }

    #[test]
    fn sweeps_and_clarabel_end_at_once_where_the_word_is_given() {
        use crate::solvers::{ProjectedGaussSeidel, ProjectedOverRelaxation};
        let solvers: Vec<Box<dyn ContactSolver>> = vec![
            Box::new(ProjectedGaussSeidel::default()),
            Box::new(ProjectedOverRelaxation::default()),
            #[cfg(feature = "clarabel")]
            Box::new(crate::solvers::ClarabelPolished),
        ];
        for solver in solvers {
            let interrupt = Interrupt::default();
            interrupt.now();
            let (answer, seen) = watched(&interrupt, || solver.solve(&block(), None));
            let iterations = answer.unwrap().iterations;
            assert!(seen.interrupted && iterations <= 1, "{}: {iterations}", solver.name());
        }
    }

    #[test]
    fn an_interrupted_iteration_ends_at_its_next_look_and_says_so() {
        let interrupt = Interrupt::default();
        interrupt.now();
        let (answer, seen) = watched(&interrupt, || AlternatingDirections::default().solve(&block(), None));
        assert_eq!((answer.unwrap().iterations, seen.history.len(), seen.interrupted), (0, 1, true));
    }
}
