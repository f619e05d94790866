//! An exact system of contacts, and what a Stewart–Trinkle step of it must satisfy, in mechanical terms.

use dashu_ratio::RBig;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// Contacts of a mechanism with diagonal mass matrix, in rational numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct RationalStep {
    /// Diagonal of M, positive.
    pub mass: DVector<Rational>,
    /// H with rows (n, t₁) or (n, t₁, t₂) per contact.
    pub jacobian: DMatrix<Rational>,
    /// 2 or 3.
    pub rows_per_contact: usize,
    /// Friction directions in the tangent plane; only first components count in the plane.
    pub directions: Vec<[Rational; 2]>,
    /// μ ≥ 0 per contact.
    pub friction: Vec<Rational>,
    /// φ per contact.
    pub gap: Vec<Rational>,
    /// h > 0.
    pub step: Rational,
    /// v_free, the velocities without impulses.
    pub free_velocity: DVector<Rational>,
}

/// d unit vectors with rational coordinates, closed under a quarter turn and hence under reversal; d = 2, 4 or 8.
///
/// d = 8 uses the Pythagorean triple 20² + 21² = 29²: the diagonal directions lie on the unit circle, at 46.4° instead of 45°.
///
/// # Panics
/// For any other d.
pub fn rational_directions(d: usize) -> Vec<[Rational; 2]> {
    let quarter_turns = |x: Rational, y: Rational| [[x.clone(), y.clone()], [-y.clone(), x.clone()], [-x.clone(), -y.clone()], [y, -x]];
    let axes = quarter_turns(RBig::ONE, RBig::ZERO);
    match d {
        2 => vec![axes[0].clone(), axes[2].clone()],
        4 => axes.to_vec(),
        8 => axes.into_iter().zip(quarter_turns(ratio(20, 29), ratio(21, 29))).flat_map(|(axis, diagonal)| [axis, diagonal]).collect(),
        _ => panic!("rational directions exist here for d = 2, 4, 8, not {d}"),
    }
}

impl RationalStep {
    /// Number of contacts k.
    pub fn contacts(&self) -> usize {
        self.friction.len()
    }

    /// Number of unknowns, k(2 + d).
    pub fn unknowns(&self) -> usize {
        self.contacts() * (2 + self.directions.len())
    }

    /// Index of λ of a contact.
    pub fn lambda(&self, contact: usize) -> usize {
        contact
    }

    /// Index of βⱼ of a contact.
    pub fn beta(&self, contact: usize, j: usize) -> usize {
        self.contacts() + self.directions.len() * contact + j
    }

    /// Index of σ of a contact.
    pub fn sigma(&self, contact: usize) -> usize {
        self.contacts() * (1 + self.directions.len()) + contact
    }

    /// Hᵀ(Dⱼ) of a contact: the generalised direction of βⱼ.
    pub fn direction(&self, contact: usize, j: usize) -> DVector<Rational> {
        let first = self.rows_per_contact * contact + 1;
        let mut sum = DVector::from_element(self.mass.len(), RBig::ZERO);
        for tangent in 0..self.rows_per_contact - 1 {
            sum += self.jacobian.row(first + tangent).transpose() * self.directions[j][tangent].clone();
        }
        sum
    }

    /// Hᵀ n of a contact: the generalised direction of λ.
    pub fn normal(&self, contact: usize) -> DVector<Rational> {
        self.jacobian.row(self.rows_per_contact * contact).transpose()
    }

    /// The generalised impulse p = Σ nλ + Dβ.
    pub fn impulse(&self, z: &DVector<Rational>) -> DVector<Rational> {
        let mut sum = DVector::from_element(self.mass.len(), RBig::ZERO);
        for contact in 0..self.contacts() {
            sum += self.normal(contact) * z[self.lambda(contact)].clone();
            for j in 0..self.directions.len() {
                sum += self.direction(contact, j) * z[self.beta(contact, j)].clone();
            }
        }
        sum
    }

    /// pᵀM⁻¹p + Σ μλσ, the value that the quadratic form of the Stewart–Trinkle matrix must have.
    pub fn expected_form(&self, z: &DVector<Rational>) -> Rational {
        let impulse = self.impulse(z);
        let kinetic = impulse.iter().zip(self.mass.iter()).fold(RBig::ZERO, |sum, (p, m)| sum + p * p / m);
        let contacts = 0..self.contacts();
        contacts.fold(kinetic, |sum, i| sum + &self.friction[i] * &z[self.lambda(i)] * &z[self.sigma(i)])
    }

    /// The three slacks of the chapter's complementarity groups after the step, computed from v⁺ = v_free + M⁻¹p:
    /// φ/h + nᵀv⁺ beside λ, σ + dⱼᵀv⁺ beside βⱼ, μλ − Σβ beside σ.
    pub fn slack(&self, z: &DVector<Rational>) -> DVector<Rational> {
        let velocity = &self.free_velocity + self.impulse(z).component_div(&self.mass);
        let mut slack = DVector::from_element(self.unknowns(), RBig::ZERO);
        for i in 0..self.contacts() {
            slack[self.lambda(i)] = &self.gap[i] / &self.step + self.normal(i).dot(&velocity);
            slack[self.sigma(i)] = &self.friction[i] * &z[self.lambda(i)];
            for j in 0..self.directions.len() {
                slack[self.beta(i, j)] = &z[self.sigma(i)] + self.direction(i, j).dot(&velocity);
                slack[self.sigma(i)] -= &z[self.beta(i, j)];
            }
        }
        slack
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rational_directions_are_distinct_unit_vectors_closed_under_reversal() {
        for d in [2, 4, 8] {
            let directions = rational_directions(d);
            assert_eq!(directions.len(), d);
            for [x, y] in &directions {
                assert_eq!(x * x + y * y, RBig::ONE);
                assert_eq!(directions.iter().filter(|[u, v]| *u == -x && *v == -y).count(), 1);
            }
        }
    }
}
