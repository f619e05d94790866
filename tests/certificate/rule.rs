//! The rule of the certificate in exact rationals: how far each contact of an answer is from its law, in units of its limit.
//!
//! Residuals are rationals up to the brackets of [`root`](crate::exact::root); limits are f64, because nothing cancels in them but the net
//! W r, which is a rational here.

use crate::exact::{Exact, nearest, norm, zero};
use moreau::problem::Law;
use moreau::scalar::{Rational, exact, ratio};

/// Residual over limit, from the smallest to the largest of the branches that rounding leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    pub least: f64,
    pub most: f64,
}

/// τ, whether rounding is forgiven at all, and the planted mistake of measuring sliding friction as sticking friction is.
#[derive(Clone, Copy)]
pub struct Limits {
    pub tolerance: f64,
    pub floors: bool,
    pub slip_widens: bool,
}

/// Nothing is forgiven: only an exact answer has ratio 0.
pub const NONE: Limits = Limits { tolerance: 0.0, floors: false, slip_widens: false };

/// The limits of `certify`.
pub const CERTIFY: Limits = Limits { tolerance: 1e-8, floors: true, slip_widens: false };

/// So small a tolerance that the floors decide.
pub const FLOORS: Limits = Limits { tolerance: 1e-15, ..CERTIFY };

/// Whether the velocities q of the data widen the limit of their own contact alone, and those of an associated law only by
/// q_n − μ‖q_t‖; otherwise they widen the limits of their whole group.
pub const OWN_DATA: bool = true;

/// An answer r with its W r.
pub struct Answer<'a> {
    pub impulse: &'a [Rational],
    pub net: &'a [Rational],
}

/// The numbers of one contact that the law reads.
#[derive(Clone)]
struct At {
    mu: Rational,
    normal: Rational,
    slip: Vec<Rational>,
    impulse: Rational,
    friction: Vec<Rational>,
    rho_t: Rational,
    /// γ (Σ|W||r| + |q|) in the normal row and over the tangential rows \[m/s\].
    floor_n: f64,
    floor_t: f64,
    rho_n: f64,
    /// 10³ ρ_t V \[N·s\].
    along: f64,
    scales: Scales,
    tolerance: f64,
    /// 8ε or 0.
    last_digits: f64,
    slip_widens: bool,
}

/// s_n, s_r, s_t of a contact or of a group \[N·s\].
#[derive(Clone, Copy, Default)]
struct Scales {
    normal: f64,
    carried: f64,
    tangential: f64,
    /// What the data of the contact itself add to s_n, s_r and s_t.
    data_n: f64,
    data_r: f64,
    data_t: f64,
}

fn quotient(value: f64, limit: f64) -> f64 {
    if value <= 0.0 { 0.0 } else { value / limit }
}

fn both(a: Ratio, b: Ratio) -> Ratio {
    Ratio { least: a.least.max(b.least), most: a.most.max(b.most) }
}

fn sure(ratio: f64) -> Ratio {
    Ratio { least: ratio, most: ratio }
}

/// A pair 0 ≤ a ⟂ b ≥ 0 of numbers with limits of their own.
fn pair((a, limit_a): (f64, f64), (b, limit_b): (f64, f64)) -> f64 {
    let negative = quotient(-a, limit_a).max(quotient(-b, limit_b));
    negative.max(quotient(a, limit_a).min(quotient(b, limit_b)))
}

/// Residual over limit of every contact, whether the contacts of which rounding does not tell are closed or open.
pub fn judge(problem: &Exact, groups: &[Vec<usize>], answer: &Answer, limits: Limits) -> Vec<Ratio> {
    let y = problem.law_velocity(answer.impulse, answer.net);
    let at: Vec<At> = (0..problem.contacts()).map(|k| at(problem, answer, &y, k, limits)).collect();
    let fastest = Fastest::new(problem, &y, &at);
    let [narrow, wide] = [false, true].map(|if_unsure| judge_limited(problem, groups, at.clone(), |k| fastest.of(k, if_unsure)));
    let either = |(a, b): (Ratio, Ratio)| Ratio { least: a.least.min(b.least), most: a.most.max(b.most) };
    narrow.into_iter().zip(wide).map(either).collect()
}

