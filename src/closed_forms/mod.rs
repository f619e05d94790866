//! Exact solutions of mechanical problems; nothing here imports what it verifies.
