//! The one check of everything that is looked up: the findings of a claim from its rows.

use super::query::LookedUp;
use super::row::{Instead, LookUp, Says, Wanted};
use super::{bullet, chrono, drake, literature, mujoco, pinocchio, siconos};
use crate::checks::Finding;
use crate::claims::Reading;
use crate::scalar::ratio;
use crate::{Error, Result};

/// All rows, in the order in which a claim finds them.
const TABLES: [&[LookUp]; 7] = [drake::ROWS, siconos::ROWS, mujoco::ROWS, bullet::ROWS, chrono::ROWS, pinocchio::ROWS, literature::ROWS];

/// Claims that say together what others say one by one: theirs are the rows of these.
const UNIONS: [(&str, &[&str]); 2] = [
    ("V.paths", &["S10.path-siconos", "S10.path-mujoco", "S10.path-drake", "S10.path-pinocchio", "S10.path-bullet", "S10.path-chrono"]),
    ("V.drake", &["S10.drake-default-sap"]),
];

/// The [`crate::claims::CheckFunction`] of a claim all of whose findings are looked up.
macro_rules! looked_up {
    ($claim:literal) => {
        $crate::claims::CheckFunction {
            run: |reading| $crate::claims::lookups::check($claim, reading),
            path: "moreau::claims::lookups::check",
        }
    };
}
pub(crate) use looked_up;

/// The findings of a claim that are looked up.
///
/// # Errors
/// If the stored facts do not have what is asked, or no row is of this claim.
pub fn check(claim: &str, reading: Reading) -> Result<Vec<Finding>> {
    let alone = [claim];
    let claims = UNIONS.iter().find(|(union, _)| *union == claim).map_or(&alone[..], |(_, claims)| claims);
    let rows = claims.iter().flat_map(|claim| TABLES.into_iter().flatten().filter(move |row| row.claim == *claim));
    let findings = rows.map(|row| found(row, reading)).collect::<Result<Vec<_>>>()?;
    if findings.is_empty() { Err(Error::Unsupported(format!("{claim} looks nothing up"))) } else { Ok(findings) }
}

/// The finding of a row.
fn found(row: &LookUp, reading: Reading) -> Result<Finding> {
    let instead = row.controls.iter().find_map(|instead| match *instead {
        Instead::Under(place, of, query) if reading == Reading::Control(place) => Some((of, query)),
        Instead::Always(of, query) if reading.is_control() => Some((of, query)),
        _ => None,
    });
    let (of, query) = instead.unwrap_or((row.of, row.query));
    let name = row.name;
    let unfit = || Error::Unsupported(format!("{}: `{name}` expects what its query does not answer", row.claim));
    let finding = match (query.ask(of)?, row.wanted) {
        (LookedUp::Share { found, of }, Wanted::Decision(wanted)) => Finding::decision(name, found == of, wanted),
        (LookedUp::Share { found, .. } | LookedUp::Count(found), Wanted::Count(wanted)) => Finding::count(name, found, wanted),
        (LookedUp::Number(found), Wanted::At(keys)) => {
            Finding::equal(name, found, super::query::number(&row.of.stated()?, keys)?, 0.0, "1")
        }
        (LookedUp::Number(found), Wanted::Number(wanted, unit)) => Finding::equal(name, found, wanted, 0.0, unit),
        (LookedUp::Fraction(found), Wanted::Fraction(above, below)) => Finding::exact(name, &found, &ratio(above, below), "1"),
        _ => return Err(unfit()),
    };
    Ok(borne(finding.looked_up(), row))
}

/// The finding with what it has to do with the sentence.
fn borne(finding: Finding, row: &LookUp) -> Finding {
    let mut finding = match row.says {
        None => finding,
        Some(Says::Is(number)) => finding.says(number),
        Some(Says::AtLeast(number)) => finding.says_at_least(number),
    };
    finding.bearing.violated = row.violated;
    finding.bearing.voice = row.voice;
    finding.bearing.context = row.beside;
    finding
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::find;

    #[test]
    fn every_row_belongs_to_a_claim_and_every_union_to_claims_with_rows() {
        let rows = || TABLES.into_iter().flatten();
        assert!(rows().all(|row| find(row.claim).is_some()), "{:?}", rows().find(|row| find(row.claim).is_none()));
        for (union, claims) in UNIONS {
            assert!(find(union).is_some() && rows().all(|row| row.claim != union), "{union}");
            assert!(claims.iter().all(|claim| rows().any(|row| row.claim == *claim)), "{union}");
        }
    }

    #[test]
    fn a_control_of_a_row_is_one_of_its_claim() {
        for row in TABLES.into_iter().flatten() {
            let controls = find(row.claim).map_or(0, |claim| claim.controls.len());
            for instead in row.controls {
                assert!(!matches!(instead, Instead::Under(place, ..) if *place >= controls), "{}: {}", row.claim, row.name);
            }
        }
    }

    #[test]
    fn a_claim_without_rows_is_an_error() {
        assert!(check("S1.weakstar", Reading::Recorded).is_err());
    }
}
