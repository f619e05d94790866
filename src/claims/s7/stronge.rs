//! Stronge's law, and what coefficients of restitution are coefficients of.

use super::impacts::{ContactsLaw, cradle, frictionless_grid, middle, rod_path, rough_grid, rounded, two_phases};
use crate::claims::prelude::*;
use crate::impact_laws::routh::Path;
use crate::impact_laws::{energy_projection, moreau, newton, poisson, stronge};
use crate::problem::Response;
use crate::tolerance::claims::impact::SIX_DECIMALS;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.stronge-def",
        statement: r"Stronge: the energetic coefficient $e_*^2 = E^+/E^-$, the energy released in restitution over the energy stored in
            compression.",
        verdict: ClaimVerdict::True,
        kind: Kind::Definition,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, $E$ being the work of the normal impulse in each phase, as the sentence says. The kinetic energies
            before and after, which §12 calls so, have another ratio: friction lowers them as well.",
        argument: r"The rod, $\mu = 1$, $e_* = 1$: the normal impulse takes 31/200 J and returns 31/200 J, ratio 1; the kinetic energy
            goes from 1/5 to 31/200 J, ratio 31/40.",
        controls: &[r"Newton's law with $e = 1$ in place of Stronge's."],
        sources: &["chapter §7, Stronge's law", "Stronge, Proc. R. Soc. A 431 (1990)"],
        check: check!(two_ratios),
    },
    Claim {
        id: "S7.stronge-no-gain",
        statement: "Stronge's law avoids the gain of energy in Kane's counterexample at the root, because it bounds an energy ratio by 1.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, for one contact: $\Delta T = -(1 - e_*^2)|W_c| + W_\text{friction}$ with
            $W_\text{friction} \le 0$.",
        argument: r"The normal work of both phases is $-(1 - e_*^2)|W_c|$, and $\int U_t\,dq \le 0$ along Routh's path, exactly, in every
            planar impact of a grid; with $e_* = 1$ in floating point $\Delta T < 0$ in all of them. The rod, $\mu = 1$: −9/200 J.",
        controls: &["Newton's law in Stronge's place."],
        sources: &["chapter §7, table of impact laws", "Stronge, J. Appl. Mech. 58 (1991) 1049"],
        check: check!(no_gain),
    },
    Claim {
        id: "S7.stronge-conserves",
        statement: "To conserve energy with several bodies one needs Stronge's law or an energy-consistent projection.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: r"Without friction they are not needed: Newton's and Moreau's laws conserve at $e = 1$. With friction they do
            not conserve: $e_* = 1$ still loses the work of friction, and a projection only takes energy away.",
        argument: r"Three balls, $e = 1$: $\Delta T = 0$ under Newton, Poisson and Moreau. The rod, $e_* = 1$: −9/200 J with $\mu = 1$
            (sticks), −0.055264 J with $\mu = 1/2$ (turns round). Projecting the plastic outcome of the balls leaves its loss of 1/3 J.",
        controls: &[
            "The other laws on the rod with friction, Stronge's on the rod without, the projection of an outcome that gains energy.",
        ],
        sources: &["chapter §7, pitfall on e = 1"],
        check: check!(conservation),
    },
    Claim {
        id: "S7.definitions-differ",
        statement: r"Newton's, Poisson's and Stronge's $e$ are different numbers for the same collision (velocity, impulse, energy).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, with friction that stops or turns round. Without friction, or while the slip goes on, the three \
            agree.",
        argument: r"The rod, $\mu = 1$, $U_n^- = -1$: the collision with $e_P = 1$ has $e_N = 16/25$ and $e_*^2 = 128/155$, that with
            $e_P = 1/2$ half and a quarter of them. The sentence is read as one about the definitions; it does not say that no collision
            makes them equal.",
        controls: &["The rod without friction."],
        sources: &["chapter §7, pitfall on e as a material constant"],
        check: check!(three_numbers),
    },
    Claim {
        id: "S7.e-not-material",
        statement: r"$e$ is not a material constant: it depends on speed, geometry and temperature, and is usually smaller at high speed;
            used as a constant across speeds it makes a simulation inaccurate.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: r"Speed and temperature are physics that no scheme decides. What can be decided: the velocity ratio depends on
            geometry and friction even if the energetic coefficient is fixed, and none of these laws with a constant $e$ can express a
            dependence on speed, because all are homogeneous of degree one.",
        argument: r"$e_* = 1$: $U_n^{+2}/U_n^{-2}$ is 1 without friction, 62/125 for the rod with $\mu = 1$. With $e = 1/2$ three times
            the velocity gives three times the impulse under Newton and Poisson.",
        controls: &[r"The rod with friction and the one without exchanged; an $e$ that falls with the speed, $1/(1 + |U_n^-|)$."],
        sources: &["chapter §7, pitfall on e as a material constant"],
        check: check!(not_material),
    },
    Claim {
        id: "S7.e1-single-conserves",
        statement: r"$e = 1$ does conserve energy in a single-point collision, but with several bodies colliding at once under Newton's
            law the total energy may change even with $e = 1$ at every point (Kane), because pointwise velocity ratios are not
            conservation of energy; $e = 1$ conserves for a single point only.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"It depends on what “pointwise” means, as in exercise 2. With impulses computed as if each point were alone,
            as said. If every velocity is reversed, $U^+ = -U^-$, $e = 1$ conserves energy for any number of contacts:
            $\Delta T = \tfrac12P^T(U^+ + U^-) = 0$. Friction, of which the section warns, changes it even at one point.",
        argument: r"One contact without friction: $\Delta T = 0$. $U^+ + U^- = 0$ at every contact: $\Delta T = 0$ exactly in every impact
            of a grid of two coupled contacts, under Moreau's law as well, and under Poisson's where all approach. Impulses computed
            contact by contact change the energy in some. One contact with friction: +9/80 (Newton), −9/125 (Poisson).",
        controls: &[
            "The single contact with friction; impulses computed contact by contact for those that are reversed.",
            "All velocities reversed together in the place of impulses computed contact by contact.",
        ],
        sources: &["chapter §7, pitfall on e = 1; its exercise 2 asks the same"],
        check: check!(elastic),
    },
];

