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
        statement: "The convergence proof of rigid-body time-stepping does not carry over to flexible bodies and finite elements: discrete \
            elastic waves with contact easily bring a numerical drift of energy, which needs integrators of its own.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated, seen on a bar that hits a wall. The solution is of another kind (a finite force ρcAV over 2L/c, e = \
            1, no atom), refining the mesh changes the finite-dimensional problem, and what is proved for each mesh says nothing of the \
            limit of the force.",
        argument: "Mesh of 20 to 80 elements, h = Δ/(2c), plastic law at the node. Midpoint: the energy lost is 1/31 at N = 20 and \
            proportional to Δ, where a rigid body loses all; its force is off by 0.88 of the true impulse at every N. \
            Average acceleration multiplies the energy by 4 and more. With the end's mass redistributed the force converges and the energy \
            stays within 3·10⁻⁴.",
        controls: &["A bar of two elements, which is nearly a rigid body."],
        sources: &[
            "chapter §11, infinite-dimensional extension and pitfalls",
            "Khenous, Laborde and Renard, Mass redistribution method (2008)",
            "Doyen, Ern and Piperno (2011)",
        ],
        check: bar,
    },
    Claim {
        id: "S11.fem-refs",
        statement: "Laursen and Chawla (1997) and Laursen and Love (2002) construct energy–momentum conserving finite-element integrators \
            for impact; Hauret and Le Tallec (2006) estimate the dissipation; Hesch and Betsch treat contact in the same spirit.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "Citations without a statement to decide; the papers were not read. What the first two names stand for is \
            checked: the persistency condition keeps the energy, at the price of a penetration of a step and of a force that oscillates.",
        argument: "Midpoint with 0 ≤ λ ⟂ u⁺ − u ≥ 0 once closed: ΔE = λ(u⁺ − u) = 0 in every step, to rounding, at N = 20, 40, 80. Without \
            it ΔE ≤ 0 in every step.",
        controls: &["Average acceleration in place of the persistency condition."],
        sources: &[
            "chapter §11, infinite-dimensional extension",
            "Laursen and Chawla 1997, Laursen and Love 2002, Hauret and Le Tallec 2006 (not read)",
        ],
        check: persistency,
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
    let lost = |elements: usize| Ok(1.0 - run(elements, Method::Midpoint, false)?.energies[1]);
    let fine = reading.pick(80, 2);
    let mut findings = vec![
        Finding::equal(format!("energy lost by the elastic bar, N = {fine}, share"), lost(fine)?, 0.0, CONVERGING, "1"),
        Finding::equal("order in Δ of that loss", order(lost)?, 1.0, ORDER_GAP, "1"),
    ];
    for elements in MESHES {
        let average = run(elements, Method::AverageAcceleration, false)?;
        findings.push(Finding::at_least(
            format!("energy by average acceleration over its start, N = {elements}"),
            average.energies[0],
            DOUBLED,
            "1",
        ));
        let midpoint = run(elements, Method::Midpoint, false)?;
        findings.push(Finding::at_least(
            format!("error of the midpoint force in ∫|λ|, N = {elements}"),
            midpoint.force_error,
            OSCILLATING,
            "1",
        ));
    }
    let redistributed = |elements: usize| run(elements, Method::AverageAcceleration, true);
    findings.push(Finding::at_least(
        "order in Δ of the redistributed force",
        order(|n| Ok(redistributed(n)?.force_error))?,
        CONVERGES,
        "1",
    ));
    let finest = redistributed(80)?;
    findings.push(Finding::at_most("error of the redistributed force in ∫|λ|, N = 80", finest.force_error, CONVERGING, "1"));
    findings.push(Finding::equal(
        "energy of the redistributed bar over its start, N = 80",
        finest.energies[0],
        1.0,
        CONVERGING * CONVERGING,
        "1",
    ));
    Ok(findings)
}

fn persistency(reading: Reading) -> Result<Vec<Finding>> {
    let method = reading.pick(Method::Persistency, Method::AverageAcceleration);
    let mut findings = Vec::new();
    for elements in MESHES {
        let allowed = energy_rounding(elements);
        let kept = run(elements, method, false)?;
        for (name, energy) in ["largest", "smallest"].iter().zip(kept.energies) {
            findings.push(Finding::equal(format!("{name} energy over its start, N = {elements}"), energy, 1.0, allowed, "1"));
        }
        let dissipating = run(elements, Method::Midpoint, false)?;
        findings.push(Finding::at_most(
            format!("largest gain in a step of the midpoint rule, N = {elements}"),
            dissipating.gain,
            allowed,
            "1",
        ));
    }
    Ok(findings)
}
