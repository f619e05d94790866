//! The family: laws × structures × scalings, every member a problem with a rational answer, q := y − (W + R) r.

use crate::exact::{Exact, Known, groups, nearest, rounded, zero};
use crate::random::Random;
use crate::statuses::{Point, STATUSES, Sizes, Status, point};
use moreau::elimination::rank;
use moreau::problem::{ContactProblem, Dynamics, Law, Solution};
use moreau::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// Who touches whom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// Every contact has a body of its own on the ground.
    Separate,
    /// All contacts hold one body.
    One,
    /// The same, at points that occur twice.
    Twice,
    /// Contact k lies between bodies k − 1 and k, the first on the ground.
    Chain,
    /// All contacts lie between the same two free bodies.
    Pair,
}

/// What is 10^±6 times (2^±20 in dyadic members) as large as elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scaling {
    None,
    Mass,
    Velocity,
    Length,
    /// Lever arms alone, by 10^±3.
    Lever,
    /// The mass of one contact's body, and its impulse.
    OneMass,
    /// One contact's impulse.
    OneImpulse,
    /// One contact's velocity.
    OneVelocity,
    /// One contact's rows, with impulse and velocity: the units of one contact.
    OneRow,
}

impl Scaling {
    pub fn is_of_one_contact(self) -> bool {
        matches!(self, Scaling::OneMass | Scaling::OneImpulse | Scaling::OneVelocity | Scaling::OneRow)
    }
}

const STRUCTURES: [Structure; 5] = [Structure::Separate, Structure::One, Structure::Twice, Structure::Chain, Structure::Pair];
const SCALINGS: [Scaling; 8] = [
    Scaling::Mass,
    Scaling::Velocity,
    Scaling::Length,
    Scaling::Lever,
    Scaling::OneMass,
    Scaling::OneImpulse,
    Scaling::OneVelocity,
    Scaling::OneRow,
];

/// Law and rows per contact.
const LAWS: [(Law, usize); 13] = [
    (Law::Frictionless, 1),
    (Law::Frictionless, 2),
    (Law::Frictionless, 3),
    (Law::Coulomb, 1),
    (Law::Coulomb, 2),
    (Law::Coulomb, 3),
    (Law::Associated, 1),
    (Law::Associated, 2),
    (Law::Associated, 3),
    (Law::PolyhedralCoulomb { directions: 2 }, 2),
    (Law::PolyhedralCoulomb { directions: 4 }, 3),
    (Law::PolyhedralAssociated { directions: 2 }, 2),
    (Law::PolyhedralAssociated { directions: 4 }, 3),
];

/// Which member to build.
#[derive(Clone, Copy, Debug)]
pub struct Spec {
    pub index: usize,
    pub law: Law,
    pub rows: usize,
    pub contacts: usize,
    pub structure: Structure,
    pub scaling: Scaling,
    pub up: bool,
    pub dyadic: bool,
}

/// A problem with its exact answer.
pub struct Member {
    pub spec: Spec,
    pub name: String,
    pub statuses: Vec<Status>,
    /// The problem before rounding.
    pub exact: Exact,
    pub impulse: Vec<Rational>,
    pub parts: Option<Vec<Rational>>,
    pub sigma: Option<Vec<Rational>>,
    pub groups: Vec<Vec<usize>>,
    pub problem: ContactProblem,
    pub jacobian: DMatrix<Rational>,
    /// W has a null space.
    pub deficient: bool,
    /// W couples different contacts.
    pub coupled: bool,
}

/// Every member's description.
pub fn specs() -> Vec<Spec> {
    let mut specs = Vec::new();
    for (law, rows) in LAWS {
        for contacts in 1..=4 {
            let structures = if contacts == 1 { &STRUCTURES[..1] } else { &STRUCTURES[..] };
            for &structure in structures {
                let scalings = SCALINGS.iter().flat_map(|&scaling| [(scaling, true), (scaling, false)]);
                for (scaling, up) in std::iter::once((Scaling::None, true)).chain(scalings) {
                    // one body has one mass
                    if scaling == Scaling::OneMass && matches!(structure, Structure::One | Structure::Twice) {
                        continue;
                    }
                    let index = specs.len();
                    let dyadic = Random::new(index as u64, false).below(3) == 0;
                    specs.push(Spec { index, law, rows, contacts, structure, scaling, up, dyadic });
                }
            }
        }
    }
    specs
}

impl Spec {
    fn name(&self) -> String {
        let scaling = match self.scaling {
            Scaling::None => "plain".into(),
            scaling => format!("{scaling:?}{}", if self.up { '+' } else { '-' }),
        };
        let numbers = if self.dyadic { "dyadic" } else { "decimal" };
        format!("{} {} {}D {} {:?} {scaling} {numbers}", self.index, self.law.name(), self.rows, self.contacts, self.structure)
    }

