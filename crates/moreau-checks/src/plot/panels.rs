//! Panels of curves over time, legends beside the panels so that they cover nothing.

use super::paper::{Area, COLOURS, Drawn, EXACT_COLOUR, FINE, GRID, font, span, thinned};
use moreau_exact::number::significant;
use moreau_exact::tolerance::EPSILON;
use moreau_exact::{Error, Result};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::series::DashedLineSeries;
use std::ops::Range;
use textwrap::wrap;

/// Where a curve comes from; it decides how the curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// By a scheme: a thin coloured line.
    Computed,
    /// By a closed form: a broad grey line under the computed ones.
    ClosedForm,
}

/// One line of a panel.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Its name in the legend.
    pub label: String,
    /// Where it comes from.
    pub role: Role,
    /// (time \[s\], value) in order of time.
    pub points: Vec<(f64, f64)>,
}

/// Curves with the same unit.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What the vertical axis shows, with its unit, e.g. `energy [J]`.
    pub axis: String,
    /// Closed forms first, so that computed curves lie on top.
    pub curves: Vec<Curve>,
}

const CHART_WIDTH: u32 = 770 * FINE;
const PANEL_HEIGHT: u32 = 260 * FINE;
const TITLE_HEIGHT: u32 = 44 * FINE;
/// A line of the note under the title.
const NOTE_HEIGHT: u32 = 18 * FINE;
/// A row of the legend, and what stands above the first and below the last.
const ROW_HEIGHT: u32 = 22 * FINE;
const LEGEND_MARGIN: u32 = 18 * FINE;
/// The least width of the legend, and what a row has beside its label, whose characters are at most so wide.
const LEGEND_WIDTH: u32 = 190 * FINE;
const LEGEND_LINE: u32 = 48 * FINE;
const CHARACTER_WIDTH: u32 = 7 * FINE;
/// Rows of the legend; of more curves it tells the number.
const LEGEND_ROWS: usize = 40;
/// Dash and gap of the curves that share a colour, in screen points; the first of them is drawn through.
const DASHES: [Option<(u32, u32)>; 4] = [None, Some((9, 4)), Some((2, 3)), Some((16, 6))];
/// Panels below each other with a common time axis, as the text of an SVG file.
///
/// # Errors
/// A point that is not finite, or a failure of the drawing backend.
pub fn svg(title: &str, panels: &[Panel]) -> Result<String> {
    svg_with_note(title, "", panels)
}

/// The same with a note under the title.
///
/// # Errors
/// As [`svg`].
pub fn svg_with_note(title: &str, note: &str, panels: &[Panel]) -> Result<String> {
    let points = || panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.points);
    if points().any(|(time, value)| !time.is_finite() || !value.is_finite()) {
        return Err(Error::Unsupported("cannot draw a curve with a point that is not finite".into()));
    }
    let times = span(points().map(|point| point.0), 0.0);
    let size = Size::of(note, panels);
    let mut text = String::new();
    draw(&mut text, title, &size, panels, times).map_err(|error| Error::Unsupported(format!("cannot draw the picture: {error}")))?;
    Ok(size.on_screen(&text))
}

/// How large the parts of a picture are; the legends have room for all their rows.
struct Size {
    note: Vec<String>,
    head: u32,
    panel: u32,
    legend: u32,
    panels: u32,
}

impl Size {
    fn of(note: &str, panels: &[Panel]) -> Self {
        let rows = panels.iter().map(|panel| legend(panel).len()).max().unwrap_or(0);
        let labels = panels.iter().flat_map(legend).map(|(label, _)| label.chars().count()).max().unwrap_or(0);
        let legend = LEGEND_WIDTH.max(LEGEND_LINE + CHARACTER_WIDTH * labels as u32);
        let line = ((CHART_WIDTH + legend) / CHARACTER_WIDTH) as usize;
        let note: Vec<String> = if note.is_empty() { Vec::new() } else { wrap(note, line).iter().map(ToString::to_string).collect() };
        Size {
            head: TITLE_HEIGHT + NOTE_HEIGHT * note.len() as u32,
            note,
            panel: PANEL_HEIGHT.max(LEGEND_MARGIN + ROW_HEIGHT * rows as u32),
            legend,
            panels: panels.len() as u32,
        }
    }

