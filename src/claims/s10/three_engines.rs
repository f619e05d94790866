//! The rows of Chrono, Bullet and Pinocchio: their steps and solvers rebuilt, their packages and stored motions read.

use crate::checks::Finding;
use crate::claims::experiments::facts;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::mechanics::{PointMass, State};
use crate::problem::{ContactProblem, Law, Solution};
use crate::schemes::{Bullet, Chrono, step};
use crate::solvers::{self, AlternatingDirections, ClarabelPolished, ContactSolver};
use crate::stored::{RUNS, problem_and_answer, read_by};
use crate::tolerance::claims::engines as tolerance;
use crate::trajectory::Trajectory;
use crate::{Error, Result};
use nalgebra::dvector;
use serde_json::Value;

const BOX_SLIDE: &str = "pinocchio/box-slide.json";
const BOX_SLIDE_RELAXED: &str = "pinocchio/box-slide-associated.json";
const BOX_SOFT: &str = "pinocchio/box-soft.json";
const BOUNCE: &str = "bullet/ball_bounce__multi__h0.01.json";
const SUNK: &str = "bullet/ball_sunk__multi__h0.01.json";

/// The solvers of Chrono's repository at commit 7689fbc of 2026-08-18, `src/chrono/solver/`; Chrono is in no package registry.
const CHRONO_SOLVERS: [&str; 5] = ["ChSolverADMM.cpp", "ChSolverAPGD.cpp", "ChSolverBB.cpp", "ChSolverPJacobi.cpp", "ChSolverPSOR.cpp"];

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S10.chrono-row",
        statement: "Chrono NSC: Anitescu's semi-implicit step, or HHT; solvers APGD (Nesterov), PSOR, BB, ADMM; a convex cone \
            complementarity problem.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "NSC is Anitescu's step, with a maximal recovery speed for penetrations and with rebounds, and the four \
            algorithms solve its convex problem. HHT integrates smooth forces: it belongs to Chrono's other system, of penalty contacts \
            (SMC).",
        argument: "Each of the four, programmed from its equations, gives the velocities of Clarabel's interior point on the step of a \
            sliding block, and the gap μ h v_t of the relaxation, at every step length; a body 0.1 m deep comes out at 0.6 m/s. \
            `ChSolver::Type` names PSOR, BARZILAIBORWEIN, APGD, ADMM; a contact's constraint is loaded by `ChContactNSC`, which HHT does \
            not solve as an inequality.",
        control: "Coulomb's law in place of the relaxation: no gap.",
        sources: &[
            "chapter §10, table of simulators",
            "Project Chrono, commit 7689fbc: ChSolver.h, ChContactNSC.cpp, ChTimestepperImplicit.cpp",
        ],
        check: chrono_row,
    },
    Claim {
        id: "S10.chrono-granular",
        statement: "Chrono NSC handles granular flow of more than a million bodies and extends to GPUs.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Not decided here: no run of that size can be made or checked. What can be said is that its solvers need no \
            matrix W, without which such a size would be out of reach.",
        argument: "A million bodies with three contacts each have 9·10⁶ rows. A dense W would take 6.5·10¹⁴ bytes; H with 12 entries per \
            row takes 8.6·10⁸. APGD, BB and PSOR use products with H and M⁻¹ only.",
        control: "The dense W fits into a terabyte.",
        sources: &["chapter §10, table of simulators"],
        check: granular,
    },
    Claim {
        id: "S10.bullet-row",
        statement: "Bullet: semi-implicit Euler with sequential impulses (projected Gauss–Seidel), MLCP by Lemke or Dantzig; Newton's e \
            through a bias velocity, Baumgarte's ERP; h from 1 ms to 1/60 s.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated. The bias is e|u_n| + ERP d/h for a depth d, and e|u_n| − d/h for a gap d, u_n after gravity \
            (multibodies) or before (rigid bodies): a rebound equals e only up to these terms. ERP of contacts is 0.2 in Bullet and 0.08 \
            in PyBullet.",
        argument: "Stored motions of PyBullet 3.2.7: the first rebound of a ball equals e(|v| + g h) + ERP d/h, and a ball 1 cm deep rises \
            so that its depth shrinks by 0.92 in every step, each to 1e-12; the scheme `bullet` reproduces every sample. The source names \
            the solvers and 1/60 s.",
        control: "ERP 0.2, Bullet's own default, in the same formulas.",
        sources: &["chapter §10, table of simulators", "PyBullet 3.2.7, source distribution", "references/bullet"],
        check: bullet_row,
    },
    Claim {
        id: "S10.pinocchio-row",
        statement: "Pinocchio 3 / Simple: an NCP or SOCCP per step, rigid and compliant alike, by ADMM with automatic ρ and a proximal \
            term, PGS, or as CCP.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "So it is in the release 4.1.0, where Coulomb's law is the default and the convex problem a switch of ADMM \
            (`solve_ncp` = false), which PGS does not heed. And Pinocchio is no simulator: a step, its contacts and their stabilisation \
            come from elsewhere.",
        argument: "Stored answers of 4.1.0 for a sliding box, hard and with compliance 1/16 kg⁻¹, under Coulomb's law and relaxed: our \
            ADMM, with ρ found by itself and the proximal term, finds the same velocities to 1e-7 m/s or better, and the certificate \
            accepts them.",
        control: "The relaxed answer in place of the one under Coulomb's law.",
        sources: &["chapter §10, table of simulators", "Pinocchio 4.1.0: ADMMConstraintSolver", "references/pinocchio"],
        check: pinocchio_row,
    },
    Claim {
        id: "S10.route-pinocchio",
        statement: "Drake's SAP and Pinocchio's ADMM are the convex primal school, the industrial form of Anitescu's relaxation.",
        verdict: ClaimVerdict::Inconsistent,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: "Of SAP it holds. Pinocchio's ADMM solves Coulomb's law unless told otherwise, as the chapter's own table says \
            (NCP); with `solve_ncp` = false it solves the relaxation.",
        argument: "A box that slides on four corners: by default the loaded corners stay on the ground, u_n = 0; relaxed they leave it \
            with u_n = μ‖u_t‖. Both answers are stored and certified.",
        control: "The relaxed answer as the default one.",
        sources: &["chapter §10, four routes, against its table of simulators", "references/pinocchio"],
        check: route,
    },
    Claim {
        id: "S10.path-chrono",
        statement: "Chrono: src/chrono/solver/ChSolverAPGD.cpp, ChSolverADMM.cpp, ChSolverPSOR.cpp.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated, at commit 7689fbc of 2026-08-18.",
        argument: "The three files are in the folder; the one of Barzilai and Borwein, which the chapter does not list, is ChSolverBB.cpp.",
        control: "ChSolverBarzilaiBorwein.cpp.",
        sources: &["chapter §10, source files", "Project Chrono, commit 7689fbc, src/chrono/solver"],
        check: path_chrono,
    },
    Claim {
        id: "S10.path-bullet",
        statement: "Bullet: src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated. PyBullet's bodies are multibodies by default, and these are solved in \
            src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp.",
        argument: "Both are in the source distribution of PyBullet 3.2.7.",
        control: "The file in the folder of the MLCP solvers.",
        sources: &["chapter §10, source files", "PyBullet 3.2.7, source distribution: references/bullet/package.json"],
        check: path_bullet,
    },
    Claim {
        id: "S10.path-pinocchio",
        statement: "Pinocchio: include/pinocchio/algorithm/admm-solver.hxx, contact-cholesky.hpp.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "So in Pinocchio 3. In 4.1.0 the solver is algorithm/solvers/admm-solver.hpp with \
            src/algorithm/solvers/admm-solver.hxx, and contact-cholesky.hpp stands under deprecated/.",
        argument: "The files of the wheel libpinocchio 4.1.0, listed.",
        control: "The printed path in 4.1.0.",
        sources: &["chapter §10, source files", "libpinocchio 4.1.0: references/pinocchio/package.json"],
        check: path_pinocchio,
    },
];

