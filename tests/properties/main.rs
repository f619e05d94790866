//! The six property families, on random cases; `PROPTEST_CASES` sets how many.

mod cone_projection;
mod convergence;
mod delassus;
mod energy;
mod stewart_trinkle;
mod zeno;

/// `default` cases unless `PROPTEST_CASES` is set; nothing is written to disk.
fn cases(default: u32) -> proptest::test_runner::Config {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|count| count.parse().ok());
    proptest::test_runner::Config { cases: asked.unwrap_or(default), failure_persistence: None, ..Default::default() }
}
