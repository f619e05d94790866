//! What §6 says of cost, scale, fidelity, reversibility and gradients: what of it can be decided.

use crate::certificate::residuals;
use crate::checks::energy::worked_ball;
use crate::claims::experiments::soft_stack::{self, STEP};
use crate::claims::prelude::*;
use crate::closed_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::exact_particle::BallState;
use crate::mechanics::{PointMass, State};
use crate::problem::{Compliance, ContactProblem, Law};
use crate::schemes::mujoco::{Cone, Mujoco};
use crate::schemes::{Activation, Anitescu, assembled, run, step};
use crate::solvers::gauss::GaussProgram;
use crate::solvers::{AcceleratedProjectedGradient, ContactSolver, GaussNewton};
use crate::tolerance::claims::soft::{AT_TOUCH, COUNTED, SOLVED, TOUCH, TURNED_ROUND};
use crate::tolerance::cli::CERTIFY;

const MODEL: &str = "MuJoCo documentation, Computation (3.17)";
/// Height \[m\] of a drop that ends on the floor.
const DROP: f64 = 0.2;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.mjx-gradients",
        statement: "Gradients are well defined everywhere, so MJX is differentiable.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: "The optimum is a Lipschitz function of the step's data while the set of contacts stays the same. The step as a \
            function of the state jumps where a moving contact enters that set, so it has no gradient there.",
        argument: r"A ball of 1 kg that falls at 1 m/s, $10^{-12}$ m above and below touch: $v^+$ differs by $d_0\,h\,(g + b\,v) = 0.207$
            m/s, the same at a thousandth of the distance. MJX itself was not run; its issue tracker reports NaN gradients.",
        controls: &["The ball at rest without weight, where nothing jumps."],
        sources: &["chapter §6, consequences", MODEL, "github.com/google-deepmind/mujoco, issues 1517 and 2841"],
        check: check!(jump_at_touch),
    },
    Claim {
        id: "S6.time-reversible",
        statement: "Soft, convex and continuous in time means reversible in time: the inverse dynamics have a closed form.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"Forces follow from accelerations in closed form, $f = -\nabla s(Ja - a_\text{ref})$. That is invertibility;
            the motion itself is not reversible, since contact dissipates.",
        argument: "Stack of three: an arbitrary change of velocity has a closed-form push that causes it, and Newton finds it again from \
            the push. A ball dropped from 2 m and turned round in the air after half a second returns to its start. One dropped from 0.2 m \
            comes back to its bed on the floor instead, 0.2 m below its start.",
        controls: &[
            "The drop from 2 m, which no contact ends.",
            "The push without the contact forces, and the turn with the velocity of the step in place of the middle one.",
        ],
        sources: &["chapter §6, consequences", "Todorov, Convex and analytically-invertible dynamics with contacts and constraints (2014)"],
        check: check!(reversal),
    },
    Claim {
        id: "S6.hard-engine-cost",
        statement: "Hard constraints need exact collision detection and the solution of complementarity problems, and are hard to run in \
            parallel on GPUs.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Speed on a machine is no mathematical statement. What can be decided: hard contact alone does not make a step \
            a complementarity problem that needs more than convex minimisation; Coulomb's law does. Soft contact reads the same gaps.",
        argument: "The hard step of Anitescu for a stack of three is solved by projected gradients to the certificate, as MuJoCo's soft \
            step is. With Coulomb's law in place of the associated one the method refuses: no convex problem is left.",
        controls: &["Coulomb's law."],
        sources: &["chapter §6, philosophy"],
        check: check!(hard_and_convex),
    },
    Claim {
        id: "S6.pyr-faster",
        statement: "Pyramidal cones are faster to compute.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "It depends on the model, as MuJoCo's documentation says. A pyramid has four rows for three but a piecewise \
            quadratic cost: it pays where Newton saves more steps than the fourth row costs.",
        argument: r"Multiplications of Newton until the change of velocity is right to a high accuracy, $n\,n_v^2 + n_v^3/3$ per step with
            $n$ rows and $n_v$ velocities: fewer over pyramids on a stack of ten, where $n$ is 160 against 120; a fifth more on one ball,
            which takes one step over either cone.",
        controls: &["The stack of ten and the ball exchanged."],
        sources: &["chapter §6, step 4", MODEL],
        check: check!(row_counts),
    },
    Claim {
        id: "S6.less-rigid-than-sap",
        statement: "Rigid fidelity is limited: hard objects penetrate a little, and for tasks that need precise rigid contact forces \
            (fine force control) it is not as good as Drake's SAP or Siconos.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Measured by the depth at rest: against Siconos, whose contact is rigid, always. Against SAP with MuJoCo's \
            defaults and 1e5 N/m: both are soft, by parameters, and either can be made the softer one. (The force at rest is the weight in \
            all three.)",
        argument: r"Depth of 1 kg on one contact: 3.67e-4 m in MuJoCo by default, 9.81e-5 m in SAP with 1e5 N/m, 0 after a hundred rigid
            steps of Moreau–Jean in rationals; with solref $(-10^6, -10^3)$ MuJoCo's is smaller than SAP's.",
        controls: &[
            "MuJoCo's default in both comparisons.",
            "SAP with 1e4 N/m, and a start 1 mm deep, which a velocity-level scheme keeps.",
        ],
        sources: &["chapter §6, consequences", MODEL],
        check: check!(depths),
    },
    Claim {
        id: "S6.gpu-scale",
        statement: "It is made for reinforcement learning in a million parallel environments.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "No mathematical statement. What a step needs for it holds: environments do not couple, so that each can be \
            stepped alone.",
        argument: "The program of two stacks side by side has the minimisers of the two as its minimiser, to the solver's stopping rule.",
        controls: &["Two stacks coupled by their mass."],
        sources: &["chapter §6, philosophy"],
        check: check!(independent_worlds),
    },
];

