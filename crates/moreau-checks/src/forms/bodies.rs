//! Closed forms of bodies that turn or deform, against point masses and balances.

use super::parts::wrong;
use crate::finding::Finding;
use crate::planted::Family;
use moreau_exact::Result;
use moreau_exact::tolerance::rounding;
use moreau_forms::elastic_bar::ElasticBar;
use moreau_forms::free_top::FreeTop;
use moreau_forms::painleve_impact::SlidingEdge;
use moreau_forms::rocking_block::RockingBlock;
use nalgebra::{Vector2, Vector3};

/// ω⁺/ω⁻ of a block of half width b and half height c that lands on its other edge.
pub type Landing = fn(f64, f64) -> Result<f64>;

/// A landing keeps the angular momentum of the block's points about the edge that is hit.
pub static LANDING: Family<Landing> = Family {
    reference: |b, c| Ok(RockingBlock::new(b, c, 9.81)?.landing_ratio()),
    checks: &[("forms/rocking-block", landing)],
    planted: &[
        wrong("forms/landing-spin-alone", "leaves the motion of the centre out of the angular momentum before the landing", |_, _| {
            Ok(0.25)
        }),
        wrong("forms/landing-inertia-of-the-centre", "turns the block about the edge with its moment about the centre", |b, c| {
            Ok((c * c - b * b + (b * b + c * c) / 3.0) / ((b * b + c * c) / 3.0))
        }),
        wrong("forms/landing-angle-from-the-floor", "takes the cosine of the slenderness for its sine", |b, c| {
            Ok(1.0 - 1.5 * c * c / (b * b + c * c))
        }),
        wrong("forms/landing-keeps-its-energy", "keeps the energy of the landing in place of its angular momentum", |_, _| Ok(1.0)),
    ],
};

/// Four equal points at (±b/√3, ±c/√3) have the centre and the moments of the solid rectangle.
fn landing(subject: &Landing) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for (b, c) in [(0.1, 0.4), (0.2, 0.3), (0.05, 1.0)] {
        let at = |x: f64, z: f64| Vector2::new(x * b / 3f64.sqrt(), z * c / 3f64.sqrt());
        let (old, new) = (Vector2::new(-b, -c), Vector2::new(b, -c));
        let [mut before, mut inertia] = [0.0; 2];
        for point in [at(1.0, 1.0), at(-1.0, 1.0), at(1.0, -1.0), at(-1.0, -1.0)] {
            let (lever, arm) = (point - old, point - new);
            let velocity = Vector2::new(-lever.y, lever.x);
            before += arm.x * velocity.y - arm.y * velocity.x;
            inertia += arm.norm_squared();
        }
        let size = 4.0 * (b * b + c * c) / inertia;
        findings.push(Finding::equal("ω⁺/ω⁻", subject(b, c)?, before / inertia, rounding(64, size), "1"));
    }
    Ok(findings)
}

/// Ω̇ of a free body with moments J at a spin Ω.
pub type Top = fn(&Vector3<f64>, &Vector3<f64>) -> Vector3<f64>;

/// A free top: the inertial forces of its points have no moment.
pub static TOP: Family<Top> = Family {
    reference: |moments, rate| FreeTop { moments: *moments }.body_acceleration(rate),
    checks: &[("forms/free-top", top)],
    planted: &[
        wrong("forms/top-sign", "has the gyroscopic term with the wrong sign", |moments, rate| {
            -FreeTop { moments: *moments }.body_acceleration(rate)
        }),
        wrong("forms/top-torque-for-acceleration", "gives JΩ × Ω without dividing by J", |moments, rate| {
            moments.component_mul(rate).cross(rate)
        }),
        wrong("forms/top-as-a-ball", "leaves the gyroscopic term out", |_, _| Vector3::zeros()),
    ],
};

