//! `solimp`: the impedance curve, the regularisation it sets, and what a loaded contact does with it.

use crate::claims::experiments::mujoco::facts;
use crate::claims::experiments::soft::{GRAVITY, default_contact, land, limited_contact};
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::soft_impedance::SoftImpedance;
use crate::closed_forms::soft_reference::SoftReference;
use crate::closed_forms::soft_row::SoftRow;
use crate::scalar::Dual;
use crate::stored::{RUNS, read};
use crate::tolerance::claims::pathology::AT_REST;
use crate::tolerance::closed_forms::PRINTED_DIGITS;
use crate::tolerance::rounding;
use serde_json::Value;

const CURVE: &str = "chapter §6, numerical example of solimp";
const MODEL: &str = "MuJoCo documentation, Computation: constraint model (3.17)";
const PARAMETERS: &str = "MuJoCo documentation, Modeling: solver parameters (3.17)";
/// Depth \[m\] of a ball of 1 kg after 900 steps of 1 ms, stored from MuJoCo 3.17.0 with its default parameters.
const STORED_DEPTH: f64 = 0.000_367_181_842_5;
/// Steps of MuJoCo 3.17.0 with its default parameters: blocks that slide and stick over round cones, and one over pyramids.
const STEPS: [(&str, &str); 3] = [
    ("sliding block", "mujoco/block_slide__cg-elliptic__h0.002__step100.dump.json"),
    ("sticking block", "mujoco/block_stick__newton-elliptic__h0.002__step400.dump.json"),
    ("block over pyramids", "mujoco/block_slide__cg-pyramidal__h0.002__step100.dump.json"),
];

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.impedance-range",
        statement: r"The impedance $d$ lies in $[0, 1]$, is small (soft) without contact and tends to 1 (hard) as the violation grows; by
            default from 0.9 to 0.95.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"$d$ goes from $d_0$ at the surface to $d_w$ beyond the width, by default from 0.9 to 0.95 and no further;
            both are kept in $[0.0001, 0.9999]$. It falls with depth if $d_0 > d_w$. Without contact there is no row and no $d$.",
        argument: r"The default curve rises from 9/10 to 19/20 and is 19/20 at 1 m too; solimp $= (0, 1, \ldots)$ gives 1/10000 and
            9999/10000; $(19/20, 9/10, \ldots)$ falls. In rationals. A $d$ of $[0, 1]$ counts as small below 1/2; tending to 1 counts as
            999/1000 at a thousand widths.",
        controls: &[
            r"solimp $= (0, 1, \ldots)$ in place of the others.",
            r"solimp $= (0.95, 0.9, \ldots)$, which falls, in place of the others.",
        ],
        sources: &["chapter §6, step 3", PARAMETERS],
        check: check!(range),
    },
    Claim {
        id: "S6.impedance-curve",
        statement: r"$d$ passes smoothly from $d_0 = 0.9$ to $d_w = 0.95$ over a width of 1 mm, its shape given by power 2 (quadratic) and
            midpoint 0.5.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: $y = 2x^2$ up to the midpoint and $1 - 2(1 - x)^2$ beyond, $x$ the depth over the width. It is
            continuously differentiable, not twice.",
        argument: r"$d$ at 0, 1/4, 1/2, 3/4 and 1 mm is 0.9, 0.90625, 0.925, 0.94375 and 0.95, in rationals. One-sided derivatives by dual
            numbers agree at both ends, and are 100 $1/m$ on both sides of the midpoint. The second derivative jumps there from 200000 to
            −200000 $1/m^2$.",
        controls: &["The straight line, power 1.", r"$d_0$ and $d_w$ exchanged.", "1 mm taken for half of the width."],
        sources: &[CURVE, PARAMETERS],
        check: check!(curve),
    },
    Claim {
        id: "S6.solimp-default",
        statement: r"The default is solimp $= (0.9, 0.95, 0.001, 0.5, 2)$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated, read back from MuJoCo 3.17.0 in the stored step problems.",
        argument: r"The five numbers are read from the stored answers of MuJoCo 3.17.0. What a ball at rest there shows, 3.671818e-4 m, is
            the depth that they give with solref $= (0.02, 1)$; power 1 would give another.",
        controls: &["power 1."],
        sources: &[CURVE, "stored step problem ball_rest, newton-elliptic, h = 1 ms (MuJoCo 3.17.0)"],
        check: check!(default_parameters),
    },
    Claim {
        id: "S6.R-formula",
        statement: r"The impedance sets the regularisation, $R \propto (1 - d)/d$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated: $R = (1 - d)/d \cdot \hat A$, with MuJoCo's approximation $\hat A$ of the diagonal of A, which for
            one body is $1/m$ for every contact point. Only where $\hat A$ is the true diagonal does a single row move with
            $d\,a_\text{ref} + (1 - d)\,a_u$. Friction rows have $R$/impratio.",
        argument: r"$R\,d/((1 - d)\,\hat A) = 1$ on stored rows of MuJoCo 3.17.0: a ball 1 mm deep, $d = 0.95$, blocks that slide and
            stick over round cones, and one over pyramids, each with a $d$ of its own; $R$ itself differs. At the corner of a cube
            $A = 4/m$, so that with the $R$ of $d = 9/10$ the weight of $a_\text{ref}$ is 36/37, not 9/10.",
        controls: &[r"The $d$ of the surface, 9/10, in place of the $d$ of the row."],
        sources: &[CURVE, MODEL, "stored step problems of MuJoCo 3.17.0"],
        check: check!(regularisation),
    },
    Claim {
        id: "S6.d-to-1",
        statement: r"As $d \to 1$, $R \to 0$: the constraint becomes hard, without regularisation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"In the formula. MuJoCo keeps $d \le 0.9999$, hence $R \ge \hat A/9999$: there is always regularisation.",
        argument: r"$R/A = (1 - d)/d$ is 1/9, 1/99, 1/999 at $d = 0.9$, 0.99, 0.999; with solimp $= (1, 1, \ldots)$ it is 1/9999 and not
            0.",
        controls: &[r"The formula at $d = 1$, without MuJoCo's limit.", r"$R = 1 - d$, the division by $d$ forgotten."],
        sources: &[CURVE, PARAMETERS],
        check: check!(hard_limit),
    },
    Claim {
        id: "S6.layered-contact",
        statement: "solimp can model a soft layer over a hard core: soft at small penetration, hard at large.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, with $d_0$ far below $d_w$: the force that holds a depth $\delta$ is
            $k\,d^2\,\delta/((1 - d)\hat A)$, a spring whose stiffness rises with $d$.",
        argument: r"solimp $= (1/10, 19/20, 1\,\mathrm{cm}, 1/2, 2)$: force over depth at the core is 1624.5 times that at the surface;
            with the default it is 2.23 times. In rationals.",
        controls: &["Constant impedance in place of either curve."],
        sources: &[CURVE],
        check: check!(layer),
    },
    Claim {
        id: "S6.rest-penetration",
        statement: "Hard objects penetrate a little, like a sponge; most tasks can accept penetration at the level of millimetres.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated; a ball on the floor rests 0.367 mm deep with default parameters, whatever its mass. It is not
            $g/k_p = 3.9$ mm: the load acts with $1 - d$. What a task accepts is not decided here.",
        argument: r"$k\,d^2\,\delta = (1 - d)\,g$ with $d = d(\delta)$ has the root $\delta = \text{3.671818e-4}$ m; the replay of 3000
            steps of 1 ms and the stored run of MuJoCo 3.17.0 end there. With constant $d = 9/10$, $\delta = g/k_p/10$ in rationals.",
        controls: &["A contact with constant impedance 0.95."],
        sources: &["chapter §6, pitfalls on stiffness and on hard contact", MODEL],
        check: check!(rest),
    },
    Claim {
        id: "S6.R-softness",
        statement: r"$R$ is the regulariser that makes a constraint soft; the larger $R$, the softer.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: $a = (A\,a_\text{ref} + R\,a_u)/(A + R)$ moves from $a_\text{ref}$ at $R = 0$ monotonically
            towards the free acceleration.",
        argument: r"$A = 1$, $a_\text{ref} = 5$, $a_u = -10$: $a = 5$ at $R = 0$, −5/2 at $R = 1$, 15/15001 above −10 at $R = 15000$;
            $da/dR = A\,(a_u - a_\text{ref})/(A + R)^2$ by dual numbers.",
        controls: &[r"A row that wants $a_\text{ref} = a_u$, where $R$ changes nothing."],
        sources: &["chapter §6, step 1", MODEL],
        check: check!(softness),
    },
    Claim {
        id: "S6.push-harder",
        statement: "Pushing harder against a constraint results in larger acceleration.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: $\partial a/\partial\tau = (1 - d)/m > 0$ for a single contact whose $\hat A$ is exact; 1/10 of
            the free value at $d = 0.9$.",
        argument: r"$a = d\,a_\text{ref} + (1 - d)\,a_u$ by dual numbers: $\partial\tau/\partial a = 10$, 100, 1000, 10000 kg at $m = 1$
            kg and $d = 0.9$, 0.99, 0.999, 0.9999.",
        controls: &[r"The hard row, $R = 0$.", "A plain spring, whose force does not know the load."],
        sources: &["chapter §6, MuJoCo's choice", MODEL],
        check: check!(push),
    },
    Claim {
        id: "S6.solref-solimp-roles",
        statement: r"solref is what the constraint wants, the target dynamics; solimp what it is able to do, soft or hard with the
            violation. Together they determine $a_\text{ref}$ and $R$; their jobs differ and have to be understood separately.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: beyond the width the motion without load is that of solref, for $d_w$ cancels; $a_\text{ref}$
            contains $d(\delta)$ and $d_w$ from solimp, and under load the depth at rest depends on both.",
        argument: r"solimp $(1/2, 1/2, \ldots)$ in place of $(19/20, 19/20, \ldots)$, solref $(1/50, 1)$: $d^2\,k = 2500$ and $d\,b = 100$
            both times, but $a_\text{ref}$ at $\varphi = -1$ mm is 5 m/s² in place of 50/19, and 1 kg rests under $g = 10$ m/s² at 2/1000
            m in place of 1/5000 m.",
        controls: &["The same solimp twice.", r"solref $(1/100, 1)$ with the one of the two solimp."],
        sources: &["chapter §6, step 3 and the pitfall on solref and solimp", PARAMETERS],
        check: check!(roles),
    },
];

