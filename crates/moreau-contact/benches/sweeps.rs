//! What a sweep of projected Gauss–Seidel costs: nanoseconds per contact and sweep on piles of spheres, W by bodies; on large ones with
//! threads, and there on disks in the plane as well, W by bodies and by blocks.
//!
//! `cargo bench -p moreau-contact --bench sweeps`; with `MOREAU_SWEEPS_CONTACTS=1000000` also on a pile of about that many contacts, with
//! the certificate of a hundred sweeps. The local step is the exact answer of one contact (closed form where it opens or sticks, Newton's
//! method from the last multiplier where it slides). The difference of two runs is divided, so that what is done once does not count; the
//! residual that is measured now and then does. Large piles are swept by one thread and by as many as there are, which give the same bits;
//! there the time is that of the clock.

use moreau_contact::ContactProblem;
use moreau_contact::certificate::residuals;
use moreau_contact::nalgebra::{DMatrix, DVector};
use moreau_contact::operator::{BlockRows, MatrixFree};
use moreau_contact::solvers::{ContactSolver, ProjectedGaussSeidel, threads};
use std::num::NonZeroUsize;
use std::time::Instant;

/// How often a large pile is swept by each number of threads.
const TURNS: usize = 5;

/// Numbers in \[0, 1\[, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Of mean 0 and standard deviation `width`, by the sum of twelve.
    fn around(&mut self, width: f64) -> f64 {
        ((0..12).map(|_| self.next()).sum::<f64>() - 6.0) * width
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let size = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / size)
}

/// H of one sphere with the contact frame (n, t₁, t₂): rows e·(v + ω × arm), times the sign.
fn rows(frame: [[f64; 3]; 3], arm: [f64; 3], sign: f64) -> [f64; 18] {
    let mut rows = [0.0; 18];
    for (row, direction) in frame.into_iter().enumerate() {
        let turn = cross(arm, direction);
        (0..3).for_each(|axis| (rows[6 * row + axis], rows[6 * row + 3 + axis]) = (sign * direction[axis], sign * turn[axis]));
    }
    rows
}

/// Unit spheres at the 4k³ places of a face-centred cubic lattice, shaken a little, every second pair of neighbours in contact, the lowest
/// ones on the floor; all fall, each at its own velocity.
fn pile(k: usize) -> ContactProblem {
    let mut random = Numbers(1);
    let size = 2 * k;
    let (mut number, mut places, mut lowest) = (vec![usize::MAX; size * size * size], Vec::new(), Vec::new());
    for (i, j, l) in (0..size).flat_map(|i| (0..size).flat_map(move |j| (0..size).map(move |l| (i, j, l)))) {
        if (i + j + l) % 2 == 0 {
            number[(i * size + j) * size + l] = places.len();
            lowest.push(l == 0);
            places.push([i, j, l].map(|x| x as f64 * 0.5_f64.sqrt() + random.around(0.02)));
        }
    }
    let steps: [[isize; 3]; 6] = [[0, 1, 1], [0, 1, -1], [1, 0, 1], [1, 0, -1], [1, 1, 0], [1, -1, 0]];
    let mut jacobian = BlockRows::new(3, vec![6; places.len()]).expect("three rows");
    jacobian.reserve(13 * places.len() / 4).expect("it fits into memory");
    let frame = |n: [f64; 3]| {
        let first = unit(cross(n, if n[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }));
        [n, first, cross(n, first)]
    };
    for (i, j, l) in (0..size).flat_map(|i| (0..size).flat_map(move |j| (0..size).map(move |l| (i, j, l)))) {
        let own = number[(i * size + j) * size + l];
        if own == usize::MAX {
            continue;
        }
        if lowest[own] {
            jacobian.push(&[(own, &rows(frame([0.0, 0.0, 1.0]), [0.0, 0.0, -0.5], 1.0))]).expect("a known body");
        }
        for step in steps {
            let at = [i as isize + step[0], j as isize + step[1], l as isize + step[2]];
            if at.iter().any(|x| *x < 0 || *x >= size as isize) || random.next() < 0.5 {
                continue;
            }
            let other = number[(at[0] as usize * size + at[1] as usize) * size + at[2] as usize];
            let n = unit([0, 1, 2].map(|axis| places[other][axis] - places[own][axis]));
            let (first, second) = (rows(frame(n), n.map(|x| 0.5 * x), -1.0), rows(frame(n), n.map(|x| -0.5 * x), 1.0));
            jacobian.push(&[(own, &first), (other, &second)]).expect("known bodies, growing");
        }
    }
    let velocity: Vec<f64> = (0..6 * places.len()).map(|v| random.around(0.02) - if v % 6 == 2 { 0.0981 } else { 0.0 }).collect();
    let free = DVector::from_vec(jacobian.contact_velocity(&velocity));
    let mass = DMatrix::from_diagonal(&DVector::from_column_slice(&[1.0, 1.0, 1.0, 0.1, 0.1, 0.1]));
    let contacts = jacobian.contacts();
    let operator = MatrixFree::new(&vec![mass; places.len()], jacobian).expect("masses are positive");
    ContactProblem::new(operator, free).friction(vec![0.5; contacts]).build().expect("a valid problem")
}

