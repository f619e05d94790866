//! §11, the four steps of a convergence proof: bounded variation, Helly, weak* compactness, passage to the limit.

use crate::certificate::copositivity::copositive_plus;
use crate::claims::experiments::wall::trapezoidal_rebound;
use crate::claims::experiments::wall::{Approach, Stepping, approach};
use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState};
use crate::problem::Lcp;
use crate::schemes::Activation;
use crate::tolerance::claims::lcp::repeated_steps;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S11.bv",
        statement: "Step 1: the velocities of all steps have uniformly bounded variation. Copositive-plus bounds the impulse of every \
            step's complementarity problem, the energy the dissipation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "With a pointed friction cone (no impulses that cancel) and starts that do not penetrate. Copositive-plus \
            yields a solution, not a bound on it; and the Stewart–Trinkle matrix has it only without friction (S4.copos-plus).",
        argument: "A mass between opposite walls, H = (1, −1)ᵀ, both touching: W = (1, −1; −1, 1) is copositive-plus, exactly, and P = (c, \
            c) solves 0 ≤ P ⟂ W P ≥ 0 for c = 1, 10³, 10⁶. One wall, plastic, h = 2⁻⁴ … 2⁻⁸: the variation is 1 at every h.",
        controls: &["Walls at right angles, whose cone is pointed."],
        sources: &["chapter §11, step 1", "Stewart 1998 (not read)"],
        check: bounded_variation,
    },
    Claim {
        id: "S11.impulse-infinite",
        statement: "Impulses cannot be unbounded, because energy would then grow without bound.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "If Hᵀ P = 0 with P in the cone implies P = 0. Otherwise impulses that cancel each other do no work, and energy \
            says nothing of them.",
        argument: "Opposite walls: P = (c, c) leaves a resting mass at rest, kinetic energy 0 for c = 1, 10³, 10⁶. A wedge with normals \
            (±3/5, 4/5): P₁ + P₂ ≤ (5/4)‖HᵀP‖, since both normals have the component 4/5 along (0, 1).",
        controls: &["Walls at right angles."],
        sources: &["chapter §11, step 1, intuition"],
        check: energy_and_impulse,
    },
    Claim {
        id: "S11.helly",
        statement: "Step 2, Helly: of functions that are uniformly bounded with uniformly bounded variation a subsequence converges \
            pointwise, to a function of bounded variation.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated; a standard theorem, not proved here. That its hypothesis on the variation is needed, and that the \
            velocities of a scheme satisfy it, is checked.",
        argument: "Stewart–Trinkle on a wall: variation 1 for h = 2⁻⁴ … 2⁻⁸. The signs of sin 2πnt, n = 2⁰ … 2⁵, are bounded, jump 2n − 1 \
            times, and any two of them differ on half of the interval: no subsequence converges.",
        controls: &["Those signs in place of the velocities."],
        sources: &["chapter §11, step 2", "Helly's selection theorem, in textbooks of real analysis"],
        check: helly,
    },
    Claim {
        id: "S11.subseq",
        statement: "Hence a subsequence of the velocities converges pointwise, and the positions uniformly.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated. A subsequence is meant: at the time of an impact the whole sequence need not converge.",
        argument: "Stewart–Trinkle on a wall that is hit at ⅓ s: ∫|v_h − v| = 4h/9, which bounds the error of the position. v_h = −1 and 0 \
            at 1/4 s and 1/2 s, but v_h(⅓) = −⅓ for h = 2⁻ᵏ with even k and −⅔ with odd k.",
        controls: &["The whole sequence at ⅓ s."],
        sources: &["chapter §11, step 2"],
        check: subsequence,
    },
    Claim {
        id: "S11.weakstar",
        statement: "Step 3, Banach–Alaoglu: of impulse measures with bounded mass a subsequence converges weakly*.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated; C([0, T]) is separable. Weakly*, and in no stronger sense: not in mass.",
        argument: "The same wall: P_h has mass 1 in two steps next to ⅓ s, ∫g dP_h → g(⅓) for g = t, t², |t − ⅓| with errors of at most 2h \
            times the slope; the mass of P_h − δ_⅓ is 2 at every h.",
        controls: &["The impulses of Moreau–Jean with e = 1/2, which tend to another measure."],
        sources: &["chapter §11, step 3"],
        check: weak_star,
    },
    Claim {
        id: "S11.atom",
        statement: "The limit of the impulses is a measure that may contain atoms; they are the impacts.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated: (1 + e) m |v| in every window around the impact, however narrow.",
        argument: "Moreau–Jean on the wall, e = ½: the impulse within 2h of ⅓ s is 3/2 N s for h = 2⁻⁴ … 2⁻⁸, that within 2h of ¾ s is 0.",
        controls: &["The window at ¾ s."],
        sources: &["chapter §11, step 3"],
        check: atom,
    },
    Claim {
        id: "S11.step4",
        statement: "Step 4: complementarity and the normal-cone relation carry over to the limit because the graph of the normal cone is \
            closed.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Exact,
        correct_statement: "The conclusion is the theorem's; the closed graph alone does not give it. v_h converges pointwise and P_h \
            weakly*, and ∫v_h dP_h need not converge to ∫v dP: a further argument is needed where both jump, such as the energy balance.",
        argument: "v_h = 1 from ½ on, P_h = δ at ½ − h: ∫v_h dP_h = 0 at every h, ∫v dP = 1. Stewart–Trinkle's own steps on the wall: Σ \
            v⁺P = −2/9 at every h, although v⁺ = 0 in the limit and P = δ_⅓; while Σ ½(v + v⁺)P = −½ at every h, as in the limit.",
        controls: &["Moreau–Jean's steps with e = 1/2, and jumps at one instant: Σ v⁺P is that of the limit."],
        sources: &["chapter §11, step 4"],
        check: passage,
    },
    Claim {
        id: "S11.no-taylor",
        statement: "The four steps are a template: whoever wants to prove a new scheme convergent goes through them, with compactness in \
            place of Taylor expansions.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Advice,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "A plan, not a theorem. Steps 1 to 3 can succeed with a limit that is no solution: step 4 has to be proved for \
            each scheme.",
        argument: "Stewart–Trinkle's constraint with the trapezoidal position update: variation of at most 2, a plastic body that rebounds \
            at 2/5 of its speed for h = 1/100 and 1/1000. Its limit exists and violates the impact law.",
        controls: &["Stewart–Trinkle's own position update, whose plastic body stays at the wall."],
        sources: &["chapter §11, essential insight after step 4", "S4.nonpen"],
        check: template,
    },
    Claim {
        id: "S11.ex1",
        statement: "Exercise: for a mass that hits a wall the energy estimate bounds the variation of v_h uniformly.",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated: impulses push one way only, so Σ P/m = v_N − v_0 + g T and the variation is at most 2 g T + v_N − \
            v_0 ≤ 2 g T + √(2 g q₀) + g h for a drop from q₀ with e ≤ 1.",
        argument: "Moreau–Jean, θ = ½, e = ½, q₀ = 1/8 m, g = 10 m/s², T = 2 s, h = 2⁻⁴ … 2⁻¹²: no speed above √(2 g q₀) + g h, no \
            variation above the bound.",
        controls: &["e = 2."],
        sources: &["chapter §11, exercise 1"],
        check: exercise,
    },
];