    fn factor(&self) -> Rational {
        let (base, lever) = if self.dyadic { (1 << 20, 1 << 10) } else { (1_000_000, 1_000) };
        let size = if self.scaling == Scaling::Lever { lever } else { base };
        if self.up { ratio(size, 1) } else { ratio(1, size) }
    }

    /// The factor where this scaling is asked for, 1 elsewhere.
    fn factor_of(&self, scalings: &[Scaling]) -> Rational {
        if scalings.contains(&self.scaling) { self.factor() } else { ratio(1, 1) }
    }

    fn bodies(&self) -> Vec<[Option<usize>; 2]> {
        let bodies = |k: usize| match self.structure {
            Structure::Separate => [Some(k), None],
            Structure::One | Structure::Twice => [Some(0), None],
            Structure::Chain => [Some(k), k.checked_sub(1)],
            // a pair is the same two bodies in either order
            Structure::Pair => [Some(k % 2), Some(1 - k % 2)],
        };
        (0..self.contacts).map(bodies).collect()
    }

    pub fn build(&self) -> Member {
        let mut random = Random::new(0x6d6f_7265_6175 + self.index as u64, self.dyadic);
        let which = random.below(self.contacts);
        let bodies = self.bodies();
        let (mass, jacobian) = self.mechanics(which, &bodies, &mut random);
        let inverse = mass.map(|m| ratio(1, 1) / m);
        let scaled = DMatrix::from_fn(jacobian.nrows(), jacobian.ncols(), |i, j| &jacobian[(i, j)] * &inverse[j]);
        let delassus = &scaled * jacobian.transpose();
        let (statuses, points, friction) = self.answer(which, &mut random);
        let part = |of: fn(&Point) -> &Vec<Rational>| points.iter().flat_map(|p| of(p).clone()).collect::<Vec<_>>();
        let (impulse, mut velocity) = (part(|p| &p.impulse), part(|p| &p.velocity));
        let softness: Vec<Rational> = (0..impulse.len()).map(|i| self.softness(random.below(4), &delassus[(i, i)])).collect();
        let edges = matches!(self.law, Law::PolyhedralAssociated { directions: 2 });
        let mut exact = Exact {
            rows: self.rows,
            law: self.law,
            friction,
            delassus,
            free: vec![zero(); impulse.len()],
            shift: vec![zero(); impulse.len()],
            soft: if edges { vec![zero(); impulse.len()] } else { softness.clone() },
            edge_soft: edges.then_some(softness),
        };
        if edges {
            exact.soften_edges(&impulse, &mut velocity);
        }
        let net = exact.net(&impulse);
        for i in 0..impulse.len() {
            let data = &velocity[i] - &net[i] - &exact.soft[i] * &impulse[i];
            let shared = if self.index.is_multiple_of(2) && i.is_multiple_of(self.rows) { &data * ratio(1, 4) } else { zero() };
            exact.free[i] = data - &shared;
            exact.shift[i] = shared;
        }
        let known = match self.index % 3 {
            0 => Known::Nothing,
            1 => Known::Jacobian(Dynamics {
                mass: DMatrix::from_diagonal(&rounded(mass.as_slice())),
                jacobian: jacobian.map(|h| nearest(&h)),
            }),
            _ => Known::Bodies(bodies),
        };
        // β, σ and f are given in some answers and left to be recovered in the others
        let given = self.law.directions().is_some() && self.index % 5 < 2;
        let coulomb = matches!(self.law, Law::PolyhedralCoulomb { .. });
        Member {
            spec: *self,
            name: self.name(),
            statuses,
            parts: (given && coulomb).then(|| part(|p| &p.parts)),
            sigma: (given && coulomb).then(|| points.iter().map(|p| p.sigma.clone()).collect()),
            groups: groups(self.contacts, self.rows, &known, &exact.delassus),
            problem: exact.rounded(&self.name(), &known),
            deficient: rank(&jacobian) < impulse.len(),
            coupled: self.contacts > 1 && self.structure != Structure::Separate,
            exact,
            impulse,
            jacobian,
        }
    }

