//! Lists of numbers in one piece of memory: as many as there are contacts, bodies or fronts cost two pieces, not one each.

use crate::memory::spare::{self, Lent};
use std::ops::Index;

/// Lists of numbers, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lists {
    /// List k has the members starts[k] .. starts[k + 1].
    starts: Lent<Vec<usize>>,
    members: Lent<Vec<usize>>,
}

impl Default for Lists {
    fn default() -> Self {
        Lists { starts: spare::collected(1, [0]).into(), members: Lent::default() }
    }
}

impl Lists {
    /// Forgets all lists; their memory is used again.
    pub fn clear(&mut self) {
        self.starts.truncate(1);
        self.members.clear();
    }

    /// Appends a member to the list that is not complete yet.
    pub fn push(&mut self, member: usize) {
        self.members.push(member);
    }

    /// Completes a list: the next member begins another one.
    pub fn end(&mut self) {
        self.starts.push(self.members.len());
    }

    /// How many lists there are.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Becomes a copy of other lists, in its own memory.
    pub fn copy_from(&mut self, other: &Lists) {
        self.starts.clone_from(&other.starts);
        self.members.clone_from(&other.members);
    }

    /// The members of a list, to change them in place.
    pub fn list_mut(&mut self, list: usize) -> &mut [usize] {
        &mut self.members[self.starts[list]..self.starts[list + 1]]
    }

    /// Sorts every list, and leaves of equal members one.
    pub fn sort_each(&mut self) {
        let (mut first, mut kept) = (0, 0);
        for end in &mut self.starts[1..] {
            self.members[first..*end].sort_unstable();
            let begun = kept;
            for place in first..*end {
                if kept == begun || self.members[kept - 1] != self.members[place] {
                    self.members[kept] = self.members[place];
                    kept += 1;
                }
            }
            (first, *end) = (*end, kept);
        }
        self.members.truncate(kept);
    }

    /// The lists in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        self.starts.windows(2).map(|ends| &self.members[ends[0]..ends[1]])
    }

    /// How many members all lists have together.
    pub fn total(&self) -> usize {
        self.members.len()
    }

    /// The last list.
    pub fn last(&self) -> Option<&[usize]> {
        (self.len() > 0).then(|| &self[self.len() - 1])
    }

    /// Replaces the lists by others: list k has member m for every (k, m) that `each` shows, in this order; it is asked twice.
    pub fn collect(&mut self, lists: usize, each: impl Fn(&mut dyn FnMut(usize, usize))) {
        // each list begins where the one before it is written next
        self.starts.make_room(lists + 2);
        self.starts.resize(lists + 2, 0);
        each(&mut |list, _| self.starts[list + 2] += 1);
        (2..lists + 2).for_each(|list| self.starts[list] += self.starts[list - 1]);
        self.members.make_room(self.starts[lists + 1]);
        self.members.resize(self.starts[lists + 1], 0);
        each(&mut |list, member| {
            self.members[self.starts[list + 1]] = member;
            self.starts[list + 1] += 1;
        });
        self.starts.truncate(lists + 1);
    }
}

impl Index<usize> for Lists {
    type Output = [usize];

    fn index(&self, list: usize) -> &[usize] {
        &self.members[self.starts[list]..self.starts[list + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_keep_their_members_in_the_order_that_they_came() {
        let mut lists = Lists::default();
        assert_eq!((lists.len(), lists.last()), (0, None));
        for list in [&[3, 1][..], &[], &[2]] {
            list.iter().for_each(|member| lists.push(*member));
            lists.end();
        }
        assert_eq!(lists.iter().collect::<Vec<_>>(), [&[3, 1][..], &[], &[2]]);
        assert_eq!((&lists[0], lists.last(), lists.total()), (&[3, 1][..], Some(&[2][..]), 3));
        let pairs = [(2, 5), (0, 7), (2, 4), (0, 7)];
        lists.collect(4, |show| pairs.iter().for_each(|&(list, member)| show(list, member)));
        assert_eq!(lists.iter().collect::<Vec<_>>(), [&[7, 7][..], &[], &[5, 4], &[]]);
        lists.sort_each();
        assert_eq!(lists.iter().collect::<Vec<_>>(), [&[7][..], &[], &[4, 5], &[]]);
        lists.list_mut(2)[0] = 9;
        let mut other = Lists::default();
        other.copy_from(&lists);
        assert_eq!((&other[2], &other), (&[9, 5][..], &lists));
        lists.clear();
        assert_eq!(lists, Lists::default());
    }
}
