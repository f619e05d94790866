//! W = Y Yᵀ with as many columns as there are velocities, recovered from the blocks of W.
//!
//! ```text
//!     W_gh = Σ_b Y_gb Y_hbᵀ        over the bodies b of both bundles g, h: at most one, unless g = h
//!     Y_gb Y_gbᵀ = W_gh W_lh⁻¹ W_lg ,     Y_hb = W_hg Y_gb⁻ᵀ        g, h, l three bundles of b
//! ```
//! Contacts that meet the same contacts lie between the same two bodies: a bundle. All of its rows are combinations of at most six of
//! them, the pivots of a Cholesky factor of its own block. Bundles of one body meet each other, so that bodies are the cliques of the
//! graph of bundles. What three bundles do not tell of a body is told by a neighbour: W_gg is the sum over both. What is left of W_gg in
//! the end belongs to a body that nothing else touches. Nothing is taken on trust: Y Yᵀ is held against every block of W, and where it
//! differs – contacts of spheres are single, and one does not determine a body – there is no factor.

use super::{BlockSparse, VelocityFactor};
use crate::tolerance::velocities::{MOST_ROWS, MOST_VELOCITIES, RANK, RECOVERED};
use nalgebra::DMatrix;
use std::collections::{BTreeMap, BTreeSet};

/// Contacts with the same neighbours.
struct Bundle {
    contacts: Vec<usize>,
    /// The rows, as contact of the bundle and row of it, of which all others are combinations.
    pivots: Vec<(usize, usize)>,
    /// All rows in terms of the pivots.
    weights: DMatrix<f64>,
    /// W of the pivots.
    own: DMatrix<f64>,
    /// The bundles it meets, growing.
    neighbours: Vec<usize>,
    bodies: Vec<usize>,
}

impl VelocityFactor {
    /// None where W is not such a product, or its blocks do not determine the bodies.
    pub fn recover(w: &BlockSparse) -> Option<Self> {
        let mut bundles = bundles(w)?;
        let bodies = bodies(&mut bundles)?;
        let mut known: Vec<Option<Known>> = bodies.iter().map(|_| None).collect();
        for (b, members) in bodies.iter().enumerate() {
            known[b] = from_three(w, &bundles, members);
        }
        spread(w, &bundles, &bodies, &mut known);
        let (mut columns, mut parts) = (Vec::new(), vec![Vec::new(); w.contacts()]);
        for (members, known) in bodies.iter().zip(&known) {
            let known = known.as_ref()?;
            columns.push(known.columns);
            for (g, factor) in members.iter().zip(&known.factors) {
                bundles[*g].add(columns.len() - 1, w.rows_per_contact(), factor, &mut parts);
            }
        }
        for (g, bundle) in bundles.iter().enumerate() {
            let mut left = bundle.own.clone();
            for b in &bundle.bodies {
                let factor = known[*b].as_ref()?.factor(&bodies[*b], g);
                left -= factor * factor.transpose();
            }
            let factor = pivoted(&left, RECOVERED * bundle.own.amax())?;
            if factor.ncols() > 0 {
                columns.push(factor.ncols());
                bundle.add(columns.len() - 1, w.rows_per_contact(), &factor, &mut parts);
            }
        }
        let mut found = VelocityFactor::with_capacity(columns, w.rows_per_contact(), w.contacts(), 0);
        for contact in &parts {
            contact.iter().for_each(|(group, block)| found.push(*group, block.transpose().iter().copied()));
            found.end();
        }
        found.reproduces(w).then_some(found)
    }

    /// Whether Y Yᵀ is W, block by block.
    fn reproduces(&self, w: &BlockSparse) -> bool {
        let size: Vec<f64> =
            (0..w.contacts()).map(|k| w.block(k, k).map_or(0.0, |block| block.iter().fold(0.0_f64, |a, x| a.max(x.abs())))).collect();
        (0..w.contacts()).all(|k| {
            w.column(k).all(|(j, block)| {
                let limit = RECOVERED * (size[j] * size[k]).sqrt();
                block.iter().zip(self.product(j, k)).all(|(entry, found)| (entry - found).abs() <= limit)
            })
        })
    }

