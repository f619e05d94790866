//! What the page offers: the scenes with the values of μ and e that act in each, the schemes, and the time steps.

use crate::words::Words;
use moreau_dynamics::scenes::{Body, Scene, named};
use moreau_dynamics::schemes::Scheme;
use moreau_exact::{Error, Result};
use moreau_replicas::mujoco::{Cone, Mujoco};
use moreau_replicas::schemes::{SchemeParameters, by_name};
use std::f64::consts::FRAC_PI_3;

/// A scene of the page.
pub struct SceneEntry {
    /// Its name in the address of the page and in files.
    pub id: &'static str,
    /// Its name for readers.
    pub name: Words,
    /// What happens in it.
    pub about: Words,
    /// The values of μ; one alone does not act, and is not offered.
    pub friction: &'static [f64],
    /// The values of e; one alone does not act, and is not offered.
    pub restitution: &'static [f64],
    base: fn() -> Result<Scene>,
}

/// A scheme of the page.
pub struct SchemeEntry {
    /// Its name on the command line.
    pub id: &'static str,
    /// Its name for readers.
    pub name: Words,
    /// Its contact law.
    pub law: Words,
    /// The values of θ; empty where the scheme has none.
    pub theta: &'static [f64],
    /// What it is given on the command line in every run.
    pub options: &'static [&'static str],
}

/// One point of the grid: what a run is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// [`SceneEntry::id`].
    pub scene: &'static str,
    /// [`SchemeEntry::id`].
    pub scheme: &'static str,
    /// h, as the command line is given it \[s\].
    pub step: &'static str,
    /// θ, of the schemes that have one.
    pub theta: Option<f64>,
    /// μ.
    pub friction: f64,
    /// e.
    pub restitution: f64,
}

/// The time steps h \[s\], those of the scoreboard, as the command line takes them: one over so many.
pub const STEPS: [(&str, f64); 3] = [("1/60", 1.0 / 60.0), ("1/240", 1.0 / 240.0), ("1/1000", 1.0 / 1000.0)];

/// The schemes: two that solve Coulomb's law, and three that solve an associated one.
pub const SCHEMES: [SchemeEntry; 5] = [
    SchemeEntry {
        id: "moreau-jean",
        name: Words { en: "Moreau–Jean", zh: "Moreau–Jean" },
        law: Words { en: "Coulomb’s law, with restitution", zh: "Coulomb 定律，含恢复系数" },
        theta: &[0.5, 0.75, 1.0],
        options: &[],
    },
    SchemeEntry {
        id: "stewart-trinkle",
        name: Words { en: "Stewart–Trinkle", zh: "Stewart–Trinkle" },
        law: Words { en: "Coulomb’s law over a polyhedral cone", zh: "多面体锥上的 Coulomb 定律" },
        theta: &[],
        options: &[],
    },
    SchemeEntry {
        id: "anitescu",
        name: Words { en: "Anitescu", zh: "Anitescu" },
        law: Words { en: "associated law, convex", zh: "关联定律，凸" },
        theta: &[],
        options: &[],
    },
    SchemeEntry {
        id: "drake-sap",
        name: Words { en: "SAP (replica of Drake’s step)", zh: "SAP（Drake 步的复刻）" },
        law: Words { en: "associated law, compliant and regularised", zh: "关联定律，柔性并正则化" },
        theta: &[],
        options: &[],
    },
    SchemeEntry {
        id: "mujoco",
        name: Words { en: "MuJoCo (replica of its step)", zh: "MuJoCo（其步的复刻）" },
        law: Words { en: "associated law over the elliptic cone, soft", zh: "椭圆锥上的关联定律，软接触" },
        theta: &[],
        options: &["--cone", "elliptic"],
    },
];

/// The scenes.
pub const SCENES: [SceneEntry; 5] = [
    SceneEntry {
        id: "ball",
        name: Words { en: "Ball", zh: "球" },
        about: Words { en: "A sphere of 1 kg falls 1 m onto the ground.", zh: "1 kg 的球从 1 m 高处落到地面。" },
        friction: &[0.5],
        restitution: &[0.0, 0.5, 0.8, 1.0],
        base: || named("bouncing-ball"),
    },
    SceneEntry {
        id: "incline",
        name: Words { en: "Block on an incline", zh: "斜面上的物块" },
        about: Words {
            en: "A block of 1 kg lies on a slope of 20°; tan 20° = 0.364 divides sliding from sticking. By Coulomb’s law its speed is \
                 max(0, sin 20° − μ cos 20°) g t. Nothing arrives, so that e does not act.",
            zh: "1 kg 的物块放在 20° 的斜面上；tan 20° = 0.364 是滑动与粘滞的分界。按 Coulomb 定律，其速度为 max(0, sin 20° − μ cos 20°) g t。没有碰撞，因此 e 不起作用。",
        },
        friction: &[0.1, 0.3, 0.36, 0.5],
        restitution: &[0.0],
        base: || named("incline-slide"),
    },
    SceneEntry {
        id: "rod",
        name: Words { en: "Sliding rod", zh: "滑动的杆" },
        about: Words {
            en: "A rod of 1 m and 1 kg leans at 60° and slides at 2 m/s with its lower end ahead; above μ = 4/3 it can jam (Painlevé).",
            zh: "1 m、1 kg 的杆以 60° 倾角、2 m/s 的速度下端朝前滑动；μ 大于 4/3 时可能卡死（Painlevé）。",
        },
        friction: &[0.0, 0.3, 1.5],
        restitution: &[0.0, 0.5],
        base: rod,
    },
    SceneEntry {
        id: "stack",
        name: Words { en: "Stack", zh: "堆叠" },
        about: Words {
            en: "Three cubes of 1 kg stand on each other; the uppermost is thrown sideways at 1 m/s.",
            zh: "三个 1 kg 的立方体叠放；最上面的以 1 m/s 被横向抛出。",
        },
        friction: &[0.1, 0.3, 0.6],
        restitution: &[0.0],
        base: stack,
    },
    SceneEntry {
        id: "cradle",
        name: Words { en: "Newton’s cradle", zh: "牛顿摆" },
        about: Words {
            en: "Five equal spheres in a row, without gravity; the first hits the four at rest at 1 m/s.",
            zh: "五个相同的球排成一列，无重力；第一个以 1 m/s 撞向静止的四个。",
        },
        friction: &[0.0],
        restitution: &[0.0, 0.5, 1.0],
        base: cradle,
    },
];

