//! What MuJoCo 3.17.0 has and does, as stored: integrators, solvers, the reference frame of its accelerations.

use crate::claims::experiments::mujoco::{Stored, facts};
use crate::claims::experiments::stored::{Fall, Faller};
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::integrators::stability::{Powers, powers};
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
        argument: r"The acceleration of a sliding block does not change to the last bit when $h$ is halved under Euler (timeconst above
            $2h$), and changes by 0.32 under discrete.",
        controls: &["The two integrators exchanged."],
        sources: &["chapter §6, philosophy", STORED],
        check: check!(continuous_time),
    },
    Claim {
        id: "S6.au",
        statement: r"The unconstrained acceleration in the space of the constraints is $a_u = J\,M^{-1}(\tau - c) + \dot Jv$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: r"That is the acceleration of material points. MuJoCo leaves $\dot Jv$ out for contacts: its problem has
            $J\,M^{-1}(\tau - c) - a_\text{ref}$.",
        argument: r"A box with one corner 1 mm in the floor, turning at 5 rad/s: $\dot Jv$ of the normal row and of one tangent, by
            differences, is 3.28 and 0.66 m/s²; efc_b − $J\,a_\text{smooth} + a_\text{ref}$ is 0. On the tangent along the spin axis
            $\dot Jv$ is 0 as well.",
        controls: &[
            r"The row along the spin axis, whose $\dot Jv$ is 0, in place of the other two.",
            "The normal row in place of that along the spin axis.",
        ],
        sources: &["chapter §6, step 2", STORED],
        check: check!(omitted_rate),
    },
    Claim {
        id: "S6.newton-desc",
        statement: "Newton: exact second-order method with a factored Hessian, updated incrementally, quadratic convergence; the default.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated. That updates are incremental is a matter of the source code and does not show in results.",
        argument: "opt.solver of an empty model is Newton. On a stack of three that slides and turns, elliptic, our own Newton goes from \
            a relative gradient of 1e-2 to rest in at most three steps, conjugate gradients need more.",
        controls: &["Conjugate gradients in place of Newton."],
        sources: &["chapter §6, table of solvers", STORED],
        check: check!(newton),
    },
    Claim {
        id: "S6.all-cones",
        statement: "All three solvers take pyramidal and elliptic cones, dense and sparse.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated.",
        argument: "One state of a sliding block under each solver, cone and kind of Jacobian, 12 in all, run to the end: accelerations \
            agree within a cone to 2.7e-7 m/s², the two cones differ by more than 1 m/s².",
        controls: &[
            "The pyramid's acceleration in place of the elliptic one.",
            "CG stopped after one iteration, the other solvers run to the end.",
        ],
        sources: &["chapter §6, table of solvers", STORED],
        check: check!(all_twelve),
    },
    Claim {
        id: "S6.euler-default",
        statement: "The main integrator is semi-implicit Euler; there are implicitfast and RK4 as well.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated. With damping at joints Euler is not the textbook's rule with forces at the old velocity: dampers \
            are implicit. There are also implicit and, in newer versions, discrete.",
        argument: r"integrator $= 0$ = Euler; implicitfast and RK4 are in the list. The stored fall has $q^+ - q - h\,v^+ = 0$. A mass of
            1 kg at 1 m/s with a damper of 1000 N·s/m, $h = 10$ ms: Euler leaves 1/11 m/s, as $v/(1 + hC/m)$.",
        controls: &["RK4 in place of Euler.", "Two of Drake's integrators looked up, and a fall that moves with the old velocity."],
        sources: &["chapter §6, step 6", STORED],
        check: check!(default_integrator),
    },
    Claim {
        id: "S6.semi-implicit-update",
        statement: "The velocity is advanced first, then the position with the new velocity; that is much more stable than the explicit \
            rule.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: r"Of weakly damped springs, up to the damping ratio $1/\sqrt3$; beyond it the explicit rule bears the larger
            step (S8.semi-much-better). The default contact has the damping ratio 1.",
        argument: r"Stored fall: $q^+ - q - h\,v^+ = 0$ to rounding, with the old velocity it is $g\,h^2$. Steps on an undamped spring,
            $h\omega = 1/2$: the powers of the semi-implicit step stay bounded, those of the explicit one grow. At the damping ratio 1 and
            $h\omega = 1$ it is the other way round.",
        controls: &["A fall and a spring that move with the old velocity."],
        sources: &["chapter §6, step 6", "chapter §8", "stored run of MuJoCo 3.17.0, Euler"],
        check: check!(new_velocity),
    },
    Claim {
        id: "S6.implicitfast",
        statement: "implicitfast makes velocity-dependent terms such as damping implicit and is more stable at large steps.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "It does for passive forces and actuators. It leaves out Coriolis and gyroscopic terms (but for bodies that \
            float freely, in newer versions), and contact forces are not among them either.",
        argument: r"1 kg at 1 m/s with a velocity servo of 1000 N·s/m, $h = 10$ ms: Euler gives −9 m/s, implicitfast 1/11. A torque-free
            top on a ball joint gains the same energy under implicitfast as under Euler, 0.77 % in 1 s, where with the gyroscopic terms,
            under implicit, it loses.",
        controls: &["A top that floats freely.", "Euler and implicitfast exchanged on the servo."],
        sources: &["chapter §6, step 6", STORED],
        check: check!(implicit_fast),
    },
];

