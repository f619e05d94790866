//! Tests of the reader and writer of FCLIB's HDF5.

use super::*;
use crate::problem::ConstraintKind;
use crate::tolerance::sharpness::roundings;
use hdf5_pure::{FileBuilder, GroupBuilder};
use nalgebra::{DMatrix, dmatrix, dvector};
use std::path::PathBuf;

fn with_file(bytes: &[u8], check: impl Fn(&Path)) {
    static NUMBER: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
    let number = NUMBER.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    let file: PathBuf = std::env::temp_dir().join(format!("moreau-fclib-{}-{number}.hdf5", std::process::id()));
    std::fs::write(&file, bytes).expect("a folder for temporary files");
    check(&file);
    std::fs::remove_file(&file).expect("it was written");
}

fn matrix(group: &mut GroupBuilder, shape: [i32; 2], nz: i32, [p, i]: [&[i32]; 2], x: &[f64]) {
    for (name, value) in [("m", shape[0]), ("n", shape[1]), ("nz", nz), ("nzmax", x.len() as i32)] {
        group.create_dataset(name).with_i32_data(&[value]);
    }
    group.create_dataset("p").with_i32_data(p);
    group.create_dataset("i").with_i32_data(i);
    group.create_dataset("x").with_f64_data(x);
}

/// One planar contact with W = (2, 3; 0, 4), stored in one of the three ways.
fn stored(nz: i32, places: [&[i32]; 2], x: &[f64]) -> Vec<u8> {
    let mut file = FileBuilder::new();
    let mut problem = file.create_group("fclib_local");
    problem.create_dataset("spacedim").with_i32_data(&[2]);
    let mut w = problem.create_group("W");
    matrix(&mut w, [2, 2], nz, places, x);
    problem.add_group(w.finish());
    let mut vectors = problem.create_group("vectors");
    vectors.create_dataset("q").with_f64_data(&[-1.0, 0.5]);
    vectors.create_dataset("mu").with_f64_data(&[0.25]);
    problem.add_group(vectors.finish());
    file.add_group(problem.finish());
    file.finish().expect("an HDF5 file in memory")
}

#[test]
fn triplets_compressed_columns_and_compressed_rows_are_one_matrix() {
    let x = [2.0, 3.0, 4.0];
    for (nz, places) in [(3, [&[0, 1, 1][..], &[0, 0, 1]]), (-1, [&[0, 1, 3], &[0, 0, 1]]), (-2, [&[0, 2, 3], &[0, 1, 1]])] {
        with_file(&stored(nz, places, &x), |file| {
            assert!(is_hdf5(file));
            let problem = ContactProblem::read(file).expect("well formed");
            assert_eq!(problem.dense(), &dmatrix![2.0, 3.0; 0.0, 4.0], "nz = {nz}");
            assert_eq!((problem.free_velocity(), problem.friction()), (&dvector![-1.0, 0.5], &[0.25][..]));
            assert!(Solution::read(file, &problem).expect_err("refused").to_string().contains("solution/r"));
        });
    }
}

#[test]
fn a_global_problem_is_reduced_to_its_contacts() {
    let mut file = FileBuilder::new();
    let mut problem = file.create_group("fclib_global");
    problem.create_dataset("spacedim").with_i32_data(&[2]);
    let mut m = problem.create_group("M");
    matrix(&mut m, [2, 2], 2, [&[0, 1], &[0, 1]], &[2.0, 4.0]);
    problem.add_group(m.finish());
    // H with one column per contact row: v₁ is the normal velocity, v₁ + v₂ the tangential one
    let mut h = problem.create_group("H");
    matrix(&mut h, [2, 2], 3, [&[0, 1, 1], &[0, 0, 1]], &[1.0, 1.0, 1.0]);
    problem.add_group(h.finish());
    let mut vectors = problem.create_group("vectors");
    for (name, values) in [("f", &[2.0, -8.0][..]), ("w", &[0.5, 0.0]), ("mu", &[0.25])] {
        vectors.create_dataset(name).with_f64_data(values);
    }
    problem.add_group(vectors.finish());
    file.add_group(problem.finish());
    with_file(&file.finish().expect("an HDF5 file in memory"), |file| {
        let problem = ContactProblem::read(file).expect("well formed");
        assert_eq!(problem.dense(), &dmatrix![0.5, 0.5; 0.5, 0.75]);
        assert_eq!(problem.free_velocity(), &dvector![1.5, -1.0]);
    });
}

