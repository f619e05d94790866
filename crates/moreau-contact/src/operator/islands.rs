//! Islands: contacts that W joins, directly or through others. No impulse of one island moves a contact of another.
//!
//! ```text
//!     W = ⊕ W_I ,      (r, y) solves the problem ⟺ (r_I, y_I) solves that of each island I
//! ```
//! Contacts that meet no other are put together: each of them is answered alone by any method that goes from contact to contact.

use super::{Lists, Operator};
use crate::contact::Jacobian;
use crate::memory::spare::{self, Lent};

/// A partition of the contacts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Islands {
    /// The contacts of each, growing.
    pub members: Lists,
    /// Of every contact its place within its island.
    place: Lent<Vec<usize>>,
    /// Of every contact the first one of its island, itself where it meets no other.
    pub first: Lent<Vec<usize>>,
    /// Whether the last one is of contacts that meet no other.
    pub last_is_of_lone: bool,
}

impl Islands {
    /// Those of contacts that were found to be one island, or to meet no other.
    pub fn found(contacts: usize, are_lone: bool) -> Self {
        let mut members = Lists::default();
        if contacts > 0 {
            members.collect(1, |show| (0..contacts).for_each(|k| show(0, k)));
        }
        let each = |first: fn(usize) -> usize| spare::collected(contacts, (0..contacts).map(first)).into();
        let first = if are_lone { each(|k| k) } else { each(|_| 0) };
        Islands { members, place: each(|k| k), first, last_is_of_lone: are_lone && contacts > 0 }
    }

    /// The place of contact k among these, an island, or one contact that meets no other.
    pub fn place_among(&self, members: &[usize], k: usize) -> usize {
        if members.len() == 1 { 0 } else { self.place[k] }
    }

