//! Which integrator the simulators use, and why: what stored runs show of it, and what is opinion.

use super::implicit::stiff_damper;
use crate::claims::experiments::motion_step::{step, step_matrix};
use crate::claims::experiments::phase_maps::disk_flow;
use crate::claims::experiments::soft_stack::found_again;
use crate::claims::experiments::spring_damper::{OneStep, SEMI_IMPLICIT, energy_ratio, matrix, theta, undamped};
use crate::claims::experiments::stored::{Fall, Faller, Thrower, projectile_error};
use crate::claims::prelude::*;
use crate::integrators::impact_flow::Tangent;
use crate::integrators::stability::invariants;
use crate::integrators::symplectic::volume;
use crate::integrators::{Method, Phase, SmoothSystem, SpringDamper};
use crate::scalar::Dual;
use crate::tolerance::claims::integrators::{FALL, PROJECTILE};
use crate::tolerance::claims::soft::SOLVED;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.nobody-explicit",
        statement: "No serious simulator uses pure explicit Euler for contact.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "A survey without a list, and “serious” is a judgement. The engines stored here whose falls are kept step by \
            step, MuJoCo and Drake, do not.",
        argument: r"Stored falls of MuJoCo 3.17.0 (integrator Euler) and Drake 1.51.1 (SAP) at $h = 1/100$ s: $q^+ - q - h\,v^+$ is zero
            to rounding, $q^+ - q - h\,v$ is $g\,h^2 = 9.81\cdot10^{-4}$ m in every step.",
        controls: &["A fall under explicit Euler in place of the stored ones."],
        sources: &["chapter §8, why explicit Euler fails", "references/mujoco and references/drake, ball_drop at h = 0.01"],
        check: check!(nobody),
    },
    Claim {
        id: "S8.semi-sim-list",
        statement: "Semi-implicit Euler is the main integrator of MuJoCo, Bullet and Drake.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated, with the sentence before it: contact forces may be solved for the velocity at the end of the step \
            (all three do), other forces are taken at its start, and the body moves with the new velocity. MuJoCo offers other \
            integrators.",
        argument: r"MuJoCo and Drake: as in S8.nobody-explicit. Bullet: in a stored fall at $h = 1/100$ $s\,q^+ = q + h\,v^+$ to rounding;
            a thrown body of PyBullet 3.2.7 is $\tfrac12\,g\,h\,t = 0.04905$ m off its parabola at $h = 1/60$ s, as an Euler rule is.",
        controls: &[
            "Siconos 4.4.0 in place of Bullet's thrown body: it follows the parabola to rounding.",
            "A fall under explicit Euler in place of the stored ones.",
        ],
        sources: &[
            "chapter §8, three levels and table",
            "references/scoreboard, flight/projectile; references/bullet, ball_bounce at h = 0.01",
        ],
        check: check!(main_integrator),
    },
    Claim {
        id: "S8.drake-midpoint",
        statement: r"Fully implicit, $\theta = 1$, with $O(h^2)$ dissipation: Drake SAP's midpoint, and implicitfast, lean towards this
            end; in the table Drake SAP's midpoint represents it.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"Midpoint is $\theta = 1/2$: it neither dissipates nor is $L$-stable. A step that is implicit in the velocity
            alone, as implicitfast is, is semi-implicit Euler on an undamped spring, with its bound $h\omega < 2$. Drake's discrete
            stepper moves with the new velocity (S8.semi-sim-list).",
        argument: r"$h\omega = 3/10$ in rationals: $\theta = 1/2$ has $E^+/E = 1$ and determinant 1, the level's $\theta = 1$ 100/109; the
            step with implicit damping has the matrix of semi-implicit Euler. A damper with $h\,c/m = 10^9$ keeps $-(10^9 - 2)/(10^9 + 2)$
            of its velocity under $\theta = 1/2$.",
        controls: &[r"$\theta = 1$ in place of the midpoint rule."],
        sources: &["chapter §8, three levels and table", "MuJoCo documentation, computation: numerical integration (3.17)"],
        check: check!(midpoint),
    },
    Claim {
        id: "S8.all-sims-semi",
        statement: "That is why all simulators use semi-implicit Euler and not the explicit one.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Measured,
        correct_statement: r"All semi-implicit: not so. Siconos uses its $\theta$ scheme, as the chapter says elsewhere.",
        argument: r"A thrown body at $h = 1/60$ s: an Euler rule is $\tfrac12\,g\,h\,t = 0.04905$ m off the parabola; Siconos 4.4.0 is off
            by rounding, $\theta = 1/2$.",
        controls: &["Bullet in place of Siconos.", "Siconos in place of Bullet."],
        sources: &["chapter §8, pitfall: semi-implicit and explicit Euler are nearly the same", "references/scoreboard, flight/projectile"],
        check: check!(not_all),
    },
    Claim {
        id: "S8.plastic-common",
        statement: r"Contact of robots mostly has $e \approx 0$, so that symplectic integrators fail there altogether.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "How common plastic contact is, is a statement about models, and “fail” a judgement. At the impact nothing is \
            left to preserve; between impacts a symplectic step stays one.",
        argument: r"Flow across an impact on a disk: $\det D = 0$ at $e = 0$ and 1/100 at $e = 1/10$. Free steps on an undamped spring
            keep determinant 1.",
        controls: &[r"$e = 1$ in both impacts.", "Explicit Euler in the free step."],
        sources: &["chapter §8, conclusion of the negative result"],
        check: check!(common),
    },
    Claim {
        id: "S8.mujoco-choice",
        statement: "MuJoCo gave up variational integrators, which plastic contact and corrections of penetration rule out, for \
            semi-implicit Euler with a soft convex solver: not symplectic, but differentiable and time-reversible, which matters more for \
            MPC and learning.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "A statement of motives. MuJoCo's documentation names the cost of variational integrators, which are implicit \
            where the inertia depends on the configuration, and that continuous-time dynamics are defined backward in time; it names \
            neither plastic contact nor Cirak and West. Forces follow from accelerations in closed form, which may be \
            meant by reversible (S6.time-reversible); the step itself is not, and at the touching point it is not differentiable.",
        argument: r"Stack of three: Newton finds an arbitrary change of velocity again from the push that causes it. In rationals: a step
            $h$ of semi-implicit Euler followed by a step $-h$ does not return, on a spring without damper; Verlet's does. At touching,
            $\partial v^+/\partial\varphi$ of a step $h = 1/5$ on a one-sided spring of unit stiffness jumps by $h$ from the separated to
            the pressed side. With MuJoCo's smallest $t_c = 2h$ the contact step is singular (S8.timeconst-origin).",
        controls: &["Verlet's step in place of semi-implicit Euler's.", "The push without the contact forces."],
        sources: &[
            "chapter §8, why MuJoCo does not use variational integrators",
            "MuJoCo documentation, computation: continuous time (3.17)",
        ],
        check: check!(choice),
    },
];

