//! Units of declared parameters: products and quotients of `kg`, `m`, `s`, `N`, `rad`, `1` with whole powers.
//!
//! ```text
//! N*s/m  =  kg^1 · m^0 · s^-1
//! ```

use moreau_exact::{Error, Result};

/// The exponents of kilogram, metre and second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    /// Exponent of kg.
    pub mass: i32,
    /// Exponent of m.
    pub length: i32,
    /// Exponent of s.
    pub time: i32,
}

/// The largest power that is read; physical laws of contact have far smaller ones.
const LARGEST_POWER: i32 = 9;

/// Reads a unit; factors are divided and multiplied from left to right, so that `N/m/s` is N/(m·s).
///
/// # Errors
/// [`Error::Invalid`] names the factor that is not understood.
pub fn parse(unit: &str) -> Result<Dimension> {
    let mut dimension = Dimension::default();
    let mut sign = 1;
    let mut rest = unit;
    loop {
        let end = rest.find(['*', '·', '/']).unwrap_or(rest.len());
        let factor = factor(rest[..end].trim()).ok_or_else(|| refuse(unit, &rest[..end]))?;
        dimension.mass += sign * factor.mass;
        dimension.length += sign * factor.length;
        dimension.time += sign * factor.time;
        let Some(operator) = rest[end..].chars().next() else { return Ok(dimension) };
        sign = if operator == '/' { -1 } else { 1 };
        rest = &rest[end + operator.len_utf8()..];
    }
}

/// The factor by which a quantity of this unit grows when all lengths, masses and times grow by these factors.
///
/// # Errors
/// Those of [`parse`].
///
/// ```
/// use moreau_gate::unit::scale;
///
/// // a damping of 2 N·s/m in millimetres and grams: m → 1000 mm, kg → 1000 g
/// assert_eq!(scale("N*s/m", 1000.0, 1000.0, 1.0)?, 1000.0);
/// assert!(scale("furlong", 1.0, 1.0, 1.0).is_err());
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn scale(unit: &str, length: f64, mass: f64, time: f64) -> Result<f64> {
    let exponents = parse(unit)?;
    Ok(length.powi(exponents.length) * mass.powi(exponents.mass) * time.powi(exponents.time))
}

/// A base unit with its power.
fn factor(text: &str) -> Option<Dimension> {
    let (name, power) = match text.split_once('^') {
        Some((name, power)) => (name.trim(), power.trim().parse().ok().filter(|power: &i32| power.abs() <= LARGEST_POWER)?),
        None => (text, 1),
    };
    let base = match name {
        "kg" => Dimension { mass: 1, ..Dimension::default() },
        "m" => Dimension { length: 1, ..Dimension::default() },
        "s" => Dimension { time: 1, ..Dimension::default() },
        "N" => Dimension { mass: 1, length: 1, time: -2 },
        "rad" | "1" => Dimension::default(),
        _ => return None,
    };
    Some(Dimension { mass: power * base.mass, length: power * base.length, time: power * base.time })
}

fn refuse(unit: &str, factor: &str) -> Error {
    let problem = format!("is `{unit}`, in which `{}` is not understood", factor.trim());
    Error::invalid("unit", problem, "use products and quotients of kg, m, s, N, rad and 1 with whole powers, such as N/m or m/s^2")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exponents(unit: &str) -> [i32; 3] {
        let Dimension { mass, length, time } = parse(unit).expect("a unit");
        [mass, length, time]
    }

    #[test]
    fn units_of_contact_laws_have_their_exponents() {
        let cases = [
            ("1", [0, 0, 0]),
            ("rad", [0, 0, 0]),
            ("m", [0, 1, 0]),
            ("1/s", [0, 0, -1]),
            ("m/s^2", [0, 1, -2]),
            ("N", [1, 1, -2]),
            ("N/m", [1, 0, -2]),
            ("N*s/m", [1, 0, -1]),
            ("N·s/m", [1, 0, -1]),
            ("N/m/s", [1, 0, -3]),
            ("kg * m^2", [1, 2, 0]),
            ("s^-1", [0, 0, -1]),
            ("N^2/m^3", [2, -1, -4]),
        ];
        for (unit, expected) in cases {
            assert_eq!(exponents(unit), expected, "{unit}");
        }
    }

    #[test]
    fn what_is_no_unit_is_refused_with_the_factor() {
        for unit in ["", " ", "Pa", "N/", "/s", "m^", "m^0.5", "m^1000000000", "m s", "kg**m", "M", "m^2^2", "(m)"] {
            let message = parse(unit).expect_err(unit).to_string();
            assert!(message.contains("kg, m, s, N, rad"), "{message}");
        }
        assert!(parse("N/mm").expect_err("millimetres").to_string().contains("`mm` is not understood"));
    }

    #[test]
    fn a_stiffness_in_newtons_per_metre_does_not_change_with_the_unit_of_length() {
        assert_eq!(scale("N/m", 1000.0, 1.0, 1.0).expect("a unit"), 1.0);
        assert_eq!(scale("N/m", 1000.0, 8.0, 2.0).expect("a unit"), 2.0);
        assert_eq!(scale("s/m", 4.0, 1.0, 2.0).expect("a unit"), 0.5);
    }
}
