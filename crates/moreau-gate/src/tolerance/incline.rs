//! Allowances of [`crate::checks::incline`].

use super::SOLVED;

/// Creep \[m/s\] that a step's solver may leave where Coulomb sticks: [`SOLVED`] of what gravity gains in a step, g sin α h. It does not
/// add up, because the next step starts from that velocity and stops it again. Plus two positions of size L \[m\] read over a time T \[s\].
pub fn creep(pull: f64, h: f64, epsilon: f64, size: f64, time: f64) -> f64 {
    SOLVED * pull * h + 2.0 * epsilon * size / time
}

/// Relative error of a creep that is predicted at the undeformed corners: a depth δ displaces every contact by at most δ and so changes
/// moments about a lever c, and with them the loads of the corners, by at most 2δ/c; the softness of a contact changes with its load by no
/// more than its load does (d rises with the depth), and the corner's lever changes w by less.
pub fn creep_geometry(depth: f64, lever: f64) -> f64 {
    2.0 * depth.abs() / lever
}

/// Mean acceleration \[m/s²\] over a time T of a slide: one step's friction μ g cos α h may be missing or doubled at the start, where the
/// contact may be found late; everything else is constant and integrated exactly. Plus what the solver leaves, per step.
pub fn slide(friction: f64, press: f64, h: f64, time: f64) -> f64 {
    friction * press * h / time + SOLVED * press
}

/// The momentum law per time \[m/s²\]: holds for any normal impulses, also those of a contact that is found late, so only the solver's
/// part.
pub fn momentum(press: f64) -> f64 {
    SOLVED * press
}

/// Mean acceleration \[m/s²\] that a law whose friction μ g cos α (`full`) needs a slip v_c \[m/s\] to saturate gains over a time T: at
/// worst friction acts fully only from v_c on, which a slide with the acceleration a reaches after v_c/a at the latest.
pub fn unsaturated(full: f64, slip: f64, acceleration: f64, time: f64) -> f64 {
    full * slip / acceleration / time
}

/// Gap \[m\] that a sound step may leave under a contact: found up to one step late, at a depth of up to g h², and pushed out of it in one
/// step with up to g h, which rises (g h)²/2g.
pub fn gap(press: f64, h: f64) -> f64 {
    press * h * h + 0.5 * press * h * h
}

/// A replayed motion of T/h steps is off by [`SOLVED`] of each change of velocity, which is `change` \[m/s\] in all, over the time T; times
/// the amplification that two replays from neighbouring starts show.
pub fn replay(change: f64, time: f64, amplification: f64) -> f64 {
    SOLVED * change * time * amplification.max(1.0)
}

/// Relative distance of neighbouring starts, √ε: far from rounding and from nonlinearity alike.
pub fn neighbouring() -> f64 {
    f64::EPSILON.sqrt()
}
