//! What is looked up of literature: records, the identifier of a paper, and how others cite one.

use super::query::{Query, Sici};
use super::release::{ANITESCU, STEWART_TRINKLE, SURVEY};
use super::row::{Instead, LookUp, Wanted};

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new("S0.siamrev", "volume", SURVEY, Query::Count(&["volume"]), Wanted::Count(42))
        .controls(&[Instead::Always(ANITESCU, Query::Count(&["volume"]))]),
    LookUp::new("S0.siamrev", "first page", SURVEY, Query::Count(&["first_page"]), Wanted::Count(3))
        .controls(&[Instead::Always(ANITESCU, Query::Count(&["first_page"]))]),
    LookUp::new("S0.siamrev", "year", SURVEY, Query::Count(&["year"]), Wanted::Count(2000))
        .controls(&[Instead::Always(ANITESCU, Query::Count(&["year"]))]),
    LookUp::new("S4.cites", "the SICI's check character agrees", STEWART_TRINKLE, Query::Sici(Sici::Agrees, &[]), Wanted::Decision(true))
        .controls(&[
            Instead::Under(0, STEWART_TRINKLE, Query::Sici(Sici::Agrees, &[["<2673", "<2763"]])),
            Instead::Under(1, STEWART_TRINKLE, Query::Sici(Sici::Agrees, &[[")39:", ")93:"], ["0207(", "0270("]])),
        ]),
    LookUp::new("S4.cites", "its volume", STEWART_TRINKLE, Query::Sici(Sici::Volume, &[]), Wanted::Count(39)).controls(&[Instead::Under(
        1,
        STEWART_TRINKLE,
        Query::Sici(Sici::Volume, &[[")39:", ")93:"]]),
    )]),
    LookUp::new("S4.cites", "its first page", STEWART_TRINKLE, Query::Sici(Sici::Page, &[]), Wanted::Count(2673))
        .controls(&[Instead::Under(0, STEWART_TRINKLE, Query::Sici(Sici::Page, &[["<2673", "<2763"]]))]),
    LookUp::new("S4.cites", "the ISSN's check digit agrees", STEWART_TRINKLE, Query::Sici(Sici::Issn, &[]), Wanted::Decision(true))
        .controls(&[Instead::Under(1, STEWART_TRINKLE, Query::Sici(Sici::Issn, &[["0207(", "0270("]]))]),
    LookUp::new(
        "S5.cite",
        "records, of two, with this year, volume and page",
        ANITESCU,
        Query::Numbered(&["cited_as"], &["2006", "105", "113"]),
        Wanted::Count(2),
    )
    .controls(&[Instead::Always(ANITESCU, Query::Numbered(&["cited_as"], &["2006", "105", "131"]))]),
];
