//! A bouncing ball: the errors of sampling, of event capturing and of the replay of a compliant law.

pub use moreau_forms::tolerance::{OSCILLATOR_PARTS, oscillator_rebound};

/// Error of a measured v⁺/v⁻ at an impact with speed v and restitution e. Both velocities are off by at most g (s + 2h), with the step h
/// and the time s between samples \[s\]. The flight to and from the floor is corrected for by at most g s. A step may count its gravity
/// before or after the reversal, and an engine may need one more step for the reversal.
/// Derived.
pub fn restitution(e: f64, speed: f64, gravity: f64, h: f64, spacing: f64) -> f64 {
    let off = gravity * (spacing + 2.0 * h);
    (1.0 + e) * off / (speed - off).max(off)
}

/// Error of v⁺/v⁻ of a plastic impact: g (s + 2h), divided by the speed.
/// Derived.
pub fn plastic(speed: f64, gravity: f64, h: f64, spacing: f64) -> f64 {
    restitution(0.0, speed, gravity, h, spacing)
}

/// How far a ball may get into the floor \[m\]. It moves (v + g h) h before the impact is noticed. It moves half of that again if the
/// position is updated with the mean of both velocities.
/// Derived.
pub fn depth(speed: f64, gravity: f64, h: f64) -> f64 {
    1.5 * (speed + gravity * h) * h
}

/// Error of the apex after a bounce, divided by the height H of the drop. The energy e²·½v² is off by (v⁺ + ½δ) δ with δ = g (s + 2h) (1 +
/// e). The flight starts up to [`depth`] away from the floor.
/// Derived.
pub fn apex(e: f64, speed: f64, height: f64, gravity: f64, h: f64, spacing: f64) -> f64 {
    let off = gravity * (spacing + 2.0 * h) * (1.0 + e);
    ((e * speed + 0.5 * off) * off / gravity + depth(speed, gravity, h)) / height
}

/// Height that an elastic ball may seem to gain at an apex, divided by the height H of the drop. A θ-scheme keeps E − (θ−½) g h v, and the
/// slowest sample at each apex has |v| ≤ ½ g s, which makes ½ g h s. To this come n roundings of the energy, with condition number two.
/// Derived.
pub fn apex_gain(height: f64, gravity: f64, h: f64, spacing: f64, samples: usize, epsilon: f64) -> f64 {
    let steps = samples as f64 * spacing / h;
    0.5 * gravity * h * spacing / height + 16.0 * steps * epsilon
}

/// Steps by which a ball with impact speed σ₀ = v/(g h) may be absorbed early and late: the widest of the bounds proved in
/// [`moreau_checks::tolerance::zeno`] over the activation rules A, B and D and θ = ½ and 1.
/// Derived.
pub fn absorption(e: f64, impact_speed: f64) -> [f64; 2] {
    let bounds = drops(e, impact_speed).map(|drop| drop.bounds());
    bounds.fold([0.0; 2], |[early, late], bounds| [early.max(bounds.early), late.max(bounds.late)])
}

/// Steps by which a ball may be absorbed late after n bounces, however slow they are. By section 3 of [`moreau_checks::tolerance::zeno`]
/// the first impact is at most δ₀ too fast and each next one at most δ₊ faster than e times the last, so that all are at most Δ = δ₀ +
/// δ₊/(1 − e) faster than the exact ones. By section 5 a flight then lasts (1 + e) Δ + 1 steps too long. At most three active steps follow
/// before the next, by section 6.
/// Derived.
pub fn late_after(e: f64, bounces: usize) -> f64 {
    let late = |drop: moreau_checks::tolerance::zeno::Drop| {
        let kappa = drop.theta + drop.forecast;
        let (p, q, r) = (kappa - 1.5, 0.5 + (kappa - 1.0) / e, kappa - 1.0);
        let faster = q - p + (p * p - q * q + 2.0 * r).max(0.0).sqrt();
        let first = drop.first_impact();
        first + 1.0 + bounces as f64 * ((1.0 + e) * (first + faster / (1.0 - e)) + 1.0 + 3.0)
    };
    // The first impact is faster by no more for a faster ball.
    drops(e, 1.0).map(late).fold(0.0, f64::max)
}

/// The drop under the activation rules A, B and D and θ = ½ and 1.
fn drops(restitution: f64, impact_speed: f64) -> impl Iterator<Item = moreau_checks::tolerance::zeno::Drop> {
    let rules = [(0.0, 0.0), (0.5, 0.0), (1.0, 1.0)];
    let with = move |(forecast, offset), theta| moreau_checks::tolerance::zeno::Drop { forecast, offset, theta, restitution, impact_speed };
    rules.into_iter().flat_map(move |rule| [0.5, 1.0].map(|theta| with(rule, theta)))
}

/// Speed \[m/s\] below which a ball counts as resting: the gravity of one step, g h.
/// Derived.
pub fn settled_speed(gravity: f64, h: f64) -> f64 {
    gravity * h
}

/// Gap or depth \[m\] at which a ball may come to rest. Section 7 of [`moreau_checks::tolerance::zeno`] puts it between −2.875 and 1 times
/// g h² at e = ½.
/// Derived.
pub fn resting_gap(gravity: f64, h: f64) -> f64 {
    3.0 * gravity * h * h
}

/// Rounding of a coordinate of at most `size` \[m\] after n samples, each of at most 16 steps' roundings.
/// Derived.
pub fn place(samples: usize, size: f64, epsilon: f64) -> f64 {
    16.0 * samples as f64 * epsilon * size
}

/// Time between samples \[s\] of motions of some seconds; a step of this length and more is sampled every time.
/// Set.
pub const SETTLING_SAMPLE: f64 = 1e-3;

/// Longest contact that is waited for \[s\]: half a period π√(m/k) of a spring of 1 kg softer than any engine's default, 1 kN/m.
/// Derived.
pub const LONGEST_CONTACT: f64 = 0.1;

/// Relative error of a replayed impact. Each step of the engine's solver ends within a relative 1e-6 of its answer (SAP's documented
/// stopping rule, the loosest), or at √ε. The map of a step does not spread differences. Only the steps in contact count. Each sample
/// stands for one of them or more, and their errors do not depend on the size of the step.
/// Derived.
pub fn replay(samples: usize, epsilon: f64) -> f64 {
    samples as f64 * moreau_forms::tolerance::SAP_RELATIVE.max(epsilon.sqrt())
}
