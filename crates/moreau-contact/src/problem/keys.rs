//! Which contact is which, when the list of contacts changes from one step to the next.
//!
//! A key names the two bodies of a contact, the first of them the one that the normal pushes, and which features of the two touch. A
//! contact of the same key is the same contact, wherever in a list it stands.

use crate::contact::Place;
use moreau_exact::{Error, Result};
use std::collections::{HashMap, HashSet};

/// The name of a contact that outlives its place in a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ContactKey {
    /// The two bodies by number, the ground as `None`.
    pub bodies: [Option<usize>; 2],
    /// Which corners, edges or faces of the two touch.
    pub features: [u32; 2],
}

impl From<&Place> for ContactKey {
    fn from(place: &Place) -> Self {
        ContactKey { bodies: [Some(place.bodies.0), place.bodies.1], features: place.features }
    }
}

impl ContactKey {
    /// The keys of contacts at these places, if every one has a place and the keys tell them apart.
    /// ```
    /// use moreau_contact::contact::Place;
    /// use moreau_contact::problem::ContactKey;
    ///
    /// let frame = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// let corner = |number| Some(Place { bodies: (2, None), features: [number, 0], frame });
    /// let keys = ContactKey::of_places(&[corner(4), corner(5)]).expect("two corners");
    /// assert_eq!(keys[1], ContactKey { bodies: [Some(2), None], features: [5, 0] });
    /// assert!(ContactKey::of_places(&[corner(4), corner(4)]).is_none() && ContactKey::of_places(&[None]).is_none());
    /// ```
    pub fn of_places(places: &[Option<Place>]) -> Option<Vec<ContactKey>> {
        let keys: Vec<ContactKey> = places.iter().map(|place| place.as_ref().map(ContactKey::from)).collect::<Option<_>>()?;
        let different: HashSet<&ContactKey> = keys.iter().collect();
        (different.len() == keys.len()).then_some(keys)
    }
}

/// Refuses keys that name one body twice, and two contacts of one key.
pub(super) fn validate(keys: &[ContactKey]) -> Result<()> {
    let mut seen = HashMap::with_capacity(keys.len());
    for (k, key) in keys.iter().enumerate() {
        two_bodies("keys", k, key.bodies)?;
        if let Some(first) = seen.insert(key, k) {
            let problem = format!("is that of keys[{first}]");
            return Err(Error::invalid(format!("keys[{k}]"), problem, "give every contact bodies and features of its own"));
        }
    }
    Ok(())
}

/// Refuses a contact of a body with itself, and of the ground with the ground.
pub(super) fn two_bodies(field: &str, k: usize, [first, second]: [Option<usize>; 2]) -> Result<()> {
    if first != second {
        return Ok(());
    }
    Err(Error::invalid(format!("{field}[{k}]"), "names the same body twice", "name two bodies, or one and null for the ground"))
}
