//! Property family `convergence`.
