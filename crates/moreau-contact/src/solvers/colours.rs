//! Blocks of consecutive contacts, coloured so that two blocks of one colour touch no body in common.
//!
//! Blocks of one colour may be swept in any order, or at the same time, to the same bits. The order – colour after colour, block after
//! block, contact after contact – depends on the problem alone, whoever sweeps. A problem of one block is swept as it is listed: to colour
//! contact by contact would take every one from another place of the memory.

use crate::operator::{Lists, MatrixFree};
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

/// The blocks of contacts, colour by colour.
pub(super) fn coloured(free: &MatrixFree) -> Blocks {
    colour(free, BLOCK)
}

fn colour(free: &MatrixFree, size: usize) -> Blocks {
    let (contacts, mut blocks, mut count) = (free.contacts(), Blocks { size, colours: Lists::default() }, 0);
    let mut chosen = Vec::with_capacity(contacts.div_ceil(size));
    // of every body the colours of the blocks that touch it
    let mut taken: Vec<Vec<u32>> = vec![Vec::new(); free.jacobian().body_count()];
    for block in 0..contacts.div_ceil(size) {
        let touched = || blocks.range(block, contacts).flat_map(|k| free.jacobian().bodies(k));
        let mut forbidden = vec![false; count + 1];
        touched().flat_map(|body| &taken[*body as usize]).for_each(|colour| forbidden[*colour as usize] = true);
        let colour = forbidden.iter().position(|forbidden| !forbidden).expect("a new colour is not forbidden");
        for body in touched() {
            let own = &mut taken[*body as usize];
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::BlockRows;
    use nalgebra::DMatrix;
    use std::collections::HashSet;

    /// A chain of n bodies: contact k lies between the bodies k and k + 1.
    fn chain(n: usize) -> MatrixFree {
        let mut rows = BlockRows::new(1, vec![1; n + 1]).unwrap();
        (0..n).for_each(|k| rows.push(&[(k, &[-1.0]), (k + 1, &[1.0])]).unwrap());
        MatrixFree::new(&vec![DMatrix::identity(1, 1); n + 1], rows).unwrap()
    }

    #[test]
    fn blocks_of_one_colour_share_no_body_and_every_contact_is_in_one() {
        for (n, size) in [(1, 4), (10, 1), (10, 3), (100, 7)] {
            let free = chain(n);
            let coloured = colour(&free, size);
            assert_eq!(coloured.colours.len(), if n <= size { 1 } else { 2 }, "a chain takes two colours");
            let mut contacts: Vec<usize> = coloured.colours.iter().flatten().flat_map(|block| coloured.range(*block, n)).collect();
            contacts.sort_unstable();
            assert_eq!(contacts, (0..n).collect::<Vec<_>>());
            assert_eq!(coloured.count(), n.div_ceil(size));
            for blocks in coloured.colours.iter() {
                let bodies_of = |block: &usize| coloured.range(*block, n).flat_map(|k| free.jacobian().bodies(k)).copied().collect();
                let bodies: Vec<HashSet<u32>> = blocks.iter().map(bodies_of).collect();
                assert!((0..bodies.len()).all(|a| (0..a).all(|b| bodies[a].is_disjoint(&bodies[b]))));
            }
        }
        assert_eq!((colour(&chain(0), 4).colours.len(), Blocks::one(0).colours.len()), (0, 0));
        assert_eq!((Blocks::one(7).count(), Blocks::one(7).range(0, 7)), (1, 0..7));
    }
}
