//! What a contact does, and the equations of that: value and slopes, written by `pattern` and `polygon`, solved by `krawczyk`.

use crate::certificate::interval::Interval;

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

/// What a contact is taken to do, under a polyhedral law with the place of its impulse on the cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Case {
    Is(ContactState),
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
            Case::Edge(_) | Case::Side(_) => ContactState::Sliding,
        }
    }
}

/// Interval blocks of one contact: value and derivatives of its equations, by r, by y, and by z = r − ρ y.
pub(super) struct Equations {
    pub value: [Interval; 3],
    pub by_impulse: [[Interval; 3]; 3],
    pub by_velocity: [[Interval; 3]; 3],
    pub by_pushed: [[Interval; 3]; 3],
}
