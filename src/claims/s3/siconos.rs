//! Where the chapter sends its reader: Siconos's sources and the literature they cite.

use crate::claims::experiments::siconos::{Facts, version};
use crate::claims::prelude::*;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.siconos-path",
        statement: "Siconos's MoreauJeanOSI implements the θ-scheme in kernel/src/simulationTools/MoreauJeanOSI.cpp; for positions it has \
            CombinedProjectedMoreauJeanOSI.",
        verdict: ClaimVerdict::False,
        kind: Kind::Path,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Cited,
        correct_statement: "The class with projection is MoreauJeanCombinedProjectionOSI. The path is right for release 4.4.0; the \
            development version has since moved it to kernel/src/simulation/ (commit ee174c26f, February 2026).",
        argument: "Debian's packages 4.4.0+dfsg-2: the library was compiled from the path named; there is a header \
            MoreauJeanCombinedProjectionOSI.hpp and none of the other name. What the scheme does is held against ours step by step \
            (tests/references, siconos).",
        controls: &["The name of the class in the release."],
        sources: &[
            "chapter §3, Moreau–Jean in engineering, and pitfall on drift",
            "Siconos 4.4.0 in Debian; github.com/siconos/siconos at 6070f0f6",
        ],
        check: path,
    },
    Claim {
        id: "S3.cmame",
        statement: "Moreau (CMAME 177, 1999, 329–349) and Jean (CMAME 177, 1999, 235–257) are the founding analyses of convergence of \
            these schemes.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "The two papers stand at these pages, as “Numerical aspects of the sweeping process” and “The non smooth \
            contact dynamics method”. Neither was read here; by their titles they present methods, and proofs of convergence are usually \
            cited from Monteiro Marques 1993, Mabrouk 1998 and Paoli and Schatzman.",
        argument: "Both titles and page ranges stand in the bibliography of Siconos's own header MoreauJeanOSI.hpp.",
        controls: &["The page ranges exchanged with those of volume 256."],
        sources: &["chapter §3", "Siconos 4.4.0, MoreauJeanOSI.hpp"],
        check: founding_papers,
    },
    Claim {
        id: "S3.ab-chapters",
        statement: "Acary and Brogliato 2008 (Springer LNACM 35), chapters 9–10, is the encyclopaedia of nonsmooth time-stepping for \
            engineers.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "The book exists, as volume 35 of that series, and Siconos refers to it for review. Which chapters: the text \
            itself says 9–10 here and 7–11 in its reading list; the one range lies within the other. The book's table of contents was not \
            at hand.",
        argument: "The bibliography of Siconos's headers names the volume; chapters 9 to 10 ⊂ 7 to 11.",
        controls: &["The reading list cut to chapters 7–9, which would contradict."],
        sources: &["chapter §3, Moreau–Jean in engineering; reading list", "Siconos 4.4.0, MoreauJeanOSI.hpp"],
        check: chapters,
    },
];

fn path(reading: Reading) -> Result<Vec<Finding>> {
    let facts = Facts::stored()?;
    let class = reading.pick("CombinedProjectedMoreauJeanOSI", "MoreauJeanCombinedProjectionOSI");
    let other = "MoreauJeanCombinedProjectionOSI";
    Ok(vec![
        Finding::decision("4.4.0 has a class of the printed name", facts.has(class), false).says(true),
        Finding::decision("compiled from the printed path", facts.compiled("kernel/src/simulationTools/MoreauJeanOSI.cpp"), true),
        Finding::decision("the facts are those of 4.4.0", version()?.starts_with("4.4.0"), true),
        Finding::decision("4.4.0 has MoreauJeanCombinedProjectionOSI", facts.has(other), true).context(),
    ])
}

fn founding_papers(reading: Reading) -> Result<Vec<Finding>> {
    let facts = Facts::stored()?;
    let pages = reading.pick("177:329–349, 1999", "256:329–349, 1999");
    Ok(vec![
        Finding::decision("Moreau's pages are cited", facts.cites(pages), true),
        Finding::decision("Jean's pages are cited", facts.cites("177:235–257, 1999"), true),
        Finding::decision("Moreau's title", facts.cites("Numerical aspects of the sweeping process"), true),
        Finding::decision("Jean's title", facts.cites("The non smooth contact dynamics method"), true),
        Finding::decision("a title that names convergence", facts.cites("onvergence"), false)
            .says(true)
            .opinion("which papers found the analysis of convergence"),
    ])
}

fn chapters(reading: Reading) -> Result<Vec<Finding>> {
    let list = 7..=reading.pick(11, 9);
    Ok(vec![
        Finding::decision("chapters 9–10 lie in the reading list's range", (9..=10).all(|chapter| list.contains(&chapter)), true)
            .opinion("what is an encyclopaedia"),
        Finding::decision("Siconos cites volume 35 of the series", Facts::stored()?.cites("volume 35 of Lecture Notes"), true),
    ])
}
