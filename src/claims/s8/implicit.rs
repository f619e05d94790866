//! Implicit Euler and the θ method: stability at every step, what it costs, and where semi-implicit Euler stands.

use crate::claims::experiments::floors::{Floor, elastic_invariant};
use crate::claims::experiments::spring_damper::{OneStep, SEMI_IMPLICIT, energy, energy_ratio, hill, matrix, powers_at, theta, undamped};
use crate::claims::prelude::*;
use crate::closed_forms::spring_damper::theta_energy_ratio;
use crate::exact_particle::{Ball, BallState};
use crate::integrators::stability::{Powers, invariants, spectral_radius};
use crate::integrators::{Method, Phase, SmoothSystem, SpringDamper};
use crate::tolerance::claims::integrators::HALVED;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.implicit-AL",
        statement: r"Fully implicit integration ($\theta = 1$) is the most stable, A-stable and $L$-stable; it allows large steps and
            needs a nonlinear system solved per step.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; a system that is nonlinear where the forces are, with contact in it in any case. $\theta = 1/2$ is
            A-stable, not $L$-stable.",
        argument: r"$R(z) = 1/(1 - z)$: $|R| < 1$ in the left half plane, and $R \to 0$. In rationals: steps of $s = 1/1000$, 1 and $10^6$
            decay at $\zeta = 1/1000$, 1 and 50; a damper with $h\,c/m = 10^9$ keeps $1/(1 + 10^9)$ of its velocity under $\theta = 1$ and
            $-(10^9 - 2)/(10^9 + 2)$ under $\theta = 1/2$.",
        controls: &[r"$\theta = 1/2$ in place of 1: A-stable, not $L$-stable.", r"Semi-implicit Euler in place of $\theta = 1$."],
        sources: &["chapter §8, three levels", "Hairer and Wanner, Solving Ordinary Differential Equations II, IV.3"],
        check: check!(stiff),
    },
    Claim {
        id: "S8.backward-uncond",
        statement: r"Implicit Euler is unconditionally stable on the spring, $|G| < 1$ for every $h$; the price is an $O(h^2)$ dissipation
            that wipes out the contact's oscillation at large steps.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated; $|G|^2 = 1/(1 + s^2)$, per step (over a fixed time the loss is $O(h)$, S8.implicit-diss).",
        argument: r"Determinant $1/(1 + s^2)$ and decay at $s = 1/1000$, 1, 2, $10^6$ in rationals, without damping;
            $|G| = 1/\sqrt{1 + s^2}$ in floating point.",
        controls: &[r"$\theta = 1/2$, for which $|G| = 1$."],
        sources: &["chapter §8, example on stability bounds"],
        check: check!(backward),
    },
    Claim {
        id: "S8.implicit-diss",
        statement: r"The price of the fully implicit level is numerical dissipation (that of $\theta = 1$, $O(h^2)$).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"On a convex potential, and per step, as §3 derives it: a spring has $E^+/E = 1/(1 + h^2\omega^2)$. Where the
            potential is concave, $\ddot q = \omega^2q$, the same step gains, $E^+/E = 1/(1 - h^2\omega^2)$. Over a fixed time the loss is
            $O(h)$.",
        argument: r"$\omega = 1$, in rationals: the energy lost in a step of 1/32 over that in one of 1/64 lies within 1/16 of 4; over
            $t = 1$ the ratio is within 1/16 of 2. Across the top of a hill, $\ddot q = q$, a step of 1/2 with $\theta = 1$ makes 4/3 of
            the energy.",
        controls: &["A spring in place of the hill.", r"A spring with a damper, $\zeta = 1/2$, whose own loss in a step is $O(h)$."],
        sources: &["chapter §8, three levels and table"],
        check: check!(dissipation),
    },
    Claim {
        id: "S8.implicit-not-always",
        statement: "Fully implicit integration is not always best: each step is dearer, and its dissipation takes the motion away where \
            details or energy matter.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: r"Undamped spring, 20 steps of $s = 1$: $\theta = 1$ leaves $2^{-20}$ of the energy, $\theta = 1/2$ all of it, and
            semi-implicit Euler returns to its start after six steps, without solving anything.",
        controls: &[r"$\theta = 1/2$ in place of 1.", r"A spring with a damper, $\zeta = 1/10$, which takes energy under every method."],
        sources: &["chapter §8, pitfall: fully implicit is always best"],
        check: check!(not_always),
    },
    Claim {
        id: "S8.theta-spectrum",
        statement: r"The $\theta$ scheme parametrises the spectrum: $\theta = 0$ explicit, $\theta = 1$ fully implicit, $\theta = 1/2$
            trapezoidal, close to a symplectic method's neutrality in energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; on linear forces $\theta = 1/2$ is symplectic and keeps the energy exactly:
            $E^+/E = (1 + (1 - \theta)^2s^2)/(1 + \theta^2s^2)$, determinant the same number.",
        argument: r"$h\omega = 3/10$ in rationals, $\theta = 0$, 1/4, 1/2, 3/4, 1: energy ratio and determinant are the formula, and 1 at
            $\theta = 1/2$.",
        controls: &[r"$\theta = 2/5$ in the place of 1/2.", r"A spring with a damper, $\zeta = 1/10$."],
        sources: &["chapter §8, bridge to §3"],
        check: check!(spectrum),
    },
    Claim {
        id: "S8.semi-on-spectrum",
        statement: r"Semi-implicit Euler is a particular splitting (velocity implicit, position semi-implicit); it, the $\theta$ scheme of
            Siconos and Drake's are points of the same spectrum.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Of the spectrum from explicit to implicit, yes; no value of $\theta$ gives it unless the force is constant.
            It takes the force at the old position, $\theta_v = 0$, and the velocity at the new one, $\theta_q = 1$.",
        argument: r"Its determinant is 1, which on the $\theta$ family only $\theta = 1/2$ has, where the trace is
            $2(4 - s^2)/(4 + s^2) \ne 2 - s^2$. At $s = 1$: 6/5 against 1. Under a constant force $\theta = 1$ is the same step.",
        controls: &[r"The step of $\theta = 1/2$ in place of that of semi-implicit Euler.", "The step of explicit Euler."],
        sources: &["chapter §8, bridge to §3"],
        check: check!(no_theta),
    },
    Claim {
        id: "S8.backwards-theta-energy",
        statement: r"$\theta = 1/2$ is the trapezoidal rule, close to a symplectic method's neutrality in energy; $\theta = 1$ is fully
            implicit and dissipates.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"In smooth motion under a constant force or a convex potential. Where the potential is concave $\theta = 1$
            gains. And what it loses in flight, $\tfrac12\,m\,g^2h^2$ a step, elastic impacts give back:
            $E - (\theta - \tfrac12)\,m\,g\,h\,v$ is conserved through flights and impacts, for every $\theta$.",
        argument: r"In rationals: a spring with $h\omega = 3/10$ keeps 100/109 of its energy in a step with $\theta = 1$, and all of it
            with $\theta = 1/2$; a body that crosses the top of a hill, $\ddot q = q$, has 4/3 of its energy after a step of 1/2 with
            $\theta = 1$. One step of flight loses $\tfrac12\,g^2h^2$ per kilogram. Elastic ball from 1 m, $h = 1/100$ s, 2000 steps with
            $\theta = 1$: $(E - \tfrac12\,m\,g\,h\,v)/E_0 = 1$.",
        controls: &["A spring in place of the hill.", r"$\theta = 0$ in place of 1/2 and of 1."],
        sources: &["chapter §8, bridge to §3", "S3.energy-runs-down"],
        check: check!(under_gravity),
    },
];

