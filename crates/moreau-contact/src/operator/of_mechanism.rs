//! W of a mechanism whose mass and rows are known body by body, with the entries that the dense formula gives, bit for bit.
//!
//! ```text
//!     W_jk = Σ_b (L_b⁻¹H_jbᵀ)ᵀ D_b⁻¹ (L_b⁻¹H_kbᵀ)        b over the bodies that both contacts touch
//! ```
//! It costs as much as there are pairs of contacts that meet.

use super::{BlockRows, BlockSparse, Lists, MatrixFree, Operator};
use crate::contact::delassus::{MassFactor, delassus_factored};
use crate::contact::{Inertia, Jacobian, Rows};
use crate::memory;
use crate::memory::spare::{self, Lent, spare_entries};
use crate::tolerance::problem::STORED_CONTACTS;
use moreau_exact::number::are_finite;
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// What one contact has at one body: H_bᵀ from the left, and the same over the pivots of the body's mass, velocities × rows.
#[derive(Clone)]
struct Half {
    body: usize,
    left: [f64; LARGEST],
    weighted: [f64; LARGEST],
}

spare_entries![Half];

/// Velocities of a free body times rows of a contact, at most.
pub(super) const LARGEST: usize = 18;

/// Rows and velocities of contacts between free bodies in space, which nearly all are.
const SPATIAL: [usize; 2] = [3, 6];

/// W = H M⁻¹ Hᵀ \[1/kg\]: by blocks where the mass consists of bodies and most contacts do not meet, densely otherwise, with the same
/// entries bit for bit; where many contacts of bodies all meet, as those of one plate, it is not formed and acts through the bodies.
///
/// # Errors
/// [`Error::Invalid`] if H does not fit the mass, is not finite, or needs more memory than is allowed.
pub fn of_mechanism(inertia: &Inertia, jacobian: &Jacobian) -> Result<Operator> {
    if inertia.size() != jacobian.ncols() {
        let cure = format!("give {} columns, one per row of the mass matrix", inertia.size());
        return Err(Error::invalid("jacobian", format!("has {} columns", jacobian.ncols()), cure));
    }
    let n = jacobian.contacts().len();
    if let Some(width) = body_width(jacobian).filter(|width| inertia.is_made_of(*width)) {
        let meeting = Meeting::new(jacobian, width);
        let nearly_all_meet = n > STORED_CONTACTS && 2 * meeting.pairs >= n * n;
        // none where a mass is infinite
        if let Some(masses) = if nearly_all_meet { inertia.bodies(width) } else { None } {
            return through_bodies(&masses, jacobian, width).map(Operator::from);
        }
        let blocks = blocks(inertia, jacobian, width, &meeting)?;
        return Ok(if 2 * meeting.pairs < n * n { blocks.into() } else { blocks.to_dense().into() });
    }
    let room = memory::matrix(jacobian.nrows(), jacobian.nrows())
        .saturating_add(memory::matrix(jacobian.nrows(), jacobian.ncols()).saturating_mul(2));
    memory::require("the Delassus operator of this step", room)?;
    delassus_factored(inertia.factor(), &jacobian.to_dense()).map(Operator::from)
}

/// W by the bodies that contacts touch, of these masses.
fn through_bodies(masses: &[DMatrix<f64>], jacobian: &Jacobian, width: usize) -> Result<MatrixFree> {
    let mut rows = BlockRows::new(jacobian.rows_per_contact(), std::iter::repeat_n(width, masses.len()))?;
    rows.reserve(jacobian.contacts().len())?;
    for contact in jacobian.contacts() {
        let parts: Vec<(usize, &[f64])> = contact.parts().map(|part| (part.first / width, part.entries)).collect();
        rows.push(&parts)?;
    }
    MatrixFree::new(masses, rows)
}

/// The number of velocities of every body, if each part belongs to one of equal bodies that follow each other.
pub(super) fn body_width(jacobian: &Jacobian) -> Option<usize> {
    let mut parts = jacobian.contacts().iter().flat_map(Rows::parts);
    let width = jacobian.contacts().first()?.parts().next()?.width;
    let is_one = (1..=3).contains(&jacobian.rows_per_contact())
        && width * jacobian.rows_per_contact() <= LARGEST
        && jacobian.ncols().is_multiple_of(width);
    (is_one && parts.all(|part| part.width == width && part.first.is_multiple_of(width))).then_some(width)
}

