//! Routh's path: the state of one planar contact with Coulomb friction while its normal impulse p grows.
//!
//! ```text
//!     U(p) = U⁻ + W (p, q(p))
//!     slip in the sense s = sign U_t     dq/dp = −μ s ,            dU_t/dp = W_nt − μ s W_tt
//!     stick                              dq/dp = −W_nt/W_tt ,      dU_t/dp = 0 ,     possible if |W_nt| ≤ μ W_tt
//! ```
//! Every piece is a line, so the path has at most two: a slip that stops is followed by stick, or by slip in the sense of W_nt.
//! U_n ends up rising on every path: a slip that never stops has μ W_tt ≤ s W_nt, hence dU_n/dp = W_nn − μ s W_nt ≥ det W/W_tt > 0, and
//! after a stop the slope is det W/W_tt or, with μ < |W_nt|/W_tt, W_nn − μ |W_nt| which is more. So compression always ends.

use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Changes per normal impulse.
#[derive(Clone, Debug, PartialEq)]
pub struct Slopes<T: Scalar> {
    /// dq/dp, the change of the friction impulse per normal impulse.
    pub friction: T,
    /// dU_n/dp \[1/kg\].
    pub normal: T,
    /// dU_t/dp \[1/kg\].
    pub tangential: T,
}

/// A state on the path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathState<T: Scalar> {
    /// p, the normal impulse so far \[N·s\].
    pub impulse: T,
    /// q, the friction impulse so far \[N·s\].
    pub friction_impulse: T,
    /// U_n \[m/s\].
    pub normal: T,
    /// U_t \[m/s\].
    pub tangential: T,
}

/// A stretch on which everything is linear in p.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece<T: Scalar> {
    /// Its first state.
    pub start: PathState<T>,
    /// Slopes on it.
    pub slopes: Slopes<T>,
    /// p at its end; none for the last piece.
    pub end: Option<T>,
}

/// The path of one impact.
#[derive(Clone, Debug)]
pub struct Path<T: Scalar> {
    impact: PlanarProblem<T>,
    pieces: Vec<Piece<T>>,
}

impl<T: Scalar> PathState<T> {
    fn advanced(&self, slopes: &Slopes<T>, dp: &T) -> Self {
        let grown = |value: &T, slope: &T| value.clone() + slope.clone() * dp.clone();
        PathState {
            impulse: self.impulse.clone() + dp.clone(),
            friction_impulse: grown(&self.friction_impulse, &slopes.friction),
            normal: grown(&self.normal, &slopes.normal),
            tangential: grown(&self.tangential, &slopes.tangential),
        }
    }
}

impl<T: Scalar> Path<T> {
    /// The path of an impact with rows (normal, tangent) and friction μ.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are not two rows, μ < 0, W is not positive definite, or the contact does not approach.
    ///
    /// # Source
    /// Routh, *Dynamics of a System of Rigid Bodies* (1905); Wang and Mason, J. Appl. Mech. 59 (1992).
    ///
    /// ```
    /// use moreau_contact::problem::PlanarProblem;
    /// use moreau_dynamics::impact_laws::{newton, poisson, routh::Path};
    /// use moreau_exact::scalar::ratio;
    /// use nalgebra::{DMatrix, dvector};
    ///
    /// // a unit mass hits the floor at 1 m/s and slides at 1 m/s, μ = ½
    /// let path = Path::new(PlanarProblem::new(DMatrix::identity(2, 2), dvector![ratio(-1, 1), ratio(1, 1)]), &ratio(1, 2))?;
    /// assert_eq!(path.compression_end(), ratio(1, 1));
    /// let e = ratio(1, 2);
    /// assert_eq!(newton::along(&path, &e)?, poisson::along(&path, &e)?); // W is diagonal: the laws agree
    /// assert_eq!(newton::along(&path, &e)?.after, dvector![ratio(1, 2), ratio(1, 4)]);
    /// # Ok::<(), moreau_exact::Error>(())
    /// ```
    pub fn new(impact: PlanarProblem<T>, friction: &T) -> Result<Self> {
        check(&impact, friction)?;
        let zero = T::zero();
        let start = PathState {
            impulse: zero.clone(),
            friction_impulse: zero.clone(),
            normal: impact.velocity[0].clone(),
            tangential: impact.velocity[1].clone(),
        };
        let slopes = slopes(&impact, friction, &start.tangential);
        let stop = stop(&start.tangential, &slopes.tangential);
        let mut pieces = vec![Piece { start, slopes, end: stop.clone() }];
        if let Some(stop) = stop {
            let rest = PathState { tangential: zero.clone(), ..pieces[0].start.advanced(&pieces[0].slopes, &stop) };
            pieces.push(Piece { start: rest, slopes: self::slopes(&impact, friction, &zero), end: None });
        }
        Ok(Path { impact, pieces })
    }

    /// W and U⁻.
    pub fn impact(&self) -> &PlanarProblem<T> {
        &self.impact
    }

    /// The pieces in order, one or two.
    pub fn pieces(&self) -> &[Piece<T>] {
        &self.pieces
    }

