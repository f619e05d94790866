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
use crate::memory::spare::{self, Lent};
use crate::tolerance::problem::STORED_CONTACTS;
use moreau_exact::number::{are_finite, counted};
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// Velocities of a free body times rows of a contact, at most.
pub(super) const LARGEST: usize = 18;

/// Rows and velocities of contacts between free bodies in space, which nearly all are.
const SPATIAL: [usize; 2] = [3, 6];

/// What stands together of three rows at a velocity, with the first once more.
const SIDE: usize = 4;

/// What is weighted of such a contact at one body.
const WEIGHTED: usize = SIDE * SPATIAL[1];

/// W = H M⁻¹ Hᵀ \[1/kg\]: by blocks where the mass consists of bodies and most contacts do not meet, densely otherwise, with the same
/// entries bit for bit; where many contacts of bodies all meet, as those of one plate, it is not formed and acts through the bodies.
///
/// # Errors
/// [`Error::Invalid`] if H does not fit the mass, is not finite, or needs more memory than is allowed.
pub fn of_mechanism(inertia: &Inertia, jacobian: &Jacobian) -> Result<Operator> {
    if inertia.size() != jacobian.ncols() {
        let cure = format!("give {}, one per row of the mass matrix", counted(inertia.size(), "column"));
        return Err(Error::invalid("jacobian", format!("has {}", counted(jacobian.ncols(), "column")), cure));
    }
    let n = jacobian.contacts().len();
    if let Some(width) = body_width(jacobian).filter(|width| inertia.is_made_of(*width)) {
        let meeting = Meeting::new(jacobian, width);
        let most_do_not_meet = 2 * meeting.most < n * n || 2 * meeting.pairs() < n * n;
        // none where a mass is infinite
        if let Some(masses) = if n > STORED_CONTACTS && !most_do_not_meet { inertia.bodies(width) } else { None } {
            return through_bodies(&masses, jacobian, width).map(Operator::from);
        }
        let blocks = blocks(inertia, jacobian, width, &meeting)?;
        return Ok(if most_do_not_meet { blocks.into() } else { blocks.to_dense().into() });
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
    let require =
        |blocks: usize| memory::require("the Delassus blocks of this step", (blocks as u128).saturating_mul((8 * d * d + 16) as u128));
    require(meeting.most).or_else(|_| require(meeting.pairs()))?;
    let mut made = meeting.without_entries(d);
    made.make_room();
    let halves = Halves::new(inertia.factor(), jacobian, width, meeting.members.total())?;
    match [d, width] {
        SPATIAL => fill::<3, 9, Spread>(&mut made, &halves, |own, spread| spread.set(own), spatial_product),
        [1, _] => fill::<1, 1, _>(&mut made, &halves, |own, kept| *kept = own, |later, own| product::<1, 1>(later, own, width)),
        [2, _] => fill::<2, 4, _>(&mut made, &halves, |own, kept| *kept = own, |later, own| product::<2, 4>(later, own, width)),
        _ => fill::<3, 9, _>(&mut made, &halves, |own, kept| *kept = own, |later, own| product::<3, 9>(later, own, width)),
    }
    Ok(made)
}

/// What every contact has at each of its bodies: H_bᵀ from the left, row after row, and the same over the pivots of the body's mass, row
/// after row, too, but between free bodies in space as [`spatial_product`] takes it.
struct Halves {
    bodies: Lent<Vec<usize>>,
    left: Lent<Vec<f64>>,
    weighted: Lent<Vec<f64>>,
    /// Those of contact k are numbers starts[k] .. starts[k + 1].
    starts: Lent<Vec<usize>>,
    /// Entries of one from the left, and weighted.
    sizes: [usize; 2],
}

/// The halves of one contact from one side, body after body, bodies growing.
#[derive(Clone, Copy, Default)]
struct Half<'a> {
    bodies: &'a [usize],
    entries: &'a [f64],
}

