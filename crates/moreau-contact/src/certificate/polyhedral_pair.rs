//! An exact pair of a polyhedral law near (r, y): Moreau's decomposition on a face that rounded numbers tell.
//!
//! ```text
//!     r − ρ ŷ = r′ − ρ ŷ′ ,   K ∋ r′ ⟂ ŷ′ ∈ K* ,      K = { Σ f_j e_j : f ≥ 0 } ,   e_j = n + μ D_j
//!     ŷ = y + μ σ(y) n ,   σ(y) = max_j (−D_j·y_t)⁺    Stewart–Trinkle ;       ŷ = y    associated
//! ```
//! r′ stands on a face of K, and ŷ′ on the face of K* that is normal to it. Given these, a pair near the decomposition is a matter of one
//! number per edge and one velocity along the tangents, and they are numbers without rounding:
//!
//! ```text
//!     open         f = 0 ,               y_t′ = y_t
//!     inside       f of all edges ,      y_t′ = 0
//!     edge j       f_j alone ,           y_t′ = y_t ,    where j dissipates most:  −D_j·y_t′ = σ
//!     side j, k    f_j and f_k ,         y_t′ = −c ν ,   ν ⟂ D_k − D_j ,  c ≥ 0
//!     y_n′ = 0  or, open, max(y_n, 0) ,  of the associated law  y_n′ = μ σ(y′)  or, open, max(y_n, μ σ(y′))
//! ```
//! D_j, μ and R are the numbers that they are stored as. Of the faces beside (r, y) that one counts whose pair is nearest to them, by
//! (r′ − r)² + ρ²(y′ − y)², among those that obey the law, which is decided in fractions for each, without regard to how it was made:
//!
//! ```text
//!     Stewart–Trinkle    f ≥ 0 ,  y_n′ ≥ 0 ,  (Σ f_j) y_n′ = 0 ,  μ f_j (D_j·y_t′ + σ) = 0        λ = Σ f_j ,  β_j = μ f_j
//!     associated         f ≥ 0 ,  w_j = y_n′ + μ D_j·y_t′ + R_j f_j ≥ 0 ,  f_j w_j = 0
//! ```
//! Where edges are soft, f_j = (−e_j·y′)⁺/R_j follows from y′, which is the decomposition's, rounded.

use super::planted::{Plant, planted};
use crate::cones::polyhedral::{along_edges, direction, edge, most_dissipative, neighbours};
use moreau_exact::scalar::{Rational, Scalar, exact};
use nalgebra::{Matrix3, Vector3};

/// The directions D_j of a law, as the numbers that they are stored as.
pub(super) struct Polygon {
    directions: Vec<[Rational; 2]>,
}

impl Polygon {
    /// d directions.
    pub fn new(directions: usize) -> Self {
        Polygon { directions: (0..directions).map(|j| direction(j, directions).map(exact)).collect() }
    }

    /// max_j (−D_j·y_t)⁺.
    fn slip(&self, tangential: &[Rational; 2]) -> Rational {
        (0..self.directions.len()).map(|j| -self.along(j, tangential)).fold(Rational::ZERO, |most, x| if x > most { x } else { most })
    }

    fn along(&self, j: usize, [first, second]: &[Rational; 2]) -> Rational {
        &self.directions[j][0] * first + &self.directions[j][1] * second
    }
}

/// A contact under a polyhedral law.
pub(super) struct Faceted<'a> {
    pub polygon: &'a Polygon,
    /// Whether its law is the associated one.
    pub associated: bool,
    /// μ.
    pub friction: f64,
    /// ρ \[kg\].
    pub rho: f64,
    /// R of every edge \[1/kg\], where a compliance acts on edges and this contact has some.
    pub softness: Option<&'a [f64]>,
}

/// Impulses along the edges and a velocity for which the law holds.
pub(super) struct Pair {
    /// f \[N·s\], one per edge.
    parts: Vec<Rational>,
    /// y′ \[m/s\].
    pub velocity: Vec<Rational>,
}

