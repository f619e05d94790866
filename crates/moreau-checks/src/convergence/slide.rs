//! A block on an incline that sticks or slides, against Coulomb's law in closed form.
//!
//! ```text
//!     sliding, Stewart–Trinkle or Moreau–Jean θ=1:   v_k = v(t_k) ,   x_k − x(t_k) = ½ a h t_k ,
//!     sliding, Anitescu from φ = μ h v₀:             φ_k = μ h v_k ,  v_k − v(t_k) → −a h μ² ,
//!     sliding, Anitescu from φ = 0:                  hop to (μ v₀)²/(2 g cos α (1+μ²)²), for every h.
//! ```

use crate::finding::Finding;
use crate::tolerance::convergence::{slide_rounding, slide_second_order};
use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{Scheme, simulate};
use moreau_dynamics::trajectory::metrics::{creep_speed, largest_gap, position_sup, velocity_l1, velocity_sup};
use moreau_dynamics::trajectory::{Graph, Recording, Refinement, fit_order};
use moreau_exact::Result;
use moreau_forms::InclineBlock;
use nalgebra::dvector;

/// A block of 1 kg on a slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incline {
    /// g \[m/s²\].
    pub gravity: f64,
    /// α \[rad\].
    pub angle: f64,
    /// μ.
    pub friction: f64,
    /// v₀ down the slope \[m/s\].
    pub velocity: f64,
    /// Simulated time \[s\].
    pub duration: f64,
}

/// Steps per run, level by level.
const STEPS: [usize; 4] = [16, 64, 256, 1024];

impl Incline {
    fn run(&self, scheme: &dyn Scheme, gap: f64, steps: usize) -> Result<(Recording, f64)> {
        let h = self.duration / steps as f64;
        let block = PointMass::block_on_incline(1.0, self.gravity, self.angle, self.friction, 0.0);
        let initial = State { time: 0.0, position: dvector![0.0, gap], velocity: dvector![self.velocity, 0.0] };
        Ok((simulate(scheme, &Auto, &block, initial, h, steps)?, h))
    }

    fn exact(&self) -> Result<InclineBlock> {
        InclineBlock::new(self.gravity, self.angle, self.friction, self.velocity)
    }

    /// Position, L¹ and sup error of the motion along the slope.
    fn errors(&self, recording: &Recording) -> Result<[f64; 3]> {
        let exact = self.exact()?;
        let (times, along) = (times(recording), component(recording, 0));
        let speeds: Vec<f64> = recording.samples.iter().map(|sample| sample.velocity[0]).collect();
        let discrete = Graph::steps(&times, &speeds)?;
        let reference = Graph::new(exact.velocity_corners(times[times.len() - 1]))?;
        let position = position_sup(&times, &along, |t| exact.state(t).0);
        Ok([position, velocity_l1(&discrete, &reference), velocity_sup(&discrete, &reference)])
    }
}

fn times(recording: &Recording) -> Vec<f64> {
    recording.samples.iter().map(|sample| sample.time).collect()
}

fn component(recording: &Recording, index: usize) -> Vec<f64> {
    recording.samples.iter().map(|sample| sample.position[index]).collect()
}

/// A block that Coulomb's law holds stays where it is, to rounding, at every step size.
///
/// # Errors
/// Those of the scheme.
pub fn sticking(subject: &dyn Scheme, incline: &Incline) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for steps in STEPS {
        let (recording, h) = incline.run(subject, 0.0, steps)?;
        let creep = creep_speed(&times(&recording), &component(&recording, 0), 0.0).unwrap_or(f64::NAN);
        let bound = slide_rounding(steps);
        findings.push(Finding::equal(format!("creep of a sticking block at h = {h:.3e}"), creep, 0.0, bound, "m/s"));
        let hop = largest_gap(&component(&recording, 1));
        findings.push(Finding::equal(format!("gap of a sticking block at h = {h:.3e}"), hop, 0.0, bound, "m"));
    }
    Ok(findings)
}

/// Sliding under Coulomb's law: exact velocities at the nodes, so every error has its constant in closed form.
///
/// # Errors
/// Those of the scheme.
pub fn coulomb_slide(subject: &dyn Scheme, incline: &Incline) -> Result<Vec<Finding>> {
    let a = incline.exact()?.acceleration(1.0);
    slide(subject, incline, |_| 0.0, [0.5 * a * incline.duration, 0.5 * a * incline.duration, a])
}

