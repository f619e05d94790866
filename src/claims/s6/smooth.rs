//! Whether the contact force is a smooth function: the switch at the surface, the kinks of the force, the cone.

use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::mujoco_normal::NormalContact;
use crate::closed_forms::soft_impedance::SoftImpedance;
use crate::closed_forms::soft_planar_contact::SoftPlanarContact;
use crate::closed_forms::soft_reference::SoftReference;
use crate::closed_forms::soft_row::SoftRow;
use crate::scalar::Dual;
use crate::tolerance::rounding;

const MODEL: &str = "MuJoCo documentation, Computation: constraint model (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.lcp-nondiff",
        statement: "Hard contact is not differentiable, or hard to differentiate: the solution of an LCP is not where the active set \
            switches, and even the convex cone problem is only subdifferentiable at the boundary of the cone, between stick and slip.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, where subdifferentiable means Lipschitz with one-sided derivatives in every direction. $R > 0$
            changes the size of the kinks and does not remove them (S6.smooth-everywhere).",
        argument: r"$f = \max(0, -q/W)$, $W = 2$: one-sided derivatives −1/2 and 0 at $q = 0$. Cone with $\mu = 1/2$ and $W = I$ at the
            load $(-2, 1)$, where stick becomes slip: $\partial f_t/\partial b_t = -1$ on the side of stick and −1/5 on that of slip. Dual
            numbers over rationals.",
        controls: &[
            r"$q = -1$ and the load $(-2, 1/2)$, inside contact and stick.",
            r"$q = 1$ and the load $(-2, 2)$, outside contact and inside slip.",
        ],
        sources: &["chapter §6, hard contact and learning", "Cottle, Pang and Stone, The Linear Complementarity Problem, chapter 7"],
        check: check!(hard_kinks),
    },
    Claim {
        id: "S6.smooth-everywhere",
        statement: "In MuJoCo the contact force is a smooth function of the gap without on/off switch, and the problem is differentiable \
            everywhere.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::BrokenTheorem),
        evidence: Evidence::Certified,
        correct_statement: r"The force jumps at touch, for there is no row above the surface and $d_0 > 0$ below it: by
            $d_0\,m\,(b|v| + g)$ at approach speed $|v|$. As a function of the control it is Lipschitz, with kinks where a contact begins
            to press and where it begins to slip.",
        argument: r"1 kg at −1 m/s under 9.81 m/s², default parameters: 0 above the surface, $9/10\,(2000/19 + 981/100) = 103.566$ N just
            below; with $d_0 = 0$, which MuJoCo raises to its least value, 0.0115 N. Control: $\partial f/\partial\tau$ is 0 on one side
            of the onset and $d = 9/10$ on the other. Load across the change from stick to slip, $R = 1/9$:
            $\partial f_t/\partial b_t = -9/10$ and −9/50.",
        controls: &["A quarter of a millimetre inside contact, and a load inside contact and inside stick."],
        sources: &["chapter §6, MuJoCo's choice, bridge, and the pitfall on hard contact", MODEL],
        check: check!(soft_kinks),
    },
    Claim {
        id: "S6.cone-softened",
        statement: r"MuJoCo adds $R$ and softens the friction cone, which makes it differentiable everywhere, where Anitescu has the hard
            cone.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"The set of forces is the hard cone; $R$ is added to the Hessian only. A slipping contact has
            $|f_t| = \mu\,f_n$ exactly, and the penalty that eliminating the force leaves is continuously differentiable once, not
            twice.",
        argument: r"$\mu = 1/2$, $R = 1/9$ and 1: loads $(-2, b_t)$ with $b_t = 2$, 5 and 50 have $f_t = f_n/2$ exactly. The force is the
            gradient of the minimum in $b$, and its slope at $b_t = 1$ is $-1/(1 + R)$ for stick and $-1/(5(1 + R))$ for slip.",
        controls: &[r"Loads that stick, for which $|f_t| < \mu\,f_n$ and the slopes are equal."],
        sources: &["chapter §6, step 2 and exercise 3", MODEL],
        check: check!(hard_cone),
    },
];

/// A planar contact of 1 kg with μ = 1/2 and a softness R of both rows.
fn contact(softness: &Rational) -> SoftPlanarContact<Rational> {
    let row = ratio(1, 1) + softness;
    SoftPlanarContact { softness: [row.clone(), row], friction: ratio(1, 2) }
}

/// ∂f_t/∂b_t on the side of slip and of stick, as loads move from (−2, `tangent`).
fn slopes(softness: &Rational, tangent: &Rational) -> [Rational; 2] {
    let SoftPlanarContact { softness, friction } = contact(softness);
    let lifted = SoftPlanarContact { softness: softness.map(Dual::constant), friction: Dual::constant(friction) };
    [1, -1].map(|direction| {
        let load = [Dual::constant(ratio(-2, 1)), Dual { value: tangent.clone(), slope: ratio(direction, 1) }];
        lifted.force(&load)[1].slope.clone() * ratio(direction, 1)
    })
}

/// The slope of a one-sided row's force in its load q = a_u − a_ref, on both sides.
fn onset(row: &SoftRow<Rational>, load: &Rational) -> [Rational; 2] {
    let lifted = SoftRow {
        inverse_inertia: Dual::constant(row.inverse_inertia.clone()),
        regularisation: Dual::constant(row.regularisation.clone()),
    };
    [1, -1].map(|direction| {
        let load = Dual { value: load.clone(), slope: ratio(direction, 1) };
        lifted.one_sided_force(&Dual::constant(ratio(0, 1)), &load).slope * ratio(direction, 1)
    })
}

