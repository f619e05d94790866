//! The scales of the residuals of a contact: impulses and velocities of its own pair of bodies, and the rounding of its own rows.
//!
//! ```text
//!     ρ_n = 1/(W_nn + R_nn) ,   ρ_t = tangential rows / tr(W_tt + R_tt)                                        [kg]
//!     s_n = max |r_n|, ρ_n |(W r)_n|  over the contacts of the same two bodies, and ρ_n |q_n| of its own         [N·s]
//!     s_r = max |r_n|  over them, and ρ_n |q_n| of its own                                                       [N·s]
//!     s_t = max ‖r‖, ρ_t ‖(W r)_t‖  over them, and ρ_t ‖q_t‖ of its own                                [N·s]
//!     floor = γ (Σ_j |W_kj||r_j| + |u_free| + |shift| + R_k|r_k|) ,   γ = mε/(1 − mε) ,   m = 2 terms + 8        [m/s]
//! ```
//! The terms of a contact are the rows of all that W joins with it, itself among them, however W is stored: zeros of W round nothing. Where
//! W acts through bodies and is not formed, the sum is |Yᵀ|D⁻¹|Y||r|, an upper bound of |W||r|, because that is where y is rounded.
//!
//! with q = u_free + shift and (W r) with R r in it, net: what cancels between the contacts of a body is no excuse for another body. Normal
//! and tangential parts stay apart, so that fast sliding does not widen what a normal impulse is held against: for the associated laws q_n
//! − μ‖q_t‖ stands in place of q_n, and a point that leaves fast excuses no other point of its body. In s_r the smaller of
//! |q_n| and |q_n − μ‖q_t‖| stands: slip makes no friction.
//!
//! None is more than 10³ ρ V, and s_r not more than that with either ρ. V is the largest velocity in q of the contacts of the island, over
//! joints, too, that are closed at the answer, r_n > ρ_n w, and of the contact itself: r·W r = −r·q − r·μ‖y_t‖n has the data of these
//! alone, so that a point that leaves moves nothing. Where all are open, or q of the closed ones is 0, it is that of all, and in W r, net,
//! where q = 0. Impulses that push against each other and move nothing would otherwise excuse any velocity, and a jaw that closes from both
//! sides, which has no solution, would have one. What impulses move is no V either: where W is not positive semidefinite they may grow
//! without end, each the excuse of the other. Nor is a floor more than 10⁻⁵ V: where rounding hides that, nothing is certain, and the
//! rounding itself counts as a residual of y, which may be zero only because q was lost in it; not what u_free and shift lose in each
//! other, for q is one sum. There y is computed with twice the digits, of which rounding hides ε|y| and γ² of the terms: its true
//! value is what is judged.
//!
//! An impulse that does not move its own contact, W_nn = 0 as in many complementarity problems, says nothing about the size of that
//! contact's velocity: |r_n| is left out of its s_n, and q_n out of its s_r. Growing along a ray such an impulse would excuse any velocity.
//! Nor does a velocity say anything about its size: r_n is held against the normal impulses of its pair and the rounding of the largest one
//! of the island.
//!
//! Which contacts lie between the same two bodies is told by [`groups`].
//!
//! `DIFFERENCE` One ρ = rows/tr(W_kk) for a whole contact would accept a normal velocity that is wrong by W_tt/W_nn times τ.

mod sharp;

use super::at_contact::worst;
use super::closing::closing;
use super::groups;
use super::joint_scales::Joints;
use super::part::Part;
use crate::cones::second_order::{length, tangential_norm};
use crate::memory::spare;
use crate::problem::{ContactProblem, Law, Weights};
use crate::tolerance::certificate::{HIDDEN, JAMMED, PROJECTED, row_rounding};

/// Entries of the largest block of a contact, of six rows.
const MOST_ENTRIES: usize = 36;

/// The weights and scales of a problem's contacts at an answer; its memory is used again for the next problem.
#[derive(Clone, Debug, Default)]
pub(super) struct Scales {
    contacts: Vec<Known>,
    /// Floor per row \[m/s\].
    pub floors: Vec<f64>,
    /// What a stored u may be off by where the floor is that of doubled precision: what rounding may hide \[m/s\]. Empty where none is.
    stored: Vec<f64>,
    /// γ (|u_free| + |shift| − |q|), the part of it that q = u_free + shift, one sum, does not round; none where shift is zero \[m/s\].
    unrounded: Vec<f64>,
    /// What a group shares of s_n, s_r, s_t, at its first contact \[N·s\].
    shared: Vec<[f64; 3]>,
    /// What the data of a contact add to its own s_n, s_r and s_t \[N·s\].
    own: Vec<[f64; 3]>,
    /// The largest velocity in the data of a contact \[m/s\].
    given: Vec<f64>,
    /// Of each island, at its first contact.
    largest: Vec<Largest>,
    /// Σ_j √W_jj |r_j| where W was made of mass and Jacobian, else nothing \[√J\].
    reach: f64,
    /// What the rows would do without the joints that hold them, and V of each contact; nothing where there are none \[m/s\].
    unheld: [Vec<f64>; 2],
}

