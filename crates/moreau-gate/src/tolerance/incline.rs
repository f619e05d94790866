//! Allowances of [`crate::checks::incline`].

use super::SOLVED;

/// Creep \[m/s\] that a step's solver may leave where Coulomb's block sticks: [`SOLVED`] of the velocity g sin α h that gravity adds in a
/// step. It does not add up, because the next step starts from that velocity and stops it. To this comes the rounding of two positions of
/// size L \[m\], divided by the time T \[s\] between them.
/// Derived.
pub fn creep(pull: f64, h: f64, epsilon: f64, size: f64, time: f64) -> f64 {
    SOLVED * pull * h + 2.0 * epsilon * size / time
}

/// Relative error of a creep that is predicted at the undeformed corners: a depth δ displaces every contact by at most δ and so changes
/// moments about a lever c, and with them the loads of the corners, by at most 2δ/c; the softness of a contact changes with its load by no
/// more than its load does (d rises with the depth), and the corner's lever changes w by less.
/// Derived.
pub fn creep_geometry(depth: f64, lever: f64) -> f64 {
    2.0 * depth.abs() / lever
}

/// Error of the mean acceleration \[m/s²\] of a slide over a time T. The friction μ g cos α h of one step may be missing or doubled at the
/// start, where the contact may be found late. All other forces are constant and integrated exactly. To this comes the error of the solver.
/// Derived.
pub fn slide(friction: f64, press: f64, h: f64, time: f64) -> f64 {
    friction * press * h / time + SOLVED * press
}

/// Error of the momentum law per time \[m/s²\]. The law holds for any normal impulses, also for a contact that is found late. So only the
/// solver's error counts.
/// Derived.
pub fn momentum(press: f64) -> f64 {
    SOLVED * press
}

/// Mean acceleration \[m/s²\] that a law gains over a time T if its friction μ g cos α (`full`) needs a slip v_c \[m/s\] to saturate. At
/// worst friction acts fully only above v_c, which a slide with the acceleration a reaches after v_c/a at the latest.
/// Derived.
pub fn unsaturated(full: f64, slip: f64, acceleration: f64, time: f64) -> f64 {
    full * slip / acceleration / time
}

/// Gap \[m\] that a sound step may leave under a contact. The contact is found up to one step late, at a depth of up to g h². The step
/// pushes it out with a velocity of up to g h, which rises (g h)²/2g.
/// Derived.
pub fn gap(press: f64, h: f64) -> f64 {
    press * h * h + 0.5 * press * h * h
}

/// Error \[m\] of a replayed motion over the time T: [`SOLVED`] of all changes of velocity, which add up to `change` \[m/s\], times T. It
/// is multiplied by the amplification that two replays from neighbouring starts show.
/// Derived.
pub fn replay(change: f64, time: f64, amplification: f64) -> f64 {
    SOLVED * change * time * amplification.max(1.0)
}

/// Relative distance of neighbouring starts, √ε. It is far above rounding, and far below any nonlinear effect.
/// Set.
pub fn neighbouring() -> f64 {
    f64::EPSILON.sqrt()
}
