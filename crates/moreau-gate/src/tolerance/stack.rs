//! How far boxes at rest on each other may move ([`crate::checks::stack`]).

use super::SOLVED;

/// Velocity \[m/s\] that a solved step may leave. Gravity gives every body g h, and the contacts stop it by impulses of up to the whole
/// load Σm g h. A part [`SOLVED`] of these impulses is unknown, and moves the lightest body by that part of Σm g h/m_min.
/// Derived.
pub fn unsolved_velocity(gravity: f64, h: f64, load_ratio: f64) -> f64 {
    SOLVED * load_ratio * gravity * h
}

/// Distance \[m\] that a velocity left in every one of `steps` steps may add up to.
/// Derived.
pub fn drift(velocity: f64, steps: usize, h: f64) -> f64 {
    steps as f64 * h * velocity
}

/// Depth \[m\] of a landing after a fall of `drop` \[m\] and of `steps` steps more, at v = √(2 g · drop): 3/2 h (v + n g h). The contact is
/// found up to a step late, and the next step moves on with the mean of both speeds. The n-th box of a pile falls a step longer for each
/// level below it ([`found_depth`]); the first one falls for one.
/// Derived.
pub fn landing(gravity: f64, drop: f64, steps: usize, h: f64) -> f64 {
    1.5 * h * (sinking_speed(gravity, drop) + steps as f64 * gravity * h)
}

/// Depth \[m\] at which the contact of the n-th box may be found: h (v + n g h). The box has fallen through all gaps of `gap` \[m\], which
/// gives v = √(2 g n · gap). It has fallen a step longer for each level below it, n g h, and it moves on for one step.
/// Derived.
pub fn found_depth(gravity: f64, gap: f64, levels: usize, h: f64) -> f64 {
    let levels = levels as f64;
    h * (sinking_speed(gravity, levels * gap) + levels * gravity * h)
}

/// How far \[m\] an error reduction r without an allowance may sway a pile of this height on a base of this width \[m\] in n steps. A depth
/// falls to a part [`SOLVED`] of itself in ln s/ln(1 − r) steps. Then the solver decides whether a corner is still closed. One that opens
/// falls for a step and is found 3/2 g h² deep, which tips the pile by that over the width, and the top moves by that angle times the
/// height. Measured on examples/engines/gauss_seidel.py at r = 1/5: depths of 1e-9 m after 80 steps, then a tip every 40 steps.
/// Derived.
pub fn sway(reduction: f64, height: f64, width: f64, gravity: f64, h: f64, steps: usize) -> f64 {
    let times = 1.0 + steps as f64 * (1.0 - reduction.min(1.0 - f64::EPSILON)).ln() / SOLVED.ln();
    times * height * super::ball::depth(0.0, gravity, h) / width
}

/// By how much more a corner may yield under a spring of given frequency if the boxes are wider: 1/m_p = (1 + 6 a²/(a² + c²))/m at the
/// corner of a box of half extents a, a, c. It is at most 7/m, and at least 5/m for a > 1.42 c, also if the arm is a fiftieth shorter.
/// Derived.
pub const WIDER: f64 = 7.0 / 5.0;

/// Angle \[rad\] by which a box may have tipped on the one below it, on a base of this width \[m\], where every depth is taken back to
/// nothing. A corner that opens falls for a step, at most with 3/2 g, as the end of a rod that tips about its other end does. It is found
/// and acted on as after a landing, 3/2 · 3/2 g h² deep, and this depth is taken back like any other, so that tips do not add up in time.
/// Those of several levels may lean to one side. Measured on examples/engines/gauss_seidel.py at r = 1/5.
/// Derived.
pub fn tip(width: f64, gravity: f64, h: f64) -> f64 {
    1.5 * super::ball::depth(0.0, gravity, h) / width
}

/// Speed \[m/s\] that every level adds to those above it where every depth is taken back to nothing: a corner that opens falls for a step
/// with at most 3/2 g, and a part r of the depth at which it is found is taken back in the next one.
/// Derived.
pub fn tipping_speed(reduction: f64, gravity: f64, h: f64) -> f64 {
    1.5 * (gravity * h + reduction * super::ball::depth(0.0, gravity, h) / h)
}

/// Part of a depth that is left after n steps which take back a part r of it each.
/// Derived.
pub fn left(reduction: f64, steps: usize) -> f64 {
    (1.0 - reduction.min(1.0)).powf(steps as f64)
}

/// Whether a declared error reduction r without an allowance lets a corner fly for longer than the step in which it opens, which [`sway`]
/// takes for granted: it flies for up to 3 r steps ([`super::incline::pushed_creep`]).
/// Derived.
pub fn hops(reduction: f64) -> bool {
    3.0 * reduction > 1.0
}

/// Speed \[m/s\] gained by sinking a distance under gravity: ½v² ≤ g · sink.
/// Derived.
pub fn sinking_speed(gravity: f64, sink: f64) -> f64 {
    (2.0 * gravity * sink).sqrt()
}
