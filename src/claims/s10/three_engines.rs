//! The rows of Chrono, Bullet and Pinocchio: their steps and solvers rebuilt, their packages and stored motions read.

use crate::claims::experiments::soft_stack;
use crate::claims::lookups::{self, looked_up};
use crate::claims::prelude::*;
use crate::mechanics::{PointMass, State};
use crate::problem::{ContactProblem, Law, Solution};
use crate::schemes::mujoco::Cone;
use crate::schemes::{Anitescu, Bullet, Chrono, MoreauJean, Scheme, Step, step};
use crate::solvers::{self, AlternatingDirections, Auto, ClarabelPolished, ContactSolver};
use crate::stored::{RUNS, problem_and_answer, read_by};
use crate::tolerance::claims::engines as tolerance;
use crate::trajectory::Trajectory;

const BOX_SLIDE: &str = "pinocchio/box-slide.json";
const BOX_SLIDE_RELAXED: &str = "pinocchio/box-slide-associated.json";
const BOX_SOFT: &str = "pinocchio/box-soft.json";
const BOUNCE: &str = "bullet/ball_bounce__multi__h0.01.json";
const SUNK: &str = "bullet/ball_sunk__multi__h0.01.json";

const BOX_STICK: &str = "pinocchio/box-stick.json";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S10.chrono-row",
        statement: "Chrono NSC: Anitescu's semi-implicit step, or HHT; solvers APGD (Nesterov), PSOR, BB, ADMM; a convex cone \
            complementarity problem.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "NSC is Anitescu's step, with a maximal recovery speed for penetrations and with rebounds, and the four \
            algorithms solve its convex problem. HHT integrates smooth forces: it belongs to Chrono's other system, of penalty contacts \
            (SMC). Chrono itself was not run: its step and its algorithms are rebuilt here from their sources.",
        argument: r"Each of the four, programmed from its equations, gives the velocities of Clarabel's interior point on the step of a
            sliding block, and the gap $\mu\,h\,v_t$ of the relaxation, at every step length. Chrono's step is Anitescu's there, but a
            body 0.1 m deep comes out at 0.6 m/s, not at the speed that undoes the depth in one step. `ChSolver::Type` names PSOR,
            BARZILAIBORWEIN, APGD, ADMM, each with its source; a contact's constraint is loaded by `ChContactNSC`, which HHT does not
            solve as an inequality.",
        controls: &[
            "A body 5 mm deep, which needs less than 0.6 m/s.",
            "Coulomb's law, under Moreau–Jean's step, in the place of the relaxation; the solvers sought in Chrono::Multicore.",
        ],
        sources: &[
            "chapter §10, table of simulators",
            "Project Chrono, commit 7689fbc: ChSolver.h, ChContactNSC.cpp, ChTimestepperImplicit.cpp",
        ],
        check: check!(chrono_row),
    },
    Claim {
        id: "S10.chrono-granular",
        statement: "Chrono NSC handles granular flow of more than a million bodies and extends to GPUs.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "Of the package Chrono: its module Chrono::DEM runs on GPUs, but with penalty contacts (SMC), not with NSC; \
            the NSC of Chrono::Multicore is parallel on processors. No run of a million bodies was made or checked here; memory does not \
            forbid it.",
        argument: r"At the commit named below the sources for GPUs (.cu) of contacts are all below src/chrono_dem/, and none is below
            src/chrono/ or src/chrono_multicore/. A million bodies with three contacts each, as $H$ and $W$ of a stack of boxes have them:
            0.432 and 2.592 GB without zeros. With all zeros both would be out of reach.",
        controls: &["The folder of Chrono::DEM in place of those with NSC.", r"$H$ and $W$ with all their zeros; sources in OpenCL."],
        sources: &["chapter §10, table of simulators", "Project Chrono, commit 7689fbc, and the documentation of Chrono::DEM in it"],
        check: check!(granular),
    },
    Claim {
        id: "S10.bullet-row",
        statement: r"Bullet: semi-implicit Euler with sequential impulses (projected Gauss–Seidel), MLCP by Lemke or Dantzig; Newton's $e$
            through a bias velocity, Baumgarte's $\mathrm{ERP}$; $h$ from 1 ms to 1/60 s.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: r"As stated. The bias is $e|u_n| + \mathrm{ERP}\,d/h$ for a depth $d$, and $e|u_n| - d/h$ for a gap $d$, $u_n$
            after gravity (multibodies) or before (rigid bodies): a rebound equals $e$ only up to these terms. $\mathrm{ERP}$ of contacts
            is 0.2 in Bullet and 0.08 in PyBullet.",
        argument: r"Stored motions of PyBullet 3.2.7: the first rebound of a ball equals $e(|v| + g\,h) + \mathrm{ERP}\,d/h$, and a ball 1
            cm deep rises so that its depth shrinks by 0.92 in every step, each to rounding; the scheme `bullet` makes the stored samples
            again (tests/systems.rs). The source names the solvers and 1/60 s.",
        controls: &[r"$\mathrm{ERP}$ 0.2, Bullet's own default, in the same formulas; Pinocchio's package in the place of Bullet's."],
        sources: &["chapter §10, table of simulators", "PyBullet 3.2.7, source distribution", "references/bullet"],
        check: check!(bullet_row),
    },
    Claim {
        id: "S10.pinocchio-row",
        statement: r"Pinocchio 3 / Simple: an NCP or SOCCP per step, rigid and compliant alike, by ADMM with automatic $\rho$ and a
            proximal term, PGS, or as CCP.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "All but the CCP in release 3: its ADMM (v3.7.0) always solves Coulomb's law. In 4.1.0 Coulomb's law is the \
            default and the convex problem a switch of ADMM (`solve_ncp` = false), which PGS does not heed. And Pinocchio is no \
            simulator: a step, its contacts and their stabilisation come from elsewhere (Simple was not looked at).",
        argument: r"Stored answers of 4.1.0 for a sliding box, hard and with compliance, under Coulomb's law and relaxed: our ADMM, with
            $\rho$ found by itself and the proximal term, finds the same velocities to 1e-7 m/s or better, and the certificate accepts
            them. ADMM of v3.7.0 takes a proximal term, a power of $\rho$ and a compliance, and nothing that switches the law.",
        controls: &[
            "Release 4.1.0 in place of 3.7.0, asked for the switch.",
            r"The other law in each problem; 4.1.0's name of the rule of $\rho$ asked of 3.7.0; Bullet's package in the place of
                Pinocchio's.",
        ],
        sources: &[
            "chapter §10, table of simulators",
            "Pinocchio 4.1.0: ADMMConstraintSolver; v3.7.0: admm-solver.hpp and .hxx",
            "references/pinocchio",
        ],
        check: check!(pinocchio_row),
    },
    Claim {
        id: "S10.route-pinocchio",
        statement: "Drake's SAP and Pinocchio's ADMM are the convex primal school, the industrial form of Anitescu's relaxation.",
        verdict: ClaimVerdict::Inconsistent,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Cited,
        correct_statement: "Of SAP it holds. Pinocchio's ADMM solves Coulomb's law unless told otherwise, as the chapter's own table says \
            (NCP); with `solve_ncp` = false it solves the relaxation.",
        argument: r"A box that slides on four corners: by default the loaded corners stay on the ground, $u_n = 0$; relaxed they leave it
            with $u_n = \mu\|u_t\|$. Both answers are stored and certified.",
        controls: &[
            "A box that sticks, of which both laws say that it stays on the ground.",
            "The default answer and the relaxed one exchanged; another setting.",
        ],
        sources: &["chapter §10, four routes, against its table of simulators", "references/pinocchio"],
        check: check!(route),
    },
    Claim {
        id: "S10.path-chrono",
        statement: "Chrono: src/chrono/solver/ChSolverAPGD.cpp, ChSolverADMM.cpp, ChSolverPSOR.cpp.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated, at commit 7689fbc of 2026-08-18.",
        argument: "The three files are in the tree of the repository at that commit; the one of Barzilai and Borwein, which the chapter \
            does not list, is ChSolverBB.cpp.",
        controls: &["The folder of Chrono::Multicore, whose solvers have other files."],
        sources: &["chapter §10, source files", "Project Chrono, commit 7689fbc, src/chrono/solver"],
        check: looked_up!("S10.path-chrono"),
    },
    Claim {
        id: "S10.path-bullet",
        statement: "Bullet: src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated. PyBullet's bodies are multibodies by default, and these are solved in \
            src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp.",
        argument: "Both are in the source distribution of PyBullet 3.2.7.",
        controls: &["The file in the folder of the MLCP solvers."],
        sources: &["chapter §10, source files", "PyBullet 3.2.7, source distribution: references/bullet/package.json"],
        check: looked_up!("S10.path-bullet"),
    },
    Claim {
        id: "S10.path-pinocchio",
        statement: "Pinocchio 3: include/pinocchio/algorithm/admm-solver.hxx, contact-cholesky.hpp; files may move a little from version \
            to version.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated, up to 3.7.0 at least. In 4.1.0 the solver is algorithm/solvers/admm-solver.hpp with \
            src/algorithm/solvers/admm-solver.hxx, and contact-cholesky.hpp stands under deprecated/.",
        argument: "The tree of the tag v3.7.0 has both, the wheel libpinocchio 4.1.0, listed, has neither.",
        controls: &["The package 4.1.0 in place of the tree of 3.7.0."],
        sources: &["chapter §10, source files", "Pinocchio, tag v3.7.0", "libpinocchio 4.1.0: references/pinocchio/package.json"],
        check: looked_up!("S10.path-pinocchio"),
    },
];

