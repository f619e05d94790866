//! The three algorithms on one problem: Newton, conjugate gradients, and sweeps along rays and discs; MuJoCo's iterates from our formulas.

use crate::Result;
use crate::certificate::residuals;
use crate::checks::Finding;
use crate::claims::experiments::mujoco::{facts, sliding_block};
use crate::claims::experiments::soft_stack::{self, STEP};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::problem::{Compliance, ContactProblem};
use crate::schemes::mujoco::Cone;
use crate::solvers::gauss::{GaussProgram, Minimiser, SoftPiece};
use crate::solvers::{ContactSolver, Direction, GaussConjugateGradient, GaussNewton, GaussSweeps};
use crate::tolerance::claims::soft::{COUNTED, FEW, ITERATES, SOLVED};
use nalgebra::DVector;

const SOURCE: &str = "MuJoCo documentation, Computation: solver algorithms (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.delassus-unifies",
        statement: "All four formats of constrained dynamics meet in W = J M⁻¹Jᵀ.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "In their dual form. The primal solvers, Newton and CG here and SAP's in Drake, minimise over velocities and \
            never form W.",
        argument: "The stored sliding block: Newton on M, J and b alone and sweeps on W + R give the same impulses; with the diagonal of R \
            doubled on one side they do not.",
        control: "R doubled in the dual problem.",
        sources: &["chapter §6, step 3", SOURCE],
        check: primal_and_dual,
    },
    Claim {
        id: "S6.cg-prp",
        statement: "CG is the nonlinear method of Polak and Ribière (plus).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "True of MuJoCo up to 3.9; from 3.10 on the direction is Hager and Zhang's. With an exact line search the two \
            are one formula while β ≥ 0: pᵀg⁺ = 0 turns one into the other.",
        argument: "MuJoCo 3.17's accelerations after 1 to 5 iterations of CG from free motion, exact line search, sliding block, both \
            cones: both formulas reproduce them to 1e-9 of their size. Steepest descent does not.",
        control: "β = 0.",
        sources: &["chapter §6, table of solvers", "MuJoCo change log, 3.10.0, item 6 (commit 828052e6)", "references/facts/mujoco.json"],
        check: conjugate_directions,
    },
    Claim {
        id: "S6.cg-linesearch",
        statement: "CG's line search is exact, with analytic second derivatives of a piecewise quadratic cost, and needs no preparation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "The cost is piecewise quadratic over pyramids. On a round cone that slips it is not: its curvature turns with \
            the direction of slip. The derivatives are analytic in both cases.",
        argument: "Second derivative of the cost of one contact along t₂ at two points of the same zone: equal to the last bit for a \
            one-sided row, different for a slipping cone.",
        control: "The one-sided row in place of the cone.",
        sources: &["chapter §6, table of solvers", SOURCE],
        check: piecewise_quadratic,
    },
    Claim {
        id: "S6.pgs-qcqp",
        statement: "With elliptic cones PGS alternates a step along the ray of the current force and a small problem with a quadratic \
            constraint for friction.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated.",
        argument: "That MuJoCo does it is read from its source (engine_solver.c, solPGS). That the two substeps suffice is shown by ours: \
            from zero to the optimum of the stored sliding block, by the certificate; one sweep does not get there.",
        control: "One sweep.",
        sources: &["chapter §6, table of solvers", SOURCE],
        check: rays_and_discs,
    },
    Claim {
        id: "S6.newton-few",
        statement: "On typical robot models Newton reaches the global optimum in a few iterations.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated, of the models measured here.",
        argument: "Our own Newton from free motion on stacks of 3 and 10 boxes, mass ratios 1 and 2, both cones: five to nine steps to a \
            relative gradient of 1e-10, where conjugate gradients take 112 to 274.",
        control: "Conjugate gradients.",
        sources: &["chapter §6, table of solvers", SOURCE],
        check: few_iterations,
    },
    Claim {
        id: "S6.pgs-10",
        statement: "Ten sweeps of PGS are usually indistinguishable from the global optimum on typical models.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "It depends on the model: with a few bodies on the ground and a good start it is near; the bottom of a stack \
            learns of its top through the boxes between, and ten sweeps from zero leave a visible part of the forces missing.",
        argument: "Change of velocity after ten sweeps from zero against Newton's, in the norm of M: 14 % of it is wrong in a stack of ten \
            boxes, 16 % with mass ratio 2, 0.24 % for a single box.",
        control: "Five thousand sweeps.",
        sources: &["chapter §6, table of solvers", SOURCE],
        check: ten_sweeps,
    },
    Claim {
        id: "S6.pgs-fastest",
        statement: "PGS is the fastest of the three (with low accuracy), CG in the middle, Newton the most accurate.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Measured,
        correct_statement: "No order holds for all models. For a given accuracy PGS needs most on stacks; on one contact it needs least.",
        argument: "Multiplications until the impulses are right to 1e-6, counted from iterations, rows n and velocities n_v: n² per sweep \
            and n²n_v once for PGS, n n_v² + n_v³/3 per Newton step. A stack of ten boxes costs PGS more than Newton, a single ball less.",
        control: "The ball in place of the stack.",
        sources: &["chapter §6, pitfall on solvers", SOURCE],
        check: work,
    },
    Claim {
        id: "S6.solver-dependence",
        statement: "If results change with the solver, that is lack of convergence, not physics.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, for one step's problem: it is strictly convex. (The post-processing `noslip` is not part of it.)",
        argument: "Newton, conjugate gradients and sweeps on a stack of three: the same impulses once each is at rest, different ones \
            after ten sweeps.",
        control: "Ten sweeps.",
        sources: &["chapter §6, pitfall on solvers", SOURCE],
        check: solver_dependence,
    },
];

