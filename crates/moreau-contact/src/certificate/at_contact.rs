//! One contact at an answer, and its residuals.

use super::part::Part;
use super::reach::Reach;
use super::scales::{at_least, at_most};
pub(super) use moreau_exact::number::larger as worst;

/// The residuals of one contact, in the order of [`Judged::entries`] without the velocity.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AtContact {
    pub primal: Part,
    pub dual: Part,
    pub complementarity: Part,
    pub normal: Part,
    pub tangential: Part,
}

impl AtContact {
    /// Of each residual the worse one.
    pub fn worse(self, other: AtContact) -> AtContact {
        AtContact {
            primal: self.primal.worse(other.primal),
            dual: self.dual.worse(other.dual),
            complementarity: self.complementarity.worse(other.complementarity),
            normal: self.normal.worse(other.normal),
            tangential: self.tangential.worse(other.tangential),
        }
    }
}

/// One contact at an answer: its numbers, weights and scales.
#[derive(Default)]
pub(super) struct Here<'a> {
    pub contact: usize,
    pub friction: f64,
    /// 1/√(1 + μ²) with the μ of the cone.
    pub steepness: f64,
    pub r: &'a [f64],
    pub y: &'a [f64],
    /// ρ_n, ρ_t \[kg\].
    pub weights: [f64; 2],
    /// s_n, s_r, s_t \[N·s\].
    pub sizes: [f64; 3],
    /// The scale of r_n and its rounding \[N·s\].
    pub impulse: [f64; 2],
    /// The largest scale of an impulse that moves this contact along the normal, and along the tangents \[N·s\].
    pub most: [f64; 2],
    /// Rounding of y_n and of y_t \[m/s\].
    pub floors: [f64; 2],
    /// How far its impulses reach; nothing where that is not asked.
    pub reach: Option<&'a Reach<'a>>,
}

impl Here<'_> {
    /// A part (n, t₁, t₂) of the impulse that counts as none, by what it moves at other contacts; all of it, `is_whole`, or a part beside
    /// which the contact stays closed. \[N·s\]
    pub fn reach(&self, taken: impl FnOnce() -> [f64; 3], is_whole: bool) -> Part {
        self.reach.map_or_else(Part::default, |reach| reach.of(self.contact, &taken()[..self.r.len()], is_whole))
    }

    /// The scale of a friction impulse where the contact slides: μ s_r, or s_r if μ is zero; where μ > 1 not more than the larger of s_r
    /// and s_t. For then friction is a size of its own: at μ = 10⁸ it may be all that holds the contact, while r_n is 10⁻⁸ of it.
    pub fn friction_scale(&self, mu: f64) -> f64 {
        let [_, s_r, s_t] = self.sizes;
        if mu > 0.0 { at_most(mu * s_r, at_least(s_r, s_t)) } else { s_r }
    }
}

/// (n, t₁, t₂) of an impulse, zero where a contact has no such row \[N·s\].
pub(super) fn in_space(impulse: &[f64]) -> [f64; 3] {
    std::array::from_fn(|row| impulse.get(row).copied().unwrap_or(0.0))
}
