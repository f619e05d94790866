//! Filippov's sliding mode, and sticking as one.

use crate::claims::prelude::*;
use crate::closed_forms::{BeltOscillator, DryFrictionOscillator};
use crate::elimination::solve;
use crate::event_driven::EventDriven;
use crate::event_driven::filippov::{DryFriction, Mode, Side, Switch, advance, share_above};
use crate::event_driven::flight::{Control, Location};
use crate::tolerance::claims::events::{ACCURACY, LOCATED_ORDER, SWITCHING};
use crate::trajectory::{Refinement, fit_order};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S1.filippov",
        statement: r"On a switching surface that the fields of both sides point at, the sliding mode is the convex combination
            $\dot x = \alpha\,f_+ + (1 - \alpha)\,f_-$, and $\alpha$ is fixed uniquely by $\dot s = 0$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, for one surface, which the chapter says: $\alpha = \nabla s\cdot f_-/(\nabla s\cdot f_- - \nabla
            s\cdot f_+) \in (0, 1)$. Where one field crosses the surface there is no such $\alpha$ in $[0, 1]$; where two surfaces meet,
            four fields and three conditions leave a family.",
        argument: r"$\dot s = \alpha\nabla s\cdot f_+ + (1 - \alpha)\nabla s\cdot f_-$ is affine in $\alpha$, positive at $\alpha = 0$ and
            negative at $\alpha = 1$: one zero, inside. Several pairs of rational fields. That the combination is what happens: a relay
            with a hysteresis $\pm\varepsilon$ zigzags across the surface, $2\varepsilon/|\nabla s\cdot f_+|$ above and
            $2\varepsilon/(\nabla s\cdot f_-)$ below, and its mean velocity along the surface is exactly that of the combination.",
        controls: &["Fields of which one crosses the surface."],
        sources: &["chapter §1, Filippov systems and sliding modes", "Filippov 1988, §4"],
        check: check!(convex_combination),
    },
    Claim {
        id: "S1.stick-sliding",
        statement: r"Sticking under Coulomb friction is a sliding mode on $v_t = 0$, slipping is regular motion.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated.",
        argument: r"The dry-friction oscillator ($\delta = 0.15$, $q_0 = 1$) integrated as a Filippov system enters the sliding mode at
            the end of a half-cycle and stays, with $\alpha = \tfrac12(1 - q/\delta)$; on the belt it is in the mode for $2\Delta/v_b$ in
            each period: both as the closed forms of Coulomb's law say.",
        controls: &[
            "A belt with less sticking friction, 0.6 in the place of 0.7, in the simulation.",
            "A third of the friction on the oscillator: it still swings at the end.",
        ],
        sources: &["chapter §1, relation to contact"],
        check: check!(sticking),
    },
    Claim {
        id: "S1.pk",
        statement: "The event-driven method of Piiroinen and Kuznetsov (ACM TOMS, 2008) detects entering and leaving the sliding mode \
            exactly and integrates it accurately, more finely than time-stepping.",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated, “exactly” meaning to the accuracy of the integrator and the root finder. The paper was not read; \
            what its kind of method can do is measured on one of our own.",
        argument: r"Belt: releases follow each other after the period of the closed form to $10^{-9}$ s. With fixed steps and located
            switches the state has the order of the integrator, with switches noticed at the end of a step they are late by the rest of
            the step.",
        controls: &["Switches that are located and those noticed at the end of a step, exchanged."],
        sources: &["chapter §1, advantage of event-driven methods", "Piiroinen and Kuznetsov, ACM TOMS 34(3), 2008 (not read)"],
        check: check!(detection),
    },
];

/// The velocity (across, along) of the combination α f₊ + (1−α) f₋, fields given by their components (along ∇s, along the surface).
fn combined(share: &Rational, above: &[Rational; 2], below: &[Rational; 2]) -> [Rational; 2] {
    [0, 1].map(|k| share * &above[k] + (ratio(1, 1) - share) * &below[k])
}

/// α of the combination that stays on the surface: with its weights α and β, α ∇s·f₊ + β ∇s·f₋ = 0 and α + β = 1.
fn share_of(above: &[Rational; 2], below: &[Rational; 2]) -> Result<Rational> {
    let (one, across) = (ratio(1, 1), DMatrix::from_row_slice(1, 2, &[above[0].clone(), below[0].clone()]));
    let weights = solve(&across.insert_row(1, one.clone()), &dvector![ratio(0, 1), one]);
    weights.map(|weights| weights[0].clone()).ok_or_else(|| Error::Unsupported("both fields cross the surface alike".into()))
}

/// Mean velocity along the surface of a relay that switches at s = ±1: once up in the field below, once down in the field above; for ever
/// in the field above, if that does not lead back.
fn relay(above: &[Rational; 2], below: &[Rational; 2]) -> Rational {
    if above[0] >= ratio(0, 1) {
        return above[1].clone();
    }
    let (down, up) = (ratio(-2, 1) / &above[0], ratio(2, 1) / &below[0]);
    (&down * &above[1] + &up * &below[1]) / (&down + &up)
}

