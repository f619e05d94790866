//! What a contact does, and the equations of that: value and slopes, written by `pattern` and `polygon`, solved by `krawczyk`.

use crate::certificate::interval::Interval;
use crate::certificate::rank::Factor;

/// What a contact does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactState {
    /// No impulse.
    Open,
    /// An impulse along the normal and no friction.
    Pressing,
    /// No velocity.
    Sticking,
    /// Friction on the boundary of the cone against the slip.
    Sliding,
    /// On the border between two of these.
    Undecided,
    /// A bilateral constraint: any impulse, and no velocity.
    Joined,
}

/// What a contact is taken to do, in the plane with the way it slides, under a polyhedral law with the place of its impulse on the cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Case {
    Is(ContactState),
    /// Sliding in the plane, forth, y_t ≥ 0, or back.
    Forth(bool),
    /// On edge j of the cone.
    Edge(usize),
    /// Between edges j and j + 1.
    Side(usize),
}

impl Case {
    /// In the words of every law.
    pub fn state(self) -> ContactState {
        match self {
            Case::Is(state) => state,
            Case::Forth(_) | Case::Edge(_) | Case::Side(_) => ContactState::Sliding,
        }
    }
}

/// An equation Σ c y_i = 0 of one contact, linear in the impulses: where it follows from those of others, one impulse may be given in its
/// place.
pub(super) struct Linear {
    /// c and i.
    pub terms: Vec<(Factor, usize)>,
    /// Its place among the equations of the contact.
    pub equation: usize,
    /// The row of the impulse that is given.
    pub given: usize,
}

impl Linear {
    /// y_i = 0.
    pub fn row(i: usize) -> Self {
        Linear { terms: vec![([1.0, 1.0], i)], equation: i, given: i }
    }
}

/// Interval blocks of one contact: value and derivatives of its equations, by r, by y, and by z = r − ρ y.
pub(super) struct Equations {
    pub value: [Interval; 3],
    pub by_impulse: [[Interval; 3]; 3],
    pub by_velocity: [[Interval; 3]; 3],
    pub by_pushed: [[Interval; 3]; 3],
}
