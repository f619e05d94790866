//! Pictures as SVG: panels of curves over time, and sheets of charts in the plane; legends outside, so that they cover nothing.

mod axis;
mod chart;
mod ink;
mod legend;
mod panels;
mod paper;
mod series;
mod sheet;

pub use axis::{Axis, Scale};
pub use chart::{Chart, Series, Shape};
pub use ink::{Ink, Mark};
pub use panels::{Curve, Panel, Role, svg, svg_with_note};
pub use sheet::Sheet;
