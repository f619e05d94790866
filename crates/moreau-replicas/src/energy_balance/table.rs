//! The balance of every scheme in words, for `docs/energy.md`; a test holds the names against [`crate::schemes::NAMES`] and the page
//! against this table.

/// One scheme's row.
pub struct Row {
    /// The scheme's name.
    pub scheme: &'static str,
    /// What bounds T(v⁺).
    pub kinetic: &'static str,
    /// What bounds the total energy of a step.
    pub total: &'static str,
    /// What is not bounded.
    pub open: &'static str,
}

const NEWTON: &str = "T(v⁺) ≤ T(v_free) − Σ e r_n u_n⁻ − ½ rᵀW r";
const GAPS: &str = "T(v⁺) ≤ T(v_free) − Σ r_n φ/h − ½ rᵀW r";
const HUNT_CROSSLEY: &str = "T(v⁺) ≤ T(v_free) − Σ (r_n φ/h + r_n²/(h²k)) − ½ rᵀW r";
const ONE_E: &str = "for one common e, without friction or with e = 0: ΔẼ ≤ (1−e)/(1+e) · h²FᵀM⁻¹F/8 + e/(1+e) r·(u_g − u⁻)";
const BY_WORK: &str = "ΔẼ ≤ −Σ r_n φ/h + h²FᵀM⁻¹F/8, θ = 1";

