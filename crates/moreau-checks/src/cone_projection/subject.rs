//! The subject of the family, and how far a point is from the cone and its polar.

/// The subject: replaces `z` by its projection on K_μ.
pub type Projection = fn(&mut [f64], f64);

pub(crate) fn apply(subject: Projection, z: &[f64], mu: f64) -> Vec<f64> {
    let mut point = z.to_vec();
    subject(&mut point, mu);
    point
}

/// a − b.
pub fn difference(left: &[f64], right: &[f64]) -> Vec<f64> {
    left.iter().zip(right).map(|(a, b)| a - b).collect()
}

/// a·b.
pub fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(a, b)| a * b).sum()
}

/// ‖z‖, without overflow.
pub fn norm(z: &[f64]) -> f64 {
    z.iter().fold(0.0, |length: f64, &entry| length.hypot(entry))
}

/// How far `z` is outside K_μ, `max(‖z_t‖ − μ z_n, −z_n)`, relative to `√(1+μ²)`.
pub fn cone_excess(z: &[f64], mu: f64) -> f64 {
    ((norm(&z[1..]) - mu * z[0]) / mu.hypot(1.0)).max(-z[0])
}

/// How far `p` is outside K_μ°, `μ‖p_t‖ + p_n`, relative to `√(1+μ²)`.
pub fn polar_excess(p: &[f64], mu: f64) -> f64 {
    (mu * norm(&p[1..]) + p[0]) / mu.hypot(1.0)
}
