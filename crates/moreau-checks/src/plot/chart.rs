//! A chart in the plane: two axes and what is drawn between them.

use super::axis::Axis;
use super::ink::Ink;

/// What a series consists of, in the units of its axes.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A curve through points.
    Line(Vec<[f64; 2]>),
    /// Single points.
    Dots(Vec<[f64; 2]>),
    /// A polygon, lightly filled.
    Region(Vec<[f64; 2]>),
    /// Rectangles by two opposite corners, fully filled.
    Cells(Vec<[[f64; 2]; 2]>),
    /// Arrows from the first point to the second.
    Arrows(Vec<[[f64; 2]; 2]>),
    /// Words, centred at their points.
    Words(Vec<([f64; 2], String)>),
}

impl Shape {
    /// All its points.
    pub fn points(&self) -> Vec<[f64; 2]> {
        match self {
            Shape::Line(points) | Shape::Dots(points) | Shape::Region(points) => points.clone(),
            Shape::Cells(pairs) | Shape::Arrows(pairs) => pairs.as_flattened().to_vec(),
            Shape::Words(words) => words.iter().map(|(place, _)| *place).collect(),
        }
    }
}

/// One thing of a chart with its row in the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend; without one it has no row.
    pub label: String,
    /// What it consists of.
    pub shape: Shape,
    /// How it is drawn.
    pub ink: Ink,
}

impl Series {
    /// A series.
    pub fn new(label: impl Into<String>, ink: Ink, shape: Shape) -> Self {
        Series { label: label.into(), shape, ink }
    }

    /// A curve in the k-th ink.
    pub fn line(k: usize, label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Series::new(label, Ink::of(k), Shape::Line(points))
    }

    /// Points in the k-th ink.
    pub fn dots(k: usize, label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Series::new(label, Ink::of(k), Shape::Dots(points))
    }

    /// What is exact, as a broad grey curve.
    pub fn exact(label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Series::new(label, Ink::exact(), Shape::Line(points))
    }

    /// Words at their places, without a row in the legend.
    pub fn words(words: Vec<([f64; 2], String)>) -> Self {
        Series::new("", Ink::thin(), Shape::Words(words))
    }
}

/// Two axes and the series between them; what comes later lies on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What is above it, if anything.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Whether a unit is as long on both axes.
    pub equal: bool,
    /// What is drawn.
    pub series: Vec<Series>,
}

impl Chart {
    /// A chart without title, each axis with its own scale.
    pub fn new(x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Chart { title: String::new(), x, y, equal: false, series }
    }

    /// The same under a title.
    pub fn titled(self, title: impl Into<String>) -> Self {
        Chart { title: title.into(), ..self }
    }

    /// The same with a unit as long on both axes.
    pub fn with_equal_scales(self) -> Self {
        Chart { equal: true, ..self }
    }
}
