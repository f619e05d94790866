//! What MuJoCo 3.17.0 has and does, as stored: integrators, solvers, the reference frame of its accelerations.

use crate::claims::experiments::mujoco::facts;
use crate::claims::experiments::stored::{Faller, update_residuals};
use crate::claims::prelude::*;
use crate::integrators::stability::invariants;
use crate::tolerance::claims::integrators::FALL;
use crate::tolerance::claims::soft::{CHANGED, COMPUTED, SAME_OPTIMUM};
use crate::tolerance::claims::thresholds::GAINED;

const STORED: &str = "MuJoCo 3.17.0, asked by scripts/generate_references.py, answers in references/facts/mujoco.json";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.soft-convex-step",
        statement: "MuJoCo gives up rigid contact: it uses a soft model in continuous time and writes each step as a convex optimisation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "As stated for the integrators Euler, implicit, implicitfast and RK4, whose accelerations do not know the step. \
            The integrator `discrete` of newer versions solves for the step itself.",
        argument: "The acceleration of a sliding block does not change to the last bit when h is halved under Euler (timeconst above 2h), \
            and changes by 0.32 under discrete.",
        controls: &["discrete in place of Euler."],
        sources: &["chapter §6, philosophy", STORED],
        check: continuous_time,
    },
    Claim {
        id: "S6.au",
        statement: "The unconstrained acceleration of the contact rows is a_u = J M⁻¹(τ − c) + J̇v.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "That is the acceleration of material points. MuJoCo leaves J̇v out for contacts: its problem has J M⁻¹(τ − c) \
            − a_ref.",
        argument: "A box with one corner 1 mm in the floor, turning at 5 rad/s: J̇v of the normal row and of one tangent, by differences, \
            is 3.28 and 0.66 m/s²; efc_b − J a_smooth + a_ref is 0. On the tangent along the spin axis J̇v is 0 as well.",
        controls: &["The row along the spin axis, whose J̇v is 0, in place of the other two."],
        sources: &["chapter §6, step 2", STORED],
        check: omitted_rate,
    },
    Claim {
        id: "S6.newton-desc",
        statement: "Newton: exact second-order method with a factored Hessian, updated incrementally, quadratic convergence; the default.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated. That updates are incremental is a matter of the source code and does not show in results.",
        argument: "opt.solver of an empty model is Newton. On a stack of three that slides and turns, elliptic, our own Newton goes from a \
            relative gradient of 1e-2 to 1e-10 in at most three steps, conjugate gradients need more.",
        controls: &["Conjugate gradients in place of Newton."],
        sources: &["chapter §6, table of solvers", STORED],
        check: super::algorithms::second_order,
    },
    Claim {
        id: "S6.all-cones",
        statement: "All three solvers take pyramidal and elliptic cones, dense and sparse.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated.",
        argument: "One state of a sliding block under 3 solvers, 2 cones and 2 Jacobians, run to the end: accelerations agree within a \
            cone to 3e-7 m/s² (PGS; the others to 1e-13), the two cones differ by more than 1 m/s².",
        controls: &["The pyramid's acceleration in place of the elliptic one."],
        sources: &["chapter §6, table of solvers", STORED],
        check: all_twelve,
    },
    Claim {
        id: "S6.euler-default",
        statement: "The main integrator is semi-implicit Euler; there are implicitfast and RK4 as well.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated. With damping at joints Euler is not the textbook's rule with forces at the old velocity: dampers \
            are implicit. There are also implicit and, in newer versions, discrete.",
        argument: "integrator = 0 = Euler; implicitfast and RK4 are in the list. The stored fall has q⁺ − q − h v⁺ = 0. A mass of 1 kg at \
            1 m/s with a damper of 1000 N·s/m, h = 10 ms: Euler leaves 1/11 m/s, as v/(1 + hC/m).",
        controls: &["RK4 in place of Euler."],
        sources: &["chapter §6, step 6", STORED],
        check: default_integrator,
    },
    Claim {
        id: "S6.semi-implicit-update",
        statement: "The velocity is advanced first, then the position with the new velocity; that is more stable than the explicit rule.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated; for the undamped spring up to hω = 2.",
        argument: "Stored fall: q⁺ − q − h v⁺ = 0 to rounding, with the old velocity it is g h². One step on a spring, hω = 1/2: |det| = 1 \
            and |trace| < 2 for the semi-implicit rule, det = 5/4 for the explicit one.",
        controls: &["The explicit rule."],
        sources: &["chapter §6, step 6", "stored run of MuJoCo 3.17.0, Euler"],
        check: new_velocity,
    },
    Claim {
        id: "S6.implicitfast",
        statement: "implicitfast treats velocity-dependent forces implicitly and is more stable at large steps.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "It does for passive forces and actuators. It leaves out Coriolis and gyroscopic terms (but for bodies that \
            float freely, in newer versions), and contact forces are not among them either.",
        argument: "1 kg at 1 m/s with a velocity servo of 1000 N·s/m, h = 10 ms: Euler gives −9 m/s, implicitfast 1/11. A torque-free top \
            on a ball joint gains the same energy under implicitfast as under Euler, 0.77 % in 1 s, where with the gyroscopic terms, under \
            implicit, it loses.",
        controls: &["A top that floats freely."],
        sources: &["chapter §6, step 6", STORED],
        check: implicit_fast,
    },
];

