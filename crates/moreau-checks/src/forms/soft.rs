//! Closed forms of soft contact against what they are to mean: an oscillator, a least cost, an implicit step.

use super::parts::{whole, wrong};
use crate::finding::Finding;
use crate::planted::Family;
use moreau_exact::Result;
use moreau_exact::scalar::{Rational, Scalar, ratio};
use moreau_exact::tolerance::rounding;
use moreau_forms::drake_normal::HuntCrossley;
use moreau_forms::huber::Huber;
use moreau_forms::soft_impedance::SoftImpedance;
use moreau_forms::soft_reference::SoftReference;

/// d(δ) of an impedance.
pub type Impedance = fn(&SoftImpedance<Rational>, &Rational) -> Rational;

/// MuJoCo's impedance: its values at the surface, beyond the width and half-way, its symmetry, and its limits.
pub static IMPEDANCE: Family<Impedance> = Family {
    reference: SoftImpedance::at,
    checks: &[("forms/soft-impedance", impedance)],
    planted: &[
        wrong(
            "forms/impedance-not-limited",
            "leaves d₀ = 0 and d_w = 1 as they are, where an impedance stays within 10⁻⁴ of them",
            |curve, depth| curve.start.clone() + share(curve, depth) * (&curve.end - &curve.start),
        ),
        wrong("forms/impedance-goes-on", "lets the curve go on beyond its width", |curve, depth| {
            if curve.width <= whole(0) || *depth <= curve.width {
                return curve.at(depth);
            }
            curve.at_width() + (depth - &curve.width) / &curve.width * (curve.at_width() - curve.at(&whole(0)))
        }),
        wrong("forms/impedance-one-branch", "uses the first half of the curve for both", |curve, depth| {
            if curve.width <= whole(0) || *depth >= curve.width || *depth <= &curve.midpoint * &curve.width {
                return curve.at(depth);
            }
            let x = depth / &curve.width;
            let y = power(&x, curve.power) / power(&curve.midpoint, curve.power - 1);
            curve.at(&whole(0)) + y * (curve.at_width() - curve.at(&whole(0)))
        }),
        wrong("forms/impedance-not-normalised", "takes xᵖ without dividing by mᵖ⁻¹", |curve, depth| {
            if curve.width <= whole(0) || *depth >= &curve.midpoint * &curve.width || *depth <= whole(0) {
                return curve.at(depth);
            }
            let x = depth / &curve.width;
            curve.at(&whole(0)) + power(&x, curve.power) * (curve.at_width() - curve.at(&whole(0)))
        }),
        wrong("forms/impedance-without-width", "jumps to d_w at once where the width is zero", |curve, depth| {
            if curve.width <= whole(0) { curve.at_width() } else { curve.at(depth) }
        }),
        wrong("forms/impedance-reversed", "goes from d_w at the surface to d₀ in the depth", |curve, depth| {
            SoftImpedance { start: curve.end.clone(), end: curve.start.clone(), ..curve.clone() }.at(depth)
        }),
    ],
};

fn power(base: &Rational, n: u32) -> Rational {
    (0..n).fold(whole(1), |product, _| product * base)
}

/// y of a curve, from the curve between 1/4 and 3/4, which no limit touches.
fn share(curve: &SoftImpedance<Rational>, depth: &Rational) -> Rational {
    let plain = SoftImpedance { start: ratio(1, 4), end: ratio(3, 4), ..curve.clone() };
    (plain.at(depth) - ratio(1, 4)) * whole(2)
}