/// Disks of 1 m on a triangular lattice in the plane, `wide` in a layer and `high` layers, the lowest on the floor, all neighbours in
/// contact; all fall, each at its own velocity.
fn planar_pile(wide: usize, high: usize) -> ContactProblem {
    let (mut random, disks) = (Numbers(2), wide * high);
    let mut jacobian = BlockRows::new(2, vec![3; disks]).expect("two rows");
    // e·(v + ω × arm) along the normal and the tangent, the arm along the normal
    let rows = |n: [f64; 2], arm: f64, sign: f64| [n[0], n[1], 0.0, n[1], -n[0], arm].map(|entry| sign * entry);
    for own in 0..disks {
        let (layer, place) = (own / wide, own % wide);
        if layer == 0 {
            jacobian.push(&[(own, &rows([0.0, 1.0], -0.5, 1.0))]).expect("a known body");
        }
        // to the right, and to the two above
        let shift = layer % 2;
        let above = [(place + shift).checked_sub(1), Some(place + shift)].map(|place| place.filter(|place| *place < wide));
        let beside = (place + 1 < wide).then_some((own + 1, 0.0));
        let higher = [2.0, 1.0].into_iter().zip(above).filter_map(|(third, place)| Some(((layer + 1) * wide + place?, third)));
        for (other, third) in beside.into_iter().chain(higher).filter(|(other, _)| *other < disks) {
            let (sin, cos) = (third * std::f64::consts::FRAC_PI_3 + random.around(0.02)).sin_cos();
            let (first, second) = (rows([cos, sin], 0.5, -1.0), rows([cos, sin], -0.5, 1.0));
            jacobian.push(&[(own, &first), (other, &second)]).expect("known bodies, growing");
        }
    }
    let velocity: Vec<f64> = (0..3 * disks).map(|v| random.around(0.02) - if v % 3 == 1 { 0.0981 } else { 0.0 }).collect();
    let free = DVector::from_vec(jacobian.contact_velocity(&velocity));
    let contacts = jacobian.contacts();
    let mass = DMatrix::from_diagonal(&DVector::from_column_slice(&[1.0, 1.0, 0.1]));
    let operator = MatrixFree::new(&vec![mass; disks], jacobian).expect("masses are positive");
    ContactProblem::new(operator, free).rows_per_contact(2).friction(vec![0.5; contacts]).build().expect("a valid problem")
}

/// The same problem with W by blocks.
fn by_blocks(problem: &ContactProblem) -> ContactProblem {
    let blocks = problem.delassus().matrix_free().expect("by bodies").delassus().expect("it fits into memory");
    problem.clone().into_builder().delassus(blocks).build().expect("a valid problem")
}

