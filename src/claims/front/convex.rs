//! Claims of the front matter on the convex relaxation: the project's module B and its scenes, the table of misconceptions.

use crate::claims::experiments::planar_step::Block;
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::BouncingBall;
use crate::mechanics::{PointMass, State};
use crate::problem::{Compliance, Coordinates, Law, Lcp};
use crate::schemes::{Anitescu, MoreauJean, Scheme, StepContext, StepProblem, Waist, passes_the_waist, simulate};
use crate::solvers::lemke::solution;
use crate::solvers::{AcceleratedProjectedGradient, Auto};
use crate::tolerance;

/// Claims on the cumulative project.
pub(super) const PREFACE: &[Claim] = &[
    Claim {
        id: "P.modB",
        statement: r"Module B: implement Anitescu's convex step with APGD and a second-order cone; measure and verify the $O(h)$ gliding,
            the speed of a block at rest on an incline being proportional to $h$.",
        verdict: ClaimVerdict::False,
        kind: Kind::Exercise,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: r"The hard convex step keeps a block with $\tan \alpha < \mu$ at rest for every $h$. What is proportional to
            $h$ is the gap $\mu h|v_t|$ of a sliding block. (A regularised convex step, as Drake's SAP, does creep proportionally to $h$.)
            One mistake, counted at S5.gliding-creep.",
        argument: r"$v = 0$ satisfies the optimality conditions of the step, see S5.gliding-creep. Measured with the scheme and the solver
            the module asks for: block of 1 kg at 20°, $\mu = 0.5$, one second in 50, 100 and 200 steps: distance 0 to rounding.",
        controls: &[r"The same scheme with the tangential softness $R_t = 1/1000$ kg⁻¹: it creeps."],
        sources: &["chapter, cumulative project, module B"],
        check: check!(block_at_rest),
    },
    Claim {
        id: "P.scenes",
        statement: "Reference scenes: (a) the bouncing ball shows robustness to Zeno, (b) a stack shows stability, penetration and jitter, \
            (c) a block on an incline verifies the gliding.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"(a) and (b) do what they are for. (c) shows the artefact of the hard relaxation only if the block slides,
            $\tan \alpha > \mu$; a block that sticks shows nothing.",
        argument: r"(a) $e = 1/2$ from 1 m: past the accumulation time the Moreau–Jean ball moves at no more than $g\,h$. (b) three blocks
            of 1, 2, 3 kg on each other, exact step: all velocities 0, the ground carries $h\,g\cdot6$ kg. (c) on the 3-4-5 slope the
            block with $\mu = 1/2$ slides with $\varphi = \mu\,h\,v_t$ exactly; with $\mu = 1$ it neither moves nor lifts off.",
        controls: &[
            r"A sticking block whose contact is softened along the tangent, $R_t = 1/1000$ kg⁻¹, in the place of the hard one: it
                creeps.",
            "An elastic ball: its impacts do not accumulate.",
            "The contact between the two lower blocks missed by the detection of collisions.",
            "Coulomb's law for the block that slides: it stays on the slope.",
        ],
        sources: &["chapter, cumulative project, reference scenes"],
        check: check!(scenes),
    },
];

/// Claims of the table of misconceptions.
pub(super) const MISCONCEPTIONS: &[Claim] = &[Claim {
    id: "M.convex-Oh",
    statement: r"Misconception: the convex relaxation loses physics. Correct: its error is $O(h)$ and vanishes with the step (convergence
        to the MDI).",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Exact,
    correct_statement: r"The error is $O(h)$ for motions that meet the contact compatibly; a tangential shock in closed contact leaves an
        $O(1)$ hop (S5.Oh-vanish).",
    argument: r"Slide from rest on the 3-4-5 slope, $\mu = 1/2$, $g = 10$ m/s²: Coulomb accelerates by $a = 2$ m/s², the relaxed step
        number $l$ by $a(1 - \varrho^l)$, $\varrho = \mu^2/(1 + \mu^2) = 1/5$. At $t = 1$ s the velocity error is $(h/2)(1 - 5^{-N})$
        exactly, $N = 1/h$, and the gap $\mu\,h\,v_t$: both halve with $h$. Given 1 m/s on level ground at $\varphi = 0$ the block is soon
        above the ground: with 500 steps a second at 103/106 of its height with 250, not at 1/2.",
    controls: &[
        r"The block given 1 m/s at the gap $\varphi = \mu\,h\,V$, where it meets the contact compatibly.",
        "Coulomb's law on the slope: no error, no gap.",
    ],
    sources: &["chapter, table of misconceptions, §5"],
    check: check!(error_of_a_slide),
}];