fn blocks(inertia: &Inertia, jacobian: &Jacobian, width: usize, meeting: &Meeting) -> Result<BlockSparse> {
    let d = jacobian.rows_per_contact();
    memory::require("the Delassus blocks of this step", (meeting.pairs as u128).saturating_mul((8 * d * d + 16) as u128))?;
    let halves = Halves::new(inertia.factor(), jacobian, width, meeting.members.total())?;
    let mut made = meeting.without_entries(d);
    match [d, width] {
        SPATIAL => fill::<3, 9>(&mut made, &halves, spatial_product),
        [1, _] => fill::<1, 1>(&mut made, &halves, |later, earlier| product::<1, 1>(later, earlier, width)),
        [2, _] => fill::<2, 4>(&mut made, &halves, |later, earlier| product::<2, 4>(later, earlier, width)),
        _ => fill::<3, 9>(&mut made, &halves, |later, earlier| product::<3, 9>(later, earlier, width)),
    }
    Ok(made)
}

/// The halves of all contacts, those of contact k from starts[k] to starts[k + 1].
struct Halves {
    halves: Lent<Vec<Half>>,
    starts: Lent<Vec<usize>>,
}

impl Halves {
    fn new(factor: &MassFactor<f64>, jacobian: &Jacobian, width: usize, total: usize) -> Result<Self> {
        let mut halves: Lent<Vec<Half>> = spare::vector(total).into();
        let mut starts: Lent<Vec<usize>> = spare::vector(jacobian.contacts().len() + 1).into();
        for contact in jacobian.contacts() {
            starts.push(halves.len());
            for part in contact.parts() {
                if !are_finite(part.entries) {
                    let wrong = part.entries.iter().find(|entry| !entry.is_finite()).unwrap_or(&f64::NAN);
                    return Err(Error::invalid("jacobian", format!("holds {wrong}"), "use finite numbers"));
                }
                halves.push(Half::new(factor, [part.first, width], part.entries));
            }
        }
        starts.push(halves.len());
        Ok(Halves { halves, starts })
    }

    /// Those of a contact, bodies growing.
    #[inline]
    fn of(&self, contact: usize) -> &[Half] {
        &self.halves[self.starts[contact]..self.starts[contact + 1]]
    }
}

impl Half {
    #[inline]
    fn new(factor: &MassFactor<f64>, [first, width]: [usize; 2], entries: &[f64]) -> Self {
        let mut half = Half { body: first / width, left: [0.0; LARGEST], weighted: [0.0; LARGEST] };
        let (left, pivots) = (&mut half.left[..entries.len()], &factor.pivots()[first..first + width]);
        left.copy_from_slice(entries);
        if !factor.is_diagonal() {
            left.chunks_exact_mut(width).for_each(|row| factor.forward_within(first, row));
        }
        match pivots.first_chunk::<{ SPATIAL[1] }>().filter(|_| width == SPATIAL[1]) {
            Some(pivots) => weigh(&mut half.weighted, left, pivots),
            None => weigh(&mut half.weighted, left, pivots),
        }
        half
    }
}

/// Row by row over the pivots.
#[inline(always)]
fn weigh(weighted: &mut [f64], left: &[f64], pivots: &[f64]) {
    for (row, half) in weighted.chunks_exact_mut(pivots.len()).zip(left.chunks_exact(pivots.len())) {
        row.iter_mut().zip(half).zip(pivots).for_each(|((weighted, y), d)| *weighted = y / d);
    }
}