    /// M (diagonal) and H.
    fn mechanics(&self, which: usize, bodies: &[[Option<usize>; 2]], random: &mut Random) -> (DVector<Rational>, DMatrix<Rational>) {
        let freedoms = [2, 3, 6][self.rows - 1];
        let count = 1 + bodies.iter().flatten().flatten().max().expect("a body in every contact");
        let (heavy, long) = (self.factor_of(&[Scaling::Mass]), self.factor_of(&[Scaling::Length]));
        let mut mass = Vec::new();
        for body in 0..count {
            // of a pair the second body alone changes
            let changed = body == if self.structure == Structure::Pair { 1 } else { which };
            let own = if changed { self.factor_of(&[Scaling::OneMass]) } else { ratio(1, 1) };
            let (linear, turning) = (random.divisor() * &heavy * &own, random.divisor() * &heavy * &own * &long * &long);
            let translations = self.rows;
            mass.extend((0..freedoms).map(|i| if i < translations { linear.clone() } else { turning.clone() }));
        }
        let arms = long * self.factor_of(&[Scaling::Lever]);
        let mut points: Vec<[Rational; 3]> = Vec::new();
        for k in 0..self.contacts {
            let repeated = self.structure == Structure::Twice && k >= self.contacts.div_ceil(2);
            let new = [(); 3].map(|()| random.arm() * &arms);
            points.push(if repeated { points[k - self.contacts.div_ceil(2)].clone() } else { new });
        }
        let mut jacobian = DMatrix::from_element(self.rows * self.contacts, freedoms * count, zero());
        for (k, pair) in bodies.iter().enumerate() {
            let scale = if k == which { self.factor_of(&[Scaling::OneRow]) } else { ratio(1, 1) };
            for body in pair.iter().flatten() {
                let upper = pair.iter().flatten().all(|other| other <= body);
                let sign = ratio(if upper { 1 } else { -1 }, 1);
                for (row, entries) in lever(self.rows, &points[k]).into_iter().enumerate() {
                    for (column, entry) in entries.into_iter().enumerate() {
                        jacobian[(self.rows * k + row, freedoms * body + column)] = entry * &sign * &scale;
                    }
                }
            }
        }
        (DVector::from_vec(mass), jacobian)
    }

    fn answer(&self, which: usize, random: &mut Random) -> (Vec<Status>, Vec<Point>, Vec<Rational>) {
        let (mut statuses, mut points, mut friction) = (Vec::new(), Vec::new(), Vec::new());
        for k in 0..self.contacts {
            let drawn = random.below(5);
            let status = STATUSES[if k == 0 { self.index % 5 } else { drawn }];
            let mu = if self.rows == 1 { zero() } else { random.friction() };
            let sizes = self.sizes(k, which);
            points.push(point(self.law, self.rows, status, &mu, &sizes, random));
            statuses.push(status);
            friction.push(mu);
        }
        (statuses, points, friction)
    }

    fn sizes(&self, k: usize, which: usize) -> Sizes {
        let one = |scalings: &[Scaling], here: bool| if here { self.factor_of(scalings) } else { ratio(1, 1) };
        // what lies on a heavy body's chain carries it; a light one changes only its own contact
        let carries = match self.structure {
            Structure::Chain if self.up => k <= which,
            Structure::Pair => !self.up,
            _ => k == which,
        };
        let row = one(&[Scaling::OneRow], k == which);
        let velocity = self.factor_of(&[Scaling::Velocity, Scaling::Length]) * one(&[Scaling::OneVelocity], k == which) * &row;
        let momentum = self.factor_of(&[Scaling::Mass, Scaling::Velocity, Scaling::Length]);
        let impulse = momentum * one(&[Scaling::OneMass], carries) * one(&[Scaling::OneImpulse], k == which) / row;
        Sizes { impulse, velocity }
    }

    /// R of a row: every fourth member is soft.
    fn softness(&self, choice: usize, diagonal: &Rational) -> Rational {
        if self.index % 4 == 3 { diagonal * [ratio(0, 1), ratio(1, 2), ratio(1, 1), ratio(4, 1)][choice].clone() } else { zero() }
    }
}

/// The rows (n, t₁, t₂) of a contact at this point of a body.
fn lever(rows: usize, p: &[Rational; 3]) -> Vec<Vec<Rational>> {
    let [x, y, z] = p.clone();
    let (one, none) = (|| ratio(1, 1), zero);
    match rows {
        1 => vec![vec![one(), x]],
        2 => vec![vec![none(), one(), x], vec![one(), none(), -y]],
        _ => vec![
            vec![none(), none(), one(), y.clone(), -x.clone(), none()],
            vec![one(), none(), none(), none(), z.clone(), -y],
            vec![none(), one(), none(), -z, none(), x],
        ],
    }
}

impl Member {
    /// The answer r, rounded.
    pub fn solution(&self) -> Solution {
        let list = |x: &Option<Vec<Rational>>| x.as_deref().map(rounded);
        let mut solution = answer(&self.problem, rounded(&self.impulse));
        (solution.beta, solution.sigma) = (list(&self.parts), list(&self.sigma));
        solution
    }
}

/// An answer with the velocity that belongs to its impulse.
pub fn answer(problem: &ContactProblem, impulse: DVector<f64>) -> Solution {
    let velocity = problem.velocity(&impulse);
    Solution::new("exact", impulse, velocity, 0)
}
