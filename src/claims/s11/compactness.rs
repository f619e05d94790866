//! §11, the four steps of a convergence proof: bounded variation, Helly, weak* compactness, passage to the limit.

use crate::certificate::copositivity::copositive_plus;
use crate::certificate::definiteness::quadratic_form;
use crate::claims::experiments::wall::{Approach, Stepping, TESTS, approach, mass_apart, weak_bound, weak_error};
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
        argument: r"A mass between opposite walls, $H = (1, -1)^T$, both touching: $W = (1, -1; -1, 1)$ is copositive-plus, exactly, and
            $P = (c, c)$ solves $0 \le P \perp W\,P \ge 0$ for $c = 1$, $10^3$, $10^6$. One wall, plastic, $h = 2^{-4}$ … $2^{-8}$: the
            variation is 1 at every $h$.",
        controls: &[
            "Walls at right angles, whose cone is pointed.",
            r"The Stewart–Trinkle matrix of a contact with friction, $\mu = 1/2$, in place of $W$.",
            r"Moreau–Jean with $e = 1/2$ in place of the plastic step.",
        ],
        sources: &["chapter §11, step 1", "Stewart 1998 (not read)"],
        check: check!(bounded_variation),
    },
    Claim {
        id: "S11.impulse-infinite",
        statement: "Intuition: impulses cannot be unbounded, because energy would then grow without bound, against bounded external \
            forces.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"If $H^T\,P = 0$ with $P$ in the cone implies $P = 0$. Otherwise impulses that cancel each other do no work,
            and energy says nothing of them.",
        argument: r"Opposite walls: $P = (c, c)$ leaves a resting mass at rest, kinetic energy 0 for $c = 1$, $10^3$, $10^6$. A wedge with
            normals $(\pm3/5, 4/5)$: $P_1 + P_2 \le (5/4)\|H^TP\|$, since both normals have the component 4/5 along $(0, 1)$.",
        controls: &["Walls at right angles.", "Opposite walls in place of the wedge."],
        sources: &["chapter §11, step 1, intuition"],
        check: check!(energy_and_impulse),
    },
    Claim {
        id: "S11.helly",
        statement: "Step 2, Helly: of functions that are uniformly bounded with uniformly bounded variation a subsequence converges \
            pointwise, to a function of bounded variation.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated; a standard theorem, not proved here. That its hypothesis on the variation is needed, and that the \
            velocities of a scheme satisfy it, is checked.",
        argument: r"Stewart–Trinkle on a wall: variation 1 for $h = 2^{-4}$ … $2^{-8}$, and those of $2^{-7}$ and $2^{-8}$ differ on the
            step of the impact alone, 2 cells of 256. The signs of sin 2πnt, $n = 2$, 4, 8 …, are bounded, jump $2n - 1$ times, and any
            two of them differ on half of the interval, 128 cells: no subsequence converges.",
        controls: &["Those signs in place of the velocities."],
        sources: &["chapter §11, step 2", "Helly's selection theorem, in textbooks of real analysis"],
        check: check!(helly),
    },
    Claim {
        id: "S11.subseq",
        statement: "Hence a subsequence of the velocities converges pointwise, and the positions uniformly.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated. A subsequence is meant: at the time of an impact the whole sequence need not converge.",
        argument: r"Stewart–Trinkle on a wall that is hit at ⅓ s: $\int|v_h - v| = 4h/9$, which bounds the error of the position.
            $v_h = -1$ and 0 at 1/4 s and 1/2 s, but $v_h(\tfrac13) = -\tfrac13$ for $h = 2^{-k}$ with even $k$ and −⅔ with odd $k$: two
            values in the whole sequence.",
        controls: &[r"The whole sequence, $h = 2^{-4}$, $2^{-5}$, $2^{-6}$ …", r"Moreau–Jean with $e = 1/2$, which has another limit."],
        sources: &["chapter §11, step 2"],
        check: check!(subsequence),
    },
    Claim {
        id: "S11.weakstar",
        statement: "Step 3, Banach–Alaoglu: of impulse measures with bounded mass a subsequence converges weakly*.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated; $C([0, T])$ is separable. Weakly*, and in no stronger sense: not in mass.",
        argument: r"The same wall: $P_h$ has mass 1 in two steps next to ⅓ s, $\int g\,dP_h \to g(\tfrac13)$ for $g = t$, $t^2$,
            $|t - \tfrac12|$ with errors of at most $2h$ times the slope; the mass of $P_h - \delta_{\tfrac13}$ is 2 at every $h$.",
        controls: &[r"The impulses of Moreau–Jean with $e = 1/2$, which tend to another measure."],
        sources: &["chapter §11, step 3"],
        check: check!(weak_star),
    },
    Claim {
        id: "S11.atom",
        statement: "The limit of the impulses is a measure that may contain atoms; they are the impacts.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: $(1 + e)\,m\,|v|$ in every window around the impact, however narrow.",
        argument: r"Moreau–Jean on the wall, $e = \tfrac12$: the impulse within $2h$ of ⅓ s is 3/2 N s for $h = 2^{-4}$ … $2^{-8}$,
            that within $2h$ of ¾ s is 0.",
        controls: &["The two windows exchanged."],
        sources: &["chapter §11, step 3"],
        check: check!(atom),
    },
    Claim {
        id: "S11.step4",
        statement: "Step 4: complementarity and the normal-cone relation carry over to the limit because the graph of the normal cone is \
            closed.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Exact,
        correct_statement: r"The conclusion is the theorem's; the closed graph alone does not give it. $v_h$ converges pointwise and $P_h$
            weakly*, and $\int v_h\,dP_h$ need not converge to $\int v\,dP$: a further argument is needed where both jump, such as the
            energy balance.",
        argument: r"$v_h = 1$ from ½ on, $P_h = \delta$ at $\tfrac12 - h$: $\int v_h\,dP_h = 0$ at every $h$, $\int v\,dP = 1$.
            Stewart–Trinkle's own steps on the wall: $\sum\,v^+P = -2/9$ at every $h$, although $v^+ = 0$ in the limit and
            $P = \delta_{\tfrac13}$; while $\sum\,\tfrac12(v + v^+)P = -\tfrac12$ at every $h$, as in the limit.",
        controls: &[
            r"Moreau–Jean's plastic steps, and jumps at one instant: $\sum\,v^+P$ is that of the limit.",
            r"Moreau–Jean's steps with $e = 1/2$, which lose another energy.",
        ],
        sources: &["chapter §11, step 4"],
        check: check!(passage),
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
        argument: r"Stewart–Trinkle's constraint with the trapezoidal position update: variation of at most 2, a plastic body that
            rebounds at 2/5 of its speed for $h = 1/100$ and 1/1000. Its limit exists and violates the impact law.",
        controls: &["Stewart–Trinkle's own position update, whose plastic body stays at the wall."],
        sources: &["chapter §11, essential insight after step 4", "S4.nonpen"],
        check: check!(template),
    },
    Claim {
        id: "S11.ex1",
        statement: r"Exercise: for a mass that hits a wall the energy estimate bounds the variation of $v_h$ uniformly.",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: impulses push one way only, so $\sum\,P/m = v_N - v_0 + g\,T$ and the variation is at most
            $2\,g\,T + v_N - v_0 \le 2\,g\,T + \sqrt{2\,g\,q_0} + g\,h$ for a drop from $q_0$ with $e \le 1$.",
        argument: r"Moreau–Jean, $\theta = \tfrac12$, $e = \tfrac12$, $q_0 = 1/8$ m, $g = 10$ m/s², $T = 2$ s, $h = 2^{-4}$ … $2^{-12}$:
            no speed above $\sqrt{2\,g\,q_0} + g\,h$, no variation above the bound.",
        controls: &[r"$e = 4$, an impact that injects energy."],
        sources: &["chapter §11, exercise 1"],
        check: check!(exercise),
    },
];

