//! Projections on the friction cone K_μ = {‖z_t‖ ≤ μ z_n}: level `project`.
//!
//! ```text
//!     ‖z_t‖ ≤ μ z_n      r = z
//!     μ‖z_t‖ ≤ −z_n      r = 0
//!     otherwise          r_n = (z_n + μ‖z_t‖)/(1 + μ²) ,  ‖r_t‖ = μ r_n
//! ```
//! The references are rational: each point has a rational tangential norm, and its nearest point is proved by Moreau's decomposition in
//! exact arithmetic ([`moreau_checks::cone_projection`]). Every number is relative to ‖z‖, so that an absolute threshold shows.

use crate::check::{Control, Run};
use crate::checks::scenery::worst;
use crate::tolerance::projection as tolerance;
use crate::{Bench, Check, Expectation, Level, Measurement, Reply};
use moreau_checks::cone_projection::{RationalPoint, cone_excess, difference, dot, norm, polar_excess};
use moreau_contact::cones::Case;
use moreau_exact::scalar::{Rational, Scalar, ratio};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "projection/regions",
        level: Level::Project,
        question: "Is the nearest point found inside the cone, inside its polar cone and between them, in two and three dimensions?",
        derivation: "The nearest point is rational and proved exactly; the engine's may differ by the rounding of a dozen operations.",
        source: "chapter §5, with the polar condition μ‖z_t‖ ≤ −z_n in place of z_n < 0",
        run: Run::Once(regions),
        control: Control { passes: "moreau-jean", fails: "projection/negative-normal-is-open" },
    },
    Check {
        name: "projection/boundaries",
        level: Level::Project,
        question: "Is the nearest point right on both boundaries, 2⁻⁴⁰ beside them on either side, at the apex, and for μ = 0?",
        derivation: "The projection is continuous: whichever case rounding picks, the answer differs by rounding.",
        source: "chapter §5",
        run: Run::Once(boundaries),
        control: Control { passes: "moreau-jean", fails: "projection/absolute-threshold" },
    },
    Check {
        name: "projection/optimality",
        level: Level::Project,
        question: "Do the engine's answers decompose as Moreau's theorem demands?",
        derivation: "z = r + p with r ∈ K, p ∈ K°, r·p = 0 characterises the projection; it is idempotent, does not expand distances and \
                     commutes with scaling. No reference is involved.",
        source: "Moreau 1962",
        run: Run::Once(optimality),
        control: Control { passes: "moreau-jean", fails: "projection/along-the-normal" },
    },
];

/// The friction coefficients of the rational points.
fn coefficients() -> [Rational; 5] {
    [ratio(0, 1), ratio(1, 3), ratio(1, 1), ratio(5, 2), ratio(10, 1)]
}

/// Points well inside each region: at tangential norm ρ the boundaries are z_n = ρ/μ and z_n = −μρ.
fn inner_points(mu: &Rational) -> Vec<RationalPoint> {
    let mut points = Vec::new();
    for (radius, slope) in [(ratio(3, 5), ratio(1, 2)), (ratio(4, 1), ratio(-3, 1)), (ratio(1, 128), ratio(0, 1))] {
        let polar = -(mu.clone() * radius.clone());
        let mut add = |normal: Rational, radius: &Rational| {
            points.push(RationalPoint { normal, radius: radius.clone(), slope: slope.clone(), mu: mu.clone() });
        };
        add(polar.clone() - ratio(1, 1), &radius);
        add(polar / ratio(2, 1), &radius);
        add(radius.clone() / (ratio(2, 1) * (ratio(1, 1) + mu.clone())), &radius);
        let inside =
            if *mu == ratio(0, 1) { (ratio(2, 1), ratio(0, 1)) } else { (radius.clone() / mu.clone() + ratio(1, 2), radius.clone()) };
        add(inside.0, &inside.1);
    }
    points
}

fn regions(bench: &mut Bench) -> Reply<Vec<Measurement>> {
    let mut largest = [0.0; 3];
    for mu in coefficients() {
        let points = inner_points(&mu);
        let spatial = errors(bench, &mu, &points, 3)?;
        // In the plane the tangential entry is ρ itself.
        let planar = errors(bench, &mu, &points, 2)?;
        for (point, error) in points.iter().chain(&points).zip(spatial.into_iter().chain(planar)) {
            let case = point.case() as usize;
            largest[case] = worst(largest[case], error);
        }
    }
    let words = [(Case::Stays, "inside the cone"), (Case::Apex, "in the polar cone"), (Case::Boundary, "between the cones")];
    let measured = |(case, words): (Case, &str)| from_exact(bench, words, largest[case as usize]);
    Ok(words.map(measured).into())
}

