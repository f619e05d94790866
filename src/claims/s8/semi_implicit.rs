//! Semi-implicit Euler on the undamped spring: what the new velocity in the position update changes, and its bound hω ≤ 2.

use crate::claims::experiments::motion_step::{Polynomial, step};
use crate::claims::experiments::spring_damper::{
    OneStep, SEMI_IMPLICIT, energy, energy_ratio, is_stable, matrix, powers_at, theta, undamped,
};
use crate::claims::prelude::*;
use crate::closed_forms::spring_damper as closed;
use crate::integrators::stability::{Powers, invariants, powers};
use crate::integrators::{Method, Phase, SmoothSystem, SpringDamper};
use crate::scalar::exact;
use crate::tolerance::claims::integrators::{BISECTED, vibrated};
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.one-change",
        statement: "Semi-implicit Euler changes explicit Euler in one place: the position is updated with the new velocity.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: the velocities agree and the positions differ by $h^2\,a(q, v)$.",
        argument: r"One step of $h = 1/5$ of $\dot v = -q - q^3 - v/2$ from $(1/2, -3)$ in rationals.",
        controls: &["Semi-implicit Euler with implicit damping, which changes the velocity too."],
        sources: &["chapter §8, three levels and essential insight"],
        check: check!(one_change),
    },
    Claim {
        id: "S8.semi-G-iff",
        statement: r"On an undamped spring semi-implicit Euler has $|G| = 1$ if and only if $\omega\,h \le 2$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, of the moduli of the eigenvalues: the step matrix has trace $2 - s^2$ and
            determinant 1. At $s = 2$ the powers grow all the same (S8.semi-bound).",
        argument: r"Determinant 1 and $|2 - s^2| \le 2$ iff $s \le 2$. Decided in rationals at $s = 1/1000$, 1, $2 - 10^{-6}$, 2 and
            $2 + 10^{-6}$.",
        controls: &[
            r"The spring with $\zeta = 1/10$, on which every step shrinks the phase volume.",
            r"The trapezoidal rule, $\theta = 1/2$.",
        ],
        sources: &["chapter §8, example on stability bounds"],
        check: check!(modulus_one),
    },
    Claim {
        id: "S8.semi-bound",
        statement: r"The stability bound of semi-implicit Euler on an undamped spring is $h \le 2/\omega_0$.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Certified,
        correct_statement: r"$h < 2/\omega_0$, strictly: at $s = 2$ the step is $-(I + N)$ with $N^2 = 0$, and the motion grows by the
            same amount every step. Below, the amplitude is at most $q_0/\sqrt{1 - s^2/4}$ from rest.",
        argument: r"From $q_0$ at rest with $s = 2$: $q_n = (-1)^n\,(1 + 2n)\,q_0$ exactly, 0.001 m becomes 0.401 m after 200 steps. With
            $s = 199/100$ the amplitude stays below that bound, at 0.01001 m; with $s = 201/100$ it grows as
            $\sinh((n + \tfrac12)\theta)/\sinh(\theta/2)$, $2 \cosh \theta = s^2 - 2$. That both moduli are 1 at $s = 2$, as the
            chapter says, is right; the double eigenvalue lacks its second eigenvector.",
        controls: &[r"$s = 199/100$ in place of 2.", "Explicit Euler in place of semi-implicit Euler."],
        sources: &["chapter §8, example on stability bounds"],
        check: check!(at_the_bound),
    },
    Claim {
        id: "S8.semi-diverges-beyond",
        statement: "Beyond the bound semi-implicit Euler diverges too.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, exponentially: one eigenvalue is below −1.",
        argument: r"$|2 - s^2| > 2$: decided in rationals at $s = 2 + 10^{-9}$, 5/2 and 100.",
        controls: &[r"$s = 2$ in place of a little more: there the growth is linear.", r"The trapezoidal rule, $\theta = 1/2$."],
        sources: &["chapter §8, example on stability bounds"],
        check: check!(beyond),
    },
    Claim {
        id: "S8.one-over-pi",
        statement: r"What it means: the step may not exceed the order of $1/\pi$ of the contact's period; the harder the contact, the
            smaller the steps allowed.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated of the order. Without damping it is $1/\pi$ exactly, $2/\omega = T/\pi$; with damping the share is
            smaller, 0.132 at $\zeta = 1$ (S8.damped-bound).",
        argument: r"Largest stable step found by bisection in rationals for $k = 10^6$ N/m, $m = 1$ kg, over the period $2\pi/1000$ s:
            $1/\pi$, and with critical damping less than half a power of ten below.",
        controls: &["Critical damping in place of none.", r"$\zeta = 10$ in place of critical damping."],
        sources: &["chapter §8, example on stability bounds"],
        check: check!(share_of_the_period),
    },
    Claim {
        id: "S8.k1e6",
        statement: r"$k = 10^6$ N/m, $m = 1$ kg: $\omega_0 = 1000$ rad/s and $h \le 2\cdot10^{-3}$ s; $k = 10^8$: $h \le 2\cdot10^{-4}$ s.
            A hundred times the stiffness needs a tenth of the step.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Certified,
        correct_statement: r"$h < 2\cdot10^{-3}$ s and $h < 2\cdot10^{-4}$ s, strictly (S8.semi-bound), without damping; a hundred times
            the stiffness needs a tenth of the step.",
        argument: r"The stable steps found by bisection in rationals end at $2\cdot10^{-3}$ s and $2\cdot10^{-4}$ s, to $10^{-9}$ of them.
            At these steps themselves the powers of the step grow.",
        controls: &[
            r"Steps of $1.99\cdot10^{-3}$ s and $1.99\cdot10^{-4}$ s in place of the bounds themselves.",
            r"Critically damped springs, $c = 2\sqrt{km}$.",
        ],
        sources: &["chapter §8, numerical example", "S8.semi-bound"],
        check: check!(steel),
    },
    Claim {
        id: "S8.misc-order",
        statement: "On a simple spring the amplitude grows exponentially under explicit Euler and is stable over long times under \
            semi-implicit Euler: merely exchanging the order of the updates makes the difference.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"On the undamped oscillator, for $h\omega < 2$. Bounded is not conserved: the largest over the smallest energy
            is up to $(1 + s/2)/(1 - s/2)$, that is 21/19 at $s = 1/10$, 7 at 3/2 and 399 at 199/100; from $s = 2$ on both orders grow.
            With strong damping explicit Euler bears the larger step (S8.semi-much-better).",
        argument: r"From $q = v/\omega$, where the energy is largest for its value of the invariant $v^2 + \omega^2q^2 - h\omega^2qv$: at
            $s = 3/2$ the largest energy in 200 steps is less than 7 times the smallest, and the first step leaves 5/32. Explicit Euler
            multiplies the energy by $1 + s^2$ every step. At $s = 2$ the powers of the semi-implicit step grow.",
        controls: &[r"$s = 199/100$ in place of 2.", "The two methods exchanged."],
        sources: &["chapter §8, pitfall: semi-implicit and explicit Euler are nearly the same"],
        check: check!(order_of_updates),
    },
];

