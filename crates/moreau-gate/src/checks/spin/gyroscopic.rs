//! Kinetic energy and angular momentum of a free box over ten turns.
//!
//! ```text
//!     one step of Euler's equations   explicit   ΔT = +½ h² τᵀJ⁻¹τ ,   Δ½‖L‖² = +½ h² ‖τ‖² ,   τ = JΩ × Ω     in every step
//!                                     implicit   the same, negative
//!     symplectic                      T + h H₁ + … is constant,  H₁ = ½ Σ_{i<j} {T_i, T_j} ,  T_i = L_i²/2J_i
//! ```

use crate::checks::motion::samples;
use crate::checks::scenery::{cuboid, over_floor, schedule, worst};
use crate::model::Model;
use crate::model::solid::box_moments;
use crate::tolerance::{flight, spin as tolerance};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_forms::free_top::{FreeTop, Spin};
use nalgebra::{UnitQuaternion, Vector3};

const HALF_EXTENTS: [f64; 3] = [0.1, 0.2, 0.3];
/// Radians of the motion, ten turns.
const ANGLE: f64 = 20.0 * std::f64::consts::PI;
const SAMPLES: usize = 40;

/// ‖Ω₀‖ \[rad/s\]: a tenth of a radian in a step, and at most what no engine takes for fast.
fn rate(h: f64) -> f64 {
    (0.1 / h).min(20.0)
}

/// Ω₀: between the axes of the largest and the smallest moment of inertia, where the torque is large and the motion stable.
fn start(h: f64) -> Vector3<f64> {
    Vector3::new(1.0, 0.0, 2.0).normalize() * rate(h)
}

fn spun(h: f64) -> Scene {
    let block = cuboid("box", 1.0, HALF_EXTENTS, [0.0; 3]);
    let block = Body { angular_velocity: start(h).into(), ..block };
    Scene { ground: None, gravity: [0.0; 3], ..over_floor("ten turns of a free box", vec![block], 0.0) }
}

/// (T − T₀)/T₀ and (‖L‖ − ‖L₀‖)/‖L₀‖ of every sample.
fn changes(top: &FreeTop, states: &[Spin]) -> [Vec<f64>; 2] {
    let of = |value: &dyn Fn(&Spin) -> f64| states.iter().map(|state| value(state) / value(&states[0]) - 1.0).collect();
    [of(&|state| top.energy(state)), of(&|state| top.momentum(state).norm())]
}

