//! Tests of the reader of Siconos's `.dat` files.

use super::*;
use nalgebra::{dmatrix, dvector};

/// Two planar contacts, W dense, column after column.
const DENSE: &str = "2\n2\n0\n4\n4\n4\t4\n2 0.5 1 0\n0.5 3 0 1\n1 0 2 0\n0 1 0 2\n-1 0.25 -2 0\n0.5 0\n1";
/// The same, by blocks, each column by column.
const BLOCKS: &str = "2 2 1 4 4  4 2 2  2 4  2 4  3 4  0 2 4  0 1 0 1
    0  2 0.5 0.5 3   1  1 0 0 1   2  1 0 0 1   3  2 0 0 2
    -1 0.25 -2 0   0.5 0  1";
/// The same, as CSparse prints columns.
const COLUMNS: &str = "2 2 2 4 4 2\nCSparse Version 3.1.9, May 4, 2016.  Copyright (c) Timothy A. Davis, 2006-2016
4-by-4, nzmax: 10 nnz: 10, 1-norm: 4.5\n    col 0 : locations 0 to 2\n      0 : 2\n      1 : 0.5\n      2 : 1\n    col 1 : locations 3 to 5
      0 : 0.5\n      1 : 3\n      3 : 1\n    col 2 : locations 6 to 7\n      0 : 1\n      2 : 2\n    col 3 : locations 8 to 9
      1 : 1\n      3 : 2\n-1 0.25 -2 0\n0.5 0";
/// A ball of 2 kg over the plane and a block of 4 kg that turns: M v = H r + f, u = Hᵀ v + b.
const GLOBAL: &str = "2 2 2 3 3 1\nCSparse Version\ntriplet: 3-by-3, nzmax: 3 nnz: 3\n 0 0 : 2\n 1 1 : 2\n 2 2 : 4
    0 3 4 3 4  1 0 0  0 1 0  0 0 1  0 0 -1\n -2 1 8   0.5 0 0 -3   0.25 0.75";
const LCP: &str = "3\n0\n3\n3\n3 3\n1 2 2\n0 1 2\n0 0 1\n-1 -1 -1\n# remarks follow";

fn expected() -> DMatrix<f64> {
    dmatrix![2.0, 0.5, 1.0, 0.0; 0.5, 3.0, 0.0, 1.0; 1.0, 0.0, 2.0, 0.0; 0.0, 1.0, 0.0, 2.0]
}

#[test]
fn three_ways_to_store_a_matrix_give_the_same_problem() {
    for (text, is_sparse) in [(DENSE, false), (BLOCKS, true), (COLUMNS, true)] {
        let problem = read(text, "two").expect("well formed");
        assert_eq!((problem.name(), problem.law(), problem.rows_per_contact()), ("two", Law::Coulomb, 2));
        assert_eq!((problem.dense(), problem.delassus().blocks().is_some()), (&expected(), is_sparse));
        assert_eq!((problem.free_velocity(), problem.friction()), (&dvector![-1.0, 0.25, -2.0, 0.0], &[0.5, 0.0][..]));
    }
}

#[test]
fn a_global_problem_is_reduced_to_its_contacts() {
    let problem = read(GLOBAL, "global").expect("well formed");
    // H has the columns e₁, e₂, e₃, −e₃: the second contact is the turning velocity and its opposite
    let w = dmatrix![0.5, 0.0, 0.0, 0.0; 0.0, 0.5, 0.0, 0.0; 0.0, 0.0, 0.25, -0.25; 0.0, 0.0, -0.25, 0.25];
    assert_eq!(problem.dense(), &w);
    assert_eq!(problem.free_velocity(), &dvector![-0.5, 0.5, 2.0, -5.0], "Hᵀ M⁻¹ f + b");
    assert_eq!(problem.friction(), [0.25, 0.75]);
}

#[test]
fn a_complementarity_problem_keeps_its_asymmetry() {
    let problem = read(LCP, "murty").expect("well formed");
    assert_eq!((problem.law(), problem.rows_per_contact(), problem.contacts()), (Law::Frictionless, 1, 3));
    assert_eq!(problem.dense(), &dmatrix![1.0, 0.0, 0.0; 2.0, 1.0, 0.0; 2.0, 2.0, 1.0]);
}

#[test]
fn every_file_that_is_cut_short_is_refused() {
    for text in [DENSE, BLOCKS, COLUMNS, GLOBAL, LCP] {
        let words: Vec<&str> = text.lines().collect();
        // the mark after μ and the remarks are not needed, the last line of the others is
        let needed = words.len() - usize::from(text == DENSE || text == LCP);
        (0..needed).for_each(|count| assert!(read(&words[..count].join("\n"), "cut").is_err(), "{count} lines of {text}"));
    }
}

#[test]
fn mistakes_are_named_with_their_line() {
    let refused = |text: &str, words: &[&str]| {
        let message = read(text, "wrong").expect_err("refused").to_string();
        words.iter().for_each(|word| assert!(message.contains(word), "{message} misses {word}"));
    };
    refused(&DENSE.replace("0.5 3 0 1", "0.5 three 0 1"), &["W, line 8", "three"]);
    refused(&DENSE.replace("0.5 3 0 1", "0.5 nan 0 1"), &["W, line 8", "NaN"]);
    refused(&DENSE.replace("4\t4", "4\t5"), &["[4, 5]"]);
    refused(&DENSE.replace("0.5 0\n1", "-0.5 0\n1"), &["friction[0]", "negative"]);
    refused(&BLOCKS.replace("0 1 0 1\n", "0 2 0 1\n"), &["do not fit together"]);
    refused(&BLOCKS.replace("   2  1 0 0 1", "   7  1 0 0 1"), &["block 7"]);
    refused(&COLUMNS.replace("      3 : 2", "      4 : 2"), &["(4, 3)"]);
    refused(&COLUMNS.replace("      3 : 2", "      1 : 2"), &["repeats"]);
    refused("4 900000000000 0 4 4", &["sizes"]);
    refused("3 9000000000000000000 0 4 4 4 4 1 2 3 4", &["shorter"]);
    refused("3 1 0 3 3 3 3 1", &["line 1", "shorter"]);
}
