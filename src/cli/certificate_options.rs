//! What `simulate` and `compare` do about steps that the certificate rejects.

use super::limits::default_tolerance;
use super::output::print_aside;
use super::{Answer, limits, number};
use crate::Result;
use crate::schemes::Certified;
use crate::solvers::ContactSolver;
use crate::tolerance::cli::{ASKED_SHARE, CERTIFY};

/// How steps are judged.
#[derive(clap::Args)]
pub struct CertificateOptions {
    /// Largest residual of a step that is accepted, relative to the scale of its contact. Where it is larger than the default, the solver
    /// stops at half of it.
    #[arg(long, default_value = default_tolerance(), value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true)]
    certify_tolerance: f64,
    /// End with exit code 0 and a warning although the certificate rejects steps.
    #[arg(long)]
    accept_rejected: bool,
}

/// The solver, asked for half of the tolerance that is accepted where that is more than the default: what is not needed takes time.
pub fn asked(solver: Box<dyn ContactSolver>, tolerance: f64) -> Box<dyn ContactSolver> {
    let rougher = (tolerance > CERTIFY).then(|| solver.with_tolerance(ASKED_SHARE * tolerance));
    rougher.flatten().unwrap_or(solver)
}

impl CertificateOptions {
    /// The solver, asked for what is accepted.
    pub fn asked(&self, solver: Box<dyn ContactSolver>) -> Box<dyn ContactSolver> {
        asked(solver, self.certify_tolerance)
    }

    /// The solver with its answers certified.
    pub fn certified<'a>(&self, solver: &'a dyn ContactSolver) -> Result<Certified<'a>> {
        limits::check_tolerance("--certify-tolerance", self.certify_tolerance)?;
        Ok(Certified::with_tolerance(solver, self.certify_tolerance))
    }

    /// The answer is no if steps were rejected and `--accept-rejected` is absent.
    pub fn answer(&self, rejected: bool) -> Answer {
        if rejected {
            let cure = if self.accept_rejected {
                "warning: the certificate rejects steps of this motion; --accept-rejected lets it pass\n"
            } else {
                "the certificate rejects steps of this motion: exit code 1; --dump-rejected of `moreau simulate` writes them\n"
            };
            print_aside(cure);
        }
        (!rejected || self.accept_rejected).into()
    }
}
