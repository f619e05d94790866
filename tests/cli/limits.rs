//! What is too large, too fast or without an end is refused at once, and what is as large as it may be is not.

use super::{Folder, PROBLEM, moreau};
use std::fmt::Write;
use std::fs::File;
use std::process::{Command, Stdio};

/// Spheres of radius 0.1 m that fall, 0.21 m apart, the lowest on the floor.
fn spheres(count: usize) -> String {
    let mut bodies = String::new();
    for k in 0..count {
        let [x, y, z] = [k % 10, k / 10 % 10, k / 100].map(|place| place as f64 * 0.21 + 0.1);
        let comma = if k == 0 { "" } else { "," };
        let still = r#""linear_velocity":[0,0,0],"angular_velocity":[0,0,0]"#;
        write!(bodies, r#"{comma}{{"name":"s{k}","mass":1,"position":[{x},{y},{z}],"sphere":{{"radius":0.1}},{still}}}"#)
            .expect("a String takes everything");
    }
    format!(
        r#"{{"schema":"scene/1","name":"spheres","bodies":[{bodies}],"gravity":[0,0,-9.81],"duration":0.01,
            "material":{{"friction":0.5,"restitution":0}},"ground":{{"normal":[0,0,1],"offset":0}}}}"#
    )
}

/// A ball or a box that spins at this rate about an axis of its own.
fn spinning(shape: &str, rate: f64) -> String {
    format!(
        r#"{{"schema":"scene/1","name":"spinning","duration":1,"gravity":[0,0,-9.81],"material":{{"friction":0,"restitution":1}},
            "ground":{{"normal":[0,0,1],"offset":0}},"bodies":[{{"name":"top","mass":2,"position":[0,1,10],{shape},
            "linear_velocity":[3,-2,4],"angular_velocity":[{rate:e},0,0]}}]}}"#
    )
}

const BALL: &str = r#""sphere":{"radius":0.1}"#;
const BRICK: &str = r#""box":{"half_extents":[0.1,0.2,0.3]}"#;

#[test]
fn many_spheres_run_in_the_memory_of_those_that_are_near_or_are_refused_with_the_size() {
    let folder = Folder::new("limits-spheres");
    // 1 000 spheres have half a million candidates, of which 2 800 are near
    let scene = folder.file("spheres.json", &spheres(1000));
    let simulate = |memory| moreau(&["simulate", "--scene", &scene, "--step", "0.005", "--max-memory", memory]);
    let run = simulate("5MB");
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    simulate("500kB").is_refused(&["--max-memory", "is 500.0 kB", "6000 velocities", "needs about 768.0 kB", "--max-memory 1MB"]);
    let run = moreau(&["compare", &scene, "--schemes", "moreau-jean,xpbd", "--max-memory", "300kB"]);
    assert_eq!(run.code, 1);
    assert_eq!(run.output.matches("recording 10 steps of spheres needs about 1.0 MB").count(), 2, "{}", run.output);
}

#[test]
fn a_recording_too_long_for_the_memory_is_refused() {
    let run = |memory| moreau(&["simulate", "--scene", "bouncing-ball", "--step", "0.01", "--max-memory", memory]);
    assert_eq!(run("1MB").code, 0);
    run("10kB").is_refused(&["recording 200 steps"]);
}

#[test]
fn a_problem_is_held_against_its_own_limit() {
    let folder = Folder::new("limits-problem");
    // 900 contacts without friction: W is written in triplets, and stored with 810 000 numbers
    let numbers = |value: &str| vec![value; 900].join(",");
    let places: Vec<String> = (0..900).map(|k| k.to_string()).collect();
    let places = places.join(",");
    let problem = format!(
        r#"{{"schema":"contact-problem/1","name":"many","dimension":1,"law":"frictionless","friction":[{}],"free_velocity":[{}],
            "delassus":{{"shape":[900,900],"triplets":{{"row":[{places}],"column":[{places}],"value":[{}]}}}}}}"#,
        numbers("0"),
        numbers("-1"),
        numbers("1")
    );
    let (problem, answer) = (folder.file("problem.json", &problem), folder.path("answer.json"));
    moreau(&["solve", &problem, "--max-memory", "12MB"]).is_refused(&["storing the matrices of this problem needs about 13.0 MB"]);
    let tight = moreau(&["solve", &problem, "--max-memory", "50MB"]);
    tight.is_refused(&["`--max-memory`: is 50.0 MB", "solving 900 rows needs about 51.8 MB", "pass --max-memory 52MB"]);
    assert!(!tight.message.contains("::"), "no function of the library: {}", tight.message);
    assert_eq!(moreau(&["solve", &problem, "--max-memory", "52MB", "--out", &answer]).code, 0);
    assert_eq!(moreau(&["certify", &problem, &answer, "--max-memory", "13MB"]).code, 0);
    moreau(&["certify", &problem, &answer, "--max-memory", "20kB"]).is_refused(&["at most 5.0 kB are read", "--max-memory"]);
}