/// v⁺ of a ball of 1 kg at a gap and velocity.
fn after_step(gravity: f64, gap: f64, velocity: f64) -> Result<f64> {
    let ball = PointMass::ball_on_floor(1.0, gravity, 0.0);
    let state = State { time: 0.0, position: dvector![gap], velocity: dvector![velocity] };
    Ok(step(&Mujoco::default(), &GaussNewton::default(), &ball, &state, STEP)?.state.velocity[0])
}

fn jump_at_touch(reading: Reading) -> Result<Vec<Finding>> {
    let (gravity, velocity) = reading.pick((9.81, -1.0), (0.0, 0.0));
    let (_, damping) = ContactParameters::default().stiffness_and_damping(STEP);
    let expected = ContactParameters::default().impedance[0] * STEP * (9.81 + damping);
    let jump = |gap: f64| -> Result<f64> { Ok(after_step(gravity, -gap, velocity)? - after_step(gravity, gap, velocity)?) };
    let tolerance = AT_TOUCH * expected;
    let [near, nearer] = TOUCH;
    Ok(vec![
        Finding::equal("jump of v⁺ across touch, 10⁻¹² m away", jump(near)?, expected, tolerance, "m/s").says(0.0),
        Finding::equal("jump of v⁺ across touch, 10⁻¹⁵ m away", jump(nearer)?, expected, tolerance, "m/s").says(0.0),
    ])
}

/// How far a ball dropped from a height is from its start after half a second, a reversal and half a second. The scheme's velocities belong
/// to the middles of its steps, hence a turn by g h: without contact the way back is the way there.
fn return_error(height: f64, turn: f64) -> Result<f64> {
    let gravity = 9.81;
    let ball = PointMass::ball_on_floor(1.0, gravity, 0.0);
    let start = State { time: 0.0, position: dvector![height], velocity: dvector![0.0] };
    let half = |state: State| run(&Mujoco::default(), &GaussNewton::default(), &ball, state, STEP, 250, |_| ());
    let turned = half(start)?;
    let back = half(State { velocity: dvector![turn - turned.velocity[0]], ..turned })?;
    Ok((back.position[0] - height).abs())
}

