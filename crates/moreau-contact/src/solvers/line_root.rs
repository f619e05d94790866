//! The root of an increasing function: Newton's method within a bracket, halved where Newton would leave it.

/// The end of a search within a bracket \[low, high\].
#[derive(Clone, Copy, Debug)]
pub struct LineRoot {
    /// Below the root.
    pub low: f64,
    /// Above the root; infinite where it is not known yet, and the step is doubled until it is.
    pub high: f64,
    /// Where the search starts.
    pub start: f64,
    /// Largest value that counts as zero.
    pub limit: f64,
    /// Most evaluations.
    pub evaluations: usize,
}

impl LineRoot {
    /// Where the function, given with its derivative, has its root. The search ends at the limits, and where no number is left to try: a
    /// bracket known from the start is then down to its ends, one that was open repeats a step.
    pub fn find(self, mut function: impl FnMut(f64) -> (f64, f64)) -> f64 {
        let LineRoot { mut low, mut high, start: mut step, limit, evaluations } = self;
        let known = high.is_finite();
        for _ in 0..evaluations {
            let (value, slope) = function(step);
            if value.abs() <= limit {
                break;
            }
            if value < 0.0 {
                low = step
            } else {
                high = step
            }
            let newton = step - value / slope;
            let next = if low < newton && newton < high {
                newton
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                2.0 * step
            };
            let exhausted = if known { next <= low || next >= high } else { next == step };
            if exhausted {
                break;
            }
            step = next;
        }
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_is_found_from_an_open_and_from_a_known_bracket() {
        let cubic = |x: f64| (x * x * x - 27.0, 3.0 * x * x);
        let open = LineRoot { low: 0.0, high: f64::INFINITY, start: 1.0, limit: 0.0, evaluations: 100 };
        assert_eq!([open.find(cubic), LineRoot { high: 8.0, ..open }.find(cubic)], [3.0; 2]);
        // a kink, where Newton's steps go back and forth
        let kink = |x: f64| if x < 2.0 { (x - 2.0, 1.0) } else { (1e3 * (x - 2.0), 1e3) };
        assert_eq!(open.find(kink), 2.0);
        assert_eq!(LineRoot { evaluations: 1, ..open }.find(|x| (-x, -1.0)), 2.0, "the bracket is open");
    }
}