/// Problem and answer of a stored `answer/1`.
fn stored(path: &str) -> Result<(ContactProblem, Solution)> {
    problem_and_answer(&RUNS, path)
}

fn chrono_row(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let (mu, slope) = (0.2, PointMass::block_on_incline(1.0, 9.81, 0.35, 0.2, 0.0));
    for h in [0.02, 0.005] {
        let start = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![1.0, 0.0] };
        let assembled = step(&Chrono::default(), &ClarabelPolished, &slope, &start, h)?.assembled;
        let problem = assembled.problem.ok_or_else(|| Error::Unsupported("the block touches".into()))?;
        let expected = ClarabelPolished.solve(&problem, None)?.velocity;
        let problem = problem.into_builder().law(reading.pick(Law::Associated, Law::Coulomb)).build()?;
        let names: &[&str] = reading.pick(&["psor", "bb", "apgd", "admm"], &["psor", "admm"]);
        for name in names {
            let found = solvers::ALL.by_name(name)?.solve(&problem, None)?.velocity;
            let difference = (&found - &expected).amax();
            findings.push(Finding::at_most(format!("{name} against Clarabel, h = {h}"), difference, tolerance::same_answer(1.0), "m/s"));
            let gap = (found[0] - mu * found[1].abs()).abs();
            findings.push(Finding::at_most(format!("{name}: u_n − μ|u_t|, h = {h}"), gap, tolerance::same_answer(1.0), "m/s"));
        }
    }
    let sunk = State { time: 0.0, position: dvector![-0.1], velocity: dvector![0.0] };
    let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
    let rising = step(&Chrono::default(), &ClarabelPolished, &ball, &sunk, 0.01)?.state.velocity[0];
    findings.push(Finding::equal("speed at which a depth of 0.1 m is undone", rising, 0.6, tolerance::same_answer(1.0), "m/s"));
    findings.push(Finding::decision("Chrono has a solver of Barzilai and Borwein", CHRONO_SOLVERS.contains(&"ChSolverBB.cpp"), true));
    Ok(findings)
}

