//! Family 2: the Stewart–Trinkle matrix is copositive, and copositive-plus only without friction.
