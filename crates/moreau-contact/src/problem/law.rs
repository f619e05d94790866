//! The contact law of a problem: which cone, and what complements what.

/// Relation between the impulse r and the law's velocity y = u + shift + R r, per contact, with
/// K_μ = {‖r_t‖ ≤ μ r_n} and its dual K_μ* = {y_n ≥ μ‖y_t‖}.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Law {
    /// 0 ≤ y_n ⟂ r_n ≥ 0, r_t = 0.
    Frictionless,
    /// K_μ ∋ r ⟂ y + μ‖y_t‖n ∈ K_μ* (Signorini–Coulomb in de Saxcé's form; not convex).
    Coulomb,
    /// K_μ ∋ r ⟂ y ∈ K_μ* (the cone complementarity problem; convex).
    Associated,
    /// Stewart–Trinkle: friction along d directions, an LCP in (λ, β, σ).
    PolyhedralCoulomb {
        /// Number d of friction directions, direction j at angle 2πj/d from tangent₁; 2 in 2D.
        directions: usize,
    },
    /// f ≥ 0 along the d edges n + μ dⱼ of a polyhedral cone, 0 ≤ f ⟂ y_edge ≥ 0 (convex).
    PolyhedralAssociated {
        /// Number d of edges, edge j at angle 2πj/d from tangent₁; 2 in 2D.
        directions: usize,
    },
}

impl Law {
    /// The name used in files and messages.
    pub fn name(self) -> &'static str {
        match self {
            Law::Frictionless => "frictionless",
            Law::Coulomb => "coulomb",
            Law::Associated => "associated",
            Law::PolyhedralCoulomb { .. } => "polyhedral-coulomb",
            Law::PolyhedralAssociated { .. } => "polyhedral-associated",
        }
    }

    /// Whether the law is that of a convex program: no friction, or one of the associated laws.
    pub fn is_convex(self) -> bool {
        matches!(self, Law::Frictionless | Law::Associated | Law::PolyhedralAssociated { .. })
    }

    /// μ of the cone that the law uses: 0 without friction.
    pub fn cone_friction(self, friction: f64) -> f64 {
        if self == Law::Frictionless { 0.0 } else { friction }
    }

    /// The number of directions of a polyhedral law.
    pub fn directions(self) -> Option<usize> {
        match self {
            Law::PolyhedralCoulomb { directions } | Law::PolyhedralAssociated { directions } => Some(directions),
            _ => None,
        }
    }
}