fn range(reading: Reading) -> Result<Vec<Finding>> {
    let standard = SoftImpedance::<Rational>::standard();
    let extreme = SoftImpedance { start: ratio(0, 1), end: ratio(1, 1), ..standard.clone() };
    let falling = SoftImpedance { start: ratio(19, 20), end: ratio(9, 10), ..standard.clone() };
    let (printed, fallen) = reading.only(0).pick((&standard, &falling), (&extreme, &extreme));
    let (rising, wide) = reading.only(1).pick((&standard, &extreme), (&falling, &falling));
    let (surface, metre) = (ratio(0, 1), ratio(1, 1));
    let (small, near_one) = (ratio(1, 2), ratio(999, 1000));
    let rises = |curve: &SoftImpedance<Rational>| curve.at(&metre) > curve.at(&surface);
    Ok(vec![
        Finding::decision("d rises with depth, default", rises(rising), true),
        Finding::exact("d at the surface for d₀ = 0", &wide.at(&surface), &ratio(1, 10_000), "1").says_at_most(&small),
        Finding::exact("d at 1 m for d_w = 1", &wide.at(&metre), &ratio(9999, 10_000), "1").says_at_least(&near_one),
        Finding::exact("d at the surface, default", &printed.at(&surface), &ratio(9, 10), "1").says_at_most(&small).violating("d₀ = 0"),
        Finding::exact("d at a depth of 1 m, default", &printed.at(&metre), &ratio(19, 20), "1")
            .says_at_least(&near_one)
            .violating("d_w = 1"),
        Finding::decision("d rises with depth, d₀ > d_w", rises(fallen), false).says(true).violating("d₀ < d_w"),
    ])
}

