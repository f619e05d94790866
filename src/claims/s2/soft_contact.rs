//! Penalty contact: its force at touchdown, and the hard contact it tends to.

use super::half_space::Impact;
use crate::claims::prelude::*;
use crate::closed_forms::CompliantImpact;
use crate::tolerance::claims::{SOFT_STEP, soft_restitution};

/// Claims on soft contact.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S2.soft-diff",
        statement: "Penalty or soft contact is a smooth function, differentiable everywhere, whereas hard contact is not differentiable \
            where the active set changes.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"The clamped spring $\max(0, -k\varphi)$ is continuous with a kink at $\varphi = 0$; with damping the force
            jumps at touchdown. It is differentiable away from the change of the active set – as hard contact is.",
        argument: r"The difference quotients of $\max(0, -k\varphi)$ at 0 are $-k$ from the left and 0 from the right, at every step size.
            With a dashpot, $-k\varphi - c\,\dot\varphi$ for $\varphi < 0$, the force at touchdown with 2 m/s and $c = 30$ N·s/m is 60 N
            an instant after contact and 0 before it. The hard impact $v^+(v^-)$ with $e = 1/2$ has the slopes −1/2 and 1 at $v^- = 0$.",
        controls: &[
            r"Spring and dashpot that never let go, $-k\varphi - c\,\dot\varphi$ at every $\varphi$: differentiable, but they hold the
                bodies together.",
            r"A hard contact that never lets go, $v^+ = -e\,v^-$ at every $v^-$.",
        ],
        sources: &["chapter §2, sweeping process and penalty compared"],
        check: check!(differentiability),
    },
    Claim {
        id: "S2.soft-limit",
        statement: r"Soft and hard contact are united for $k \to \infty$: the stiff limit of soft contact is hard contact.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Penetration vanishes like $v\sqrt{m/k}$, and the limit is hard contact with the restitution that the damping
            ratio $\zeta$ fixes, independent of $k$: $e = 1$ without damping, $\exp(-\pi\zeta/\sqrt{1 - \zeta^2})$ if the dashpot acts
            until $\varphi = 0$, and a larger one if the force may not pull.",
        argument: r"In the time $\sqrt{m/k}$ the impact is $m\,x^{\prime\prime} + 2\zeta\,x' + x = 0$, without $k$. Integrated for
            $k = \text{1e4}$ and 1e8 N/m: $e = 0.5266$ ($\zeta = 0.2$) and 0.1630 ($\zeta = 0.5$) for the dashpot until $\varphi = 0$;
            0.5717 and 0.2984 when contact ends with the force; 1 for $\zeta = 0$. With the dashpots that give 0.5266 and 0.1630 at
            $k = \text{1e4}$ left as they are, $k = \text{1e8}$ has a hundredth of $\zeta$ and $e = 0.994$ and 0.984: $k \to \infty$ at
            fixed damping tends to the elastic law, whatever $c$ was meant to model.",
        controls: &[
            r"The dashpot that grows with $\sqrt{k}$ in place of the one that is left as it is.",
            "The impact integrated by explicit Euler in place of Runge and Kutta.",
        ],
        sources: &[
            "chapter §2, sweeping process and penalty compared",
            "Schwager and Pöschel, Coefficient of restitution and linear–dashpot model revisited (2007)",
        ],
        check: check!(stiff_limit),
    },
];

fn differentiability(reading: Reading) -> Result<Vec<Finding>> {
    let (stiffness, zero) = (ratio(1000, 1), ratio(0, 1));
    let (lets_go, hard_lets_go) = (reading.only(0).pick(true, false), reading.only(1).pick(true, false));
    let force = |gap: &Rational, damping: Rational| {
        if lets_go && *gap >= zero { zero.clone() } else { damping - stiffness.clone() * gap.clone() }
    };
    let spring = |gap: &Rational| force(gap, zero.clone());
    let mut findings = Vec::new();
    for step in [ratio(1, 1000), ratio(1, 1 << 40)] {
        let left = (spring(&zero) - spring(&-step.clone())) / step.clone();
        let right = (spring(&step) - spring(&zero)) / step.clone();
        let name = format!("kink of the force at φ = 0, quotients over {step}");
        findings.push(Finding::exact(name, &(right - left), &stiffness, "N/m").says(ratio(0, 1)));
    }
    let damped = |gap: &Rational| force(gap, ratio(30, 1) * ratio(2, 1));
    let hair = ratio(1, 1 << 60);
    let spring_alone = spring(&-hair.clone()) - spring(&hair);
    let jump = damped(&-hair.clone()) - damped(&hair) - spring_alone;
    findings.push(Finding::exact("jump of the damped force at touchdown with 2 m/s", &jump, &ratio(60, 1), "N").says(ratio(0, 1)));
    let hard = Impact::moreau(ratio(1, 1), ratio(1, 2));
    let rebound = |before: &Rational| if hard_lets_go { hard.solutions(before).pop() } else { Some(-(before.clone() * ratio(1, 2))) };
    let slope = |before: Rational| rebound(&before).map(|after| after / &before);
    let differentiable = slope(ratio(-1, 1000)) == slope(ratio(1, 1000));
    findings.push(Finding::decision("the hard impact is not differentiable at v⁻ = 0", !differentiable, true));
    Ok(findings)
}

