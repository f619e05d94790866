//! Any number of threads sweeps to the same bits, whatever contacts touch.

use super::block_sweep::{Change, Sweep};
use super::colours::{Blocks, Touching, are_apart, colour};
use super::crew::Crew;
use super::one_contact::Coulomb;
use super::swept::{Joined, Swept};
use super::swept_bodies::{Bodies, Free};
use crate::operator::{BlockRows, BlockSparse, MatrixFree};
use crate::problem::{Compliance, ContactProblem, Coordinates};
use crate::tolerance::sweeps::THREADED;
use nalgebra::{DMatrix, DVector, Matrix3};

/// Contacts in a block of these tests, and contacts: thirteen halves of a block.
const SIZE: usize = 64;
const CONTACTS: usize = 13 * SIZE / 2;
/// How many threads sweep.
const THREADS: [usize; 5] = [1, 2, 3, 7, 64];

/// Numbers of no pattern, from −1 to 1.
fn number(seed: usize) -> f64 {
    ((seed.wrapping_mul(2_654_435_761) >> 7) % 1000) as f64 / 500.0 - 1.0
}

/// Contacts of so many rows along a chain of bodies of these velocities, again and again; now and then one lies to a body further on.
fn chain(rows: usize, velocities: &[usize]) -> ContactProblem {
    let sizes: Vec<usize> = (0..=CONTACTS).map(|body| velocities[body % velocities.len()]).collect();
    let mut jacobian = BlockRows::new(rows, sizes.clone()).unwrap();
    for k in 0..CONTACTS {
        let other = if k % 97 == 50 { (k + 150).min(CONTACTS) } else { k + 1 };
        let block = |body: usize| -> Vec<f64> { (0..rows * sizes[body]).map(|place| number(36 * k + 18 * (body - k) + place)).collect() };
        jacobian.push(&[(k, &block(k)), (other, &block(other))]).unwrap();
    }
    let mass = |size: &usize| DMatrix::from_diagonal(&DVector::from_fn(*size, |axis, _| 1.0 + axis as f64));
    let free = DVector::from_fn(rows * CONTACTS, |row, _| number(7 * row + 3) - if row % rows == 0 { 0.5 } else { 0.0 });
    let operator = MatrixFree::new(&sizes.iter().map(mass).collect::<Vec<_>>(), jacobian).unwrap();
    let soft = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_fn(rows * CONTACTS, |row, _| (row % 5) as f64) };
    let friction = vec![if rows == 1 { 0.0 } else { 0.5 }; CONTACTS];
    ContactProblem::new(operator, free).rows_per_contact(rows).friction(friction).compliance(soft).build().unwrap()
}

fn bodies_of(problem: &ContactProblem) -> &MatrixFree {
    problem.delassus().matrix_free().unwrap()
}

/// The same with W by blocks.
fn by_blocks(problem: &ContactProblem) -> ContactProblem {
    problem.clone().into_builder().delassus(bodies_of(problem).delassus().unwrap()).build().unwrap()
}

/// Impulses, state and changes after a few sweeps, bit by bit.
fn bits<const D: usize>(swept: &impl Swept<D>, problem: &ContactProblem, blocks: &Blocks, threads: usize) -> Vec<u64> {
    let mut own = vec![0.0; D * D];
    let mut block = |k: usize| {
        problem.delassus().of_contacts().diagonal_block(k, &mut own);
        let entry = |i: usize, j: usize| if i < D && j < D { own[j * D + i] } else { f64::from(u8::from(i == j)) };
        Matrix3::from_fn(|i, j| entry(i, j) + if i == j && i < D { problem.row_compliance(k * D + i) } else { 0.0 })
    };
    let mut contacts: Vec<Coulomb> = (0..CONTACTS).map(|k| Coulomb::new(&block(k), 0.5).unwrap()).collect();
    let (mut impulses, crew) = (vec![[0.0; D]; CONTACTS], Crew::with_threads(threads, swept.size()));
    let (mut state, mut changes) = (vec![0.0; swept.size()], vec![Change::default(); blocks.count()]);
    swept.set_state(impulses.as_flattened(), &mut state);
    for _ in 0..4 {
        let (contacts, impulses, changes) = (&mut contacts[..], &mut impulses[..], &mut changes[..]);
        swept.sweep(&crew, Sweep { blocks, contacts, impulses, changes }, &mut state);
    }
    assert!(changes.iter().all(|change| change.moved && change.squares > 0.0));
    let squares = changes.iter().map(|change| change.squares);
    impulses.as_flattened().iter().chain(&state).copied().chain(squares).map(f64::to_bits).collect()
}

/// Sweeps by all numbers of threads, and in the reverse order of the colours, and returns the bits.
fn same_bits<const D: usize>(swept: &impl Swept<D>, problem: &ContactProblem, touching: &impl Touching) -> Vec<u64> {
    let blocks = colour(touching, SIZE);
    assert!(are_apart(touching, &blocks) && blocks.widest() > 1 && blocks.colours.len() > 1);
    let alone = bits(swept, problem, &blocks, 1);
    for threads in THREADS {
        assert!(bits(swept, problem, &blocks, threads) == alone, "{threads} threads");
    }
    // what the comparison is for: blocks that touch something in common, swept in another order
    let (mut other, count) = (blocks.clone(), blocks.colours.len());
    let reversed = |colour: usize| blocks.colours[count - 1 - colour].iter();
    other.colours.collect(count, |show| (0..count).for_each(|colour| reversed(colour).for_each(|block| show(colour, *block))));
    assert!(bits(swept, problem, &other, 1) != alone);
    assert!(bits(swept, problem, &other, 3) == bits(swept, problem, &other, 1));
    alone
}

