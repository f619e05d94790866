//! What `moreau certify` is asked.

use super::super::limits::{CommonOptions, default_tolerance};
use super::super::number;
use super::super::residual_names::RESIDUALS;
use std::path::PathBuf;

/// How an answer is given.
pub(super) const USAGE: &str = "moreau certify PROBLEM SOLUTION";

/// Certify an answer to a contact problem: residuals with units, and whether they are small enough.
///
/// The residuals are computed from the impulses; residuals stored in the solution are not read, and its velocities are
/// only compared. Its `beta` and `sigma`, where the law in the plane or of a polyhedral cone has them, are judged as they
/// are: an answer with wrong ones is none. Each residual is held against the size of the impulses and velocities of its own pair of
/// bodies, normal and tangential parts apart, and against the rounding of its evaluation; it is shown at the contact where
/// it is worst. Of a folder every problem is judged with its answer NAME.solution.json, a line for each.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{RESIDUALS}"))]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB; or a folder of them.
    pub(super) problem: PathBuf,
    /// The answer, a file solution/1; left out, the solution that an HDF5 file of FCLIB holds beside its problem. Of a folder of problems,
    /// the folder of the answers NAME.solution.json; left out, the same folder.
    pub(super) solution: Option<PathBuf>,
    /// Largest residual accepted, relative to the scale of its contact.
    #[arg(long, default_value = default_tolerance(), value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true)]
    pub(super) tolerance: f64,
    /// Prove, in fractions, how far the nearest problem is that impulses near these solve exactly; and by intervals, within which radius
    /// the problem itself has a solution, or why that is not proved, and how many dimensions the impulses with its velocity have; whether
    /// velocities are unique; whether there is no solution at all; how many velocities there are, to six contacts in the plane, three in
    /// space and 20 unknowns λ, β, σ of polyhedral friction. Of that, besides, how far a solution of its complementarity problem is. Of a
    /// linear complementarity problem, moreover: how far a solution is, and how many there are; without an answer, the latter alone. Of a
    /// problem with joints, all of this but the number of velocities. It takes seconds, for some hundred contacts too. There is no limit of
    /// time: a search ends undecided after a counted amount of work, ten seconds or so, so that it ends in the same way everywhere.
    #[arg(long)]
    pub(super) prove: bool,
    #[command(flatten)]
    pub(super) common: CommonOptions,
}

const EXAMPLES: &str = "\
Examples:
  moreau certify problem.json solution.json
  moreau certify problem.json solution.json --tolerance 1e-12 --format json
  moreau certify problem.json solution.json --prove      with proved backward and forward errors
  moreau certify lcp.json --prove                        how many solutions a linear complementarity problem has
  moreau certify collected.hdf5                          an FCLIB file and the solution stored in it
  moreau certify problems/ answers/                      every problem of a folder with answers/NAME.solution.json

A problem and a solution of it, as `moreau new problem` writes the first and `moreau new solution` the form of the second:
  {\"schema\": \"contact-problem/1\", \"name\": \"block\", \"dimension\": 3, \"law\": \"coulomb\",
   \"friction\": [0.5], \"free_velocity\": [-1, 2, 0],
   \"delassus\": {\"shape\": [3, 3], \"rows\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}
  {\"schema\": \"solution/1\", \"problem\": \"block\", \"solver\": \"by hand\",
   \"impulse\": [1, -0.5, 0], \"velocity\": [0, 1.5, 0]}
`impulse` is r [N·s], of every contact the normal entry first; `velocity` is u = W r + u_free [m/s] and may be left
out; so may `problem` and `solver`. Every field: docs/formats.md, `moreau schema solution`.

Exit code 0: the answer is a solution, or, where none is given, one is proved to exist; 1: it is none, or none exists,
which is looked for where no answer is given, too;
2: the files cannot be read or do not fit each other.
Of a folder the worst of these, and all are judged; a problem without an answer counts as 2, as 1 where it is proved
to have no solution.";
