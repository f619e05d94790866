//! Two boxes whose faces meet with their centres beside each other, without friction.
//!
//! ```text
//!     0 ≤ p_i ⟂ u_i⁺ + e u_i⁻ ≥ 0  at every point of both faces ,    u_i⁻ = −v ,    u_i linear in the place
//!     all points part alike:     ω₁⁺ = ω₂⁺ ,   p at y_c = d J₁/(J₁ + J₂) from the first centre, in each direction along the faces
//!                                W_n = 1/m + 1/M + Σ d²/(J₁ + J₂) ,   W_n p = (1 + e) v
//!     y_c beside the faces:      p at the nearest edge y of both:   W_n = 1/m + 1/M + y²/J₁ + (d − y)²/J₂ ,  and the rest opens faster
//! ```
//! W is positive definite on what impulses of four corners can do to the motion – their sum and its moment –, so that the motion is unique.
//! How the corners share the impulse is not, and is not asked.

use crate::checks::pair::compliant;
use crate::checks::pair::meeting::{GAP, SPEED, in_space, undamped};
use crate::checks::pair::strike::Strike;
use crate::checks::pair::view::View;
use crate::checks::scenery::cuboid;
use crate::description::Kind;
use crate::{Bench, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;

const RESTITUTION: f64 = 0.5;

/// Two boxes, the second beside the first: m \[kg\], half extents \[m\] and J \[kg·m²\] of both, which are given and not those of solid
/// ones, and the distance of their centres along the faces, in y and z \[m\].
struct Faces {
    words: &'static str,
    masses: [f64; 2],
    half: [[f64; 3]; 2],
    inertia: [[f64; 3]; 2],
    beside: [f64; 2],
}

/// Equal moments: the impulse acts in the middle of the common part, where equal springs put it, too.
const ALIKE: Faces =
    Faces { words: "alike", masses: [1.0, 3.0], half: [[3.0, 4.0, 5.0]; 2], inertia: [[80.0, 90.0, 60.0]; 2], beside: [3.0, -4.0] };
/// Unequal moments: it acts elsewhere in the common part, −3 ≤ y ≤ 4, −5 ≤ z ≤ 4.5, at y = 2.4, z = −1/2.
const INSIDE: Faces = Faces {
    words: "in the common part",
    masses: [1.0, 9.0],
    half: [[3.0, 4.0, 5.0], [3.0, 6.0, 7.0]],
    inertia: [[100.0, 40.0, 120.0], [140.0, 160.0, 30.0]],
    beside: [3.0, -2.5],
};
/// y_c = 4.5, but the first face ends at y = 4: the impulse acts at this edge, and the other one, y = 2, opens faster.
const EDGE: Faces = Faces {
    words: "at the edge",
    masses: [1.0, 3.0],
    half: [[3.0, 4.0, 5.0], [3.0, 3.0, 5.0]],
    inertia: [[100.0, 90.0, 180.0], [90.0, 80.0, 20.0]],
    beside: [5.0, 0.0],
};

impl Faces {
    /// The common part of the faces along y or z, from the first centre \[m\].
    fn common(&self, axis: usize) -> [f64; 2] {
        let [first, second] = self.half.map(|half| half[axis + 1]);
        let beside = self.beside[axis];
        [f64::max(-first, beside - second), f64::min(first, beside + second)]
    }

    /// Where the impulse acts along y or z, from the first centre \[m\]: turns about z belong to y, and about y to z.
    fn place(&self, axis: usize) -> f64 {
        let [first, second] = self.inertia.map(|moments| moments[2 - axis]);
        let [low, high] = self.common(axis);
        (self.beside[axis] * first / (first + second)).clamp(low, high)
    }

    /// The first box flies along x at the second one, which lies at the origin beside its line of flight.
    fn scene(&self, restitution: f64) -> Scene {
        let block = |name: &str, k: usize, place: [f64; 3]| Body {
            inertia: Some(self.inertia[k]),
            ..cuboid(name, self.masses[k], self.half[k], place)
        };
        let ahead = self.half[0][0] + self.half[1][0] + GAP;
        let striker = Body { linear_velocity: [SPEED, 0.0, 0.0], ..block("striker", 0, [-ahead, -self.beside[0], -self.beside[1]]) };
        in_space("faces beside their centres", vec![striker, block("target", 1, [0.0; 3])], 0.0, restitution)
    }

    fn strike<'a>(&self, words: &'a str, restitution: f64) -> Strike<'a> {
        let [y, z] = [self.place(0), self.place(1)];
        let levers = [[self.half[0][0], y, z], [-self.half[1][0], y - self.beside[0], z - self.beside[1]]];
        let far = |axis: usize| self.common(axis).map(|end| (end - self.place(axis)).abs()).into_iter().fold(0.0, f64::max);
        Strike {
            words,
            scene: self.scene(restitution),
            normal: Vector3::x(),
            levers: levers.map(Vector3::from),
            speed: SPEED,
            spread: far(0).hypot(far(1)),
            springs: Vec::new(),
        }
    }
}