/// Sweeps by bodies and by blocks; the impulses of both are the same to the rounding of their sums.
fn both<const D: usize>(problem: &ContactProblem, swept: &impl Swept<D>) {
    let through_bodies = same_bits(swept, problem, bodies_of(problem));
    let blocks = by_blocks(problem);
    let joined = Joined::of(&blocks).unwrap();
    same_bits::<D>(&joined, &blocks, blocks.delassus().stored_blocks().unwrap());
    // in one order
    let order = colour(bodies_of(problem), SIZE);
    let found = bits::<D>(&joined, &blocks, &order, 1);
    let impulses = |bits: &[u64]| DVector::from_iterator(D * CONTACTS, bits[..D * CONTACTS].iter().map(|bits| f64::from_bits(*bits)));
    let (one, other) = (impulses(&through_bodies), impulses(&found));
    assert!((&one - &other).amax() <= moreau_exact::tolerance::rounding(4 * 64, one.amax()), "{:e}", (&one - &other).amax());
}

#[test]
fn bodies_of_six_velocities_are_swept_to_the_same_bits_by_any_number_of_threads() {
    let problem = chain(3, &[6]);
    both::<3>(&problem, &Bodies::<3>::new(&problem, bodies_of(&problem)).unwrap());
}

#[test]
fn planar_and_mixed_bodies_are_swept_to_the_same_bits_by_any_number_of_threads() {
    let planar = chain(2, &[3]);
    assert!(Bodies::<3>::new(&planar, bodies_of(&planar)).is_none());
    both::<2>(&planar, &Free::new(&planar, bodies_of(&planar)));
    let mixed = chain(3, &[6, 3, 4]);
    both::<3>(&mixed, &Free::new(&mixed, bodies_of(&mixed)));
    let rows = chain(1, &[1, 2]);
    both::<1>(&rows, &Free::new(&rows, bodies_of(&rows)));
}

#[test]
fn bodies_of_six_velocities_are_swept_as_bodies_of_any() {
    let problem = chain(3, &[6]);
    let blocks = colour(bodies_of(&problem), SIZE);
    let impulses = |bits: Vec<u64>| DVector::from_iterator(3 * CONTACTS, bits[..3 * CONTACTS].iter().map(|bits| f64::from_bits(*bits)));
    let one = impulses(bits::<3>(&Bodies::<3>::new(&problem, bodies_of(&problem)).unwrap(), &problem, &blocks, 2));
    let other = impulses(bits::<3>(&Free::new(&problem, bodies_of(&problem)), &problem, &blocks, 2));
    assert!((&one - &other).amax() <= moreau_exact::tolerance::rounding(4 * 64, one.amax()), "{:e}", (&one - &other).amax());
}

#[test]
fn blocks_of_few_contacts_or_in_space_are_swept_as_they_are_listed_and_those_of_many_in_the_plane_by_colours() {
    let problem = |rows: usize, contacts: usize| {
        let one = DMatrix::identity(rows, rows);
        let w = BlockSparse::new(rows, contacts, (0..contacts).map(|k| (k, k, one.clone())).collect()).unwrap();
        ContactProblem::new(w, DVector::from_element(rows * contacts, -1.0))
            .rows_per_contact(rows)
            .friction(vec![0.0; contacts])
            .build()
            .unwrap()
    };
    assert!(Joined::new(&problem(1, THREADED - 1)).is_none() && Joined::new(&problem(3, THREADED)).is_none());
    assert!(Joined::new(&problem(2, THREADED)).is_some());
    let many = problem(1, THREADED);
    let joined = Joined::new(&many).unwrap();
    // no contact moves another: all blocks have one colour
    assert_eq!(Swept::<1>::blocks(&joined).colours.len(), 1);
    assert!(Swept::<1>::blocks(&joined).widest() > 16);
    let dense = problem(1, 2).dense().clone();
    assert!(Joined::of(&ContactProblem::new(dense, DVector::zeros(2)).rows_per_contact(1).build().unwrap()).is_none());
}

#[test]
fn a_sweep_whose_word_to_end_is_given_moves_nothing() {
    use crate::solvers::watch::{Interrupt, watched};
    let (problem, interrupt) = (chain(3, &[6]), Interrupt::default());
    let bodies = Bodies::<3>::new(&problem, bodies_of(&problem)).unwrap();
    let mut contacts: Vec<Coulomb> = (0..CONTACTS).map(|_| Coulomb::new(&Matrix3::identity(), 0.5).unwrap()).collect();
    let (mut impulses, blocks) = (vec![[0.0; 3]; CONTACTS], colour(bodies_of(&problem), SIZE));
    let (mut state, mut changes) = (vec![0.0; Swept::<3>::size(&bodies)], vec![Change::default(); blocks.count()]);
    interrupt.now();
    let sweep = Sweep { blocks: &blocks, contacts: &mut contacts, impulses: &mut impulses, changes: &mut changes };
    let (_, seen) = watched(&interrupt, || bodies.sweep(&Crew::with_threads(1, 0), sweep, &mut state));
    assert!(seen.interrupted && impulses.as_flattened().iter().all(|r| *r == 0.0));
}