    fn whole(&self) -> (u32, u32) {
        (CHART_WIDTH + self.legend, self.head + self.panel * self.panels)
    }

    /// The picture at its size in screen points; its view box stays fine.
    fn on_screen(&self, text: &str) -> String {
        let (width, height) = self.whole();
        let size = |width: u32, height: u32| format!("<svg width=\"{width}\" height=\"{height}\"");
        text.replacen(&size(width, height), &size(width / FINE, height / FINE), 1)
    }
}

fn draw(text: &mut String, title: &str, size: &Size, panels: &[Panel], times: Range<f64>) -> Drawn {
    let root = SVGBackend::with_string(text, size.whole()).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(size.head);
    head.draw(&Text::new(title.to_string(), (16 * FINE as i32, 12 * FINE as i32), font(20)))?;
    for (k, line) in size.note.iter().enumerate() {
        let place = (16 * FINE as i32, (38 * FINE + NOTE_HEIGHT * k as u32) as i32);
        head.draw(&Text::new(line.clone(), place, font(13)))?;
    }
    for (k, (area, panel)) in body.split_evenly((panels.len(), 1)).iter().zip(panels).enumerate() {
        let (chart, legend) = area.split_horizontally(CHART_WIDTH);
        draw_curves(&chart, panel, times.clone(), k + 1 == panels.len())?;
        draw_legend(&legend, panel)?;
    }
    root.present()?;
    Ok(())
}

fn draw_curves(area: &Area, panel: &Panel, times: Range<f64>, last: bool) -> Drawn {
    let values = span(panel.curves.iter().flat_map(|curve| &curve.points).map(|point| point.1), 0.05);
    let mut chart = ChartBuilder::on(area)
        .margin(8 * FINE)
        .set_label_area_size(LabelAreaPosition::Left, 84 * FINE)
        .set_label_area_size(LabelAreaPosition::Bottom, 44 * FINE)
        .build_cartesian_2d(times, values.clone())?;
    let negligible = EPSILON * 16.0 * (values.end - values.start); // what is left where the axis crosses zero
    let number = |value: &f64| significant(if value.abs() <= negligible { 0.0 } else { *value });
    let mut mesh = chart.configure_mesh();
    mesh.label_style(font(14)).axis_desc_style(font(16)).light_line_style(WHITE).set_all_tick_mark_size(5 * FINE);
    mesh.bold_line_style(GRID.stroke_width(FINE)).axis_style(BLACK.stroke_width(FINE));
    mesh.x_label_formatter(&number).y_label_formatter(&number).y_labels(6).y_desc(panel.axis.as_str());
    if last {
        mesh.x_desc("time [s]");
    }
    mesh.draw()?;
    for (curve, style) in panel.curves.iter().zip(styles(panel)) {
        let points = thinned(&curve.points);
        match style.dash {
            None => chart.draw_series(LineSeries::new(points, style.line))?,
            Some((dash, gap)) => chart.draw_series(DashedLineSeries::new(points, dash * FINE, gap * FINE, style.line))?,
        };
    }
    Ok(())
}

/// One row per computed curve and one for all closed forms, each with its line; the last one tells how many more there are.
fn legend(panel: &Panel) -> Vec<(String, Option<Line>)> {
    let first_exact = panel.curves.iter().position(|curve| curve.role == Role::ClosedForm);
    let rows = panel.curves.iter().zip(styles(panel)).enumerate();
    let rows = rows.filter(|(k, (curve, _))| curve.role == Role::Computed || Some(*k) == first_exact);
    let mut rows: Vec<_> = rows.map(|(_, (curve, style))| (curve.label.clone(), Some(style))).collect();
    if rows.len() > LEGEND_ROWS {
        let more = rows.len() - LEGEND_ROWS + 1;
        rows.truncate(LEGEND_ROWS - 1);
        rows.push((format!("and {more} more"), None));
    }
    rows
}

fn draw_legend(area: &Area, panel: &Panel) -> Drawn {
    for (row, (label, line)) in legend(panel).into_iter().enumerate() {
        let place = |x: i32, y: i32| (x * FINE as i32, (20 + 22 * row as i32 + y) * FINE as i32);
        let ends = vec![place(4, 0), place(32, 0)];
        match line {
            Some(Line { line, dash: None }) => area.draw(&PathElement::new(ends, line))?,
            Some(Line { line, dash: Some((dash, gap)) }) => area.draw(&DashedPathElement::new(ends, dash * FINE, gap * FINE, line))?,
            None => {}
        }
        area.draw(&Text::new(label, place(40, -8), font(14)))?;
    }
    Ok(())
}