fn granular(reading: Reading) -> Result<Vec<Finding>> {
    let rows = 3.0 * 3.0 * 1_000_000.0;
    let [dense, sparse] = [8.0 * rows * rows, 8.0 * 12.0 * rows];
    let terabyte = 1_000_000_000_000.0;
    Ok(vec![
        Finding::at_least("dense W over what can be stored", reading.pick(dense, sparse), terabyte, "B"),
        Finding::at_most("H of two bodies per contact", sparse, terabyte, "B"),
    ])
}

/// Height above the ground and vertical velocity of a stored ball, sample by sample.
fn ball(path: &str) -> Result<(f64, Vec<[f64; 2]>)> {
    let run = read_by(&RUNS, path, Trajectory::from_json)?;
    let radius = run.scene.bodies[0].sphere.as_ref().map_or(0.0, |sphere| sphere.radius);
    let track = &run.bodies[0];
    Ok((run.time_step, track.position.iter().zip(&track.linear_velocity).map(|(x, v)| [x[2] - radius, v[2]]).collect()))
}

fn bullet_row(reading: Reading) -> Result<Vec<Finding>> {
    let scheme = Bullet { error_reduction: reading.pick(Bullet::default().error_reduction, 0.2), ..Bullet::default() };
    let (h, bounce) = ball(BOUNCE)?;
    let k = bounce.iter().position(|[_, v]| *v > 0.0).ok_or_else(|| Error::Unsupported("the ball rebounds".into()))?;
    let ([gap, before], after) = (bounce[k - 1], bounce[k][1]);
    let distance = gap + scheme.slop;
    let bias = 0.5 * (before - 9.81 * h).abs() - if distance > 0.0 { distance } else { scheme.error_reduction * distance } / h;
    let (_, sunk) = ball(SUNK)?;
    let package = facts::bullet()?.stated;
    let ratio = (sunk[1][0] + scheme.slop) / (sunk[0][0] + scheme.slop);
    Ok(vec![
        Finding::equal("first rebound less e(|v| + g h) less the term of the depth", after - bias, 0.0, tolerance::stored(1.0 / h), "m/s"),
        Finding::equal(
            "depth after a step over that before it",
            ratio,
            1.0 - scheme.error_reduction,
            tolerance::stored(1.0 / sunk[0][0].abs()),
            "1",
        ),
        Finding::decision("the solvers' files", package.has("/btLemkeSolver.h") && package.has("/btDantzigSolver.h"), true),
        Finding::decision("h = 1/60 s unless set", package.says("/btContactSolverInfo.h", "m_timeStep = btScalar(1.f / 60.f);"), true),
    ])
}

