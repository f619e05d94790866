//! Claims of the front matter: P (preface and project), M (map of methods) and T (theorems and tables).

use super::Claim;

mod cone;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[cone::PREFACE, cone::MISCONCEPTIONS];
