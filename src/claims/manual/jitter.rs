//! Rows 5 and 6: a stack that trembles, and a block that creeps.

use crate::claims::experiments::creep::Creeping;
use crate::claims::experiments::soft::{GRAVITY, land, unlimited_contact};
use crate::claims::experiments::theta_energy::{SPRING, effect_of_theta_on_a_tower};
use crate::claims::experiments::tower::{Sweeps, Tower, approach_left};
use crate::claims::prelude::*;
use crate::tolerance::claims::pathology as tolerance;

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "R5",
        statement: r"A stack at rest trembles at high frequency: possible causes (a) step too large, (b) stiffness too high for the step,
            (c) solver not converged, (d) forces switch. Raise the solver's iterations (most common), reduce the step or the stiffness,
            increase numerical damping ($\theta \to 1$) moderately, warm-start the contact forces.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Advice,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"More iterations, a smaller step or stiffness and a warm start work, as predicted; $\theta \to 1$ has no
            effect on rigid contacts under a constant load (S9.theta-damps-jitter).",
        argument: r"Tower of ten, Gauss–Seidel: a sweep leaves the factor $\cos^2(\pi/20)$ of the approach velocity, 200 sweeps 0.00705 of
            it (measured between 200 and 400 sweeps). Ten cold sweeps a step: the top sinks at 0.40 m/s with $h = 1/100$ s; half the step
            halves its speed; with a warm start the tower stands. $\theta = 1/2$ or 1: the same bit for bit. Contact with $t_c = h$:
            thrown up; $t_c = 1.5h$: calm.",
        controls: &[
            r"Bodies of the tower that hang on springs as well: there $\theta$ matters.",
            "A tower of five in the place of ten.",
            "Twice the sweeps in the halved step, no warm start, and the two time constants exchanged.",
        ],
        sources: &["chapter, troubleshooting manual, row 5"],
        check: check!(trembling),
    },
    Claim {
        id: "R6",
        statement: r"A body that should rest on a slope slides down slowly: possible cause the $O(h)$ gliding of the convex relaxation, no
            bug and no wrong parameter. Check whether the scheme is convex (SAP, MuJoCo, Chrono); reduce $h$ and see whether the slip
            shrinks linearly, which confirms gliding; accept it or reduce $h$; do not mend it with a larger friction coefficient.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Advice,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"True of SAP: $v = R_t\,h\,g_t$. In MuJoCo the creep $v = R_t\,g_t/b$ does not depend on $h$ up to
            timeconst/2, 10 ms by default, and is a matter of parameters (impratio, solimp, solref); under Drake's Similar and Lagged it
            is proportional to their stiction speed; the hard relaxation (Anitescu, Chrono) does not creep. That $\mu$ is no cure holds
            for the first two.",
        argument: r"Block on 20°, $\mu = 1/2$, stepped until steady at $h = 4$, 2 and 1 ms: creep at $h$ over that at $h/2$ is 1 for
            MuJoCo and for Drake's regularised friction, 2 for SAP; 0 for the hard block. impratio $= 10$ divides MuJoCo's creep by 10.
            Each agrees with its closed form, and these with the stored runs of MuJoCo 3.17.0 and Drake 1.51.1.",
        controls: &[
            "SAP in the place of MuJoCo, of the regularised friction and of the hard block.",
            "Another law's steps: MuJoCo's for SAP's, the hard block's for MuJoCo's, SAP's for the regularised.",
        ],
        sources: &["chapter, troubleshooting manual, row 6", "S5.gliding-creep", "stored runs of block_stick, see tests/references"],
        check: check!(creeping),
    },
];

