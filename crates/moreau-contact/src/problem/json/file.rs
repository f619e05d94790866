//! The fields of `contact-problem/1`, and how each is read.

use super::by_bodies;
use super::matrix::{self, MatrixFile};
use crate::contact::delassus::delassus;
use crate::memory;
use crate::operator::{Operator, SparseDynamics};
use crate::problem::contact_problem::Known;
use crate::problem::{Compliance, ConstraintKind, ContactKey, Coordinates, Dynamics, Law};
use crate::tolerance::problem::DENSE_ROWS;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Schema name of a contact problem.
pub const PROBLEM_SCHEMA: &str = "contact-problem/1";
/// So many letters of a wrong entry are shown.
const SHOWN: usize = 60;

/// One step's contact problem: u = W r + u_free, y = u + shift + R r, and (r, y) in the law, contact by contact.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ContactProblem", extend("oneOf" = [{"required": ["delassus"]}, {"required": ["mass", "jacobian"]}]))]
pub struct ProblemFile {
    /// Always `contact-problem/1`.
    #[schemars(extend("const" = PROBLEM_SCHEMA))]
    pub(super) schema: String,
    /// A name for messages.
    pub(super) name: String,
    /// Rows per contact: 1 (normal), 2 (normal, tangent) or 3 (normal, tangent 1, tangent 2).
    #[schemars(range(min = 1, max = 3))]
    pub(super) dimension: usize,
    /// The contact law.
    #[schemars(extend("enum" = ["frictionless", "coulomb", "associated", "polyhedral-coulomb", "polyhedral-associated"]))]
    pub(super) law: String,
    /// Number of friction directions, of polyhedral laws only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) directions: Option<usize>,
    /// μ ≥ 0 per contact; with `kinds` one per constraint, 0 where it is no contact.
    pub(super) friction: Vec<f64>,
    /// u_free \[m/s\], `dimension` entries per contact; with `kinds` as many per constraint as it has rows.
    pub(super) free_velocity: Vec<f64>,
    /// What the scheme adds for the law \[m/s\]; 0 if absent.
    #[serde(default)]
    pub(super) shift: Option<Vec<f64>>,
    /// W \[1/kg\].
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "matrix::named")]
    pub(super) delassus: Option<MatrixFile>,
    /// M̂, in place of W.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "matrix::named")]
    pub(super) mass: Option<MatrixFile>,
    /// H, with `mass`.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "matrix::named")]
    pub(super) jacobian: Option<MatrixFile>,
    /// R, of soft contacts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) compliance: Option<ComplianceFile>,
    /// The two bodies of each contact, numbered from 0, the ground as null: contacts of one pair are judged by one size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) bodies: Option<Vec<[Option<usize>; 2]>>,
    /// What tells each contact from the others in any list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) keys: Option<Vec<KeyFile>>,
    /// What each constraint is, where some are no contacts; the lists above then go by constraint, and rows stand in their order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Vec<KindFile>>")]
    pub(super) kinds: Option<Vec<serde_json::Value>>,
    /// How the problem was made; opaque here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) provenance: Option<serde_json::Value>,
}

/// Which contact it is.
#[derive(PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ContactKey")]
pub(super) struct KeyFile {
    /// The two bodies, numbered from 0, the ground as null.
    pub(super) bodies: [Option<usize>; 2],
    /// Which features of the two touch.
    pub(super) features: [u32; 2],
}

/// Diagonal softness R \[1/kg\].
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Compliance")]
pub(super) struct ComplianceFile {
    /// Where its entries act: on contact rows, or on the edges of a polyhedral cone.
    #[schemars(extend("enum" = ["contact", "edge"]))]
    pub(super) coordinates: String,
    /// Its entries, all ≥ 0.
    pub(super) diagonal: Vec<f64>,
}