#[test]
fn a_size_that_is_none_is_refused() {
    for size in ["0", "-1", "4 parsecs", "1e9", ""] {
        let option = format!("--max-memory={size}");
        moreau(&["simulate", "--scene", "bouncing-ball", &option]).is_refused(&["--max-memory", "4GiB"]);
        moreau(&["certify", "p.json", "s.json", &option]).is_refused(&["--max-memory"]);
    }
}

#[test]
fn a_number_of_threads_that_is_none_is_refused_and_any_other_answers_alike() {
    let folder = Folder::new("limits-threads");
    let problem = folder.file("problem.json", PROBLEM);
    let run = |threads: &str| moreau(&["solve", &problem, "--solver", "pgs", "--threads", threads]);
    for none in ["0", "-1", "two", "1.5"] {
        assert_eq!(run(none).code, 2, "{none}");
    }
    let one = run("1");
    assert_eq!(one.code, 0, "{}", one.message);
    for threads in ["2", "1000000"] {
        assert_eq!(run(threads).output, one.output, "{threads}");
    }
}

#[test]
fn files_beyond_256_mb_are_refused_unread() {
    let folder = Folder::new("limits-files");
    let hollow = folder.path("hollow.json");
    let file = File::create(&hollow).expect("writable");
    let problem = folder.file("problem.json", PROBLEM);
    let commands: [&[&str]; 4] = [
        &["simulate", "--scene", &hollow],
        &["compare", &hollow],
        &["certify", &problem, &hollow],
        &["gate", "--quick", "--baseline", &hollow, "--", "true"],
    ];
    file.set_len(256_000_001).expect("no space is taken");
    for arguments in commands {
        moreau(arguments).is_refused(&["hollow.json", "is 256.0 MB", "at most 256.0 MB are read"]);
    }
    // a problem has a limit of its own, and this is no text
    moreau(&["solve", &hollow]).is_refused(&["hollow.json", "not text"]);
    moreau(&["solve", &hollow, "--max-memory", "1GB"]).is_refused(&["at most 250.0 MB are read", "--max-memory"]);
    file.set_len(256_000_000).expect("no space is taken");
    for arguments in commands {
        moreau(arguments).is_refused(&["hollow.json", "not text"]);
    }
}

#[cfg(unix)]
#[test]
fn a_device_or_a_pipe_without_an_end_is_left() {
    let folder = Folder::new("limits-endless");
    let problem = folder.file("problem.json", PROBLEM);
    for arguments in [&["simulate", "--scene", "/dev/zero"][..], &["solve", "/dev/zero"], &["certify", &problem, "/dev/zero"]] {
        moreau(arguments).is_refused(&["/dev/zero", "not text"]);
    }
    for arguments in [&["solve", "/dev/stdin"][..], &["certify", &problem, "/dev/stdin"], &["simulate", "--scene", "/dev/stdin"]] {
        let mut endless = Command::new("yes").arg("x").stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("yes");
        let input = endless.stdout.take().expect("piped");
        let output = super::command(arguments).stdin(input).output().expect("the built command starts");
        endless.wait().expect("its pipe is closed");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let message = String::from_utf8(output.stderr).expect("UTF-8");
        assert!(message.contains("not a JSON object") || message.contains("at most 256.0 MB are read"), "{message}");
    }
}

#[test]
fn a_ball_spins_at_any_rate_and_a_box_up_to_a_stated_one() {
    let folder = Folder::new("limits-spin");
    let simulate = |name: &str, scene: String| {
        let file = folder.file(name, &scene);
        moreau(&["simulate", "--scene", &file, "--step", "0.01"])
    };
    let ball = simulate("ball.json", spinning(BALL, 1e9));
    assert_eq!((ball.code, ball.message.as_str()), (0, ""));
    // J₁ = 2/3·(0.04 + 0.09) is the largest moment: s = Ω √(13/5) and 2 h s ≤ 1024
    let most = 1024.0 / (2.0 * 0.01 * (13.0f64 / 5.0).sqrt());
    assert_eq!(simulate("slow.json", spinning(BRICK, 0.99 * most)).code, 0);
    simulate("fast.json", spinning(BRICK, 1.01 * most)).is_refused(&["`angular_velocity`", "top", "smaller step", "1024"]);
    simulate("mad.json", spinning(BRICK, 1e9)).is_refused(&["`angular_velocity`"]);
}

#[test]
fn counts_have_limits_that_help_and_errors_tell() {
    let help = moreau(&["simulate", "--help"]).output;
    for words in ["from 1 to 10000", "from 3 to 1024", "[default: 4GiB]"] {
        assert!(help.contains(words), "{words}");
    }
    let run = |scheme: &str, option: &str, value: &str| {
        moreau(&["simulate", "--scene", "bouncing-ball", "--step", "0.5", "--scheme", scheme, option, value])
    };
    for value in ["0", "10001", "4000000000"] {
        run("xpbd", "--sweeps", value).is_refused(&["--sweeps", "from 1 to 10000"]);
    }
    assert_eq!([run("pbd", "--sweeps", "1").code, run("pbd", "--sweeps", "10000").code], [0, 0]);
    for value in ["2", "1025"] {
        run("stewart-trinkle", "--friction-directions", value).is_refused(&["--friction-directions", "from 3 to 1024"]);
    }
    assert_eq!(run("stewart-trinkle", "--friction-directions", "1024").code, 0);
}