/// Problem and answer of a stored `answer/1`.
fn stored(path: &str) -> Result<(ContactProblem, Solution)> {
    problem_and_answer(&RUNS, path)
}

/// What the rows of Chrono and of Coulomb's law are compared on: a block that slides at 1 m/s on the ground.
struct Sliding {
    step: f64,
    law: Law,
}

impl Sliding {
    const FRICTION: f64 = 0.2;

    fn taken(&self, scheme: &dyn Scheme) -> Result<Step> {
        let slope = PointMass::block_on_incline(1.0, 9.81, 0.35, Self::FRICTION, 0.0);
        let start = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![1.0, 0.0] };
        step(scheme, &Auto, &slope, &start, self.step)
    }

    /// |v⁺ of the row's step − v⁺ of Anitescu's| \[m/s\].
    fn apart(&self) -> Result<f64> {
        let scheme: &dyn Scheme = if self.law == Law::Associated { &Chrono::default() } else { &MoreauJean::default() };
        Ok((self.taken(scheme)?.state.velocity - self.taken(&Anitescu)?.state.velocity).amax())
    }

    /// |u of the solver − u of Clarabel's relaxation| and |u_n − μ|u_t|| of the solver \[m/s\].
    fn solved(&self, name: &str) -> Result<[f64; 2]> {
        let problem = self.taken(&Chrono::default())?.assembled.problem;
        let problem = problem.ok_or_else(|| Error::Unsupported("the block touches".into()))?;
        let expected = ClarabelPolished.solve(&problem, None)?.velocity;
        let found = if self.law == Law::Associated {
            solvers::ALL.by_name(name)?.solve(&problem, None)?.velocity
        } else {
            Auto.solve(&problem.into_builder().law(self.law).build()?, None)?.velocity
        };
        Ok([(&found - &expected).amax(), (found[0] - Self::FRICTION * found[1].abs()).abs()])
    }
}

