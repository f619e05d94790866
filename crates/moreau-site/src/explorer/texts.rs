//! The texts of the page that its program puts in.

use crate::Words;

/// Texts by the name that the program knows them by.
pub const TEXTS: [(&str, Words); 26] = [
    ("play", Words { en: "Play", zh: "播放" }),
    ("pause", Words { en: "Pause", zh: "暂停" }),
    ("step", Words { en: "step", zh: "第" }),
    ("stepEnd", Words { en: "", zh: " 步" }),
    ("of", Words { en: "of", zh: "/" }),
    ("start", Words { en: "the start: nothing was solved", zh: "起始:无求解" }),
    ("nothing", Words { en: "nothing to solve", zh: "无需求解" }),
    ("accepted", Words { en: "accepted", zh: "接受" }),
    ("unconverged", Words { en: "unconverged by declaration", zh: "按声明未收敛" }),
    ("rejected", Words { en: "rejected", zh: "拒绝" }),
    ("largest", Words { en: "largest residual", zh: "最大残差" }),
    ("limit", Words { en: "limit", zh: "限值" }),
    ("refused", Words { en: "No run: the scheme or its solver says", zh: "没有结果:格式或其求解器给出" }),
    ("missing", Words { en: "This run could not be read:", zh: "无法读取该结果:" }),
    ("height", Words { en: "centre", zh: "质心" }),
    ("speed", Words { en: "velocity", zh: "速度" }),
    ("spin", Words { en: "angular velocity", zh: "角速度" }),
    ("energy", Words { en: "energy T + V", zh: "能量 T + V" }),
    ("gap", Words { en: "smallest gap", zh: "最小间隙" }),
    ("natural", Words { en: "natural map", zh: "自然映射" }),
    ("impulse", Words { en: "impulse r", zh: "冲量 r" }),
    ("velocity", Words { en: "velocity u at the contact", zh: "接触点速度 u" }),
    ("law", Words { en: "law velocity ŷ", zh: "定律速度 ŷ" }),
    ("more", Words { en: "contacts active; the largest impulse", zh: "个接触起作用;其中最大冲量" }),
    ("open", Words { en: "no contact active", zh: "没有起作用的接触" }),
    ("ground", Words { en: "ground", zh: "地面" }),
];
