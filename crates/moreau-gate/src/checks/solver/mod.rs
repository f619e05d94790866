//! Solutions of contact problems: level `solve`. An answer is judged by its residuals, never by the impulses it chose.
//!
//! ```text
//!     r ∈ K   [N·s] ,    ŷ ∈ K*   [m/s] ,    r·ŷ = 0   [J] ,    r = P_K(r − ρ ŷ)   [N·s] ,    u = W r + u_free   [m/s]
//! ```
//! Each residual is relative to the scale of its unit and may be √ε. Every problem is posed under each of the laws `frictionless`,
//! `coulomb` and `associated` that the engine lists.

mod asked;
mod impossible;
mod posed;
mod problems;

use crate::check::{Control, Run};
use crate::checks::scenery::worst;
use crate::tolerance::solver as tolerance;
use crate::{Bench, Check, Expectation, Level, Measurement, Refusal, Reply};
use asked::laws;
use moreau_contact::certificate::residuals::{Residuals, residuals};
use moreau_contact::problem::Law;
use problems::Solved;

const MANUFACTURED: &str = "The velocities after the step and the impulses are chosen, then the velocity without impulses: a solution \
    exists by \
                            construction. A solver that knows an energy to ε knows impulses and velocities to √ε of their scale. A problem \
                            answered with an error was not solved; it is counted, and the residuals are those of the others.";

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "solver/certificate",
        level: Level::Solve,
        question: "Are small problems solved whose contacts stick, slide and open, with restitution in the shift?",
        derivation: "As for the other problems, the velocities and the impulses are chosen first. Here the velocity is unique: with one \
            contact on a point mass, ‖Δu‖ ≤ b + √(2b) for residuals b = √ε.",
        source: "chapter §4 and §5; residuals as in the certificate",
        run: Run::Once(|bench| certified(bench, posed::small, true)),
        control: Control { passes: "moreau-jean", fails: "solver/no-impulse" },
    },
    Check {
        name: "solver/redundant",
        level: Level::Solve,
        question: "Are plates on four and eight contacts solved, where W has rank 6 and the impulses are not determined?",
        derivation: MANUFACTURED,
        source: "only u and W r are determined; raw impulses are never compared",
        run: Run::Once(|bench| certified(bench, posed::redundant, false)),
        control: Control { passes: "moreau-jean", fails: "solver/three-sweeps" },
    },
    Check {
        name: "solver/jamming",
        level: Level::Solve,
        question: "Are bodies solved that are wedged between walls, where the friction cones hold a line and impulses are unbounded?",
        derivation: MANUFACTURED,
        source: "chapter §4: with gaps ≥ 0 a solution exists whatever the friction, although the cone is not pointed",
        run: Run::Once(|bench| certified(bench, posed::jamming, false)),
        control: Control { passes: "moreau-jean", fails: "solver/normal-impulses-clipped" },
    },
    Check {
        name: "solver/friction-range",
        level: Level::Solve,
        question: "Are plates solved with friction coefficients from 0 to 10?",
        derivation: MANUFACTURED,
        source: "Coulomb's law is posed for every μ ≥ 0",
        run: Run::Once(|bench| certified(bench, posed::friction_range, false)),
        control: Control { passes: "moreau-jean", fails: "solver/convex-relaxation" },
    },
    Check {
        name: "solver/conditioning",
        level: Level::Solve,
        question: "Are problems solved whose W has condition numbers up to 10¹²?",
        derivation: MANUFACTURED,
        source: "contacts 10⁻⁶ m apart on one body; masses of 1 : 1000 on each other and of 1 : 10¹² side by side",
        run: Run::Once(|bench| certified(bench, posed::ill_conditioned, false)),
        control: Control { passes: "moreau-jean", fails: "solver/three-sweeps" },
    },
    Check {
        name: "solver/infeasible",
        level: Level::Solve,
        question: "Is the answer to a problem without solution honest: either a refusal, or a velocity that belongs to the impulses?",
        derivation: "A point pressed by two opposite walls at once: y₁ + y₂ = u₁ + u₂ − 2 s = −2 s < 0 for every r, so no answer satisfies \
                     y ≥ 0. Whatever r is returned, u must be W r + u_free, up to √ε and the rounding of the product; then every \
                     reader sees the violation. An error or `unsupported` is honest.",
        source: "Farkas: λ = (1, 1) has Wλ = 0 and λᵀq < 0",
        run: Run::Once(impossible::run),
        control: Control { passes: "moreau-jean", fails: "solver/velocity-as-wished" },
    },
];

/// The problems of a check under one law.
type Posed = fn(Law) -> moreau_exact::Result<Vec<Solved>>;

/// Every problem with a solution, for the test that proves their witnesses.
#[cfg(test)]
fn every_problem() -> Vec<Solved> {
    let all: [Posed; 5] = [posed::small, posed::redundant, posed::jamming, posed::friction_range, posed::ill_conditioned];
    all.iter().flat_map(|posed| problems::LAWS.map(|law| posed(law).expect("valid problems"))).flatten().collect()
}