/// What the problem says of a contact before there is an answer.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// ρ_n and ρ_t \[kg\].
    weights: [f64; 2],
    /// √W_nn and √tr W_tt or more, and the larger of the two \[kg^-½\].
    roots: [f64; 3],
    /// Whether a normal impulse moves its own contact, W_nn + R_nn > 0, and friction, tr(W_tt + R_tt) > 0.
    moves_itself: [bool; 2],
    /// By how much the rounding of y_t counts in that of w: max(1, μ) for the associated laws, whose w = y_n − μ‖y_t‖, else 1.
    lifts: f64,
    /// The first contact of the same island.
    island: usize,
    /// The first contact of the same two bodies: see [`groups`].
    group: usize,
}

/// What the numbers of one contact are held against.
pub(super) struct Held {
    /// ρ_n and ρ_t \[kg\].
    pub weights: [f64; 2],
    /// s_n, s_r and s_t \[N·s\].
    pub sizes: [f64; 3],
    /// The largest scale of an impulse that moves this contact along the normal, and along the tangents \[N·s\].
    pub most: [f64; 2],
    /// The scale of r_n itself, with its rounding \[N·s\]: s_n, or – where an impulse does not move its own contact – the normal impulses
    /// between the two bodies.
    pub impulse: [f64; 2],
    /// The floors of the normal row and of the tangential rows \[m/s\], limited to the part of the given velocities that rounding may hide.
    pub floors: [f64; 2],
    /// The rounding of y where it hides more of the given velocities than it may: as large a residual, for y tells nothing there.
    pub uncertain: Option<Part>,
}

/// The largest numbers of an island.
#[derive(Clone, Copy, Debug, Default)]
struct Largest {
    /// The largest velocity in the data \[m/s\].
    given: f64,
    /// The same of closed contacts \[m/s\].
    driven: f64,
    /// The same, or of the impulses, net \[m/s\].
    fastest: f64,
    /// Normal impulse \[N·s\].
    impulse: f64,
    /// How many contacts it has.
    contacts: usize,
}

impl Largest {
    /// V of the contacts together \[m/s\].
    fn velocity(&self) -> f64 {
        let known = [self.driven, self.given].into_iter().find(|velocity| *velocity > 0.0);
        known.unwrap_or(self.fastest)
    }
}

/// What the given velocities of contacts come from, where joints hold them \[m/s\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Unheld<'a> {
    /// The rounding of the given velocities, row by row.
    pub rounding: &'a [f64],
    /// u_free + shift without the impulses of the joints.
    pub data: &'a [f64],
    /// V of each contact: the largest of these at the joints and closed contacts that W joins with it.
    pub fastest: &'a [f64],
    /// The joints, which an impulse that counts as none must not move either.
    pub joints: Option<&'a Joints<'a>>,
}

/// The weights of every contact: what its impulse moves at itself, and whether it moves anything.
pub(super) fn weigh(problem: &ContactProblem) -> Weights {
    let (rows, operator, mut block) = (problem.rows_per_contact(), problem.delassus().of_contacts(), [0.0; MOST_ENTRIES]);
    let (block, softness) = (&mut block[..rows * rows], problem.row_compliances());
    let one = |k: usize| {
        operator.diagonal_block(k, block);
        let soft = |row: usize| softness.map_or(0.0, |softness| softness[row]);
        let diagonal = |row: usize| block[row * (rows + 1)] + soft(k * rows + row);
        let tangential: f64 = (1..rows).map(diagonal).sum();
        [inverse(1.0, diagonal(0)), inverse((rows - 1) as f64, tangential)]
    };
    let mut weights = spare::collected(problem.contacts(), (0..problem.contacts()).map(one));
    let moves_itself = spare::collected(weights.len(), weights.iter().map(|weights| weights.map(f64::is_finite))).into();
    // A block without a trace has no mass of its own. Every mass > 0 has the same zeros: the largest of the problem is the strictest.
    let largest = weights.iter().flatten().copied().filter(|rho| rho.is_finite()).fold(0.0, f64::max);
    let instead = if largest > 0.0 { largest } else { 1.0 };
    weights.iter_mut().flatten().filter(|rho| !rho.is_finite()).for_each(|rho| *rho = instead);
    Weights { weights: weights.into(), moves_itself }
}

