//! A sparse matrix of FCLIB: m, n, nz, nzmax, p, i, x, where nz tells how it is stored.

use super::datasets::{integers, numbers};
use crate::operator::Sparse;
use hdf5_pure::File;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};

/// Compressed columns: p[j] .. p[j + 1] are the entries of column j, i their rows.
pub(super) const COLUMNS: i32 = -1;
/// Compressed rows: p[i] .. p[i + 1] are the entries of row i, i their columns.
const ROWS: i32 = -2;

/// The matrix of a group. With nz ≥ 0 it is nz triplets, row i and column p.
pub(super) fn read(file: &File, group: &str) -> Result<Sparse> {
    let one = |name: &str| match integers(file, &format!("{group}/{name}"))?[..] {
        [value] => Ok(value),
        ref other => Err(Error::invalid(format!("{group}/{name}"), format!("has {}", counted(other.len(), "number")), "give one")),
    };
    let [rows, columns, nz] = [one("m")?, one("n")?, one("nz")?];
    let all = |name: &str| integers(file, &format!("{group}/{name}"));
    let (pointers, indices, values) = (all("p")?, all("i")?, numbers(file, &format!("{group}/x"))?);
    let shape = [size(group, rows)?, size(group, columns)?];
    let places: Vec<(i32, i32)> = match nz {
        0.. => indices.iter().copied().zip(pointers.iter().copied()).take(nz as usize).collect(),
        COLUMNS => unpacked(group, &pointers, &indices, shape[1])?.map(|(major, minor)| (minor, major)).collect(),
        ROWS => unpacked(group, &pointers, &indices, shape[0])?.collect(),
        other => {
            let cure = "use −1 (compressed columns), −2 (compressed rows) or the number of triplets";
            return Err(Error::invalid(format!("{group}/nz"), format!("is {other}"), cure));
        }
    };
    if places.len() > values.len() || (nz >= 0 && places.len() != nz as usize) {
        let problem = format!("has {} and {}", counted(places.len(), "place"), counted(values.len(), "value"));
        return Err(Error::invalid(group, problem, "give a value for each place"));
    }
    let entry = |((row, column), value): ((i32, i32), f64)| match (usize::try_from(row), usize::try_from(column)) {
        (Ok(row), Ok(column)) if row < shape[0] && column < shape[1] => Ok((row, column, value)),
        _ => Err(Error::invalid(group, format!("has an entry at ({row}, {column})"), format!("use places below {shape:?}"))),
    };
    let entries = places.into_iter().zip(values).map(entry).collect::<Result<_>>()?;
    Ok(Sparse { shape, entries })
}

fn size(group: &str, size: i32) -> Result<usize> {
    usize::try_from(size).map_err(|_| Error::invalid(group, format!("has the size {size}"), "use sizes ≥ 0"))
}

/// The places (major, minor) of a compressed matrix.
fn unpacked<'a>(group: &str, pointers: &'a [i32], indices: &'a [i32], majors: usize) -> Result<impl Iterator<Item = (i32, i32)> + 'a> {
    let grows = pointers.windows(2).all(|pair| pair[0] <= pair[1]);
    let last = pointers.last().and_then(|last| usize::try_from(*last).ok());
    if pointers.len() != majors + 1 || pointers[0] != 0 || !grows || last.is_none_or(|last| last > indices.len()) {
        let problem = format!("has {} pointers that do not fit {majors} rows or columns and {} indices", pointers.len(), indices.len());
        return Err(Error::invalid(format!("{group}/p"), problem, "give growing pointers from 0, one more than rows or columns"));
    }
    let range = |pair: &[i32]| pair[0] as usize..pair[1] as usize;
    Ok(pointers.windows(2).enumerate().flat_map(move |(major, pair)| indices[range(pair)].iter().map(move |minor| (major as i32, *minor))))
}