fn certified(bench: &mut Bench, posed: Posed, unique: bool) -> Reply<Vec<Measurement>> {
    let (mut largest, mut off) = ([0.0; 5], 0.0);
    let (mut solved, mut refused) = (0, Vec::new());
    for law in laws(bench)? {
        for Solved { problem, witness } in posed(law).map_err(Refusal::errored)? {
            let solution = match bench.solve(&problem) {
                Err(Refusal::Errored(cause)) if bench.in_conversation() => {
                    refused.push((problem.name().to_string(), cause));
                    continue;
                }
                answer => answer?,
            };
            solved += 1;
            let found = residuals(&problem, &solution).map_err(Refusal::errored)?;
            for (largest, value) in largest.iter_mut().zip(relative(&found)) {
                *largest = worst(*largest, value);
            }
            let known = problem.velocity(&witness);
            off = worst(off, relative_to((&solution.velocity - known).norm(), found.velocity_scale));
        }
    }
    if let (0, Some((name, cause))) = (solved, refused.first()) {
        return Err(Refusal::Errored(format!("no problem got an answer; {name}: {cause}")));
    }
    let allowed = tolerance::residual(bench.epsilon());
    let words = [
        "distance of impulses from the cone",
        "distance of velocities from the dual cone",
        "complementarity",
        "natural map",
        "u − (W r + u_free)",
    ];
    let residual = |(words, value): (&str, f64)| {
        Measurement::new(
            format!("largest residual over its scale: {words}"),
            "1",
            value,
            Expectation::at_most(0.0, allowed, "a solution, to √ε"),
        )
    };
    let mut measurements: Vec<Measurement> = words.into_iter().zip(largest).map(residual).collect();
    measurements.push(unanswered(&refused));
    if unique {
        let ideal = Expectation::at_most(0.0, tolerance::known_velocity(bench.epsilon()), "the only velocity, for residuals of √ε");
        measurements.push(Measurement::new("largest difference from the known velocity over its scale", "1", off, ideal));
    }
    Ok(measurements)
}

/// How many problems were answered with an error, with their names and the first one's message.
fn unanswered(refused: &[(String, String)]) -> Measurement {
    let names: Vec<&str> = refused.iter().map(|(name, _)| name.as_str()).collect();
    let why = match refused.first() {
        None => "every problem has a solution".to_string(),
        Some((_, cause)) => format!("every problem has a solution; not solved: {} ({cause})", names.join("; ")),
    };
    Measurement::new("problems that were answered with an error", "1", refused.len() as f64, Expectation::equal(0.0, 0.0, why))
}

/// The residuals relative to their scales; the natural map's scale does not vanish with r.
fn relative(found: &Residuals) -> [f64; 5] {
    let (impulse, velocity) = (found.natural_map_scale, found.velocity_scale);
    [
        relative_to(found.primal, impulse),
        relative_to(found.dual, velocity),
        relative_to(found.complementarity, impulse * velocity),
        relative_to(found.natural_map, impulse),
        relative_to(found.velocity, velocity),
    ]
}

/// value/scale, 0 for 0/0; finite, so that a report can hold it, unless the value is not.
fn relative_to(value: f64, scale: f64) -> f64 {
    if value == 0.0 {
        0.0
    } else if value.is_finite() {
        (value / scale).min(f64::MAX)
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Description, Engine, Options, Verdict, own};
    use moreau_contact::problem::{ContactProblem, Solution};

    /// Our solver, which gives up on some problems: by an error, or by going away.
    struct GivesUp {
        on: fn(&str) -> bool,
        gone: bool,
    }

    impl Engine for GivesUp {
        fn describe(&mut self, options: &Options) -> Reply<Description> {
            own::by_name("moreau-jean").expect("our scheme").describe(options)
        }

        fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution> {
            if (self.on)(problem.name()) {
                return Err(Refusal::errored("no convergence"));
            }
            own::by_name("moreau-jean").expect("our scheme").solve(problem, options)
        }

        fn in_conversation(&self) -> bool {
            !self.gone
        }
    }

    fn judged(on: fn(&str) -> bool, gone: bool) -> Reply<Vec<Measurement>> {
        let (mut engine, options) = (GivesUp { on, gone }, Options::new());
        let description = engine.describe(&options).expect("a description");
        certified(&mut Bench::new(&mut engine, &description, &options), posed::small, true)
    }

    #[test]
    fn a_problem_answered_with_an_error_is_counted_and_named_and_the_others_are_judged() {
        let measured = judged(|name| name.starts_with("a point: slide, shift 0,"), false).expect("measurements");
        let bad: Vec<&Measurement> = measured.iter().filter(|one| one.verdict() == Verdict::Fail).collect();
        assert_eq!(bad.len(), 1);
        // in two and three dimensions, under three laws
        assert_eq!(bad[0].value, 6.0);
        assert!(bad[0].ideal.why.contains("slide") && bad[0].ideal.why.contains("no convergence"), "{}", bad[0].ideal.why);
    }

    #[test]
    fn an_engine_that_answers_nothing_or_goes_away_has_erred() {
        assert!(matches!(judged(|_| true, false), Err(Refusal::Errored(_))));
        assert!(matches!(judged(|name| name.contains("slide"), true), Err(Refusal::Errored(_))));
    }
}