pub(super) fn gyroscopic(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (steps, every) = schedule(ANGLE / rate(h), SAMPLES, h);
    let motion = bench.simulate(&spun(h), h, steps, every)?;
    let time = steps as f64 * h;
    let top = FreeTop { moments: box_moments(1.0, HALF_EXTENTS.into()) };
    let measured = samples(&motion.bodies[0])
        .into_iter()
        .map(|sample| Spin { orientation: sample.rotation, body_rate: sample.rotation.inverse() * sample.spin });
    let changes = changes(&top, &measured.collect::<Vec<_>>());
    let exact = top.path(Spin { orientation: UnitQuaternion::identity(), body_rate: start(h) }, time, tolerance::TOP_STEPS);
    let rates: Vec<Vector3<f64>> = exact.iter().map(|spin| spin.body_rate).collect();
    let bounds = tolerance::gyroscopic(&top.moments, &rates, time, h);
    let noise = flight::turning(steps, bench.epsilon());
    let damped = Model::of(bench.description()).damping().filter(|(_, angular)| *angular > 0.0);
    let mut rows = Vec::new();
    for ((quantity, power, bound), changes) in
        [("kinetic energy", 2.0, bounds.energy), ("angular momentum", 1.0, bounds.momentum)].into_iter().zip(changes)
    {
        let grown = changes.iter().copied().fold(f64::NEG_INFINITY, worst);
        let lost = -changes[changes.len() - 1];
        let passive = Expectation::at_most(0.0, bound.swing + noise, "no growth: at most the swing of a symplectic step");
        let implicit = Expectation::at_most(0.0, bound.drift + bound.swing + noise, "no more than implicit steps of first order lose");
        let model = damped.map(|(_, rate)| {
            let slower = power * flight::damped_velocity(rate, 0.0, 1.0, time, h);
            let allowed = bound.drift + bound.swing + noise + slower;
            Expectation::equal(-(-power * rate * time).exp_m1(), allowed, "the declared damping")
        });
        rows.push(Measurement::new(format!("largest growth of the {quantity} over itself"), "1", grown, passive));
        rows.push(Measurement::new(format!("loss of the {quantity} over itself in ten turns"), "1", lost, implicit).predicted(model));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{Exact, RigidState};
    use crate::runner::SWEEP;
    use crate::{Engine, Options};

    /// A map of Ω over one step of h.
    type Step = fn(&FreeTop, Vector3<f64>, f64) -> Vector3<f64>;

    fn explicit(top: &FreeTop, rate: Vector3<f64>, h: f64) -> Vector3<f64> {
        rate + top.body_acceleration(&rate) * h
    }

    fn implicit(top: &FreeTop, rate: Vector3<f64>, h: f64) -> Vector3<f64> {
        (0..60).fold(rate, |next, _| rate + top.body_acceleration(&next) * h)
    }

    fn midpoint(top: &FreeTop, rate: Vector3<f64>, h: f64) -> Vector3<f64> {
        (0..60).fold(rate, |next, _| rate + top.body_acceleration(&((rate + next) * 0.5)) * h)
    }

    fn runge_kutta(top: &FreeTop, rate: Vector3<f64>, h: f64) -> Vector3<f64> {
        rate + top.body_acceleration(&explicit(top, rate, 0.5 * h)) * h
    }

    /// exp of the three parts T_i one after another: symplectic, of first order.
    fn split(top: &FreeTop, rate: Vector3<f64>, h: f64) -> Vector3<f64> {
        let mut momentum = top.moments.component_mul(&rate);
        for axis in 0..3 {
            let mut turn = Vector3::zeros();
            turn[axis] = -h * momentum[axis] / top.moments[axis];
            momentum = UnitQuaternion::from_scaled_axis(turn) * momentum;
        }
        momentum.component_div(&top.moments)
    }

    fn verdicts(step: Step, h: f64) -> Vec<Verdict> {
        let top = FreeTop { moments: box_moments(1.0, HALF_EXTENTS.into()) };
        let (steps, _) = schedule(ANGLE / rate(h), SAMPLES, h);
        let mut rates = vec![start(h)];
        for k in 0..steps {
            rates.push(step(&top, rates[k], h));
        }
        let still = move |_: &Scene, _: usize, h: f64, t: f64| -> RigidState {
            ([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], rates[(t / h).round() as usize].into())
        };
        let (mut engine, options) = (Exact { motion: still }, Options::new());
        let description = engine.describe(&options).expect("an exact engine describes itself");
        let mut bench = Bench::new(&mut engine, &description, &options);
        gyroscopic(&mut bench, h).expect("an exact engine answers").iter().map(Measurement::verdict).collect()
    }

    #[test]
    fn implicit_symplectic_and_second_order_steps_pass_and_explicit_ones_fail_whatever_the_step() {
        for h in SWEEP.into_iter().chain([1.0 / 30.0]) {
            let sound: [Step; 4] = [implicit, midpoint, runge_kutta, split];
            for (number, step) in sound.into_iter().enumerate() {
                assert_eq!(verdicts(step, h), [Verdict::Pass; 4], "{number} at {h}");
            }
            let [energy, _, momentum, _] = verdicts(explicit, h).try_into().expect("four numbers");
            assert_eq!([energy, momentum], [Verdict::Fail; 2], "{h}");
        }
    }
}