fn trembling(reading: Reading) -> Result<Vec<Finding>> {
    let (bodies, h) = (10, 0.01);
    let tower = Tower { bodies, gravity: GRAVITY, stiffness: 0.0 };
    let stepped = Tower { bodies: reading.only(1).pick(bodies, 5), gravity: GRAVITY, stiffness: 0.0 };
    let fewer = approach_left(&tower, 200, h)?;
    let left = approach_left(&stepped, 400, h)? / approach_left(&stepped, 200, h)?;
    let effect = effect_of_theta_on_a_tower(reading.only(0).pick(0.0, SPRING))?;
    let speed =
        |sweeps: Sweeps, h: f64, steps: usize| -> Result<f64> { Ok(-stepped.simulate(&sweeps, 0.5, h, steps)?.last().velocity.min()) };
    let [cold, finer] = [speed(Sweeps::cold(10), h, 400)?, speed(Sweeps::cold(reading.only(2).pick(10, 20)), 0.5 * h, 400)?];
    let warm = speed(Sweeps { count: 10, warm: reading.only(2).pick(true, false) }, h, 400)?;
    let [_, predicted] = tower.predicted_sinking(10, 0.5, h, 400);
    let thrown = |parts: f64| land(&unlimited_contact(0.001, parts * 0.001), 0.001, 2000).speed;
    let [stiff, calm] = reading.only(2).pick([1.0, 1.5], [1.5, 1.0]);
    let rounding_error = tolerance::tower_rounding(bodies, 10, 400);
    Ok(vec![
        Finding::equal(
            "approach velocity left by 400 sweeps over that of 200",
            left,
            tower.sweep_factor(1).powi(200),
            tolerance::sweep_ratio(bodies, 400, fewer),
            "1",
        ),
        Finding::equal("speed of the top, 10 cold sweeps a step, against a linear recursion", cold, predicted, rounding_error, "m/s"),
        Finding::equal("the same over that with half the step", cold / finer, 2.0, 3.0 * rounding_error / finer, "1"),
        Finding::at_most("the same with a warm start", warm, tolerance::solved_speed(bodies, h, 400), "m/s"),
        Finding::equal("effect of θ = 1 instead of 1/2 on a tower", effect, 0.0, 0.0, "m/s")
            .says_at_least(f64::MIN_POSITIVE)
            .violating("the load depends on the state"),
        Finding::at_least("speed at rest of a soft contact with t_c = h", thrown(stiff), GRAVITY * 0.001, "m/s"),
        Finding::equal("speed at rest with t_c = 1.5h", thrown(calm), 0.0, tolerance::rest_speed(GRAVITY, 0.001), "m/s"),
    ])
}

fn creeping(reading: Reading) -> Result<Vec<Finding>> {
    let mujoco = Creeping::Mujoco { impedance_ratio: 1 };
    let halving = |law: Creeping, h: f64| -> Result<f64> { Ok(law.stepped(h)? / law.stepped(0.5 * h)?) };
    let [soft, regularised, hard] = reading.only(0).pick([mujoco, Creeping::Regularised, Creeping::Hard], [Creeping::Sap; 3]);
    let [of_sap, of_mujoco, of_regularised] =
        reading.only(1).pick([Creeping::Sap, mujoco, Creeping::Regularised], [mujoco, Creeping::Hard, Creeping::Sap]);
    let proportional = "the friction has a softness proportional to h";
    let mut findings = vec![
        Finding::equal("MuJoCo's creep at 4 ms over that at 2 ms", halving(soft, 0.004)?, 1.0, tolerance::AT_REST, "1")
            .says(2.0)
            .violating(proportional),
    ];
    for h in [0.004, 0.002] {
        let sap = format!("SAP's creep at {h} s over that at half");
        findings.push(Finding::equal(sap, halving(of_sap, h)?, 2.0, 2.0 * tolerance::AT_REST, "1"));
        let name = format!("creep of Similar and Lagged at {h} s over that at half");
        findings.push(Finding::equal(name, halving(regularised, h)?, 1.0, tolerance::AT_REST, "1").says(2.0).violating(proportional));
        let name = format!("creep of the hard relaxation at {h} s");
        let rounding = tolerance::creep(0.0);
        // that it creeps at all: faster than any rounding
        findings.push(Finding::equal(name, hard.stepped(h)?, 0.0, rounding, "m/s").says_at_least(4.0 * rounding).violating(proportional));
    }
    for (law, steps) in [(mujoco, of_mujoco), (Creeping::Sap, of_sap), (Creeping::Regularised, of_regularised)] {
        let expected = law.predicted(0.002)?;
        findings.push(Finding::equal(
            format!("creep at 2 ms against its closed form, {}", law.name()),
            steps.stepped(0.002)?,
            expected,
            tolerance::creep(expected),
            "m/s",
        ));
    }
    let softened = mujoco.stepped(0.002)? / Creeping::Mujoco { impedance_ratio: 10 }.stepped(0.002)?;
    let name = "MuJoCo's creep over that with impratio = 10";
    findings.push(Finding::equal(name, softened, 10.0, 10.0 * tolerance::AT_REST, "1").context());
    Ok(findings)
}
