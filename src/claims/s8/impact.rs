//! What an impact does to the symplectic form and to phase volume: the flow across it, and the steps of schemes.

use crate::claims::experiments::phase_maps::{
    Coupled, Disk, Floor, about_to_penetrate, across, ball_flow, disk_flow, entries, identity, kept_step, loaded, projected_step, vanishes,
};
use crate::claims::experiments::spring_damper::{OneStep, SEMI_IMPLICIT};
use crate::claims::prelude::*;
use crate::elimination::rank;
use crate::exact_particle::{Ball, BallState};
use crate::integrators::impact_flow::{ImpactFlow, Tangent};
use crate::integrators::jacobian::jacobian;
use crate::integrators::symplectic::{defect, form, volume};
use crate::integrators::{Method, Phase};
use crate::scalar::Dual;
use crate::schemes::Activation;
use crate::tolerance::claims::pathology::elastic_drop;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.activation-not-diffeo",
        statement: "Intuition: the switching of the active set is not a diffeomorphism; at activation the phase space is folded \
            (penetration is corrected, velocity is projected), and the fold does not keep the symplectic form.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"At $e = 0$, where the flow is singular, at a grazing impact, where its derivative grows without bound, and
            for a step that reverses the velocity without locating the impact, which turns phase volume over. Across a located impact with
            $e > 0$ and a normal speed the flow is smooth with a smooth inverse: its determinant is $e^2$.",
        argument: r"Disk of radius 1 hit from outside at $(3/5, 4/5)$ under the constant acceleration $(1/2, -3)$, $e = 1/2$: determinant
            exactly 1/4, and 0 at $e = 0$. Ball on a floor, $g = 10$: the entry $\partial v^+/\partial q$ is $(1 + e)\,g/|v_n|$: arriving
            at 1/10, 1/100, 1/1000 m/s it grows by a factor of ten each time. A Moreau–Jean step with $e = 1/2$ has determinant −1/2.",
        controls: &[r"$e = 0$ in place of 1/2.", r"$e = 1$ in place of 0."],
        sources: &[
            "chapter §8, the negative result, intuition",
            "di Bernardo et al., Piecewise-smooth Dynamical Systems (2008), §2.5 on saltation matrices",
        ],
        check: check!(activation),
    },
    Claim {
        id: "S8.e-lt-1",
        statement: r"As soon as $e < 1$ the symplectic form is lost.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: $\det D = e^2$ for every number of coordinates, curved walls and constant forces. $J^{-1}D^TJD$
            has the eigenvalues $e^2$, $e^2$, 1, 1, …: with one coordinate the form is scaled by $e^2$, with more it is not.",
        argument: r"Impact on the disk as in S8.activation-not-diffeo, $e = 4/5$: $\det D = 16/25$, in space on the sphere too;
            $A = J^{-1}D^TJD$ has trace $2 + 2e^2$ and $(A - I)(A - e^2I) = 0$, $A \ne e^2I$, exactly. Ball on the floor:
            $D^TJD = e^2J$.",
        controls: &[r"$e = 1$, which keeps the form.", r"A body that slides with friction, $\mu = 1/2$, across the disk."],
        sources: &["chapter §8, the negative result"],
        check: check!(dissipative),
    },
    Claim {
        id: "S8.e0",
        statement: r"A plastic impact ($e = 0$) and symplecticity contradict each other.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated: the flow is not even invertible. On a flat wall it loses two dimensions, the gap and its rate; a \
            curved one, which the body leaves along the tangent, keeps one of them, the time of the impact.",
        argument: r"Impact without load, $e = 0$, in rationals: $\det D = 0$ on the disk and on a flat floor; rank 3 and 2 of 4.",
        controls: &[r"$e = 1/2$."],
        sources: &["chapter §8, conclusion of the negative result"],
        check: check!(plastic),
    },
    Claim {
        id: "S8.e1-only",
        statement: r"Symplecticity is kept only for $e = 1$, purely elastic, and without correction of the penetration.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The flow with exact impacts keeps it iff $e = 1$. A time-stepping scheme without correction need not: a
            Moreau–Jean step in which the contact acts has determinant $-e$, that is −1 for $e = 1$, for every $\theta$. And a correction
            need not destroy it (S8.cirak-west).",
        argument: r"Flow across the disk, $e = 1$: $D^TJD - J = 0$ exactly, and not for $e = 4/5$. Ball, Moreau–Jean in rationals with
            dual numbers: $\det D = -e$ at $\theta = 0$, 1/2, 1, for $e = 1$ and 1/2.",
        controls: &[
            "The flow of the ball across its impact in place of the Moreau–Jean step.",
            "The two coefficients of restitution of the flow exchanged.",
        ],
        sources: &["chapter §8, conclusion of the negative result"],
        check: check!(elastic_only),
    },
    Claim {
        id: "S8.friction-det",
        statement: r"(Not in the chapter: a question of ours beside its sentence that $e < 1$, dissipation, loses the form.) What does
            friction do to phase volume and to the form in an impact?",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"An impact in which the body slides throughout has $\det D = e^2$, as without friction, and is not symplectic
            even at $e = 1$: conserved volume does not show a conserved form. An impact that sticks has $\det D = 0$.",
        argument: r"Disk, $\mu = 1/2$: $\det D = 9/25$ for $e = 3/5$, and 1 for $e = 1$ with $D^TJD \ne J$. Sticking: 0.",
        controls: &[r"No friction, which at $e = 1$ is symplectic.", r"$e = 1/2$ in place of 1 and of 3/5."],
        sources: &[
            "suggested by chapter §8, the negative result; not stated there",
            "S8.e-lt-1",
            "Routh's impact with one phase of sliding",
        ],
        check: check!(friction),
    },
    Claim {
        id: "S8.ex2-fold",
        statement: "Exercise: pushing a penetrating body back squashes or folds phase space; the purely elastic impact without correction \
            is an exception.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Projection squashes, determinant 0. The exception is the flow with the impact at its time, determinant 1; \
            reversing the velocity at the end of a step is not, determinant −1.",
        argument: r"A semi-implicit step put back on the wall: 0. The same step with its velocity reversed, $e = 1$: −1. The flow of a
            ball across its elastic impact: 1, and symplectic.",
        controls: &[
            "The flow in place of the step with reversed velocity.",
            r"$e = 4/5$ in the flow.",
            "A step of 1/2000 s, too short to penetrate, in place of the one that is put back.",
        ],
        sources: &["chapter §8, exercise 2"],
        check: check!(fold),
    },
    Claim {
        id: "S8.ex3-tasks",
        statement: "Exercise: which integrator for (a) planets over a million years, (b) ten seconds of a trotting quadruped, (c) a \
            million elastic bounces without friction, (d) training by reinforcement.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: r"Which of its criteria a task needs is a judgement. What each method has can be said: (a) without contact
            semi-implicit Euler is itself symplectic, so that the two answers are one; $(b, d)$ at $e = 0$ nothing is symplectic; (c)
            located elastic impacts and the variational step are, and Moreau–Jean keeps the energy of a ball without being so.",
        argument: r"(a) Two coupled masses in a cubic potential: $D^TJD - J = 0$. $(b, d)$ Flow across a disk, $e = 0$: $\det D = 0$. (c)
            The same flow and the variational step with $e = 1$: $D^TJD - J = 0$; Moreau–Jean, $\theta = 1/2$, $h = 1/100$ s, ten thousand
            steps of a bouncing ball: energy within rounding.",
        controls: &[
            r"$e = 0.9999$ in every impact, and the variational step's velocity cut to that share.",
            "Explicit Euler in place of semi-implicit Euler.",
        ],
        sources: &["chapter §8, exercise 3", "S8.backwards-theta-energy"],
        check: check!(tasks),
    },
];

