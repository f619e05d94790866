//! What a judge says: each residual of an answer at the contact where it is worst.

use super::at_contact::{AtContact, worst};
use super::part::Part;

/// A residual where it is worst.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// The residual with its scale and its rounding.
    pub part: Part,
    /// The contact.
    pub contact: usize,
    /// The largest value of this residual at any contact. It may belong to another contact.
    pub largest: f64,
}

/// The six residuals of an answer, each at the contact where it is worst.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Judged {
    /// dist(r, K) \[N·s\].
    pub primal: Worst,
    /// dist(ŷ, K*) \[m/s\].
    pub dual: Worst,
    /// |r·ŷ| \[J\].
    pub complementarity: Worst,
    /// Natural map of Signorini's pair \[N·s\].
    pub normal: Worst,
    /// Natural map of friction \[N·s\].
    pub tangential: Worst,
    /// |u − (W r + u_free)| of the stored u \[m/s\].
    pub velocity: Worst,
    /// max r_n/(ρ_n V), V the largest velocity of the data of closed contacts of the island: how many times the impulse that the data
    /// ask of a contact one of them carries.
    pub loaded: f64,
    /// The largest violation of the law at any contact, or its rounding where that is more, as a velocity in parts of V: how far the given
    /// velocities are from those of a problem that the answer solves.
    pub missed: f64,
}

impl Judged {
    /// Name, worst place and unit of each residual.
    pub fn entries(&self) -> [(&'static str, Worst, &'static str); 6] {
        [
            ("primal", self.primal, "N·s"),
            ("dual", self.dual, "m/s"),
            ("complementarity", self.complementarity, "J"),
            ("normal", self.normal, "N·s"),
            ("tangential", self.tangential, "N·s"),
            ("velocity", self.velocity, "m/s"),
        ]
    }

    /// The residual with the largest relative size.
    pub fn worst(&self) -> (&'static str, Worst) {
        let entries = self.entries();
        let mut worst = (entries[0].0, entries[0].1);
        for (name, one, _) in &entries[1..] {
            if one.part.exceeds(&worst.1.part) {
                worst = (name, *one);
            }
        }
        worst
    }

    /// The largest relative size; not a number if one is not.
    pub fn relative(&self) -> f64 {
        self.worst().1.part.relative()
    }

    /// Whether every residual is within its limit max(τ · scale, floor).
    pub fn accepts(&self, tolerance: f64) -> bool {
        self.relative() <= tolerance
    }

    /// Takes the residuals of one contact, and shows each.
    pub(super) fn take(&mut self, contact: usize, at: AtContact, see: &mut impl FnMut(usize, usize, Part)) {
        let mut take = |entry: usize, place: &mut Worst, part: Part| {
            see(contact, entry, part);
            place.take(contact, part);
        };
        take(0, &mut self.primal, at.primal);
        take(1, &mut self.dual, at.dual);
        take(2, &mut self.complementarity, at.complementarity);
        take(3, &mut self.normal, at.normal);
        take(4, &mut self.tangential, at.tangential);
    }
}

impl Worst {
    /// Whether a residual changes nothing: it is rounding, so that its relative size is 0, and its value is no larger. The first part is
    /// kept even where it is 0: it has a limit that readers look at.
    #[inline]
    pub(super) fn ignores(&self, value: f64, floor: f64) -> bool {
        value <= floor && floor.is_finite() && value <= self.part.value && self.part != Part::default()
    }

    /// Takes the residual of one contact.
    #[inline]
    pub(super) fn take(&mut self, contact: usize, part: Part) {
        if self.ignores(part.value, part.floor) {
            return;
        }
        self.largest = worst(self.largest, part.value);
        if self.part == Part::default() || part.exceeds(&self.part) {
            (self.part, self.contact) = (part, contact);
        }
    }
}
