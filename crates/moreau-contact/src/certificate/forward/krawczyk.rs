//! A zero of the pattern's equations, enclosed by Krawczyk's operator.
//!
//! ```text
//!     J = D_r + D_y A ,    C ≈ J(x̃)⁻¹ ,    X = x̃ ± η ,
//!     η′ = |C| (|F(x̃)| + |J(X) − J̃| η) + |I − C J̃| η  <  η
//! ```
//! For every x in X, x − C F(x) is in x̃ ± η′, inside of X, because F has the mean value property with J(X). By Brouwer's theorem it has a
//! fixed point there; η′ < η makes I − C J(X) a contraction in the norm max |x_i|/η_i, hence C regular and the fixed point a zero of F, the
//! only one in X. All sums are bounds: the product C J̃ is rounded, and its error is bounded a priori (Rump).

use super::affine::{Affine, times};
use super::case::{Case, ContactState, Equations};
use super::pattern::{Contact, of, places};
use crate::certificate::interval::Interval;
use crate::certificate::planted::{Plant, planted};
use crate::tolerance::proof::{BOXES, CORRECTIONS, ENTRY, INFLATION, SMALLEST_BOX, enlarged, product};
use nalgebra::{DMatrix, DVector};

/// A box with one solution of the equations of a pattern.
pub(super) struct Enclosed {
    /// x̃, one impulse per column of A.
    pub middle: Vec<f64>,
    /// η, as many; zero where the impulse is given.
    pub radius: Vec<f64>,
    /// y of all rows, for every impulse of the box.
    pub velocity: Vec<Interval>,
}

/// Why there is no enclosure: the contact where it failed first.
pub(super) struct Failed {
    pub contact: usize,
}

/// The equations of a pattern that do not follow from others, and the rows whose impulses are unknown, in the columns of A; the others of
/// its columns are given.
pub(super) struct System<'a> {
    pub affine: &'a Affine<'a>,
    pub contacts: &'a [Contact],
    pub cases: &'a [Case],
    /// The unknown rows, which are among the columns of A.
    pub unknown: Vec<usize>,
    /// The rows of as many equations.
    pub equations: Vec<usize>,
}