/// What one step with h c/m = 10⁹ leaves of the velocity of a mass on a damper.
pub(super) fn stiff_damper(method: &impl Method) -> Rational {
    let damper = SpringDamper { stiffness_per_mass: ratio(0, 1), damping_per_mass: ratio(1_000_000_000, 1) };
    matrix(method, &damper, &ratio(1, 1))[(1, 1)].clone()
}

fn stiff(reading: Reading) -> Result<Vec<Finding>> {
    let method = match reading {
        Reading::Recorded => theta(1, 1),
        Reading::Control(0) => theta(1, 2),
        Reading::Control(_) => OneStep::SemiImplicit,
    };
    let ratios = [ratio(1, 1000), ratio(1, 1), ratio(50, 1)];
    let steps = [ratio(1, 1000), ratio(1, 1), ratio(1_000_000, 1)];
    let cases = ratios.iter().flat_map(|zeta| steps.iter().map(move |s| (zeta, s)));
    let decaying = cases.filter(|(zeta, s)| powers_at(&method, zeta, s) == Powers::Decay).count();
    Ok(vec![
        Finding::exact("R(−10⁹) of θ = 1", &stiff_damper(&method), &ratio(1, 1_000_000_001), "1"),
        Finding::count("steps that decay, of three sizes at three damping ratios", decaying, 9),
        Finding::exact("R(−10⁹) of θ = 1/2", &stiff_damper(&theta(1, 2)), &ratio(-999_999_998, 1_000_000_002), "1").context(),
    ])
}

