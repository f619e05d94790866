//! Energy over a motion: E_k − E_0 and the largest gain in one step.

use crate::trajectory::Recording;
use moreau_exact::number::larger;

/// What became of an energy over a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyBalance {
    /// E at the start \[J\].
    pub initial: f64,
    /// max_k |E_k − E_0| \[J\].
    pub drift: f64,
    /// max_k (E_{k+1} − E_k) \[J\]; negative if every step loses energy, −∞ without steps.
    pub largest_gain: f64,
}

/// Balance of any function of the state, for instance `Mechanism::energy` or a scheme's own invariant.
pub fn energy_balance(recording: &Recording, energy: impl Fn(&crate::mechanics::State) -> f64) -> EnergyBalance {
    let energies: Vec<f64> = recording.samples.iter().map(energy).collect();
    let initial = energies[0];
    let largest = |values: &mut dyn Iterator<Item = f64>, start: f64| values.fold(start, |worst, value| larger(value, worst));
    EnergyBalance {
        initial,
        drift: largest(&mut energies.iter().map(|e| (e - initial).abs()), 0.0),
        largest_gain: largest(&mut energies.windows(2).map(|pair| pair[1] - pair[0]), f64::NEG_INFINITY),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::State;
    use nalgebra::dvector;

    #[test]
    fn drift_and_gain_are_told_apart() {
        let state = |v: f64| State { time: 0.0, position: dvector![0.0], velocity: dvector![v] };
        let mut recording = Recording::new("mass", "none".into(), 1.0, state(2.0));
        for v in [1.0, 1.5, 0.5] {
            recording.push(state(v), Vec::new());
        }
        let balance = energy_balance(&recording, |state| state.velocity[0]);
        assert_eq!(balance, EnergyBalance { initial: 2.0, drift: 1.5, largest_gain: 0.5 });
        recording.push(state(5.0), Vec::new());
        let balance = energy_balance(&recording, |state| state.velocity[0]);
        assert_eq!(balance, EnergyBalance { initial: 2.0, drift: 3.0, largest_gain: 4.5 }, "drift is a magnitude");
    }
}
