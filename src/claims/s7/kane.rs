//! Kane's paradox: where Newton's law creates energy.

use super::impacts::{ends, frictionless_grid, gain, middle, rod_path};
use crate::claims::prelude::*;
use crate::closed_forms::double_pendulum_impact::DoublePendulum;
use crate::impact_laws::routh::Path;
use crate::impact_laws::{moreau, newton, poisson, stronge};
use crate::problem::{PlanarProblem, Response};
use crate::tolerance::claims::pathology::FOUR_DIGITS;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.kane-multi",
        statement: "Kane's counterexample: in some collisions of several bodies, Newton's law applied independently at every contact \
            increases the total kinetic energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, of some configurations: if each impulse is computed as if its contact were alone, with unequal \
            coefficients, or with friction. Not without friction for one e and the coupled problem: ΔT = −½(1 − e²)U⁻ᵀW⁻¹U⁻ ≤ 0, and e = \
            1 conserves exactly.",
        argument: "W = (2, 1; 1, 2): e = 1 and U⁻ = (−1, −1) with uncoupled impulses P = (1, 1) gains 1 J; e = (1, 0) and U⁻ = (−1, \
            −1/2), reversed together, gains 1/12 J. One contact with friction gains 9/80 J (S7.kane-friction). No gain in 35 coupled \
            frictionless impacts with e = 1.",
        controls: &["One e for both contacts, solved together, in the place of uncoupled impulses."],
        sources: &["chapter §7, the energy trap of Newton's law", "Kane and Levinson, Dynamics: Theory and Applications (1985)"],
        check: several_contacts,
    },
    Claim {
        id: "S7.kane-friction",
        statement: "With friction, Newton's law gets into trouble: some impact laws create energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, and one contact is enough. The rod at 45° with μ = 1, U⁻ = (−1, 3/5) has ΔT(e) = (e² − \
            16/25)/(16/5): a gain for e > 4/5.",
        argument: "At e = 1 P = (41/40, 3/8), U⁺ = (1, 0), T from 1/5 to 5/16. ΔT = 9/80, 17/320, 0, −39/320, −1/5 for e = 1, 9/10, 4/5, \
            1/2, 0. The end sticks in compression, then rebounds from a body that turns: the normal velocity at the sticking end costs \
            less energy to make than friction and compression left unspent.",
        controls: &["Poisson's law in Newton's place."],
        sources: &["chapter §7, the energy trap of Newton's law", "Stronge, J. Appl. Mech. 58 (1991) 1049"],
        check: friction,
    },
    Claim {
        id: "S7.kane-double-pendulum",
        statement: "Kane's counterexample is a real mechanism: a double pendulum whose tip hits the ground gains energy under Newton's law \
            with friction.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, for uniform rods of equal mass and length at 20° and 30° and ω = (−0.1, −0.2) rad/s (masses and \
            lengths are a choice made here): ΔT/T = +0.298 with μ = 0.5, e = 0.9, and +2.11 with μ = e = 0.7. Poisson's and Stronge's laws \
            lose energy.",
        argument: "Routh's path with W = (1.009560, 1.521309, 2.440338): sticking needs μ ≥ 0.6234. μ = 0.5, e = 0.9: ΔT/T = +0.29808, \
            −0.40076, −0.34191 (Newton, Poisson, Stronge); μ = e = 0.7: +2.11149, −0.46146, −0.42922. The same in rationals at sin θ = \
            12/37, 8/17: Newton gains, Poisson does not.",
        controls: &["Poisson's law in Newton's place."],
        sources: &["chapter §7, Kane's counterexample (named only)", "Kane and Levinson 1985 for the mechanism; their table was not found"],
        check: pendulum,
    },
    Claim {
        id: "S7.kane-different-e",
        statement: "The cause: Newton's law prescribes velocity ratios, and since rigid bodies couple the contact velocities, prescribing \
            them independently over-constrains the motion or injects energy.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Coupling alone does neither: a singular W over-constrains, and unequal coefficients inject energy if a \
            separating contact receives an impulse or an impulse pulls. With P ≥ 0 and every contact approaching, ΔT = ½Σ(1 − e_i)P_iU_i⁻ \
            ≤ 0 for any coefficients.",
        argument: "Rod above supports at its ends, e = (1, 0), U⁻ = (−1, 1/2): P = (7/6, 1/3), U⁺ = (1, 0), T from 1/4 to 1/3. Supports \
            near the middle, U⁻ = (−1, −1/2), all reversed: P = (7/6, −1/3), again +1/12. With P ≥ 0 and U⁻ ≤ 0 none of 60 impacts gains. \
            W = (1, 1; 1, 1) with e = (1, 0): no solution.",
        controls: &["One e in the place of unequal ones, and unequal ones in the place of one; contacts that separate among those that \
            approach."],
        sources: &["chapter §7, the energy trap of Newton's law"],
        check: unequal_coefficients,
    },
];

