//! Claims of §8: explicit, semi-implicit and implicit integration, symplecticity and contact.

use super::Claim;

mod damped;
mod explicit;
mod implicit;
mod semi_implicit;
pub(in crate::claims) mod spring;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] = &[explicit::CLAIMS, semi_implicit::CLAIMS, damped::CLAIMS, implicit::CLAIMS];
