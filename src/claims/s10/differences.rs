//! What simulators have in common, and by how much they differ on one scene.

use crate::claims::experiments::creep::Creeping;
use crate::claims::experiments::planar_step::Block;
use crate::claims::experiments::soft::{default_contact, land, rebound};
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_normal::spring_damper_restitution;
use crate::elimination::solve;
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{PointMass, State};
use crate::problem::Law;
use crate::schemes::{Activation, SchemeParameters, by_name, simulate};
use crate::solvers::Auto;
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::gate::ball::{OSCILLATOR_PARTS, oscillator_rebound};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S10.all-delassus",
        statement: "All six simulators are built on the Delassus operator W = JM⁻¹Jᵀ; they differ in four things only: position or \
            velocity level, polyhedral or second-order cone, relaxed or softened or not, numerical algorithm.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "All solve a problem whose dual has W as its operator; a primal method (SAP's and MuJoCo's Newton) solves it \
            without ever forming W. But the four things do not determine the motion: impact law and stabilisation, for instance, differ \
            between simulators that agree in all four, as the chapter's own table shows in its column on impacts.",
        argument: "Tower of three on soft contacts, R = 1/100: the primal system (M + HᵀR⁻¹H) v = M v_free and the dual (W + R) r = −H \
            v_free give the same velocities exactly. Two velocity-level, hard, unrelaxed steps of the same solver with e = 0 and e = 1/2 \
            leave an impact at −1 m/s with 0 and 1/2 m/s; with and without projection a ball 1 mm deep ends at 0 and at −1 mm.",
        controls: &["Two simulators that also agree in e, and of which neither projects."],
        sources: &["chapter §10, essential insight"],
        check: four_dimensions,
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
        argument: "1 kg at rest on the floor: 0 m deep under an LCP scheme, 3.6718e-4 m in MuJoCo. Rebound of the default contact: e⁻² = \
            0.135 in MuJoCo, e in a rigid scheme. Block that should stick on 20°, h = 10 ms: 0 (Anitescu), R_t h g_t (SAP), R_t g_t/b \
            (MuJoCo), 1.06 v_s (Drake Similar, Lagged). Sliding: u_n = 0 under Coulomb, μ|u_t| under the relaxation.",
        controls: &["Stewart–Trinkle in place of MuJoCo: at rest it agrees with Moreau–Jean."],
        sources: &[
            "chapter §10, pitfall “another simulator, the same result”",
            "stored runs of MuJoCo 3.17.0 and Drake 1.51.1 agree with these models, see tests/references",
        ],
        check: differences,
    },
    Claim {
        id: "S10.mujoco-gliding",
        statement: "Exercise 3, one stack of cubes: of Bullet, Drake SAP and MuJoCo, which penetrates least, which trembles most easily, \
            which shows O(h) gliding, which has gradients?",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Of gliding: none of them on level ground, where nothing pulls along the contacts. On a slope, or pushed, SAP \
            creeps by O(h), MuJoCo at a speed that does not depend on h (set by impratio, solimp and solref), a scheme with hard \
            friction such as Bullet's model not at all.",
        argument: "Stepped to a steady state on 20°, μ = 1/2, at h = 4 and 2 ms: SAP's creep halves, MuJoCo's stays the same to rounding, \
            the hard block does not move; each agrees with its closed form. On level ground the blocks of drake-sap, mujoco and anitescu \
            stay where they are.",
        controls: &["The slope of 20° in place of level ground."],
        sources: &["chapter §10, exercise 3", "stored runs of MuJoCo 3.17.0 and Drake 1.51.1, see tests/references"],
        check: gliding,
    },
];

/// Velocities of a tower of three on soft contacts, by the primal system and by the dual one.
fn soft_tower() -> Result<[DVector<Rational>; 2]> {
    let entry = |value: i64| ratio(value, 1);
    let jacobian = DMatrix::from_row_slice(3, 3, &[1, 0, 0, -1, 1, 0, 0, -1, 1].map(entry));
    let mass = DMatrix::from_diagonal(&DVector::from_vec([1, 2, 3].map(entry).to_vec()));
    let inverse = DMatrix::from_diagonal(&DVector::from_vec(vec![ratio(1, 1), ratio(1, 2), ratio(1, 3)]));
    let free = DVector::from_element(3, ratio(-1, 10));
    let singular = || Error::Unsupported("a positive definite system has a solution".into());
    let stiffness = ratio(100, 1);
    let primal = solve(&(&mass + jacobian.transpose() * &jacobian * stiffness), &(&mass * &free)).ok_or_else(singular)?;
    let softened = &jacobian * &inverse * jacobian.transpose() + DMatrix::identity(3, 3) * ratio(1, 100);
    let impulse = solve(&softened, &-(&jacobian * &free)).ok_or_else(singular)?;
    Ok([primal, &free + inverse * jacobian.transpose() * impulse])
}

