//! The three algorithms on one problem: Newton, conjugate gradients, and sweeps along rays and discs; MuJoCo's iterates from our formulas.

use crate::certificate::residuals;
use crate::claims::experiments::mujoco::{facts, sliding_block};
use crate::claims::experiments::soft_stack::{self, STEP};
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::mechanics::spatial::{Shape, SpatialBody};
use crate::mechanics::{Mechanism, Plane, PointMass, SpatialBodies, State};
use crate::problem::ContactProblem;
use crate::schemes::mujoco::{Cone, Mujoco};
use crate::schemes::{Activation, Anitescu, MoreauJean, StewartTrinkle, Waist, assembled};
use crate::solvers::gauss::{GaussProgram, Minimiser, SoftPiece};
use crate::solvers::{ContactSolver, Direction, GaussConjugateGradient, GaussNewton, GaussSweeps};
use crate::tolerance::claims::soft::{COUNTED, FEW, INDISTINGUISHABLE, ITERATES, LOW, SAME_LEVER, SOLVED, TOUCH};
use crate::tolerance::claims::thresholds::{DIFFERENT, MORE_WORK, SQUARINGS};
use crate::tolerance::rounding;

const SOURCE: &str = "MuJoCo documentation, Computation: solver algorithms (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.delassus-unifies",
        statement: r"All four formats of constrained dynamics meet in $W = J\,M^{-1}J^T$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated of the dual problems, which the chapter compares here. The primal solvers, Newton and CG in MuJoCo
            and SAP's in Drake, minimise over velocities and never form $W$; what they find is the same.",
        argument: r"One ball in touch with the floor: Moreau–Jean, Stewart–Trinkle, Anitescu and MuJoCo assemble the same $W$. The stored
            sliding block: Newton on $M$, $J$ and $b$ alone and sweeps on $W + R$ give the same impulses.",
        controls: &[
            r"$A + R$ in place of A for MuJoCo.",
            "A ball that cannot turn, a point mass, for Stewart–Trinkle and Anitescu.",
            "A single sweep on the dual.",
        ],
        sources: &["chapter §6, step 3", SOURCE],
        check: check!(primal_and_dual),
    },
    Claim {
        id: "S6.cg-prp",
        statement: "CG is the nonlinear method of Polak and Ribière (plus).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: r"True of MuJoCo up to 3.9; from 3.10 on the direction is Hager and Zhang's. With an exact line search the two
            are one formula while $\beta \ge 0$: $p^Tg^+ = 0$ turns one into the other.",
        argument: "The change log puts Hager and Zhang's direction into 3.10.0, and 3.17.0 is stored. Its accelerations after 1 to 5 \
            iterations of CG from free motion, exact line search, sliding block, both cones: both formulas reproduce them to 1e-9 of their \
            size. Steepest descent does not.",
        controls: &["Release 3.9.0.", "Steepest descent and the conjugate directions exchanged."],
        sources: &["chapter §6, table of solvers", "MuJoCo change log, 3.10.0, item 6 (commit 828052e6)", "references/facts/mujoco.json"],
        check: check!(conjugate_directions),
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
        argument: r"Second derivative of the cost of one contact along $t_2$ at two points of the same zone: equal to the last bit for a
            one-sided row, different for a slipping cone.",
        controls: &["The one-sided row and the cone exchanged."],
        sources: &["chapter §6, table of solvers", SOURCE],
        check: check!(piecewise_quadratic),
    },
    Claim {
        id: "S6.pgs-qcqp",
        statement: "With elliptic cones PGS alternates a step along the ray of the current force and a small problem with a quadratic \
            constraint for friction.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated.",
        argument: "That MuJoCo does it is read from its source (engine_solver.c, solPGS). That the two substeps suffice is shown by ours: \
            from zero to the optimum of the stored sliding block, by the certificate; one sweep does not get there.",
        controls: &["One sweep."],
        sources: &["chapter §6, table of solvers", SOURCE],
        check: check!(rays_and_discs),
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
            relative gradient below 1e-10. A few counts as ten.",
        controls: &["Conjugate gradients."],
        sources: &["chapter §6, table of solvers", SOURCE],
        check: check!(few_iterations),
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
        argument: r"Change of velocity after ten sweeps from zero against Newton's, in the norm of $M$: 14 % of it is wrong in a stack of
            ten boxes, 16 % with mass ratio 2, 0.24 % for a single box. One per cent counts as a difference.",
        controls: &["Five thousand sweeps.", "One sweep."],
        sources: &["chapter §6, table of solvers", SOURCE],
        check: check!(ten_sweeps),
    },
    Claim {
        id: "S6.pgs-fastest",
        statement: "PGS is the fastest of the three (with low accuracy), CG in the middle, Newton the most accurate.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "No order holds for all models. On one contact PGS needs the least work; on stacks conjugate gradients need \
            less, for a low accuracy as for a high one.",
        argument: r"Multiplications until the change of velocity is right to a low accuracy, a tenth, and to a high one, counted from
            iterations, rows $n$ and velocities $n_v$: $n^2n_v$ once and $n^2/2$ per sweep for PGS, $n\,n_v^2 + n_v^3/3$ per Newton step,
            $2n\,n_v + n_v^2$ per step of CG. A stack of ten boxes costs PGS more than twice what CG needs, a single ball less.",
        controls: &["The ball in place of the stack.", "A stack of five in place of either."],
        sources: &["chapter §6, pitfall on solvers", SOURCE],
        check: check!(work),
    },
    Claim {
        id: "S6.solver-dependence",
        statement: "If results change with the solver, that is mostly lack of convergence of one of them, not other physics.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, for one step's problem: it is strictly convex. (The post-processing `noslip` is not part of it.)",
        argument: "Newton, conjugate gradients and sweeps on a stack of three: the same impulses once each is at rest, different ones \
            after ten sweeps.",
        controls: &["Ten sweeps.", "Ten steps of conjugate gradients, and the sweeps run to the end."],
        sources: &["chapter §6, pitfall on solvers", SOURCE],
        check: check!(solver_dependence),
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

/// A ball of 1 kg in touch with the floor, and its state.
fn rolling_ball() -> Result<(SpatialBodies, State)> {
    let ball = SpatialBody::solid("ball", Shape::Sphere { radius: 0.1 }, 1.0)?;
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0)?;
    let position = dvector![0.0, 0.0, 0.1 - TOUCH[0], 1.0, 0.0, 0.0, 0.0];
    let state = State { time: 0.0, position, velocity: DVector::zeros(6) };
    Ok((SpatialBodies::new("ball", vec![ball], [0.0, 0.0, -9.81], ground)?, state))
}