impl Faceted<'_> {
    /// A pair near r and y; none where a hard edge stands beside soft ones.
    pub fn near(&self, r: &[f64], y: &[f64]) -> Option<Pair> {
        let proposed = match self.softness {
            Some(softness) => vec![self.softened(softness, r, y)?],
            None => self.on_faces(r, y),
        };
        let obeying = proposed.into_iter().filter(|pair| planted(Plant::Law) || self.obeys(pair));
        let measured = obeying.map(|pair| (self.distance(&pair, r, y), pair));
        measured.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, pair)| pair)
    }

    /// r′ = Σ f_j (n + μ D_j) \[N·s\].
    pub fn impulse(&self, pair: &Pair) -> Vec<Rational> {
        let mut sums = [Rational::ZERO, Rational::ZERO, Rational::ZERO];
        for (part, [first, second]) in pair.parts.iter().zip(&self.polygon.directions).filter(|(part, _)| !part.is_zero()) {
            sums[0] += part;
            sums[1] += part * first;
            sums[2] += part * second;
        }
        let mu = exact(self.friction);
        let scaled = |(i, sum): (usize, Rational)| if i == 0 { sum } else { &mu * sum };
        sums.into_iter().enumerate().map(scaled).take(pair.velocity.len()).collect()
    }

    /// The pairs of the faces beside r and y.
    fn on_faces(&self, r: &[f64], y: &[f64]) -> Vec<Pair> {
        let (d, slip) = (self.polygon.directions.len(), tangent(y));
        let mut made = vec![self.open(y)];
        if r[0] <= 0.0 {
            return made;
        }
        let only = |j: usize| (0..d).map(|i| if i == j { r[0] } else { 0.0 }).collect::<Vec<_>>();
        if self.friction == 0.0 {
            made.extend(self.pressing(&only(0), slip.map(exact), y.len()));
            return made;
        }
        made.extend(self.pressing(&self.inside(r), [Rational::ZERO, Rational::ZERO], y.len()));
        let pushed: [f64; 2] = std::array::from_fn(|i| tangent(r)[i] - self.rho * slip[i]);
        let most = most_dissipative(slip, d);
        // two directions are all there are in the plane, and have no side between them
        let sector = if d > 2 { neighbours(pushed, d).0 } else { 0 };
        for j in [most, sector, (sector + 1) % d] {
            made.extend(self.pressing(&only(j), slip.map(exact), y.len()));
        }
        for j in [sector, most, (most + d - 1) % d].into_iter().filter(|_| d > 2) {
            let (parts, velocity) = self.on_side(j, r[0], pushed, slip);
            made.extend(self.pressing(&parts, velocity, y.len()));
        }
        made
    }

    /// No impulse, and y lifted into what the law allows.
    fn open(&self, y: &[f64]) -> Pair {
        let tangential = tangent(y).map(exact);
        let (normal, least) = (exact(y[0]), self.lift(&tangential));
        let parts = vec![Rational::ZERO; self.polygon.directions.len()];
        Pair { parts, velocity: velocity(if normal > least { normal } else { least }, tangential, y.len()) }
    }

    /// Impulses along the edges at this velocity of the tangents; none where one is no number.
    fn pressing(&self, parts: &[f64], tangential: [Rational; 2], rows: usize) -> Option<Pair> {
        let parts: Vec<Rational> = parts.iter().map(|part| part.is_finite().then(|| exact(*part))).collect::<Option<_>>()?;
        Some(Pair { parts, velocity: velocity(self.lift(&tangential), tangential, rows) })
    }

    /// The least y_n′ of a velocity: μ σ under the associated law, 0 under the other.
    fn lift(&self, tangential: &[Rational; 2]) -> Rational {
        if self.associated { exact(self.friction) * self.polygon.slip(tangential) } else { Rational::ZERO }
    }

    /// Impulses along all edges that add up to r, or to what is left of it inside of the cone.
    fn inside(&self, r: &[f64]) -> Vec<f64> {
        let mut parts = Vec::new();
        along_edges(r, self.friction, self.polygon.directions.len(), &mut parts);
        if parts.iter().any(|part| *part < 0.0) {
            parts.iter_mut().for_each(|part| *part = part.max(0.0));
            let shrunk = r[0] / parts.iter().sum::<f64>();
            parts.iter_mut().for_each(|part| *part *= shrunk);
        }
        parts
    }

    /// Impulses along edge j and the next one, nearest to p on the side between them, and the velocity across it.
    fn on_side(&self, j: usize, normal: f64, pushed: [f64; 2], slip: [f64; 2]) -> (Vec<f64>, [Rational; 2]) {
        let d = self.polygon.directions.len();
        let k = (j + 1) % d;
        let (one, other) = (direction(j, d), direction(k, d));
        let (bound, along) = (self.friction * normal, [one[0] - other[0], one[1] - other[1]]);
        let square = along[0] * along[0] + along[1] * along[1];
        let share = (0..2).map(|i| (pushed[i] / bound - other[i]) * along[i]).sum::<f64>() / square;
        let mut parts = vec![0.0; d];
        parts[j] = share.clamp(0.0, 1.0) * normal;
        parts[k] = normal - parts[j];
        let size = -((slip[0] * along[1] - slip[1] * along[0]).max(0.0) / square);
        let [from, to] = [&self.polygon.directions[j], &self.polygon.directions[k]];
        let across = [&to[1] - &from[1], &from[0] - &to[0]];
        (parts, if size.is_finite() { across.map(|part| part * exact(size)) } else { [Rational::ZERO, Rational::ZERO] })
    }

    /// y′ with r′ − ρ y′ = r − ρ y, rounded, and the impulses of soft edges at it.
    fn softened(&self, softness: &[f64], r: &[f64], y: &[f64]) -> Option<Pair> {
        if softness.contains(&0.0) {
            return None;
        }
        let (d, rows) = (softness.len(), y.len());
        let [impulse, given] = [r, y].map(|x| Vector3::from_fn(|i, _| x.get(i).copied().unwrap_or(0.0)));
        let edges: Vec<Vector3<f64>> = (0..d).map(|j| Vector3::from(edge(j, d, self.friction))).collect();
        let (mut found, mut before) = (given, Vec::new());
        for _ in 0..=d {
            let pressed: Vec<usize> = (0..d).filter(|j| edges[*j].dot(&found) < 0.0).collect();
            if pressed == before {
                break;
            }
            let start = Matrix3::identity() * self.rho;
            let matrix = pressed.iter().fold(start, |sum, j| sum + edges[*j] * edges[*j].transpose() / softness[*j]);
            let next = matrix.lu().solve(&(given * self.rho - impulse)).filter(|next| next.iter().all(|x| x.is_finite()));
            let Some(next) = next else { break };
            (found, before) = (next, pressed);
        }
        let tangential: [Rational; 2] = std::array::from_fn(|i| exact(if i + 1 < rows { found[i + 1] } else { 0.0 }));
        let (normal, mu) = (exact(found[0]), exact(self.friction));
        let part = |j: usize| {
            let along = &normal + &mu * self.polygon.along(j, &tangential);
            if along < Rational::ZERO { -along / exact(softness[j]) } else { Rational::ZERO }
        };
        Some(Pair { parts: (0..d).map(part).collect(), velocity: velocity(normal, tangential, rows) })
    }

    /// Whether the law holds, without rounding.
    fn obeys(&self, pair: &Pair) -> bool {
        let (mu, normal) = (exact(self.friction), &pair.velocity[0]);
        let tangential: [Rational; 2] = std::array::from_fn(|i| pair.velocity.get(i + 1).cloned().unwrap_or(Rational::ZERO));
        let pushes = pair.parts.iter().all(|part| *part >= Rational::ZERO);
        if self.associated {
            let soft = |j: usize| self.softness.map_or(Rational::ZERO, |softness| exact(softness[j]) * &pair.parts[j]);
            let edge = |j: usize| normal + &mu * self.polygon.along(j, &tangential) + soft(j);
            return pushes
                && pair.parts.iter().enumerate().all(|(j, part)| {
                    let velocity = edge(j);
                    velocity >= Rational::ZERO && (part.is_zero() || velocity.is_zero())
                });
        }
        let slip = self.polygon.slip(&tangential);
        let loaded = pair.parts.iter().any(|part| !part.is_zero());
        let dissipates = |j: usize| mu.is_zero() || (self.polygon.along(j, &tangential) + &slip).is_zero();
        let along = |(j, part): (usize, &Rational)| part.is_zero() || dissipates(j);
        pushes && *normal >= Rational::ZERO && (!loaded || normal.is_zero()) && pair.parts.iter().enumerate().all(along)
    }

    /// ‖r′ − r‖² + ρ²‖y′ − y‖² \[N²·s²\], rounded.
    fn distance(&self, pair: &Pair, r: &[f64], y: &[f64]) -> f64 {
        let square = |(found, given): (&Rational, &f64)| (Scalar::to_f64(found) - given).powi(2);
        let impulses: f64 = self.impulse(pair).iter().zip(r).map(square).sum();
        impulses + self.rho * self.rho * pair.velocity.iter().zip(y).map(square).sum::<f64>()
    }
}

fn tangent(z: &[f64]) -> [f64; 2] {
    std::array::from_fn(|i| z.get(i + 1).copied().unwrap_or(0.0))
}

fn velocity(normal: Rational, [first, second]: [Rational; 2], rows: usize) -> Vec<Rational> {
    [normal, first, second].into_iter().take(rows).collect()
}

#[cfg(test)]
#[path = "polyhedral_pair_tests.rs"]
mod tests;
