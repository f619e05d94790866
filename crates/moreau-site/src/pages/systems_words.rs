//! What the systems say of their algorithm, restitution, positions and of what they are held against, in Chinese.

/// The texts of the systems with words in them, and their Chinese.
const CHINESE: [(&str, &str); 36] = [
    ("block projected Gauss–Seidel, accelerated", "分块投影 Gauss–Seidel，加速"),
    ("block projected Gauss–Seidel, accelerated; projected gradient; interior point", "分块投影 Gauss–Seidel（加速）；投影梯度；内点法"),
    ("Lemke on accelerations; block projected Gauss–Seidel at impacts", "加速度上用 Lemke；碰撞时用分块投影 Gauss–Seidel"),
    ("discrete Euler–Lagrange equations, with the time of the impact as an unknown", "离散 Euler–Lagrange 方程，碰撞时刻为未知量"),
    (
        "sequential impulses, a given number of sweeps (`--solver sequential-impulses`); or their limit",
        "序列冲量，给定扫掠次数（`--solver sequential-impulses`）；或其极限",
    ),
    ("lexicographic Lemke; in space Gauss–Seidel first", "字典序 Lemke；空间问题先用 Gauss–Seidel"),
    (
        "projected over-relaxation, Barzilai–Borwein, accelerated projected gradient, ADMM",
        "投影超松弛、Barzilai–Borwein、加速投影梯度、ADMM",
    ),
    (
        "direct here: lexicographic Lemke; there NSGS, nonsmooth Newton and others",
        "此处为直接法：字典序 Lemke；原软件为 NSGS、非光滑 Newton 等",
    ),
    ("Newton, conjugate gradients, or Gauss–Seidel; the cone may be round, too", "Newton、共轭梯度或 Gauss–Seidel；也可用圆锥"),
    ("ADMM with a proximal term and automatic ρ (`--solver admm`)", "带邻近项与自动 ρ 的 ADMM（`--solver admm`）"),
    ("projected Gauss–Seidel on positions, gaps taken anew", "位置上的投影 Gauss–Seidel，间隙重新计算"),
    ("Newton's e", "Newton 的 e"),
    ("Newton's e, plastic where the next flight would last less than 2⁻²⁰ s", "Newton 的 e；下一段飞行短于 2⁻²⁰ s 时取塑性"),
    ("Newton's e on the velocity that arrives", "Newton 的 e，作用于到达速度"),
    ("Newton's e on the velocity after the forces, less d/h of a gap", "Newton 的 e，作用于受力后的速度，减去间隙的 d/h"),
    ("Newton's e above a rebound speed", "超过反弹速度时用 Newton 的 e"),
    ("Newton's e, or Moreau's on the whole velocity", "Newton 的 e，或作用于整个速度的 Moreau 定律"),
    ("e = 1 only: the discrete energy is kept", "仅 e = 1：保持离散能量"),
    ("e on the velocity after the positions, 0 below 2 g h", "e 作用于位置更新后的速度，低于 2 g h 时取 0"),
    ("none: plastic", "无：塑性"),
    ("none; solref sets the damping", "无；阻尼由 `solref` 决定"),
    ("none; what dissipation leaves", "无；取决于耗散"),
    ("Newton on velocities, analytic projection, exact line search", "速度上的 Newton 法，解析投影，精确线搜索"),
    ("Newton on velocities, convex potential, exact line search", "速度上的 Newton 法，凸势能，精确线搜索"),
    ("Newton on velocities, residual halved along each step", "速度上的 Newton 法，每步沿方向减半残差"),
    ("the caller's", "由调用者给定"),
    ("Dormand–Prince 5(4), events located to rounding", "Dormand–Prince 5(4)，事件定位到舍入误差"),
    ("classical Runge–Kutta, not corrected by the impulse", "经典 Runge–Kutta，不由冲量修正"),
    ("q + h v⁺, and split impulses of deep rigid bodies", "q + h v⁺，深穿透的刚体另用分离冲量"),
    ("q + h(θ v⁺ + (1−θ) v), with projection onto φ = 0 if asked", "q + h(θ v⁺ + (1−θ) v)，可选投影到 φ = 0"),
    ("exact rationals", "精确有理数"),
    ("closed form", "闭式解"),
    ("Newton's method on dual numbers", "对偶数上的 Newton 法"),
    ("Clarabel 0.11, polished", "Clarabel 0.11，经精化"),
    ("MuJoCo 3.17.0, run to the end", "MuJoCo 3.17.0，运行到底"),
    ("Pinocchio 4.1.0, ADMM with solve_ncp = false", "Pinocchio 4.1.0，ADMM，`solve_ncp` = false"),
];

/// A text of a system in Chinese; none where it has no words, or is not known.
pub fn chinese(text: &str) -> Option<&'static str> {
    CHINESE.iter().find(|(english, _)| *english == text).map(|(_, chinese)| *chinese)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_replicas::systems::ALL;

    /// Names and signs that are the same in Chinese.
    fn is_name(text: &str) -> bool {
        let is_word = |word: &str| word.len() > 2 && word.chars().all(|letter| letter.is_ascii_lowercase());
        !text.split([' ', ',', ';', ':', '(', ')']).any(is_word)
    }

    #[test]
    fn every_text_of_a_system_has_its_chinese_and_no_other_text_is_kept() {
        let mut said: Vec<&str> = Vec::new();
        for system in ALL {
            said.extend([system.algorithm, system.restitution, system.position_update]);
            said.extend(system.held_against.iter().map(|agreement| agreement.against));
        }
        let missing: Vec<&str> = said.iter().copied().filter(|text| chinese(text).is_none() && !is_name(text)).collect();
        assert_eq!(missing, Vec::<&str>::new());
        for (english, _) in CHINESE {
            assert!(said.contains(&english), "{english} is said by no system");
        }
    }
}