fn hard_kinks(reading: Reading) -> Result<Vec<Finding>> {
    let zero = ratio(0, 1);
    let row = SoftRow { inverse_inertia: ratio(2, 1), regularisation: zero.clone() };
    let (load, tangent) = match reading {
        Reading::Recorded => (zero.clone(), ratio(1, 1)),
        Reading::Control(0) => (ratio(-1, 1), ratio(1, 2)),
        Reading::Control(_) => (ratio(1, 1), ratio(2, 1)),
    };
    let [above, below] = onset(&row, &load);
    let [slip, stick] = slopes(&zero, &tangent);
    Ok(vec![
        Finding::exact("∂f/∂q of an LCP, side of no contact", &above, &zero, "kg"),
        Finding::exact("∂f/∂q, side of contact", &below, &ratio(-1, 2), "kg"),
        Finding::exact("∂f_t/∂b_t of the cone problem, side of slip", &slip, &ratio(-1, 5), "kg"),
        Finding::exact("∂f_t/∂b_t, side of stick", &stick, &ratio(-1, 1), "kg"),
    ])
}

/// The force just below the surface on 1 kg that arrives at 1 m/s under 9.81 m/s² \[N\]; d₀ as given.
fn at_touch(start: Rational) -> Rational {
    let impedance = SoftImpedance { start, ..SoftImpedance::standard() };
    let surface = ratio(0, 1);
    let row = SoftRow::of_impedance(ratio(1, 1), &impedance.at(&surface));
    let reference = SoftReference::unlimited(&ratio(1, 50), &ratio(1, 1), impedance);
    row.one_sided_force(&reference.acceleration(&surface, &ratio(-1, 1)), &ratio(-981, 100))
}

/// The replayed force \[N\] on the same body just above a depth \[m\] and just below it; d₀ as given.
fn around(depth: f64, start: f64) -> [f64; 2] {
    let standard = ContactParameters::default();
    let [_, rest @ ..] = standard.impedance;
    let [end, width, midpoint, power] = rest;
    let parameters = ContactParameters { impedance: [start, end, width, midpoint, power], ..standard };
    let contact = NormalContact::elliptic(parameters, 0.002, 1.0);
    [depth.next_down(), depth.next_up()].map(|depth| contact.impulse(depth, -1.0, -9.81) / contact.time_step)
}

fn soft_kinks(reading: Reading) -> Result<Vec<Finding>> {
    let printed = ratio(9, 10) * (ratio(2000, 19) + ratio(981, 100));
    let size = Scalar::to_f64(&printed);
    let place = reading.pick(0.0, 0.00025);
    let mut findings = vec![
        Finding::exact("force at touch, d₀ = 9/10", &at_touch(ratio(9, 10)), &printed, "N").context(),
        Finding::exact("force at touch, d₀ = 0", &at_touch(ratio(0, 1)), &(&printed / ratio(9000, 1)), "N").context(),
    ];
    for (name, start, expected) in [("d₀ = 9/10", 0.9, size), ("d₀ = 0", 0.0, size / 9000.0)] {
        let [above, below] = around(place, start);
        let jump = Finding::equal(format!("jump of the force at the place, {name}"), below - above, expected, rounding(32, size), "N");
        findings.push(jump.says(0.0));
        findings.push(Finding::decision(format!("no force just above it, {name}"), above == 0.0, true).says(false));
    }
    let [above, below] = onset(&SoftRow::of_impedance(ratio(1, 1), &ratio(9, 10)), &reading.pick(ratio(0, 1), ratio(-1, 1)));
    let [slip, stick] = slopes(&ratio(1, 9), &reading.pick(ratio(1, 1), ratio(1, 2)));
    findings.extend([
        Finding::exact("jump of ∂f/∂q where the contact begins to press", &(below - above), &ratio(-9, 10), "kg").says(ratio(0, 1)),
        Finding::exact("jump of ∂f_t/∂b_t where it begins to slip", &(&slip - stick), &ratio(18, 25), "kg").says(ratio(0, 1)),
        Finding::exact("∂f_t/∂b_t, side of slip", &slip, &ratio(-9, 50), "kg").context(),
    ]);
    Ok(findings)
}

fn hard_cone(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let tangents = reading.pick([ratio(2, 1), ratio(5, 1), ratio(50, 1)], [ratio(1, 2), ratio(1, 4), ratio(1, 8)]);
    for softness in [ratio(1, 9), ratio(1, 1)] {
        let on_the_cone = tangents.iter().all(|tangent| {
            let [normal, friction] = contact(&softness).force(&[ratio(-2, 1), tangent.clone()]);
            friction.magnitude() / normal == ratio(1, 2)
        });
        findings.push(
            Finding::decision(format!("forces of three slipping loads are on the hard cone, R = {softness}"), on_the_cone, true)
                .says(false),
        );
        let scale = ratio(1, 1) + &softness;
        let [slip, stick] = slopes(&softness, &reading.pick(ratio(1, 1), ratio(1, 2))).map(|slope| slope * &scale);
        findings.push(Finding::exact("jump of (1+R) ∂f_t/∂b_t from stick to slip", &(slip - stick), &ratio(4, 5), "1").says(ratio(0, 1)));
    }
    Ok(findings)
}
