//! Impulses carried from one list of contacts to the next by the keys of the contacts.

use super::ContactProblem;
use super::keys::ContactKey;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::collections::HashMap;

/// The impulses of `before` at the contacts of `after` that have the same key, and zero at the others: a warm start \[N·s\].
///
/// # Errors
/// [`Error::Invalid`] if a problem has no keys, contacts have another number of rows, or there are not as many impulses as rows.
/// ```
/// use moreau_contact::ContactProblem;
/// use moreau_contact::nalgebra::{DMatrix, DVector, dvector};
/// use moreau_contact::problem::{ContactKey, carried};
///
/// let balls = |keys: &[u32]| {
///     let n = keys.len();
///     let keys = keys.iter().map(|ball| ContactKey { bodies: [Some(*ball as usize), None], features: [0, 0] }).collect();
///     ContactProblem::new(DMatrix::identity(n, n), DVector::zeros(n)).rows_per_contact(1).keys(Some(keys)).build()
/// };
/// // ball 7 has left, ball 9 has come
/// let start = carried(&balls(&[5, 7, 8])?, &dvector![1.0, 2.0, 3.0], &balls(&[8, 9, 5])?)?;
/// assert_eq!(start, dvector![3.0, 0.0, 1.0]);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn carried(before: &ContactProblem, impulse: &DVector<f64>, after: &ContactProblem) -> Result<DVector<f64>> {
    let rows = after.rows_per_contact();
    if before.rows_per_contact() != rows || impulse.len() != before.rows() {
        let problem = format!("are {} of contacts of {}", counted(impulse.len(), "impulse"), counted(before.rows_per_contact(), "row"));
        return Err(Error::invalid("warm_start", problem, format!("give {rows} for each contact of the earlier problem")));
    }
    by_keys(before.keys().ok_or_else(|| missing(before.name()))?, impulse, after).map(|(carried, _)| carried)
}

/// The impulses of these keys at the contacts that have the same, and zero at the others \[N·s\]; and how many contacts have one.
///
/// # Errors
/// [`Error::Invalid`] if the problem has no keys, or there are not as many impulses as the keys have rows.
pub(super) fn by_keys(keys: &[ContactKey], impulse: &DVector<f64>, after: &ContactProblem) -> Result<(DVector<f64>, usize)> {
    let rows = after.rows_per_contact();
    if impulse.len() != rows * keys.len() {
        let cure =
            format!("give size {}, for {} with {rows} each", rows * keys.len(), counted(keys.len(), "key"), rows = counted(rows, "row"));
        return Err(Error::invalid("impulse", format!("has size {}", impulse.len()), cure));
    }
    let found: HashMap<&ContactKey, &[f64]> = keys.iter().zip(impulse.as_slice().chunks_exact(rows)).collect();
    let (mut carried, mut matched) = (DVector::zeros(after.rows()), 0);
    let own = after.keys().ok_or_else(|| missing(after.name()))?;
    for (part, key) in carried.as_mut_slice().chunks_exact_mut(rows).zip(own) {
        if let Some(impulse) = found.get(key) {
            part.copy_from_slice(impulse);
            matched += 1;
        }
    }
    Ok((carried, matched))
}

fn missing(name: &str) -> Error {
    Error::invalid("keys", format!("are missing in the problem “{name}”"), "name the bodies and features of each contact")
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    fn key(number: usize) -> ContactKey {
        ContactKey { bodies: [Some(number / 2), None], features: [number as u32 % 2, 0] }
    }

    fn problem(numbers: &[usize]) -> ContactProblem {
        let n = numbers.len();
        let problem = ContactProblem::new(DMatrix::identity(2 * n, 2 * n), DVector::zeros(2 * n)).rows_per_contact(2);
        problem.friction(vec![0.5; n]).keys(Some(numbers.iter().map(|number| key(*number)).collect())).build().unwrap()
    }

    fn impulses(numbers: &[usize]) -> DVector<f64> {
        DVector::from_iterator(2 * numbers.len(), numbers.iter().flat_map(|number| [10.0 + *number as f64, *number as f64]))
    }

    #[test]
    fn impulses_follow_their_contacts_through_insertion_removal_and_permutation() {
        let before = [0, 1, 2, 3, 4, 5];
        for after in [vec![5, 3, 1, 0, 2, 4], vec![0, 1, 4, 5], vec![9, 0, 1, 8, 2, 3, 4, 5, 7], vec![7, 4, 0], vec![]] {
            let found = carried(&problem(&before), &impulses(&before), &problem(&after)).unwrap();
            let known = |number: &usize| if before.contains(number) { [10.0 + *number as f64, *number as f64] } else { [0.0; 2] };
            assert_eq!(found.as_slice(), after.iter().flat_map(known).collect::<Vec<_>>(), "{after:?}");
            let by_place = DVector::from_fn(2 * after.len(), |row, _| impulses(&before).get(row).copied().unwrap_or(0.0));
            assert!(after.is_empty() || found != by_place, "impulses that stay at their place belong to other contacts");
        }
    }

    #[test]
    fn a_warm_start_by_keys_solves_a_changed_list_at_once() {
        use crate::solvers::{ContactSolver, ProjectedGaussSeidel};
        let pressed = |numbers: &[usize]| {
            let free = numbers.iter().flat_map(|number| [-1.0 - *number as f64, 0.25]);
            problem(numbers).into_builder().free_velocity(DVector::from_iterator(2 * numbers.len(), free)).build().unwrap()
        };
        let (before, after) = (pressed(&[0, 1, 2]), pressed(&[2, 0, 1]));
        let solver = ProjectedGaussSeidel::default();
        let answer = solver.solve(&before, None).unwrap();
        let iterations = |start: &DVector<f64>| solver.solve(&after, Some(start)).unwrap().iterations;
        assert_eq!(iterations(&carried(&before, &answer.impulse, &after).unwrap()), 0);
        assert!(iterations(&answer.impulse) > 0, "by place the impulses are wrong");
    }

    #[test]
    fn problems_without_keys_and_wrong_sizes_are_refused() {
        let bare = problem(&[0]).into_builder().keys(None).build().unwrap();
        assert!(carried(&bare, &impulses(&[0]), &problem(&[0])).unwrap_err().to_string().contains("keys"));
        assert!(carried(&problem(&[0]), &impulses(&[0, 1]), &problem(&[0])).unwrap_err().to_string().contains("4 impulses"));
        let twice = problem(&[0, 1]).into_builder().keys(Some(vec![key(0); 2])).build().unwrap_err().to_string();
        assert!(twice.contains("keys[1]") && twice.contains("keys[0]"), "{twice}");
        let few = problem(&[0, 1]).into_builder().keys(Some(vec![key(0)])).build().unwrap_err().to_string();
        assert!(few.contains("`keys`"), "{few}");
        let pairs = Some(vec![[Some(0), None], [Some(1), None]]);
        let others = problem(&[0, 1]).into_builder().bodies(pairs).build().unwrap_err().to_string();
        assert!(others.contains("keys[1]"), "{others}");
    }
}
