//! Claims of §5 on the price of the relaxation: creep where a block should stick, and what really happens.

use crate::claims::experiments::planar_step::{Block, magnitude};
use crate::claims::prelude::*;
use crate::problem::Law;

/// The claims of this file.
pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.gliding-creep",
        statement: r"Anitescu's relaxation produces a visible artefact: when the normal force is large, an object that should stick gets a
            tiny tangential slip, of order $O(h)$. (The example, a block at rest on an incline, is given of Drake's SAP.)",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"The hard relaxation sticks exactly: from rest at $\varphi = 0$ with $\tan \alpha \le \mu$ its step keeps
            $v = 0$. Its artefact belongs to sliding contacts, which hover at the gap $\varphi = \mu\,h\,|v_t|$. Creep of order $h$ in
            stick belongs to schemes that also regularise friction, such as Drake's SAP with its tangential softness $R_t$.",
        argument: r"At $\varphi = 0$, $v = 0$ the impulse $r = h\,m\,g\,(\cos \alpha, -\sin \alpha)$ lies in $K_\mu$ for
            $\tan \alpha \le \mu$ and makes $u = 0 \in K_\mu^*$; $r\cdot u = 0$, so this is the step, and $v^+$ is unique. 200 exact steps
            on the 3-4-5 slope, pressed with 8 m/s² as with 8000 m/s², $\mu = 751/1000$ and $h = 1/10$, 1/100, 1/1000 give $v_t = 0$ and
            $\varphi = 0$. Sliding ($\mu = 1/2$, started at $\varphi = \mu\,h\,v_t$): complementarity puts $u + (\varphi/h)\,n$ on the
            boundary of $K^*$, $\varphi + h\,v_n = \mu\,h\,|v_t|$, and $\varphi/(\mu\,h\,v_t) = 1$ after every step.",
        controls: &[
            r"The same block with the tangential softness $R_t = 1/1000$ kg⁻¹ of a regularised scheme, which does creep.",
            r"$\mu = 1/2$, with which the block slides and hovers.",
        ],
        sources: &["chapter §5, the price of convexity", "KKT conditions of the convex step"],
        check: check!(no_creep),
    },
    Claim {
        id: "S5.gliding-normal",
        statement: "When the normal force is large the body gets a tiny tangential slip proportional to the normal force, although it \
            should stick.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"The hard relaxation does not creep at all (S5.gliding-creep). With a tangential softness $R_t$ the creep is
            $v = R_t\,r_t$, proportional to the tangential impulse and independent of the normal load.",
        argument: r"The hard relaxation keeps a block that is pressed with 16 m/s² at $v_t = 0$. With $R_t = 1/1000$, in stick the law
            velocity $y_t = u_t + R_t\,r_t$ vanishes, so $u_t = -R_t\,r_t$ whatever $r_n$ is, as long as $|r_t| \le \mu\,r_n$. In 20 exact
            steps from rest: pressing twice as hard ($g_n$ $8 \to 16$ m/s²) changes the speed by the factor 1, pulling twice as hard along
            the slope ($g_t$ $3 \to 6$ m/s²) by the factor 2. (A heavier block does both at once.)",
        controls: &[r"A block with $R_t = 1/1000$, whose whole weight is doubled: its creep is twice as fast."],
        sources: &["chapter §5, the price of convexity"],
        check: check!(creep_follows_the_tangential_load),
    },
    Claim {
        id: "S5.gliding-mechanism",
        statement: r"The slip arises because the relaxed constraint $\mu(n\cdot v) + |D^Tv| \le 0$ couples the two velocities: in
            sustained contact, $n\cdot v \approx 0$, that does no harm, but through the gap term and softening there is a small
            penetration velocity along the normal, which leaks into tangential slip.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"The constraint is $n\cdot v + \varphi/h \ge \mu|v_t|$. It lets tangential motion force normal lift,
            $u_n = \mu|u_t|$; a normal approach or a penetration forces no tangential motion.",
        argument: r"A block with $\mu = 1$ that arrives with $v_n = -1/10$ under the tangential load of the 3-4-5 slope stops:
            $v^+ = (0, 0)$. The same block at rest 1/1000 deep leaves with $v^+ = (1/10, 0)$ for $h = 1/100$: no slip in that step.
            (Gravity then acts along the slope while the contact is open, under Coulomb's law as well.) Conversely a tangential velocity
            of 1 m/s with $\mu = 1/2$ on level ground without gravity becomes $v_t = 1/(1 + \mu^2)$ and $v_n = \mu/(1 + \mu^2) = 2/5$. The
            leak needs the sign as printed: the set $\mu\,n\cdot v + |v_t| \le 0$ contains the velocity of the free motion into the slope
            and lets it pass. (One mistake, counted at S5.relaxed-constraint.)",
        controls: &["The printed set: the velocity it leaves to either block is its free one, because the set contains it."],
        sources: &["chapter §5, the price of convexity and exercise 2"],
        check: check!(no_leak),
    },
    Claim {
        id: "S5.glide-h-not-mu",
        statement: r"The $O(h)$ gliding is inherent to the scheme and no wrong parameter; the slip is proportional to $h$ and not
            (exercise 2) to the friction coefficient, and raising $\mu$ only treats the symptom.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"True of the creep of a block at rest under a regularised convex scheme ($R_t$ independent of $h$, as in
            Drake's SAP): $v = R_t\,r_t$ is proportional to $h$ and independent of $\mu$. The hard relaxation has no creep; its sliding
            gap $\mu\,h\,|v_t|$ is proportional to $h$ and to $\mu$.",
        argument: r"$R_t = 1/1000$, 20 exact steps from rest on the 3-4-5 slope: the creep with $h/10$ is 1/10 of that with $h$, and
            $\mu = 1$ and $\mu = 2$ give the same creep, because $u_t^+ = (u_t + h\,g_t)\cdot R_t/(1 + R_t)$ contains no $\mu$. The gap of
            a hard slide is $\varphi = \mu\,h\,v_t$: 1/2 and 1/4 of $h\,v_t$ for $\mu = 1/2$ and $\mu = 1/4$.",
        controls: &[
            r"The same block with $R_t = 1/1000$ in place of the hard relaxation: it slips.",
            r"$\mu = 1/2 < \tan \alpha$ in place of 1: the block slides.",
            r"A damper in place of the softness, $R_t \propto 1/h$, as in MuJoCo: its creep does not shrink with $h$.",
        ],
        sources: &["chapter §5, pitfalls and exercise 2"],
        check: check!(proportional_to_h),
    },
];

