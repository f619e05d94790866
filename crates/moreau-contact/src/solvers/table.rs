//! Solvers by name. This crate makes a table of its own algorithms. A program with more solvers adds them to the table.

#[cfg(feature = "clarabel")]
use super::ClarabelPolished;
use super::watch::{Interrupt, watched};
use super::{
    AcceleratedProjectedGradient, AlternatingDirections, Auto, BarzilaiBorwein, ContactSolver, ConvexSubproblems, Enumeration,
    FischerBurmeister, GaussNewton, InteriorPoint, LemkePivoting, Murty, NewtonMin, NonsmoothNewton, ParametricPivoting,
    ProjectedGaussSeidel, ProjectedOverRelaxation, ProximalNewton,
};
use crate::problem::ContactProblem;
use crate::tolerance::solvers::{MOST_ITERATIONS, SYMMETRY};
use moreau_exact::error::Failure;
use moreau_exact::{Error, Result};

/// How many solvers a refusal names.
const NAMED: usize = 3;

/// One solver of a table.
#[derive(Clone, Copy, Debug)]
pub struct SolverEntry {
    /// Its name on the command line and in files, [`ContactSolver::name`].
    pub name: &'static str,
    /// The algorithm with its default settings.
    pub default: fn() -> Box<dyn ContactSolver>,
    /// The solver with another limit of iterations; absent if it has no such limit.
    pub limited: Option<fn(usize) -> Box<dyn ContactSolver>>,
}

/// Solvers by name, in the order in which they are listed.
#[derive(Clone, Debug, Default)]
pub struct Solvers(Vec<SolverEntry>);