fn reversal(reading: Reading) -> Result<Vec<Finding>> {
    let again = soft_stack::found_again(reading.only(1).pick(1.0, 0.0))?;
    let turn = reading.only(1).pick(9.81 * STEP, 0.0);
    let lost = return_error(reading.only(0).pick(DROP, 2.0), 9.81 * STEP)?;
    let (invertible, reversible) = ("forces follow from accelerations", "a motion that is turned round runs back");
    Ok(vec![
        Finding::at_most("change of velocity found again from its push, relative", again, SOLVED, "1").reading(invertible),
        Finding::at_most("distance from the start after turning round in the air", return_error(2.0, turn)?, TURNED_ROUND, "m")
            .reading(reversible),
        Finding::at_least("distance from the start after turning round on the floor", lost, DROP, "m")
            .says_at_most(TURNED_ROUND)
            .reading(reversible),
    ])
}

fn hard_and_convex(reading: Reading) -> Result<Vec<Finding>> {
    let (mechanism, state) = soft_stack::stack(3, 1.0)?;
    let hard = assembled(&Anitescu, &mechanism, &state, STEP)?.problem;
    let mut findings = Vec::new();
    for (name, problem) in [("hard", hard), ("soft", Some(soft_stack::problem(3, 1.0, Cone::Elliptic)?))] {
        let problem = problem.ok_or_else(|| crate::Error::Unsupported("the boxes overlap and touch".into()))?;
        let law = reading.pick(problem.law(), Law::Coulomb);
        let problem = problem.into_builder().law(law).build()?;
        let answer = AcceleratedProjectedGradient::default().solve(&problem, None);
        let solved = answer.is_ok_and(|answer| residuals(&problem, &answer).is_ok_and(|judged| judged.is_solution(CERTIFY)));
        findings.push(
            Finding::decision(format!("the {name} step is solved by projected gradients"), solved, true)
                .opinion("what is hard on a machine"),
        );
    }
    Ok(findings)
}

/// Rows of a problem, and Newton's multiplications on it.
fn newton_work(problem: &ContactProblem) -> Result<[f64; 2]> {
    let program = GaussProgram::of_problem("newton", problem)?;
    let (n, nv) = (program.rows() as f64, program.velocities() as f64);
    let newton = GaussNewton { tolerance: COUNTED, ..GaussNewton::default() };
    let steps = newton.minimise(&program, DVector::zeros(program.velocities()))?.iterations as f64;
    Ok([n, steps * (n * nv * nv + nv.powi(3) / 3.0)])
}

fn row_counts(reading: Reading) -> Result<Vec<Finding>> {
    let stack = |cone: Cone| soft_stack::problem(10, 1.0, cone).and_then(|problem| newton_work(&problem));
    let small = |cone: Cone| soft_stack::ball(cone).and_then(|problem| newton_work(&problem));
    let of_both = |work: &dyn Fn(Cone) -> Result<[f64; 2]>| -> Result<_> { Ok([work(Cone::Pyramidal)?, work(Cone::Elliptic)?]) };
    let (ten, one) = (of_both(&stack)?, of_both(&small)?);
    let ([pyramid, round], [small_pyramid, small_round]) = reading.pick((ten, one), (one, ten));
    Ok(vec![
        Finding::equal("rows of pyramids, stack of ten", ten[0][0], 160.0, 0.0, "1").context(),
        Finding::equal("rows of round cones, stack of ten", ten[1][0], 120.0, 0.0, "1").context(),
        Finding::at_most("multiplications over pyramids against round cones, stack of ten", pyramid[1] / round[1], 1.0, "1").experiment(),
        Finding::at_least("multiplications over pyramids against round cones, one ball", small_pyramid[1] / small_round[1], 1.0, "1")
            .experiment()
            .says_at_most(1.0)
            .violating("Newton saves more steps than the fourth row costs"),
    ])
}