/// Work of the normal impulse in restitution over minus that in compression, and T⁺/T⁻, for the rod (T⁻ = 1/5) on one piece of its path
/// in restitution.
fn ratios(friction: &Rational) -> Result<[Rational; 2]> {
    let path = rod_path(friction)?;
    let end = stronge::end(&path, &ratio(1, 1))?;
    let released = (&end.speed_squared - &end.start.normal * &end.start.normal) / (ratio(2, 1) * &end.slope);
    let stored = -stronge::compression_work(&path);
    let rubbed = path.friction_work(&ratio(0, 1), &end.start.impulse);
    let kinetic = (ratio(1, 5) - &stored + &released + rubbed) / ratio(1, 5);
    Ok([released / stored, kinetic])
}

fn two_ratios(reading: Reading) -> Result<Vec<Finding>> {
    let [work, kinetic] = ratios(&ratio(1, 1))?;
    let path = rod_path(&ratio(1, 1))?;
    let newton = newton::along(&path, &ratio(1, 1))?.impulse[0].clone();
    let by_newton = path.normal_work(&path.compression_end(), &newton) / -stronge::compression_work(&path);
    Ok(vec![
        Finding::exact("energy released over energy stored, coefficient 1", &reading.pick(work, by_newton), &ratio(1, 1), "1"),
        Finding::exact("T⁺/T⁻", &kinetic, &ratio(31, 40), "1").context(),
        Finding::exact("work of the normal impulse in compression", &stronge::compression_work(&path), &ratio(-31, 200), "J").context(),
    ])
}

/// ΔT in floating point of an elastic end of a path.
fn rounded_gain(path: &Path<Rational>, friction: &Rational, law: fn(&Path<f64>, f64) -> Result<Response<f64>>) -> Result<f64> {
    let path = Path::new(rounded(path.impact()), &friction.to_f64().value())?;
    Ok(path.impact().energy_change(&law(&path, 1.0)?))
}

fn newton_along(path: &Path<f64>, restitution: f64) -> Result<Response<f64>> {
    newton::along(path, &restitution)
}