const EXPONENTS: [u32; 5] = [4, 5, 6, 7, 8];

fn plastic(k: u32) -> Approach {
    approach(Stepping::StewartTrinkle, k)
}

fn exact(entries: &[i64], denominator: i64) -> DMatrix<Rational> {
    DMatrix::from_row_slice(2, 2, &entries.iter().map(|x| ratio(*x, denominator)).collect::<Vec<_>>())
}

/// W of two walls that touch a mass of 1 kg: opposite, or at right angles.
fn two_walls(reading: Reading) -> DMatrix<Rational> {
    reading.pick(exact(&[1, -1, -1, 1], 1), exact(&[1, 0, 0, 1], 1))
}

fn bounded_variation(reading: Reading) -> Result<Vec<Finding>> {
    let walls = two_walls(reading);
    let mut findings = vec![Finding::decision("W is copositive-plus", copositive_plus(&walls)?.holds(), true)];
    let solves = |c: i64| {
        let impulse = DVector::from_element(2, ratio(c, 1));
        let slack = Lcp::new(walls.clone(), DVector::from_element(2, ratio(0, 1))).slack(&impulse);
        slack.iter().all(|y| *y >= ratio(0, 1)) && slack.dot(&impulse) == ratio(0, 1)
    };
    // the problem is homogeneous: with (1, 1) every multiple solves it
    findings.push(
        Finding::decision("P = (c, c) solves the problem, c = 1, 10³ and 10⁶", [1, 1000, 1_000_000].into_iter().all(solves), true)
            .says(false)
            .violating("a pointed friction cone"),
    );
    findings.extend(EXPONENTS.map(|k| variation(&plastic(k), k)));
    Ok(findings)
}

fn variation(approach: &Approach, k: u32) -> Finding {
    Finding::exact(format!("variation of v_h, h = 2^-{k}"), &approach.variation(), &ratio(1, 1), "m/s")
}

