//! Claims of §5 on the projected gradient iterations.

use crate::claims::prelude::*;
use crate::cones::second_order;
use crate::problem::{ContactProblem, Law};
use crate::solvers::{AcceleratedProjectedGradient, ContactSolver, LemkePivoting, Momentum, largest_eigenvalue_bound, objective};
use crate::tolerance;
use moreau_exact::minimum::{Minimum, diagonal};
use moreau_exact::witness::{Part, Witness, decided};

/// The claims of this file.
pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.step",
        statement: r"The projected gradient iteration uses a step $\eta \le 1/\|N\|$, the spectral norm of the Delassus operator.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$\eta \le 1/\|N\|$ suffices (and Nesterov's bound needs it); the plain iteration converges for every
            $\eta < 2/\|N\|$ and not beyond.",
        argument: r"Inside the cone the error is multiplied by $I - \eta N$, whose factor along the largest eigenvalue $L = \|N\|$ is
            $1 - \eta L$. $N = (2, -1; -1, 2)$, $L = 3$, $r = (-1, -1)$, solution $(1, 1)$: an error of 1/100 along $(1, -1)$ is after ten
            exact steps 0 for $\eta = 1/L$, $(9/10)^{10}$ of itself for $\eta = 1.9/L$ and $(11/10)^{10}$ for $\eta = 2.1/L$.",
        controls: &[r"$\eta = 2.1/\|N\|$ in place of $1/\|N\|$, and half of that in place of $1/(2\|N\|)$."],
        sources: &["chapter §5, APGD iteration"],
        check: check!(step_length),
    },
    Claim {
        id: "S5.rates",
        statement: r"Nesterov's acceleration improves the convergence rate of projected gradient from $O(1/k)$ to $O(1/k^2)$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, as upper bounds for the step $1/L$: $f(r_k) - f^* \le L\,R^2/(2k)$ for the plain and
            $\le 2\,L\,R^2/(k + 1)^2$ for the accelerated iteration, $R = \|r_0 - r^*\|$. A well-conditioned problem converges far
            faster.",
        argument: r"Beck and Teboulle's bounds, asserted at each of the first 300 iterations of a row of 40 pressed masses ($N$
            tridiagonal 2, −1, $r^*$ from Lemke). With $N = I$ both end after one iteration, so no exponent describes them.",
        controls: &[
            "The plain iteration held against the accelerated bound, which it breaks.",
            "A plain iteration with a hundredth of the step, which breaks its bound.",
        ],
        sources: &[
            "chapter §5, APGD",
            "Beck and Teboulle, A fast iterative shrinkage-thresholding algorithm (2009), bounds of both methods",
        ],
        check: check!(rates),
    },
    Claim {
        id: "S5.one-matvec",
        statement: r"Each iteration needs one product $N\,y$ (possibly without forming $N$) and one projection, so that its cost is linear
            in the number of contacts.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"One product and one projection per iteration suffice, with the fixed step that the chapter takes. The cost is
            linear in the contacts if $N$ is applied as $D^T(M^{-1}(D\gamma))$ and each contact moves few coordinates: assembled, $N$ has
            $k^2$ blocks for $k$ contacts on one body, and in the joint coordinates of a chain $D$ itself has $k^2/2$ entries.",
        argument: r"A fixed-step implementation that counts its products uses 50 in 50 iterations and reproduces the iterates of the
            library's solver. Doubling the contacts from 16 to 32 multiplies the non-zeros of $D$ by 2; of the assembled $N$ by 4 if all
            contacts touch one body.",
        controls: &[
            r"Every contact on a body of its own: the non-zeros of $N$ grow as those of $D$.",
            "An exact line search, which needs a second product in every iteration.",
            r"A contact on each link of a chain in joint coordinates: $D$ is a full triangle.",
        ],
        sources: &["chapter §5, APGD iteration"],
        check: check!(products),
    },
];

fn step_length(reading: Reading) -> Result<Vec<Finding>> {
    let allowed = reading.pick(ratio(1, 3), ratio(21, 30));
    let power = |x: Rational| (0..10).fold(ratio(1, 1), |product, _| product * x.clone());
    Ok(vec![
        Finding::exact("error after 10 steps with η = 1/‖N‖, relative", &error_after_ten_steps(&allowed), &ratio(0, 1), "1"),
        Finding::exact("the same with η = 1/(2‖N‖)", &error_after_ten_steps(&(&allowed * ratio(1, 2))), &power(ratio(1, 2)), "1"),
        Finding::exact("the same with η = 1.9/‖N‖", &error_after_ten_steps(&(ratio(19, 10) * ratio(1, 3))), &power(ratio(9, 10)), "1")
            .context(),
        Finding::exact("the same with η = 2.1/‖N‖", &error_after_ten_steps(&(ratio(21, 10) * ratio(1, 3))), &power(ratio(11, 10)), "1")
            .context(),
    ])
}