fn continuous_time(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let change = |name: &str| facts.number(&["computed", "acceleration_change_when_h_halves", name]);
    Ok(vec![
        Finding::equal("change of a when h is halved, Euler", change("EULER")?, 0.0, COMPUTED, "m/s²"),
        Finding::at_least("change of a when h is halved, discrete", change(reading.pick("DISCRETE", "EULER"))?, CHANGED, "m/s²")
            .says_at_most(COMPUTED)
            .violating("an integrator other than discrete"),
    ])
}

fn omitted_rate(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let of = |key: &str| facts.numbers(&["computed", "turning_corner", key]);
    let (rate, held) = (of("jacobian_rate_times_velocity")?, of("efc_b_minus_smooth_plus_reference")?);
    let mut findings = vec![Finding::at_least("J̇v of the normal row", rate[reading.pick(0, 2)], 1.0, "m/s²").context()];
    for row in [0, 1].map(|row| reading.pick(row, 2)) {
        let name = format!("what of J̇v efc_b holds, row {row}");
        findings.push(Finding::equal(name, held[row], 0.0, COMPUTED, "m/s²").says(rate[row]).violating("J̇v = 0"));
    }
    findings.push(Finding::equal("what of J̇v efc_b holds, row along the spin axis", held[2], 0.0, COMPUTED, "m/s²").says(rate[2]));
    Ok(findings)
}

fn all_twelve(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let distances = facts.numbers(&["computed", "distance_from_newton"])?;
    let last = |cone: &str| facts.numbers(&["computed", "cg_iterates", cone, "7"]);
    let between = (last(reading.pick("elliptic", "pyramidal"))? - last("pyramidal")?).amax();
    Ok(vec![
        Finding::count("solvers × cones × Jacobians", distances.len(), 12),
        Finding::at_most("largest distance from Newton with the same cone", distances.amax(), SAME_OPTIMUM, "m/s²"),
        Finding::at_least("distance of the two cones", between, 1.0, "m/s²"),
    ])
}

fn default_integrator(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let left = facts.number(&["computed", "velocity_after_a_step", "Euler damper"])?;
    let default = facts.number(&["stated", "defaults", "integrator"])?;
    let main = facts.number(&["stated", "integrators", reading.pick("EULER", "RK4")])?;
    let has = |name: &str| facts.has(&["stated", "integrators"], name);
    let [with_new, _] = update_residuals(Faller::MuJoCo)?;
    Ok(vec![
        Finding::decision("the default is the main integrator of the sentence", default == main, true),
        Finding::decision("implicitfast and RK4 exist", has("IMPLICITFAST") && has("RK4"), true),
        Finding::at_most("|q⁺ − q − h v⁺| of the stored fall", with_new, FALL, "m"),
        Finding::equal("velocity after a step with a damper, Euler", left, 1.0 / 11.0, COMPUTED, "m/s").context(),
    ])
}

/// det and trace of the step (x, v) on a spring with hω = 1/2, with the old or the new velocity moving x.
fn spring_step(new: bool) -> [Rational; 2] {
    let (one, h) = (ratio(1, 1), ratio(1, 2));
    let corner = if new { &one - &h * &h } else { one.clone() };
    invariants(&DMatrix::from_row_slice(2, 2, &[corner, h.clone(), -h, one]))
}

fn new_velocity(reading: Reading) -> Result<Vec<Finding>> {
    let [with_new, with_old] = update_residuals(Faller::MuJoCo)?;
    let invariants = spring_step(reading.pick(true, false));
    let two = ratio(2, 1);
    Ok(vec![
        Finding::decision(
            "one eigenvalue pair of size 1, hω = 1/2",
            invariants.contains(&ratio(1, 1)) && invariants.iter().all(|x| *x < two),
            true,
        ),
        Finding::at_most("|q⁺ − q − h v⁺| of the stored fall", with_new, FALL, "m"),
        Finding::equal("|q⁺ − q − h v| of the stored fall", with_old, 9.81 * 0.01 * 0.01, FALL, "m"),
    ])
}

fn implicit_fast(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let motor = |name: &str| facts.number(&["computed", "velocity_after_a_step", &format!("{name} motor")]);
    let top = |name: &str, joint: &str| facts.number(&["computed", "energy_of_a_top", &format!("{name} {joint}")]);
    let with = |name: &str| top(name, reading.pick("ball", "free"));
    Ok(vec![
        Finding::equal("velocity after a step with a servo, Euler", motor("Euler")?, -9.0, 10.0 * COMPUTED, "m/s"),
        Finding::equal("velocity after a step with a servo, implicitfast", motor("implicitfast")?, 1.0 / 11.0, COMPUTED, "m/s"),
        Finding::equal("energy of a top on a ball joint after 1 s, implicitfast", with("implicitfast")?, with("Euler")?, COMPUTED, "1")
            .says(with("implicit")?)
            .violating("no gyroscopic torque at a joint"),
        Finding::at_least("energy gained by the top under Euler", top("Euler", "ball")? - 1.0, GAINED, "1").context(),
    ])
}