/// The flow across an impact on the unit sphere in space, at (2, 3, 6)/7.
fn sphere_flow(restitution: &Rational) -> DMatrix<Rational> {
    let flow = ImpactFlow {
        gap: Disk,
        acceleration: entries(&[(0, 1), (1, 2), (-3, 1)]),
        restitution: restitution.clone(),
        tangent: Tangent::Frictionless,
        friction: ratio(0, 1),
    };
    let (touching, arriving) = (entries(&[(2, 7), (3, 7), (6, 7)]), entries(&[(1, 1), (-2, 1), (-1, 1)]));
    across(&flow, &touching, &arriving, &ratio(1, 3), &ratio(1, 2))
}

fn activation(reading: Reading) -> Result<Vec<Finding>> {
    const MET: &str = "e = 0, a grazing impact, or a step that does not locate it";
    let (half, zero, one) = (ratio(1, 2), ratio(0, 1), ratio(1, 1));
    let bounce = reading.only(0).pick(&half, &zero);
    let plastic = reading.only(1).pick(&zero, &one);
    // not a diffeomorphism: the volume vanishes, a slope is unbounded, or the orientation turns over
    let mut findings = vec![
        Finding::exact("det D of the flow across the disk, e = 1/2", &volume(&loaded(bounce.clone())), &ratio(1, 4), "1")
            .says(&zero)
            .violating(MET),
        Finding::exact("det D of the flow across the disk, e = 0", &volume(&loaded(plastic.clone())), &zero, "1"),
        Finding::exact("det D of a Moreau–Jean step, e = 1/2", &volume(&moreau_jean(bounce, &half)), &-half.clone(), "1"),
    ];
    for (speed, steep) in [(ratio(1, 10), 150), (ratio(1, 100), 1500), (ratio(1, 1000), 15_000)] {
        let flow = ball_flow(bounce, &speed);
        findings
            .push(Finding::exact(format!("det D, arriving at {speed} m/s"), &volume(&flow), &ratio(1, 4), "1").says(&zero).violating(MET));
        // exactly (1 + e) g/|v_n|: the flights before and after add nothing to this entry
        findings.push(Finding::exact(format!("∂v⁺/∂q, arriving at {speed} m/s"), &flow[(1, 0)], &ratio(steep, 1), "1/s"));
    }
    Ok(findings)
}

