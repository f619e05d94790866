//! What is looked up of literature: records, the identifier of a paper, and how others cite one.

use super::query::{Query, Sici};
use super::release::{ANITESCU, STEWART_TRINKLE, SURVEY};
use super::row::{Instead, LookUp, Wanted};

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new("S0.siamrev", "printed volume, against the record", SURVEY, Query::Printed(42), Wanted::At(&["volume"]))
        .controls(&[Instead::Under(0, SURVEY, Query::Printed(43))]),
    LookUp::new("S0.siamrev", "printed page, against the first page in the record", SURVEY, Query::Printed(3), Wanted::At(&["first_page"]))
        .controls(&[Instead::Under(1, SURVEY, Query::Printed(1))]),
    LookUp::new("S0.siamrev", "printed year, against the record", SURVEY, Query::Printed(2000), Wanted::At(&["year"]))
        .controls(&[Instead::Always(SURVEY, Query::Printed(2001))]),
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
