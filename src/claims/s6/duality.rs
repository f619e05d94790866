//! Gauss' principle, the primal and the dual problem, and uniqueness, in rationals.

use super::program::{Program, Row};
use crate::certificate::definiteness::{Definiteness, definiteness};
use crate::claims::prelude::*;
use crate::closed_forms::soft_row::SoftRow;
use crate::elimination::solve;
use crate::tolerance::claims::soft::two_contacts;
use crate::{problem::Compliance, problem::ContactProblem, problem::Coordinates, problem::Law};
use crate::{scalar::Scalar, solvers::ClarabelPolished, solvers::ContactSolver};

const MODEL: &str = "MuJoCo documentation, Computation: constraint model (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.gauss",
        statement: "Gauss' principle: the true acceleration is the one that deviates least, in the norm of the mass matrix, from the \
            unconstrained one, among those the constraints allow.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, for constraints $J\,x = b$ that do no work.",
        argument: r"Three coupled coordinates, one constraint: the minimiser by Newton's equations $M\,x = M\,a_0 + J^Tf$ with $J\,x = b$.
            Every other admissible $x + n$, $J\,n = 0$, deviates by exactly $\tfrac12\,n^TM\,n$ more, in rationals.",
        controls: &[r"The Euclidean norm in place of that of $M$."],
        sources: &["chapter §6, Gauss' principle and step 1", "Udwadia and Kalaba, A new perspective on constrained motion (1992)"],
        check: check!(gauss),
    },
    Claim {
        id: "S6.primal-terms",
        statement: r"The primal problem adds to Gauss' term $a_\text{ref}$, a diagonal $R$ that softens the constraints, the dual of the
            friction cone, and a Huber function for friction loss. (The display is not legible in the source; that the penalty is on
            $J\,x - a_\text{ref}$ in the norm of $R^{-1}$ is taken from MuJoCo's documentation, which it follows.)",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; at the minimiser $M(x - a_0) = J^Tf$ with the forces $f = -s'(J\,x - a_\text{ref})$.",
        argument: r"Two-sided row, friction loss at its bound and two contacts, one of them open, on three coordinates: the accelerations
            of the enumerated optimal forces show these forces again, and $P$ rises in all 26 directions of the unit cube around them. In
            rationals.",
        controls: &["Forces and penalties from twice the regularisation.", "Every row two-sided, without bounds of the forces."],
        sources: &["chapter §6, step 1", MODEL],
        check: check!(primal),
    },
    Claim {
        id: "S6.dual",
        statement: r"The Lagrange dual is min $\tfrac12\,f^T(A + R)f +$ … over $f \in \Omega$, with $A = J\,M^{-1}J^T$. (The display is
            not legible in the source; its linear term is taken as $f^T(a_u - a_\text{ref})$.)",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated; the minima of the primal and the dual problem add up to zero.",
        argument: r"The same problem: $P(x) + D(f) = 0$ exactly at the enumerated optimum, and positive at the 80 other admissible forces
            of a grid about it. Its two contacts alone, solved by Clarabel, have the impulses that enumeration finds.",
        controls: &[r"$D$ and the contacts without $R$."],
        sources: &["chapter §6, step 2", MODEL],
        check: check!(dual),
    },
    Claim {
        id: "S6.huber-box",
        statement: "The Huber function of friction loss is quadratic and then linear, smooth and bounded.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated of its force, which is bounded by $\eta$; the function itself grows without bound and is
            continuously differentiable once. Its dual is the box $|f| \le \eta$.",
        argument: r"$\eta = 2$ N, $R = 1/2$ 1/kg: force $\mp2$ N beyond $|y| = 1$, where the two pieces have the same value 1 and slope 2;
            penalty 199 at $y = 100$. In the mixed problem the row with friction loss is at its bound.",
        controls: &["The quadratic without the linear part.", r"$R = 1$ in place of 1/2."],
        sources: &["chapter §6, step 1", "Huber, Robust estimation of a location parameter (1964)"],
        check: check!(huber),
    },
    Claim {
        id: "S6.omega-dot",
        statement: r"The deformation dynamics of the constraint is $\dot\omega = a_\text{ref} - R\,f$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Definition,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Of the rows that are inside their bounds, where $J\,x = a_\text{ref} - R\,f$. On a row at its bound $J\,x$
            differs, and $\dot\omega$ with it.",
        argument: "The same problem, row by row in rationals: equality on the two-sided row and the closed contact, a difference on the \
            open contact and on the row with friction loss, whose bound is reached.",
        controls: &[r"Twice the regularisation in $R\,f$.", "Every row two-sided, without bounds of the forces."],
        sources: &["chapter §6, step 3", MODEL],
        check: check!(deformation),
    },
    Claim {
        id: "S6.R-uniqueness",
        statement: r"Adding $R$ makes the dual Hessian strictly positive definite, so that the force is unique even if A is singular
            through redundant contacts.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: r"Four corners of a box, normal rows: A has rank 3, and two different sets of forces give the same accelerations.
            $A + R$ with $R = 1/9$ is definite, and enumeration finds one optimum, 81/37 N on each corner. All decided in rationals.",
        controls: &[r"$R = 0$.", "Four points on a line, at −1, 0, 1 and 3 m, in place of four corners."],
        sources: &["chapter §6, step 2", MODEL],
        check: check!(four_corners),
    },
    Claim {
        id: "S6.inverse-closed-form",
        statement: "Inverse dynamics, from known accelerations to forces, has a closed form.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: with $R$ diagonal $f = -s'(J\,x - a_\text{ref})$ row by row, and $M\,x - J^Tf$ is the applied
            force.",
        argument: r"The mixed problem forwards by enumeration and back by the formula: forces and $M\,a_0$ come out exactly.",
        controls: &["The forces without their bounds."],
        sources: &["chapter §6, bridge", "Todorov, Convex and analytically-invertible dynamics (2014)"],
        check: check!(inverse),
    },
    Claim {
        id: "S6.todorov2014-invertible",
        statement: "Todorov (2014) proves that the dynamics is analytically invertible.",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, of the regularised dynamics, $R > 0$, and from accelerations to forces. The inverse multiplies an
            error of the acceleration by $1/R$ on each row, so that it is lost as $R \to 0$. It is not the inverse of a time step, nor
            time reversal (S6.time-reversible).",
        argument: r"One row of 1 kg at $d = 0.9$: loads of 5, 20 and 50 N have three accelerations; $\partial\tau/\partial a = 10$ and
            10000 kg at $d = 0.9$ and 0.9999. With $R = 0$ all loads have the acceleration $a_\text{ref}$. The round trip of
            S6.inverse-closed-form is exact.",
        controls: &[r"The hard row, $R = 0$.", r"$R = 1 - d$, the division by $d$ forgotten."],
        sources: &["chapter §6, history", "Todorov, Convex and analytically-invertible dynamics (2014)"],
        check: check!(invertible),
    },
];

