//! Parts of a problem that share nothing: what is proved of each of them is proved of the whole.
//!
//! ```text
//!     W = ⊕ W_I ,      (r, y) solves the problem ⟺ (r_I, y_I) solves that of each part I ,      velocities = ∏_I velocities of I
//! ```
//! Of a stored W two contacts are together if an entry between them is not zero. Where mass and Jacobian are known they are together if
//! their rows touch velocities that M̂ couples, directly or through others: a zero of the rounded W need not be one of H M̂⁻¹ Hᵀ.

use super::forward::groups;
use crate::operator::Islands;
use crate::problem::{ContactProblem, Dynamics, Law};
use crate::tolerance::proof::ROWS;
use moreau_exact::Result;
use nalgebra::DMatrix;
use std::borrow::Cow;

/// Some contacts of a problem, and the problem that they are.
#[derive(Clone, Debug)]
pub struct Separate {
    /// Which ones, growing.
    pub contacts: Vec<usize>,
    /// Theirs, with the velocities that they touch where mass and Jacobian are known.
    pub problem: ContactProblem,
}

/// The parts of a problem; none where all contacts are together, there are more than [`ROWS`] rows, or what they touch is not known.
///
/// # Errors
/// As of any problem.
/// ```
/// use moreau_contact::ContactProblem;
/// use moreau_contact::certificate::separate::separate;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
///
/// // three blocks on rails, the second one between two stops
/// let w = dmatrix![1.0, 0.0, 0.0, 0.0; 0.0, 2.0, -2.0, 0.0; 0.0, -2.0, 2.0, 0.0; 0.0, 0.0, 0.0, 4.0];
/// let problem = ContactProblem::new(w, dvector![-1.0, 1.0, -1.0, 2.0]).rows_per_contact(1).build()?;
/// let parts = separate(&problem)?;
/// assert_eq!(parts.iter().map(|part| &part.contacts[..]).collect::<Vec<_>>(), [&[1, 2][..], &[0], &[3]]);
/// assert_eq!(parts[0].problem.dense()[(1, 0)], -2.0);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn separate(problem: &ContactProblem) -> Result<Vec<Separate>> {
    // what an entry of W joins touches a velocity of the same group: where W joins all, nothing else need be asked
    if problem.rows() > ROWS || problem.islands().one_by_one().len() < 2 || (problem.knows_rows() && problem.dynamics().is_none()) {
        return Ok(Vec::new());
    }
    let (together, touched) = match problem.dynamics() {
        None => (Cow::Borrowed(problem.islands()), None),
        Some(known) => {
            let touched = Touched::of(known, problem.rows_per_contact());
            (Cow::Owned(Islands::touching(problem.contacts(), touched.groups.len(), &touched.by_contact)), Some((known, touched)))
        }
    };
    let islands = together.one_by_one();
    if islands.len() < 2 {
        return Ok(Vec::new());
    }
    let part = |contacts: Vec<usize>| -> Result<Separate> {
        let mut own = problem.island(&together, &contacts).into_builder();
        if let Some((known, touched)) = &touched {
            own = own.dynamics(touched.part(known, problem.rows_per_contact(), &contacts));
        }
        let own = own.build()?;
        // what is proved is the same under every law where nothing rubs
        let own = if own.is_frictionless() { own.into_builder().law(Law::Frictionless).build()? } else { own };
        Ok(Separate { contacts, problem: own })
    };
    islands.into_iter().map(part).collect()
}

/// Which velocities that M̂ couples each contact touches.
struct Touched {
    /// Velocities that M̂ couples with each other.
    groups: Vec<Vec<usize>>,
    /// Of every contact the numbers of the groups.
    by_contact: Vec<Vec<usize>>,
}

impl Touched {
    fn of(Dynamics { mass, jacobian }: &Dynamics, rows: usize) -> Self {
        let groups = groups(mass);
        let meets = |k: usize, group: &[usize]| group.iter().any(|v| (k * rows..(k + 1) * rows).any(|row| jacobian[(row, *v)] != 0.0));
        let touched = |k: usize| (0..groups.len()).filter(|group| meets(k, &groups[*group])).collect();
        Touched { by_contact: (0..jacobian.nrows() / rows).map(touched).collect(), groups }
    }

