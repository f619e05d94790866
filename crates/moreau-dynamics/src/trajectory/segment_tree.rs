//! A tree of bounding boxes over the segments of a polyline: the nearest segment in logarithmic time.

/// A point of the plane.
pub(crate) type Point = [f64; 2];

/// An axis-parallel box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundingBox {
    low: Point,
    high: Point,
}

/// Bounding boxes over ranges of consecutive segments; node 0 is the root, the children of a range are its halves.
pub(crate) struct SegmentTree {
    points: Vec<Point>,
    nodes: Vec<Node>,
}

struct Node {
    /// The segments first … last − 1.
    first: usize,
    last: usize,
    bounds: BoundingBox,
    /// Index of the left child; the right child is given apart.
    children: Option<[usize; 2]>,
}

impl SegmentTree {
    /// The tree of a polyline with at least one point; a single point is a segment of length zero.
    pub(crate) fn new(points: &[Point]) -> Self {
        let mut points = points.to_vec();
        if points.len() == 1 {
            points.push(points[0]);
        }
        let segments = points.len() - 1;
        let mut tree = SegmentTree { points, nodes: Vec::with_capacity(2 * segments) };
        tree.build(0, segments);
        tree
    }

    fn build(&mut self, first: usize, last: usize) -> usize {
        let index = self.nodes.len();
        let bounds = BoundingBox::of(&self.points[first..=last]);
        self.nodes.push(Node { first, last, bounds, children: None });
        if last - first > 1 {
            let middle = first.midpoint(last);
            let left = self.build(first, middle);
            let right = self.build(middle, last);
            self.nodes[index].children = Some([left, right]);
        }
        index
    }

    /// The box of the whole polyline.
    pub(crate) fn root_box(&self) -> BoundingBox {
        self.nodes[0].bounds
    }

    /// The box of a node.
    pub(crate) fn bounding_box(&self, node: usize) -> BoundingBox {
        self.nodes[node].bounds
    }

    /// A point of the polyline inside a node.
    pub(crate) fn first_point(&self, node: usize) -> Point {
        self.points[self.nodes[node].first]
    }

    /// The children of a node, or the one segment it holds.
    pub(crate) fn children(&self, node: usize) -> Result<[usize; 2], (Point, Point)> {
        let node = &self.nodes[node];
        node.children.ok_or((self.points[node.first], self.points[node.last]))
    }

    /// Distance from a point to the polyline, and the segment that attains it.
    pub(crate) fn nearest(&self, point: Point) -> (f64, [Point; 2]) {
        let mut best = (f64::INFINITY, [self.points[0], self.points[1]]);
        let mut stack = vec![(self.nodes[0].bounds.distance(point), 0)];
        while let Some((bound, index)) = stack.pop() {
            if bound >= best.0 {
                continue;
            }
            let node = &self.nodes[index];
            match node.children {
                None => {
                    let segment = [self.points[node.first], self.points[node.last]];
                    let distance = distance_to_segment(point, segment);
                    if distance < best.0 {
                        best = (distance, segment);
                    }
                }
                Some(children) => {
                    let [a, b] = children.map(|child| (self.nodes[child].bounds.distance(point), child));
                    let (near, far) = if a.0 <= b.0 { (a, b) } else { (b, a) };
                    stack.push(far);
                    stack.push(near);
                }
            }
        }
        best
    }
}

impl BoundingBox {
    fn of(points: &[Point]) -> Self {
        let mut bounds = BoundingBox { low: points[0], high: points[0] };
        for [t, y] in points {
            bounds.low = [bounds.low[0].min(*t), bounds.low[1].min(*y)];
            bounds.high = [bounds.high[0].max(*t), bounds.high[1].max(*y)];
        }
        bounds
    }

    fn distance(&self, point: Point) -> f64 {
        let outside = |axis: usize| (self.low[axis] - point[axis]).max(point[axis] - self.high[axis]).max(0.0);
        outside(0).hypot(outside(1))
    }

    /// The four corners.
    pub(crate) fn corners(&self) -> [Point; 4] {
        [self.low, self.high, [self.low[0], self.high[1]], [self.high[0], self.low[1]]]
    }

    /// The largest absolute coordinate.
    pub(crate) fn magnitude(&self) -> f64 {
        self.corners().iter().flatten().fold(0.0, |largest, x| x.abs().max(largest))
    }
}

/// Euclidean distance from a point to a segment.
pub(crate) fn distance_to_segment(point: Point, [start, end]: [Point; 2]) -> f64 {
    let (along, from) = ([end[0] - start[0], end[1] - start[1]], [point[0] - start[0], point[1] - start[1]]);
    let length = along[0] * along[0] + along[1] * along[1];
    let s = if length > 0.0 { ((from[0] * along[0] + from[1] * along[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    (from[0] - s * along[0]).hypot(from[1] - s * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_segment_agrees_with_a_full_search() {
        let points: Vec<Point> = (0..57).map(|k| [k as f64, ((k * k) % 13) as f64]).collect();
        let tree = SegmentTree::new(&points);
        for k in 0..200 {
            let point = [0.31 * k as f64, ((k * 7) % 17) as f64 - 2.0];
            let full = points.windows(2).map(|s| distance_to_segment(point, [s[0], s[1]])).fold(f64::INFINITY, f64::min);
            assert_eq!(tree.nearest(point).0, full);
        }
    }

    #[test]
    fn distance_to_a_segment_in_its_three_regions() {
        let segment = [[0.0, 0.0], [2.0, 0.0]];
        assert_eq!(distance_to_segment([1.0, 3.0], segment), 3.0);
        assert_eq!(distance_to_segment([-3.0, 4.0], segment), 5.0);
        assert_eq!(distance_to_segment([5.0, -4.0], segment), 5.0);
        assert_eq!(distance_to_segment([3.0, 4.0], [[0.0, 0.0], [0.0, 0.0]]), 5.0);
    }
}
