//! Energy over an impact, M(v⁺ − v⁻) = HᵀP with P ≥ 0 acting on the bodies.
//!
//! ```text
//!     ΔT = ½ Pᵀ(U⁺ + U⁻) ,        uniform e:  ΔT = PᵀŪ/(1+e) − ½(1−e)/(1+e) PᵀWP ,   Ū = U⁺ + e U⁻ .
//! ```
//! Without friction PᵀŪ = 0. With friction PᵀŪ ≤ 0 if the law holds for all components of Ū.

use crate::claims::prelude::*;
use crate::problem::{Lcp, PlanarProblem, Response};
use crate::solvers::lemke::solution;
use num_traits::{One, Zero};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.contact-work-sign",
        statement: r"$\Delta E_\text{contact} = -\tfrac12P^T(U^+ + U^-)$ (the chapter adds: the sign depends on the convention).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, with its warning: with $P \ge 0$ and $M(v^+ - v^-) = H^TP$, the convention of the scheme in §3,
            $\Delta T = +\tfrac12P^T(U^+ + U^-)$; the minus sign belongs to $P = \int dR$ with $M(v^+ - v^-) = -H^TP$, the convention of
            §0.",
        argument: r"$\Delta T = \tfrac12(v^+ + v^-)^TM(v^+ - v^-) = \pm\tfrac12P^T(U^+ + U^-)$. Two unit masses in line at 1 and 0 m/s,
            $e = 0$: $P = 1/2$, $U^- = -1$, $U^+ = 0$, $\Delta T = -1/4 = +\tfrac12\cdot\tfrac12\cdot(-1)$.",
        controls: &["The minus sign together with the convention of §3.", "The velocity after the impact in place of the mean."],
        sources: &["chapter §3, energy change in the contact phase", "chapter §0 for the sign of dR"],
        check: check!(work_sign),
    },
    Claim {
        id: "S3.contact-diss",
        statement: r"In the Moreau–Jean frame $P^T(v^+ + e\,v^-)/2 \ge 0$ guarantees that the contact dissipates in addition ($e < 1$
            loses energy, $e = 1$ keeps it).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, for one common $e$, as the chapter writes it, a pure impact, and the law on every component if
            there is friction: $\Delta T \le -\tfrac12(1 - e)/(1 + e)\,P^TWP \le 0$, with equality without friction.",
        argument: r"$\bar U = U^+ + eU^-$ and $U^+ - U^- = WP$ give $U^+ + U^- = 2\bar U/(1 + e) - (1 - e)/(1 + e)\,WP$; complementarity
            makes $P^T\bar U = 0$ in the convention $P \ge 0$ (and the sign of the chapter's inequality is right in the convention
            $P = \int dR$). Checked in rationals on a chain of balls for $e = 0$, 1/3, 1. With $e = (1, 0)$ at the two ends of a rod,
            $W = \begin{bmatrix}1 & -1/2 \\ -1/2 & 1\end{bmatrix}$, $U^- = (-1, 1/2)$, the kinetic energy grows by 1/6 J.",
        controls: &[r"The rod with $e = (1, 0)$.", "A chain that only one sweep of Gauss–Seidel was spent on."],
        sources: &["chapter §3, energy change in the contact phase"],
        check: check!(dissipation),
    },
    Claim {
        id: "S3.moreau-diss",
        statement: r"In the Moreau–Jean frame contact dissipates in addition ($e < 1$ loses energy, $e = 1$ keeps it) (§3); Moreau's law
            treats friction by the inclusion and dissipates it automatically (§7, table).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"For one common $e$ without friction, and with friction if $v^+ + e\,v^-$ is taken in normal and tangential
            components. Newton's law on the normal component alone, combined with Coulomb friction, can gain energy.",
        argument: r"$W = \begin{bmatrix}2 & 4 \\ 4 & 9\end{bmatrix}$, $\mu = 7/4$, $e = 1$, $U^- = (-1, -2)$: with the full vector
            $P = (1, 0)$ lies in the cone, $U^+ = -U^-$ and the energy is kept; with the normal component alone $\tfrac12U^TW^{-1}U$ grows
            from 1/4 J to 9/4 J. §3 writes the argument $v^+ + e\,v^-$ whole and expands its normal component.",
        controls: &[
            "Restitution of the full vector in place of the normal component alone.",
            "Restitution of the normal component alone in place of the full vector.",
        ],
        sources: &["chapter §3 and §7", "Kane and Levinson, Dynamics: Theory and Applications, 1985, for energy gain with friction"],
        check: check!(moreau_law),
    },
];

