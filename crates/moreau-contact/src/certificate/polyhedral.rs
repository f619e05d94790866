//! Polyhedral laws as complementary pairs 0 ≤ z ⟂ w ≥ 0 per contact.
//!
//! Stewart–Trinkle, λ = r_n, r_t = Σ Dⱼβⱼ:
//! ```text
//!     0 ≤ λ ⟂ y_n ≥ 0 ,    0 ≤ βⱼ ⟂ Dⱼ·y_t + σ ≥ 0 ,    0 ≤ μλ − Σβⱼ ⟂ σ ≥ 0 .
//! ```
//! Polyhedral associated, r = Σ fⱼ (n + μDⱼ): `0 ≤ fⱼ ⟂ y_n + μ Dⱼ·y_t + Rⱼ fⱼ ≥ 0`.
//!
//! The scale of a pair's impulse is an impulse. The scale of its velocity is a velocity, with its rounding. Fast sliding makes σ large, but
//! it excuses no impulse along another direction.
//!
//! Where a solution does not give β, f or σ they are recovered. σ = max_j(−Dⱼ·y_t)₊ is the smallest that makes every Dⱼ·y_t + σ ≥ 0. β is
//! the decomposition of r_t along the two directions beside it, the one with the smallest Σβⱼ: when σ > 0 only the
//! directions with Dⱼ·y_t + σ = 0 may carry β, and r_t on the boundary of the polygon has no other decomposition; when σ = 0 and
//! r_t is inside, y_t = 0 and every decomposition does.

use super::at_contact::{AtContact, Here, in_space, worst};
use super::part::{Part, pair};
use crate::cones::polyhedral::{along_edges, along_neighbours, direction};
use crate::cones::second_order::length;
use crate::problem::{Compliance, ContactProblem, Coordinates, Solution};
use moreau_exact::{Error, Result};

/// One complementary pair; z is an impulse \[N·s\] and w a velocity \[m/s\].
#[derive(Clone, Copy, Debug)]
struct Pair {
    z: f64,
    w: f64,
}

/// The pairs of one contact, and how far its impulse is from what its parts add up to: [of the normal, of the tangents], and the
/// difference itself \[N·s\].
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs {
    pairs: Vec<Pair>,
    parts: Vec<f64>,
    mismatch: [f64; 2],
    rest: [f64; 3],
}

/// The residuals of Stewart–Trinkle's law at one contact.
pub(super) fn stewart_trinkle(pairs: &mut Pairs, solution: &Solution, d: usize, here: &Here) -> AtContact {
    stewart_trinkle_beside(pairs, solution, d, here, false)
}

/// The same, where `is_judged` says that r and y are judged already by the cone that these pairs make in the plane: what β and σ say
/// beside them is held against s_t where the contact slides, too, for at the edge of the cone the two may take it for different states.
pub(super) fn stewart_trinkle_beside(pairs: &mut Pairs, solution: &Solution, d: usize, here: &Here, is_judged: bool) -> AtContact {
    pairs.fill_stewart_trinkle(solution, d, here);
    let (Pair { z: left, w: sigma }, [rho_n, rho_t], [s_n, s_r, s_t]) = (pairs.pairs[d + 1], here.weights, here.sizes);
    let friction = here.friction_scale(here.friction);
    let sticks = is_judged || left >= rho_t * sigma;
    let mut at = AtContact::default();
    let normal = Members { impulse: here.impulse[0].max(here.impulse[1]), velocity: s_n / rho_n, floor: here.floors[0], rho: rho_n };
    at.normal = normal.judge(pairs.pairs[0], |_| here.reach(|| in_space(here.r), true), &mut at);
    // an impulse that moves nothing excuses no slip, however large it is; one that moves its contact is limited by what it moves
    let excused = if here.most == [f64::INFINITY; 2] { friction.min(s_t) } else { friction };
    let velocity = if sticks { s_t } else { excused } / rho_t;
    let tangential = Members { impulse: friction, velocity, floor: here.floors[1], rho: rho_t };
    for (j, one) in pairs.pairs[1..].iter().enumerate() {
        let along = |z: f64| {
            let [first, second] = if j < d { direction(j, d) } else { rubbed(here) };
            [0.0, z * first, z * second]
        };
        let part = tangential.judge(*one, |z| here.reach(|| along(z), false), &mut at);
        at.tangential = at.tangential.worse(part);
    }
    let parts =
        Part { value: pairs.mismatch[1], scale: if sticks { s_t } else { friction }, floor: rounding_of_parts(d, s_r * here.friction) };
    at.tangential = at.tangential.worse(parts).worse(pairs.missing(here));
    at.primal = at.primal.worse(parts);
    at
}