    /// The mass and the Jacobian of these contacts, of the velocities that they touch and those that M̂ couples with them.
    fn part(&self, Dynamics { mass, jacobian }: &Dynamics, rows: usize, contacts: &[usize]) -> Dynamics {
        let mut own: Vec<usize> =
            contacts.iter().flat_map(|k| &self.by_contact[*k]).flat_map(|group| &self.groups[*group]).copied().collect();
        own.sort_unstable();
        own.dedup();
        let row = |i: usize| contacts[i / rows] * rows + i % rows;
        Dynamics {
            mass: DMatrix::from_fn(own.len(), own.len(), |i, j| mass[(own[i], own[j])]),
            jacobian: DMatrix::from_fn(contacts.len() * rows, own.len(), |i, j| jacobian[(row(i), own[j])]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::patterns::solutions;
    use nalgebra::{DVector, dmatrix, dvector};

    fn contacts(parts: &[Separate]) -> Vec<&[usize]> {
        parts.iter().map(|part| &part.contacts[..]).collect()
    }

    #[test]
    fn a_zero_of_a_rounded_w_separates_nothing_where_a_body_joins() {
        // rows (1, 1) and (1, −1): H Hᵀ is zero between them for equal masses, and not where they differ in the last digit
        let jacobian = dmatrix![1.0, 1.0, 0.0; 1.0, -1.0, 0.0; 0.0, 0.0, 1.0];
        let made = |mass: DMatrix<f64>| {
            let problem = ContactProblem::from_dynamics(mass, jacobian.clone(), &dvector![1.0, 2.0, 3.0]);
            problem.rows_per_contact(1).law(Law::Frictionless).friction(vec![0.0; 3]).build().unwrap()
        };
        let equal = made(DMatrix::identity(3, 3));
        assert_eq!(equal.dense()[(0, 1)], 0.0, "what is planted");
        assert_eq!(contacts(&separate(&equal).unwrap()), [&[0, 1][..], &[2]]);
        let stored = ContactProblem::new(equal.dense().clone(), equal.free_velocity().clone()).rows_per_contact(1).build().unwrap();
        assert_eq!(contacts(&separate(&stored).unwrap()), [&[0][..], &[1], &[2]]);
        // a mass that couples the bodies joins their contacts
        let coupled = made(dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.25; 0.0, 0.25, 1.0]);
        assert!(separate(&coupled).unwrap().is_empty());
    }

    #[test]
    fn a_part_has_the_numbers_of_its_contacts_and_the_solutions_of_the_whole() {
        // two blocks in the plane that are listed by turns: 2 kg and 4 kg, of which the second is pressed from two sides
        let (mass, rows) = (DMatrix::from_diagonal(&dvector![2.0, 2.0, 4.0, 4.0]), [[0, 1], [2, 3], [1, 0], [3, 2]]);
        let jacobian = DMatrix::from_fn(8, 4, |row, v| f64::from(u8::from(rows[row / 2][row % 2] == v)));
        let free = dvector![-1.0, 0.5, -2.0, 0.25];
        let whole = ContactProblem::from_dynamics(mass, jacobian, &free).rows_per_contact(2).friction(vec![0.5, 0.25, 1.0, 0.75]);
        let whole = whole.shift(DVector::from_fn(8, |row, _| row as f64 / 16.0)).build().unwrap();
        let parts = separate(&whole).unwrap();
        assert_eq!(contacts(&parts), [&[0, 2][..], &[1, 3]]);
        let mut found = vec![DVector::zeros(8)];
        for Separate { contacts, problem } in &parts {
            let rows: Vec<usize> = contacts.iter().flat_map(|k| [2 * k, 2 * k + 1]).collect();
            assert_eq!(problem.dynamics().unwrap().mass.nrows(), 2);
            for (i, row) in rows.iter().enumerate() {
                assert_eq!((problem.free_velocity()[i], problem.shift()[i]), (whole.free_velocity()[*row], whole.shift()[*row]));
                rows.iter().enumerate().for_each(|(j, column)| assert_eq!(problem.entry(i, j), whole.entry(*row, *column)));
            }
            assert_eq!(problem.friction(), contacts.iter().map(|k| whole.friction()[*k]).collect::<Vec<_>>());
            let all = solutions(problem).unwrap().found;
            let place = |before: &DVector<f64>, one: &DVector<f64>| {
                let mut velocity = before.clone();
                rows.iter().zip(one.iter()).for_each(|(row, u)| velocity[*row] = *u);
                velocity
            };
            let velocities = all.iter().map(|one| one.velocity.map(|u| moreau_exact::scalar::Scalar::to_f64(&u)));
            let velocities: Vec<_> = velocities.collect();
            found = found.iter().flat_map(|before| velocities.iter().map(move |one| place(before, one))).collect();
        }
        let at_once: Vec<DVector<f64>> =
            solutions(&whole).unwrap().found.iter().map(|one| one.velocity.map(|u| moreau_exact::scalar::Scalar::to_f64(&u))).collect();
        assert_eq!(found.len(), at_once.len());
        assert!(at_once.iter().all(|one| found.contains(one)), "{found:?} {at_once:?}");
    }

    #[test]
    fn a_part_without_friction_is_one_of_the_law_without() {
        let problem =
            ContactProblem::new(DMatrix::identity(6, 6), DVector::from_element(6, -1.0)).friction(vec![0.0, 0.5]).build().unwrap();
        let laws: Vec<Law> = separate(&problem).unwrap().iter().map(|part| part.problem.law()).collect();
        assert_eq!(laws, [Law::Frictionless, Law::Coulomb]);
    }

    #[test]
    fn what_is_together_has_no_parts() {
        let w = ContactProblem::new(DMatrix::from_element(2, 2, 1.0), dvector![-1.0, -1.0]).rows_per_contact(1).build().unwrap();
        assert!(separate(&w).unwrap().is_empty());
        let none = ContactProblem::new(DMatrix::zeros(0, 0), DVector::zeros(0)).rows_per_contact(1).build().unwrap();
        assert!(separate(&none).unwrap().is_empty());
    }
}
