//! Answers that differ along null(W): Hᵀx = 0 leaves every velocity alone, so r + x is a solution wherever it keeps the cone conditions.

use crate::exact::{rounded, zero};
use crate::family::{Member, answer};
use crate::near::worst;
use crate::rule::{Answer, CERTIFY, NONE, judge};
use crate::tally::{Tally, Verdict};
use moreau::certificate::residuals;
use moreau::scalar::{Rational, Scalar, ratio};
use nalgebra::DMatrix;

/// How many directions of a member are tried.
const TRIED: usize = 6;

/// Transfers between contacts at one point, then a basis of null(Hᵀ), both ways.
fn directions(member: &Member) -> Vec<Vec<Rational>> {
    let basis = null_space(&member.jacobian.transpose());
    let both = basis.into_iter().flat_map(|x| [x.iter().map(|x| -x).collect(), x]);
    transfers(member).into_iter().chain(both).take(TRIED).collect()
}

/// What contact a carries goes over to contact b, which has the same rows.
fn transfers(member: &Member) -> Vec<Vec<Rational>> {
    let (rows, contacts) = (member.spec.rows, member.spec.contacts);
    let same = |a: usize, b: usize| member.jacobian.rows(a * rows, rows) == member.jacobian.rows(b * rows, rows);
    let pairs = (0..contacts).flat_map(|a| (0..contacts).map(move |b| (a, b))).filter(|&(a, b)| a != b && same(a, b));
    pairs
        .map(|(a, b)| {
            let mut x = vec![zero(); member.impulse.len()];
            for i in 0..rows {
                let part = member.impulse[a * rows + i].clone();
                (x[a * rows + i], x[b * rows + i]) = (-&part, part);
            }
            x
        })
        .collect()
}

/// A basis of {x: A x = 0} by elimination.
fn null_space(matrix: &DMatrix<Rational>) -> Vec<Vec<Rational>> {
    let mut a = matrix.clone();
    let mut pivots = Vec::new();
    for column in 0..a.ncols() {
        let row = pivots.len();
        let Some(pivot) = (row..a.nrows()).find(|&i| a[(i, column)] != zero()) else { continue };
        a.swap_rows(row, pivot);
        let head = a[(row, column)].clone();
        a.row_mut(row).iter_mut().for_each(|entry| *entry /= &head);
        for i in (0..a.nrows()).filter(|&i| i != row) {
            let factor = a[(i, column)].clone();
            if factor != zero() {
                (column..a.ncols()).for_each(|j| a[(i, j)] = &a[(i, j)] - &factor * &a[(row, j)]);
            }
        }
        pivots.push(column);
    }
    let free = (0..a.ncols()).filter(|column| !pivots.contains(column));
    free.map(|column| {
        let mut x = vec![zero(); a.ncols()];
        x[column] = ratio(1, 1);
        pivots.iter().enumerate().for_each(|(row, &pivot)| x[pivot] = -&a[(row, column)]);
        x
    })
    .collect()
}

/// Certifies every r + x that the rule calls exact.
pub fn examine(member: &Member, tally: &mut Tally) {
    let largest = member.impulse.iter().map(Scalar::magnitude).fold(zero(), Rational::max);
    for x in directions(member) {
        let size = x.iter().map(Scalar::magnitude).fold(zero(), Rational::max);
        if size == zero() {
            continue;
        }
        let exact = [1, 4, 16, 64].into_iter().find_map(|part| {
            let step = &largest / (&size * ratio(2 * part, 1));
            let moved: Vec<Rational> = member.impulse.iter().zip(&x).map(|(r, x)| r + x * &step).collect();
            let net = member.exact.net(&moved);
            let ratios = judge(&member.exact, &member.groups, &Answer { impulse: &moved, net: &net }, NONE);
            (worst(&ratios).most == 0.0).then_some(moved)
        });
        let verdict = match exact {
            None => Verdict::OutOfReach,
            Some(moved) => {
                let solution = answer(&member.problem, rounded(&moved));
                let accepted = residuals(&member.problem, &solution).expect("sizes fit").is_solution(CERTIFY.tolerance);
                if !accepted {
                    tally.mistake(format!("WronglyRefused: {}, an answer along null(W)", member.name));
                }
                if accepted { Verdict::Accepted } else { Verdict::WronglyRefused }
            }
        };
        tally.add(member, "along", "null(W)", verdict);
    }
}
