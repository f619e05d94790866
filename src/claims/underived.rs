//! Claims whose findings do not carry their verdict yet: what the sentence says of each instance is still to be written beside them.
//!
//! A claim that stands here is judged by its recorded verdict, as all were before. A test keeps the list honest: what can be
//! derived may not stand here.

/// Their ids.
pub const UNDERIVED: &[&str] = &[
    // s2
    // s3
    // s4
    // s5
    // s6
    // s7
    "S7.ex2",
    "S7.kane-multi",
    "S7.kane-different-e",
    "S7.moreau-def",
    "S7.moreau-dissipative",
    "S7.moreau-no-split",
    "S7.no-tangential-restitution",
    "S7.friction-bound",
    "S7.newton-single",
    "S7.four-generations",
    "S7.table-newton",
    "S7.e0-max-dissipation",
    "S7.newton-pointwise-best",
    "S7.poisson-def",
    "S7.poisson-conserved",
    "S7.poisson-better",
    "S7.newton-neq-poisson-multi",
    "S7.compression-end",
    "S7.multi-nonunique",
    "S7.four-corners",
    "S7.solver-pivot",
    "S7.fremond-2024",
    "S7.pfeiffer-glocker-proj",
    "S7.stronge-def",
    "S7.stronge-conserves",
    "S7.e-not-material",
    "S7.e1-single-conserves",
    // s10
    // s11
    "S11.bv",
    "S11.impulse-infinite",
    "S11.step4",
    "S11.no-taylor",
    "S11.fem-refs",
    "S11.painleve",
    "S11.friction-split",
    "S11.dmm",
    "S11.discontinuous-friction",
    "S11.ten-years",
    "S11.reflection-symplectic",
    "S11.no-symplectic-contact",
    "S11.explicit-or-implicit",
    "S11.ex3",
    // s12
    // v
];
