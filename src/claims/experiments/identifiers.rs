//! Identifiers of the literature that carry a check character: what is mistyped in them does not agree with it.
//!
//! ```text
//!     ISSN   d₁…d₇ c          Σ (9−i) dᵢ + c ≡ 0  (mod 11) ,  c = X for 10
//!     SICI   serial(date)volume:issue<page::title>code-c ,  the characters before c with weights 3, 1, 3, … from the last one on,
//!            digits by value, letters from A = 10, everything else 36:   Σ + c ≡ 0  (mod 37)
//! ```
//!
//! # Source
//! ISO 3297 (ISSN); ANSI/NISO Z39.56 (SICI).

/// The year in a SICI.
pub fn year(sici: &str) -> Option<usize> {
    sici.split_once('(')?.1.get(..4)?.parse().ok()
}

/// Whether the check character of an ISSN agrees with its digits.
pub fn issn_agrees(issn: &str) -> bool {
    let digits: Vec<u32> = issn.chars().filter(|c| *c != '-').map(|c| c.to_digit(10).unwrap_or(10)).collect();
    digits.len() == 8 && digits.iter().zip((1..=8).rev()).map(|(digit, weight)| digit * weight).sum::<u32>().is_multiple_of(11)
}

/// The value of a character of a SICI.
fn value(letter: char) -> u32 {
    letter.to_digit(36).unwrap_or(36)
}

/// Whether the last character of a SICI agrees with the others.
pub fn sici_agrees(sici: &str) -> bool {
    let letters: Vec<char> = sici.chars().collect();
    let Some((check, body)) = letters.split_last() else { return false };
    let sum: u32 = body.iter().rev().enumerate().map(|(k, letter)| value(*letter) * if k % 2 == 0 { 3 } else { 1 }).sum();
    (sum + value(*check)).is_multiple_of(37)
}

/// (volume, first page) of a SICI.
pub fn volume_and_page(sici: &str) -> Option<(u32, u32)> {
    let (_, rest) = sici.split_once(')')?;
    let (volume, rest) = rest.split_once(':')?;
    let (_, rest) = rest.split_once('<')?;
    let (page, _) = rest.split_once("::")?;
    Some((volume.parse().ok()?, page.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_of_the_standards_agree_and_any_changed_digit_does_not() {
        // the example of ISO 3297, and SICIs of other papers
        assert!(issn_agrees("0317-8471") && issn_agrees("1050-124X") && !issn_agrees("0317-8741"));
        for sici in ["0095-4403(199502/03)21:3<12:WATIIB>2.0.TX;2-J", "1097-4571(199806)49:8<693::AID-ASI4>3.0.CO;2-O"] {
            assert!(sici_agrees(sici), "{sici}");
            for (k, letter) in sici.char_indices().filter(|(_, letter)| letter.is_ascii_digit()) {
                let other = if letter == '9' { '0' } else { char::from(letter as u8 + 1) };
                let wrong: String = sici.char_indices().map(|(at, kept)| if at == k { other } else { kept }).collect();
                assert!(!sici_agrees(&wrong), "{wrong}");
            }
        }
        assert_eq!(volume_and_page("1097-4571(199806)49:8<693::AID-ASI4>3.0.CO;2-O"), Some((49, 693)));
    }
}
