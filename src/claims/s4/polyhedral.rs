//! The friction cone with d directions: how far it is from the circular one, and what sliding on it looks like.

use super::matrices::integers;
use crate::claims::experiments::polygon::Spread;
use crate::claims::prelude::*;
use crate::cones::polyhedral::{direction_error, strength_error};
use crate::mechanics::{Mechanism, Plane, PointMass, State};
use crate::problem::PlanarProblem;
use crate::schemes::{MoreauJean, Scheme, StewartTrinkle, step};
use crate::solvers::Auto;
use crate::solvers::lemke::{LemkeOutcome, lemke};
use crate::tolerance::claims::{SLIDE_STEP, slide_drift};
use crate::tolerance::rounding;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Claims on the polyhedral cone.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.poly-order",
        statement: r"The polyhedral cone has an error $O(1/d)$ in its shape (§4, its summary, §5's insight); it has an error $O(1/d^2)$ in
            the radius (§4's pitfall) and in its shape (§5's table).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"Shape and strength: $1 - \cos(\pi/d) \approx \pi^2/(2d^2)$, so $O(1/d^2)$ is the order and $O(1/d)$ a bound
            that is not sharp. $O(1/d)$ is the order of the direction of the force, $\pi/d$, and of the force vector,
            $2 \sin(\pi/2d) \approx \pi/d$. In the plane $d = 2$ has no error.",
        argument: r"The inscribed regular $d$-gon has inradius $\cos(\pi/d)$, which is its Hausdorff distance $1 - \cos(\pi/d)$ from the
            disk: times $d^2$ it lies in $[\pi^2/2 - \pi^4/(24\,d^2), \pi^2/2]$. Read as upper bounds both orders hold of it. Read as the
            order, $O(1/d)$ says that twice the directions halve the error; they divide it by $2(1 + \cos(\pi/64)) = 3.998$ from $d = 32$
            to 64: as orders of one shape the two exclude each other.",
        controls: &[
            r"Directions added in one quadrant only: the radius stays short by $1 - \cos(\pi/4)$ in the others, and neither order holds of
                it.",
        ],
        sources: &["chapter §4, compromise, summary and pitfall", "chapter §5, table and insight on the two approximations"],
        check: check!(order),
    },
    Claim {
        id: "S4.d8",
        statement: r"The error of the polyhedral cone is $O(1/d^2)$ (for the radius); $d = 8$ is already quite accurate. What changes in
            kind is a slight anisotropy.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: r"$d = 8$ is 7.6 % weak in the worst direction and up to 22.5° off in the direction of the force; a free slide
            drifts sideways by up to 10.6 % of its stopping distance.",
        argument: r"$1 - \cos(\pi/8) = 0.0761$. A slide at angle $\psi$ from a direction keeps that direction's friction until the
            velocity has turned to the bisector, then follows the bisector: with $v^2 = 2\mu g\cdot s$ the sideways displacement has the
            closed form of `lateral_drift`, largest at $\psi = 0.200$ where it is 0.1056 of the stopping distance. Stewart–Trinkle with 8
            directions measures the same; the first order of the drift is $(\pi/4)/d$, not $1/d^2$.",
        controls: &["The circular cone, which is what quite accurate would mean."],
        sources: &["chapter §4, pitfall on the polyhedral cone"],
        check: check!(eight_directions),
    },
    Claim {
        id: "S4.aniso",
        statement: r"The friction force is restricted to $d$ discrete directions, which makes sliding along the basis directions slightly
            easier or harder than along the diagonals.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Basis directions are the harder ones (full $\mu$), bisectors the easier ones ($\mu \cos(\pi/d)$), so stopping
            distances differ by sec($\pi/d$): 1.414, 1.082, 1.020 for $d = 4$, 8, 16. Sticking and sliding along a bisector use
            combinations of directions; the bisectors attract the sliding direction.",
        argument: r"The inscribed polygon reaches $\mu$ at its vertices and $\mu \cos(\pi/d)$ at the middle of its sides. One
            Stewart–Trinkle step along a direction and along the bisector loses speed in exactly this ratio. In a slide between them
            friction points along one direction; in a slide along the bisector it is a combination of two, $\pi/d$ beside either; and a
            slide that starts a quarter of the way from direction to bisector turns towards the bisector.",
        controls: &["Coulomb's circular cone.", "Two directions more.", "A floor with half the coefficient of friction."],
        sources: &["chapter §4, pitfall on the polyhedral cone"],
        check: check!(anisotropy),
    },
    Claim {
        id: "S4.maxdiss",
        statement: r"The slip-rate multiplier $\sigma$ with $\mu\lambda - E^T\beta \ge 0 \perp \sigma \ge 0$ reproduces the principle of
            maximal dissipation: $\sigma = 0$ while sticking, $\sigma > 0$ and full friction while sliding.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$\beta$ maximises $-u_t\cdot D\beta$ over $\beta \ge 0$, $E^T\beta \le \mu\lambda$ – on the polyhedral cone –
            and $\sigma$ is the multiplier of that linear programme, $\sigma = \max_j(-D_j\cdot u_t)$.",
        argument: r"$\beta \ge 0 \perp D^Tu_t + E\sigma \ge 0$ and $\mu\lambda - E^T\beta \ge 0 \perp \sigma \ge 0$ are the optimality
            conditions of max $-u_t\cdot D\beta$. Its value is $\mu\lambda \max_j(-D_j\cdot u_t)$ by duality. For eight rational
            directions, a coupled rational $W$ and four free velocities the exact Lemke solution dissipates exactly that, and $\sigma = 0$
            when it sticks.",
        controls: &[
            r"An LCP whose cone rows carry $2E^T$, which halves the available friction.",
            r"An LCP whose tangential rows carry $2E$, which halves the slip rate.",
        ],
        sources: &["chapter §4, the LCP matrix and σ"],
        check: check!(maximal_dissipation),
    },
];