fn chrono_row(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.only(1).pick(Law::Associated, Law::Coulomb);
    let slides = [0.02, 0.005].map(|step| Sliding { step, law });
    let most = |measure: &dyn Fn(&Sliding) -> Result<f64>| slides.iter().try_fold(0.0, |most: f64, one| Ok(most.max(measure(one)?)));
    let at_most =
        |name: String, value: Result<f64>| -> Result<Finding> { Ok(Finding::at_most(name, value?, tolerance::same_answer(1.0), "m/s")) };
    let mut findings = vec![at_most("step against Anitescu's".into(), most(&Sliding::apart))?];
    for name in ["psor", "bb", "apgd", "admm"] {
        findings.push(at_most(format!("{name} against Clarabel"), most(&|one| Ok(one.solved(name)?[0])))?);
        findings.push(at_most(format!("{name}: u_n − μ|u_t|"), most(&|one| Ok(one.solved(name)?[1])))?);
    }
    let sunk = State { time: 0.0, position: dvector![-reading.only(0).pick(0.1, 0.005)], velocity: dvector![0.0] };
    let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
    let rising = |scheme: &dyn Scheme| step(scheme, &ClarabelPolished, &ball, &sunk, 0.01).map(|taken| taken.state.velocity[0]);
    let (limited, unlimited) = (rising(&Chrono::default())?, rising(&Anitescu)?);
    findings.push(
        Finding::equal(
            "speed at which a depth of 0.1 m is undone, less Anitescu's",
            limited - unlimited,
            -9.4,
            tolerance::same_answer(10.0),
            "m/s",
        )
        .says(0.0)
        .violating("no depth beyond v_r h"),
    );
    findings.push(Finding::equal("that speed", limited, 0.6, tolerance::same_answer(1.0), "m/s").context());
    findings.extend(lookups::check("S10.chrono-row", reading)?);
    Ok(findings)
}

/// The largest number of entries other than zero in a row.
fn entries_per_row(matrix: &DMatrix<f64>) -> usize {
    matrix.row_iter().map(|row| row.iter().filter(|entry| **entry != 0.0).count()).max().unwrap_or(0)
}