/// Every scheme, in the order of [`crate::schemes::NAMES`].
pub const ROWS: [Row; 20] = [
    Row {
        scheme: "moreau-jean",
        kinetic: "T̂(v⁺) ≤ T̂(v_free) − r·(e u⁻) − ½ rᵀŴ r, u⁻ its normal part or the full vector",
        total: "for one common e, without friction, with e = 0 or with the full vector reversed: ΔẼ ≤ (1−e)/(1+e) · h²FᵀM⁻¹F/8 \
            + e/(1+e) r·(u_g − u⁻); under linear forces the bound uses M̂, v_free − v and κ = 1/(1+e) − θ",
        open: "unequal e, and normal-only e > 0 with friction: these satisfy only ΔẼ ≤ −r·(e u⁻) + h²FᵀM⁻¹F/8, a bound that needs the \
            impulses",
    },
    Row {
        scheme: "moreau-jean-projection",
        kinetic: "T̂(v⁺) ≤ T̂(v_free) − Σ e r_n u_n⁻ − ½ rᵀŴ r, H at q⁺",
        total: "no theorem: the projection moves bodies along F or against it",
        open: "V, and with it the distances of bodies",
    },
    Row {
        scheme: "schatzman-paoli",
        kinetic: "T(v⁺) ≤ T(v_free) − Σ r_n ((1+e) φ/h − e u_n⁻) − ½ rᵀW r",
        total: "ΔẼ ≤ −Σ r_n ((1+e) φ/h − e u_n⁻) + h²FᵀM⁻¹F/8, θ = 1",
        open: "a depth φ becomes a speed φ/h",
    },
    Row {
        scheme: "generalised-alpha",
        kinetic: "T̂(v⁺) ≤ T̂(v_free) − Σ e r_n u_n⁻ − ½ rᵀŴ r, H after the free step",
        total: "for one common e, without friction or with e = 0, without linear force and without gyroscopic term: \
            ΔE ≤ (1−e)/(1+e) · h²FᵀM⁻¹F/8",
        open: "T(v_free) of bodies with three unequal axes, because the scheme remembers their accelerations; unequal e",
    },
    Row { scheme: "stewart-trinkle", kinetic: GAPS, total: BY_WORK, open: "a depth φ becomes a speed φ/h" },
    Row { scheme: "anitescu", kinetic: GAPS, total: BY_WORK, open: "a depth φ becomes a speed φ/h" },
    Row {
        scheme: "chrono",
        kinetic: "T(v⁺) ≤ T(v_free) − Σ r_n s − ½ rᵀW r, s = e u_n⁻ or max(φ/h, −v_r)",
        total: "ΔẼ ≤ −Σ r_n s + h²FᵀM⁻¹F/8, θ = 1",
        open: "a depth becomes a speed of up to v_r",
    },
    Row {
        scheme: "bullet",
        kinetic: "T(v⁺) ≤ T(v_free) − Σ r_n s − ½ rᵀW r, s = φ'/h or ERP φ'/h less the rebound, φ' = φ + slop",
        total: "multibodies: ΔẼ ≤ −Σ r_n s + h²FᵀM⁻¹F/8, θ = 1",
        open: "e multiplies v_free, so that an elastic ball gains g h per bounce; split impulses of rigid bodies change V",
    },
    Row {
        scheme: "mujoco",
        kinetic: "T(v⁺) ≤ T(v_free) + r·(u⁻ + h a_ref) − fᵀR f − ½ rᵀW r",
        total: "ΔẼ ≤ ½‖v_g − v‖²_M + r·(u⁻ + h a_ref) − fᵀR f + h²FᵀM⁻¹F/8, θ = 1",
        open: "explicit gyroscopic torques gain ½‖v_g − v‖²_M; springs and dampers, implicitfast, RK4 and friction against rotation: no \
            theorem",
    },
    Row {
        scheme: "explicit-euler",
        kinetic: NEWTON,
        total: ONE_E,
        open: "θ = 0: Ẽ = E − ½ h F·v; explicit springs gain; unequal e, e > 0 with friction",
    },
    Row {
        scheme: "semi-implicit-euler",
        kinetic: NEWTON,
        total: ONE_E,
        open: "θ = 1: Ẽ = E + ½ h F·v; springs keep another form; unequal e, e > 0 with friction",
    },
    Row {
        scheme: "runge-kutta-flip",
        kinetic: "T(v⁺) ≤ T(v_free) − Σ e r_n min(u_free,n, 0) − ½ rᵀW r, H at q⁺",
        total: "without gyroscopic term, ΔE is the change of T by contact",
        open: "the free flight of other forces, of order h⁵; a resting body sinks and loses V",
    },
    Row {
        scheme: "event-driven",
        kinetic: "a step poses several problems",
        total: "e = 0, or no friction and one contact: ΔE ≤ 0 up to the method's tolerances",
        open: "several contacts hit at once with e > 0, friction beside e > 0",
    },
    Row {
        scheme: "variational",
        kinetic: "no contact problem: E_d is kept",
        total: "constant force: ΔE = h(h − 2τ)FᵀM⁻¹F/8, within ±h²FᵀM⁻¹F/8, for an impact after τ; 0 without",
        open: "E of forces that are not constant, where E_d alone is kept",
    },
    Row {
        scheme: "xpbd",
        kinetic: "no theorem: v = (q⁺ − q)/h turns position corrections into velocities, and H changes within a sweep",
        total: "no theorem",
        open: "everything, because the sweeps end after a declared number",
    },
    Row {
        scheme: "pbd",
        kinetic: "no theorem: v = (q⁺ − q)/h turns position corrections into velocities, and H changes within a sweep",
        total: "no theorem",
        open: "everything, because the sweeps end after a declared number",
    },
    Row {
        scheme: "drake-sap",
        kinetic: "T(v⁺) ≤ T(v_free) − Σ r_n φ/(h+τ) − rᵀR r − ½ rᵀW r",
        total: "ΔẼ ≤ −Σ r_n φ/(h+τ) − rᵀR r + h²FᵀM⁻¹F/8, θ = 1",
        open: "a depth φ returns energy, at most k φ²/4 for a spring that the step resolves",
    },
    Row {
        scheme: "drake-similar",
        kinetic: HUNT_CROSSLEY,
        total: "the bound on the left, for Ẽ, plus h²FᵀM⁻¹F/8, θ = 1",
        open: "a depth φ returns energy, at most k φ²/4",
    },
    Row {
        scheme: "drake-lagged",
        kinetic: HUNT_CROSSLEY,
        total: "the bound on the left, for Ẽ, plus h²FᵀM⁻¹F/8, θ = 1",
        open: "a depth φ returns energy, at most k φ²/4",
    },
    Row {
        scheme: "drake-tamsi",
        kinetic: HUNT_CROSSLEY,
        total: "the bound on the left, for Ẽ, plus h²FᵀM⁻¹F/8, θ = 1",
        open: "a depth φ returns energy, at most k φ²/4",
    },
];

