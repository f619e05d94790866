//! Claims of the front matter: P (preface and project), M (table of misconceptions) and T (tables of theorems and symbols).

use super::Claim;

mod cone;
mod convex;
mod energy;
mod lcp;
mod orders;
mod schemes;

/// The claims, one slice per group and file.
pub const CLAIMS: &[&[Claim]] = &[
    cone::PREFACE,
    schemes::PREFACE,
    energy::PREFACE,
    convex::PREFACE,
    lcp::PREFACE,
    orders::PREFACE,
    cone::MISCONCEPTIONS,
    schemes::MISCONCEPTIONS,
    energy::MISCONCEPTIONS,
    convex::MISCONCEPTIONS,
    lcp::MISCONCEPTIONS,
    orders::MISCONCEPTIONS,
    schemes::TABLES,
    energy::TABLES,
    lcp::TABLES,
];
