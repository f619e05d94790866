//! What nearly every claim names: `use crate::claims::prelude::*;`.

pub(crate) use super::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity, check};
pub(crate) use crate::checks::Finding;
pub(crate) use crate::scalar::{Rational, Scalar, ratio};
pub(crate) use crate::{Error, Result};
pub(crate) use nalgebra::{DMatrix, DVector, dvector};
