//! The mass and Jacobian that a problem is known to come from: as matrices, or by bodies until something asks for matrices.

use super::dynamics::Dynamics;
use crate::contact::{Inertia, Jacobian, Mass};
use crate::memory::spare::{self, Lent};
use crate::operator::{BlockRows, MatrixFree, Sparse, SparseDynamics};
use crate::tolerance::certificate::{KEPT_BY_MASS, lost_of_pivots};
use crate::tolerance::problem::WRITTEN_OUT;
use moreau_exact::Result;
use nalgebra::DMatrix;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// M̂ and H, however they are kept.
#[derive(Clone, Debug)]
pub(in crate::problem) enum Known {
    /// As matrices.
    Dense(Dynamics),
    /// As a step has them, with the matrices once something asked for them.
    Sparse {
        inertia: Arc<Inertia>,
        /// H of the step.
        jacobian: Arc<Jacobian>,
        /// Which of its contacts these are, if they are not all of them.
        members: Option<Lent<Vec<usize>>>,
        dense: OnceLock<Dynamics>,
    },
    /// As a file has them, entry by entry, with the matrices once something asked for them.
    Listed { listed: Arc<SparseDynamics>, dense: OnceLock<Dynamics> },
}

impl Known {
    /// Whether M̂ is a matrix of numbers: no velocity is prescribed.
    pub fn is_finite(&self) -> bool {
        match self {
            Known::Dense(_) | Known::Listed { .. } => true,
            Known::Sparse { inertia, .. } => inertia.mass().is_finite(),
        }
    }

    /// As a step has them.
    pub fn sparse(inertia: Arc<Inertia>, jacobian: Arc<Jacobian>) -> Self {
        Known::Sparse { inertia, jacobian, members: None, dense: OnceLock::new() }
    }

    /// As a file has them.
    pub fn listed(listed: SparseDynamics) -> Self {
        Known::Listed { listed: Arc::new(listed), dense: OnceLock::new() }
    }

    /// M̂ and H of some of the contacts; none where H is a matrix.
    pub fn of(&self, contacts: &[usize]) -> Option<Self> {
        let Known::Sparse { inertia, jacobian, members, .. } = self else { return None };
        let own = contacts.iter().map(|k| members.as_ref().map_or(*k, |members| members[*k]));
        let members = Some(spare::collected(contacts.len(), own).into());
        Some(Known::Sparse { inertia: inertia.clone(), jacobian: jacobian.clone(), members, dense: OnceLock::new() })
    }

    /// M̂ by bodies, and H of the contacts themselves; none where they are matrices.
    pub fn by_bodies(&self) -> Option<(&Inertia, Cow<'_, Jacobian>)> {
        let Known::Sparse { inertia, jacobian, members, .. } = self else { return None };
        let own = members.as_ref().map_or(Cow::Borrowed(&**jacobian), |members| Cow::Owned(jacobian.of(members)));
        Some((inertia, own))
    }

    /// M̂ and H with all their zeros; none where a file lists their entries because there are too many for that.
    pub fn dense(&self) -> Option<&Dynamics> {
        match self {
            Known::Listed { listed, dense } => {
                (listed.entries() <= WRITTEN_OUT).then(|| dense.get_or_init(|| Dynamics::of(listed.triplets())))
            }
            Known::Dense(dynamics) => Some(dynamics),
            Known::Sparse { inertia, jacobian, members, dense } => Some(dense.get_or_init(|| {
                let jacobian = members.as_ref().map_or_else(|| jacobian.to_dense(), |members| jacobian.of(members).to_dense());
                Dynamics { mass: inertia.matrix().clone(), jacobian }
            })),
        }
    }

    /// M̂ and H by the groups of velocities that M̂ does not couple.
    fn by_groups(&self, rows_per_contact: usize) -> Result<Cow<'_, SparseDynamics>> {
        let made = |[mass, jacobian]: [Sparse; 2]| SparseDynamics::new(&mass, &jacobian, rows_per_contact).map(Cow::Owned);
        match self {
            Known::Listed { listed, .. } => Ok(Cow::Borrowed(&**listed)),
            Known::Dense(Dynamics { mass, jacobian }) => made([Sparse::of(mass), Sparse::of(jacobian)]),
            Known::Sparse { inertia, .. } => {
                let jacobian = self.by_bodies().map(|(_, jacobian)| entries_of_rows(&jacobian, rows_per_contact));
                made(without_unmoved([entries_of(inertia.mass()), jacobian.expect("it is kept by bodies")]))
            }
        }
    }

    /// W as M̂ and H make it, not formed.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if that takes more memory than is allowed, or a velocity is prescribed.
    pub fn unformed(&self, rows_per_contact: usize) -> Result<MatrixFree> {
        self.by_groups(rows_per_contact)?.matrix_free()
    }

    /// Whether M̂ is so nearly singular that a W which was formed of it lost digits.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if looking takes more memory than is allowed.
    pub fn loses_digits(&self, rows_per_contact: usize) -> Result<bool> {
        Ok(match self {
            Known::Sparse { inertia, .. } if !may_lose_digits(inertia) => false,
            Known::Dense(Dynamics { mass, .. }) if is_diagonal(mass) => false,
            known => known.by_groups(rows_per_contact)?.loses_digits(),
        })
    }

    /// M̂ and H entry by entry, where they are not kept as matrices.
    #[cfg(feature = "files")]
    pub fn triplets(&self, rows_per_contact: usize) -> Option<[Sparse; 2]> {
        match self {
            Known::Dense(_) => None,
            Known::Listed { listed, .. } => Some(listed.triplets()),
            Known::Sparse { inertia, .. } => {
                let (_, jacobian) = self.by_bodies()?;
                Some([entries_of(inertia.mass()), entries_of_rows(&jacobian, rows_per_contact)])
            }
        }
    }

    /// Appends the columns of H that the rows of a contact touch, growing.
    pub fn push_touched(&self, contact: usize, rows: usize, columns: &mut Vec<usize>) {
        match self {
            Known::Sparse { jacobian, members, .. } => {
                let contact = members.as_ref().map_or(contact, |members| members[contact]);
                jacobian.contacts()[contact].push_touched(columns);
            }
            Known::Listed { listed, .. } => listed.push_touched(contact, columns),
            Known::Dense(Dynamics { jacobian, .. }) => {
                let rows = jacobian.rows(contact * rows, rows);
                columns.extend((0..jacobian.ncols()).filter(|column| rows.column(*column).iter().any(|entry| *entry != 0.0)));
            }
        }
    }
}