impl Halves {
    fn new(factor: &MassFactor<f64>, jacobian: &Jacobian, width: usize, total: usize) -> Result<Self> {
        let (rows, n) = (jacobian.rows_per_contact(), jacobian.contacts().len());
        let sizes = if [rows, width] == SPATIAL { [LARGEST, WEIGHTED] } else { [rows * width; 2] };
        let [left, weighted] = sizes.map(|size| spare::vector(size * total).into());
        let mut made = Halves { bodies: spare::vector(total).into(), left, weighted, starts: spare::vector(n + 1).into(), sizes };
        for contact in jacobian.contacts() {
            made.starts.push(made.bodies.len());
            for part in contact.parts() {
                if !are_finite(part.entries) {
                    let wrong = part.entries.iter().find(|entry| !entry.is_finite()).unwrap_or(&f64::NAN);
                    return Err(Error::invalid("jacobian", format!("holds {wrong}"), "use finite numbers"));
                }
                made.push(factor, [part.first, width], part.entries);
            }
        }
        made.starts.push(made.bodies.len());
        Ok(made)
    }

    #[inline]
    fn push(&mut self, factor: &MassFactor<f64>, [first, width]: [usize; 2], entries: &[f64]) {
        let (begin, pivots) = (self.left.len(), &factor.pivots()[first..first + width]);
        self.bodies.push(first / width);
        self.left.extend_from_slice(entries);
        let left = &mut self.left[begin..];
        if !factor.is_diagonal() {
            left.chunks_exact_mut(width).for_each(|row| factor.forward_within(first, row));
        }
        match (left.as_array(), pivots.as_array()) {
            (Some(left), Some(pivots)) if self.sizes[1] == WEIGHTED => weigh_in_space(&mut self.weighted, left, pivots),
            _ => left.chunks_exact(width).for_each(|row| self.weighted.extend(row.iter().zip(pivots).map(|(y, d)| y / d))),
        }
    }

    #[inline]
    fn left(&self, contact: usize) -> Half<'_> {
        let (first, last, size) = (self.starts[contact], self.starts[contact + 1], self.sizes[0]);
        Half { bodies: &self.bodies[first..last], entries: &self.left[size * first..size * last] }
    }

    #[inline]
    fn weighted(&self, contact: usize) -> Half<'_> {
        let (first, last, size) = (self.starts[contact], self.starts[contact + 1], self.sizes[1]);
        Half { bodies: &self.bodies[first..last], entries: &self.weighted[size * first..size * last] }
    }
}

/// Appends what is weighted of a contact between free bodies in space, velocity by velocity.
#[inline]
fn weigh_in_space(weighted: &mut Vec<f64>, left: &[f64; LARGEST], pivots: &[f64; SPATIAL[1]]) {
    let over: [f64; LARGEST] = std::array::from_fn(|place| left[place] / pivots[place % SPATIAL[1]]);
    let [n, t1, t2] = over.as_chunks::<{ SPATIAL[1] }>().0.as_array().expect("three rows");
    let sides: [[f64; SIDE]; SPATIAL[1]] = std::array::from_fn(|axis| [n[axis], t1[axis], t2[axis], n[axis]]);
    weighted.extend_from_slice(sides.as_flattened());
}

/// Appends the blocks of contacts of so many rows, of so many entries: W_jk = `product` of the halves of j and of what `prepare` makes of
/// those of k, j ≥ k. Of a diagonal block the lower triangle is mirrored.
fn fill<'a, const ROWS: usize, const SIZE: usize, Own: Default>(
    made: &mut BlockSparse,
    halves: &'a Halves,
    prepare: impl Fn(Half<'a>, &mut Own),
    product: impl Fn(Half, &Own) -> [f64; SIZE],
) {
    let (starts, coupled, entries) = made.parts_mut();
    // of every column so far the place of the first block that has not been mirrored yet
    let mut next: Lent<Vec<usize>> = spare::repeated(starts.len(), 0).into();
    let mut prepared = Own::default();
    for k in 0..starts.len() - 1 {
        let met = &coupled[starts[k]..starts[k + 1]];
        let (before, rest) = met.split_at(met.partition_point(|j| *j < k));
        let Some((_, after)) = rest.split_first() else { continue };
        for j in before {
            // W_jk = W_kjᵀ, which stands in the column of j: contacts that meet meet in both orders
            let block = transposed::<ROWS, SIZE>(&entries.as_chunks().0[next[*j]]);
            entries.extend_from_slice(&block);
            next[*j] += 1;
        }
        next[k] = starts[k] + before.len() + 1;
        prepare(halves.left(k), &mut prepared);
        // it meets itself
        let mut diagonal = product(halves.weighted(k), &prepared);
        mirror::<ROWS, SIZE>(&mut diagonal);
        entries.extend_from_slice(&diagonal);
        after.iter().for_each(|j| entries.extend_from_slice(&product(halves.weighted(*j), &prepared)));
    }
}

