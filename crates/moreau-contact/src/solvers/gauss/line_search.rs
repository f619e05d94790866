//! The exact line search: the root of the slope of ½ΔᵀMΔ + s along a direction, which never decreases.
//!
//! ```text
//!     φ'(α) = pᵀM(Δ + αp) − r(y + αHp)·Hp ,      φ''(α) = pᵀM p + (Hp)ᵀ ∇²s (Hp) .
//! ```
//! Newton's method on φ' within a bracket; where it would leave the bracket, the bracket is halved, and doubled while it is open.

use super::GaussProgram;
use crate::solvers::LineRoot;
use crate::tolerance::solvers::{LINE_SLOPE, ROOT_STEPS};
use nalgebra::DVector;

/// The step α > 0 with φ'(α) = 0 along a direction of descent, or 0 if there is none: φ'(0) ≥ 0.
pub fn exact_step(program: &GaussProgram, change: &DVector<f64>, direction: &DVector<f64>) -> f64 {
    let line = Line::new(program, change, direction);
    let (start, _) = line.slope(0.0);
    if start.is_nan() || start >= 0.0 {
        return 0.0;
    }
    let root = LineRoot { low: 0.0, high: f64::INFINITY, start: 1.0, limit: LINE_SLOPE * -start, evaluations: ROOT_STEPS };
    root.find(|step| line.slope(step))
}

struct Line<'a> {
    program: &'a GaussProgram,
    violation: DVector<f64>,
    motion: DVector<f64>,
    linear: f64,
    quadratic: f64,
}

impl<'a> Line<'a> {
    fn new(program: &'a GaussProgram, change: &DVector<f64>, direction: &DVector<f64>) -> Self {
        let inertia = program.mass().times(direction);
        Line {
            program,
            violation: program.violation(change),
            motion: program.motion(direction),
            linear: inertia.dot(change),
            quadratic: inertia.dot(direction),
        }
    }

    /// φ' and φ''.
    fn slope(&self, step: f64) -> (f64, f64) {
        let violation = &self.violation + &self.motion * step;
        let (mut slope, mut curvature) = (self.linear + step * self.quadratic, self.quadratic);
        for (first, piece) in self.program.pieces() {
            let range = first..first + piece.rows();
            let (y, p) = (&violation.as_slice()[range.clone()], &self.motion.as_slice()[range]);
            slope -= piece.impulse(y).iter().zip(p).map(|(r, p)| r * p).sum::<f64>();
            let matrix = piece.curvature(y);
            let p = DVector::from_column_slice(p);
            curvature += p.dot(&(matrix * &p));
        }
        (slope, curvature)
    }
}