#[test]
fn an_energy_that_is_no_number_is_an_error_with_the_step() {
    let folder = Folder::new("limits-energy");
    let scene = folder.file("heavy.json", &spinning(BALL, 0.0).replace("-9.81", "-1e150").replace("\"mass\":2", "\"mass\":1e10"));
    let run = moreau(&["simulate", "--scene", &scene, "--step", "0.5"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.message);
    assert!(run.message.contains("the energy of") && run.message.contains("not finite"), "{}", run.message);
}

#[test]
fn the_event_driven_restitution_is_that_of_the_located_impact() {
    for step in ["0.013", "0.05"] {
        let run = moreau(&["simulate", "--scene", "bouncing-ball", "--scheme", "event-driven", "--step", step, "--format", "json"]);
        let summary = run.json();
        let found = summary["quantities"].as_array().expect("a list").iter();
        let mut found = found.filter(|one| one["name"] == "effective restitution of the first impact");
        let value = found.next().expect("listed")["value"].as_f64().expect("one contact");
        assert!((value - 0.5).abs() <= 1e-12, "h = {step} s: {value}");
    }
}

/// A plate with so many contacts, all of one body: what one of them does moves all others.
pub fn plate(contacts: usize) -> String {
    let list = |count: usize, one: &dyn Fn(usize) -> String| (0..count).map(one).collect::<Vec<_>>().join(",");
    let rows = list(contacts, &|k| {
        let [x, y] = [k % 64, k / 64].map(|place| place as f64 / 32.0 - 1.0);
        format!("0,0,1,{y},{},0,1,0,0,0,-0.1,{},0,1,0,0.1,0,{x}", -x, -y)
    });
    let starts = list(3 * contacts + 1, &|row| (6 * row).to_string());
    let column = list(18 * contacts, &|place| (place % 6).to_string());
    let friction = list(contacts, &|_| "0.5".into());
    let free = list(contacts, &|k| format!("-0.1{},0.02,0.01", k % 7));
    format!(
        r#"{{"schema":"contact-problem/1","name":"plate","dimension":3,"law":"coulomb","friction":[{friction}],"free_velocity":[{free}],
            "mass":{{"shape":[6,6],"diagonal_blocks":[
              [1,0,0,0,0,0, 0,1,0,0,0,0, 0,0,1,0,0,0, 0,0,0,0.3,0,0, 0,0,0,0,0.3,0, 0,0,0,0,0,0.6]]}},
            "jacobian":{{"shape":[{},6],"sparse_rows":{{"starts":[{starts}],"column":[{column}],"value":[{rows}]}}}}}}"#,
        3 * contacts
    )
}

#[test]
fn a_sweep_that_takes_longer_than_the_time_limit_is_ended_within() {
    let folder = Folder::new("limits-time");
    let (problem, answer) = (folder.file("plate.json", &plate(4096)), folder.path("answer.json"));
    for solver in ["psor", "sequential-impulses"] {
        let asked = ["solve", &problem, "--solver", solver, "--iterations", "1", "--time-limit", "0.02", "--max-memory", "20GB"];
        let run = moreau(&[&asked[..], &["--out", &answer, "--format", "json"]].concat());
        assert_eq!(run.json()["reproducible"], false, "{solver} ends within its first sweep: {}{}", run.output, run.message);
    }
}

#[test]
fn a_problem_by_bodies_whose_w_has_no_room_is_solved_by_sweeps_that_need_none() {
    let folder = Folder::new("limits-bodies");
    // W of 600 contacts of one body would have 360 000 blocks, and a square matrix of 26 MB
    let (problem, answer) = (folder.file("plate.json", &plate(600)), folder.path("answer.json"));
    let asked = |word: &str, solver: &str| moreau(&[word, &problem, "--solver", solver, "--max-memory", "20MB"]);
    let solve = moreau(&["solve", &problem, "--solver", "pgs", "--max-memory", "20MB", "--out", &answer]);
    assert_eq!(solve.code, 0, "{}{}", solve.output, solve.message);
    assert_eq!(moreau(&["certify", &problem, &answer, "--max-memory", "20MB"]).code, 0);
    for solver in ["fischer-burmeister", "interior-point", "admm"] {
        for word in ["solve", "bench"] {
            asked(word, solver).is_refused(&["--max-memory", "the square Delassus matrix of this problem needs about 103.7 MB"]);
        }
    }
    let run = moreau(&["solve", &problem, "--solver", "fischer-burmeister", "--iterations", "1", "--max-memory", "200MB"]);
    assert!(run.code == 1 && !run.message.contains("panicked") && run.message.contains("iterations: 1"), "{}", run.message);
}
