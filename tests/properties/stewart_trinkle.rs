//! Property family `stewart_trinkle`: exact rationals, 1–3 contacts, d = 2 (planar), 4 and 8 directions.

use crate::cases;
use moreau::certificate::copositivity::{NotPlus, copositive_plus};
use moreau::certificate::lcp::residuals;
use moreau::certificate::residuals::residuals as judge;
use moreau::certificate::{Decision, existence};
use moreau::checks::Finding;
use moreau::checks::stewart_trinkle::{
    RationalStep, chapter_example, decisions, identity, rational_directions, reduced, reference, solvability, theorem_applies, wedge,
};
use moreau::contact::delassus::delassus;
use moreau::problem::{ContactProblem, Law, Lcp};
use moreau::scalar::{Rational, Scalar, ratio};
use moreau::solvers::enumeration::all_solutions;
use moreau::solvers::lemke::{LemkeOutcome, lemke};
use moreau::solvers::{ContactSolver, LemkePivoting};
use moreau::tolerance::cli::CERTIFY;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

/// (contacts, directions) by number of unknowns k(2 + d).
const UP_TO_8: [(usize, usize); 3] = [(1, 2), (2, 2), (1, 4)];
const FROM_9_TO_12: [(usize, usize); 3] = [(3, 2), (2, 4), (1, 8)];
const LARGER: [(usize, usize); 3] = [(3, 4), (2, 8), (3, 8)];

/// `default` cases, or twenty times as many in a campaign.
fn campaign(default: u32) -> ProptestConfig {
    let deeper = std::env::var("MOREAU_CAMPAIGN").is_ok_and(|value| value == "1");
    cases(if deeper { 20 * default } else { default })
}

#[derive(Clone, Copy, Debug)]
enum Relation {
    Independent,
    Redundant,
    Opposed,
}

/// A system of this shape: up to 4 velocities, contacts that may repeat or oppose the first, μ from 0 to 3.
fn system(shapes: &'static [(usize, usize)], gaps: std::ops::RangeInclusive<i64>) -> impl Strategy<Value = RationalStep> {
    (prop::sample::select(shapes), 1..=4usize).prop_flat_map(move |((contacts, d), velocities)| {
        let rows_per_contact = if d == 2 { 2 } else { 3 };
        let relation = prop_oneof![3 => Just(Relation::Independent), 1 => Just(Relation::Redundant), 1 => Just(Relation::Opposed)];
        (
            prop::collection::vec(-3..=3i64, rows_per_contact * contacts * velocities),
            prop::collection::vec(relation, contacts),
            prop::collection::vec((1..=4i64, 1..=3i64), velocities),
            prop_oneof![1 => Just(vec![(0, 1); contacts]), 9 => prop::collection::vec((0..=3i64, 1..=4i64), contacts)],
            prop::collection::vec(gaps.clone(), contacts),
            prop::collection::vec(-5..=5i64, velocities),
        )
            .prop_map(move |(entries, relations, masses, friction, gaps, free)| RationalStep {
                mass: DVector::from_iterator(velocities, masses.iter().map(|&(p, q)| ratio(p, q))),
                jacobian: related(rows_per_contact, velocities, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>(), &relations),
                rows_per_contact,
                directions: rational_directions(d),
                friction: friction.iter().map(|&(p, q)| ratio(p, q)).collect(),
                gap: gaps.iter().map(|&gap| ratio(gap, 100)).collect(),
                step: ratio(1, 10),
                free_velocity: DVector::from_iterator(velocities, free.iter().map(|&v| ratio(v, 2))),
            })
    })
}

/// The Jacobian with repeated contacts, and contacts whose normal opposes the first.
fn related<T: Scalar>(rows_per_contact: usize, velocities: usize, entries: &[T], relations: &[Relation]) -> DMatrix<T> {
    DMatrix::from_fn(entries.len() / velocities, velocities, |i, j| {
        let (contact, row) = (i / rows_per_contact, i % rows_per_contact);
        let own = entries[i * velocities + j].clone();
        let first = entries[row * velocities + j].clone();
        match relations[contact] {
            _ if contact == 0 => own,
            Relation::Independent => own,
            Relation::Opposed if row == 0 => -first,
            Relation::Redundant | Relation::Opposed => first,
        }
    })
}

fn assert_holds(system: &RationalStep, findings: &[Finding]) -> std::result::Result<(), TestCaseError> {
    for finding in findings {
        prop_assert!(finding.holds(), "{finding}\n{system:?}");
    }
    Ok(())
}

