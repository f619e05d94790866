//! Property family `cone_projection`.
