//! A box that is spun flat on the floor, and on a slab that the floor holds: friction of its corners stops it.
//!
//! ```text
//!     corners at (±a, ±b):  N₁ = N₃ , N₂ = N₄ by the balance of moments,  so that the friction of opposite corners is opposite
//!     J ω̇ = −μ ρ Σ N ,  J = ⅓ m ρ² ,  ρ² = a² + b² ,  Σ N = m (g + v̇_z)
//!     ⇒   ⅓ ρ (ω₀ − ω) − μ v_z = μ g t     for every load of the corners and every sequence of normal impulses
//!     a declared moment of a N at every point:   μ + a/ρ for μ
//! ```

use crate::checks::motion::{Sample, does_not_hop, opens_within, start_gap};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor};
use crate::description::Friction;
use crate::model::Model;
use crate::model::addition::Addition;
use crate::model::sliding::{full_slip, hops};
use crate::model::springs::swinging;
use crate::tolerance::rest::pushed_velocity;
use crate::tolerance::{flight, spin as tolerance};
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use moreau_contact::cones::polyhedral;
use moreau_dynamics::scenes::{Body, Scene};

/// a, b and half the height \[m\]: long arms, so that a step turns the box little and stops it little.
const HALF_EXTENTS: [f64; 3] = [0.5, 1.0, 0.1];
const FRICTION: f64 = 0.2;
/// Of the slab \[m\] and \[kg\].
const SLAB: [f64; 3] = [1.5, 2.0, 0.2];
const HEAVY: f64 = 5.0;
/// ω₀ \[rad/s\].
const SPIN: f64 = 4.0;
/// Parts of the time to stop, in fifths: while it slips, and when it has stopped, also with 1/√2 of the friction.
const FIFTHS: [usize; 2] = [3, 9];

/// ρ \[m\] of corners that are `inset` \[m\] inside of the edges.
fn reach(inset: f64) -> f64 {
    (HALF_EXTENTS[0] - inset).hypot(HALF_EXTENTS[1] - inset)
}

/// J ω₀/(μ m g ρ) = ω₀ ρ/(3 μ g) \[s\].
fn stop() -> f64 {
    SPIN * reach(0.0) / (3.0 * FRICTION * GRAVITY)
}

fn spun(bench: &Bench, h: f64, height: f64) -> Body {
    let gap = start_gap(bench, h, (1.0, 4.0), GRAVITY, FRICTION, SPIN * reach(0.0));
    let block = cuboid("box", 1.0, HALF_EXTENTS, [0.0, 0.0, height + HALF_EXTENTS[2] + gap]);
    Body { angular_velocity: [0.0, 0.0, SPIN], ..block }
}

fn on_the_floor(bench: &Bench, h: f64) -> Scene {
    over_floor("box spun flat", vec![spun(bench, h, 0.0)], FRICTION)
}

/// On a slab that is listed second: heavier and with longer arms, it does not slip on the floor.
fn on_a_slab(bench: &Bench, h: f64) -> Scene {
    let floor = SLAB[2] + start_gap(bench, h, (1.0 + HEAVY, 4.0), GRAVITY, FRICTION, 0.0);
    let slab = cuboid("slab", HEAVY, SLAB, [0.0, 0.0, floor]);
    over_floor("box spun flat on a slab", vec![spun(bench, h, floor + SLAB[2]), slab], FRICTION)
}

/// a \[m\] of a declared friction against turning, if the check predicts what it does beside that of the corners.
fn torsion(bench: &Bench) -> f64 {
    let description = bench.description();
    let apart = matches!(Model::of(description), Model::Coulomb(_)) && description.friction == Friction::Cone;
    if apart { Addition::TorsionalFriction.declared(description) } else { 0.0 }
}

pub(super) fn flat_box(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    if torsion(bench) > 0.0 {
        bench.predicts(&[Addition::TorsionalFriction]);
        bench.without_damping()?;
    }
    does_not_hop(bench)?;
    let scenes = [("", on_the_floor(bench, h)), (", on a slab", on_a_slab(bench, h))];
    let mut measured = stopped(bench, h, scenes[0].0, &scenes[0].1)?;
    // an engine that knows one box only is judged by it
    match stopped(bench, h, scenes[1].0, &scenes[1].1) {
        Err(refusal) if !matches!(refusal, Refusal::Unsupported(_)) => return Err(refusal),
        answer => measured.extend(answer.unwrap_or_default()),
    }
    Ok(measured)
}

/// Refuses the check where a declared torsional friction a > ½ μ ρ stops the box in two thirds of the time, or before it is measured at
/// `time` \[s\].
///
/// # Errors
/// `unsupported` with that reason.
fn stops_late(bench: &Bench, time: f64) -> Reply<()> {
    let stops = stop() / (1.0 + torsion(bench) / (FRICTION * reach(0.0)));
    if time.max(2.0 * stop() / 3.0) > stops {
        return Err(Refusal::unsupported("the declared torsional friction stops the box before its braking is measured"));
    }
    Ok(())
}

