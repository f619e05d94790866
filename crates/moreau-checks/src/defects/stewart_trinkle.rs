//! Planted defects of the family `stewart_trinkle`: four ways to write the LCP down wrongly.

use crate::finding::Finding;
use crate::planted::{Beside, Kind, Planted};
use crate::stewart_trinkle::{Assembly, RationalStep, chapter_example, decisions, identity, reduced, reference, solvability, wedge};
use moreau_contact::problem::{Lcp, stewart_trinkle};
use moreau_exact::Result;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::DVector;

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[
    Planted {
        name: "stewart-trinkle/cone-row-reversed",
        mistake: "the last row reads (−μ, Eᵀ) instead of (μ, −Eᵀ): friction is asked to exceed its bound",
        kind: Kind::Assembly,
        subject: Beside { check: "properties/stewart-trinkle", defective: || family(cone_row_reversed), reference: || family(reference) },
    },
    Planted {
        name: "stewart-trinkle/symmetric-blocks",
        mistake: "the matrix is written [[W̃, b], [bᵀ, 0]] with b = (0, E), as in the chapter's proof",
        kind: Kind::Assembly,
        subject: Beside { check: "properties/stewart-trinkle", defective: || family(symmetric_blocks), reference: || family(reference) },
    },
    Planted {
        name: "stewart-trinkle/gap-times-step",
        mistake: "the gap enters as φ·h instead of φ/h",
        kind: Kind::Assembly,
        subject: Beside { check: "properties/stewart-trinkle", defective: || family(gap_times_step), reference: || family(reference) },
    },
    Planted {
        name: "stewart-trinkle/friction-forgotten",
        mistake: "μ is missing from the last row, so no friction is ever allowed",
        kind: Kind::Assembly,
        subject: Beside { check: "properties/stewart-trinkle", defective: || family(friction_forgotten), reference: || family(reference) },
    },
];

/// The findings of the whole family of checks on three systems: a contact that slides before it touches, one that penetrates at rest, and a
/// point between two walls.
fn family(assembly: Assembly) -> Result<Vec<Finding>> {
    let systems = [
        chapter_example(ratio(1, 100), [ratio(2, 1), ratio(-1, 1)]),
        chapter_example(ratio(-1, 100), [ratio(0, 1), ratio(0, 1)]),
        wedge(ratio(1, 2)),
    ];
    let mut findings = Vec::new();
    for system in &systems {
        let size = system.unknowns();
        let points = [DVector::from_element(size, ratio(1, 1)), DVector::from_fn(size, |i, _| ratio(i as i64, 3))];
        findings.extend(identity(system, assembly, &points)?);
        findings.extend(decisions(system, assembly)?);
        findings.extend(solvability(system, assembly)?);
    }
    Ok(findings)
}

/// The last rows and columns of the reference, changed entry by entry.
fn changed(system: &RationalStep, change: impl Fn(usize, usize, Rational) -> Rational) -> Result<Lcp<Rational>> {
    let lcp = reference(system)?;
    let first_sigma = system.sigma(0);
    let matrix = lcp.matrix.map_with_location(|i, j, x| if i >= first_sigma { change(i, j, x) } else { x });
    Ok(Lcp::new(matrix, lcp.vector))
}

fn cone_row_reversed(system: &RationalStep) -> Result<Lcp<Rational>> {
    changed(system, |_, _, x| -x)
}

fn symmetric_blocks(system: &RationalStep) -> Result<Lcp<Rational>> {
    let columns = reference(system)?.matrix.transpose();
    changed(system, |i, j, _| columns[(i, j)].clone())
}

fn friction_forgotten(system: &RationalStep) -> Result<Lcp<Rational>> {
    changed(system, |_, j, x| if j < system.contacts() { ratio(0, 1) } else { x })
}

fn gap_times_step(system: &RationalStep) -> Result<Lcp<Rational>> {
    let mut wrong = system.clone();
    for gap in &mut wrong.gap {
        *gap = gap.clone() * &system.step * &system.step;
    }
    let (reduced, velocity) = reduced(&wrong)?;
    Ok(stewart_trinkle::lcp(&reduced, &system.friction, &velocity))
}
