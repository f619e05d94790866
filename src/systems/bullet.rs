//! Bullet: velocity level, Coulomb's cone, sequential impulses; gap and depth enter as a bias velocity.
//!
//! ```text
//!     K_μ ∋ r ⟂ u⁺ + (ERP d/h − e|u_n|) n + μ‖u_t⁺‖n ∈ K_μ* ,     d/h in place of ERP d/h while d = φ + slop > 0
//! ```

use super::{Agreement, Cone, ContactLaw, Level, Measured, System, replay};
use crate::Result;
use crate::schemes::{Bodies, Bullet, Scheme};
use crate::trajectory::Trajectory;

const SUNK: &str = include_str!("../../references/bullet/ball_sunk__multi__h0.01.json");
const BOUNCE: &str = include_str!("../../references/bullet/ball_bounce__multi__h0.01.json");
const RIGID_BOUNCE: &str = include_str!("../../references/bullet/ball_bounce__rigid__h0.01.json");
const DEEP: &str = include_str!("../../references/bullet/ball_deep__rigid__h0.01.json");
const SLIDE: &str = include_str!("../../references/bullet/block_slide__box__h0.005.json");

const ENGINE: &str = "PyBullet 3.2.7";

pub static SYSTEM: System = System {
    name: "Bullet",
    level: Level::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "sequential impulses: block projected Gauss–Seidel in their limit",
    restitution: "Newton's e on the velocity after the forces, less d/h of a gap",
    position_update: "q + h v⁺, and split impulses of deep rigid bodies",
    schemes: &["bullet"],
    held_against: &[
        Agreement {
            against: ENGINE,
            quantity: "velocity of a sunken ball, every step",
            unit: "m/s",
            measure: || velocity(SUNK, &Bullet::default()),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a bouncing multibody, every step",
            unit: "m/s",
            measure: || velocity(BOUNCE, &Bullet::default()),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a bouncing rigid body, every step",
            unit: "m/s",
            measure: || velocity(RIGID_BOUNCE, &rigid()),
        },
        Agreement {
            against: ENGINE,
            quantity: "position under split impulses, every step",
            unit: "m",
            measure: || position(DEEP, &rigid()),
        },
        Agreement {
            against: ENGINE,
            quantity: "velocity of a block sliding on a box, every second step",
            unit: "m/s",
            measure: || velocity(SLIDE, &boxes()),
        },
    ],
};

/// Contact points between boxes begin where they overlap.
fn boxes() -> Bullet {
    Bullet { margin: 0.0, ..Bullet::default() }
}

fn rigid() -> Bullet {
    Bullet { bodies: Bodies::Rigid, ..Bullet::default() }
}

fn velocity(stored: &str, scheme: &dyn Scheme) -> Result<Measured> {
    let stored = Trajectory::from_json(stored)?;
    Ok(replay::replay(&stored, scheme, stored.times.len() - 1)?.velocity)
}

fn position(stored: &str, scheme: &dyn Scheme) -> Result<Measured> {
    let stored = Trajectory::from_json(stored)?;
    Ok(replay::replay(&stored, scheme, stored.times.len() - 1)?.position)
}

#[cfg(test)]
mod tests {
    use super::super::planted::{Mistake, caught, planted};
    use super::*;

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        caught(velocity(SUNK, &Bullet { error_reduction: 0.2, ..Bullet::default() }));
        caught(velocity(BOUNCE, &rigid()));
        caught(velocity(RIGID_BOUNCE, &Bullet::default()));
        caught(position(DEEP, &Bullet { error_reduction: 0.2, ..rigid() }));
        caught(velocity(SLIDE, &planted(boxes(), Mistake::HalfFriction)));
    }
}