/// A force is found for every program with R > 0.
fn optimum(program: &Program) -> Result<DVector<Rational>> {
    let optima = program.optima();
    let [force] = optima.as_slice() else {
        return Err(Error::breakdown("enumeration", format!("found {} optima, not one", optima.len())));
    };
    Ok(force.clone())
}

fn zero() -> Rational {
    ratio(0, 1)
}

fn vector(entries: &[i64]) -> DVector<Rational> {
    DVector::from_iterator(entries.len(), entries.iter().map(|&entry| ratio(entry, 1)))
}

fn gauss(reading: Reading) -> Result<Vec<Finding>> {
    let Program { mass, free, .. } = Program::mixed();
    let (row, wanted) = (vector(&[1, 1, 0]), ratio(1, 1));
    let norm = reading.pick(mass.clone(), DMatrix::identity(3, 3));
    let column = solve(&mass, &row).ok_or_else(|| Error::breakdown("elimination", "M is singular"))?;
    let force = (&wanted - row.dot(&free)) / row.dot(&column);
    let truth = &free + &column * force.clone();
    let deviation = |x: &DVector<Rational>| (x - &free).dot(&(&norm * (x - &free))) * ratio(1, 2);
    let mut largest = zero();
    for direction in [vector(&[1, -1, 0]), vector(&[0, 0, 1]), vector(&[-3, 3, 2])] {
        let more = deviation(&(&truth + &direction)) - deviation(&truth);
        let expected = direction.dot(&(&norm * &direction)) * ratio(1, 2);
        largest = largest.max((more - expected).magnitude());
    }
    Ok(vec![Finding::exact("largest excess of another admissible acceleration over ½ nᵀM n", &largest, &zero(), "N m/s²")])
}

fn primal(reading: Reading) -> Result<Vec<Finding>> {
    let program = Program::mixed();
    let force = optimum(&program)?;
    let acceleration = program.acceleration(&force);
    let mut shown = program.clone();
    shown.regularisation *= reading.only(0).pick(ratio(1, 1), ratio(2, 1));
    let steps = (0..27).map(|k| vector(&[k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]) / ratio(100, 1));
    if reading == Reading::Control(1) {
        shown.rows = vec![Row::TwoSided; 4];
    }
    let least = shown.primal(&acceleration);
    let other = |step: &DVector<Rational>| step.iter().any(|x| *x != zero());
    let risen = steps.filter(other).filter(|step| shown.primal(&(&acceleration + step)) > least).count();
    let found = shown.inverse(&acceleration);
    Ok(vec![
        Finding::decision("the accelerations show the optimal forces", found == force, true),
        Finding::count("directions, of 26, in which P rises", risen, 26),
        Finding::exact("friction loss, at its bound", &found[1].magnitude(), &ratio(2, 1), "N"),
        Finding::exact("force of the open contact", &found[3], &zero(), "N"),
    ])
}