fn depths(reading: Reading) -> Result<Vec<Finding>> {
    let depth = |reference: [f64; 2]| ContactParameters { reference, ..ContactParameters::default() }.rest_depth(STEP, 1.0, 9.81);
    let sap = SapContact {
        time_step: STEP,
        stiffness: reading.only(1).pick(1e5, 1e4),
        relaxation_time: 0.005,
        diagonal_mean: 1.0,
        tangential_ratio: TANGENTIAL_RATIO,
        friction: 0.5,
    };
    let sap = -sap.rest_gap(9.81);
    let standard = ContactParameters::default().reference;
    let stiff = reading.only(0).pick([-1e6, -1e3], standard);
    let resting = BallState { position: reading.only(1).pick(ratio(0, 1), ratio(-1, 1000)), velocity: ratio(0, 1) };
    let rigid_step = |now| worked_ball().moreau_jean(&now, &ratio(1, 1), Activation::Gap, &ratio(1, 500)).motion;
    let rigid = (0..100).fold(resting, |now, _| rigid_step(now));
    let bound = crate::tolerance::rounding(64, 0.001);
    Ok(vec![
        Finding::equal("depth of 1 kg, SAP", sap, 9.81 / 1e5, bound, "m").context(),
        Finding::at_most("depth of 1 kg, MuJoCo's default", depth(standard)?, 0.001, "m").context(),
        Finding::exact("height of a ball at rest on a rigid contact", &rigid.position, &ratio(0, 1), "m"),
        Finding::at_least("MuJoCo's default depth over SAP's", depth(standard)? / sap, 1.0, "1"),
        Finding::at_most("MuJoCo's stiff depth over SAP's", depth(stiff)? / sap, 1.0, "1")
            .says_at_least(1.0)
            .violating("MuJoCo's default parameters"),
    ])
}

fn independent_worlds(reading: Reading) -> Result<Vec<Finding>> {
    let alone = soft_stack::problem(3, 1.0, Cone::Elliptic)?;
    let both = side_by_side(&alone, reading.pick(0.0, 0.5))?;
    let (one, two) = (GaussNewton::default().solve(&alone, None)?.impulse, GaussNewton::default().solve(&both, None)?.impulse);
    let n = one.len();
    let far = (two.rows(0, n) - &one).norm().max((two.rows(n, n) - &one).norm()) / one.norm();
    Ok(vec![
        Finding::at_most("impulses of two worlds in one problem against each alone, relative", far, SOLVED, "1")
            .opinion("what it is made for"),
    ])
}

/// Two copies of a problem in one, their masses coupled by this part of the mass.
fn side_by_side(problem: &ContactProblem, coupling: f64) -> Result<ContactProblem> {
    let missing = || crate::Error::Unsupported("a soft step has mass, Jacobian and compliance".into());
    let dynamics = problem.dynamics().ok_or_else(missing)?;
    let compliance = problem.compliance().ok_or_else(missing)?;
    let double = |x: &DVector<f64>| DVector::from_iterator(2 * x.len(), x.iter().chain(x.iter()).copied());
    let blocks = |matrix: &nalgebra::DMatrix<f64>, beside: f64| {
        let (n, m) = matrix.shape();
        let mut both = nalgebra::DMatrix::zeros(2 * n, 2 * m);
        for (row, column, scale) in [(0, 0, 1.0), (n, m, 1.0), (0, m, beside), (n, 0, beside)] {
            both.view_mut((row, column), (n, m)).copy_from(&(matrix * scale));
        }
        both
    };
    let (mass, jacobian) = (blocks(&dynamics.mass, coupling), blocks(&dynamics.jacobian, 0.0));
    problem
        .clone()
        .into_builder()
        .name("two worlds")
        .friction(problem.friction().iter().chain(problem.friction()).copied().collect())
        .free_velocity(double(problem.free_velocity()))
        .shift(double(problem.shift()))
        .delassus(crate::contact::delassus::delassus(&mass, &jacobian)?)
        .compliance(Compliance { coordinates: compliance.coordinates, diagonal: double(&compliance.diagonal) })
        .dynamics(crate::problem::Dynamics { mass, jacobian })
        .bodies(None)
        .build()
}