fn no_gain(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.pick(stronge::along as fn(&Path<f64>, f64) -> Result<Response<f64>>, newton_along);
    let (mut gains, mut fed) = (0, 0);
    for (path, mu) in rough_grid()? {
        gains += usize::from(rounded_gain(&path, &mu, law)? >= 0.0);
        fed += usize::from(path.friction_work(&ratio(0, 1), &ratio(100, 1)) > ratio(0, 1));
    }
    let rod = rounded_gain(&rod_path(&ratio(1, 1))?, &ratio(1, 1), law)?;
    Ok(vec![
        Finding::count("planar impacts that do not lose energy with e_* = 1, μ > 0", gains, 0),
        Finding::equal("ΔT of the rod, μ = 1", rod, -9.0 / 200.0, rounding(64, 1.0), "J"),
        Finding::count("paths along which friction feeds energy in", fed, 0).context(),
    ])
}

fn conservation(reading: Reading) -> Result<Vec<Finding>> {
    // one impact under Newton, Poisson and Moreau with e = 1
    let changes = match reading {
        Reading::Recorded => elastic_balls()?,
        Reading::Control(_) => elastic_rod()?,
    };
    let [stuck, turned] = [ratio(1, 1), ratio(1, 2)].map(|friction| reading.pick(friction, ratio(0, 1)));
    let stuck = rounded_gain(&rod_path(&stuck)?, &stuck, stronge::along)?;
    let turned = rounded_gain(&rod_path(&turned)?, &turned, stronge::along)?;
    let (impact, pair) = reading.pick((cradle(), [0, 0]), (middle([ratio(-1, 1), ratio(-1, 2)]), [1, 0]));
    let candidate = newton::together(&impact, &pair.map(|e| ratio(e, 1)))?;
    let projected = energy_projection::project(&impact, &candidate.after)?;
    let before = energy_projection::energy(&impact, &impact.velocity)?;
    let kept = energy_projection::energy(&impact, &projected.direction)? * &projected.factor_squared - before;
    let mut findings = Vec::new();
    for (law, change) in ["Newton", "Poisson", "Moreau"].into_iter().zip(changes) {
        findings
            .push(Finding::decision(format!("an elastic collision conserves energy under {law}"), change == ratio(0, 1), true).says(false));
    }
    findings.extend([
        Finding::equal("ΔT of the rod under Stronge, e_* = 1, μ = 1", stuck, -9.0 / 200.0, rounding(64, 1.0), "J").says(0.0),
        Finding::equal("with μ = 1/2", turned, -0.055_264, SIX_DECIMALS, "J").says(0.0),
        Finding::exact("ΔT of a projected plastic outcome", &(kept * ratio(1, 2)), &ratio(-1, 3), "J").says(ratio(0, 1)),
    ]);
    Ok(findings)
}

/// ΔT of three balls, e = 1, under Newton, Poisson and Moreau.
fn elastic_balls() -> Result<[Rational; 3]> {
    let (balls, pair) = (cradle(), [ratio(1, 1), ratio(1, 1)]);
    let ends = [newton::together(&balls, &pair)?, poisson::two_problems(&balls, &pair)?.end, moreau::frictionless(&balls, &pair)?];
    Ok(ends.map(|end| balls.energy_change(&end)))
}

/// The same of the rod with friction.
fn elastic_rod() -> Result<[Rational; 3]> {
    let (path, one) = (rod_path(&ratio(1, 1))?, ratio(1, 1));
    let coulomb = moreau::normal_only(path.impact(), std::slice::from_ref(&one), &one)?;
    let ends = [newton::along(&path, &one)?, poisson::along(&path, &one)?, coulomb];
    Ok(ends.map(|end| path.impact().energy_change(&end)))
}

/// One collision, that of the rod which Poisson's e ends, and its three coefficients: e_P, e_N = U_n⁺ for U_n⁻ = −1 m/s, and
/// e_*² = U_n⁺²/U_n⁺²(e_* = 1).
fn three_numbers(reading: Reading) -> Result<Vec<Finding>> {
    let path = rod_path(&reading.pick(ratio(1, 1), ratio(0, 1)))?;
    let all_returned = stronge::end(&path, &ratio(1, 1))?.speed_squared;
    let mut findings = Vec::new();
    for poissons in [ratio(1, 1), ratio(1, 2)] {
        let newtons = poisson::along(&path, &poissons)?.after[0].clone();
        let stronges_squared = &newtons * &newtons / &all_returned;
        let mut squares = vec![&poissons * &poissons, &newtons * &newtons, stronges_squared.clone()];
        squares.sort();
        squares.dedup();
        findings.push(Finding::count(format!("different numbers among the three e, e_P = {poissons}"), squares.len(), 3));
        findings.push(Finding::exact(format!("e_N of it, e_P = {poissons}"), &newtons, &(ratio(16, 25) * &poissons), "1"));
        let expected = ratio(128, 155) * &poissons * &poissons;
        findings.push(Finding::exact(format!("e_*² of it, e_P = {poissons}"), &stronges_squared, &expected, "1"));
    }
    Ok(findings)
}

