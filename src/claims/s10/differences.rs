//! What simulators have in common, and by how much they differ on one scene.

use crate::claims::experiments::creep::Creeping;
use crate::claims::experiments::drake::stored_creep;
use crate::claims::experiments::siconos::deepest;
use crate::claims::experiments::soft::{GRAVITY, default_contact, land, rebound};
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::mujoco_normal::spring_damper_restitution;
use crate::elimination::solve;
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{PointMass, State};
use crate::schemes::{Activation, Anitescu, MoreauJean, Scheme, SchemeParameters, by_name, simulate, step};
use crate::solvers::Auto;
use crate::tolerance::claims::SAME_CREEP;
use crate::tolerance::claims::engines::same_answer;
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::gate::ball::{OSCILLATOR_PARTS, oscillator_rebound};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S10.all-delassus",
        statement: r"All six simulators are built on the Delassus operator $W = JM^{-1}J^T$; they differ in four things only: position or
            velocity level, polyhedral or second-order cone, relaxed or softened or not, numerical algorithm.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Measured,
        correct_statement: r"All solve a problem whose dual has $W$ as its operator; a primal method (SAP's and MuJoCo's Newton) solves it
            without ever forming $W$. But the four things do not determine the motion: stabilisation, the compliance's own law and the
            impact law, for instance, differ between methods that agree in all four, as the chapter's own table shows in its column on
            impacts.",
        argument: r"Tower of three on soft contacts, $R = 1/100$: the primal system $(M + H^TR^{-1}H)\,v = M\,v_\text{free}$ and the dual
            $(W + R)\,r = -H\,v_\text{free}$ give the same velocities exactly. Stored runs of engines that agree in the four things:
            Siconos's ball sinks more than twice as deep into the floor without combined projection as with it; a block on 20° that
            Coulomb holds creeps at another speed under Drake's approximation kSap than under kLagged, which is solved by the same
            solver.",
        controls: &["Two runs with projection; two runs under kLagged.", r"A stiffness in the primal system that is not $1/R$."],
        sources: &[
            "chapter §10, essential insight",
            "Siconos 4.4.0 and Drake 1.51.1, stored runs in references/siconos and references/drake",
        ],
        check: check!(four_dimensions),
    },
    Claim {
        id: "S10.results-differ",
        statement: "Different simulators use different discretisations, cones, relaxations and solvers, so their results differ \
            systematically; that is normal, not a bug.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated. The differences are those of the declared models and can be predicted from them.",
        argument: r"1 kg at rest on the floor: 0 m deep under an LCP scheme, 3.6718e-4 m in MuJoCo. Rebound of the default contact:
            $e^{-2} = 0.135$ in MuJoCo, $e$ in a rigid scheme. Block that should stick on 20°, $h = 10$ ms: 0 (Anitescu), $R_t\,h\,g_t$
            (SAP), $R_t\,g_t/b$ (MuJoCo), 1.0617e-4 m/s (Drake Similar, Lagged). Sliding: $u_n = 0$ under Coulomb, $\mu|u_t|$ under the
            relaxation.",
        controls: &["The simulators exchanged: each measured in the place of another."],
        sources: &[
            "chapter §10, pitfall “another simulator, the same result”",
            "stored runs of MuJoCo 3.17.0 and Drake 1.51.1 agree with these models, see tests/references",
        ],
        check: check!(differences),
    },
    Claim {
        id: "S10.mujoco-gliding",
        statement: r"Exercise 3, one stack of cubes: of Bullet, Drake SAP and MuJoCo, which penetrates least, which trembles most easily,
            which shows $O(h)$ gliding, which has gradients?",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Of gliding: none of them on level ground, where nothing pulls along the contacts. On a slope, or pushed, SAP
            creeps by $O(h)$, MuJoCo at a speed that does not depend on $h$ (set by impratio, solimp and solref), a scheme with hard
            friction not at all.",
        argument: r"Stepped to a steady state on 20°, $\mu = 1/2$, at $h = 0.004$ and 0.002 s: SAP's creep halves, MuJoCo's stays the same
            to rounding, the hard block does not move. On level ground the blocks of drake-sap, mujoco and anitescu stay where they are.",
        controls: &[
            "The slope of 20° in place of level ground.",
            "SAP and MuJoCo exchanged on the slope, MuJoCo in place of the hard block.",
        ],
        sources: &["chapter §10, exercise 3", "stored runs of MuJoCo 3.17.0 and Drake 1.51.1, see tests/references"],
        check: check!(gliding),
    },
];