/// ‖r − s‖/‖s‖.
fn relative(r: &DVector<f64>, s: &DVector<f64>) -> f64 {
    (r - s).norm() / s.norm()
}

fn newton(problem: &ContactProblem) -> Result<DVector<f64>> {
    Ok(GaussNewton::default().solve(problem, None)?.impulse)
}

fn swept(problem: &ContactProblem, sweeps: usize) -> Result<DVector<f64>> {
    Ok(GaussSweeps { sweeps, ..GaussSweeps::default() }.solve(problem, None)?.impulse)
}

fn primal_and_dual(reading: Reading) -> Result<Vec<Finding>> {
    let (problem, _) = sliding_block(Cone::Elliptic)?;
    let softened = |own: &Compliance| Compliance { coordinates: own.coordinates, diagonal: &own.diagonal * reading.pick(1.0, 2.0) };
    let dual = problem.clone().into_builder().compliance(problem.compliance().map(softened)).build()?;
    let sweeps = GaussSweeps::default().solve(&dual, None)?.impulse;
    Ok(vec![Finding::at_most("impulses of the dual against the primal, relative", relative(&sweeps, &newton(&problem)?), SOLVED, "1")])
}

fn conjugate_directions(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let mut findings = Vec::new();
    for (cone, name) in [(Cone::Elliptic, "elliptic"), (Cone::Pyramidal, "pyramidal")] {
        let (problem, step) = sliding_block(cone)?;
        let program = GaussProgram::of_problem("cg", &problem)?;
        let (h, free) = (step.number(&["native", "time_step"])?, step.numbers(&["native", "qacc_smooth"])?);
        for direction in reading.pick(vec![Direction::PolakRibierePlus, Direction::HagerZhang], vec![Direction::Steepest]) {
            let mut worst = 0.0f64;
            for k in 1..=5usize {
                let solver = GaussConjugateGradient { direction, steps: k, tolerance: 0.0 };
                let ours = solver.minimise(&program, DVector::zeros(program.velocities())).change / h + &free;
                let theirs = facts.numbers(&["computed", "cg_iterates", name, &(k - 1).to_string()])?;
                worst = worst.max((ours - &theirs).amax() / theirs.amax());
            }
            findings.push(Finding::at_most(format!("iterates 1 to 5, {name}, {direction:?}, relative"), worst, ITERATES, "1"));
        }
    }
    Ok(findings)
}

