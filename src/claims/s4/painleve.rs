//! Painlevé's rod: no sliding force or two, and the impulse that resolves it.
//!
//! Rod of mass 1 and half-length 1 (I = 1/3) at the angle with cos = 3/5, sin = 4/5, its lower end on the floor and sliding
//! with v_t = −1: W_nn = 52/25, W_nt = −36/25, W_tt = 73/25, det W = 4.

use crate::checks::stewart_trinkle::{RationalStep, reference};
use crate::claims::experiments::painleve::{forces, leaning_delassus, rod, rod_delassus};
use crate::claims::prelude::*;
use crate::mechanics::{PainleveRod, State};
use crate::schemes::{self, StewartTrinkle};
use crate::solvers::LemkePivoting;
use crate::solvers::enumeration::{SolutionSet, all_solutions};
use crate::tolerance::claims::lcp::painleve_impulse;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.painleve",
        statement: r"Painlevé 1895: for some rigid bodies with Coulomb friction (a rod sliding on the ground with large $\mu$) the
            equations of motion have no solution or several.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"For the uniform rod at an angle with the tangent $t$ this happens for
            $\mu > \mu_P = W_{nn}/|W_{nt}| = (4 + t^2)/(3t) \ge 4/3$ when it slides with its lower end ahead, away from the side it
            leans to.",
        argument: r"Sliding force $\lambda$ with friction $\mu\lambda$: $0 \le \lambda \perp A\lambda + b \ge 0$,
            $A = W_{nn} - \mu|W_{nt}|$. At cos $= 3/5$: $\mu_P = 13/9$. With $\mu = 2$: $A = -4/5$; $b = -1$ has no solution, $b = 1$ has
            two (0 and 5/4). $(4 + t^2)/(3t) - 4/3 = (t - 2)^2/(3t) \ge 0$, so $\mu_P$ is least at $t = 2$.",
        controls: &[r"$\mu = 1 < \mu_P$: exactly one solution for either sign of $b$.", r"A rod that leans the other way, cos $= 4/5$."],
        sources: &["chapter §4, resolution of Painlevé's paradox", "Painlevé 1895; Génot and Brogliato 1999"],
        check: check!(paradox),
    },
    Claim {
        id: "S4.painleve-atom",
        statement: r"(Stewart 1998) The limit $h \to 0$ of Stewart–Trinkle solutions exists (§4: of a subsequence) but contains impulsive
            atoms, “impact without collision”: in a Painlevé configuration the system produces an instantaneous impulse by itself; time
            stepping delivers this measure solution automatically.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Where no sliding force exists the step has one solution, whose impulse does not vanish with $h$:
            $P_n = |W_{nt}||v_t|/\det W$, $P_t = W_{nn}|v_t|/\det W$, and the end sticks. Where two forces exist the step has three
            solutions, and the solver's pivoting rule decides whether there is an atom.",
        argument: r"cos $= 3/5$, $\mu = 2$, $v_t = -1$, gravity 9.81, $h = 1/100$, then a hundredth of it twice: one solution each,
            $P = W^{-1}(g\,h, 1) \to (9/25, 13/25)$. At the last $h\,P = (0.3600072, 0.5200035)$. With an upward normal free velocity,
            where two sliding forces exist (a Painlevé configuration as well): 3 solutions (open, sliding, impact).",
        controls: &[r"$\mu = 1 < \mu_P$: the impulse is of order $h$ and there is no atom."],
        sources: &["chapter §4, resolution of Painlevé's paradox", "Stewart 1998 (not read)"],
        check: check!(atom),
    },
    Claim {
        id: "S4.ex3-energy",
        statement: "Exercise 3: is the impulse of Painlevé's rod dissipative in energy, or does it inject energy?",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"It dissipates: $\Delta T = \tfrac12P^T(u^+ + u^-) = -\tfrac12\,W_{nn}\,v_t^2/\det W = -(1 + 3\cos^2)/8 \cdot
            m\,v_t^2$.",
        argument: r"$u^- = (0, -1)$, $P = (9/25, 13/25)$, $u^+ = 0$: $\Delta T = \tfrac12\cdot(13/25)\cdot(-1) = -13/50$ with $m = 1$, cos
            $= 3/5$; the same from $\tfrac12v^TMv$ before and after.",
        controls: &["A rod whose end starts below the floor: the impulse that pushes it out injects energy."],
        sources: &["chapter §4, exercise 3"],
        check: check!(dissipation),
    },
];

/// The different velocities after the step among these solutions.
pub(super) fn velocities(system: &RationalStep, set: &SolutionSet) -> Vec<DVector<Rational>> {
    let mut velocities: Vec<DVector<Rational>> = Vec::new();
    for z in &set.points {
        let velocity = &system.free_velocity + system.impulse(z).component_div(&system.mass);
        if !velocities.contains(&velocity) {
            velocities.push(velocity);
        }
    }
    velocities
}

