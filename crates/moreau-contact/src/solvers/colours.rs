//! Blocks of consecutive contacts, coloured so that two blocks of one colour touch nothing in common: no body where W acts through bodies,
//! no contact that both move where W is stored by blocks.
//!
//! Blocks of one colour may be swept in any order, or at the same time, to the same bits. The order – colour after colour, block after
//! block, contact after contact – depends on the problem alone, whoever sweeps. A problem of one block is swept as it is listed: to colour
//! contact by contact would take every one from another place of the memory.

use crate::operator::{BlockSparse, Lists, MatrixFree};
use crate::tolerance::sweeps::BLOCK;
use std::ops::Range;

/// Consecutive contacts in blocks of one size, of which the last may be smaller, and the numbers of the blocks, colour by colour.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Blocks {
    pub size: usize,
    pub colours: Lists,
}

impl Blocks {
    /// All contacts in one block.
    pub fn one(contacts: usize) -> Self {
        let mut colours = Lists::default();
        colours.collect(usize::from(contacts > 0), |show| (0..contacts.min(1)).for_each(|block| show(0, block)));
        Blocks { size: contacts.max(1), colours }
    }

    /// How many blocks there are.
    pub fn count(&self) -> usize {
        self.colours.total()
    }

    /// The blocks of the most frequent colour.
    pub fn widest(&self) -> usize {
        self.colours.iter().map(<[usize]>::len).max().unwrap_or(0)
    }

    /// The contacts of a block.
    pub fn range(&self, block: usize, contacts: usize) -> Range<usize> {
        block * self.size..((block + 1) * self.size).min(contacts)
    }
}

/// What contacts touch: two of them that touch nothing in common may be swept at the same time.
pub(super) trait Touching {
    /// How many contacts there are.
    fn contacts(&self) -> usize;

    /// How many things there are to touch.
    fn things(&self) -> usize;

    /// The things that a contact reads and moves.
    fn touched(&self, contact: usize) -> impl Iterator<Item = usize>;
}

/// W by bodies: the bodies.
impl Touching for MatrixFree {
    fn contacts(&self) -> usize {
        self.contacts()
    }

    fn things(&self) -> usize {
        self.jacobian().body_count()
    }

    fn touched(&self, contact: usize) -> impl Iterator<Item = usize> {
        self.jacobian().bodies(contact).iter().map(|body| *body as usize)
    }
}

/// W by blocks: the contact itself and all that W joins with it, whose y it moves.
impl Touching for BlockSparse {
    fn contacts(&self) -> usize {
        self.contacts()
    }

    fn things(&self) -> usize {
        self.contacts()
    }

    fn touched(&self, contact: usize) -> impl Iterator<Item = usize> {
        self.met(contact).iter().copied().chain([contact])
    }
}

/// The blocks of contacts, colour by colour.
pub(super) fn coloured(touching: &impl Touching) -> Blocks {
    colour(touching, BLOCK)
}

/// The same with so many contacts in a block: each takes the first colour that no block before it has which touches something of it.
pub(super) fn colour(touching: &impl Touching, size: usize) -> Blocks {
    let (contacts, mut blocks, mut count) = (touching.contacts(), Blocks { size, colours: Lists::default() }, 0);
    let mut chosen = Vec::with_capacity(contacts.div_ceil(size));
    // of every thing the colours of the blocks that touch it
    let mut taken: Vec<Vec<u32>> = vec![Vec::new(); touching.things()];
    for block in 0..contacts.div_ceil(size) {
        let touched = || blocks.range(block, contacts).flat_map(|k| touching.touched(k));
        let mut forbidden = vec![false; count + 1];
        touched().flat_map(|thing| &taken[thing]).for_each(|colour| forbidden[*colour as usize] = true);
        let colour = forbidden.iter().position(|forbidden| !forbidden).expect("a new colour is not forbidden");
        for thing in touched() {
            let own = &mut taken[thing];
            if own.last() != Some(&(colour as u32)) {
                own.push(colour as u32);
            }
        }
        count = count.max(colour + 1);
        chosen.push(colour);
    }
    blocks.colours.collect(count, |show| chosen.iter().enumerate().for_each(|(block, colour)| show(*colour, block)));
    blocks
}

/// Whether no two blocks of one colour touch anything in common.
#[cfg(test)]
pub(super) fn are_apart(touching: &impl Touching, blocks: &Blocks) -> bool {
    let of = |block: &usize| -> std::collections::HashSet<usize> {
        blocks.range(*block, touching.contacts()).flat_map(|k| touching.touched(k)).collect()
    };
    blocks.colours.iter().all(|colour| {
        let touched: Vec<_> = colour.iter().map(of).collect();
        (0..touched.len()).all(|a| (0..a).all(|b| touched[a].is_disjoint(&touched[b])))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::BlockRows;
    use nalgebra::DMatrix;

    /// A chain of n bodies: contact k lies between the bodies k and k + 1.
    fn chain(n: usize) -> MatrixFree {
        let mut rows = BlockRows::new(1, vec![1; n + 1]).unwrap();
        (0..n).for_each(|k| rows.push(&[(k, &[-1.0]), (k + 1, &[1.0])]).unwrap());
        MatrixFree::new(&vec![DMatrix::identity(1, 1); n + 1], rows).unwrap()
    }

    /// Holds the blocks of n contacts against what they have to be.
    fn is_sound(touching: &impl Touching, size: usize, colours: usize) {
        let (n, coloured) = (touching.contacts(), colour(touching, size));
        assert_eq!(coloured.colours.len(), if n <= size { 1 } else { colours }, "{n} contacts, {size} in a block");
        let mut contacts: Vec<usize> = coloured.colours.iter().flatten().flat_map(|block| coloured.range(*block, n)).collect();
        contacts.sort_unstable();
        assert_eq!(contacts, (0..n).collect::<Vec<_>>());
        assert_eq!(coloured.count(), n.div_ceil(size));
        assert!(are_apart(touching, &coloured), "{n} contacts, {size} in a block");
        // what it is that must not be: neighbours of one colour
        let mut wrong = coloured.clone();
        wrong.colours.collect(1, |show| (0..coloured.count()).for_each(|block| show(0, block)));
        assert_eq!(are_apart(touching, &wrong), n <= size, "{n} contacts, {size} in a block");
    }

    #[test]
    fn blocks_of_one_colour_touch_nothing_in_common_and_every_contact_is_in_one() {
        for (n, size) in [(1, 4), (10, 1), (10, 3), (100, 7)] {
            is_sound(&chain(n), size, 2);
            // contacts move each other over the bodies: the two beside a single one move what is between them
            is_sound(&chain(n).delassus().unwrap(), size, if size == 1 { 3 } else { 2 });
        }
        assert_eq!((colour(&chain(0), 4).colours.len(), Blocks::one(0).colours.len()), (0, 0));
        assert_eq!((Blocks::one(7).count(), Blocks::one(7).range(0, 7)), (1, 0..7));
    }

    #[test]
    fn a_contact_that_w_keeps_no_block_of_is_touched_by_itself() {
        // contact 0 moves contact 1, which moves nothing, and 2 stands alone
        let w = BlockSparse::new(1, 3, vec![(0, 0, DMatrix::identity(1, 1)), (1, 0, DMatrix::identity(1, 1))]).unwrap();
        assert_eq!((0..3).map(|k| w.touched(k).collect::<Vec<_>>()).collect::<Vec<_>>(), [vec![0, 1, 0], vec![1], vec![2]]);
        assert_eq!(colour(&w, 1).colours.iter().collect::<Vec<_>>(), [&[0, 2][..], &[1]]);
    }
}
