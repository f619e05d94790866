//! The base measure, and what is known about existence and uniqueness of sweeping processes.

use super::half_space::whole;
use crate::Result;
use crate::checks::Finding;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::closed_forms::bouncing_ball::{accumulation_time_ratio, impact_time_ratio};
use crate::problem::PlanarProblem;
use crate::scalar::{Rational, ratio};
use crate::solvers::enumeration::all_solutions;
use nalgebra::{DMatrix, DVector};
use std::cmp::Ordering;

/// Claims on measures and uniqueness.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S2.base-measure",
        statement: "The base measure is dμ = dt + Σᵢ δ_{tᵢ}, the Lebesgue measure and an atom at each impact; v is of bounded variation \
            and dv splits into v̇ dt and jumps.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "True for finitely many impacts in bounded time and without a Cantor part of dv. Past a Zeno point the atoms \
            need summable weights, for instance the jumps: dμ = dt + |dv|.",
        argument: "The bouncing ball with e = 1/2 makes infinitely many impacts before T∞: unit atoms have mass n after n of them, so \
            Σδ_{tᵢ} is not finite on any neighbourhood of T∞. The jumps (1+e)eᵏv₀ sum to (1+e)/(1−e) v₀ = 3 v₀. \
            Functions of bounded variation may also grow on a null set without jumping: the Cantor function rises by 1 on intervals of \
            total length (2/3)²⁰ < 1/3000 in steps of at most 2⁻²⁰. \
            As the values of the inclusion are cones, any other dμ that dominates dt and dv serves as well.",
        control: "Unit atoms at every impact of the ball.",
        sources: &["chapter §2, step 4, term by term", "Ambrosio, Fusco and Pallara, Functions of Bounded Variation (2000), §3.2"],
        check: base_measure,
    },
    Claim {
        id: "S2.sweep-theory",
        statement: "Sweeping processes are rigorous, with a complete theory of existence and uniqueness (Moreau 1977 for convex C(t), \
            later prox-regular sets), in first order or their second-order dynamic version.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Existence and uniqueness hold for the first-order process with convex or prox-regular C(t). For the \
            second-order process of this chapter uniqueness fails in general.",
        argument: "First order, convex: the catching-up steps q ↦ P_{C(t)}(q) are non-expansive, so two motions never separate – checked \
            exactly on a moving interval. Not prox-regular: C(t) = {|q| ≥ t} sweeps q(0) = 0 to t and to −t, both with −q̇ ∈ N. \
            Second order with friction: W = (1 2; 2 5), μ = 1, free motion (1, 10) admits r = (0,0), (1,−1) and (15,−8): separation, \
            sliding contact, impact (Painlevé).",
        control: "The second-order problem with friction as if its solution were unique.",
        sources: &[
            "chapter §2, pitfall on the sweeping process",
            "Moreau, Evolution problem associated with a moving convex set in a Hilbert space (1977)",
            "Painlevé (1895)",
        ],
        check: sweeping_theory,
    },
];

fn base_measure(reading: Reading) -> Result<Vec<Finding>> {
    let e = ratio(1, 2);
    let jump = |k: usize| (whole(1) + e.clone()) * power(&e, k);
    let mass = |count: usize| (0..count).map(|k| reading.pick(jump(k), whole(1))).fold(whole(0), |sum, weight| sum + weight);
    let total = (whole(1) + e.clone()) / (whole(1) - e.clone());
    let mut findings = Vec::new();
    for count in [64, 16, 8] {
        let before = impact_time_ratio(&e, count) < accumulation_time_ratio(&e);
        findings.push(Finding::at_most(
            format!("mass of the first {count} atoms"),
            mass(count).to_f64().value(),
            total.to_f64().value(),
            "m/s",
        ));
        findings.push(Finding::decision(format!("impact {count} comes before T∞"), before, true));
    }
    let remaining = total - (0..64).map(jump).fold(whole(0), |sum, weight| sum + weight);
    findings.push(Finding::exact("jumps after the 64th", &remaining, &(whole(3) * power(&e, 64)), "m/s"));
    let (length, rise) = cantor(20);
    findings.push(Finding::decision("the Cantor function rises by 1 on a length below 1/3000", length < ratio(1, 3000), true));
    findings.push(Finding::exact("its rise on each interval", &rise, &ratio(1, 1 << 20), "1"));
    Ok(findings)
}

fn power(base: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(whole(1), |product, _| product * base.clone())
}

/// Total length (2/3)ⁿ of the intervals of generation n of the Cantor set, and the rise 2⁻ⁿ of the Cantor function on each.
fn cantor(generation: usize) -> (Rational, Rational) {
    (power(&ratio(2, 3), generation), power(&ratio(1, 2), generation))
}

/// Where catching up with the moving interval C(t) = [t, 2 + t/2] takes a start, at the times k/8 up to 3.
fn catch_up(start: Rational) -> Vec<Rational> {
    let mut place = start;
    let positions = (0..=24).map(|k| {
        place = place.clone().max(ratio(k, 8)).min(whole(2) + ratio(k, 16));
        place.clone()
    });
    positions.collect()
}

/// Whether q(t) = c t solves `−q̇ ∈ N_{C(t)}(q)`, q(0) = 0, for C(t) = {|q| ≥ t}.
fn swept_out(c: &Rational) -> bool {
    let rate = -c.clone();
    match c.clone().max(-c.clone()).cmp(&whole(1)) {
        Ordering::Less => false,                         // q is not in C(t)
        Ordering::Equal => rate * c.clone() <= whole(0), // N = {g : g q ≤ 0} on the boundary
        Ordering::Greater => rate == whole(0),           // N = {0} inside
    }
}

/// The distinct impulses that solve one planar contact with μ = 1 and free velocity (1, 10).
fn planar_contact(coupling: i64) -> Result<Vec<DVector<Rational>>> {
    let delassus = DMatrix::from_row_slice(2, 2, &[whole(1), whole(coupling), whole(coupling), whole(5)]);
    let free = DVector::from_vec(vec![whole(1), whole(10)]);
    let problem = PlanarProblem::new(delassus, free).coulomb(&[whole(1)])?;
    let set = all_solutions(&problem.lcp)?;
    // families move σ only: the slip rate of an open contact is not determined, its impulse is
    let mut impulses: Vec<DVector<Rational>> = Vec::new();
    for z in &set.points {
        let impulse = problem.impulse(z);
        if !impulses.contains(&impulse) {
            impulses.push(impulse);
        }
    }
    Ok(impulses)
}

fn sweeping_theory(reading: Reading) -> Result<Vec<Finding>> {
    let (left, right) = (catch_up(whole(0)), catch_up(ratio(3, 2)));
    let gaps: Vec<Rational> = left.iter().zip(&right).map(|(a, b)| b.clone() - a.clone()).collect();
    let separating = gaps.windows(2).filter(|pair| pair[1] > pair[0]).count();
    Ok(vec![
        Finding::count("solutions of a second-order step that jams", planar_contact(2)?.len(), 3),
        Finding::count("solutions of a second-order step with W diagonal", planar_contact(reading.pick(0, 2))?.len(), 1),
        Finding::count("steps in which two swept points separate", separating, 0),
        Finding::exact("their distance in the end", &gaps[24], &whole(0), "m"),
        Finding::count("solutions q = c t of the process with C(t) = {|q| ≥ t}", (-4..=4).filter(|c| swept_out(&ratio(*c, 2))).count(), 2),
    ])
}