/// Ten exact projected gradient steps for N = (2, −1; −1, 2), r = (−1, −1) over γ ≥ 0, from (1.01, 0.99): the error along
/// (1, −1), relative.
fn error_after_ten_steps(eta: &Rational) -> Rational {
    let start = ratio(1, 100);
    let mut gamma = [ratio(1, 1) + start.clone(), ratio(1, 1) - start.clone()];
    for _ in 0..10 {
        gamma = onto_quadrant(&descended(&gamma, eta));
    }
    (gamma[0].clone() - gamma[1].clone()) * ratio(1, 2) / start
}

/// γ − η (N γ + r).
fn descended(gamma: &[Rational; 2], eta: &Rational) -> [Rational; 2] {
    let gradient = |one: &Rational, other: &Rational| ratio(2, 1) * one - other - ratio(1, 1);
    let after = || [gradient(&gamma[0], &gamma[1]), gradient(&gamma[1], &gamma[0])];
    let slope = decided(after, |found| {
        let row = |one: i64, other: i64| vec![ratio(one, 1), ratio(other, 1)];
        let data = [("delassus", Part::Matrix(vec![row(2, -1), row(-1, 2)])), ("velocity", Part::Vector(row(-1, -1)))];
        let told = [("impulse", gamma.as_slice().into()), ("after", found.as_slice().into())];
        Some(Witness::new("response", data.into_iter().chain(told).collect()))
    });
    std::array::from_fn(|i| &gamma[i] - eta * &slope[i])
}

/// The nearest point without negative entries.
fn onto_quadrant(place: &[Rational; 2]) -> [Rational; 2] {
    let (zero, one) = (ratio(0, 1), ratio(1, 1));
    let nearest = || place.clone().map(|entry| entry.max(zero.clone()));
    let least = || Minimum::projection([one.clone(), one.clone()], place, diagonal([one.clone(), one.clone()]).to_vec());
    decided(nearest, |found| least().witness(found))
}

/// Masses in a row, the first pressed against the others: N tridiagonal with 2 and −1.
pub(super) fn pressed_row(contacts: usize) -> ContactProblem {
    ContactProblem::new(
        DMatrix::from_fn(contacts, contacts, |i, j| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        }),
        DVector::from_fn(contacts, |k, _| if k == 0 { -1.0 } else { 0.0 }),
    )
    .name("pressed row")
    .law(Law::Frictionless)
    .rows_per_contact(1)
    .build()
    .expect("a row of finite numbers")
}

/// max over k ≤ 300 of (f(r_k) − f*)/bound(L, R, k).
fn largest_ratio(momentum: Momentum, bound: fn(f64, f64, f64) -> f64) -> Result<f64> {
    let problem = pressed_row(40);
    let exact = LemkePivoting.solve(&problem, None)?.impulse;
    let (best, radius, size) = (objective(&problem, &exact), exact.norm(), largest_eigenvalue_bound(problem.dense()));
    // rounding of two objectives of size ‖N‖‖r‖²
    let rounding = tolerance::rounding(problem.rows(), size * radius * radius);
    let mut largest: f64 = 0.0;
    AcceleratedProjectedGradient { momentum, iterations: 300, ..Default::default() }.solve_observed(&problem, None, |k, impulse| {
        largest = largest.max((objective(&problem, impulse) - best - rounding) / bound(size, radius, k as f64));
    })?;
    Ok(largest)
}

/// The same of plain projected gradients with a share of the step 1/L.
fn largest_ratio_of_slow(share: f64, bound: fn(f64, f64, f64) -> f64) -> Result<f64> {
    let problem = pressed_row(40);
    let exact = LemkePivoting.solve(&problem, None)?.impulse;
    let (best, radius, size) = (objective(&problem, &exact), exact.norm(), largest_eigenvalue_bound(problem.dense()));
    let mut impulse = DVector::zeros(problem.rows());
    let mut largest: f64 = 0.0;
    for k in 1..=300 {
        let slope = problem.dense() * &impulse + problem.free_velocity();
        impulse = (impulse - slope * (share / size)).map(|entry: f64| entry.max(0.0));
        largest = largest.max((objective(&problem, &impulse) - best) / bound(size, radius, f64::from(k)));
    }
    Ok(largest)
}

/// In how many of 300 iterations the distance to the solution grows.
pub(super) fn grown(problem: &ContactProblem, momentum: Momentum) -> Result<usize> {
    let exact = LemkePivoting.solve(problem, None)?.impulse;
    let rounding = tolerance::rounding(problem.rows(), exact.norm());
    let (mut before, mut count) = (exact.norm(), 0);
    AcceleratedProjectedGradient { momentum, iterations: 300, ..Default::default() }.solve_observed(problem, None, |_, impulse| {
        let distance = (impulse - &exact).norm();
        count += usize::from(distance > before + rounding);
        before = distance;
    })?;
    Ok(count)
}