/// How a curve is drawn.
#[derive(Clone, Copy, PartialEq)]
struct Line {
    line: ShapeStyle,
    dash: Option<(u32, u32)>,
}

/// The lines of a panel's curves: as many computed ones as colours times dashes are told apart.
fn styles(panel: &Panel) -> impl Iterator<Item = Line> {
    let mut computed = 0;
    panel.curves.iter().map(move |curve| match curve.role {
        Role::ClosedForm => Line { line: EXACT_COLOUR.stroke_width(5 * FINE), dash: None },
        Role::Computed => {
            computed += 1;
            let line = COLOURS[(computed - 1) % COLOURS.len()].stroke_width(FINE + FINE / 4);
            Line { line, dash: DASHES[(computed - 1) / COLOURS.len() % DASHES.len()] }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(points: Vec<(f64, f64)>) -> Panel {
        let curve = |label: &str, role| Curve { label: label.into(), role, points: points.clone() };
        Panel { axis: "height [m]".into(), curves: vec![curve("closed form", Role::ClosedForm), curve("computed", Role::Computed)] }
    }

    #[test]
    fn a_picture_names_its_axes_and_curves_and_is_the_same_twice() {
        let draw = || svg("a ball", &[panel(vec![(0.0, 1.0), (1.0, 0.0)])]).expect("two finite points");
        let text = draw();
        for words in ["<svg width=\"960\" height=\"304\"", "a ball", "height [m]", "time [s]", "closed form", "computed", "</svg>"] {
            assert!(text.contains(words), "{words} is missing");
        }
        assert_eq!(text, draw());
    }

    /// A panel of many computed curves.
    fn many(count: usize) -> Panel {
        let curve = |k: usize| Curve { label: format!("body {k} z"), role: Role::Computed, points: vec![(0.0, k as f64), (1.0, 0.5)] };
        Panel { axis: "height [m]".into(), curves: (0..count).map(curve).collect() }
    }

    #[test]
    fn nineteen_curves_are_told_apart_and_all_of_them_are_named() {
        let panel = many(19);
        let lines: Vec<_> = styles(&panel).map(|style| (style.line.color, style.dash)).collect();
        assert!(lines.iter().enumerate().all(|(k, line)| !lines[..k].contains(line)), "each has a colour or dashes of its own");
        let text = svg("a tower", std::slice::from_ref(&panel)).expect("finite points");
        assert!((0..19).all(|k| text.contains(&format!("body {k} z"))) && !text.contains("more"));
        let text = svg("a heap", &[many(LEGEND_ROWS + 5)]).expect("finite points");
        assert!(text.contains("and 6 more") && text.contains("body 38 z") && !text.contains("body 39 z"));
    }

    #[test]
    fn the_legend_has_room_for_its_rows_and_labels() {
        let [few, tall] = [many(3), many(19)].map(|panel| Size::of("", &[panel]));
        assert_eq!((few.panel, few.legend), (PANEL_HEIGHT, LEGEND_WIDTH));
        assert!(tall.panel >= 19 * ROW_HEIGHT);
        let mut named = many(1);
        named.curves[0].label = "moreau-jean-projection: the body at the top x".into();
        assert!(Size::of("", &[named]).legend > LEGEND_LINE + 45 * 6 * FINE, "its label is not cut");
    }

    #[test]
    fn a_note_stands_under_the_title_in_as_many_lines_as_it_needs() {
        let picture = |note: &str| svg_with_note("a ball", note, &[many(1)]).expect("finite points");
        assert_eq!(picture(""), svg("a ball", &[many(1)]).expect("finite points"));
        let text = picture(&"not drawn: box x ".repeat(20));
        assert!(text.contains("not drawn: box x") && text.contains("<svg width=\"960\" height=\"358\""), "{}", &text[..200]);
    }

    #[test]
    fn a_point_that_is_not_finite_is_refused() {
        assert!(svg("x", &[panel(vec![(0.0, f64::NAN)])]).is_err());
        assert!(svg("x", &[panel(vec![(f64::INFINITY, 0.0)])]).is_err());
    }
}
