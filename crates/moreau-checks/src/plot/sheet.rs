//! Charts beside and below each other as one SVG, each over its legend.

use super::axis::Axis;
use super::chart::{Chart, Shape};
use super::legend::{ROW, draw_legend, legend_rows};
use super::paper::{Area, Drawn, FINE, GRID, LEFT, font};
use super::series::{Marked, Window, draw_series};
use moreau_exact::{Error, Result};
use plotters::prelude::*;
use std::ops::Range;

/// Charts in rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// How many stand beside each other.
    pub columns: usize,
    /// The charts, row by row.
    pub charts: Vec<Chart>,
}

/// The width of a sheet, in units.
const WIDTH: u32 = 840 * FINE;
/// The height of a chart without its title and legend: alone in its row, and beside another one.
const ALONE: u32 = 400 * FINE;
const BESIDE: u32 = 350 * FINE;
const TITLE: u32 = 30 * FINE;
const MARGIN: u32 = 8 * FINE;
const BOTTOM: u32 = 46 * FINE;
/// The round corners of the paper.
const CORNER: u32 = 10 * FINE;

impl Sheet {
    /// Charts below each other.
    pub fn column(charts: Vec<Chart>) -> Self {
        Sheet { columns: 1, charts }
    }

    /// Two charts beside each other, in rows.
    pub fn pairs(charts: Vec<Chart>) -> Self {
        Sheet { columns: 2, charts }
    }

    /// The text of an SVG file, on paper of its own with round corners, so that it can be read on a dark page.
    ///
    /// # Errors
    /// A point that is not finite or has no logarithm, an axis without a range, or a failure of the drawing backend.
    pub fn svg(&self) -> Result<String> {
        for chart in &self.charts {
            chart.check()?;
        }
        let rows: Vec<u32> = self.charts.chunks(self.columns).map(|row| self.height(row)).collect();
        let size = (WIDTH, rows.iter().sum());
        let mut text = String::new();
        self.draw(&mut text, size, &rows).map_err(|error| Error::Unsupported(format!("cannot draw the picture: {error}")))?;
        let fine = format!("<svg width=\"{}\" height=\"{}\"", size.0, size.1);
        let text = text.replacen(&fine, &format!("<svg width=\"{}\" height=\"{}\"", size.0 / FINE, size.1 / FINE), 1);
        Ok(text.replacen("<rect ", &format!("<rect rx=\"{CORNER}\" "), 1))
    }

    /// The width of one chart.
    fn width(&self) -> u32 {
        WIDTH / self.columns as u32
    }

    fn height(&self, row: &[Chart]) -> u32 {
        let chart = if self.columns == 1 { ALONE } else { BESIDE };
        let title = if row.iter().all(|chart| chart.title.is_empty()) { 0 } else { TITLE };
        let legend = row.iter().map(|chart| legend_rows(chart, self.width())).max().unwrap_or(0);
        chart + title + ROW * legend as u32 + 2 * MARGIN
    }

    fn draw(&self, text: &mut String, size: (u32, u32), rows: &[u32]) -> Drawn {
        let root = SVGBackend::with_string(text, size).into_drawing_area();
        root.fill(&WHITE)?;
        let mut rest = root.clone();
        for (charts, height) in self.charts.chunks(self.columns).zip(rows) {
            let (row, below) = rest.split_vertically(*height);
            rest = below;
            let titled = charts.iter().any(|chart| !chart.title.is_empty());
            for (area, chart) in row.split_evenly((1, self.columns)).iter().zip(charts) {
                let legend = legend_rows(chart, self.width()) as u32;
                let legends = charts.iter().map(|chart| legend_rows(chart, self.width())).max().unwrap_or(0) as u32;
                let title = if titled { TITLE } else { 0 };
                let (head, body) = area.split_vertically(title);
                head.draw(&Text::new(chart.title.clone(), ((LEFT + MARGIN) as i32, (10 * FINE) as i32), font(16)))?;
                let (plot, foot) = body.split_vertically(height - title - ROW * legends - MARGIN);
                draw_chart(&plot, chart)?;
                if legend > 0 {
                    draw_legend(&foot, chart, self.width())?;
                }
            }
        }
        root.present()?;
        Ok(())
    }
}

impl Chart {
    fn check(&self) -> Result<()> {
        for series in &self.series {
            let fine = |place: &[f64; 2]| self.x.place(place[0]).is_finite() && self.y.place(place[1]).is_finite();
            if let Some(place) = series.shape.points().iter().find(|place| !fine(place)) {
                return Err(Error::Unsupported(format!("cannot draw `{}` at ({}, {})", series.label, place[0], place[1])));
            }
        }
        self.extents().map(drop)
    }

    fn extents(&self) -> Result<[Range<f64>; 2]> {
        let along = |axis: &Axis, k: usize| axis.extent(self.series.iter().flat_map(|series| series.shape.points()).map(|place| place[k]));
        Ok([along(&self.x, 0)?, along(&self.y, 1)?])
    }
}

/// Both ranges with a unit of the same length, the narrower one widened about its middle.
fn levelled([x, y]: [Range<f64>; 2], area: &Area) -> [Range<f64>; 2] {
    let (width, height) = area.dim_in_pixel();
    let (width, height) = (f64::from(width - LEFT - 2 * MARGIN), f64::from(height - BOTTOM - 2 * MARGIN));
    let unit = ((x.end - x.start) / width).max((y.end - y.start) / height);
    let widened = |range: Range<f64>, size: f64| {
        let extra = (unit * size - (range.end - range.start)) / 2.0;
        range.start - extra..range.end + extra
    };
    [widened(x, width), widened(y, height)]
}