fn newton(reading: Reading) -> Result<Vec<Finding>> {
    super::algorithms::second_order(reading)
}

fn continuous_time(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let change = |name: &str| facts.number(&["computed", "acceleration_change_when_h_halves", name]);
    let [euler, discrete] = reading.pick(["EULER", "DISCRETE"], ["DISCRETE", "EULER"]);
    Ok(vec![
        Finding::equal("change of a when h is halved, Euler", change(euler)?, 0.0, COMPUTED, "m/s²").experiment(),
        Finding::at_least("change of a when h is halved, discrete", change(discrete)?, CHANGED, "m/s²")
            .experiment()
            .says_at_most(COMPUTED)
            .violating("an integrator other than discrete"),
    ])
}

fn omitted_rate(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let of = |key: &str| facts.numbers(&["computed", "turning_corner", key]);
    let (rate, held) = (of("jacobian_rate_times_velocity")?, of("efc_b_minus_smooth_plus_reference")?);
    let mut findings = Vec::new();
    for (place, name) in [(0, "normal row"), (1, "first tangent")] {
        let row = reading.only(0).pick(place, 2);
        let left_out = Finding::at_least(format!("J̇v that efc_b leaves out, {name}"), (rate[row] - held[row]).abs(), CHANGED, "m/s²");
        findings.push(left_out.experiment().says_at_most(COMPUTED).violating("J̇v = 0"));
    }
    let spin = reading.only(1).pick(2, 0);
    let left_out = Finding::equal("J̇v that efc_b leaves out, row along the spin axis", rate[spin] - held[spin], 0.0, COMPUTED, "m/s²");
    findings.push(left_out.experiment());
    Ok(findings)
}

/// How many iterates of CG are stored; the last one has converged.
const ITERATES: usize = 8;

/// The acceleration \[m/s²\] after a number of iterations of CG, from 1 on.
fn iterate(facts: &Stored, cone: &str, iterations: usize) -> Result<DVector<f64>> {
    facts.numbers(&["computed", "cg_iterates", cone, &(iterations - 1).to_string()])
}

/// Largest difference \[m/s²\] of the acceleration of each solver, cone and kind of Jacobian from that of Newton with the same cone: all
/// run to the end, or CG stopped after a number of iterations.
fn distances_from_newton(facts: &Stored, stopped: Option<usize>) -> Result<Vec<f64>> {
    let mut found = Vec::new();
    for cone in ["elliptic", "pyramidal"] {
        for solver in ["NEWTON", "CG", "PGS"] {
            for jacobian in ["DENSE", "SPARSE"] {
                found.push(match stopped.filter(|_| solver == "CG") {
                    Some(iterations) => (iterate(facts, cone, iterations)? - iterate(facts, cone, ITERATES)?).amax(),
                    None => facts.number(&["computed", "distance_from_newton", &format!("{cone} {solver} {jacobian}")])?,
                });
            }
        }
    }
    Ok(found)
}

