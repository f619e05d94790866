//! Family 1: the Delassus operator is symmetric positive semidefinite.
