//! What most programs name: `use moreau::prelude::*;`.

pub use moreau_contact::prelude::*;
pub use moreau_dynamics::mechanics::{Mechanism, State};
pub use moreau_dynamics::scenes::{self, Scene};
pub use moreau_dynamics::schemes::{MoreauJean, Scheme, simulate};
pub use moreau_dynamics::trajectory::Recording;
pub use moreau_gate::{Description, Engine, Options, Refusal, Reply};