/// An impact in contact coordinates: W and U⁻, and what came of it.
struct Impact {
    problem: PlanarProblem<Rational>,
    end: Response<Rational>,
}

impl Impact {
    /// Solves 0 ≤ U⁺ + diag(e) U⁻ ⟂ P ≥ 0 with U⁺ = U⁻ + W P.
    fn frictionless(delassus: DMatrix<Rational>, before: DVector<Rational>, restitution: &[Rational]) -> Result<Self> {
        Self::by(solution, delassus, before, restitution)
    }

    /// The same by another solver.
    fn by(solver: Solver, delassus: DMatrix<Rational>, before: DVector<Rational>, restitution: &[Rational]) -> Result<Self> {
        let shift = DVector::from_fn(before.len(), |i, _| &before[i] * &restitution[i]);
        let problem = PlanarProblem::new(delassus, before);
        let impulse = solver(&problem.shifted(&shift).frictionless())?;
        Ok(Impact { end: problem.response(impulse), problem })
    }

    /// ½ (U⁺ + U⁻).
    fn mean(&self) -> DVector<Rational> {
        (&self.end.after + &self.problem.velocity) * ratio(1, 2)
    }

    /// ½ Pᵀ(U⁺ + U⁻).
    fn work(&self) -> Rational {
        self.end.impulse.dot(&self.mean())
    }

    /// −½ (1−e)/(1+e) PᵀWP.
    fn predicted_loss(&self, restitution: &Rational) -> Rational {
        let factor = (Rational::one() - restitution) / (Rational::one() + restitution);
        -(self.end.impulse.dot(&(&self.problem.delassus * &self.end.impulse)) * factor * ratio(1, 2))
    }
}

/// What finds the impulses of an LCP.
type Solver = fn(&Lcp<Rational>) -> Result<DVector<Rational>>;

/// One sweep of Gauss–Seidel from zero impulses.
fn one_sweep(lcp: &Lcp<Rational>) -> Result<DVector<Rational>> {
    let mut impulse = DVector::from_element(lcp.size(), Rational::zero());
    for row in 0..lcp.size() {
        let rate = lcp.matrix.row(row).transpose().dot(&impulse) + &lcp.vector[row];
        impulse[row] = (-rate / &lcp.matrix[(row, row)]).max(Rational::zero());
    }
    Ok(impulse)
}

fn integers(rows: usize, columns: usize, entries: &[i64]) -> DMatrix<Rational> {
    DMatrix::from_row_slice(rows, columns, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>())
}

fn vector(entries: &[Rational]) -> DVector<Rational> {
    DVector::from_vec(entries.to_vec())
}

fn work_sign(reading: Reading) -> Result<Vec<Finding>> {
    // unit masses at 1 and 0 m/s, H = (−1, 1), e = 0: P = 1/2
    let impact = Impact::frictionless(integers(1, 1, &[2]), vector(&[ratio(-1, 1)]), &[ratio(0, 1)])?;
    let kinetic = |velocities: [Rational; 2]| velocities.iter().map(|v| v * v * ratio(1, 2)).fold(Rational::zero(), |a, b| a + b);
    let push = impact.end.impulse[0].clone();
    let change = kinetic([ratio(1, 1) - &push, push.clone()]) - kinetic([ratio(1, 1), ratio(0, 1)]);
    // P = ∫dR is minus the impulse on the bodies
    let in_convention = reading.only(0).pick(-push.clone(), push.clone());
    let velocity = reading.only(1).pick(impact.mean()[0].clone(), impact.end.after[0].clone());
    Ok(vec![
        Finding::exact("−½P(U⁺ + U⁻) in the convention of P", &-(in_convention * &velocity), &change, "J"),
        Finding::exact("+½P(U⁺ + U⁻) in the other convention, P ≥ 0 on the bodies", &(push * velocity), &change, "J"),
    ])
}