/// Slope of a curve at a share of a millimetre, on the side towards which `direction` = ±1 points \[1/m\].
fn slope(shape: &SoftImpedance<Rational>, share: &Rational, direction: i64) -> Rational {
    let lift = |x: &Rational| Dual::constant(x.clone());
    let SoftImpedance { start, end, width, midpoint, power } = shape;
    let lifted = SoftImpedance { start: lift(start), end: lift(end), width: lift(width), midpoint: lift(midpoint), power: *power };
    let at = Dual { value: share / ratio(1000, 1), slope: ratio(direction, 1) };
    lifted.at(&at).slope * ratio(direction, 1)
}

fn curve(reading: Reading) -> Result<Vec<Finding>> {
    let standard = SoftImpedance::<Rational>::standard();
    let shape = match reading {
        Reading::Recorded => standard,
        Reading::Control(0) => SoftImpedance { power: 1, ..standard },
        Reading::Control(1) => SoftImpedance { start: standard.end.clone(), end: standard.start.clone(), ..standard },
        Reading::Control(_) => SoftImpedance { width: ratio(1, 500), ..standard },
    };
    let slope = |share: &Rational, direction: i64| slope(&shape, share, direction);
    let mut findings = Vec::new();
    for (quarters, d) in [(1, (29, 32)), (0, (9, 10)), (2, (37, 40)), (3, (151, 160)), (4, (19, 20))] {
        let at = shape.at(&ratio(quarters, 4000));
        findings.push(Finding::exact(format!("d at {quarters}/4 mm"), &at, &ratio(d.0, d.1), "1"));
    }
    let joins = [0, 1, 2].map(|halves| ratio(halves, 2)).iter().all(|place| slope(place, -1) == slope(place, 1));
    findings.push(Finding::decision("slopes of both sides agree at the surface, the midpoint and the width", joins, true));
    findings.push(Finding::exact("slope at the midpoint", &slope(&ratio(1, 2), 1), &ratio(100, 1), "1/m"));
    // the slope is linear on each half, so that its difference quotient is the second derivative
    let bend = |from: Rational, to: Rational| (slope(&to, 1) - slope(&from, 1)) * ratio(1000, 1) / (to - from);
    findings.push(Finding::exact("second derivative before the midpoint", &bend(ratio(1, 4), ratio(3, 8)), &ratio(200_000, 1), "1/m²"));
    findings.push(Finding::exact("second derivative after it", &bend(ratio(5, 8), ratio(3, 4)), &ratio(-200_000, 1), "1/m²"));
    Ok(findings)
}