#[test]
fn what_is_written_comes_back_bit_for_bit_with_solution_and_guess() {
    let w = DMatrix::from_fn(6, 6, |i, j| if i == j { 1.0 / 3.0 } else { 0.1 / (1 + i + j) as f64 });
    let problem = ContactProblem::new(w, dvector![-0.1, 0.2, 0.3, -f64::EPSILON, f64::from_bits(1), 1e300])
        .name("two, µ")
        .friction(vec![0.1, 0.7])
        .build()
        .expect("sizes fit");
    let solution = Solution::new("mine", dvector![0.1, 0.0, 0.0, 1.0 / 3.0, 0.0, 0.0], problem.free_velocity().clone(), 3);
    let bytes = problem.to_fclib(Some(&solution), Some(&solution.impulse)).expect("well formed");
    with_file(&bytes, |file| {
        let back = ContactProblem::read(file).expect("well formed");
        assert_eq!((back.dense(), back.free_velocity(), back.friction()), (problem.dense(), problem.free_velocity(), problem.friction()));
        let again = Solution::read(file, &back).expect("well formed");
        assert_eq!((again.impulse, again.velocity), (solution.impulse.clone(), solution.velocity.clone()));
        assert_eq!(numbers(&open(file).expect("an HDF5 file"), "guesses/1/r").expect("well formed"), solution.impulse.as_slice());
    });
    // what is cut off may be the guess alone
    for end in (1..bytes.len()).step_by(97) {
        with_file(&bytes[..end], |file| {
            let read = ContactProblem::read(file);
            assert!(
                read.as_ref().map_or(end < bytes.len(), |back| end > bytes.len() / 2 && back.dense() == problem.dense()),
                "{end} bytes"
            );
        });
    }
}

#[test]
fn answers_of_a_file_are_written_again_bit_for_bit() {
    let problem = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 0.5]).rows_per_contact(2).friction(vec![0.25]).build();
    let problem = problem.expect("sizes fit");
    // velocities that do not belong to the impulses: nothing is computed again
    let pair = |r: [f64; 2], u: [f64; 2]| Solution::new("stored", r.to_vec().into(), u.to_vec().into(), 0);
    let bits = f64::from_bits(1);
    let answers = StoredAnswers {
        solution: Some(pair([1.0, -0.1], [bits, 7.0])),
        guesses: vec![pair([0.1, 1.0 / 3.0], [0.0, 1e300]), pair([-0.0, 2.0], [3.0, -bits])],
        info: vec![("title".into(), "two of them".into()), ("math_info".into(), "full rank".into())],
        left_out: Vec::new(),
    };
    let bytes = problem.to_fclib_with(&answers).expect("well formed");
    with_file(&bytes, |file| {
        let again = StoredAnswers::read(file).expect("well formed");
        assert_eq!(again, answers);
        assert!(again.guesses[1].impulse[0].is_sign_negative());
        assert_eq!(problem.to_fclib_with(&again).expect("well formed"), bytes);
    });
    with_file(b"{}", |file| assert_eq!(StoredAnswers::read(file).expect("no HDF5"), StoredAnswers::default()));
    let long = |answer: Solution| problem.to_fclib_with(&StoredAnswers { guesses: vec![answer], ..answers.clone() });
    let long = |answer: Solution| long(answer).expect_err("refused").to_string();
    assert!(long(Solution::new("", DVector::zeros(3), DVector::zeros(2), 0)).contains("`guesses/1/r`: has size 3; give size 2"));
    assert!(long(Solution::new("", DVector::zeros(2), DVector::zeros(3), 0)).contains("`guesses/1/u`: has size 3"));
    assert!(problem.to_fclib(None, Some(&DVector::zeros(3))).expect_err("refused").to_string().contains("`guess`: has size 3"));
}

#[test]
fn answers_that_are_not_whole_are_named_and_what_a_local_problem_has_no_place_for_is_listed() {
    let with = |add: fn(&mut FileBuilder)| {
        let mut file = FileBuilder::new();
        add(&mut file);
        file.finish().expect("an HDF5 file in memory")
    };
    let missing = with(|file| {
        let mut group = file.create_group("solution");
        group.create_dataset("r").with_f64_data(&[1.0]);
        file.add_group(group.finish());
    });
    with_file(&missing, |file| assert!(StoredAnswers::read(file).expect_err("no u").to_string().contains("`solution/u`")));
    let negative = with(|file| {
        let mut group = file.create_group("guesses");
        group.create_dataset("number_of_guesses").with_i32_data(&[-1]);
        file.add_group(group.finish());
    });
    with_file(&negative, |file| assert!(StoredAnswers::read(file).expect_err("-1").to_string().contains("number_of_guesses`: is [-1]")));
    with_file(&bob(true, Some([&[7.5, 0.0], &[-2.5], &[0.0, 0.0]])), |file| {
        let names = ["fclib_global/M", "fclib_global/H", "fclib_global/vectors/f", "fclib_global/vectors/w", "solution/l"];
        assert_eq!(StoredAnswers::read(file).expect("well formed").left_out, names);
    });
}