/// The same as a point mass.
fn point() -> Result<(PointMass, State)> {
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0)?;
    let state = State { time: 0.0, position: dvector![0.0, 0.0, -TOUCH[0]], velocity: DVector::zeros(3) };
    Ok((PointMass::new("ball", 1.0, dvector![0.0, 0.0, -9.81], vec![ground])?, state))
}

/// The matrix of the dual problem [1/kg] that a scheme poses, with or without its R.
fn dual_operator(scheme: &dyn Waist, softened: bool, mechanism: &dyn Mechanism, state: &State) -> Result<DMatrix<f64>> {
    let untouched = || crate::Error::Unsupported("a ball in touch has a contact".into());
    let problem = assembled(scheme, mechanism, state, STEP)?.problem.ok_or_else(untouched)?;
    let softness = |i: usize, j: usize| if softened && i == j { problem.row_compliance(i) } else { 0.0 };
    Ok(DMatrix::from_fn(problem.rows(), problem.rows(), |i, j| problem.entry(i, j) + softness(i, j)))
}

fn primal_and_dual(reading: Reading) -> Result<Vec<Finding>> {
    let moreau_jean = MoreauJean { activation: Activation::Gap, ..MoreauJean::default() };
    let ((ball, state), (point, at)) = (rolling_ball()?, point()?);
    let first = dual_operator(&moreau_jean, false, &ball, &state)?;
    let (hard, start): (&dyn Mechanism, &State) = reading.only(1).pick((&ball, &state), (&point, &at));
    let distance = |scheme: &dyn Waist| -> Result<f64> { Ok((dual_operator(scheme, false, hard, start)? - &first).amax()) };
    let others = [distance(&StewartTrinkle::default())?, distance(&Anitescu)?];
    let softened = reading.only(0).pick(false, true);
    let soft = (dual_operator(&Mujoco::standard(Cone::Elliptic), softened, &ball, &state)? - &first).amax();
    let (problem, _) = sliding_block(Cone::Elliptic)?;
    let sweeps = swept(&problem, reading.only(2).pick(GaussSweeps::default().sweeps, 1))?;
    Ok(vec![
        Finding::at_most("W of Stewart–Trinkle against that of Moreau–Jean", others[0], SAME_LEVER, "1/kg"),
        Finding::at_most("W of Anitescu against that of Moreau–Jean", others[1], SAME_LEVER, "1/kg"),
        Finding::at_most("A of MuJoCo against W of Moreau–Jean", soft, SAME_LEVER, "1/kg"),
        Finding::at_most("impulses of the dual against the primal, relative", relative(&sweeps, &newton(&problem)?), SOLVED, "1"),
    ])
}