fn default_parameters(reading: Reading) -> Result<Vec<Finding>> {
    let printed = [0.9, 0.95, 0.001, 0.5, reading.pick(2.0, 1.0)];
    let parameters = ContactParameters { impedance: printed, ..ContactParameters::default() };
    let depth = parameters.rest_depth(0.001, 1.0, GRAVITY)?;
    let mut findings = lookups::check("S6.solimp-default", reading)?;
    findings.push(Finding::equal("depth at rest of these parameters", depth, STORED_DEPTH, PRINTED_DIGITS * STORED_DEPTH, "m"));
    Ok(findings)
}

/// A row of a stored step of MuJoCo 3.17.0.
struct StoredRow {
    /// d.
    impedance: f64,
    /// R [1/kg].
    softness: f64,
    /// Â [1/kg].
    diagonal: f64,
}

/// The first row of a stored step.
fn stored_row(path: &str) -> Result<StoredRow> {
    let step: Value = read(&RUNS, path)?;
    let missing = || Error::invalid(path.to_string(), "is not a step of MuJoCo", "run scripts/generate_references.py");
    let number = |value: &Value| value.as_f64().ok_or_else(missing);
    let native = &step["native"];
    Ok(StoredRow {
        impedance: number(&native["efc_KBIP"]["rows"][0][2])?,
        softness: number(&native["efc_R"][0])?,
        diagonal: number(&native["efc_diagA"][0])?,
    })
}

fn regularisation(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let deep = facts()?.numbers(&["computed", "one_contact", "elliptic 1", "efc_R"])?[0];
    let mut rows = vec![("ball of 1 kg 1 mm deep", StoredRow { impedance: 0.95, softness: deep, diagonal: 1.0 })];
    for (name, path) in STEPS {
        rows.push((name, stored_row(path)?));
    }
    for (name, row) in rows {
        let d = reading.pick(row.impedance, 0.9);
        let factor = row.softness / row.diagonal * d / (1.0 - d);
        let bound = rounding(8, 1.0 / (1.0 - row.impedance));
        findings.push(Finding::equal(format!("R d/((1−d) Â), {name}"), factor, 1.0, bound, "1").experiment());
    }
    let row = SoftRow::of_impedance(ratio(1, 1), &ratio(9, 10));
    // corner (a, a, −a)/2 of a cube with inertia m a²/6: 1/m + (a²/4 + a²/4)/(m a²/6)
    let corner = SoftRow { inverse_inertia: ratio(4, 1), ..row };
    // a_u = 0, a_ref = 1: the acceleration is the weight of a_ref
    let weight = corner.acceleration(&corner.force(&ratio(1, 1), &ratio(0, 1)), &ratio(0, 1));
    findings.push(Finding::exact("weight of a_ref at a corner, R = 1/9", &weight, &ratio(36, 37), "1").context());
    Ok(findings)
}

