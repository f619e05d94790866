//! Property family `delassus`.