fn order(reading: Reading) -> Result<Vec<Finding>> {
    let spread = reading.pick(Spread::Even, Spread::OneQuadrant);
    let error = |d: usize| spread.errors(d)[0];
    let mut findings = Vec::new();
    for d in [8, 16, 32, 64] {
        let square = (d * d) as f64;
        let width = PI.powi(4) / (24.0 * square);
        let (centre, bound) = (PI * PI / 2.0 - 0.5 * width, 0.5 * width + rounding(8, square));
        findings.push(Finding::equal(format!("d² × error of the shape, d = {d}"), square * error(d), centre, bound, "1"));
    }
    // (1 − cos 2x)/(1 − cos x) = 2 (1 + cos x); both errors are rounded to 8 ulp of 1
    let (halved, bound) = (2.0 * (1.0 + (PI / 64.0).cos()), 5.0 * rounding(8, 1.0) / error(64));
    let falls = || Finding::equal("error with d = 32 over that with d = 64", error(32) / error(64), halved, bound, "1");
    findings.push(falls().says(2.0).reading("O(1/d) as the order of the error"));
    findings.push(falls().says_at_least(2.0).reading("O(1/d) as an upper bound"));
    Ok(findings)
}

const FRICTION: f64 = 0.5;
const GRAVITY: f64 = 10.0;
/// The step \[s\] of experiments that take one step only.
const ONE_STEP: f64 = 1.0 / 16.0;

/// A point on a floor, sliding at unit speed at an angle from tangent₁.
struct Slide {
    mechanism: PointMass,
    scheme: Box<dyn Scheme>,
    state: State,
    tangents: DMatrix<f64>,
}

impl Slide {
    fn new(scheme: Box<dyn Scheme>, angle: f64) -> Result<Self> {
        Self::on_a_floor(FRICTION, scheme, angle)
    }

    fn on_a_floor(friction: f64, scheme: Box<dyn Scheme>, angle: f64) -> Result<Self> {
        let floor = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, friction, 0.0)?;
        let mechanism = PointMass::new("sliding point", 1.0, dvector![0.0, 0.0, -GRAVITY], vec![floor])?;
        let position = dvector![0.0, 0.0, 0.0];
        let tangents = mechanism.contacts(&position)[0].jacobian.to_dense().rows(1, 2).into_owned();
        let velocity = tangents.transpose() * dvector![angle.cos(), angle.sin()];
        Ok(Slide { mechanism, scheme, state: State { time: 0.0, position, velocity }, tangents })
    }

    fn advance(&mut self, h: f64) -> Result<()> {
        self.state = step(self.scheme.as_ref(), &Auto, &self.mechanism, &self.state, h)?.state;
        Ok(())
    }

    fn in_plane(&self, vector: &DVector<f64>) -> Vector2<f64> {
        let components = &self.tangents * vector;
        Vector2::new(components[0], components[1])
    }

    fn velocity(&self) -> Vector2<f64> {
        self.in_plane(&self.state.velocity)
    }
}

