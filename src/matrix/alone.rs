//! What each check of the gate catches that no other check of the gate catches.
//!
//! ```text
//!     alone(c) = { planted engine e : c is the only check that fails on e }
//! ```
//! A check for which this set is empty could be left out without a planted mistake passing; it stands for the reason that [`STANDS`] gives.

use super::Row;
use serde::Serialize;

/// What only one check of the gate catches, or why the check stands although others catch all that it does.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Alone {
    /// The check.
    pub check: String,
    /// The planted mistakes that it alone catches.
    pub catches: Vec<&'static str>,
    /// Why it stands if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stands: Option<&'static str>,
}

impl Alone {
    /// Whether the check catches a mistake alone, or else says why it stands; a reason beside such a mistake is a stale one.
    pub fn is_justified(&self) -> bool {
        self.catches.is_empty() == self.stands.is_some()
    }
}

/// What each of these checks of the gate catches alone. Checks of other kinds, which ask no engine, are not counted.
pub fn alone<'a>(checks: impl Iterator<Item = &'a str>, rows: &[Row]) -> Vec<Alone> {
    let names: Vec<&str> = checks.collect();
    let asked = |row: &Row| row.caught_by.iter().filter(|check| names.contains(&check.as_str())).count();
    let single: Vec<&Row> = rows.iter().filter(|row| asked(row) == 1).collect();
    let of = |check: &&str| Alone {
        check: (*check).into(),
        catches: single.iter().filter(|row| row.caught_by.iter().any(|name| name == check)).map(|row| row.name).collect(),
        stands: STANDS.iter().find(|(name, _)| name == check).map(|(_, why)| *why),
    };
    names.iter().map(of).collect()
}

