//! The law at one contact as equations, once it is known whether the contact is open, presses, sticks or slides.
//!
//! ```text
//!     open        r = 0                                            holds where  y_n ≥ 0  (associated: y_n ≥ μ‖y_t‖)
//!     pressing    y_n = 0 ,  r_t = 0          (no friction)                     r_n ≥ 0
//!     sticking    y = 0                                                         r_n ≥ 0 ,  ‖r_t‖² ≤ μ² r_n²
//!     sliding     y_n = 0  (associated: y_n = μ‖y_t‖) ,                         r_n ≥ 0 ,  y_t ≠ 0
//!                 r_t + μ r_n y_t/‖y_t‖ = 0
//!                 in the plane forth, r_t = −μ r_n and y_t ≥ 0, or back
//!     joined      y = 0        (a bilateral row)                                always
//!     undecided   r_n = max(z_n, 0) ,  r_t = P(z_t) onto the disk of radius μ max(z_n, 0) ,  z = r − ρ y ,   always
//! ```
//! The equations of a decided contact are smooth; where its inequalities hold strictly, a solution of the equations solves the law. An
//! undecided contact is one on the border between two cases. Its equations are those of Coulomb's law itself (Alart and Curnier) and only
//! Lipschitz: in place of a derivative stands the hull of the generalised Jacobian, which has the mean value property as well.
//!
//! Polyhedral laws in the plane are the round ones; in space their edges and sides are in `polygon`.

use super::affine::Affine;
use super::case::{Case, ContactState, Equations, Linear};
use super::polygon::Polygon;
use crate::certificate::interval::Interval;
use crate::certificate::planted::{Plant, planted};
use crate::problem::{ContactProblem, Law};

/// One contact with its law.
#[derive(Clone, Copy)]
pub(super) struct Contact {
    /// The associated law in place of Coulomb's.
    associated: bool,
    /// The directions of friction in space, if they are finitely many.
    polygon: Option<Polygon>,
    pub friction: f64,
    pub rows: usize,
    /// ρ_n, ρ_t \[kg\].
    pub weights: [f64; 2],
    /// Whether it is a bilateral row, of which the first of its rows alone says something.
    pub joined: bool,
}

const ZERO: Interval = Interval::ZERO;

impl Contact {
    /// Contact k of a problem, or the bilateral row that it stands for, ρ from the diagonal of A.
    pub fn new(problem: &ContactProblem, k: usize, joined: bool) -> Self {
        let rows = problem.rows_per_contact();
        let entry = |row: usize| problem.entry(k * rows + row, k * rows + row) + problem.row_compliance(k * rows + row);
        let inverse = |diagonal: f64| if diagonal > 0.0 { 1.0 / diagonal } else { 1.0 };
        let tangential = (1..rows).map(entry).fold(0.0, f64::max);
        let friction = if rows == 1 { 0.0 } else { problem.law().cone_friction(problem.friction()[k]) };
        let associated = matches!(problem.law(), Law::Associated | Law::PolyhedralAssociated { .. });
        let directions = problem.law().directions().filter(|_| rows == 3 && friction > 0.0);
        let polygon = directions.map(|directions| Polygon { directions, friction, associated });
        Contact { associated, polygon, friction, rows, weights: [inverse(entry(0)), inverse(tangential)], joined }
    }

    /// Whether a border between two cases has equations.
    pub fn has_borders(&self) -> bool {
        !self.associated && self.polygon.is_none()
    }

    /// The case nearest to r and y.
    pub fn case(&self, r: &[f64], y: &[f64]) -> Case {
        let [normal, tangential] = self.weights;
        let length = y[1..].iter().fold(0.0_f64, |sum, y| sum.hypot(*y));
        let slip = self.polygon.map_or(length, |polygon| polygon.slip([y[1], y[2]]));
        let lift = if self.associated { self.friction * slip } else { 0.0 };
        let pushed = |i: usize| r[i] - tangential * y[i];
        let pressed = r[0] - normal * (y[0] - lift);
        // a contact without an impulse that closes will have one; under the round laws the equations of a border find it
        let bound = self.friction * if r[0] > 0.0 { r[0] } else { pressed };
        Case::Is(match (self.friction, self.polygon) {
            _ if self.joined => ContactState::Joined,
            _ if pressed <= 0.0 || r[0] <= 0.0 && self.polygon.is_none() => ContactState::Open,
            (0.0, _) => ContactState::Pressing,
            (_, Some(polygon)) => return polygon.nearest(bound, [pushed(1), pushed(2)]).unwrap_or(Case::Is(ContactState::Sticking)),
            _ if self.rows == 2 && pushed(1).abs() > bound && slip > 0.0 => return Case::Forth(pushed(1) < 0.0),
            _ if (1..self.rows).map(pushed).fold(0.0_f64, f64::hypot) > bound && slip > 0.0 => ContactState::Sliding,
            _ => ContactState::Sticking,
        })
    }

