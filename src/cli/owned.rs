//! What the options of all schemes share: which scheme an option belongs to, and errors in the words of the command line.

use crate::Error;

/// An option, whether it was given, and the schemes in which it does something.
pub struct Owned {
    /// With its dashes.
    pub option: &'static str,
    /// On this command line.
    pub given: bool,
    /// Names of schemes.
    pub owners: &'static [&'static str],
}

/// The error with the field spelt as the option it came from.
pub fn option(error: Error) -> Error {
    match error {
        Error::Invalid { field, problem, cure } if field == "directions" => {
            Error::Invalid { field: "--friction-directions".into(), problem, cure }
        }
        Error::Invalid { field, problem, cure } => Error::Invalid { field: format!("--{}", field.replace([' ', '_'], "-")), problem, cure },
        other => other,
    }
}
