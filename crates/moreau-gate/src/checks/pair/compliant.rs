//! What a compliant contact returns of the speed of approach: replays of its declared law's discrete map.
//!
//! ```text
//!     n equal points that open and close alike answer as one with 1/(n W_n) for the mass:   v⁺ = v + n r(δ, v) W_n
//! ```
//! A law's map needs W_n, and MuJoCo's Σ 1/m of the bodies. The softness of Drake's SAP depends on the inertia in the axes of the world,
//! so that it is replayed for balls only. Where friction lifts a contact off, its rebound is not replayed. What is not replayed is not
//! asked: a bound that every rebound keeps says nothing.

use crate::checks::pair::meeting::{GAP, SPEED, opening, returned, steps};
use crate::checks::scenery::between;
use crate::model::Model;
use crate::model::normal::{Arms, Normal};
use crate::tolerance::{ball, pair as tolerance};
use crate::{Bench, Expectation, Kind, Measurement};

/// Points that two faces may touch at, of which one lies in the other: the corners of their common part, each once or once for either box.
const POINTS_OF_FACES: [f64; 2] = [4.0, 8.0];

/// Points that two faces beside each other may touch at: as above, or the one corner of each that lies in the other. Both ends of a
/// diagonal are as far from the middle of the common part, so that they, too, answer alike.
const POINTS_OF_FACES_BESIDE: [f64; 3] = [2.0, 4.0, 8.0];

/// How bodies approach whose contact is replayed.
#[derive(Clone, Copy, Debug)]
pub(in crate::checks) struct Approach {
    /// \[m\].
    pub gap: f64,
    /// \[m/s\].
    pub speed: f64,
    /// Steps of the whole motion.
    pub steps: usize,
}

impl Approach {
    /// Over [`GAP`] with [`SPEED`].
    pub fn usual(h: f64) -> Self {
        Approach { gap: GAP, speed: SPEED, steps: steps(h) }
    }
}

/// One point with W_n = `response` \[1/kg\] between bodies of these masses \[kg\], or several points that answer as it does; none under
/// Drake's SAP.
pub(in crate::checks) fn points(bench: &Bench, response: f64, masses: &[f64], count: f64, h: f64) -> Option<Normal> {
    let (mass, cone) = (1.0 / (count * response), bench.description().friction);
    let inverse_masses = masses.iter().map(|mass| 1.0 / mass).sum();
    let contact = Normal { mass, inverse_masses, arms: Arms::Fixed(response), acceleration: 0.0, friction: 0.0, cone, time_step: h };
    (!matches!(Model::of(bench.description()), Model::DrakeSap { .. })).then_some(contact)
}

/// One point.
pub(in crate::checks) fn one_point(bench: &Bench, response: f64, masses: &[f64], h: f64) -> Vec<Normal> {
    points(bench, response, masses, 1.0, h).into_iter().collect()
}

/// Two solid balls of (mass \[kg\], radius \[m\]), or one on a floor.
pub(in crate::checks) fn balls<const N: usize>(bench: &Bench, bodies: [(f64, f64); N], h: f64) -> Vec<Normal> {
    vec![Normal::spheres(&bodies, 0.0, 0.0, bench.description().friction, h)]
}

/// Two faces that stay parallel, at all numbers of points that they may touch at.
pub(in crate::checks) fn faces(bench: &Bench, response: f64, masses: &[f64], h: f64) -> Vec<Normal> {
    POINTS_OF_FACES.iter().filter_map(|count| points(bench, response, masses, *count, h)).collect()
}

/// The same where either face has one corner in the other; boxes that touch with spheres at their corners by declaration have these two
/// points only.
pub(in crate::checks) fn faces_beside(bench: &Bench, response: f64, masses: &[f64], h: f64) -> Vec<Normal> {
    let counts = if corner_radius(bench) > 0.0 { &POINTS_OF_FACES_BESIDE[..1] } else { &POINTS_OF_FACES_BESIDE };
    counts.iter().filter_map(|count| points(bench, response, masses, *count, h)).collect()
}

/// Declared radius \[m\] of the spheres with which the corners of boxes touch; 0 where none is declared.
pub(in crate::checks) fn corner_radius(bench: &Bench) -> f64 {
    bench.description().contact_model.number("corner_radius").unwrap_or(0.0)
}

/// The most points that two faces may touch at.
pub(in crate::checks) fn most_points_of_faces() -> f64 {
    POINTS_OF_FACES[1]
}

/// e of the contacts, anything between that of each; a part `later` of the impulse may come later. None if the law is not replayed.
pub(in crate::checks) fn rebound(bench: &Bench, contacts: &[Normal], approach: Approach, later: f64) -> Option<Expectation> {
    let Approach { gap, speed, steps } = approach;
    let model = Model::of(bench.description());
    let replays = contacts.iter().filter_map(|contact| contact.replays(&model, gap, -speed, steps)).flatten();
    let ends: Vec<f64> = replays.filter_map(|states| states.last().map(|(_, velocity)| velocity / speed)).collect();
    let allowed = tolerance::ratio(bench.epsilon()) + ball::replay(steps, bench.epsilon()) + later;
    (!ends.is_empty()).then(|| between(ends, allowed, "replay of the declared law's discrete map"))
}

/// e of an impact at [`SPEED`], from its impulse; a part `later` of the impulse may come later. `slip` is μ times that of the contact
/// \[m/s\], and `contacts` what it may be under a compliant law. None where it opens by its slip – how much depends on the gap that the
/// step finds –, nor where a compliant law is not replayed.
pub(in crate::checks) fn restitution(
    bench: &Bench,
    h: f64,
    (words, e): (&str, f64),
    value: f64,
    later: f64,
    slip: f64,
    (contacts, approach): (&[Normal], Approach),
) -> Option<Measurement> {
    let law = rebound(bench, contacts, approach, later);
    let asked = bench.description().contact_model.kind == Kind::Rigid || law.is_some();
    (asked && opening(bench, slip) == 0.0).then(|| returned(bench, h, (words, e), (value, SPEED), later, law))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::OneOrMany;
    use crate::{ContactModel, Description, Engine, Options, Parameter};

    /// Points of faces beside each other, of an engine with springs that declares this radius of its corners.
    fn counts(radius: Option<f64>) -> Vec<f64> {
        let mut engine = crate::own::by_name("moreau-jean").expect("listed");
        let options = Options::new();
        let described = engine.describe(&options).expect("describes itself");
        let declared = [("stiffness", 1e5), ("damping", 100.0)].into_iter().chain(radius.map(|radius| ("corner_radius", radius)));
        let one = |(name, value): (&str, f64)| (name.into(), Parameter { value: OneOrMany::One(value), unit: OneOrMany::One("1".into()) });
        let contact_model =
            ContactModel { kind: Kind::Compliant, law: Some("spring-damper".into()), parameters: declared.map(one).collect() };
        let description = Description { contact_model, ..described };
        let bench = Bench::new(&mut engine, &description, &options);
        faces_beside(&bench, 0.5, &[1.0, 3.0], 0.01).iter().map(|contact| 2.0 / contact.mass).collect()
    }

    #[test]
    fn faces_beside_each_other_may_touch_by_a_corner_of_each_and_with_spheres_there_they_do() {
        assert_eq!(counts(None), [2.0, 4.0, 8.0]);
        assert_eq!(counts(Some(0.005)), [2.0]);
    }
}