/// Three points x ≥ 0 of a system: two pseudo-random, one with equal entries.
fn points(system: &RationalStep, seeds: &[i64]) -> Vec<DVector<Rational>> {
    let size = system.unknowns();
    let strided = |stride: usize| DVector::from_fn(size, |i, _| ratio(seeds[stride * i % seeds.len()], 3));
    vec![strided(1), strided(5), DVector::from_element(size, ratio(1, 1))]
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn the_quadratic_form_is_the_kinetic_term_plus_mu_lambda_sigma(
        system in prop_oneof![2 => system(&UP_TO_8, -3..=3), 1 => system(&FROM_9_TO_12, -3..=3), 1 => system(&LARGER, -3..=3)],
        seeds in prop::collection::vec(0..=9i64, 31),
    ) {
        assert_holds(&system, &identity(&system, reference, &points(&system, &seeds)).unwrap())?;
    }

    #[test]
    fn up_to_8_unknowns_it_is_copositive_and_plus_only_without_friction(system in system(&UP_TO_8, 0..=0)) {
        assert_holds(&system, &decisions(&system, reference).unwrap())?;
    }

    #[test]
    fn lemke_solves_every_step_with_gaps_that_are_not_negative(
        system in prop_oneof![6 => system(&UP_TO_8, 0..=3), 2 => system(&FROM_9_TO_12, 0..=3), 1 => system(&LARGER, 0..=3)],
    ) {
        prop_assert!(theorem_applies(&system).unwrap());
        assert_holds(&system, &solvability(&system, reference).unwrap())?;
    }

    #[test]
    fn lemke_solves_every_step_with_a_pointed_cone(
        system in prop_oneof![6 => system(&UP_TO_8, -3..=-1), 2 => system(&FROM_9_TO_12, -3..=-1), 1 => system(&LARGER, -3..=-1)]
            .prop_filter("the cone is not pointed", |system| {
                existence::pointed(&reduced(system).unwrap().0, &system.friction).holds()
            }),
    ) {
        assert_holds(&system, &solvability(&system, reference).unwrap())?;
    }
}

proptest! {
    #![proptest_config(campaign(60))]

    #[test]
    fn with_9_to_12_unknowns_it_is_copositive_and_plus_only_without_friction(system in system(&FROM_9_TO_12, 0..=0)) {
        assert_holds(&system, &decisions(&system, reference).unwrap())?;
    }

    #[test]
    fn enumeration_and_lemke_agree_on_solvability_of_small_steps(system in system(&UP_TO_8, -3..=3)) {
        let lcp = reference(&system).unwrap();
        let set = all_solutions(&lcp).unwrap();
        for point in &set.points {
            prop_assert!(residuals(&lcp, point).vanish());
        }
        match lemke(&lcp, &ones(lcp.size())).unwrap() {
            LemkeOutcome::Solution { .. } => prop_assert!(!set.is_empty()),
            LemkeOutcome::Ray { .. } => {
                let added: Vec<_> = system.gap.iter().map(|gap| gap / &system.step).collect();
                prop_assert!(!existence::hypothesis(&reduced(&system).unwrap().0, &system.friction, &added).holds());
            }
        }
    }
}

/// A step in floating point: up to 8 contacts that may repeat or oppose the first, d = 4 or 8, mass ratios up to 10⁶, open gaps.
fn rounded_step() -> impl Strategy<Value = ContactProblem> {
    (1..=8usize, prop_oneof![Just(4usize), Just(8)], 1..=6usize).prop_flat_map(|(contacts, directions, velocities)| {
        let relation = prop_oneof![2 => Just(Relation::Independent), 1 => Just(Relation::Redundant), 1 => Just(Relation::Opposed)];
        (
            prop::collection::vec(-1.0..1.0f64, 3 * contacts * velocities),
            prop::collection::vec(relation, contacts),
            prop::collection::vec(-3.0..3.0f64, velocities),
            prop::collection::vec(0.0..2.0f64, contacts),
            prop::collection::vec(prop_oneof![Just(0.0), 0.0..1.0f64], contacts),
            prop::collection::vec(-5.0..5.0f64, velocities),
        )
            .prop_map(move |(entries, relations, masses, friction, gaps, free)| {
                let jacobian = related(3, velocities, &entries, &relations);
                let mass = DMatrix::from_diagonal(&DVector::from_vec(masses).map(|exponent: f64| 10f64.powf(exponent)));
                ContactProblem::new(delassus(&mass, &jacobian).unwrap(), &jacobian * DVector::from_vec(free))
                    .name("random step")
                    .law(Law::PolyhedralCoulomb { directions })
                    .friction(friction)
                    .shift(DVector::from_fn(3 * contacts, |i, _| if i % 3 == 0 { gaps[i / 3] } else { 0.0 }))
                    .build()
                    .unwrap()
            })
    })
}

