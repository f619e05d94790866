//! Friction and restitution of pairs of bodies: common values with exceptions.

use super::point_mass::material;
use moreau_exact::{Error, Result};

/// Friction and restitution of one pair of bodies that differ from the common ones.
#[derive(Clone, Debug, PartialEq)]
pub struct PairMaterial {
    /// The two bodies; `None` is the ground.
    pub bodies: (usize, Option<usize>),
    /// μ ≥ 0.
    pub friction: f64,
    /// e ∈ \[0, 1\].
    pub restitution: f64,
}

/// (μ, e) of every pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Materials {
    friction: f64,
    restitution: f64,
    pairs: Vec<PairMaterial>,
}

impl Materials {
    /// The same μ and e for every pair.
    ///
    /// # Errors
    /// [`Error::Invalid`] if μ < 0 or e ∉ \[0, 1\].
    pub fn new(friction: f64, restitution: f64) -> Result<Self> {
        material(friction, restitution)?;
        Ok(Materials { friction, restitution, pairs: Vec::new() })
    }

    /// The same with exceptions, for a mechanism of `bodies` bodies.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a pair names a body that does not exist, μ < 0 or e ∉ \[0, 1\].
    pub fn with_pairs(self, pairs: Vec<PairMaterial>, bodies: usize) -> Result<Self> {
        for pair in &pairs {
            let last = pair.bodies.0.max(pair.bodies.1.unwrap_or(0));
            if last >= bodies {
                return Err(Error::invalid("pairs", format!("names body {last}"), format!("there are {bodies}")));
            }
            material(pair.friction, pair.restitution)?;
        }
        Ok(Materials { pairs, ..self })
    }

    /// (μ, e) of a pair, whichever body is named first.
    pub fn of(&self, first: usize, second: Option<usize>) -> (f64, f64) {
        let same =
            |pair: &&PairMaterial| pair.bodies == (first, second) || second.is_some_and(|second| pair.bodies == (second, Some(first)));
        self.pairs.iter().find(same).map_or((self.friction, self.restitution), |pair| (pair.friction, pair.restitution))
    }

    /// The largest μ of any pair.
    pub fn largest_friction(&self) -> f64 {
        self.pairs.iter().map(|pair| pair.friction).fold(self.friction, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_exception_holds_for_its_pair_in_either_order_and_for_no_other() {
        let pair = |bodies| PairMaterial { bodies, friction: 0.25, restitution: 1.0 };
        let materials = Materials::new(0.5, 0.0).and_then(|all| all.with_pairs(vec![pair((0, Some(2))), pair((1, None))], 3));
        let materials = materials.expect("valid");
        for (bodies, excepted) in [((0, Some(2)), true), ((2, Some(0)), true), ((1, None), true), ((0, Some(1)), false), ((0, None), false)]
        {
            assert_eq!(materials.of(bodies.0, bodies.1), if excepted { (0.25, 1.0) } else { (0.5, 0.0) });
        }
        let stray = Materials::new(0.5, 0.0).and_then(|all| all.with_pairs(vec![pair((0, Some(3)))], 3));
        assert!(stray.expect_err("no body 3").to_string().contains("names body 3"));
    }
}
