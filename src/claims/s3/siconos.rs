//! Where the chapter sends its reader: Siconos's sources and the literature they cite.

use crate::claims::experiments::siconos::{Facts, version};
use crate::claims::lookups::{self, looked_up};
use crate::claims::prelude::*;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.siconos-path",
        statement: r"Siconos's MoreauJeanOSI implements the $\theta$-scheme fully, in kernel/src/simulationTools/MoreauJeanOSI.cpp;
            against drift there is a position projection such as CombinedProjectedMoreauJeanOSI (§ on sources: files may move from version
            to version).",
        verdict: ClaimVerdict::False,
        kind: Kind::Path,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Cited,
        correct_statement: "The class with projection is MoreauJeanCombinedProjectionOSI. The path is right for release 4.4.0; the \
            development version has since moved it to kernel/src/simulation/ (commit ee174c26f, February 2026).",
        argument: "Debian's packages 4.4.0+dfsg-2: the library was compiled from the path named; there is a header \
            MoreauJeanCombinedProjectionOSI.hpp and none of the other name. What the scheme does is held against ours step by step \
            (tests/references, siconos).",
        controls: &["The name of the class in the release.", "The folder of the development version."],
        sources: &[
            "chapter §3, Moreau–Jean in engineering, and pitfall on drift",
            "Siconos 4.4.0 in Debian; github.com/siconos/siconos at 6070f0f6",
        ],
        check: check!(path),
    },
    Claim {
        id: "S3.cmame",
        statement: "Moreau (CMAME 177, 1999) and Jean (CMAME 177, 1999) each gave founding papers of the convergence analysis.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "The two papers stand in that volume, as “Numerical aspects of the sweeping process” and “The non smooth \
            contact dynamics method”. Neither was read here; by their titles they present methods, and proofs of convergence are usually \
            cited from Monteiro Marques 1993, Mabrouk 1998 and Paoli and Schatzman. Whether a paper that presents the method founds its \
            analysis is a matter of opinion.",
        argument: "Both titles, the volume and the year stand in the bibliography of Siconos's own header MoreauJeanOSI.hpp.",
        controls: &["Volume 167 in place of 177, and the titles as they would be if they named what the text says of them."],
        sources: &["chapter §3", "Siconos 4.4.0, MoreauJeanOSI.hpp"],
        check: looked_up!("S3.cmame"),
    },
    Claim {
        id: "S3.ab-chapters",
        statement: "This section is what one must know to read Acary and Brogliato 2008 (Springer LNACM 35), chapters 9–10; that is the \
            “engineer's encyclopaedia” of nonsmooth time-stepping.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "The book exists, as volume 35 of that series, and Siconos refers to it for review. Its table of contents was \
            not at hand, and what is an encyclopaedia is a matter of opinion.",
        argument: "The bibliography of Siconos's headers names the volume of the series.",
        controls: &["Volume 53 in place of 35."],
        sources: &["chapter §3, Moreau–Jean in engineering", "Siconos 4.4.0, MoreauJeanOSI.hpp"],
        check: looked_up!("S3.ab-chapters"),
    },
];

fn path(reading: Reading) -> Result<Vec<Finding>> {
    let facts = Facts::stored()?;
    let other = "MoreauJeanCombinedProjectionOSI";
    let mut findings = lookups::check("S3.siconos-path", reading)?;
    findings.extend([
        Finding::decision("the facts are those of 4.4.0", version()?.starts_with("4.4.0"), true).context(),
        Finding::decision("4.4.0 has MoreauJeanCombinedProjectionOSI", facts.has(other), true).context(),
    ]);
    Ok(findings)
}