impl Scales {
    /// Weights and groups of a problem; the floors are 0 until they are asked for.
    pub fn prepare(&mut self, problem: &ContactProblem) {
        let Weights { weights, moves_itself } = problem.weights(weigh);
        self.floors.clear();
        self.floors.resize(problem.rows(), 0.0);
        let places = problem.islands().first.iter().zip(problem.groups(groups::find));
        self.contacts.clear();
        self.contacts.reserve(weights.len());
        let is_associated = matches!(problem.law(), Law::Associated | Law::PolyhedralAssociated { .. });
        let known = weights.iter().zip(moves_itself.iter()).zip(problem.friction()).zip(places);
        for (((weights, moves_itself), mu), (island, group)) in known {
            let [n, t] = [(1.0 / weights[0]).sqrt(), (2.0 / weights[1]).sqrt()];
            let (weights, moves_itself, island, group) = (*weights, *moves_itself, *island, *group);
            let lifts = if is_associated { mu.max(1.0) } else { 1.0 };
            self.contacts.push(Known { weights, roots: [n, t, n.max(t)], moves_itself, lifts, island, group });
        }
        self.unheld = Default::default();
    }

    /// Makes room for what joints hold: the rounding of the given velocities, and their size without the joints.
    pub fn set_unheld(&mut self, unheld: Unheld) {
        self.floors.iter_mut().zip(unheld.rounding).for_each(|(floor, more)| *floor += more);
        self.unheld = [unheld.data.to_vec(), unheld.fastest.to_vec()];
    }

    /// The floors at the impulses r; one pass over |W|.
    pub fn set_floors(&mut self, problem: &ContactProblem, impulse: &[f64]) {
        let (data, softness) = (problem.free_velocity().as_slice().iter().zip(problem.shift().as_slice()), problem.row_compliances());
        let soft = |row: usize| softness.map_or(0.0, |softness| softness[row]);
        let own = |(row, ((free, shift), r)): (usize, ((&f64, &f64), &f64))| free.abs() + shift.abs() + soft(row) * r.abs();
        self.floors.clear();
        self.floors.extend(data.zip(impulse).enumerate().map(own));
        if let Some(operator) = problem.rounded_as() {
            operator.add_magnitudes(impulse, &mut self.floors);
        }
        self.stored.clear();
        let gammas = problem.rounding();
        self.floors.iter_mut().zip(gammas).for_each(|(floor, gamma)| *floor *= gamma);
        self.reach =
            if problem.knows_rows() { self.contacts.iter().zip(impulse.chunks(problem.rows_per_contact())).map(reach).sum() } else { 0.0 };
        self.unrounded.clear();
        let (free, shift) = (problem.free_velocity().as_slice(), problem.shift().as_slice());
        if shift.iter().any(|shift| *shift != 0.0) {
            let lost = |((free, shift), gamma): ((&f64, &f64), &f64)| gamma * (free.abs() + shift.abs() - (free + shift).abs());
            self.unrounded.extend(free.iter().zip(shift).zip(gammas).map(lost));
        }
    }

    /// The sizes at r and y = q + (W + R) r.
    pub fn set_sizes(&mut self, problem: &ContactProblem, impulse: &[f64], law_velocity: &[f64]) {
        match problem.rows_per_contact() {
            1 => self.set_sizes_of::<1>(problem, impulse, law_velocity),
            2 => self.set_sizes_of::<2>(problem, impulse, law_velocity),
            _ => self.set_sizes_of::<3>(problem, impulse, law_velocity),
        }
    }

