//! How a series is drawn: colour, dash and mark, so that none needs colour to be told apart.

use super::paper::{COLOURS, EXACT_COLOUR, FINE};
use plotters::prelude::*;

/// The sign at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A filled disk.
    Disk,
    /// A filled triangle.
    Triangle,
    /// A cross.
    Cross,
    /// A filled square.
    Square,
    /// A circle.
    Circle,
}

/// Colour, dash and mark of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    colour: RGBColor,
    width: u32,
    /// Dash and gap in screen points; `None` draws through.
    pub(super) dash: Option<(u32, u32)>,
    /// The sign of its points.
    pub(super) mark: Mark,
}

/// Dash and gap in screen points.
const DASHES: [Option<(u32, u32)>; 5] = [None, Some((9, 4)), Some((2, 3)), Some((16, 6)), Some((5, 9))];
const MARKS: [Mark; 5] = [Mark::Disk, Mark::Triangle, Mark::Cross, Mark::Square, Mark::Circle];
/// Ends of the scale of [`Ink::shade`].
const LIGHT: RGBColor = RGBColor(238, 244, 250);
const DARK: RGBColor = RGBColor(8, 48, 107);

impl Ink {
    /// The k-th ink of a chart: its own colour, dash and mark.
    pub fn of(k: usize) -> Self {
        Ink { colour: COLOURS[k % COLOURS.len()], width: FINE * 3 / 2, dash: DASHES[k % DASHES.len()], mark: MARKS[k % MARKS.len()] }
    }

    /// A broad grey line, of what is exact.
    pub fn exact() -> Self {
        Ink { colour: EXACT_COLOUR, width: 5 * FINE, dash: None, mark: Mark::Disk }
    }

    /// Thin and black: axes, outlines and words.
    pub fn thin() -> Self {
        Ink { colour: RGBColor(60, 60, 60), width: FINE, dash: None, mark: Mark::Disk }
    }

    /// The k-th of n shades from light to dark.
    pub fn shade(k: usize, n: usize) -> Self {
        let share = k as f64 / n.saturating_sub(1).max(1) as f64;
        let mixed = |light: u8, dark: u8| (f64::from(light) + share * (f64::from(dark) - f64::from(light))).round() as u8;
        let colour = RGBColor(mixed(LIGHT.0, DARK.0), mixed(LIGHT.1, DARK.1), mixed(LIGHT.2, DARK.2));
        Ink { colour, ..Ink::thin() }
    }

    /// The same with another sign at its points.
    pub fn marked(self, mark: Mark) -> Self {
        Ink { mark, ..self }
    }

    /// The same, drawn through.
    pub fn solid(self) -> Self {
        Ink { dash: None, ..self }
    }

    pub(super) fn line(&self) -> ShapeStyle {
        self.colour.stroke_width(self.width)
    }

    pub(super) fn filled(&self) -> ShapeStyle {
        self.colour.filled()
    }

    /// So light that words stand on it.
    pub(super) fn wash(&self) -> ShapeStyle {
        self.colour.mix(0.22).filled()
    }
}
