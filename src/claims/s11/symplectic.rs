//! §11, why contact and the symplectic form do not go together: projections, reflections, and what is between them.

use crate::claims::experiments::phase_maps::{
    Coupled, Floor, about_to_penetrate, across, ball_flow, entries, identity, kept_step, loaded, mirror_step, projected_step, vanishes,
};
use crate::claims::experiments::spring_damper::{OneStep, theta};
use crate::claims::prelude::*;
use crate::integrators::impact_flow::{ImpactFlow, Tangent};
use crate::integrators::jacobian::jacobian;
use crate::integrators::symplectic::{defect, volume};
use crate::integrators::{Method, Phase, SpringDamper};
use crate::scalar::Dual;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S11.projection-singular",
        statement: "Projecting the velocity onto what the contact allows has a singular Jacobian; a map with a singular Jacobian is not \
            symplectic.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: $v \mapsto v - M^{-1}n\,(n^TM^{-1}n)^{-1}\,n^Tv$ has the eigenvalue 0, and $D^TJD = J$ gives
            $(\det D)^2 = 1$.",
        argument: r"Two coupled masses, $M = (2, 1; 1, 3)$, $n = (0, 1)$, in rationals: $\det D = 0$, and $D^TJD \ne J$. In one dimension
            $D = \operatorname{diag}(1, 0)$.",
        controls: &[
            r"The reflection $v \mapsto v - 2M^{-1}n\,(n^TM^{-1}n)^{-1}\,n^Tv$.",
            "A velocity that already points away from the wall, which the projection leaves alone.",
        ],
        sources: &["chapter §11, symplectic incompatibility"],
        check: check!(velocity_projection),
    },
    Claim {
        id: "S11.any-projection",
        statement: "So every contact correction that contains a projection destroys symplecticity.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, where it acts on an open set of states: one that is put back on the wall has lost the depth it had.",
        argument: r"A semi-implicit step of two coupled masses in a cubic potential, put back on the wall where it ends below:
            $\det D = 0$ exactly.",
        controls: &["The mirror image in the wall in place of the projection: a correction that projects nothing."],
        sources: &["chapter §11, symplectic incompatibility"],
        check: check!(position_projection),
    },
    Claim {
        id: "S11.reflection-symplectic",
        statement: r"The exception: for $e = 1$ without correction the collision is a reflection $v \to -v$, which keeps the energy and is
            symplectic.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The flow across the collision is. The reflection by itself, $(q, v) \mapsto (q, -v)$ at fixed $q$, keeps the
            energy too, with determinant −1 and $D^TJD = -J$: it reverses the form. That the time of the impact moves with the start makes
            the difference.",
        argument: r"Ball on a floor, $e = 1$, in rationals: the flow from before to after the impact has $\det D = 1$ and $D^TJD = J$; the
            reflection $\det D = -1$ and $D^TJD = -J$.",
        controls: &["The flow in the place of the reflection.", r"$e = 4/5$ in the flow."],
        sources: &["chapter §11, symplectic incompatibility; exercise 3(d)"],
        check: check!(reflection),
    },
    Claim {
        id: "S11.no-symplectic-contact",
        statement: r"Projection loses information and the symplectic form cannot: so no improved symplectic contact integrator can succeed
            completely; the obstacle is geometric, not technical. (Excepted is $e = 1$ without correction.)",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, “completely” meaning for every $e$: for $e < 1$ the motion itself does not keep the form, so no
            method should, and no projection can. For $e = 1$ such integrators exist; that a correction of the penetration rules them out
            is charged elsewhere (S8.kmow, S8.cirak-west, S11.explicit-or-implicit).",
        argument: r"The exact flow across an impact with $e = 4/5$ has $\det D = 16/25$, and a step put back on the wall is singular. For
            $e = 1$, the case excepted, a variational step with an impact in it, two coordinates, cubic potential, curved wall:
            $D^TJD - J = 0$ in rationals.",
        controls: &[
            r"$e = 1$ in the flow, and a mirrored step in place of the one that is put back on the wall.",
            "The variational step with its velocity at the end cut to 4/5.",
        ],
        sources: &["chapter §11, essential insight on symplecticity", "S8.kmow", "S8.cirak-west"],
        check: check!(exceptions),
    },
    Claim {
        id: "S11.explicit-or-implicit",
        statement: r"Every operation that corrects penetration destroys symplecticity, whether explicit or implicit. (What is excepted is
            $e = 1$ without such a correction.)",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "Of a projection that is so, whatever method made the step. A mirror image leaves it to the method: symplectic \
            after a symplectic step, not after another.",
        argument: r"A spring stepped by explicit Euler, semi-implicit Euler, the midpoint rule and implicit Euler, $h\,\omega = 1/4$, then
            projected: $\det D = 0$ for all four. Mirrored: $\det D = 1$ after semi-implicit Euler and the midpoint rule, not after the
            other two.",
        controls: &[
            "A correction that puts the state on the wall and sends it back, in place of the mirror image.",
            "The mirror image in place of the projection.",
            "A step of semi-implicit Euler in place of those of explicit and of implicit Euler.",
        ],
        sources: &["chapter §11, pitfalls"],
        check: check!(either),
    },
    Claim {
        id: "S11.ex3",
        statement: r"Exercise: the Jacobian of the projection $v < 0 \mapsto 0$ is singular, so it cannot be symplectic; and the elastic
            reflection is an exception – what is its Jacobian?",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The projection: $\operatorname{diag}(1, 0)$. The reflection: $\operatorname{diag}(1, -1)$, determinant −1,
            which is not symplectic. The exception is the flow across the impact: over a time $T$ without forces $-(1, T; 0, 1)$,
            determinant 1.",
        argument: "One dimension, in rationals with dual numbers: determinants 0, −1 and 1.",
        controls: &["The flow in the place of the reflection.", r"$e = 4/5$ in the flow and in the projection, which is $e = 0$."],
        sources: &["chapter §11, exercise 3"],
        check: check!(exercise),
    },
];

