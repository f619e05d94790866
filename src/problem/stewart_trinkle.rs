//! The Stewart–Trinkle LCP of a polyhedral Coulomb problem.
