//! Property family `zeno`.
