//! The elimination held against the matrix with its zeros, and what has to be refused.

use super::*;
use crate::watch::{Interrupt, watched};
use moreau_exact::tolerance::rounding;
use nalgebra::{dmatrix, dvector};

/// Numbers in −1 .. 1.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / 2f64.powi(52) - 1.0
    }
}

/// A definite matrix.
fn definite(size: usize, next: &mut impl FnMut() -> f64) -> DMatrix<f64> {
    let root = DMatrix::from_fn(size, size, |_, _| next());
    &root * root.transpose() + DMatrix::identity(size, size)
}

/// Three rows at a body of six velocities.
fn part(next: &mut impl FnMut() -> f64) -> [[f64; 6]; 3] {
    std::array::from_fn(|_| std::array::from_fn(|_| next()))
}

/// Contacts of seven bodies in space: grounds, a chain that closes, two contacts of one pair, and the fourth and the last one without any.
fn pile(next: &mut impl FnMut() -> f64) -> Vec<Rows> {
    let pairs = [(5, Some(0)), (0, None), (1, Some(0)), (2, Some(1)), (2, None), (5, Some(2)), (1, Some(0)), (4, None)];
    let contact = |(one, other): (usize, Option<usize>)| {
        let rows = Rows::zeros(3, 42).with(6 * one, part(next));
        if let Some(other) = other { rows.with(6 * other, part(next)) } else { rows }
    };
    pairs.map(contact).into()
}

/// Masses of seven bodies in space.
fn masses(next: &mut impl FnMut() -> f64) -> Vec<Mass> {
    let whole = (0..7).map(|_| definite(6, next)).collect();
    let turning = (0..7).flat_map(|_| [dmatrix![1.5 + next()], dmatrix![0.5], dmatrix![], definite(1, next), definite(3, next)]).collect();
    // the first two blocks are of the same bodies as three of the contacts
    let pair = vec![definite(12, next), definite(6, next), definite(24, next)];
    let diagonal = DVector::from_fn(42, |_, _| 1.5 + next());
    vec![Mass::Diagonal(diagonal), Mass::Blocks(whole), Mass::Blocks(turning), Mass::Blocks(pair), Mass::Dense(definite(42, next))]
}

/// M + Σ HᵀGH with its zeros.
fn dense(mass: &Mass, contacts: &[Rows], slopes: &[DMatrix<f64>]) -> DMatrix<f64> {
    let products = contacts.iter().zip(slopes).map(|(rows, slope)| rows.to_dense().tr_mul(&(slope * rows.to_dense())));
    products.fold(mass.to_dense(), |sum, product| sum + product)
}

/// Whether d answers the dense matrix as well as a stable elimination does: A d − b is of the rounding of n products in n steps.
fn answers(matrix: &DMatrix<f64>, found: &DVector<f64>, right: &DVector<f64>) {
    let (left, n) = ((matrix * found - right).amax(), matrix.nrows());
    let size = (matrix.abs() * found.abs()).amax();
    assert!(left <= rounding(n * n, size), "{left} of {size}");
}

#[test]
fn drawn_piles_are_answered_as_by_the_dense_matrix() {
    for seed in 1..20 {
        let mut next = numbers(seed);
        let contacts = pile(&mut next);
        let right = DVector::from_fn(42, |_, _| next());
        for mass in masses(&mut next) {
            let inertia = Inertia::of(mass).expect("definite");
            let mut sum = AugmentedMass::new(&inertia, &contacts).expect("it fits");
            // twice, with other slopes: the order stays
            for _ in 0..2 {
                let mut slopes: Vec<_> = contacts.iter().map(|_| definite(3, &mut next)).collect();
                slopes[3].fill(0.0);
                answers(&dense(inertia.mass(), &contacts, &slopes), &sum.solve_definite("test", &slopes, &right).unwrap(), &right);
                answers(&dense(inertia.mass(), &contacts, &slopes), &sum.solve("test", &slopes, &right).unwrap(), &right);
                slopes.iter_mut().for_each(|slope| (0..3).for_each(|i| slope[(i, 0)] += 2.0 * next()));
                answers(&dense(inertia.mass(), &contacts, &slopes), &sum.solve("test", &slopes, &right).unwrap(), &right);
                let symmetric: Vec<_> = slopes.iter().map(|slope| slope + DMatrix::identity(3, 3) * 4.0).collect();
                let parts: Vec<_> = symmetric.iter().map(|slope| (slope + slope.transpose()) * 0.5).collect();
                answers(&dense(inertia.mass(), &contacts, &parts), &sum.solve_definite("test", &symmetric, &right).unwrap(), &right);
            }
        }
    }
}