/// Stewart–Trinkle with d directions; for the controls Coulomb's circular cone, or two directions more.
fn scheme(reading: Reading, d: usize) -> Box<dyn Scheme> {
    match reading {
        Reading::Control(0) => Box::new(MoreauJean { theta: 1.0, ..MoreauJean::default() }),
        Reading::Control(1) => Box::new(StewartTrinkle { directions: d + 2 }),
        Reading::Recorded | Reading::Control(_) => Box::new(StewartTrinkle { directions: d }),
    }
}

/// Friction's share of μ g h in one step from unit speed at an angle, and the angle \[rad\] between it and −u⁺.
fn friction_of_one_step(reading: Reading, d: usize, angle: f64) -> Result<(f64, f64)> {
    let h = ONE_STEP;
    let mut slide = Slide::on_a_floor(reading.only(2).pick(FRICTION, 0.5 * FRICTION), scheme(reading, d), angle)?;
    let before = slide.velocity();
    slide.advance(h)?;
    let friction = before - slide.velocity();
    Ok((friction.norm() / (FRICTION * GRAVITY * h), friction.angle(&slide.velocity())))
}

/// The angle at unit speed from which one step with friction along tangent₁ leaves the velocity at the angle `after`.
fn angle_before_the_step(after: f64) -> f64 {
    let loss = FRICTION * GRAVITY * ONE_STEP;
    let (sine, cosine) = after.sin_cos();
    let speed = (1.0 - (loss * sine).powi(2)).sqrt() - loss * cosine;
    (speed * sine).asin()
}

/// Sideways displacement over v²/(2μg), the stopping distance of Coulomb's friction, for a slide at angle ψ ∈ (0, π/d]
/// from a basis direction.
///
/// Along that direction the speed falls from cos ψ to sin ψ cot(π/d) at constant sin ψ across; then the bisector is
/// followed with deceleration μ g cos(π/d).
fn lateral_drift(d: usize, angle: f64) -> f64 {
    let beta = direction_error(d);
    let (across, along) = angle.sin_cos();
    let turned = across / beta.tan();
    let (first, sideways) = (along * along - turned * turned, 2.0 * across * (along - turned));
    let rest = (across / beta.sin()).powi(2) / beta.cos();
    sideways * along - first * across + rest * (beta - angle).sin()
}

fn eight_directions(reading: Reading) -> Result<Vec<Finding>> {
    let worst_angle = 0.2;
    let (weakest, _) = friction_of_one_step(reading, 8, PI / 8.0)?;
    let beside = PI / 8.0 - 1.0 / 64.0;
    let (_, off) = friction_of_one_step(reading, 8, angle_before_the_step(beside))?;
    let mut slide = Slide::new(scheme(reading, 8), worst_angle)?;
    while slide.velocity().norm() > FRICTION * GRAVITY * SLIDE_STEP {
        slide.advance(SLIDE_STEP)?;
    }
    let place = slide.in_plane(&slide.state.position);
    let sideways = place.y * worst_angle.cos() - place.x * worst_angle.sin();
    let stopping = 1.0 / (2.0 * FRICTION * GRAVITY);
    Ok(vec![
        Finding::equal(
            "sideways drift over stopping distance",
            (sideways / stopping).abs(),
            lateral_drift(8, worst_angle),
            slide_drift(FRICTION * GRAVITY),
            "1",
        )
        .opinion("which error of a cone is quite accurate, and which anisotropy slight"),
        Finding::equal("missing strength along a bisector", 1.0 - weakest, strength_error(8), rounding(64, 1.0), "1"),
        Finding::equal("angle between friction and −u⁺ just before the bisector", off, beside, rounding(128, 1.0), "rad"),
    ])
}

