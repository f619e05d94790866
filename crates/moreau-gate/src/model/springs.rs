//! A spring and damper per contact point, f = max(0, k δ − c u), by every first-order step that an engine may integrate it with.
//!
//! ```text
//!     v⁺ = v + τ a + τ f/m̄ ,    f = max(0, −k (φ + α τ v⁺) − c (β v⁺ + (1 − β) v)) ,    φ⁺ = φ + τ v⁺ ,    α, β ∈ {0, 1}
//! ```
//! The law says nothing of the steps. τ is the declared `substep` or, where none is declared, h; spring and damper may each be explicit or
//! implicit, and the gap may close anywhere within a step. For τ → 0 all of them tend to the motion of the law,
//! [`moreau_forms::compliant_impact`].

use crate::ContactModel;
use crate::model::Model;

/// Places within a substep at which the gap may close.
const PHASES: usize = 4;

/// Steps that an engine makes within one step of h \[s\]: as many as its declared longest `substep` asks for, otherwise one.
pub fn substeps(model: &ContactModel, h: f64) -> usize {
    parts(model.number("substep").filter(|substep| *substep > 0.0), h)
}

fn parts(substep: Option<f64>, h: f64) -> usize {
    substep.map_or(1, |substep| (h / substep).ceil().max(1.0) as usize)
}

/// One way to integrate the law.
#[derive(Clone, Copy, Debug)]
struct Way {
    stiffness: f64,
    damping: f64,
    /// α.
    spring_implicit: bool,
    /// β.
    damper_implicit: bool,
    /// τ \[s\].
    part: f64,
}

impl Way {
    /// v⁺ of a substep.
    fn velocity(&self, mass: f64, acceleration: f64, gap: f64, velocity: f64) -> f64 {
        let tau = self.part;
        let free = velocity + tau * acceleration;
        let ahead = if self.spring_implicit { tau } else { 0.0 };
        let [old, new] = if self.damper_implicit { [0.0, self.damping] } else { [self.damping, 0.0] };
        if gap + ahead * free >= 0.0 {
            return free;
        }
        let slope = self.stiffness * ahead + new;
        let force = (-self.stiffness * gap - old * velocity - slope * free) / (1.0 + tau * slope / mass);
        free + tau * force.max(0.0) / mass
    }
}

/// (gap, velocity) at the start and after each of `steps` steps of h \[s\], once for every way to integrate; none for another law. The
/// reduced mass is \[kg\], the acceleration without contact \[m/s²\].
pub fn replays(model: &Model, (mass, acceleration): (f64, f64), h: f64, (gap, velocity): (f64, f64), steps: usize) -> Vec<Vec<(f64, f64)>> {
    let Model::SpringDamper { stiffness, damping, substep } = *model else { return Vec::new() };
    let count = parts(substep, h);
    let part = h / count as f64;
    let arrival = (velocity * velocity + 2.0 * acceleration.abs() * gap.max(0.0)).sqrt();
    let way = |k: usize| Way { stiffness, damping, spring_implicit: k & 1 == 1, damper_implicit: k & 2 == 2, part };
    let one = |k: usize| {
        let late = (k / 4) as f64 / PHASES as f64 * part * arrival;
        let mut state = (gap + late, velocity);
        let mut states = vec![state];
        for _ in 0..steps {
            for _ in 0..count {
                state.1 = way(k).velocity(mass, acceleration, state.0, state.1);
                state.0 += part * state.1;
            }
            states.push(state);
        }
        states
    };
    (0..4 * PHASES).map(one).collect()
}