/// Whether the pivots of some block of M̂ tell that it may be nearly singular.
fn may_lose_digits(inertia: &Inertia) -> bool {
    let pivots = inertia.factor().pivots();
    let loses = |block: &DMatrix<f64>, first: usize| lost_of_pivots(block, &pivots[first..first + block.nrows()]) > KEPT_BY_MASS;
    match inertia.mass() {
        Mass::Diagonal(_) => false,
        Mass::Dense(dense) => loses(dense, 0),
        Mass::Blocks(blocks) => {
            let mut first = 0;
            blocks.iter().any(|block| {
                first += block.nrows();
                loses(block, first - block.nrows())
            })
        }
    }
}

fn is_diagonal(mass: &DMatrix<f64>) -> bool {
    mass.iter().enumerate().all(|(place, entry)| *entry == 0.0 || place % (mass.nrows() + 1) == 0)
}

/// The same W of finite masses: a velocity of infinite mass is left out of H, and any mass stands in its place.
fn without_unmoved([mut mass, mut rows]: [Sparse; 2]) -> [Sparse; 2] {
    let mut is_unmoved = vec![false; mass.shape[0]];
    for (v, _, entry) in mass.entries.iter_mut().filter(|(.., entry)| entry.is_infinite()) {
        (is_unmoved[*v], *entry) = (true, 1.0);
    }
    rows.entries.retain(|(_, v, _)| !is_unmoved[*v]);
    [mass, rows]
}

/// The entries of H that are not zero.
fn entries_of_rows(jacobian: &Jacobian, rows_per_contact: usize) -> Sparse {
    let mut rows = Sparse { shape: [jacobian.nrows(), jacobian.ncols()], entries: Vec::new() };
    for (k, contact) in jacobian.contacts().iter().enumerate() {
        for part in contact.parts() {
            let place = |at: usize| (k * rows_per_contact + at / part.width, part.first + at % part.width);
            let own = part.entries.iter().enumerate().filter(|(_, entry)| **entry != 0.0);
            rows.entries.extend(own.map(|(at, entry)| (place(at).0, place(at).1, *entry)));
        }
    }
    rows
}

/// The entries of a mass that are not zero.
fn entries_of(mass: &Mass) -> Sparse {
    let entries = match mass {
        Mass::Diagonal(diagonal) => diagonal.iter().enumerate().map(|(v, mass)| (v, v, *mass)).collect(),
        Mass::Blocks(blocks) => {
            let (mut entries, mut first) = (Vec::new(), 0);
            for block in blocks {
                entries.extend(Sparse::of(block).entries.into_iter().map(|(i, j, mass)| (first + i, first + j, mass)));
                first += block.nrows();
            }
            entries
        }
        Mass::Dense(dense) => return Sparse::of(dense),
    };
    Sparse { shape: [mass.size(); 2], entries }
}

/// Appends the columns that the rows of a contact touch, of an H by bodies.
pub(super) fn push_columns_of(jacobian: &BlockRows, contact: usize, columns: &mut Vec<usize>) {
    let blocks = jacobian.contact(contact).map(|(body, block)| (jacobian.velocities(body), block));
    let is_touched =
        |range: &Range<usize>, block: &[f64], v: &usize| block.iter().skip(v - range.start).step_by(range.len()).any(|entry| *entry != 0.0);
    columns.extend(blocks.flat_map(|(range, block)| range.clone().filter(move |v| is_touched(&range, block, v))));
}

impl PartialEq for Known {
    /// Whether both are the same mass and Jacobian.
    fn eq(&self, other: &Self) -> bool {
        if let (Known::Listed { listed: one, .. }, Known::Listed { listed: other, .. }) = (self, other) {
            return one == other;
        }
        match (self.by_bodies(), other.by_bodies()) {
            (Some((inertia, jacobian)), Some((mass, rows))) => jacobian == rows && inertia.mass() == mass.mass(),
            _ => self.dense() == other.dense(),
        }
    }
}
