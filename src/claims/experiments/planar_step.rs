//! One planar step in exact rationals, under the associated law or under Coulomb's, for the checks of several sections.
//!
//! ```text
//!     v⁺ = v_free + M⁻¹Hᵀr ,   y = H v⁺ + (φ/h) n + R r
//!     associated   K_μ ∋ r ⟂ y ∈ K_μ*     as an LCP in the two edge impulses of each contact
//!     Coulomb      Stewart–Trinkle with both senses of the tangent, exact in the plane
//! ```

use crate::Result;
use crate::problem::{ImpulseLcp, Law, Lcp, PlanarProblem};
use crate::scalar::{Rational, ratio};
use crate::solvers::lemke::solution;
use moreau_exact::witness::{Witness, decided};
use nalgebra::{DMatrix, DVector};

/// The data of one step; rows of H in the order (n, t) per contact.
#[derive(Clone, Debug)]
pub struct PlanarStep {
    /// Diagonal of M \[kg\].
    pub mass: Vec<Rational>,
    /// H.
    pub jacobian: DMatrix<Rational>,
    /// v_free \[m/s\].
    pub free_velocity: DVector<Rational>,
    /// (φ/h) n and zero, per contact \[m/s\].
    pub shift: DVector<Rational>,
    /// μ per contact.
    pub friction: Vec<Rational>,
    /// R, the diagonal softness per row \[1/kg\].
    pub softness: DVector<Rational>,
}

/// Impulses and the velocity after the step.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// r \[N·s\].
    pub impulse: DVector<Rational>,
    /// v⁺ \[m/s\].
    pub velocity: DVector<Rational>,
}

impl PlanarStep {
    /// A hard step of one point of unit mass whose coordinates are (height, distance along the ground).
    pub fn point(free_velocity: [Rational; 2], gap_rate: Rational, friction: Rational) -> Self {
        PlanarStep {
            mass: vec![ratio(1, 1); 2],
            jacobian: DMatrix::identity(2, 2),
            free_velocity: DVector::from_row_slice(&free_velocity),
            shift: DVector::from_vec(vec![gap_rate, ratio(0, 1)]),
            friction: vec![friction],
            softness: DVector::from_element(2, ratio(0, 1)),
        }
    }

    /// W = H M⁻¹Hᵀ \[1/kg\].
    pub fn delassus(&self) -> DMatrix<Rational> {
        decided(
            || &self.jacobian * self.inverse_mass() * self.jacobian.transpose(),
            |found| {
                let mass = DMatrix::from_diagonal(&DVector::from_vec(self.mass.clone()));
                let parts = vec![("mass", (&mass).into()), ("jacobian", (&self.jacobian).into()), ("delassus", found.into())];
                Some(Witness::new("delassus", parts))
            },
        )
    }

    /// u_free + shift, the linear term of the convex program \[m/s\].
    pub fn linear_term(&self) -> DVector<Rational> {
        &self.jacobian * &self.free_velocity + &self.shift
    }

    /// y = (W + R) r + u_free + shift \[m/s\].
    pub fn law_velocity(&self, impulse: &DVector<Rational>) -> DVector<Rational> {
        self.delassus() * impulse + self.linear_term() + self.softness.component_mul(impulse)
    }

    /// ½rᵀ(W + R)r + (u_free + shift)ᵀr \[J\].
    pub fn objective(&self, impulse: &DVector<Rational>) -> Rational {
        ratio(1, 2) * impulse.dot(&(self.law_velocity(impulse) + self.linear_term()))
    }

    /// The objective as a form of (r, 1): ½ (W + R, b; bᵀ, 0) with b = u_free + shift.
    pub fn program(&self) -> DMatrix<Rational> {
        let (b, size) = (self.linear_term(), self.softness.len());
        let mut form = (self.delassus() + DMatrix::from_diagonal(&self.softness)).resize(size + 1, size + 1, ratio(0, 1));
        for (i, entry) in b.iter().enumerate() {
            form[(i, size)] = entry.clone();
            form[(size, i)] = entry.clone();
        }
        form * ratio(1, 2)
    }

