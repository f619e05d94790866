//! Closed forms of motions against their flights, their works and their conserved quantities.

use super::parts::{whole, wrong};
use crate::finding::Finding;
use crate::planted::Family;
use moreau_exact::Result;
use moreau_exact::scalar::{Rational, Scalar, ratio};
use moreau_exact::tolerance::rounding;
use moreau_forms::baumgarte_decay;
use moreau_forms::bouncing_ball::impact_time_ratio;
use moreau_forms::dry_friction_oscillator::turning_points;
use moreau_forms::incline_block::InclineBlock;
use moreau_forms::sliding_to_rolling::rolling_speed;

/// t_k/t₁ for a coefficient e and an impact k.
pub type ImpactTimes = fn(&Rational, usize) -> Rational;

/// A bouncing ball: every flight begins with e times the speed of the impact before it, and lasts twice as long as its rise.
pub static BALL: Family<ImpactTimes> = Family {
    reference: impact_time_ratio::<Rational>,
    checks: &[("forms/bouncing-ball", ball)],
    planted: &[
        wrong("forms/flights-half", "counts the rise of every flight and not its fall", |e, k| {
            (impact_time_ratio(e, k) + whole(1)) * ratio(1, 2)
        }),
        wrong("forms/flight-before-its-impact", "begins a flight with the speed before its impact", |e, k| {
            if k < 2 { whole(1) } else { whole(2) + impact_time_ratio(e, k - 1) }
        }),
        wrong("forms/dropped-as-thrown", "counts the first fall as a whole flight", |e, k| whole(1) + impact_time_ratio(e, k)),
        wrong("forms/time-in-energies", "lets the time of a flight fall by e² an impact, as its height does", |e, k| {
            impact_time_ratio(&(e * e), k)
        }),
    ],
};

/// With v₁ = g t₁: t = 1, then v ← e v and t ← t + 2 v.
fn ball(subject: &ImpactTimes) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for e in [ratio(1, 2), ratio(4, 5), ratio(1, 1)] {
        let (mut time, mut speed) = (whole(1), whole(1));
        for impact in 1..6 {
            findings.push(Finding::exact("time of an impact", &subject(&e, impact), &time, "t₁"));
            speed *= &e;
            time += whole(2) * &speed;
        }
    }
    Ok(findings)
}

/// (x, v) at a time on a slope with (g, α, μ, v₀).
pub type Slope = fn([f64; 4], f64) -> Result<(f64, f64)>;

/// A block on a slope: gravity and friction do the work that its speed shows, and x moves with the mean of v.
pub static SLOPE: Family<Slope> = Family {
    reference: |[g, angle, mu, v], time| Ok(InclineBlock::new(g, angle, mu, v)?.state(time)),
    checks: &[("forms/incline-block", slope)],
    planted: &[
        wrong(
            "forms/friction-always-uphill",
            "lets friction push up the slope, also where the block slides up",
            |[g, angle, mu, v], time| {
                let slide = g * (angle.sin() - mu * angle.cos());
                Ok((time * (v + 0.5 * slide * time), v + slide * time))
            },
        ),
        wrong("forms/whole-weight-presses", "takes m g for the normal force on a slope", |[g, angle, mu, v], time| {
            Ok(InclineBlock::new(g, angle, mu / angle.cos(), v)?.state(time))
        }),
        wrong("forms/no-friction-once-stopped", "lets a block that has stopped slide back without friction", |[g, angle, mu, v], time| {
            let block = InclineBlock::new(g, angle, mu, v)?;
            let (stop, back) = (block.stopping_time(), g * angle.sin());
            if time <= stop {
                return Ok(block.state(time));
            }
            let (x, elapsed) = (block.state(stop).0, time - stop);
            Ok((x + 0.5 * back * elapsed * elapsed, back * elapsed))
        }),
        wrong("forms/slope-from-the-vertical", "measures the angle of the slope from the vertical", |[g, angle, mu, v], time| {
            Ok(InclineBlock::new(g, std::f64::consts::FRAC_PI_2 - angle, mu, v)?.state(time))
        }),
    ],
};

/// Between two times of one phase: ½v² gains g sin α Δx − μ g cos α |Δx|, and Δx = ½ (v + v′) Δt; and v = 0 at the end of an ascent.
fn slope(subject: &Slope) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for case in [[9.81, 0.35, 0.3, 0.5], [9.81, 0.35, 0.5, -2.0], [9.81, 0.6, 0.3, -3.0f64]] {
        let [g, angle, mu, v0]: [f64; 4] = case;
        // an ascent ends when gravity and friction have taken its speed
        let ascent = if v0 < 0.0 { -v0 / (g * (angle.sin() + mu * angle.cos())) } else { 0.5 };
        let times = [0.0, 0.5 * ascent, ascent, 1.25 * ascent, 2.0 * ascent];
        for pair in times.windows(2) {
            let [(x, v), (x_next, v_next)] = [subject(case, pair[0])?, subject(case, pair[1])?];
            let (moved, size) = (x_next - x, v.abs() + v_next.abs() + g * pair[1]);
            let work = g * (angle.sin() * moved - mu * angle.cos() * moved.abs());
            let gained = 0.5 * (v_next * v_next - v * v);
            findings.push(Finding::equal("work", gained, work, rounding(64, size * size), "J/kg"));
            let mean = 0.5 * (v + v_next) * (pair[1] - pair[0]);
            findings.push(Finding::equal("way", moved, mean, rounding(64, size * pair[1]), "m"));
        }
        if v0 < 0.0 {
            let (_, v) = subject(case, ascent)?;
            findings.push(Finding::equal("speed at the end of the ascent", v, 0.0, rounding(64, v0.abs()), "m/s"));
        }
    }
    Ok(findings)
}

