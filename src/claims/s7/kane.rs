//! Kane's paradox: where Newton's law creates energy.

use super::impacts::{ContactsLaw, PathLaw, ends, frictionless_grid, gain, middle, rod_path};
use crate::claims::prelude::*;
use crate::closed_forms::double_pendulum_impact::DoublePendulum;
use crate::closed_forms::rough_impact::RoughImpact;
use crate::elimination::rank;
use crate::impact_laws::routh::Path;
use crate::impact_laws::{moreau, newton, poisson, stronge};
use crate::problem::{PlanarProblem, Response};
use crate::tolerance::claims::pathology::FOUR_DIGITS;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.kane-multi",
        statement: "Kane's counterexample: in some collisions of several bodies, Newton's law applied independently at every contact \
            increases the total kinetic energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, of some configurations: if each impulse is computed as if its contact were alone, with unequal
            coefficients, or with friction. Not without friction for one $e$ and the coupled problem:
            $\Delta T = -\tfrac12(1 - e^2)U^{-T}W^{-1}U^- \le 0$, and $e = 1$ conserves exactly.",
        argument: r"$W = (2, 1; 1, 2)$: $e = 1$ and $U^- = (-1, -1)$ with uncoupled impulses $P = (1, 1)$ gains 1 J; $e = (1, 0)$ and
            $U^- = (-1, -1/2)$, reversed together, gains 1/12 J. One contact with friction is enough for a gain (S7.kane-friction). Solved
            together with $e = 1$ no coupled frictionless impact of a grid gains.",
        controls: &[r"One $e$ for both contacts, solved together, in the place of uncoupled impulses and of unequal coefficients."],
        sources: &["chapter §7, the energy trap of Newton's law", "Kane and Levinson, Dynamics: Theory and Applications (1985)"],
        check: check!(several_contacts),
    },
    Claim {
        id: "S7.kane-friction",
        statement: "With friction, Newton's law gets into trouble: some impact laws create energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, and one contact is enough. The rod at 45° with $\mu = 1$, $U^- = (-1, 3/5)$ has
            $\Delta T(e) = (e^2 - 16/25)/(16/5)$: a gain for $e > 4/5$.",
        argument: r"At $e = 1$ $P = (41/40, 3/8)$. $\Delta T = 9/80$, 17/320, 0, −39/320 for $e = 1$, 9/10, 4/5, 1/2. The end sticks in
            compression, then rebounds from a body that turns: the normal velocity at the sticking end costs less energy to make than
            friction and compression left unspent.",
        controls: &["Poisson's law in Newton's place."],
        sources: &["chapter §7, the energy trap of Newton's law", "Stronge, J. Appl. Mech. 58 (1991) 1049"],
        check: check!(friction),
    },
    Claim {
        id: "S7.kane-double-pendulum",
        statement: "Exercise 2 asks for a counterexample like Kane's, which the chapter names only. An answer of ours: a double pendulum \
            whose tip hits the ground gains energy under Newton's law with friction.",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, for uniform rods of equal mass and length at 20° and 30° and $\omega = (-0.1, -0.2)$ rad/s (masses
            and lengths are a choice made here): $\Delta T/T = +0.298$ with $\mu = 0.5$, $e = 0.9$, and +2.11 with $\mu = e = 0.7$.
            Poisson's and Stronge's laws lose energy.",
        argument: r"Routh's path, on which sticking needs $\mu \ge 0.6234$. $\mu = 0.5$, $e = 0.9$: $\Delta T/T = +0.29808$, −0.40076,
            −0.34191 (Newton, Poisson, Stronge); $\mu = e = 0.7$: +2.11149, −0.46146, −0.42922, each from the path and from the formulas
            by regime. The same in rationals at $\sin \theta = 12/37$, 8/17: Newton gains, Poisson does not.",
        controls: &["The laws exchanged: Poisson's in Newton's place, Stronge's in Poisson's, Newton's in Stronge's."],
        sources: &[
            "chapter §7, exercise 2, and Kane's counterexample (named only)",
            "Kane and Levinson 1985 for the mechanism; their table was not found",
        ],
        check: check!(pendulum),
    },
    Claim {
        id: "S7.kane-different-e",
        statement: "The cause: Newton's law prescribes velocity ratios, and since rigid bodies couple the contact velocities, prescribing \
            them independently over-constrains the motion or injects energy.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Coupling alone does neither: a singular $W$ over-constrains, and unequal coefficients inject energy if a
            separating contact receives an impulse or an impulse pulls. With $P \ge 0$ and every contact approaching,
            $\Delta T = \tfrac12\sum(1 - e_i)P_iU_i^- \le 0$ for any coefficients.",
        argument: r"Rod above supports at its ends, $e = (1, 0)$, $U^- = (-1, 1/2)$: the separating end takes 1/3 N·s, and
            $\Delta T = 1/12$. Supports near the middle, $U^- = (-1, -1/2)$, all reversed: $P_2 = -1/3$, again +1/12. With $P \ge 0$ and
            $U^- \le 0$ no impact of a grid gains. $W = (1, 1; 1, 1)$, $U^- = (-1, -1)$, $e = (1, 0)$: no impulses give both velocities.",
        controls: &[r"One $e$ in the place of unequal ones, and unequal ones in the place of one; contacts that separate among those that
                approach."],
        sources: &["chapter §7, the energy trap of Newton's law"],
        check: check!(unequal_coefficients),
    },
];