fn draw_chart(area: &Area, chart: &Chart) -> Drawn {
    let extents = chart.extents()?;
    let [x, y] = if chart.equal { levelled(extents, area) } else { extents };
    let marked = |axis: &Axis, range: &Range<f64>| Marked { inner: range.clone().into(), marks: axis.marks(range) };
    let mut paper = ChartBuilder::on(area)
        .margin(MARGIN)
        .set_label_area_size(LabelAreaPosition::Left, LEFT)
        .set_label_area_size(LabelAreaPosition::Bottom, BOTTOM)
        .build_cartesian_2d(marked(&chart.x, &x), marked(&chart.y, &y))?;
    let window = Window { axes: [&chart.x, &chart.y], x: &x, y: &y };
    let (filled, drawn): (Vec<_>, Vec<_>) =
        chart.series.iter().partition(|series| matches!(series.shape, Shape::Region(_) | Shape::Cells(_)));
    for series in filled {
        draw_series(&mut paper, series, &window)?;
    }
    let (across, up) = (|place: &f64| chart.x.number(*place, &x), |place: &f64| chart.y.number(*place, &y));
    let mut mesh = paper.configure_mesh();
    mesh.label_style(font(13)).axis_desc_style(font(15)).light_line_style(TRANSPARENT).set_all_tick_mark_size(4 * FINE);
    mesh.bold_line_style(GRID.stroke_width(FINE)).axis_style(BLACK.stroke_width(FINE));
    mesh.x_label_formatter(&across).y_label_formatter(&up).x_desc(chart.x.label.as_str()).y_desc(chart.y.label.as_str());
    mesh.draw()?;
    for series in drawn {
        draw_series(&mut paper, series, &window)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Ink, Series};

    fn chart(shape: Shape) -> Chart {
        let (x, y) = (Axis::linear("x [m]").within(-0.1, 2.1), Axis::linear("y [N]").within(-0.1, 2.1));
        Chart::new(x, y, vec![Series::new("a thing", Ink::of(1), shape)])
    }

    #[test]
    fn every_shape_is_drawn_and_named() {
        let (pair, points) = (vec![[[0.0, 0.0], [1.0, 2.0]]], vec![[0.0, 0.0], [1.0, 2.0], [0.5, 0.1]]);
        let shapes = [
            (Shape::Line(points.clone()), Shape::Line(Vec::new())),
            (Shape::Dots(points.clone()), Shape::Dots(Vec::new())),
            (Shape::Region(points), Shape::Region(Vec::new())),
            (Shape::Cells(pair.clone()), Shape::Cells(Vec::new())),
            (Shape::Arrows(pair), Shape::Arrows(Vec::new())),
            (Shape::Words(vec![([0.0, 0.0], "stick".into())]), Shape::Words(Vec::new())),
        ];
        let drawn = |shape: &Shape| Sheet::column(vec![chart(shape.clone()).titled("Above")]).svg().expect("finite points");
        for (shape, nothing) in shapes {
            let (text, without) = (drawn(&shape), drawn(&nothing));
            assert!(["x [m]", "y [N]", "a thing", "Above"].iter().all(|word| text.contains(word)), "{shape:?}");
            let elements = |text: &str| ["<p", "<rect", "stick"].iter().map(|name| text.matches(name).count()).sum::<usize>();
            assert!(elements(&text) > elements(&without), "{shape:?}");
        }
    }

    #[test]
    fn a_place_without_a_logarithm_and_one_that_is_not_finite_are_refused() {
        let mut logarithmic = chart(Shape::Line(vec![[0.0, 1.0], [1.0, 1.0]]));
        assert!(Sheet::column(vec![logarithmic.clone()]).svg().is_ok());
        logarithmic.x = Axis::logarithmic("x [m]");
        assert!(Sheet::column(vec![logarithmic]).svg().is_err());
        assert!(Sheet::column(vec![chart(Shape::Dots(vec![[f64::NAN, 1.0]]))]).svg().is_err());
    }

    #[test]
    fn what_is_outside_of_the_ranges_is_not_drawn() {
        let mut narrow = chart(Shape::Dots(vec![[0.0, 0.0], [1.0, 1.0]]));
        let circles = |chart: &Chart| Sheet::column(vec![chart.clone()]).svg().expect("finite").matches("<polygon").count();
        let all = circles(&narrow);
        narrow.x = narrow.x.within(-0.5, 0.5);
        assert_eq!(circles(&narrow), all - 1);
    }

    #[test]
    fn a_unit_is_as_long_on_both_axes_where_it_should_be() {
        let area_of = |text: &mut String, judge: &dyn Fn(&Area)| judge(&SVGBackend::with_string(text, (WIDTH, ALONE)).into_drawing_area());
        area_of(&mut String::new(), &|area| {
            let [x, y] = levelled([0.0..1.0, 0.0..1.0], area);
            let (width, height) = (f64::from(WIDTH - LEFT - 2 * MARGIN), f64::from(ALONE - BOTTOM - 2 * MARGIN));
            let ratio = (x.end - x.start) / width / ((y.end - y.start) / height);
            assert!((ratio - 1.0).abs() <= 8.0 * f64::EPSILON && (y.end - y.start - 1.0).abs() <= 8.0 * f64::EPSILON);
        });
    }
}
