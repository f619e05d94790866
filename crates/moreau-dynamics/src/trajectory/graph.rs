//! The filled-in graph of a piecewise linear function of time: gph(f) = {(t, y): y between f(t⁻) and f(t⁺)}.
//!
//! It is one polyline, monotone in t, whose vertical segments are the jumps. Two velocities whose impacts differ by a
//! small shift in time are far apart in the maximum norm and close as filled-in graphs (Moreau).

use moreau_exact::number::counted;
use moreau_exact::{Error, Result};

/// A polyline (t_i, y_i) with t₀ ≤ t₁ ≤ …; equal neighbouring times are a jump.
///
/// ```
/// use moreau_dynamics::trajectory::Graph;
///
/// let impact = Graph::new(vec![[0.0, 0.0], [1.0, -10.0], [1.0, 5.0], [2.0, -5.0]])?; // (t, v) of a ball, with its jump
/// assert_eq!((impact.span(), impact.variation()), ([0.0, 2.0], 35.0));
/// assert!(Graph::new(vec![[1.0, 0.0], [0.0, 0.0]]).is_err()); // time runs backwards
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    points: Vec<[f64; 2]>,
}

impl Graph {
    /// The graph through these points (t, y).
    ///
    /// # Errors
    /// If there is no point, a number is not finite, or time runs backwards.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self> {
        if points.is_empty() {
            return Err(Error::invalid("graph", "has no point", "give at least one"));
        }
        if let Some(k) = points.iter().position(|point| !point.iter().all(|x| x.is_finite())) {
            return Err(Error::invalid(format!("graph[{k}]"), "is not finite", "use finite times and values"));
        }
        if let Some(k) = points.windows(2).position(|pair| pair[1][0] < pair[0][0]) {
            return Err(Error::invalid(format!("graph[{}]", k + 1), "lies before its predecessor", "order the points by time"));
        }
        Ok(Graph { points })
    }

    /// Linear interpolation of samples (t_k, y_k).
    ///
    /// # Errors
    /// Those of [`Graph::new`], and if the numbers of times and values differ.
    pub fn linear(times: &[f64], values: &[f64]) -> Result<Self> {
        same_length(times, values)?;
        Graph::new(times.iter().zip(values).map(|(&t, &y)| [t, y]).collect())
    }

    /// The step function of a time-stepping scheme: y_{k+1} on (t_k, t_{k+1}\], with a jump from y_k to y_{k+1} at t_k.
    ///
    /// # Errors
    /// Those of [`Graph::new`], and if the numbers of times and values differ.
    pub fn steps(times: &[f64], values: &[f64]) -> Result<Self> {
        same_length(times, values)?;
        let mut points: Vec<[f64; 2]> = times.iter().zip(values).take(1).map(|(&t, &y)| [t, y]).collect();
        for k in 1..times.len() {
            points.push([times[k - 1], values[k]]);
            points.push([times[k], values[k]]);
        }
        Graph::new(points)
    }

    /// The points (t_i, y_i).
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// First and last time.
    pub fn span(&self) -> [f64; 2] {
        [self.points[0][0], self.points[self.points.len() - 1][0]]
    }

    /// (t, y) ↦ (t/`time`, y/`value`).
    ///
    /// # Errors
    /// If a scaled point is not finite, or a negative `time` turns time round.
    pub fn scaled(&self, time: f64, value: f64) -> Result<Graph> {
        Graph::new(self.points.iter().map(|[t, y]| [t / time, y / value]).collect())
    }

    /// Total variation of y, Σ|y_{i+1} − y_i|: exact for a piecewise linear function.
    pub fn variation(&self) -> f64 {
        self.points.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs()).sum()
    }

    /// The pieces on which both graphs are linear, over the common span; jumps lie between pieces.
    pub(crate) fn common_pieces(&self, other: &Graph) -> Vec<Piece> {
        let (mut pieces, mut i, mut j) = (Vec::new(), 0, 0);
        while i + 1 < self.points.len() && j + 1 < other.points.len() {
            let (a, b) = (&self.points[i..i + 2], &other.points[j..j + 2]);
            let start = a[0][0].max(b[0][0]);
            let end = a[1][0].min(b[1][0]);
            if start < end {
                pieces.push(Piece { length: end - start, difference: [value(a, start) - value(b, start), value(a, end) - value(b, end)] });
            }
            if a[1][0] <= b[1][0] {
                i += 1;
            } else {
                j += 1;
            }
        }
        pieces
    }
}

/// One interval on which the difference of two graphs is linear.
pub(crate) struct Piece {
    /// Duration.
    pub length: f64,
    /// The difference at both ends.
    pub difference: [f64; 2],
}

/// Value at t of the line through two points with different times.
fn value(segment: &[[f64; 2]], time: f64) -> f64 {
    let [[t0, y0], [t1, y1]] = [segment[0], segment[1]];
    if time == t1 { y1 } else { y0 + (y1 - y0) * ((time - t0) / (t1 - t0)) }
}

fn same_length(times: &[f64], values: &[f64]) -> Result<()> {
    if times.len() == values.len() {
        return Ok(());
    }
    Err(Error::invalid(
        "graph",
        format!("has {} and {}", counted(times.len(), "time"), counted(values.len(), "value")),
        "give one value per time",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_function_takes_the_value_at_the_end_of_each_step() {
        let graph = Graph::steps(&[0.0, 1.0, 2.0], &[5.0, 3.0, 4.0]).expect("ordered");
        assert_eq!(graph.points(), [[0.0, 5.0], [0.0, 3.0], [1.0, 3.0], [1.0, 4.0], [2.0, 4.0]]);
        assert_eq!(graph.variation(), 3.0);
    }

    #[test]
    fn common_pieces_cover_the_common_span_once() {
        let a = Graph::linear(&[0.0, 1.0, 1.0, 3.0], &[0.0, 1.0, -1.0, 1.0]).expect("ordered");
        let b = Graph::linear(&[0.5, 2.5, 4.0], &[0.0, 0.0, 0.0]).expect("ordered");
        let pieces = a.common_pieces(&b);
        assert_eq!(pieces.iter().map(|piece| piece.length).sum::<f64>(), 2.5);
        assert_eq!(pieces[0].difference, [0.5, 1.0]);
        assert_eq!(pieces[1].difference, [-1.0, 0.5]);
    }

    #[test]
    fn time_that_runs_backwards_and_values_that_are_not_finite_are_refused() {
        assert!(Graph::linear(&[0.0, 1.0, 0.5], &[0.0; 3]).is_err());
        assert!(Graph::linear(&[0.0, 1.0], &[0.0, f64::NAN]).is_err());
        assert!(Graph::linear(&[0.0, 1.0], &[0.0]).is_err());
        assert!(Graph::new(Vec::new()).is_err());
    }
}