    /// [`Scales::set_sizes`] of contacts of this many rows.
    fn set_sizes_of<const ROWS: usize>(&mut self, problem: &ContactProblem, impulse: &[f64], law_velocity: &[f64]) {
        self.shared.clear();
        self.shared.resize(problem.contacts(), [0.0; 3]);
        self.own.clear();
        self.own.reserve(problem.contacts());
        self.given.clear();
        self.given.reserve(problem.contacts());
        self.largest.clear();
        self.largest.resize(problem.contacts(), Largest::default());
        let law = problem.law();
        let [r, y, free, shift] = [impulse, law_velocity, problem.free_velocity().as_slice(), problem.shift().as_slice()]
            .map(|numbers| numbers.as_chunks::<ROWS>().0.iter());
        let given = free.zip(shift).zip(problem.friction());
        for (known, ((r, y), ((free, shift), mu))) in self.contacts.iter().zip(r.zip(y).zip(given)) {
            let q: [f64; ROWS] = std::array::from_fn(|row| free[row] + shift[row]);
            let [normal, tangential] = known.weights;
            let moved = |row: usize| if row < ROWS { y[row] - q[row] } else { 0.0 };
            let net = length(moved(1), moved(2));
            let own = if known.moves_itself[0] { r[0].abs() } else { 0.0 };
            let pushed = [own.max(normal * moved(0).abs()), r[0].abs(), length(tangential_norm(r), r[0]).max(tangential * net)];
            let largest = &mut self.largest[known.island];
            largest.impulse = at_least(largest.impulse, r[0].abs());
            largest.contacts += 1;
            let fastest = q.iter().fold(0.0, |most, q| at_least(most, q.abs()));
            largest.given = at_least(largest.given, fastest);
            if r[0] > normal * closing(law, *mu, y) {
                largest.driven = at_least(largest.driven, fastest);
            }
            largest.fastest = (0..ROWS).fold(at_least(largest.fastest, fastest), |most, row| at_least(most, moved(row).abs()));
            self.given.push(fastest);
            let sizes = &mut self.shared[known.group];
            sizes.iter_mut().zip(pushed).for_each(|(size, pushed)| *size = at_least(*size, pushed));
            self.own.push(known.of_data(law, *mu, &q));
        }
        self.include_unheld(problem);
    }

    /// The sizes with those of what joints hold.
    fn include_unheld(&mut self, problem: &ContactProblem) {
        let [data, fastest] = &self.unheld;
        for (k, q) in data.chunks_exact(problem.rows_per_contact()).enumerate() {
            let sizes = self.contacts[k].of_data(problem.law(), problem.friction()[k], q);
            self.own[k].iter_mut().zip(sizes).for_each(|(own, size)| *own = own.max(size));
            // what the impulses of joints move is no velocity that was given
            self.given[k] = q.iter().fold(0.0, |most, q| at_least(most, q.abs()));
        }
        for (largest, most) in self.largest.iter_mut().zip(fastest) {
            (largest.given, largest.driven, largest.fastest) = (*most, *most, largest.fastest.max(*most));
        }
    }

    /// What the numbers of a contact are held against, whose rows have these floors.
    #[inline]
    pub fn held<const ROWS: usize>(&self, contact: usize, given: &[f64; ROWS]) -> Held {
        let known = &self.contacts[contact];
        let (weights, hidden, jammed) = (known.weights, self.hidden(contact), known.jammed(self.velocity(contact)));
        let most = known.most(jammed);
        let (sizes, floors) = (self.sizes(contact, jammed, most), [given[0], tangential_norm(given)]);
        let impulse = if known.moves_itself[0] { [sizes[0], 0.0] } else { self.of_impulse(known) };
        let uncertain = if floors[0].max(known.lifts * floors[1]) > hidden { Some(self.rounding(contact, given)) } else { None };
        let part = |value| Part { value, scale: sizes[0] / weights[0], floor: hidden };
        let uncertain = uncertain.filter(|value| value.is_nan() || *value > hidden).map(part);
        Held { weights, sizes, most, impulse, floors: floors.map(|floor| at_most(hidden, floor)), uncertain }
    }

    /// The rounding of y at a contact whose rows have these floors, without what u_free and shift lose in each other: q is one sum of two
    /// numbers, which rounds by an ε of itself, however small it is beside them \[m/s\].
    #[cold]
    fn rounding<const ROWS: usize>(&self, contact: usize, floors: &[f64; ROWS]) -> f64 {
        let lost = |row: usize| self.unrounded.get(contact * ROWS + row).copied().unwrap_or(0.0);
        let rounded: [f64; ROWS] = std::array::from_fn(|row| floors[row] - lost(row));
        rounded[0].max(self.contacts[contact].lifts * tangential_norm(&rounded))
    }

    /// What a stored u may be off by, row by row \[m/s\].
    pub fn of_stored(&self) -> &[f64] {
        if self.stored.is_empty() { &self.floors } else { &self.stored }
    }