    /// A bound of how far Y Yᵀ is from W, row by row: max |W_ij − (Y Yᵀ)_ij|/√(W_ii W_jj) times the most entries of a row. Then
    /// W + `deviation` diag W is positive semidefinite.
    pub fn deviation(&self, w: &BlockSparse) -> f64 {
        let d = w.rows_per_contact();
        let diagonal = |k: usize, row: usize| w.block(k, k).map_or(0.0, |block| block[row * (d + 1)]);
        let (mut farthest, mut most) = (0.0_f64, 0);
        for k in 0..w.contacts() {
            most = most.max(d * w.met(k).len());
            for (j, block) in w.column(k) {
                for (at, (entry, found)) in block.iter().zip(self.product(j, k)).enumerate() {
                    let off = (entry - found).abs();
                    if off > 0.0 {
                        farthest = farthest.max(off / (diagonal(j, at % d) * diagonal(k, at / d)).sqrt());
                    }
                }
            }
        }
        most as f64 * farthest
    }

    /// Y_j Y_kᵀ of two contacts, column after column.
    fn product(&self, j: usize, k: usize) -> [f64; 9] {
        let (d, mut found) = (self.rows_per_contact(), [0.0; 9]);
        for (group, own) in self.parts(k) {
            for (_, other) in self.parts(j).iter().filter(|(other, _)| other == group) {
                let n = self.columns[*group];
                let rows = |first: usize| self.entries[first..first + d * n].chunks_exact(n);
                for (column, y_k) in rows(*own).enumerate() {
                    for (row, y_j) in rows(*other).enumerate() {
                        found[column * d + row] += dot(y_j, y_k);
                    }
                }
            }
        }
        found
    }
}

/// The sum of products; nearly all bodies have six velocities.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    match (<&[f64; 6]>::try_from(a), <&[f64; 6]>::try_from(b)) {
        (Ok(a), Ok(b)) => (0..6).map(|i| a[i] * b[i]).sum(),
        _ => a.iter().zip(b).map(|(a, b)| a * b).sum(),
    }
}

impl Bundle {
    /// Adds the rows of all its contacts at one group to their parts.
    fn add(&self, group: usize, d: usize, factor: &DMatrix<f64>, parts: &mut [Vec<(usize, DMatrix<f64>)>]) {
        let rows = &self.weights * factor;
        for (place, &contact) in self.contacts.iter().enumerate() {
            parts[contact].push((group, rows.rows(place * d, d).into_owned()));
        }
    }
}

/// Contacts by the list of those they meet, themselves included.
fn bundles(w: &BlockSparse) -> Option<Vec<Bundle>> {
    let meets = |k: usize| w.column(k).filter(|(_, block)| block.iter().any(|x| *x != 0.0)).map(|(j, _)| j).collect::<Vec<usize>>();
    let mut by_list: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
    (0..w.contacts()).for_each(|k| by_list.entry(meets(k)).or_default().push(k));
    let mut of = vec![0; w.contacts()];
    let mut groups: Vec<(Vec<usize>, Vec<usize>)> = by_list.into_iter().map(|(list, contacts)| (contacts, list)).collect();
    groups.sort();
    groups.iter().enumerate().for_each(|(g, (contacts, _))| contacts.iter().for_each(|k| of[*k] = g));
    groups
        .into_iter()
        .enumerate()
        .map(|(g, (contacts, list))| {
            let mut neighbours: Vec<usize> = list.into_iter().map(|k| of[k]).filter(|h| *h != g).collect();
            neighbours.sort_unstable();
            neighbours.dedup();
            let rows: Vec<(usize, usize)> = contacts.iter().flat_map(|&k| (0..w.rows_per_contact()).map(move |i| (k, i))).collect();
            if rows.len() > MOST_ROWS {
                return None;
            }
            let full = gather(w, &rows, &rows);
            let order = pivots(&full)?;
            let pivots: Vec<(usize, usize)> = order.iter().map(|&at| rows[at]).collect();
            let own = gather(w, &pivots, &pivots);
            let weights = own.clone().cholesky()?.solve(&gather(w, &pivots, &rows)).transpose();
            Some(Bundle { contacts, pivots, weights, own, neighbours, bodies: Vec::new() })
        })
        .collect()
}

