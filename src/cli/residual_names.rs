//! What the residuals are that `certify`, `solve` and `bench` show.

/// For `--help`: every residual with its unit and its equation.
pub const RESIDUALS: &str = "\
Residuals, each at the contact where it is worst. A contact has the impulse r = (r_n, r_t) [N·s] and the law's velocity
y = (y_n, y_t) = u + shift + R r [m/s], u = W r + u_free; n is the normal and t the tangential part. K is the cone of the impulses
that the law allows, ‖r_t‖ ≤ μ r_n, K* its dual; ŷ = y + μ‖y_t‖n for Coulomb's law and y for others; ρ_n and ρ_t are masses [kg]:
  primal           [N·s]  dist(r, K): the impulse pulls, or friction is more than μ r_n
  dual             [m/s]  dist(ŷ, K*): the contact still approaches
  complementarity  [J]    |r·ŷ|: an impulse where the contact opens, or friction that does not oppose slip
  normal           [N·s]  min(r_n, ρ_n y_n): pressed and open at once, or neither
  tangential       [N·s]  ‖r_t − P(r_t − ρ_t y_t)‖, P the projection on the disk of radius μ r_n: friction is not that of the slip
  velocity         [m/s]  |u − (W r + u_free)|: the velocity stored in the answer is not that of its impulses
  bilateral        [m/s]  ‖y_k‖ of a constraint that holds in both directions, where a problem has `kinds`: it moves
Accepted is what is at most its limit, the larger one of tolerance × scale and of the rounding of its evaluation. The scale is the size of
the impulses and velocities of the contact's own pair of bodies. relative is the residual over its scale, and 0 where it is rounding.
Norms over all contacts decide nothing:
  natural_map        [N·s]  ‖r − P_K(r − ρŷ)‖ with ρ = rows/trace of a contact's block of W + R
  siconos, fclib     [1]    the same with ρ = 1 kg, divided as Siconos and FCLIB do
  impulse_scale      [N·s]  ‖r‖
  velocity_scale     [m/s]  ‖u_free + shift‖
  natural_map_scale  [N·s]  the larger one of ‖r‖ and ‖ρ(u_free + shift)‖, the latter of contacts with an impulse or a residual";

#[cfg(test)]
mod tests {
    use super::RESIDUALS;
    use crate::certificate::residuals;
    use crate::problem::{ContactProblem, Solution};
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn every_residual_and_every_norm_that_is_shown_is_explained_with_its_unit() {
        let problem =
            ContactProblem::new(DMatrix::identity(2, 2), DVector::zeros(2)).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        let found = residuals(&problem, &Solution::new("", DVector::zeros(2), DVector::zeros(2), 0)).unwrap();
        let shown = found.judged.entries().map(|(name, _, unit)| (name, unit)).into_iter();
        for (name, unit) in shown.chain(found.norms().map(|(name, _, unit)| (name, unit))) {
            let is_its = |line: &&str| line.split("  ").any(|part| part.split(", ").any(|word| word == name));
            let line = RESIDUALS.lines().find(is_its).unwrap_or_else(|| panic!("{name} is not explained"));
            assert!(line.contains(&format!("[{unit}]")), "{name}: {line}");
        }
    }
}
