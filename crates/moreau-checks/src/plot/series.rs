//! How a series is drawn into a chart, as far as the chart's ranges go.

use super::axis::Axis;
use super::chart::{Series, Shape};
use super::ink::{Ink, Mark};
use super::paper::{Drawn, FINE, font, thinned};
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// The length of an arrow's head.
const HEAD: f64 = 9.0 * FINE as f64;

pub(super) type Place = (f64, f64);
pub(super) type Coordinates = Cartesian2d<Marked, Marked>;
pub(super) type Paper<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Coordinates>;

/// A linear coordinate with numbers at chosen places.
pub(super) struct Marked {
    pub inner: RangedCoordf64,
    pub marks: Vec<f64>,
}

impl Ranged for Marked {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.inner.map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.marks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.inner.range()
    }
}

/// What a chart shows of the plane.
pub(super) struct Window<'a> {
    pub axes: [&'a Axis; 2],
    pub x: &'a Range<f64>,
    pub y: &'a Range<f64>,
}

impl Window<'_> {
    /// Where a point lies on the paper, if it is within the ranges.
    fn place(&self, [x, y]: [f64; 2]) -> Option<Place> {
        let (x, y) = (self.axes[0].place(x), self.axes[1].place(y));
        (x >= self.x.start && x <= self.x.end && y >= self.y.start && y <= self.y.end).then_some((x, y))
    }

    /// The part of a polygon within the ranges, cut at one side after the other (Sutherland and Hodgman).
    fn clip(&self, points: &[[f64; 2]]) -> Vec<Place> {
        let mut corners: Vec<Place> = points.iter().map(|[x, y]| (self.axes[0].place(*x), self.axes[1].place(*y))).collect();
        let sides: [&dyn Fn(Place) -> f64; 4] =
            [&|p| p.0 - self.x.start, &|p| self.x.end - p.0, &|p| p.1 - self.y.start, &|p| self.y.end - p.1];
        for inside in sides {
            let mut kept = Vec::new();
            for (k, &to) in corners.iter().enumerate() {
                let from = corners[(k + corners.len() - 1) % corners.len()];
                let (a, b) = (inside(from), inside(to));
                if (a < 0.0) != (b < 0.0) {
                    let share = a / (a - b);
                    kept.push((from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1)));
                }
                if b >= 0.0 {
                    kept.push(to);
                }
            }
            corners = kept;
        }
        corners
    }
}

pub(super) fn draw_series(paper: &mut Paper, series: &Series, window: &Window) -> Drawn {
    let (ink, visible) = (&series.ink, |place: [f64; 2]| window.place(place));
    match &series.shape {
        Shape::Line(points) => {
            for run in points.split(|place| visible(*place).is_none()).filter(|run| run.len() > 1) {
                draw_line(paper, thinned(&run.iter().filter_map(|place| visible(*place)).collect::<Vec<_>>()), ink)?;
            }
        }
        Shape::Dots(points) => draw_marks(paper, points.iter().filter_map(|place| visible(*place)), ink)?,
        Shape::Region(points) => {
            let mut corners = window.clip(points);
            if corners.is_empty() {
                return Ok(());
            }
            paper.draw_series([Polygon::new(corners.clone(), ink.wash())])?;
            corners.extend(corners.first().copied());
            draw_line(paper, corners, ink)?;
        }
        Shape::Cells(cells) => {
            for [low, high] in cells.iter().filter_map(|[low, high]| Some([visible(*low)?, visible(*high)?])) {
                let (from, to) = (paper.backend_coord(&low), paper.backend_coord(&high));
                let corners = [(0, SEAM), (to.0 - from.0 + SEAM, to.1 - from.1)];
                paper.draw_series([EmptyElement::at(low) + Rectangle::new(corners, ink.filled())])?;
            }
        }
        Shape::Arrows(arrows) => {
            for [from, to] in arrows.iter().filter_map(|[from, to]| Some([visible(*from)?, visible(*to)?])) {
                draw_line(paper, vec![from, to], ink)?;
                draw_head(paper, from, to, ink)?;
            }
        }
        Shape::Words(words) => {
            let style = TextStyle::from(font(14)).pos(Pos::new(HPos::Center, VPos::Center));
            let placed = words.iter().filter_map(|(place, word)| Some((visible(*place)?, word)));
            paper.draw_series(placed.map(|(place, word)| Text::new(word.clone(), place, style.clone())))?;
        }
    }
    Ok(())
}

