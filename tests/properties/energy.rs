//! Property family `energy`.
