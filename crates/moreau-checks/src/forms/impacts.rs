//! Closed forms of impacts against the laws they solve, in rationals.

use super::parts::{whole, wrong};
use crate::finding::Finding;
use crate::planted::Family;
use moreau_contact::problem::PlanarProblem;
use moreau_dynamics::impact_laws::newton;
use moreau_dynamics::impact_laws::routh::Path;
use moreau_exact::Result;
use moreau_exact::scalar::{Rational, ratio};
use moreau_forms::newtons_cradle;
use moreau_forms::rough_impact::RoughImpact;
use moreau_forms::two_body_impact::TwoBodyImpact;
use nalgebra::{DMatrix, DVector};

/// v₁⁺ and v₂⁺ of two bodies on a line.
pub type TwoBodies = fn(&TwoBodyImpact<Rational>) -> [Rational; 2];

/// Two bodies: momentum is kept and the relative velocity becomes −e times itself.
pub static TWO_BODIES: Family<TwoBodies> = Family {
    reference: TwoBodyImpact::velocities_post,
    checks: &[("forms/two-body-impact", two_bodies)],
    planted: &[
        wrong("forms/impulse-over-the-other-mass", "divides the impulse by the mass of the other body", |impact| {
            let other = TwoBodyImpact { masses: [impact.masses[1].clone(), impact.masses[0].clone()], ..impact.clone() };
            other.velocities_post()
        }),
        wrong("forms/impulse-on-both-alike", "lets both bodies take the impulse in the same sense", |impact| {
            let p = impact.impulse();
            [0, 1].map(|k| &impact.velocities[k] + &p / &impact.masses[k])
        }),
        wrong("forms/restitution-of-the-sum", "asks for e times the sum of the velocities in place of their difference", |impact| {
            let [m1, m2] = &impact.masses;
            let [v1, v2] = &impact.velocities;
            let centre = (m1 * v1 + m2 * v2) / (m1 + m2);
            let apart = &impact.restitution * (v1 + v2);
            [&centre - m2 * &apart / (m1 + m2), centre + m1 * apart / (m1 + m2)]
        }),
        wrong("forms/plastic-part-forgotten", "gives e m̄ c for the impulse, without the part that stops the approach", |impact| {
            let p = &impact.restitution * impact.reduced_mass() * impact.closing_speed();
            [&impact.velocities[0] - &p / &impact.masses[0], &impact.velocities[1] + p / &impact.masses[1]]
        }),
    ],
};

fn two_bodies(subject: &TwoBodies) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (m2, e, v2) in [(1, 1, 0), (3, 2, -5), (1000, 4, 1), (3, 0, -2)] {
        let impact = TwoBodyImpact { masses: [ratio(2, 7), whole(m2)], velocities: [ratio(3, 2), whole(v2)], restitution: ratio(e, 4) };
        let after = subject(&impact);
        let momentum = |v: &[Rational; 2]| &impact.masses[0] * &v[0] + &impact.masses[1] * &v[1];
        let [before, now] = [&impact.velocities, &after].map(|v| &v[1] - &v[0]);
        findings.push(Finding::exact("momentum", &momentum(&after), &momentum(&impact.velocities), "kg m/s"));
        findings.push(Finding::exact("relative velocity", &now, &-(&impact.restitution * before), "m/s"));
    }
    Ok(findings)
}

/// Velocities of three equal balls for a coefficient e.
pub type Cradle = fn(&Rational) -> [Rational; 3];

/// Three balls that collide at once: momentum is kept, and each of the two contacts has Newton's law.
pub static CRADLE: Family<Cradle> = Family {
    reference: newtons_cradle::at_once::<Rational>,
    checks: &[("forms/newtons-cradle", cradle)],
    planted: &[
        wrong("forms/cradle-two-by-two", "takes the collision of three balls for two collisions of two", newtons_cradle::after_two_impacts),
        wrong("forms/cradle-last-ball-alone", "lets the last ball leave alone, as in the film, whatever e is", |e| {
            let half = (whole(1) + e) * ratio(1, 2);
            [whole(1) - &half, whole(0), half]
        }),
    ],
};