/// The same where no size is more than 10³ times what these velocities ask \[m/s\].
fn judge_limited(problem: &Exact, groups: &[Vec<usize>], mut at: Vec<At>, fastest: impl Fn(usize) -> f64) -> Vec<Ratio> {
    let own: Vec<Scales> = at.iter().map(|at| at.scales).collect();
    for (k, (at, group)) in at.iter_mut().zip(groups).enumerate() {
        let most = 1e3 * fastest(k);
        let (most_n, most_t) = (most * at.rho_n, most * nearest(&at.rho_t));
        let largest = |scale: fn(&Scales) -> f64| group.iter().map(|&j| scale(&own[j])).fold(0.0, f64::max);
        let along = if problem.rows > 1 { most_t } else { f64::INFINITY };
        at.along = along;
        at.scales = Scales {
            normal: largest(|s| s.normal).max(at.scales.data_n).min(most_n),
            carried: largest(|s| s.carried).max(at.scales.data_r).min(most_n).min(along),
            tangential: largest(|s| s.tangential).max(at.scales.data_t).min(most_t),
            ..at.scales
        };
    }
    at.iter()
        .enumerate()
        .map(|(k, at)| match problem.law {
            Law::Frictionless => both(at.normal_pair(false), sure(at.no_friction())),
            Law::Coulomb => both(at.normal_pair(false), at.disk()),
            Law::Associated => both(both(at.normal_pair(true), at.disk()), at.lift()),
            Law::PolyhedralCoulomb { directions } => both(at.normal_pair(false), at.stewart_trinkle(directions)),
            Law::PolyhedralAssociated { directions } => {
                let soft = problem.edge_soft.as_ref().map(|soft| &soft[k * directions..(k + 1) * directions]);
                sure(at.edges(directions, soft))
            }
            law => panic!("no rule is derived here for {law:?}"),
        })
        .collect()
}

/// What limits the sizes: the fastest velocity in the data of the island's closed contacts and of the contact itself; of all, if those have
/// none; of the impulses, if the data have none.
struct Fastest {
    islands: Vec<usize>,
    /// Of each contact the largest velocity in its data, and that of its impulses \[m/s\].
    given: Vec<f64>,
    moved: Vec<f64>,
    /// r_n − ρ_n w, and what rounding may hide of it \[N·s\].
    pressed: Vec<(f64, f64)>,
}

impl Fastest {
    fn new(problem: &Exact, y: &[Rational], at: &[At]) -> Self {
        let largest = |of: &dyn Fn(usize) -> Rational| {
            let rows = |k: usize| (k * problem.rows..(k + 1) * problem.rows).map(|i| nearest(&of(i)).abs());
            (0..problem.contacts()).map(|k| rows(k).fold(0.0, f64::max)).collect()
        };
        let pressed = |(k, at): (usize, &At)| {
            let w = towards(problem.law, &at.mu, &y[k * problem.rows..(k + 1) * problem.rows]);
            let rounding = 4.0 * at.rho_n * (at.floor_n + nearest(&at.mu) * at.floor_t);
            (nearest(&(&at.impulse - w * exact(at.rho_n))), rounding)
        };
        Fastest {
            islands: islands(problem),
            given: largest(&|i| &problem.free[i] + &problem.shift[i]),
            moved: largest(&|i| &y[i] - &problem.free[i] - &problem.shift[i]),
            pressed: at.iter().enumerate().map(pressed).collect(),
        }
    }

    fn of(&self, k: usize, if_unsure: bool) -> f64 {
        let island = || (0..self.islands.len()).filter(|j| self.islands[*j] == self.islands[k]);
        let is_closed = |j: &usize| {
            let (pressed, rounding) = self.pressed[*j];
            if pressed.abs() <= rounding { if_unsure } else { pressed > 0.0 }
        };
        let largest = |of: &[f64], among: &dyn Fn(&usize) -> bool| island().filter(among).map(|j| of[j]).fold(0.0, f64::max);
        let known = [largest(&self.given, &is_closed), largest(&self.given, &|_| true), largest(&self.moved, &|_| true)];
        known.into_iter().find(|velocity| *velocity > 0.0).unwrap_or(0.0).max(self.given[k])
    }
}

