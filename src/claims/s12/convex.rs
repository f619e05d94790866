//! Claims of §12 on exercise 3: the worked example as a convex program, and a tangential direction beside it.

use crate::Result;
use crate::checks::Finding;
use crate::claims::s5::planar_step::Block;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::problem::{Law, Lcp};
use crate::scalar::{Rational, ratio};
use crate::solvers::lemke::solution;
use nalgebra::{DMatrix, DVector};

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[Claim {
    id: "S12.ex3",
    statement: "In one dimension without friction the convex QP of Anitescu is equivalent to the LCP; with a tangential direction \
        (friction, horizontal initial velocity) LCP and relaxation begin to differ by an O(h) gliding.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Exact,
    correct_statement: "The one-dimensional QP and LCP have the same solution. With friction they differ only while the contact slides, by \
        the gap μh|v_t|; they agree where it sticks.",
    argument: "QP: min ½P² − 1.585 P over P ≥ 0 has the minimiser max(0, 1.585) = 317/200, which is the solution of the LCP 0 ≤ P ⟂ P − \
        317/200 ≥ 0 of the chapter's contact step. On the 3-4-5 slope, h = 1/200: with μ = 1 both laws give v = 0; with μ = 1/2 \
               Coulomb slides at φ = 0 and the relaxed step at φ = μ h v_t exactly.",
    control: "Coulomb's step in place of the relaxed one: it has no gap.",
    sources: &["chapter §12, exercise 3"],
    check: exercise,
}];

fn exercise(reading: Reading) -> Result<Vec<Finding>> {
    let free = ratio(-317, 200);
    let lcp = Lcp::new(DMatrix::from_element(1, 1, ratio(1, 1)), DVector::from_element(1, free.clone()));
    let by_lcp = solution(&lcp)?[0].clone();
    // ½P² + fP = ½(P + f)² − ½f²: smaller nowhere on P ≥ 0 than at the LCP's solution
    let objective = |p: &Rational| ratio(1, 2) * p.clone() * p.clone() + free.clone() * p.clone();
    let better = (0..400).filter(|&k| objective(&ratio(k, 100)) < objective(&by_lcp)).count();
    let h = ratio(1, 200);
    let slope = |law: Law, friction: Rational| -> Result<Block> {
        let mut block = Block { law, ..Block::at_rest(friction) };
        block.steps(25, &h)?;
        Ok(block)
    };
    let relaxed = slope(reading.pick(Law::Associated, Law::Coulomb), ratio(1, 2))?;
    let exact = slope(Law::Coulomb, ratio(1, 2))?;
    let sticking = [slope(Law::Associated, ratio(1, 1))?, slope(Law::Coulomb, ratio(1, 1))?];
    let own_gap = ratio(1, 2) * h.clone() * relaxed.velocity[1].clone();
    Ok(vec![
        Finding::exact("P of the LCP", &by_lcp, &ratio(317, 200), "N·s"),
        Finding::count("points of a grid on P ≥ 0 with a smaller objective", better, 0),
        Finding::exact("φ/(μ h v_t) of the relaxed slide", &(relaxed.gap / own_gap), &ratio(1, 1), "1"),
        Finding::exact("φ of Coulomb's slide", &exact.gap, &ratio(0, 1), "m"),
        Finding::decision("both stick with μ = 1", sticking.iter().all(|block| block.velocity == [ratio(0, 1), ratio(0, 1)]), true),
    ])
}
