//! Piles of twenty to sixty contacts that are made here, in the plane and in space.

use super::transform::by_blocks;
use moreau::{ContactProblem, Law};
use moreau_contact::operator::{BlockRows, MatrixFree};
use nalgebra::{DMatrix, DVector};

/// Bodies and where they touch.
struct Pile {
    is_planar: bool,
    /// Centre \[m\], mass \[kg\], moment of inertia \[kg·m²\].
    bodies: Vec<([f64; 3], f64, f64)>,
    /// Which body, on which one or on the ground, where \[m\], and along which axis.
    contacts: Vec<(usize, Option<usize>, [f64; 3], usize)>,
    /// v_free of each body before gravity, along x \[m/s\].
    pushes: Vec<f64>,
}

/// So many cubes of edge 2 m on each other, every second one pushed sideways: four contacts each.
fn tower(cubes: usize) -> Pile {
    let corners = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
    let contact = |k: usize| corners.map(|[x, y]| (k, k.checked_sub(1), [x, y, 2.0 * k as f64], 2));
    Pile {
        is_planar: false,
        bodies: (0..cubes).map(|k| ([0.0, 0.0, 2.0 * k as f64 + 1.0], 1.0 + 0.25 * k as f64, 0.7)).collect(),
        contacts: (0..cubes).flat_map(contact).collect(),
        pushes: (0..cubes).map(|k| 0.3 * (k % 2) as f64).collect(),
    }
}

/// Bricks of 2 m by 1 m in the plane, layer over layer, each shifted by half a brick: two contacts where two of them meet.
fn wall(wide: usize, high: usize) -> Pile {
    let mut made = Pile { is_planar: true, bodies: Vec::new(), contacts: Vec::new(), pushes: Vec::new() };
    let mut below: Vec<usize> = Vec::new();
    for layer in 0..high {
        let shift = layer % 2;
        let own: Vec<usize> = (0..wide - shift).map(|k| made.bodies.len() + k).collect();
        for (k, body) in own.iter().enumerate() {
            let (x, z) = (2.0 * k as f64 + shift as f64, layer as f64);
            made.bodies.push(([x, 0.0, z + 0.5], 2.0, 0.8));
            made.pushes.push(0.2 * (made.bodies.len() % 3) as f64);
            let lower: Vec<(Option<usize>, [f64; 2])> = if layer == 0 {
                vec![(None, [x - 1.0, x + 1.0])]
            } else {
                let meets = |one: &&usize| (made.bodies[**one].0[0] - x).abs() < 1.5;
                let overlap = |one: &usize| [x.max(made.bodies[*one].0[0]) - 1.0, x.min(made.bodies[*one].0[0]) + 1.0];
                below.iter().filter(meets).map(|one| (Some(*one), overlap(one))).collect()
            };
            let ends = lower.into_iter().flat_map(|(other, ends)| ends.map(|x| (*body, other, [x, 0.0, z], 2)));
            made.contacts.extend(ends);
        }
        below = own;
    }
    made
}

