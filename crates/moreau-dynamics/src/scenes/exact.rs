//! The exact motion of a scene, where a closed form covers it.
//!
//! ```text
//!     fall     one sphere at rest above a level ground:   q(t) along the normal from the bouncing ball,
//!     slide    one box flat on a plane:                   s(t) down the slope from the block on an incline,
//!     impact   two spheres on a line without gravity:     v₁, v₂ before, v₁⁺, v₂⁺ after the central impact,
//!     roll     one sphere or disk thrown along the ground: sliding until v = ω R, then rolling.
//! ```

use super::validation::GROUND;
use super::{Body, Scene};
use crate::mechanics::State;
use crate::tolerance::scenes::WRITTEN_UNIT_VECTOR;
use moreau_forms::sliding_to_rolling::SlidingToRolling;
use moreau_forms::two_body_impact::TwoBodyImpact;
use moreau_forms::{BouncingBall, InclineBlock};
use nalgebra::DVector;

/// A closed form of the motion of a scene's bodies in the x–z plane.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactMotion {
    /// (x, z, angle) per body at the start.
    start: DVector<f64>,
    form: Form,
}

#[derive(Clone, Debug, PartialEq)]
enum Form {
    Fall { ball: BouncingBall, height: f64, normal: [f64; 2] },
    Slide { block: InclineBlock, down: [f64; 2] },
    Impact { line: [f64; 2], time: f64, before: [f64; 2], after: [f64; 2] },
    Roll { body: SlidingToRolling, radius: f64, ahead: [f64; 2] },
}

impl ExactMotion {
    /// The law in words and symbols.
    pub fn law(&self) -> &'static str {
        match self.form {
            Form::Fall { .. } => "bouncing ball: q̈ = −g, v⁺ = −e v⁻",
            Form::Slide { .. } => "block on an incline: a = g (sin α − μ cos α sign v)",
            Form::Impact { .. } => "central impact: P = (1 + e) m̄ (v₁ − v₂)",
            Form::Roll { .. } => "sliding to rolling: v̇ = −μ g, ω̇ R = κ μ g until v = ω R",
        }
    }

    /// Whether e is in it, so that a scene without restitution has another one.
    pub fn has_restitution(&self) -> bool {
        matches!(self.form, Form::Fall { .. } | Form::Impact { .. })
    }

    /// Configuration and velocity, (x, z, angle) per body, at a time t ≥ 0.
    pub fn state(&self, time: f64) -> State {
        let mut turned = [0.0; 2];
        let moves = match &self.form {
            Form::Fall { ball, height, normal } => {
                let (q, v) = ball.state(time);
                vec![along(*normal, q - height, v)]
            }
            Form::Slide { block, down } => {
                let (s, v) = block.state(time);
                vec![along(*down, s, v)]
            }
            Form::Impact { line, time: impact, before, after } => {
                let travelled = |k: usize| before[k] * time.min(*impact) + after[k] * (time - impact).max(0.0);
                let speed = if time < *impact { before } else { after };
                (0..2).map(|k| along(*line, travelled(k), speed[k])).collect()
            }
            Form::Roll { body, radius, ahead } => {
                let state = body.state(time);
                let slide = body.rolling_time().min(time);
                let surface = 0.5 * (body.surface + state.surface) * slide + state.surface * (time - slide);
                // rolling along the tangent (n_z, −n_x) is a turn about +ŷ
                turned = [surface / radius, state.surface / radius];
                vec![along(*ahead, state.distance, state.speed)]
            }
        };
        let offsets = moves.iter().flat_map(|(offset, _)| [offset[0], offset[1], turned[0]]);
        let velocities = moves.iter().flat_map(|(_, velocity)| [velocity[0], velocity[1], turned[1]]);
        let size = self.start.len();
        let position = &self.start + DVector::from_iterator(size, offsets);
        State { time, position, velocity: DVector::from_iterator(size, velocities) }
    }
}