fn rates(reading: Reading) -> Result<Vec<Finding>> {
    let plain_bound: fn(f64, f64, f64) -> f64 = |l, r, k| l * r * r / (2.0 * k);
    let fast_bound: fn(f64, f64, f64) -> f64 = |l, r, k| 2.0 * l * r * r / (k + 1.0).powi(2);
    let fast = largest_ratio(reading.only(0).pick(Momentum::Nesterov, Momentum::Plain), fast_bound)?;
    let plain = match reading {
        Reading::Control(1) => largest_ratio_of_slow(0.01, plain_bound)?,
        _ => largest_ratio(Momentum::Plain, plain_bound)?,
    };
    let easy = pressed_row(40).into_builder().delassus(DMatrix::identity(40, 40)).build()?;
    let at_once = AcceleratedProjectedGradient::default().solve(&easy, None)?.iterations;
    Ok(vec![
        Finding::at_most("largest (f − f*)/(2LR²/(k+1)²), accelerated", fast, 1.0, "1"),
        Finding::at_most("largest (f − f*)/(LR²/2k), plain", plain, 1.0, "1"),
        Finding::count("iterations for N = I", at_once, 1).context(),
    ])
}

/// The chapter's iteration, counting its products; with the step of an exact line search, or the fixed one.
fn counted(problem: &ContactProblem, iterations: usize, searched: bool) -> (DVector<f64>, usize) {
    let mut products = 0;
    let mut apply = |vector: &DVector<f64>| {
        products += 1;
        problem.dense() * vector
    };
    let fixed = 1.0 / largest_eigenvalue_bound(problem.dense());
    let mut gamma = DVector::zeros(problem.rows());
    let mut point = gamma.clone();
    let mut t: f64 = 1.0;
    for _ in 0..iterations {
        let slope = apply(&point) + problem.free_velocity();
        let step = if searched { slope.norm_squared() / slope.dot(&apply(&slope)) } else { fixed };
        let mut next = &point - slope * step;
        next.as_mut_slice().iter_mut().for_each(|entry| second_order::project(std::slice::from_mut(entry), 0.0));
        let longer = 0.5 * (1.0 + (1.0 + 4.0 * t * t).sqrt());
        point = &next + (&next - &gamma) * ((t - 1.0) / longer);
        (gamma, t) = (next, longer);
    }
    (gamma, products)
}

fn products(reading: Reading) -> Result<Vec<Finding>> {
    const ITERATIONS: usize = 50;
    let problem = pressed_row(40);
    let (gamma, products) = counted(&problem, ITERATIONS, reading.only(1).pick(false, true));
    let solver = AcceleratedProjectedGradient { momentum: Momentum::Nesterov, iterations: ITERATIONS, tolerance: 0.0 };
    let difference = (solver.solve(&problem, None)?.impulse - &gamma).norm();
    // every iteration adds the rounding of one product and one step; momentum carries at most ITERATIONS of them along
    let bound = tolerance::rounding(problem.rows(), gamma.norm()) * (ITERATIONS * ITERATIONS) as f64;
    let nonzero = |matrix: &DMatrix<Rational>| matrix.iter().filter(|x| **x != ratio(0, 1)).count() as i64;
    let one_body =
        |contacts: usize| DMatrix::from_fn(contacts, 3, |k, j| [ratio(1, 1), ratio(k as i64 + 1, 1), ratio(1, k as i64 + 2)][j].clone());
    let of_its_own = |contacts: usize| DMatrix::from_fn(contacts, contacts, |k, j| ratio(i64::from(k == j), 1));
    let chain = |contacts: usize| DMatrix::from_fn(contacts, contacts, |k, j| ratio(i64::from(j <= k), 1));
    let transposed = |contacts: usize| match reading {
        Reading::Control(0) => of_its_own(contacts),
        Reading::Control(2) => chain(contacts),
        _ => one_body(contacts),
    };
    let growth = |of: &dyn Fn(usize) -> i64| ratio(of(32), of(16));
    Ok(vec![
        Finding::count("products in 50 iterations", products, ITERATIONS),
        Finding::equal("distance to the library's iterate", difference, 0.0, bound, "N·s"),
        Finding::exact("growth of D's non-zeros from 16 to 32 contacts", &growth(&|k| nonzero(&transposed(k))), &ratio(2, 1), "1"),
        Finding::exact(
            "growth of the assembled N's, one body",
            &growth(&|k| nonzero(&(transposed(k) * transposed(k).transpose()))),
            &ratio(4, 1),
            "1",
        )
        .says(ratio(2, 1))
        .violating("N applied as Dᵀ(M⁻¹(Dγ)), or few contacts per body"),
    ])
}
