//! Planted mistakes that repeat another one's line of reasoning: they differ from it in a constant, or in the place where it is met.

/// The mistake and the one that it repeats, by name.
pub const REPEATS: &[(&str, &str)] = &[
    ("tumbling/springs-and-extrapolated-sweeps", "tumbling/extrapolated-sweeps"),
    ("tumbling/springs-and-two-sweeps", "tumbling/two-sweeps"),
    ("tumbling/deeper-than-its-springs", "rest/undeclared-slop"),
    ("solver/three-sweeps", "tumbling/two-sweeps"),
    ("systems/one-sweep", "tumbling/two-sweeps"),
    ("systems/one-sweep-more", "tumbling/two-sweeps"),
    ("systems/four-sweeps", "tumbling/two-sweeps"),
    ("rocking/full-edges", "contact/inertia-of-full-extents"),
    ("metamorphic/damping-in-the-world", "flight/undeclared-damping"),
    ("metamorphic/friction-along-axes", "isotropy/boxed-friction"),
    ("cone-projection/box", "isotropy/boxed-friction"),
    ("round/cylinders-pass-through", "round/sides-pass-through"),
    ("incline/undeclared-relaxation", "solver/convex-relaxation"),
    ("incline/friction-root-two", "incline/friction-squared"),
    ("scheme/half-friction", "incline/friction-squared"),
    ("systems/friction-larger", "incline/friction-squared"),
    ("systems/friction-slightly-larger", "incline/friction-squared"),
    ("systems/rolling-friction", "incline/friction-squared"),
    ("stewart-trinkle/friction-forgotten", "incline/friction-squared"),
    ("systems/restitution-off", "ball/restitution-multiplied"),
    ("energy-balance/restitution-twice", "ball/restitution-multiplied"),
    ("convergence/fixed-margin", "contact/early"),
    ("ball/baumgarte-velocity-kept", "energy/baumgarte"),
    ("energy/delassus-with-mass", "delassus/mass-instead-of-its-inverse"),
    ("readers/mass-as-its-inverse", "delassus/mass-instead-of-its-inverse"),
    ("energy-balance/gravity-twice", "scheme/forces-too-strong"),
    ("energy-balance/impulse-scaled", "solver/a-thousandth-left"),
    ("energy-balance/positions-of-another-theta", "scheme/positions-ahead"),
    ("convergence/trapezoidal-position", "scheme/positions-ahead"),
    ("systems/first-run-ahead", "scheme/positions-ahead"),
    ("systems/multibody-for-rigid", "systems/rigid-for-multibody"),
    ("systems/damped", "systems/spectral-radius"),
    ("systems/velocities-before", "solver/velocity-before-its-impulses"),
    ("systems/one-tells-velocities-before", "solver/velocity-before-its-impulses"),
    ("systems/one-answers-another-problem", "systems/another-problem"),
    ("systems/stiffness-larger", "systems/compliance-larger"),
    ("forms/top-sign", "flight/gyroscopic-sign"),
    ("forms/top-as-a-ball", "flight/no-gyroscopic-term"),
    ("forms/friction-always-uphill", "incline/friction-not-opposed"),
    ("certificate/associated-for-coulomb", "solver/convex-relaxation"),
];

/// The mistake that this one repeats.
pub(super) fn original(name: &str) -> Option<&'static str> {
    REPEATS.iter().find(|(repetition, _)| *repetition == name).map(|(_, original)| *original)
}