impl Scene {
    /// The exact motion, if the scene is one of those a closed form covers; `start` is the mechanism's initial state.
    pub fn exact_motion(&self, start: &State) -> Option<ExactMotion> {
        if self.bodies.iter().any(|body| body.angular_velocity != [0.0; 3]) {
            return None;
        }
        let form = match (self.bodies.as_slice(), self.ground.is_some()) {
            ([body], true) if body.sphere.is_some() => self.fall(body).or_else(|| self.roll(body))?,
            ([body], true) => self.slide(body)?,
            ([first, second], false) => self.impact(first, second)?,
            _ => return None,
        };
        Some(ExactMotion { start: start.position.clone(), form })
    }

    /// A sphere released at rest above a ground perpendicular to gravity.
    fn fall(&self, body: &Body) -> Option<Form> {
        let (normal, offset) = self.ground_line()?;
        let (tangential, gravity) = split(planar(self.gravity), normal);
        let height = dot(normal, planar(body.position)) - offset - body.sphere?.radius;
        let at_rest = body.linear_velocity == [0.0; 3] && tangential.abs() <= WRITTEN_UNIT_VECTOR * gravity.abs();
        let ball = BouncingBall::new(-gravity, height, self.coefficients(&body.name, GROUND).1).ok()?;
        at_rest.then_some(Form::Fall { ball, height, normal })
    }

    /// A sphere, or a disk, that touches level ground and moves along it.
    fn roll(&self, body: &Body) -> Option<Form> {
        let (normal, offset) = self.ground_line()?;
        let radius = body.sphere?.radius;
        let (pull, weight) = split(planar(self.gravity), normal);
        let (speed, lifting) = split(planar(body.linear_velocity), normal);
        let gap = dot(normal, planar(body.position)) - offset - radius;
        let level = pull.abs() <= WRITTEN_UNIT_VECTOR * weight.abs();
        let touching = gap.abs() <= radius * WRITTEN_UNIT_VECTOR && lifting.abs() <= speed.abs() * WRITTEN_UNIT_VECTOR;
        let inertia = body.inertia.map_or(0.4 * body.mass * radius * radius, |moments| moments[1]);
        let turning = body.mass * radius * radius / inertia;
        let rolling = SlidingToRolling::new(turning, self.coefficients(&body.name, GROUND).0, -weight, 0.0, speed, 0.0).ok()?;
        (level && touching && speed != 0.0).then_some(Form::Roll { body: rolling, radius, ahead: [normal[1], -normal[0]] })
    }

    /// A box whose lower face lies on the ground, that moves along it if at all, and is too low to tip.
    fn slide(&self, body: &Body) -> Option<Form> {
        let (normal, offset) = self.ground_line()?;
        let [half_width, _, half_height] = body.cuboid?.half_extents;
        let size = half_width + half_height;
        let upright = {
            let [w, _, y, _] = body.orientation;
            let axis = [2.0 * w * y, 1.0 - 2.0 * y * y];
            (axis[0] - normal[0]).abs() + (axis[1] - normal[1]).abs() <= 4.0 * WRITTEN_UNIT_VECTOR
        };
        let gap = dot(normal, planar(body.position)) - offset - half_height;
        let (pull, weight) = split(planar(self.gravity), normal);
        let (speed, lifting) = split(planar(body.linear_velocity), normal);
        let sign = if pull < 0.0 { -1.0 } else { 1.0 };
        let tangent = [normal[1] * sign, -normal[0] * sign];
        let friction = self.coefficients(&body.name, GROUND).0;
        let slope = pull.abs() / -weight;
        let lever = if speed == 0.0 { friction.min(slope) } else { friction };
        let flat = upright && gap.abs() <= size * WRITTEN_UNIT_VECTOR && lifting.abs() <= speed.abs() * WRITTEN_UNIT_VECTOR;
        let block = InclineBlock::new(pull.hypot(weight), pull.abs().atan2(-weight), friction, speed * sign).ok()?;
        (flat && lever * half_height <= half_width).then_some(Form::Slide { block, down: tangent })
    }

