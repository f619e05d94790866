//! Thrown boxes: laws that hold although the motion itself cannot be predicted.
//!
//! ```text
//!     e = 0 with friction, e > 0 without       the energy rises by no more than gravity and rotation within a step allow
//!     e > 0 with friction                      no energy theorem: by e times the speed of arrival more; depths stay bounded
//!     always                                   m Δv = m g h + Σ p ;   at the end they lie, on the floor and outside each other
//! ```
//! The other families have motions in closed form or bodies at rest, which a solver meets with a good start and an answer of known shape.
//! Here every step is another problem, with one to eight contacts that come and go, and an answer that is wrong once shows at once.

mod depth;
mod energy;
mod momentum;
mod motion;
mod overlap;
mod parting;
mod rest;
mod scenes;

pub(super) use energy::passive_rise;
pub(super) use motion::Tumble;

use crate::check::{Control, Expected, Run};
use crate::{Check, Level};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "tumbling/passive",
        level: Level::Simulate,
        question: "Does the energy of boxes that land on a rough floor and on each other ever rise, without restitution?",
        derivation: "A step gains r·u⁺ − Σ(½ ‖p‖²/m − ½ h g p_z) with r·u⁺ ≤ 0, where p are the impulses on a body. This is at most m g² \
            h²/8, and zero for a body that is carried. The energy is E − σ g h Σ m v_z with |σ| ≤ ½, which a scheme keeps that updates \
            positions with (½ + σ) v⁺ + (½ − σ) v. The σ that fits the flight best is taken. Corners that turned below a surface by ½ \
            ω²ρ h² are pushed out at ½ ω²ρ h. A first-order step of rotation adds ½ h² τᵀJ⁻¹τ + ½ h (J_max − J_min) ω²‖Δω‖, which is \
            zero for a cube. The allowances of an interval of steps add up, and the interval farthest above them is reported. A \
            compliant contact stores energy, so that it is compared with the start. If a rigid law declares that it takes back a depth, \
            the declared speed is added.",
        source: "T(v⁺) − T(v_free) = r·u⁺ − ½ rᵀWr; chapter §9",
        run: Run::EachStep(energy::passive),
        control: Control { passes: "moreau-jean", fails: "tumbling/two-sweeps" },
    },
    Check {
        name: "tumbling/bouncing",
        level: Level::Simulate,
        question: "Does the energy of boxes that bounce with one restitution and without friction ever rise?",
        derivation: "With y = u⁺ + e u⁻ and r·y = 0 the bound without restitution holds, times (1−e)/(1+e). Contacts that were opening \
            and are pressed may be kept from closing again, u⁺ ≥ 0, which gives e/(1+e) Σ r u⁻ over them. Contacts below a declared \
            threshold have another e than the others. Newton's law with several e has no such theorem, so that the bound with friction \
            is used for them.",
        source: "Moreau's law with one e for all contacts dissipates; chapter §9",
        run: Run::EachStep(energy::bouncing),
        control: Control { passes: "moreau-jean", fails: "tumbling/stale-impulses" },
    },
    Check {
        name: "tumbling/rough",
        level: Level::Simulate,
        question: "Does the energy of boxes that bounce on a rough floor rise in a step by more than Newton's law can give?",
        derivation: "Newton's e with friction has no energy theorem. But r·u⁺ ≤ −e Σ r_n u_n⁻ ≤ e U R. U is the greatest relative speed \
            of two points that may touch. R = Σ r_n follows from the change of momentum: the floor gives S = Σ p_z, and ‖p‖ + S √(1+μ²) \
            of the upper of two bodies bounds their mutual impulses. All other terms are those without restitution.",
        source: "T(v⁺) − T(v_free) = r·u⁺ − ½ rᵀWr with y_n = u_n⁺ + e u_n⁻ and friction that opposes u_t⁺",
        run: Run::EachStep(energy::rough),
        control: Control { passes: "moreau-jean", fails: "tumbling/extrapolated-sweeps" },
    },
    Check {
        name: "tumbling/depth",
        level: Level::Simulate,
        question: "How deep do boxes get into a rough floor and into each other, with and without restitution?",
        derivation: "A corner that arrives at u is noticed a step late and moves on for half a step: 3/2 h (u + g h), with the fastest \
            arrival u of the motion. The overlap of two boxes is the least of their overlaps along 15 axes. A compliant or sprung law \
            stops the energy of the whole motion in one contact, at a depth that is replayed.",
        source: "the activation rules of Moreau–Jean; separating axes",
        run: Run::EachStep(depth::depth),
        control: Control { passes: "moreau-jean", fails: "ball/contacts-every-fourth-step" },
    },
    Check {
        name: "tumbling/momentum",
        level: Level::Simulate,
        question: "Do the reported impulses account for every change of every body's momentum?",
        derivation: "m Δv = m g h + Σ p in every step, with p on the body named first and −p on the other. The difference is relative to \
            Σ‖p‖ + m g h.",
        source: "Newton's laws; protocol: impulses summed over the interval that ends at the sample",
        run: Run::EachStep(momentum::momentum),
        control: Control { passes: "moreau-jean", fails: "contact/late" },
    },
    Check {
        name: "tumbling/rest",
        level: Level::Simulate,
        question: "Do boxes that land without restitution come to rest, on the floor and not inside each other?",
        derivation: "Sliding ends after v/(μ g). A landing from edge to edge keeps at most (1 − 3/2 sin²α)² of the energy. Both end \
            within a second. After 2.5 s a corner is slower than a step of gravity, g h. The lowest body is within 3 g h² of the floor, \
            and depths are bounded as in flight. Contacts whose depth is taken back by declaration open when nothing is left of it, and \
            move at up to 3/2 g h, level by level.",
        source: "Housner 1963; the places where event capturing lets a ball rest",
        run: Run::EachStep(rest::rest),
        control: Control { passes: "moreau-jean", fails: "tumbling/stale-impulses" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected::without_restitution("stewart-trinkle", "tumbling/bouncing"),
    Expected::without_restitution("stewart-trinkle", "tumbling/rough"),
    Expected::without_restitution("anitescu", "tumbling/bouncing"),
    Expected::without_restitution("anitescu", "tumbling/rough"),
];

#[cfg(test)]
mod tests {
    use super::scenes::{FRICTION, Throw, Thrown};
    use crate::exact::{RigidState, judge};
    use crate::runner::QUICK;
    use crate::{Engine, Measurement, Options, Verdict, own};
    use moreau_dynamics::scenes::Scene;
    use nalgebra::{Quaternion, UnitQuaternion, Vector3};

    /// A body that falls through everything and turns about a fixed axis, which keeps its energy.
    fn falling(scene: &Scene, body: usize, t: f64) -> RigidState {
        let body = &scene.bodies[body];
        let [w, x, y, z] = body.orientation;
        let spin = Vector3::from(body.angular_velocity);
        let turned = UnitQuaternion::from_scaled_axis(spin * t) * UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let (gravity, velocity) = (Vector3::from(scene.gravity), Vector3::from(body.linear_velocity));
        let position = Vector3::from(body.position) + velocity * t + gravity * (0.5 * t * t);
        (position.into(), [turned.w, turned.i, turned.j, turned.k], (velocity + gravity * t).into(), spin.into())
    }

    fn verdict(measured: &[Measurement]) -> Verdict {
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn a_motion_without_contact_keeps_its_energy_and_sinks() {
        for h in QUICK {
            for check in ["tumbling/passive", "tumbling/bouncing", "tumbling/rough"] {
                let measured = judge(check, h, |scene, body, _, t| falling(scene, body, t));
                assert_eq!(verdict(&measured), Verdict::Pass, "{check} at {h}: {measured:?}");
            }
            for check in ["tumbling/depth", "tumbling/rest"] {
                let measured = judge(check, h, |scene, body, _, t| falling(scene, body, t));
                assert_eq!(verdict(&measured), Verdict::Fail, "{check} at {h}: {measured:?}");
            }
        }
    }

    #[test]
    fn a_thousandth_of_the_velocity_out_of_nothing_is_a_gain() {
        let faster = |scene: &Scene, body: usize, t: f64| {
            let (position, orientation, velocity, spin) = falling(scene, body, t);
            (position, orientation, velocity.map(|v| if t > 0.5 { 1.001 * v } else { v }), spin)
        };
        for (h, check) in
            QUICK.into_iter().flat_map(|h| ["tumbling/passive", "tumbling/bouncing", "tumbling/rough"].map(|check| (h, check)))
        {
            let measured = judge(check, h, |scene, body, _, t| faster(scene, body, t));
            assert!(measured.iter().all(|one| one.verdict() == Verdict::Fail), "{check} at {h}: {measured:?}");
        }
    }

    #[test]
    fn two_boxes_meet() {
        for thrown in [Thrown::Pair, Thrown::Heavy] {
            for seed in 0..20 {
                let scene = Scene { duration: 0.5, ..Throw { thrown, seed, restitution: 0.0 }.scene(FRICTION) };
                // whether they meet is asked, not whether every step is solved
                let mut engine = own::OwnEngine { certified: false, ..own::by_name("moreau-jean").expect("a listed name") };
                let motion = engine.simulate(&scene, 1.0 / 64.0, 1, &Options::new()).expect("simulated");
                let met = motion.contacts.iter().any(|contact| contact.bodies.iter().all(|name| name != "ground"));
                assert!(met, "{thrown:?}, throw {seed}");
            }
        }
    }
}
