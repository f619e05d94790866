//! Facts about an engine, format `facts/1`: what the pinned release says of itself, or what the files of its package do.

use serde::Deserialize;

/// The part of a document that claims read; `S` is what is stated of this engine.
#[derive(Clone, Debug, Deserialize)]
pub struct Document<S> {
    /// Version of the package that was asked.
    pub version: String,
    /// Names, settings, sentences, files, lines of source.
    pub stated: S,
}
