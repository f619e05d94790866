//! Where a circle in space comes nearest to a line and to another circle.
//!
//! ```text
//!     p(θ) = c + r (x cos θ + y sin θ)        x along the part of the line's direction e in the circle's plane, of the size k
//!     ‖P(p − q)‖² = ‖w‖² + 2r (A cos θ + B sin θ) + r² (1 − k² cos² θ)        P = 1 − e eᵀ , w = P(c − q) , A = w·x , B = w·y
//! ```
//! Turn x and y so that A, B ≥ 0. At θ = π + α the distance is least where A cos α + B sin α + ½ r k² cos² α is largest, once between 0
//! and π/2: its derivative over sin α cos α, B/sin α − A/cos α − r k², falls. At θ = −α the sign of A is the other one. There
//! A/cos α + B/sin α is least, (A^⅔ + B^⅔)^(3/2), for tan³ α = B/A, and if r k² is larger, there is a second least distance before that α.
//! Where sin θ > 0 there is none: the distance is monotone, or largest.
//!
//! Two circles have an equation of degree eight. Its roots are looked for along the first circle, whose points know their nearest one on
//! the second: p − q has no part along the tangent t of p.

use crate::tolerance::mechanics::{ARCS, PARALLEL, ROOT_STEPS};
use moreau_exact::tolerance::EPSILON;
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A circle in space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    /// c \[m\].
    pub centre: Vector3<f64>,
    /// Two unit vectors of its plane, at right angles.
    pub plane: [Vector3<f64>; 2],
    /// r \[m\].
    pub radius: f64,
}

/// A point of a circle and one of a line or another circle between which the distance is least, or a local least.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    /// The points.
    pub points: [Vector3<f64>; 2],
    /// Unit tangents of both at these points.
    pub tangents: [Vector3<f64>; 2],
}

impl Passage {
    /// The direction that is normal to both, if they are not parallel.
    pub fn across(&self) -> Option<Vector3<f64>> {
        let across = self.tangents[0].cross(&self.tangents[1]);
        let length = across.norm();
        (length >= PARALLEL).then(|| across / length)
    }
}

impl Circle {
    /// x cos θ + y sin θ and its derivative.
    fn frame(&self, angle: f64) -> [Vector3<f64>; 2] {
        let ([x, y], (sine, cosine)) = (self.plane, angle.sin_cos());
        [x * cosine + y * sine, y * cosine - x * sine]
    }

    /// Where it comes nearest to the line through a point along a unit vector: the least distance, and a second local least if there is
    /// one.
    pub fn passes_line(&self, through: &Vector3<f64>, along: &Vector3<f64>) -> [Option<Passage>; 2] {
        let [first, second] = self.plane;
        let flat = [first.dot(along), second.dot(along)];
        let size = flat[0].hypot(flat[1]);
        // a line along the axis sees every direction alike
        let [cosine, sine] = if size > 0.0 { flat.map(|part| part / size) } else { [1.0, 0.0] };
        let (x, y) = (first * cosine + second * sine, second * cosine - first * sine);
        let apart = self.centre - through;
        let w = apart - along * along.dot(&apart);
        let [a, b] = [w.dot(&x), w.dot(&y)];
        let (x, y) = (x * a.signum(), y * b.signum());
        let ([a, b], bend) = ([a.abs(), b.abs()], self.radius * size * size);
        // half the derivative of ∓A cos α + B sin α + ½ r k² cos² α, and its own
        let slope = |side: f64| {
            move |angle: f64| {
                let (sine, cosine) = angle.sin_cos();
                let value = side * a * sine + (b - bend * sine) * cosine;
                (value, side * a * cosine - b * sine - bend * (cosine - sine) * (cosine + sine))
            }
        };
        let at = |side: f64, angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            let out = x * (side * cosine) - y * sine;
            let tangent = x * (side * sine) + y * cosine;
            let point = self.centre + out * self.radius;
            let foot = through + along * along.dot(&(point - through));
            Passage { points: [point, foot], tangents: [tangent, *along] }
        };
        let least = at(-1.0, sign_change([0.0, FRAC_PI_2], slope(-1.0)));
        let [root_a, root_b] = [a, b].map(f64::cbrt);
        let again = bend > root_a.hypot(root_b).powi(3);
        let second = again.then(|| at(1.0, sign_change([0.0, root_b.atan2(root_a)], slope(1.0))));
        [Some(least), second]
    }

    /// Every place where it comes nearer to another circle than beside it.
    pub fn passes_circle(&self, other: &Circle) -> Vec<Passage> {
        let part = TAU / ARCS as f64;
        let slope = |angle: f64| self.slope_towards(other, angle);
        let slopes: Vec<f64> = (0..ARCS).map(|k| slope(part * k as f64).0).collect();
        let turns = (0..ARCS).filter(|k| slopes[*k] >= 0.0 && slopes[(k + 1) % ARCS] < 0.0);
        let place = |k: usize| {
            let angle = sign_change([part * k as f64, part * (k + 1) as f64], slope);
            let [out, tangent] = self.frame(angle);
            let point = self.centre + out * self.radius;
            let [outward, along] = other.nearest(&point);
            Passage { points: [point, other.centre + outward * other.radius], tangents: [tangent, along] }
        };
        turns.map(place).collect()
    }

    /// Unit vectors from the centre to the point of the circle that is nearest to a point, and along the circle there.
    fn nearest(&self, point: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let ([x, y], from) = (self.plane, point - self.centre);
        let [a, b] = [x.dot(&from), y.dot(&from)];
        let size = a.hypot(b);
        let [a, b] = if size > 0.0 { [a / size, b / size] } else { [1.0, 0.0] };
        [x * a + y * b, y * a - x * b]
    }

    /// −t·(p − q) and its derivative over θ, q the point of the other circle that is nearest to p.
    fn slope_towards(&self, other: &Circle, angle: f64) -> (f64, f64) {
        let [out, tangent] = self.frame(angle);
        let point = self.centre + out * self.radius;
        let [outward, along] = other.nearest(&point);
        let apart = point - other.centre - outward * other.radius;
        let size = outward.dot(&(point - other.centre));
        let together = along.dot(&tangent).powi(2) * other.radius / size;
        (-tangent.dot(&apart), apart.dot(&out) - self.radius * (1.0 - together))
    }
}

/// Where a function that is not negative at the lower end turns negative, to rounding: steps of Newton within a bracket that halves
/// otherwise.
fn sign_change([mut low, mut high]: [f64; 2], function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut place = 0.5 * (low + high);
    for _ in 0..ROOT_STEPS {
        let (value, slope) = function(place);
        if value >= 0.0 {
            low = place
        } else {
            high = place
        }
        let newton = place - value / slope;
        let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
        if (next - place).abs() <= EPSILON * (1.0 + place) {
            return next;
        }
        place = next;
    }
    place
}