const EXPONENTS: [u32; 5] = [4, 5, 6, 7, 8];

fn motions<const N: usize>(stepping: Stepping, exponents: [u32; N]) -> [Approach; N] {
    exponents.map(|k| approach(stepping, k))
}

fn largest(numbers: impl Iterator<Item = Rational>) -> Rational {
    numbers.fold(ratio(0, 1), |a, b| if a > b { a } else { b })
}

/// W of two walls that touch a mass of 1 kg.
fn walls(of: [[i64; 2]; 2]) -> DMatrix<Rational> {
    DMatrix::from_fn(2, 2, |i, j| ratio(of[i][j], 1))
}

const OPPOSITE: [[i64; 2]; 2] = [[1, -1], [-1, 1]];
const AT_RIGHT_ANGLES: [[i64; 2]; 2] = [[1, 0], [0, 1]];

/// (W, Wd, 0; …): the Stewart–Trinkle matrix of one planar contact with W = I and μ = 1/2, rows n, ±t, slip speed.
fn with_friction() -> DMatrix<Rational> {
    let twice = [[2, 0, 0, 0], [0, 2, -2, 2], [0, -2, 2, 2], [1, -2, -2, 0]];
    DMatrix::from_fn(4, 4, |i, j| ratio(twice[i][j], 2))
}