#[test]
fn what_fclib_cannot_hold_and_what_does_not_fit_is_named() {
    let problem = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 0.0, 0.0]).friction(vec![0.5]).build().expect("sizes fit");
    let refused = |problem: ContactProblem| problem.to_fclib(None, None).expect_err("refused").to_string();
    assert!(refused(problem.clone().into_builder().law(Law::Associated).build().expect("sizes fit")).contains("law"));
    assert!(refused(problem.clone().into_builder().shift(dvector![0.1, 0.0, 0.0]).build().expect("sizes fit")).contains("shift"));
    let wrong = |bytes: Vec<u8>, word: &str| {
        with_file(&bytes, |file| {
            let message = ContactProblem::read(file).expect_err("refused").to_string();
            assert!(message.contains(word), "{message} misses {word}");
        });
    };
    let x = [2.0, 3.0, 4.0];
    wrong(stored(-3, [&[0, 1, 3], &[0, 0, 1]], &x), "W/nz");
    wrong(stored(-1, [&[0, 1], &[0, 0, 1]], &x), "W/p");
    wrong(stored(-1, [&[0, 1, 4], &[0, 0, 1]], &x), "W/p");
    wrong(stored(-1, [&[0, 1, 3], &[0, 0, 2]], &x), "(2, 1)");
    wrong(stored(3, [&[0, 1, -1], &[0, 0, 1]], &x), "(1, -1)");
    wrong(stored(4, [&[0, 1, 1], &[0, 0, 1]], &x), "places");
    wrong(FileBuilder::new().finish().expect("an HDF5 file in memory"), "fclib_local");
}

/// A bob of 2 kg at (−3, 1) m/s on a rod along (3, 4)/5 hits a rough wall with normal (1, 0); r, λ and u of the answer where given.
fn bob(is_global: bool, answer: Option<[&[f64]; 3]>) -> Vec<u8> {
    let mut file = FileBuilder::new();
    let mut problem = file.create_group(if is_global { "fclib_global" } else { "fclib_local" });
    problem.create_dataset("spacedim").with_i32_data(&[2]);
    let diagonal: [&[i32]; 2] = [&[0, 1], &[0, 1]];
    let column: [&[i32]; 2] = [&[0, 0], &[0, 1]];
    let mut add = |name: &str, shape: [i32; 2], places: [&[i32]; 2], x: &[f64]| {
        let mut group = problem.create_group(name);
        matrix(&mut group, shape, x.len() as i32, places, x);
        problem.add_group(group.finish());
    };
    if is_global {
        add("M", [2, 2], diagonal, &[2.0, 2.0]);
        add("H", [2, 2], diagonal, &[1.0, 1.0]);
        add("G", [2, 1], column, &[0.6, 0.8]);
    } else {
        add("W", [2, 2], diagonal, &[0.5, 0.5]);
        add("V", [2, 1], column, &[0.3, 0.4]);
        add("R", [1, 1], [&[0], &[0]], &[0.5]);
    }
    let vectors: &[(&str, &[f64])] = if is_global {
        &[("f", &[-6.0, 2.0]), ("w", &[0.0, 0.0]), ("b", &[0.0]), ("mu", &[0.25])]
    } else {
        &[("q", &[-3.0, 1.0]), ("s", &[-1.0]), ("mu", &[0.25])]
    };
    let mut group = problem.create_group("vectors");
    vectors.iter().for_each(|(name, values)| {
        group.create_dataset(name).with_f64_data(values);
    });
    problem.add_group(group.finish());
    file.add_group(problem.finish());
    if let Some([r, l, u]) = answer {
        let mut solution = file.create_group("solution");
        for (name, values) in [("r", r), ("l", l), ("u", u)] {
            solution.create_dataset(name).with_f64_data(values);
        }
        file.add_group(solution.finish());
    }
    file.finish().expect("an HDF5 file in memory")
}

#[test]
fn bilateral_rows_of_local_and_global_problems_are_joints() {
    for is_global in [false, true] {
        // with r_t = 0 the wall and the rod stop it: r_n (1, 0) + λ (3, 4)/5 = (6, −2)
        with_file(&bob(is_global, Some([&[7.5, 0.0], &[-2.5], &[0.0, 0.0]])), |file| {
            let posed = Posed::read(file).expect("well formed");
            let Posed::Jointed(problem) = &posed else { panic!("it has joints") };
            assert_eq!(problem.kinds(), [ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }]);
            // two products and their sum, of numbers up to 3
            assert!((problem.delassus() - dmatrix![0.5, 0.0, 0.3; 0.0, 0.5, 0.4; 0.3, 0.4, 0.5]).amax() <= roundings(8.0));
            assert!((problem.free_velocity() - dvector![-3.0, 1.0, -1.0]).amax() <= roundings(8.0));
            let answer = Solution::read_posed(file, &posed).expect("well formed");
            assert_eq!((answer.impulse, answer.velocity), (dvector![7.5, 0.0, -2.5], dvector![0.0, 0.0, 0.0]));
            assert!(ContactProblem::read(file).expect_err("contacts alone").to_string().contains("kinds"));
        });
    }
    with_file(&bob(true, None), |file| {
        assert!(
            Solution::read_posed(file, &Posed::read(file).expect("well formed")).expect_err("no answer").to_string().contains("solution/r")
        );
    });
}
