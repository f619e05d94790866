//! W of a mechanism whose mass and rows are known body by body, with the entries that the dense formula gives, bit for bit.
//!
//! ```text
//!     W_jk = Σ_b (L_b⁻¹H_jbᵀ)ᵀ D_b⁻¹ (L_b⁻¹H_kbᵀ)        b over the bodies that both contacts touch
//! ```
//! It costs as much as there are pairs of contacts that meet.

use super::{BlockRows, BlockSparse, Lists, MatrixFree, Operator};
use crate::contact::delassus::delassus_factored;
use crate::contact::{Inertia, Jacobian, Rows};
use crate::memory;
use crate::memory::spare::{self, Lent, spare_entries};
use crate::tolerance::problem::STORED_CONTACTS;
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
        let nearly_all_meet = n > STORED_CONTACTS && 2 * meeting.pairs() >= n * n;
        // none where a mass is infinite
        if let Some(masses) = if nearly_all_meet { inertia.bodies(width) } else { None } {
            return through_bodies(&masses, jacobian, width).map(Operator::from);
        }
        let blocks = blocks(inertia, jacobian, width, &meeting)?;
        return Ok(if 2 * meeting.pairs() < n * n { blocks.into() } else { blocks.to_dense().into() });
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
    let is_one = width * jacobian.rows_per_contact() <= LARGEST && jacobian.ncols().is_multiple_of(width);
    (is_one && parts.all(|part| part.width == width && part.first.is_multiple_of(width))).then_some(width)
}

fn blocks(inertia: &Inertia, jacobian: &Jacobian, width: usize, meeting: &Meeting) -> Result<BlockSparse> {
    let (d, n) = (jacobian.rows_per_contact(), jacobian.contacts().len());
    memory::require("the Delassus blocks of this step", (meeting.pairs() as u128).saturating_mul((8 * d * d + 16) as u128))?;
    let mut halves: Lent<Vec<Half>> = spare::vector(meeting.members.total()).into();
    let mut starts: Lent<Vec<usize>> = spare::vector(n + 1).into();
    for contact in jacobian.contacts() {
        starts.push(halves.len());
        for part in contact.parts() {
            if let Some(entry) = part.entries.iter().find(|entry| !entry.is_finite()) {
                return Err(Error::invalid("jacobian", format!("holds {entry}"), "use finite numbers"));
            }
            let (mut left, mut weighted) = ([0.0; LARGEST], [0.0; LARGEST]);
            left[..part.entries.len()].copy_from_slice(part.entries);
            for row in left[..part.entries.len()].chunks_exact_mut(width) {
                inertia.factor().forward_within(part.first, row);
            }
            let pivots = &inertia.factor().pivots()[part.first..part.first + width];
            for (row, half) in weighted.chunks_exact_mut(width).zip(left[..part.entries.len()].chunks_exact(width)) {
                row.iter_mut().zip(half).zip(pivots).for_each(|((weighted, y), d)| *weighted = y / d);
            }
            halves.push(Half { body: part.first / width, left, weighted });
        }
    }
    starts.push(halves.len());
    let own = |k: usize| &halves[starts[k]..starts[k + 1]];
    let mut made = BlockSparse::with_capacity(d, n, meeting.pairs());
    let (mut met, mut block) = (Lent::from(spare::vector(meeting.most)), [0.0; 9]);
    // of every column so far the place of the first block that has not been mirrored yet
    let mut next: Lent<Vec<usize>> = spare::repeated(n, 0).into();
    for k in 0..n {
        met.clear();
        meeting.of(own(k).iter().map(|half| half.body), |j| met.push(j));
        made.begin(k);
        for &j in met.iter() {
            if j < k {
                // W_jk = W_kjᵀ, which stands in the column of j: contacts that meet meet in both orders
                block[..d * d].copy_from_slice(made.block_at(next[j]));
                next[j] += 1;
                transpose(&mut block, d);
            } else if [d, width] == SPATIAL {
                spatial_product(own(j), own(k), j == k, &mut block);
            } else {
                product(own(j), own(k), [d, width], j == k, &mut block);
            }
            made.append(j, &block[..d * d]);
            if j == k {
                next[k] = made.block_count();
            }
        }
    }
    made.finish(n);
    Ok(made)
}

