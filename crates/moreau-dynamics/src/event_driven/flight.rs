//! Smooth motion until something happens: Dormand–Prince steps of ẋ = f(x), and the first time at which one of the functions g_i falls
//! below zero.
//!
//! ```text
//!     bracket     g_i on the continuous extension x(ϑh) at ϑ = 1/8, …, 1
//!     locate      the root of s ↦ g_i(step(x, s)), the step itself and not its extension, to rounding
//! ```
//! A function that starts at zero or below (the gap of a body that has just bounced) is watched as (g(s) − g(0))/s instead, whose root is
//! the next one. The state at an event is a full step of order five, so that locating costs no order.

use super::root::falling_root;
use crate::integrators::DormandPrinceStep;
use crate::tolerance::event_driven::{GROWTH, SAFETY, SHORTEST_STEP};
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// A smooth motion and what ends it.
pub trait Phase {
    /// f(x).
    ///
    /// # Errors
    /// Where the motion is not defined.
    fn rate(&self, x: &DVector<f64>) -> Result<DVector<f64>>;
    /// g(x): the phase ends when one of them falls below zero.
    ///
    /// # Errors
    /// Where the motion is not defined.
    fn events(&self, x: &DVector<f64>) -> Result<Vec<f64>>;
}

/// How the steps are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Steps of this length \[s\], the last before an event shortened.
    Fixed(f64),
    /// Steps whose estimated error stays below this share of 1 + |x|, entry by entry.
    Tolerance(f64),
}

/// What to do about an event within a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// Find it.
    Root,
    /// Notice it at the end of the step, as a method without event location does.
    EndOfStep,
}

/// The end of a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// x there.
    pub state: DVector<f64>,
    /// How long it took \[s\].
    pub elapsed: f64,
    /// Which function fell below zero, if one did.
    pub event: Option<usize>,
}

/// Shares of a step at which events are looked for.
const LOOKS: usize = 8;

/// Flies for `duration` \[s\] or until an event; `first` is the first step to try \[s\] and becomes the next one.
///
/// # Errors
/// Those of the phase, or if no step is short enough.
pub fn fly(
    phase: &dyn Phase,
    start: &DVector<f64>,
    duration: f64,
    control: Control,
    location: Location,
    first: &mut f64,
) -> Result<Arrival> {
    let (mut state, mut elapsed) = (start.clone(), 0.0);
    while elapsed < duration {
        let left = duration - elapsed;
        let wanted = if let Control::Fixed(h) = control { h } else { *first };
        // a rest below a thousandth of a step is taken with it
        let h = if wanted * (1.0 + SHORTEST_STEP) >= left { left } else { wanted };
        let step = DormandPrinceStep::take(|x| phase.rate(x), &state, &h)?;
        if let Control::Tolerance(tolerance) = control {
            let ratio = error_ratio(&step, &state, tolerance);
            let factor = (SAFETY * ratio.powf(-0.2)).clamp(1.0 / GROWTH, GROWTH);
            if ratio > 1.0 {
                *first = h * factor;
                if *first < SHORTEST_STEP * SHORTEST_STEP * duration {
                    return Err(Error::limit("event-driven", "no step is short enough for its error; the motion is not smooth"));
                }
                continue;
            }
            *first = (h * factor).max(*first);
        }
        let found = match location {
            Location::Root => locate(phase, &state, &step, h)?,
            Location::EndOfStep => late(phase, &state, &step.end, h)?,
        };
        if let Some((event, time, state)) = found {
            return Ok(Arrival { state, elapsed: elapsed + time, event: Some(event) });
        }
        (state, elapsed) = (step.end, if h == left { duration } else { elapsed + h });
    }
    Ok(Arrival { state, elapsed: duration, event: None })
}

/// The largest error over its allowance; an error that is not a number allows nothing.
fn error_ratio(step: &DormandPrinceStep<f64>, start: &DVector<f64>, tolerance: f64) -> f64 {
    let scale = |k: usize| tolerance * (1.0 + start[k].abs().max(step.end[k].abs()));
    let worst = step
        .error()
        .iter()
        .enumerate()
        .map(|(k, e)| e.abs() / scale(k))
        .fold(0.0, |a: f64, b| if b.is_nan() { f64::INFINITY } else { a.max(b) });
    worst.max(f64::MIN_POSITIVE)
}

/// g over a time s from a start: g itself, or its quotient where it starts at zero or below; a fall by rounding is none.
fn watched(value: f64, start: f64, time: f64) -> f64 {
    if start > 0.0 { value } else { (value - start + rounding(32, value.abs().max(start.abs()))) / time }
}