    /// Those of W; of a W by bodies that is not formed, contacts are together that touch the same body.
    pub fn of(w: &Operator, contacts: usize) -> Self {
        let (n, mut parts) = (contacts, Parts::alone(contacts));
        match w {
            Operator::Blocks(stored) => {
                let mut columns = 0..n;
                while let (true, Some(k)) = (parts.count > 1, columns.next()) {
                    stored.blocks.met(k).iter().for_each(|j| parts.join(*j, k));
                }
            }
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

    /// Those of contacts that are together where they touch the same of so many things, directly or through others.
    pub fn touching(contacts: usize, things: usize, touched: &[Vec<usize>]) -> Self {
        let (mut parts, mut last) = (Parts::alone(contacts), vec![None; things]);
        for (k, touched) in touched.iter().enumerate() {
            for thing in touched {
                if let Some(before) = last[*thing].replace(k) {
                    parts.join(before, k);
                }
            }
        }
        parts.islands()
    }

    /// The contacts of each, those that meet no other one by one at the end.
    pub fn one_by_one(&self) -> Vec<Vec<usize>> {
        let together = self.members.len() - usize::from(self.last_is_of_lone);
        let lone = self.members.iter().skip(together).flatten().map(|k| vec![*k]);
        self.members.iter().take(together).map(<[usize]>::to_vec).chain(lone).collect()
    }
}

/// The islands of H: contacts are together whose rows touch the same velocity, directly or through others. H_I H_Jᵀ = 0 for any two.
/// ```
/// use moreau_contact::contact::{Jacobian, Rows};
/// use moreau_contact::operator::islands_of;
///
/// // four masses on a line: the first on the third, the second and the fourth on the ground, the third once more
/// let on_ground = |mass| Rows::zeros(1, 4).with(mass, [[1.0]]);
/// let contacts = vec![on_ground(0).with(2, [[-1.0]]), on_ground(1), on_ground(3), on_ground(2)];
/// assert_eq!(islands_of(&Jacobian::new(1, 4, contacts)), [vec![0, 3], vec![1], vec![2]]);
/// ```
pub fn islands_of(jacobian: &Jacobian) -> Vec<Vec<usize>> {
    let touched: Vec<Vec<usize>> = jacobian.contacts().iter().map(|rows| rows.touched().collect()).collect();
    Islands::touching(touched.len(), jacobian.ncols(), &touched).one_by_one()
}

/// Contacts that were found to be together, each with one of them that comes before it, or itself.
struct Parts {
    root: Lent<Vec<usize>>,
    count: usize,
}

impl Parts {
    /// So many contacts, none of which has been found with another.
    fn alone(contacts: usize) -> Self {
        Parts { root: spare::collected(contacts, 0..contacts).into(), count: contacts }
    }

    #[inline]
    fn join(&mut self, j: usize, k: usize) {
        if self.root[j] == self.root[k] {
            return;
        }
        let (one, other) = (find(&mut self.root, j), find(&mut self.root, k));
        if one != other {
            self.root[one.max(other)] = one.min(other);
            self.count -= 1;
        }
    }

    fn islands(self) -> Islands {
        let (n, mut root) = (self.root.len(), self.root);
        let each = |number: usize| Lent::from(spare::repeated(n, number));
        let mut size = each(0);
        for k in 0..n {
            size[find(&mut root, k)] += 1;
        }
        // islands are numbered as their first contacts follow each other, and those alone are the last one
        let (mut island, mut islands) = (each(usize::MAX), 0);
        for k in (0..n).filter(|k| root[*k] == *k && size[*k] > 1) {
            island[k] = islands;
            islands += 1;
        }
        let last_is_of_lone = size.contains(&1);
        let (mut members, mut place) = (Lists::default(), each(0));
        let of = |k: usize| island[root[k]].min(islands);
        members.collect(islands + usize::from(last_is_of_lone), |show| (0..n).for_each(|k| show(of(k), k)));
        members.iter().for_each(|own| own.iter().enumerate().for_each(|(at, k)| place[*k] = at));
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
    use crate::contact::Rows;
    use nalgebra::{DMatrix, dmatrix};

    #[test]
    fn contacts_are_together_exactly_if_their_rows_touch_a_velocity_through_any_chain() {
        let touching = |bodies: &[usize]| bodies.iter().fold(Rows::zeros(1, 24), |rows, body| rows.with(3 * body, [[1.0, 0.0, -1.0]]));
        // 2–0–4 by a chain whose middle comes last, 1 twice, 6 alone; what has no entry meets nothing, and a zero at a body is none
        let rows = [&[2][..], &[1], &[4], &[6], &[], &[1], &[0, 2], &[0, 4]].map(touching);
        let beside = Rows::zeros(1, 24).with(18, [[0.0, 1.0, 0.0]]);
        let found = islands_of(&Jacobian::new(1, 24, rows.into_iter().chain([beside]).collect()));
        assert_eq!(found, [vec![0, 2, 6, 7], vec![1, 5], vec![3], vec![4], vec![8]]);
        assert!(islands_of(&Jacobian::new(1, 24, Vec::new())).is_empty());
    }

    #[test]
    fn contacts_are_together_exactly_if_a_chain_of_blocks_joins_them() {
        let one = |j, k| (j, k, dmatrix![1.0]);
        let diagonal = (0..7).map(|k| one(k, k));
        // 0–4–2 through a block above and one below the diagonal, 3–6, and 1 and 5 alone; 5 has no block at all
        let blocks = diagonal.filter(|(k, ..)| *k != 5).chain([one(0, 4), one(4, 2), one(6, 3)]).collect();
        let blocks = BlockSparse::new(1, 7, blocks).unwrap();
        for w in [Operator::from(blocks.to_dense()), blocks.into()] {
            let islands = Islands::of(&w, 7);
            assert_eq!(islands.members.iter().collect::<Vec<_>>(), [&[0, 2, 4][..], &[3, 6], &[1, 5]]);
            assert_eq!(**islands.place, [0, 0, 1, 0, 2, 1, 1]);
            assert_eq!((&**islands.first, islands.last_is_of_lone), (&[0, 1, 0, 3, 0, 5, 3][..], true));
        }
        let chain = Operator::from(DMatrix::from_element(3, 3, 1.0));
        for (w, are_lone) in [(chain, false), (DMatrix::identity(3, 3).into(), true)] {
            let (known, found) = (Islands::found(3, are_lone), Islands::of(&w, 3));
            assert_eq!((&known.members, &known.place, &known.first), (&found.members, &found.place, &found.first));
            assert_eq!(known.last_is_of_lone, found.last_is_of_lone);
        }
        let none = Islands::of(&BlockSparse::new(1, 0, Vec::new()).unwrap().into(), 0);
        assert!(none.members.len() == 0 && !none.last_is_of_lone);
    }
}
