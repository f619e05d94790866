//! Solvers of the one convex problem: the same optimum, warm starts, the rate of Gauss–Seidel; and Anitescu's problem beside it.

use super::duality::{box_on_corners, contacts_alone};
use super::program::Program;
use crate::claims::experiments::soft_stack::{self, STEP};
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::soft_impedance::SoftImpedance;
use crate::closed_forms::soft_reference::SoftReference;
use crate::problem::{Compliance, Coordinates};
use crate::schemes::mujoco::{Cone, Mujoco};
use crate::schemes::{assembled, step};
use crate::solvers::gauss::GaussProgram;
use crate::solvers::{
    AcceleratedProjectedGradient, ClarabelPolished, ContactSolver, GaussConjugateGradient, GaussNewton, ProjectedGaussSeidel,
};
use crate::tolerance::claims::pathology::AT_REST;
use crate::tolerance::claims::soft::two_contacts;

const MODEL: &str = "MuJoCo documentation, Computation: constraint model (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.same-optimum",
        statement: "PGS, CG and Newton solve the same convex problem; changing the solver changes speed and accuracy, not the physics.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, once converged: the problem is strictly convex (S6.R-uniqueness).",
        argument: "Two coupled soft contacts, by projected Gauss–Seidel, accelerated projected gradients, Clarabel, and enumeration in \
            rationals: the same forces to the solvers' stopping rule times the conditioning. MuJoCo's own solvers are compared on stored \
            steps in tests/references.",
        controls: &["One sweep of Gauss–Seidel.", r"The problem without $R$ for the other two solvers."],
        sources: &["chapter §6, step 5 and the pitfall on solvers", MODEL],
        check: check!(same_optimum),
    },
    Claim {
        id: "S6.unique-warmstart",
        statement: "Convexity gives one global optimum per step, so that the last step's solution can start the next one and convergence \
            is fast.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated; it is $R > 0$, strict convexity, that makes the optimum unique.",
        argument: r"Box on four corners, $R = 1/9$: enumeration finds one optimum; with $R = 0$, which is convex too, at least two. Ten
            steps of a stack of two under MuJoCo's model: conjugate gradients started from the change of velocity of the step before need
            fewer iterations in all than from zero.",
        controls: &[r"$R = 0$ in place of 1/9, and 1/9 in place of 0.", "Every step started from zero."],
        sources: &["chapter §6, bridge", MODEL],
        check: check!(warm_start),
    },
    Claim {
        id: "S6.pgs-sublinear",
        statement: "PGS converges at first order, sublinearly.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "It converges linearly: the problem is strictly convex, and over a polyhedron Gauss–Seidel contracts the error \
            by a constant factor from some sweep on. The factor may be close to one.",
        argument: r"Two coupled soft contacts, both closed: every sweep multiplies the error by exactly
            $H_{12}^2/(H_{11}H_{22}) = 19/157$, sweeps 3 to 10 in rationals. The factor of a sublinear sequence rises towards 1.",
        controls: &[r"Sweeps averaged with the weight $1/(k + 1)$, which do converge sublinearly."],
        sources: &["chapter §6, table of solvers", "Luo and Tseng, On the convergence of the coordinate descent method (1992)"],
        check: check!(gauss_seidel),
    },
    Claim {
        id: "S6.same-as-anitescu",
        statement: r"MuJoCo's dual problem and Anitescu's convex problem are the same thing, up to continuous or discrete time and
            acceleration or impulse; they differ only in that MuJoCo adds $R$ and softens the cone, so that MuJoCo is a special case of
            Anitescu's route with a softening regularisation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"They coincide for $R = 0$, $b = 1/h$, $k\,d = 1/h^2$ and equal cones, with $\gamma = h\,f$. MuJoCo's
            parameters do not reach that: $R \ge \hat A/9999$, and timeconst $\ge 2h$ gives $k\,d\,h^2 \le 1/(4d)$ at $\zeta = 1$, a
            quarter, while $b\,h$ is at most $1/d$.",
        argument: r"$h\,(a_u - a_\text{ref}) = v_\text{free} + \varphi/h$ for $b = 1/h$ and $k\,d = 1/h^2$, in rationals at $\varphi = -1$
            mm, $v = -3$ m/s, $a_u = -10$ m/s², $h = 1/100$ s. At timeconst $2h$, $\zeta = 1$ and the largest $d$: $b\,h = 10000/9999$,
            $k\,d\,h^2 = 2500/9999$, $R/\hat A = 1/9999$.",
        controls: &[
            r"$b = 1/h$ and $k\,d = 1/h^2$ in place of MuJoCo's stiffest parameters.",
            r"$k = 0$, the gap term $\varphi/h$ forgotten.",
        ],
        sources: &[
            "chapter §6, insight on Anitescu's problem",
            "Anitescu, Optimization-based simulation of nonsmooth rigid multibody dynamics (2006)",
        ],
        check: check!(anitescu),
    },
    Claim {
        id: "S6.impratio",
        statement: "impratio sets the ratio of normal to tangential impedance; a larger one makes friction harder.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"Larger is harder, as stated. $R_n/R_t$ = impratio: with “impedance” for $R$, as in the chapter's table of
            symbols, the sentence is right; with impedance as what is hard, as in its step 3, impratio is the ratio of tangential to
            normal.",
        argument: r"Creep of one elliptic contact under a tangential load, $v_t = R_t\,f_t/b$: ten times smaller with impratio 10, at an
            unchanged depth; hence $R_n/R_t = 10$ and, of the hardness $1/R$, a tenth.",
        controls: &["impratio 1."],
        sources: &["chapter §6, step 4", "MuJoCo documentation, option impratio (3.17)"],
        check: check!(impedance_ratio),
    },
];

