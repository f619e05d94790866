//! One planar contact with Coulomb friction: where the three classical laws end, regime by regime.
//!
//! ```text
//!     w = −U_n⁻ > 0 ,  s = sign U_t⁻ ,  P_s = |U_t⁻|/(μ W_tt − s W_nt)  if positive: the slip stops there
//!     p ≤ P_s    slides      q = −μ s p                    U_n = −w + (W_nn − μ s W_nt) p
//!     p > P_s    sticks      q = −(U_t⁻ + W_nt p)/W_tt     U_n = −w − W_nt U_t⁻/W_tt + (det W/W_tt) p        if μ W_tt ≥ |W_nt|
//!                reverses    q = μ s (p − 2P_s)            U_n = −w − 2 μ s W_nt P_s + (W_nn + μ s W_nt) p   otherwise
//!     Newton  U_n(p) = e w ,     Poisson  p = (1 + e) p_c with U_n(p_c) = 0 ,
//!     Stronge, stop before p_c:  U_n⁺² = e² (k (w + |U_n(P_s)|) P_s + U_n(P_s)²) ,   k = dU_n/dp after the stop
//! ```

use moreau_exact::scalar::Scalar;

/// W = (nn, nt, tt), the approach speed w > 0, the sliding velocity U_t⁻ ≠ 0 and μ.
///
/// # Source
/// Routh 1905; Wang and Mason 1992; Stronge 1990.
///
/// ```
/// use moreau_exact::scalar::{Rational, ratio};
/// use moreau_forms::rough_impact::{Regime, RoughImpact};
///
/// let [cos, sin]: [Rational; 2] = [ratio(3, 5), ratio(4, 5)];
/// let rod = RoughImpact::rod(&ratio(1, 1), [cos, sin], [ratio(-1, 1), ratio(1, 1)], ratio(1, 2));
/// assert_eq!(rod.delassus, [ratio(52, 25), ratio(-36, 25), ratio(73, 25)]);
/// assert_eq!(rod.regime(), Regime::Sticks);
/// assert_eq!(rod.newton(&ratio(0, 1)), rod.poisson(&ratio(0, 1))); // without restitution the laws agree
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RoughImpact<T: Scalar> {
    /// W_nn, W_nt, W_tt \[1/kg\].
    pub delassus: [T; 3],
    /// w = −U_n⁻ \[m/s\].
    pub approach: T,
    /// U_t⁻ \[m/s\].
    pub slide: T,
    /// μ.
    pub friction: T,
}

/// What the contact does when its slip is not the initial one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// It never stops sliding.
    Slides,
    /// It sticks after the stop.
    Sticks,
    /// It slides the other way after the stop.
    Reverses,
}

impl<T: Scalar> RoughImpact<T> {
    /// The uniform rod of mass m and length 2l that touches with one end, at the angle with cosine c and sine s from the ground:
    /// W = (1 + 3c², −3cs, 1 + 3s²)/m.
    pub fn rod(mass: &T, direction: [T; 2], velocity: [T; 2], friction: T) -> Self {
        let [c, s] = direction;
        let [slide, approach] = [velocity[1].clone(), -velocity[0].clone()];
        let three = T::ratio(3, 1);
        let diagonal = |x: T| (T::one() + three.clone() * x.clone() * x) / mass.clone();
        let coupling = -three.clone() * c.clone() * s.clone() / mass.clone();
        RoughImpact { delassus: [diagonal(c), coupling, diagonal(s)], approach, slide, friction }
    }

    fn sense(&self) -> T {
        if self.slide < T::zero() { -T::one() } else { T::one() }
    }

    /// μ s W_nt.
    fn drag(&self) -> T {
        self.friction.clone() * self.sense() * self.delassus[1].clone()
    }

    /// P_s, the normal impulse at which the slip stops; none if it does not.
    pub fn stop(&self) -> Option<T> {
        let braking = self.friction.clone() * self.delassus[2].clone() - self.sense() * self.delassus[1].clone();
        (braking > T::zero()).then(|| self.slide.magnitude() / braking)
    }

    /// What follows the first slip.
    pub fn regime(&self) -> Regime {
        match self.stop() {
            None => Regime::Slides,
            Some(_) if self.friction.clone() * self.delassus[2].clone() >= self.delassus[1].magnitude() => Regime::Sticks,
            Some(_) => Regime::Reverses,
        }
    }

    /// U_n = offset + slope · p after the stop.
    fn after_stop(&self, stop: &T) -> [T; 2] {
        let [nn, nt, tt] = self.delassus.clone();
        if self.regime() == Regime::Sticks {
            let offset = -self.approach.clone() - nt.clone() * self.slide.clone() / tt.clone();
            [offset, (nn * tt.clone() - nt.clone() * nt) / tt]
        } else {
            let offset = -self.approach.clone() - T::ratio(2, 1) * self.drag() * stop.clone();
            [offset, nn + self.drag()]
        }
    }

    /// U_n at the stop \[m/s\].
    pub fn normal_velocity_at_stop(&self) -> Option<T> {
        self.stop().map(|stop| (self.delassus[0].clone() - self.drag()) * stop - self.approach.clone())
    }

    /// p with U_n(p) = velocity ≥ 0.
    pub fn impulse_reaching(&self, velocity: &T) -> T {
        match self.stop() {
            Some(stop) if self.normal_velocity_at_stop().is_some_and(|at_stop| at_stop < *velocity) => {
                let [offset, slope] = self.after_stop(&stop);
                (velocity.clone() - offset) / slope
            }
            _ => (velocity.clone() + self.approach.clone()) / (self.delassus[0].clone() - self.drag()),
        }
    }