fn anisotropy(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for d in [4, 8, 16] {
        let beta = direction_error(d);
        let (along_basis, _) = friction_of_one_step(reading, d, 0.0)?;
        let (along_bisector, _) = friction_of_one_step(reading, d, beta)?;
        let name = format!("stopping distance along a bisector over that along a direction, d = {d}");
        findings.push(Finding::equal(name, along_basis / along_bisector, 1.0 / beta.cos(), rounding(128, 1.0), "1"));
        findings.push(Finding::equal(format!("friction along a direction over μ m g, d = {d}"), along_basis, 1.0, rounding(64, 1.0), "1"));
        let between = beside_a_direction(reading, d, beta / 4.0)?;
        let on_bisector = beside_a_direction(reading, d, beta)?;
        let bound = rounding(128, 1.0);
        findings.push(Finding::equal(format!("friction beside a direction, slide between them, d = {d}"), between, 0.0, bound, "rad"));
        findings.push(
            Finding::equal(format!("friction beside a direction, slide along a bisector, d = {d}"), on_bisector, beta, bound, "rad")
                .says(0.0)
                .violating("the contact slides, and not along a bisector"),
        );
    }
    let beta = direction_error(8);
    let mut slide = Slide::new(scheme(reading, 8), beta / 4.0)?;
    for _ in 0..8 {
        slide.advance(1.0 / 64.0)?;
    }
    let angle = slide.velocity().y.atan2(slide.velocity().x).abs();
    findings.push(Finding::at_least("sliding direction has turned to the bisector, d = 8", angle, beta / 3.0, "rad").context());
    Ok(findings)
}

/// The angle \[rad\] between the friction of one step from unit speed at an angle and the nearest of the d directions.
fn beside_a_direction(reading: Reading, d: usize, angle: f64) -> Result<f64> {
    let mut slide = Slide::new(scheme(reading, d), angle)?;
    let before = slide.velocity();
    slide.advance(ONE_STEP)?;
    let friction = before - slide.velocity();
    let between = 2.0 * direction_error(d);
    let turns = friction.y.atan2(friction.x) / between;
    Ok((turns - turns.round()).abs() * between)
}

/// Four axes and four Pythagorean directions.
fn rational_directions() -> Vec<[Rational; 2]> {
    let fifths = [[5, 0], [4, 3], [0, 5], [-3, 4], [-5, 0], [-4, -3], [0, -5], [3, -4]];
    fifths.map(|[x, y]| [ratio(x, 5), ratio(y, 5)]).to_vec()
}

fn maximal_dissipation(reading: Reading) -> Result<Vec<Finding>> {
    let directions = rational_directions();
    let delassus = DMatrix::from_row_slice(3, 3, &[4, 1, -1, 1, 3, 1, -1, 1, 5].map(|x| ratio(x, 2)));
    let mu = ratio(1, 2);
    let mut findings = Vec::new();
    for free in [[-2, 3, 1], [-1, -2, 4], [-3, 5, -5], [-6, 1, 0]] {
        let free = integers(&free);
        let mut problem = PlanarProblem::new(delassus.clone(), free.clone()).polyhedral(std::slice::from_ref(&mu), &directions)?;
        let cone_row = problem.generators.ncols();
        for beta in 1..cone_row {
            problem.lcp.matrix[(cone_row, beta)] *= reading.only(0).pick(ratio(1, 1), ratio(2, 1));
            problem.lcp.matrix[(beta, cone_row)] *= reading.only(1).pick(ratio(1, 1), ratio(2, 1));
        }
        let LemkeOutcome::Solution { z, .. } = lemke(&problem.lcp, &DVector::from_element(problem.lcp.size(), ratio(1, 1)))? else {
            findings.push(Finding::decision("the LCP is solved", false, true));
            continue;
        };
        let impulse = problem.impulse(&z);
        let velocity = &delassus * &impulse + &free;
        let rate = |d: &[Rational; 2]| -(d[0].clone() * velocity[1].clone() + d[1].clone() * velocity[2].clone());
        let best = directions.iter().map(rate).fold(ratio(0, 1), |a, b| if b > a { b } else { a });
        let dissipation = -(velocity[1].clone() * impulse[1].clone() + velocity[2].clone() * impulse[2].clone());
        let available = mu.clone() * impulse[0].clone() * best.clone();
        let name = format!("u_free = ({}, {}, {})", free[0], free[1], free[2]);
        findings.push(Finding::exact(format!("dissipation, {name}"), &dissipation, &available, "J"));
        findings.push(Finding::exact(format!("σ, {name}"), &z[cone_row], &best, "m/s"));
    }
    Ok(findings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_drift_of_eight_directions_is_a_tenth_of_the_stopping_distance() {
        let drifts = (1..400).map(|k| lateral_drift(8, PI / 8.0 * f64::from(k) / 400.0));
        let largest = drifts.fold(0.0, f64::max);
        assert!((largest - 0.10562).abs() < 1e-4, "{largest}");
    }
}
