//! One contact of §2 in exact arithmetic: its tangent cone, its normal cone by definition, and the impact inclusion on a line.

use crate::scalar::{Rational, ratio};
use moreau_exact::witness::{Part, Witness, decided};

/// The integer as a rational.
pub fn whole(number: i64) -> Rational {
    ratio(number, 1)
}

/// A vector of the plane.
pub type Plane = [Rational; 2];

pub fn dot(left: &Plane, right: &Plane) -> Rational {
    left[0].clone() * right[0].clone() + left[1].clone() * right[1].clone()
}

/// `T_C(q)` of one constraint in the plane: `{w : ∇φ·w ≥ 0}` at φ = 0, the whole plane at φ > 0.
pub struct TangentCone {
    gradient: Plane,
    active: bool,
}

impl TangentCone {
    pub fn new(gradient: [i64; 2], active: bool) -> Self {
        TangentCone { gradient: gradient.map(whole), active }
    }

    pub fn rate(&self, velocity: &Plane) -> Rational {
        dot(&self.gradient, velocity)
    }

    pub fn contains(&self, velocity: &Plane) -> bool {
        !self.active || self.rate(velocity) >= whole(0)
    }

    /// Vectors whose non-negative combinations are the cone.
    fn generators(&self) -> Vec<Plane> {
        let [a, b] = self.gradient.clone();
        let (along, against) = ([-b.clone(), a.clone()], [b, -a]);
        let inward = self.gradient.clone();
        let outward = [-inward[0].clone(), -inward[1].clone()];
        if self.active { vec![inward, along, against] } else { vec![inward, outward, along, against] }
    }

    /// `g ∈ N_T(v)` by definition, `⟨g, w − v⟩ ≤ 0` for all w in T.
    ///
    /// T is a cone: w = 0 and w = 2v give `⟨g, v⟩ = 0`, and then `⟨g, w⟩ ≤ 0` on the generators says the rest.
    pub fn normal_cone_contains(&self, velocity: &Plane, g: &Plane) -> bool {
        let zero = whole(0);
        decided(
            || self.contains(velocity) && dot(g, velocity) == zero && self.generators().iter().all(|w| dot(g, w) <= zero),
            |found| Some(in_normal_cone(&self.gradient, self.active, velocity, g, *found)),
        )
    }
}

/// The witness of a decision on g ∈ N_T(v), T = {w : a·w ≥ 0} or everything.
fn in_normal_cone(gradient: &[Rational], active: bool, velocity: &[Rational], g: &[Rational], found: bool) -> Witness {
    let constraint = Part::Word(if active { "closed" } else { "open" });
    let vectors = [("gradient", gradient), ("velocity", velocity), ("member", g)].map(|(name, vector)| (name, vector.into()));
    Witness::new("normal-cone", vectors.into_iter().chain([("constraint", constraint), ("answer", found.into())]).collect())
}

/// `g ∈ N_T(x)` on the line, with `T = {w ≥ 0}` in contact and the whole line otherwise.
pub fn line_normal_cone_contains(in_contact: bool, x: &Rational, g: &Rational) -> bool {
    let zero = whole(0);
    let decide = || if !in_contact || *x > zero { *g == zero } else { *x == zero && *g <= zero };
    decided(decide, |found| Some(in_normal_cone(&[whole(1)], in_contact, std::slice::from_ref(x), std::slice::from_ref(g), *found)))
}

/// An impact inclusion on the line, `−m (v⁺ − v⁻) ∈ N_T(a v⁺ + b v⁻)` at q = 0; `a = 1, b = e` is Moreau's law.
pub struct Impact {
    pub mass: Rational,
    /// a, the weight of v⁺ in the argument.
    pub after: Rational,
    /// b, the weight of v⁻ in the argument.
    pub before: Rational,
}

impl Impact {
    /// The inclusion with argument v⁺ + e v⁻.
    pub fn moreau(mass: Rational, restitution: Rational) -> Self {
        Impact { mass, after: whole(1), before: restitution }
    }

    pub fn admits(&self, pre: &Rational, post: &Rational) -> bool {
        let argument = self.after.clone() * post.clone() + self.before.clone() * pre.clone();
        let reaction = self.mass.clone() * (pre.clone() - post.clone());
        line_normal_cone_contains(true, &argument, &reaction)
    }

    /// All v⁺. The normal cone is {0} or the half-line at 0, so that v⁺ = v⁻ or the argument vanishes.
    pub fn solutions(&self, pre: &Rational) -> Vec<Rational> {
        decided(
            || self.all_solutions(pre),
            |found| {
                let data = [&self.mass, &self.after, &self.before, pre].map(Clone::clone);
                Some(Witness::new("impact-inclusion", vec![("data", data.as_slice().into()), ("solutions", found.as_slice().into())]))
            },
        )
    }

    fn all_solutions(&self, pre: &Rational) -> Vec<Rational> {
        let mut candidates = vec![pre.clone()];
        if self.after != whole(0) {
            candidates.push(-(self.before.clone() * pre.clone()) / self.after.clone());
        }
        candidates.dedup();
        candidates.retain(|post| self.admits(pre, post));
        candidates
    }
}

/// All pairs of two slices.
pub fn pairs<'a, A, B>(left: &'a [A], right: &'a [B]) -> impl Iterator<Item = (&'a A, &'a B)> {
    left.iter().flat_map(move |a| right.iter().map(move |b| (a, b)))
}

/// The integer grid −reach … reach in the plane.
pub fn grid(reach: i64) -> Vec<Plane> {
    (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| [whole(x), whole(y)])).collect()
}
