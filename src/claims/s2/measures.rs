//! The base measure, and what is known about existence and uniqueness of sweeping processes.

use super::half_space::whole;
use crate::claims::experiments::cantor::Rise;
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::{accumulation_time_ratio, impact_time_ratio};
use crate::problem::PlanarProblem;
use crate::solvers::enumeration::all_solutions;
use std::cmp::Ordering;

/// Claims on measures and uniqueness.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S2.base-measure",
        statement: r"The base measure is $d\mu = dt + \sum_i\,\delta_{t_i}$, the Lebesgue measure and an atom at each impact; $v$ is of
            bounded variation and $dv$ splits into $\dot v\,dt$ and jumps.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Definition,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"True for finitely many impacts in bounded time and without a Cantor part of $dv$. Past a Zeno point the atoms
            need summable weights, for instance the jumps: $d\mu = dt + |dv|$.",
        argument: r"The masses of the atoms $n$ … $2n$ must fall as $n$ doubles if the atoms are to have a finite sum. The elastic ball
            makes eight impacts in 15 fall times, and no more. With $e = 1/2$ there are infinitely many before $T_\infty$, each with unit
            mass: the masses double with $n$, so $\sum\delta_{t_i}$ is not finite on any neighbourhood of $T_\infty$. The jumps
            $(1 + e)e^kv_0$ sum to $(1 + e)/(1 - e)\,v_0 = 3\,v_0$. Functions of bounded variation may also grow on a null set without
            jumping: on the intervals of the $n$-th generation of Cantor’s set, whose total length falls to 0, his function rises by 1 for
            $n = 2$, 4, 8, and by $2^{-n}$ on each. As the values of the inclusion are cones, any other $d\mu$ that dominates $dt$ and
            $dv$ serves as well.",
        controls: &[
            r"The atoms weighted with the jumps, and $x$ in place of Cantor’s function.",
            r"The ball with $e = 1/2$ up to $T_\infty$ in place of the elastic one.",
        ],
        sources: &["chapter §2, step 4, term by term", "Ambrosio, Fusco and Pallara, Functions of Bounded Variation (2000), §3.2"],
        check: check!(base_measure),
    },
    Claim {
        id: "S2.sweep-theory",
        statement: r"Sweeping processes are rigorous mathematics with a complete theory of existence and uniqueness (Moreau 1977 for
            convex $C(t)$, later prox-regular sets). “Sweeping” stands for $-\dot q \in N_{C(t)}(q)$ (of first order) or its second-order
            dynamic version.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"Existence and uniqueness hold for the first-order process with convex or prox-regular $C(t)$. For the
            second-order process of this chapter uniqueness needs analytic data and no friction. The text names the second order in the
            next sentence, on the meaning of the word; whether the theory is said to cover it is open.",
        argument: r"First order, convex: the catching-up steps $q \mapsto P_{C(t)}(q)$ are non-expansive, so two motions never separate –
            checked exactly on a moving interval. Not prox-regular: $C(t) = \{|q| \ge t\}$ sweeps $q(0) = 0$ to $t$ and to $-t$, both with
            $-\dot q \in N$. Second order without friction, $C = \{q \ge 0\}$, $e = 1/2$, $q(0) = 0$, $v(0) = 0$: a point pulled to the
            floor stays there. If the pull alternates between 1 and 16 m/s² it also bounces away: a flight up under 1 and down under 16
            lands 4 times as fast as it left, leaves 2 times as fast as before, and backwards in time the flights shrink to the start.
            Under a constant pull they do not. Second order with friction: $W = \begin{bmatrix}1 & 2 \\ 2 & 5\end{bmatrix}$, $\mu = 1$, free motion $(1, 10)$ admits
            $r = (0, 0)$, (1,−1) and (15,−8): separation, sliding contact, impact (Painlevé).",
        controls: &[
            r"A constant pull, and $W$ diagonal.",
            r"The set $|q| \ge t$ in place of the interval, the pull that alternates and the $W$ that jams in place of those that do
                not.",
        ],
        sources: &[
            "chapter §2, pitfall on the sweeping process",
            "Moreau, Evolution problem associated with a moving convex set in a Hilbert space (1977)",
            "Painlevé (1895)",
            "Schatzman (1978) and Ballard, The dynamics of discrete mechanical systems with perfect unilateral constraints (2000), for \
            analytic data",
        ],
        check: check!(sweeping_theory),
    },
];

fn base_measure(reading: Reading) -> Result<Vec<Finding>> {
    let half = ratio(1, 2);
    let weight = |impact: usize| reading.only(0).pick(whole(1), (whole(1) + &half) * power(&half, impact));
    let until_accumulation = accumulation_time_ratio(&half);
    let summable = |e: &Rational, until: &Rational| {
        let before = |impact: &usize| impact_time_ratio(e, *impact) < *until;
        let block = |n: usize| (n..2 * n).filter(before).map(weight).fold(whole(0), |sum, atom| sum + atom);
        [8, 16, 32].windows(2).all(|pair| block(pair[1]) <= &half * block(pair[0]))
    };
    let rise = reading.only(0).pick(Rise::Cantor, Rise::Uniform);
    let (often, until) = reading.only(1).pick((whole(1), whole(15)), (half.clone(), until_accumulation.clone()));
    let rise_on_set = |generation: usize| {
        let [rest, largest] = rise.on_cantors_set(generation);
        rest + largest
    };
    let falls = [2, 4, 8].windows(2).all(|pair| rise_on_set(pair[1]) <= &half * rise_on_set(pair[0]));
    let [_, largest] = Rise::Cantor.on_cantors_set(8);
    Ok(vec![
        Finding::decision("the atoms of an elastic ball have a finite sum over 15 fall times", summable(&often, &until), true),
        Finding::decision("those of the ball with e = 1/2 have one before T∞", summable(&half, &until_accumulation), false)
            .says(true)
            .violating("finitely many impacts in bounded time"),
        Finding::decision("the rise on the intervals of Cantor's set falls with their length", falls, false)
            .says(true)
            .violating("dv without a Cantor part"),
        Finding::exact("largest rise on an interval of generation 8", &largest, &ratio(1, 256), "1").context(),
    ])
}

