//! A measured quantity against the time step, both logarithmic, as an SVG picture: measured blue, allowed by the ideal grey, the declared
//! law's own deviation orange.

use crate::CheckOutcome;
use moreau_exact::{Error, Result};
use plotters::prelude::*;

const SIZE: (u32, u32) = (520, 260);
const MEASURED: RGBColor = RGBColor(0, 114, 178);
const ALLOWED: RGBColor = RGBColor(190, 190, 190);
const PREDICTED: RGBColor = RGBColor(213, 94, 0);

/// |value − ideal| of one quantity at every step, with the allowance and the declared law's own deviation.
struct Series {
    measured: Vec<(f64, f64)>,
    allowed: Vec<(f64, f64)>,
    predicted: Vec<(f64, f64)>,
}

/// The picture of one quantity of a check; `None` if fewer than two steps show anything to draw.
///
/// # Errors
/// If the drawing backend fails.
pub fn svg(check: &CheckOutcome, quantity: &str) -> Result<Option<String>> {
    let series = series(check, quantity);
    let points: Vec<(f64, f64)> = [&series.measured, &series.allowed, &series.predicted].into_iter().flatten().copied().collect();
    if series.measured.len() < 2 {
        return Ok(None);
    }
    let mut text = String::new();
    draw(&mut text, quantity, &series, &points).map_err(|error| Error::Unsupported(format!("cannot draw the picture: {error}")))?;
    Ok(Some(text))
}

fn series(check: &CheckOutcome, quantity: &str) -> Series {
    let mut series = Series { measured: Vec::new(), allowed: Vec::new(), predicted: Vec::new() };
    for step in &check.steps {
        let Some(h) = step.time_step else { continue };
        let Some(one) = step.measurements.iter().find(|one| one.quantity == quantity) else { continue };
        let push = |list: &mut Vec<(f64, f64)>, value: f64| {
            if value.is_finite() && value > 0.0 {
                list.push((h, value));
            }
        };
        push(&mut series.measured, one.ideal.miss(one.value));
        push(&mut series.allowed, one.ideal.tolerance);
        push(&mut series.predicted, one.modelling_error());
    }
    for list in [&mut series.measured, &mut series.allowed, &mut series.predicted] {
        list.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    series
}

fn draw(text: &mut String, quantity: &str, series: &Series, points: &[(f64, f64)]) -> std::result::Result<(), Box<dyn std::error::Error>> {
    let range = |values: &mut dyn Iterator<Item = f64>| values.fold((f64::INFINITY, 0.0f64), |(low, high), x| (low.min(x), high.max(x)));
    let (left, right) = range(&mut points.iter().map(|point| point.0));
    let (low, high) = range(&mut points.iter().map(|point| point.1));
    let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(quantity, ("sans-serif", 15))
        .margin(8)
        .x_label_area_size(32)
        .y_label_area_size(64)
        .build_cartesian_2d(((left / 1.5)..(right * 1.5)).log_scale(), ((low / 2.0)..(high * 2.0)).log_scale())?;
    let label = |value: &f64| label(*value, high / low);
    let mut mesh = chart.configure_mesh();
    mesh.light_line_style(WHITE).bold_line_style(ALLOWED.mix(0.5)).x_desc("h [s]").y_desc("deviation from the ideal");
    mesh.y_label_formatter(&label).x_label_formatter(&label).draw()?;
    for (list, colour, width) in [(&series.allowed, ALLOWED, 5), (&series.predicted, PREDICTED, 2), (&series.measured, MEASURED, 2)] {
        chart.draw_series(LineSeries::new(list.iter().copied(), colour.stroke_width(width)))?;
    }
    chart.draw_series(series.measured.iter().map(|point| Circle::new(*point, 3, MEASURED.filled())))?;
    area.present()?;
    Ok(())
}

/// A number on an axis: 1, 2 and 5 times a power of ten, and only the powers where the axis spans many of them.
fn label(value: f64, span: f64) -> String {
    let text = format!("{value:.0e}");
    let shown = text.starts_with('1') || (span < 100.0 && (text.starts_with('2') || text.starts_with('5')));
    if shown { text } else { String::new() }
}