    /// The piece that follows the impulse p.
    pub fn piece_after(&self, impulse: &T) -> &Piece<T> {
        self.pieces.iter().find(|piece| piece.end.as_ref().is_none_or(|end| impulse < end)).expect("the last piece has no end")
    }

    /// The state at the impulse p ≥ 0.
    pub fn state(&self, impulse: &T) -> PathState<T> {
        let piece = self.piece_after(impulse);
        piece.start.advanced(&piece.slopes, &(impulse.clone() - piece.start.impulse.clone()))
    }

    /// P = (p, q(p)) and U⁺.
    pub fn outcome(&self, impulse: &T) -> Response<T> {
        let state = self.state(impulse);
        self.impact.response(DVector::from_vec(vec![state.impulse, state.friction_impulse]))
    }

    /// The least p with U_n(p) = target ≥ 0, on a rising piece.
    pub fn reaching(&self, target: &T) -> T {
        let mut rising = self.pieces.iter().filter(|piece| piece.slopes.normal > T::zero());
        let crossing = |piece: &Piece<T>| {
            let missing = target.clone() - piece.start.normal.clone();
            let p = piece.start.impulse.clone() + missing / piece.slopes.normal.clone();
            piece.end.as_ref().is_none_or(|end| p <= *end).then_some(p)
        };
        rising.find_map(crossing).expect("U_n ends up rising on every path")
    }

    /// p_c with U_n(p_c) = 0.
    pub fn compression_end(&self) -> T {
        self.reaching(&T::zero())
    }

    /// ∫ U_n dp from one impulse to another \[J\].
    pub fn normal_work(&self, from: &T, to: &T) -> T {
        self.integral(from, to, |state, _| state.normal.clone())
    }

    /// ∫ U_t dq from one impulse to another \[J\], never positive.
    pub fn friction_work(&self, from: &T, to: &T) -> T {
        self.integral(from, to, |state, slopes| state.tangential.clone() * slopes.friction.clone())
    }

    /// The integral of `rate` over p. `rate` has to be linear in p on every piece.
    fn integral(&self, from: &T, to: &T, rate: impl Fn(&PathState<T>, &Slopes<T>) -> T) -> T {
        let mut sum = T::zero();
        for piece in &self.pieces {
            let left = if *from > piece.start.impulse { from.clone() } else { piece.start.impulse.clone() };
            let right = piece.end.clone().filter(|end| end < to).unwrap_or_else(|| to.clone());
            if left < right {
                let at = |p: &T| piece.start.advanced(&piece.slopes, &(p.clone() - piece.start.impulse.clone()));
                let mean = (rate(&at(&left), &piece.slopes) + rate(&at(&right), &piece.slopes)) * T::ratio(1, 2);
                sum += mean * (right - left);
            }
        }
        sum
    }
}

fn check<T: Scalar>(impact: &PlanarProblem<T>, friction: &T) -> Result<()> {
    let w = &impact.delassus;
    if impact.velocity.len() != 2 || *friction < T::zero() {
        return Err(Error::invalid(
            "impact",
            "is not one planar contact with μ ≥ 0",
            "give one contact with rows (normal, tangent) and μ ≥ 0",
        ));
    }
    let determinant = w[(0, 0)].clone() * w[(1, 1)].clone() - w[(0, 1)].clone() * w[(1, 0)].clone();
    if !(determinant > T::zero() && w[(1, 1)] > T::zero()) {
        return Err(Error::invalid(
            "delassus",
            "is not positive definite",
            "give the positive definite W of a rigid body that can move freely",
        ));
    }
    if impact.velocity[0] >= T::zero() {
        return Err(Error::invalid("velocity", "does not approach", "give U_n < 0"));
    }
    Ok(())
}

/// Slopes of slip in the sense of U_t; at U_t = 0 of stick, or of slip in the sense of W_nt.
fn slopes<T: Scalar>(impact: &PlanarProblem<T>, friction: &T, tangential: &T) -> Slopes<T> {
    let (coupling, mobility) = (impact.delassus[(0, 1)].clone(), impact.delassus[(1, 1)].clone());
    let sign = |x: &T| if *x > T::zero() { T::one() } else { -T::one() };
    let sticks = tangential.is_zero() && coupling.magnitude() <= friction.clone() * mobility.clone();
    let rate = if sticks {
        -coupling.clone() / mobility.clone()
    } else if tangential.is_zero() {
        -friction.clone() * sign(&coupling)
    } else {
        -friction.clone() * sign(tangential)
    };
    let tangential = if sticks { T::zero() } else { coupling.clone() + mobility * rate.clone() };
    Slopes { normal: impact.delassus[(0, 0)].clone() + coupling * rate.clone(), tangential, friction: rate }
}

/// p at which a slip stops, if it does.
fn stop<T: Scalar>(tangential: &T, slope: &T) -> Option<T> {
    let slowing = (*tangential > T::zero() && *slope < T::zero()) || (*tangential < T::zero() && *slope > T::zero());
    slowing.then(|| -tangential.clone() / slope.clone())
}