/// The residuals of the polyhedral associated law at one contact.
///
/// # Errors
/// [`Error::Invalid`] if an edge compliance judges edge impulses that the solution does not give.
pub(super) fn edges(pairs: &mut Pairs, problem: &ContactProblem, solution: &Solution, d: usize, here: &Here) -> Result<AtContact> {
    pairs.fill_edges(problem, solution, d, here)?;
    let ([rho, _], [s_n, ..]) = (here.weights, here.sizes);
    // an impulse that does not move its own contact excuses no velocity there, however large it is
    let scale = here.impulse[0].max(here.impulse[1]);
    let floor = here.floors[0] + here.friction * here.floors[1];
    // an edge's impulse moves the contact along the tangents, too, by its part μ
    let along = if here.friction > 0.0 { here.most[1] / here.friction } else { f64::INFINITY };
    let members = Members { impulse: scale.min(here.most[0]).min(along), velocity: s_n / rho, floor, rho };
    let mut at = AtContact::default();
    for (j, one) in pairs.pairs.iter().enumerate() {
        let along = |z: f64| {
            let [first, second] = direction(j, d).map(|part| here.friction * part);
            [z, z * first, z * second]
        };
        let part = members.judge(*one, |z| here.reach(|| along(z), true), &mut at);
        at.normal = at.normal.worse(part);
    }
    let parts = |value: f64, scale: f64| Part { value, scale, floor: rounding_of_parts(d, scale) };
    let tangential = here.friction_scale(here.friction);
    at.primal = at.primal.worse(parts(pairs.mismatch[0], s_n)).worse(parts(pairs.mismatch[1], tangential));
    at.normal = at.normal.worse(parts(pairs.mismatch[0], s_n));
    at.tangential = parts(pairs.mismatch[1], tangential).worse(pairs.missing(here));
    Ok(at)
}

/// The unit vector of the friction at a contact, or against its slip where there is none.
fn rubbed(here: &Here) -> [f64; 2] {
    let ([first, second], [along, across]) = (tangent(here.r), tangent(here.y));
    let [size, slip] = [length(first, second), length(along, across)];
    match (size > 0.0, slip > 0.0) {
        (true, _) => [first / size, second / size],
        (false, true) => [-along / slip, -across / slip],
        _ => [0.0; 2],
    }
}

/// The rounding of a sum of d parts of at most `size`.
fn rounding_of_parts(d: usize, size: f64) -> f64 {
    moreau_exact::tolerance::rounding(d + 4, size)
}

/// The scales of the two members of a pair.
struct Members {
    /// Scale of the impulse \[N·s\].
    impulse: f64,
    /// Scale of the velocity \[m/s\].
    velocity: f64,
    /// Rounding of the velocity \[m/s\].
    floor: f64,
    /// ρ \[kg\].
    rho: f64,
}

impl Members {
    /// The pair's natural map; its negative members and its product join what `at` holds. `reach` tells how far z reaches where it counts
    /// as none.
    fn judge(&self, Pair { z, w }: Pair, reach: impl FnOnce(f64) -> Part, at: &mut AtContact) -> Part {
        let velocity = Part { value: w.abs(), scale: self.velocity, floor: self.floor };
        let impulse = Part { value: z.abs(), scale: self.impulse, floor: 0.0 };
        let negative = |x: f64, part: Part| if x >= 0.0 { Part { value: 0.0, ..part } } else { part };
        at.primal = at.primal.worse(negative(z, impulse));
        at.dual = at.dual.worse(negative(w, velocity));
        let size = (self.impulse * w.abs()).max(self.impulse.max(z.abs()) * self.velocity);
        let product = Part { value: (z * w).abs(), scale: size, floor: z.abs() * self.floor };
        at.complementarity = at.complementarity.worse(product);
        let velocity = velocity.times(self.rho);
        let counts_as_none = z < 0.0 || (w > self.floor && velocity.exceeds(&impulse));
        pair([z, w], if counts_as_none { impulse.worse(reach(z)) } else { impulse }, velocity)
    }
}