fn dissipation(reading: Reading) -> Result<Vec<Finding>> {
    let rod = DMatrix::from_row_slice(2, 2, &[ratio(1, 1), ratio(-1, 2), ratio(-1, 2), ratio(1, 1)]);
    let ends = vector(&[ratio(-1, 1), ratio(1, 2)]);
    let uneven = [ratio(1, 1), ratio(0, 1)];
    let restitution = reading.only(0).pick([ratio(1, 2), ratio(1, 2)], uneven.clone());
    let struck = Impact::frictionless(rod.clone(), ends.clone(), &restitution)?;
    let gain = Impact::frictionless(rod, ends, &uneven)?.work();
    let mut findings = vec![
        Finding::decision("the rod gains no energy", struck.work() <= Rational::zero(), true),
        Finding::exact("energy that it gains with e = (1, 0)", &gain, &ratio(1, 6), "J").context(),
    ];
    // chain of balls of 1, 1/2 and 1/3 kg: W has 1/m sums on the diagonal and −1/m between neighbours
    let chain = integers(2, 2, &[3, -2, -2, 5]);
    let solver: Solver = reading.only(1).pick(solution, one_sweep);
    for e in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
        let impact = Impact::by(solver, chain.clone(), vector(&[ratio(-3, 1), ratio(1, 2)]), &[e.clone(), e.clone()])?;
        findings.push(Finding::exact(format!("ΔT, e = {e}, against −½(1−e)/(1+e) PᵀWP"), &impact.work(), &impact.predicted_loss(&e), "J"));
    }
    Ok(findings)
}

/// Planar Coulomb impact with restitution e on the components given by `reversed`, as a Stewart–Trinkle LCP with d = 2.
fn frictional(delassus: &DMatrix<Rational>, before: &DVector<Rational>, mu: &Rational, shift: &DVector<Rational>) -> Result<Impact> {
    let problem = PlanarProblem::new(delassus.clone(), before.clone());
    let impulse = problem.shifted(shift).coulomb(std::slice::from_ref(mu))?.solve()?;
    Ok(Impact { end: problem.response(impulse), problem })
}

fn moreau_law(reading: Reading) -> Result<Vec<Finding>> {
    let delassus = integers(2, 2, &[2, 4, 4, 9]);
    let (before, mu) = (vector(&[ratio(-1, 1), ratio(-2, 1)]), ratio(7, 4));
    let normal_only = vector(&[before[0].clone(), Rational::zero()]);
    let reversed = reading.only(1).pick(before.clone(), normal_only.clone());
    let full = frictional(&delassus, &before, &mu, &reversed)?;
    let partly = frictional(&delassus, &before, &mu, &(reversed * ratio(1, 2)))?;
    let subject = frictional(&delassus, &before, &mu, &reading.only(0).pick(normal_only, before.clone()))?;
    // T in contact coordinates: ½UᵀW⁻¹U with W⁻¹ = [[9, −4], [−4, 2]]/2
    let inverse = integers(2, 2, &[9, -4, -4, 2]) * ratio(1, 2);
    let energy = |u: &DVector<Rational>| u.dot(&(&inverse * u)) * ratio(1, 2);
    let (whole, alone) = ("v⁺ + e v⁻ in all components", "v⁺ + e v⁻ in the normal component alone");
    Ok(vec![
        Finding::exact("energy gained in the frictional impact with e = 1, all components", &full.work(), &Rational::zero(), "J")
            .reading(whole),
        Finding::decision("energy is lost with e = 1/2, all components", partly.work() < Rational::zero(), true).reading(whole),
        Finding::exact("energy gained with e = 1 of the normal component alone", &subject.work(), &ratio(2, 1), "J")
            .says_at_most(ratio(0, 1))
            .reading(alone),
        Finding::exact("kinetic energy after that impact", &energy(&subject.end.after), &ratio(9, 4), "J")
            .says_at_most(ratio(1, 4))
            .reading(alone),
        Finding::exact("kinetic energy before it", &energy(&before), &ratio(1, 4), "J").context(),
    ])
}
