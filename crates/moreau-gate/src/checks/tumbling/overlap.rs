//! How deep boxes are in the floor and in each other.
//!
//! ```text
//!     floor    −min over corners of  n·x − c
//!     boxes    min over the 15 axes a of separation   Σ_i |a·e_i| h_i (both boxes) − |a·(x₁ − x₂)| ,   ‖a‖ = 1
//! ```
//! The axes are the three face normals of each box and the nine cross products of their edges; the smallest overlap along them is the
//! distance by which one convex box must move to leave the other.

use crate::checks::motion::Sample;
use nalgebra::Vector3;

/// A box where it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    /// Its state.
    pub state: Sample,
    /// Half extents \[m\].
    pub half: [f64; 3],
}

impl Placed {
    fn axes(&self) -> [Vector3<f64>; 3] {
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| self.state.rotation * axis)
    }

    /// From the centre to the eight corners \[m\], world frame.
    pub fn corners(&self) -> impl Iterator<Item = Vector3<f64>> {
        let (state, half) = (self.state, self.half);
        (0..8).map(move |k| {
            let sign = |axis: usize| if k >> axis & 1 == 0 { 1.0 } else { -1.0 };
            state.rotation * Vector3::from_fn(|axis, _| sign(axis) * half[axis])
        })
    }

    /// Height \[m\] of the lowest corner over the floor z = 0.
    pub fn lowest(&self) -> f64 {
        self.corners().map(|corner| self.state.position.z + corner.z).fold(f64::INFINITY, f64::min)
    }

    /// Half the extent \[m\] along a direction.
    fn extent(&self, direction: &Vector3<f64>) -> f64 {
        self.axes().iter().zip(self.half).map(|(axis, half)| axis.dot(direction).abs() * half).sum()
    }
}

/// Depth \[m\] of two boxes in each other; negative along the axis that separates them best if they are apart.
pub(super) fn overlap(one: &Placed, other: &Placed) -> f64 {
    let (own, others) = (one.axes(), other.axes());
    let edges = own.iter().flat_map(|a| others.iter().map(move |b| a.cross(b)));
    let faces = own.iter().chain(&others).copied();
    let apart = one.state.position - other.state.position;
    let along = |axis: Vector3<f64>| {
        // Parallel edges span no axis; the face normals cover that case.
        let axis = axis.try_normalize(crate::tolerance::tumbling::PARALLEL)?;
        Some(one.extent(&axis) + other.extent(&axis) - axis.dot(&apart).abs())
    };
    faces.chain(edges).filter_map(along).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use nalgebra::UnitQuaternion;

    fn placed(half: [f64; 3], position: [f64; 3], turn: Vector3<f64>) -> Placed {
        let state = Sample {
            position: position.into(),
            rotation: UnitQuaternion::from_scaled_axis(turn),
            velocity: Vector3::zeros(),
            spin: Vector3::zeros(),
        };
        Placed { state, half }
    }

    #[test]
    fn upright_boxes_overlap_by_the_smallest_of_three_intervals() {
        let one = placed([1.0, 2.0, 3.0], [0.0; 3], Vector3::zeros());
        let other = placed([1.0, 1.0, 1.0], [1.5, 0.5, 3.75], Vector3::zeros());
        assert!((overlap(&one, &other) - 0.25).abs() <= rounding(32, 4.0));
        let apart = placed([1.0, 1.0, 1.0], [1.5, 0.5, 4.5], Vector3::zeros());
        assert!((overlap(&one, &apart) + 0.5).abs() <= rounding(32, 4.0));
    }

    #[test]
    fn an_edge_across_an_edge_is_measured_along_their_cross_product() {
        let quarter = std::f64::consts::FRAC_PI_4;
        let low = placed([1.0; 3], [0.0; 3], Vector3::new(quarter, 0.0, 0.0));
        let height = 2.0 * 2f64.sqrt() - 0.125;
        let high = placed([1.0; 3], [0.0, 0.0, height], Vector3::new(0.0, quarter, 0.0));
        assert!((overlap(&low, &high) - 0.125).abs() <= rounding(64, 4.0));
    }

    #[test]
    fn the_lowest_corner_of_a_cube_on_its_tip_is_a_half_diagonal_down() {
        let axis = Vector3::new(1.0, -1.0, 0.0).normalize() * (1.0 / 3f64.sqrt()).acos();
        let cube = placed([1.0; 3], [0.0, 0.0, 2.0], axis);
        assert!((cube.lowest() - (2.0 - 3f64.sqrt())).abs() <= rounding(64, 4.0), "{}", cube.lowest());
    }
}
