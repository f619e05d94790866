//! The restitution an impact shows: −v⁺/v⁻ over each step, or run of steps, in which a falling body turns round.

/// e_eff = −v⁺/v⁻ of each impact of a body above a floor, from its sampled normal velocities.
///
/// An impact is a run of samples in which the velocity rises; v⁻ is the velocity before the run and v⁺ after it. Runs
/// that start at a speed below `threshold` \[m/s\] are resting contact and left out. Gravity acts during the run, so
/// that a scheme with step h and exact restitution shows e with an error of at most g · (length of the run)/|v⁻|.
///
/// ```
/// use moreau_dynamics::trajectory::metrics::effective_restitutions;
///
/// assert_eq!(effective_restitutions(&[-1.0, -2.0, 1.0, 0.0, -1.0, 0.5], 0.1), [0.5, 0.5]);
/// ```
pub fn effective_restitutions(velocities: &[f64], threshold: f64) -> Vec<f64> {
    let mut found = Vec::new();
    let mut k = 0;
    while k + 1 < velocities.len() {
        let start = k;
        while k + 1 < velocities.len() && velocities[k + 1] > velocities[k] {
            k += 1;
        }
        if k == start {
            k += 1;
        } else if velocities[start] < -threshold {
            found.push(-velocities[k] / velocities[start]);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_step_and_several_step_impacts_show_the_same_ratio() {
        assert_eq!(effective_restitutions(&[0.0, -1.0, -2.0, 1.0, 0.5], 0.1), [0.5]);
        assert_eq!(effective_restitutions(&[-1.0, -2.0, -1.0, 0.5, 1.0, 0.0, -0.5, -1.0, 0.25], 0.1), [0.5, 0.25]);
    }

    #[test]
    fn resting_contact_is_not_an_impact() {
        assert!(effective_restitutions(&[-0.01, 0.0, -0.01, 0.0], 0.1).is_empty());
        assert!(effective_restitutions(&[], 0.1).is_empty());
    }
}
