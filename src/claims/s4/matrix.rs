//! The Stewart–Trinkle matrix of the chapter and its 4×4 example.

use super::matrices::{chapter_matrix, integers, reversed};
use crate::certificate::copositivity::copositive;
use crate::certificate::definiteness::{Definiteness, definiteness, positive_semidefinite, quadratic_form};
use crate::checks::stewart_trinkle::{chapter_example, reference};
use crate::claims::prelude::*;
use crate::contact::delassus::delassus;
use crate::problem::stewart_trinkle::generators;
use crate::solvers::enumeration::all_solutions;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.groups",
        statement: r"The LCP has three complementarity groups: $0 \le \lambda_n$ ⟂ normal separation velocity $\ge 0$;
            $0 \le \beta \perp \lambda E + D^Tv^+ \ge 0$, “where $\sigma$ is the slip rate”;
            $0 \le \sigma \perp \mu\lambda_n - E^T\beta \ge 0$.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Exact,
        correct_statement: r"The three groups hold with $\sigma E$ in the second: $0 \le \beta \perp \sigma E + D^Tv^+ \ge 0$. The printed
            $\lambda$ is undefined there; the clause about $\sigma$ shows what is meant.",
        argument: r"Unit point mass, $\mu = 1/2$, $\varphi = 0$, free velocity $(2, -1)$: $\lambda = 1$, $\beta = (0, 1/2)$,
            $v^+ = (3/2, 0)$, $\sigma = 3/2$. The second group with $\sigma$ is $(3, 0) \ge 0$ and complementary to $\beta$; with
            $\lambda$ in its place it is $(5/2, -1/2)$.",
        controls: &[
            r"The second group with $\sigma$ in place of the printed $\lambda$: all three groups hold.",
            r"The impulses of another contact, $\mu = 1$ with free velocity $(3, -2)$, kept for this one.",
        ],
        sources: &["chapter §4, step 3 of the construction"],
        check: check!(groups),
    },
    Claim {
        id: "S4.Wtilde",
        statement: r"The upper left block over $(\lambda, \beta)$ is symmetric positive semidefinite.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$\tilde W = C^TM^{-1}C$ with $C = (n\,D)$ is symmetric positive semidefinite because $M \succ 0$; with
            opposite directions in $D$ it is singular.",
        argument: r"$x^T\tilde Wx = (Cx)^TM^{-1}(Cx) \ge 0$. In the chapter's example $x = (0, 1, 1)$ has $Cx = 0$, so $\tilde W$ is not
            definite: rank 2 of 3.",
        controls: &[
            r"An indefinite “mass” $\operatorname{diag}(1, -1)$ in place of $M$: the block must then stop being semidefinite.",
            "An asymmetric “mass”, as an implicit gyroscopic force leaves it.",
        ],
        sources: &["chapter §4, reading of the matrix block by block"],
        check: check!(reduced_block),
    },
    Claim {
        id: "S4.ex-jacobian",
        statement: r"Example: the corner of a $2D$ block ($m = 1$, $I = 1$) touches the ground; let the contact point lie straight below
            the centre of mass (simplification: the contact Jacobian contains no rotational coupling).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"A contact point at distance $r$ straight below the centre of mass has the tangential row $(1, 0, r)$:
            $W_{nt} = 0$, but $W_{tt} = 1/m + r^2/I$. The matrix of the example is that of a point mass ($r = 0$): as a declared
            simplification it may stand, it does not follow from where the contact point lies.",
        argument: r"The velocity of the point $(0, -r)$ is $(v_x + r\omega, v_y)$. With $m = I = r = 1$: $W_{tt} = 2$, not 1. Only the
            normal-tangential block vanishes.",
        controls: &[
            r"The lever arm $r = 0$ that the example's row $(1, 0, 0)$ stands for.",
            "A corner that lies 1 m below the centre of mass and 1 m beside it.",
        ],
        sources: &["chapter §4, example “2D block on the ground”"],
        check: check!(lever_arm),
    },
    Claim {
        id: "S4.ex-W",
        statement: r"Example: $W = \begin{bmatrix}1 & 0 & 0 \\ 0 & 1 & -1 \\ 0 & -1 & 1\end{bmatrix}$; the tangential block has rank 1
            because $d_1 = -d_2$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"With rows $n = (0, 1, 0)$, $\pm t = (\pm1, 0, 0)$ and $m = 1$, $W$ is as printed and its tangential block has
            rank 1.",
        argument: r"$W = H\,M^{-1}H^T$ entry by entry; the tangential block has the kernel $(1, 1)$ and the entry 1.",
        controls: &[r"Two directions that are not opposite, $d_1 = d_2$.", "Two directions at a right angle, of a contact in space."],
        sources: &["chapter §4, example “2D block on the ground”"],
        check: check!(example_delassus),
    },
    Claim {
        id: "S4.ex-asym",
        statement: r"The $4\times4$ matrix is not symmetric: $M_{14} = 0$ but $M_{41} = 0.5$, $M_{24} = 1$ but $M_{42} = -1$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$M_{14} = 0$, $M_{41} = 1/2$, $M_{24} = 1$, $M_{42} = -1$.",
        argument: r"Read off $M = \begin{bmatrix}\tilde W & (0; E) \\ (\mu, -E^T) & 0\end{bmatrix}$ with $\mu = 1/2$.",
        controls: &[
            r"The symmetric matrix $\begin{bmatrix}\tilde W & b \\ b^T & 0\end{bmatrix}$ of the proof's first line.",
            "The transposed matrix.",
        ],
        sources: &["chapter §4, example “2D block on the ground”"],
        check: check!(asymmetry),
    },
    Claim {
        id: "S4.ex-quadratic",
        statement: r"Example: the cross terms with $\sigma$ cancel and $x^TMx = \lambda^2 + (\beta_1 - \beta_2)^2 \ge 0$ remains.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"$x^TMx = \lambda^2 + (\beta_1 - \beta_2)^2 + \tfrac12\lambda\sigma$: the terms $\sigma(\beta_1 + \beta_2)$
            cancel, $\mu\lambda\sigma$ remains. It is $\ge 0$ for $x \ge 0$, so the conclusion drawn there survives, but $M$ is not
            positive semidefinite. (The dropped term is that of S4.quadratic-general.)",
        argument: r"$x = (1, 0, 0, 1)$: $x^TMx = 3/2$, the printed formula gives 1. $x = (-1/10, 0, 0, 1)$: $x^TMx = -1/25 < 0$.",
        controls: &[
            r"The matrix without $\mu$ in the row of the friction cone, whose form is the printed one.",
            r"The last row with reversed sign, $(-\mu, E^T)$.",
        ],
        sources: &["chapter §4, example “2D block on the ground”"],
        check: check!(example_form),
    },
    Claim {
        id: "S4.block-form",
        statement: r"Proof: partition $M_\text{LCP}$ as $\begin{bmatrix}\tilde W & b \\ b^T & 0\end{bmatrix}$, where the last row and
            column hold $[\mu, -E^T]$ and $[0; E]$.",
        verdict: ClaimVerdict::Inconsistent,
        kind: Kind::Assertion,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Exact,
        correct_statement: r"$M_\text{LCP} = \begin{bmatrix}\tilde W & b \\ c^T & 0\end{bmatrix}$ with $b = (0; E)$ and
            $c = (\mu; -E) \ne b$; the same sentence names both correctly, so this is a slip of notation.",
        argument: r"In the example's matrix the last row $(1/2, -1, -1)$ and the last column $(0, 1, 1)$ differ in three entries: so they
            do in the words of the sentence, $\mu$ against 0 and $-E^T$ against $E$, while the display with $b$ and $b^T$ says that they
            do not differ.",
        controls: &[
            r"A contact without friction, $\mu = 0$ and no directions: its last row and column are zero in the display and in the words.",
        ],
        sources: &["chapter §4, proof of the theorem on M_LCP"],
        check: check!(block_form),
    },
    Claim {
        id: "S4.ex1-size",
        statement: r"Exercise: for one planar contact with $d_1 = -d_2$, write down the $3\times3$ Stewart–Trinkle matrix entry by
            entry.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"The matrix is $3\times3$ in blocks $(\lambda, \beta, \sigma)$ and $4\times4$ in scalars
            $(\lambda, \beta_1, \beta_2, \sigma)$, as in the section's own example.",
        argument: r"Unknowns: 1 normal impulse, 2 direction impulses, 1 slip speed – four scalars in three blocks. The text does not say
            which size is meant; leaving $\sigma$ out would lose the row of the friction cone the exercise asks for, and the three scalars
            $(\lambda, \beta_1, \sigma)$ of $d_1$ alone brake one sense of sliding only: a slide at 2 m/s to 3/2 m/s in one sense, not at
            all in the other.",
        controls: &[r"The three scalars $(\lambda, \beta_1, \sigma)$ of the direction $d_1$ alone.", "No directions at all."],
        sources: &["chapter §4, exercise 1"],
        check: check!(example_size),
    },
];

