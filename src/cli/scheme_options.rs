//! A scheme and its parameters on the command line.

use super::drake_options::DrakeOptions;
use super::limits::count;
use super::mujoco_options::MujocoOptions;
use super::near::suggestion;
use super::number;
use super::owned::{Owned, option};
use crate::schemes::{self, Activation, Bullet, RestitutionRule, Scheme, SchemeParameters};
use crate::tolerance::limits::SWEEPS;
use crate::{Error, Result};
use clap::Parser;
use clap::error::{ContextKind, ErrorKind};

const MOREAU_JEAN: &str = "Options of moreau-jean and moreau-jean-projection";
const STEWART_TRINKLE: &str = "Options of stewart-trinkle";
const GENERALISED_ALPHA: &str = "Options of generalised-alpha";
const POSITION_BASED: &str = "Options of xpbd and pbd";
const EVENT_DRIVEN: &str = "Options of event-driven";

/// The options of all schemes; one that does nothing in the chosen scheme is an error.
#[derive(clap::Args)]
pub struct SchemeOptions {
    /// θ of moreau-jean and moreau-jean-projection, from 0 (explicit) over 1/2 (default) to 1 (implicit).
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = MOREAU_JEAN)]
    theta: Option<f64>,
    /// Restitution e of every pair, for the schemes that have one, in place of the scene's.
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true)]
    restitution: Option<f64>,
    /// Whether e reverses the normal velocity only (normal-only, default) or the whole contact velocity (full-vector).
    #[arg(long, value_name = "RULE", help_heading = MOREAU_JEAN)]
    restitution_rule: Option<String>,
    /// Which contacts of moreau-jean are active: A (gap), B (half-step-forecast, default) or D (free-velocity-forecast).
    #[arg(long, value_name = "RULE", help_heading = MOREAU_JEAN)]
    activation: Option<String>,
    /// Friction directions of stewart-trinkle at spatial contacts, from 3 to 1024 (8).
    #[arg(long, value_parser = number::count, value_name = "NUMBER", help_heading = STEWART_TRINKLE, allow_negative_numbers = true)]
    friction_directions: Option<usize>,
    /// ρ of generalised-alpha, the share that a step keeps of infinitely stiff motion, from 0 to 1 (0.8).
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = GENERALISED_ALPHA)]
    spectral_radius: Option<f64>,
    /// Compliance α of a contact in xpbd [m/N] (0).
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = POSITION_BASED)]
    compliance: Option<f64>,
    /// Share s of a penetration that pbd undoes in a sweep, above 0 and up to 1 (1/2).
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true, help_heading = POSITION_BASED)]
    share: Option<f64>,
    /// Sweeps over all contacts in a step of xpbd (20) or pbd (10), from 1 to 10000.
    #[arg(long, value_parser = number::count, value_name = "NUMBER", help_heading = POSITION_BASED, allow_negative_numbers = true)]
    sweeps: Option<usize>,
    /// τ of event-driven [s]: an impact that would start a shorter flight is plastic. With 0 every impact is followed, and infinitely many
    /// are an error.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", allow_hyphen_values = true, help_heading = EVENT_DRIVEN)]
    shortest_flight: Option<f64>,
    #[command(flatten)]
    mujoco: MujocoOptions,
    #[command(flatten)]
    drake: DrakeOptions,
}

/// Options alone, without a command.
#[derive(clap::Parser)]
#[command(no_binary_name = true)]
struct Words {
    #[command(flatten)]
    options: SchemeOptions,
}

/// What the parser of words says, as an error with its field.
fn refused(error: &clap::Error) -> Error {
    let of = |kind: ContextKind| error.get(kind).map(ToString::to_string);
    let said = error.to_string().lines().next().unwrap_or_default().trim_start_matches("error: ").to_string();
    let Some(option) = of(ContextKind::InvalidArg) else { return Error::Unsupported(said) };
    let field = option.split([' ', '=']).next().unwrap_or_default();
    let near = of(ContextKind::SuggestedArg).map(|near| format!("did you mean `{near}`?"));
    let cure = near.unwrap_or_else(|| "`moreau simulate --help` has the options of every scheme".into());
    Error::invalid(field, if error.kind() == ErrorKind::UnknownArgument { "is no option of a scheme".into() } else { said }, cure)
}

impl SchemeOptions {
    /// The options of these words, such as `--theta`, `1`.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the option that is none, or whose value is none.
    pub fn of_words(words: &[String]) -> Result<Self> {
        Words::try_parse_from(words).map(|words| words.options).map_err(|error| refused(&error))
    }

