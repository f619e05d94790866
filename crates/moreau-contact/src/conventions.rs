//! Units, signs, order of components and symbols – documentation only.
//!
//! # Units
//! SI everywhere: m, s, kg, rad. An **impulse** is in N·s and is never called a force; a **force** is in N.
//!
//! # Order and signs
//! - Contact components come in the order (normal, tangent₁, tangent₂); `rows_per_contact` is 1, 2 or 3.
//! - The gap φ is positive when separated, zero when touching, negative when penetrating.
//! - The rows of H map generalised velocities to contact velocities, u = H v; u_n > 0 separates.
//! - Reactions push: r_n ≥ 0, and M̂(v⁺ − v) = h F + Hᵀ r.
//! - `_pre` / `_post` stand for v⁻ / v⁺.
//! - Polyhedral laws: direction j at angle 2πj/d from tangent₁, r_t = Σ Dⱼβⱼ. In 2D contacts d = 2: ±tangent₁.
//!
//! # Symbols
//! | symbol | field or function | meaning | unit |
//! |---|---|---|---|
//! | W = H M̂⁻¹ Hᵀ | `delassus` | Delassus operator of the step's effective mass | 1/kg |
//! | u_free = H v_free | `free_velocity` | contact velocity without impulses | m/s |
//! | s | `shift` | restitution, φ/h or reference acceleration, added by the scheme | m/s |
//! | R | `compliance` | softness, diagonal | 1/kg |
//! | r | `impulse` | contact impulses | N·s |
//! | u = W r + u_free | `velocity` | physical contact velocity, used for energy | m/s |
//! | y = u + s + R r | `law_velocity` | what the law sees, used for the certificate | m/s |
//! | ŷ = y + μ‖y_t‖ n | `de_saxce` | de Saxcé's corrected velocity | m/s |
//! | K_μ = {‖r_t‖ ≤ μ r_n} | `cones::second_order` | friction cone; dual K* = {u_n ≥ μ‖u_t‖} | N·s |