/// Of every contact the first of those that W joins with it.
fn islands(problem: &Exact) -> Vec<usize> {
    let (n, rows) = (problem.contacts(), problem.rows);
    let meet =
        |j: usize, k: usize| (0..rows * rows).any(|place| problem.delassus[(j * rows + place / rows, k * rows + place % rows)] != zero());
    let mut first: Vec<usize> = (0..n).collect();
    // as often as a name may have to travel
    for _ in 0..n {
        for (j, k) in (0..n).flat_map(|j| (0..n).map(move |k| (j, k))).filter(|(j, k)| meet(*j, *k)) {
            let least = first[j].min(first[k]);
            (first[j], first[k]) = (least, least);
        }
    }
    first
}

fn at(problem: &Exact, answer: &Answer, y: &[Rational], k: usize, limits: Limits) -> At {
    let (rows, size) = (problem.rows, y.len());
    let (n, t) = (k * rows, k * rows + 1..(k + 1) * rows);
    // what W does not join with this contact rounds nothing
    let moves = |j: usize| j == k || (0..rows * rows).any(|at| problem.delassus[(n + at / rows, j * rows + at % rows)] != zero());
    let terms = rows * (0..size / rows).filter(|j| moves(*j)).count();
    let operations = (2 * terms + 8) as f64 * f64::EPSILON;
    let gamma = if limits.floors { operations / (1.0 - operations) } else { 0.0 };
    let size_of = |x: &Rational| nearest(x).abs();
    let floor = |i: usize| {
        let products: f64 = (0..size).map(|j| size_of(&problem.delassus[(i, j)]) * size_of(&answer.impulse[j])).sum();
        gamma
            * (products + size_of(&problem.free[i]) + size_of(&problem.shift[i]) + size_of(&problem.soft[i]) * size_of(&answer.impulse[i]))
    };
    let trace = t.clone().fold(zero(), |sum, i| sum + &problem.delassus[(i, i)] + &problem.soft[i]);
    let rho_t = if rows == 1 { zero() } else { ratio(rows as i64 - 1, 1) / trace };
    let rho_n = 1.0 / nearest(&(&problem.delassus[(n, n)] + &problem.soft[n]));
    let data: Vec<Rational> = (n..n + rows).map(|i| &problem.free[i] + &problem.shift[i]).collect();
    let (r, net, mu) = (answer.impulse, answer.net, &problem.friction[k]);
    let length = |x: &[Rational]| x.iter().map(|x| nearest(x).powi(2)).sum::<f64>().sqrt();
    let [data_t, net_t] = [length(&data[1..]), length(&net[t.clone()])].map(|velocity| nearest(&rho_t) * velocity);
    // its evaluation rounds by 8ε of its terms
    let rounded = |slip: f64| 8.0 * f64::EPSILON * (size_of(&data[0]) + slip);
    let slip = length(&data[1..]);
    // μ times what this adds to s_r is never more than the rounding of the slip, nor than that of μ² times it
    let beside = rounded(if nearest(mu) > 1.0 { slip / nearest(mu) } else { nearest(mu) * slip });
    let subtracts = matches!(problem.law, Law::Associated | Law::PolyhedralAssociated { .. });
    let towards_it = size_of(&towards(problem.law, mu, &data)) + if subtracts { rounded(nearest(mu) * slip) } else { beside };
    let data_n = rho_n * if OWN_DATA { towards_it } else { size_of(&data[0]) };
    // slip makes no friction: the smaller of |q_n| and |q_n − μ‖q_t‖|
    let pressed = towards_it.min(size_of(&data[0]) + beside);
    let data_r = rho_n * if OWN_DATA { pressed } else { size_of(&data[0]) };
    let shared = |data: f64| if OWN_DATA { 0.0 } else { data };
    let scales = Scales {
        normal: size_of(&r[n]).max(rho_n * size_of(&net[n])).max(shared(data_n)),
        carried: size_of(&r[n]),
        tangential: length(&r[n..n + rows]).max(net_t).max(shared(data_t)),
        data_n,
        data_r,
        data_t,
    };
    At {
        mu: mu.clone(),
        normal: y[n].clone(),
        slip: y[t.clone()].to_vec(),
        impulse: r[n].clone(),
        friction: r[t.clone()].to_vec(),
        floor_n: floor(n),
        floor_t: t.map(|i| floor(i).powi(2)).sum::<f64>().sqrt(),
        rho_t,
        rho_n,
        along: f64::INFINITY,
        scales,
        tolerance: limits.tolerance,
        last_digits: if limits.floors { 8.0 * f64::EPSILON } else { 0.0 },
        slip_widens: limits.slip_widens,
    }
}