fn ones(count: usize) -> Vec<Rational> {
    vec![ratio(1, 1); count]
}

/// How many impacts of the grid gain energy at e = 1.
fn gaining(law: ContactsLaw) -> Result<usize> {
    let mut count = 0;
    for impact in frictionless_grid(false) {
        count += usize::from(impact.energy_change(&law(&impact, &ones(2))?) > ratio(0, 1));
    }
    Ok(count)
}

fn several_contacts(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.pick(newton::uncoupled as ContactsLaw, newton::together);
    let straight = middle([ratio(-1, 1), ratio(-1, 1)]);
    let tilted = middle([ratio(-1, 1), ratio(-1, 2)]);
    let second = reading.pick(ratio(0, 1), ratio(1, 1));
    let unequal = newton::together(&tilted, &[ratio(1, 1), second])?;
    Ok(vec![
        Finding::count("coupled frictionless impacts that gain energy at e = 1", gaining(newton::together)?, 0).context(),
        Finding::exact("gain of uncoupled impulses, e = 1", &straight.energy_change(&law(&straight, &ones(2))?), &ratio(1, 1), "J"),
        Finding::exact("gain with e = (1, 0), all reversed", &tilted.energy_change(&unequal), &ratio(1, 12), "J"),
    ])
}

fn friction(reading: Reading) -> Result<Vec<Finding>> {
    let path = rod_path(&ratio(1, 1))?;
    let law = reading.pick(newton::along as PathLaw, poisson::along);
    let mut findings = Vec::new();
    for e in [ratio(1, 1), ratio(9, 10), ratio(4, 5), ratio(1, 2)] {
        let predicted = (&e * &e - ratio(16, 25)) * ratio(5, 16);
        findings.push(Finding::exact(format!("ΔT of the rod, μ = 1, e = {e}"), &gain(&path, law(&path, &e))?, &predicted, "J"));
    }
    let elastic = law(&path, &ratio(1, 1))?;
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

type RoundedLaw = fn(&Path<f64>, f64) -> Result<Response<f64>>;

/// Newton's, Poisson's and Stronge's law, or each in the place of the one before.
fn laws(reading: Reading) -> [RoundedLaw; 3] {
    let [newton, poisson]: [RoundedLaw; 2] = [|path, e| newton::along(path, &e), |path, e| poisson::along(path, &e)];
    reading.pick([newton, poisson, stronge::along], [poisson, stronge::along, newton])
}

/// U_n⁺² under Stronge's law on two straight pieces whose slip stops in restitution, at U_n = v: the first one stores w²/(2s₁), releases
/// v²/(2s₁), and the second, with the slope s₂, the rest.
fn stopped_in_restitution(closed: &RoughImpact<f64>, restitution: f64) -> Option<f64> {
    let (stop, at_stop) = (closed.stop()?, closed.normal_velocity_at_stop()?);
    let due = (restitution * closed.approach).powi(2) - at_stop * at_stop;
    let first = (at_stop + closed.approach) / stop;
    let second = 1.0 / (closed.impulse_reaching(&(at_stop + 1.0)) - stop);
    (at_stop > 0.0).then(|| if due > 0.0 { at_stop * at_stop + due * second / first } else { due + at_stop * at_stop })
}

/// ΔT \[J\] under Newton, Poisson and Stronge by the formulas by regime.
fn formulas(impact: &PlanarProblem<f64>, friction: f64, restitution: f64) -> Result<[f64; 3]> {
    let w = &impact.delassus;
    let delassus = [w[(0, 0)], w[(0, 1)], w[(1, 1)]];
    let closed = RoughImpact { delassus, approach: -impact.velocity[0], slide: impact.velocity[1], friction };
    let squared = closed.stronge_speed_squared(&restitution).or_else(|| stopped_in_restitution(&closed, restitution));
    let squared = squared.ok_or_else(|| Error::Unsupported("the slip stops".into()))?;
    let stronge = closed.impulse(closed.impulse_reaching(&squared.sqrt()));
    Ok([closed.newton(&restitution), closed.poisson(&restitution), stronge].map(|end| closed.energy_change(&end)))
}

/// (sin θ, cos θ) of 20° and 30°.
fn degrees() -> [[f64; 2]; 2] {
    [20f64, 30.0].map(|degrees| [degrees.to_radians().sin(), degrees.to_radians().cos()])
}

fn pendulum(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (mu, e) in [(0.5, 0.9), (0.7, 0.7)] {
        let (path, energy) = tip(degrees(), &mu)?;
        let expected = formulas(path.impact(), mu, e)?;
        for ((name, law), expected) in ["Newton", "Poisson", "Stronge"].into_iter().zip(laws(reading)).zip(expected) {
            let change = path.impact().energy_change(&law(&path, e)?) / energy;
            let rounding = rounding(256, change.abs().max(1.0));
            findings.push(Finding::equal(format!("ΔT/T under {name}, μ = {mu}, e = {e}"), change, expected / energy, rounding, "1"));
        }
    }
    let exact = [[ratio(12, 37), ratio(35, 37)], [ratio(8, 17), ratio(15, 17)]];
    let (path, _) = tip(exact, &ratio(1, 2))?;
    let laws = reading.pick([newton::along as PathLaw, poisson::along], [poisson::along, newton::along]);
    let [gains, losses] = laws.map(|law| gain(&path, law(&path, &ratio(9, 10))));
    findings.push(Finding::decision("Newton gains energy, in rationals", gains? > ratio(0, 1), true));
    findings.push(Finding::decision("Poisson gains energy, in rationals", losses? > ratio(0, 1), false));
    let (path, _) = tip(degrees(), &0.5)?;
    let delassus = &path.impact().delassus;
    let least = delassus[(0, 1)].abs() / delassus[(1, 1)];
    findings.push(Finding::equal("least μ that lets the tip stick", least, 0.6234, FOUR_DIGITS, "1").context());
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

/// Whether some impulses give every contact its ratio.
fn has_impulses(impact: &PlanarProblem<Rational>, restitution: &[Rational; 2]) -> bool {
    let change = DVector::from_fn(2, |k, _| -(ratio(1, 1) + &restitution[k]) * &impact.velocity[k]);
    let mut augmented = impact.delassus.clone().insert_column(2, ratio(0, 1));
    augmented.set_column(2, &change);
    rank(&augmented) == rank(&impact.delassus)
}

fn unequal_coefficients(reading: Reading) -> Result<Vec<Finding>> {
    let (different, equal) = ([ratio(1, 1), ratio(0, 1)], [ratio(1, 1), ratio(1, 1)]);
    let (unequal, one_e) = reading.pick((different.clone(), equal.clone()), (equal, different));
    let separating = ends([ratio(-1, 1), ratio(1, 2)]);
    let lifted = moreau::frictionless(&separating, &unequal)?;
    let same = moreau::frictionless(&separating, &one_e)?;
    let gains = gains_without_pull(reading.pick(true, false))?;
    let pulling = middle([ratio(-1, 1), ratio(-1, 2)]);
    let reversed = newton::together(&pulling, &unequal)?;
    let in_one_place = PlanarProblem::new(DMatrix::from_element(2, 2, ratio(1, 1)), DVector::from_element(2, ratio(-1, 1)));
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
        Finding::decision("two contacts in one place can have two ratios", has_impulses(&in_one_place, &unequal), false),
    ])
}