/// The map v ↦ v − share · M⁻¹n (nᵀM⁻¹n)⁻¹ nᵀv of two coupled masses: share 1 projects, 2 reflects. M⁻¹n = (−1, 2)/5.
fn pushed(share: i64) -> DMatrix<Rational> {
    jacobian(&entries(&[(1, 2), (1, 100), (2, 1), (-3, 1)]), |x| {
        let lost = x[3].clone() * Dual::ratio(share, 2);
        DVector::from_vec(vec![x[0].clone(), x[1].clone(), x[2].clone() + lost.clone(), x[3].clone() - lost * Dual::ratio(2, 1)])
    })
}

fn is_symplectic(d: &DMatrix<Rational>, mass: &DMatrix<Rational>) -> bool {
    defect(d, mass).iter().all(|entry| *entry == ratio(0, 1))
}

fn velocity_projection(reading: Reading) -> Result<Vec<Finding>> {
    let (share, factor) = match reading {
        Reading::Recorded => (1, ratio(0, 1)),
        Reading::Control(0) => (2, ratio(-1, 1)),
        Reading::Control(_) => (0, ratio(1, 1)),
    };
    let map = pushed(share);
    Ok(vec![
        Finding::exact("det D of the projection", &volume(&map), &ratio(0, 1), "1"),
        Finding::decision("the projection is symplectic", is_symplectic(&map, &Coupled::mass()), false),
        Finding::exact("det D in one dimension", &volume(&in_one_dimension(factor)), &ratio(0, 1), "1"),
    ])
}

/// D of a step of 1/20 s that penetrates and is corrected: put back on the wall, or mirrored in it.
fn corrected_step(mirrored: bool) -> DMatrix<Rational> {
    let h = Dual::constant(ratio(1, 20));
    jacobian(&about_to_penetrate().stacked(), |x| {
        let before = Phase::from_stacked(x);
        if mirrored { mirror_step(&before, &h) } else { projected_step(&before, &h) }.stacked()
    })
}

fn position_projection(reading: Reading) -> Result<Vec<Finding>> {
    let subject = corrected_step(reading.is_control());
    Ok(vec![
        Finding::exact("det D of the corrected step", &volume(&subject), &ratio(0, 1), "1"),
        Finding::decision("the corrected step is symplectic", is_symplectic(&subject, &Coupled::mass()), false),
    ])
}

/// D of (q, v) ↦ (q, factor · v).
fn in_one_dimension(factor: Rational) -> DMatrix<Rational> {
    let factor = Dual::constant(factor);
    jacobian(&entries(&[(0, 1), (-2, 1)]), |x| DVector::from_vec(vec![x[0].clone(), x[1].clone() * factor.clone()]))
}

