//! Blocks of consecutive contacts, coloured so that two blocks of one colour touch no body in common.
//!
//! Blocks of one colour may be swept in any order, or at the same time, to the same bits. The order – colour after colour, block after
//! block, contact after contact – depends on the problem alone, whoever sweeps. A problem of one block is swept as it is listed: to colour
//! contact by contact would take every one from another place of the memory.

use crate::operator::MatrixFree;
use crate::tolerance::sweeps::BLOCK;
use std::ops::Range;

/// The blocks of contacts, colour by colour.
pub(super) fn coloured(free: &MatrixFree) -> Vec<Vec<Range<usize>>> {
    colour(free, BLOCK)
}

fn colour(free: &MatrixFree, size: usize) -> Vec<Vec<Range<usize>>> {
    let mut colours: Vec<Vec<Range<usize>>> = Vec::new();
    // of every body the colours of the blocks that touch it
    let mut taken: Vec<Vec<u32>> = vec![Vec::new(); free.jacobian().body_count()];
    for first in (0..free.contacts()).step_by(size) {
        let block = first..(first + size).min(free.contacts());
        let touched = || block.clone().flat_map(|k| free.jacobian().bodies(k));
        let mut forbidden = vec![false; colours.len() + 1];
        touched().flat_map(|body| &taken[*body as usize]).for_each(|colour| forbidden[*colour as usize] = true);
        let colour = forbidden.iter().position(|forbidden| !forbidden).expect("a new colour is not forbidden");
        for body in block.clone().flat_map(|k| free.jacobian().bodies(k)) {
            let own = &mut taken[*body as usize];
            if own.last() != Some(&(colour as u32)) {
                own.push(colour as u32);
            }
        }
        if colour == colours.len() {
            colours.push(Vec::new());
        }
        colours[colour].push(block);
    }
    colours
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
            let colours = colour(&free, size);
            assert_eq!(colours.len(), if n <= size { 1 } else { 2 }, "a chain takes two colours");
            let mut contacts: Vec<usize> = colours.iter().flatten().cloned().flatten().collect();
            contacts.sort_unstable();
            assert_eq!(contacts, (0..n).collect::<Vec<_>>());
            for blocks in &colours {
                let bodies: Vec<HashSet<u32>> =
                    blocks.iter().map(|block| block.clone().flat_map(|k| free.jacobian().bodies(k)).copied().collect()).collect();
                assert!((0..bodies.len()).all(|a| (0..a).all(|b| bodies[a].is_disjoint(&bodies[b]))));
            }
        }
        assert!(colour(&chain(0), 4).is_empty());
    }
}