fn draw_line(paper: &mut Paper, points: Vec<Place>, ink: &Ink) -> Drawn {
    match ink.dash {
        None => paper.draw_series(LineSeries::new(points, ink.line()))?,
        Some((dash, gap)) => paper.draw_series(DashedLineSeries::new(points, dash * FINE, gap * FINE, ink.line()))?,
    };
    Ok(())
}

/// How far neighbouring cells overlap, so that no seam shines through.
const SEAM: i32 = FINE as i32 / 2;
/// Size of a mark.
pub(super) const MARK: u32 = 4 * FINE;

fn draw_marks(paper: &mut Paper, points: impl Iterator<Item = Place>, ink: &Ink) -> Drawn {
    let side = MARK as i32 * 7 / 8;
    match ink.mark {
        Mark::Disk => paper.draw_series(points.map(|place| plotters::element::Circle::new(place, MARK, ink.filled())))?,
        Mark::Circle => paper.draw_series(points.map(|place| plotters::element::Circle::new(place, MARK, ink.line())))?,
        Mark::Triangle => paper.draw_series(points.map(|place| TriangleMarker::new(place, MARK + FINE, ink.filled())))?,
        Mark::Cross => paper.draw_series(points.map(|place| Cross::new(place, MARK, ink.line())))?,
        Mark::Square => {
            paper.draw_series(points.map(|place| EmptyElement::at(place) + Rectangle::new([(-side, -side), (side, side)], ink.filled())))?
        }
    };
    Ok(())
}

fn draw_head(paper: &mut Paper, from: Place, to: Place, ink: &Ink) -> Drawn {
    let (tail, tip) = (paper.backend_coord(&from), paper.backend_coord(&to));
    let (dx, dy) = (f64::from(tip.0 - tail.0), f64::from(tip.1 - tail.1));
    let length = dx.hypot(dy);
    if length > 0.0 {
        let (dx, dy) = (HEAD * dx / length, HEAD * dy / length);
        let corner = |side: f64| ((-dx - side * dy / 2.5).round() as i32, (-dy + side * dx / 2.5).round() as i32);
        let head = Polygon::new(vec![(0, 0), corner(1.0), corner(-1.0)], ink.filled());
        paper.draw_series([EmptyElement::at(to) + head])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_is_cut_at_the_ranges() {
        let (x, y) = (Axis::linear("x [m]"), Axis::linear("y [m]"));
        let window = Window { axes: [&x, &y], x: &(0.0..2.0), y: &(0.0..1.0) };
        let area = |corners: &[Place]| {
            let next = |k: usize| corners[(k + 1) % corners.len()];
            corners.iter().enumerate().map(|(k, p)| 0.5 * (p.0 * next(k).1 - next(k).0 * p.1)).sum::<f64>().abs()
        };
        // the triangle below y = 4 − x lacks its corners above and to the right: the whole window is left
        let whole = window.clip(&[[-8.0, -8.0], [12.0, -8.0], [-8.0, 12.0]]);
        assert!((area(&whole) - 2.0).abs() <= 16.0 * f64::EPSILON, "{whole:?}");
        let half = window.clip(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]);
        assert!((area(&half) - 1.0).abs() <= 16.0 * f64::EPSILON, "{half:?}");
        assert!(window.clip(&[[3.0, 0.0], [4.0, 0.0], [4.0, 1.0]]).is_empty());
    }
}
