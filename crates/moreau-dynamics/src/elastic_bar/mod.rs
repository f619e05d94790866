//! The elastic bar of [`moreau_forms::elastic_bar`] by linear finite elements, and its contact by four methods.
//!
//! ```text
//!     M ü + K u = λ e₀ ,   0 ≤ λ ⟂ u₀ ≥ 0 ,       Δ = L/N ,  k = EA/Δ
//!     M lumped: ρAΔ, half of it at both ends;   K: k on the diagonal at the ends, 2k inside, −k beside it
//!     redistributed mass: node 0 has none, node 1 has it, and u₀ = u₁ + λ/k follows from statics
//! ```
//! One step is a contact problem of one row, W r + u_free with r = hλ, and with R = 1/k where the mass is redistributed: the finite mass at
//! the end is what makes the contact force of the others oscillate at the frequency of the mesh.

use moreau_exact::{Error, Result};
use moreau_forms::ElasticBar;
use nalgebra::{DMatrix, DVector};

mod step;

pub use step::Method;

/// Displacements \[m\], velocities \[m/s\], accelerations \[m/s²\] and the contact force \[N\].
#[derive(Clone, Debug, PartialEq)]
pub struct BarState {
    /// u.
    pub displacement: DVector<f64>,
    /// v.
    pub velocity: DVector<f64>,
    /// a at the end of the step; of the midpoint rule its mean.
    pub acceleration: DVector<f64>,
    /// λ.
    pub force: f64,
}

/// A bar of N elements.
#[derive(Clone, Debug)]
pub struct FiniteElementBar {
    /// Diagonal of M \[kg\], free nodes only.
    pub mass: DVector<f64>,
    /// K \[N/m\].
    pub stiffness: DMatrix<f64>,
    /// 1/k \[m/N\] between the first free node and the wall, 0 for a contact of the node itself.
    pub compliance: f64,
    /// V \[m/s\].
    speed: f64,
}

impl FiniteElementBar {
    /// The bar in N elements, with the mass of its striking end lumped there or given to the next node.
    ///
    /// # Errors
    /// If there are fewer than two elements.
    pub fn new(bar: &ElasticBar, elements: usize, redistributed: bool) -> Result<Self> {
        if elements < 2 {
            return Err(Error::invalid("elements", format!("is {elements}"), "use at least 2"));
        }
        let length = bar.length / elements as f64;
        let (lump, spring) = (bar.density * bar.area * length, bar.modulus * bar.area / length);
        let nodes = if redistributed { elements } else { elements + 1 };
        let mut mass = DVector::from_element(nodes, lump);
        mass[nodes - 1] = 0.5 * lump;
        mass[0] = if redistributed { 1.5 * lump } else { 0.5 * lump };
        let mut stiffness = DMatrix::zeros(nodes, nodes);
        for left in 0..nodes - 1 {
            for (i, j, sign) in [(left, left, 1.0), (left, left + 1, -1.0), (left + 1, left, -1.0), (left + 1, left + 1, 1.0)] {
                stiffness[(i, j)] += sign * spring;
            }
        }
        let compliance = if redistributed { 1.0 / spring } else { 0.0 };
        Ok(FiniteElementBar { mass, stiffness, compliance, speed: bar.speed })
    }

    /// The bar as it touches the wall, moving at −V.
    pub fn arriving(&self) -> BarState {
        let nodes = self.mass.len();
        let still = || DVector::zeros(nodes);
        BarState { displacement: still(), velocity: DVector::from_element(nodes, -self.speed), acceleration: still(), force: 0.0 }
    }

    /// ½ vᵀMv + ½ uᵀKu + ½ λ²/k \[J\].
    pub fn energy(&self, state: &BarState) -> f64 {
        let kinetic = state.velocity.component_mul(&self.mass).dot(&state.velocity);
        let elastic = state.displacement.dot(&(&self.stiffness * &state.displacement));
        0.5 * (kinetic + elastic + self.compliance * state.force * state.force)
    }

    /// Σ m v \[N·s\].
    pub fn momentum(&self, state: &BarState) -> f64 {
        self.mass.dot(&state.velocity)
    }
}