/// The first event within the step: which, when, and the state there.
fn locate(phase: &dyn Phase, start: &DVector<f64>, step: &DormandPrinceStep<f64>, h: f64) -> Result<Option<(usize, f64, DVector<f64>)>> {
    let before = phase.events(start)?;
    for look in 1..=LOOKS {
        let share = look as f64 / LOOKS as f64;
        let there = if look == LOOKS { step.end.clone() } else { step.at(&share) };
        let values = phase.events(&there)?;
        let fallen: Vec<usize> = (0..values.len()).filter(|&i| watched(values[i], before[i], share * h) < 0.0).collect();
        let mut earliest: Option<(usize, f64)> = None;
        for event in fallen {
            let time = root_time(phase, start, event, before[event], (share - 1.0 / LOOKS as f64) * h, share * h)?;
            if earliest.is_none_or(|(_, known)| time < known) {
                earliest = Some((event, time));
            }
        }
        if let Some((event, time)) = earliest {
            let state = DormandPrinceStep::take(|x| phase.rate(x), start, &time)?.end;
            return Ok(Some((event, time, state)));
        }
    }
    Ok(None)
}

/// When g_i, taken along steps from the start, falls below zero between two times.
fn root_time(phase: &dyn Phase, start: &DVector<f64>, event: usize, before: f64, low: f64, high: f64) -> Result<f64> {
    let along = |time: f64| -> Result<f64> {
        let there = DormandPrinceStep::take(|x| phase.rate(x), start, &time)?.end;
        Ok(watched(phase.events(&there)?[event], before, time))
    };
    // the extension and the step differ by its error: the root may lie beyond either end of the bracket
    let (mut low, mut high) = (low, high);
    if along(high)? >= 0.0 {
        return Ok(high);
    }
    for _ in 0..f64::MANTISSA_DIGITS {
        if low > 0.0 && along(low)? >= 0.0 {
            return falling_root(along, low, high);
        }
        if low > 0.0 {
            high = low;
        }
        low = 0.5 * high;
    }
    Ok(high)
}

/// The event that is over at the end of the step, if there is one.
fn late(phase: &dyn Phase, start: &DVector<f64>, end: &DVector<f64>, h: f64) -> Result<Option<(usize, f64, DVector<f64>)>> {
    let (before, after) = (phase.events(start)?, phase.events(end)?);
    Ok((0..after.len()).find(|&i| watched(after[i], before[i], h) < 0.0).map(|event| (event, h, end.clone())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    /// ẍ = −x, watched where x falls below a level.
    struct Swing(f64);

    impl Phase for Swing {
        fn rate(&self, x: &DVector<f64>) -> Result<DVector<f64>> {
            Ok(dvector![x[1], -x[0]])
        }
        fn events(&self, x: &DVector<f64>) -> Result<Vec<f64>> {
            Ok(vec![x[0] - self.0])
        }
    }

    fn arrival(level: f64, control: Control, location: Location) -> Arrival {
        fly(&Swing(level), &dvector![1.0, 0.0], 4.0, control, location, &mut 0.1).expect("smooth")
    }

    #[test]
    fn the_event_is_where_the_cosine_is_with_the_error_of_the_method() {
        let found = arrival(0.3, Control::Tolerance(1e-12), Location::Root);
        assert_eq!(found.event, Some(0));
        assert!((found.elapsed - 0.3f64.acos()).abs() <= 1e-10 && (found.state[0] - 0.3).abs() <= rounding(8, 1.0), "{found:?}");
        let never = arrival(-1.5, Control::Tolerance(1e-12), Location::Root);
        assert!(never.event.is_none() && (never.state[0] - 4f64.cos()).abs() <= 1e-10);
    }

    #[test]
    fn the_location_has_the_order_of_the_step_and_a_late_notice_has_none() {
        let error = |h: f64| (arrival(0.3, Control::Fixed(h), Location::Root).elapsed - 0.3f64.acos()).abs();
        let order = (error(0.2) / error(0.05)).log2() / 2.0;
        assert!(order > 4.5, "{order}");
        let late = arrival(0.3, Control::Fixed(0.05), Location::EndOfStep).elapsed - 0.3f64.acos();
        assert!(0.0 < late && late <= 0.05, "{late}");
    }

    #[test]
    fn what_starts_at_zero_is_watched_for_its_next_root() {
        // sin t from t = 0: positive until π
        let flight = fly(&Swing(0.0), &dvector![0.0, 1.0], 4.0, Control::Tolerance(1e-12), Location::Root, &mut 0.1).expect("smooth");
        assert_eq!(flight.event, Some(0));
        assert!((flight.elapsed - std::f64::consts::PI).abs() <= 1e-10, "{}", flight.elapsed);
    }
}
