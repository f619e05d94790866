//! Mistakes of contact solvers. They show in scenes as well as in problems.

use crate::planted::{Faulty, Planted};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    solver!(
        THREE_SWEEPS,
        &["solver/redundant", "solver/conditioning", "stack/five", "stack/ten", "stack/mass-ratio", "metamorphic/body-order"]
    ),
    solver!(A_THOUSANDTH_LEFT, UNSOLVED),
    solver!(NO_IMPULSE, &["solver/certificate", "solver/redundant", "solver/jamming", "stack/five"]),
    solver!(NORMALS_CLIPPED, &["solver/certificate", "solver/jamming"]),
    solver!(SHIFT_IGNORED, &["solver/certificate", "solver/redundant"]),
    solver!(CONVEX_RELAXATION, &["solver/certificate", "solver/friction-range"]),
    solver!(VELOCITY_AS_WISHED, &["solver/infeasible"]),
];

/// The checks that ask how well a step is solved, where one body makes it plain.
const UNSOLVED: &[&str] = &["rest/jitter", "incline/stick", "incline/stick-threshold", "solver/certificate"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Level;
    use crate::planted::parts::{Answers, with_solver};
    use crate::planted::{Kind, judge};
    use crate::{Verdict, checks};
    use moreau_checks::defects::solvers::left_over;

    /// The other side of the boundary: with a tenth of what the planted solver leaves, every question about motion is answered as the ideal
    /// demands.
    #[test]
    fn a_solver_that_leaves_a_ten_thousandth_passes_where_one_that_leaves_a_thousandth_fails() {
        let engine = || with_solver(|| Box::new(Answers(|problem, start| left_over(problem, start, 1e-4))));
        let subject = Faulty { engine, caught_by: UNSOLVED };
        let careful = Planted { name: "a ten-thousandth left", mistake: "", kind: Kind::Solver, subject };
        let families = ["rest", "stack", "incline", "contact", "metamorphic", "isotropy", "rolling", "energy"];
        let asked = |check: &&crate::Check| check.level == Level::Simulate && families.contains(&check.family());
        let checks: Vec<_> = checks::all().filter(asked).collect();
        let report = judge(&careful, &checks).expect("an engine");
        for outcome in &report.checks {
            assert_eq!(outcome.verdict, Verdict::Pass, "{} {:?}", outcome.check, outcome.reason);
        }
    }
}
