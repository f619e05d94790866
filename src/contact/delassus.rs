//! The Delassus operator W = H M⁻¹ Hᵀ.
