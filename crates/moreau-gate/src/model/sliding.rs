//! The motion of a sliding sphere under a convex law, see [`moreau_forms::sliding_contact`].

use crate::Description;
use crate::description::Friction;
use crate::model::{Model, convex};
use moreau_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use moreau_forms::sliding_contact::{SlidingContact, SlidingLaw};

/// m W_t of a solid sphere, 1 + m R²/I.
pub const SPHERE: f64 = 3.5;

/// One contact of a solid sphere under the declared law, if that is convex; \[m, R\] in kg and m, `gravity` is (g_n, g_t) \[m/s²\].
pub fn replayed(description: &Description, h: f64, [mass, radius]: [f64; 2], friction: f64, gravity: [f64; 2]) -> Option<SlidingContact> {
    let law = match Model::of(description) {
        Model::Anitescu => SlidingLaw::Anitescu,
        Model::DrakeSap { stiffness, relaxation_time } => SlidingLaw::DrakeSap(SapContact {
            time_step: h,
            stiffness,
            relaxation_time,
            diagonal_mean: (2.0 * SPHERE * SPHERE + 1.0).sqrt() / (3.0 * mass),
            tangential_ratio: TANGENTIAL_RATIO,
            friction,
        }),
        Model::Mujoco(parameters) if description.friction == Friction::Pyramid => SlidingLaw::MujocoPyramidal(parameters),
        Model::Mujoco(parameters) => SlidingLaw::MujocoElliptic(parameters),
        _ => return None,
    };
    Some(SlidingContact { law, time_step: h, mass, radius, friction, press: gravity[0], pull: gravity[1] })
}

/// Whether the declared law lifts a contact off when it slips: the convex ones, among them Drake's Similar, whose motion has no closed
/// form.
pub fn hops(description: &Description) -> bool {
    let similar = description.options.get("approximation").and_then(serde_json::Value::as_str) == Some("similar");
    let model = Model::of(description);
    convex(&model) || (similar && matches!(model, Model::DrakeRegularised { .. }))
}

/// Slip \[m/s\] above which the declared law's friction is full, where it would brake with `rate` \[m/s²\]; 0 for Coulomb's.
///
/// MuJoCo asks for a deceleration b u of a contact that slips with u, which the cone limits to `rate` above `rate`/b·(1 + R_t/W_t), with
/// R_t < W_t for every impedance above ½; regularised friction is full to 1/(2·10²) at ten stiction tolerances.
pub fn full_slip(description: &Description, rate: f64, h: f64) -> f64 {
    match Model::of(description) {
        Model::Mujoco(parameters) => 2.0 * rate / parameters.stiffness_and_damping(h).1,
        Model::DrakeRegularised { stiction_tolerance, .. } => 10.0 * stiction_tolerance,
        _ => 0.0,
    }
}