/// v̇ = −q − q³ − v/2.
struct Hardening;

impl SmoothSystem for Hardening {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, velocity: &DVector<T>) -> DVector<T> {
        position.map(|q| -(q.clone() + q.clone() * q.clone() * q)) - velocity * T::ratio(1, 2)
    }
}

impl Polynomial for Hardening {
    fn terms(&self) -> Vec<[Rational; 3]> {
        let term = |coefficient: Rational, of_place: i64, of_speed: i64| [coefficient, ratio(of_place, 1), ratio(of_speed, 1)];
        vec![term(ratio(-1, 1), 1, 0), term(ratio(-1, 1), 3, 0), term(ratio(-1, 2), 0, 1)]
    }
}

fn one_change(reading: Reading) -> Result<Vec<Finding>> {
    let (now, h) = (Phase::of_one(ratio(1, 2), ratio(-3, 1)), ratio(1, 5));
    let explicit = step(&OneStep::Explicit, &Hardening, &now, &h);
    let semi = step(&reading.pick(OneStep::SemiImplicit, OneStep::ImplicitDamping), &Hardening, &now, &h);
    let apart = Hardening.acceleration(&now.position, &now.velocity)[0].clone() * &h * &h;
    Ok(vec![
        Finding::exact("difference of the velocities", &(&semi.velocity[0] - &explicit.velocity[0]), &ratio(0, 1), "m/s"),
        Finding::exact("difference of the positions", &(&semi.position[0] - &explicit.position[0]), &apart, "m"),
    ])
}