/// Entries of W at these rows and columns.
fn gather(w: &BlockSparse, rows: &[(usize, usize)], columns: &[(usize, usize)]) -> DMatrix<f64> {
    let d = w.rows_per_contact();
    let mut found = DMatrix::zeros(rows.len(), columns.len());
    for (b, (k, c)) in columns.iter().enumerate() {
        let mut last = (usize::MAX, None);
        for (a, (j, i)) in rows.iter().enumerate() {
            if last.0 != *j {
                last = (*j, w.block(*j, *k));
            }
            found[(a, b)] = last.1.map_or(0.0, |block| block[c * d + i]);
        }
    }
    found
}

/// Rows whose pivots are more than rounding, largest first, by Cholesky; none if there is none, or more than two bodies have velocities.
fn pivots(matrix: &DMatrix<f64>) -> Option<Vec<usize>> {
    let (size, mut rest, mut found) = (matrix.nrows(), matrix.clone(), Vec::new());
    let scale = matrix.diagonal().amax();
    loop {
        let best = (0..size).filter(|i| !found.contains(i)).max_by(|a, b| rest[(*a, *a)].total_cmp(&rest[(*b, *b)]).then(b.cmp(a)));
        let Some(best) = best.filter(|&i| rest[(i, i)] > RANK * scale) else { break };
        if found.len() == MOST_VELOCITIES {
            return None;
        }
        found.push(best);
        let column = rest.column(best).into_owned();
        let pivot = column[best];
        for j in 0..size {
            let factor = column[j] / pivot;
            (0..size).for_each(|i| rest[(i, j)] -= column[i] * factor);
        }
    }
    (!found.is_empty()).then_some(found)
}

/// The L with L Lᵀ = matrix, its columns as many as there are pivots above a threshold; none where a pivot is below minus that.
fn pivoted(matrix: &DMatrix<f64>, threshold: f64) -> Option<DMatrix<f64>> {
    let (size, mut rest, mut columns) = (matrix.nrows(), matrix.clone(), Vec::new());
    while columns.len() < size {
        let best = (0..size).max_by(|a, b| rest[(*a, *a)].total_cmp(&rest[(*b, *b)]).then(b.cmp(a)))?;
        if rest[(best, best)] <= threshold {
            break;
        }
        let column = rest.column(best) / rest[(best, best)].sqrt();
        rest -= &column * column.transpose();
        columns.push(column);
    }
    let is_semidefinite = (0..size).all(|i| rest[(i, i)] >= -threshold);
    is_semidefinite.then(|| if columns.is_empty() { DMatrix::zeros(size, 0) } else { DMatrix::from_columns(&columns) })
}

/// The bundles of every body: for two that meet, those that meet both and each other. None where a bundle would have three bodies.
fn bodies(bundles: &mut [Bundle]) -> Option<Vec<Vec<usize>>> {
    let mut found: Vec<Vec<usize>> = Vec::new();
    for g in 0..bundles.len() {
        for h in bundles[g].neighbours.clone() {
            if h < g || bundles[g].bodies.iter().any(|b| bundles[h].bodies.contains(b)) {
                continue;
            }
            let meets = |one: usize, other: usize| bundles[one].neighbours.binary_search(&other).is_ok();
            let common: Vec<usize> = bundles[g].neighbours.iter().copied().filter(|l| meets(h, *l)).collect();
            let mut members = vec![g, h];
            // one that closes a triangle of bodies meets none of the others
            members.extend(common.iter().filter(|l| common.len() == 1 || common.iter().any(|m| m != *l && meets(**l, *m))));
            members.sort_unstable();
            let is_clique = members.iter().all(|a| members.iter().all(|b| a == b || meets(*a, *b)));
            if !is_clique {
                return None;
            }
            for member in &members {
                bundles[*member].bodies.push(found.len());
                if bundles[*member].bodies.len() > 2 {
                    return None;
                }
            }
            found.push(members);
        }
    }
    Some(found)
}

/// Y of one body.
struct Known {
    columns: usize,
    /// By member.
    factors: Vec<DMatrix<f64>>,
}

