//! One named trial per claim of the registry; `cargo test --test claims S4` runs one section.

use libtest_mimic::{Arguments, Trial};
use moreau::claims::{self, Status};

fn main() {
    let trials = claims::all().map(|claim| {
        Trial::test(claim.id, move || {
            let outcome = claims::judge(claim);
            if outcome.status == Status::Supported {
                return Ok(());
            }
            let findings =
                outcome.findings.iter().map(|finding| format!("\n  [{}] {finding}", if finding.holds() { "holds" } else { "FAILS" }));
            Err(format!("{:?}{}", outcome.status, findings.collect::<String>()).into())
        })
    });
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit();
}