fn paradox(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.only(0).pick(ratio(2, 1), ratio(1, 1));
    let block = leaning_delassus(reading.only(1).pick([ratio(3, 5), ratio(4, 5)], [ratio(4, 5), ratio(3, 5)]))?;
    let threshold = -&block[(0, 0)] / &block[(0, 1)];
    let tangent = ratio(4, 3);
    let closed_form = (ratio(4, 1) + &tangent * &tangent) / (ratio(3, 1) * tangent);
    let largest = forces(&rod_delassus()?, &ratio(2, 1), 1)?.into_iter().fold(ratio(0, 1), Ord::max);
    Ok(vec![
        Finding::count("sliding forces for b = −1", forces(&block, &friction, -1)?.len(), 0),
        Finding::count("sliding forces for b = +1", forces(&block, &friction, 1)?.len(), 2),
        Finding::exact("μ_P = W_nn/|W_nt|", &threshold, &closed_form, "1"),
        Finding::decision("μ is larger than μ_P", friction > threshold, true),
        Finding::exact("the larger of the forces for b = 1", &largest, &ratio(5, 4), "m/s²").context(),
    ])
}

fn atom(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.pick(ratio(2, 1), ratio(1, 1));
    let block = rod_delassus()?;
    let determinant = &block[(0, 0)] * &block[(1, 1)] - &block[(0, 1)] * &block[(0, 1)];
    let mut findings = Vec::new();
    for h in [ratio(1, 1_000_000), ratio(1, 10_000), ratio(1, 100)] {
        let fall = ratio(981, 100) * &h;
        let set = all_solutions(&reference(&rod(friction.clone(), -fall.clone()))?)?;
        let normal = (&block[(1, 1)] * &fall - &block[(0, 1)]) / &determinant;
        let tangential = (&block[(0, 0)] - &block[(0, 1)] * &fall) / &determinant;
        findings.push(Finding::exact(format!("P_n at h = {h}"), &set.points[0][0], &normal, "N·s"));
        findings.push(Finding::exact(format!("P_t at h = {h}"), &(&set.points[0][1] - &set.points[0][2]), &tangential, "N·s"));
    }
    let indeterminate = rod(friction, ratio(1, 1000));
    let velocities = velocities(&indeterminate, &all_solutions(&reference(&indeterminate)?)?);
    findings.push(
        Finding::count("different answers where two sliding forces exist", velocities.len(), 3)
            .says(1usize)
            .violating("no force lets the end slide on"),
    );
    findings.extend(scheme_step(reading.pick(2.0, 1.0))?);
    let limit = [-&block[(0, 1)] / &determinant, &block[(0, 0)] / &determinant];
    findings.push(Finding::exact("limit of P_n", &limit[0], &ratio(9, 25), "N·s").context());
    findings.push(Finding::exact("limit of P_t", &limit[1], &ratio(13, 25), "N·s").context());
    Ok(findings)
}

/// The same step by the scheme, in floating point, at h = 2⁻¹⁰.
fn scheme_step(friction: f64) -> Result<Vec<Finding>> {
    let (gravity, h) = (9.81, 1.0 / 1024.0);
    let rod = PainleveRod::new(1.0, 1.0, gravity, friction, 0.0)?;
    let state = State { time: 0.0, position: dvector![0.0, 0.8, 0.8f64.atan2(0.6)], velocity: dvector![-1.0, 0.0, 0.0] };
    let step = schemes::step(&StewartTrinkle::default(), &LemkePivoting, &rod, &state, h)?;
    let impulse = &step.impulses[0].impulse;
    let expected = [(73.0 * gravity * h + 36.0) / 100.0, (52.0 + 36.0 * gravity * h) / 100.0];
    let compare = |name, k: usize| Finding::equal(name, impulse[k], expected[k], painleve_impulse(h), "N·s");
    Ok(vec![compare("P_n of the scheme at h = 1/1024", 0), compare("P_t of the scheme at h = 1/1024", 1)])
}

fn dissipation(reading: Reading) -> Result<Vec<Finding>> {
    let mut system = rod(ratio(2, 1), ratio(0, 1));
    system.gap[0] = reading.pick(ratio(0, 1), ratio(-1, 1));
    let solution = all_solutions(&reference(&system)?)?;
    let tangential = &solution.points[0][1] - &solution.points[0][2];
    let impulse = DVector::from_vec(vec![solution.points[0][0].clone(), tangential.clone()]);
    let change = (system.jacobian.transpose() * &impulse).component_div(&system.mass);
    let after = &system.free_velocity + change;
    let kinetic = |v: &DVector<Rational>| v.component_mul(&system.mass).dot(v) / ratio(2, 1);
    let difference = kinetic(&after) - kinetic(&system.free_velocity);
    Ok(vec![
        Finding::exact("ΔT", &difference, &ratio(-13, 50), "J"),
        Finding::exact("P_n of the step's solution", &impulse[0], &ratio(9, 25), "N·s"),
        Finding::exact("P_t of the step's solution", &tangential, &ratio(13, 25), "N·s"),
        Finding::decision("the end sticks", (&system.jacobian * after).iter().all(|u| u.is_zero()), true),
    ])
}