fn same_optimum(reading: Reading) -> Result<Vec<Finding>> {
    let (pair, problem) = contacts_alone();
    let exact = pair.optima().remove(0).map(|force| Scalar::to_f64(&force));
    let sweeps = reading.only(0).pick(ProjectedGaussSeidel::default().sweeps, 1);
    let hard = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::zeros(2) };
    let others = reading.only(1).pick(problem.clone(), problem.clone().into_builder().compliance(hard).build()?);
    let solvers: [&dyn ContactSolver; 3] =
        [&ProjectedGaussSeidel { sweeps, ..ProjectedGaussSeidel::default() }, &AcceleratedProjectedGradient::default(), &ClarabelPolished];
    let bound = two_contacts(exact.norm(), problem.free_velocity().amax() + problem.shift().amax());
    let mut findings = Vec::new();
    for (solver, problem) in solvers.into_iter().zip([&problem, &others, &others]) {
        let force = solver.solve(problem, None)?.impulse;
        findings.push(Finding::equal(format!("distance from the optimum, {}", solver.name()), (force - &exact).norm(), 0.0, bound, "N"));
    }
    Ok(findings)
}

fn warm_start(reading: Reading) -> Result<Vec<Finding>> {
    let count = |softness: Rational| box_on_corners(softness).optima().len();
    let [soft, hard] = reading.only(0).pick([ratio(1, 9), ratio(0, 1)], [ratio(0, 1), ratio(1, 9)]);
    let [warm, cold] = iterations(reading.only(1).pick(true, false))?;
    Ok(vec![
        Finding::count("optima on four corners", count(soft), 1),
        Finding::decision("at least two optima with R = 0", count(hard) >= 2, true),
        Finding::decision("fewer iterations from the step before than from zero", warm < cold, true).experiment(),
    ])
}

/// Iterations of conjugate gradients over ten steps of a stack of two, each started from the change of velocity of the step before (or from
/// zero), and each from zero.
fn iterations(warm: bool) -> Result<[usize; 2]> {
    let (mechanism, mut state) = soft_stack::stack(2, 1.0)?;
    let scheme = Mujoco::standard(Cone::Elliptic);
    let mut before: Option<DVector<f64>> = None;
    let mut counts = [0; 2];
    for _ in 0..10 {
        let problem = assembled(&scheme, &mechanism, &state, STEP)?.problem;
        let problem = problem.ok_or_else(|| Error::Unsupported("the boxes touch".into()))?;
        let program = GaussProgram::of_problem("warm", &problem)?;
        let zero = DVector::zeros(program.velocities());
        let start = before.take().filter(|_| warm).unwrap_or_else(|| zero.clone());
        let answers = [start, zero].map(|start| GaussConjugateGradient::default().minimise(&program, start));
        counts = [counts[0] + answers[0].iterations, counts[1] + answers[1].iterations];
        before = Some(answers[0].change.clone());
        state = step(&scheme, &GaussNewton::default(), &mechanism, &state, STEP)?.state;
    }
    Ok(counts)
}

/// One sweep of exact projected Gauss–Seidel on two one-sided rows.
fn sweep(program: &Program, force: &[Rational; 2]) -> [Rational; 2] {
    let (h, b) = (program.hessian(), program.linear());
    let positive = |x: Rational| x.max(ratio(0, 1));
    let first = positive(-(&b[0] + &h[(0, 1)] * &force[1]) / &h[(0, 0)]);
    let second = positive(-(&b[1] + &h[(1, 0)] * &first) / &h[(1, 1)]);
    [first, second]
}