    /// The rows whose impulses are unknown.
    pub fn unknowns(&self, case: Case) -> usize {
        match case.state() {
            ContactState::Open => 0,
            ContactState::Pressing | ContactState::Joined => 1,
            ContactState::Undecided if self.friction == 0.0 => 1,
            _ => self.rows,
        }
    }

    /// Its equations that are linear in the impulses and say nothing else of them: of sliding in space under the associated law none is.
    pub fn linear(&self, case: Case) -> Vec<Linear> {
        match case {
            Case::Edge(_) | Case::Side(_) => self.polygon.map_or(Vec::new(), |polygon| polygon.linear(case)),
            Case::Forth(forth) if self.associated => {
                let mut lift = Linear::row(0);
                let way = if planted(Plant::Way) { -sign(forth) } else { sign(forth) };
                lift.terms.push(([self.friction, -way], 1));
                vec![lift]
            }
            Case::Forth(_) => vec![Linear::row(0)],
            Case::Is(ContactState::Sticking) => (0..self.rows).map(Linear::row).collect(),
            Case::Is(ContactState::Pressing | ContactState::Joined) => vec![Linear::row(0)],
            Case::Is(ContactState::Sliding) if !self.associated => vec![Linear::row(0)],
            Case::Is(_) => Vec::new(),
        }
    }

    /// Whether y_i = 0 is one of its equations.
    pub fn is_zero(&self, case: Case, row: usize) -> bool {
        self.linear(case).iter().any(|linear| linear.terms == [([1.0, 1.0], row)])
    }

    /// The equations of this case where the impulse is in r and the velocity in y.
    pub fn equations(&self, case: Case, r: &[Interval], y: &[Interval]) -> Equations {
        let none = [[ZERO; 3]; 3];
        let mut made = Equations { value: [ZERO; 3], by_impulse: none, by_velocity: none, by_pushed: none };
        match case.state() {
            ContactState::Open => {}
            ContactState::Pressing | ContactState::Sticking | ContactState::Joined => {
                for (i, y) in y.iter().enumerate().take(self.unknowns(case)) {
                    made.value[i] = *y;
                    made.by_velocity[i][i] = Interval::ONE;
                }
            }
            ContactState::Sliding => match (self.polygon, case) {
                (Some(polygon), _) => polygon.write(case, r, y, &mut made),
                (None, Case::Forth(forth)) => self.slide_straight(Interval::point(sign(forth)), r, y, &mut made),
                (None, _) => self.slide(r, y, &mut made),
            },
            ContactState::Undecided => self.natural_map(r, y, &mut made),
        }
        made
    }

    /// Sliding in the plane, `way` = ± 1: y_n = ± μ y_t or 0, r_t = ∓ μ r_n.
    fn slide_straight(&self, way: Interval, r: &[Interval], y: &[Interval], made: &mut Equations) {
        let mu = way * Interval::point(self.friction);
        (made.value[0], made.by_velocity[0][0]) = (y[0], Interval::ONE);
        if self.associated {
            (made.value[0], made.by_velocity[0][1]) = (y[0] - mu * y[1], -mu);
        }
        made.value[1] = r[1] + mu * r[0];
        (made.by_impulse[1][0], made.by_impulse[1][1]) = (mu, Interval::ONE);
    }

    fn slide(&self, r: &[Interval], y: &[Interval], made: &mut Equations) {
        let (mu, slip) = (Interval::point(self.friction), length(&y[1..]));
        let t: Vec<Interval> = y[1..].iter().map(|y| component(*y, slip, self.rows)).collect();
        (made.value[0], made.by_velocity[0][0]) = (y[0], Interval::ONE);
        if self.associated {
            made.value[0] = y[0] - mu * slip;
            (1..self.rows).for_each(|j| made.by_velocity[0][j] = -(mu * t[j - 1]));
        }
        for i in 1..self.rows {
            made.value[i] = r[i] + mu * r[0] * t[i - 1];
            made.by_impulse[i][0] = mu * t[i - 1];
            made.by_impulse[i][i] = Interval::ONE;
            // the derivative of y_t/‖y_t‖ is (I − t tᵀ)/‖y_t‖
            for j in 1..self.rows {
                made.by_velocity[i][j] = mu * r[0] * across(&t, i, j) / slip;
            }
        }
    }