/// The residuals of the engine's stored fall, or those of explicit Euler's.
fn residuals(engine: Faller, explicit: bool) -> Result<[f64; 2]> {
    Ok(if explicit { Fall::explicit() } else { Fall::stored(engine)? }.residuals())
}

fn falls(name: &str, [new, old]: [f64; 2]) -> [Finding; 2] {
    [
        Finding::equal(format!("{name}: largest |q⁺ − q − h v⁺|"), new, 0.0, FALL, "m").experiment(),
        Finding::equal(format!("{name}: largest |q⁺ − q − h v|"), old, 9.81 * 0.01 * 0.01, FALL, "m").experiment(),
    ]
}

fn nobody(reading: Reading) -> Result<Vec<Finding>> {
    let fall = |engine: Faller| residuals(engine, reading.is_control());
    let both = falls("MuJoCo", fall(Faller::MuJoCo)?).into_iter().chain(falls("Drake", fall(Faller::Drake)?));
    Ok(both.map(|finding| finding.opinion("which simulators are serious")).collect())
}

/// ½ g h t at h = 1/60 s and t = 0.6 s \[m\].
const EULER_ERROR: f64 = 0.5 * 9.81 * 0.6 / 60.0;

fn main_integrator(reading: Reading) -> Result<Vec<Finding>> {
    let thrower = reading.only(0).pick(Thrower::Bullet, Thrower::Siconos);
    let off = projectile_error(thrower)?;
    let explicit = reading.only(1).is_control();
    let fallen = [("MuJoCo", Faller::MuJoCo), ("Drake", Faller::Drake), ("Bullet", Faller::Bullet)];
    let mut findings =
        vec![Finding::equal("Bullet's thrown body, distance from its parabola", off, EULER_ERROR, PROJECTILE, "m").experiment()];
    for (name, engine) in fallen {
        findings.extend(falls(name, residuals(engine, explicit)?));
    }
    Ok(findings)
}

