//! The sections of the chapter, in the order in which claims are registered and reported.

/// A section of the chapter: the group its claim ids start with, and its title.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Section {
    /// What the ids start with: `S4` of `S4.copos-plus`, `R` of `R6`.
    pub group: &'static str,
    /// What the section is about.
    pub title: &'static str,
}

/// The text that the claims are of, as far as it says so itself: the title in English, and for whom it is written. Its own title is the
/// first heading of [`crate::claims::PLACES`]; its authors and the book that it belongs to are not named in it.
pub const CHAPTER: &str = "“Contact mechanics, topic 3.0: time-stepping methods and numerical integration – the time discretisation of \
                           nonsmooth contact dynamics”, a Chinese textbook chapter for doctoral students";

const fn section(group: &'static str, title: &'static str) -> Section {
    Section { group, title }
}

/// Every section that claims may belong to: front matter and summary tables first, then §0 to §12, then the manual at the end.
pub const SECTIONS: [Section; 19] = [
    section("P", "Preface and project"),
    section("M", "Table of misconceptions"),
    section("T", "Tables of theorems and symbols"),
    section("S0", "§0 Why time discretisation is a problem of its own"),
    section("S1", "§1 Event-driven methods and time-stepping"),
    section("S2", "§2 The sweeping process and the measure differential inclusion"),
    section("S3", "§3 The Moreau–Jean θ-scheme"),
    section("S4", "§4 Stewart–Trinkle time-stepping"),
    section("S5", "§5 Anitescu's convex relaxation"),
    section("S6", "§6 The soft contact of MuJoCo"),
    section("S7", "§7 Impact laws"),
    section("S8", "§8 Semi-implicit and implicit integration, symplecticity"),
    section("S9", "§9 Penetration, energy and drift"),
    section("S10", "§10 Simulators compared"),
    section("S11", "§11 Convergence proofs"),
    section("S12", "§12 A worked example"),
    section("R", "Troubleshooting manual"),
    section("Pr", "Advice for practice"),
    section("V", "Versions and default values"),
];

/// The place of a group in the chapter's order, `None` if no section has it.
pub fn order(group: &str) -> Option<usize> {
    SECTIONS.iter().position(|section| section.group == group)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn section_ten_comes_after_section_nine_and_unknown_groups_have_no_place() {
        assert!(order("S10") > order("S9"));
        assert!(order("S9") > order("S1"));
        assert!(order("R") > order("S12"));
        assert_eq!(order("S13"), None);
        assert_eq!(order("s4"), None);
    }
}