fn backward(reading: Reading) -> Result<Vec<Finding>> {
    let method = reading.pick(theta(1, 1), theta(1, 2));
    let mut findings = Vec::new();
    for s in [ratio(1, 1000), ratio(1, 1), ratio(2, 1), ratio(1_000_000, 1)] {
        let step = matrix(&method, &SpringDamper::of_ratio(ratio(0, 1)), &s);
        let [_, determinant] = invariants(&step);
        let square = ratio(1, 1) / (ratio(1, 1) + &s * &s);
        findings.push(Finding::exact(format!("|G|² at s = {s}"), &determinant, &square, "1"));
        let decays = powers_at(&method, &ratio(0, 1), &s) == Powers::Decay;
        findings.push(Finding::decision(format!("decays at s = {s}"), decays, true));
        let radius = spectral_radius(&step.map(|entry| Scalar::to_f64(&entry)));
        let size = 1.0 / (1.0 + Scalar::to_f64(&s).powi(2)).sqrt();
        findings.push(Finding::equal(format!("|G| in floating point at s = {s}"), radius, size, rounding(16, size), "1"));
    }
    Ok(findings)
}

/// The share of its energy that a spring with ω = 1 loses in a number of steps h with θ = 1.
fn loss(damping_ratio: &Rational, h: &Rational, steps: usize) -> f64 {
    let spring = SpringDamper::of_ratio(damping_ratio.clone());
    let start = Phase::of_one(ratio(1, 1), ratio(1, 3));
    let end = (0..steps).fold(start.clone(), |now, _| theta(1, 1).step(&spring, &now, h));
    Scalar::to_f64(&(ratio(1, 1) - energy(&spring, &end) / energy(&spring, &start)))
}

fn dissipation(reading: Reading) -> Result<Vec<Finding>> {
    let (coarse, fine) = (ratio(1, 32), ratio(1, 64));
    let zeta = reading.only(1).pick(ratio(0, 1), ratio(1, 2));
    let one_step = loss(&zeta, &coarse, 1) / loss(&zeta, &fine, 1);
    let fixed_time = loss(&zeta, &coarse, 32) / loss(&zeta, &fine, 64);
    let place = reading.only(0).pick(hill(), undamped());
    Ok(vec![
        Finding::equal("loss of a step, h = 1/32 over h = 1/64", one_step, 4.0, HALVED, "1"),
        Finding::equal("E⁺/E at h = 1/32", 1.0 - loss(&zeta, &coarse, 1), theta_energy_ratio(1.0, 1.0 / 32.0), rounding(4, 1.0), "1"),
        Finding::exact("E⁺/E on a hill, q̈ = q, h = 1/2", &energy_ratio(&theta(1, 1), &place, &ratio(1, 2)), &ratio(4, 3), "1")
            .says_at_most(ratio(1, 1))
            .violating("a convex potential"),
        Finding::equal("loss over t = 1, h = 1/32 over h = 1/64", fixed_time, 2.0, HALVED, "1").context(),
    ])
}

fn not_always(reading: Reading) -> Result<Vec<Finding>> {
    let spring = SpringDamper::of_ratio(reading.only(1).pick(ratio(0, 1), ratio(1, 10)));
    let start = Phase::of_one(ratio(1, 1), ratio(1, 3));
    let kept = |method: &OneStep| {
        let end = (0..20).fold(start.clone(), |now, _| method.step(&spring, &now, &ratio(1, 1)));
        energy(&spring, &end) / energy(&spring, &start)
    };
    let returned = (0..6).fold(start.clone(), |now, _| SEMI_IMPLICIT.step(&spring, &now, &ratio(1, 1)));
    let implicit = reading.only(0).pick(theta(1, 1), theta(1, 2));
    Ok(vec![
        Finding::exact("energy left by θ = 1 after 20 steps of s = 1", &kept(&implicit), &ratio(1, 1 << 20), "1"),
        Finding::exact("energy left by θ = 1/2", &kept(&theta(1, 2)), &ratio(1, 1), "1"),
        Finding::decision("semi-implicit Euler is back after six steps of s = 1", returned == start, true),
    ])
}

