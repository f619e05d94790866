//! Motion with a discontinuous right-hand side, and Filippov's sliding mode on the surface where it switches.
//!
//! ```text
//!     ẋ = f₊(x) where s > 0 ,  f₋(x) where s < 0 ;    a± = ∇s·f±
//!     s = 0:  a₋ > 0 > a₊   slides:   ẋ = α f₊ + (1−α) f₋ ,   α = a₋/(a₋ − a₊) ∈ (0, 1), the only one with ṡ = 0
//!             a₊, a₋ > 0    crosses upwards;   a₊, a₋ < 0 downwards;   a₋ < 0 < a₊ leaves on either side: not unique
//!     the sliding ends where a₋ or a₊ reaches zero, or where [`Switched::holds`] does
//! ```
//! Coulomb friction with s = slip velocity is such a system: sticking is its sliding mode.
//!
//! # Source
//! Filippov, *Differential Equations with Discontinuous Righthand Sides* (1988); Piiroinen and Kuznetsov, ACM TOMS 34(3) (2008).

use super::EventDriven;
use super::flight::{Phase, fly};
use crate::tolerance::event_driven::EVENT_LIMIT;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// A side of the switching surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// s > 0.
    Above,
    /// s < 0.
    Below,
}

/// A system that switches on a surface.
pub trait Switched {
    /// f₊ or f₋.
    fn rate(&self, side: Side, x: &DVector<f64>) -> DVector<f64>;
    /// s.
    fn surface(&self, x: &DVector<f64>) -> f64;
    /// ∇s.
    fn normal(&self, x: &DVector<f64>) -> DVector<f64>;
    /// Not negative where the sliding goes on: min(a₋, −a₊), unless the surface holds more than the two sides push (static friction).
    fn holds(&self, x: &DVector<f64>) -> f64 {
        let [above, below] = approach(self, x);
        below.min(-above)
    }
}

/// a₊ and a₋.
pub fn approach<S: Switched + ?Sized>(system: &S, x: &DVector<f64>) -> [f64; 2] {
    let normal = system.normal(x);
    [Side::Above, Side::Below].map(|side| normal.dot(&system.rate(side, x)))
}

/// α of the sliding mode, a₋/(a₋ − a₊).
pub fn share_above<S: Switched + ?Sized>(system: &S, x: &DVector<f64>) -> f64 {
    let [above, below] = approach(system, x);
    below / (below - above)
}

/// A mode of a system that switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// On one side.
    Beside(Side),
    /// On the surface.
    Sliding,
}

struct Smooth<'a> {
    system: &'a dyn Switched,
    mode: Mode,
}

impl Phase for Smooth<'_> {
    fn rate(&self, x: &DVector<f64>) -> Result<DVector<f64>> {
        let side = |side| self.system.rate(side, x);
        Ok(match self.mode {
            Mode::Beside(here) => side(here),
            Mode::Sliding => {
                let share = share_above(self.system, x);
                side(Side::Above) * share + side(Side::Below) * (1.0 - share)
            }
        })
    }

    fn events(&self, x: &DVector<f64>) -> Result<Vec<f64>> {
        Ok(vec![match self.mode {
            Mode::Beside(Side::Above) => self.system.surface(x),
            Mode::Beside(Side::Below) => -self.system.surface(x),
            Mode::Sliding => self.system.holds(x),
        }])
    }
}

/// A change of mode: when, and to which.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// \[s\] after the start.
    pub time: f64,
    /// The mode from then on.
    pub mode: Mode,
}

/// The state after `duration` \[s\] and the switches on the way, from a state on one side or, if s = 0, on the surface.
///
/// # Errors
/// [`Error::Unsupported`] where the motion may leave the surface on either side; [`Error::Solver`] if the switches do not end.
pub fn advance(method: &EventDriven, system: &dyn Switched, start: &DVector<f64>, duration: f64) -> Result<(DVector<f64>, Vec<Switch>)> {
    let beside = |s: f64| if s > 0.0 { Mode::Beside(Side::Above) } else { Mode::Beside(Side::Below) };
    let s = system.surface(start);
    let mut mode = if s == 0.0 { on_surface(system, start)? } else { beside(s) };
    let (mut x, mut elapsed, mut step) = (start.clone(), 0.0, duration / 8.0);
    let mut switches = vec![Switch { time: 0.0, mode }];
    for _ in 0..EVENT_LIMIT {
        let arrival = fly(&Smooth { system, mode }, &x, duration - elapsed, method.control, method.location, &mut step)?;
        (x, elapsed) = (arrival.state, elapsed + arrival.elapsed);
        if arrival.event.is_none() {
            return Ok((x, switches));
        }
        mode = match mode {
            Mode::Beside(_) => on_surface(system, &x)?,
            Mode::Sliding => leaving(system, &x),
        };
        switches.push(Switch { time: elapsed, mode });
    }
    Err(Error::limit("event-driven", format!("met more than {EVENT_LIMIT} switches")))
}

/// The mode that begins on the surface.
fn on_surface(system: &dyn Switched, x: &DVector<f64>) -> Result<Mode> {
    let [above, below] = approach(system, x);
    if system.holds(x) > 0.0 {
        return Ok(Mode::Sliding);
    }
    match (above >= 0.0, below <= 0.0) {
        (true, true) => Err(Error::Unsupported("both sides push away from the switching surface: the motion is not unique".into())),
        (true, false) => Ok(Mode::Beside(Side::Above)),
        (false, true) => Ok(Mode::Beside(Side::Below)),
        (false, false) => Ok(Mode::Sliding),
    }
}

/// The side to which a sliding mode is left: that whose vector field has stopped pushing back.
fn leaving(system: &dyn Switched, x: &DVector<f64>) -> Mode {
    let [above, below] = approach(system, x);
    Mode::Beside(if below < -above { Side::Below } else { Side::Above })
}

/// A mass on a spring under Coulomb friction against a surface that moves at v_b: x = (q, v), s = v − v_b.
///
/// ```text
///     f± = (v, −ω² (q ± δ_k)) ,   held while |q| ≤ δ_s
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryFriction {
    /// ω \[rad/s\].
    pub frequency: f64,
    /// v_b \[m/s\].
    pub belt: f64,
    /// δ_s \[m\], where the spring overcomes sticking friction.
    pub sticking: f64,
    /// δ_k ≤ δ_s \[m\], where it balances slipping friction.
    pub slipping: f64,
}

impl Switched for DryFriction {
    fn rate(&self, side: Side, x: &DVector<f64>) -> DVector<f64> {
        let shift = if side == Side::Above { self.slipping } else { -self.slipping };
        DVector::from_vec(vec![x[1], -self.frequency * self.frequency * (x[0] + shift)])
    }

    fn surface(&self, x: &DVector<f64>) -> f64 {
        x[1] - self.belt
    }

    fn normal(&self, _x: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(vec![0.0, 1.0])
    }

    fn holds(&self, x: &DVector<f64>) -> f64 {
        self.frequency * self.frequency * (self.sticking - x[0].abs())
    }
}
