//! Allowances of [`crate::checks::incline`].

use super::SOLVED;

/// Creep \[m/s\] that a step's solver may leave where Coulomb's block sticks: [`SOLVED`] of the velocity g sin α h that gravity adds in a
/// step. It does not add up, because the next step starts from that velocity and stops it. To this comes the rounding of two positions of
/// size L \[m\], divided by the time T \[s\] between them.
/// Derived.
pub fn creep(pull: f64, h: f64, epsilon: f64, size: f64, time: f64) -> f64 {
    SOLVED * pull * h + 2.0 * epsilon * size / time
}

/// A slower creep \[m/s\] is not told from rounding where creeps are drawn: a nanometre per second, about a thousandth of what a
/// sound discretisation may make at the smallest step of the scoreboard.
/// Set.
pub const SLOWEST: f64 = 1e-9;

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

/// Slip \[m/s\] that friction may leave where an error reduction r pushes a box out of its slope. It is found at a depth of at most 3/2 g
/// cos α h² ([`super::ball::depth`]). Each step takes back the part r of what is left, by normal velocities which add up to depth/h. A box
/// that hops by them falls back to a part r of the depth, so that all pushes together give depth/(h (1 − r)) of normal velocity, and
/// friction misses at most μ times that.
/// Derived.
pub fn pushed_friction(friction: f64, reduction: f64, press: f64, h: f64) -> f64 {
    if reduction > 0.0 { friction * super::ball::depth(0.0, press, h) / (h * (1.0 - reduction).max(f64::MIN_POSITIVE)) } else { 0.0 }
}

/// Mean acceleration \[m/s²\] that a body gains over a time T while a spring along the slope is loaded, x'' = pull − ω² x, until friction
/// is full: it is slower than pull/ω then, by the energy of the spring, and full friction would have taken a part of that.
/// Derived.
pub fn loading(pull: f64, frequency_squared: f64, time: f64) -> f64 {
    pull / frequency_squared.sqrt() / time
}

/// Creep \[m/s\] of a box that sticks, where each step takes back a part r of its depth. In units of g cos α h², the box is found at a
/// depth d ≤ 3/2 ([`super::ball::depth`]) and flies at r d − n after n steps of flight, at the height −(1 − r) d + n r d − ½ n (n + 1),
/// which is negative again for n > 2 r d − 1. So it flies for n ≤ 3 r steps, at least for the one in which it opens, and is found no
/// deeper than before: ½ n (n + 1) − n d ≤ d. It moves down by (1 + … + n) g sin α h² meanwhile, in n steps and the one in which it lands,
/// where friction stops it: on the average at ½ n g sin α h. Where it does not fly, the push takes r d/h ≤ 3/2 r g cos α h from the normal
/// impulses of the steps that follow, and μ times that from their friction, `full` = μ g cos α. If tan α is close to μ no friction is left
/// to stop that slip.
/// Derived.
pub fn pushed_creep(reduction: f64, full: f64, h: f64) -> f64 {
    (1.5 * reduction).max(0.5) * full * h
}

/// Depth \[m\] at which a sound step may find a contact that closes from rest: 3/2 g h², see [`super::ball::depth`].
/// Derived.
pub fn found(press: f64, h: f64) -> f64 {
    super::ball::depth(0.0, press, h)
}

/// Height \[m\] to which a step rises that pushes a body out of a depth δ at δ/h and leaves it that velocity: (δ/h)²/2g, and the way of the
/// step that goes on with it.
/// Derived.
pub fn risen(depth: f64, press: f64, h: f64) -> f64 {
    (depth / h).powi(2) / (2.0 * press) + depth
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

#[cfg(test)]
mod tests {
    use super::pushed_creep;
    use moreau_exact::tolerance::rounding;

    /// Mean speed down the slope of a point that sticks with full friction, in units of g sin α h = g cos α h = 1: it starts at a depth d,
    /// and each step takes back the part r.
    fn crept(reduction: f64, depth: f64) -> f64 {
        let (mut gap, mut normal, mut slip, mut way) = (-depth, 0.0, 0.0, 0.0);
        let steps = 4000;
        for _ in 0..steps {
            let free: f64 = normal - 1.0;
            // What rounding leaves of a depth opens.
            let next = if gap < -1e-9 { free.max(reduction * -gap) } else { free };
            slip = f64::max(slip + 1.0 - (next - free), 0.0);
            normal = next;
            gap += normal;
            way += slip;
        }
        way / f64::from(steps)
    }

    #[test]
    fn a_point_that_hops_by_corrections_creeps_no_faster_than_its_bound() {
        for reduction in [0.05, 0.2, 0.4, 0.5, 0.7, 0.8, 0.9, 1.0] {
            for depth in [0.0, 0.3, 0.7, 1.0, 1.3, 1.5] {
                let (found, bound) = (crept(reduction, depth), pushed_creep(reduction, 1.0, 1.0));
                assert!(found <= bound + rounding(4000, 1.0), "{reduction} {depth}: {found} {bound}");
            }
        }
        // It is reached from the greatest depth, where tan α = μ leaves nothing to stop the slip.
        assert!([0.4, 0.8, 1.0].into_iter().all(|reduction| crept(reduction, 1.5) >= 0.99 * pushed_creep(reduction, 1.0, 1.0)));
    }
}
