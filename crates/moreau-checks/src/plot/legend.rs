//! The legend under a chart: one row or more of samples with their names.

use super::chart::{Chart, Series, Shape};
use super::ink::{Ink, Mark};
use super::paper::{Area, Drawn, FINE, LEFT, font};
use super::series::MARK;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// A row of the legend.
pub(super) const ROW: u32 = 20 * FINE;
/// What a row of the legend has beside its label, and how wide a character is at most.
const SAMPLE: u32 = 54 * FINE;
const CHARACTER: u32 = 7 * FINE;

/// The series with a row in the legend.
fn named(chart: &Chart) -> impl Iterator<Item = &Series> {
    chart.series.iter().filter(|series| !series.label.is_empty())
}

/// How many labels stand beside each other in a legend.
fn legend_columns(chart: &Chart, width: u32) -> usize {
    let widest = named(chart).map(|series| series.label.chars().count()).max().unwrap_or(0) as u32;
    ((width - LEFT) / (SAMPLE + CHARACTER * widest)).max(1) as usize
}

pub(super) fn legend_rows(chart: &Chart, width: u32) -> usize {
    named(chart).count().div_ceil(legend_columns(chart, width))
}

pub(super) fn draw_legend(area: &Area, chart: &Chart, width: u32) -> Drawn {
    let columns = legend_columns(chart, width);
    let room = (width - LEFT) / columns as u32;
    for (k, series) in named(chart).enumerate() {
        let (x, y) = ((LEFT + room * (k % columns) as u32) as i32, (ROW * (k / columns) as u32 + ROW / 2) as i32);
        let place = |dx: i32, dy: i32| (x + dx * FINE as i32, y + dy * FINE as i32);
        draw_sample(area, series, [place(2, 0), place(38, 0)])?;
        area.draw(&Text::new(series.label.clone(), place(46, 0), TextStyle::from(font(13)).pos(Pos::new(HPos::Left, VPos::Center))))?;
    }
    Ok(())
}

fn draw_sample(area: &Area, series: &Series, [from, to]: [(i32, i32); 2]) -> Drawn {
    let (ink, middle) = (&series.ink, ((from.0 + to.0) / 2, from.1));
    let side = (5 * FINE) as i32;
    let corners = [(from.0, from.1 - side), (to.0, from.1 + side)];
    match (&series.shape, ink.dash) {
        (Shape::Line(_) | Shape::Arrows(_), None) => area.draw(&PathElement::new(vec![from, to], ink.line()))?,
        (Shape::Line(_) | Shape::Arrows(_), Some((dash, gap))) => {
            area.draw(&DashedPathElement::new(vec![from, to], dash * FINE, gap * FINE, ink.line()))?;
        }
        (Shape::Region(_), _) => area.draw(&Rectangle::new(corners, ink.wash()))?,
        (Shape::Cells(_), _) => area.draw(&Rectangle::new(corners, ink.filled()))?,
        (Shape::Dots(_), _) => draw_mark(area, middle, ink)?,
        (Shape::Words(_), _) => {}
    }
    Ok(())
}

fn draw_mark(area: &Area, place: (i32, i32), ink: &Ink) -> Drawn {
    let side = MARK as i32 * 7 / 8;
    match ink.mark {
        Mark::Disk => area.draw(&plotters::element::Circle::new(place, MARK, ink.filled()))?,
        Mark::Circle => area.draw(&plotters::element::Circle::new(place, MARK, ink.line()))?,
        Mark::Triangle => area.draw(&TriangleMarker::new(place, MARK + FINE, ink.filled()))?,
        Mark::Cross => area.draw(&Cross::new(place, MARK, ink.line()))?,
        Mark::Square => area.draw(&(EmptyElement::at(place) + Rectangle::new([(-side, -side), (side, side)], ink.filled())))?,
    }
    Ok(())
}