fn piecewise_quadratic(reading: Reading) -> Result<Vec<Finding>> {
    let row = SoftPiece::OneSided { softness: 0.1 };
    let cone = SoftPiece::Cone { normal: 0.1, tangential: 0.02, friction: vec![0.5, 0.5] };
    let bend = |piece: &SoftPiece, second: f64| match piece {
        SoftPiece::OneSided { .. } => piece.curvature(&[-1.0 - second])[(0, 0)],
        SoftPiece::Cone { .. } => piece.curvature(&[-0.1, 1.0, second])[(2, 2)],
    };
    let same = |piece: &SoftPiece| bend(piece, 0.5) == bend(piece, 0.75);
    Ok(vec![
        Finding::decision("curvature of a slipping contact is the same all over its zone", same(reading.pick(&cone, &row)), false),
        Finding::decision("curvature of a one-sided row is", same(&row), true),
    ])
}

fn rays_and_discs(reading: Reading) -> Result<Vec<Finding>> {
    let (problem, _) = sliding_block(Cone::Elliptic)?;
    let solver = GaussSweeps { sweeps: reading.pick(GaussSweeps::default().sweeps, 1), ..GaussSweeps::default() };
    let judged = residuals(&problem, &solver.solve(&problem, None)?)?;
    Ok(vec![Finding::at_most("natural map of the sweeps, relative", judged.natural_map / judged.natural_map_scale, SOLVED, "1")])
}

/// Gradient from 10⁻² to 10⁻¹⁰ in at most three Newton steps.
pub(super) fn second_order(reading: Reading) -> Result<Vec<Finding>> {
    let problem = soft_stack::problem(3, 1.0, Cone::Elliptic)?;
    let program = GaussProgram::of_problem("newton", &problem)?;
    let start = || DVector::zeros(program.velocities());
    let iterations = |tolerance: f64| -> Result<usize> {
        let newton = || GaussNewton { tolerance, ..GaussNewton::default() }.minimise(&program, start());
        let gradients = || GaussConjugateGradient { tolerance, ..GaussConjugateGradient::default() }.minimise(&program, start());
        Ok(reading.pick(newton()?, gradients()).iterations)
    };
    let default = facts()?.number(&["stated", "defaults", "solver"])?;
    Ok(vec![
        Finding::at_most("steps from a relative gradient of 1e-2 to 1e-10", (iterations(SOLVED)? - iterations(0.01)?) as f64, 3.0, "1"),
        Finding::equal("default solver", default, facts()?.number(&["stated", "solvers", "NEWTON"])?, 0.0, "1"),
    ])
}

fn few_iterations(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (boxes, ratio) in [(3, 1.0), (10, 1.0), (10, 2.0)] {
        for cone in [Cone::Elliptic, Cone::Pyramidal] {
            let problem = soft_stack::problem(boxes, ratio, cone)?;
            let program = GaussProgram::of_problem("newton", &problem)?;
            let start = DVector::zeros(program.velocities());
            let Minimiser { change, impulse, iterations, .. } = match reading {
                Reading::Recorded => GaussNewton { tolerance: SOLVED, ..GaussNewton::default() }.minimise(&program, start)?,
                Reading::Control => {
                    GaussConjugateGradient { tolerance: SOLVED, ..GaussConjugateGradient::default() }.minimise(&program, start)
                }
            };
            let label = format!("{boxes} boxes, mass ratio {ratio}, {cone:?}");
            findings.push(Finding::at_most(format!("iterations, {label}"), iterations as f64, FEW, "1"));
            findings.push(Finding::at_most(
                format!("relative gradient, {label}"),
                program.relative_gradient(&change, &impulse),
                SOLVED,
                "1",
            ));
        }
    }
    Ok(findings)
}

