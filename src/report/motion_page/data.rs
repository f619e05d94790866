//! The numbers of a motion as its page holds them: six significant digits, and not more samples than a page can carry.

use super::super::motion::MotionReport;
use super::acting::{Acting, acting};
use crate::certificate::{Judgement, StepResidual};
use crate::mechanics::spatial::Shape;
use crate::number::significant;
use crate::scenes::{Body, Scene};
use crate::{Error, Result};
use serde::{Serialize, Serializer};

/// A page shows at most this many samples.
pub const MOST_SAMPLES: usize = 1200;

/// And at most this many positions of bodies, over all samples.
const MOST_PLACES: usize = 240_000;

/// Digits of every number of a page, those of [`significant`].
pub const DIGITS: usize = 6;

/// A number as a report writes it; null if it is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown(pub f64);

impl Serialize for Shown {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        // not longer than it has to be: 1, not 1.0
        match significant(self.0).parse::<f64>() {
            Ok(value) if !value.is_finite() => serializer.serialize_none(),
            Ok(value) if value as i64 as f64 == value && value.abs() < 1e15 => serializer.serialize_i64(value as i64),
            Ok(value) => serializer.serialize_f64(value),
            Err(_) => serializer.serialize_none(),
        }
    }
}

/// What the page's program reads.
#[derive(Serialize)]
pub struct Data<'a> {
    /// How many steps the motion has.
    pub steps: usize,
    /// Every how many of them there is a sample; the last one has one in any case.
    pub every: usize,
    /// n and c of the plane n·x = c.
    ground: Option<([Shown; 3], Shown)>,
    bodies: Vec<Drawn<'a>>,
    /// t of every sample \[s\].
    times: Vec<Shown>,
    /// The step that ends at the sample; 0 at the start.
    ends: Vec<usize>,
    /// T + V \[J\].
    energies: Vec<Shown>,
    /// Per sample and body: centre \[m\] and unit quaternion (w, x, y, z), one after the other.
    places: Vec<Vec<Shown>>,
    /// Per sample: what acted since the sample before.
    contacts: Vec<Vec<Pushed>>,
    /// Per sample: what the certificate says of the steps since the sample before.
    certificates: Vec<Option<Certified>>,
    /// The words that they count in.
    residuals: Vec<String>,
}

/// A body of the scene.
#[derive(Serialize)]
struct Drawn<'a> {
    name: &'a str,
    /// `free`, `static` or `prescribed`.
    kind: &'static str,
    /// `sphere`, `box`, `capsule` or `cylinder`.
    shape: &'static str,
    /// Radius, or half the edges, or radius and half the height \[m\].
    size: Vec<Shown>,
}

/// First body, second body (−1: the ground), point \[m\], impulse on the first body, its normal and tangential size \[N·s\].
#[derive(Serialize)]
struct Pushed(usize, isize, [Shown; 3], [Shown; 3], Shown, Shown);

/// Steps that are rejected, steps that are unconverged by declaration, the largest residual, its limit, its word, its step.
#[derive(Serialize)]
struct Certified(usize, usize, Shown, Shown, usize, usize);

impl<'a> Data<'a> {
    /// The data of a motion of a scene.
    pub fn new(motion: &MotionReport, scene: &'a Scene) -> Result<Self> {
        let recording = motion.recording;
        let steps = recording.impulses.len();
        let every = thinning(steps, scene.bodies.len());
        let mut ends: Vec<usize> = (0..=steps).step_by(every).collect();
        if ends.last() != Some(&steps) {
            ends.push(steps);
        }
        let begins = std::iter::once(0).chain(ends.iter().copied());
        let spans: Vec<_> = begins.zip(&ends).map(|(begin, end)| begin..*end).collect();
        let samples = || ends.iter().map(|end| &recording.samples[*end]);
        let mut residuals = Vec::new();
        let certificates = spans.iter().map(|span| certified(motion, span.clone(), &mut residuals)).collect();
        Ok(Data {
            steps,
            every,
            ground: scene.ground.map(|ground| (ground.normal.map(Shown), Shown(ground.offset))),
            bodies: scene.bodies.iter().map(drawn).collect::<Result<_>>()?,
            times: samples().map(|state| Shown(state.time)).collect(),
            energies: samples().map(|state| Shown(motion.mechanism.energy(state))).collect(),
            places: ends.iter().map(|end| places(motion, *end)).collect(),
            contacts: spans.into_iter().map(|span| acting(motion, span).into_iter().map(pushed).collect()).collect(),
            certificates,
            residuals,
            ends,
        })
    }