/// The two contacts of the mixed program as a contact problem, an impulse being a force over 1 s.
pub fn contacts_alone() -> (Program, ContactProblem) {
    softened_contacts(&ratio(1, 1))
}

/// The same with a share of R in the contact problem.
fn softened_contacts(share: &Rational) -> (Program, ContactProblem) {
    let mixed = Program::mixed();
    let pair = Program {
        jacobian: mixed.jacobian.rows(2, 2).into_owned(),
        reference: vector(&[10, 2]),
        regularisation: mixed.regularisation.rows(2, 2).into_owned(),
        rows: vec![Row::OneSided; 2],
        ..mixed
    };
    let rounded = |x: DVector<Rational>| x.map(|entry| Scalar::to_f64(&entry));
    let problem = ContactProblem::new(pair.delassus().map(|entry| Scalar::to_f64(&entry)), rounded(&pair.jacobian * &pair.free))
        .name("two soft contacts")
        .law(Law::Frictionless)
        .rows_per_contact(1)
        .shift(rounded(-pair.reference.clone()))
        .compliance(Compliance { coordinates: Coordinates::Contact, diagonal: rounded(&pair.regularisation * share.clone()) })
        .build()
        .expect("two soft contacts of finite numbers");
    (pair, problem)
}

fn dual(reading: Reading) -> Result<Vec<Finding>> {
    let program = Program::mixed();
    let force = optimum(&program)?;
    let primal = program.primal(&program.acceleration(&force));
    let share = reading.pick(ratio(1, 1), zero());
    let mut softened = program.clone();
    softened.regularisation *= share.clone();
    let gap = &primal + softened.dual(&force);
    // the friction loss is at its bound and the last contact open: both move inwards
    let step = |k: i64| [(k % 3 - 1), 0, (k / 9 % 3 - 1), (k / 27)].map(|tenths| ratio(tenths, 10));
    let inwards = |k: i64| ratio(10 - k / 3 % 3, 10);
    let other = |k: i64| DVector::from_fn(4, |i, _| if i == 1 { &force[1] * inwards(k) } else { &force[i] + &step(k)[i] });
    let worse = (0..81).map(other).filter(|other| *other != force).filter(|other| &primal + softened.dual(other) > zero()).count();
    let (pair, problem) = softened_contacts(&share);
    let exact = optimum(&pair)?;
    let interior = ClarabelPolished.solve(&problem, None)?;
    let size = Scalar::to_f64(&exact[0]).hypot(Scalar::to_f64(&exact[1]));
    let mut findings = vec![
        Finding::exact("P + D at the optimum", &gap, &zero(), "N m/s²"),
        Finding::count("other admissible forces, of 80, at which P + D > 0", worse, 80),
    ];
    for (measured, exact) in interior.impulse.iter().zip(exact.iter()) {
        let bound = two_contacts(size, problem.free_velocity().amax() + problem.shift().amax());
        findings.push(Finding::equal("force of a contact by Clarabel", *measured, Scalar::to_f64(exact), bound, "N"));
    }
    Ok(findings)
}

fn huber(reading: Reading) -> Result<Vec<Finding>> {
    use crate::closed_forms::huber::Huber;
    let bound = reading.only(0).pick(ratio(2, 1), ratio(1_000_000, 1));
    let mut mixed = Program::mixed();
    mixed.rows[1] = Row::FrictionLoss(bound.clone());
    let huber = Huber { bound, regularisation: reading.only(1).pick(ratio(1, 2), ratio(1, 1)) };
    let force = optimum(&mixed)?;
    Ok(vec![
        Finding::exact("force at y = 100", &huber.force(&ratio(100, 1)), &ratio(-2, 1), "N"),
        Finding::exact("force at y = −1, the bend", &huber.force(&ratio(-1, 1)), &ratio(2, 1), "N"),
        Finding::exact("penalty at y = 1", &huber.penalty(&ratio(1, 1)), &ratio(1, 1), "N m/s²"),
        Finding::exact("penalty at y = 100", &huber.penalty(&ratio(100, 1)), &ratio(199, 1), "N m/s²"),
        Finding::decision("the dual is infinite beyond the bound", huber.conjugate(&ratio(3, 1)).is_none(), true),
        Finding::exact("friction loss in the mixed problem", &force[1].magnitude(), &ratio(2, 1), "N"),
    ])
}

