//! Restitution of boxes, at slow impacts, with friction, and of contacts that open: one impact each.
//!
//! ```text
//!     four corners of a flat box         v⁺ = −e v ,  ω⁺ = 0
//!     one corner without friction        p = (1 + e) |u_n|/W_nn ,   W_nn = 1/m + (l × n)·J⁻¹(l × n)
//!     a solid sphere with friction       p_t = min(μ p_n, u_t/W_tt) ,   W_tt = 1/m + ℓ²/J ,   p_n = (1 + e) m |u_n|
//!     a contact that opens               p = 0, or what stops it if it is pressed
//!     a bar that only turns              p = (1 + e) ω ℓ/W_nn
//! ```
//! No box spins before its impact but the bar, so that the lever of a corner does not depend on when the contact is found. There is no
//! gravity but for the contact that is pressed. So no number depends on h, except where it is said.

mod declared;
mod landing;
mod opening;
mod scene;
mod slow;
pub(super) mod spinning;
mod turning;

use crate::check::{Control, Expected, Run};
use crate::{Check, Level};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "bounce/flat-box",
        level: Level::Simulate,
        question: "Does a box that lands flat, with e = 1/2 at each corner, go back at half its speed without spin?",
        derivation: "Newton's law at every corner, u⁺ = −e u, has one solution for the motion: v⁺ = −e v, ω⁺ = 0, however the impulse is \
            distributed over the corners and whichever of them are reported. There is no gravity, so that v⁺ does not depend on h. A \
            solver may leave a part √2⁻²³ of the impulse (1 + e) m v, at most at the lever of a corner.",
        source: "Newton's law; Moreau's impact law of several contacts",
        run: Run::EachStep(landing::flat),
        control: Control { passes: "moreau-jean", fails: "bounce/first-contact-only" },
    },
    Check {
        name: "bounce/corner",
        level: Level::Simulate,
        question: "Do a cube and a brick that land on one corner have the speed and the spin of a single impact?",
        derivation: "p = (1 + e) v/W_nn, v_z⁺ = −v + p/m, ω⁺ = J⁻¹(l × n) p, W_nn = 1/m + (l × n)·J⁻¹(l × n). The body does not spin \
            before the impact, so that l × n is the same wherever on its way the contact is found and wherever on the normal it acts; only \
            an implicit scheme may turn it by up to h ω⁺. The energies know no lever: ω·Jω = p² (W_nn − 1/m), e = (ω·Jω/p + p/m)/v − 1. No \
            other corner comes near before the last sample. The brick's spin then turns with at most ω² (J_max/J_min)(J_max − \
            J_min)/J_min, the cube's does not.",
        source: "closed form of an eccentric impact without friction; Newton's law",
        run: Run::EachStep(landing::corner),
        control: Control { passes: "moreau-jean", fails: "bounce/mean-inertia" },
    },
    Check {
        name: "bounce/slow",
        level: Level::Simulate,
        question: "Is the restitution of a ball the same at 0.02, 0.05, 0.2 and 1 m/s?",
        derivation: "Newton's law knows no speed: v⁺ = −e v. There is no gravity, so that no speed is small against g h. A threshold that \
            is declared is predicted; another is a mistake. The speeds are a little off round numbers, which thresholds are.",
        source: "Newton's law",
        run: Run::EachStep(slow::slow),
        control: Control { passes: "moreau-jean", fails: "bounce/silent-threshold" },
    },
    Check {
        name: "bounce/every-step",
        level: Level::Simulate,
        question: "Is the restitution of a ball the same at every time step from 1/30 s to 0.1 ms?",
        derivation: "Newton's law knows no time step: v⁺ = −e v, without gravity. This check goes through the time steps of the whole \
            sweep by itself, whichever sweep is asked for: it takes a few hundred steps.",
        source: "Newton's law",
        run: Run::Once(slow::every_step),
        control: Control { passes: "moreau-jean", fails: "bounce/plastic-at-small-steps" },
    },
    Check {
        name: "bounce/spinning-ball",
        level: Level::Simulate,
        question: "What are speed, spin and angle of a spinning ball after a bounce with e = 1/2 and μ = 0.3, slipping and sticking?",
        derivation: "The normal of a sphere goes through its centre, so that friction does not change what e acts on: p_n = (1 + e) m v. \
            Slipping, p_t = μ p_n; sticking, the contact point ends at rest, p_t = u_t/(1/m + ℓ²/J), 2/7 m u_t for ℓ = R. The contact may \
            be found up to the way d of two steps from the floor and act there, |ℓ − R| ≤ d. Each quantity is monotone in e, μ and ℓ.",
        source: "closed form of a sphere's impact; R. Cross, Grip-slip behavior of a bouncing ball, Am. J. Phys. 70 (2002)",
        run: Run::EachStep(spinning::spinning),
        control: Control { passes: "moreau-jean", fails: "bounce/tangential-restitution" },
    },
    Check {
        name: "bounce/separating",
        level: Level::Simulate,
        question: "Is a contact that opens left alone, and only stopped if gravity presses it?",
        derivation: "Bodies that overlap and part have u_n > 0: no impulse, whatever e; also taking back the whole depth in a step asks \
            for 0.6 u_n only. A ball that rises with 0.9 g h from 0.54 g h² below the floor has −0.1 g h after a step of free fall. \
            Signorini's law stops it at 0, Newton's law u_n⁺ ≥ −e u_n leaves it, and an engine that takes e of the velocity after gravity \
            returns 0.1 e g h. A rebound e u_n of a contact that opens would be 0.45 g h, a pull −0.45 g h.",
        source: "Moreau: r (u⁺ + e u) = 0, r ≥ 0; Newton's law",
        run: Run::EachStep(opening::separating),
        control: Control { passes: "moreau-jean", fails: "bounce/opening-contact-bounces" },
    },
    Check {
        name: "bounce/turning-bar",
        level: Level::Simulate,
        question: "Does a bar that only turns, its centre at rest, bounce where it strikes the floor or a ball?",
        derivation: "e acts on the velocity of the contact, here ω ℓ, and not on that of the centres, which is 0: p = (1 + e) ω ℓ/W_nn, \
            W_nn = 1/m + 1/M + ℓ²/J. The impulse's power Σ (p·v + L·ω), L = ℓ × p, is p u_n, so that −e is its ratio after over before, \
            whatever the lever. The bar turns while the contact is found, by at most the angle of two steps, and the approach may be \
            taken with a lever as much older; p is monotone in ℓ for ℓ² > J (1/m + 1/M).",
        source: "Newton's law at the contact point; closed form of an eccentric impact without friction",
        run: Run::EachStep(turning::turning),
        control: Control { passes: "moreau-jean", fails: "bounce/approach-of-centres" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected::without_restitution("stewart-trinkle", "bounce/flat-box"),
    Expected::without_restitution("stewart-trinkle", "bounce/corner"),
    Expected::without_restitution("stewart-trinkle", "bounce/slow"),
    Expected::without_restitution("stewart-trinkle", "bounce/every-step"),
    Expected::without_restitution("stewart-trinkle", "bounce/spinning-ball"),
    Expected::without_restitution("stewart-trinkle", "bounce/separating"),
    Expected::without_restitution("stewart-trinkle", "bounce/turning-bar"),
    Expected::without_restitution("anitescu", "bounce/flat-box"),
    Expected::without_restitution("anitescu", "bounce/corner"),
    Expected::without_restitution("anitescu", "bounce/slow"),
    Expected::without_restitution("anitescu", "bounce/every-step"),
    Expected::without_restitution("anitescu", "bounce/spinning-ball"),
    Expected::without_restitution("anitescu", "bounce/separating"),
    Expected::without_restitution("anitescu", "bounce/turning-bar"),
];

#[cfg(test)]
mod tests;