fn hard_limit(reading: Reading) -> Result<Vec<Finding>> {
    let hardest = reading.only(0).pick(SoftImpedance::constant(ratio(1, 1)).at(&ratio(1, 1000)), ratio(1, 1));
    let softness = |d: &Rational| match reading {
        Reading::Control(1) => ratio(1, 1) - d,
        _ => SoftRow::of_impedance(ratio(1, 1), d).regularisation,
    };
    let mut findings = vec![
        Finding::exact("R/A for solimp = (1, 1, …)", &softness(&hardest), &ratio(1, 9999), "1")
            .says(ratio(0, 1))
            .violating("d is not limited to 9999/10000"),
    ];
    for (d, expected) in [(ratio(9, 10), 9), (ratio(99, 100), 99), (ratio(999, 1000), 999)] {
        findings.push(Finding::exact(format!("R/A at d = {d}"), &softness(&d), &ratio(1, expected), "1"));
    }
    Ok(findings)
}

/// d²/(1−d): the static force per depth over k/Â.
fn holding(d: &Rational) -> Rational {
    d * d / (ratio(1, 1) - d)
}

fn layer(reading: Reading) -> Result<Vec<Finding>> {
    let standard = SoftImpedance::<Rational>::standard();
    let rubber = SoftImpedance { start: ratio(1, 10), width: ratio(1, 100), ..standard.clone() };
    let ratio_of = |curve: &SoftImpedance<Rational>| holding(&curve.at(&ratio(1, 100))) / holding(&curve.at(&ratio(0, 1)));
    let constant = SoftImpedance::constant(ratio(19, 20));
    let (layered, default) = reading.pick((&rubber, &standard), (&constant, &constant));
    let stiffens = (0..10).all(|k| holding(&layered.at(&ratio(k, 1000))) < holding(&layered.at(&ratio(k + 1, 1000))));
    Ok(vec![
        Finding::exact("stiffness of the core over that of the surface", &ratio_of(layered), &ratio(3249, 2), "1"),
        Finding::exact("the same of the default curve", &ratio_of(default), &ratio(361, 162), "1"),
        Finding::decision("the stiffness rises with every millimetre", stiffens, true),
    ])
}

fn rest(reading: Reading) -> Result<Vec<Finding>> {
    let standard = ContactParameters::default();
    let constant = ContactParameters { impedance: [0.95, 0.95, 0.001, 0.5, 2.0], ..standard };
    let closed = standard.rest_depth(0.001, 1.0, GRAVITY)?;
    let parameters = reading.pick(standard, constant);
    let contact = reading.pick(default_contact(0.001), limited_contact(0.001, 0.02));
    let measured = land(&contact, 0.0, 3000).depth;
    let heavy = parameters.rest_depth(0.001, 1.0 / 1000.0, 1000.0 * GRAVITY)?;
    // constant d = 9/10: k = 1/(d t_c)², and R f = k d δ balances f = m g
    let d = reading.pick(ratio(9, 10), ratio(19, 20));
    let reference = SoftReference::unlimited(&ratio(1, 50), &ratio(1, 1), SoftImpedance::constant(d.clone()));
    let at = ratio(981, 100) / ratio(2500, 1) / ratio(10, 1);
    let row = SoftRow::of_impedance(ratio(1, 1), &d);
    let force = row.force(&reference.acceleration(&-at.clone(), &ratio(0, 1)), &ratio(-981, 100));
    let stored = parameters.rest_depth(0.001, 1.0, GRAVITY)?;
    Ok(vec![
        Finding::equal("depth at rest, replay against closed form", measured, closed, AT_REST * closed, "m"),
        Finding::equal("depth at rest, closed form against MuJoCo 3.17.0", stored, STORED_DEPTH, PRINTED_DIGITS * closed, "m").experiment(),
        Finding::equal("depth at rest of 1000 kg", heavy, closed, AT_REST * closed, "m"),
        Finding::exact("force on 1 kg at the depth g/k_p/10, d = 9/10", &force, &ratio(981, 100), "N"),
    ])
}

