//! What every exact decision returns: it holds, or a witness shows that it does not.

/// A decided statement; a refutation carries its witness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision<Witness> {
    /// The statement holds.
    Holds,
    /// The statement does not hold, and this witness shows it.
    Fails(Witness),
}

impl<Witness> Decision<Witness> {
    /// Whether the statement holds.
    pub fn holds(&self) -> bool {
        matches!(self, Decision::Holds)
    }

    /// The witness against it.
    pub fn witness(self) -> Option<Witness> {
        match self {
            Decision::Holds => None,
            Decision::Fails(witness) => Some(witness),
        }
    }
}
