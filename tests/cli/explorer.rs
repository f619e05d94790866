//! The runs of the explorer are the command's: positions, velocities, impulses, energies, residuals and the natural map, to the digits
//! that the page shows.

use super::{Folder, moreau};
use moreau::trajectory::Trajectory;
use moreau_site::explorer::{Choice, Run, SCENES, SCHEMES, WIDTHS, compute, decode, fixed, posed, residual, unwound};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// What the command and the store say of one sample, under names; a difference is a name.
type Numbers = BTreeMap<String, i64>;

/// The numbers of a body, in the order of their channels.
const PARTS: [&str; WIDTHS[0]] = ["x", "z", "angle", "v_x", "v_z", "ω", "y"];

/// What the command writes for a point of the grid.
struct Told {
    trajectory: Trajectory,
    page: Value,
}

fn told(folder: &Folder, choice: &Choice) -> Told {
    let entry = SCENES.iter().find(|entry| entry.id == choice.scene).expect("on the grid");
    let scene = entry.with(choice.friction, choice.restitution).and_then(|scene| scene.to_json()).expect("a scene");
    let file = folder.file(&choice.scene_file(), &scene);
    let (out, html) = (folder.path("run.json"), folder.path("run.html"));
    let arguments = choice.arguments(&file);
    let words: Vec<&str> = arguments.iter().map(String::as_str).chain(["--out", &out, "--html", &html]).collect();
    let run = moreau(&words);
    assert!(run.code < 2, "{choice:?}: {}", run.message);
    let page = std::fs::read_to_string(&html).expect("written");
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"data\">").expect("the data");
    let page = serde_json::from_str(rest.split_once("</script>").expect("an end").0).expect("JSON");
    Told { trajectory: Trajectory::read(Path::new(&out)).expect("written"), page }
}

impl Told {
    /// The numbers of sample k; angles go on from those of the sample before.
    fn numbers(&self, k: usize, angles: &mut [f64]) -> Numbers {
        let mut numbers = Numbers::new();
        for (track, angle) in self.trajectory.bodies.iter().zip(angles) {
            *angle = unwound(track.orientation[k], *angle);
            let ([x, y, z], [v_x, _, v_z]) = (track.position[k], track.linear_velocity[k]);
            let all = [x, z, *angle, v_x, v_z, track.angular_velocity[k][1], y];
            let all = PARTS.into_iter().zip(all);
            numbers.extend(all.map(|(what, value)| (format!("{what} of {}", track.name), fixed(value))));
        }
        let steps = self.trajectory.steps.as_ref().expect("our own steps are certified");
        let relative = k.checked_sub(1).and_then(|step| steps.relative[step]);
        numbers.insert("residual".into(), relative.map_or(0, residual));
        numbers.insert("accepted".into(), i64::from(k == 0 || steps.accepted[k - 1]));
        numbers
    }
}

/// A stored run, as a page reads it.
struct Kept {
    run: Run,
    channels: Vec<Vec<i64>>,
    names: Vec<String>,
}

impl Kept {
    fn new(choice: &Choice) -> Self {
        let scene = posed(choice).expect("on the grid").0;
        let run = compute(choice, &scene).expect("the scheme takes it");
        let channels = decode(&run.data, run.steps + 1).expect("its own text");
        Kept { run, channels, names: scene.bodies.into_iter().map(|body| body.name).collect() }
    }

    fn numbers(&self, k: usize) -> Numbers {
        let mut numbers = Numbers::new();
        for (one, name) in self.names.iter().enumerate() {
            for (part, what) in PARTS.into_iter().enumerate() {
                numbers.insert(format!("{what} of {name}"), self.channels[WIDTHS[0] * one + part][k]);
            }
        }
        numbers.insert("residual".into(), self.whole(3)[k]);
        numbers.insert("accepted".into(), i64::from(self.whole(4)[k] <= 1));
        numbers
    }

    /// Energy, gap, natural map, residual, verdict, word.
    fn whole(&self, part: usize) -> &[i64] {
        &self.channels[WIDTHS[0] * self.names.len() + part]
    }

    /// Bodies of every contact that was active in step k, its normal and its tangential impulse [N·s].
    fn impulses(&self, k: usize) -> Vec<(usize, isize, f64, f64)> {
        let first = WIDTHS[0] * self.names.len() + WIDTHS[1];
        let contacts = self.run.contacts.iter().zip(self.channels[first..].chunks(WIDTHS[2]));
        let active = contacts.filter(|(_, channels)| channels[0][k] == 1);
        let real = |value: i64| value as f64 / fixed(1.0) as f64;
        active.map(|(slot, channels)| (slot.0, slot.1, real(channels[1][k]), real(channels[2][k]).hypot(real(channels[3][k])))).collect()
    }
}

/// What differs between the command and the store; `shift` is a planted mistake.
fn differences(told: &Told, kept: &Kept, shift: usize) -> Vec<String> {
    let mut angles = vec![0.0; kept.names.len()];
    let mut found = Vec::new();
    if told.trajectory.times.len() != kept.run.steps + 1 {
        found.push("the number of samples".into());
    }
    for k in 0..told.trajectory.times.len().min(kept.run.steps + 1 - shift) {
        let (own, others) = (told.numbers(k, &mut angles), kept.numbers(k + shift));
        found.extend(own.iter().filter(|(name, value)| others.get(*name) != Some(value)).map(|(name, _)| format!("{name} at {k}")));
        if !impulses_agree(told, kept, k, k + shift) {
            found.push(format!("impulses at {k}"));
        }
        // six significant digits there, six after the point here
        let energy = told.page["energies"][k].as_f64().expect("an energy");
        let off = (energy - kept.whole(0)[k + shift] as f64 / fixed(1.0) as f64).abs();
        if told.page["every"] == 1 && off > 1e-5 * energy.abs() + 1e-6 {
            found.push(format!("energy at {k}"));
        }
    }
    found
}