    /// The scheme with this name and these parameters.
    ///
    /// # Errors
    /// An unknown name, an option that belongs to another scheme, or a parameter that is not valid.
    pub fn build(&self, name: &str) -> Result<Box<dyn Scheme>> {
        if !schemes::NAMES.contains(&name) {
            let known = format!("use one of {}", schemes::NAMES.join(", "));
            return Err(Error::invalid("--scheme", format!("`{name}` is unknown"), suggestion(name, schemes::NAMES, &known)));
        }
        for Owned { option, given, owners } in self.own().into_iter().chain(self.mujoco.owned()).chain(self.drake.owned()) {
            if given && !owners.contains(&name) {
                return Err(foreign(option, name, owners));
            }
        }
        let scheme = schemes::by_name(name, self.parameters()?).map_err(option)?;
        if self.restitution.is_some() && !scheme.has_restitution() {
            return Err(foreign("--restitution", name, &restituting()?));
        }
        Ok(scheme)
    }

    /// e of every pair, if given.
    ///
    /// # Errors
    /// A number outside \[0, 1\].
    pub fn restitution(&self) -> Result<Option<f64>> {
        match self.restitution {
            Some(value) if !(0.0..=1.0).contains(&value) => {
                Err(Error::invalid("--restitution", format!("is {value}"), "use a number from 0 to 1"))
            }
            given => Ok(given),
        }
    }

    fn own(&self) -> [Owned; 9] {
        let of = |option, given, owners| Owned { option, given, owners };
        [
            of("--theta", self.theta.is_some(), &["moreau-jean", "moreau-jean-projection"][..]),
            of("--restitution-rule", self.restitution_rule.is_some(), &["moreau-jean"]),
            of("--activation", self.activation.is_some(), &["moreau-jean"]),
            of("--spectral-radius", self.spectral_radius.is_some(), &["generalised-alpha"]),
            of("--friction-directions", self.friction_directions.is_some(), &["stewart-trinkle"]),
            of("--compliance", self.compliance.is_some(), &["xpbd"]),
            of("--share", self.share.is_some(), &["pbd"]),
            of("--sweeps", self.sweeps.is_some(), &["xpbd", "pbd"]),
            of("--shortest-flight", self.shortest_flight.is_some(), &["event-driven"]),
        ]
    }

    fn parameters(&self) -> Result<SchemeParameters> {
        let default = SchemeParameters::default();
        Ok(SchemeParameters {
            theta: self.theta.unwrap_or(default.theta),
            activation: self.activation.as_deref().map_or(Ok(default.activation), activation)?,
            restitution: self.restitution_rule.as_deref().map_or(Ok(default.restitution), RestitutionRule::by_name).map_err(option)?,
            directions: self.friction_directions.unwrap_or(default.directions),
            spectral_radius: self.spectral_radius.unwrap_or(default.spectral_radius),
            compliance: self.compliance.unwrap_or(default.compliance),
            share: self.share.unwrap_or(default.share),
            sweeps: self.sweeps.map(|sweeps| count("--sweeps", sweeps, SWEEPS)).transpose()?.or(default.sweeps),
            shortest_flight: self.shortest_flight.unwrap_or(default.shortest_flight),
            mujoco: self.mujoco.mujoco()?,
            bullet: Bullet { friction: self.mujoco.friction()?, ..default.bullet },
            drake: self.drake.material(),
        })
    }
}

fn foreign(option: &str, scheme: &str, owners: &[&str]) -> Error {
    Error::invalid(option, format!("does nothing in {scheme}"), format!("use it with {}", owners.join(", ")))
}

/// The schemes whose impacts use e.
fn restituting() -> Result<Vec<&'static str>> {
    let all = schemes::NAMES.into_iter().map(|name| Ok((name, schemes::by_name(name, SchemeParameters::default())?)));
    let all = all.collect::<Result<Vec<_>>>()?;
    Ok(all.into_iter().filter(|(_, scheme)| scheme.has_restitution()).map(|(name, _)| name).collect())
}

/// A rule by its letter or its name.
fn activation(name: &str) -> Result<Activation> {
    match name {
        "A" => Ok(Activation::Gap),
        "B" => Ok(Activation::HalfStepForecast),
        "D" => Ok(Activation::FreeVelocityForecast),
        "C" => Err(Error::invalid("--activation", "is C, under which a resting body sinks", "use A, B or D")),
        _ => Activation::by_name(name).map_err(option),
    }
}
