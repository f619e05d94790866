//! Family 3: projection on the friction cone.
