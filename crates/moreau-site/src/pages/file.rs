//! A file of the report.

/// A file of the report.
pub struct File {
    /// Its path from the folder of the report, with `/`.
    pub path: String,
    /// What it holds.
    pub text: String,
}
