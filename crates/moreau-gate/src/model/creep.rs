//! How fast a body creeps on a slope that would hold it if friction were Coulomb's.
//!
//! ```text
//!     MuJoCo            [`moreau_forms::mujoco_creep`]           independent of h, ∝ 1/impratio
//!     Drake SAP         σ h F_t/Σ 1/w_i                                  ∝ h
//!     Drake regularised v_s s with c(s) = F_t/(μ F_n)                    independent of h
//! ```

use crate::Description;
use crate::description::Friction;
use crate::model::Model;
use crate::model::solid::box_moments;
use moreau_forms::drake_sap::{diagonal_mean, shared_creep};
use moreau_forms::mujoco_creep::HeldBody;
use moreau_forms::regularised_friction::FrictionCurve;
use nalgebra::Vector3;

/// A box that lies flat on its slope, held by its four lower corners.
#[derive(Clone, Debug)]
pub struct HeldBox {
    /// h \[s\].
    pub time_step: f64,
    /// m \[kg\].
    pub mass: f64,
    /// Half the edges \[m\]: down the slope, across, up.
    pub half_extents: [f64; 3],
    /// Unit vectors of these edges in the world.
    pub axes: [Vector3<f64>; 3],
    /// μ.
    pub friction: f64,
    /// g sin α and g cos α \[m/s²\].
    pub pull: f64,
    /// g cos α \[m/s²\].
    pub press: f64,
}

impl HeldBox {
    /// Normal forces \[N\] of the two lower and the two upper corners: ¼ m g (cos α ± (c/a) sin α), from the balance of moments.
    pub fn normal_forces(&self) -> [f64; 4] {
        let [length, _, height] = self.half_extents;
        let share = |sign: f64| 0.25 * self.mass * (self.press + sign * height / length * self.pull);
        [share(1.0), share(1.0), share(-1.0), share(-1.0)]
    }

    /// F_t = m g sin α \[N\].
    pub fn load(&self) -> f64 {
        self.mass * self.pull
    }

    /// w_i \[1/kg\] of the corners, whose spheres of `inset` \[m\] radius touch inside the box's edges.
    fn diagonal_means(&self, inset: f64) -> Vec<f64> {
        let [length, width, height] = self.half_extents;
        let moments = box_moments(self.mass, Vector3::new(length, width, height));
        let inertia = (0..3).fold(Vector3::zeros(), |sum: Vector3<f64>, k| sum + self.axes[k].component_mul(&self.axes[k]) * moments[k]);
        let corner = |[x, y]: [f64; 2]| {
            let [down, side, up] = self.axes;
            let lever = down * (x * (length - inset)) + side * (y * (width - inset)) - up * height;
            diagonal_mean(self.mass, inertia, lever)
        };
        [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(corner).to_vec()
    }
}

/// The creep \[m/s\] under the declared law; `None` for a law without creep, an unknown law, or one whose friction does not hold the box.
pub fn creep(description: &Description, held: &HeldBox) -> Option<f64> {
    match Model::of(description) {
        Model::Mujoco(parameters) => {
            let body = HeldBody { parameters, time_step: held.time_step, diagonal: 1.0 / held.mass, friction: held.friction };
            match description.friction {
                Friction::Pyramid => Some(body.pyramidal_creep_under(&held.normal_forces(), held.load())),
                _ => body.elliptic_creep_under(&held.normal_forces(), held.load()).ok(),
            }
        }
        Model::DrakeSap { .. } => {
            let inset = description.contact_model.number("corner_radius").unwrap_or(0.0);
            Some(shared_creep(held.time_step, &held.diagonal_means(inset), held.load()))
        }
        Model::DrakeRegularised { stiction_tolerance, .. } => {
            let slip = friction_curve(description).slip(held.pull / (held.friction * held.press))?;
            Some(stiction_tolerance * slip)
        }
        _ => None,
    }
}

/// The friction curve of a regularised law: TAMSI's parabola if the description names `tamsi`.
pub fn friction_curve(description: &Description) -> FrictionCurve {
    let approximation = description.options.get("approximation").and_then(serde_json::Value::as_str);
    if approximation == Some("tamsi") { FrictionCurve::Parabola } else { FrictionCurve::Sigmoid }
}
