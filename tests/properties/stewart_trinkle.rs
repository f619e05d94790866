//! Property family `stewart_trinkle`.