    /// How many samples the page has.
    pub fn samples(&self) -> usize {
        self.ends.len()
    }

    /// JSON that may stand in an HTML page: no letter of it ends a script or begins a comment.
    pub fn json(&self) -> Result<String> {
        let text = serde_json::to_string(self).map_err(Error::from)?;
        // these letters stand in names only, never in the structure of JSON
        Ok(text.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026"))
    }
}

/// Every how many steps a sample is shown.
fn thinning(steps: usize, bodies: usize) -> usize {
    let most = MOST_SAMPLES.min(MOST_PLACES / bodies.max(1)).max(3);
    // the start, and perhaps the end, are samples beside those of the quotient
    steps.div_ceil(most - 2).max(1)
}

fn drawn(body: &Body) -> Result<Drawn<'_>> {
    let shape = body.shape()?;
    let size = match shape {
        Shape::Sphere { radius } => vec![radius],
        Shape::Box { half_extents } => half_extents.to_vec(),
        Shape::Capsule { radius, half_height } | Shape::Cylinder { radius, half_height } => vec![radius, half_height],
    };
    let kind = match (body.is_static, body.prescribed) {
        (true, _) => "static",
        (_, Some(_)) => "prescribed",
        _ => "free",
    };
    Ok(Drawn { name: &body.name, kind, shape: shape.word(), size: size.into_iter().map(Shown).collect() })
}

fn places(motion: &MotionReport, sample: usize) -> Vec<Shown> {
    let state = &motion.recording.samples[sample];
    let bodies = motion.mechanism.bodies(&state.position, &state.velocity);
    bodies.iter().flat_map(|body| body.position.into_iter().chain(body.orientation)).map(Shown).collect()
}

fn pushed(acting: Acting) -> Pushed {
    let second = acting.bodies.1.map_or(-1, |body| body as isize);
    let [normal, tangential] = acting.sizes();
    Pushed(acting.bodies.0, second, acting.point.map(Shown), acting.impulse.map(Shown), Shown(normal), Shown(tangential))
}

/// What the certificate says of some steps; nothing where nothing was solved.
fn certified(motion: &MotionReport, steps: std::ops::Range<usize>, words: &mut Vec<String>) -> Option<Certified> {
    let recording = motion.recording;
    let count = |wanted| recording.judgements[steps.clone()].iter().filter(|one| **one == wanted).count();
    let solved = steps.clone().filter_map(|step| Some((step, recording.residuals[step]?)));
    // what is not a number equals nothing, and nothing is worse
    let stays = |known: StepResidual, next| known.relative.is_nan() || known.worse(next) == known;
    let worse = |known: (usize, StepResidual), next: (usize, StepResidual)| if stays(known.1, next.1) { known } else { next };
    let (step, worst) = solved.reduce(worse)?;
    let word = match worst.rule {
        "certificate" => worst.residual.to_string(),
        rule => format!("{} of the {rule}", worst.residual),
    };
    let place = words.iter().position(|known| *known == word).unwrap_or_else(|| {
        words.push(word);
        words.len() - 1
    });
    let (rejected, unconverged) = (count(Judgement::Rejected), count(Judgement::Unconverged));
    Some(Certified(rejected, unconverged, Shown(worst.relative), Shown(worst.limit), place, step + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_written_as_the_command_writes_it_and_not_longer() {
        let text = |value: f64| serde_json::to_string(&Shown(value)).expect("a number");
        for value in [std::f64::consts::PI, -1.0 / 3.0 * 1e-9, 123_456.78, 1e20, 0.1 + 0.2, 9.999_999_9, 1e300] {
            assert_eq!(text(value).parse::<f64>().ok(), significant(value).parse().ok(), "{value}");
        }
        assert_eq!([1.0, -0.0, 0.1 + 0.2, f64::NAN, f64::INFINITY].map(text), ["1", "0", "0.3", "null", "null"]);
    }

    #[test]
    fn no_page_has_more_samples_than_it_says_and_a_short_motion_has_all_of_its_own() {
        for bodies in [1, 7, 1000, 1_000_000] {
            for steps in [1, 2, 1198, 1199, 1200, 5000, 999_999] {
                let every = thinning(steps, bodies);
                let count = (0..=steps).step_by(every).count() + usize::from(!steps.is_multiple_of(every));
                let few = count <= MOST_SAMPLES && (count * bodies <= MOST_PLACES || count <= 3);
                assert!(few, "{steps} steps of {bodies}: {count} samples");
            }
        }
        assert_eq!((thinning(1000, 10), thinning(1198, 1), thinning(1199, 1)), (1, 1, 2));
    }
}
