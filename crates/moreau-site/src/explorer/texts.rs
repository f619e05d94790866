//! The texts of the page.

use crate::words::Words;
use moreau_replicas::staging::{COMPLIANT, PLASTIC, SOFT};

/// What the program puts in, by the name that it knows it by.
pub const TEXTS: [(&str, Words); 37] = [
    ("play", Words { en: "Play", zh: "播放" }),
    ("pause", Words { en: "Pause", zh: "暂停" }),
    ("step", Words { en: "step", zh: "第" }),
    ("stepEnd", Words { en: "", zh: " 步" }),
    ("of", Words { en: "of", zh: "/" }),
    ("start", Words { en: "the start: nothing was solved", zh: "起始：无求解" }),
    ("nothing", Words { en: "nothing to solve", zh: "无需求解" }),
    ("accepted", Words { en: "accepted", zh: "接受" }),
    ("unconverged", Words { en: "unconverged by declaration", zh: "按声明未收敛" }),
    ("rejected", Words { en: "rejected", zh: "拒绝" }),
    ("largest", Words { en: "largest residual", zh: "最大残差" }),
    ("limit", Words { en: "limit", zh: "限值" }),
    ("refused", Words { en: "No run: the scheme or its solver says", zh: "没有结果：格式或其求解器给出" }),
    ("missing", Words { en: "This run could not be read:", zh: "无法读取该结果：" }),
    ("height", Words { en: "centre", zh: "质心" }),
    ("speed", Words { en: "velocity", zh: "速度" }),
    ("spin", Words { en: "angular velocity", zh: "角速度" }),
    ("energy", Words { en: "energy T + V", zh: "能量 T + V" }),
    ("gap", Words { en: "smallest gap", zh: "最小间隙" }),
    ("natural", Words { en: "natural map", zh: "自然映射" }),
    ("impulse", Words { en: "impulse r", zh: "冲量 r" }),
    ("velocity", Words { en: "velocity u at the contact", zh: "接触点速度 u" }),
    ("law", Words { en: "law velocity ŷ", zh: "定律速度 ŷ" }),
    ("more", Words { en: "contacts push; the largest impulse", zh: "个接触有冲量；其中最大冲量" }),
    ("open", Words { en: "no contact pushes", zh: "没有接触有冲量" }),
    ("ground", Words { en: "ground", zh: "地面" }),
    ("across", Words { en: "across", zh: "面外" }),
    ("away", Words { en: "in space the bodies leave the plane of the picture, by up to", zh: "在空间中物体离开图面，至多" }),
    ("primal", Words { en: "primal", zh: "原始" }),
    ("dual", Words { en: "dual", zh: "对偶" }),
    ("complementarity", Words { en: "complementarity", zh: "互补" }),
    ("normal", Words { en: "normal", zh: "法向" }),
    ("tangential", Words { en: "tangential", zh: "切向" }),
    // the residual of the stored velocity
    ("velocityResidual", Words { en: "velocity", zh: "速度" }),
    (PLASTIC, Words { en: PLASTIC, zh: "此格式没有恢复系数：每次碰撞都是塑性的，以 e = 0 代替场景的 e" }),
    (
        COMPLIANT,
        Words {
            en: COMPLIANT, zh: "柔性接触没有恢复系数：物体弹起多高由刚度、耗散与 h 决定，而非场景的 e"
        },
    ),
    (SOFT, Words { en: SOFT, zh: "软接触没有恢复系数：物体弹起多高由 solref 与 solimp 决定，而非场景的 e" }),
];

/// Where a parameter acts, beside its control.
pub(super) const ACTS: [(&str, Words); 4] = [
    ("thetaActs", Words { en: "acts in Moreau–Jean only", zh: "只作用于 Moreau–Jean" }),
    ("thetaNot", Words { en: "Stewart–Trinkle has no θ", zh: "Stewart–Trinkle 没有 θ" }),
    ("restitutionActs", Words { en: "acts in Moreau–Jean only", zh: "只作用于 Moreau–Jean" }),
    ("actsNot", Words { en: "fixed in this scene", zh: "在此场景中固定" }),
];

