//! What forms with mistakes are made of.

use crate::planted::{Kind, Planted};
use moreau_exact::scalar::{Rational, ratio};

/// A closed form with one mistake.
pub(super) const fn wrong<S>(name: &'static str, mistake: &'static str, subject: S) -> Planted<S> {
    Planted { name, mistake, kind: Kind::ClosedForm, subject }
}

/// A whole number.
pub(super) fn whole(number: i64) -> Rational {
    ratio(number, 1)
}