fn all_twelve(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let last = |cone: &str| iterate(&facts, cone, ITERATES);
    let distances = distances_from_newton(&facts, reading.only(1).pick(None, Some(1)))?;
    let agreeing = distances.iter().filter(|distance| **distance <= SAME_OPTIMUM).count();
    let between = (last(reading.only(0).pick("elliptic", "pyramidal"))? - last("pyramidal")?).amax();
    Ok(vec![
        Finding::count("solvers × cones × Jacobians that end where Newton with the same cone does", agreeing, 12).experiment(),
        Finding::at_most(
            "largest distance from Newton with the same cone",
            distances.into_iter().fold(0.0, f64::max),
            SAME_OPTIMUM,
            "m/s²",
        )
        .experiment(),
        Finding::at_least("distance of the two cones", between, 1.0, "m/s²").experiment(),
    ])
}

fn default_integrator(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let left = facts.number(&["computed", "velocity_after_a_step", "Euler damper"])?;
    let [with_new, _] = reading.only(1).pick(Fall::stored(Faller::MuJoCo)?, Fall::explicit()).residuals();
    let (h, damper) = (0.01, 1000.0);
    let mut findings = lookups::check("S6.euler-default", reading)?;
    findings.extend([
        Finding::at_most("|q⁺ − q − h v⁺| of the stored fall", with_new, FALL, "m").experiment(),
        Finding::equal("velocity after a step with a damper, Euler", left, 1.0 / (1.0 + h * damper), COMPUTED, "m/s").context(),
    ]);
    Ok(findings)
}

/// Whether the powers of the step on a spring with hω = s and a damping ratio stay bounded, with the old or the new velocity moving x.
fn is_bounded(new: bool, s: &Rational, zeta: &Rational) -> bool {
    let one = ratio(1, 1);
    let slowed = &one - ratio(2, 1) * zeta * s;
    let moved = if new { [&one - s * s, s * &slowed] } else { [one, s.clone()] };
    let [from_place, from_velocity] = moved;
    let step = DMatrix::from_row_slice(2, 2, &[from_place, from_velocity, -s, slowed]);
    matches!(powers(&step), Powers::Decay | Powers::Bounded)
}

fn new_velocity(reading: Reading) -> Result<Vec<Finding>> {
    let (fall, new) = reading.pick((Fall::stored(Faller::MuJoCo)?, true), (Fall::explicit(), false));
    let [with_new, with_old] = fall.residuals();
    let (half, one) = (ratio(1, 2), ratio(1, 1));
    let better = |s: &Rational, zeta: &Rational| is_bounded(new, s, zeta) && !is_bounded(!new, s, zeta);
    let worse = |s: &Rational, zeta: &Rational| !is_bounded(new, s, zeta) && is_bounded(!new, s, zeta);
    Ok(vec![
        Finding::decision("the new velocity alone is stable, hω = 1/2 without damping", better(&half, &ratio(0, 1)), true),
        Finding::decision("the old velocity alone is stable, hω = 1 at the damping ratio 1", worse(&one, &one), true)
            .says(false)
            .violating("a damping ratio below 1/√3"),
        Finding::at_most("|q⁺ − q − h v⁺| of the stored fall", with_new, FALL, "m").experiment(),
        Finding::equal("|q⁺ − q − h v| of the stored fall", with_old, 9.81 * 0.01 * 0.01, FALL, "m").experiment(),
    ])
}

fn implicit_fast(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let motor = |name: &str| facts.number(&["computed", "velocity_after_a_step", &format!("{name} motor")]);
    let top = |name: &str, joint: &str| facts.number(&["computed", "energy_of_a_top", &format!("{name} {joint}")]);
    let with = |name: &str| top(name, reading.only(0).pick("ball", "free"));
    let [explicit, implicit] = reading.only(1).pick(["Euler", "implicitfast"], ["implicitfast", "Euler"]);
    let (h, servo) = (0.01, 1000.0);
    let slowed = 1.0 / (1.0 + h * servo);
    Ok(vec![
        Finding::equal("velocity after a step with a servo, Euler", motor(explicit)?, 1.0 - h * servo, 10.0 * COMPUTED, "m/s").experiment(),
        Finding::equal("velocity after a step with a servo, implicitfast", motor(implicit)?, slowed, COMPUTED, "m/s").experiment(),
        Finding::equal("energy of a top on a ball joint after 1 s, implicitfast", with("implicitfast")?, with("Euler")?, COMPUTED, "1")
            .experiment()
            .says(with("implicit")?)
            .violating("no gyroscopic torque at a joint"),
        Finding::at_least("energy gained by the top under Euler", top("Euler", "ball")? - 1.0, GAINED, "1").context(),
    ])
}