    /// (p, q(p)).
    pub fn impulse(&self, normal: T) -> [T; 2] {
        let sliding = -self.friction.clone() * self.sense();
        let friction_impulse = match (self.stop(), self.regime()) {
            (Some(stop), Regime::Sticks) if normal > stop => {
                -(self.slide.clone() + self.delassus[1].clone() * normal.clone()) / self.delassus[2].clone()
            }
            (Some(stop), Regime::Reverses) if normal > stop => sliding * (T::ratio(2, 1) * stop - normal.clone()),
            _ => sliding * normal.clone(),
        };
        [normal, friction_impulse]
    }

    /// P under Newton's law.
    pub fn newton(&self, restitution: &T) -> [T; 2] {
        self.impulse(self.impulse_reaching(&(restitution.clone() * self.approach.clone())))
    }

    /// P under Poisson's law.
    pub fn poisson(&self, restitution: &T) -> [T; 2] {
        self.impulse((T::one() + restitution.clone()) * self.impulse_reaching(&T::zero()))
    }

    /// U_n⁺² under Stronge's law, if the slip stops in compression.
    pub fn stronge_speed_squared(&self, restitution: &T) -> Option<T> {
        let (stop, velocity) = (self.stop()?, self.normal_velocity_at_stop()?);
        let [_, slope] = self.after_stop(&stop);
        let work = slope * (self.approach.clone() - velocity.clone()) * stop + velocity.clone() * velocity.clone();
        (velocity <= T::zero()).then(|| restitution.clone() * restitution.clone() * work)
    }

    /// ΔT = PᵀU⁻ + ½PᵀWP \[J\].
    pub fn energy_change(&self, impulse: &[T; 2]) -> T {
        let ([nn, nt, tt], [p, q]) = (self.delassus.clone(), impulse.clone());
        let quadratic = nn * p.clone() * p.clone() + T::ratio(2, 1) * nt * p.clone() * q.clone() + tt * q.clone() * q.clone();
        q * self.slide.clone() - p * self.approach.clone() + T::ratio(1, 2) * quadratic
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    /// 1 kg at 45° (c s = ½, c² = s² = ½), U⁻ = (−1, 3/5).
    fn rod(friction: Rational) -> RoughImpact<Rational> {
        let delassus = [ratio(5, 2), ratio(-3, 2), ratio(5, 2)];
        RoughImpact { delassus, approach: ratio(1, 1), slide: ratio(3, 5), friction }
    }

    #[test]
    fn the_rod_on_a_rough_plane_sticks_with_mu_1_and_turns_round_with_one_half() {
        let (rough, smooth) = (rod(ratio(1, 1)), rod(ratio(1, 2)));
        assert_eq!((rough.regime(), smooth.regime()), (Regime::Sticks, Regime::Reverses));
        assert_eq!(rod(ratio(3, 5)).regime(), Regime::Sticks);
        assert_eq!(rough.newton(&ratio(1, 1)), [ratio(41, 40), ratio(3, 8)]);
        assert_eq!(smooth.newton(&ratio(1, 1)), [ratio(368, 385), ratio(20, 77)]);
        assert_eq!(smooth.poisson(&ratio(1, 1)), [ratio(296, 385), ratio(64, 385)]);
    }

    #[test]
    fn the_rod_gains_nine_eightieths_under_newton_and_loses_under_poisson() {
        let rough = rod(ratio(1, 1));
        let gain = |e: Rational| rough.energy_change(&rough.newton(&e));
        assert_eq!(gain(ratio(1, 1)), ratio(9, 80));
        assert_eq!(gain(ratio(4, 5)), ratio(0, 1));
        assert_eq!(gain(ratio(0, 1)), ratio(-1, 5));
        assert_eq!(rough.energy_change(&rough.poisson(&ratio(1, 1))), ratio(-9, 125));
        assert_eq!(rough.stronge_speed_squared(&ratio(1, 1)), Some(ratio(310, 625)));
    }

    #[test]
    fn the_rod_s_delassus_operator_is_that_of_its_angle() {
        let [c, s] = [ratio(3, 5), ratio(4, 5)];
        let rod = RoughImpact::rod(&ratio(2, 1), [c.clone(), s.clone()], [ratio(-1, 1), ratio(1, 1)], ratio(0, 1));
        // end at l(−c, −s) from the centre, rows n = (0, 1, −l c), t = (1, 0, l s), I = m l²/3
        let arm = |x: &Rational, y: &Rational| ratio(3, 2) * x * y;
        let half = ratio(1, 2);
        assert_eq!(rod.delassus, [&half + arm(&c, &c), -arm(&c, &s), &half + arm(&s, &s)]);
    }

    #[test]
    fn a_slip_that_never_stops_has_no_stop() {
        // W_nt > μ W_tt drives the slide on
        let pushed = RoughImpact { delassus: [ratio(5, 2), ratio(3, 2), ratio(5, 2)], ..rod(ratio(1, 2)) };
        assert_eq!((pushed.regime(), pushed.stop()), (Regime::Slides, None));
        assert_eq!(pushed.newton(&ratio(1, 1)), [ratio(8, 7), ratio(-4, 7)]);
        assert_eq!(pushed.newton(&ratio(1, 1)), pushed.poisson(&ratio(1, 1)));
    }
}