fn energy_and_impulse(reading: Reading) -> Result<Vec<Finding>> {
    let walls = two_walls(reading);
    // ½ vᵀM v with M v = HᵀP
    let energies = [1, 1000, 1_000_000].map(|c| {
        let impulse = DVector::from_element(2, ratio(c, 1));
        impulse.dot(&(&walls * &impulse)) * ratio(1, 2)
    });
    let grows = energies.windows(2).all(|pair| pair[0] < pair[1]);
    let mut findings = vec![
        Finding::decision("the kinetic energy that P = (c, c) gives grows with c = 1, 10³, 10⁶", grows, false)
            .says(true)
            .violating("HᵀP = 0 only for P = 0"),
    ];
    let normals = exact(&[3, 4, -3, 4], 5);
    for (first, second) in [(1, 0), (1, 1), (7, 2), (1, 1000)] {
        let impulse = DVector::from_vec(vec![ratio(first, 1), ratio(second, 1)]);
        let (total, pushed) = (impulse.sum(), normals.transpose() * &impulse);
        let margin = pushed.dot(&pushed) * ratio(25, 16) - &total * &total;
        findings.push(Finding::decision(format!("wedge: the bound holds at P = ({first}, {second})"), margin >= ratio(0, 1), true));
    }
    Ok(findings)
}

/// The sign of sin 2πnt on (i/64, (i+1)/64), n = 2^j.
fn rademacher(j: u32, cell: u32) -> i64 {
    1 - 2 * i64::from((cell >> (5 - j)) & 1)
}

fn helly(reading: Reading) -> Result<Vec<Finding>> {
    let signs = |j: u32| (0..64).map(move |cell| rademacher(j, cell));
    let turns = |j: u32| signs(j).zip(signs(j).skip(1)).filter(|(a, b)| a != b).count();
    let mut findings = Vec::new();
    for k in EXPONENTS {
        findings.push(match reading {
            Reading::Recorded => variation(&plastic(k), k),
            Reading::Control(_) => Finding::exact(
                format!("half the variation of sign sin, n = 2^{}", k - 3),
                &ratio(turns(k - 3) as i64, 1),
                &ratio(1, 1),
                "1",
            ),
        });
    }
    for j in 0..=5u32 {
        findings.push(Finding::count(format!("jumps of sign sin 2πnt, n = 2^{j}"), turns(j), (2 << j) - 1));
        for other in 0..j {
            let apart = signs(j).zip(signs(other)).filter(|(a, b)| a != b).count();
            findings.push(Finding::count(format!("64ths in which n = 2^{j} and 2^{other} differ"), apart, 32));
        }
    }
    Ok(findings)
}

fn subsequence(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for k in EXPONENTS {
        let motion = plastic(k);
        let distance = motion.distance(&ratio(0, 1));
        findings.push(Finding::exact(format!("∫|v_h − v|, h = 2^-{k}"), &distance, &(&motion.step * ratio(4, 9)), "m"));
        for (time, limit) in [(ratio(1, 4), ratio(-1, 1)), (ratio(1, 2), ratio(0, 1))] {
            findings.push(Finding::exact(format!("v_h({time}), h = 2^-{k}"), &motion.velocity_at(&time), &limit, "m/s"));
        }
        if k % 2 == 0 || reading.is_control() {
            let there = motion.velocity_at(&ratio(1, 3));
            findings.push(Finding::exact(format!("v_h(1/3), h = 2^-{k}"), &there, &ratio(-1, 3), "m/s"));
        }
    }
    Ok(findings)
}