fn pinocchio_row(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let other = stored(BOX_SLIDE_RELAXED)?.1;
    for (name, path) in [("hard", BOX_SLIDE), ("with compliance", BOX_SOFT), ("relaxed", BOX_SLIDE_RELAXED)] {
        let (problem, answer) = stored(path)?;
        let theirs = reading.pick(answer.velocity, other.velocity.clone());
        let ours = AlternatingDirections::default().solve(&problem, None)?;
        let difference = (&ours.velocity - &theirs).amax();
        findings.push(Finding::at_most(format!("our ADMM against Pinocchio's, {name}"), difference, tolerance::SAME_VELOCITY, "m/s"));
    }
    Ok(findings)
}

fn route(reading: Reading) -> Result<Vec<Finding>> {
    let relaxed = stored(BOX_SLIDE_RELAXED)?;
    let settings = facts::pinocchio()?.stated.settings;
    let default = reading.pick(stored(BOX_SLIDE)?, relaxed.clone());
    let lift = |(problem, answer): &(ContactProblem, Solution), share: f64| {
        let loaded = (0..problem.contacts()).filter(|k| answer.impulse[3 * k] > tolerance::SAME_VELOCITY);
        loaded
            .map(|k| {
                let slip = answer.velocity[3 * k + 1].hypot(answer.velocity[3 * k + 2]);
                (answer.velocity[3 * k] - share * problem.friction()[k] * slip).abs()
            })
            .fold(0.0, f64::max)
    };
    Ok(vec![
        Finding::at_most("u_n at the loaded corners, by default", lift(&default, 0.0), tolerance::SAME_VELOCITY, "m/s"),
        Finding::at_most("u_n − μ‖u_t‖ there, relaxed", lift(&relaxed, 1.0), tolerance::SAME_VELOCITY, "m/s"),
        Finding::decision("`solve_ncp` is true unless set", settings["solve_ncp"] == Value::Bool(true), true),
    ])
}

fn path_chrono(reading: Reading) -> Result<Vec<Finding>> {
    let names = ["ChSolverAPGD.cpp", "ChSolverADMM.cpp", reading.pick("ChSolverPSOR.cpp", "ChSolverBarzilaiBorwein.cpp")];
    Ok(names.map(|name| Finding::decision(name, CHRONO_SOLVERS.contains(&name), true)).to_vec())
}

pub(in crate::claims) fn path_bullet(reading: Reading) -> Result<Vec<Finding>> {
    let folder = reading.pick("ConstraintSolver", "MLCPSolvers");
    let path = format!("src/BulletDynamics/{folder}/btSequentialImpulseConstraintSolver.cpp");
    let multibody = "src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp";
    let package = facts::bullet()?.stated;
    Ok(vec![Finding::decision(&*path, package.has(&path), true), Finding::decision(multibody, package.has(multibody), true)])
}

pub(in crate::claims) fn path_pinocchio(reading: Reading) -> Result<Vec<Finding>> {
    let (package, printed) = (facts::pinocchio()?.stated, reading.pick(false, true));
    Ok(vec![
        Finding::decision("the printed path in 4.1.0", package.has("include/pinocchio/algorithm/admm-solver.hxx"), printed),
        Finding::decision("its new path", package.has("include/pinocchio/algorithm/solvers/admm-solver.hpp"), true),
        Finding::decision(
            "contact-cholesky.hpp under deprecated/",
            package.has("deprecated/pinocchio/algorithm/contact-cholesky.hpp"),
            true,
        ),
    ])
}