fn dissipative(reading: Reading) -> Result<Vec<Finding>> {
    let e = reading.only(0).pick(ratio(4, 5), ratio(1, 1));
    let square = ratio(16, 25);
    let tangent = reading.only(1).pick(Tangent::Frictionless, Tangent::Sliding);
    let d = disk_flow(e.clone(), tangent, ratio(1, 2), &[(1, 2), (-3, 1)]);
    let one = identity(4);
    // J⁻¹ = −J for unit masses
    let pulled = -form(&identity(2)) * d.transpose() * form(&identity(2)) * &d;
    let product = (&pulled - &one) * (&pulled - &one * square.clone());
    let line = ball_flow(&e, &ratio(1, 10));
    let scaled = defect(&line, &identity(1)) + form(&identity(1)) * (ratio(1, 1) - &square);
    Ok(vec![
        Finding::exact("det D", &volume(&d), &square, "1"),
        Finding::exact("det D in space", &volume(&sphere_flow(&e)), &square, "1"),
        vanishes("(A − I)(A − e²I)", &product),
        Finding::exact("trace of A", &pulled.trace(), &(ratio(2, 1) + ratio(2, 1) * &square), "1"),
        vanishes("DᵀJD − e²J of a ball", &scaled),
    ])
}

fn plastic(reading: Reading) -> Result<Vec<Finding>> {
    let none: &[(i64, i64)] = &[(0, 1), (0, 1)];
    let restitution = reading.pick(ratio(0, 1), ratio(1, 2));
    let disk = disk_flow(restitution.clone(), Tangent::Frictionless, ratio(0, 1), none);
    let flat = ImpactFlow { gap: Floor, acceleration: entries(none), restitution, tangent: Tangent::Frictionless, friction: ratio(0, 1) };
    let floor = across(&flat, &entries(none), &entries(&[(1, 1), (-2, 1)]), &ratio(1, 3), &ratio(1, 2));
    Ok(vec![
        Finding::exact("det D on the disk", &volume(&disk), &ratio(0, 1), "1"),
        Finding::exact("det D on a floor", &volume(&floor), &ratio(0, 1), "1"),
        Finding::count("rank of D on the disk", rank(&disk), 3),
        Finding::count("rank of D on a floor", rank(&floor), 2),
    ])
}

/// D of a Moreau–Jean step of a ball of 1 kg that touches the floor at −2 m/s, h = 1/10 s, g = 10 m/s².
fn moreau_jean(restitution: &Rational, theta: &Rational) -> DMatrix<Rational> {
    let constant = |x: &Rational| Dual::constant(x.clone());
    let ball = Ball { mass: constant(&ratio(1, 1)), gravity: constant(&ratio(10, 1)), restitution: constant(restitution) };
    let (theta, h) = (constant(theta), constant(&ratio(1, 10)));
    jacobian(&entries(&[(-1, 100), (-2, 1)]), |x| {
        let now = BallState { position: x[0].clone(), velocity: x[1].clone() };
        let after = ball.moreau_jean(&now, &theta, Activation::Gap, &h).motion;
        DVector::from_vec(vec![after.position, after.velocity])
    })
}

fn elastic_only(reading: Reading) -> Result<Vec<Finding>> {
    let (one, half) = (ratio(1, 1), ratio(1, 2));
    let (elastic, lossy) = reading.only(1).pick((ratio(1, 1), ratio(4, 5)), (ratio(4, 5), ratio(1, 1)));
    let kept = |e: Rational| defect(&loaded(e), &identity(2)).iter().all(|entry| *entry == ratio(0, 1));
    let mut findings = vec![
        Finding::decision("DᵀJD = J across the disk, e = 1", kept(elastic), true),
        Finding::decision("DᵀJD = J across the disk, e = 4/5", kept(lossy), false),
    ];
    let bounce = |e: &Rational, theta: &Rational| match reading.only(0) {
        Reading::Recorded => volume(&moreau_jean(e, theta)),
        Reading::Control(_) => volume(&ball_flow(e, &ratio(1, 10))),
    };
    for theta in [ratio(0, 1), ratio(1, 2), ratio(1, 1)] {
        findings.push(
            Finding::exact(format!("det D of Moreau–Jean, θ = {theta}, e = 1"), &bounce(&one, &theta), &-one.clone(), "1")
                .says(&one)
                .violating("the impact at its time"),
        );
        findings.push(Finding::exact(format!("det D of Moreau–Jean, θ = {theta}, e = 1/2"), &bounce(&half, &theta), &-half.clone(), "1"));
    }
    Ok(findings)
}