/// The scene of this name.
///
/// # Errors
/// [`Error::Unsupported`] for another one.
pub fn scene(id: &str) -> Result<&'static SceneEntry> {
    SCENES.iter().find(|scene| scene.id == id).ok_or_else(|| Error::Unsupported(format!("the explorer has no scene `{id}`")))
}

impl SceneEntry {
    /// The scene with these coefficients.
    ///
    /// # Errors
    /// None that the table allows.
    pub fn with(&self, friction: f64, restitution: f64) -> Result<Scene> {
        let mut scene = (self.base)()?;
        scene.name = self.id.into();
        scene.description = self.about.en.into();
        (scene.material.friction, scene.material.restitution) = (friction, restitution);
        Ok(scene)
    }

    /// Every point of the grid in this scene.
    pub fn choices(&self) -> Vec<Choice> {
        let mut all = Vec::new();
        for scheme in &SCHEMES {
            let thetas: Vec<_> = if scheme.theta.is_empty() { vec![None] } else { scheme.theta.iter().copied().map(Some).collect() };
            for (step, _) in STEPS {
                for &theta in &thetas {
                    for &friction in self.friction {
                        let of = |&restitution: &f64| Choice { scene: self.id, scheme: scheme.id, step, theta, friction, restitution };
                        all.extend(self.restitution.iter().map(of));
                    }
                }
            }
        }
        all
    }
}

impl Choice {
    /// h \[s\].
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a step that is none of [`STEPS`].
    pub fn h(&self) -> Result<f64> {
        let known = STEPS.iter().find(|(name, _)| *name == self.step);
        known.map(|(_, h)| *h).ok_or_else(|| Error::Unsupported(format!("the explorer has no time step `{}`", self.step)))
    }

    /// The name of the run in the data.
    pub fn key(&self) -> String {
        let theta = self.theta.map(|theta| format!(" theta={theta}")).unwrap_or_default();
        format!("{} h={}{theta} mu={} e={}", self.scheme, self.step, self.friction, self.restitution)
    }

    /// The name of the file with the scene of the run.
    pub fn scene_file(&self) -> String {
        format!("{}-mu{}-e{}.json", self.scene, self.friction, self.restitution)
    }

    /// The scheme of the run.
    ///
    /// # Errors
    /// Those of the scheme's parameters.
    pub fn scheme(&self) -> Result<Box<dyn Scheme>> {
        let default = SchemeParameters::default();
        // over the pyramid, which is MuJoCo's default, softness acts on edges, and no one ŷ says what r is related to
        let mujoco = Mujoco::standard(Cone::Elliptic);
        by_name(self.scheme, SchemeParameters { theta: self.theta.unwrap_or(default.theta), mujoco, ..default })
    }

    /// What follows `moreau` on the command line for this run, with the scene in this file.
    pub fn arguments(&self, file: &str) -> Vec<String> {
        let mut words = ["simulate", "--scene", file, "--scheme", self.scheme, "--step", self.step].map(String::from).to_vec();
        if let Some(theta) = self.theta {
            words.extend(["--theta".into(), theta.to_string()]);
        }
        let options = SCHEMES.iter().filter(|scheme| scheme.id == self.scheme).flat_map(|scheme| scheme.options);
        words.extend(options.map(|option| option.to_string()));
        words
    }
}

/// A rod in the plane that leans at 60°, its lower end on the ground at x = 0 and its centre behind it \[m, m/s\].
fn rod() -> Result<Scene> {
    let [half, thin] = [0.5, 0.01];
    let (sine, cosine) = FRAC_PI_3.sin_cos();
    let mut body = Body::cuboid("rod", 1.0, [half, thin, thin], [-half * cosine, 0.0, half * sine + thin * cosine]);
    let (half_sine, half_cosine) = (FRAC_PI_3 / 2.0).sin_cos();
    body.orientation = [half_cosine, 0.0, half_sine, 0.0];
    body.linear_velocity = [2.0, 0.0, 0.0];
    Ok(Scene { bodies: vec![body], duration: 1.0, ..named("bouncing-ball")? })
}

fn stack() -> Result<Scene> {
    let mut scene = named("box-stack")?;
    scene.bodies.truncate(3);
    if let Some(top) = scene.bodies.last_mut() {
        top.linear_velocity = [1.0, 0.0, 0.0];
    }
    Ok(scene)
}

fn cradle() -> Result<Scene> {
    // sums of quarters are exact: spheres that touch have a gap of zero, not one of rounding
    let radius = 0.125;
    let ball = |k: u8| Body::sphere(format!("ball{}", k + 1), 1.0, radius, [2.0 * radius * f64::from(k), 0.0, 0.0]);
    let mut bodies: Vec<Body> = (0..5).map(ball).collect();
    bodies[0].position[0] = -0.25;
    bodies[0].linear_velocity = [1.0, 0.0, 0.0];
    Ok(Scene { bodies, duration: 0.6, ..named("two-ball-impact")? })
}
