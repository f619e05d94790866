//! The six property families, on random cases; `PROPTEST_CASES` sets how many.

mod cone_projection;
mod convergence;
mod delassus;
mod energy;
mod stewart_trinkle;
mod zeno;