/// Seconds of the processor that this thread has had; of the clock where the system does not tell.
fn processor_seconds(begun: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| begun.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

/// The impulses of so many plain sweeps.
fn swept(problem: &ContactProblem, sweeps: usize) -> DVector<f64> {
    ProjectedGaussSeidel { sweeps, tolerance: 0.0, memory: 0 }.solve(problem, None).expect("it sweeps").impulse
}

/// Seconds of the processor for so many plain sweeps.
fn seconds(problem: &ContactProblem, sweeps: usize, begun: Instant) -> f64 {
    let before = processor_seconds(begun);
    swept(problem, sweeps);
    processor_seconds(begun) - before
}

/// Nanoseconds of the clock per contact and sweep by one thread and by all, in turn, the least of each; they must give the same bits.
fn by_threads(problem: &ContactProblem, sweeps: usize) {
    let all = threads::limit();
    let counts = [NonZeroUsize::MIN, all];
    let clock = |sweeps: usize| {
        let begun = Instant::now();
        swept(problem, sweeps);
        begun.elapsed().as_secs_f64()
    };
    let found = counts.map(|count| {
        threads::set_limit(count);
        swept(problem, 3)
    });
    assert!(found[0].iter().zip(&found[1]).all(|(one, other)| one.to_bits() == other.to_bits()), "{all} threads");
    // of so many sweeps, and of twice as many
    let mut least = [[f64::INFINITY; 2]; 2];
    for _ in 0..TURNS {
        for (count, own) in counts.into_iter().zip(&mut least) {
            threads::set_limit(count);
            *own = [own[0].min(clock(sweeps)), own[1].min(clock(2 * sweeps))];
        }
    }
    for (count, [once, twice]) in counts.into_iter().zip(least) {
        let each = (twice - once) * 1e9 / (sweeps * problem.contacts()) as f64;
        println!("{:8} contacts {each:8.1} ns per contact and sweep of the clock, {count} of {all} threads", problem.contacts());
    }
    threads::set_limit(all);
}

fn main() {
    println!("local step: exact answer of one contact, closed form or Newton from the last multiplier");
    let (begun, all) = (Instant::now(), threads::limit());
    threads::set_limit(NonZeroUsize::MIN);
    for (k, repetitions) in [(2, 1000), (5, 50), (10, 5), (20, 1)] {
        let problem = pile(k);
        // the system tells the time of the processor in steps of a few milliseconds: many solutions at once
        let each = |sweeps: usize| (0..repetitions).map(|_| seconds(&problem, sweeps, begun)).sum::<f64>();
        let least = |sweeps: usize| (0..2).map(|_| each(sweeps)).fold(f64::INFINITY, f64::min);
        let each = (least(200) - least(100)) / (100 * repetitions * problem.contacts()) as f64;
        println!("{:8} contacts {:8.1} ns per contact and sweep", problem.contacts(), each * 1e9);
    }
    threads::set_limit(all);
    for (name, problem, sweeps) in [
        ("spheres, W by bodies", pile(18), 20),
        ("disks, W by bodies", planar_pile(150, 150), 40),
        ("disks, W by blocks", by_blocks(&planar_pile(150, 150)), 20),
    ] {
        println!("{name}");
        by_threads(&problem, sweeps);
    }
    let Some(contacts) = std::env::var("MOREAU_SWEEPS_CONTACTS").ok().and_then(|text| text.parse::<f64>().ok()) else { return };
    let made = processor_seconds(begun);
    let problem = pile((contacts / 12.0).cbrt().round() as usize);
    println!("{:8} contacts made in {:.1} s", problem.contacts(), processor_seconds(begun) - made);
    by_threads(&problem, 4);
    threads::set_limit(NonZeroUsize::MIN);
    let (before, clock) = (processor_seconds(begun), Instant::now());
    let swept = ProjectedGaussSeidel { sweeps: 100, tolerance: 0.0, memory: 0 }.solve(&problem, None).expect("it sweeps");
    let found = residuals(&problem, &swept).expect("sizes fit");
    let (spent, clock) = (processor_seconds(begun) - before, clock.elapsed().as_secs_f64());
    println!("{spent:8.1} s ({clock:.1} s of the clock) for 100 sweeps of one thread and their certificate");
    println!("{:8.1e} relative residual", found.judged.relative());
    // what the process had at most, where the system tells
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    status.lines().filter(|line| line.starts_with("VmHWM")).for_each(|line| println!("{line}"));
}