    /// z = r − ρ y.
    fn pushed(&self, r: &[Interval], y: &[Interval]) -> Vec<Interval> {
        let weight = |i: usize| Interval::point(self.weights[usize::from(i > 0)]);
        (0..self.rows).map(|i| r[i] - weight(i) * y[i]).collect()
    }

    /// r − Q(z): z is affine in the impulses, so that what Q does not know multiplies I − ρ A, which is small where contacts hardly couple.
    fn natural_map(&self, r: &[Interval], y: &[Interval], made: &mut Equations) {
        let z = self.pushed(r, y);
        let pushes = step(z[0]);
        made.value[0] = r[0] - z[0].positive_part();
        made.by_impulse[0][0] = Interval::ONE;
        made.by_pushed[0][0] = -pushes;
        if self.friction == 0.0 {
            return;
        }
        let (mu, radius) = (Interval::point(self.friction), Interval::point(self.friction) * z[0].positive_part());
        let reach = length(&z[1..]);
        let outside = step(reach - radius);
        let unknown = |size: f64| Interval { low: -size, high: size };
        let known = reach.low > 0.0;
        let ratio = if known { radius / reach } else { Interval { low: 0.0, high: 1.0 } };
        let shrunk = Interval { low: ratio.low.min(1.0), high: ratio.high.min(1.0) };
        let t: Vec<Interval> = z[1..].iter().map(|z| if known { component(*z, reach, self.rows) } else { unknown(1.0) }).collect();
        for i in 1..self.rows {
            // inside of the disk the derivative of P is I, outside (ϱ/‖z‖)(I − t tᵀ), and t by the radius ϱ
            made.value[i] = r[i] - between(outside, z[i], radius * t[i - 1]);
            made.by_impulse[i][i] = Interval::ONE;
            made.by_pushed[i][0] = -(outside * t[i - 1] * mu * pushes);
            for j in 1..self.rows {
                let identity = if i == j { Interval::ONE } else { ZERO };
                let beyond = match (self.rows, known, i == j) {
                    (2, ..) => ZERO,
                    (_, true, _) => shrunk * across(&t, i, j),
                    (_, false, true) => Interval { low: 0.0, high: 1.0 },
                    (_, false, false) => unknown(0.5), // the product of two components of a unit vector
                };
                made.by_pushed[i][j] = -between(outside, identity, beyond);
            }
        }
    }

    /// What the contact does in the words of every law, for all impulses in r and velocities in y of this case.
    pub fn told(&self, case: Case, r: &[Interval], y: &[Interval]) -> ContactState {
        match case {
            Case::Is(ContactState::Undecided) => self.decided(r, y),
            Case::Is(state) => state,
            _ if squares(&y[1..]).low > 0.0 => ContactState::Sliding,
            _ => ContactState::Undecided,
        }
    }

    /// What an undecided contact does after all, if every impulse in r and velocity in y tells the same.
    fn decided(&self, r: &[Interval], y: &[Interval]) -> ContactState {
        let z = self.pushed(r, y);
        if z[0].high < 0.0 {
            return ContactState::Open;
        }
        if self.friction == 0.0 {
            return if z[0].low > 0.0 { ContactState::Pressing } else { ContactState::Undecided };
        }
        let (radius, reach) = (Interval::point(self.friction) * z[0], length(&z[1..]));
        match z[0].low > 0.0 {
            true if reach.high < radius.low => ContactState::Sticking,
            true if reach.low > radius.high => ContactState::Sliding,
            _ => ContactState::Undecided,
        }
    }

    /// Whether the law's inequalities hold for every impulse in r and velocity in y of this case.
    pub fn holds(&self, case: Case, r: &[Interval], y: &[Interval]) -> bool {
        match (self.polygon, case) {
            (None, Case::Is(state)) => self.holds_round(state, r, y),
            (None, Case::Forth(forth)) => r[0].low >= 0.0 && (Interval::point(sign(forth)) * y[1]).low >= 0.0,
            (None, _) => false,
            (Some(polygon), Case::Is(ContactState::Open)) => polygon.opens(y),
            (Some(polygon), Case::Is(ContactState::Sticking)) => polygon.holds_inside(r),
            (Some(polygon), Case::Edge(_) | Case::Side(_)) => polygon.holds(case, r, y),
            (Some(_), _) => case == Case::Is(ContactState::Joined),
        }
    }

