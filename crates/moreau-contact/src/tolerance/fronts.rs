//! Settings of the elimination by fronts; none bounds a result.

/// Columns of a front that are eliminated before the rest of it is updated: a panel of them stays in the nearest cache while the product
/// that follows is large enough for the blocked kernel.
/// Set.
pub const PANEL: usize = 24;

/// Columns of a panel that are eliminated one by one before the rest of it is updated by all of them in one pass.
/// Set.
pub const COLUMNS: usize = 4;

/// Columns that one product updates: the triangle above the diagonal that is computed in vain is this wide.
/// Set.
pub const STRIP: usize = 48;

/// Terms and entries from which a product is left to the blocked kernel; below, its packing costs more than the product.
/// Set.
pub const SMALL_PRODUCT: (usize, usize) = (8, 256);

/// Two fronts become one if at most this share of its pivot columns is then stored in vain: an eighth.
/// Set.
pub const VAIN: usize = 8;

/// Narrow fronts become one if at most this share is stored in vain, a third, up to so many pivot columns: their overhead is larger.
/// Set.
pub const NARROW: (usize, usize) = (3, 24);

/// Rows from which a front is left to faer's kernels, where they are compiled in; below, ours are as fast, and 36 rows are no gain.
/// Set.
#[cfg(feature = "faer")]
pub const WIDE: usize = 48;

/// Pivots that faer's kernels eliminate between two looks at the watch: some hundredths of a second in a front of 10⁴ rows.
/// Set.
#[cfg(feature = "faer")]
pub const BETWEEN_LOOKS: usize = 128;

/// Contacts that are eliminated in one front, whichever of them meet: a dense factor of 24 rows takes some 5 µs, as much as an order of
/// elimination for eight contacts.
/// Set.
pub const ONE_FRONT: usize = 8;

/// Entries that all children leave to their parents, 2²⁰, up to which they are kept for another matrix; beyond, they are freed as soon as
/// the parent has them.
/// Set.
pub const KEPT: usize = 1 << 20;