/// q_n, or what an associated law complements: q_n − μ‖q_t‖, q_n + μ min D_j·q_t.
fn towards(law: Law, mu: &Rational, data: &[Rational]) -> Rational {
    match law {
        Law::Associated => &data[0] - mu * norm(&data[1..]),
        Law::PolyhedralAssociated { directions } => {
            let least = along(&data[1..], directions).into_iter().min().expect("directions");
            &data[0] + mu * least
        }
        _ => data[0].clone(),
    }
}

impl At {
    /// r_n against w = y_n, or w = y_n − μ‖y_t‖.
    fn normal_pair(&self, associated: bool) -> Ratio {
        let (mut w, mut floor) = (self.normal.clone(), self.floor_n);
        if associated {
            w -= &self.mu * norm(&self.slip);
            floor += nearest(&self.mu) * self.floor_t;
        }
        let impulse = self.tolerance * self.scales.normal;
        sure(pair((nearest(&self.impulse), impulse), (nearest(&w), floor.max(impulse / self.rho_n))))
    }

    /// ‖r_t − P_a(z)‖, z = r_t − ρ_t y_t, onto the disk of radius a = μ r_n.
    fn disk(&self) -> Ratio {
        if self.slip.is_empty() {
            return sure(0.0);
        }
        let radius = (&self.mu * &self.impulse).max(zero());
        let z: Vec<Rational> = self.friction.iter().zip(&self.slip).map(|(r, y)| r - &self.rho_t * y).collect();
        let length = norm(&z);
        let scale = if length <= radius { ratio(1, 1) } else { &radius / &length };
        let off: Vec<Rational> = self.friction.iter().zip(&z).map(|(r, z)| r - z * &scale).collect();
        let value = off.iter().map(|x| nearest(x).powi(2)).sum::<f64>().sqrt();
        let (floor, a, z) = (nearest(&self.rho_t) * self.floor_t, nearest(&radius), nearest(&length));
        let sticks = quotient(value, floor.max(self.tolerance * self.scales.tangential));
        let turned = if z > 0.0 { floor * (2.0 * a / z).min(1.0) } else { floor };
        let slides = quotient(value, (turned + self.last_digits * a).max(self.friction_limit()));
        let slides = if self.slip_widens { sticks } else { slides };
        // no change of the data brings an impulse back into its cone, so that it is held against μ s_r even where the contact sticks
        let outside = nearest(&(norm(&self.friction) - &radius)) / nearest(&self.mu).hypot(1.0);
        let cone = sure(quotient(outside, self.friction_limit().max(self.last_digits * a)));
        both(cone, open_branch(sticks, slides, nearest(&(radius - length)), 4.0 * (floor + self.last_digits * a)))
    }

    /// Where friction sticks, y_n is a normal velocity like others, not μ times a slip: it is within their limit, or ‖r_t‖ is that of
    /// sliding friction, or there is no impulse.
    fn lift(&self) -> Ratio {
        if self.slip.is_empty() || self.mu == zero() {
            return sure(0.0);
        }
        let radius = (&self.mu * &self.impulse).max(zero());
        let z: Vec<Rational> = self.friction.iter().zip(&self.slip).map(|(r, y)| r - &self.rho_t * y).collect();
        let excess = nearest(&(&radius - norm(&z)));
        let rho_t = nearest(&self.rho_t);
        let lifted = quotient(nearest(&self.normal), (self.tolerance * self.scales.normal / self.rho_n).max(self.floor_n));
        let pushed = norm(&self.friction);
        let edge = quotient(nearest(&(&radius - &pushed)), self.friction_limit().max(self.last_digits * nearest(&radius)));
        let whole = norm(&[self.impulse.clone(), pushed]);
        let value = lifted.min(edge).min(quotient(nearest(&whole), self.tolerance * self.scales.normal));
        open_branch(value, 0.0, excess, 4.0 * (rho_t * self.floor_t + self.last_digits * nearest(&radius)))
    }