/// R_t \[1/kg\] of the regularised block.
fn softness() -> Rational {
    ratio(1, 1000)
}

fn no_creep(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let friction = reading.only(1).pick(ratio(751, 1000), ratio(1, 2));
    // rationals of the controls grow with every step
    let steps = reading.pick(200, 10);
    for (denominator, press) in [(10, 8), (100, 8), (1000, 8), (100, 8000)] {
        let (h, normal_gravity) = (ratio(1, denominator), ratio(press, 1));
        let tangential_gravity = ratio(3, 4) * &normal_gravity;
        let tangential_softness = reading.only(0).pick(ratio(0, 1), softness());
        let mut block = Block { normal_gravity, tangential_gravity, tangential_softness, ..Block::at_rest(friction.clone()) };
        block.steps(steps, &h)?;
        let slips = block.velocity[1] != ratio(0, 1);
        let name = format!("pressed with {press} m/s², h = 1/{denominator}");
        findings.push(Finding::decision(format!("a block that should stick slips, {name}"), slips, false).says(true));
        findings.push(Finding::exact(format!("φ of a block that should stick, {name}"), &block.gap, &ratio(0, 1), "m"));
    }
    let (h, mu) = (ratio(1, 100), ratio(1, 2));
    let block = slide(&mu, &h)?;
    let hover = block.gap / (mu * h * block.velocity[1].clone());
    findings.push(Finding::exact("φ/(μ h v_t) in a slide", &hover, &ratio(1, 1), "1").context());
    Ok(findings)
}

/// 30 exact steps of a slide that starts at v_t = 1 m/s with its own gap μ h v_t, under the hard relaxation.
fn slide(friction: &Rational, h: &Rational) -> Result<Block> {
    let mut block = Block::at_rest(friction.clone());
    block.velocity = [ratio(0, 1), ratio(1, 1)];
    block.gap = friction.clone() * h.clone();
    block.steps(30, h)?;
    Ok(block)
}

/// Speed after 20 exact steps h from rest under the given loads.
fn creep(friction: Rational, normal_gravity: Rational, tangential_gravity: Rational, h: &Rational) -> Result<Rational> {
    softened_creep(Block { normal_gravity, tangential_gravity, tangential_softness: softness(), ..Block::at_rest(friction) }, h)
}

fn softened_creep(mut block: Block, h: &Rational) -> Result<Rational> {
    block.steps(20, h)?;
    Ok(block.velocity[1].clone())
}