    /// Two spheres that move along the line through their centres.
    fn impact(&self, first: &Body, second: &Body) -> Option<Form> {
        let (a, b) = (planar(first.position), planar(second.position));
        let distance = (b[0] - a[0]).hypot(b[1] - a[1]);
        let line = [(b[0] - a[0]) / distance, (b[1] - a[1]) / distance];
        let speeds = [first, second].map(|body| (-cross(line, planar(body.linear_velocity)), dot(line, planar(body.linear_velocity))));
        let central = speeds.iter().all(|(aside, speed)| aside.abs() <= speed.abs() * WRITTEN_UNIT_VECTOR);
        let restitution = self.coefficients(&first.name, &second.name).1;
        let impact = TwoBodyImpact { masses: [first.mass, second.mass], velocities: speeds.map(|(_, speed)| speed), restitution };
        let time = (distance - first.sphere?.radius - second.sphere?.radius) / impact.closing_speed();
        let meets = time.is_finite() && time >= 0.0;
        let form = Form::Impact { line, time, before: impact.velocities, after: impact.velocities_post() };
        (central && meets && self.gravity == [0.0; 3]).then_some(form)
    }

    /// Unit normal and offset of the ground in the x–z plane.
    fn ground_line(&self) -> Option<([f64; 2], f64)> {
        let ground = self.ground?;
        Some((planar(ground.normal), ground.offset))
    }

    /// (μ, e) of a pair.
    fn coefficients(&self, one: &str, other: &str) -> (f64, f64) {
        let own = self.material.pairs.iter().rfind(|pair| {
            let [a, b] = &pair.bodies;
            (a == one && b == other) || (a == other && b == one)
        });
        let friction = own.and_then(|pair| pair.friction).unwrap_or(self.material.friction);
        let restitution = own.and_then(|pair| pair.restitution).unwrap_or(self.material.restitution);
        (friction, restitution)
    }
}