fn ones(count: usize) -> Vec<Rational> {
    vec![ratio(1, 1); count]
}

/// How many impacts of the grid gain energy at e = 1.
fn gaining(law: fn(&PlanarProblem<Rational>, &[Rational]) -> Result<Response<Rational>>) -> Result<usize> {
    let mut count = 0;
    for impact in frictionless_grid(false) {
        count += usize::from(impact.energy_change(&law(&impact, &ones(2))?) > ratio(0, 1));
    }
    Ok(count)
}

fn several_contacts(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.pick(newton::uncoupled as fn(&PlanarProblem<Rational>, &[Rational]) -> Result<Response<Rational>>, newton::together);
    let straight = middle([ratio(-1, 1), ratio(-1, 1)]);
    let tilted = middle([ratio(-1, 1), ratio(-1, 2)]);
    let unequal = newton::together(&tilted, &[ratio(1, 1), ratio(0, 1)])?;
    Ok(vec![
        Finding::count("coupled frictionless impacts that gain energy at e = 1", gaining(newton::together)?, 0).context(),
        Finding::exact("gain of uncoupled impulses, e = 1", &straight.energy_change(&law(&straight, &ones(2))?), &ratio(1, 1), "J"),
        Finding::exact("gain with e = (1, 0), all reversed", &tilted.energy_change(&unequal), &ratio(1, 12), "J"),
    ])
}

fn friction(reading: Reading) -> Result<Vec<Finding>> {
    let path = rod_path(&ratio(1, 1))?;
    let law = reading.pick(newton::along as fn(&Path<Rational>, &Rational) -> Result<Response<Rational>>, poisson::along);
    let mut findings = Vec::new();
    for e in [ratio(1, 1), ratio(9, 10), ratio(4, 5), ratio(1, 2), ratio(0, 1)] {
        let predicted = (&e * &e - ratio(16, 25)) * ratio(5, 16);
        findings.push(Finding::exact(format!("ΔT of the rod, μ = 1, e = {e}"), &gain(&path, law(&path, &e))?, &predicted, "J"));
    }
    let elastic = newton::along(&path, &ratio(1, 1))?;
    findings.push(Finding::exact("P_n at e = 1", &elastic.impulse[0], &ratio(41, 40), "N·s"));
    findings.push(Finding::exact("P_t at e = 1", &elastic.impulse[1], &ratio(3, 8), "N·s"));
    Ok(findings)
}

/// Routh's path of a pendulum's tip with ω = (−1, −2)/10 rad/s, and its kinetic energy.
fn tip<T: Scalar>(angles: [[T; 2]; 2], friction: &T) -> Result<(Path<T>, T)> {
    let pendulum = DoublePendulum { mass: T::one(), length: T::one(), angles };
    let angular = [T::ratio(-1, 10), T::ratio(-1, 5)];
    let [nn, nt, tt] = pendulum.delassus();
    let before = DVector::from_row_slice(&pendulum.contact_velocity(&angular));
    let impact = PlanarProblem::new(DMatrix::from_row_slice(2, 2, &[nn, nt.clone(), nt, tt]), before);
    Ok((Path::new(impact, friction)?, pendulum.kinetic_energy(&angular)))
}

