//! Where energy comes from and where it goes.

use crate::claims::experiments::floors::{Floor, elastic_invariant, first_impact};
use crate::claims::experiments::push_out::{biased_gain, elastic_drop, projected_gain};
use crate::claims::experiments::rod::energy_gained;
use crate::claims::experiments::spring::{energy_ratio, explicit_peak, semi_implicit_peak};
use crate::claims::experiments::tower::energy_of_stale_impulses;
use crate::claims::prelude::*;
use crate::schemes::{Activation, RestitutionRule};
use crate::tolerance;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.energy-up-causes",
        statement: "Energy that grows usually comes from explicit components or from Baumgarte's injection: use a (semi-)implicit scheme, \
            and projection instead of Baumgarte.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Advice,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"The two causes inject, and a semi-implicit scheme cures the first. Projection cures the second on a joint and
            without load; a contact under load it lifts, $m\,g\,\delta$ (S9.projection-energy). Besides these usual causes: Newton's $e$
            on the normal component with Coulomb friction, impulses of the step before that too few sweeps have not corrected, and a
            contact too stiff for its step (S9.jitter).",
        argument: r"Explicit Euler on a spring with $h\omega = 1/10$: 101/100 per step; semi-implicit Euler stays below 1/0.95 of its
            start. Baumgarte: 9/125000 J for 1 mm (S9.baumgarte-inject). Projection: 81/80. Neither explicit nor Baumgarte: the rod with
            $W = (5, -3; -3, 5)/2$, $u^- = (-1, 3/5)$, $\mu = 1$, $e = 1$ gains 9/80 J; a tower of three whose load is taken away, one
            warm-started sweep: $11/16\,(g\,h)^2\,J$ out of rest.",
        controls: &[
            r"The activation $\varphi + h\,v_\text{free} \le 0$, under which the ball is never projected.",
            "The causes and the cures exchanged: explicit and semi-implicit, Baumgarte and projection.",
        ],
        sources: &["chapter §9, energy drift", "Kane and Levinson 1985; Stronge 1991 for energy gain with friction"],
        check: check!(causes_of_growth),
    },
    Claim {
        id: "S9.energy-down",
        statement: r"Too much loss of energy comes from $\theta = 1$ or large numerical damping: use $\theta = 1/2$, reduce the damping.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Advice,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"True of forces that depend on the state (springs): $E^+/E = 1/(1 + h^2\omega^2)$ at $\theta = 1$ and 1 at
            $\theta = 1/2$. Under gravity and on a hard floor $\theta$ has no effect in the long run:
            $E - (\theta - \tfrac12)\,m\,g\,h\,v$ is conserved, and an impact keeps $e^2$ of the kinetic energy, for every $\theta$.",
        argument: r"Spring, $h\omega = 1/10$: 100/101 per step at $\theta = 1$, 1 at $\theta = 1/2$. Elastic ball from 1 m, $h = 1/100$ s,
            2000 steps with $\theta = 1$: $(E - \tfrac12\,g\,h\,v)/E_0 = 1$ exactly. Ball with $e = 1/2$: the first impact keeps 1/4 of
            $\tfrac12v^2$ with $\theta = 1$ and with $\theta = 1/2$. On a soft floor, $h\omega = 1/5$, less is left of both at
            $\theta = 1$.",
        controls: &[
            "A soft floor, whose force depends on the state, in place of the hard one.",
            r"$\theta = 1/2$ and $\theta = 1$ exchanged on the spring.",
        ],
        sources: &["chapter §9, energy drift", "S3.energy-runs-down"],
        check: check!(causes_of_loss),
    },
];

fn causes_of_growth(reading: Reading) -> Result<Vec<Finding>> {
    let rule = reading.only(0).pick(Activation::Gap, Activation::FreeVelocityForecast);
    let none = ratio(0, 1);
    let gains = [projected_gain(&none)[0].clone(), biased_gain(&ratio(1, 5), &none)[0].clone()];
    let [by_projection, by_baumgarte] = reading.only(1).pick(gains.clone(), [gains[1].clone(), gains[0].clone()]);
    let peak = reading.only(1).pick(semi_implicit_peak(1000), explicit_peak(1000));
    let explicit = reading.only(1).pick(ratio(0, 1), ratio(1, 2));
    let projected = elastic_drop::<Rational>(rule, true);
    let rod = energy_gained(&ratio(1, 1), RestitutionRule::NormalOnly)?;
    let (stale, width) = (energy_of_stale_impulses(1)?, tolerance::rounding(64, 1.0));
    let bound = 1.0 / 0.95 + tolerance::rounding(8000, 1.0);
    Ok(vec![
        Finding::exact("E(20 s)/E(0) with projection", &projected.energy, &ratio(81, 80), "1")
            .says(ratio(1, 1))
            .violating("a joint, or a contact without load"),
        Finding::exact("kinetic energy from projection without load", &by_projection, &none, "J"),
        Finding::at_most("largest E/E₀ of 1000 semi-implicit steps on a spring", peak, bound, "1"),
        // unusual causes, of which the sentence does not speak
        Finding::exact("energy gained by a rod, implicit step, no Baumgarte, e = 1, μ = 1", &rod, &ratio(9, 80), "J").context(),
        Finding::equal("kinetic energy from stale impulses over (g h)²", stale, 11.0 / 16.0, width, "kg").context(),
        Finding::exact("E⁺/E of an explicit step on a spring", &energy_ratio(&explicit, 1), &ratio(101, 100), "1"),
        Finding::exact("kinetic energy from Baumgarte", &by_baumgarte, &ratio(9, 125_000), "J"),
    ])
}

fn causes_of_loss(reading: Reading) -> Result<Vec<Finding>> {
    const MET: &str = "forces that depend on the state";
    let (half, one) = (ratio(1, 2), ratio(1, 1));
    // E − ½ g h v after 2000 steps with θ = 1, and what an impact with e = 1/2 keeps at θ = 1 and θ = 1/2
    let floor = reading.only(0).pick(Floor::Hard, Floor::Soft);
    let [kept, impact, cured] = [elastic_invariant(floor), first_impact(floor, &one), first_impact(floor, &half)];
    let [damped, neutral] = reading.only(1).pick([&one, &half], [&half, &one]);
    Ok(vec![
        Finding::decision("2000 steps with θ = 1 have taken from E − ½ g h v of an elastic ball", kept < one, false)
            .says(true)
            .violating(MET),
        Finding::decision("θ = 1/2 keeps more of the energy of an impact with e = 1/2 than θ = 1", cured > impact, false)
            .says(true)
            .violating(MET),
        Finding::exact("kinetic energy kept by an impact, e = 1/2, θ = 1/2", &cured, &ratio(1, 4), "1").context(),
        Finding::exact("E⁺/E on a spring, θ = 1", &energy_ratio(damped, 1), &ratio(100, 101), "1"),
        Finding::exact("E/E₀ on a spring after 20 steps, θ = 1/2", &energy_ratio(neutral, 20), &ratio(1, 1), "1"),
    ])
}