fn creep_follows_the_tangential_load(reading: Reading) -> Result<Vec<Finding>> {
    let h = ratio(1, 100);
    let speed = |normal: i64, tangential: i64| creep(ratio(1, 1), ratio(normal, 1), ratio(tangential, 1), &h);
    // pressed twice as hard, or of twice the weight
    let (normal, tangential) = reading.pick((16, 6), (16, 12));
    Ok(vec![
        Finding::decision("a block that should stick slips under a large normal load", rest_slips(reading)?, false).says(true),
        Finding::exact("creep with twice the normal load, relative", &(speed(normal, tangential)? / speed(8, 6)?), &ratio(1, 1), "1")
            .says(ratio(2, 1)),
        Finding::exact("creep with twice the tangential load, relative", &(speed(8, 6)? / speed(8, 3)?), &ratio(2, 1), "1").context(),
    ])
}

/// Whether a block pressed with 16 m/s² slips in 20 steps from rest, under the hard relaxation or with regularised friction.
fn rest_slips(reading: Reading) -> Result<bool> {
    let tangential_softness = reading.pick(ratio(0, 1), softness());
    let mut block = Block { normal_gravity: ratio(16, 1), tangential_softness, ..Block::at_rest(ratio(1, 1)) };
    block.steps(20, &ratio(1, 100))?;
    Ok(block.velocity[1] != ratio(0, 1))
}

fn no_leak(reading: Reading) -> Result<Vec<Finding>> {
    let h = ratio(1, 100);
    let arriving = Block { velocity: [ratio(-1, 10), ratio(0, 1)], ..Block::at_rest(ratio(1, 1)) };
    let deep = Block { gap: ratio(-1, 1000), ..Block::at_rest(ratio(1, 1)) };
    let mut shoved = Block {
        normal_gravity: ratio(0, 1),
        tangential_gravity: ratio(0, 1),
        velocity: [ratio(0, 1), ratio(1, 1)],
        ..Block::at_rest(ratio(1, 2))
    };
    shoved.step(&h)?;
    Ok(vec![
        Finding::decision("an approach along the normal leaks into slip", slip(reading, arriving, &h)? != ratio(0, 1), false).says(true),
        Finding::decision("a penetration leaks into slip", slip(reading, deep, &h)? != ratio(0, 1), false).says(true),
        Finding::exact("v_n forced by 1 m/s of tangential velocity", &shoved.velocity[0], &ratio(2, 5), "m/s").context(),
    ])
}

/// v_t after one step under the relaxation; or under the printed set, which leaves a velocity that it contains as it is.
fn slip(reading: Reading, mut block: Block, h: &Rational) -> Result<Rational> {
    if !reading.is_control() {
        block.step(h)?;
        return Ok(block.velocity[1].clone());
    }
    let normal = &block.velocity[0] - h * &block.normal_gravity + &block.gap / h;
    let tangential = &block.velocity[1] + h * &block.tangential_gravity;
    if &block.friction * normal + magnitude(&tangential) > ratio(0, 1) {
        return Err(Error::Unsupported("the printed set does not contain the free velocity".into()));
    }
    Ok(tangential)
}

fn proportional_to_h(reading: Reading) -> Result<Vec<Finding>> {
    let h = ratio(1, 100);
    // R_t, or one that grows as 1/h and is the same at h = 1/100
    let softness_at = |h: &Rational| reading.only(2).pick(softness(), softness() / (ratio(100, 1) * h));
    let creep =
        |friction: Rational, h: &Rational| softened_creep(Block { tangential_softness: softness_at(h), ..Block::at_rest(friction) }, h);
    let lower = || reading.only(1).pick(ratio(1, 1), ratio(1, 2));
    let of_h = |h: &Rational| creep(ratio(1, 1), h);
    let between = creep(lower(), &h)? / creep(ratio(2, 1), &h)?;
    let gaps = relative_gap(ratio(1, 2), &h)? / relative_gap(ratio(1, 4), &h)?;
    Ok(vec![
        Finding::exact("creep with μ = 1 over creep with μ = 2, R_t = 1/1000", &between, &ratio(1, 1), "1"),
        Finding::exact("creep with h/10 over creep with h", &(of_h(&ratio(1, 1000))? / of_h(&h)?), &ratio(1, 10), "1"),
        Finding::decision("a block that should stick slips under the hard relaxation", rest_slips(reading.only(0))?, false).says(true),
        Finding::exact("sliding gap φ/(h v_t) for μ = 1/2 over that for μ = 1/4", &gaps, &ratio(2, 1), "1").context(),
    ])
}

/// φ/(h v_t) of a hard slide.
fn relative_gap(friction: Rational, h: &Rational) -> Result<Rational> {
    let block = slide(&friction, h)?;
    debug_assert_eq!(block.law, Law::Associated);
    Ok(block.gap / (h.clone() * block.velocity[1].clone()))
}