pub(super) const INTRODUCTION: Words = Words {
    en: "The same scene through four schemes: Coulomb’s law, Anitescu’s convex step, SAP and MuJoCo’s law. The last two are \
         our replicas of the engines’ steps. Every run was computed when this report was built, by the library of the command; \
         the command under each panel makes its numbers again.",
    zh: "同一场景由四种格式计算：Coulomb 定律、Anitescu 的凸步、SAP 与 MuJoCo 的定律；后两者是我们对引擎步的复刻。所有结果在生成本报告时由命令的程序库算出；\
         每个面板下方的命令可重新得到其数值。",
};
pub(super) const NO_SCRIPT: Words = Words {
    en: "The runs are drawn by a script, which this browser does not run. The command `moreau simulate` makes the same numbers.",
    zh: "结果由脚本绘制，而此浏览器不运行脚本。命令 moreau simulate 给出相同的数值。",
};
pub(super) const CHOICE: Words = Words { en: "Scene, scheme and parameters", zh: "场景、格式与参数" };
pub(super) const SCENE: Words = Words { en: "scene", zh: "场景" };
pub(super) const SCHEME: Words = Words { en: "Coulomb’s law by", zh: "Coulomb 定律的格式" };
pub(super) const THETA: Words = Words { en: "θ [1]", zh: "θ [1]" };
pub(super) const RESTITUTION: Words = Words { en: "restitution e [1]", zh: "恢复系数 e [1]" };
pub(super) const FRICTION: Words = Words { en: "friction μ [1]", zh: "摩擦系数 μ [1]" };
pub(super) const STEP: Words = Words { en: "time step h [s]", zh: "时间步长 h [s]" };
pub(super) const TIME: Words = Words { en: "time", zh: "时间" };
pub(super) const PLAY: Words = Words { en: "Play", zh: "播放" };
pub(super) const BACK: Words = Words { en: "One step back", zh: "后退一步" };
pub(super) const ON: Words = Words { en: "One step on", zh: "前进一步" };
pub(super) const SPEED: Words = Words { en: "speed", zh: "速度" };
pub(super) const MOTION: Words = Words { en: "The motion, seen from the side", zh: "运动的侧视图" };
pub(super) const CONE: Words = Words {
    en: "The friction cone with the impulse, and its dual with the law velocity",
    zh: "摩擦锥与冲量，以及对偶锥与定律速度",
};
pub(super) const GAP: Words = Words { en: "Smallest gap over time", zh: "最小间隙随时间的变化" };
pub(super) const ENERGY: Words = Words { en: "Energy over time", zh: "能量随时间的变化" };
pub(super) const NATURAL: Words = Words { en: "Natural map of every step", zh: "每一步的自然映射" };
pub(super) const SCENE_FILE: Words = Words { en: "the scene’s file", zh: "场景文件" };
pub(super) const HOW: Words = Words { en: "How to read this page", zh: "如何阅读本页" };

pub(super) const NOTES: [Words; 5] = [
    Words {
        en: "The cone: the filled wedge is K, |r_t| ≤ μ r_n, with the impulse r of every contact that pushes as a solid arrow \
             [N·s]; the wide wedge is its dual K*, y_n ≥ μ|y_t|, with ŷ as a dashed arrow [m/s]. A step is solved where r lies \
             in K, ŷ in K*, and both are at right angles or one of them is zero. Lengths grow as the square root; directions \
             are true.",
        zh: "锥：填充的楔形是 K，|r_t| ≤ μ r_n，每个有冲量的接触的 r 画成实线箭头 [N·s]；宽楔形是对偶锥 K*，y_n ≥ μ|y_t|，ŷ 画成虚线箭头 [m/s]。\
             r 在 K 中、ŷ 在 K* 中且两者垂直（或其一为零）时，该步得解。长度按平方根增长，方向真实。",
    },
    Words {
        en: "ŷ is y + μ‖y_t‖n for Coulomb’s law, with the restitution in y, and for an associated law the velocity that the \
             scheme relates to r, with its shift and its compliance. Anitescu, SAP and MuJoCo lift a sliding contact for that \
             reason.",
        zh: "Coulomb 定律的 ŷ 是 y + μ‖y_t‖n（y 含恢复系数）；关联定律的 ŷ 是格式与 r 相联系的速度，含其移位与柔度。Anitescu、SAP 与 MuJoCo 因此会把滑动的接触抬起。",
    },
    Words {
        en: "The natural map is ‖r − P_K(r − ρŷ)‖ over all contacts [N·s]; a zero stands on the lowest line. It is shown for \
             comparison: the certificate judges each residual against its scale. A triangle above the graph marks a rejected \
             step, a diamond one that is unconverged by declaration.",
        zh: "自然映射是所有接触上的 ‖r − P_K(r − ρŷ)‖ [N·s]；零画在最低线上。它只供比较：证书按各残差的尺度判定。图上方的三角形标出被拒绝的步，菱形标出按声明未收敛的步。",
    },
    Words {
        en: "Positions, velocities, impulses and energies have six digits after the point, residuals two significant digits: \
             these are the command’s numbers. Every step is stored. MuJoCo’s replica moves bodies in space, the others in the \
             plane; a box has four lower corners there and two here.",
        zh: "位置、速度、冲量与能量保留小数点后六位，残差保留两位有效数字：与命令的数值相同。每一步都已存储。MuJoCo 的复刻在空间中运动，其余在平面内；\
             物块在前者有四个下角，在后者有两个。",
    },
    Words {
        en: "Keys: Tab goes from control to control; on the time slider the arrow keys go one step. The address of the page \
             keeps the choice.",
        zh: "按键：Tab 在控件间移动；在时间滑块上方向键前进或后退一步。页面地址保存所做的选择。",
    },
];
