//! The controls of the claims: each is a planted subject, which its claim must tell from the right one.

use crate::claims::{self, Claim, Status};
use rayon::prelude::*;
use serde::Serialize;

/// The controls of one claim.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Control {
    /// The claim.
    pub claim: &'static str,
    /// What its controls change.
    pub controls: Vec<String>,
    /// Whether every one of them leads to another verdict or moves a finding that none before it moves.
    pub caught: bool,
    /// Why not; empty if so.
    pub why: String,
}

/// Every claim on its controls, in parallel.
pub fn controls(progress: &(dyn Fn() + Sync)) -> Vec<Control> {
    let claims: Vec<&'static Claim> = claims::all().collect();
    claims.par_iter().map(|claim| control(claim)).inspect(|_| progress()).collect()
}

fn control(claim: &'static Claim) -> Control {
    let status = claims::judge(claim).status;
    let caught = status == Status::Supported;
    let why = match status {
        Status::Supported => String::new(),
        Status::ControlPassed => "a control passed".into(),
        Status::Contradicted => "the claim is contradicted".into(),
        Status::OtherVerdict(why) | Status::Failed(why) => why,
    };
    Control { claim: claim.id, controls: claim.controls(), caught, why }
}
