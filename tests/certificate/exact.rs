//! A contact problem in exact rationals, W r, y, and square roots: exact where rational, else from below within 2⁻¹²⁸ of themselves.

use moreau::problem::{Compliance, ContactProblem, Coordinates, Dynamics, Law};
use moreau::scalar::{Rational, Scalar, exact, ratio};
use nalgebra::{DMatrix, DVector};

/// A contact problem whose numbers are rationals.
#[derive(Clone)]
pub struct Exact {
    pub rows: usize,
    pub law: Law,
    pub friction: Vec<Rational>,
    pub delassus: DMatrix<Rational>,
    pub free: Vec<Rational>,
    pub shift: Vec<Rational>,
    /// R on the contact rows, zeros without compliance.
    pub soft: Vec<Rational>,
    /// R on the edges of the polyhedral associated law.
    pub edge_soft: Option<Vec<Rational>>,
}

/// Who touches whom: what the certificate may know of the bodies.
#[derive(Clone, Debug, PartialEq)]
pub enum Known {
    /// Nothing: every contact stands alone.
    Nothing,
    /// M̂ and H: the columns of a contact's rows name its bodies.
    Jacobian(Dynamics),
    /// The two bodies of every contact, `None` for the ground.
    Bodies(Vec<[Option<usize>; 2]>),
}

pub fn zero() -> Rational {
    ratio(0, 1)
}

/// x as the certificate's own numbers see it.
pub fn nearest(x: &Rational) -> f64 {
    Scalar::to_f64(x)
}

/// √x: exact where it is rational, otherwise too small by less than 2⁻¹²⁸ of itself.
pub fn root(x: &Rational) -> Rational {
    let (p, q) = x.clone().into_parts();
    let (a, b) = (p.nth_root(2), q.nth_root(2));
    if &a * &a == p && &b * &b == q {
        return Rational::from_parts(a, b);
    }
    // ⌊√(p q 4¹²⁸)⌋ / (q 2¹²⁸), and p q ≥ 1
    let scaled = ((p * &q) << 256usize).nth_root(2);
    Rational::from_parts(scaled, q << 128usize)
}

/// ‖x‖.
pub fn norm(x: &[Rational]) -> Rational {
    match x {
        [] => zero(),
        [single] => single.magnitude(),
        _ => root(&x.iter().fold(zero(), |sum, x| sum + x * x)),
    }
}

/// r to f64.
pub fn rounded(x: &[Rational]) -> DVector<f64> {
    DVector::from_iterator(x.len(), x.iter().map(nearest))
}

impl Exact {
    pub fn contacts(&self) -> usize {
        self.friction.len()
    }

    /// The problem that the f64 data are, digit for digit.
    pub fn of(problem: &ContactProblem) -> Self {
        let list = |x: &DVector<f64>| x.iter().map(|&x| exact(x)).collect::<Vec<_>>();
        let soft = |coordinates| problem.compliance().filter(|r| r.coordinates == coordinates).map(|r| list(&r.diagonal));
        Exact {
            rows: problem.rows_per_contact(),
            law: problem.law(),
            friction: problem.friction().iter().map(|&mu| exact(mu)).collect(),
            delassus: problem.dense().map(exact),
            free: list(problem.free_velocity()),
            shift: list(problem.shift()),
            soft: soft(Coordinates::Contact).unwrap_or_else(|| vec![zero(); problem.rows()]),
            edge_soft: soft(Coordinates::Edge),
        }
    }

    /// The data rounded to f64. The only place where this test writes a `ContactProblem`.
    pub fn rounded(&self, name: &str, known: &Known) -> ContactProblem {
        let diagonal = |soft: &[Rational], coordinates| Compliance { coordinates, diagonal: rounded(soft) };
        let soft = self.soft.iter().any(|r| *r > zero()).then(|| diagonal(&self.soft, Coordinates::Contact));
        let (dynamics, bodies) = match known {
            Known::Nothing => (None, None),
            Known::Jacobian(dynamics) => (Some(dynamics.clone()), None),
            Known::Bodies(bodies) => (None, Some(bodies.clone())),
        };
        ContactProblem::new(self.delassus.map(|w| nearest(&w)), rounded(&self.free))
            .name(name)
            .law(self.law)
            .rows_per_contact(self.rows)
            .friction(self.friction.iter().map(nearest).collect())
            .shift(rounded(&self.shift))
            .compliance(self.edge_soft.as_ref().map(|soft| diagonal(soft, Coordinates::Edge)).or(soft))
            .dynamics(dynamics)
            .bodies(bodies)
            .build()
            .unwrap()
    }