impl Known {
    /// From Y_gb Y_gbᵀ of one member: Y_hb = W_hg Y_gb⁻ᵀ.
    fn from_one(w: &BlockSparse, bundles: &[Bundle], members: &[usize], g: usize, square: DMatrix<f64>) -> Option<Self> {
        let lower = ((&square + square.transpose()) * 0.5).cholesky()?.l();
        let factors = members.iter().map(|&h| {
            if h == g {
                return Some(lower.clone());
            }
            let across = gather(w, &bundles[g].pivots, &bundles[h].pivots);
            Some(lower.solve_lower_triangular(&across)?.transpose())
        });
        Some(Known { columns: lower.ncols(), factors: factors.collect::<Option<_>>()? })
    }

    fn factor(&self, members: &[usize], g: usize) -> &DMatrix<f64> {
        &self.factors[members.iter().position(|member| *member == g).expect("a bundle is a member of its bodies")]
    }
}

/// By three bundles with the most pivots; of the first pairs h, l the one with W_lh best to invert.
fn from_three(w: &BlockSparse, bundles: &[Bundle], members: &[usize]) -> Option<Known> {
    let rank = members.iter().map(|g| bundles[*g].pivots.len()).max()?;
    let full: Vec<usize> = members.iter().copied().filter(|g| bundles[*g].pivots.len() == rank).collect();
    let [first, second, third] = full.first_chunk::<3>()?;
    let mut best: Option<(f64, usize, DMatrix<f64>)> = None;
    for [g, h, l] in [[first, second, third], [second, third, first], [third, first, second]] {
        let [gh, lh, lg] = [(g, h), (l, h), (l, g)].map(|(one, other)| gather(w, &bundles[*one].pivots, &bundles[*other].pivots));
        let Some(inverse) = lh.clone().try_inverse() else { continue };
        let condition = inverse.amax() * lh.amax();
        if best.as_ref().is_none_or(|(least, ..)| condition < *least) {
            best = Some((condition, *g, gh * inverse * lg));
        }
    }
    let (_, g, square) = best?;
    Known::from_one(w, bundles, members, g, square)
}

/// Finds what three bundles do not tell, the first body first: beside a known one, or else where a bundle has no other body. A body is
/// tried again only when one beside it becomes known, so that a long chain is gone through once.
fn spread(w: &BlockSparse, bundles: &[Bundle], bodies: &[Vec<usize>], known: &mut [Option<Known>]) {
    let beside = |b: usize| bodies[b].iter().flat_map(|g| bundles[*g].bodies.iter().copied());
    let mut candidates: BTreeSet<usize> = (0..bodies.len()).filter(|b| known[*b].is_some()).flat_map(beside).collect();
    let mut alone = 0..bodies.len();
    while let Some((b, has_neighbour)) = candidates.pop_first().map(|b| (b, true)).or_else(|| alone.next().map(|b| (b, false))) {
        if known[b].is_some() {
            continue;
        }
        let found = if has_neighbour { from_neighbour(w, bundles, bodies, known, b) } else { from_itself(w, bundles, &bodies[b]) };
        if found.is_some() {
            known[b] = found;
            candidates.extend(beside(b));
        }
    }
}

/// From what a known body leaves of a bundle with the most pivots.
fn from_neighbour(w: &BlockSparse, bundles: &[Bundle], bodies: &[Vec<usize>], known: &[Option<Known>], b: usize) -> Option<Known> {
    let rank = bodies[b].iter().map(|g| bundles[*g].pivots.len()).max()?;
    bodies[b].iter().filter(|g| bundles[**g].pivots.len() == rank).find_map(|&g| {
        let other = bundles[g].bodies.iter().copied().find(|other| *other != b)?;
        let factor = known[other].as_ref()?.factor(&bodies[other], g);
        Known::from_one(w, bundles, &bodies[b], g, &bundles[g].own - factor * factor.transpose())
    })
}