fn softness(reading: Reading) -> Result<Vec<Finding>> {
    let (free, wanted) = (ratio(-10, 1), reading.pick(ratio(5, 1), ratio(-10, 1)));
    let at = |softness: Rational| {
        let lift = |x: &Rational| Dual::constant(x.clone());
        let regularisation = Dual { value: softness, slope: ratio(1, 1) };
        let row = SoftRow { inverse_inertia: Dual::constant(ratio(1, 1)), regularisation };
        row.acceleration(&row.force(&lift(&wanted), &lift(&free)), &lift(&free))
    };
    let expected_slope = |softness: i64| ratio(-15, (1 + softness) * (1 + softness));
    let mut findings = vec![Finding::exact("a at R = 1", &at(ratio(1, 1)).value, &ratio(-5, 2), "m/s²")];
    for softness in [0, 1, 10] {
        let name = format!("da/dR at R = {softness}");
        findings.push(Finding::exact(name, &at(ratio(softness, 1)).slope, &expected_slope(softness), "kg m/s²"));
    }
    let far = at(ratio(15_000, 1)).value - &free;
    findings.push(Finding::exact("a at R = 0", &at(ratio(0, 1)).value, &ratio(5, 1), "m/s²"));
    findings.push(Finding::exact("a − a_u at R = 15000", &far, &ratio(15, 15_001), "m/s²"));
    Ok(findings)
}

fn push(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (d, parts) in [(ratio(9, 10), 10), (ratio(99, 100), 100), (ratio(999, 1000), 1000), (ratio(9999, 10000), 10000)] {
        let name = format!("∂a/∂τ at d = {d}");
        let d = reading.only(0).pick(d, ratio(1, 1));
        let row = SoftRow::of_impedance(Dual::constant(ratio(1, 1)), &Dual::constant(d));
        // 1 kg, pushed into the surface with 20 N and one newton more or less
        let free = Dual { value: ratio(-20, 1), slope: ratio(1, 1) };
        let force = row.one_sided_force(&Dual::constant(ratio(3, 1)), &free);
        let slope = row.acceleration(&force, &free).slope;
        findings.push(Finding::exact(name, &slope, &ratio(1, parts), "1/kg"));
    }
    // the same by the replayed formula: f(20 N) and f(21 N) on the default contact at 1 mm
    let contact = default_contact(0.001);
    let known = reading.only(1).pick(1.0, 0.0);
    let acceleration = |push: f64| -push + contact.impulse(0.001, 0.0, -push * known) / (contact.time_step * contact.mass);
    let measured = acceleration(20.0) - acceleration(21.0);
    findings.push(Finding::equal("by the replayed formula, d = 0.95", measured, 0.05, rounding(16, 42.0), "m/s²"));
    Ok(findings)
}

fn roles(reading: Reading) -> Result<Vec<Finding>> {
    let contact = |time: Rational, d: Rational| SoftReference::unlimited(&time, &ratio(1, 1), SoftImpedance::constant(d));
    let hard = contact(reading.only(1).pick(ratio(1, 50), ratio(1, 100)), ratio(19, 20));
    let soft = contact(ratio(1, 50), reading.only(0).pick(ratio(1, 2), ratio(19, 20)));
    let wanted = |reference: &SoftReference<Rational>| reference.acceleration(&ratio(-1, 1000), &ratio(0, 1));
    // k d² δ = (1−d) g
    let depth = |reference: &SoftReference<Rational>| {
        let d = reference.impedance.at_width();
        (ratio(1, 1) - d) * ratio(10, 1) / reference.effective(&ratio(1, 1))[0].clone()
    };
    let one = ratio(1, 1);
    Ok(vec![
        Finding::exact("a_ref at 1 mm, d = 19/20", &wanted(&hard), &ratio(50, 19), "m/s²"),
        Finding::exact("a_ref at 1 mm, d = 1/2", &wanted(&soft), &ratio(5, 1), "m/s²"),
        Finding::exact("depth at rest, d = 1/2", &depth(&soft), &ratio(2, 1000), "m"),
        Finding::exact("depth at rest, d = 19/20", &depth(&hard), &ratio(1, 5000), "m"),
        Finding::decision("the unloaded motions are the same", soft.effective(&one) == hard.effective(&one), true),
    ])
}