fn convex_combination(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (above, below, slip) in [(-3, 2, [1, 0]), (-1, 5, [2, -1]), (-4, 1, [-1, 3])] {
        let posed = [ratio(above, 7), ratio(slip[0], 1)];
        let above = [ratio(reading.pick(above, -above), 7), ratio(slip[0], 1)];
        let below = [ratio(below, 5), ratio(slip[1], 1)];
        let name = format!("∇s·f₊ = {}, ∇s·f₋ = {}", posed[0], below[0]);
        let [_, along] = combined(&share_of(&posed, &below)?, &posed, &below);
        let share = share_of(&above, &below)?;
        let inside = share > ratio(0, 1) && share < ratio(1, 1);
        let changes = combined(&ratio(0, 1), &above, &below)[0] > ratio(0, 1) && combined(&ratio(1, 1), &above, &below)[0] < ratio(0, 1);
        findings.push(Finding::decision(format!("α in (0, 1), {name}"), inside, true));
        findings.push(Finding::decision(format!("ṡ falls through 0 from α = 0 to α = 1, {name}"), changes, true));
        findings.push(Finding::exact(format!("mean velocity of a relay along the surface, {name}"), &relay(&above, &below), &along, "1"));
    }
    Ok(findings)
}

const BELT: DryFriction = DryFriction { frequency: 3.0, belt: 0.2, sticking: 0.7, slipping: 0.5 };

fn carried(system: &DryFriction, method: &EventDriven, time: f64) -> Result<(DVector<f64>, Vec<Switch>)> {
    advance(method, system, &dvector![0.0, system.belt], time)
}

/// Times at which a mode begins.
fn begins(switches: &[Switch], mode: Mode) -> Vec<f64> {
    switches.iter().filter(|switch| switch.mode == mode).map(|switch| switch.time).collect()
}

fn sticking(reading: Reading) -> Result<Vec<Finding>> {
    let delta = reading.only(1).pick(0.15, 0.05);
    let friction = DryFriction { frequency: 2.0, belt: 0.0, sticking: delta, slipping: delta };
    let exact = DryFrictionOscillator::new(1.0, 4.0, 0.6, 1.0)?;
    let (end, switches) = advance(&EventDriven::default(), &friction, &dvector![1.0, 0.0], 7.0)?;
    let entered = begins(&switches, Mode::Sliding);
    let belt = BeltOscillator::new(BELT.frequency, BELT.belt, BELT.sticking, BELT.slipping)?;
    let simulated = DryFriction { sticking: reading.only(0).pick(BELT.sticking, 0.6), ..BELT };
    let (_, cycles) = carried(&simulated, &EventDriven::default(), 10.0)?;
    let (stuck, released) = (begins(&cycles, Mode::Sliding), begins(&cycles, Mode::Beside(Side::Below)));
    // the first sliding phase begins at the start, the second after the first slip
    let duration = released[1] - stuck[1];
    Ok(vec![
        Finding::equal("length of a sticking phase on the belt", duration, belt.stick_duration(), SWITCHING, "s"),
        Finding::count("sliding modes of the dry-friction oscillator", entered.len(), 1),
        Finding::equal(
            "begin of its sliding mode, within 7 s",
            entered.first().copied().unwrap_or(7.0),
            exact.sticking_time(),
            SWITCHING,
            "s",
        ),
        Finding::equal("where it sticks", end[0], exact.state(7.0).0, ACCURACY, "m"),
        Finding::equal("α there", share_above(&friction, &end), 0.5 * (1.0 - exact.state(7.0).0 / 0.15), SWITCHING, "1"),
    ])
}

/// h \[s\] that does not divide the time of a release, 3.5 s.
const LATE_STEP: f64 = 0.13;

fn detection(reading: Reading) -> Result<Vec<Finding>> {
    let exact = BeltOscillator::new(BELT.frequency, BELT.belt, BELT.sticking, BELT.slipping)?;
    let (located, noticed) = reading.pick((Location::Root, Location::EndOfStep), (Location::EndOfStep, Location::Root));
    let method = |control, location| EventDriven { control, location, ..EventDriven::default() };
    let (_, cycles) = carried(&BELT, &EventDriven { location: located, ..EventDriven::default() }, 10.0)?;
    let released = begins(&cycles, Mode::Beside(Side::Below));
    let period = released.windows(2).next().map_or(10.0, |pair| pair[1] - pair[0]);
    let level = |h: f64| -> Result<Refinement> {
        let (end, _) = carried(&BELT, &method(Control::Fixed(h), located), 8.0)?;
        Ok(Refinement { time_step: h, error: (end[0] - exact.carried_from_zero(8.0).0).abs() })
    };
    let order = fit_order([0.1, 0.05, 0.025].into_iter().map(level).collect::<Result<_>>()?)?.slope;
    let (_, late) = carried(&BELT, &method(Control::Fixed(LATE_STEP), noticed), 4.0)?;
    let release = BELT.sticking / BELT.belt;
    let delay = begins(&late, Mode::Beside(Side::Below))[0] - release;
    let rest_of_step = (release / LATE_STEP).ceil() * LATE_STEP - release;
    Ok(vec![
        Finding::at_least("order of q at 8 s", order, LOCATED_ORDER, "1").experiment(),
        Finding::equal("time between two releases, within 10 s", period, exact.period(), SWITCHING, "s"),
        Finding::equal("delay of a release noticed at the end of a step of 0.13 s", delay, rest_of_step, SWITCHING, "s"),
    ])
}