pub(super) fn faces(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let restitution = if bench.description().restitution { RESTITUTION } else { 0.0 };
    // springs press in the middle of the common part, wherever the boxes would part alike
    let asked: &[Faces] = if bench.description().contact_model.kind == Kind::Compliant { &[ALIKE] } else { &[ALIKE, INSIDE, EDGE] };
    let mut measured = Vec::new();
    for faces in asked {
        for (order, reversed) in [("", false), (", target listed first", true)] {
            let words = format!(", {}{order}", faces.words);
            let mut strike = faces.strike(&words, restitution);
            strike.springs = compliant::faces_beside(bench, strike.inverse_mass(), &faces.masses, h);
            measured.extend(strike.measured(bench, h, &View::turned(reversed))?);
        }
    }
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::checks::pair::view::oriented;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;
    use moreau_exact::scalar::{Rational, Scalar, exact as rational};

    /// A motion of both boxes after an impulse of this part of the right one, at this place from the first centre along the faces.
    fn motion(scene: &Scene, index: usize, t: f64, part: f64, place: fn(&Faces) -> [f64; 2]) -> RigidState {
        let first = scene.bodies.iter().position(|body| body.name == "striker").expect("one flies");
        let faces = [ALIKE, INSIDE, EDGE].into_iter().find(|one| Some(one.inertia[0]) == scene.bodies[first].inertia).expect("listed");
        let body = &scene.bodies[index];
        let turn = oriented(body);
        let role = usize::from(index != first);
        let [y, z] = place(&faces);
        let levers = [[3.0, y, z], [-3.0, y - faces.beside[0], z - faces.beside[1]]].map(Vector3::from);
        let moment = |k: usize| levers[k].cross(&Vector3::x());
        let spin = |k: usize| moment(k).component_div(&Vector3::from(faces.inertia[k]));
        let response: f64 = (0..2).map(|k| 1.0 / faces.masses[k] + moment(k).dot(&spin(k))).sum();
        let impulse = (1.0 + scene.material.restitution) * SPEED / response * part * [-1.0, 1.0][role];
        let before = Vector3::from(body.linear_velocity);
        let after = before + turn * Vector3::x() * (impulse / faces.masses[role]);
        let contact = GAP / SPEED;
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        let [velocity, spin] = if t < contact { [before, Vector3::zeros()] } else { [after, turn * spin(role) * impulse] };
        (place.into(), body.orientation, velocity.into(), spin.into())
    }

    fn verdict(h: f64, part: f64, place: fn(&Faces) -> [f64; 2]) -> Verdict {
        let measured = judge("pair/faces", h, |scene, index, _, t| motion(scene, index, t, part, place));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_another_impulse_or_place_fails_at_every_step() {
        for h in SWEEP {
            // written out: the middle; d J₁/(J₁ + J₂); the edge
            let right = |faces: &Faces| match faces.words {
                "alike" => [1.5, -2.0],
                "in the common part" => [2.4, -0.5],
                _ => [4.0, 0.0],
            };
            assert_eq!(verdict(h, 1.0, right), Verdict::Pass, "{h}");
            for part in [0.98, 1.02, 2.0 / 3.0] {
                assert_eq!(verdict(h, part, right), Verdict::Fail, "{part} at {h}");
            }
            let middle = |faces: &Faces| [0, 1].map(|axis| 0.5 * faces.common(axis).iter().sum::<f64>());
            let centres = |_: &Faces| [0.0; 2];
            // beyond the edge of the first face, as if faces had no end
            let unclipped = |faces: &Faces| if faces.words == "at the edge" { [4.5, 0.0] } else { [2.4, -0.5] };
            for wrong in [middle as fn(&Faces) -> [f64; 2], centres, unclipped] {
                assert_eq!(verdict(h, 1.0, wrong), Verdict::Fail, "{h}");
            }
        }
    }

    /// u⁺ at a corner of the common part and the sum of W p there, in rationals: u⁺ = −v + Σ (1/m + 1/M + y y'/J₁ + …) p'.
    fn exactly(faces: &Faces, impulses: &[([Rational; 2], Rational)], at: [f64; 2]) -> Rational {
        let of = |x: f64| rational(x);
        let mut velocity = of(-SPEED);
        for (place, impulse) in impulses {
            let mut response = of(1.0) / of(faces.masses[0]) + of(1.0) / of(faces.masses[1]);
            for axis in 0..2 {
                let [first, second] = faces.inertia.map(|moments| of(moments[2 - axis]));
                let beside = of(faces.beside[axis]);
                response += of(at[axis]) * place[axis].clone() / first;
                response += (of(at[axis]) - beside.clone()) * (place[axis].clone() - beside) / second;
            }
            velocity += response * impulse.clone();
        }
        velocity
    }

    /// Impulses of the four corners, in rationals, that add up to one of this size at this place: products of the parts along both sides.
    fn shared(faces: &Faces, place: [Rational; 2], whole: Rational) -> Vec<([Rational; 2], Rational)> {
        let sides: Vec<[(Rational, Rational); 2]> = (0..2)
            .map(|axis| {
                let [low, high] = faces.common(axis).map(rational);
                let part = (place[axis].clone() - low.clone()) / (high.clone() - low.clone());
                [(low, rational(1.0) - part.clone()), (high, part)]
            })
            .collect();
        let corner =
            |y: &(Rational, Rational), z: &(Rational, Rational)| ([y.0.clone(), z.0.clone()], whole.clone() * y.1.clone() * z.1.clone());
        sides[0].iter().flat_map(|y| sides[1].iter().map(move |z| corner(y, z))).collect()
    }

    #[test]
    fn four_corners_solve_their_complementarity_exactly_with_the_impulse_at_this_place() {
        let zero = rational(0.0);
        let target = rational(RESTITUTION * SPEED);
        let ratio = |up: f64, down: f64| rational(up) / rational(down);
        // d J₁/(J₁ + J₂) in rationals, cut off by hand where the face ends
        let cases = [
            (ALIKE, [ratio(3.0, 2.0), rational(-2.0)]),
            (INSIDE, [ratio(12.0, 5.0), ratio(-1.0, 2.0)]),
            (EDGE, [rational(4.0), zero.clone()]),
        ];
        for (faces, place) in cases {
            let unit = shared(&faces, place.clone(), rational(1.0));
            // the velocity that one N·s gives to the place where it acts
            let gain = |at: [f64; 2]| exactly(&faces, &unit, at) + rational(SPEED);
            let corners: Vec<[f64; 2]> = faces.common(0).into_iter().flat_map(|y| faces.common(1).map(|z| [y, z])).collect();
            let pressed: Vec<bool> = unit.iter().map(|(_, part)| *part > zero).collect();
            let first = (0..4).find(|k| pressed[*k]).expect("a corner is pressed");
            let whole = rational((1.0 + RESTITUTION) * SPEED) / gain(corners[first]);
            let impulses = shared(&faces, place, whole.clone());
            for (k, at) in corners.into_iter().enumerate() {
                let velocity = exactly(&faces, &impulses, at);
                assert!(impulses[k].1 >= zero && velocity >= target, "{}: corner {k}", faces.words);
                assert!(!pressed[k] || velocity == target, "{}: corner {k} is pressed and does not part with e v", faces.words);
            }
            assert_eq!(pressed, if faces.words == "at the edge" { [false, false, true, true] } else { [true; 4] });
            let closed = (1.0 + RESTITUTION) * SPEED / faces.strike("", RESTITUTION).inverse_mass();
            let exact = Scalar::to_f64(&whole);
            assert!((closed - exact).abs() <= moreau_exact::tolerance::rounding(32, exact), "{}: {closed} and {exact}", faces.words);
        }
    }
}
