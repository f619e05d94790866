//! Which contact is which, when the list of contacts changes from one step to the next.
//!
//! A key names the two bodies of a contact, the first of them the one that the normal pushes, and which features of the two touch. A
//! contact of the same key is the same contact, wherever in a list it stands.

/// The name of a contact that outlives its place in a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ContactKey {
    /// The two bodies by number, the ground as `None`.
    pub bodies: [Option<usize>; 2],
    /// Which corners, edges or faces of the two touch.
    pub features: [u32; 2],
}