fn ten_sweeps(reading: Reading) -> Result<Vec<Finding>> {
    let sweeps = reading.pick(10, 5000);
    let error = |boxes: usize, ratio: f64| -> Result<f64> {
        let problem = soft_stack::problem(boxes, ratio, Cone::Pyramidal)?;
        let program = GaussProgram::of_problem("newton", &problem)?;
        let exact = GaussNewton::default().minimise(&program, DVector::zeros(program.velocities()))?.change;
        let error = GaussSweeps { sweeps, ..GaussSweeps::default() }.minimise(&program)?.change - &exact;
        let energy = |x: &DVector<f64>| x.dot(&(program.mass() * x)).sqrt();
        Ok(energy(&error) / energy(&exact))
    };
    let (one, ten, heavy) = (error(1, 1.0)?, error(10, 1.0)?, error(10, 2.0)?);
    Ok(vec![
        Finding::at_least("error after the sweeps, ten boxes", ten, 0.01, "1"),
        Finding::at_least("error after the sweeps, ten boxes, mass ratio 2", heavy, 0.01, "1"),
        Finding::at_most("error of one box over that of ten", one / ten, 0.1, "1"),
    ])
}

/// Multiplications of Newton and of sweeps until the impulses are right to 10⁻⁶.
fn multiplications(problem: &ContactProblem) -> Result<[f64; 2]> {
    let program = GaussProgram::of_problem("newton", problem)?;
    let (n, nv) = (program.rows() as f64, program.velocities() as f64);
    let exact = newton(problem)?;
    let steps =
        GaussNewton { tolerance: COUNTED, ..GaussNewton::default() }.minimise(&program, DVector::zeros(program.velocities()))?.iterations;
    let mut sweeps = 1;
    while relative(&swept(problem, sweeps)?, &exact) > COUNTED && sweeps < 4096 {
        sweeps *= 2;
    }
    Ok([steps as f64 * (n * nv * nv + nv.powi(3) / 3.0), n * n * nv + 0.5 * sweeps as f64 * n * n])
}

fn work(reading: Reading) -> Result<Vec<Finding>> {
    let stack = match reading {
        Reading::Recorded => soft_stack::problem(10, 1.0, Cone::Pyramidal)?,
        Reading::Control => soft_stack::ball(Cone::Elliptic)?,
    };
    let [newton_stack, sweeps_stack] = multiplications(&stack)?;
    let [newton_one, sweeps_one] = multiplications(&soft_stack::ball(Cone::Elliptic)?)?;
    Ok(vec![
        Finding::at_least("multiplications of sweeps over those of Newton, stack", sweeps_stack / newton_stack, 1.0, "1"),
        Finding::at_most("multiplications of sweeps over those of Newton, one ball", sweeps_one / newton_one, 1.0, "1"),
        Finding::equal("time step", STEP, facts()?.number(&["stated", "defaults", "timestep"])?, 0.0, "s"),
    ])
}

fn solver_dependence(reading: Reading) -> Result<Vec<Finding>> {
    let problem = soft_stack::problem(3, 1.0, Cone::Elliptic)?;
    let exact = newton(&problem)?;
    let gradients = GaussConjugateGradient::default().solve(&problem, None)?.impulse;
    let sweeps = swept(&problem, reading.pick(GaussSweeps::default().sweeps, 10))?;
    Ok(vec![
        Finding::at_most("sweeps against Newton, relative", relative(&sweeps, &exact), SOLVED.sqrt(), "1"),
        Finding::at_most("conjugate gradients against Newton, relative", relative(&gradients, &exact), SOLVED.sqrt(), "1"),
        Finding::at_least("ten sweeps against Newton, relative", relative(&swept(&problem, 10)?, &exact), 0.0001, "1"),
    ])
}