/// Velocities of a tower of three on soft contacts, R = 1/100, by the primal system with this stiffness and by the dual one.
fn soft_tower(stiffness: &Rational) -> Result<[DVector<Rational>; 2]> {
    let entry = |value: i64| ratio(value, 1);
    let jacobian = DMatrix::from_row_slice(3, 3, &[1, 0, 0, -1, 1, 0, 0, -1, 1].map(entry));
    let mass = DMatrix::from_diagonal(&DVector::from_vec([1, 2, 3].map(entry).to_vec()));
    let inverse = DMatrix::from_diagonal(&DVector::from_vec(vec![ratio(1, 1), ratio(1, 2), ratio(1, 3)]));
    let free = DVector::from_element(3, ratio(-1, 10));
    let singular = || Error::Unsupported("a positive definite system has a solution".into());
    let stiff = jacobian.transpose() * &jacobian * stiffness.clone();
    let primal = solve(&(&mass + stiff), &(&mass * &free)).ok_or_else(singular)?;
    let softened = &jacobian * &inverse * jacobian.transpose() + DMatrix::identity(3, 3) * ratio(1, 100);
    let impulse = solve(&softened, &-(&jacobian * &free)).ok_or_else(singular)?;
    Ok([primal, &free + inverse * jacobian.transpose() * impulse])
}

fn four_dimensions(reading: Reading) -> Result<Vec<Finding>> {
    let [primal, dual] = soft_tower(&reading.only(1).pick(ratio(100, 1), ratio(50, 1)))?;
    let (free, projected) = (deepest(reading.only(0).pick(false, true))?, deepest(true)?);
    let (sap, lagged) = (stored_creep(reading.only(0).pick(false, true))?, stored_creep(true)?);
    let apart = (sap / lagged - 1.0).abs() > SAME_CREEP;
    let mut findings = vec![
        Finding::decision("Siconos's ball sinks more than twice as deep without projection as with it", free > 2.0 * projected, true)
            .says(false)
            .experiment(),
        Finding::decision("Drake's block creeps at another speed under kSap than under kLagged", apart, true).says(false).experiment(),
        Finding::decision("the primal system, without W, gives the velocities of the dual one", primal == dual, true),
    ];
    findings.extend(lookups::check("S10.all-delassus", reading)?);
    Ok(findings)
}

/// Velocity after a step of a ball that arrives at −1 m/s, without load.
fn after_impact(restitution: Rational) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution };
    let arriving = BallState { position: ratio(0, 1), velocity: ratio(-1, 1) };
    ball.moreau_jean(&arriving, &ratio(1, 2), Activation::Gap, &ratio(1, 100)).motion.velocity
}

/// Depth at rest under Moreau–Jean or Stewart–Trinkle, from a ball laid on the floor.
fn hard_depth(position_level: bool) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution: ratio(1, 2) };
    let mut now = BallState { position: ratio(0, 1), velocity: ratio(0, 1) };
    let h = ratio(1, 100);
    for _ in 0..100 {
        let outcome =
            if position_level { ball.stewart_trinkle(&now, &h) } else { ball.moreau_jean(&now, &ratio(1, 2), Activation::Gap, &h) };
        now = outcome.motion;
    }
    -now.position
}

/// u_n/(μ u_t) after one step of a block that slides on 20° with μ = 1/2, from u_t = 1 m/s on the ground.
fn lift(scheme: &dyn Scheme) -> Result<f64> {
    let block = PointMass::block_on_incline(1.0, 9.81, 20f64.to_radians(), 0.5, 0.0);
    let start = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![1.0, 0.0] };
    let velocity = step(scheme, &Auto, &block, &start, 0.01)?.state.velocity;
    Ok(velocity[1] / (0.5 * velocity[0]))
}