fn impedance(subject: &Impedance) -> Result<Vec<Finding>> {
    let curve = |start: (i64, i64), end: (i64, i64)| SoftImpedance {
        start: ratio(start.0, start.1),
        end: ratio(end.0, end.1),
        width: ratio(1, 100),
        midpoint: ratio(1, 2),
        power: 3,
    };
    let (rubber, extreme) = (curve((1, 5), (4, 5)), curve((0, 1), (1, 1)));
    let millimetres = |k: i64| ratio(k, 1000);
    let exact = |name: &str, found: Rational, expected: Rational| Finding::exact(name, &found, &expected, "1");
    let mut findings = vec![
        exact("at the surface", subject(&rubber, &whole(0)), ratio(1, 5)),
        exact("at the width", subject(&rubber, &millimetres(10)), ratio(4, 5)),
        exact("beyond the width", subject(&rubber, &millimetres(25)), ratio(4, 5)),
        exact("above the surface", subject(&rubber, &millimetres(-5)), ratio(1, 5)),
        exact("at the midpoint", subject(&rubber, &millimetres(5)), ratio(1, 2)),
        // y = x³/m² = (1/4)³ · 4
        exact("at a quarter", subject(&rubber, &ratio(1, 400)), ratio(1, 5) + ratio(1, 16) * ratio(3, 5)),
        exact("least impedance", subject(&extreme, &whole(0)), ratio(1, 10_000)),
        exact("largest impedance", subject(&extreme, &millimetres(10)), ratio(9_999, 10_000)),
        exact("without a width", subject(&SoftImpedance { width: whole(0), ..rubber.clone() }, &millimetres(1)), ratio(1, 2)),
    ];
    // m = ½: the curve is symmetric about its midpoint
    for k in 1..5 {
        let sum = subject(&rubber, &millimetres(k)) + subject(&rubber, &millimetres(10 - k));
        findings.push(exact("d(δ) + d(w − δ)", sum, whole(1)));
    }
    Ok(findings)
}

/// (k, b) for (t_c, ζ, h) and a constant impedance d, with the limit t_c ≥ 2h.
pub type Reference = fn(&[Rational; 4]) -> [Rational; 2];

/// MuJoCo's reference: an unloaded row moves with d times it, an oscillator of frequency 1/(t_c ζ) and damping ratio ζ.
pub static REFERENCE: Family<Reference> = Family {
    reference: coefficients,
    checks: &[("forms/soft-reference", reference)],
    planted: &[
        wrong("forms/reference-impedance-once", "divides the stiffness by d_w once, where the force and the row take it twice", |given| {
            let [k, b] = coefficients(given);
            [k * &given[3], b]
        }),
        wrong("forms/reference-damping-halved", "takes 1/t_c for the damping of an oscillator with the time constant t_c", |given| {
            let [k, b] = coefficients(given);
            [k, b * ratio(1, 2)]
        }),
        wrong(
            "forms/reference-ratio-in-the-damping",
            "multiplies the damping by ζ and leaves the stiffness without",
            |[time, zeta, h, d]| {
                let [k, b] = coefficients(&[time.clone(), whole(1), h.clone(), d.clone()]);
                [k, b * zeta]
            },
        ),
        wrong("forms/reference-not-limited", "lets a time constant be shorter than two steps", |[time, zeta, _, d]| {
            coefficients(&[time.clone(), zeta.clone(), whole(0), d.clone()])
        }),
    ],
};

/// d k = coefficient of −φ in a_ref over d.
fn coefficients([time, zeta, h, d]: &[Rational; 4]) -> [Rational; 2] {
    let made = SoftReference::limited(time, zeta, h, SoftImpedance::constant(d.clone()));
    [made.stiffness, made.damping]
}

fn reference(subject: &Reference) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (time, h) in [(ratio(1, 50), ratio(1, 500)), (ratio(1, 50), ratio(1, 40))] {
        let (zeta, d) = (ratio(4, 5), ratio(9, 10));
        let [k, b] = subject(&[time.clone(), zeta.clone(), h.clone(), d.clone()]);
        let used = if time < whole(2) * &h { whole(2) * h } else { time };
        let frequency = whole(1) / (&used * &zeta);
        // φ̈ = d a_ref = −d² k φ − d b φ̇ = −ω₀² φ − 2 ζ ω₀ φ̇
        findings.push(Finding::exact("d² k", &(&d * &d * k), &(&frequency * &frequency), "1/s²"));
        findings.push(Finding::exact("d b", &(d * b), &(whole(2) * zeta * frequency), "1/s"));
    }
    Ok(findings)
}

/// The force of a row with friction loss.
pub type RowForce = fn(&Huber<Rational>, &Rational) -> Rational;

/// A row with friction loss: of all forces |f| ≤ η its force has the least ½R f² + y f.
pub static HUBER: Family<RowForce> = Family {
    reference: Huber::force,
    checks: &[("forms/huber", huber)],
    planted: &[
        wrong("forms/huber-without-bound", "does not cut the force off at its bound", |row, y| -(y / &row.regularisation)),
        wrong("forms/huber-along-the-slip", "lets the force act along the motion", |row, y| -row.force(y)),
        wrong("forms/huber-bound-on-the-velocity", "cuts off where |y| > η in place of |y| > Rη", |row, y| {
            if y.magnitude() > row.bound { row.force(&(y * whole(1000))) } else { -(y / &row.regularisation) }
        }),
    ],
};