fn groups(reading: Reading) -> Result<Vec<Finding>> {
    let system = chapter_example(ratio(0, 1), [ratio(2, 1), ratio(-1, 1)]);
    let mut other = chapter_example(ratio(0, 1), [ratio(3, 1), ratio(-2, 1)]);
    other.friction = vec![ratio(1, 1)];
    let set = all_solutions(&reference(reading.only(1).pick(&system, &other))?)?;
    let z = &set.points[0];
    let velocity = &system.free_velocity + system.impulse(z).component_div(&system.mass);
    // λE, as printed, or σE
    let added = reading.only(0).pick(&z[0], &z[3]);
    let second = [0, 1].map(|j| added + system.direction(0, j).dot(&velocity));
    let normal = system.normal(0).dot(&velocity);
    let left = &system.friction[0] * &z[0] - &z[1] - &z[2];
    Ok(vec![
        Finding::exact("slack of the second group where friction acts", &second[1], &ratio(-1, 2), "m/s").says(ratio(0, 1)),
        Finding::exact("slack of the second group at the other direction", &second[0], &ratio(5, 2), "m/s").says_at_least(ratio(0, 1)),
        Finding::exact("λ_n times the normal velocity", &(&z[0] * normal), &ratio(0, 1), "J"),
        Finding::exact("σ times μλ_n − Eᵀβ", &(&z[3] * left), &ratio(0, 1), "J"),
        Finding::exact("σ less the sliding speed", &(&z[3] - &velocity[0]), &ratio(0, 1), "m/s"),
    ])
}