/// What a constraint is.
#[derive(Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[schemars(rename = "ConstraintKind")]
pub(super) enum KindFile {
    /// A contact under the law, of `dimension` rows.
    Contact,
    /// One unilateral row: 0 ≤ r ⟂ y ≥ 0.
    Limit,
    /// So many rows that do not move, y = 0: 1 to 6.
    Bilateral(#[schemars(range(min = 1, max = 6))] usize),
}

/// The keys of a list.
pub(super) fn read_keys(keys: Vec<KeyFile>) -> Vec<ContactKey> {
    keys.into_iter().map(|KeyFile { bodies, features }| ContactKey { bodies, features }).collect()
}

/// The keys as a file has them.
pub(super) fn write_keys(keys: &[ContactKey]) -> Vec<KeyFile> {
    keys.iter().map(|&ContactKey { bodies, features }| KeyFile { bodies, features }).collect()
}

impl From<KindFile> for ConstraintKind {
    fn from(kind: KindFile) -> Self {
        match kind {
            KindFile::Contact => ConstraintKind::Contact,
            KindFile::Limit => ConstraintKind::Limit,
            KindFile::Bilateral(rows) => ConstraintKind::Bilateral { rows },
        }
    }
}

impl From<ConstraintKind> for KindFile {
    fn from(kind: ConstraintKind) -> Self {
        match kind {
            ConstraintKind::Contact => KindFile::Contact,
            ConstraintKind::Limit => KindFile::Limit,
            ConstraintKind::Bilateral { rows } => KindFile::Bilateral(rows),
        }
    }
}

impl ProblemFile {
    /// Three fields say how many rows there are: W or H, u_free, and `friction` times `dimension`. Where they do not agree, the one
    /// that two others contradict is wrong; of `friction` and `dimension`, the latter where no number of contacts would do.
    ///
    /// # Errors
    /// [`Error::Invalid`] names it, with the size that it has and those of the others.
    pub(super) fn check_counts(&self) -> Result<()> {
        let (rows, contacts, dimension) = (self.free_velocity.len(), self.friction.len(), self.dimension);
        let matrices = [("delassus", &self.delassus), ("jacobian", &self.jacobian)];
        let matrix = matrices.into_iter().find_map(|(field, matrix)| Some((field, matrix.as_ref()?.shape[0])));
        // what is missing is told where it is read
        let Some((field, height)) = matrix.filter(|_| rows != dimension * contacts) else { return Ok(()) };
        if height != rows {
            let wanted = format!(
                "give size {}, for {contacts} with {dimension} each",
                dimension * contacts,
                contacts = counted(contacts, "contact"),
                dimension = counted(dimension, "row")
            );
            let others = format!(
                "`friction` has {contacts}, `dimension` is {dimension} and `{field}` has {height}",
                contacts = counted(contacts, "entry"),
                height = counted(height, "row")
            );
            let either = if height == dimension * contacts { "" } else { ", and these do not fit each other either" };
            return Err(Error::invalid("free_velocity", format!("has size {rows}"), format!("{wanted}: {others}{either}")));
        }
        if rows.is_multiple_of(dimension) {
            let others = format!(
                "`free_velocity` and `{field}` have {rows}, {dimension} per contact as `dimension` says",
                rows = counted(rows, "row")
            );
            let cure = format!("give {}, one per contact: {others}", rows / dimension);
            return Err(Error::invalid("friction", format!("has size {contacts}"), cure));
        }
        let problem = format!(
            "is {dimension}, with `free_velocity` of {rows} and `friction` of {contacts}",
            rows = counted(rows, "row"),
            contacts = counted(contacts, "contact")
        );
        Err(Error::invalid("dimension", problem, "give as many rows as the dimension for each contact"))
    }
}

/// What each constraint is.
///
/// # Errors
/// [`Error::Invalid`] names the first that is no kind.
pub(super) fn read_kinds(kinds: &[serde_json::Value]) -> Result<Vec<ConstraintKind>> {
    let read = |(k, kind): (usize, &serde_json::Value)| {
        let cure = "use \"contact\", \"limit\" or {\"bilateral\": N} with its number of rows N, 1 to 6, and nothing beside it";
        let shown: String = kind.to_string().chars().take(SHOWN).collect();
        let no_kind = |_| Error::invalid(format!("kinds[{k}]"), format!("is {shown}"), cure);
        serde_json::from_value::<KindFile>(kind.clone()).map(ConstraintKind::from).map_err(no_kind)
    };
    kinds.iter().enumerate().map(read).collect()
}

/// The law of this name.
pub(super) fn read_law(name: &str, directions: Option<usize>) -> Result<Law> {
    let law = match name {
        "frictionless" => Law::Frictionless,
        "coulomb" => Law::Coulomb,
        "associated" => Law::Associated,
        "polyhedral-coulomb" | "polyhedral-associated" => {
            let directions =
                directions.ok_or_else(|| Error::invalid("directions", "is missing", "give the number of friction directions"))?;
            return Ok(if name == "polyhedral-coulomb" {
                Law::PolyhedralCoulomb { directions }
            } else {
                Law::PolyhedralAssociated { directions }
            });
        }
        _ => {
            let cure = "use frictionless, coulomb, associated, polyhedral-coulomb or polyhedral-associated";
            return Err(Error::invalid("law", format!("is `{name}`"), cure));
        }
    };
    match directions {
        None => Ok(law),
        Some(_) => Err(Error::invalid("directions", format!("is given with the law `{name}`"), "leave it out, or use a polyhedral law")),
    }
}

/// W, or mass and Jacobian that make it.
pub(super) fn read_operator(
    operator: Option<MatrixFile>,
    mass: Option<MatrixFile>,
    jacobian: Option<MatrixFile>,
    [rows_per_contact, rows]: [usize; 2],
) -> Result<(Operator, Option<Known>)> {
    // sizes are compared before a matrix is made, so that a wrong shape cannot ask for all the memory
    let shape = |field: &str, matrix: &MatrixFile, wanted: [usize; 2]| {
        let problem = format!("has shape {}×{}", matrix.shape[0], matrix.shape[1]);
        let contacts = rows / rows_per_contact;
        let cure = format!(
            "use the shape {}×{}, for {contacts} with {rows_per_contact} each",
            wanted[0],
            wanted[1],
            contacts = counted(contacts, "contact"),
            rows_per_contact = counted(rows_per_contact, "row")
        );
        if matrix.shape == wanted { Ok(()) } else { Err(Error::invalid(field, problem, cure)) }
    };
    let room = |velocities: usize| {
        let matrices = [(2, rows, rows), (1, velocities, velocities), (2, rows, velocities)]
            .map(|(times, n, m)| memory::matrix(n, m).saturating_mul(times));
        memory::require("storing the matrices of this problem", matrices.into_iter().fold(0, u128::saturating_add))
    };
    match (operator, mass, jacobian) {
        (Some(operator), None, None) => {
            shape("delassus", &operator, [rows, rows])?;
            if !operator.has_blocks() {
                room(0)?;
            }
            Ok((operator.read_operator("delassus", rows_per_contact)?, None))
        }
        (None, Some(mass), Some(jacobian)) => {
            let velocities = mass.shape[0];
            if mass.triplets.as_ref().is_some_and(|triplets| triplets.value.len() < velocities) {
                return Err(Error::invalid("mass", "has an empty row", "give every velocity a positive inertia"));
            }
            shape("mass", &mass, [velocities, velocities])?;
            shape("jacobian", &jacobian, [rows, velocities])?;
            if let Some((field, _)) = [("mass", &mass), ("jacobian", &jacobian)].into_iter().find(|(_, matrix)| matrix.forms() != 1) {
                return Err(matrix::one_form(field));
            }
            if by_bodies::is_given(&mass, &jacobian) {
                return Ok((by_bodies::read(mass, jacobian, rows_per_contact)?.into(), None));
            }
            if rows > DENSE_ROWS && mass.triplets.is_some() && jacobian.triplets.is_some() {
                let (mass, jacobian) = (mass.read_sparse("mass")?, jacobian.read_sparse("jacobian")?);
                let listed = SparseDynamics::new(&mass, &jacobian, rows_per_contact)?;
                return Ok((listed.delassus()?.into(), Some(Known::listed(listed))));
            }
            room(velocities)?;
            let dynamics = Dynamics { mass: mass.read("mass")?, jacobian: jacobian.read("jacobian")? };
            Ok((delassus(&dynamics.mass, &dynamics.jacobian)?.into(), Some(Known::Dense(dynamics))))
        }
        (None, Some(_), None) => Err(Error::invalid("jacobian", "is missing beside `mass`", "give H, or W alone as `delassus`")),
        (None, None, Some(_)) => Err(Error::invalid("mass", "is missing beside `jacobian`", "give M̂, or W alone as `delassus`")),
        (None, None, None) => Err(Error::invalid("delassus", "is missing", "give W, or `mass` and `jacobian` in its place")),
        (Some(_), ..) => Err(Error::invalid("delassus", "stands beside `mass` or `jacobian`", "give W alone, or these two in its place")),
    }
}

/// M̂ and H as they are shorter, if W follows from them bit for bit. Where both by their entries would make W by blocks, H is row by row.
pub(super) fn written(dynamics: Option<&Dynamics>, w: &DMatrix<f64>) -> [Option<MatrixFile>; 2] {
    let follows = |dynamics: &&Dynamics| delassus(&dynamics.mass, &dynamics.jacobian).is_ok_and(|found| found == *w);
    dynamics.filter(follows).map_or([None, None], |Dynamics { mass, jacobian }| {
        let rows = if jacobian.nrows() > DENSE_ROWS { MatrixFile::dense(jacobian) } else { MatrixFile::shorter(jacobian) };
        [MatrixFile::shorter(mass), rows].map(Some)
    })
}

/// R of soft contacts.
pub(super) fn read_compliance(file: ComplianceFile) -> Result<Compliance> {
    let coordinates = match file.coordinates.as_str() {
        "contact" => Coordinates::Contact,
        "edge" => Coordinates::Edge,
        other => return Err(Error::invalid("compliance.coordinates", format!("is `{other}`"), "use `contact` or `edge`")),
    };
    Ok(Compliance { coordinates, diagonal: DVector::from_vec(file.diagonal) })
}

/// The text of a file.
pub(super) fn text(file: &impl Serialize) -> String {
    serde_json::to_string(file).expect("numbers, strings and lists always have a JSON form") + "\n"
}