impl System<'_> {
    fn rows(&self) -> usize {
        self.contacts.first().map_or(1, |contact| contact.rows)
    }

    /// Moves the impulses to a zero of the equations, as near as numbers allow.
    pub fn corrected(&self, mut impulse: Vec<f64>) -> Vec<f64> {
        let mut before = f64::INFINITY;
        for _ in (0..CORRECTIONS).filter(|_| !self.unknown.is_empty()) {
            let all = self.of_contacts(&impulse, None);
            let (value, jacobian) = (self.value(&all), self.jacobian(&all));
            let Some(step) = jacobian.lu().solve(&value) else { break };
            let size = step.amax();
            // no number, or rounding: it does not become smaller any more
            if !(size.is_finite() && size < before) {
                break;
            }
            let places = places(self.affine, self.affine.matrix.nrows());
            for (row, step) in self.unknown.iter().zip(step.iter()) {
                impulse[places[*row].expect("an unknown is a column")] -= step;
            }
            before = size / INFLATION;
        }
        impulse
    }

    /// A box around these impulses with a zero of the equations.
    pub fn enclosed(&self, impulse: Vec<f64>) -> Result<Enclosed, Failed> {
        let (columns, size) = (places(self.affine, self.affine.matrix.nrows()), self.unknown.len());
        if size == 0 {
            let (radius, velocity) = (vec![0.0; impulse.len()], self.affine.at(&impulse));
            return Ok(Enclosed { middle: impulse, radius, velocity });
        }
        let place = |row: &usize| columns[*row].expect("an unknown is a column");
        let middle = self.of_contacts(&impulse, None);
        let jacobian = self.jacobian(&middle);
        let Some(mut inverse) = jacobian.clone().try_inverse() else {
            return Err(Failed { contact: self.unknown.first().map_or(0, |row| row / self.rows()) });
        };
        let mut off = &inverse * &jacobian;
        (0..size).for_each(|i| off[(i, i)] -= 1.0);
        let mut values: Vec<f64> = self.values(&middle).iter().map(|value| value.magnitude()).collect();
        if planted(Plant::Preconditioner) {
            inverse.fill(0.0);
            off.fill(0.0);
        }
        if planted(Plant::Residual) {
            values.fill(0.0);
        }
        let smallest: Vec<f64> = self.unknown.iter().map(|row| SMALLEST_BOX * impulse[place(row)].abs() + f64::MIN_POSITIVE).collect();
        let mut radius: Vec<f64> = times(&inverse, &values).iter().zip(&smallest).map(|(eta, least)| INFLATION * eta + least).collect();
        if planted(Plant::Image) {
            radius.clone_from(&smallest);
        }
        let mut worst = 0;
        for _ in 0..BOXES {
            let mut all = vec![0.0; impulse.len()];
            self.unknown.iter().zip(&radius).for_each(|(row, eta)| all[place(row)] = *eta);
            let [spread, slope] = self.bounds(&impulse, &all, &middle);
            let rounded = product(size);
            let sizes: Vec<f64> = (0..size).map(|i| enlarged(values[i] + spread[i] + rounded * slope[i], 3)).collect();
            let needed: Vec<f64> =
                times(&inverse, &sizes).iter().zip(times(&off, &radius)).map(|(one, other)| enlarged(one + other, 2)).collect();
            if needed.iter().zip(&radius).all(|(needed, radius)| needed < radius) || planted(Plant::Image) {
                let velocity = self.velocities(&impulse, &all);
                return Ok(Enclosed { middle: impulse, radius: all, velocity });
            }
            let ratio = |i: &usize| needed[*i] / radius[*i];
            worst = (0..size).max_by(|i, j| ratio(i).total_cmp(&ratio(j))).unwrap_or(0);
            if !ratio(&worst).is_finite() {
                break;
            }
            radius = needed.iter().zip(&smallest).map(|(needed, least)| INFLATION * needed + least).collect();
        }
        Err(Failed { contact: self.unknown.get(worst).map_or(0, |row| row / self.rows()) })
    }

    /// y for all impulses within these radii.
    pub fn velocities(&self, impulse: &[f64], radius: &[f64]) -> Vec<Interval> {
        let spread = self.affine.spread(radius);
        self.affine.at(impulse).into_iter().zip(spread).map(|(y, spread)| y + Interval::ball(0.0, spread)).collect()
    }

    /// The impulses within these radii of every row; zero where there is none.
    pub fn impulses(&self, impulse: &[f64], radius: Option<&[f64]>) -> Vec<Interval> {
        let mut all = vec![Interval::ZERO; self.affine.matrix.nrows()];
        for (place, row) in self.affine.columns.iter().enumerate() {
            all[*row] = Interval::ball(impulse[place], radius.map_or(0.0, |radius| radius[place]));
        }
        all
    }

    /// The equations of every contact, at impulses or in a box around them.
    fn of_contacts(&self, impulse: &[f64], radius: Option<&[f64]>) -> Vec<Equations> {
        let y = radius.map_or_else(|| self.affine.at(impulse), |radius| self.velocities(impulse, radius));
        let (r, rows) = (self.impulses(impulse, radius), self.rows());
        let at = |k: usize| self.contacts[k].equations(self.cases[k], &of(&r, k, rows)[..rows], &of(&y, k, rows)[..rows]);
        (0..self.contacts.len()).map(at).collect()
    }

    fn values(&self, all: &[Equations]) -> Vec<Interval> {
        self.equations.iter().map(|row| all[row / self.rows()].value[row % self.rows()]).collect()
    }

    fn value(&self, all: &[Equations]) -> DVector<f64> {
        DVector::from_iterator(self.unknown.len(), self.values(all).iter().map(|value| value.middle()))
    }

    /// J̃, of the middles of the derivatives.
    fn jacobian(&self, all: &[Equations]) -> DMatrix<f64> {
        let (rows, columns) = (self.rows(), places(self.affine, self.affine.matrix.nrows()));
        let place: Vec<usize> = self.unknown.iter().map(|row| columns[*row].expect("an unknown is a column")).collect();
        DMatrix::from_fn(self.unknown.len(), self.unknown.len(), |i, j| {
            let (row, other) = (self.equations[i], self.unknown[j]);
            let (k, own, here) = (row / rows, &all[row / rows], row % rows);
            let entry = |c: usize| {
                let (at, moved) = (k * rows + c, self.affine.matrix[(k * rows + c, place[j])]);
                let same = f64::from(u8::from(at == other));
                let pushed = same - self.contacts[k].weights[usize::from(c > 0)] * moved;
                own.by_velocity[here][c].middle() * moved
                    + own.by_impulse[here][c].middle() * same
                    + own.by_pushed[here][c].middle() * pushed
            };
            (0..rows).map(entry).sum()
        })
    }

    /// |I − ρ A| η of the rows of undecided contacts, at least; zero elsewhere.
    fn pushed(&self, radius: &[f64], unsure: &[f64]) -> Vec<f64> {
        let (rows, columns) = (self.rows(), places(self.affine, self.affine.matrix.nrows()));
        let mut found = vec![0.0; self.affine.matrix.nrows()];
        for row in (0..found.len()).filter(|row| self.cases[row / rows].state() == ContactState::Undecided) {
            let weight = self.contacts[row / rows].weights[usize::from(row % rows > 0)];
            let entry = |place: usize| f64::from(u8::from(columns[row] == Some(place))) - weight * self.affine.matrix[(row, place)];
            let rounded = |place: usize| ENTRY * (1.0 + weight * self.affine.matrix[(row, place)].abs());
            let terms = radius.iter().enumerate().filter(|(_, eta)| **eta != 0.0);
            let sum: f64 = terms.map(|(place, eta)| (entry(place).abs() + rounded(place)) * eta).sum();
            found[row] = enlarged(sum + weight * unsure[row], radius.len());
        }
        found
    }

    /// |J(X) − J̃| η and |J̃| η of every equation, at least.
    fn bounds(&self, impulse: &[f64], radius: &[f64], middle: &[Equations]) -> [Vec<f64>; 2] {
        let (rows, boxed) = (self.rows(), self.of_contacts(impulse, Some(radius)));
        let (moved, unsure) = (self.affine.spread(radius), self.affine.uncertain(radius));
        let pushed = self.pushed(radius, &unsure);
        let mut own = vec![0.0; self.affine.matrix.nrows()];
        self.affine.columns.iter().zip(radius).for_each(|(row, eta)| own[*row] = *eta);
        let mut bounds = [Vec::with_capacity(self.unknown.len()), Vec::with_capacity(self.unknown.len())];
        for row in &self.equations {
            let (k, i) = (row / rows, row % rows);
            let (mut spread, mut slope) = (0.0, 0.0);
            for c in 0..rows {
                let (at, weight) = (k * rows + c, self.contacts[k].weights[usize::from(c > 0)]);
                let parts = |of: fn(&Equations) -> &[[Interval; 3]; 3]| {
                    let (middle, boxed) = (of(&middle[k])[i][c].middle(), of(&boxed[k])[i][c]);
                    (boxed.reach(middle), middle.abs(), boxed.magnitude())
                };
                let [velocity, impulse, push] = [parts(|all| &all.by_velocity), parts(|all| &all.by_impulse), parts(|all| &all.by_pushed)];
                spread += velocity.0 * moved[at] + velocity.2 * unsure[at] + impulse.0 * own[at];
                spread += push.0 * pushed[at] + push.2 * weight * unsure[at];
                slope += velocity.1 * moved[at] + impulse.1 * own[at] + push.1 * (own[at] + weight * moved[at]);
            }
            slope = enlarged(slope, 5 * rows);
            bounds[0].push(enlarged(spread + ENTRY * slope, 6 * rows));
            bounds[1].push(slope);
        }
        bounds
    }
}
