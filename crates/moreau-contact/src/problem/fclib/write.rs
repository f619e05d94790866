//! A problem written as FCLIB's HDF5, with its solution and a guess.

use super::matrix::COLUMNS;
use super::stored::{INFO, StoredAnswers};
use crate::problem::{ContactProblem, Law, Solution};
use hdf5_pure::{FileBuilder, GroupBuilder};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

impl ContactProblem {
    /// The problem as a local FCLIB file, with its solution and one guess where given: W in compressed columns, every number bit for bit.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for what FCLIB has no place for: another law than Coulomb's, one row per contact, a shift, a compliance, or
    /// more entries than its 32-bit numbers count.
    /// ```
    /// use moreau_contact::nalgebra::{DMatrix, dvector};
    /// use moreau_contact::prelude::*;
    ///
    /// let block = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]).build()?;
    /// let answer = Auto.solve(&block, None)?;
    /// let file = std::env::temp_dir().join(format!("moreau-fclib-{}.hdf5", std::process::id()));
    /// std::fs::write(&file, block.to_fclib(Some(&answer), None)?).expect("a folder for temporary files");
    /// let back = ContactProblem::read(&file)?;
    /// assert_eq!((back.dense(), back.free_velocity()), (block.dense(), block.free_velocity()));
    /// assert_eq!(Solution::read(&file, &back)?.impulse, answer.impulse);
    /// # std::fs::remove_file(&file).expect("it was written");
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn to_fclib(&self, solution: Option<&Solution>, guess: Option<&DVector<f64>>) -> Result<Vec<u8>> {
        let pair = |guess: &DVector<f64>| {
            self.require_size("guess", guess.len()).map(|()| Solution::new("", guess.clone(), self.velocity(guess), 0))
        };
        let guesses = guess.map(pair).transpose()?.into_iter().collect();
        self.to_fclib_with(&StoredAnswers { solution: solution.cloned(), guesses, ..StoredAnswers::default() })
    }

    /// [`Self::to_fclib`] with the answers that another file held: their numbers and its texts are kept bit for bit, and what is left out
    /// is not written.
    ///
    /// # Errors
    /// Those of [`Self::to_fclib`], and [`Error::Invalid`] for impulses or velocities of another size than the problem's.
    pub fn to_fclib_with(&self, answers: &StoredAnswers) -> Result<Vec<u8>> {
        self.fits_fclib()?;
        let mut file = FileBuilder::new();
        let mut problem = file.create_group("fclib_local");
        problem.create_dataset("spacedim").with_i32_data(&[self.rows_per_contact() as i32]);
        let mut info = problem.create_group("info");
        for (name, nothing) in INFO {
            let kept = answers.info.iter().find(|(known, _)| known == name).map(|(_, text)| text.as_str());
            let own = Some(self.name()).filter(|own| name == "title" && !own.is_empty());
            let text = kept.or(own).unwrap_or(nothing);
            info.create_dataset(name).with_strings(&[text]).map_err(failed)?.with_shape(&[]);
        }
        problem.add_group(info.finish());
        let mut w = problem.create_group("W");
        self.write_columns(&mut w)?;
        problem.add_group(w.finish());
        let mut vectors = problem.create_group("vectors");
        vectors.create_dataset("q").with_f64_data(self.free_velocity().as_slice());
        vectors.create_dataset("mu").with_f64_data(self.friction());
        problem.add_group(vectors.finish());
        file.add_group(problem.finish());
        if let Some(solution) = &answers.solution {
            let mut group = file.create_group("solution");
            self.write_pair(&mut group, solution, "solution")?;
            file.add_group(group.finish());
        }
        if !answers.guesses.is_empty() {
            let count = i32::try_from(answers.guesses.len()).map_err(too_large)?;
            let mut guesses = file.create_group("guesses");
            guesses.create_dataset("number_of_guesses").with_i32_data(&[count]);
            for (number, guess) in (1..).zip(&answers.guesses) {
                let mut group = guesses.create_group(&format!("{number}"));
                self.write_pair(&mut group, guess, &format!("guesses/{number}"))?;
                guesses.add_group(group.finish());
            }
            file.add_group(guesses.finish());
        }
        file.finish().map_err(failed)
    }

    /// r and u of the group at a path.
    fn write_pair(&self, group: &mut GroupBuilder, answer: &Solution, path: &str) -> Result<()> {
        for (name, numbers) in [("r", &answer.impulse), ("u", &answer.velocity)] {
            self.require_size(&format!("{path}/{name}"), numbers.len())?;
            group.create_dataset(name).with_f64_data(numbers.as_slice());
        }
        Ok(())
    }

    fn fits_fclib(&self) -> Result<()> {
        let lacks = [
            (self.law() != Law::Coulomb, "laws other than Coulomb's", "pose it with Coulomb's law"),
            (self.rows_per_contact() == 1, "contacts of one row", "give each contact a tangent"),
            (self.shift().iter().any(|shift| *shift != 0.0), "a shift", "leave `shift` out"),
            (self.compliance().is_some(), "a compliance", "leave `compliance` out"),
            (self.contacts() == 0, "problems without contacts", "give one contact or more"),
        ];
        match lacks.into_iter().find(|(has, ..)| *has) {
            Some((_, what, cure)) => {
                let keep = "write `contact-problem/1`, a file that ends in .json, which has one";
                Err(Error::Unsupported(format!("FCLIB has no place for {what}; {keep}, or {cure}")))
            }
            None => Ok(()),
        }
    }

    /// m, n, nz, nzmax, p, i, x of W in compressed columns.
    fn write_columns(&self, group: &mut GroupBuilder) -> Result<()> {
        let (mut pointers, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for column in 0..self.rows() {
            self.delassus().for_each_in_column(column, |row, value| {
                rows.push(row);
                values.push(value);
            });
            pointers.push(i32::try_from(rows.len()).map_err(too_large)?);
        }
        let rows: Vec<i32> = rows.into_iter().map(i32::try_from).collect::<std::result::Result<_, _>>().map_err(too_large)?;
        let size = i32::try_from(self.rows()).map_err(too_large)?;
        for (name, value) in [("m", size), ("n", size), ("nz", COLUMNS), ("nzmax", pointers[self.rows()])] {
            group.create_dataset(name).with_i32_data(&[value]);
        }
        group.create_dataset("p").with_i32_data(&pointers);
        group.create_dataset("i").with_i32_data(&rows);
        group.create_dataset("x").with_f64_data(&values);
        Ok(())
    }
}

fn too_large(_: std::num::TryFromIntError) -> Error {
    Error::Unsupported("FCLIB counts entries with 32 bits, and this problem has more; write `contact-problem/1`".into())
}

fn failed(error: impl std::fmt::Display) -> Error {
    Error::Unsupported(format!("HDF5: {error}"))
}