/// The page `docs/energy.md`.
pub fn page() -> String {
    let mut text = String::from(HEAD);
    for Row { scheme, kinetic, total, open } in &ROWS {
        let place = CHECKED.iter().find(|(names, _)| names.contains(scheme)).map_or("nowhere", |(_, place)| place);
        text.push_str(&format!("| `{scheme}` | {kinetic} | {total} | {open} | {place} |\n"));
    }
    text.push_str(FOOT);
    text
}

/// Which file holds which schemes to their row.
const CHECKED: [(&[&str], &str); 4] = [
    (&["variational", "event-driven"], "`own.rs`"),
    (&["xpbd", "pbd"], "no theorem: no panic and finite numbers only"),
    (&["moreau-jean"], "`waist.rs`, `total.rs`, `gyroscopic.rs`, `linear.rs`"),
    (
        &[
            "moreau-jean-projection",
            "schatzman-paoli",
            "generalised-alpha",
            "stewart-trinkle",
            "anitescu",
            "chrono",
            "bullet",
            "mujoco",
            "explicit-euler",
            "semi-implicit-euler",
            "runge-kutta-flip",
            "drake-sap",
            "drake-similar",
            "drake-lagged",
            "drake-tamsi",
        ],
        "`waist.rs`, `total.rs`, `gyroscopic.rs`",
    ),
];

const HEAD: &str = "# The energy balance of every scheme

Written from `crates/moreau-replicas/src/energy_balance/table.rs`; a test compares the two, and the names with `schemes::NAMES`.

u = W r + u_free, y = u + shift + R r; T = ½ vᵀM v, and T̂ with the effective mass M̂ of a step with linear forces; F the constant force \
(gravity), θ of
q⁺ = q + h (θ v⁺ + (1−θ) v), Ẽ = T + V + (θ−½) h F·v; u⁻ = H v before the step, v_g the velocity after torque-free rotation alone, u_g = H \
v_g; f edge impulses. Every bound
is up to rounding and the work w = Σ max(0, r_k·y_k) of the step's residual, which an accepted step keeps below 10⁻⁸ of s Σ (s ‖diag W_kk‖ \
+ ‖q_k‖ + ‖(W r)_k‖), s the largest ‖r_j‖ or ρ_n|q_n|.

For every impulse T(v⁺) = T(v_free) + r·u⁺ − ½ rᵀW r; for every law r·u⁺ ≤ −r·(shift + R r) + w. Rotation enters by v_g: the mean torque \
over a step keeps T, and
‖v_g − v‖_M ≤ h (Σ (2 T_rot √J_max/J_min)²)^½.

| scheme | kinetic energy | total energy of a step | not bounded | checked in `crates/moreau-replicas/src/energy_balance/` |
|---|---|---|---|---|
";

const FOOT: &str = "
Each is checked on every step of the random scenes of `tests/random_scenes/`, with the distance that a body can have come on the energy \
allowed (`reach.rs`), and fails on
the planted mistakes of `defects.rs` there.
";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schemes::NAMES;

    #[test]
    fn every_scheme_has_a_row_and_every_row_a_place_where_it_is_checked() {
        assert_eq!(ROWS.iter().map(|row| row.scheme).collect::<Vec<_>>(), NAMES);
        assert!(!page().contains("| nowhere |"));
        // a bar within a cell would begin another
        assert!(page().lines().filter(|line| line.starts_with('|')).all(|line| line.matches('|').count() == 6));
    }

    #[test]
    fn a_row_without_a_theorem_is_one_of_a_scheme_without_one() {
        for row in &ROWS {
            let balance = crate::energy_balance::Balance::of(row.scheme, &Default::default()).expect("a listed scheme");
            assert_eq!(balance.is_theorem(), !row.kinetic.starts_with("no theorem"), "{}", row.scheme);
        }
    }
}
