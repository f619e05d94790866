//! What is computed of a problem once, when something asks for it first.

use std::sync::OnceLock;

/// A value that follows from the problem and is no part of it: problems are compared without it.
#[derive(Clone, Debug, Default)]
pub(super) struct Once<T>(OnceLock<T>);

impl<T> Once<T> {
    /// A value that is known.
    pub fn known(value: T) -> Self {
        Once(OnceLock::from(value))
    }

    /// The value, if it is known.
    pub fn get(&self) -> Option<&T> {
        self.0.get()
    }

    /// The value, made now if it is not known.
    pub fn get_or(&self, make: impl FnOnce() -> T) -> &T {
        self.0.get_or_init(make)
    }
}

impl<T> PartialEq for Once<T> {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}
