//! Claims of §8: explicit, semi-implicit and implicit integration, symplecticity and contact.

use super::Claim;

mod damped;
mod engines;
mod explicit;
mod impact;
mod implicit;
mod semi_implicit;
mod symplectic;

/// The claims, one slice per file.
pub const CLAIMS: &[&[Claim]] =
    &[explicit::CLAIMS, semi_implicit::CLAIMS, damped::CLAIMS, implicit::CLAIMS, symplectic::CLAIMS, impact::CLAIMS, engines::CLAIMS];