#[test]
fn each_free_body_is_a_group_and_bodies_without_contact_are_none() {
    let mut next = numbers(7);
    let contacts = pile(&mut next);
    let groups = |mass: &Mass| touched_groups(mass, &contacts);
    let [diagonal, whole, turning, pair, all] = <[Mass; 5]>::try_from(masses(&mut next)).expect("five");
    for mass in [diagonal, whole, turning] {
        assert_eq!(groups(&mass), [0..6, 6..12, 12..18, 24..30, 30..36]);
    }
    let one_group = std::iter::once(0..42).collect::<Vec<_>>();
    assert_eq!((groups(&pair), groups(&all)), (vec![0..12, 12..18, 18..42], one_group));
}

#[test]
fn contacts_may_have_other_rows_and_bodies_other_sizes() {
    let mut next = numbers(3);
    // a point, a planar body and one in space; the second contact has one row, the last one is a linkage's
    let contacts = [
        Rows::zeros(2, 11).with(0, [[1.0, 0.5], [next(), next()]]).with(2, [[0.3, 1.0, next()], [next(), 1.0, 0.0]]),
        Rows::zeros(1, 11).with(5, [[0.0, 1.0, next(), 0.0, 0.0, 0.7]]),
        DMatrix::from_fn(3, 11, |_, column| if column < 5 { next() } else { 0.0 }).into(),
    ];
    let slopes = [definite(2, &mut next), definite(1, &mut next), definite(3, &mut next)];
    let right = DVector::from_fn(11, |_, _| next());
    for taken in [1, 2, 3] {
        let inertia = Inertia::of(Mass::Diagonal(DVector::from_fn(11, |_, _| 1.5 + next()))).expect("positive");
        let found = AugmentedMass::new(&inertia, &contacts[..taken]).unwrap().solve_definite("test", &slopes[..taken], &right).unwrap();
        answers(&dense(inertia.mass(), &contacts[..taken], &slopes[..taken]), &found, &right);
    }
}

#[test]
fn without_contacts_it_is_the_mass() {
    let mut next = numbers(5);
    let right = DVector::from_fn(42, |_, _| next());
    for mass in masses(&mut next) {
        let inertia = Inertia::of(mass).expect("definite");
        let mut sum = AugmentedMass::new(&inertia, &[]).expect("nothing to fit");
        assert_eq!(sum.solve("test", &[], &right).unwrap(), inertia.solve(&right));
        assert_eq!(sum.solve_definite("test", &[], &right).unwrap(), inertia.solve(&right));
    }
}

#[test]
fn what_has_no_answer_is_refused() {
    let one = [Rows::zeros(1, 2).with(0, [[1.0]]).with(1, [[-1.0]])];
    let inertia = |other: f64| Inertia::of(Mass::Diagonal(dvector![2.0, other])).expect("positive");
    let (finite, right) = (inertia(2.0), dvector![1.0, 0.0]);
    let mut sum = AugmentedMass::new(&finite, &one).expect("it fits");
    // 2 1 + (1, −1)ᵀ(−1)(1, −1) has the eigenvalue 0, and with −1.5 a negative one
    let refused = |answer: Result<DVector<f64>>| answer.expect_err("refused").to_string();
    assert!(refused(sum.solve("me", &[dmatrix![-1.0]], &right)).contains("singular"));
    for bad in [-1.0, -1.5, f64::NAN, f64::INFINITY] {
        let told = refused(sum.solve_definite("me", &[dmatrix![bad]], &right));
        assert!(told.contains("me") && told.contains("positive definite"), "{told}");
    }
    assert!(sum.solve("me", &[dmatrix![-1.5]], &right).is_ok() && sum.solve("me", &[dmatrix![f64::NAN]], &right).is_err());
    let interrupt = Interrupt::default();
    interrupt.now();
    assert!(refused(watched(&interrupt, || sum.solve_definite("me", &[dmatrix![1.0]], &right)).0).contains("no time"));
    assert!(AugmentedMass::new(&inertia(f64::INFINITY), &one).expect_err("infinite").to_string().contains("mass"));
    assert!(AugmentedMass::new(&finite, &[Rows::zeros(1, 3)]).expect_err("sizes").to_string().contains("`jacobian`"));
}