/// Checks all of whose planted mistakes are caught by others too, and why they stand.
pub const STANDS: &[(&str, &str)] = &[
    ("flight/projectile", "it has no contact and no turning: what fails beside it may be blamed on contact only where it passes"),
    ("flight/momentum", "it asks momentum of bodies that nothing touches, apart from the laws of contact that tumbling/momentum rests on"),
    ("flight/spinning-box", "its expected motion is the closed form of a middle axis, where spin/gyroscopic asks only what is conserved"),
    ("ball/restitution", "it compares velocities at one impact, which names e itself where heights and times depend on many impacts"),
    ("ball/energy", "it judges engines that show no velocity at the impact, by heights alone"),
    ("ball/zeno", "it is the claim of the theory that no single impact shows: infinitely many of them end in finite time"),
    ("ball/penetration", "it tells the depth at an impact as a number in metres, which authors compare with their own tolerance"),
    (
        "ball/effective-restitution",
        "it measures what a plastic impact gives back, in the body that other checks with e > 0 let bounce by declaration",
    ),
    (
        "impact/two-spheres",
        "it is the one closed form of two masses without friction and ground, by which masses that are mixed up are named",
    ),
    ("impact/cradle", "it is the one scene in which several impacts happen at once and laws of impact differ by right"),
    ("impact/plastic", "it asks for the energy that a perfectly plastic impact loses, which no check with e > 0 can"),
    ("rest/drift", "it accumulates a thousand steps, so that an error far below the allowance of one step shows in metres"),
    ("rest/jitter", "it tells a body that trembles from one that drifts, though both are found elsewhere by their consequences"),
    (
        "rest/depth",
        "it is predicted by the declared stiffness, and tells a softness that is not declared from a solver that is not finished",
    ),
    ("stack/five", "an engine that fails stack/ten alone has too few sweeps, one that fails here a wrong law"),
    ("stack/ten", "its ten contacts in a row are what solvers that sweep converge slowest on"),
    ("stack/mass-ratio", "heavy on light is where sweeps stop early, and users ask for it by that name"),
    ("determinism/repeat", "it tells randomness from memory: what it finds company finds as well, but not the reverse"),
    ("determinism/company", "it tells memory of another scene from randomness"),
    ("metamorphic/rotation", "it needs no expected value at all, and so judges engines of any law"),
    ("metamorphic/tilt", "it turns gravity with the scene, which finds a vertical that is built in"),
    ("metamorphic/mirror", "a reflection is no rotation: it finds a handedness, as of a one-sided friction direction"),
    ("metamorphic/translation", "it finds what depends on the distance from the origin, and tells how many metres precision lasts"),
    ("metamorphic/units", "it finds thresholds in metres and kilograms of any kind, where limits/fast asks for two of them"),
    ("metamorphic/body-order", "it needs no expected value where a pile has none in closed form"),
    ("metamorphic/galilean", "it finds damping and thresholds of speed in two bodies that nothing else slows"),
    ("metamorphic/halving", "it compares an engine with itself at half the step, whatever its law"),
    ("solver/certificate", "it judges a solver that can move nothing, by the residual alone"),
    ("solver/redundant", "it is the class in which W is singular, where a solver that factors it fails"),
    ("solver/jamming", "it is the class in which impulses are unbounded, where one that bounds them fails"),
    ("solver/friction-range", "it is the class of μ from 0 to 10, where a relaxation that is harmless at small μ shows"),
    ("solver/conditioning", "it tells the condition number at which a solver ends, as a number for its author"),
    ("projection/regions", "it says in which region a projection is wrong"),
    ("projection/boundaries", "it asks within 2⁻⁴⁰ of both boundaries, where regions asks far from them"),
    ("projection/optimality", "it needs no expected point: Moreau's decomposition alone decides, in any dimension"),
    ("incline/stick", "its friction is 37 % above the need: who fails here creeps by its law, and not for want of iterations"),
    (
        "incline/stick-threshold",
        "it has a sixteenth on either side of the limit, between the large margin of incline/stick and the fiftieth of limits/stick",
    ),
    ("incline/slide", "it is the closed form of dry friction, with the number that everybody knows"),
    ("incline/hop", "it is the one place where the gap of a convex relaxation has a closed form after a landing"),
    ("incline/gap", "it is the same gap in a steady slide, proportional to h, μ and the slip"),
    ("rolling/five-sevenths", "it holds time and speed of the end of slip in closed form, where rolling/incline never slips"),
    ("rolling/incline", "it holds sticking friction to the moment of inertia, where five-sevenths holds sliding friction to it"),
    ("isotropy/deceleration", "it shows the cone's shape as a picture of 16 directions, which counts a pyramid's edges"),
    ("isotropy/straight", "it asks that friction does not turn the path, to which the size of deceleration is blind"),
    ("contact/cone", "it reads nothing but reported impulses"),
    ("contact/complementarity", "it reads nothing but reported impulses and the gap"),
    ("contact/dissipation", "it reads the reported impulse against the slip, and so tells a wrong report from a wrong motion"),
    ("contact/increment", "it bounds the work of contact in every single step, which sums over a motion hide"),
    ("contact/momentum", "it holds reports to the motion of one body, where contact/pairs holds both bodies to them"),
    ("energy/passive", "it is one cube in every step: who fails it need not search among many bodies"),
    ("rocking/impact", "it is Housner's closed form, an impact with two contacts of which one opens"),
    ("rocking/fall-time", "it asks for a time without any impact, and so tells a wrong moment of inertia from a wrong impact"),
    ("painleve/rod", "it is the one scene in which rigid bodies with friction have no solution without an impulse"),
    ("tumbling/passive", "energy has a bound in motions that have no closed form, as those of users have none"),
    ("tumbling/bouncing", "it lets boxes bounce at random on corners, edges and faces, where closed forms cover a few positions"),
    ("tumbling/rough", "it has restitution and friction at once, with Kane's possible gain as its bound"),
    ("tumbling/depth", "it looks for a pair of features through which random boxes fall"),
    ("tumbling/momentum", "it holds reports in random motions, where contact/pairs has two bodies"),
    ("tumbling/rest", "it asks for the end of a random motion, which laws of energy do not"),
    ("spin/drilling", "it asks of one contact point without a length what only its law can say"),
    ("spin/flat-box", "its time holds for every load of four corners, so that a wrong yaw friction has a number"),
    ("spin/gyroscopic", "it tells growth from loss over many turns, where flight/spinning-box compares one"),
    ("limits/stick", "it holds one coefficient of friction to two percent, in a body whose contacts share no load"),
    ("limits/small", "its cube is 4 cm wide: lengths that an engine has built in are large there, and small in every other scene"),
    ("bounce/flat-box", "it has four impacts at once whose sum has a closed form for every law of them"),
    ("bounce/corner", "it is the closed form of one impact with a lever, by which a moment of inertia is named"),
    ("bounce/spinning-ball", "it has e and μ in one impact in closed form"),
    ("bounce/slow", "it goes through speeds from 0.02 m/s on, by which a threshold of restitution has a number"),
    ("bounce/separating", "it finds an impulse where there must be none"),
    ("pair/oblique-spheres", "it has friction between two bodies in one impact, with no other contact to share it"),
    ("pair/crossed-bars", "it is the pair of features that engines forget, in closed form"),
    ("pair/ball-on-box", "it is a long contact of two bodies, with no impact in it"),
    ("pair/any-direction", "its slip lies along no axis and in either order of the list, where other frictions between bodies have one"),
    ("pair/woken", "it lets bodies rest as long as engines need to put them to sleep, and says which of them was not woken"),
    ("pair/held", "what sticks here is carried by a box that could creep itself, as no load on a floor is"),
    ("pair/plank-on-plank", "it is faces on faces, whose contact points are the engine's own choice"),
    ("pair/central", "it has masses from 10 g to 400 kg and sizes from 8 mm on, by which a limit of either is named"),
    ("pair/off-centre", "face, edge and corner of a turned box have a closed form each, by which the wrong feature is named"),
    ("pair/faces", "it is e at several corners between two bodies, where the place of the whole impulse has a closed form"),
    ("pair/rough-corner", "it has e and μ of a box in one contact, with a closed form for stick and for slip"),
    ("pair/support-leaves", "what rests is left by what carries it, which wakes nothing by an impact"),
    ("fixed/bounce", "floors and walls of users are static bodies, whose mass an engine may have made up"),
    ("fixed/rest", "it asks of a static body what rest/drift and rest/jitter ask of the plane"),
    ("conveyor/box", "it is the one surface that moves and is not moved, with an exact time to the end of slip"),
    ("conveyor/sphere", "the belt turns what it drives, which a box does not show"),
    ("round/cylinder-incline", "its acceleration names the moment of inertia about the axis"),
    ("round/capsule-incline", "the moment of a capsule is a sum of three, of which cylinder and sphere have one each"),
    ("round/standing", "a flat end needs three points at least, which a rolling cylinder does not"),
    ("round/struck", "it has moments of inertia of both rods across their axes, in free space and in closed form"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gate::checks;
    use crate::matrix::{Source, rows};
    use moreau_checks::planted::{Catch, Kind, Planted};
    use std::collections::BTreeSet;

    #[test]
    fn every_reason_is_that_of_one_check_and_no_other_has_it() {
        let names: BTreeSet<&str> = STANDS.iter().map(|(name, _)| *name).collect();
        let reasons: BTreeSet<&str> = STANDS.iter().map(|(_, why)| *why).collect();
        assert_eq!((names.len(), reasons.len()), (STANDS.len(), STANDS.len()));
        for name in names {
            assert!(checks::find(name).is_some(), "{name}");
        }
    }

    #[test]
    fn what_one_check_catches_is_told_and_what_two_catch_is_neither_ones() {
        static MISTAKES: [Planted<&[&str]>; 3] = [
            Planted { name: "made-up/seen-by-one", mistake: "", kind: Kind::Report, subject: &["rest/depth", "another kind of check"] },
            Planted { name: "made-up/seen-by-two", mistake: "", kind: Kind::Report, subject: &["rest/depth", "limits/fast"] },
            Planted { name: "made-up/seen-elsewhere", mistake: "", kind: Kind::Report, subject: &["another kind of check"] },
        ];
        let trial = |planted: &'static Planted<&'static [&'static str]>| {
            planted.trial(|checks| Ok(checks.iter().map(|check| Catch::from(*check)).collect()))
        };
        let source = Source { checks: Vec::new(), trials: MISTAKES.iter().map(trial).collect() };
        let rows = rows(&[source], &|| ()).expect("computed");
        let found = alone(["rest/depth", "limits/fast"].into_iter(), &rows);
        assert_eq!(found[0].catches, ["made-up/seen-by-one"]);
        assert!(found[1].catches.is_empty() && found[1].stands.is_none() && !found[1].is_justified(), "{:?}", found[1]);
        assert!(!found[0].is_justified(), "rest/depth has a reason that it does not need here: {:?}", found[0]);
        assert!(Alone { stands: None, ..found[0].clone() }.is_justified());
        assert!(Alone { catches: Vec::new(), ..found[0].clone() }.is_justified());
    }
}
