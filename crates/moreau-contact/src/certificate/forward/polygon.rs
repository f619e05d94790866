//! A polyhedral law at one contact in space as equations, once it is known on which edge or side of its cone the impulse is.
//!
//! ```text
//!     K = cone{ n + μ D_j } ,     e = D_{j+1} − D_j ,     ν = (e₂, −e₁) ,    away from the other directions
//!
//!     edge j    r_t = μ r_n D_j ,                        v = 0      holds where  r_n ≥ 0 ,  (D_i − D_j)·y_t ≥ 0 ,  −D_j·y_t ≥ 0
//!     side j    ν·(r_t − μ r_n D_j) = 0 ,   e·y_t = 0 ,  v = 0      r_n ≥ 0 ,  r_t between its ends ,  −ν·y_t ≥ 0
//!     inside    y = 0                                               r_n ≥ 0 ,  ν·(r_t − μ r_n D_j) ≤ 0  on every side
//!     open      r = 0                                               y_n ≥ 0 ,    associated:  y_n + μ D_j·y_t ≥ 0
//! ```
//! with v = y_n under Coulomb's law and v = y_n + μ D_j·y_t, the velocity along the edge, under the associated one. D_j and μ are the
//! numbers that they are stored as. On a side y_t = −c ν with c ≥ 0, and both its ends dissipate most if ν·(D_j − D_i) ≥ 0 for every i,
//! which is looked at as well. All equations are linear.

use super::case::{Case, Equations, Linear};
use crate::certificate::interval::Interval;
use crate::certificate::planted::{Plant, planted};
use crate::cones::polyhedral::{direction, neighbours};

/// The friction of a contact in space with three directions or more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    pub directions: usize,
    /// μ, not zero.
    pub friction: f64,
    pub associated: bool,
}

type Plane = [Interval; 2];

fn dot(a: Plane, b: Plane) -> Interval {
    a[0] * b[0] + a[1] * b[1]
}

impl Polygon {
    /// D_j.
    fn direction(&self, j: usize) -> Plane {
        direction(j % self.directions, self.directions).map(Interval::point)
    }

    /// e and ν of side j.
    fn side(&self, j: usize) -> [Plane; 2] {
        let along = self.between(j + 1, j);
        [along, [along[1], -along[0]]]
    }

    /// D_i − D_j.
    fn between(&self, i: usize, j: usize) -> Plane {
        let [to, from] = [self.direction(i), self.direction(j)];
        [to[0] - from[0], to[1] - from[1]]
    }

    /// σ(y) = max_j (−D_j·y_t)⁺ of rounded numbers.
    pub fn slip(&self, y: [f64; 2]) -> f64 {
        let against = |j: usize| direction(j, self.directions).iter().zip(y).map(|(d, y)| -d * y).sum::<f64>();
        (0..self.directions).map(against).fold(0.0, f64::max)
    }

    /// Where the point of R·S nearest to p is: on a side or at an end of one; none inside.
    pub fn nearest(&self, radius: f64, p: [f64; 2]) -> Option<Case> {
        let j = neighbours(p, self.directions).0;
        let [from, to] = [j, (j + 1) % self.directions].map(|i| direction(i, self.directions).map(|d| radius * d));
        let (along, away) = ([to[0] - from[0], to[1] - from[1]], [p[0] - from[0], p[1] - from[1]]);
        if along[1] * away[0] - along[0] * away[1] <= 0.0 {
            return None;
        }
        let (part, whole) = (along[0] * away[0] + along[1] * away[1], along[0] * along[0] + along[1] * along[1]);
        Some(if part <= 0.0 {
            Case::Edge(j)
        } else if part >= whole {
            Case::Edge((j + 1) % self.directions)
        } else {
            Case::Side(j)
        })
    }

