//! Islands: contacts that W joins, directly or through others. No impulse of one island moves a contact of another.
//!
//! ```text
//!     W = ⊕ W_I ,      (r, y) solves the problem ⟺ (r_I, y_I) solves that of each island I
//! ```
//! Contacts that meet no other are put together: each of them is answered alone by any method that goes from contact to contact.

use super::Operator;

/// A partition of the contacts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Islands {
    /// The contacts of each, growing.
    pub members: Vec<Vec<usize>>,
    /// Of every contact its place within its island.
    place: Vec<usize>,
    /// Of every contact the first one of its island, itself where it meets no other.
    pub first: Vec<usize>,
    /// Whether the last one is of contacts that meet no other.
    pub last_is_of_lone: bool,
}

impl Islands {
    /// The place of contact k among these, an island, or one contact that meets no other.
    pub fn place_among(&self, members: &[usize], k: usize) -> usize {
        if members.len() == 1 { 0 } else { self.place[k] }
    }

    /// Those of W; of a W by bodies that is not formed, contacts are together that touch the same body.
    pub fn of(w: &Operator, contacts: usize) -> Self {
        let (n, mut parts) = (contacts, Parts { root: (0..contacts).collect(), count: contacts });
        match w {
            Operator::Blocks(stored) => (0..n).for_each(|k| stored.blocks.column(k).for_each(|(j, _)| parts.join(j, k))),
            Operator::Dense(dense) => {
                let d = dense.nrows() / n.max(1);
                let meet =
                    |j: usize, k: usize| (k * d..(k + 1) * d).any(|column| (j * d..(j + 1) * d).any(|row| dense[(row, column)] != 0.0));
                let mut columns = 0..n;
                // of most problems the first column joins all
                while let (true, Some(k)) = (parts.count > 1, columns.next()) {
                    (0..n).filter(|j| meet(*j, k)).for_each(|j| parts.join(j, k));
                }
            }
            Operator::Bodies(bodies) => {
                for touching in bodies.free.members() {
                    touching.windows(2).for_each(|pair| parts.join(pair[0] as usize, pair[1] as usize));
                }
            }
        }
        parts.islands()
    }
}

/// Contacts that were found to be together, each with one of them that comes before it, or itself.
struct Parts {
    root: Vec<usize>,
    count: usize,
}

impl Parts {
    fn join(&mut self, j: usize, k: usize) {
        let (one, other) = (find(&mut self.root, j), find(&mut self.root, k));
        if one != other {
            self.root[one.max(other)] = one.min(other);
            self.count -= 1;
        }
    }

    fn islands(self) -> Islands {
        let (n, mut root) = (self.root.len(), self.root);
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
        let last_is_of_lone = !alone.is_empty();
        if last_is_of_lone {
            members.push(alone);
        }
        Islands { members, place, first: root, last_is_of_lone }
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
    use super::super::BlockSparse;
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn contacts_are_together_exactly_if_a_chain_of_blocks_joins_them() {
        let one = |j, k| (j, k, dmatrix![1.0]);
        let diagonal = (0..7).map(|k| one(k, k));
        // 0–4–2 through a block above and one below the diagonal, 3–6, and 1 and 5 alone; 5 has no block at all
        let blocks = diagonal.filter(|(k, ..)| *k != 5).chain([one(0, 4), one(4, 2), one(6, 3)]).collect();
        let blocks = BlockSparse::new(1, 7, blocks).unwrap();
        for w in [Operator::from(blocks.to_dense()), blocks.into()] {
            let islands = Islands::of(&w, 7);
            assert_eq!(islands.members, [vec![0, 2, 4], vec![3, 6], vec![1, 5]]);
            assert_eq!(islands.place, [0, 0, 1, 0, 2, 1, 1]);
            assert_eq!((islands.first, islands.last_is_of_lone), (vec![0, 1, 0, 3, 0, 5, 3], true));
        }
        let none = Islands::of(&BlockSparse::new(1, 0, Vec::new()).unwrap().into(), 0);
        assert!(none.members.is_empty() && !none.last_is_of_lone);
    }
}
