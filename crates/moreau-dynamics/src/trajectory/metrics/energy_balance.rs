//! Energy over a motion: E_k − E_0 and the largest gain in one step.

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

impl EnergyBalance {
    /// That of any energies at the samples of a motion \[J\], of `Mechanism::energy` or of a scheme's own invariant.
    ///
    /// # Panics
    /// If there are none.
    pub fn of(energies: &[f64]) -> Self {
        let initial = energies[0];
        let largest = |values: &mut dyn Iterator<Item = f64>, start: f64| values.fold(start, |worst, value| larger(value, worst));
        EnergyBalance {
            initial,
            drift: largest(&mut energies.iter().map(|e| (e - initial).abs()), 0.0),
            largest_gain: largest(&mut energies.windows(2).map(|pair| pair[1] - pair[0]), f64::NEG_INFINITY),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drift_and_gain_are_told_apart() {
        let balance = EnergyBalance::of(&[2.0, 1.0, 1.5, 0.5]);
        assert_eq!(balance, EnergyBalance { initial: 2.0, drift: 1.5, largest_gain: 0.5 });
        let balance = EnergyBalance::of(&[2.0, 1.0, 1.5, 0.5, 5.0]);
        assert_eq!(balance, EnergyBalance { initial: 2.0, drift: 3.0, largest_gain: 4.5 }, "drift is a magnitude");
    }
}
