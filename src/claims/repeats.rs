//! Claims that say again what another one says: the repetition has the verdict of its original, and one mistake is charged once.

/// The repetition and its original.
pub const REPEATS: &[(&str, &str)] = &[];
