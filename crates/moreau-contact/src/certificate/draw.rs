//! Numbers for tests of proofs, the same in every run.

/// Whole numbers from a linear congruence.
pub(super) struct Draw(pub(super) u64);

impl Draw {
    /// From −most to most.
    pub(super) fn whole(&mut self, most: i64) -> i64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as i64 % (2 * most + 1) - most
    }

    /// From −1 to 1.
    pub(super) fn part(&mut self) -> f64 {
        self.whole(1 << 20) as f64 / f64::from(1 << 20)
    }
}