fn modulus_one(reading: Reading) -> Result<Vec<Finding>> {
    let zeta = reading.only(0).pick(ratio(0, 1), ratio(1, 10));
    let method = reading.only(1).pick(OneStep::SemiImplicit, theta(1, 2));
    let million = 1_000_000;
    let cases = [
        (ratio(1, 1000), true),
        (ratio(1, 1), true),
        (ratio(2 * million - 1, million), true),
        (ratio(2, 1), true),
        (ratio(2 * million + 1, million), false),
    ];
    // both eigenvalues have modulus 1 iff none is larger and their product is 1
    let finding = |(s, kept): &(Rational, bool)| {
        let step = matrix(&method, &SpringDamper::of_ratio(zeta.clone()), s);
        let [_, product] = invariants(&step);
        let found = powers(&step) != Powers::GrowExponentially && product == ratio(1, 1);
        Finding::decision(format!("both eigenvalues have modulus 1 at s = {s}"), found, *kept)
    };
    Ok(cases.iter().map(finding).collect())
}

/// Positions q₀ = 1 mm, q₁, … of 200 steps with h = 1 and ω = s, from rest.
fn positions(method: &OneStep, s: f64) -> Vec<f64> {
    let rate = exact(s);
    let spring = SpringDamper { stiffness_per_mass: &rate * &rate, damping_per_mass: ratio(0, 1) };
    let mut now = Phase::of_one(0.001, 0.0);
    let mut places = vec![0.001];
    for _ in 0..STEPS {
        now = method.step(&spring, &now, &1.0);
        places.push(now.position[0]);
    }
    places
}

/// How many steps the motions at and beside the bound are followed.
const STEPS: usize = 200;

fn largest(places: &[f64]) -> f64 {
    places.iter().fold(0.0, |largest, place| largest.max(place.abs()))
}

/// ln |q_n/q₀| from rest for s > 2: q_n = (−1)ⁿ q₀ sinh((n + ½)θ)/sinh(θ/2) with 2 cosh θ = s² − 2.
fn growth(s: f64) -> f64 {
    let turn = (0.5 * s * s - 1.0).acosh();
    ((STEPS as f64 + 0.5) * turn).sinh().ln() - (0.5 * turn).sinh().ln()
}

fn at_the_bound(reading: Reading) -> Result<Vec<Finding>> {
    let method = reading.only(1).pick(OneStep::SemiImplicit, OneStep::Explicit);
    let zero = ratio(0, 1);
    let spring = SpringDamper::of_ratio(zero.clone());
    let start = Phase::of_one(ratio(1, 1000), zero.clone());
    let end = (0..STEPS).fold(start, |now, _| method.step(&spring, &now, &ratio(2, 1)));
    let stable = is_stable(&method, &zero, &reading.only(0).pick(ratio(2, 1), ratio(199, 100)));
    let amplitude = 0.001 / (1.0 - 0.25 * 1.99f64.powi(2)).sqrt();
    let bound = (1.0 + vibrated(STEPS)) * amplitude;
    let grown = (largest(&positions(&method, 2.01)) / 0.001).ln();
    Ok(vec![
        Finding::decision("stable at s = 2", stable, false).says(true),
        Finding::at_most("largest |q| in 200 steps at s = 1.99", largest(&positions(&method, 1.99)), bound, "m"),
        Finding::equal("ln |q/q₀| after 200 steps at s = 2.01", grown, growth(2.01), vibrated(STEPS), "1"),
        Finding::exact("q after 200 steps at s = 2", &end.position[0], &ratio(401, 1000), "m").context(),
    ])
}

fn beyond(reading: Reading) -> Result<Vec<Finding>> {
    let billion = 1_000_000_000;
    let just = reading.only(0).pick(ratio(2 * billion + 1, billion), ratio(2, 1));
    let method = reading.only(1).pick(OneStep::SemiImplicit, theta(1, 2));
    let finding = |(name, s): (&str, Rational)| {
        let diverges = powers_at(&method, &ratio(0, 1), &s) == Powers::GrowExponentially;
        Finding::decision(format!("powers grow exponentially at {name}"), diverges, true)
    };
    Ok([("s = 2 + 10⁻⁹", just), ("s = 5/2", ratio(5, 2)), ("s = 100", ratio(100, 1))].map(finding).to_vec())
}

/// The largest stable step of semi-implicit Euler, by 40 bisections of (0, 1/64) in rationals.
fn largest_stable_step(spring: &SpringDamper) -> f64 {
    let stable = |h: &Rational| {
        let step = matrix(&SEMI_IMPLICIT, spring, h);
        powers(&step) != Powers::GrowExponentially
    };
    let (mut low, mut high) = (ratio(0, 1), ratio(1, 64));
    for _ in 0..40 {
        let middle = (&low + &high) / ratio(2, 1);
        if stable(&middle) { low = middle } else { high = middle }
    }
    Scalar::to_f64(&low)
}