/// Continuous functions of slope at most 2 on \[0, 1\], and their values at ⅓.
type Test = (&'static str, fn(&Rational) -> Rational);

const TESTS: [Test; 3] =
    [("t", |t| t.clone()), ("t²", |t| t * t), ("|t − 1/3|", |t| if *t > ratio(1, 3) { t - ratio(1, 3) } else { ratio(1, 3) - t })];

/// |∫g dP_h − (1 + e) g(⅓)| within 4h(1 + e) for the three functions: all of P_h lies within 2h of ⅓.
pub fn weakly(approach: &Approach, mass: &Rational, label: &str) -> Vec<Finding> {
    let bound = ratio(4, 1) * &approach.step * mass;
    let finding = |(name, g): Test| {
        let error = Scalar::to_f64(&(approach.tested(g) - g(&ratio(1, 3)) * mass).magnitude());
        Finding::at_most(format!("error of ∫g dP_h, g = {name}, {label}"), error, Scalar::to_f64(&bound), "N·s")
    };
    TESTS.map(finding).to_vec()
}

/// The mass of P_h − m δ_⅓: no step ends at ⅓.
pub fn mass_apart(approach: &Approach, mass: &Rational) -> Rational {
    let at_impact = approach.window(&ratio(1, 3), &ratio(0, 1));
    let size = |x: Rational| if x < ratio(0, 1) { -x } else { x };
    approach.tested(|_| ratio(1, 1)) - &at_impact + size(at_impact - mass)
}

fn weak_star(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let mut findings = Vec::new();
    for k in EXPONENTS {
        let motion = approach(reading.pick(Stepping::StewartTrinkle, Stepping::MoreauJean), k);
        findings.push(Finding::exact(format!("mass of P_h, h = 2^-{k}"), &motion.tested(|_| ratio(1, 1)), &one, "N·s"));
        findings.extend(weakly(&motion, &one, &format!("h = 2^-{k}")));
        findings.push(Finding::exact(format!("mass of P_h − δ_⅓, h = 2^-{k}"), &mass_apart(&motion, &one), &ratio(2, 1), "N·s"));
    }
    Ok(findings)
}

fn atom(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for k in EXPONENTS {
        let motion = approach(Stepping::MoreauJean, k);
        let width = ratio(2, 1) * &motion.step;
        let centre = reading.pick(ratio(1, 3), ratio(3, 4));
        findings.push(Finding::exact(
            format!("impulse within 2h of {centre} s, h = 2^-{k}"),
            &motion.window(&centre, &width),
            &ratio(3, 2),
            "N·s",
        ));
        let away = motion.window(&ratio(3, 4), &width);
        findings.push(Finding::exact(format!("impulse within 2h of 3/4 s, h = 2^-{k}"), &away, &ratio(0, 1), "N·s"));
    }
    Ok(findings)
}

fn passage(reading: Reading) -> Result<Vec<Finding>> {
    let (zero, one) = (ratio(0, 1), ratio(1, 1));
    // in the limit v jumps from −1 to e, and P = (1 + e) δ_⅓
    let (stepping, e) = reading.pick((Stepping::StewartTrinkle, zero.clone()), (Stepping::MoreauJean, ratio(1, 2)));
    let impulse = &one + &e;
    let together = "an argument for the times at which v and P jump together";
    let mut findings = Vec::new();
    for k in EXPONENTS {
        let jump = |time: &Rational| ratio(i64::from(*time >= ratio(1, 2)), 1);
        let early = ratio(1, 2) - reading.pick(ratio(1, 1 << k), zero.clone());
        findings.push(
            Finding::exact(format!("∫v_h dP_h of the two jumps, h = 2^-{k}"), &jump(&early), &zero, "J")
                .says(jump(&ratio(1, 2)))
                .violating(together),
        );
        let motion = approach(stepping, k);
        let after = motion.work(|_, after| after.clone());
        findings.push(Finding::exact(format!("Σ v⁺P, h = 2^-{k}"), &after, &ratio(-2, 9), "J").says(&e * &impulse).violating(together));
        let mean = motion.work(|before, after| (before + after) * ratio(1, 2));
        let of_limit = (&e - &one) * ratio(1, 2) * &impulse;
        findings.push(Finding::exact(format!("Σ ½(v + v⁺)P, h = 2^-{k}"), &mean, &of_limit, "J"));
    }
    Ok(findings)
}

/// Velocity after two steps of Stewart–Trinkle from φ = h/5, v = −1, plastic.
fn rebound(h: &Rational) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution: ratio(0, 1) };
    let start = BallState { position: h / ratio(5, 1), velocity: ratio(-1, 1) };
    let first = ball.stewart_trinkle(&start, h).motion;
    ball.stewart_trinkle(&first, h).motion.velocity
}

fn template(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.pick(trapezoidal_rebound as fn(&Rational) -> Rational, rebound);
    let at = |denominator: i64| {
        let name = format!("rebound of the plastic body, h = 1/{denominator}");
        Finding::exact(name, &law(&ratio(1, denominator)), &ratio(2, 5), "1").opinion("whether a plan for a proof is a template")
    };
    Ok([100, 1000].map(at).to_vec())
}

fn exercise(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { mass: 1.0, gravity: 10.0, restitution: reading.pick(0.5, 2.0) };
    let mut findings = Vec::new();
    for k in [4, 6, 8, 10, 12] {
        let steps = 2usize << k;
        let h = 2.0 / steps as f64;
        let mut now = BallState { position: 0.125, velocity: 0.0 };
        let [mut variation, mut fastest] = [0.0f64; 2];
        for _ in 0..steps {
            let next = ball.moreau_jean(&now, &0.5, Activation::Gap, &h).motion;
            variation += (next.velocity - now.velocity).abs();
            fastest = fastest.max(next.velocity.abs());
            now = next;
        }
        let speed = (2.0 * ball.gravity * 0.125f64).sqrt() + ball.gravity * h + repeated_steps(steps);
        findings.push(Finding::at_most(format!("largest |v_h|, h = 2^-{k}"), fastest, speed, "m/s"));
        findings.push(Finding::at_most(format!("variation of v_h, h = 2^-{k}"), variation, 2.0 * ball.gravity * 2.0 + speed, "m/s"));
    }
    Ok(findings)
}