fn planar([x, _, z]: [f64; 3]) -> [f64; 2] {
    [x, z]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The parts of a vector along the tangent (n_z, −n_x), which is +x on level ground, and along the normal n.
fn split(vector: [f64; 2], normal: [f64; 2]) -> (f64, f64) {
    (dot(vector, [normal[1], -normal[0]]), dot(vector, normal))
}

fn along(direction: [f64; 2], distance: f64, speed: f64) -> ([f64; 2], [f64; 2]) {
    (direction.map(|part| part * distance), direction.map(|part| part * speed))
}

#[cfg(test)]
mod tests {
    use super::super::named;
    use super::*;
    use moreau_exact::tolerance::rounding;

    fn exact(name: &str, change: impl Fn(&mut Scene)) -> Option<ExactMotion> {
        let mut scene = named(name).expect("a built-in scene");
        change(&mut scene);
        let (_, start) = scene.mechanism().expect("planar");
        scene.exact_motion(&start)
    }

    fn at(name: &str, time: f64) -> State {
        exact(name, |_| {}).expect("covered").state(time)
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= rounding(64, 1.0 + b.abs())
    }

    #[test]
    fn the_ball_falls_by_half_g_t_squared_and_touches_at_its_radius() {
        let state = at("bouncing-ball", 0.25);
        assert!(close(state.position[1], 1.1 - 0.5 * 9.81 * 0.0625) && close(state.velocity[1], -9.81 * 0.25));
        assert!(close(at("ball-drop", 2.0).position[1], 0.1));
    }

    #[test]
    fn the_block_stays_or_slides_down_its_slope() {
        let stuck = at("incline-stick", 1.0);
        assert_eq!(stuck.velocity, DVector::zeros(3));
        let (start, slid) = (at("incline-slide", 0.0), at("incline-slide", 1.0));
        let angle = std::f64::consts::PI / 9.0;
        let acceleration = 9.81 * (angle.sin() - 0.3 * angle.cos());
        let moved = &slid.position - &start.position;
        assert!(close(moved[0], 0.5 * acceleration * angle.cos()), "{moved}");
        assert!(close(moved[1], -0.5 * acceleration * angle.sin()), "{moved}");
        assert_eq!(moved[2], 0.0);
    }

    #[test]
    fn the_heavy_ball_goes_on_at_half_a_metre_per_second() {
        // touch after 0.4 m at 1 m/s; P = 1.5 · (2/3) · 1 = 1 N·s
        let state = at("two-ball-impact", 0.9);
        assert!(close(state.velocity[0], 0.5) && close(state.velocity[3], 1.0));
        assert!(close(state.position[0], -0.6 + 0.4 + 0.25) && close(state.position[3], 0.5));
    }

    #[test]
    fn a_thrown_sphere_rolls_at_five_sevenths_and_a_disk_at_two_thirds_of_its_speed() {
        for (name, share) in [("rolling-sphere", 5.0 / 7.0), ("rolling-disk", 2.0 / 3.0)] {
            let (start, end) = (at(name, 0.0), at(name, 1.0));
            assert_eq!((start.velocity[0], start.velocity[2]), (1.0, 0.0));
            assert!(close(end.velocity[0], share) && close(end.velocity[2] * 0.1, share), "{name}: {}", end.velocity);
            // it slides for t = (1 − share)/(μ g) at the mean of both speeds; its surface turns at half the last one meanwhile
            let time = (1.0 - share) / (0.2 * 9.81);
            let distance = share * (1.0 - time) + 0.5 * (1.0 + share) * time;
            assert!(close(end.position[0], distance) && close(end.position[2] * 0.1, share * (1.0 - 0.5 * time)), "{name}");
        }
        assert!(exact("rolling-sphere", |scene| scene.bodies[0].position[2] = 0.2).is_none(), "it falls first");
        assert!(exact("rolling-sphere", |scene| scene.gravity[0] = 1.0).is_none(), "a slope");
    }

    #[test]
    fn the_forms_with_e_are_those_that_change_with_it() {
        for name in ["bouncing-ball", "two-ball-impact", "incline-slide", "rolling-disk"] {
            let [elastic, plastic] = [1.0, 0.0].map(|e| exact(name, |scene| scene.material.restitution = e).expect("covered"));
            let apart = (elastic.state(1.5).position - plastic.state(1.5).position).amax() > 0.0;
            assert_eq!((elastic.has_restitution(), plastic.has_restitution()), (apart, apart), "{name}");
        }
    }

    #[test]
    fn what_no_closed_form_covers_has_none() {
        assert!(exact("box-stack", |_| {}).is_none());
        assert!(exact("bouncing-ball", |scene| scene.bodies[0].linear_velocity[0] = 1.0).is_none());
        assert!(exact("bouncing-ball", |scene| scene.gravity[0] = 1.0).is_none());
        assert!(exact("incline-slide", |scene| scene.bodies[0].angular_velocity[1] = 1.0).is_none());
        assert!(exact("two-ball-impact", |scene| scene.bodies[0].linear_velocity = [-1.0, 0.0, 0.0]).is_none());
    }

    #[test]
    fn a_box_that_would_tip_is_not_a_sliding_block() {
        let tall = |height: f64| {
            exact("incline-slide", |scene| {
                let body = &mut scene.bodies[0];
                let normal = scene.ground.map(|ground| ground.normal).expect("an incline");
                body.position = normal.map(|part| part * height);
                body.cuboid.as_mut().expect("a box").half_extents[2] = height;
            })
        };
        assert!(tall(0.33).is_some(), "μ · 0.33 < 0.1");
        assert!(tall(0.34).is_none(), "μ · 0.34 > 0.1");
    }
}
