//! What happens between two bodies: friction, levers, edges and the values of a pair. Most scenes have no gravity and no ground, so that
//! nothing depends on the step but where the bodies meet.
//!
//! ```text
//!     p on the one, −p on the other, at one point:   Σ m v and Σ x × m v + J ω stay,   J_i Δω_i = l_i × p_i
//!     W_n p_n = (1 + e) |u_n| ,    ‖p_t‖ = min(μ p_n, ‖u_t‖/W_t)
//! ```

mod ball_on_box;
mod bars;
mod central;
pub(super) mod compliant;
mod corner;
mod directions;
mod encounter;
mod faces;
mod friction;
mod held;
mod landings;
mod materials;
pub(super) mod meeting;
mod off_centre;
mod planks;
mod rough;
mod spheres;
pub(super) mod strike;
mod support;
pub(super) mod view;
mod woken;

use crate::check::{Control, Expected, Level, Run};
use crate::{Check, Verdict};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "pair/oblique-spheres",
        level: Level::Simulate,
        question: "Do two spheres that meet with slip push and turn each other, equally and oppositely, with Coulomb's friction?",
        derivation: "Without gravity only the impact changes anything. Two solid spheres have W_n = 1/m̄ and W_t = 7/2 · 1/m̄, \
            uncoupled. So friction is μ p_n against the slip, whatever p_n is, if that does not end the slip; otherwise it is 2/7 m̄ \
            u_t, with restitution, too. p acts at one point: J_i Δω_i = l_i × p_i, and both momenta stay. Spinning spheres that fly \
            along their line of centres meet with an exact normal, and their levers are off by u h at most. When one flies past the \
            other's centre the line turns by at most b s/(R − s)². Convex laws are replayed. Not measured: friction that lags behind \
            its normal impulse or softens with it, the end of slip where contacts yield along the surface, and flight with contacts \
            that last or hop.",
        source: "closed form of the impact of spheres with friction; Goldsmith, Impact",
        run: Run::EachStep(spheres::oblique_spheres),
        control: Control { passes: "moreau-jean", fails: "pair/friction-turns-the-first-only" },
    },
    Check {
        name: "pair/crossed-bars",
        level: Level::Simulate,
        question: "Do two bars that meet edge on edge push, turn and rub each other as the inverse mass at that point and μ say?",
        derivation: "The edges are horizontal and cross beside the middle of both bars: W_n = Σ 1/m + a²/J with exact levers, at \
            whatever distance the contact acts, W_n p = (1 + e)|u_n| and J_i Δω_i = l_i × p. In a plastic impact the bars roll on each \
            other's edges, which close with c(ω₁² + ω₂²) and give a later part of the impulse. The e of a compliant contact is \
            that of its replayed map, where it is replayed. The same holds when the whole scene is turned and the lower bar is \
            listed first. Where they cross at their \
            middles and the upper one slips along itself, W_nt = 0 and p_t = μ p_n. Boxes that touch with spheres at their corners have \
            no edges.",
        source: "closed form of the impact at one point",
        run: Run::EachStep(bars::crossed_bars),
        control: Control { passes: "moreau-jean", fails: "pair/no-edge-on-edge" },
    },
    Check {
        name: "pair/ball-on-box",
        level: Level::Simulate,
        question: "Does a ball meet a free box, lie on a box and roll on it as a ball does?",
        derivation: "A spinning ball hits the middle of a face: W_n = 1/m + 1/M and W_t = 1/m + R²/J + 1/M + a²/J', uncoupled, so that \
            ‖p_t‖ = min(μ p_n, u_t/W_t), W_n p_n = (1 + e)|u_n|; both are turned by l × p. The same holds when the whole scene is \
            turned and the box is listed first. The turned face closes again, with a later part of the impulse. A ball that was set \
            down lies on the box, found late by 3/2 g h² for each contact, or as deep as declared. A ball thrown along a heavy box on \
            the floor, which holds it, ends with 5/7 of its speed whatever friction did.",
        source: "closed form of the impact with friction at one point; Newton–Euler",
        run: Run::EachStep(ball_on_box::ball_on_box),
        control: Control { passes: "moreau-jean", fails: "pair/sphere-through-box" },
    },
    Check {
        name: "pair/material-pairs",
        level: Level::Simulate,
        question: "Does every pair of bodies have the friction and the restitution that the scene gives for it?",
        derivation: "Six pairs of every two shapes meet in the same step, far from each other, each with μ and e of its own and with other \
            common values: p_t = μ p_n and p_n = (1 + e) m̄ |u_n| of each. Both orders occur in which the scene lists two bodies, and in \
            which an override names them. A ball and a plate land without gravity with theirs, of which one names the ground first. A \
            plank that slides on a plank is braked with μ g, and both keep their momentum, on a floor whose pair with the lower one has no \
            friction. An engine without restitution is asked for friction only; a hard contact of an associated law opens by its slip, \
            and its e is not measured.",
        source: "the fields `material.pairs` of `scene/1`",
        run: Run::EachStep(materials::material_pairs),
        control: Control { passes: "moreau-jean", fails: "pair/material-pairs-ignored" },
    },
    Check {
        name: "pair/any-direction",
        level: Level::Simulate,
        question: "Do spheres, balls and boxes, and plates rub on each other with μ against the slip, in any direction and order?",
        derivation: "Bodies meet along x in free fall, where gravity changes no relative motion, and slip to the end along (0, 4, 3)/5, by \
            spin or by flight. Along each n, W is the same for every tangent, so that p_t = μ p_n stays opposed to the slip, for μ up to \
            3/2 and slips up to 30 m/s. The corners of a plate that meets a plate with its face all slip alike: their sum does the same. \
            Both momenta stay, and L = l × p of spheres has no part along n though they spin about it: a point does not drill. A contact \
            that lasts moves by its slip and turns its normal: levers, ratio and later impulses are off by that.",
        source: "closed form of the impact with friction at one point; Newton–Euler",
        run: Run::EachStep(directions::any_direction),
        control: Control { passes: "moreau-jean", fails: "pair/friction-of-boxes-at-their-centres" },
    },
    Check {
        name: "pair/woken",
        level: Level::Simulate,
        question: "Does a body that has rested for two seconds move when it is hit, and a slow one go on?",
        derivation: "One ball rests for 2.1 s, in space or on a floor without friction; then another one of its mass and size hits it \
            centrally. Along the line of centres only the impact acts: Σ m v_x stays and p = m̄ |u| (1 + e) with e = 0, that of its \
            replayed map \
            for a compliant contact. Both lie equally deep. A free sphere keeps 10 mm/s and 10 mrad/s: engines let bodies sleep there.",
        source: "Newton's first law; closed form of the central impact",
        run: Run::EachStep(woken::woken),
        control: Control { passes: "moreau-jean", fails: "pair/asleep-for-good" },
    },
    Check {
        name: "pair/held",
        level: Level::Simulate,
        question: "Does a box stick to a box on a slope that is less steep than their friction?",
        derivation: "As incline/stick, but on a heavy box that lies on the slope: tan 20° = 0.36 < μ = ½ for both, so that Coulomb's \
            answer is rest of the one on the other. Measured is their displacement against each other over the second half. A compliant or \
            regularised law creeps at the slip that it declares; on a body of 1 % of the inverse mass by at most twice that.",
        source: "Coulomb's law: rest exactly for tan α ≤ μ",
        run: Run::EachStep(held::held_by_a_box),
        control: Control { passes: "moreau-jean", fails: "pair/boxes-never-stick" },
    },
    Check {
        name: "pair/plank-on-plank",
        level: Level::Simulate,
        question: "Is a plank that slides on another one, along no edge, braked with μ g against its slide, for as long as it slides?",
        derivation: "The floor holds the lower plank, μ m g ≤ μ (m + M) g. So ‖v_t‖ + μ v_n = v₀ − μ g t for every sequence of normal \
            impulses, as on the floor itself (incline/slide), whatever contact points carry the plank. It slides along (4, 3)/5 of its \
            edges; with d directions of friction the slip turns, and μ cos(π/d) to μ act against it, with a pyramid μ/√2 to √2 μ, of \
            p_n/m = g t + v_n: a part c of μ leaves (1 − c) μ v_n of the sum. Friction is along the slide only where all \
            points slip alike: what goes aside is not asked of pyramids, of contacts that yield, hop, or open when their depth has been \
            taken back, nor in single precision. A law that hops and \
            whose friction softens with the force of each landing brakes with up to that.",
        source: "Coulomb's law and the balance of momentum",
        run: Run::EachStep(planks::plank_on_plank),
        control: Control { passes: "moreau-jean", fails: "pair/friction-with-the-ground-only" },
    },
    Check {
        name: "pair/central",
        level: Level::Simulate,
        question: "Do balls and boxes of 10 g to 400 kg that meet centrally exchange momentum with e, fast and slowly?",
        derivation: "Without friction and with the centres on the line of impact nobody turns: m v + M V stays and v⁺ − V⁺ = −e (v − \
            V), for one point of contact or many. Every pair of shapes meets with e = 0.3 and e = 1 at 2.5 m/s and with e = 1 at 0.125 \
            m/s, along no axis of the world. A step carries the centre of a ball of 8 mm into the box. Ball on a box on the floor: e \
            |u|, up to (1 + e) m/M, whether both impacts are solved together or one after the other. Laws without e are asked \
            for e = 0: rigid ones return nothing, compliant ones what their replayed map returns, with 4 to 8 \
            points between two faces; where no map is replayed e is not asked. A declared spring and damper is not asked for bodies \
            too light for its own steps, n τ c/m̄ ≥ 1 or n τ² k/m̄ ≥ 1 with \
            n = 8 points between two faces.",
        source: "closed form of the central impact; Newton's law",
        run: Run::EachStep(central::central),
        control: Control { passes: "moreau-jean", fails: "pair/no-mass-above-100-kg" },
    },
    Check {
        name: "pair/off-centre",
        level: Level::Simulate,
        question: "Does a ball push and turn a box by its face, its edge and its corner, however the box is turned and listed?",
        derivation: "The ball flies along n at a place of the box, which is the nearest to its centre at any distance: W_n = 1/m + 1/M \
            + (l × n)·J⁻¹(l × n), W_n p = (1 + e)|u_n|, the box gains l × p n and the ball does not turn. J is given with the box and \
            is not the solid's. Contacts that last move along the box: by at most ω|l| for the time they last, which is a step – an \
            implicit scheme may take the bodies at its end –, or the whole motion for a compliant law, whose e is that of its map \
            replayed with 1/W_n for the mass; \
            Drake's SAP, whose softness depends on more, is not asked for e.",
        source: "closed form of the impact at one point",
        run: Run::EachStep(off_centre::off_centre),
        control: Control { passes: "moreau-jean", fails: "pair/box-has-faces-only-for-balls" },
    },
    Check {
        name: "pair/faces",
        level: Level::Simulate,
        question: "Do two boxes part with e whose faces meet beside their centres, and where does the impulse act?",
        derivation: "0 ≤ p ⟂ u⁺ + e u⁻ ≥ 0 at every corner of the common part of the faces, u⁻ = −v, u linear in the place. If all part \
            alike, both boxes have the same spin, which puts the impulse at y = d J₁/(J₁ + J₂) from the first centre, in each direction \
            along the faces, and W_n = 1/m + 1/M + Σ d²/(J₁ + J₂). That is so if this place is on both faces; otherwise the impulse acts \
            at the nearest edge of both, and the rest opens faster. The motion is unique, the parts of the corners are not and are not \
            asked; a test solves the four corners in rationals. Springs press in the middle of the common part, where equal moments put \
            the impulse, too: compliant laws are asked for those only, with 2, 4 or 8 points. With spheres at the corners there are 2.",
        source: "Newton's law at every point; Moreau's impact law of several contacts",
        run: Run::EachStep(faces::faces),
        control: Control { passes: "moreau-jean", fails: "pair/faces-bounce-in-the-middle" },
    },
    Check {
        name: "pair/rough-corner",
        level: Level::Simulate,
        question: "Does a box that meets the floor or another box with its corner have friction and restitution at the same time?",
        derivation: "A cube with its corner on the line of impact has J = ⅔ m a² in every direction and l = √3 a: W_n = 1/m and W_t = \
            11/2 · 1/m on the floor, with 1/M and 1/M + b²/J' more on the middle of a box's face, uncoupled. So p_n = (1 + e)|u_n|/W_n \
            and ‖p_t‖ = min(μ p_n, u_t/W_t), and both are turned by l × p. The corner moves along the box before the impact, by at most \
            2 h u_t from its middle. Where an impact takes a second step, the corner has turned by ω h and rises with ω² l h, twice \
            with its coupling, or for as long as it yields. Not measured: as for pair/ball-on-box, and the e of compliant corners with \
            spheres, which touch later and may have another point beside them.",
        source: "closed form of the impact with friction at one point",
        run: Run::EachStep(corner::corner),
        control: Control { passes: "moreau-jean", fails: "pair/rough-boxes-are-plastic" },
    },
    Check {
        name: "pair/support-leaves",
        level: Level::Simulate,
        question: "Do balls fall that have rested on a box for two seconds, when it slides away under them?",
        derivation: "A ball of the box's mass hits the box centrally on a floor without friction, V ≥ v/2. The rear edge passes below \
            the balls at t₀ and is V τ away after that: R − √(R² − V² τ²) ≥ ½ V² τ²/R > ½ g τ² for V² > g R, so that nothing holds them \
            and v_z = −g (t − t₀). V and t₀ are read from the box. A ball at a depth δ is free √(2 R δ)/V later; steps see the edge \
            early or late. An engine that declares an option for sleep is asked without it, after 0.3 s of rest, and with it.",
        source: "Newton; engines that wake what is hit, and not what loses its support",
        run: Run::EachStep(support::support_leaves),
        control: Control { passes: "moreau-jean", fails: "pair/wakes-only-what-is-hit" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected { scheme: "stewart-trinkle", check: "pair/any-direction", verdict: Verdict::Difference, why: ALONG_THE_NEXT_DIRECTION },
    Expected { scheme: "stewart-trinkle", check: "pair/material-pairs", verdict: Verdict::Difference, why: ALONG_THE_NEXT_DIRECTION },
    Expected { scheme: "stewart-trinkle", check: "pair/ball-on-box", verdict: Verdict::Difference, why: ALONG_DIRECTIONS },
    Expected { scheme: "stewart-trinkle", check: "pair/plank-on-plank", verdict: Verdict::Difference, why: ALONG_DIRECTIONS },
    Expected { scheme: "stewart-trinkle", check: "pair/rough-corner", verdict: Verdict::Difference, why: ALONG_DIRECTIONS },
];

const ALONG_DIRECTIONS: &str =
    "friction along d directions of a frame that the slip is not along: cos(π/d) to 1 of μ p_n, up to π/d beside the slip";

const ALONG_THE_NEXT_DIRECTION: &str =
    "friction acts along the nearest of eight directions, π/4 − atan ¾ = 0.142 rad from that of the slip";
