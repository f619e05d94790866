//! Named scenes and `scene/1` files, turned into mechanisms.
