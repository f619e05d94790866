//! The gate: any simulator, in any language, judged by one set of checks ([`moreau_gate`]).

pub use moreau_gate::*;
