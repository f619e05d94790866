//! The probe of angular velocities: the rotation from sample to sample agrees with the reported angular velocity.
//!
//! ```text
//! log(q_{k+1} q_k⁻¹) / Δt  =  ½ (ω_k + ω_{k+1}) + O(Δt ω²)     in the world frame
//! ```
//! A wrong frame, order or sense of the quaternion, used in and out, leaves the first sample as it should be; it shows here.

use crate::conformance::scenes::tumbling_brick;
use crate::conformance::{Seen, problem};
use crate::tolerance::conformance::{STEP, mean_angular_velocity};
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// One reading of the four numbers of an orientation.
type Reading = fn([f64; 4]) -> UnitQuaternion<f64>;

pub(super) fn frame(trajectory: &Trajectory) -> Seen {
    let track = &trajectory.bodies[0];
    let size = Vector3::from(tumbling_brick().bodies[0].angular_velocity).norm();
    let allowed = mean_angular_velocity(STEP, size);
    let seen = disagreement(track, as_written, false);
    if seen <= allowed {
        return Ok(());
    }
    let cure = if disagreement(track, as_written, true) <= allowed {
        "the angular velocities are in the body frame: turn them by the orientation, coming in and going out"
    } else if disagreement(track, w_last, false) <= allowed || disagreement(track, w_last, true) <= allowed {
        "the engine has quaternions x, y, z, w: put w first going out, and last coming in"
    } else if disagreement(track, inverse, false) <= allowed || disagreement(track, inverse, true) <= allowed {
        "the orientations are from world to body: conjugate them, coming in and going out"
    } else {
        "check the order of the quaternion, its sense (body to world) and the frame of the angular velocity (world), coming in and going \
            out"
    };
    Err(problem(format!("the body turns otherwise than its angular velocity says, by {seen:.2} rad/s of {size:.2} rad/s"), cure))
}

/// The largest difference \[rad/s\] between the turning of the orientation and the mean angular velocity of an interval.
fn disagreement(track: &BodyTrack, read: Reading, in_body: bool) -> f64 {
    let interval = |k: usize| {
        let (first, second) = (read(track.orientation[k]), read(track.orientation[k + 1]));
        let mean = (Vector3::from(track.angular_velocity[k]) + Vector3::from(track.angular_velocity[k + 1])) / 2.0;
        let mean = if in_body { first * mean } else { mean };
        // the shorter way round: q and −q are one rotation
        let turned = (second * first.inverse()).scaled_axis() / STEP;
        (turned - mean).norm()
    };
    (0..track.orientation.len().saturating_sub(1)).map(interval).fold(0.0, f64::max)
}

fn as_written([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

fn w_last([x, y, z, w]: [f64; 4]) -> UnitQuaternion<f64> {
    as_written([w, x, y, z])
}

fn inverse(components: [f64; 4]) -> UnitQuaternion<f64> {
    as_written(components).inverse()
}