fn stopped(bench: &mut Bench, h: f64, words: &str, scene: &Scene) -> Reply<Vec<Measurement>> {
    let every = (stop() / (5.0 * h)).round().max(1.0) as usize;
    stops_late(bench, (FIFTHS[0] * every) as f64 * h)?;
    let motion = bench.simulate(scene, h, FIFTHS[1] * every, every)?;
    let [sliding, end] = FIFTHS.map(|fifths| Sample::of(&motion.bodies[0], fifths));
    let time = (FIFTHS[0] * every) as f64 * h;
    let third = reach(0.0) / 3.0;
    let braked = (third * (SPIN - sliding.spin.z) - FRICTION * sliding.velocity.z) / time;
    let full = FRICTION * GRAVITY;
    let error = full * tolerance::braking(SPIN, h);
    let ideal = Expectation::equal(full, error, "μ g, for every load of the corners");
    let law = slipping(bench, full, h, (time, sliding.velocity.z)).map(|(low, high, why)| {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        Expectation::equal(middle, half + error, why)
    });
    let still = Expectation::equal(0.0, tolerance::stopped(SPIN), "J ω₀/(μ m g ρ) is over");
    Ok(vec![
        Measurement::new(format!("(ρ (ω₀ − ω)/3 − μ v_z)/t while it slips{words}"), "m/s^2", braked, ideal).predicted(law),
        Measurement::new(format!("spin after 9/5 of the time to stop{words}"), "rad/s", end.spin.z, still).predicted(left(
            bench,
            FIFTHS[1] * every,
            h,
        )),
    ])
}

/// Least and greatest braking \[m/s²\] under the declared law, where it is not μ g; `rising` is v_z \[m/s\].
fn slipping(bench: &Bench, full: f64, h: f64, (time, rising): (f64, f64)) -> Option<(f64, f64, &'static str)> {
    let model = Model::of(bench.description());
    let inset = bench.description().contact_model.number("corner_radius").unwrap_or(0.0);
    let ratio = reach(inset) / reach(0.0);
    // corners at ρ' brake with μ ρ'/ρ (g t + v_z), of which μ v_z is subtracted
    let shorter = full * ratio + FRICTION * rising * (ratio - 1.0) / time;
    let weakest = std::f64::consts::FRAC_1_SQRT_2;
    match model {
        // every point turns with a p_n beside its friction, whatever it carries: (μ + a/ρ) (g t + v_z)
        Model::Coulomb(_) if torsion(bench) > 0.0 => {
            let beside = torsion(bench) / reach(0.0);
            let braked = full + beside * (GRAVITY + rising / time);
            Some((braked, braked, "friction of the corners, and the declared torsional friction"))
        }
        Model::Coulomb(limits) if limits.angular_damping > 0.0 => {
            let rate = limits.angular_damping;
            let third = reach(0.0) / 3.0;
            let fall = full / third;
            // ω̇ = −α − c ω:  ω₀ − ω = (ω₀ + α/c)(1 − e^{−ct})
            let braked = third * -(-rate * time).exp_m1() * (SPIN + fall / rate) / time;
            let error = third * flight::damped_velocity(rate, fall, SPIN, time, h) / time;
            Some((braked - error, braked + error, "friction and the declared damping"))
        }
        Model::StewartTrinkle { directions } => {
            Some((full * (1.0 - polyhedral::strength_error(directions)), full, "friction between μ cos(π/d) and μ"))
        }
        Model::Mujoco(_) if bench.description().friction == Friction::Pyramid => Some((weakest * full, full, "a pyramid with four edges")),
        Model::DrakeRegularised { stiction_tolerance, .. } => {
            // 1 − c(s) ≤ 1/(2 s²) at slips of a quarter of the first one and more; a lagged law misses one step's friction.
            let slip = stiction_tolerance / (0.25 * SPIN * reach(0.0));
            Some((
                shorter * (1.0 - h / time - 0.5 * slip * slip),
                shorter,
                "corner spheres; friction lacks one step and 1 − c(s) of itself",
            ))
        }
        _ if bench.description().friction == Friction::Pyramid => {
            Some((weakest * full, std::f64::consts::SQRT_2 * full, "a pyramid within or around the cone"))
        }
        _ if inset > 0.0 => Some((shorter, shorter, "corner spheres")),
        _ if hops(bench.description()) => Some((full, full, "friction on the cone and opposed to the slip, through every hop")),
        _ => None,
    }
}

