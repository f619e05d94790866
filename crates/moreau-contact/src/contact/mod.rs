//! A contact: gap, rows of H, friction, restitution; and the Delassus operator of several.

mod components;
pub mod delassus;
pub mod frame;
mod inertia;
mod jacobian;
mod rows;

pub use components::Components;
pub use inertia::{Inertia, Mass};
pub use jacobian::Jacobian;
pub use rows::{BodyRows, Rows};

use crate::memory::spare::{self, spare_entries, spare_shared};

spare_entries![Rows, Contact, ContactImpulse, Option<Place>, [Components; 2]];
spare_shared![Inertia, Jacobian];

/// One contact candidate of a mechanism at a configuration q.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// φ(q) \[m\], positive when separated.
    pub gap: f64,
    /// H of this contact, rows (n), (n, t₁) or (n, t₁, t₂), times the number of velocities.
    pub jacobian: Rows,
    /// μ ≥ 0.
    pub friction: f64,
    /// e ∈ \[0, 1\].
    pub restitution: f64,
    /// Where it is in the world, if the mechanism consists of bodies.
    pub place: Option<Place>,
}

impl Contact {
    /// Which pair touches, e.g. `body 1, feature 0, on the ground`.
    pub fn label(&self) -> String {
        match self.place {
            None => "a contact without place".into(),
            Some(Place { bodies: (first, None), features: [own, _], .. }) => format!("body {first}, feature {own}, on the ground"),
            Some(Place { bodies: (first, Some(second)), features: [own, other], .. }) => {
                format!("body {first}, feature {own}, on body {second}, feature {other}")
            }
        }
    }
}

/// Which two bodies touch, with what, and the contact frame in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Indices of the first and the second body; `None` is the ground.
    pub bodies: (usize, Option<usize>),
    /// Which corners, edges or faces of the two touch: the same candidate has the same numbers in every step.
    pub features: [u32; 2],
    /// n (from the second body to the first), t₁, t₂.
    pub frame: [[f64; 3]; 3],
}

impl Place {
    /// Whether both are the same candidate, perhaps in different steps.
    pub fn is_same(&self, other: &Place) -> bool {
        (self.bodies, self.features) == (other.bodies, other.features)
    }

    /// r_n n + r_t₁ t₁ + r_t₂ t₂, the impulse on the first body \[N·s\].
    pub fn world_impulse(&self, impulse: &[f64]) -> [f64; 3] {
        let part = |axis: usize| impulse.iter().zip(&self.frame).map(|(part, direction)| part * direction[axis]).sum();
        [part(0), part(1), part(2)]
    }
}

/// The two bodies of every contact, if all contacts have a place.
pub fn pairs(places: &[Option<Place>]) -> Option<Vec<[Option<usize>; 2]>> {
    let mut pairs = spare::vector(places.len());
    for place in places {
        let (first, second) = place.as_ref()?.bodies;
        pairs.push([Some(first), second]);
    }
    Some(pairs)
}

/// Which candidate of a mechanism a contact is, wherever in the list it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Identity {
    /// Index into the list it was found in: what tells candidates apart that have no place.
    pub index: usize,
    /// Where it is, as in [`Contact::place`].
    pub place: Option<Place>,
}

impl Identity {
    /// The identity of the contact at this index of a list.
    pub fn of(index: usize, contact: &Contact) -> Self {
        Identity { index, place: contact.place }
    }

    /// Whether both are the same candidate: compared by bodies and features where they are known, by index otherwise.
    pub fn is_same(&self, other: &Identity) -> bool {
        are_same((self.index, self.place.as_ref()), (other.index, other.place.as_ref()))
    }
}

#[inline]
fn are_same((own, place): (usize, Option<&Place>), (other, there): (usize, Option<&Place>)) -> bool {
    match (place, there) {
        (Some(place), Some(there)) => place.is_same(there),
        _ => own == other,
    }
}

/// The impulse of one contact over one step.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactImpulse {
    /// Index into `moreau::mechanics::Mechanism::contacts`.
    pub contact: usize,
    /// (r_n, r_t₁, r_t₂) \[N·s\], as many as the contact has rows.
    pub impulse: Components,
    /// Where it acted, as in [`Contact::place`].
    pub place: Option<Place>,
}

impl ContactImpulse {
    /// Whether the impulse acted at this candidate: compared by features where they are known, by index otherwise.
    pub fn acts_at(&self, contact: usize, place: Option<&Place>) -> bool {
        are_same((self.contact, self.place.as_ref()), (contact, place))
    }
}