impl Pairs {
    /// λ with y_n, each βⱼ with Dⱼ·y_t + σ, and what friction is left with σ.
    pub(super) fn fill_stewart_trinkle(&mut self, solution: &Solution, d: usize, here: &Here) {
        let Here { contact, r, y, .. } = *here;
        self.parts.clear();
        match &solution.beta {
            Some(beta) => self.parts.extend_from_slice(&beta.as_slice()[contact * d..(contact + 1) * d]),
            None => along_neighbours(tangent(r), d, &mut self.parts),
        }
        let against = |j: usize| dot(direction(j, d), tangent(y));
        let slip = || (0..d).fold(0.0, |slip, j| worst(slip, -against(j)));
        let sigma = solution.sigma.as_ref().map_or_else(slip, |sigma| sigma[contact]);
        let left = here.friction * r[0] - self.parts.iter().sum::<f64>();
        self.pairs.clear();
        self.pairs.push(Pair { z: r[0], w: y[0] });
        self.pairs.extend(self.parts.iter().enumerate().map(|(j, &z)| Pair { z, w: against(j) + sigma }));
        self.pairs.push(Pair { z: left, w: sigma });
        self.set_rest([0.0, 0.0], tangent(r), 1.0);
    }

    /// Each edge impulse fⱼ with y_n + μ Dⱼ·y_t + Rⱼ fⱼ.
    ///
    /// # Errors
    /// [`Error::Invalid`] if an edge compliance judges edge impulses that the solution does not give.
    pub(super) fn fill_edges(&mut self, problem: &ContactProblem, solution: &Solution, d: usize, here: &Here) -> Result<()> {
        let Here { contact, friction: mu, r, y, .. } = *here;
        let softness = match problem.compliance() {
            Some(Compliance { coordinates: Coordinates::Edge, diagonal }) => Some(&diagonal.as_slice()[contact * d..(contact + 1) * d]),
            _ => None,
        };
        self.parts.clear();
        match &solution.beta {
            Some(beta) => self.parts.extend_from_slice(&beta.as_slice()[contact * d..(contact + 1) * d]),
            None if softness.is_some() && d > 2 => {
                let cure = "an edge compliance judges the edge impulses, and they do not follow from `impulse`";
                return Err(Error::invalid("beta", "is missing", cure));
            }
            None => along_edges(r, mu, d, &mut self.parts),
        }
        let w = |j: usize, z: f64| y[0] + mu * dot(direction(j, d), tangent(y)) + softness.map_or(0.0, |softness| softness[j] * z);
        self.pairs.clear();
        self.pairs.extend(self.parts.iter().enumerate().map(|(j, &z)| Pair { z, w: w(j, z) }));
        self.set_rest([r[0], self.parts.iter().sum::<f64>()], tangent(r), mu);
        Ok(())
    }

    /// What the impulse has beside its parts: r_n − Σ f of the normal, r_t − scale Σ Dⱼβⱼ of the tangents.
    fn set_rest(&mut self, [normal, sum]: [f64; 2], tangent: [f64; 2], scale: f64) {
        let [first, second] = difference(tangent, &self.parts, scale);
        self.rest = [normal - sum, first, second];
        self.mismatch = [self.rest[0].abs(), length(first, second)];
    }

    /// How far that reaches, where it is more than rounding.
    fn missing(&self, here: &Here) -> Part {
        let d = self.parts.len();
        let rounded = rounding_of_parts(d, worst(here.r[0].abs(), length(tangent(here.r)[0], tangent(here.r)[1])));
        let is_told = worst(self.mismatch[0], self.mismatch[1]) > rounded;
        if is_told { here.reach(|| self.rest, false) } else { Part::default() }
    }

    /// ‖(min(z, ρw), mismatch)‖ over the pairs \[N·s\].
    pub(super) fn natural_map(&self, rho: f64) -> f64 {
        let pairs: f64 = self.pairs.iter().map(|one| smaller(one.z, rho * one.w).powi(2)).sum();
        (pairs + worst(self.mismatch[0], self.mismatch[1]).powi(2)).sqrt()
    }
}

/// z − (z − w)₊ = min(z, w), NaN if one is.
fn smaller(z: f64, w: f64) -> f64 {
    -worst(-z, -w)
}

/// r_t − scale Σ Dⱼβⱼ.
fn difference(r: [f64; 2], beta: &[f64], scale: f64) -> [f64; 2] {
    let d = beta.len();
    let sum = beta.iter().enumerate().fold([0.0, 0.0], |sum, (j, b)| {
        let [first, second] = direction(j, d);
        [sum[0] + first * b, sum[1] + second * b]
    });
    [r[0] - scale * sum[0], r[1] - scale * sum[1]]
}

fn tangent(z: &[f64]) -> [f64; 2] {
    [z.get(1).copied().unwrap_or(0.0), z.get(2).copied().unwrap_or(0.0)]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
