//! What all pictures share: the unit of length, colours, fonts, ranges and the thinning of curves.

use plotters::coord::Shift;
use plotters::prelude::*;
use std::ops::Range;

/// Lengths are in screen points times this: the backend rounds to whole units, which would show as steps.
pub(super) const FINE: u32 = 8;
/// Colours that stay apart for colour-blind readers (Okabe and Ito, with their black lightened).
pub(super) const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(70, 70, 70),
];
pub(super) const GRID: RGBColor = RGBColor(225, 225, 225);
/// The broad line of a closed form.
pub(super) const EXACT_COLOUR: RGBColor = RGBColor(190, 190, 190);
/// What stands to the left of a chart in the plane: its numbers and its label.
pub(super) const LEFT: u32 = 74 * FINE;
/// Points per curve that a picture of this width can show.
pub(super) const POINTS: usize = 2 * 960;

pub(super) type Drawn = std::result::Result<(), Box<dyn std::error::Error>>;
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

pub(super) fn font(points: u32) -> (&'static str, u32) {
    ("sans-serif", points * FINE)
}

/// The range of some values, widened by a share on both sides; a range far narrower than the values themselves is
/// rounding, and is shown as the straight line it means.
pub(super) fn span(values: impl Iterator<Item = f64>, margin: f64) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high || (low == 0.0 && high == 0.0) {
        return 0.0..1.0;
    }
    let size = low.abs().max(high.abs());
    let missing = (0.01 * size - (high - low)).max(0.0);
    let extra = margin * (high - low) + missing / 2.0;
    low - extra..high + extra
}

/// At most about [`POINTS`] points with the same look: of each stretch its first, lowest, highest and last.
pub(super) fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= POINTS {
        return points.to_vec();
    }
    let stretch = points.len().div_ceil(POINTS / 4);
    points.chunks(stretch).flat_map(characteristic).collect()
}

fn characteristic(stretch: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let by_value = |a: &usize, b: &usize| stretch[*a].1.total_cmp(&stretch[*b].1);
    let lowest = (0..stretch.len()).min_by(by_value);
    let highest = (0..stretch.len()).max_by(by_value);
    let mut places: Vec<_> = [Some(0), lowest, highest, stretch.len().checked_sub(1)].into_iter().flatten().collect();
    places.sort_unstable();
    places.dedup();
    places.into_iter().map(|place| stretch[place]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_is_drawn_flat_and_rounding_is_not_magnified() {
        let range = span([9.81, 9.81 + 1e-14].into_iter(), 0.05);
        assert!(range.start < 9.8 && range.end > 9.82);
        assert_eq!(span([0.0, 0.0].into_iter(), 0.05), 0.0..1.0);
        assert_eq!(span([1.0, 3.0].into_iter(), 0.0), 1.0..3.0);
    }

    #[test]
    fn thinning_keeps_ends_order_and_a_single_spike() {
        let mut points: Vec<_> = (0..100_000).map(|k| (k as f64, 0.0)).collect();
        points[54_321].1 = 7.0;
        let thin = thinned(&points);
        assert!(thin.len() <= POINTS + 4);
        assert_eq!((thin[0], thin[thin.len() - 1]), (points[0], points[99_999]));
        assert!(thin.contains(&(54_321.0, 7.0)));
        assert!(thin.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
}