fn huber(subject: &RowForce) -> Result<Vec<Finding>> {
    let row = Huber { bound: ratio(3, 2), regularisation: ratio(1, 4) };
    let mut findings = Vec::new();
    for y in [-8, -1, 0, 1, 5].map(|y| ratio(y, 4)) {
        let force = subject(&row, &y);
        let cost = |f: &Rational| ratio(1, 2) * &row.regularisation * f * f + &y * f;
        let others = (-24..=24).map(|k| ratio(k, 16));
        let better = others.filter(|other| cost(other) < cost(&force)).count();
        findings.push(Finding::decision("within the bound", force.magnitude() <= row.bound, true));
        findings.push(Finding::count("forces that cost less", better, 0));
    }
    Ok(findings)
}

/// The normal impulse on a mass, at a depth, with a velocity without contact.
pub type NormalImpulse = fn(&HuntCrossley, [f64; 3]) -> f64;

/// Hunt and Crossley's step is implicit: r = h k (δ − h u)₊ (1 − d u)₊ with u = v + r/m̄, after the impulse.
pub static HUNT_CROSSLEY: Family<NormalImpulse> = Family {
    reference: |law, [mass, depth, velocity]| law.normal_impulse(mass, depth, velocity),
    checks: &[("forms/hunt-crossley", hunt_crossley)],
    planted: &[
        wrong("forms/hunt-crossley-explicit", "takes the velocity before the impulse", |law, [_, depth, velocity]| {
            law.time_step * law.stiffness * (depth - law.time_step * velocity).max(0.0) * (1.0 - law.dissipation * velocity).max(0.0)
        }),
        wrong("forms/hunt-crossley-dissipation-reversed", "lets dissipation help what approaches", |law, [mass, depth, velocity]| {
            HuntCrossley { dissipation: -law.dissipation, ..*law }.normal_impulse(mass, depth, velocity)
        }),
        wrong("forms/hunt-crossley-force", "gives the force where the impulse is asked for", |law, [mass, depth, velocity]| {
            law.normal_impulse(mass, depth, velocity) / law.time_step
        }),
        wrong(
            "forms/hunt-crossley-not-cut-off",
            "cuts neither factor off at zero, so that two negative ones push",
            |law, [mass, depth, velocity]| {
                let (h, k, d) = (law.time_step, law.stiffness, law.dissipation);
                let newton = |r: f64, _| {
                    let u = velocity + r / mass;
                    let slope = -h * k * (h + d * depth - 2.0 * h * d * u) / mass - 1.0;
                    r - (h * k * (depth - h * u) * (1.0 - d * u) - r) / slope
                };
                (0..60).fold(0.0, newton)
            },
        ),
    ],
};

/// |∂r/∂u| ≤ L = h k (h (1 + d|u|) + d (δ + h|u|)): u is known to a rounding of its terms, and both sides move by L of it.
fn hunt_crossley(subject: &NormalImpulse) -> Result<Vec<Finding>> {
    let law = HuntCrossley { time_step: 0.01, stiffness: 1e4, dissipation: 0.5 };
    let mut findings = Vec::new();
    for case in [[2.0, 0.001, -0.5], [2.0, 0.003, 0.1], [0.5, 0.01, -3.0], [1.0, 0.001, 5.0]] {
        let [mass, depth, velocity] = case;
        let (h, k, d) = (law.time_step, law.stiffness, law.dissipation);
        let r = subject(&law, case);
        let after = velocity + r / mass;
        let expected = h * k * (depth - h * after).max(0.0) * (1.0 - d * after).max(0.0);
        let size = velocity.abs() + (r / mass).abs() + depth / h;
        let slope = h * k * (h * (1.0 + d * size) + d * (depth + h * size));
        let tolerance = rounding(8, (1.0 + slope / mass) * slope * size + r.abs());
        findings.push(Finding::equal("impulse", r, expected, tolerance, "N·s"));
    }
    Ok(findings)
}