fn reflection(reading: Reading) -> Result<Vec<Finding>> {
    let elastic = ball_flow(&ratio(1, 1), &ratio(1, 10));
    let flow = reading.only(1).pick(elastic.clone(), ball_flow(&ratio(4, 5), &ratio(1, 10)));
    let alone = reading.only(0).pick(in_one_dimension(ratio(-1, 1)), elastic);
    let at_fixed_place = "the flow across the impact, of which the reflection is a part";
    // in one dimension DᵀJD = (det D) J
    Ok(vec![
        Finding::exact("det D across the impact", &volume(&flow), &ratio(1, 1), "1"),
        vanishes("DᵀJD − J across the impact", &defect(&flow, &identity(1))),
        Finding::exact("det D of the reflection", &volume(&alone), &ratio(-1, 1), "1").says(ratio(1, 1)).violating(at_fixed_place),
        Finding::decision("the reflection is symplectic", is_symplectic(&alone, &identity(1)), false).says(true).violating(at_fixed_place),
    ])
}

fn exceptions(reading: Reading) -> Result<Vec<Finding>> {
    let e = reading.only(0).pick(ratio(4, 5), ratio(1, 1));
    let corrected = corrected_step(reading.only(0).is_control());
    let kept = reading.only(1).pick(ratio(1, 1), ratio(4, 5));
    Ok(vec![
        Finding::exact("det D of the flow, e = 4/5", &volume(&loaded(e)), &ratio(16, 25), "1"),
        Finding::decision("the step put back on the wall is symplectic", is_symplectic(&corrected, &Coupled::mass()), false),
        vanishes("DᵀJD − J of the variational step, e = 1", &defect(&kept_step(&kept), &identity(2))),
    ])
}

/// D of a step of the spring, ω = 1, and then of the correction diag(depth, speed) of a state behind the wall.
fn corrected(method: &impl Method, [depth, speed]: [i64; 2]) -> Rational {
    let spring = SpringDamper { stiffness_per_mass: ratio(1, 1), damping_per_mass: ratio(0, 1) };
    let step = method.jacobian(&spring, &Phase::of_one(ratio(1, 100), ratio(-1, 1)), &ratio(1, 4));
    let correction = DMatrix::from_diagonal(&DVector::from_vec(vec![ratio(depth, 1), ratio(speed, 1)]));
    volume(&(correction * step))
}

fn either(reading: Reading) -> Result<Vec<Finding>> {
    const MIRROR: [i64; 2] = [-1, -1];
    let (explicit, implicit) = reading.only(2).pick((OneStep::Explicit, theta(1, 1)), (OneStep::SemiImplicit, OneStep::SemiImplicit));
    let methods = [
        ("explicit Euler", explicit, true),
        ("semi-implicit Euler", OneStep::SemiImplicit, false),
        ("midpoint rule", theta(1, 2), false),
        ("implicit Euler", implicit, true),
    ];
    let (projection, mirror) = (reading.only(1).pick([0, 1], MIRROR), reading.only(0).pick(MIRROR, [0, -1]));
    let mut findings = Vec::new();
    for (name, method, lost) in methods {
        let projected = corrected(&method, projection);
        findings.push(Finding::exact(format!("det D of {name}, projected"), &projected, &ratio(0, 1), "1"));
        // in one dimension a map is symplectic if and only if its determinant is 1
        let symplectic = corrected(&method, mirror) == ratio(1, 1);
        findings.push(Finding::decision(format!("{name}, mirrored, is not symplectic"), !symplectic, lost).says(true));
    }
    Ok(findings)
}

fn exercise(reading: Reading) -> Result<Vec<Finding>> {
    let (restitution, projection) = reading.only(1).pick((ratio(1, 1), ratio(0, 1)), (ratio(4, 5), ratio(-4, 5)));
    let free = |restitution: Rational| {
        let gap_and_law =
            ImpactFlow { gap: Floor, acceleration: entries(&[(0, 1)]), restitution, tangent: Tangent::Frictionless, friction: ratio(0, 1) };
        across(&gap_and_law, &entries(&[(0, 1)]), &entries(&[(-2, 1)]), &ratio(1, 3), &ratio(1, 2))
    };
    let flow = free(restitution);
    let expected = DMatrix::from_row_slice(2, 2, &[ratio(-1, 1), ratio(-1, 2), ratio(0, 1), ratio(-1, 1)]);
    let alone = reading.only(0).pick(in_one_dimension(ratio(-1, 1)), free(ratio(1, 1)));
    Ok(vec![
        Finding::exact("det D of the projection", &volume(&in_one_dimension(projection)), &ratio(0, 1), "1"),
        Finding::exact("det D of the reflection", &volume(&alone), &ratio(-1, 1), "1")
            .says(ratio(1, 1))
            .violating("the flow across the impact, of which the reflection is a part"),
        Finding::exact("det D of the flow across the impact", &volume(&flow), &ratio(1, 1), "1"),
        vanishes("D + (1, T; 0, 1) of the flow, T = 1/2 s", &(flow - expected)),
    ])
}