fn deformation(reading: Reading) -> Result<Vec<Finding>> {
    let mut program = Program::mixed();
    if reading == Reading::Control(1) {
        program.rows = vec![Row::TwoSided; 4];
    }
    let force = optimum(&program)?;
    let softness = &program.regularisation * reading.only(0).pick(ratio(1, 1), ratio(2, 1));
    let rest = program.violation(&program.acceleration(&force)) + softness.component_mul(&force);
    let finding = |i: usize, inside: bool| Finding::decision(format!("J x = a_ref − R f on row {i}"), rest[i] == zero(), inside);
    let bound = |i: usize| finding(i, false).says(true).violating("the row is inside its bounds");
    Ok(vec![finding(0, true), finding(2, true), bound(1), bound(3)])
}

/// Normal rows of a box at its corners (±1, ±1): v_z, ω_x, ω_y with M = diag(1, 1, 1).
pub fn box_on_corners(softness: Rational) -> Program {
    Program {
        mass: DMatrix::identity(3, 3),
        jacobian: DMatrix::from_row_iterator(4, 3, [1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1].map(|x| ratio(x, 1))),
        free: vector(&[-9, 0, 0]),
        reference: vector(&[0; 4]),
        regularisation: DVector::from_element(4, softness),
        rows: vec![Row::OneSided; 4],
    }
}

fn four_corners(reading: Reading) -> Result<Vec<Finding>> {
    let corners = box_on_corners(reading.only(0).pick(ratio(1, 9), zero()));
    let line = DMatrix::from_row_iterator(4, 3, [1, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0, 3].map(|x| ratio(x, 1)));
    let program = reading.only(1).pick(corners.clone(), Program { jacobian: line, ..corners });
    let delassus = program.delassus();
    let rank = match definiteness(&delassus) {
        Definiteness::Semidefinite { rank, .. } => rank,
        Definiteness::Definite => 4,
        Definiteness::Indefinite { .. } => 0,
    };
    let definite = matches!(definiteness(&program.hessian()), Definiteness::Definite);
    let change = &delassus * vector(&[1, -1, -1, 1]);
    let equal = ratio(81, 37);
    let optima = program.optima();
    Ok(vec![
        Finding::decision("A + R is definite", definite, true),
        Finding::count("rank of A", rank, 3),
        Finding::decision("forces (1, −1, −1, 1) change an acceleration", change.iter().any(|x| *x != zero()), false),
        Finding::decision("enumeration finds one optimum", optima.len() == 1, true),
        Finding::decision("81/37 N on each corner", optima.iter().any(|force| force.iter().all(|f| *f == equal)), true),
    ])
}

fn inverse(reading: Reading) -> Result<Vec<Finding>> {
    let program = Program::mixed();
    let force = optimum(&program)?;
    let acceleration = program.acceleration(&force);
    let mut shown = program.clone();
    if reading.is_control() {
        shown.rows = vec![Row::TwoSided; 4];
    }
    let found = shown.inverse(&acceleration);
    let applied = &program.mass * &acceleration - program.jacobian.transpose() * &found;
    Ok(vec![
        Finding::decision("M x − Jᵀf is the applied force", applied == &program.mass * &program.free, true),
        Finding::decision("the forces of the forward problem come out", found == force, true),
    ])
}

fn invertible(reading: Reading) -> Result<Vec<Finding>> {
    let acceleration = |d: &Rational, push: i64| {
        let (one, free) = (ratio(1, 1), ratio(-push, 1));
        let undivided = SoftRow { inverse_inertia: one.clone(), regularisation: &one - d };
        let row = reading.only(1).pick(SoftRow::of_impedance(one, d), undivided);
        row.acceleration(&row.one_sided_force(&ratio(3, 1), &free), &free)
    };
    let gain = |d: Rational| ratio(1, 1) / (acceleration(&d, 20) - acceleration(&d, 21));
    let d = reading.only(0).pick(ratio(9, 10), ratio(1, 1));
    let [light, medium, heavy] = [5, 20, 50].map(|push| acceleration(&d, push));
    Ok(vec![
        Finding::decision("loads of 5, 20 and 50 N have accelerations that differ", light > medium && medium > heavy, true),
        Finding::exact("∂τ/∂a at d = 0.9", &gain(ratio(9, 10)), &ratio(10, 1), "kg"),
        Finding::exact("∂τ/∂a at d = 0.9999", &gain(ratio(9999, 10000)), &ratio(10_000, 1), "kg"),
    ])
}