fn friction(reading: Reading) -> Result<Vec<Finding>> {
    let (sliding, sticking) = reading.only(0).pick((Tangent::Sliding, Tangent::Sticking), (Tangent::Frictionless, Tangent::Frictionless));
    let (full, part) = reading.only(1).pick((ratio(1, 1), ratio(3, 5)), (ratio(1, 2), ratio(1, 2)));
    let none: &[(i64, i64)] = &[(0, 1), (0, 1)];
    let across = |tangent: Tangent, e: &Rational| disk_flow(e.clone(), tangent, ratio(1, 2), none);
    let elastic = across(sliding, &full);
    let kept = defect(&elastic, &identity(2)).iter().all(|entry| *entry == ratio(0, 1));
    Ok(vec![
        Finding::decision("sliding at e = 1 is symplectic", kept, false),
        Finding::exact("det D of sliding, e = 1", &volume(&elastic), &ratio(1, 1), "1"),
        Finding::exact("det D of sliding, e = 3/5", &volume(&across(sliding, &part)), &ratio(9, 25), "1"),
        Finding::exact("det D of sticking, e = 3/5", &volume(&across(sticking, &part)), &ratio(0, 1), "1"),
    ])
}

fn fold(reading: Reading) -> Result<Vec<Finding>> {
    let now = about_to_penetrate().stacked();
    let lasting = |h: Rational| Dual::constant(h);
    let short = reading.only(2).pick(ratio(1, 20), ratio(1, 2000));
    let projected = jacobian(&now, |x| projected_step(&Phase::from_stacked(x), &lasting(short.clone())).stacked());
    let reversed = jacobian(&now, |x| {
        let mut after = SEMI_IMPLICIT.step(&Coupled, &Phase::from_stacked(x), &lasting(ratio(1, 20)));
        after.velocity[1] = -after.velocity[1].clone();
        after.stacked()
    });
    let elastic = loaded(ratio(1, 1));
    let flow = loaded(reading.only(1).pick(ratio(1, 1), ratio(4, 5)));
    Ok(vec![
        Finding::exact("det D of the flow, e = 1", &volume(&flow), &ratio(1, 1), "1"),
        Finding::exact("det D of the projected step", &volume(&projected), &ratio(0, 1), "1"),
        Finding::exact("det D of the step with reversed velocity", &volume(reading.only(0).pick(&reversed, &elastic)), &ratio(-1, 1), "1")
            .says(ratio(1, 1))
            .violating("the impact at its time"),
        vanishes("DᵀJD − J of the flow", &defect(&flow, &identity(2))),
    ])
}

fn tasks(reading: Reading) -> Result<Vec<Finding>> {
    const POINT: &str = "which criteria a task needs";
    let smooth = Phase { position: entries(&[(1, 2), (-1, 3)]), velocity: entries(&[(2, 1), (1, 5)]) };
    let method = reading.only(1).pick(OneStep::SemiImplicit, OneStep::Explicit);
    let separable = defect(&method.jacobian(&Coupled, &smooth, &ratio(1, 7)), &Coupled::mass());
    let (elastic, plastic) = reading.only(0).pick((ratio(1, 1), ratio(0, 1)), (ratio(9999, 10_000), ratio(9999, 10_000)));
    let ball = Ball { mass: 1.0, gravity: 10.0, restitution: Scalar::to_f64(&elastic) };
    let start = BallState { position: 0.0, velocity: 1.0 };
    let steps = 10_000;
    let end = (0..steps).fold(start.clone(), |now, _| ball.moreau_jean(&now, &0.5, Activation::Gap, &0.01).motion);
    let share = ball.energy(&end) / ball.energy(&start);
    Ok(vec![
        vanishes("DᵀJD − J of semi-implicit Euler without contact (a)", &separable).opinion(POINT),
        Finding::exact("det D of the flow across an impact, e = 0 (b, d)", &volume(&loaded(plastic)), &ratio(0, 1), "1").opinion(POINT),
        vanishes("DᵀJD − J of the flow across an elastic impact (c)", &defect(&loaded(elastic.clone()), &identity(2))).opinion(POINT),
        vanishes("DᵀJD − J of the variational step (c)", &defect(&kept_step(&elastic), &identity(2))).opinion(POINT),
        Finding::equal("E/E₀ of Moreau–Jean, θ = 1/2, e = 1 (c)", share, 1.0, elastic_drop(steps), "1").opinion(POINT),
    ])
}