    /// τ μ s_r, or τ s_r where no friction is allowed at all.
    fn friction_limit(&self) -> f64 {
        let mu = nearest(&self.mu);
        self.tolerance * self.scales.carried * if mu > 0.0 { mu } else { 1.0 }
    }

    /// r_t = 0.
    fn no_friction(&self) -> f64 {
        quotient(nearest(&norm(&self.friction)), self.tolerance * self.scales.carried)
    }

    /// The pairs (β_j, D_j·y_t + σ) and (μ r_n − Σβ, σ).
    fn stewart_trinkle(&self, d: usize) -> Ratio {
        let against = along(&self.slip, d);
        let sigma = against.iter().fold(zero(), |slip, v| slip.max(-v));
        let beta = beside(&self.friction, d);
        let left = beta.iter().fold(&self.mu * &self.impulse, |left, b| left - b);
        let floor = nearest(&self.rho_t) * self.floor_t;
        let carried = self.friction_limit();
        let rho = nearest(&self.rho_t);
        let with = |velocity_scale: f64| {
            let limit = (velocity_scale / rho).max(self.floor_t);
            let cone = pair((nearest(&left), carried), (nearest(&sigma), limit));
            beta.iter().zip(&against).fold(cone, |worst, (b, v)| {
                let w = nearest(&(v + &sigma));
                worst.max(pair((nearest(b), carried), (w, limit)))
            })
        };
        let margin = 4.0 * (floor + self.last_digits * nearest(&self.mu) * self.scales.carried);
        let excess = nearest(&(left.clone() - &self.rho_t * &sigma));
        let sticks = with(self.tolerance * self.scales.tangential);
        open_branch(sticks, if self.slip_widens { sticks } else { with(carried) }, excess, margin)
    }

    /// The pairs (f_j, y_n + μ D_j·y_t + R_j f_j).
    fn edges(&self, d: usize, soft: Option<&[Rational]>) -> f64 {
        let f = self.recovered_edges(d);
        let scale = self.scales.carried.max(self.scales.normal);
        let floor = self.floor_n + nearest(&self.mu) * self.floor_t;
        let velocity = floor.max(self.tolerance * scale / self.rho_n);
        let mu = nearest(&self.mu);
        let impulse = self.tolerance * scale.min(if mu > 0.0 { self.along / mu } else { f64::INFINITY });
        let pairs = along(&self.slip, d).into_iter().enumerate().map(|(j, v)| {
            let w = &self.normal + &self.mu * v + soft.map_or_else(zero, |soft| &soft[j] * &f[j]);
            pair((nearest(&f[j]), impulse), (nearest(&w), velocity))
        });
        // without friction the edges are all the normal, and give no r_t
        pairs.fold(if self.mu == zero() { self.no_friction() } else { 0.0 }, f64::max)
    }

    /// r_t/μ along the directions beside it, the rest of r_n spread evenly.
    fn recovered_edges(&self, d: usize) -> Vec<Rational> {
        let scaled: Vec<Rational> = self.friction.iter().map(|r| if self.mu == zero() { zero() } else { r / &self.mu }).collect();
        let mut f = beside(&scaled, d);
        let rest = f.iter().fold(self.impulse.clone(), |rest, f| rest - f) / ratio(d as i64, 1);
        f.iter_mut().for_each(|f| *f += &rest);
        f
    }
}

/// The branch that the sign of `excess` takes, or both where it is within `margin` of 0.
fn open_branch(sticks: f64, slides: f64, excess: f64, margin: f64) -> Ratio {
    if excess.abs() <= margin {
        Ratio { least: sticks.min(slides), most: sticks.max(slides) }
    } else {
        sure(if excess >= 0.0 { sticks } else { slides })
    }
}

/// D_j·x for the quarter turns (d = 4), or for ±1 in the plane (d = 2).
fn along(x: &[Rational], d: usize) -> Vec<Rational> {
    (0..d).map(|j| if 2 * j < d { x[j].clone() } else { -&x[j - d / 2] }).collect()
}

/// β ≥ 0 with Σ D_jβ_j = x and the smallest sum.
fn beside(x: &[Rational], d: usize) -> Vec<Rational> {
    along(x, d).into_iter().map(|part| part.max(zero())).collect()
}