/// Anitescu's step with a tangential softness.
struct Regularised;

impl Scheme for Regularised {
    fn name(&self) -> String {
        "anitescu with tangential softness".into()
    }

    passes_the_waist!();
}

impl Waist for Regularised {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let mut step = Anitescu.assemble(at)?;
        if let Some(problem) = step.problem.take() {
            let rows = problem.rows_per_contact();
            let diagonal = DVector::from_fn(problem.rows(), |row, _| if row % rows == 0 { 0.0 } else { 1.0 / 1000.0 });
            let compliance = Compliance { coordinates: Coordinates::Contact, diagonal };
            step.problem = Some(problem.into_builder().compliance(compliance).build()?);
        }
        Ok(step)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        Anitescu.advance(at, velocity_post)
    }
}

fn block_at_rest(reading: Reading) -> Result<Vec<Finding>> {
    let gravity = 9.81;
    let block = PointMass::block_on_incline(1.0, gravity, 20f64.to_radians(), 0.5, 0.0);
    let start = || State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, 0.0] };
    let scheme = reading.pick(&Anitescu as &dyn Scheme, &Regularised);
    let solver = AcceleratedProjectedGradient::default();
    let mut findings = Vec::new();
    for steps in [50, 100, 200] {
        let h = 1.0 / steps as f64;
        let recording = simulate(scheme, &solver, &block, start(), h, steps)?;
        // each step leaves at most the rounding of four operations on h g and what the solver's stop allows; the sum over one second
        let bound = steps as f64 * (tolerance::rounding(4, h * gravity) + tolerance::solvers::STOP * h * gravity);
        let distance = Finding::equal(format!("distance in 1 s, h = {h}"), recording.last().position[0], 0.0, bound, "m");
        // that it slips at all: farther than any rounding
        findings.push(distance.says_at_least(4.0 * bound));
    }
    Ok(findings)
}

fn scenes(reading: Reading) -> Result<Vec<Finding>> {
    let (gravity, h) = (9.81, 1.0 / 200.0);
    let form = BouncingBall::new(gravity, 1.0, 0.5)?;
    let steps = ((form.accumulation_time() + 0.25) / h).ceil() as usize;
    let ball = PointMass::ball_on_floor(1.0, gravity, reading.only(1).pick(0.5, 1.0));
    let start = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
    let speed = simulate(&MoreauJean::default(), &Auto, &ball, start, h, steps)?.last().velocity[0].abs();
    let h = ratio(1, 100);
    let (velocities, ground) = stack(reading.only(2).pick(&[0, 1, 2][..], &[0, 2]), &h)?;
    let mut block = Block { law: reading.only(3).pick(Law::Associated, Law::Coulomb), ..Block::at_rest(ratio(1, 2)) };
    block.steps(30, &h)?;
    let own_gap = block.friction.clone() * &h * block.velocity[1].clone();
    let tangential_softness = reading.only(0).pick(ratio(0, 1), ratio(1, 1000));
    let mut sticking = Block { tangential_softness, ..Block::at_rest(ratio(1, 1)) };
    sticking.steps(30, &h)?;
    Ok(vec![
        Finding::exact("(c) φ/(μ h v_t) of the block with μ < tan α", &(block.gap / own_gap), &ratio(1, 1), "1"),
        Finding::decision("(c) the block with μ > tan α glides", sticking.velocity[1] > ratio(0, 1) || sticking.gap > ratio(0, 1), false)
            .says(true)
            .violating("the block slides"),
        Finding::at_most("(a) speed after the accumulation time", speed, gravity / 200.0, "m/s"),
        Finding::decision("(b) the stack stays at rest", velocities.iter().all(|v| *v == ratio(0, 1)), true),
        Finding::exact("(b) impulse of the ground", &ground, &ratio(6, 10), "N·s"),
    ])
}

