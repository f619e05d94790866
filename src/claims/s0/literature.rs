//! §0, the literature it leans on: a survey, a book on smooth systems, and variational integrators with contact.

use crate::claims::experiments::runge_kutta::{Impacts, Norm, order};
use crate::claims::lookups::looked_up;
use crate::claims::prelude::*;
use crate::integrators::Phase;
use crate::integrators::jacobian::jacobian;
use crate::integrators::symplectic::{defect, volume};
use crate::integrators::variational::{Guess, ScalarField, Variational};
use crate::scalar::Dual;
use crate::tolerance::claims::ORDER_GAP;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.siamrev",
        statement: "Stewart's survey of the branch is SIAM Review 42:3 (2000).",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated: volume 42 (issue 1), 2000; 3 is the first page, as in the chapter's other references \
            (64:1079, 49:1295), not an issue.",
        argument: "Volume, first page and year of the record, which was read on the title page and in HAL, are the printed ones.",
        controls: &["The record of Anitescu's paper of 2006."],
        sources: &[
            "chapter §0, three kinds of integrators",
            "HAL hal-01570533; title page of the paper: SIAM Review, Vol. 42, No. 1, pp. 3–39, 2000, DOI 10.1137/S0036144599360110",
        ],
        check: looked_up!("S0.siamrev"),
    },
    Claim {
        id: "S0.hlw",
        statement: r"Hairer, Lubich and Wanner's book of 644 pages assumes smooth Hamiltonian systems throughout; all its error estimates
            need $f \in C^k$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated of the estimates: where $f$ is smooth between the nodes a method has its order, where $f$ jumps
            within a step it has not. Neither the number of pages nor the contents of the book were checked. (What follows for solutions
            of bounded variation is S0.order-meaningless.)",
        argument: r"Runge–Kutta on a ball on a spring through three impacts, closed form by arcs: order 4 with the impacts located, so
            that $f$ is smooth in every step; order 1 with the velocity flipped at the end of the step, within which it jumps.",
        controls: &["The flip and the located impacts exchanged."],
        sources: &["chapter §0, (a) solutions of bounded variation"],
        check: check!(smooth_pieces),
    },
    Claim {
        id: "S0.fetecau",
        statement: "Variational integrators can be extended to contact (Fetecau, Marsden, West and Ortiz 2003: a discretisation of \
            collisions that keeps the symplectic form, see §8), but are used less, because symplecticity and the correction of \
            penetration exclude each other.",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, with the condition of §8: elastic impacts ($e = 1$) without friction (Fetecau, Marsden, Ortiz and
            West, in this order). There the step through the impact is symplectic, and a step whose position is then set onto the surface
            is not. With $e < 1$ no integrator that follows the motion can be, since the motion is not: its determinant is $e^2$. How much
            the method is used, and why, was not examined.",
        argument: r"Unit mass, $g = 2$, $h = 1/2$, hit after 1/4: $D^TJD - J = 0$ of the variational step, exactly. The same with the
            velocity after the step times 4/5: the determinant is 4/5. With the position after the step set to 0, the determinant is 0.",
        controls: &["The step that keeps 4/5 of the velocity.", "The position left where it is in the place of that set onto the surface."],
        sources: &["chapter §0, variational integrators", "Fetecau, Marsden, Ortiz and West, SIAM J. Appl. Dyn. Syst. 2 (2003) 381"],
        check: check!(variational),
    },
];

fn smooth_pieces(reading: Reading) -> Result<Vec<Finding>> {
    let through = |impacts| order(impacts, Norm::EndPosition, 3);
    let (smooth, broken) = reading.pick((Impacts::Located, Impacts::Flipped), (Impacts::Flipped, Impacts::Located));
    Ok(vec![
        Finding::equal("order through three located impacts, f smooth in every step", through(smooth)?.slope, 4.0, ORDER_GAP, "1")
            .experiment(),
        Finding::equal("order through three flips, v jumps within a step", through(broken)?.slope, 1.0, ORDER_GAP, "1").experiment(),
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
    let kept = reading.only(0).pick(ratio(1, 1), ratio(4, 5));
    let place = |share: Rational| {
        jacobian(&start.stacked(), |x: &DVector<Dual<Rational>>| {
            let after = integrator.step_with_impact(&Phase::from_stacked(x), &Dual::constant(h.clone()), &guess);
            let position = after.position * Dual::constant(share.clone());
            Phase { position, velocity: after.velocity * Dual::constant(kept.clone()) }.stacked()
        })
    };
    let (step, corrected) = (place(ratio(1, 1)), place(reading.only(1).pick(ratio(0, 1), ratio(1, 1))));
    let lost = defect(&step, &DMatrix::identity(1, 1)).iter().filter(|entry| **entry != ratio(0, 1)).count();
    Ok(vec![
        Finding::count("entries of DᵀJD − J that do not vanish", lost, 0),
        Finding::exact("determinant of the step", &volume(&step), &ratio(1, 1), "1"),
        Finding::decision("it is 1 if the position is then set onto the surface", volume(&corrected) == ratio(1, 1), false),
    ])
}
