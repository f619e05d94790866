//! The Delassus operator W = H M⁻¹Hᵀ: semidefinite, a compliance, and badly conditioned where expected.

use crate::certificate::definiteness::{Definiteness, definiteness};
use crate::claims::prelude::*;
use crate::contact::delassus::delassus;
use crate::elimination::solve;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.delassus-psd",
        statement: r"$M \succ 0$, hence $W = H\,M^{-1}H^T \succeq 0$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$W$ is positive semidefinite, and positive definite iff the rows of $H$ are independent.",
        argument: r"$x^TWx = (H^Tx)^TM^{-1}(H^Tx) \ge 0$, zero iff $H^Tx = 0$. Decided exactly here for $H$ with independent and dependent
            rows, and on a thousand random systems in the property family.",
        controls: &[r"A symmetric invertible $M$ that is not positive definite.", "The dependent row left out."],
        sources: &["chapter §3, step 5; table of theorems"],
        check: check!(semidefinite),
    },
    Claim {
        id: "S3.delassus-phys",
        statement: r"$W$ is the contact's effective compliance: $\Delta U = W\,P$; one contact and one velocity: $1/m$; off-diagonal
            entries couple contacts; nearly parallel contact directions or extreme masses make $W$ ill-conditioned.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated. Two contacts of a point at the angle $\alpha$ have condition number $\cot^2(\alpha/2)$; two
            contacts of a chain of masses 1, $1/\rho$, 1 have $1 + 2\rho$.",
        argument: r"With $\tan(\alpha/2) = t$ the two normals have cosine $(1 - t^2)/(1 + t^2)$, and
            $W = (1/m)\begin{bmatrix}1 & c \\ c & 1\end{bmatrix}$ has eigenvalues $1 \pm c$, ratio $1/t^2$: 1e6 at $t = 1/1000$. The
            chain's $W = \begin{bmatrix}1 + \rho & -\rho \\ -\rho & 1 + \rho\end{bmatrix}$ has eigenvalues 1 (vector $(1, 1)$) and
            $1 + 2\rho$ (vector $(1, -1)$).",
        controls: &[
            "Perpendicular normals and equal masses, where the condition numbers are 1 and 3.",
            r"$H\,M\,H^T$, the inverse of $M$ forgotten.",
        ],
        sources: &["chapter §3, “what the Delassus operator is”"],
        check: check!(compliance),
    },
];

fn matrix(rows: usize, columns: usize, entries: &[i64]) -> DMatrix<Rational> {
    DMatrix::from_row_slice(rows, columns, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>())
}

fn semidefinite(reading: Reading) -> Result<Vec<Finding>> {
    let mass = reading.only(0).pick(matrix(2, 2, &[2, 1, 1, 3]), matrix(2, 2, &[1, 2, 2, 1]));
    let independent = matrix(2, 2, &[1, -1, 1, 1]);
    let dependent = reading.only(1).pick(matrix(3, 2, &[1, -1, 1, 1, 2, 0]), independent.clone());
    let mut findings = Vec::new();
    for (name, jacobian, full) in [("independent rows", independent, true), ("dependent rows", dependent, false)] {
        let rows = jacobian.nrows();
        let responses: Option<Vec<DVector<Rational>>> = (0..rows).map(|row| solve(&mass, &jacobian.row(row).transpose())).collect();
        let responses = responses.ok_or_else(|| crate::Error::invalid("mass", "is singular", "use an invertible one"))?;
        let w = DMatrix::from_fn(rows, rows, |i, j| jacobian.row(i).transpose().dot(&responses[j]));
        let decided = definiteness(&w);
        let semidefinite = !matches!(decided, Definiteness::Indefinite { .. });
        findings.push(Finding::decision(format!("W ⪰ 0, {name}"), semidefinite, true));
        let definite = decided == Definiteness::Definite;
        findings.push(Finding::decision(format!("W ≻ 0, {name}"), definite, full));
        let agrees = delassus(&mass, &jacobian).is_ok_and(|computed| computed == w);
        findings.push(Finding::decision(format!("the library computes this W, {name}"), agrees, true));
    }
    Ok(findings)
}

fn compliance(reading: Reading) -> Result<Vec<Finding>> {
    let t = reading.only(0).pick(ratio(1, 1000), ratio(1, 1));
    let light = reading.only(0).pick(ratio(1, 1_000_000), ratio(1, 1));
    let compliance = |mass: &DMatrix<Rational>, jacobian: &DMatrix<Rational>| {
        Ok::<_, Error>(reading.only(1).pick(delassus(mass, jacobian)?, jacobian * mass * jacobian.transpose()))
    };
    let one = || ratio(1, 1);
    // a point of mass 1 between two planes, normals (0, 1) and (sin α, cos α)
    let (sine, cosine) = (ratio(2, 1) * &t / (one() + &t * &t), (one() - &t * &t) / (one() + &t * &t));
    let normals = DMatrix::from_row_slice(2, 2, &[ratio(0, 1), one(), sine, cosine]);
    let wedge = compliance(&DMatrix::identity(2, 2), &normals)?;
    let chain_mass = DMatrix::from_diagonal(&DVector::from_vec(vec![one(), light, one()]));
    let chain = compliance(&chain_mass, &matrix(2, 3, &[-1, 1, 0, 0, -1, 1]))?;
    let single = compliance(&DMatrix::from_element(1, 1, ratio(5, 2)), &matrix(1, 1, &[1]))?;
    Ok(vec![
        Finding::exact("condition number of two contacts at a small angle", &condition(&wedge), &ratio(1_000_000, 1), "1"),
        Finding::exact("condition number of a chain with a light middle", &condition(&chain), &ratio(2_000_001, 1), "1"),
        Finding::exact(
            "coupling of neighbours over −1/m of the ball between",
            &(chain[(0, 1)].clone() * ratio(-1, 1_000_000)),
            &one(),
            "1",
        ),
        Finding::exact("one contact, one velocity of 5/2 kg", &single[(0, 0)], &ratio(2, 5), "1/kg"),
    ])
}

/// Condition number of a 2×2 matrix with equal diagonal entries a and off-diagonal b: (a + |b|)/(a − |b|).
fn condition(w: &DMatrix<Rational>) -> Rational {
    let (a, b) = (w[(0, 0)].clone(), w[(0, 1)].clone());
    let b = if b < ratio(0, 1) { -b } else { b };
    (&a + &b) / (&a - &b)
}