    /// V of a contact \[m/s\].
    #[inline]
    fn velocity(&self, contact: usize) -> f64 {
        at_least(self.largest[self.contacts[contact].island].velocity(), self.given[contact])
    }

    /// What rounding may hide at a contact \[m/s\].
    pub fn hidden(&self, contact: usize) -> f64 {
        let is_given = self.largest[self.contacts[contact].island].given > 0.0;
        if is_given { self.velocity(contact) * HIDDEN } else { f64::INFINITY }
    }

    /// Whether the rounding of y at the rows of a contact, which have these floors, is within what it may hide.
    pub fn is_certain(&self, contact: usize, floors: &[f64]) -> bool {
        let most = self.hidden(contact);
        floors.iter().all(|floor| floor.is_finite() && *floor <= 0.5 * most)
    }

    /// The larger of the residuals \[m/s\], \[N·s\] along the normal and \[N·s\] along the tangents, and of the rounding of y, as
    /// velocities, in parts of V.
    pub fn missed(&self, contact: usize, [dual, normal, tangential]: [&Part; 3]) -> f64 {
        let ([rho_n, rho_t], rows) = (self.contacts[contact].weights, self.floors.len() / self.contacts.len());
        let rounded = self.floors[contact * rows..(contact + 1) * rows].iter().fold(0.0, |most, floor| worst(most, *floor));
        let off = [dual.value, normal.value / rho_n, tangential.value / rho_t, rounded].into_iter().fold(0.0, worst);
        if off == 0.0 { 0.0 } else { off / self.velocity(contact) }
    }

    /// The largest r_n/(ρ_n V): how many times the impulse that the data ask of a contact it
    /// carries. Where V = 0, or an impulse does not move its own contact, nothing tells.
    pub fn loaded(&self, impulse: &[f64]) -> f64 {
        let rows = impulse.len() / self.contacts.len().max(1);
        let carried = |(k, r): (usize, &[f64])| {
            let known = &self.contacts[k];
            let tells = known.moves_itself[0] && self.largest[known.island].given > 0.0;
            tells.then(|| r[0].abs() / (known.weights[0] * self.velocity(k)))
        };
        impulse.chunks_exact(rows.max(1)).enumerate().filter_map(carried).fold(0.0, at_least)
    }

    /// The scale of r_n itself, with its rounding \[N·s\], where an impulse does not move its own contact, so that no velocity tells how
    /// large it should be: the normal impulses there are between the two bodies.
    fn of_impulse(&self, known: &Known) -> [f64; 2] {
        let Largest { impulse, contacts, .. } = self.largest[known.island];
        [self.shared[known.group][1], row_rounding(contacts) * impulse]
    }

    /// s_n, s_r and s_t of contact k \[N·s\].
    pub fn at(&self, contact: usize) -> [f64; 3] {
        let known = &self.contacts[contact];
        let jammed = known.jammed(self.velocity(contact));
        self.sizes(contact, jammed, known.most(jammed))
    }

    /// s_n/ρ_n and s_t/ρ_t of contact k \[m/s\].
    pub fn velocities(&self, contact: usize) -> [f64; 2] {
        let ([s_n, _, s_t], [rho_n, rho_t]) = (self.at(contact), self.contacts[contact].weights);
        [s_n / rho_n, s_t / rho_t]
    }

    /// [`Scales::at`] with what [`Known::jammed`] and [`Known::most`] say of the contact.
    #[inline]
    fn sizes(&self, contact: usize, [most_n, most_t]: [f64; 2], [moved_n, moved_t]: [f64; 2]) -> [f64; 3] {
        let group = self.contacts[contact].group;
        let ([s_n, s_r, s_t], [own_n, own_r, own_t]) = (self.shared[group], self.own[contact]);
        [
            at_most(at_least(s_n, own_n), most_n),
            at_most(at_most(at_least(s_r, own_r), moved_n), moved_t),
            at_most(at_least(s_t, own_t), most_t),
        ]
    }
}

impl Known {
    /// What the data q of a contact add to its s_n, s_r and s_t \[N·s\]; to s_r only where a velocity tells the size of an impulse.
    #[inline]
    fn of_data(&self, law: Law, mu: f64, q: &[f64]) -> [f64; 3] {
        let [s_n, s_r, s_t] = of_data(law, mu, q, self.weights);
        [s_n, if self.moves_itself[0] { s_r } else { 0.0 }, s_t]
    }

    /// 10³ ρ V, normal and tangential \[N·s\].
    #[inline]
    fn jammed(&self, fastest: f64) -> [f64; 2] {
        self.weights.map(|rho| JAMMED * rho * fastest)
    }