/// Balls of 1 m in a row on the ground, the outer ones pushed at each other.
fn row(balls: usize) -> Pile {
    let ground = (0..balls).map(|k| (k, None, [k as f64, 0.0, 0.0], 2));
    let beside = (1..balls).map(|k| (k, Some(k - 1), [k as f64 - 0.5, 0.0, 0.5], 0));
    let push = |k: usize| if k == 0 { 1.0 } else { -f64::from(u8::from(k + 1 == balls)) };
    Pile {
        is_planar: false,
        bodies: (0..balls).map(|k| ([k as f64, 0.0, 0.5], 1.0, 0.1)).collect(),
        contacts: ground.chain(beside).collect(),
        pushes: (0..balls).map(push).collect(),
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl Pile {
    /// Places of x, y, z and of the turns about them among the velocities of a body; those of the plane are x, z and the turn about y.
    fn axes(&self) -> &'static [usize] {
        if self.is_planar { &[0, 2, 4] } else { &[0, 1, 2, 3, 4, 5] }
    }

    /// H of one body at a contact, row by row.
    fn rows(&self, body: usize, point: [f64; 3], normal: usize, sign: f64) -> Vec<f64> {
        let arm = [0, 1, 2].map(|axis| point[axis] - self.bodies[body].0[axis]);
        let directions = if self.is_planar { vec![normal, 0] } else { (0..3).map(|k| (normal + k) % 3).collect() };
        let row = |direction: usize| {
            let mut along = [0.0; 3];
            along[direction] = sign;
            let all = [along, cross(arm, along)].concat();
            self.axes().iter().map(|axis| all[*axis]).collect::<Vec<_>>()
        };
        directions.into_iter().flat_map(row).collect()
    }

    /// The problem of a hundredth of a second under gravity, W by bodies.
    fn problem(&self, name: &str, law: Law, friction: f64) -> ContactProblem {
        let (rows, axes) = (if self.is_planar { 2 } else { 3 }, self.axes());
        let mut jacobian = BlockRows::new(rows, vec![axes.len(); self.bodies.len()]).expect("two or three rows");
        for (body, other, point, normal) in &self.contacts {
            let own = self.rows(*body, *point, *normal, 1.0);
            match other {
                None => jacobian.push(&[(*body, &own)]),
                Some(other) => jacobian.push(&[(*other, &self.rows(*other, *point, *normal, -1.0)), (*body, &own)]),
            }
            .expect("bodies that grow");
        }
        let mass = |(_, mass, inertia): &([f64; 3], f64, f64)| {
            DMatrix::from_diagonal(&DVector::from_fn(axes.len(), |k, _| if axes[k] < 3 { *mass } else { *inertia }))
        };
        let masses: Vec<DMatrix<f64>> = self.bodies.iter().map(mass).collect();
        let moving = |push: &f64| [*push, 0.0, -0.0981, 0.0, 0.0, 0.0];
        let free: Vec<f64> = self.pushes.iter().flat_map(|push| axes.iter().map(|axis| moving(push)[*axis]).collect::<Vec<_>>()).collect();
        let free = DVector::from_vec(jacobian.contact_velocity(&free));
        ContactProblem::new(MatrixFree::new(&masses, jacobian).expect("positive masses"), free)
            .name(name)
            .law(law)
            .rows_per_contact(rows)
            .friction(vec![if law == Law::Frictionless { 0.0 } else { friction }; self.contacts.len()])
            .build()
            .expect("a valid problem")
    }
}

/// The laws of contacts in the plane or in space.
pub fn laws(is_planar: bool) -> [Law; 5] {
    let directions = if is_planar { 2 } else { 4 };
    let polyhedral = [Law::PolyhedralCoulomb { directions }, Law::PolyhedralAssociated { directions }];
    [Law::Frictionless, Law::Coulomb, Law::Associated, polyhedral[0], polyhedral[1]]
}

/// Whether W r is the same at all solutions of a law.
pub fn is_convex(law: Law) -> bool {
    !matches!(law, Law::Coulomb | Law::PolyhedralCoulomb { .. })
}

/// A tower, a wall and a row under every law, W in turn dense, by blocks and by bodies, so that each pile and each law has each.
pub fn stored_in_turn(piles: [usize; 3]) -> Vec<ContactProblem> {
    let mut made = Vec::new();
    for (place, (name, pile)) in [("tower", tower(piles[0])), ("wall", wall(3, piles[1])), ("row", row(piles[2]))].into_iter().enumerate() {
        for (turn, law) in laws(pile.is_planar).into_iter().enumerate() {
            let problem = pile.problem(&format!("{name}, {}", law.name()), law, 0.4);
            made.push(match (place + turn) % 3 {
                0 => problem.clone().into_builder().delassus(problem.dense().clone()).build().expect("a valid problem"),
                1 => by_blocks(&problem),
                _ => problem,
            });
        }
    }
    made
}