fn reduced_block(reading: Reading) -> Result<Vec<Finding>> {
    let columns = DMatrix::from_row_slice(2, 3, &[0, 1, -1, 1, 0, 0].map(|x| ratio(x, 1)));
    let coupling = reading.only(1).pick(ratio(0, 1), ratio(1, 2));
    let last = reading.only(0).pick(ratio(1, 1), ratio(-1, 1));
    let inverse_mass = DMatrix::from_row_slice(2, 2, &[ratio(1, 1), coupling, ratio(0, 1), last]);
    let block = columns.transpose() * inverse_mass * &columns;
    let rank = match definiteness(&block) {
        Definiteness::Semidefinite { rank, .. } => rank,
        _ => 0,
    };
    Ok(vec![
        Finding::decision("W̃ is positive semidefinite", positive_semidefinite(&block).holds(), true),
        Finding::decision("symmetric", block == block.transpose(), true),
        Finding::count("rank", rank, 2).context(),
    ])
}

fn lever_arm(reading: Reading) -> Result<Vec<Finding>> {
    // Velocity of the material point (x, −r): (vₓ + rω, v_y + xω).
    let delassus_at = |[beside, below]: [i64; 2]| {
        let jacobian = DMatrix::from_row_slice(2, 3, &[0, 1, beside, 1, 0, below].map(|x| ratio(x, 1)));
        delassus(&DMatrix::identity(3, 3), &jacobian)
    };
    let corner = |place: [i64; 2]| reading.only(1).pick(place, [1, 1]);
    let below = delassus_at(corner(reading.only(0).pick([0, 1], [0, 0])))?;
    let simplified = delassus_at(corner([0, 0]))?;
    let (follows, declared) = ("it follows from the place of the contact", "it is declared as a simplification");
    Ok(vec![
        Finding::exact("W_tt at r = 1, m = I = 1", &below[(1, 1)], &ratio(2, 1), "1/kg").says(ratio(1, 1)).reading(follows),
        Finding::exact("W_nt at r = 1", &below[(0, 1)], &ratio(0, 1), "1/kg").reading(follows),
        Finding::exact("W_tt at r = 0", &simplified[(1, 1)], &ratio(1, 1), "1/kg").reading(declared),
    ])
}

fn example_delassus(reading: Reading) -> Result<Vec<Finding>> {
    let second = reading.only(1).pick([reading.only(0).pick(ratio(-1, 1), ratio(1, 1)), ratio(0, 1)], [ratio(0, 1), ratio(1, 1)]);
    let frame = DMatrix::from_row_slice(3, 3, &[0, 1, 0, 1, 0, 0, 0, 0, 1].map(|x| ratio(x, 1)));
    let rows = reading.only(1).pick(2, 3);
    let generators = generators(1, rows, &[[ratio(1, 1), ratio(0, 1)], second]);
    let jacobian = generators.transpose() * frame.rows(0, rows);
    let block = delassus(&DMatrix::identity(3, 3), &jacobian)?;
    let printed = DMatrix::from_row_slice(3, 3, &[1, 0, 0, 0, 1, -1, 0, -1, 1].map(|x| ratio(x, 1)));
    let differing = block.iter().zip(printed.iter()).filter(|(ours, theirs)| ours != theirs).count();
    let tangential = block.view((1, 1), (2, 2)).into_owned();
    let singular = matches!(definiteness(&tangential), Definiteness::Semidefinite { rank: 1, .. });
    Ok(vec![
        Finding::count("entries that differ from the printed W", differing, 0),
        Finding::decision("the tangential block has rank 1", singular, true),
    ])
}

