//! Islands: contacts that W joins, directly or through others. No impulse of one island moves a contact of another.
//!
//! ```text
//!     W = ⊕ W_I ,      (r, y) solves the problem ⟺ (r_I, y_I) solves that of each island I
//! ```
//! Contacts that meet no other are put together: each of them is answered alone by any method that goes from contact to contact.

use super::BlockSparse;

/// A partition of the contacts.
pub(crate) struct Islands {
    /// The contacts of each, growing.
    pub members: Vec<Vec<usize>>,
    /// Of every contact its place within its island.
    pub place: Vec<usize>,
}

impl Islands {
    /// Those of W.
    pub fn of(w: &BlockSparse) -> Self {
        let n = w.contacts();
        let mut root: Vec<usize> = (0..n).collect();
        for k in 0..n {
            for (j, _) in w.column(k) {
                let (one, other) = (find(&mut root, j), find(&mut root, k));
                root[one.max(other)] = one.min(other);
            }
        }
        let (mut size, mut alone) = (vec![0; n], Vec::new());
        for k in 0..n {
            size[find(&mut root, k)] += 1;
        }
        let (mut members, mut island, mut place) = (Vec::<Vec<usize>>::new(), vec![usize::MAX; n], vec![0; n]);
        for k in 0..n {
            let first = root[k];
            let own = if size[first] == 1 {
                &mut alone
            } else {
                if island[first] == usize::MAX {
                    island[first] = members.len();
                    members.push(Vec::with_capacity(size[first]));
                }
                &mut members[island[first]]
            };
            place[k] = own.len();
            own.push(k);
        }
        if !alone.is_empty() {
            members.push(alone);
        }
        Islands { members, place }
    }
}

/// The first contact of the island of k so far, which the way to it remembers.
fn find(root: &mut [usize], k: usize) -> usize {
    let mut first = k;
    while root[first] != first {
        root[first] = root[root[first]];
        first = root[first];
    }
    root[k] = first;
    first
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn contacts_are_together_exactly_if_a_chain_of_blocks_joins_them() {
        let one = |j, k| (j, k, dmatrix![1.0]);
        let diagonal = (0..7).map(|k| one(k, k));
        // 0–4–2 through a block above and one below the diagonal, 3–6, and 1 and 5 alone; 5 has no block at all
        let blocks = diagonal.filter(|(k, ..)| *k != 5).chain([one(0, 4), one(4, 2), one(6, 3)]).collect();
        let islands = Islands::of(&BlockSparse::new(1, 7, blocks).unwrap());
        assert_eq!(islands.members, [vec![0, 2, 4], vec![3, 6], vec![1, 5]]);
        assert_eq!(islands.place, [0, 0, 1, 0, 2, 1, 1]);
        let none = Islands::of(&BlockSparse::new(1, 0, Vec::new()).unwrap());
        assert!(none.members.is_empty());
    }
}