/// When contact ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum End {
    /// When the gap opens: the dashpot may pull.
    Gap,
    /// When the force vanishes: it may not.
    Force,
}

/// A one-step method for (x, v)˙ = slope(x, v).
type Method = fn(&dyn Fn([f64; 2]) -> [f64; 2], [f64; 2], f64) -> [f64; 2];

fn along([x, v]: [f64; 2], [a, b]: [f64; 2], h: f64) -> [f64; 2] {
    [x + h * a, v + h * b]
}

pub(super) fn runge_kutta(slope: &dyn Fn([f64; 2]) -> [f64; 2], state: [f64; 2], h: f64) -> [f64; 2] {
    let first = slope(state);
    let second = slope(along(state, first, h / 2.0));
    let third = slope(along(state, second, h / 2.0));
    let fourth = slope(along(state, third, h));
    let mean = [0, 1].map(|i| (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i]) / 6.0);
    along(state, mean, h)
}

fn explicit_euler(slope: &dyn Fn([f64; 2]) -> [f64; 2], state: [f64; 2], h: f64) -> [f64; 2] {
    along(state, slope(state), h)
}

/// Speed after an impact at 1 m/s of a unit mass on a spring and a dashpot, and the deepest penetration; the last step is shortened
/// by bisection to end with the contact.
pub(super) fn impact(method: Method, stiffness: f64, damping: f64, end: End) -> (f64, f64) {
    let slope = |[x, v]: [f64; 2]| [v, -stiffness * x - damping * v];
    let step = |state: [f64; 2], h: f64| method(&slope, state, h);
    let over = |[x, v]: [f64; 2]| match end {
        End::Gap => x >= 0.0,
        End::Force => -stiffness * x - damping * v <= 0.0,
    };
    let h = SOFT_STEP / stiffness.sqrt();
    let (mut state, mut depth) = ([0.0, -1.0], 0.0f64);
    state = step(state, h);
    while !over(step(state, h)) {
        state = step(state, h);
        depth = depth.max(-state[0]);
    }
    let (mut during, mut after) = (0.0, h);
    for _ in 0..60 {
        let middle = 0.5 * (during + after);
        if over(step(state, middle)) { after = middle } else { during = middle }
    }
    (step(state, after)[1], depth)
}

fn stiff_limit(reading: Reading) -> Result<Vec<Finding>> {
    let (soft, stiff) = (1e4f64, 1e8f64);
    let method: Method = reading.only(1).pick(runge_kutta, explicit_euler);
    let mut findings = Vec::new();
    let mut deepest = 0.0f64;
    for stiffness in [stiff, soft] {
        for (zeta, end) in [(0.2, End::Gap), (0.2, End::Force), (0.5, End::Gap), (0.5, End::Force), (0.0, End::Gap)] {
            let (speed, depth) = impact(method, stiffness, 2.0 * zeta * stiffness.sqrt(), end);
            deepest = deepest.max(depth * stiffness.sqrt());
            let exact = CompliantImpact::new(1.0, 1.0, 2.0 * zeta)?;
            let expected = match end {
                End::Gap => exact.restitution_with_adhesion(),
                End::Force => exact.restitution_cut(),
            };
            let ends = if matches!(end, End::Gap) { "penetration" } else { "push" };
            let name = format!("restitution, ζ = {zeta}, contact until the {ends} ends, k = {stiffness:e}");
            findings.push(Finding::equal(name, speed, expected, soft_restitution(), "1"));
        }
    }
    findings.push(Finding::at_most("largest depth × √k of these", deepest, 1.0 + soft_restitution(), "m/s"));
    for zeta in [0.2, 0.5] {
        let damping = 2.0 * zeta * reading.only(0).pick(soft, stiff).sqrt();
        let (speed, _) = impact(method, stiff, damping, End::Gap);
        let of_the_law = CompliantImpact::new(1.0, 1.0, 2.0 * zeta)?.restitution_with_adhesion();
        let left = CompliantImpact::new(1.0, stiff, 2.0 * zeta * soft.sqrt())?.restitution_with_adhesion();
        let name = format!("restitution at k = 1e8 with the dashpot of ζ = {zeta} at 1e4");
        let found = Finding::equal(name, speed, left, soft_restitution(), "1");
        findings.push(found.says(of_the_law).violating("damping that grows with √k"));
    }
    Ok(findings)
}
