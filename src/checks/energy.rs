//! Family 5: the energy ratio e² of an impact.