    /// The same where impulses move their own contact so; else infinite.
    #[inline]
    fn most(&self, [normal, tangential]: [f64; 2]) -> [f64; 2] {
        let [moves_n, moves_t] = self.moves_itself;
        [if moves_n { normal } else { f64::INFINITY }, if moves_t { tangential } else { f64::INFINITY }]
    }
}

/// What the data q of a contact add to its s_n, s_r and s_t \[N·s\], with their rounding.
///
/// The associated laws subtract μ‖q_t‖ from q_n, which rounds by 8ε of both. Of the others only q_n is asked, beside which 8ε‖q_t‖ is
/// nothing; it counts with min(μ, 1/μ), so that the friction μ s_r that it excuses is rounding of the slip, however large μ is.
#[inline]
fn of_data(law: Law, mu: f64, q: &[f64], [normal, tangential]: [f64; 2]) -> [f64; 3] {
    let slip = tangential_norm(q);
    let rounded = |part: f64| PROJECTED * (q[0].abs() + part * slip);
    let beside = rounded(mu.min(1.0 / mu));
    let own = match law {
        Law::Associated | Law::PolyhedralAssociated { .. } => rounded(mu),
        _ => beside,
    };
    let data = closing(law, mu, q).abs() + own;
    [normal * data, normal * data.min(q[0].abs() + beside), tangential * slip]
}

/// The larger of two, of which the first is a number: a NaN changes nothing, as in [`f64::max`], which asks both.
#[inline(always)]
pub(super) fn at_least(number: f64, other: f64) -> f64 {
    if other > number { other } else { number }
}

/// The smaller of two, of which the first is a number.
#[inline(always)]
pub(super) fn at_most(number: f64, other: f64) -> f64 {
    if other < number { other } else { number }
}

/// √W_jj |r_j| of the rows of a contact, or more.
fn reach((known, impulse): (&Known, &[f64])) -> f64 {
    let [normal, tangential, _] = known.roots;
    impulse[0].abs() * normal + tangential_norm(impulse) * tangential
}

/// count/trace, infinite if the trace is not positive.
fn inverse(count: f64, trace: f64) -> f64 {
    if trace > 0.0 { count / trace } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::super::Judge;
    use super::*;
    use crate::problem::Solution;
    use nalgebra::{DMatrix, DVector, dvector};

    #[test]
    fn what_was_found_of_a_hard_problem_is_not_believed_of_the_softer_one() {
        let hard = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]);
        let hard = hard.build().unwrap();
        assert_eq!(Judge::weights(&hard), [[1.0, 1.0]]);
        let mut softer = hard.clone();
        softer.soften(dvector![1.0, 3.0], DVector::zeros(2));
        assert_eq!(Judge::weights(&softer), [[0.5, 0.25]]);
        assert_eq!(Judge::weights(&hard), [[1.0, 1.0]]);
    }

    #[test]
    fn what_a_free_velocity_and_a_shift_lose_in_each_other_is_no_rounding_of_their_sum() {
        let accepts = |w: DMatrix<f64>, shift: DVector<f64>, impulse: DVector<f64>| {
            let free = DVector::from_element(shift.len(), -2.0);
            let problem = ContactProblem::new(w, free).rows_per_contact(1).shift(shift).build().unwrap();
            let solution = Solution::new("by hand", impulse.clone(), problem.velocity(&impulse), 0);
            Judge::default().judge(&problem, &solution).unwrap().accepts(1e-8)
        };
        for q in [4.0 * f64::EPSILON, 2f64.powi(-42), 2f64.powi(-30), -2.0 * f64::EPSILON, -2f64.powi(-42), -1.0] {
            let alone = |r: f64| accepts(DMatrix::identity(1, 1), dvector![2.0 + q], dvector![r]);
            let right = (-q).max(0.0);
            assert!(alone(right) && !alone(right + 1e-3 * q.abs()), "{q:e}");
            assert!(q > 0.0 || !alone(0.0), "{q:e}: it closes");
            // impulses that push against each other lose q as ever
            let jaw = |r: f64| accepts(DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]), dvector![2.0 + q, 2.0 + q], dvector![r, r]);
            assert!(!jaw(1e16 * q.abs()) && jaw(0.0) == (q > 0.0), "{q:e}");
        }
        // a sum that is no number is none that rounding may hide
        assert!(!accepts(DMatrix::identity(1, 1), dvector![f64::MAX], dvector![f64::MAX]));
    }
}
