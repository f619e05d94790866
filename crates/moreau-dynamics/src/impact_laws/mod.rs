//! Impact laws: which impulses P a collision transfers, one law per file.
//!
//! ```text
//!     U⁺ = U⁻ + W P ,     ΔT = ½ Pᵀ(U⁺ + U⁻) ,     W = H M⁻¹ Hᵀ
//! ```
//! An impact is a [`PlanarProblem`](moreau_contact::problem::PlanarProblem) whose velocities are U⁻; what comes of it is a
//! [`Response`](moreau_contact::problem::Response).
//!
//! | law | what it prescribes |
//! |---|---|
//! | [`newton`] | U_n⁺ = −e U_n⁻, in three readings: all contacts together, each as if alone, along Routh's path |
//! | [`poisson`] | restitution impulse = e · compression impulse, by two complementarity problems or along Routh's path |
//! | [`stronge`] | work of the normal impulse in restitution = −e² · that in compression, along Routh's path |
//! | [`moreau`] | −P ∈ N(U⁺ + e U⁻), e on the normal component or on the whole vector |
//! | [`fremond`] | Coulomb's law on the mean of the tangential velocities before and after |
//! | [`sequential`] | Newton's law at one approaching contact after the other |
//! | [`energy_projection`] | the velocities of another law, moved to the nearest ones that neither penetrate nor gain energy |
//!
//! [`routh`] follows one planar contact through slip and stick while its normal impulse grows.

pub mod energy_projection;
pub mod fremond;
mod impact;
pub mod moreau;
pub mod newton;
pub mod poisson;
pub mod routh;
pub mod sequential;
pub mod stronge;

#[cfg(test)]
mod tests;