/// The speed of rolling for κ = m R²/I, v₀ and w₀ = ω₀ R.
pub type Rolling = fn(&[Rational; 3]) -> Rational;

/// From sliding to rolling on a level floor: the angular momentum about the floor, v + w/κ, is kept.
pub static ROLLING: Family<Rolling> = Family {
    reference: |[turning, speed, surface]| rolling_speed(turning, speed, surface),
    checks: &[("forms/sliding-to-rolling", rolling)],
    planted: &[
        wrong("forms/rolling-inertia-inverted", "takes I/(m R²) for m R²/I", |[turning, speed, surface]| {
            rolling_speed(&(whole(1) / turning), speed, surface)
        }),
        wrong("forms/rolling-spin-reversed", "counts the spin in the other sense", |[turning, speed, surface]| {
            rolling_speed(turning, speed, &-surface.clone())
        }),
        wrong("forms/rolling-without-torque", "lets friction brake the body without turning it", |[_, speed, surface]| {
            (speed + surface) * ratio(1, 2)
        }),
    ],
};

fn rolling(subject: &Rolling) -> Result<Vec<Finding>> {
    let of = |[turning, speed, surface]: [Rational; 3]| {
        let end = subject(&[turning.clone(), speed.clone(), surface.clone()]);
        let momentum = |v: &Rational, w: &Rational| v + w / &turning;
        Finding::exact("angular momentum about the floor", &momentum(&end, &end), &momentum(&speed, &surface), "m/s")
    };
    Ok([[ratio(5, 2), whole(1), whole(0)], [whole(2), whole(3), whole(-1)], [ratio(3, 2), whole(0), whole(4)]].map(of).into())
}

/// The turning points of a dry-friction oscillator with start q₀ and half width δ of its stick zone.
pub type TurningPoints = fn(&Rational, &Rational) -> Vec<Rational>;

/// Dry friction: over each half-cycle the spring loses what friction takes, and the last point alone lies in the stick zone.
pub static TURNING_POINTS: Family<TurningPoints> = Family {
    reference: turning_points::<Rational>,
    checks: &[("forms/dry-friction-oscillator", turning)],
    planted: &[
        wrong("forms/decrement-half", "shortens the swing by δ a half-cycle, as if friction acted on the way out only", |start, zone| {
            turning_points(start, &(zone * ratio(1, 2)))
        }),
        wrong("forms/one-swing-too-many", "lets it swing once more out of the stick zone", |start, zone| {
            let mut points = turning_points(start, zone);
            let last = points[points.len() - 1].clone();
            points.push(if last > whole(0) { whole(2) * zone - last } else { -(whole(2) * zone + last) });
            points
        }),
        wrong("forms/turning-points-on-one-side", "keeps every turning point on the side of the start", |start, zone| {
            turning_points(start, zone).into_iter().map(|point| point.magnitude()).collect()
        }),
    ],
};

fn turning(subject: &TurningPoints) -> Result<Vec<Finding>> {
    let (start, zone) = (whole(1), ratio(3, 20));
    let points = subject(&start, &zone);
    let mut findings = vec![Finding::exact("start", &points[0], &start, "m")];
    for pair in points.windows(2) {
        // ½k(q² − q′²) = F (|q| + |q′|), over k
        let lost = ratio(1, 2) * (&pair[0] * &pair[0] - &pair[1] * &pair[1]);
        findings.push(Finding::exact("energy lost", &lost, &(&zone * (&pair[0] - &pair[1]).magnitude()), "m²"));
    }
    let moving = points.iter().filter(|point| point.magnitude() > zone).count();
    findings.push(Finding::count("points outside the stick zone", moving, points.len() - 1));
    Ok(findings)
}

/// The time constant of φ̈ + 2αφ̇ + β²φ = 0.
pub type TimeConstant = fn(f64, f64) -> f64;

/// A decay: −1/τ is the real part of a root, and of the other root not larger.
pub static DECAY: Family<TimeConstant> = Family {
    reference: baumgarte_decay::time_constant,
    checks: &[("forms/baumgarte-decay", decay)],
    planted: &[
        wrong("forms/fast-root", "takes the fast root of an overdamped decay", |damping, frequency| {
            if damping <= frequency { 1.0 / damping } else { 1.0 / (damping + (damping * damping - frequency * frequency).sqrt()) }
        }),
        wrong("forms/damping-alone", "takes 1/α beyond critical damping as well", |damping, _| 1.0 / damping),
    ],
};

/// The two roots have the sum −2α and the product β²: where they are real, the other one is −2α + 1/τ.
fn decay(subject: &TimeConstant) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (damping, frequency) in [(6.0, 5.0), (3.0, 5.0), (50.0, 5.0)] {
        let rate: f64 = 1.0 / subject(damping, frequency);
        let other = 2.0 * damping - rate;
        let product = if damping > frequency { frequency * frequency } else { damping * damping };
        let size = damping * damping;
        findings.push(Finding::equal("product of the roots", rate * other, product, rounding(16, size), "1/s²"));
        findings.push(Finding::at_most_within("rate of the slow root", rate, other, rounding(16, damping), "1/s"));
    }
    Ok(findings)
}
