//! Mistakes planted in the proofs, for tests alone: each is caught by solutions that are known without them.

/// A mistake in a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plant {
    /// |F(x̃)| is left out of the radius that is needed.
    Residual,
    /// The smallest box is taken although its image is not inside of it.
    Image,
    /// The preconditioner is zero, and |I − C J̃| η is left out.
    Preconditioner,
    /// The inequalities of the pattern are not looked at.
    Signs,
    /// Half of the distance from the box is reported.
    Radius,
    /// Rows that depend on others are left out whatever their free velocities are.
    Rank,
    /// The equations of sliding that are asked for dependence have a wrong sign.
    Way,
    /// A pair of a polyhedral law is believed without asking the law.
    Law,
    /// δ is that of the given impulses, not of those near them that obey the law.
    Moved,
    /// δ is rounded inward.
    Inward,
    /// A bilateral row is taken for a limit.
    Joined,
    /// Impulses of joints in a witness may move the joints.
    Held,
    /// Signs of an LCP's solution that are wrong, or not decided, are taken for right.
    Decided,
    /// A condition that holds at one point of a set of cones is taken to hold on all of it, and the other branch is passed over.
    Pruned,
    /// Coordinates that are zero at one point of a polyhedron are taken for zero on all of it.
    Vanishing,
    /// Two solutions are taken for the ends of a segment without asking what one does with the other.
    Alone,
    /// Solutions that share a complementary cone are taken for one velocity.
    Still,
}

/// Whether this mistake is made: never outside of tests.
#[cfg(not(test))]
pub(super) const fn planted(_: Plant) -> bool {
    false
}

#[cfg(test)]
thread_local! {
    static PLANTED: std::cell::Cell<Option<Plant>> = const { std::cell::Cell::new(None) };
}

#[cfg(test)]
pub(super) fn planted(plant: Plant) -> bool {
    PLANTED.get() == Some(plant)
}

/// What a check says where this mistake is made.
#[cfg(test)]
pub(super) fn with<T>(plant: Option<Plant>, check: impl FnOnce() -> T) -> T {
    PLANTED.set(plant);
    let said = check();
    PLANTED.set(None);
    said
}
