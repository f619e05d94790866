//! The findings of a step whose scheme goes through the waist.

use crate::energy_balance::constant::Constant;
use crate::energy_balance::gyroscopic::Turned;
use crate::energy_balance::waist::{Posed, WaistLaw};
use crate::energy_balance::{IDENTITY, Judged, KINETIC, RESIDUAL, Taken, linear, own, total};
use moreau_checks::Finding;
use moreau_exact::Result;

impl WaistLaw {
    /// The findings of one step.
    pub fn judge(&self, taken: &Taken) -> Result<Judged> {
        if self.explicit && taken.mechanism.linear_force().is_some() {
            // MuJoCo damps joints after its contact problem: r answers another velocity than v⁺
            return Ok(own::nothing());
        }
        let posed = self.posed(taken)?;
        let Posed { exchange, work, rounding, .. } = &posed;
        let exact = exchange.impulse.dot(&exchange.after) - 0.5 * exchange.square;
        let allowed = posed.given - 0.5 * exchange.square + work.residual;
        let mut findings = vec![
            Finding::equal(IDENTITY, exchange.gained, exact, *rounding, "J"),
            Finding::at_most_within(RESIDUAL, work.residual, work.limit, *rounding, "J"),
            Finding::at_most_within(KINETIC, exchange.gained, allowed, *rounding, "J"),
        ];
        let (mut gain, mut rise) = (None, None);
        if let Some(constant) = Constant::of(taken, self) {
            let turned = Turned::of(taken, &constant, self.explicit)?;
            findings.extend(turned.findings(taken));
            let judged = total::judge(self, taken, &posed, &constant, &turned);
            findings.extend(judged.findings);
            rise = judged.rise;
            gain = self.position.moves_by_velocities().then(|| allowed.max(0.0) + turned.gain.max(0.0) + rounding);
        } else {
            findings.extend(linear::judge(self, taken, &posed));
        }
        Ok(Judged { findings, residual: work.residual, gain, rise })
    }
}