    /// v⁺ = v_free + M⁻¹Hᵀr.
    pub fn velocity(&self, impulse: &DVector<Rational>) -> DVector<Rational> {
        let response = self.inverse_mass() * self.jacobian.transpose();
        decided(
            || &self.free_velocity + &response * impulse,
            |after| {
                let data = [("delassus", (&response).into()), ("velocity", (&self.free_velocity).into()), ("impulse", impulse.into())];
                Some(Witness::new("response", data.into_iter().chain([("after", after.into())]).collect()))
            },
        )
    }

    /// The LCP of the associated law in the edge impulses, two per contact.
    pub fn edge_lcp(&self) -> Lcp<Rational> {
        let edges = self.edges();
        let operator = self.delassus() + DMatrix::from_diagonal(&self.softness);
        Lcp::new(edges.transpose() * operator * &edges, edges.transpose() * self.linear_term())
    }

    /// The Stewart–Trinkle LCP of Coulomb's law.
    pub fn stewart_trinkle(&self) -> Result<ImpulseLcp<Rational>> {
        let operator = self.delassus() + DMatrix::from_diagonal(&self.softness);
        PlanarProblem::new(operator, self.linear_term()).coulomb(&self.friction)
    }

    /// r of a solution of [`PlanarStep::edge_lcp`].
    pub fn impulse_of_edges(&self, z: &DVector<Rational>) -> DVector<Rational> {
        self.edges() * z
    }

    /// The step under [`Law::Associated`] or [`Law::Coulomb`].
    pub fn solve(&self, law: Law) -> Result<Answer> {
        let impulse = match law {
            Law::Associated => self.impulse_of_edges(&solution(&self.edge_lcp())?),
            _ => self.stewart_trinkle()?.solve()?,
        };
        Ok(Answer { velocity: self.velocity(&impulse), impulse })
    }

    /// Whether K ∋ r ⟂ y ∈ K* holds exactly.
    pub fn is_cone_complementary(&self, impulse: &DVector<Rational>) -> bool {
        let y = self.law_velocity(impulse);
        self.friction.iter().enumerate().all(|(k, mu)| {
            let (r_n, r_t, y_n, y_t) = (&impulse[2 * k], &impulse[2 * k + 1], &y[2 * k], &y[2 * k + 1]);
            let inside = magnitude(r_t) <= mu.clone() * r_n.clone() && *r_n >= ratio(0, 1);
            let dual = *y_n >= mu.clone() * magnitude(y_t);
            inside && dual && r_n.clone() * y_n.clone() + r_t.clone() * y_t.clone() == ratio(0, 1)
        })
    }

    fn inverse_mass(&self) -> DMatrix<Rational> {
        DMatrix::from_diagonal(&DVector::from_iterator(self.mass.len(), self.mass.iter().map(|m| ratio(1, 1) / m.clone())))
    }

    /// Columns n + μt and n − μt of every contact.
    fn edges(&self) -> DMatrix<Rational> {
        let rows = 2 * self.friction.len();
        DMatrix::from_fn(rows, rows, |row, column| match (row / 2 == column / 2, row % 2, column % 2) {
            (false, _, _) => ratio(0, 1),
            (true, 0, _) => ratio(1, 1),
            (true, _, 0) => self.friction[row / 2].clone(),
            (true, _, _) => -self.friction[row / 2].clone(),
        })
    }
}

/// |x|.
pub fn magnitude(x: &Rational) -> Rational {
    crate::scalar::Scalar::magnitude(x)
}

/// A block (as a point of unit mass) on a slope, stepped exactly; gravity 10 m/s².
#[derive(Clone, Debug)]
pub struct Block {
    /// Acceleration into the slope \[m/s²\].
    pub normal_gravity: Rational,
    /// Acceleration down the slope \[m/s²\].
    pub tangential_gravity: Rational,
    /// μ.
    pub friction: Rational,
    /// R_t \[1/kg\], zero for the hard step.
    pub tangential_softness: Rational,
    /// The law.
    pub law: Law,
    /// φ \[m\].
    pub gap: Rational,
    /// (u_n, u_t) \[m/s\].
    pub velocity: [Rational; 2],
}

