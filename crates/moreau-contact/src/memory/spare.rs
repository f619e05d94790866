//! Spare memory: what a step of a simulation held is left to the next one, so that it need not ask for memory again.
//!
//! What is taken is empty, and whoever takes it fills it: nothing of its last use is seen, and no number depends on where memory comes
//! from. Each thread has its own, without locks, and of each kind of entry it keeps no more than [`SPARE_VECTORS`] vectors and
//! [`SPARE_BYTES`] in all, so that the memory of a large problem is not kept for ever. Vectors that nobody leaves are freed as any.

use crate::tolerance::limits::{SPARE_BYTES, SPARE_ROOM, SPARE_VECTORS};
use nalgebra::DVector;
use std::cell::RefCell;
use std::fmt::{Debug, Formatter, Result};
use std::ops::{Deref, DerefMut};
use std::sync::Arc;
use std::thread::LocalKey;

/// What can be left: a vector, a column of numbers, a text.
pub trait Spare: Sized {
    /// One without memory.
    fn nothing() -> Self;
    /// A copy in spare memory.
    fn copied(&self) -> Self;
    /// Leaves its memory to the thread.
    fn leave(self);
}

/// The entries of vectors whose memory is kept.
pub trait Entry: Sized + 'static {
    /// The spare vectors of this thread.
    fn shelf() -> &'static LocalKey<RefCell<Shelf<Self>>>;
}

/// How many powers of two a capacity can be.
const SIZES: usize = usize::BITS as usize;

/// Empty vectors, to be used again.
#[derive(Debug)]
pub struct Shelf<T> {
    /// Those with room for 2ᵏ entries and less than twice as many.
    sizes: [Vec<Vec<T>>; SIZES],
    count: usize,
    bytes: usize,
}

impl<T> Shelf<T> {
    /// One without any.
    pub const fn new() -> Self {
        Shelf { sizes: [const { Vec::new() }; SIZES], count: 0, bytes: 0 }
    }

    /// A vector of the smallest size with so much room, unless it has far more: whoever keeps an answer to a small problem would keep it.
    fn take(&mut self, room: usize) -> Option<Vec<T>> {
        let enough = room.checked_next_power_of_two()?.ilog2() as usize;
        let most = (enough + SPARE_ROOM.ilog2() as usize).min(SIZES - 1);
        (enough..=most).find(|size| !self.sizes[*size].is_empty()).and_then(|size| self.remove(size))
    }

    fn remove(&mut self, size: usize) -> Option<Vec<T>> {
        let vector = self.sizes[size].pop()?;
        self.count -= 1;
        self.bytes -= vector.capacity() * size_of::<T>();
        Some(vector)
    }

    /// Keeps an empty vector, in place of a smaller one where there are many.
    fn keep(&mut self, vector: Vec<T>) {
        let bytes = vector.capacity() * size_of::<T>();
        if bytes == 0 || self.bytes + bytes > SPARE_BYTES {
            return;
        }
        let size = vector.capacity().ilog2() as usize;
        if self.count == SPARE_VECTORS {
            let Some(smaller) = (0..size).find(|size| !self.sizes[*size].is_empty()) else { return };
            self.remove(smaller);
        }
        self.count += 1;
        self.bytes += bytes;
        self.sizes[size].push(vector);
    }
}

impl<T> Default for Shelf<T> {
    fn default() -> Self {
        Shelf::new()
    }
}

/// An empty vector with room for so many entries; where no spare one is large enough new memory is asked for, and so that fewer sizes are
/// kept for up to twice as many entries.
pub fn vector<T: Entry>(room: usize) -> Vec<T> {
    if room == 0 {
        return Vec::new();
    }
    let spare = T::shelf().try_with(|shelf| shelf.borrow_mut().take(room)).ok().flatten();
    let is_kept = room.saturating_mul(size_of::<T>()) <= SPARE_BYTES;
    spare.unwrap_or_else(|| Vec::with_capacity(if is_kept { room.next_power_of_two() } else { room }))
}

/// A vector of these entries, with room for `most` of them.
pub fn collected<T: Entry>(most: usize, entries: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut collected = vector(most);
    collected.extend(entries);
    collected
}

/// The same entry so many times.
pub fn repeated<T: Entry + Clone>(count: usize, entry: T) -> Vec<T> {
    let mut repeated = vector(count);
    repeated.resize(count, entry);
    repeated
}

/// So many zeros.
pub fn zeros(size: usize) -> DVector<f64> {
    repeated(size, 0.0).into()
}