fn bounded_variation(reading: Reading) -> Result<Vec<Finding>> {
    let touching = walls(reading.only(0).pick(OPPOSITE, AT_RIGHT_ANGLES));
    let subject = reading.only(1).pick(touching.clone(), with_friction());
    let stepping = reading.only(2).pick(Stepping::StewartTrinkle, Stepping::MoreauJean);
    let solves = |c: i64| {
        let impulse = DVector::from_element(2, ratio(c, 1));
        let slack = Lcp::new(touching.clone(), DVector::from_element(2, ratio(0, 1))).slack(&impulse);
        slack.iter().all(|y| *y >= ratio(0, 1)) && slack.dot(&impulse) == ratio(0, 1)
    };
    let variation = largest(motions(stepping, EXPONENTS).iter().map(Approach::variation));
    Ok(vec![
        Finding::decision("W is copositive-plus", copositive_plus(&subject)?.holds(), true),
        // the problem is homogeneous: with (1, 1) every multiple solves it
        Finding::decision("P = (c, c) solves the problem, c = 1, 10³ and 10⁶", [1, 1000, 1_000_000].into_iter().all(solves), true)
            .says(false)
            .violating("a pointed friction cone"),
        Finding::exact("largest variation of v_h, h = 2⁻⁴ … 2⁻⁸", &variation, &ratio(1, 1), "m/s"),
    ])
}

fn energy_and_impulse(reading: Reading) -> Result<Vec<Finding>> {
    let touching = walls(reading.only(0).pick(OPPOSITE, AT_RIGHT_ANGLES));
    // ½ vᵀM v with M v = HᵀP
    let energies = [1, 1000, 1_000_000].map(|c| {
        let impulse = DVector::from_element(2, ratio(c, 1));
        quadratic_form(&touching, &impulse) * ratio(1, 2)
    });
    let grows = energies.windows(2).all(|pair| pair[0] < pair[1]);
    // the second components of the normals of the wedge, or of opposite walls, (±1, 0)
    let (across, along) = reading.only(1).pick((ratio(3, 5), ratio(4, 5)), (ratio(1, 1), ratio(0, 1)));
    // (5/4)²‖HᵀP‖² − (P₁ + P₂)² is a form of P
    let normals = DMatrix::from_row_slice(2, 2, &[across.clone(), along.clone(), -across, along]);
    let room = &normals * normals.transpose() * ratio(25, 16) - DMatrix::from_element(2, 2, ratio(1, 1));
    let bounded = |(first, second): &(i64, i64)| quadratic_form(&room, &dvector![ratio(*first, 1), ratio(*second, 1)]) >= ratio(0, 1);
    let holds = [(1, 0), (1, 1), (7, 2), (1, 1000)].iter().filter(|impulse| bounded(impulse)).count();
    Ok(vec![
        Finding::decision("the kinetic energy that P = (c, c) gives grows with c = 1, 10³, 10⁶", grows, false)
            .says(true)
            .violating("HᵀP = 0 only for P = 0"),
        Finding::count("wedge: P₁ + P₂ ≤ (5/4)‖HᵀP‖ at (1, 0), (1, 1), (7, 2), (1, 1000)", holds, 4),
    ])
}

