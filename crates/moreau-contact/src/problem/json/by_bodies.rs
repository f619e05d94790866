//! W by bodies in a file: the masses as blocks on the diagonal of `mass`, H as sparse rows of `jacobian`.

use super::matrix::MatrixFile;
use super::sparse_rows::SparseRows;
use crate::contact::delassus::{SYMMETRIC, asymmetric_entry};
use crate::operator::{BlockRows, MatrixFree};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// Whether both matrices, or one of them, are given by bodies.
pub(super) fn is_given(mass: &MatrixFile, jacobian: &MatrixFile) -> bool {
    mass.diagonal_blocks.is_some() || jacobian.sparse_rows.is_some()
}

/// W from both, with so many rows per contact.
pub(super) fn read(mass: MatrixFile, jacobian: MatrixFile, rows_per_contact: usize) -> Result<MatrixFree> {
    let ([velocities, _], [rows, _]) = (mass.shape, jacobian.shape);
    let (Some(blocks), Some(sparse)) = (mass.diagonal_blocks, jacobian.sparse_rows) else {
        let cure = "give `mass` as `diagonal_blocks` and `jacobian` as `sparse_rows`, or none of them so";
        return Err(Error::invalid("mass", "and `jacobian` are not both given by bodies", cure));
    };
    let masses = read_masses(blocks, velocities)?;
    sparse.check(rows, velocities)?;
    let mut made = BlockRows::new(rows_per_contact, masses.iter().map(DMatrix::nrows))?;
    made.reserve(rows / rows_per_contact)?;
    let mut body_of = vec![0; velocities];
    (0..masses.len()).for_each(|body| body_of[made.velocities(body)].fill(body));
    for contact in 0..rows / rows_per_contact {
        let mut touched: Vec<(usize, Vec<f64>)> = Vec::new();
        for row in 0..rows_per_contact {
            for entry in sparse.entries(contact * rows_per_contact + row) {
                let body = body_of[sparse.column[entry]];
                let range = made.velocities(body);
                let at = touched.iter().position(|(other, _)| *other == body).unwrap_or_else(|| {
                    touched.push((body, vec![0.0; rows_per_contact * range.len()]));
                    touched.len() - 1
                });
                touched[at].1[row * range.len() + sparse.column[entry] - range.start] = sparse.value[entry];
            }
        }
        touched.sort_by_key(|(body, _)| *body);
        made.push(&touched.iter().map(|(body, block)| (*body, block.as_slice())).collect::<Vec<_>>())?;
    }
    MatrixFree::new(&masses, made)
}

fn read_masses(blocks: Vec<Vec<f64>>, velocities: usize) -> Result<Vec<DMatrix<f64>>> {
    let mut masses = Vec::with_capacity(blocks.len());
    let mut sum = 0;
    for (body, block) in blocks.into_iter().enumerate() {
        let size = block.len().isqrt();
        if size * size != block.len() || size == 0 {
            let problem = format!("has {}", counted(block.len(), "entry"));
            return Err(Error::invalid(
                format!("mass.diagonal_blocks[{body}]"),
                problem,
                "give as many as the square of the body's velocities",
            ));
        }
        sum += size;
        let mass = DMatrix::from_row_slice(size, size, &block);
        if let Some((i, j)) = asymmetric_entry(&mass) {
            let problem = format!("is not symmetric: ({i}, {j}) is {} and ({j}, {i}) is {}", mass[(i, j)], mass[(j, i)]);
            return Err(Error::invalid(format!("mass.diagonal_blocks[{body}]"), problem, SYMMETRIC));
        }
        masses.push(mass);
    }
    if sum == velocities {
        return Ok(masses);
    }
    let problem = format!("have {} together", counted(sum, "row"));
    Err(Error::invalid("mass.diagonal_blocks", problem, format!("give {velocities}, as `shape` says")))
}

/// `mass` and `jacobian` of W by bodies; entries of H that are zero are left out.
pub(super) fn written(free: &MatrixFree) -> [MatrixFile; 2] {
    let (jacobian, rows) = (free.jacobian(), free.rows_per_contact());
    let by_rows = |body: usize| free.mass(body).transpose().as_slice().to_vec();
    let mut sparse = SparseRows { starts: vec![0], column: Vec::new(), value: Vec::new() };
    for (contact, row) in (0..free.contacts()).flat_map(|contact| (0..rows).map(move |row| (contact, row))) {
        for (body, block) in jacobian.contact(contact) {
            let range = jacobian.velocities(body);
            let own = range.clone().zip(&block[row * range.len()..(row + 1) * range.len()]);
            for (column, value) in own.filter(|(_, value)| value.to_bits() != 0) {
                sparse.column.push(column);
                sparse.value.push(*value);
            }
        }
        sparse.starts.push(sparse.value.len());
    }
    let velocities = jacobian.velocity_count();
    let mass =
        MatrixFile { diagonal_blocks: Some((0..jacobian.body_count()).map(by_rows).collect()), ..MatrixFile::empty([velocities; 2]) };
    [mass, MatrixFile { sparse_rows: Some(sparse), ..MatrixFile::empty([rows * free.contacts(), velocities]) }]
}