fn spectrum(reading: Reading) -> Result<Vec<Finding>> {
    let (spring, start) = undamped();
    let spring = SpringDamper { damping_per_mass: reading.only(1).pick(ratio(0, 1), ratio(2, 5)), ..spring };
    let h = ratio(3, 10) / ratio(2, 1);
    let middle = reading.only(0).pick(theta(1, 2), theta(2, 5));
    let [_, neutral] = invariants(&matrix(&middle, &spring, &h));
    let mut findings = vec![Finding::exact("determinant of the neutral member", &neutral, &ratio(1, 1), "1")];
    for (n, d) in [(0, 1), (1, 4), (1, 2), (3, 4), (1, 1)] {
        let method = theta(n, d);
        let (share, rest) = (ratio(n, d), ratio(d - n, d));
        let square = ratio(9, 100);
        let formula = (ratio(1, 1) + &rest * &rest * &square) / (ratio(1, 1) + &share * &share * &square);
        let grown = energy_ratio(&method, &(spring.clone(), start.clone()), &h);
        let [_, determinant] = invariants(&matrix(&method, &spring, &h));
        findings.push(Finding::exact(format!("E⁺/E, θ = {share}"), &grown, &formula, "1"));
        findings.push(Finding::exact(format!("determinant, θ = {share}"), &determinant, &formula, "1"));
    }
    Ok(findings)
}

/// A body that falls at 10 m/s².
struct Falling;

impl SmoothSystem for Falling {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, _velocity: &DVector<T>) -> DVector<T> {
        position.map(|_| T::ratio(-10, 1))
    }
}

fn no_theta(reading: Reading) -> Result<Vec<Finding>> {
    let subject = match reading {
        Reading::Recorded => OneStep::SemiImplicit,
        Reading::Control(0) => theta(1, 2),
        Reading::Control(_) => OneStep::Explicit,
    };
    let s = ratio(1, 1);
    let spring = SpringDamper::of_ratio(ratio(0, 1));
    let half = matrix(&theta(1, 2), &spring, &s);
    let ([trace, determinant], [other, neutral]) = (invariants(&matrix(&subject, &spring, &s)), invariants(&half));
    let determinants = [(0, 1), (1, 4), (1, 2), (3, 4), (1, 1)].map(|(n, d)| invariants(&matrix(&theta(n, d), &spring, &s))[1].clone());
    let (start, h) = (Phase::of_one(ratio(5, 1), ratio(1, 1)), ratio(1, 10));
    let same = subject.step(&Falling, &start, &h) == theta(1, 1).step(&Falling, &start, &h);
    // a point of the spectrum with this determinant is θ = ½, as (1 + (1−θ)²s²)/(1 + θ²s²) falls with θ: the sentence gives it that trace
    Ok(vec![
        Finding::exact("determinant less that of θ = 1/2", &(determinant - neutral), &ratio(0, 1), "1"),
        Finding::exact("trace less that of θ = 1/2, s = 1", &(&trace - &other), &ratio(-1, 5), "1")
            .says(ratio(0, 1))
            .violating("a constant force"),
        Finding::exact("trace of semi-implicit Euler at s = 1", &trace, &ratio(1, 1), "1").context(),
        Finding::decision("under a constant force it takes the step of θ = 1", same, true),
        Finding::exact("trace of θ = 1/2 at s = 1", &other, &ratio(6, 5), "1").context(),
        Finding::decision("the determinant falls with θ", determinants.windows(2).all(|pair| pair[0] > pair[1]), true).context(),
    ])
}

fn under_gravity(reading: Reading) -> Result<Vec<Finding>> {
    let (implicit, trapezoidal) = reading.only(1).pick((theta(1, 1), theta(1, 2)), (theta(0, 1), theta(0, 1)));
    let left = |method: &OneStep| energy_ratio(method, &undamped(), &(ratio(3, 10) / ratio(2, 1)));
    let place = reading.only(0).pick(hill(), undamped());
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(10, 1), restitution: ratio(1, 1) };
    let (flying, h) = (BallState { position: ratio(1, 1), velocity: ratio(1, 2) }, ratio(1, 100));
    let Phase { position, velocity } = implicit.step(&Falling, &Phase::of_one(flying.position.clone(), flying.velocity.clone()), &h);
    let lost = ball.energy(&flying) - ball.energy(&BallState { position: position[0].clone(), velocity: velocity[0].clone() });
    Ok(vec![
        Finding::exact("E⁺/E of a spring, θ = 1, hω = 3/10", &left(&implicit), &ratio(100, 109), "1"),
        Finding::exact("E⁺/E of a spring, θ = 1/2, hω = 3/10", &left(&trapezoidal), &ratio(1, 1), "1"),
        Finding::exact("energy lost in a step of free flight, θ = 1", &lost, &ratio(1, 200), "J"),
        Finding::exact("E⁺/E of θ = 1 on a hill, q̈ = q, h = 1/2", &energy_ratio(&theta(1, 1), &place, &ratio(1, 2)), &ratio(4, 3), "1")
            .says_at_most(ratio(1, 1))
            .violating("a convex potential"),
        Finding::exact("(E − ½ m g h v)/E₀ of an elastic ball, θ = 1", &elastic_invariant(Floor::Hard), &ratio(1, 1), "1").context(),
    ])
}