proptest! {
    #![proptest_config(campaign(300))]

    #[test]
    fn rounded_lemke_solves_steps_with_open_gaps_to_the_tolerance_of_the_certificate(problem in rounded_step()) {
        let solution = LemkePivoting.solve(&problem, None).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let judged = judge(&problem, &solution).unwrap();
        prop_assert!(judged.is_solution(CERTIFY), "{judged:?}");
    }
}

/// The case of this number in the campaign that found the ones below, drawn by its own generator.
fn numbered_step(number: u64) -> ContactProblem {
    let mut seed = [0; 32];
    seed[..8].copy_from_slice(&number.to_le_bytes());
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
    rounded_step().new_tree(&mut TestRunner::new_with_rng(ProptestConfig::default(), rng)).expect("nothing is filtered").current()
}

/// Number, contacts and first entry of W of steps whose first path once failed: 82597 ended on a ray that is none (a column whose largest
/// entry is 6·10⁻⁹, well above its error), the next three cycled (ties that rounding decided anew at each visit), at the others a bound
/// was too wide or too narrow while this one was found.
const HARD_STEPS: [(u64, usize, f64); 11] = [
    (82597, 3, 32.072853856646496),
    (15116, 8, 0.46230448633003),
    (25730, 8, 1.0696148298295447),
    (47217, 8, 17.632745358918985),
    (1452, 4, 163.5361686596734),
    (3673, 8, 134.35198866303762),
    (7758, 5, 2.116369087874219),
    (9320, 8, 171.7958578386178),
    (9760, 2, 126.60616998281014),
    (272, 4, 22.886457838761363),
    (696, 3, 50.944511113923745),
];

/// The step's complementarity problem with entries of order one: impulses in units of (mean diagonal of W)^(−½) at each contact.
fn of_order_one(problem: &ContactProblem) -> Lcp<f64> {
    let (lcp, n) = (problem.stewart_trinkle_lcp().unwrap(), problem.contacts());
    let directions = problem.law().directions().expect("polyhedral");
    let unit = |contact: usize| (3.0 / (0..3).map(|k| problem.entry(3 * contact + k, 3 * contact + k)).sum::<f64>()).sqrt();
    let scale = DVector::from_fn(lcp.size(), |i, _| match i {
        i if i < n => unit(i),
        i if i < n * (1 + directions) => unit((i - n) / directions),
        i => unit(i - n * (1 + directions)).recip(),
    });
    let vector = lcp.vector.component_mul(&scale);
    let largest = vector.amax();
    let matrix = DMatrix::from_fn(lcp.size(), lcp.size(), |i, j| scale[i] * lcp.matrix[(i, j)] * scale[j]);
    Lcp::new(matrix, vector / largest)
}

#[test]
fn steps_on_which_rounding_once_made_rays_and_cycles_are_solved_on_the_first_path() {
    for (number, contacts, first) in HARD_STEPS {
        let problem = numbered_step(number);
        assert_eq!((problem.contacts(), problem.entry(0, 0)), (contacts, first), "step {number} is another one: draw it as before");
        let lcp = of_order_one(&problem);
        let found = lemke(&lcp, &DVector::from_element(lcp.size(), 1.0));
        assert!(matches!(found, Ok(LemkeOutcome::Solution { .. })), "step {number}: {found:?}");
        let solution = LemkePivoting.solve(&problem, None).unwrap_or_else(|error| panic!("step {number}: {error}"));
        assert!(judge(&problem, &solution).unwrap().is_solution(CERTIFY), "step {number}");
    }
}

/// A jaw without gaps whose columns are so nearly dependent that rounding ends the path of every covering vector: case 32220 of the shard
/// of `scripts/campaign.py` with the seed 12945476836330, shrunk.
fn jaw() -> ContactProblem {
    let (n, t) = ([638.2522430953022, -555.0444425432646, -431.0270014106217], [482.6877649680574, 374.88725988885216, 291.87614195307464]);
    let (closed, told) = (555.0444425432645, 431.02700141062166);
    let rows = [
        [n[0], n[1], n[2], -n[0], n[1], n[2]],
        [n[1], t[0], t[1], closed, t[0], t[1]],
        [n[2], t[1], t[2], told, t[1], t[2]],
        [-n[0], -n[1], -n[2], n[0], -n[1], -n[2]],
        [n[1], t[0], t[1], -n[1], t[0], t[1]],
        [n[2], t[1], t[2], -n[2], t[1], t[2]],
    ];
    let [opening, sideways, across] = [0.48029900346962673, -0.400414866177737, -0.0786429350732295];
    let free = DVector::from_column_slice(&[opening, sideways, across, -opening, sideways, across]);
    ContactProblem::new(DMatrix::from_fn(6, 6, |i, j| rows[i][j]), free)
        .law(Law::PolyhedralCoulomb { directions: 8 })
        .friction(vec![0.0, 1.811051355465206])
        .build()
        .unwrap()
}