/// Whether three times the velocity gives the rod three times the impulse, under Newton and Poisson with this e.
fn scales(coefficient: fn(&Rational) -> Rational) -> Result<bool> {
    let slow = rod_path(&ratio(1, 1))?;
    let mut thrice = slow.impact().clone();
    thrice.velocity *= ratio(3, 1);
    let fast = Path::new(thrice, &ratio(1, 1))?;
    let [of_slow, of_fast] = [&slow, &fast].map(|path| coefficient(&path.impact().velocity[0].magnitude()));
    Ok(newton::along(&slow, &of_slow)?.impulse * ratio(3, 1) == newton::along(&fast, &of_fast)?.impulse
        && poisson::along(&slow, &of_slow)?.impulse * ratio(3, 1) == poisson::along(&fast, &of_fast)?.impulse)
}

fn not_material(reading: Reading) -> Result<Vec<Finding>> {
    let frictions = [ratio(1, 1), ratio(0, 1)];
    let [rough, smooth] = reading.pick(frictions.clone(), [frictions[1].clone(), frictions[0].clone()]);
    let [rough, smooth] = [rough, smooth].map(|friction| stronge::end(&rod_path(&friction)?, &ratio(1, 1)));
    let coefficient: fn(&Rational) -> Rational = reading.pick(|_| ratio(1, 2), |speed| ratio(1, 1) / (ratio(1, 1) + speed));
    Ok(vec![
        Finding::exact("U_n⁺²/U_n⁻² with e_* = 1 and friction", &rough?.speed_squared, &ratio(62, 125), "1")
            .opinion("speed and temperature, which measured collisions decide"),
        Finding::exact("without friction", &smooth?.speed_squared, &ratio(1, 1), "1"),
        Finding::decision("impulses are proportional to the speed", scales(coefficient)?, true),
    ])
}

/// Impacts of several contacts whose energy changes at e = 1.
fn changes(law: ContactsLaw, approaching_only: bool) -> Result<usize> {
    let mut count = 0;
    for impact in frictionless_grid(approaching_only) {
        count += usize::from(impact.energy_change(&law(&impact, &[ratio(1, 1), ratio(1, 1)])?) != ratio(0, 1));
    }
    Ok(count)
}

fn elastic(reading: Reading) -> Result<Vec<Finding>> {
    let reversed = reading.only(0).pick(newton::together as ContactsLaw, newton::uncoupled);
    let point_by_point = reading.only(1).pick(newton::uncoupled as ContactsLaw, newton::together);
    let rough = rod_path(&ratio(1, 1))?;
    let smooth = rod_path(&reading.only(0).pick(ratio(0, 1), ratio(1, 1)))?;
    let change = |path: &Path<Rational>, end: Response<Rational>| path.impact().energy_change(&end);
    let single = change(&smooth, newton::along(&smooth, &ratio(1, 1))?);
    let rubbing = [newton::along(&rough, &ratio(1, 1))?, poisson::along(&rough, &ratio(1, 1))?].map(|end| change(&rough, end));
    let some = changes(point_by_point, false)? > 0;
    Ok(vec![
        Finding::decision("an impact of several contacts with U⁺ = −U⁻ changes the energy", changes(reversed, false)? > 0, false)
            .says(true)
            .reading("as U⁺ = −U⁻ at every point"),
        Finding::decision("one with impulses computed contact by contact does", some, true).reading("as impulses computed point by point"),
        Finding::exact("ΔT of one contact without friction", &single, &ratio(0, 1), "J"),
        Finding::exact("ΔT of one contact with friction, Newton", &rubbing[0], &ratio(9, 80), "J").context(),
        Finding::exact("ΔT of one contact with friction, Poisson", &rubbing[1], &ratio(-9, 125), "J").context(),
        Finding::count("energies changed under Moreau", changes(moreau::frictionless, false)?, 0).context(),
        Finding::count("energies changed under Poisson, all contacts approaching", changes(two_phases, true)?, 0).context(),
    ])
}