/// The left halves of a contact between free bodies in space for [`spatial_product`], velocity after velocity: each of three rows as often
/// as it has products.
#[derive(Default)]
struct Spread {
    bodies: [usize; 2],
    count: usize,
    left: [[[f64; SPATIAL[0] * SPATIAL[0]]; SPATIAL[1]]; 2],
}

impl Spread {
    #[inline]
    fn set(&mut self, own: Half) {
        self.count = own.bodies.len();
        self.bodies[..self.count].copy_from_slice(own.bodies);
        for (spread, left) in self.left.iter_mut().zip(own.entries.as_chunks::<LARGEST>().0) {
            for (axis, products) in spread.iter_mut().enumerate() {
                *products = std::array::from_fn(|place| left[place / SPATIAL[0] * SPATIAL[1] + axis]);
            }
        }
    }
}

/// [`product`] of contacts between free bodies in space, with the same entries bit for bit: the entries of a block that follow each other
/// take factors that follow each other.
#[inline]
fn spatial_product(later: Half, own: &Spread) -> [f64; 9] {
    const ROW: [usize; 9] = [0, 1, 2, 3, 1, 2, 0, 1, 2];
    let mut block = [0.0; 9];
    for (body, weighted) in later.bodies.iter().zip(later.entries.as_chunks::<WEIGHTED>().0) {
        let Some(at) = own.bodies[..own.count].iter().position(|other| other == body) else { continue };
        for (weighted, left) in weighted.as_chunks::<SIDE>().0.iter().zip(&own.left[at]) {
            (0..9).for_each(|place| block[place] += weighted[ROW[place]] * left[place]);
        }
    }
    block
}

/// Σ_b (L⁻¹H_jᵀ D⁻¹)(L⁻¹H_kᵀ) of the contacts j and k, column by column, with the terms in the order of the velocities.
#[inline]
fn product<const ROWS: usize, const SIZE: usize>(later: Half, own: &Half, width: usize) -> [f64; SIZE] {
    let (size, mut block) = (ROWS * width, [0.0; SIZE]);
    for (part, body) in later.bodies.iter().enumerate() {
        let Some(at) = own.bodies.iter().position(|other| other == body) else { continue };
        let (weighted, left) = (&later.entries[part * size..], &own.entries[at * size..]);
        for (place, entry) in block.iter_mut().enumerate() {
            let (i, j) = (place % ROWS, place / ROWS);
            let (weighted, left) = (&weighted[i * width..(i + 1) * width], &left[j * width..(j + 1) * width]);
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
    /// How many blocks W has at most.
    most: usize,
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
        // contacts that touch both bodies are counted twice
        let most = bodies.iter().flatten().flatten().map(|body| members[*body].len()).sum();
        Meeting { bodies, members, most }
    }

    /// How many blocks W has.
    fn pairs(&self) -> usize {
        let mut pairs = 0;
        (0..self.bodies.len()).for_each(|k| self.each(k, |_| pairs += 1));
        pairs
    }

    /// Shows the contacts that touch a body of contact k, growing, each once.
    #[inline]
    fn each(&self, k: usize, mut show: impl FnMut(usize)) {
        let of = |body: Option<usize>| body.map_or(&[][..], |body| &self.members[body]);
        let (one, other) = (of(self.bodies[k][0]), of(self.bodies[k][1]));
        let (mut i, mut j) = (0, 0);
        while i < one.len() && j < other.len() {
            let (a, b) = (one[i], other[j]);
            show(a.min(b));
            (i, j) = (i + usize::from(a <= b), j + usize::from(b <= a));
        }
        one[i..].iter().chain(&other[j..]).for_each(|k| show(*k));
    }

    /// W of contacts of so many rows, whose blocks have no entries yet.
    fn without_entries(&self, rows: usize) -> BlockSparse {
        let mut made = BlockSparse::without_entries(rows, self.bodies.len(), self.most);
        (0..self.bodies.len()).for_each(|k| made.append_column(|coupled| self.each(k, |j| coupled.push(j))));
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