    /// W r.
    pub fn net(&self, impulse: &[Rational]) -> Vec<Rational> {
        let mut net = vec![zero(); impulse.len()];
        self.add_net(&mut net, 0..impulse.len(), impulse);
        net
    }

    /// Adds W change to `net`, where `change` belongs to these columns.
    pub fn add_net(&self, net: &mut [Rational], columns: std::ops::Range<usize>, change: &[Rational]) {
        for (column, change) in columns.zip(change) {
            if *change == zero() {
                continue;
            }
            for (row, entry) in net.iter_mut().enumerate() {
                *entry += &self.delassus[(row, column)] * change;
            }
        }
    }

    /// y = W r + u_free + shift + R r.
    pub fn law_velocity(&self, impulse: &[Rational], net: &[Rational]) -> Vec<Rational> {
        (0..impulse.len()).map(|i| &net[i] + &self.free[i] + &self.shift[i] + &self.soft[i] * &impulse[i]).collect()
    }
}

impl Exact {
    /// Makes y of two soft edges from y of hard ones: y_n ± μ y_t loses R f, with f = (r_n ± r_t/μ)/2.
    pub fn soften_edges(&mut self, impulse: &[Rational], velocity: &mut [Rational]) {
        let Some(soft) = &mut self.edge_soft else { return };
        for (k, mu) in self.friction.iter().enumerate() {
            let (n, half) = (2 * k, ratio(1, 2));
            if *mu == zero() {
                // both edges are the normal
                soft[n + 1] = soft[n].clone();
            }
            let along = if *mu == zero() { zero() } else { &impulse[n + 1] / mu };
            let [first, second] = [0, 1].map(|j| {
                let f = if j == 0 { &impulse[n] + &along } else { &impulse[n] - &along };
                &soft[n + j] * f * &half
            });
            velocity[n] -= (&first + &second) * &half;
            if *mu > zero() {
                velocity[n + 1] -= (first - second) * &half / mu;
            }
        }
    }
}

/// The contacts of the same two bodies as each contact, itself included.
///
/// Where columns of H name the bodies, those that W joins to it, directly or through others: coordinates that mix bodies give two of them
/// the same columns.
pub fn groups(contacts: usize, rows: usize, known: &Known, delassus: &DMatrix<Rational>) -> Vec<Vec<usize>> {
    let same: Box<dyn Fn(usize, usize) -> bool> = match known {
        Known::Nothing => Box::new(|a, b| a == b),
        Known::Jacobian(dynamics) => {
            let h = &dynamics.jacobian;
            let touched = move |contact: usize| -> Vec<bool> {
                h.column_iter().map(|column| (contact * rows..(contact + 1) * rows).any(|row| column[row] != 0.0)).collect()
            };
            Box::new(move |a, b| touched(a) == touched(b))
        }
        Known::Bodies(bodies) => Box::new(|a, b| bodies[a] == bodies[b] || [bodies[a][1], bodies[a][0]] == bodies[b]),
    };
    let moved = |a: usize, b: usize| delassus.view((a * rows, b * rows), (rows, rows)).iter().any(|entry| *entry != zero());
    let reached = |k: usize| {
        let mut found = vec![k];
        let mut next = 0;
        while let Some(&from) = found.get(next) {
            let more: Vec<usize> = (0..contacts).filter(|to| same(from, *to) && moved(from, *to) && !found.contains(to)).collect();
            found.extend(more);
            next += 1;
        }
        found
    };
    match known {
        Known::Jacobian(_) => (0..contacts).map(reached).collect(),
        _ => (0..contacts).map(|k| (0..contacts).filter(|&j| same(k, j)).collect()).collect(),
    }
}

#[test]
fn roots_are_exact_where_they_are_rational_and_close_where_not() {
    assert_eq!(root(&ratio(49, 225)), ratio(7, 15));
    assert_eq!(norm(&[ratio(3, 7), ratio(-4, 7)]), ratio(5, 7));
    let two = ratio(2, 1);
    let below = root(&two);
    let above = &below * (ratio(1, 1) + exact(2f64.powi(-128)));
    assert!(&below * &below < two && &above * &above > two);
}