/// A column of these numbers.
pub fn column(numbers: &[f64]) -> DVector<f64> {
    let mut column = vector(numbers.len());
    column.extend_from_slice(numbers);
    column.into()
}

/// This text.
pub fn text(text: &str) -> String {
    let mut made = empty_text(text.len());
    made.push_str(text);
    made
}

/// A text with room for so many bytes, to be written.
pub fn empty_text(room: usize) -> String {
    // what is empty is UTF-8
    String::from_utf8(vector(room)).unwrap_or_default()
}

impl<T: Entry + Clone> Spare for Vec<T> {
    fn nothing() -> Self {
        Vec::new()
    }

    fn copied(&self) -> Self {
        let mut copy = vector(self.len());
        copy.extend_from_slice(self);
        copy
    }

    fn leave(mut self) {
        // the entries may leave memory of their own, before the shelf is borrowed
        self.clear();
        // at the end of a thread there may be nothing left to leave it to
        let _ = T::shelf().try_with(|shelf| shelf.borrow_mut().keep(self));
    }
}

impl Spare for DVector<f64> {
    fn nothing() -> Self {
        DVector::from_vec(Vec::new())
    }

    fn copied(&self) -> Self {
        column(self.as_slice())
    }

    fn leave(self) {
        Vec::from(self.data).leave();
    }
}

impl Spare for String {
    fn nothing() -> Self {
        String::new()
    }

    fn copied(&self) -> Self {
        text(self)
    }

    fn leave(self) {
        self.into_bytes().leave();
    }
}

/// What leaves its memory at its end, wherever that is.
#[derive(PartialEq)]
pub struct Lent<S: Spare>(S);

impl<S: Spare> Lent<S> {
    /// The value itself, which leaves nothing.
    pub fn into_inner(mut self) -> S {
        std::mem::replace(&mut self.0, S::nothing())
    }
}

impl<T: Entry + Clone> Lent<Vec<T>> {
    /// Forgets the entries and has room for so many.
    pub fn make_room(&mut self, room: usize) {
        self.0.clear();
        if self.0.capacity() < room {
            *self = vector(room).into();
        }
    }
}

impl<S: Spare> Drop for Lent<S> {
    fn drop(&mut self) {
        std::mem::replace(&mut self.0, S::nothing()).leave();
    }
}

impl<S: Spare + Debug> Debug for Lent<S> {
    fn fmt(&self, formatter: &mut Formatter) -> Result {
        self.0.fmt(formatter)
    }
}

impl<S: Spare> Default for Lent<S> {
    fn default() -> Self {
        Lent(S::nothing())
    }
}

impl<S: Spare> Clone for Lent<S> {
    fn clone(&self) -> Self {
        Lent(self.0.copied())
    }
}

impl<S: Spare> From<S> for Lent<S> {
    fn from(own: S) -> Self {
        Lent(own)
    }
}

impl<S: Spare> Deref for Lent<S> {
    type Target = S;

    fn deref(&self) -> &S {
        &self.0
    }
}

impl<S: Spare> DerefMut for Lent<S> {
    fn deref_mut(&mut self) -> &mut S {
        &mut self.0
    }
}

/// What several hold together, in memory that is used again.
pub trait Shared: Default + 'static {
    /// The spare ones of this thread.
    fn shelf() -> &'static LocalKey<RefCell<Vec<Arc<Self>>>>;
}

/// A value for several to hold.
pub fn shared<T: Shared>(value: T) -> Arc<T> {
    let mut spare = T::shelf().try_with(|shelf| shelf.borrow_mut().pop()).ok().flatten();
    match spare.as_mut().and_then(Arc::get_mut) {
        Some(place) => *place = value,
        None => spare = Some(Arc::new(value)),
    }
    spare.expect("it was there or was made")
}

/// Leaves the memory of a value that nobody else holds.
pub fn leave_shared<T: Shared>(mut value: Arc<T>) {
    let Some(place) = Arc::get_mut(&mut value) else { return };
    *place = T::default();
    let _ = T::shelf().try_with(|shelf| {
        let mut shelf = shelf.borrow_mut();
        if shelf.len() < SPARE_VECTORS {
            shelf.push(value);
        }
    });
}

/// Gives a thread shelves for vectors of these entries.
macro_rules! spare_entries {
    ($($entry:ty),* $(,)?) => {
        $(impl crate::memory::spare::Entry for $entry {
            fn shelf() -> &'static std::thread::LocalKey<std::cell::RefCell<crate::memory::spare::Shelf<Self>>> {
                std::thread_local! {
                    static SHELF: std::cell::RefCell<crate::memory::spare::Shelf<$entry>> =
                        const { std::cell::RefCell::new(crate::memory::spare::Shelf::new()) };
                }
                &SHELF
            }
        })*
    };
}