/// k/m in 1/s², c = 0.
fn hard(stiffness: i64) -> SpringDamper {
    SpringDamper { stiffness_per_mass: ratio(stiffness, 1), damping_per_mass: ratio(0, 1) }
}

fn share_of_the_period(reading: Reading) -> Result<Vec<Finding>> {
    let period = std::f64::consts::TAU / 1000.0;
    // c/m = 2 ζ ω
    let share = |zeta: i64| {
        let spring = SpringDamper { damping_per_mass: ratio(2000 * zeta, 1), ..hard(1_000_000) };
        largest_stable_step(&spring) / period
    };
    let (undamped, damped) = (share(reading.only(0).pick(0, 1)), share(reading.only(1).pick(1, 10)));
    let bound = BISECTED / period + rounding(4, 1.0);
    // of one order: by less than half a power of ten
    let order = std::f64::consts::FRAC_1_PI / 10f64.sqrt();
    Ok(vec![
        Finding::equal("largest stable step over the period", undamped, std::f64::consts::FRAC_1_PI, bound, "1"),
        Finding::at_least("the same with critical damping", damped, order, "1"),
    ])
}

fn steel(reading: Reading) -> Result<Vec<Finding>> {
    let share = reading.only(0).pick(ratio(1, 1), ratio(199, 200));
    let damping_ratio = reading.only(1).pick(0, 1);
    let mut findings = Vec::new();
    for (stiffness, frequency, bound) in [(1_000_000, 1000, ratio(2, 1000)), (100_000_000, 10_000, ratio(2, 10_000))] {
        let spring = SpringDamper { damping_per_mass: ratio(2 * damping_ratio * frequency, 1), ..hard(stiffness) };
        let printed = Scalar::to_f64(&bound);
        let width = BISECTED + rounding(4, printed);
        let bounded = powers(&matrix(&SEMI_IMPLICIT, &spring, &(&bound * &share))) == Powers::Bounded;
        findings.push(Finding::equal(
            format!("end of the stable steps, k = {stiffness} N/m"),
            largest_stable_step(&spring),
            printed,
            width,
            "s",
        ));
        findings.push(Finding::decision(format!("stable at the bound itself, k = {stiffness} N/m"), bounded, false).says(true));
    }
    Ok(findings)
}

fn order_of_updates(reading: Reading) -> Result<Vec<Finding>> {
    let (explicit, semi) = reading.only(1).pick((OneStep::Explicit, OneStep::SemiImplicit), (OneStep::SemiImplicit, OneStep::Explicit));
    let (spring, _) = undamped();
    let (h, s) = (ratio(3, 4), 1.5);
    let start = Phase::of_one(ratio(1, 1), ratio(2, 1));
    let first = energy_ratio(&semi, &(spring.clone(), start.clone()), &h);
    let growth = energy_ratio(&explicit, &(spring.clone(), start.clone()), &h);
    let mut now = start;
    let (mut lowest, mut highest) = (energy(&spring, &now), energy(&spring, &now));
    for _ in 0..200 {
        now = semi.step(&spring, &now, &h);
        let reached = energy(&spring, &now);
        (lowest, highest) = (lowest.min(reached.clone()), highest.max(reached));
    }
    let swing = Scalar::to_f64(&(highest / lowest));
    let limit = is_stable(&semi, &ratio(0, 1), &reading.only(0).pick(ratio(2, 1), ratio(199, 100)));
    let bound = (1.0 + rounding(4, 1.0)) * closed::semi_implicit_energy_swing(s);
    Ok(vec![
        Finding::at_most("largest over smallest energy in 200 semi-implicit steps", swing, bound, "1"),
        Finding::decision("semi-implicit Euler is stable at s = 2", limit, false).says(true).violating("hω < 2"),
        Finding::exact("E⁺/E of the first semi-implicit step", &first, &ratio(5, 32), "1").context(),
        Finding::equal("E⁺/E of explicit Euler", Scalar::to_f64(&growth), 1.0 + s * s, 0.0, "1"),
        Finding::decision("explicit Euler is stable at s = 1/1000", is_stable(&explicit, &ratio(0, 1), &ratio(1, 1000)), false),
    ])
}