impl Block {
    /// At rest on the 3-4-5 slope, tan α = 3/4, under the hard associated law.
    pub fn at_rest(friction: Rational) -> Self {
        Block {
            normal_gravity: ratio(8, 1),
            tangential_gravity: ratio(6, 1),
            friction,
            tangential_softness: ratio(0, 1),
            law: Law::Associated,
            gap: ratio(0, 1),
            velocity: [ratio(0, 1), ratio(0, 1)],
        }
    }

    /// One step; returns the impulse.
    pub fn step(&mut self, h: &Rational) -> Result<DVector<Rational>> {
        let free = [
            self.velocity[0].clone() - h.clone() * self.normal_gravity.clone(),
            self.velocity[1].clone() + h.clone() * self.tangential_gravity.clone(),
        ];
        let mut step = PlanarStep::point(free, self.gap.clone() / h.clone(), self.friction.clone());
        step.softness[1] = self.tangential_softness.clone();
        let Answer { impulse, velocity } = step.solve(self.law)?;
        self.gap += h.clone() * velocity[0].clone();
        self.velocity = [velocity[0].clone(), velocity[1].clone()];
        Ok(impulse)
    }

    /// `count` steps.
    pub fn steps(&mut self, count: usize, h: &Rational) -> Result<()> {
        (0..count).try_for_each(|_| self.step(h).map(|_| ()))
    }
}

/// A box of unit mass, 2 m wide and 1 m high, inertia ⅓ kg·m², on its two lower corners: velocities (x, y, ω).
///
/// Both corners have the tangential row (1, 0, ½): the impulse (0, 1, 0, −1) moves nothing.
pub fn box_on_two_corners(free_velocity: [Rational; 3], friction: Rational) -> PlanarStep {
    let row = |a: i64, b: i64, c: (i64, i64)| [ratio(a, 1), ratio(b, 1), ratio(c.0, c.1)];
    let rows = [row(0, 1, (-1, 1)), row(1, 0, (1, 2)), row(0, 1, (1, 1)), row(1, 0, (1, 2))];
    PlanarStep {
        mass: vec![ratio(1, 1), ratio(1, 1), ratio(1, 3)],
        jacobian: DMatrix::from_fn(4, 3, |i, j| rows[i][j].clone()),
        free_velocity: DVector::from_row_slice(&free_velocity),
        shift: DVector::from_element(4, ratio(0, 1)),
        friction: vec![friction; 2],
        softness: DVector::from_element(4, ratio(0, 1)),
    }
}

/// Painlevé's rod (unit mass and half-length, cos θ = 4/5) sliding at −1 m/s while its tip separates at 1/10 m/s.
///
/// W = (73, −36; −36, 52)/25. With μ > 73/36 Coulomb's step has three solutions: none, a jam that slides on, a jam that sticks.
pub fn painleve_rod(friction: Rational) -> PlanarStep {
    // velocities (x, y, ω), tip at (−4/5, −3/5) from the centre, inertia 1/3
    let rows = [[ratio(0, 1), ratio(1, 1), ratio(-4, 5)], [ratio(1, 1), ratio(0, 1), ratio(3, 5)]];
    PlanarStep {
        mass: vec![ratio(1, 1), ratio(1, 1), ratio(1, 3)],
        jacobian: DMatrix::from_fn(2, 3, |i, j| rows[i][j].clone()),
        free_velocity: DVector::from_vec(vec![ratio(-1, 1), ratio(1, 10), ratio(0, 1)]),
        shift: DVector::from_element(2, ratio(0, 1)),
        friction: vec![friction],
        softness: DVector::from_element(2, ratio(0, 1)),
    }
}
