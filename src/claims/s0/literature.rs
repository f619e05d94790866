//! §0, the literature it leans on: a survey, a book on smooth systems, and variational integrators with contact.

use super::runge_kutta::{Impacts, Norm, order};
use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::identifiers::issn_agrees;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::integrators::Phase;
use crate::integrators::jacobian::jacobian;
use crate::integrators::symplectic::{defect, volume};
use crate::integrators::variational::{Guess, ScalarField, Variational};
use crate::scalar::{Dual, Rational, Scalar, ratio};
use crate::tolerance::claims::ORDER_GAP;
use nalgebra::{DMatrix, DVector};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.siamrev",
        statement: "Stewart's survey of the branch is SIAM Review 42:3 (2000).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "Volume 42 (issue 1), pages 3–39, 2000; 3 is the first page, not an issue.",
        argument: "The record in HAL and the DOI 10.1137/S0036144599360110, whose letters S0036-1445 are the journal's ISSN: its check \
            digit agrees. SIAM Review counts one volume a year from 1959 on, so that 2000 is volume 42.",
        control: "2001, as one secondary list has it.",
        sources: &["chapter §0, three kinds of integrators", "HAL hal-01570533"],
        check: survey,
    },
    Claim {
        id: "S0.hlw",
        statement: "Hairer, Lubich and Wanner's book of 644 pages assumes smooth Hamiltonian systems throughout; on solutions of bounded \
            variation its error estimates say nothing.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "Neither the number of pages nor the contents were checked. What can be decided is that an estimate for smooth \
            systems carries over exactly where the motion is smooth: the order of a method is kept by locating the impact, and lost by \
            stepping over it.",
        argument: "Runge–Kutta on a ball on a spring through three impacts, closed form by arcs: order 4 with the impacts located, order 1 \
            with the velocity flipped at the end of the step.",
        control: "The flip expected to keep order 4.",
        sources: &["chapter §0, (a) solutions of bounded variation"],
        check: smooth_pieces,
    },
    Claim {
        id: "S0.fetecau",
        statement: "Variational integrators can be extended to contact (Fetecau, Marsden, West and Ortiz 2003: a discretisation of \
            collisions that keeps the symplectic form), but are used less, because symplecticity and the correction of penetration exclude \
            each other.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "To elastic impacts without friction (Fetecau, Marsden, Ortiz and West): there the step through the impact is \
            symplectic. With e < 1 no integrator that follows the motion can be, since the motion is not: its determinant is e². Why the \
            method is used less is not decidable.",
        argument: "Unit mass, g = 2, h = 1/2, hit after 1/4: DᵀJD − J = 0 of the variational step, exactly. The same with the velocity \
            after the step times 4/5: the determinant is 4/5.",
        control: "The step that keeps 4/5 of the velocity.",
        sources: &["chapter §0, variational integrators", "Fetecau, Marsden, Ortiz and West, SIAM J. Appl. Dyn. Syst. 2 (2003) 381"],
        check: variational,
    },
];

fn survey(reading: Reading) -> Result<Vec<Finding>> {
    let year: usize = reading.pick(2000, 2001);
    Ok(vec![
        Finding::count("volume of SIAM Review in that year", year - 1958, 42),
        Finding::decision("the ISSN in the DOI agrees with its check digit", issn_agrees("0036-1445"), true),
    ])
}

fn smooth_pieces(reading: Reading) -> Result<Vec<Finding>> {
    let through = |impacts| order(impacts, Norm::EndPosition, 3);
    let kept = through(reading.pick(Impacts::Located, Impacts::Flipped))?;
    let lost = through(Impacts::Flipped)?;
    Ok(vec![
        Finding::equal("order through three located impacts", kept.slope, 4.0, ORDER_GAP, "1"),
        Finding::equal("order through three flips", lost.slope, 1.0, ORDER_GAP, "1"),
    ])
}

/// q, as gap and, times 2, as potential.
#[derive(Clone, Copy)]
struct Height(i64);

impl ScalarField for Height {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        position[0].clone() * T::ratio(self.0, 1)
    }
}

fn variational(reading: Reading) -> Result<Vec<Finding>> {
    let integrator = Variational { potential: Height(2), gap: Height(1) };
    // built backwards from the impact: v = −1, q = ¼(1 + ¼), arriving at −3/2 and leaving at 3/2
    let start = Phase::of_one(ratio(5, 16), ratio(-1, 1));
    let (time, h) = (ratio(1, 4), ratio(1, 2));
    let guess = Guess { time: Dual::constant(time), jump: Dual::constant(ratio(3, 1)), newton_steps: 1 };
    let kept = reading.pick(ratio(1, 1), ratio(4, 5));
    let step = jacobian(&start.stacked(), |x: &DVector<Dual<Rational>>| {
        let after = integrator.step_with_impact(&Phase::from_stacked(x), &Dual::constant(h.clone()), &guess);
        Phase { velocity: after.velocity * Dual::constant(kept.clone()), ..after }.stacked()
    });
    let lost = defect(&step, &DMatrix::identity(1, 1)).iter().filter(|entry| **entry != ratio(0, 1)).count();
    Ok(vec![
        Finding::count("entries of DᵀJD − J that do not vanish", lost, 0),
        Finding::exact("determinant of the step", &volume(&step), &ratio(1, 1), "1"),
    ])
}
