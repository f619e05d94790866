//! Pictures: panels of curves over time as SVG, legends beside the panels so that they cover nothing.

use moreau_exact::number::significant;
use moreau_exact::tolerance::EPSILON;
use moreau_exact::{Error, Result};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::ops::Range;

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

/// Lengths below are in screen points times this: the backend rounds to whole units, which would show as steps.
const FINE: u32 = 8;
const WIDTH: u32 = 960 * FINE;
const PANEL_HEIGHT: u32 = 260 * FINE;
const TITLE_HEIGHT: u32 = 44 * FINE;
const LEGEND_WIDTH: u32 = 190 * FINE;
const LEGEND_ROWS: usize = 11;
/// Points per curve that a picture of this width can show.
const POINTS: usize = 2 * 960;
/// Colours that stay apart for colour-blind readers (Okabe and Ito, with their black lightened).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(70, 70, 70),
];
const GRID: RGBColor = RGBColor(225, 225, 225);
const EXACT_COLOUR: RGBColor = RGBColor(190, 190, 190);

/// Panels below each other with a common time axis, as the text of an SVG file.
///
/// # Errors
/// A point that is not finite, or a failure of the drawing backend.
pub fn svg(title: &str, panels: &[Panel]) -> Result<String> {
    let points = || panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.points);
    if points().any(|(time, value)| !time.is_finite() || !value.is_finite()) {
        return Err(Error::Unsupported("cannot draw a curve with a point that is not finite".into()));
    }
    let times = span(points().map(|point| point.0), 0.0);
    let mut text = String::new();
    draw(&mut text, title, panels, times).map_err(|error| Error::Unsupported(format!("cannot draw the picture: {error}")))?;
    Ok(on_screen(&text, TITLE_HEIGHT + PANEL_HEIGHT * panels.len() as u32))
}

/// The picture at its size in screen points; its view box stays fine.
fn on_screen(text: &str, height: u32) -> String {
    let size = |width: u32, height: u32| format!("<svg width=\"{width}\" height=\"{height}\"");
    text.replacen(&size(WIDTH, height), &size(WIDTH / FINE, height / FINE), 1)
}

fn font(points: u32) -> (&'static str, u32) {
    ("sans-serif", points * FINE)
}

type Drawn = std::result::Result<(), Box<dyn std::error::Error>>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn draw(text: &mut String, title: &str, panels: &[Panel], times: Range<f64>) -> Drawn {
    let height = TITLE_HEIGHT + PANEL_HEIGHT * panels.len() as u32;
    let root = SVGBackend::with_string(text, (WIDTH, height)).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(TITLE_HEIGHT);
    head.draw(&Text::new(title.to_string(), (16 * FINE as i32, 12 * FINE as i32), font(20)))?;
    for (k, (area, panel)) in body.split_evenly((panels.len(), 1)).iter().zip(panels).enumerate() {
        let (chart, legend) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
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
        chart.draw_series(LineSeries::new(thinned(&curve.points), style))?;
    }
    Ok(())
}

/// One row per computed curve and one for all closed forms, as many as there is room for.
fn draw_legend(area: &Area, panel: &Panel) -> Drawn {
    let first_exact = panel.curves.iter().position(|curve| curve.role == Role::ClosedForm);
    let rows = panel.curves.iter().zip(styles(panel)).enumerate();
    let rows = rows.filter(|(k, (curve, _))| curve.role == Role::Computed || Some(*k) == first_exact);
    for (row, (_, (curve, style))) in rows.take(LEGEND_ROWS).enumerate() {
        let place = |x: i32, y: i32| (x * FINE as i32, (20 + 22 * row as i32 + y) * FINE as i32);
        area.draw(&PathElement::new(vec![place(4, 0), place(32, 0)], style))?;
        area.draw(&Text::new(curve.label.clone(), place(40, -8), font(14)))?;
    }
    Ok(())
}

fn styles(panel: &Panel) -> impl Iterator<Item = ShapeStyle> {
    let mut computed = 0;
    panel.curves.iter().map(move |curve| match curve.role {
        Role::ClosedForm => EXACT_COLOUR.stroke_width(5 * FINE),
        Role::Computed => {
            computed += 1;
            COLOURS[(computed - 1) % COLOURS.len()].stroke_width(FINE + FINE / 4)
        }
    })
}

/// The range of some values, widened by a share on both sides; a range far narrower than the values themselves is
/// rounding, and is shown as the straight line it means.
fn span(values: impl Iterator<Item = f64>, margin: f64) -> Range<f64> {
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
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
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

    #[test]
    fn a_point_that_is_not_finite_is_refused() {
        assert!(svg("x", &[panel(vec![(0.0, f64::NAN)])]).is_err());
        assert!(svg("x", &[panel(vec![(f64::INFINITY, 0.0)])]).is_err());
    }

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