/// [[W̃, b], [bᵀ, 0]] with b = (0; E) of the example.
fn symmetric_matrix() -> Result<DMatrix<Rational>> {
    let mut matrix = chapter_matrix()?;
    for k in 0..3 {
        matrix[(3, k)] = matrix[(k, 3)].clone();
    }
    Ok(matrix)
}

fn asymmetry(reading: Reading) -> Result<Vec<Finding>> {
    let matrix = reading.only(1).pick(reading.only(0).pick(chapter_matrix()?, symmetric_matrix()?), chapter_matrix()?.transpose());
    let entry = |i: usize, j: usize, expected| Finding::exact(format!("M_{i}{j}"), &matrix[(i - 1, j - 1)], &expected, "1");
    Ok(vec![entry(4, 1, ratio(1, 2)), entry(1, 4, ratio(0, 1)), entry(2, 4, ratio(1, 1)), entry(4, 2, ratio(-1, 1))])
}

fn example_form(reading: Reading) -> Result<Vec<Finding>> {
    let mut matrix = reading.only(1).pick(chapter_matrix()?, reversed(chapter_matrix()?, 1));
    if reading.only(0).is_control() {
        matrix[(3, 0)] = ratio(0, 1);
    }
    let printed = |x: &DVector<Rational>| {
        let difference = &x[1] - &x[2];
        &x[0] * &x[0] + &difference * &difference
    };
    let formula = |x: &DVector<Rational>| printed(x) + ratio(1, 2) * &x[0] * &x[3];
    let negative = DVector::from_vec(vec![ratio(-1, 10), ratio(0, 1), ratio(0, 1), ratio(1, 1)]);
    let points = [integers(&[1, 0, 0, 1]), negative, integers(&[2, 3, 1, 5]), integers(&[0, 1, 4, 2]), integers(&[-3, 1, 1, 7])];
    let compare = |x: &DVector<Rational>| {
        let name = format!("xᵀMx at ({}, {}, {}, {})", x[0], x[1], x[2], x[3]);
        Finding::exact(name, &quadratic_form(&matrix, x), &formula(x), "J").says(printed(x))
    };
    let mut findings: Vec<Finding> = points.iter().map(compare).collect();
    findings.push(Finding::decision("≥ 0 for every x ≥ 0", copositive(&matrix)?.holds(), true));
    findings.push(Finding::decision("not positive semidefinite", !positive_semidefinite(&matrix).holds(), true).context());
    Ok(findings)
}

fn block_form(reading: Reading) -> Result<Vec<Finding>> {
    let mut system = chapter_example(ratio(0, 1), [ratio(0, 1), ratio(0, 1)]);
    if reading.is_control() {
        system.friction[0] = ratio(0, 1);
        system.directions.clear();
    }
    let matrix = reference(&system)?.matrix;
    let last = matrix.nrows() - 1;
    let differing = (0..last).filter(|&k| matrix[(last, k)] != matrix[(k, last)]).count();
    // μ against 0, −1 against 1 for every direction
    let named = usize::from(!system.friction[0].is_zero()) + system.directions.len();
    let finding = || Finding::count("entries in which the last row is not the last column", differing, 3);
    Ok(vec![
        finding().says(0usize).passage("the display [[W̃, b], [bᵀ, 0]]"),
        finding().says(named).passage("the row [μ, −Eᵀ] and the column [0; E]"),
    ])
}

fn example_size(reading: Reading) -> Result<Vec<Finding>> {
    let posed = |speed: i64| {
        let mut system = chapter_example(ratio(0, 1), [ratio(speed, 1), ratio(-1, 1)]);
        system.directions.truncate(reading.only(1).pick(reading.only(0).pick(2, 1), 0));
        system
    };
    let slide = |speed: i64| -> Result<(usize, Rational)> {
        let system = posed(speed);
        let lcp = reference(&system)?;
        let set = all_solutions(&lcp)?;
        let z = set.points.first().ok_or_else(|| Error::breakdown("enumeration", "one point over a floor has a solution"))?;
        Ok((lcp.size(), &system.free_velocity[0] + &system.impulse(z)[0] / &system.mass[0]))
    };
    let ((unknowns, forward), (_, backward)) = (slide(2)?, slide(-2)?);
    let of_a_group = [1, posed(2).directions.len(), 1];
    let groups = of_a_group.iter().filter(|scalars| **scalars > 0).count();
    Ok(vec![
        Finding::count("rows of the matrix in blocks λ, β, σ", groups, 3).reading("3×3 in blocks"),
        Finding::count("rows of the matrix in scalars", unknowns, 4).says(3usize).reading("3×3 in scalars"),
        Finding::exact("velocity after the step of a slide at 2 m/s", &forward, &ratio(3, 2), "m/s"),
        Finding::exact("velocity after the step of a slide at −2 m/s", &backward, &ratio(-3, 2), "m/s"),
    ])
}
