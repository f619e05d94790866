//! Contact of an elastic continuum: a bar that hits a wall, against its wave solution.

use crate::claims::prelude::*;
use crate::closed_forms::ElasticBar;
use crate::elastic_bar::{FiniteElementBar, Method};
use crate::tolerance::claims::ORDER_GAP;
use crate::tolerance::claims::elastic::{CONVERGING, OSCILLATING, energy_rounding};
use crate::tolerance::claims::thresholds::{CONVERGES, DOUBLED};
use crate::trajectory::{Refinement, fit_order};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S11.rigid-to-fem",
        statement: "The finite-dimensional proof for rigid bodies does not carry over directly to infinite dimensions: discrete elastic \
            waves with contact easily bring a numerical drift of energy, which needs energy–momentum integrators.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated, seen on a bar that hits a wall. The solution is of another kind (a finite force $\rho cAV$ over
            $2L/c$, $e = 1$, no atom), refining the mesh changes the finite-dimensional problem, and what is proved for each mesh says
            nothing of the limit of the force.",
        argument: r"Mesh of 20 to 80 elements, $h = \Delta/(2c)$, plastic law at the node. Midpoint: the energy lost vanishes with
            $\Delta$, where a rigid body loses all; its force is off by 0.88 of the true impulse at every $N$. Average acceleration
            multiplies the energy by more than 2. With the end's mass redistributed the force converges, and the energy gained is below
            $(3/80)^2$ of it.",
        controls: &[
            "A bar of two elements, which is nearly a rigid body.",
            "The end's mass not redistributed where it was, and average acceleration with redistributed mass everywhere else.",
        ],
        sources: &[
            "chapter §11, infinite-dimensional extension and pitfalls",
            "Khenous, Laborde and Renard, Mass redistribution method (2008)",
            "Doyen, Ern and Piperno (2011)",
        ],
        check: check!(bar),
    },
    Claim {
        id: "S11.fem-refs",
        statement: "Laursen and Chawla (1997) and Laursen and Love (2002): finite-element impact integrators that conserve energy and \
            momentum. Hauret and Le Tallec (2006): estimates of dissipation. Hesch and Betsch (2009, 2011): mortar methods, whose \
            conservation of energy they prove.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Citations; the papers were not read. What the first two names stand for is \
            checked: the persistency condition keeps the energy, at the price of a penetration of a step and of a force that oscillates.",
        argument: r"Midpoint with $0 \le \lambda \perp u^+ - u \ge 0$ once closed: $\Delta E = \lambda(u^+ - u) = 0$ in every step, to
            rounding, at $N = 20$, 40, 80. Without it $\Delta E \le 0$ in every step.",
        controls: &["Average acceleration in place of the persistency condition and of the midpoint rule."],
        sources: &[
            "chapter §11, infinite-dimensional extension",
            "Laursen and Chawla 1997, Laursen and Love 2002, Hauret and Le Tallec 2006 (not read)",
        ],
        check: check!(persistency),
    },
];

/// What a run to 1.6 contact times shows, in units of the exact solution.
struct Outcome {
    /// Largest and smallest E/E₀ after the start.
    energies: [f64; 2],
    /// Largest increase of E/E₀ in a step.
    gain: f64,
    /// ∫|λ − ρcAV| dt over the exact impulse.
    force_error: f64,
}