fn granular(reading: Reading) -> Result<Vec<Finding>> {
    let (problem, other) = (soft_stack::problem(12, 1.0, Cone::Elliptic)?, reading.only(1));
    let jacobian = &problem.dynamics().ok_or_else(|| Error::Unsupported("a step has a mass matrix".into()))?.jacobian;
    // three contacts to a body, three rows to a contact, six columns to a body; a large machine has a terabyte
    let (rows, columns, terabyte) = (3 * 3 * 1_000_000, 6 * 1_000_000, 1e3);
    let gigabytes = |entries: usize| 8.0 * entries as f64 * rows as f64 / 1e9;
    // a row without zeros
    let full = |entries: usize| DMatrix::from_element(1, entries, 1.0);
    let of_jacobian = gigabytes(entries_per_row(&if other.is_control() { full(columns) } else { jacobian.clone() }));
    let of_operator = gigabytes(entries_per_row(&if other.is_control() { full(rows) } else { problem.dense().clone() }));
    let mut findings = lookups::check("S10.chrono-granular", reading)?;
    findings.extend([
        Finding::at_most("H of a million bodies", of_jacobian, terabyte, "GB"),
        Finding::at_most("W of a million bodies, without its zeros", of_operator, terabyte, "GB"),
    ]);
    Ok(findings)
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
    let ratio = (sunk[1][0] + scheme.slop) / (sunk[0][0] + scheme.slop);
    let mut findings = vec![
        Finding::equal("first rebound less e(|v| + g h) less the term of the depth", after - bias, 0.0, tolerance::stored(1.0 / h), "m/s")
            .experiment(),
        Finding::equal(
            "depth after a step over that before it, less what the error reduction leaves",
            ratio - (1.0 - scheme.error_reduction),
            0.0,
            tolerance::stored(1.0 / sunk[0][0].abs()),
            "1",
        )
        .experiment(),
        Finding::equal("that depth over the one before", ratio, 0.92, tolerance::stored(1.0 / sunk[0][0].abs()), "1")
            .experiment()
            .context(),
    ];
    findings.extend(lookups::check("S10.bullet-row", reading)?);
    Ok(findings)
}

/// The problem under the other of Coulomb's law and its relaxation.
fn other_law(problem: ContactProblem) -> Result<ContactProblem> {
    let law = if problem.law() == Law::Coulomb { Law::Associated } else { Law::Coulomb };
    problem.into_builder().law(law).build()
}

fn pinocchio_row(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (name, path) in [("hard", BOX_SLIDE), ("with compliance", BOX_SOFT), ("relaxed", BOX_SLIDE_RELAXED)] {
        let (problem, answer) = stored(path)?;
        let problem = reading.only(1).pick(Ok as fn(ContactProblem) -> Result<ContactProblem>, other_law)(problem)?;
        let ours = AlternatingDirections::default().solve(&problem, None)?;
        let difference = (&ours.velocity - &answer.velocity).amax();
        let name = format!("our ADMM against Pinocchio's, {name}");
        findings.push(Finding::at_most(name, difference, tolerance::SAME_VELOCITY, "m/s").experiment());
    }
    findings.extend(lookups::check("S10.pinocchio-row", reading)?);
    Ok(findings)
}

/// The largest |u_n − share · μ‖u_t‖| \[m/s\] at the contacts that carry an impulse.
fn lift((problem, answer): &(ContactProblem, Solution), share: f64) -> f64 {
    let loaded = (0..problem.contacts()).filter(|k| answer.impulse[3 * k] > tolerance::SAME_VELOCITY);
    let one = |k: usize| {
        let slip = answer.velocity[3 * k + 1].hypot(answer.velocity[3 * k + 2]);
        (answer.velocity[3 * k] - share * problem.friction()[k] * slip).abs()
    };
    loaded.map(one).fold(0.0, f64::max)
}

/// Whether the relaxation lifts a loaded contact of this answer, by u_n = μ‖u_t‖.
fn relaxation_lifts((problem, answer): &(ContactProblem, Solution)) -> bool {
    let slip = |k: usize| problem.friction()[k] * answer.velocity[3 * k + 1].hypot(answer.velocity[3 * k + 2]);
    (0..problem.contacts()).any(|k| answer.impulse[3 * k] > tolerance::SAME_VELOCITY && slip(k) > tolerance::SAME_VELOCITY)
}

fn route(reading: Reading) -> Result<Vec<Finding>> {
    let [by_default, relaxed] = reading.only(1).pick([BOX_SLIDE, BOX_SLIDE_RELAXED], [BOX_SLIDE_RELAXED, BOX_SLIDE]);
    let default = stored(reading.only(0).pick(by_default, BOX_STICK))?;
    let lifted = lift(&default, 0.0) > tolerance::SAME_VELOCITY;
    let slides = relaxation_lifts(&default);
    let loaded = || Finding::decision("the loaded corners leave the ground, by default", lifted, false).experiment();
    let mut findings = vec![
        loaded().says(slides).passage("the four routes: the relaxation"),
        loaded().says(false).passage("the table: NCP"),
        Finding::decision("a loaded corner slides, so that the relaxation lifts it", slides, true).context(),
        Finding::at_most("u_n − μ‖u_t‖ there, relaxed", lift(&stored(relaxed)?, 1.0), tolerance::SAME_VELOCITY, "m/s").experiment(),
    ];
    findings.extend(lookups::check("S10.route-pinocchio", reading)?);
    Ok(findings)
}
