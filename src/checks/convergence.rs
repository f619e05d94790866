//! Family 6: convergence as h → 0.