#[test]
fn where_rounding_ends_every_path_a_softer_problem_leads_to_the_solution() {
    let (problem, lcp) = (jaw(), of_order_one(&jaw()));
    assert!(lemke(&lcp, &DVector::from_element(lcp.size(), 1.0)).is_err(), "rounding ends the path no longer: another jaw is needed");
    let solution = LemkePivoting.solve(&problem, None).unwrap();
    assert!(judge(&problem, &solution).unwrap().is_solution(CERTIFY));
}

fn ones(size: usize) -> DVector<Rational> {
    DVector::from_element(size, ratio(1, 1))
}

/// M = \[\[9, 12, −12, 0\], \[12, 16, −16, 25\], \[−12, −16, 16, 25\], \[25, −25, −25, 0\]\]/25, q = (−1, 0, 0, 0).
fn feasible_but_unsolvable() -> Lcp<Rational> {
    let entries = [9, 12, -12, 0, 12, 16, -16, 25, -12, -16, 16, 25, 25, -25, -25, 0].map(|x| ratio(x, 25));
    Lcp::new(DMatrix::from_row_slice(4, 4, &entries), DVector::from_vec([-1, 0, 0, 0].map(|x| ratio(x, 1)).to_vec()))
}

#[test]
fn the_feasible_but_unsolvable_step_ends_on_a_ray_and_enumeration_proves_that_nothing_solves_it() {
    let lcp = feasible_but_unsolvable();
    let feasible = DVector::from_vec(vec![ratio(3, 1), ratio(0, 1), ratio(0, 1), ratio(2, 1)]);
    assert!(lcp.slack(&feasible).iter().all(|w| *w >= ratio(0, 1)), "z = (3, 0, 0, 2) ≥ 0 has M z + q ≥ 0");
    assert!(matches!(lemke(&lcp, &ones(4)).unwrap(), LemkeOutcome::Ray { .. }));
    assert!(all_solutions(&lcp).unwrap().is_empty());
    assert!(matches!(copositive_plus(&lcp.matrix).unwrap(), Decision::Fails(NotPlus::Zero(_))));
}

#[test]
fn a_penetrating_wedge_is_solvable_up_to_mu_7_10_and_not_from_3_4_on() {
    for (friction, solvable) in
        [(ratio(1, 2), true), (ratio(7, 10), true), (ratio(3, 4), false), (ratio(4, 5), false), (ratio(1, 1), false)]
    {
        let system = wedge(friction.clone());
        let lcp = reference(&system).unwrap();
        assert_eq!(!all_solutions(&lcp).unwrap().is_empty(), solvable, "μ = {friction}");
        assert_eq!(theorem_applies(&system).unwrap(), solvable, "μ = {friction}");
        assert_eq!(matches!(lemke(&lcp, &ones(8)).unwrap(), LemkeOutcome::Solution { .. }), solvable, "μ = {friction}");
    }
}
#[test]
fn the_textbooks_theorem_and_the_corrected_one() {
    let claim = moreau::claims::find("S4.copos-plus").expect("the claim is registered");
    let matrix = reference(&chapter_example(ratio(0, 1), [ratio(0, 1), ratio(0, 1)])).unwrap().matrix;
    let Some(NotPlus::Zero(x)) = copositive_plus(&matrix).unwrap().witness() else { panic!("μ = 1/2 > 0") };
    let image = (&matrix + matrix.transpose()) * &x;
    let list = |x: &DVector<Rational>| x.iter().map(Rational::to_string).collect::<Vec<_>>().join(", ");
    let text = format!(
        "The chapter's theorem: {}\nWitness: x = ({}) ≥ 0, xᵀMx = 0, (M + Mᵀ)x = ({})\nThe corrected theorem: {}\n",
        claim.statement(),
        list(&x),
        list(&image),
        claim.correct_statement()
    );
    // Past the capture of the test harness: the two theorems belong into the output of `cargo test`.
    std::io::Write::write_all(&mut std::io::stdout(), text.as_bytes()).unwrap();
    assert_eq!((list(&x).as_str(), list(&image).as_str()), ("0, 0, 0, 1", "1/2, 0, 0, 0"));
}