fn differences(reading: Reading) -> Result<Vec<Finding>> {
    let h = 0.01;
    let other = reading.pick(land(&default_contact(h), 0.0, 300).depth, Scalar::to_f64(&hard_depth(true)));
    let depth = ContactParameters::default().rest_depth(h, 1.0, GRAVITY)?;
    let below = other - Scalar::to_f64(&hard_depth(false));
    let rebounds = [rebound(1.0, 1.0 / OSCILLATOR_PARTS as f64), Scalar::to_f64(&after_impact(ratio(1, 2)))];
    let [soft, rigid] = reading.pick(rebounds, [rebounds[1], rebounds[0]]);
    let moreau_jean = MoreauJean::default();
    let schemes: [&dyn Scheme; 2] = [&moreau_jean, &Anitescu];
    let [coulomb, relaxed] = reading.pick(schemes, [schemes[1], schemes[0]]);
    let damped = spring_damper_restitution(1.0);
    let mut findings = vec![
        Finding::equal("depth at rest of MuJoCo less that of an LCP scheme", below, depth, tolerance::AT_REST * depth, "m"),
        Finding::equal("rebound of MuJoCo's critically damped contact", soft, damped, oscillator_rebound(1.0), "1"),
        Finding::equal("rebound of a rigid scheme with e = 1/2", rigid, 0.5, 0.0, "1"),
        Finding::equal("u_n/(μ u_t) in a slide, Coulomb", lift(coulomb)?, 0.0, 2.0 * same_answer(1.0), "1"),
        Finding::equal("u_n/(μ u_t) in a slide, relaxed", lift(relaxed)?, 1.0, 2.0 * same_answer(1.0), "1"),
    ];
    let laws = [Creeping::Hard, Creeping::Sap, Creeping::Mujoco { impedance_ratio: 1 }, Creeping::Regularised];
    for (law, next) in laws.into_iter().zip(laws.into_iter().cycle().skip(1)) {
        let expected = law.predicted(h)?;
        let name = format!("creep at h = {h}, {}", law.name());
        findings.push(Finding::equal(name, reading.pick(law, next).stepped(h)?, expected, tolerance::creep(expected), "m/s"));
    }
    Ok(findings)
}

/// Whether a block of 1 kg, μ = ½, that the scheme lets rest on a plane of this angle moves along it.
fn creeps(scheme: &str, angle: f64) -> Result<bool> {
    let (h, scheme) = (0.004, by_name(scheme, SchemeParameters::default())?);
    let block = PointMass::block_on_incline(1.0, 9.81, angle, 0.5, 0.0);
    let start = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, 0.0] };
    let speed = simulate(scheme.as_ref(), &Auto, &block, start, h, 500)?.last().velocity[0];
    Ok(speed.abs() > tolerance::creep(0.0))
}

fn gliding(reading: Reading) -> Result<Vec<Finding>> {
    let (sap, mujoco, hard) = (Creeping::Sap, Creeping::Mujoco { impedance_ratio: 1 }, Creeping::Hard);
    let [sap, mujoco, hard] = reading.only(1).pick([sap, mujoco, hard], [mujoco, sap, mujoco]);
    let halving = |law: Creeping| -> Result<f64> { Ok(law.stepped(0.004)? / law.stepped(0.002)?) };
    let angle = reading.only(0).pick(0.0, 20f64.to_radians());
    let mut moving = 0;
    for scheme in ["drake-sap", "mujoco", "anitescu"] {
        moving += usize::from(creeps(scheme, angle)?);
    }
    Ok(vec![
        Finding::equal("creep at 4 ms over that at 2 ms on 20°, SAP", halving(sap)?, 2.0, 2.0 * tolerance::AT_REST, "1"),
        Finding::equal("the same, MuJoCo", halving(mujoco)?, 1.0, tolerance::AT_REST, "1"),
        Finding::equal("creep of the hard block", hard.stepped(0.004)?, 0.0, tolerance::creep(0.0), "m/s"),
        Finding::count("of three blocks on level ground, those that creep", moving, 0)
            .says_at_least(1)
            .violating("a pull along the contacts"),
    ])
}