/// The sign of sin 2πnt on the 256 cells (i/256, (i+1)/256), n = 2^j.
fn rademacher(j: u32) -> Vec<Rational> {
    (0..256u32).map(|cell| ratio(1 - 2 * i64::from((cell >> (7 - j)) & 1), 1)).collect()
}

/// v_h on those cells.
fn on_cells(motion: &Approach) -> Vec<Rational> {
    let cells = 256 / motion.outcomes.len();
    motion.outcomes.iter().flat_map(|outcome| std::iter::repeat_n(outcome.motion.velocity.clone(), cells)).collect()
}

/// The sum of a function's jumps from cell to cell.
fn jumps(cells: &[Rational]) -> Rational {
    cells.windows(2).map(|pair| (&pair[1] - &pair[0]).magnitude()).fold(ratio(0, 1), |a, b| a + b)
}

fn differing(one: &[Rational], other: &[Rational]) -> usize {
    one.iter().zip(other).filter(|(a, b)| a != b).count()
}

fn helly(reading: Reading) -> Result<Vec<Finding>> {
    let velocities: Vec<_> = motions(Stepping::StewartTrinkle, EXPONENTS).iter().map(on_cells).collect();
    let signs: Vec<_> = (1..=5).map(rademacher).collect();
    let sequence = reading.pick(&velocities, &signs);
    let pairs = (0..5).flat_map(|one| (0..one).map(move |other| (one, other)));
    let closest = pairs.map(|(one, other)| differing(&signs[one], &signs[other])).min().unwrap_or_default();
    Ok(vec![
        Finding::exact("largest variation of the five functions", &largest(sequence.iter().map(|cells| jumps(cells))), &ratio(1, 1), "1"),
        Finding::count("cells, of 256, on which the last two differ", differing(&sequence[3], &sequence[4]), 2),
        Finding::count("cells on which two of the signs of sin 2πnt differ at least", closest, 128).context(),
        Finding::exact("jumps of the sign of sin 2πnt, n = 32", &(jumps(&signs[4]) * ratio(1, 2)), &ratio(63, 1), "1").context(),
    ])
}

fn subsequence(reading: Reading) -> Result<Vec<Finding>> {
    let stepping = reading.only(1).pick(Stepping::StewartTrinkle, Stepping::MoreauJean);
    let members = motions(stepping, reading.only(0).pick([4, 6, 8, 10], [4, 5, 6, 7]));
    let distance = |motion: &Approach| motion.distance(&ratio(0, 1)) / &motion.step;
    let at_limit = |motion: &&Approach| motion.velocity_at(&ratio(1, 4)) == ratio(-1, 1) && motion.velocity_at(&ratio(1, 2)) == ratio(0, 1);
    let mut values: Vec<Rational> = members.iter().map(|motion| motion.velocity_at(&ratio(1, 3))).collect();
    values.sort();
    values.dedup();
    Ok(vec![
        Finding::exact("largest ∫|v_h − v|/h of four members", &largest(members.iter().map(distance)), &ratio(4, 9), "m/s"),
        Finding::count("members with the values of the limit at 1/4 s and 1/2 s", members.iter().filter(at_limit).count(), 4),
        Finding::count("different values at 1/3 s", values.len(), 1),
    ])
}

fn weak_star(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let members = motions(reading.pick(Stepping::StewartTrinkle, Stepping::MoreauJean), EXPONENTS);
    let mut findings = Vec::new();
    for (name, g) in TESTS {
        let relative = |motion: &Approach| weak_error(motion, g, &one) / weak_bound(motion, &one);
        let error = Scalar::to_f64(&largest(members.iter().map(relative)));
        findings.push(Finding::at_most(format!("largest error of ∫g dP_h over its bound 4h, g = {name}"), error, 1.0, "1"));
    }
    for (motion, k) in members.iter().zip(EXPONENTS) {
        findings.push(Finding::exact(format!("mass of P_h, h = 2^-{k}"), &motion.tested(|_| ratio(1, 1)), &one, "N·s"));
        findings.push(Finding::exact(format!("mass of P_h − δ_⅓, h = 2^-{k}"), &mass_apart(motion, &one), &ratio(2, 1), "N·s"));
    }
    Ok(findings)
}