/// Anitescu's slide from the gap it keeps: φ = μ h |v|, velocity deficit a h μ².
///
/// The velocity error runs from a h(1−μ²) to −a h μ² in each step, so ∫|·| = ½ a h \[(1−μ²)² + μ⁴\] per unit of time.
///
/// # Errors
/// Those of the scheme.
pub fn anitescu_slide(subject: &dyn Scheme, incline: &Incline) -> Result<Vec<Finding>> {
    let (a, duration) = (incline.exact()?.acceleration(1.0), incline.duration);
    let squared = incline.friction * incline.friction;
    let mean = 0.5 * ((1.0 - squared).powi(2) + squared * squared);
    let constants = [a * duration * (0.5 - squared).abs(), a * duration * mean, a / (1.0 + squared)];
    let start = |h: f64| incline.friction * h * incline.velocity.abs();
    let mut findings = slide(subject, incline, start, constants)?;
    for steps in STEPS {
        let (recording, h) = incline.run(subject, start(incline.duration / steps as f64), steps)?;
        let excess = recording.samples.iter().map(|s| (s.position[1] - incline.friction * h * s.velocity[0].abs()).abs());
        let worst = excess.fold(0.0, f64::max);
        findings.push(Finding::equal(format!("|φ − μ h |v|| at h = {h:.3e}"), worst, 0.0, slide_rounding(steps), "m"));
    }
    Ok(findings)
}

/// Anitescu's slide from φ = 0 hops, by a height that does not vanish with h.
///
/// First step, with g_n = g cos α and g_s = g sin α: r on the boundary of K and y on that of K* give
/// ```text
///     v_n⁺ = \[μ (v₀ + h g_s) − μ² h g_n\]/(1+μ²) ,   within μ g h of w = μ v₀/(1+μ²) .
/// ```
/// From there the free flight q⁺ = q + h v⁺ rises to w²/(2g_n) + ½ w h, sampled to within g h²: in all the hop is within
/// w h (½ + μ g/g_n) + g h² (1 + ½μ + ½μ² g/g_n) of w²/(2g_n).
///
/// # Errors
/// Those of the scheme.
pub fn anitescu_hop(subject: &dyn Scheme, incline: &Incline) -> Result<Vec<Finding>> {
    let (mu, normal_gravity) = (incline.friction, incline.gravity * incline.angle.cos());
    let launch = mu * incline.velocity / (1.0 + mu * mu);
    let height = launch * launch / (2.0 * normal_gravity);
    let mut findings = Vec::new();
    for steps in STEPS {
        let (recording, h) = incline.run(subject, 0.0, steps)?;
        let hop = largest_gap(&component(&recording, 1));
        let ratio = incline.gravity / normal_gravity;
        let first = launch.abs() * h * (0.5 + mu * ratio);
        let second = incline.gravity * h * h * (1.0 + 0.5 * mu + 0.5 * mu * mu * ratio);
        let tolerance = first + second;
        findings.push(Finding::equal(format!("hop at h = {h:.3e}"), hop, height, tolerance, "m"));
    }
    Ok(findings)
}

/// Orders and constants of the three errors: constant·h up to a relative remainder.
fn slide(subject: &dyn Scheme, incline: &Incline, gap: impl Fn(f64) -> f64, constants: [f64; 3]) -> Result<Vec<Finding>> {
    let mut levels: [Vec<Refinement>; 3] = Default::default();
    for steps in STEPS {
        let (recording, time_step) = incline.run(subject, gap(incline.duration / steps as f64), steps)?;
        for (levels, error) in levels.iter_mut().zip(incline.errors(&recording)?) {
            levels.push(Refinement { time_step, error });
        }
    }
    let mut findings = Vec::new();
    for ((name, levels), constant) in ["sup|q|", "∫|v|", "sup|v|"].into_iter().zip(levels).zip(constants) {
        let estimate = fit_order(levels)?;
        let remainders: Vec<f64> = STEPS.iter().map(|&steps| slide_second_order(incline.friction, steps)).collect();
        let ratio = (1.0 + remainders[0]) / (1.0 - remainders[0]);
        findings.push(Finding::equal(format!("slide, {name}: order"), estimate.slope, 1.0, estimate.slope_interval(ratio), "1"));
        for (level, remainder) in estimate.levels.iter().zip(remainders) {
            let title = format!("slide, {name} at h = {:.3e}", level.time_step);
            let expected = constant * level.time_step;
            findings.push(Finding::equal(title, level.error, expected, expected * remainder, "SI"));
        }
    }
    Ok(findings)
}