/// The spin that a law leaves whose friction is full above a slip only, or whose corners open within so many steps, because what is left of
/// their depth is taken back, and turn the box about those that stick.
fn left(bench: &Bench, steps: usize, h: f64) -> Option<Expectation> {
    if opens_within(bench, steps).is_some() {
        let allowed = pushed_velocity(GRAVITY, h) / reach(0.0) + tolerance::stopped(SPIN);
        return Some(Expectation::equal(0.0, allowed, "corners whose depth is taken back open, fall and are pushed out"));
    }
    let description = bench.description();
    let slip = full_slip(description, FRICTION * GRAVITY, h);
    // J θ'' = −4 k ρ² θ with J = ⅓ m ρ²: the slip ρθ of a corner, which carries a quarter of the load, feels 12/m.
    let swing = swinging(&Model::of(description), 0.25 * FRICTION * GRAVITY, 12.0, 0.8 * stop());
    let left = slip + swing;
    let why = "a slip too small for full friction, or of loaded springs";
    (left > 0.0).then(|| Expectation::equal(0.0, left / reach(0.0) + tolerance::stopped(SPIN), why))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{judge_declaring, refusal};
    use crate::runner::SWEEP;
    use nalgebra::{UnitQuaternion, Vector3};

    fn verdicts(h: f64, friction: f64) -> Vec<Verdict> {
        declaring(h, friction, &[])
    }

    fn declaring(h: f64, friction: f64, declared: &[(&str, f64, &str)]) -> Vec<Verdict> {
        let rate = 3.0 * friction * GRAVITY / reach(0.0);
        let measured = judge_declaring("spin/flat-box", h, declared, |scene, index, _, t| {
            let body = &scene.bodies[index];
            if index == 1 {
                return (body.position, body.orientation, [0.0; 3], [0.0; 3]);
            }
            let slipping = if rate > 0.0 { t.min(SPIN / rate) } else { t };
            let turned = UnitQuaternion::from_scaled_axis(Vector3::z() * (SPIN * slipping - 0.5 * rate * slipping * slipping));
            (body.position, [turned.w, turned.i, turned.j, turned.k], [0.0; 3], [0.0, 0.0, SPIN - rate * slipping])
        });
        measured.iter().map(Measurement::verdict).collect()
    }

    #[test]
    fn declared_torsional_friction_stops_the_box_sooner_and_fails_where_it_does_not_act() {
        // a = 1/10 m beside the corners at √(5/4) m
        let together = FRICTION + 0.1 / 1.25f64.sqrt();
        let declared = [("torsional_friction", 0.1, "m")];
        for h in SWEEP {
            let found = declaring(h, together, &declared);
            assert_eq!(found, [Verdict::Difference, Verdict::Pass, Verdict::Difference, Verdict::Pass], "{h}");
            assert_eq!(declaring(h, FRICTION, &declared)[0], Verdict::Fail, "{h}");
        }
    }

    #[test]
    fn a_box_that_would_stop_too_early_or_hop_is_not_asked() {
        let refused = |part: f64, h: f64| refusal("spin/flat-box", h, &[("torsional_friction", part * FRICTION * reach(0.0), "m")]);
        assert!(refused(0.51, 1e-3).is_some_and(|reason| reason.contains("torsional friction")));
        assert_eq!(refused(0.49, 1e-3), None);
        assert!(refused(0.49, 0.1).is_some(), "three fifths, rounded to steps, are later");
        let pushed = |part: f64| refusal("spin/flat-box", 0.01, &[("error_reduction", part, "1")]);
        assert!(pushed(0.35).is_some_and(|reason| reason.contains("error_reduction")));
        assert_eq!(pushed(0.3), None);
    }

    #[test]
    fn corners_that_open_by_declaration_may_turn_the_box_and_others_may_not() {
        let verdict = |declared: &[(&str, f64, &str)]| {
            let (h, rate) = (0.01, 3.0 * FRICTION * GRAVITY / reach(0.0));
            let measured = judge_declaring("spin/flat-box", h, declared, |scene, index, _, t| {
                let body = &scene.bodies[index];
                let spin = if index == 1 { 0.0 } else { (SPIN - rate * t).max(0.01) };
                (body.position, body.orientation, [0.0; 3], [0.0, 0.0, spin])
            });
            measured[1].verdict()
        };
        assert_eq!(verdict(&[]), Verdict::Fail);
        assert_eq!(verdict(&[("error_reduction", 0.3, "1")]), Verdict::Difference);
    }

    #[test]
    fn the_closed_form_passes_and_friction_that_is_off_by_a_fiftieth_fails() {
        for h in SWEEP {
            assert_eq!(verdicts(h, FRICTION), [Verdict::Pass; 4], "{h}");
            for factor in [0.98, 1.02] {
                assert_eq!(verdicts(h, factor * FRICTION), [Verdict::Fail, Verdict::Pass, Verdict::Fail, Verdict::Pass], "{factor} at {h}");
            }
            assert_eq!(verdicts(h, 0.0), [Verdict::Fail; 4], "{h}");
        }
    }
}