fn midpoint(reading: Reading) -> Result<Vec<Finding>> {
    let (spring, start) = undamped();
    let h = ratio(3, 20);
    let kept = |method: &OneStep| energy_ratio(method, &(spring.clone(), start.clone()), &h);
    let determinant = |method: &OneStep| invariants(&matrix(method, &spring, &h))[1].clone();
    let (level, method) = (theta(1, 1), reading.pick(theta(1, 2), theta(1, 1)));
    let same = matrix(&OneStep::ImplicitDamping, &spring, &h) == matrix(&SEMI_IMPLICIT, &spring, &h);
    let stiff = ratio(-999_999_998, 1_000_000_002);
    // the sentence gives it what its level has, which is θ = 1
    Ok(vec![
        Finding::exact("E⁺/E of the midpoint rule", &kept(&method), &ratio(1, 1), "1").says(kept(&level)),
        Finding::exact("its determinant", &determinant(&method), &ratio(1, 1), "1").says(determinant(&level)),
        Finding::exact("what it leaves of a stiffly damped velocity", &stiff_damper(&method), &stiff, "1").says(stiff_damper(&level)),
        Finding::decision("implicit in the velocity alone: the matrix of semi-implicit Euler", same, true).context(),
    ])
}

fn not_all(reading: Reading) -> Result<Vec<Finding>> {
    let first = projectile_error(reading.only(0).pick(Thrower::Siconos, Thrower::Bullet))?;
    let second = projectile_error(reading.only(1).pick(Thrower::Bullet, Thrower::Siconos))?;
    Ok(vec![
        Finding::equal("Siconos's thrown body, distance from its parabola", first, 0.0, PROJECTILE, "m").says(EULER_ERROR).experiment(),
        Finding::equal("Bullet's", second, EULER_ERROR, PROJECTILE, "m").experiment(),
    ])
}

fn common(reading: Reading) -> Result<Vec<Finding>> {
    let still: &[(i64, i64)] = &[(0, 1), (0, 1)];
    let determinant = |e: Rational| volume(&disk_flow(e, Tangent::Frictionless, ratio(0, 1), still));
    let (plastic, nearly) = reading.only(0).pick((ratio(0, 1), ratio(1, 10)), (ratio(1, 1), ratio(1, 1)));
    let (spring, _) = undamped();
    let [_, free] = invariants(&matrix(&reading.only(1).pick(OneStep::SemiImplicit, OneStep::Explicit), &spring, &ratio(3, 20)));
    let findings = [
        Finding::exact("det D across an impact, e = 0", &determinant(plastic), &ratio(0, 1), "1"),
        Finding::exact("det D across an impact, e = 1/10", &determinant(nearly), &ratio(1, 100), "1"),
        Finding::exact("det D of a free semi-implicit step", &free, &ratio(1, 1), "1"),
    ];
    Ok(findings.map(|finding| finding.opinion("how common plastic contact is, and what failing is")).to_vec())
}

/// A spring that pushes only: v̇ = max(0, −q).
struct OneSided;

impl SmoothSystem for OneSided {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, _velocity: &DVector<T>) -> DVector<T> {
        position.map(|q| if q < T::zero() { -q } else { T::zero() })
    }
}

/// Whether a step h and a step −h lead back to the start.
fn returns(method: &OneStep) -> bool {
    let (spring, start) = undamped();
    let (h, back) = (ratio(1, 5), ratio(-1, 5));
    step(method, &spring, &step(method, &spring, &start, &h), &back) == start
}

/// By how much the slope of v⁺ in the gap falls at touching, from the separated to the pressed side, in a step of 1/5.
fn jump_of_slope(system: &impl SmoothSystem) -> Rational {
    let slope = |side: i64| {
        let gap = Dual { value: ratio(0, 1), slope: ratio(side, 1) };
        let now = Phase::of_one(gap, Dual::constant(ratio(-1, 1)));
        SEMI_IMPLICIT.step(system, &now, &Dual::constant(ratio(1, 5))).velocity[0].slope.clone() * ratio(side, 1)
    };
    slope(1) - slope(-1)
}

fn choice(reading: Reading) -> Result<Vec<Finding>> {
    let reversible = returns(&reading.only(0).pick(OneStep::SemiImplicit, OneStep::Verlet));
    let again = found_again(reading.only(1).pick(1.0, 0.0))?;
    let [_, determinant] = invariants(&step_matrix(&OneStep::SemiImplicit, &SpringDamper::of_ratio(ratio(1, 1)), &ratio(1, 2)));
    Ok(vec![
        Finding::decision("a step of semi-implicit Euler is undone by one of −h", reversible, false)
            .says(true)
            .reading("a motion that is turned round runs back"),
        Finding::at_most("change of velocity found again from its push, relative", again, SOLVED, "1")
            .reading("forces follow from accelerations"),
        Finding::exact("jump of ∂v⁺/∂φ at touching, h = 1/5 s", &jump_of_slope(&OneSided), &ratio(1, 5), "1/s").context(),
        Finding::exact("determinant of the contact step at t_c = 2h", &determinant, &ratio(0, 1), "1").context(),
    ])
}