fn run(elements: usize, method: Method, redistributed: bool) -> Result<Outcome> {
    let bar = ElasticBar::new(1.0, 1.0, 1.0, 1.0, 1.0)?;
    let mesh = FiniteElementBar::new(&bar, elements, redistributed)?;
    let h = 0.5 * bar.length / elements as f64 / bar.wave_speed();
    let steps = (1.6 * bar.contact_time() / h).round() as usize;
    let start = mesh.energy(&mesh.arriving());
    let (mut outcome, mut last, mut count) = (Outcome { energies: [1.0, 1.0], gain: 0.0, force_error: 0.0 }, 1.0, 0);
    mesh.run(method, h, steps, |state| {
        count += 1;
        let energy = mesh.energy(state) / start;
        outcome.energies = [outcome.energies[0].max(energy), outcome.energies[1].min(energy)];
        outcome.gain = outcome.gain.max(energy - last);
        last = energy;
        let middle = (f64::from(count) - 0.5) * h;
        outcome.force_error += h * (state.force - bar.force(middle)).abs() / (bar.contact_force() * bar.contact_time());
    })?;
    Ok(outcome)
}

const MESHES: [usize; 3] = [20, 40, 80];

/// The order in Δ of a number per mesh.
fn order(value: impl Fn(usize) -> Result<f64>) -> Result<f64> {
    let level = |elements: usize| Ok(Refinement { time_step: 1.0 / elements as f64, error: value(elements)? });
    Ok(fit_order(MESHES.into_iter().map(level).collect::<Result<_>>()?)?.slope)
}

fn bar(reading: Reading) -> Result<Vec<Finding>> {
    let other = reading.only(1).is_control();
    let plain = |elements: usize, method: Method| {
        if other { run(elements, Method::AverageAcceleration, true) } else { run(elements, method, false) }
    };
    let lost = |elements: usize| Ok::<_, Error>(1.0 - run(elements, Method::Midpoint, false)?.energies[1]);
    let fine = lost(reading.only(0).pick(80, 2))?;
    let mut findings = vec![
        Finding::equal("energy lost by the elastic bar, N = 80, share", fine, 0.0, CONVERGING, "1"),
        Finding::at_least("that lost at N = 20 over it, of order one half at least", lost(20)? / fine, 4f64.powf(ORDER_GAP), "1"),
    ];
    for elements in MESHES {
        let (average, midpoint) = (plain(elements, Method::AverageAcceleration)?, plain(elements, Method::Midpoint)?);
        let gained = average.energies[0];
        findings.push(Finding::at_least(format!("energy by average acceleration over its start, N = {elements}"), gained, DOUBLED, "1"));
        let error = midpoint.force_error;
        findings.push(Finding::at_least(format!("error of the midpoint force in ∫|λ|, N = {elements}"), error, OSCILLATING, "1"));
    }
    let converging = |elements: usize| run(elements, Method::AverageAcceleration, !other);
    let finest = converging(80)?;
    findings.extend([
        Finding::at_least("order in Δ of the redistributed force", order(|n| Ok(converging(n)?.force_error))?, CONVERGES, "1"),
        Finding::at_most("error of the redistributed force in ∫|λ|, N = 80", finest.force_error, CONVERGING, "1"),
        Finding::at_most("energy gained by the redistributed bar, N = 80, share", finest.energies[0] - 1.0, CONVERGING * CONVERGING, "1"),
    ]);
    Ok(findings.into_iter().map(Finding::experiment).collect())
}

fn persistency(reading: Reading) -> Result<Vec<Finding>> {
    const POINT: &str = "what the papers, which were not read, prove";
    let (conserving, dissipating) =
        reading.pick((Method::Persistency, Method::Midpoint), (Method::AverageAcceleration, Method::AverageAcceleration));
    let mut findings = Vec::new();
    for elements in MESHES {
        let allowed = energy_rounding(elements);
        let [most, least] = run(elements, conserving, false)?.energies;
        let change = (most - 1.0).max(1.0 - least);
        findings.push(Finding::at_most(
            format!("largest |E/E₀ − 1| under the persistency condition, N = {elements}"),
            change,
            allowed,
            "1",
        ));
        let gain = run(elements, dissipating, false)?.gain;
        findings.push(Finding::at_most(format!("largest gain in a step of the midpoint rule, N = {elements}"), gain, allowed, "1"));
    }
    Ok(findings.into_iter().map(|finding| finding.opinion(POINT)).collect())
}