/// Appends the blocks of contacts of so many rows, of so many entries: W_jk = `product` of the halves of j and k, j ≥ k. Of a diagonal
/// block the lower triangle is mirrored.
fn fill<const ROWS: usize, const SIZE: usize>(made: &mut BlockSparse, halves: &Halves, product: impl Fn(&[Half], &[Half]) -> [f64; SIZE]) {
    let (starts, coupled, entries) = made.parts_mut();
    // of every column so far the place of the first block that has not been mirrored yet
    let mut next: Lent<Vec<usize>> = spare::repeated(starts.len(), 0).into();
    for k in 0..starts.len() - 1 {
        let (met, own) = (&coupled[starts[k]..starts[k + 1]], halves.of(k));
        let (before, rest) = met.split_at(met.partition_point(|j| *j < k));
        let Some((_, after)) = rest.split_first() else { continue };
        for j in before {
            // W_jk = W_kjᵀ, which stands in the column of j: contacts that meet meet in both orders
            let block = transposed::<ROWS, SIZE>(&entries.as_chunks().0[next[*j]]);
            entries.extend_from_slice(&block);
            next[*j] += 1;
        }
        next[k] = starts[k] + before.len() + 1;
        // it meets itself
        let mut diagonal = product(own, own);
        mirror::<ROWS, SIZE>(&mut diagonal);
        entries.extend_from_slice(&diagonal);
        after.iter().for_each(|j| entries.extend_from_slice(&product(halves.of(*j), own)));
    }
}

/// [`product`] of contacts between free bodies in space, with the same entries bit for bit.
#[inline]
fn spatial_product(later: &[Half], earlier: &[Half]) -> [f64; 9] {
    const ROWS: usize = SPATIAL[0];
    const WIDTH: usize = SPATIAL[1];
    let mut block = [[0.0; ROWS]; ROWS];
    for half in later {
        let Some(other) = earlier.iter().find(|other| other.body == half.body) else { continue };
        let [weighted, left] = [&half.weighted, &other.left].map(|rows| rows.as_chunks::<WIDTH>().0);
        for axis in 0..WIDTH {
            for (column, left) in block.iter_mut().zip(left) {
                column.iter_mut().zip(weighted).for_each(|(entry, weighted)| *entry += weighted[axis] * left[axis]);
            }
        }
    }
    *block.as_flattened().as_array().expect("as many entries")
}

/// Σ_b (L⁻¹H_jᵀ D⁻¹)(L⁻¹H_kᵀ) of the contacts j and k, column by column, with the terms in the order of the velocities.
#[inline]
fn product<const ROWS: usize, const SIZE: usize>(later: &[Half], earlier: &[Half], width: usize) -> [f64; SIZE] {
    let mut block = [0.0; SIZE];
    for half in later {
        let Some(other) = earlier.iter().find(|other| other.body == half.body) else { continue };
        for (place, entry) in block.iter_mut().enumerate() {
            let (i, j) = (place % ROWS, place / ROWS);
            let (weighted, left) = (&half.weighted[i * width..(i + 1) * width], &other.left[j * width..(j + 1) * width]);
            weighted.iter().zip(left).for_each(|(weighted, left)| *entry += weighted * left);
        }
    }
    block
}

/// Takes the lower triangle as the upper one.
#[inline]
fn mirror<const ROWS: usize, const SIZE: usize>(block: &mut [f64; SIZE]) {
    for (i, j) in (0..ROWS).flat_map(|i| (0..i).map(move |j| (i, j))) {
        block[i * ROWS + j] = block[j * ROWS + i];
    }
}

#[inline]
fn transposed<const ROWS: usize, const SIZE: usize>(block: &[f64; SIZE]) -> [f64; SIZE] {
    std::array::from_fn(|place| block[place % ROWS * ROWS + place / ROWS])
}

/// Which contacts meet.
struct Meeting {
    /// The one or two bodies of every contact.
    bodies: Lent<Vec<[Option<usize>; 2]>>,
    /// The contacts of every body.
    members: Lists,
    /// How many blocks W has.
    pairs: usize,
}

impl Meeting {
    fn new(jacobian: &Jacobian, width: usize) -> Self {
        let pair = |contact: &Rows| {
            let mut bodies = contact.parts().map(|part| part.first / width);
            [bodies.next(), bodies.next()]
        };
        let bodies: Lent<Vec<_>> = spare::collected(jacobian.contacts().len(), jacobian.contacts().iter().map(pair)).into();
        let mut members = Lists::default();
        members.collect(jacobian.ncols() / width, |show| {
            for (k, [one, other]) in bodies.iter().enumerate() {
                one.iter().chain(other).for_each(|body| show(*body, k));
            }
        });
        let mut meeting = Meeting { bodies, members, pairs: 0 };
        let mut pairs = 0;
        (0..meeting.bodies.len()).for_each(|k| meeting.each(k, |_| pairs += 1));
        meeting.pairs = pairs;
        meeting
    }