/// The algorithms of this crate; a new one is one more line.
const OWN: &[SolverEntry] = &[
    SolverEntry { name: "auto", default: || Box::new(Auto), limited: None },
    SolverEntry { name: "lemke", default: || Box::new(LemkePivoting), limited: None },
    SolverEntry { name: "murty", default: || Box::new(Murty::default()), limited: Some(|limit| Box::new(Murty { pivots: limit })) },
    SolverEntry {
        name: "parametric-pivoting",
        default: || Box::new(ParametricPivoting::default()),
        limited: Some(|limit| Box::new(ParametricPivoting { pivots: limit })),
    },
    SolverEntry {
        name: "newton-min",
        default: || Box::new(NewtonMin::default()),
        limited: Some(|limit| Box::new(NewtonMin { steps: limit })),
    },
    SolverEntry { name: "enumeration", default: || Box::new(Enumeration), limited: None },
    SolverEntry {
        name: "pgs",
        default: || Box::new(ProjectedGaussSeidel::default()),
        limited: Some(|limit| Box::new(ProjectedGaussSeidel { sweeps: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "psor",
        default: || Box::new(ProjectedOverRelaxation::default()),
        limited: Some(|limit| Box::new(ProjectedOverRelaxation { sweeps: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "apgd",
        default: || Box::new(AcceleratedProjectedGradient::default()),
        limited: Some(|limit| Box::new(AcceleratedProjectedGradient { iterations: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "bb",
        default: || Box::new(BarzilaiBorwein::default()),
        limited: Some(|limit| Box::new(BarzilaiBorwein { iterations: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "admm",
        default: || Box::new(AlternatingDirections::default()),
        limited: Some(|limit| Box::new(AlternatingDirections { iterations: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "nonsmooth-newton",
        default: || Box::new(NonsmoothNewton::default()),
        limited: Some(|limit| Box::new(NonsmoothNewton { steps: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "jean-moreau",
        default: || Box::new(NonsmoothNewton::jean_moreau()),
        limited: Some(|limit| Box::new(NonsmoothNewton { steps: limit, ..NonsmoothNewton::jean_moreau() })),
    },
    SolverEntry {
        name: "fischer-burmeister",
        default: || Box::new(FischerBurmeister::default()),
        limited: Some(|limit| Box::new(FischerBurmeister { steps: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "proximal-newton",
        default: || Box::new(ProximalNewton::default()),
        limited: Some(|limit| Box::new(ProximalNewton { steps: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "interior-point",
        default: || Box::new(InteriorPoint::default()),
        limited: Some(|limit| Box::new(InteriorPoint { steps: limit, ..Default::default() })),
    },
    SolverEntry {
        name: "convex-subproblems",
        default: || Box::new(ConvexSubproblems::default()),
        limited: Some(|limit| Box::new(ConvexSubproblems { steps: limit, ..Default::default() })),
    },
    #[cfg(feature = "clarabel")]
    SolverEntry { name: "clarabel", default: || Box::new(ClarabelPolished), limited: None },
    SolverEntry {
        name: "newton",
        default: || Box::new(GaussNewton::default()),
        limited: Some(|limit| Box::new(GaussNewton { steps: limit, ..Default::default() })),
    },
];

impl Solvers {
    /// The algorithms of this crate.
    pub fn own() -> Self {
        Solvers(OWN.to_vec())
    }

    /// A table of these solvers alone.
    pub fn of(entries: &[SolverEntry]) -> Self {
        Solvers(entries.to_vec())
    }

    /// The same table with more solvers at its end.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a name is there already: a name stands for one algorithm.
    pub fn with(mut self, more: &[SolverEntry]) -> Result<Self> {
        for entry in more {
            if self.names().any(|name| name == entry.name) {
                return Err(Error::invalid(
                    "name",
                    format!("`{}` is a solver of the table already", entry.name),
                    "give yours another name",
                ));
            }
            self.0.push(*entry);
        }
        Ok(self)
    }

    /// The names, in order.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.0.iter().map(|entry| entry.name)
    }

    /// The solver of this name with its default settings.
    ///
    /// # Errors
    /// [`Error::Unsupported`] lists the names there are.
    /// ```
    /// use moreau_contact::solvers::Solvers;
    ///
    /// let solvers = Solvers::own();
    /// assert_eq!(solvers.by_name("lemke")?.name(), "lemke");
    /// assert!(solvers.by_name("lemk").err().expect("misspelt").to_string().contains("lemke"));
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn by_name(&self, name: &str) -> Result<Box<dyn ContactSolver>> {
        self.entry(name).map(|entry| (entry.default)())
    }

    /// The solver of this name with another limit of its iterations, from 1 to [`MOST_ITERATIONS`]; with its own if none is given.
    ///
    /// # Errors
    /// [`Error::Unsupported`] lists the names there are; [`Error::Invalid`] if the limit is outside its range, or if the solver has none.
    pub fn with_iterations(&self, name: &str, iterations: Option<usize>) -> Result<Box<dyn ContactSolver>> {
        let entry = self.entry(name)?;
        let Some(limit) = iterations else { return Ok((entry.default)()) };
        if !(1..=MOST_ITERATIONS).contains(&limit) {
            return Err(Error::invalid("iterations", format!("is {limit}"), format!("use a number from 1 to {MOST_ITERATIONS}")));
        }
        let limited = entry.limited.ok_or_else(|| {
            Error::invalid("iterations", format!("is given to `{}`, which has no such limit", entry.name), "leave it out")
        })?;
        Ok(limited(limit))
    }

    /// The names of those that take this problem and promise a solution, in order: each is asked by [`ContactSolver::takes`], and by
    /// solving, which is ended at its first look; what it takes more memory for than is allowed it does not take.
    /// ```
    /// use moreau_contact::nalgebra::{DMatrix, dvector};
    /// use moreau_contact::prelude::*;
    /// use moreau_contact::solvers::Solvers;
    ///
    /// let block = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]).build()?;
    /// let solvers = Solvers::own();
    /// let taking: Vec<&str> = solvers.taking(&block).collect();
    /// assert!(taking.contains(&"pgs") && !taking.contains(&"lemke")); // Coulomb's law in space is no LCP
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn taking<'a>(&'a self, problem: &'a ContactProblem) -> impl Iterator<Item = &'static str> + 'a {
        let symmetric = problem.asymmetry() <= SYMMETRY;
        let takes = move |entry: &&SolverEntry| {
            let solver = (entry.default)();
            let in_scope = !solver.is_truncated() && solver.takes(problem.law(), problem.rows_per_contact(), symmetric);
            in_scope && !is_refused(solver.as_ref(), problem)
        };
        self.0.iter().filter(takes).map(|entry| entry.name)
    }

    /// The error of a solver of this table, and, where that refused the problem, who takes it; the first few of them.
    pub fn with_cure(&self, error: Error, problem: &ContactProblem) -> Error {
        match error {
            Error::Solver { solver, failure: Failure::Refused, reason } => {
                let others = self.taking(problem).filter(|name| *name != solver);
                let taking: Vec<String> = others.take(NAMED).map(|name| format!("`{name}`")).collect();
                let cure = match taking.split_last() {
                    None => "no solver takes this problem".to_string(),
                    Some((only, [])) => format!("use {only}, which takes this problem"),
                    Some((last, others)) => format!("use {} or {last}, which take this problem", others.join(", ")),
                };
                Error::refused(solver, format!("{reason}; {cure}"))
            }
            Error::InFile { file, inner } => self.with_cure(*inner, problem).in_file(&file),
            other => other,
        }
    }

    fn entry(&self, name: &str) -> Result<&SolverEntry> {
        let unknown = || {
            if name == "clarabel" && !cfg!(feature = "clarabel") {
                return Error::Unsupported("this program was built without the feature `clarabel` of moreau-contact".into());
            }
            Error::Unsupported(format!("there is no solver `{name}`; use one of {}", self.names().collect::<Vec<_>>().join(", ")))
        };
        self.0.iter().find(|entry| entry.name == name).ok_or_else(unknown)
    }
}

/// Whether it refuses the problem, or has no room for it; an iteration ends at its first look.
fn is_refused(solver: &dyn ContactSolver, problem: &ContactProblem) -> bool {
    let ended = Interrupt::default();
    ended.now();
    let (answer, _) = watched(&ended, || solver.solve(problem, None));
    match answer {
        Ok(_) => false,
        Err(Error::Solver { failure, .. }) => failure == Failure::Refused,
        Err(_) => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::BlockSparse;
    use crate::problem::Law;
    use nalgebra::{DVector, dmatrix};

    #[test]
    fn every_listed_name_is_a_solver_of_that_name_and_others_get_the_list() {
        let solvers = Solvers::own();
        for name in solvers.names() {
            assert_eq!(solvers.by_name(name).expect("listed").name(), name);
        }
        let message = solvers.by_name("gauss").err().unwrap().to_string();
        assert!(solvers.names().all(|name| message.contains(name)), "{message}");
        assert_eq!(solvers.names().any(|name| name == "clarabel"), cfg!(feature = "clarabel"));
        if !cfg!(feature = "clarabel") {
            assert!(solvers.by_name("clarabel").err().unwrap().to_string().contains("feature `clarabel`"));
        }
    }

    #[test]
    fn who_has_no_room_or_is_for_smaller_problems_is_not_recommended_however_large_the_problem_is() {
        let solvers = Solvers::own();
        let problem = |contacts: usize| {
            let blocks = (0..contacts).map(|k| (k, k, dmatrix![2.0])).collect();
            let w = BlockSparse::new(1, contacts, blocks).expect("blocks on the diagonal");
            ContactProblem::new(w, DVector::from_element(contacts, -1.0)).rows_per_contact(1).law(Law::Frictionless).build().expect("posed")
        };
        let told = |problem: &ContactProblem| solvers.with_cure(Error::refused("pgs", "planted"), problem).to_string();
        assert!(told(&problem(30)).ends_with("use `auto`, `lemke` or `murty`, which take this problem"));
        // M of 20 000 unknowns takes 3.2 GB, and its pivots six times as much
        let large = problem(20_000);
        assert!(told(&large).ends_with("use `auto`, `psor` or `apgd`, which take this problem"), "{}", told(&large));
        assert!(!solvers.taking(&large).any(|name| name == "enumeration"));
    }

    #[test]
    fn an_added_solver_is_found_and_two_of_one_name_are_refused() {
        let mine = SolverEntry { name: "mine", default: || Box::new(Auto), limited: None };
        assert!(Solvers::own().by_name("mine").is_err());
        assert!(Solvers::own().with(&[mine]).expect("a new name").by_name("mine").is_ok());
        assert_eq!(Solvers::of(&[mine]).names().collect::<Vec<_>>(), ["mine"]);
        let twice = Solvers::of(&[mine]).with(&[mine]).expect_err("two of one name");
        assert!(twice.to_string().contains("`mine`"), "{twice}");
    }

    #[test]
    fn a_limit_of_iterations_is_refused_outside_its_range_and_where_there_is_none() {
        let refused = |name: &str, limit: usize| Solvers::own().with_iterations(name, Some(limit)).err().map(|error| error.to_string());
        for (name, limit) in [("pgs", 0), ("pgs", MOST_ITERATIONS + 1), ("lemke", 5)] {
            assert!(refused(name, limit).expect("refused").contains("iterations"), "{name}");
        }
        assert_eq!(refused("pgs", MOST_ITERATIONS), None);
        assert!(Solvers::own().with_iterations("lemke", None).is_ok());
    }
}