    /// The equations of an edge or a side.
    pub fn write(&self, case: Case, r: &[Interval], y: &[Interval], made: &mut Equations) {
        let (Case::Edge(j) | Case::Side(j)) = case else { return };
        let (mu, own) = (Interval::point(self.friction), self.direction(j));
        let tangent = |of: &[Interval]| [of[1], of[2]];
        (made.value[0], made.by_velocity[0][0]) = (y[0], Interval::ONE);
        if self.associated {
            made.value[0] = y[0] + mu * dot(own, tangent(y));
            (0..2).for_each(|i| made.by_velocity[0][1 + i] = mu * own[i]);
        }
        let beside: Plane = std::array::from_fn(|i| r[1 + i] - mu * r[0] * own[i]);
        if let Case::Side(_) = case {
            let [along, outward] = self.side(j);
            (made.value[1], made.value[2]) = (dot(along, tangent(y)), dot(outward, beside));
            made.by_impulse[2][0] = -(mu * dot(outward, own));
            made.by_velocity[1][1..].copy_from_slice(&along);
            made.by_impulse[2][1..].copy_from_slice(&outward);
            return;
        }
        for i in 0..2 {
            made.value[1 + i] = beside[i];
            made.by_impulse[1 + i][0] = -(mu * own[i]);
            made.by_impulse[1 + i][1 + i] = Interval::ONE;
        }
    }

    /// The equations v = 0 and, on a side, e·y_t = 0. Where the latter follows from others the longer component of e keeps its impulse.
    pub fn linear(&self, case: Case) -> Vec<Linear> {
        let (Case::Edge(j) | Case::Side(j)) = case else { return Vec::new() };
        let at = |j: usize| direction(j % self.directions, self.directions);
        let mut lift = Linear::row(0);
        if self.associated {
            (0..2).for_each(|i| lift.terms.push(([self.friction, at(j)[i]], 1 + i)));
        }
        let Case::Side(_) = case else { return vec![lift] };
        let way = if planted(Plant::Way) { 1.0 } else { -1.0 };
        let along = |i: usize| [([at(j + 1)[i], 1.0], 1 + i), ([way, at(j)[i]], 1 + i)];
        let size = |i: usize| (at(j + 1)[i] - at(j)[i]).abs();
        let given = if size(0) >= size(1) { 1 } else { 2 };
        vec![lift, Linear { terms: [along(0), along(1)].concat(), equation: 1, given }]
    }

    /// Whether no velocity in y of an open contact closes it or moves it along an edge that gives way.
    pub fn opens(&self, y: &[Interval]) -> bool {
        let leaves = |j: usize| y[0] + Interval::point(self.friction) * dot(self.direction(j), [y[1], y[2]]);
        if self.associated { (0..self.directions).all(|j| leaves(j).low >= 0.0) } else { y[0].low >= 0.0 }
    }

    /// Whether every impulse in r is in the cone.
    pub fn holds_inside(&self, r: &[Interval]) -> bool {
        r[0].low >= 0.0 && (0..self.directions).all(|j| self.beyond(j, r).high <= 0.0)
    }

    /// ν·(r_t − μ r_n D_j) of side j.
    fn beyond(&self, j: usize, r: &[Interval]) -> Interval {
        let (outward, own) = (self.side(j)[1], self.direction(j));
        dot(outward, [r[1], r[2]]) - Interval::point(self.friction) * r[0] * dot(outward, own)
    }

    /// Whether the inequalities of an edge or a side hold for all impulses in r and velocities in y that solve its equations.
    pub fn holds(&self, case: Case, r: &[Interval], y: &[Interval]) -> bool {
        let (tangential, pushes, all) = ([y[1], y[2]], r[0].low >= 0.0, 0..self.directions);
        match case {
            Case::Edge(j) => {
                let least = all.filter(|i| *i != j).all(|i| dot(self.between(i, j), tangential).low >= 0.0);
                pushes && least && (self.associated || dot(self.direction(j), tangential).high <= 0.0)
            }
            Case::Side(j) => {
                let ([along, outward], mu) = (self.side(j), Interval::point(self.friction));
                let ends = [0, 1].map(|end| dot(along, [r[1], r[2]]) - mu * r[0] * dot(along, self.direction(j + end)));
                let other = |i: &usize| *i != j && *i != (j + 1) % self.directions;
                let is_side = all.filter(other).all(|i| dot(outward, self.between(i, j)).high <= 0.0);
                pushes && is_side && ends[0].low >= 0.0 && ends[1].high <= 0.0 && dot(outward, tangential).high <= 0.0
            }
            Case::Is(_) | Case::Forth(_) => false,
        }
    }
}
