//! §4, the papers it rests on: where they are, and what “the first proof” can mean.

use super::matrices::{chapter_matrix, integers, reversed};
use crate::certificate::copositivity::copositive;
use crate::certificate::definiteness::quadratic_form;
use crate::checks::stewart_trinkle::{RationalStep, chapter_example, reference, wedge};
use crate::claims::lookups::{self, looked_up};
use crate::claims::prelude::*;
use crate::solvers::lemke::{LemkeOutcome, lemke};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.cites",
        statement: "Stewart and Trinkle, IJNME 39:2673 (1996); Anitescu and Potra, Nonlinear Dynamics 14:231 (1997); Stewart, ARMA 145:215 \
            (1998).",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated, volume and first page: 39 (15), 2673–2691; 14 (3), 231–247; 145 (3), 215–260.",
        argument: "The first paper's DOI contains its SICI, which names volume 39 and page 2673 and ends in a check character that agrees \
            with them (mod 37); so does the ISSN in it (mod 11). The other two DOIs carry neither volume nor page: for them the reference \
            lists of other papers agree with the chapter, two for each.",
        controls: &[
            "Page 2763, two digits exchanged: the check character is another.",
            "Volume 93, and an ISSN with two digits exchanged.",
        ],
        sources: &[
            "chapter §4, and the list of papers at its end",
            "doi:10.1002/(SICI)1097-0207(19960815)39:15<2673::AID-NME972>3.0.CO;2-I; doi:10.1023/A:1008292328909; \
                doi:10.1007/s002050050129",
        ],
        check: looked_up!("S4.cites"),
    },
    Claim {
        id: "S4.drake-name",
        statement: "Early Drake (TimeSteppingRigidBodyPlant) derives from Stewart and Trinkle.",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated of the form: a class of that name existed from September 2017 to April 2018, in multibody/dev; its \
            solver's documentation displays the matrix of Stewart and Trinkle, block by block, over a polygonal cone, with Lemke's \
            method. That documentation does not name their paper. The pinned release does not know the class any more.",
        argument: r"Drake's repository: added by commit 0e218d926b, removed by fc428c0fa2. multibody/constraint/constraint_solver.h
            (commit 03b888e8ed), which the class calls, has the blocks $(N\,C\,N^T, N\,C\,D^T, 0; D\,C\,N^T, D\,C\,D^T, E; \mu, -E^T, 0)$,
            $C = M^{-1}$: for a wedge of two contacts every entry is that of the LCP here. The documentation of the plant's module in
            1.51.1 does not have the name.",
        controls: &[
            "The name of the present plant, which is not early Drake's.",
            "The LCP with the sign of its rows of the friction cone wrong.",
        ],
        sources: &["chapter §4, motivation", "Drake 1.51.1 (references/facts/drake.json); its repository and its history"],
        check: check!(early_drake),
    },
    Claim {
        id: "S4.first-proof",
        statement: "Anitescu and Potra's is the first proof of solvability that does not need the matrix of the complementarity problem to \
            be positive definite.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Who was first is not decided here; Pang and Trinkle had existence results for several bodies with Coulomb \
            friction in print a year before. What the sentence says of the matrix is so: it is not even semidefinite, it is copositive, \
            and Lemke's method solves the step.",
        argument: r"The chapter's example, $\mu = 1/2$: $x^TMx = -1$ at $x = (1, 0, 0, -4)$, since the quadratic form holds
            $\mu\,\lambda\,\sigma$; copositive, decided exactly; a closing contact is solved by Lemke in rationals.",
        controls: &[
            r"$\mu = 0$, where the form is that of the Delassus operator, $1 \ge 0$ at this $x$.",
            r"The last row with reversed sign, $(-\mu, E^T)$.",
        ],
        sources: &[
            "chapter §4, essential insight on copositive-plus",
            "Pang and Trinkle, Math. Program. 73 (1996) 199, for the title and year",
        ],
        check: check!(not_definite),
    },
];

fn early_drake(reading: Reading) -> Result<Vec<Finding>> {
    let system = wedge(ratio(1, 2));
    let lcp = reference(&system)?.matrix;
    let ours = reading.only(1).pick(lcp.clone(), reversed(lcp, system.contacts()));
    let theirs = matrix_of_early_drake(&system);
    let differing = ours.iter().zip(theirs.iter()).filter(|(ours, theirs)| ours != theirs).count();
    let mut findings = lookups::check("S4.drake-name", reading)?;
    findings.push(Finding::count("entries of its documented LCP that differ from Stewart and Trinkle's", differing, 0).looked_up());
    Ok(findings)
}

/// The matrix in the documentation of the solver of that class, with C = M⁻¹:
/// (N C Nᵀ, N C Dᵀ, 0; D C Nᵀ, D C Dᵀ, E; μ, −Eᵀ, 0).
fn matrix_of_early_drake(system: &RationalStep) -> DMatrix<Rational> {
    let (contacts, d) = (system.contacts(), system.directions.len());
    let normals = (0..contacts).map(|i| system.normal(i));
    let tangents = (0..contacts).flat_map(|i| (0..d).map(move |j| system.direction(i, j)));
    let rows: Vec<DVector<Rational>> = normals.chain(tangents).collect();
    let impulses = rows.len();
    let contact_of = |beta: usize| (beta - contacts) / d;
    DMatrix::from_fn(system.unknowns(), system.unknowns(), |i, j| match (i < impulses, j < impulses) {
        (true, true) => rows[i].component_div(&system.mass).dot(&rows[j]),
        (true, false) => ratio(i64::from(i >= contacts && contact_of(i) == j - impulses), 1),
        (false, true) if j < contacts => {
            if i - impulses == j {
                system.friction[j].clone()
            } else {
                ratio(0, 1)
            }
        }
        (false, true) => ratio(-i64::from(contact_of(j) == i - impulses), 1),
        (false, false) => ratio(0, 1),
    })
}

fn not_definite(reading: Reading) -> Result<Vec<Finding>> {
    let printed = |matrix: DMatrix<Rational>| reading.only(1).pick(matrix.clone(), reversed(matrix, 1));
    let mut matrix = printed(chapter_matrix()?);
    if reading.only(0).is_control() {
        matrix[(3, 0)] = ratio(0, 1);
    }
    let mut closing = reference(&chapter_example(ratio(0, 1), [ratio(0, 1), ratio(-1, 1)]))?;
    closing.matrix = printed(closing.matrix);
    let covering = DVector::from_element(closing.size(), ratio(1, 1));
    let solved = matches!(lemke(&closing, &covering)?, LemkeOutcome::Solution { .. });
    Ok(vec![
        Finding::exact("xᵀMx at x = (1, 0, 0, −4)", &quadratic_form(&matrix, &integers(&[1, 0, 0, -4])), &ratio(-1, 1), "J")
            .opinion("who was first"),
        Finding::decision("copositive", copositive(&matrix)?.holds(), true),
        Finding::decision("Lemke solves a closing contact", solved, true),
    ])
}