/// Gives a thread a shelf for shared values.
macro_rules! spare_shared {
    ($($value:ty),*) => {
        $(impl crate::memory::spare::Shared for $value {
            fn shelf() -> &'static std::thread::LocalKey<std::cell::RefCell<Vec<std::sync::Arc<Self>>>> {
                std::thread_local! {
                    static SHELF: std::cell::RefCell<Vec<std::sync::Arc<$value>>> =
                        const { std::cell::RefCell::new(Vec::new()) };
                }
                &SHELF
            }
        })*
    };
}

pub(crate) use {spare_entries, spare_shared};

spare_entries![f64, usize, u8, [f64; 2], [bool; 2], (usize, usize), (usize, [usize; 2]), [Option<usize>; 2]];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Jacobian, Rows};

    /// A thread that nobody has left anything yet.
    fn in_a_new_thread(test: fn()) {
        std::thread::spawn(test).join().expect("the test holds");
    }

    #[test]
    fn what_is_taken_is_empty_and_its_memory_is_that_of_the_smallest_that_fits() {
        in_a_new_thread(|| {
            let [small, large] = [3, 9].map(|size| repeated(size, 7.0));
            let [at_small, at_large] = [&small, &large].map(|vector| vector.as_ptr());
            large.leave();
            small.leave();
            let zeros = zeros(3);
            assert_eq!((zeros.as_slice(), zeros.as_ptr()), (&[0.0; 3][..], at_small));
            let other: Vec<f64> = vector(3);
            assert_eq!((other.len(), other.as_ptr()), (0, at_large));
            zeros.leave();
            let huge: Vec<f64> = Vec::with_capacity(300);
            let at_huge = huge.as_ptr();
            huge.leave();
            let held: Vec<Vec<f64>> = (0..3).map(|_| vector(3)).collect();
            assert!(held.iter().all(|vector| vector.capacity() <= 4 * SPARE_ROOM), "a small answer holds no large memory");
            let wide: Vec<f64> = vector(256);
            assert_eq!(wide.as_ptr(), at_huge);
            assert_eq!(column(&[1.0, 2.0]).as_slice(), [1.0, 2.0]);
            assert_eq!((text("a").copied(), empty_text(9)), ("a".into(), String::new()));
        });
    }

    #[test]
    fn a_thread_keeps_no_more_than_its_limits() {
        in_a_new_thread(|| {
            let kept = || f64::shelf().with_borrow(|shelf| (shelf.count, shelf.bytes));
            Vec::<f64>::with_capacity(SPARE_BYTES / 8 + 1).leave();
            assert_eq!(kept(), (0, 0));
            (1..SPARE_VECTORS + 8).for_each(|room| Vec::<f64>::with_capacity(room).leave());
            // the seven smallest made place for the others
            let entries: usize = (8..SPARE_VECTORS + 8).sum();
            assert_eq!(kept(), (SPARE_VECTORS, 8 * entries));
            Vec::<f64>::with_capacity(1).leave();
            assert_eq!(kept(), (SPARE_VECTORS, 8 * entries));
        });
    }

    #[test]
    fn what_is_lent_leaves_its_memory_and_what_is_taken_out_does_not() {
        in_a_new_thread(|| {
            let kept = || usize::shelf().with_borrow(|shelf| shelf.count);
            let lent: Lent<Vec<usize>> = vec![1, 2, 3].into();
            let copy = lent.clone();
            assert_eq!((&copy, copy.clone().into_inner()), (&lent, vec![1, 2, 3]));
            drop((lent, copy));
            assert_eq!(kept(), 2);
        });
    }

    #[test]
    fn a_shared_value_is_made_anew_in_the_memory_of_one_that_nobody_holds() {
        in_a_new_thread(|| {
            let first = shared(Jacobian::new(1, 2, vec![Rows::zeros(1, 2)]));
            let (place, held) = (Arc::as_ptr(&first), first.clone());
            leave_shared(first);
            let second = shared(Jacobian::new(3, 4, Vec::new()));
            assert_ne!(Arc::as_ptr(&second), place, "somebody holds the first one");
            leave_shared(held);
            let third = shared(Jacobian::new(5, 6, Vec::new()));
            assert_eq!((Arc::as_ptr(&third), third.ncols(), third.nrows()), (place, 6, 0));
        });
    }
}