fn gauss_seidel(reading: Reading) -> Result<Vec<Finding>> {
    let (pair, _) = contacts_alone();
    let optimum = pair.optima().remove(0);
    let mut force = [ratio(0, 1), ratio(0, 1)];
    let mut errors = Vec::new();
    for k in 1..=10 {
        let next = sweep(&pair, &force);
        let weight = reading.pick(ratio(1, 1), ratio(1, k + 1));
        force = [0, 1].map(|i| &force[i] + (&next[i] - &force[i]) * &weight);
        errors.push(&force[1] - &optimum[1]);
    }
    let factors: Vec<Rational> = errors.windows(2).skip(1).map(|pair| &pair[1] / &pair[0]).collect();
    let rises = factors.windows(2).all(|pair| pair[1] > pair[0]);
    let one = factors.iter().all(|factor| *factor == ratio(19, 157));
    Ok(vec![
        Finding::decision("the factor of the error rises from sweep to sweep, towards 1", rises, false).says(true),
        Finding::decision("every sweep multiplies the error by 19/157", one, true).says(false),
    ])
}

fn anitescu(reading: Reading) -> Result<Vec<Finding>> {
    let (h, gap, rate, free) = (ratio(1, 100), ratio(-1, 1000), ratio(-3, 1), ratio(-10, 1));
    let hardest = SoftImpedance::constant(ratio(1, 1));
    let stiffest = SoftReference::limited(&ratio(0, 1), &ratio(1, 1), &h, hardest.clone());
    let d = hardest.at_width();
    let identical = SoftReference { stiffness: ratio(1, 1) / (&h * &h * &d), damping: ratio(1, 1) / &h, impedance: hardest };
    let gapless = SoftReference { stiffness: ratio(0, 1), ..identical.clone() };
    let reference = reading.only(1).pick(&identical, &gapless).acceleration(&gap, &rate);
    let [stiffness, damping] = reading.only(0).pick(&stiffest, &identical).coefficients(&ratio(1, 1000));
    let condition = "b = 1/h and k d = 1/h²";
    Ok(vec![
        Finding::exact("h (a_u − a_ref)", &(&h * (&free - reference)), &(&rate + &h * &free + &gap / &h), "m/s"),
        Finding::exact("b h of the stiffest contact", &(&damping * &h), &ratio(10_000, 9999), "1").says(ratio(1, 1)).violating(condition),
        Finding::exact("k d h² of the stiffest contact", &(&stiffness * &h * &h), &ratio(2500, 9999), "1")
            .says(ratio(1, 1))
            .violating(condition),
        Finding::exact("R/Â of the stiffest contact", &((ratio(1, 1) - &d) / &d), &ratio(1, 9999), "1").context(),
    ])
}

fn impedance_ratio(reading: Reading) -> Result<Vec<Finding>> {
    let contact = |impedance_ratio: f64| ContactParameters { impedance_ratio, ..ContactParameters::default() };
    let (step, normal, tangential) = (0.001, 9.2, 3.4);
    let creep = |impratio: f64| contact(impratio).creep_speed(step, 1.0, normal, tangential);
    let depth = |impratio: f64| contact(impratio).rest_depth(step, 1.0, normal);
    let larger = reading.pick(10.0, 1.0);
    let standard = contact(1.0);
    let (_, damping) = standard.stiffness_and_damping(step);
    // v_t = R_t f_t/b
    let of_normal = standard.normal_regularisation(depth(1.0)?, 1.0);
    let of_friction = creep(larger)? * damping / tangential;
    let bound = 10.0 * AT_REST;
    Ok(vec![
        Finding::equal("creep at impratio 1 over that at 10", creep(1.0)? / creep(larger)?, 10.0, bound, "1"),
        Finding::equal("depth at impratio 1 over that at 10", depth(1.0)? / depth(larger)?, 1.0, AT_REST, "1").context(),
        Finding::equal("R, normal over tangential, impratio 10", of_normal / of_friction, 10.0, bound, "1")
            .says(10.0)
            .reading("impedance is R, as in the table of symbols"),
        Finding::equal("1/R, normal over tangential, impratio 10", of_friction / of_normal, 0.1, AT_REST, "1")
            .says(10.0)
            .reading("impedance is what is hard, as in step 3"),
    ])
}
