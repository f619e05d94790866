//! Which solver takes which contact law, asked of the solvers themselves; and what is near to a name that none has.

use super::near::suggestion;
use crate::problem::Law;
use crate::solvers::{self, ContactSolver};
use crate::{Error, Result};
use std::fmt::Write;

/// Directions of a polyhedral law in a plane and in space, by which a solver is asked.
const DIRECTIONS: [usize; 2] = [2, 8];

/// Columns of a cell.
const CELL: usize = 6;

/// A law in a plane and in space.
type Pair = [Law; 2];

fn laws() -> [Pair; 5] {
    let [plane, space] = DIRECTIONS;
    [
        [Law::Frictionless; 2],
        [Law::Coulomb; 2],
        [Law::Associated; 2],
        [Law::PolyhedralCoulomb { directions: plane }, Law::PolyhedralCoulomb { directions: space }],
        [Law::PolyhedralAssociated { directions: plane }, Law::PolyhedralAssociated { directions: space }],
    ]
}

/// The solvers there are, in a line.
pub fn names() -> String {
    format!("Which algorithm proposes the answer: {}", solvers::ALL.names().collect::<Vec<_>>().join(", "))
}

/// The solvers there are, and which laws each takes.
pub fn table() -> String {
    let mut text = "Which algorithm proposes the answer, with the laws that it takes: in space and in the plane (yes), in the plane alone \
                    (plane), or not (-); with * only where W is symmetric\n\n"
        .to_string();
    let short = |law: Law| -> String { law.name().split('-').filter_map(|word| word.chars().next()).collect::<String>().to_uppercase() };
    let heads = laws().map(|[law, _]| (short(law), law.name()));
    let explained = heads.iter().map(|(short, name)| format!("{short} {name}")).collect::<Vec<_>>().join(", ");
    let head: String = heads.iter().map(|(short, _)| format!(" {short:<CELL$}")).collect();
    let _ = writeln!(text, "{explained}\n\n{:20}{}", "", head.trim_end());
    for name in solvers::ALL.names() {
        let Ok(solver) = solvers::ALL.by_name(name) else { continue };
        let cells: String = laws().iter().map(|law| format!(" {:<CELL$}", cell(&*solver, *law))).collect();
        let _ = writeln!(text, "{}", format!("{name:20}{cells}").trim_end());
    }
    text + "\nWhat else a solver needs, as a compliance or a mass, it says where it refuses, with solvers that take the problem"
}

/// How a solver takes a law.
fn cell(solver: &dyn ContactSolver, [plane, space]: Pair) -> &'static str {
    let takes = |symmetric| [solver.takes(plane, 2, symmetric), solver.takes(space, 3, symmetric)];
    match (takes(true), takes(false)) {
        ([true, true], [true, true]) => "yes",
        ([true, false], [true, _]) => "plane",
        ([true, true], _) => "yes*",
        ([true, false], _) => "plane*",
        ([false, true], [_, true]) => "space",
        ([false, true], _) => "space*",
        ([false, false], _) => "-",
    }
}

/// Refuses a name that no solver has, with the nearest ones.
///
/// # Errors
/// [`Error::Unsupported`].
pub fn check_name(name: &str) -> Result<()> {
    let Err(error) = solvers::ALL.by_name(name) else { return Ok(()) };
    let near = suggestion(name, solvers::ALL.names(), "");
    let cure = if near.is_empty() { error.to_string() } else { format!("there is no solver `{name}`; {near}") };
    Err(Error::Unsupported(format!("--solver: {cure}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_says_of_every_solver_and_law_what_the_solver_says() {
        let text = table();
        let line = |name: &str| -> Vec<String> {
            let line = text.lines().find(|line| line.split_whitespace().next() == Some(name)).expect("a line per solver");
            line.split_whitespace().skip(1).map(str::to_string).collect()
        };
        // known apart from the code: Lemke's method is for linear problems, gradients for convex ones, Murty's for frictionless ones
        assert_eq!(line("lemke"), ["yes", "plane", "plane", "yes", "yes"]);
        assert_eq!(line("apgd"), ["yes*", "-", "yes*", "-", "-"]);
        assert_eq!(line("murty"), ["yes", "-", "-", "-", "-"]);
        assert_eq!(line("auto"), ["yes"; 5]);
        for name in solvers::ALL.names() {
            assert_eq!(line(name).len(), laws().len(), "{name}");
        }
    }

    #[test]
    fn a_misspelt_name_gets_its_neighbour_and_nonsense_gets_the_list() {
        let message = |name: &str| check_name(name).expect_err("no such solver").to_string();
        assert!(message("lemk").contains("did you mean `lemke`"), "{}", message("lemk"));
        assert!(message("interiorpoint").contains("`interior-point`"));
        assert!(solvers::ALL.names().all(|name| message("xyzzyxyzzyxyzzy").contains(name)));
        assert!(check_name("pgs").is_ok());
    }
}