fn atom(reading: Reading) -> Result<Vec<Finding>> {
    let (impact, late) = reading.pick((ratio(1, 3), ratio(3, 4)), (ratio(3, 4), ratio(1, 3)));
    let mut findings = Vec::new();
    for (motion, k) in motions(Stepping::MoreauJean, EXPONENTS).iter().zip(EXPONENTS) {
        let width = ratio(2, 1) * &motion.step;
        let (there, away) = (motion.window(&impact, &width), motion.window(&late, &width));
        findings.push(Finding::exact(format!("impulse within 2h of 1/3 s, h = 2^-{k}"), &there, &ratio(3, 2), "N·s"));
        findings.push(Finding::exact(format!("impulse within 2h of 3/4 s, h = 2^-{k}"), &away, &ratio(0, 1), "N·s"));
    }
    Ok(findings)
}

fn passage(reading: Reading) -> Result<Vec<Finding>> {
    let stepping = match reading {
        Reading::Recorded => Stepping::StewartTrinkle,
        Reading::Control(0) => Stepping::PlasticMoreauJean,
        Reading::Control(_) => Stepping::MoreauJean,
    };
    let together = "an argument for the times at which v and P jump together";
    let mut findings = Vec::new();
    for (motion, k) in motions(stepping, EXPONENTS).iter().zip(EXPONENTS) {
        let jump = |time: &Rational| ratio(i64::from(*time >= ratio(1, 2)), 1);
        let early = ratio(1, 2) - reading.only(0).pick(ratio(1, 1 << k), ratio(0, 1));
        findings.push(
            Finding::exact(format!("∫v_h dP_h of the two jumps, h = 2^-{k}"), &jump(&early), &ratio(0, 1), "J")
                .says(jump(&ratio(1, 2)))
                .violating(together),
        );
        // the plastic limit: v jumps from −1 to 0, P = δ_⅓
        let after = motion.work(|_, after| after.clone());
        findings.push(Finding::exact(format!("Σ v⁺P, h = 2^-{k}"), &after, &ratio(-2, 9), "J").says(ratio(0, 1)).violating(together));
        let mean = motion.work(|before, after| (before + after) * ratio(1, 2));
        findings.push(Finding::exact(format!("Σ ½(v + v⁺)P, h = 2^-{k}"), &mean, &ratio(-1, 2), "J"));
    }
    Ok(findings)
}

/// How the position of a Stewart–Trinkle step is updated.
#[derive(Clone, Copy)]
enum Update {
    /// q⁺ = q + ½h(v + v⁺).
    Trapezoidal,
    /// q⁺ = q + h v⁺.
    New,
}

/// Velocity of a plastic body after two steps of Stewart–Trinkle's constraint φ + h v⁺ ≥ 0 from φ = h/5, v = −1.
fn rebound(update: Update, h: &Rational) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution: ratio(0, 1) };
    let mut now = BallState { position: h / ratio(5, 1), velocity: ratio(-1, 1) };
    for _ in 0..2 {
        let velocity = ball.stewart_trinkle(&now, h).motion.velocity;
        let mean = match update {
            Update::Trapezoidal => (&now.velocity + &velocity) / ratio(2, 1),
            Update::New => velocity.clone(),
        };
        now = BallState { position: &now.position + h * mean, velocity };
    }
    now.velocity
}

fn template(reading: Reading) -> Result<Vec<Finding>> {
    let update = reading.pick(Update::Trapezoidal, Update::New);
    let at = |h: Rational| {
        let name = format!("rebound of the plastic body, h = {h}");
        Finding::exact(name, &rebound(update, &h), &ratio(2, 5), "1").opinion("whether a plan for a proof is a template")
    };
    Ok([ratio(1, 100), ratio(1, 1000)].map(at).to_vec())
}

fn exercise(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { mass: 1.0, gravity: 10.0, restitution: reading.pick(0.5, 4.0) };
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
