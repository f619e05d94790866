//! What happens at one contact, as an exact pair (r, y) that the law allows, and where the law has them β and σ, or f.

use crate::exact::zero;
use crate::random::Random;
use moreau::problem::Law;
use moreau::scalar::{Rational, ratio};

/// What a contact does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// r = 0 and separating.
    Open,
    /// Carries, y = 0, friction inside the cone; without friction any tangential motion.
    Stick,
    /// Carries, y = 0, friction exactly on the cone.
    Edge,
    /// Carries and slides.
    Slide,
    /// r = 0 and not separating: both members of the normal pair vanish.
    Graze,
}

pub const STATUSES: [Status; 5] = [Status::Open, Status::Stick, Status::Edge, Status::Slide, Status::Graze];

/// (r, y) of one contact, and the parts of r that polyhedral laws name.
pub struct Point {
    pub impulse: Vec<Rational>,
    pub velocity: Vec<Rational>,
    pub parts: Vec<Rational>,
    pub sigma: Rational,
}

/// A direction of friction s with its gauge (‖s‖, or 1 for an edge), the slip against it and the slip's speed σ.
struct Slip {
    friction: Vec<Rational>,
    gauge: Rational,
    velocity: Vec<Rational>,
    speed: Rational,
}

/// Sides with rational hypotenuse.
const TRIPLES: [(i64, i64, i64); 5] = [(3, 4, 5), (-4, 3, 5), (5, -12, 13), (-8, -15, 17), (0, 1, 1)];

fn round_slip(rows: usize, random: &mut Random) -> Slip {
    let (a, b, c) = TRIPLES[random.below(TRIPLES.len())];
    let (direction, c) = match rows {
        1 => (vec![], 1),
        2 => (vec![[1, -1][random.below(2)]], 1),
        _ => (vec![a, b], c),
    };
    let speed = random.number();
    let direction: Vec<Rational> = direction.into_iter().map(|x| ratio(x, 1)).collect();
    let velocity = direction.iter().map(|x| -x * &speed).collect();
    Slip { friction: direction, gauge: ratio(c, 1), velocity, speed: speed * ratio(c, 1) }
}

fn unit(j: usize, d: usize) -> Vec<Rational> {
    let size = d / 2;
    (0..size)
        .map(|i| {
            ratio(
                if i != j % size {
                    0
                } else if j < size {
                    1
                } else {
                    -1
                },
                1,
            )
        })
        .collect()
}

/// Slip against edge j, and beside it by p of its speed; friction along that edge, and at |p| = 1 along the next one too.
fn edge_slip(d: usize, random: &mut Random) -> Slip {
    let (j, speed) = (random.below(d), random.number());
    let side = if d == 2 { 0 } else { random.below(5) as i64 - 2 };
    let beside = unit(if side > 0 { j + d / 4 } else { j + 3 * d / 4 } % d, d);
    let share = |p: i64| if p.abs() == 2 { ratio(1, 4) } else { zero() };
    let mix = |own: Rational, next: Rational| -> Vec<Rational> {
        unit(j, d).iter().zip(&beside).map(|(own_axis, next_axis)| own_axis * &own + next_axis * &next).collect()
    };
    let friction = mix(ratio(1, 1) - share(side), share(side));
    let velocity = mix(-&speed, -&speed * ratio(side.abs(), 2));
    Slip { friction, gauge: ratio(1, 1), velocity, speed }
}

/// How large impulses \[N·s\] and velocities \[m/s\] are at this contact.
pub struct Sizes {
    pub impulse: Rational,
    pub velocity: Rational,
}

/// An exact answer at one contact.
pub fn point(law: Law, rows: usize, status: Status, mu: &Rational, sizes: &Sizes, random: &mut Random) -> Point {
    let slip = match law.directions() {
        Some(d) => edge_slip(d, random),
        None => round_slip(rows, random),
    };
    let associated = matches!(law, Law::Associated | Law::PolyhedralAssociated { .. });
    let carried = if matches!(status, Status::Open | Status::Graze) { zero() } else { random.number() * &sizes.impulse };
    // r_n is a multiple of the gauge, so that r_t = μ r_n s/gauge is a dyadic number where the data are
    let share = match (law, status) {
        (Law::Frictionless, _) | (_, Status::Open | Status::Graze) => zero(),
        (_, Status::Stick) => ratio(random.below(4) as i64, 4),
        _ => ratio(1, 1),
    };
    let mut impulse = vec![&carried * &slip.gauge];
    impulse.extend(slip.friction.iter().map(|s| s * mu * &carried * &share));
    let moves = match (law, status) {
        (Law::Frictionless, _) => random.below(3) > 0,
        (_, Status::Stick | Status::Edge) => false,
        (_, Status::Graze) => random.below(3) > 0,
        _ => true,
    };
    let scale = if moves { sizes.velocity.clone() } else { zero() };
    let speed = &slip.speed * &scale;
    let mut normal = if associated { mu * &speed } else { zero() };
    if status == Status::Open {
        normal += random.number() * &sizes.velocity;
    }
    let mut velocity = vec![normal];
    velocity.extend(slip.velocity.iter().map(|v| v * &scale));
    let d = law.directions().unwrap_or(0);
    let parts: Vec<Rational> = (0..d)
        .map(|j| {
            let (axis, sign) = (1 + j % (d / 2), if 2 * j < d { ratio(1, 1) } else { ratio(-1, 1) });
            (&impulse[axis] * sign).max(zero())
        })
        .collect();
    Point { impulse, velocity, parts, sigma: speed }
}