    /// Shows the contacts that touch a body of contact k, growing, each once.
    #[inline]
    fn each(&self, k: usize, mut show: impl FnMut(usize)) {
        let of = |body: Option<usize>| body.map_or(&[][..], |body| &self.members[body]);
        let (mut one, mut other) = (of(self.bodies[k][0]), of(self.bodies[k][1]));
        while let (Some(a), Some(b)) = (one.first(), other.first()) {
            show(*a.min(b));
            (one, other) = (&one[usize::from(a <= b)..], &other[usize::from(b <= a)..]);
        }
        one.iter().chain(other).for_each(|k| show(*k));
    }

    /// W of contacts of so many rows, whose blocks have no entries yet.
    fn without_entries(&self, rows: usize) -> BlockSparse {
        let mut made = BlockSparse::with_capacity(rows, self.bodies.len(), self.pairs);
        (0..self.bodies.len()).for_each(|k| made.append_column(|push| self.each(k, push)));
        made
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Mass;
    use nalgebra::{DVector, dmatrix};

    /// A chain of planar bodies, each of which meets the one before; their rows are of one scale and of no special form.
    fn chain(bodies: usize) -> Jacobian {
        let entry = |seed: usize| ((seed * 7919 + 13) % 101) as f64 / 37.0 - 1.0;
        let block = |seed: usize| [[entry(seed), entry(seed + 1), entry(seed + 2)], [entry(seed + 3), entry(seed + 4), entry(seed + 5)]];
        let contact = |k: usize| Rows::zeros(2, 3 * bodies).with(3 * k, block(11 * k)).with(3 * k - 3, block(11 * k + 6));
        let mut contacts = vec![Rows::zeros(2, 3 * bodies).with(0, block(5))];
        contacts.extend((1..bodies).map(contact));
        Jacobian::new(2, 3 * bodies, contacts)
    }

    /// A chain of bodies in space, with two contacts between any two that meet.
    fn chain_in_space(bodies: usize) -> Jacobian {
        let entry = |seed: usize| ((seed * 7919 + 13) % 101) as f64 / 37.0 - 1.0;
        let block = |seed: usize| -> [[f64; 6]; 3] { std::array::from_fn(|i| std::array::from_fn(|v| entry(seed + 6 * i + v))) };
        let contact = |k: usize, seed: usize| {
            let rows = Rows::zeros(3, 6 * bodies).with(6 * k, block(seed));
            if k > 0 { rows.with(6 * k - 6, block(seed + 18)) } else { rows }
        };
        Jacobian::new(3, 6 * bodies, (0..2 * bodies).map(|k| contact(k / 2, 37 * k)).collect())
    }

    #[test]
    fn blocks_in_space_equal_the_dense_operator_to_the_last_bit() {
        let jacobian = chain_in_space(7);
        let coupled = DMatrix::from_fn(6, 6, |i, j| if i == j { 2.0 + i as f64 } else { 0.3 / (1.0 + i.abs_diff(j) as f64) });
        let masses = [
            Mass::Diagonal(DVector::from_fn(42, |i, _| 0.3 + i as f64 / 7.0)),
            Mass::Blocks((0..7).map(|k| &coupled * (1.0 + k as f64 / 3.0)).collect()),
        ];
        for mass in masses {
            let inertia = Inertia::of(mass).expect("definite");
            let found = of_mechanism(&inertia, &jacobian).expect("it fits");
            let expected = delassus_factored(inertia.factor(), &jacobian.to_dense()).expect("it fits");
            assert_eq!(found.blocks().expect("few contacts meet").block_count(), 4 * (7 + 2 * 6));
            assert_eq!(found.dense(), &expected);
        }
    }

    #[test]
    fn blocks_equal_the_dense_operator_to_the_last_bit() {
        let jacobian = chain(8);
        let coupled = dmatrix![2.0, 0.5, 0.25; 0.5, 1.0, 0.125; 0.25, 0.125, 3.0];
        let masses = [
            Mass::Diagonal(DVector::from_fn(24, |i, _| 0.3 + i as f64 / 7.0)),
            Mass::Blocks((0..8).map(|k| &coupled * (1.0 + k as f64 / 3.0)).collect()),
        ];
        for mass in masses {
            let inertia = Inertia::of(mass).expect("definite");
            let found = of_mechanism(&inertia, &jacobian).expect("it fits");
            let expected = delassus_factored(inertia.factor(), &jacobian.to_dense()).expect("it fits");
            assert_eq!(found.blocks().expect("few contacts meet").block_count(), 8 + 2 * 7);
            assert_eq!(found.dense(), &expected);
        }
    }

    #[test]
    fn a_coupled_mass_or_contacts_that_all_meet_make_a_dense_operator() {
        let (jacobian, coupled) = (chain(8), DMatrix::from_fn(24, 24, |i, j| if i == j { 2.0 } else { 0.01 }));
        assert!(of_mechanism(&Inertia::new(coupled).expect("definite"), &jacobian).expect("it fits").blocks().is_none());
        let few = Jacobian::new(2, 24, jacobian.contacts()[..2].to_vec());
        let inertia = Inertia::of(Mass::Diagonal(DVector::from_fn(24, |i, _| 1.0 + i as f64 / 7.0))).expect("definite");
        let found = of_mechanism(&inertia, &few).expect("it fits");
        assert!(found.is_dense() && found.dense() == &delassus_factored(inertia.factor(), &few.to_dense()).expect("it fits"));
    }

    #[test]
    fn many_contacts_of_one_plate_act_through_it_and_as_the_dense_operator_does() {
        let entry = |seed: usize| ((seed * 7919 + 13) % 101) as f64 / 37.0 - 1.0;
        let block = |seed: usize| -> [[f64; 6]; 3] { std::array::from_fn(|i| std::array::from_fn(|v| entry(seed + 6 * i + v))) };
        let plate = |contacts: usize| {
            let contact = |k: usize| Rows::zeros(3, 6 * (contacts + 1)).with(0, block(5 * k)).with(6 * k + 6, block(11 * k + 3));
            Jacobian::new(3, 6 * (contacts + 1), (0..contacts).map(contact).collect())
        };
        let inertia = |contacts: usize, last: f64| {
            let mass = |v: usize| if v + 1 == 6 * (contacts + 1) { last } else { 0.3 + (v % 7) as f64 };
            Inertia::of(Mass::Diagonal(DVector::from_fn(6 * (contacts + 1), |v, _| mass(v)))).expect("positive")
        };
        let n = STORED_CONTACTS + 1;
        let (found, same) = (of_mechanism(&inertia(n, 1.0), &plate(n)).expect("it fits"), inertia(n, 1.0));
        assert!(found.matrix_free().is_some());
        let impulse = DVector::from_fn(3 * n, |i, _| entry(i));
        let dense = delassus_factored(same.factor(), &plate(n).to_dense()).expect("it fits");
        let size = (dense.abs() * impulse.abs()).amax();
        assert!((found.apply(&impulse) - &dense * &impulse).amax() <= moreau_exact::tolerance::rounding(3 * n, size));
        assert!(of_mechanism(&inertia(n - 1, 1.0), &plate(n - 1)).expect("it fits").is_dense(), "as many as are stored");
        assert!(of_mechanism(&inertia(n, f64::INFINITY), &plate(n)).expect("it fits").is_dense(), "a velocity is prescribed");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let inertia = Inertia::new(DMatrix::identity(2, 2)).expect("definite");
        assert!(of_mechanism(&inertia, &chain(5)).expect_err("sizes").to_string().contains("`jacobian`"));
        let broken = Jacobian::new(1, 2, vec![Rows::zeros(1, 2).with(0, [[f64::NAN]])]);
        assert!(of_mechanism(&inertia, &broken).is_err());
    }
}
