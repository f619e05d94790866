//! A scene as a scheme runs it: its mechanism, its start, and what is known of its motion.

use super::{ExactMotion, Scene};
use crate::mechanics::{Mechanism, State};
use moreau_exact::{Error, Result};

/// Everything a run needs.
pub struct Staged {
    /// The scene's name.
    pub name: String,
    /// What moves.
    pub mechanism: Box<dyn Mechanism>,
    /// Where it starts.
    pub start: State,
    /// The closed form of its motion, where there is one.
    pub exact: Option<ExactMotion>,
    /// Gravity \[m/s²\].
    pub gravity: f64,
    /// How long the scene lasts \[s\].
    pub duration: f64,
}

impl Scene {
    /// The scene in its plane, or in space if its motion leaves the x–z plane, where no closed form is.
    ///
    /// # Errors
    /// [`Error::Invalid`] as [`Scene::validate`].
    pub fn staged(&self) -> Result<Staged> {
        let (mechanism, start, planar) = match self.mechanism() {
            Err(Error::Unsupported(_)) => {
                let (mechanism, start) = self.spatial_mechanism()?;
                (mechanism, start, false)
            }
            result => {
                let (mechanism, start) = result?;
                (mechanism, start, true)
            }
        };
        let exact = if planar { self.exact_motion(&start) } else { None };
        let gravity = self.gravity.iter().map(|part| part * part).sum::<f64>().sqrt();
        Ok(Staged { name: self.name.clone(), mechanism, start, exact, gravity, duration: self.duration })
    }
}