/// [`product`] of contacts between free bodies in space, with the same entries bit for bit.
fn spatial_product(later: &[Half], earlier: &[Half], diagonal: bool, block: &mut [f64; 9]) {
    const ROWS: usize = SPATIAL[0];
    const WIDTH: usize = SPATIAL[1];
    block.fill(0.0);
    let (mut one, mut other) = (later, earlier);
    while let ([half, ..], [opposite, ..]) = (one, other) {
        if half.body == opposite.body {
            let [weighted, left] = [&half.weighted, &opposite.left].map(|rows| rows.as_chunks::<WIDTH>().0);
            for (column, left) in block.as_chunks_mut::<ROWS>().0.iter_mut().zip(left) {
                for (entry, weighted) in column.iter_mut().zip(weighted) {
                    (0..WIDTH).for_each(|axis| *entry += weighted[axis] * left[axis]);
                }
            }
        }
        (one, other) = (&one[usize::from(half.body <= opposite.body)..], &other[usize::from(opposite.body <= half.body)..]);
    }
    if diagonal {
        mirror(block, ROWS);
    }
}

/// Takes the lower triangle as the upper one.
fn mirror(block: &mut [f64; 9], d: usize) {
    for (i, j) in (0..d).flat_map(|i| (0..i).map(move |j| (i, j))) {
        block[i * d + j] = block[j * d + i];
    }
}

/// W_jk of two contacts, j ≥ k, column by column: Σ_b (L⁻¹H_jᵀ D⁻¹)(L⁻¹H_kᵀ) with the terms in the order of the velocities. Of a diagonal
/// block the lower triangle is computed and mirrored.
#[inline(always)]
fn product(later: &[Half], earlier: &[Half], [d, width]: [usize; 2], diagonal: bool, block: &mut [f64; 9]) {
    block[..d * d].fill(0.0);
    let mut others = earlier.iter().peekable();
    for half in later {
        while others.next_if(|other| other.body < half.body).is_some() {}
        let Some(other) = others.next_if(|other| other.body == half.body) else { continue };
        for i in 0..d {
            for j in 0..if diagonal { i + 1 } else { d } {
                let (weighted, left) = (&half.weighted[i * width..(i + 1) * width], &other.left[j * width..(j + 1) * width]);
                let entry = &mut block[j * d + i];
                weighted.iter().zip(left).for_each(|(weighted, left)| *entry += weighted * left);
            }
        }
    }
    if diagonal {
        mirror(block, d);
    }
}

fn transpose(block: &mut [f64; 9], d: usize) {
    for (i, j) in (0..d).flat_map(|i| (0..i).map(move |j| (i, j))) {
        block.swap(i * d + j, j * d + i);
    }
}

/// The contacts of every body.
struct Meeting {
    members: Lists,
    pairs: usize,
    /// Most contacts that one contact meets.
    most: usize,
}

impl Meeting {
    fn new(jacobian: &Jacobian, width: usize) -> Self {
        let bodies = |contact: &Rows| contact.parts().map(move |part| part.first / width).collect::<BodiesOf>();
        let mut members = Lists::default();
        members.collect(jacobian.ncols() / width, |show| {
            for (k, contact) in jacobian.contacts().iter().enumerate() {
                bodies(contact).iter().for_each(|body| show(body, k));
            }
        });
        let mut meeting = Meeting { members, pairs: 0, most: 0 };
        for contact in jacobian.contacts() {
            let mut met = 0;
            meeting.of(bodies(contact).iter(), |_| met += 1);
            meeting.pairs += met;
            meeting.most = meeting.most.max(met);
        }
        meeting
    }

    /// How many blocks W has.
    fn pairs(&self) -> usize {
        self.pairs
    }

    /// Shows the contacts that touch one of at most two bodies, growing, each once.
    fn of(&self, mut bodies: impl Iterator<Item = usize>, mut show: impl FnMut(usize)) {
        let mut next = || bodies.next().map_or(&[][..], |body| &self.members[body]);
        let (mut one, mut other) = (next(), next());
        while let (Some(a), Some(b)) = (one.first(), other.first()) {
            show(*a.min(b));
            (one, other) = (&one[usize::from(a <= b)..], &other[usize::from(b <= a)..]);
        }
        one.iter().chain(other).for_each(|k| show(*k));
    }
}

/// The one or two bodies of a contact.
#[derive(Clone, Copy, Default)]
struct BodiesOf([Option<usize>; 2]);

impl BodiesOf {
    fn iter(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().flatten()
    }
}

impl FromIterator<usize> for BodiesOf {
    fn from_iter<I: IntoIterator<Item = usize>>(bodies: I) -> Self {
        let mut bodies = bodies.into_iter();
        BodiesOf([bodies.next(), bodies.next()])
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