fn boundaries(bench: &mut Bench) -> Reply<Vec<Measurement>> {
    let points = RationalPoint::around_the_boundaries();
    let (mut with, mut without) = (0.0, 0.0);
    for group in points.chunk_by(|one, other| one.mu == other.mu) {
        for rows in [2, 3] {
            let error = errors(bench, &group[0].mu, group, rows)?.into_iter().fold(0.0, worst);
            let largest = if group[0].mu == ratio(0, 1) { &mut without } else { &mut with };
            *largest = worst(*largest, error);
        }
    }
    Ok(vec![from_exact(bench, "on and beside the boundaries", with), from_exact(bench, "on and beside the boundaries of μ = 0", without)])
}

/// ‖r − P(z)‖/‖z‖ of each point (absolute at z = 0), with `rows` entries.
fn errors(bench: &mut Bench, mu: &Rational, points: &[RationalPoint], rows: usize) -> Reply<Vec<f64>> {
    let floats = |entries: [Rational; 3]| entries.each_ref().map(Scalar::to_f64);
    let flat = |z: [f64; 3]| if rows == 3 { z.to_vec() } else { vec![z[0], z[1].hypot(z[2])] };
    let request: Vec<Vec<f64>> = points.iter().map(|point| flat(floats(point.entries()))).collect();
    let answers = bench.project(Scalar::to_f64(mu), &request)?;
    let error = |((point, z), r): ((&RationalPoint, &Vec<f64>), &Vec<f64>)| {
        let distance = norm(&difference(r, &flat(floats(point.nearest()))));
        if norm(z) > 0.0 { distance / norm(z) } else { distance }
    };
    Ok(points.iter().zip(&request).zip(&answers).map(error).collect())
}

fn from_exact(bench: &Bench, words: &str, value: f64) -> Measurement {
    let ideal = Expectation::equal(0.0, tolerance::position(bench.epsilon()), "the exact nearest point, rounded");
    Measurement::new(format!("distance from the exact projection over ‖z‖, {words}"), "1", value, ideal)
}

/// Directions over the whole sphere: a spiral of equal areas, its turns by the golden angle.
fn spiral() -> Vec<Vec<f64>> {
    let count = 40;
    let point = |k: usize| {
        let normal = 1.0 - (2 * k + 1) as f64 / count as f64;
        let (sine, cosine) = (k as f64 * std::f64::consts::PI * (3.0 - 5f64.sqrt())).sin_cos();
        let radius = (1.0 - normal * normal).sqrt();
        vec![normal, radius * cosine, radius * sine]
    };
    (0..count).map(point).collect()
}

/// How much smaller the scaled points are.
const SCALE: f64 = 1.0 / (1u64 << 40) as f64;

fn optimality(bench: &mut Bench) -> Reply<Vec<Measurement>> {
    let points = spiral();
    let scaled: Vec<Vec<f64>> = points.iter().map(|z| z.iter().map(|x| x * SCALE).collect()).collect();
    let mut largest = [0.0; 6];
    for mu in [0.0, 0.25, 1.0, 2.0, 10.0] {
        let once = bench.project(mu, &points)?;
        let twice = bench.project(mu, &once)?;
        let small = bench.project(mu, &scaled)?;
        for (k, (z, r)) in points.iter().zip(&once).enumerate() {
            let (next, rest) = ((k + 1) % points.len(), difference(z, r));
            let enlarged: Vec<f64> = small[k].iter().map(|x| x / SCALE).collect();
            let here = [
                cone_excess(r, mu),
                polar_excess(&rest, mu),
                dot(r, &rest).abs(),
                norm(&difference(&twice[k], r)),
                norm(&difference(r, &once[next])) - norm(&difference(z, &points[next])),
                norm(&difference(&enlarged, r)),
            ];
            for (largest, here) in largest.iter_mut().zip(here) {
                *largest = worst(*largest, here);
            }
        }
    }
    let (position, product) = (tolerance::position(bench.epsilon()), tolerance::product(bench.epsilon()));
    let rows = [
        ("excess over the cone", 2.0 * position),
        ("excess of the remainder over the polar cone", 2.0 * position),
        ("product of projection and remainder", product),
        ("change by a second projection", position),
        ("expansion of distances", 2.0 * position),
        ("difference between projecting a small point and scaling the projection", 2.0 * position),
    ];
    let measured = |((name, allowed), value): ((&str, f64), f64)| {
        Measurement::new(format!("{name}, at points of size 1"), "1", value, Expectation::at_most(0.0, allowed, "Moreau's decomposition"))
    };
    Ok(rows.into_iter().zip(largest).map(measured).collect())
}