/// ΔT/T at 20° and 30° under Newton, Poisson and Stronge.
fn relative_gains(friction: f64, restitution: f64) -> Result<[f64; 3]> {
    let angles = [20f64, 30.0].map(|degrees| [degrees.to_radians().sin(), degrees.to_radians().cos()]);
    let (path, energy) = tip(angles, &friction)?;
    let ends = [newton::along(&path, &restitution)?, poisson::along(&path, &restitution)?, stronge::along(&path, restitution)?];
    Ok(ends.map(|end| path.impact().energy_change(&end) / energy))
}

fn pendulum(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let table = [(0.5, 0.9, [0.298_081, -0.400_757, -0.341_907]), (0.7, 0.7, [2.111_490, -0.461_458, -0.429_217])];
    for (mu, e, expected) in table {
        let gains = relative_gains(mu, e)?;
        let subject = reading.pick(gains[0], gains[1]);
        for (law, value, expected) in
            [("Newton", subject, expected[0]), ("Poisson", gains[1], expected[1]), ("Stronge", gains[2], expected[2])]
        {
            findings.push(Finding::equal(format!("ΔT/T under {law}, μ = {mu}, e = {e}"), value, expected, FOUR_DIGITS, "1"));
        }
    }
    let exact = [[ratio(12, 37), ratio(35, 37)], [ratio(8, 17), ratio(15, 17)]];
    let (path, _) = tip(exact, &ratio(1, 2))?;
    let [gains, losses] = [newton::along(&path, &ratio(9, 10)), poisson::along(&path, &ratio(9, 10))].map(|end| gain(&path, end));
    findings.push(Finding::decision("Newton gains energy, in rationals", gains? > ratio(0, 1), true));
    findings.push(Finding::decision("Poisson gains energy, in rationals", losses? > ratio(0, 1), false));
    Ok(findings)
}

/// Gains among the impacts of the grid with three pairs of coefficients, under Moreau's law.
fn gains_without_pull(approaching_only: bool) -> Result<usize> {
    let mut count = 0;
    for impact in frictionless_grid(approaching_only) {
        for [first, second] in [[1, 0], [0, 1], [1, 1]] {
            let outcome = moreau::frictionless(&impact, &[ratio(first, 1), ratio(second, 1)])?;
            count += usize::from(impact.energy_change(&outcome) > ratio(0, 1));
        }
    }
    Ok(count)
}

fn unequal_coefficients(reading: Reading) -> Result<Vec<Finding>> {
    let (unequal, equal) = ([ratio(1, 1), ratio(0, 1)], [ratio(1, 1), ratio(1, 1)]);
    let separating = ends([ratio(-1, 1), ratio(1, 2)]);
    let lifted = moreau::frictionless(&separating, &unequal)?;
    let same = moreau::frictionless(&separating, &reading.pick(equal, unequal.clone()))?;
    let gains = gains_without_pull(reading.pick(true, false))?;
    let pulling = middle([ratio(-1, 1), ratio(-1, 2)]);
    let reversed = newton::together(&pulling, &unequal)?;
    let singular = PlanarProblem::new(DMatrix::from_element(2, 2, ratio(1, 1)), DVector::from_element(2, ratio(-1, 1)));
    let refused = matches!(newton::together(&singular, &unequal), Err(Error::Unsupported(_)));
    Ok(vec![
        Finding::exact("energy gained above supports at the ends", &separating.energy_change(&lifted), &ratio(1, 12), "J"),
        Finding::exact("impulse at the separating end", &lifted.impulse[1], &ratio(1, 3), "N·s"),
        Finding::exact("energy gained with a pulling impulse", &pulling.energy_change(&reversed), &ratio(1, 12), "J"),
        Finding::exact("the pulling impulse", &reversed.impulse[1], &ratio(-1, 3), "N·s"),
        Finding::decision("with one e for both ends energy is gained there", separating.energy_change(&same) > ratio(0, 1), false)
            .says(true)
            .violating("unequal coefficients"),
        Finding::count("gains with P ≥ 0 where every contact approaches", gains, 0)
            .says_at_least(1)
            .violating("an impulse at a separating contact, or one that pulls"),
        Finding::decision("two contacts in one place can have two ratios", !refused, false),
    ])
}