/// Six points ±x, ±y, ±z with masses that give the moments J: a = Ω̇ × r + Ω × (Ω × r), Σ m r × a = 0.
fn top(subject: &Top) -> Result<Vec<Finding>> {
    let squares = Vector3::new(1.0, 2.0, 4.0);
    // J₁ = s₂ + s₃ and so on, s_k = Σ m x_k²
    let moments = Vector3::new(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
    let mut findings = Vec::new();
    for rate in [Vector3::new(1.0, 2.0, -3.0), Vector3::new(0.5, -1.0, 0.25)] {
        let turned = subject(&moments, &rate);
        let mut moment = Vector3::zeros();
        for k in 0..3 {
            let mut point = Vector3::zeros();
            point[k] = squares[k].sqrt();
            moment += point.cross(&(turned.cross(&point) + rate.cross(&rate.cross(&point))));
        }
        let size = squares.sum() * (rate.norm_squared() + turned.norm());
        findings.push(Finding::equal("moment of the inertial forces", moment.norm(), 0.0, rounding(64, size), "N·m"));
    }
    Ok(findings)
}

/// Contact time and contact force of a bar that hits a wall.
pub type Bar = fn(&ElasticBar) -> [f64; 2];

/// A bar turns its momentum round, and half-way all its energy is that of the compression ε = F/(E A).
pub static BAR: Family<Bar> = Family {
    reference: |bar| [bar.contact_time(), bar.contact_force()],
    checks: &[("forms/elastic-bar", bar)],
    planted: &[
        wrong("forms/bar-one-passage", "ends the contact when the wave reaches the free end", |bar| {
            [0.5 * bar.contact_time(), bar.contact_force()]
        }),
        wrong("forms/bar-wave-inverted", "takes √(ρ/E) for the speed of the wave", |bar| {
            let c = 1.0 / bar.wave_speed();
            [2.0 * bar.length / c, bar.density * c * bar.area * bar.speed]
        }),
        wrong("forms/bar-twice-the-force", "doubles the pressure at the wall, as for a wave that is reflected there", |bar| {
            [0.5 * bar.contact_time(), 2.0 * bar.contact_force()]
        }),
    ],
};

fn bar(subject: &Bar) -> Result<Vec<Finding>> {
    let bar = ElasticBar::new(2.0, 8.0, 50.0, 0.5, 3.0)?;
    let [time, force] = subject(&bar);
    let mass = bar.density * bar.area * bar.length;
    let (momentum, kinetic) = (2.0 * mass * bar.speed, 0.5 * mass * bar.speed * bar.speed);
    let elastic = 0.5 * force * force * bar.length / (bar.modulus * bar.area);
    Ok(vec![
        Finding::equal("impulse of the wall", force * time, momentum, rounding(16, momentum), "N·s"),
        Finding::equal("elastic energy half-way", elastic, kinetic, rounding(16, kinetic), "J"),
    ])
}

/// (W_nn, W_nt, W_tt) of a sliding edge.
pub type Edge = fn(&SlidingEdge) -> [f64; 3];

/// An edge moves as the body does that its impulse sets in motion: v = P/m, ω = r × P/I, u = v + ω × r.
pub static EDGE: Family<Edge> = Family {
    reference: SlidingEdge::delassus,
    checks: &[("forms/painleve-impact", edge)],
    planted: &[
        wrong("forms/edge-on-the-other-side", "has the edge in front of the centre, so that the coupling has the other sign", |edge| {
            let [nn, nt, tt] = edge.delassus();
            [nn, -nt, tt]
        }),
        wrong("forms/edge-arms-exchanged", "turns the normal row by the vertical arm and the tangential one by the horizontal", |edge| {
            let [nn, nt, tt] = edge.delassus();
            [tt, nt, nn]
        }),
        wrong("forms/edge-held-at-the-centre", "leaves out that the centre moves", |edge| {
            let [nn, nt, tt] = edge.delassus();
            [nn - 1.0 / edge.mass, nt, tt - 1.0 / edge.mass]
        }),
    ],
};

fn edge(subject: &Edge) -> Result<Vec<Finding>> {
    let edge = SlidingEdge { mass: 2.0, inertia: 0.3, arm: [0.4, 0.7] };
    let [nn, nt, tt] = subject(&edge);
    // axes: the tangent away from the side that the edge lies on, the normal upwards; the edge lies at (−X, −Z)
    let r = Vector2::new(-edge.arm[0], -edge.arm[1]);
    let moved = |impulse: Vector2<f64>| {
        let spin = (r.x * impulse.y - r.y * impulse.x) / edge.inertia;
        impulse / edge.mass + Vector2::new(-spin * r.y, spin * r.x)
    };
    let [by_normal, by_tangent] = [moved(Vector2::y()), moved(Vector2::x())];
    let entry = |name: &str, found: f64, expected: f64| Finding::equal(name, found, expected, rounding(16, 4.0), "1/kg");
    Ok(vec![entry("W_nn", nn, by_normal.y), entry("W_nt", nt, by_normal.x), entry("W_tt", tt, by_tangent.x)])
}