fn power(base: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(whole(1), |product, _| product * base.clone())
}

/// The point of C(t) next to a place.
type Projection = fn(&Rational, &Rational) -> Rational;

/// C(t) = [t, 2 + t/2].
fn into_interval(place: &Rational, time: &Rational) -> Rational {
    place.clone().max(time.clone()).min(whole(2) + time * ratio(1, 2))
}

/// C(t) = {|q| ≥ t}; 0 goes down.
fn out_of_interval(place: &Rational, time: &Rational) -> Rational {
    if *place > whole(0) { place.clone().max(time.clone()) } else { place.clone().min(-time.clone()) }
}

/// Where catching up with C(t) takes a start, at the times k/8 up to 3.
fn catch_up(project: Projection, start: Rational) -> Vec<Rational> {
    let mut place = start;
    let positions = (0..=24).map(|k| {
        place = project(&place, &ratio(k, 8));
        place.clone()
    });
    positions.collect()
}

/// Whether q(t) = c t solves `−q̇ ∈ N_{C(t)}(q)`, q(0) = 0, for C(t) = {|q| ≥ t}.
fn swept_out(c: &Rational) -> bool {
    let rate = -c.clone();
    match c.clone().max(-c.clone()).cmp(&whole(1)) {
        Ordering::Less => false,                         // q is not in C(t)
        Ordering::Equal => rate * c.clone() <= whole(0), // N = {g : g q ≤ 0} on the boundary
        Ordering::Greater => rate == whole(0),           // N = {0} inside
    }
}

/// The distinct impulses that solve one planar contact with μ = 1 and free velocity (1, 10).
fn planar_contact(coupling: i64) -> Result<Vec<DVector<Rational>>> {
    let delassus = DMatrix::from_row_slice(2, 2, &[whole(1), whole(coupling), whole(coupling), whole(5)]);
    let free = DVector::from_vec(vec![whole(1), whole(10)]);
    let problem = PlanarProblem::new(delassus, free).coulomb(&[whole(1)])?;
    let set = all_solutions(&problem.lcp)?;
    // families move σ only: the slip rate of an open contact is not determined, its impulse is
    let mut impulses: Vec<DVector<Rational>> = Vec::new();
    for z in &set.points {
        let impulse = problem.impulse(z);
        if !impulses.contains(&impulse) {
            impulses.push(impulse);
        }
    }
    Ok(impulses)
}

fn sweeping_theory(reading: Reading) -> Result<Vec<Finding>> {
    let project: Projection = reading.only(1).pick(into_interval, out_of_interval);
    let (left, right) = (catch_up(project, whole(0)), catch_up(project, ratio(3, 2)));
    let gaps: Vec<Rational> = left.iter().zip(&right).map(|(a, b)| b.clone() - a.clone()).collect();
    let separating = gaps.windows(2).filter(|pair| pair[1] > pair[0]).count();
    let swept = (-4..=4).filter(|c| swept_out(&ratio(*c, 2))).count();
    let (steady, alternating) = (reading.only(1).pick(whole(1), whole(16)), reading.only(0).pick(whole(16), whole(1)));
    let (diagonal, jams) = (reading.only(1).pick(0, 2), reading.only(0).pick(2, 0));
    let (first, second) = ("the theory of the first order", "the theory of both orders");
    let motions = |down: &Rational| motions_from_rest(&whole(1), down);
    Ok(vec![
        Finding::count("motions from rest under a pull that alternates between 1 and 16 m/s²", motions(&alternating), 2)
            .says(1)
            .reading(second),
        Finding::count("solutions of a second-order step that jams", planar_contact(jams)?.len(), 3).says(1).reading(second),
        Finding::count("motions from rest on the floor under a constant pull", motions(&steady), 1).reading(second),
        Finding::count("solutions of a second-order step with W diagonal", planar_contact(diagonal)?.len(), 1).reading(second),
        Finding::count("steps in which two swept points separate", separating, 0).reading(first),
        Finding::exact("their distance in the end", &gaps[24], &whole(0), "m").reading(first),
        Finding::count("solutions q = c t of the process with C(t) = {|q| ≥ t}", swept, 2).context(),
    ])
}

/// Motions q ≥ 0 with q(0) = 0, v(0) = 0 and v⁺ = −v⁻/2 under a pull that is `up` while the flight of a bouncing point rises and
/// `down` while it falls: rest is one, and the bouncing point another if its flights grow with time, so that backwards they shrink to 0.
fn motions_from_rest(up: &Rational, down: &Rational) -> usize {
    let launch = whole(1);
    let height = &launch * &launch / (whole(2) * up);
    let landing_squared = whole(2) * down * height;
    let next_squared = ratio(1, 4) * landing_squared;
    1 + usize::from(next_squared > &launch * &launch)
}