fn cradle(subject: &Cradle) -> Result<Vec<Finding>> {
    let of = |e: Rational| {
        let [a, b, c] = subject(&e);
        vec![
            Finding::exact("momentum", &(&a + &b + &c), &whole(1), "kg m/s"),
            Finding::exact("first contact", &(&b - &a), &e, "m/s"),
            Finding::exact("second contact", &(c - b), &whole(0), "m/s"),
        ]
    };
    Ok([ratio(0, 1), ratio(1, 3), ratio(1, 1)].into_iter().flat_map(of).collect())
}

/// Normal and tangential impulse of a rough impact under Newton's law with a coefficient e.
pub type Rough = fn(&RoughImpact<Rational>, &Rational) -> [Rational; 2];

/// Rough impacts: the end of Routh's path, followed piece by piece.
pub static ROUGH: Family<Rough> = Family {
    reference: RoughImpact::newton,
    checks: &[("forms/rough-impact", rough)],
    planted: &[
        wrong("forms/rough-friction-along-the-slip", "lets friction act along the slip", |impact, e| {
            let [p, q] = impact.newton(e);
            [p, -q]
        }),
        wrong("forms/rough-never-stops", "goes on sliding where the slip has stopped", |impact, e| {
            let sense = if impact.slide < whole(0) { whole(-1) } else { whole(1) };
            let sliding = &impact.delassus[0] - &impact.friction * &sense * &impact.delassus[1];
            let p = (whole(1) + e) * &impact.approach / sliding;
            let q = -(&impact.friction * sense * &p);
            [p, q]
        }),
        wrong("forms/rough-coupling-forgotten", "leaves W_nt out", |impact, e| {
            let [nn, _, tt] = impact.delassus.clone();
            RoughImpact { delassus: [nn, whole(0), tt], ..impact.clone() }.newton(e)
        }),
        wrong("forms/rough-sticks-always", "lets every slip that stops stick, inside its cone or not", |impact, e| {
            let [nn, nt, tt] = impact.delassus.clone();
            match impact.stop() {
                Some(stop) if impact.impulse_reaching(&(e * &impact.approach)) > stop => {
                    let slope = (&nn * &tt - &nt * &nt) / &tt;
                    let p = ((whole(1) + e) * &impact.approach + &nt * &impact.slide / &tt) / slope;
                    let q = -(&impact.slide + nt * &p) / tt;
                    [p, q]
                }
                _ => impact.newton(e),
            }
        }),
    ],
};

fn rough(subject: &Rough) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for [nn, nt, tt] in [[2, 0, 3], [5, -3, 5], [5, 3, 5], [2, 4, 9], [9, -4, 2]] {
        for (slide, mu) in [(1, 1), (-1, 2), (3, 7), (20, 1)] {
            let impact = RoughImpact {
                delassus: [nn, nt, tt].map(|x| ratio(x, 2)),
                approach: whole(1),
                slide: whole(slide),
                friction: ratio(mu, 4),
            };
            let [w_nn, w_nt, w_tt] = impact.delassus.clone();
            let matrix = DMatrix::from_row_slice(2, 2, &[w_nn, w_nt.clone(), w_nt, w_tt]);
            let before = DVector::from_vec(vec![-impact.approach.clone(), impact.slide.clone()]);
            let path = Path::new(PlanarProblem::new(matrix, before), &impact.friction)?;
            let end = newton::along(&path, &ratio(1, 3))?;
            let [p, q] = subject(&impact, &ratio(1, 3));
            findings.push(Finding::exact("normal impulse", &p, &end.impulse[0], "N·s"));
            findings.push(Finding::exact("tangential impulse", &q, &end.impulse[1], "N·s"));
        }
    }
    Ok(findings)
}