/// From the bundle of this body alone that has the most pivots.
fn from_itself(w: &BlockSparse, bundles: &[Bundle], members: &[usize]) -> Option<Known> {
    let g = members.iter().copied().filter(|g| bundles[*g].bodies.len() == 1).max_by_key(|g| bundles[*g].pivots.len())?;
    Known::from_one(w, bundles, members, g, bundles[g].own.clone())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::operator::{BlockRows, MatrixFree, Sparse, SparseDynamics};
    use nalgebra::dmatrix;

    /// W of a wall of bricks 1 m × ½ m × ½ m in running bond, four contacts where two overlap; a brick has `ratio` times the mass of the
    /// one before.
    pub(crate) fn wall(wide: usize, high: usize, ratio: f64) -> BlockSparse {
        let (mut mass, mut jacobian, mut row) = (Vec::new(), Vec::new(), 0);
        let place = |i: usize, j: usize| j as f64 + 0.5 * (i % 2) as f64;
        for (body, (i, j)) in (0..high).flat_map(|i| (0..wide).map(move |j| (i, j))).enumerate() {
            let x = place(i, j);
            let m = ratio.powi(body as i32);
            let inertia = [0.5 / 12.0, 1.25 / 12.0, 1.25 / 12.0];
            (0..3).for_each(|c| mass.extend([(6 * body + c, 6 * body + c, m), (6 * body + 3 + c, 6 * body + 3 + c, m * inertia[c])]));
            let below: Vec<Option<usize>> =
                if i == 0 { vec![None] } else { (0..wide).filter(|k| (place(i - 1, *k) - x).abs() < 0.75).map(Some).collect() };
            for support in below {
                let other = support.map_or(x, |k| place(i - 1, k));
                for (px, py) in [-0.5, 0.5].into_iter().flat_map(|end| [-0.25, 0.25].map(|py| (end, py))) {
                    let at = if px < 0.0 { x.max(other) - 0.5 } else { x.min(other) + 0.5 };
                    let mut add = |body: usize, arm: [f64; 3], sign: f64| {
                        // n = e_z, t₁ = e_x, t₂ = e_y: e·(v + ω × arm)
                        for (r, (axis, turn)) in
                            [(2, [arm[1], -arm[0], 0.0]), (0, [0.0, arm[2], -arm[1]]), (1, [-arm[2], 0.0, arm[0]])].into_iter().enumerate()
                        {
                            jacobian.push((row + r, 6 * body + axis, sign));
                            turn.into_iter().enumerate().for_each(|(c, x)| jacobian.push((row + r, 6 * body + 3 + c, sign * x)));
                        }
                    };
                    add(body, [at - x, py, -0.25], 1.0);
                    if let Some(k) = support {
                        add((i - 1) * wide + k, [at - other, py, 0.25], -1.0);
                    }
                    row += 3;
                }
            }
        }
        let size = 6 * wide * high;
        let sparse = |rows: usize, entries: Vec<(usize, usize, f64)>| Sparse { shape: [rows, size], entries };
        SparseDynamics::new(&sparse(size, mass), &sparse(row, jacobian), 3).unwrap().delassus().unwrap()
    }

    fn product(factor: &VelocityFactor, contacts: usize, d: usize) -> DMatrix<f64> {
        let columns: usize = factor.columns.iter().sum();
        let mut y = DMatrix::zeros(contacts * d, columns);
        for k in 0..factor.contacts() {
            for (group, at) in factor.parts(k) {
                let (first, n) = (factor.columns[..*group].iter().sum::<usize>(), factor.columns[*group]);
                let block = DMatrix::from_row_slice(d, n, &factor.entries[*at..at + d * n]);
                y.view_mut((k * d, first), (d, n)).copy_from(&block);
            }
        }
        &y * y.transpose()
    }

    #[test]
    fn bricks_are_found_from_the_blocks_alone() {
        for (wide, high, ratio) in [(1, 1, 1.0), (2, 2, 1.0), (4, 3, 1.0), (3, 5, 0.5), (3, 3, 4.0)] {
            let w = wall(wide, high, ratio);
            let factor = VelocityFactor::recover(&w).unwrap_or_else(|| panic!("{wide} × {high} {ratio}"));
            assert_eq!(factor.columns.iter().sum::<usize>(), 6 * wide * high, "six velocities per brick");
            let dense = w.to_dense();
            let difference = product(&factor, w.contacts(), 3) - &dense;
            for k in 0..dense.nrows() {
                let scale = dense[(k, k)];
                assert!(difference[(k, k)].abs() <= RECOVERED * scale, "{wide} × {high} {ratio}");
            }
        }
    }

    #[test]
    fn known_bodies_make_the_same_operator() {
        // a body of two coupled velocities, one that cannot move, and one of a single velocity
        let masses = [dmatrix![2.0, 0.5; 0.5, 1.0], DMatrix::zeros(0, 0), dmatrix![4.0]];
        let mut jacobian = BlockRows::new(2, [2, 0, 1]).unwrap();
        jacobian.push(&[(0, &[1.0, -1.0, 0.5, 2.0]), (2, &[3.0, 1.0])]).unwrap();
        jacobian.push(&[(0, &[0.0, 1.0, 1.0, 0.0]), (1, &[])]).unwrap();
        let free = MatrixFree::new(&masses, jacobian).unwrap();
        let factor = VelocityFactor::of_bodies(&free).expect("symmetric masses");
        let w = free.delassus().unwrap().to_dense();
        assert!((product(&factor, 2, 2) - &w).amax() <= moreau_exact::tolerance::rounding(16, w.amax()));
    }

    #[test]
    fn a_w_that_is_no_such_product_has_no_factor() {
        // planted: one block is another one than the bodies make
        let w = wall(3, 3, 1.0);
        assert!(w.block(12, 0).is_some(), "a contact on the floor meets one on top of its brick");
        let blocks = (0..w.contacts()).flat_map(|k| w.column(k).map(move |(j, block)| (j, k, DMatrix::from_column_slice(3, 3, block))));
        let spoilt = blocks.map(|(j, k, block)| (j, k, if (j, k) == (12, 0) { block * 1.001 } else { block })).collect();
        assert!(VelocityFactor::recover(&BlockSparse::new(3, w.contacts(), spoilt).unwrap()).is_none());
        // asymmetric, without contacts, indefinite, a chain of masses whose single contacts do not determine the bodies
        let entry = |x: f64| DMatrix::from_element(1, 1, x);
        let of = |count: usize, blocks: Vec<(usize, usize, f64)>| {
            BlockSparse::new(1, count, blocks.into_iter().map(|(j, k, x)| (j, k, entry(x))).collect()).unwrap()
        };
        assert!(VelocityFactor::recover(&of(2, vec![(0, 0, 1.0), (1, 1, 1.0), (0, 1, 0.5), (1, 0, 0.25)])).is_none());
        assert!(VelocityFactor::recover(&of(1, vec![(0, 0, -1.0)])).is_none());
        assert!(VelocityFactor::recover(&of(0, Vec::new())).is_some_and(|factor| factor.columns.is_empty()));
        // a contact alone is a body of its own, two points that move together are one
        assert_eq!(VelocityFactor::recover(&of(1, vec![(0, 0, 2.0)])).unwrap().columns[..], [1]);
        assert_eq!(VelocityFactor::recover(&of(2, vec![(0, 0, 1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 1.0)])).unwrap().columns[..], [1]);
    }

    #[test]
    fn what_a_factor_is_off_is_told_in_parts_of_both_rows() {
        let right = wall(3, 3, 1.0);
        let factor = VelocityFactor::recover(&right).expect("bodies");
        let met = |k: usize| right.column(k).map(move |(j, block)| (j, k, DMatrix::from_column_slice(3, 3, block)));
        let near = factor.deviation(&right);
        assert!(near < RECOVERED, "{near:e}");
        for part in [1e-3, 0.5] {
            let mut blocks: Vec<_> = (0..right.contacts()).flat_map(met).collect();
            let (row, column, block) = blocks.iter_mut().find(|(j, k, _)| j != k).expect("contacts of one brick");
            block[(0, 0)] += part * (right.entry(3 * *row, 3 * *row) * right.entry(3 * *column, 3 * *column)).sqrt();
            let far = factor.deviation(&BlockSparse::new(3, right.contacts(), blocks).unwrap());
            assert!(far >= 0.99 * part, "{part} {far:e}");
        }
    }
}