/// Whether each contact of the page of the motion has its impulse in the store: six significant digits there, six after the point here.
fn impulses_agree(told: &Told, kept: &Kept, k: usize, other: usize) -> bool {
    if told.page["every"] != 1 {
        return true;
    }
    let number = |value: &Value| value.as_f64().expect("a number");
    let mut kept: Vec<_> = kept.impulses(other).into_iter().filter(|(_, _, n, t)| *n != 0.0 || *t != 0.0).collect();
    for one in told.page["contacts"][k].as_array().expect("contacts") {
        let (first, second) = (one[0].as_u64().expect("a body") as usize, one[1].as_i64().expect("a body") as isize);
        let (normal, tangential) = (number(&one[4]), number(&one[5]));
        let off = |(_, _, n, t): &(usize, isize, f64, f64)| ((n - normal).abs(), (t - tangential).abs());
        let all = kept.iter().enumerate().filter(|(_, (a, b, ..))| (*a, *b) == (first, second));
        let nearest = all.map(|(at, one)| (at, off(one))).min_by(|(_, a), (_, b)| (a.0 + a.1).total_cmp(&(b.0 + b.1)));
        match nearest {
            Some((at, (n, t))) if n <= 1e-5 * normal + 1e-6 && t <= 1e-5 * tangential + 1e-6 => drop(kept.swap_remove(at)),
            _ if normal <= 1e-6 && tangential <= 1e-6 => {}
            _ => return false,
        }
    }
    kept.iter().all(|(_, _, n, t)| n.abs() <= 2e-6 && *t <= 2e-6)
}

/// Every scene with every scheme, the last values of μ and e of each scene, at the largest step and some at smaller ones.
fn points() -> Vec<Choice> {
    let mut points = Vec::new();
    for (k, entry) in SCENES.iter().enumerate() {
        for (j, scheme) in SCHEMES.iter().enumerate() {
            let step = if (k + j) % 4 == 1 { "1/240" } else { "1/60" };
            let of = |scheme: &str, friction: f64, restitution: f64| {
                let wanted = |one: &Choice| (one.scheme, one.step, one.friction, one.restitution) == (scheme, step, friction, restitution);
                entry.choices().into_iter().rfind(wanted).expect("on the grid")
            };
            let last = |all: &[f64]| all[all.len() - 1];
            points.push(of(scheme.id, last(entry.friction), last(entry.restitution)));
        }
    }
    points
}

#[test]
fn every_scene_and_scheme_of_the_explorer_has_the_numbers_of_the_command() {
    let folder = Folder::new("explorer");
    for choice in points() {
        let (told, kept) = (told(&folder, &choice), Kept::new(&choice));
        assert_eq!(differences(&told, &kept, 0), Vec::<String>::new(), "{choice:?}");
    }
}

#[test]
fn a_run_of_another_theta_or_shifted_by_a_step_is_seen() {
    let folder = Folder::new("explorer-planted");
    let entry = SCENES.iter().find(|entry| entry.id == "ball").expect("on the grid");
    let wanted = |one: &Choice| (one.step, one.restitution, one.theta) == ("1/60", 0.5, Some(0.5));
    let choice = entry.choices().into_iter().find(wanted).expect("on the grid");
    let told = told(&folder, &choice);
    assert_eq!(differences(&told, &Kept::new(&choice), 0), Vec::<String>::new());
    for (kept, shift, what) in [
        (Kept::new(&choice), 1, "a step"),
        (Kept::new(&Choice { theta: Some(0.75), ..choice }), 0, "θ"),
        (Kept::new(&Choice { restitution: 0.8, ..choice }), 0, "e"),
        (Kept::new(&Choice { scheme: "anitescu", theta: None, ..choice }), 0, "the scheme"),
    ] {
        let found = differences(&told, &kept, shift);
        for part in ["z of ball", "energy", "impulses"] {
            assert!(found.iter().any(|one| one.starts_with(part)), "{what}: {part} in {found:?}");
        }
    }
}

#[test]
fn the_natural_map_of_a_stored_step_is_the_one_that_certify_prints() {
    let folder = Folder::new("explorer-natural");
    for scheme in &SCHEMES {
        let entry = SCENES.iter().find(|entry| entry.id == "incline").expect("on the grid");
        let choice = entry.choices().into_iter().find(|one| one.scheme == scheme.id && one.friction == 0.3).expect("on the grid");
        let scene = entry.with(choice.friction, choice.restitution).and_then(|scene| scene.to_json()).expect("a scene");
        let (file, problem) = (folder.file("scene.json", &scene), folder.path("step.json"));
        let arguments = choice.arguments(&file);
        let words: Vec<&str> = arguments.iter().map(String::as_str).chain(["--dump-step", "30", &problem]).collect();
        assert!(moreau(&words).code < 2, "{}", scheme.id);
        let certified = moreau(&["certify", &problem, &folder.path("step-solution.json"), "--format", "json"]).json();
        let natural = certified["residuals"]["natural_map"]["value"].as_f64().expect("a number");
        let kept = Kept::new(&choice).whole(2)[30];
        // the file holds W as numbers, the run as an operator: what is rounding alone in one is so in the other
        let is_rounding = |code: i64| code <= residual(1e-14);
        assert!(kept == residual(natural) || is_rounding(kept) && is_rounding(residual(natural)), "{}: {natural} {kept}", scheme.id);
    }
}