/// Slip \[m/s\] that a spring along the surface leaves at a time \[s\] after friction has stopped a body of 1 kg: 0 for another law.
///
/// The spring is loaded to ξ = `load`/k then, and swings the slip, ξ'' = −w (k ξ + c ξ'), w = m W_t \[1/kg\], with the amplitude
/// `load` √(w/k). Its envelope decays at ½ c w or, where it is damped beyond its critical value, at k/c or faster; half of these rates
/// bound the slip from the start, whatever its phase.
pub fn swinging(model: &Model, load: f64, response: f64, time: f64) -> f64 {
    let Model::SpringDamper { stiffness, damping, .. } = *model else { return 0.0 };
    let rate = if damping > 0.0 { 0.5 * (0.5 * damping * response).min(stiffness / damping) } else { 0.0 };
    load * (response / stiffness).sqrt() * (-rate * time).exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_forms::compliant_impact::CompliantImpact;

    /// Least and greatest restitution of spheres of 1 and 3 kg that meet at 2.5 m/s without gravity.
    fn restitution(substep: f64) -> [f64; 2] {
        let model = Model::SpringDamper { stiffness: 1e5, damping: 300.0, substep: Some(substep) };
        let ends = replays(&model, (0.75, 0.0), 1.0 / 60.0, (0.01, -2.5), 3).into_iter().map(|states| states[3].1 / 2.5);
        ends.fold([f64::INFINITY, 0.0], |[least, most], end| [least.min(end), most.max(end)])
    }

    #[test]
    fn the_replays_enclose_the_closed_form_and_close_in_on_it_with_the_substep() {
        let exact = CompliantImpact::new(0.75, 1e5, 300.0).expect("valid").restitution_cut();
        let widths = [4e-4, 2e-4, 1e-4, 5e-5].map(|substep| {
            let [least, most] = restitution(substep);
            assert!(least <= exact && exact <= most, "{exact} in {least}..{most} at {substep}");
            most - least
        });
        assert!(widths.windows(2).all(|pair| pair[1] <= 0.6 * pair[0]), "{widths:?}");
        let half = CompliantImpact::new(0.75, 1e5, 150.0).expect("valid").restitution_cut();
        assert!(half > restitution(2e-4)[1], "half the damping, e = {half}, is outside");
    }

    #[test]
    fn a_loaded_spring_swings_with_its_energy_and_a_damped_one_does_not_swing_longer_than_its_damper_allows() {
        let spring = |damping: f64| Model::SpringDamper { stiffness: 400.0, damping, substep: None };
        // ½ k ξ² = ½ u²/w: ξ = 2/400, u = ξ √(400 · 4).
        assert_eq!(swinging(&spring(0.0), 2.0, 4.0, 10.0), 0.2);
        for damping in [1.0, 10.0, 14.0, 20.0, 100.0] {
            // The exact solution of ξ'' = −w (k ξ + c ξ'), in small steps.
            let (mut stretch, mut slip) = (2.0 / 400.0, 0.0);
            for step in 1..=100_000 {
                slip -= 1e-5 * 4.0 * (400.0 * stretch + damping * slip);
                stretch += 1e-5 * slip;
                let bound = swinging(&spring(damping), 2.0, 4.0, f64::from(step) * 1e-5);
                assert!(f64::abs(slip) <= 1.001 * bound, "{damping}: {slip} at step {step}, {bound}");
            }
        }
        assert_eq!(swinging(&Model::Anitescu, 2.0, 4.0, 0.0), 0.0);
    }

    #[test]
    fn a_step_is_one_substep_unless_one_is_declared() {
        let mut model = ContactModel { kind: crate::Kind::Compliant, law: None, parameters: Default::default() };
        assert_eq!(substeps(&model, 0.5), 1);
        let parameter = |value: f64| crate::Parameter {
            value: crate::description::OneOrMany::One(value),
            unit: crate::description::OneOrMany::One("s".into()),
        };
        model.parameters.insert("substep".into(), parameter(0.2));
        assert_eq!((substeps(&model, 0.5), substeps(&model, 0.1)), (3, 1));
        model.parameters.insert("substep".into(), parameter(0.0));
        assert_eq!(substeps(&model, 0.5), 1);
    }
}