    fn holds_round(&self, state: ContactState, r: &[Interval], y: &[Interval]) -> bool {
        let pushes = r[0].low >= 0.0;
        let mu_squared = Interval::point(self.friction).square();
        match state {
            ContactState::Open if self.associated => y[0].low >= 0.0 && (y[0].square() - mu_squared * squares(&y[1..])).low >= 0.0,
            ContactState::Open => y[0].low >= 0.0,
            ContactState::Pressing => pushes,
            ContactState::Sticking => pushes && (mu_squared * r[0].square() - squares(&r[1..])).low >= 0.0,
            ContactState::Sliding => pushes && squares(&y[1..]).low > 0.0,
            ContactState::Undecided | ContactState::Joined => true,
        }
    }
}

/// 1 forth and −1 back.
fn sign(forth: bool) -> f64 {
    if forth { 1.0 } else { -1.0 }
}

/// The rows of one contact in a list over all rows.
pub(super) fn of<T: Copy>(all: &[T], contact: usize, rows: usize) -> [T; 3] {
    std::array::from_fn(|i| all[contact * rows + i.min(rows - 1)])
}

/// ‖x‖².
fn squares(x: &[Interval]) -> Interval {
    x.iter().fold(ZERO, |sum, x| sum + x.square())
}

/// ‖x‖ of one or two components.
fn length(x: &[Interval]) -> Interval {
    match *x {
        [one] => {
            Interval { low: if one.low <= 0.0 && one.high >= 0.0 { 0.0 } else { one.low.abs().min(one.high.abs()) }, high: one.magnitude() }
        }
        _ => squares(x).sqrt(),
    }
}

/// x/‖x‖, of which no component is larger than one; in the plane it is a sign.
fn component(x: Interval, length: Interval, rows: usize) -> Interval {
    let quotient = match rows {
        2 if x.low > 0.0 => return Interval::ONE,
        2 if x.high < 0.0 => return -Interval::ONE,
        _ => x / length,
    };
    Interval { low: quotient.low.clamp(-1.0, 1.0), high: quotient.high.clamp(-1.0, 1.0) }
}

/// (I − t tᵀ)_ij, i and j from 1.
fn across(t: &[Interval], i: usize, j: usize) -> Interval {
    let product = if i == j { t[i - 1].square() } else { t[i - 1] * t[j - 1] };
    if i == j { Interval::ONE - product } else { -product }
}

/// The derivative of max(x, 0): 0, 1, or all between.
fn step(x: Interval) -> Interval {
    if x.low > 0.0 {
        Interval::ONE
    } else if x.high < 0.0 {
        ZERO
    } else {
        Interval { low: 0.0, high: 1.0 }
    }
}

/// The first where `switch` is 0, the second where it is 1, and their hull where it is undecided.
fn between(switch: Interval, first: Interval, second: Interval) -> Interval {
    if switch == ZERO {
        first
    } else if switch == Interval::ONE {
        second
    } else {
        first.hull(second)
    }
}

/// The cases of all contacts at r and y.
pub(super) fn read_off(contacts: &[Contact], affine_rows: usize, r: &[f64], y: &[f64]) -> Vec<Case> {
    let at = |k: usize| k * affine_rows..(k + 1) * affine_rows;
    contacts.iter().enumerate().map(|(k, contact)| contact.case(&r[at(k)], &y[at(k)])).collect()
}

/// The rows with an impulse, contact by contact.
pub(super) fn pressed_rows(contacts: &[Contact], cases: &[Case]) -> Vec<usize> {
    let rows = |k: usize| k * contacts[k].rows..k * contacts[k].rows + contacts[k].unknowns(cases[k]);
    (0..contacts.len()).flat_map(rows).collect()
}

/// Where each row stands among the columns.
pub(super) fn places(affine: &Affine, rows: usize) -> Vec<Option<usize>> {
    let mut places = vec![None; rows];
    affine.columns.iter().enumerate().for_each(|(place, row)| places[*row] = Some(place));
    places
}
