//! Claims that say again what another one says: the repetition has the verdict of its original, and one mistake is charged once.

/// The repetition and its original.
pub const REPEATS: &[(&str, &str)] = &[
    ("M.high-order", "S0.all-Oh"),
    ("M.zeno", "S0.zeno-absorb"),
    ("R2", "S0.event-stuck"),
    ("M.lcp-nonunique", "S4.nonunique"),
    ("M.cone-error", "S4.poly-order"),
    ("P.modA", "S3.energy-runs-down"),
    ("P.modB", "S5.gliding-creep"),
    ("S5.glide-h-not-mu", "S5.gliding-creep"),
    ("T.delassus-psd", "S3.normal-solvable"),
    ("S4.ex-quadratic", "S4.quadratic-general"),
    ("S5.gliding-normal", "S5.gliding-creep"),
    ("S5.gliding-mechanism", "S5.gliding-creep"),
    ("M.convex-Oh", "S5.Oh-vanish"),
    ("V.drake", "S10.drake-default-sap"),
    ("S3.friction-block", "S4.copos-plus"),
    ("S9.siconos-class", "S3.siconos-path"),
    ("S8.k1e6", "S8.semi-bound"),
    ("S8.ex1", "S8.misc-order"),
    ("S8.ex2-fold", "S8.e1-only"),
    ("S8.timeconst-origin", "S8.damped-bound"),
    ("S9.clean-dirty", "S9.projection-energy"),
    ("S9.energy-up-causes", "S9.projection-energy"),
    ("S9.ex3", "S9.theta-damps-jitter"),
    ("S9.energy-down", "S8.backwards-theta-energy"),
    ("S6.omega-gt-1-over-2h", "S6.solref-meaning"),
    ("S6.steps-per-period", "S6.solref-meaning"),
    ("S6.mjx-gradients", "S6.smooth-everywhere"),
    ("S6.cone-softened", "S6.smooth-everywhere"),
    ("S6.semi-implicit-update", "S8.semi-much-better"),
    ("S6.solver-dependence", "S6.same-optimum"),
    ("S11.impulse-infinite", "S11.bv"),
    ("S11.ex3", "S11.reflection-symplectic"),
    ("S11.ten-years", "S2.dzonou"),
];

/// The claim that this one repeats.
pub fn original(id: &str) -> Option<&'static str> {
    REPEATS.iter().find(|(repetition, _)| *repetition == id).map(|(_, original)| *original)
}