/// Velocity after a step of a ball that arrives at −1 m/s, without load.
fn after_impact(restitution: Rational) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution };
    let arriving = BallState { position: ratio(0, 1), velocity: ratio(-1, 1) };
    ball.moreau_jean(&arriving, &ratio(1, 2), Activation::Gap, &ratio(1, 100)).motion.velocity
}

fn four_dimensions(reading: Reading) -> Result<Vec<Finding>> {
    let [primal, dual] = soft_tower()?;
    let (one, other) = (after_impact(ratio(0, 1)), after_impact(reading.pick(ratio(1, 2), ratio(0, 1))));
    let resting = Ball { mass: ratio(1, 1), gravity: ratio(10, 1), restitution: ratio(0, 1) };
    let sunk = BallState { position: ratio(-1, 1000), velocity: ratio(0, 1) };
    let unprojected = resting.moreau_jean(&sunk, &ratio(1, 2), Activation::Gap, &ratio(1, 100)).motion.position;
    let projects = reading.pick(true, false);
    let settled = if projects { unprojected.clone().max(ratio(0, 1)) } else { unprojected.clone() };
    Ok(vec![
        Finding::exact("difference of two steps equal in all four things", &(other - one), &ratio(1, 2), "m/s").says(ratio(0, 1)),
        Finding::exact("difference of two ends of a step equal in them", &(settled - unprojected), &ratio(1, 1000), "m").says(ratio(0, 1)),
        Finding::decision("the primal system, without W, gives the velocities of the dual one", primal == dual, true),
    ])
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

/// u_n/(μ u_t) of a steady slide on the 3-4-5 slope with μ = 1/2, after one step from u_t = 1 m/s on the ground.
fn lift(law: Law) -> Result<Rational> {
    let mut block = Block { law, velocity: [ratio(0, 1), ratio(1, 1)], ..Block::at_rest(ratio(1, 2)) };
    block.step(&ratio(1, 100))?;
    Ok(&block.velocity[0] / (ratio(1, 2) * &block.velocity[1]))
}

fn differences(reading: Reading) -> Result<Vec<Finding>> {
    let h = 0.01;
    let soft = land(&default_contact(h), 0.0, 300).depth;
    let other = reading.pick(soft, Scalar::to_f64(&hard_depth(true)));
    let (printed, zero) = (0.000_367_18, ratio(0, 1));
    let difference = other - Scalar::to_f64(&hard_depth(false));
    let mut findings = vec![
        Finding::equal("depth at rest of MuJoCo less that of an LCP scheme", difference, printed, tolerance::FOUR_DIGITS * printed, "m"),
        Finding::equal(
            "rebound of MuJoCo's critically damped contact",
            rebound(1.0, 1.0 / OSCILLATOR_PARTS as f64),
            spring_damper_restitution(1.0),
            oscillator_rebound(1.0),
            "1",
        ),
        Finding::exact("rebound of a rigid scheme with e = 1/2", &after_impact(ratio(1, 2)), &ratio(1, 2), "1"),
        Finding::exact("u_n/(μ u_t) in a slide, Coulomb", &lift(Law::Coulomb)?, &zero, "1"),
        Finding::exact("u_n/(μ u_t) in a slide, relaxed", &lift(Law::Associated)?, &ratio(1, 1), "1"),
    ];
    for law in [Creeping::Hard, Creeping::Sap, Creeping::Mujoco { impedance_ratio: 1 }, Creeping::Regularised] {
        let expected = law.predicted(h)?;
        findings.push(Finding::equal(
            format!("creep at h = {h}, {}", law.name()),
            law.stepped(h)?,
            expected,
            tolerance::creep(expected),
            "m/s",
        ));
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
    let mujoco = Creeping::Mujoco { impedance_ratio: 1 };
    let halving = |law: Creeping| -> Result<f64> { Ok(law.stepped(0.004)? / law.stepped(0.002)?) };
    let expected = |law: Creeping| -> Result<f64> { Ok(law.predicted(0.004)? / law.predicted(0.002)?) };
    let angle = reading.pick(0.0, 20f64.to_radians());
    let mut moving = 0;
    for scheme in ["drake-sap", "mujoco", "anitescu"] {
        moving += usize::from(creeps(scheme, angle)?);
    }
    Ok(vec![
        Finding::equal("creep at 4 ms over that at 2 ms on 20°, SAP", halving(Creeping::Sap)?, 2.0, 2.0 * tolerance::AT_REST, "1"),
        Finding::equal("the same, MuJoCo", halving(mujoco)?, 1.0, tolerance::AT_REST, "1"),
        Finding::equal("the same in closed form, SAP", expected(Creeping::Sap)?, 2.0, 2.0 * tolerance::AT_REST, "1"),
        Finding::equal("creep of the hard block", Creeping::Hard.stepped(0.004)?, 0.0, tolerance::creep(0.0), "m/s"),
        Finding::count("of three blocks on level ground, those that creep", moving, 0)
            .says_at_least(1)
            .violating("a pull along the contacts"),
    ])
}