/// Largest distance of five iterates of CG from MuJoCo's on the sliding block, relative.
fn iterates(cone: Cone, name: &str, direction: Direction) -> Result<f64> {
    let (problem, step) = sliding_block(cone)?;
    let program = GaussProgram::of_problem("cg", &problem)?;
    let (h, free) = (step.number(&["native", "time_step"])?, step.numbers(&["native", "qacc_smooth"])?);
    let mut worst = 0.0f64;
    for k in 1..=5usize {
        let solver = GaussConjugateGradient { direction, steps: k, tolerance: 0.0 };
        let ours = solver.minimise(&program, DVector::zeros(program.velocities())).change / h + &free;
        let theirs = facts()?.numbers(&["computed", "cg_iterates", name, &(k - 1).to_string()])?;
        worst = worst.max((ours - &theirs).amax() / theirs.amax());
    }
    Ok(worst)
}

/// The direction of a release of MuJoCo, by its change log: Hager and Zhang's from 3.10.0 on.
fn direction_of(release: &str) -> Direction {
    let parts: Vec<usize> = release.split('.').filter_map(|part| part.parse().ok()).collect();
    if parts.as_slice() >= [3, 10].as_slice() { Direction::HagerZhang } else { Direction::PolakRibierePlus }
}

fn conjugate_directions(reading: Reading) -> Result<Vec<Finding>> {
    let release = match reading {
        Reading::Control(0) => "3.9.0".into(),
        _ => facts()?.text(&["version"]),
    };
    let printed = direction_of(&release) == Direction::PolakRibierePlus;
    let mut findings = vec![
        Finding::decision("the direction of the release is Polak and Ribière's, by the change log", printed, false)
            .looked_up()
            .says(true)
            .violating("a release before 3.10"),
    ];
    let [conjugate, descent] =
        reading.only(1).pick([Direction::PolakRibierePlus, Direction::Steepest], [Direction::Steepest, Direction::PolakRibierePlus]);
    for (cone, name) in [(Cone::Elliptic, "elliptic"), (Cone::Pyramidal, "pyramidal")] {
        let distance = |direction: Direction| iterates(cone, name, direction);
        let (printed, newer) = (distance(conjugate)?, distance(Direction::HagerZhang)?);
        let steepest = distance(descent)? <= ITERATES;
        findings.extend([
            Finding::at_most(format!("iterates 1 to 5, {name}, PolakRibierePlus, relative"), printed, ITERATES, "1").experiment(),
            Finding::at_most(format!("iterates 1 to 5, {name}, HagerZhang, relative"), newer, ITERATES, "1").context(),
            Finding::decision(format!("steepest descent has these iterates, {name}"), steepest, false).experiment(),
        ]);
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
    let change = |piece: &SoftPiece| (bend(piece, 0.5) - bend(piece, 0.75)).abs();
    // curvatures are at most 1/R
    let bound = rounding(16, 1.0 / 0.02);
    let (slipping, pressed) = reading.pick((&cone, &row), (&row, &cone));
    Ok(vec![
        Finding::at_least("change of curvature in its zone, slipping contact", change(slipping), bound, "kg")
            .says_at_most(bound)
            .violating("no slip on a round cone"),
        Finding::equal("change of curvature in its zone, one-sided row", change(pressed), 0.0, bound, "kg"),
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
    let steps = (iterations(SOLVED)? - iterations(0.01)?) as f64;
    let mut findings = vec![Finding::at_most("steps from a relative gradient of 1e-2 to 1e-10", steps, SQUARINGS, "1").experiment()];
    findings.extend(lookups::check("S6.newton-desc", reading)?);
    Ok(findings)
}

fn few_iterations(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (boxes, ratio) in [(3, 1.0), (10, 1.0), (10, 2.0)] {
        for cone in [Cone::Elliptic, Cone::Pyramidal] {
            let problem = soft_stack::problem(boxes, ratio, cone)?;
            let program = GaussProgram::of_problem("newton", &problem)?;
            let start = DVector::zeros(program.velocities());
            let (steps, tolerance) = (FEW as usize + 1, SOLVED);
            let Minimiser { change, impulse, iterations, .. } = match reading {
                Reading::Recorded => GaussNewton { steps, tolerance }.minimise(&program, start)?,
                Reading::Control(_) => {
                    GaussConjugateGradient { steps, tolerance, ..GaussConjugateGradient::default() }.minimise(&program, start)
                }
            };
            let (label, left) = (format!("{boxes} boxes, mass ratio {ratio}, {cone:?}"), program.relative_gradient(&change, &impulse));
            findings.push(Finding::at_most(format!("iterations, {label}"), iterations as f64, FEW, "1").experiment());
            findings.push(Finding::at_most(format!("relative gradient then, {label}"), left, SOLVED, "1").experiment());
        }
    }
    Ok(findings)
}

fn ten_sweeps(reading: Reading) -> Result<Vec<Finding>> {
    let sweeps = match reading {
        Reading::Recorded => 10,
        Reading::Control(0) => 5000,
        Reading::Control(_) => 1,
    };
    let error = |boxes: usize, ratio: f64| -> Result<f64> {
        let problem = soft_stack::problem(boxes, ratio, Cone::Pyramidal)?;
        let program = GaussProgram::of_problem("newton", &problem)?;
        let exact = GaussNewton::default().minimise(&program, DVector::zeros(program.velocities()))?.change;
        let change = GaussSweeps { sweeps, ..GaussSweeps::default() }.minimise(&program)?.change;
        Ok(energy_error(&program, &change, &exact))
    };
    let (one, ten, heavy) = (error(1, 1.0)?, error(10, 1.0)?, error(10, 2.0)?);
    Ok(vec![
        Finding::at_most("error after the sweeps, one box", one, INDISTINGUISHABLE, "1").experiment(),
        Finding::at_least("error after the sweeps, ten boxes", ten, INDISTINGUISHABLE, "1")
            .experiment()
            .says_at_most(INDISTINGUISHABLE)
            .violating("few bodies between a contact and the ground"),
        Finding::at_least("error after the sweeps, ten boxes, mass ratio 2", heavy, INDISTINGUISHABLE, "1")
            .experiment()
            .says_at_most(INDISTINGUISHABLE)
            .violating("few bodies between a contact and the ground"),
    ])
}

/// The error of a change of velocity over its size, both in the norm of M.
fn energy_error(program: &GaussProgram, change: &DVector<f64>, exact: &DVector<f64>) -> f64 {
    let size = |x: &DVector<f64>| x.dot(&program.mass().times(x)).sqrt();
    size(&(change - exact)) / size(exact)
}

/// The first power of two that is enough.
fn doubled(enough: impl Fn(usize) -> Result<bool>) -> Result<f64> {
    let mut count = 1;
    while count < 4096 && !enough(count)? {
        count *= 2;
    }
    Ok(count as f64)
}

/// Multiplications of sweeps over those of the cheaper of Newton and conjugate gradients, until the change of velocity is right to an
/// accuracy. Iterations are counted in powers of two, so that the ratio may be wrong by 2.
fn multiplications(problem: &ContactProblem, accuracy: f64) -> Result<f64> {
    let program = GaussProgram::of_problem("newton", problem)?;
    let (n, nv) = (program.rows() as f64, program.velocities() as f64);
    let start = || DVector::zeros(program.velocities());
    let exact = GaussNewton::default().minimise(&program, start())?.change;
    let enough = |change: &DVector<f64>| energy_error(&program, change, &exact) <= accuracy;
    let newton = doubled(|steps| Ok(enough(&GaussNewton { steps, tolerance: 0.0 }.minimise(&program, start())?.change)))?;
    let conjugate = |steps: usize| GaussConjugateGradient { steps, tolerance: 0.0, ..GaussConjugateGradient::default() };
    let gradients = doubled(|steps| Ok(enough(&conjugate(steps).minimise(&program, start()).change)))?;
    let sweeps = doubled(|sweeps| Ok(enough(&GaussSweeps { sweeps, tolerance: 0.0 }.minimise(&program)?.change)))?;
    let others = f64::min(newton * (n * nv * nv + nv.powi(3) / 3.0), gradients * (2.0 * n * nv + nv * nv));
    Ok((n * n * nv + 0.5 * sweeps * n * n) / others)
}

fn work(reading: Reading) -> Result<Vec<Finding>> {
    let ball = soft_stack::ball(Cone::Elliptic)?;
    let many = match reading {
        Reading::Control(0) => ball.clone(),
        _ => soft_stack::problem(reading.only(1).pick(10, 5), 1.0, Cone::Pyramidal)?,
    };
    let single = match reading {
        Reading::Control(1) => many.clone(),
        _ => ball,
    };
    let mut findings = Vec::new();
    for accuracy in [LOW, COUNTED] {
        let name = |model: &str| format!("multiplications of sweeps over the least of the others, to {accuracy:.0e}, {model}");
        findings.push(
            Finding::at_least(name("stack"), multiplications(&many, accuracy)?, MORE_WORK, "1")
                .experiment()
                .says_at_most(1.0)
                .violating("few contacts"),
        );
        findings.push(Finding::at_most(name("one ball"), multiplications(&single, accuracy)?, 1.0, "1").experiment());
    }
    let default = facts()?.number(&["stated", "defaults", "timestep"])?;
    findings.push(Finding::equal("time step", STEP, default, 0.0, "s").context());
    Ok(findings)
}

fn solver_dependence(reading: Reading) -> Result<Vec<Finding>> {
    let problem = soft_stack::problem(3, 1.0, Cone::Elliptic)?;
    let exact = newton(&problem)?;
    let conjugate = GaussConjugateGradient::default();
    let program = GaussProgram::of_problem("newton", &problem)?;
    let steps = reading.only(1).pick(conjugate.steps, 10);
    let gradients = GaussConjugateGradient { steps, ..conjugate }.minimise(&program, DVector::zeros(program.velocities())).impulse;
    let all = GaussSweeps::default().sweeps;
    let sweeps = swept(&problem, reading.only(0).pick(all, 10))?;
    let few = swept(&problem, reading.only(1).pick(10, all))?;
    Ok(vec![
        Finding::at_most("sweeps against Newton, relative", relative(&sweeps, &exact), SOLVED.sqrt(), "1"),
        Finding::at_most("conjugate gradients against Newton, relative", relative(&gradients, &exact), SOLVED.sqrt(), "1"),
        Finding::at_least("ten sweeps against Newton, relative", relative(&few, &exact), DIFFERENT, "1"),
    ])
}