/// Velocities and ground impulse of one step of three blocks of 1, 2 and 3 kg on each other, g = 10 m/s², with the contacts that were
/// found, from the ground up.
fn stack(found: &[usize], h: &Rational) -> Result<(DVector<Rational>, Rational)> {
    let rows = [[1, 0, 0], [-1, 1, 0], [0, -1, 1]];
    let jacobian = DMatrix::from_fn(found.len(), 3, |i, j| ratio(rows[found[i]][j], 1));
    let inverse_mass = DMatrix::from_diagonal(&DVector::from_vec(vec![ratio(1, 1), ratio(1, 2), ratio(1, 3)]));
    let free = DVector::from_element(3, -(h.clone() * ratio(10, 1)));
    let lcp = Lcp::new(&jacobian * &inverse_mass * jacobian.transpose(), &jacobian * &free);
    let impulse = solution(&lcp)?;
    Ok((free + inverse_mass * jacobian.transpose() * &impulse, impulse[0].clone()))
}

/// Velocity error against Coulomb and gap over μ h v_t, one second into a slide from rest with 1/h steps.
fn slide(law: Law, steps: i64) -> Result<(Rational, Rational)> {
    let h = ratio(1, steps);
    let mut block = Block { law, ..Block::at_rest(ratio(1, 2)) };
    block.steps(steps as usize, &h)?;
    let relative_gap = block.gap.clone() / (ratio(1, 2) * h * block.velocity[1].clone());
    Ok((ratio(2, 1) - block.velocity[1].clone(), relative_gap))
}

/// Gap 1/25 s after a block on level ground, at this gap over h, was given 1 m/s.
fn height_after_a_shock(relative_gap: &Rational, steps: i64) -> Result<Rational> {
    let h = ratio(1, steps);
    let mut block = Block {
        law: Law::Associated,
        normal_gravity: ratio(10, 1),
        tangential_gravity: ratio(0, 1),
        velocity: [ratio(0, 1), ratio(1, 1)],
        gap: relative_gap * &h,
        ..Block::at_rest(ratio(1, 2))
    };
    block.steps(steps as usize / 25, &h)?;
    Ok(block.gap)
}

fn error_of_a_slide(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.only(1).pick(Law::Associated, Law::Coulomb);
    let ((coarse, gap), (fine, _)) = (slide(law, 25)?, slide(law, 50)?);
    let start = reading.only(0).pick(ratio(0, 1), ratio(1, 2));
    let hop = height_after_a_shock(&start, 500)? / height_after_a_shock(&start, 250)?;
    let closed = |steps: i64| ratio(1, 2 * steps) * (ratio(1, 1) - (0..steps).fold(ratio(1, 1), |power, _| power * ratio(1, 5)));
    Ok(vec![
        Finding::exact("velocity error at h = 1/25", &coarse, &closed(25), "m/s"),
        Finding::exact("velocity error at h = 1/50", &fine, &closed(50), "m/s"),
        Finding::exact("gap over μ h v_t", &gap, &ratio(1, 1), "1"),
        Finding::exact("height after a tangential shock with h/2 over that with h", &hop, &ratio(103, 106), "1")
            .says_at_most(ratio(1, 2))
            .violating("the motion meets the contact compatibly"),
    ])
}
