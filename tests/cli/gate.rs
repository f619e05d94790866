//! `moreau gate`, `defects` and `engine` from outside, with our own schemes as the engines.

use super::{Folder, Run, moreau};

/// Our scheme behind the protocol, through one cheap check at one step.
fn gate(before: &[&str], scheme: &str) -> Run {
    let engine = ["--", env!("CARGO_BIN_EXE_moreau"), "engine", "--scheme", scheme];
    moreau(&[&["gate", "--only", "flight/projectile", "--steps", "1/60,0.001"], before, &engine].concat())
}

#[test]
fn our_own_scheme_passes_through_the_same_door() {
    let run = gate(&[], "moreau-jean");
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    assert!(run.output.contains("pass") && run.output.contains("1 check: 1 pass"), "{}", run.output);
    let json = gate(&["--format", "json"], "moreau-jean").json();
    assert_eq!(json["report"]["schema"], "gate-report/1");
    assert_eq!(json["report"]["checks"][0]["verdict"], "pass");
}

#[test]
fn the_number_of_jobs_changes_nothing() {
    let one = gate(&["--format", "json"], "anitescu");
    let two = gate(&["--format", "json", "--jobs", "2"], "anitescu");
    assert_eq!(one.output, two.output);
}

#[test]
fn every_output_is_written_and_read_back() {
    let folder = Folder::new("gate-outputs");
    let file = |name: &str| folder.path(name);
    let (baseline, junit, html, out) = (file("b.toml"), file("j.xml"), file("p.html"), file("r.json"));
    let run = gate(&["--save-baseline", &baseline, "--junit", &junit, "--html", &html, "--out", &out], "moreau-jean");
    assert_eq!(run.code, 0, "{}", run.message);
    let read = |name: &str| std::fs::read_to_string(name).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(read(&junit).contains("<testcase name=\"flight/projectile\""));
    assert!(read(&html).starts_with("<!DOCTYPE html>") && !read(&html).contains("src="), "self-contained");
    let made = format!("Judged by moreau {} on 20", env!("CARGO_PKG_VERSION"));
    assert!(read(&html).contains(&made), "{made}");
    assert!(serde_json::from_str::<moreau::gate::Report>(&read(&out)).is_ok());
    let run = gate(&["--baseline", &baseline], "moreau-jean");
    assert_eq!(run.code, 0, "{}", run.output);
    assert!(run.output.contains("As the baseline."), "{}", run.output);
}

#[test]
fn a_baseline_that_has_nothing_of_the_run_is_refused_before_it() {
    let folder = Folder::new("gate-other-baseline");
    let baseline = folder.path("b.toml");
    assert_eq!(gate(&["--save-baseline", &baseline], "moreau-jean").code, 0);
    let other = |words: &[&str]| moreau(&[&["gate", "--baseline", &baseline][..], words, &["--", "/nowhere/engine"]].concat());
    other(&["--steps", "1/60,0.001", "--only", "incline/"]).is_refused(&["b.toml", "baseline.check", "none of the checks of this run"]);
    other(&["--steps", "0.1", "--only", "flight/"]).is_refused(&["b.toml", "baseline.sweep", "0.1"]);
}

#[test]
fn the_baseline_of_another_engine_is_refused_before_the_run() {
    let folder = Folder::new("gate-other-engine");
    let baseline = folder.path("b.toml");
    assert_eq!(gate(&["--save-baseline", &baseline], "moreau-jean").code, 0);
    let run = gate(&["--baseline", &baseline], "anitescu");
    run.is_refused(&["b.toml", "baseline.engine", "`anitescu`"]);
    assert!(!run.message.contains("1/1"), "{}", run.message);
}

#[test]
fn a_program_that_answers_a_check_at_some_time_steps_only_is_told() {
    let engine = ["--", env!("CARGO_BIN_EXE_moreau"), "engine"];
    let stack = |steps: &str| moreau(&[&["gate", "--only", "stack/ten", "--steps", steps], &engine[..]].concat());
    let told = "answered at some of the time steps only: 1 check, such as stack/ten, not at h = 0.0333333 s: at this step a box";
    let run = stack("1/30,0.01");
    assert!(run.code == 0 && run.message.contains(told), "{}", run.message);
    assert!(!stack("0.01").message.contains("answered at some"));
}

#[test]
fn a_value_that_got_worse_stops_the_build_and_names_the_check() {
    let folder = Folder::new("gate-regression");
    let baseline = folder.path("b.toml");
    assert_eq!(gate(&["--save-baseline", &baseline], "moreau-jean").code, 0);
    // an engine that used to be exact has begun to round
    let text = std::fs::read_to_string(&baseline).expect("written");
    let mut table: toml::Table = text.parse().expect("toml");
    for value in table["check"][0]["value"].as_array_mut().expect("values") {
        value["value"] = toml::Value::Float(0.0);
        value["spread"] = toml::Value::Float(0.0);
    }
    std::fs::write(&baseline, table.to_string()).expect("writable");
    let run = gate(&["--baseline", &baseline], "moreau-jean");
    assert_eq!(run.code, 1, "{}", run.output);
    assert!(run.output.contains("Regressions") && run.output.contains("flight/projectile: worse: position error across"), "{}", run.output);
    let known = text + "\n[[known_issue]]\ncheck = \"flight/projectile\"\nreason = \"issue 12\"\n";
    std::fs::write(&baseline, known.replace("known_issue = []\n", "")).expect("writable");
    assert_eq!(gate(&["--baseline", &baseline], "moreau-jean").code, 0);
}

#[test]
fn an_engine_that_cannot_be_run_is_exit_code_three() {
    for command in [vec!["/nowhere/engine"], vec![env!("CARGO_BIN_EXE_moreau"), "engine", "--scheme", "euler"], vec!["true"]] {
        let folder = Folder::new("gate-cannot-run");
        let html = folder.path("p.html");
        let run = moreau(&[&["gate", "--quick", "--only", "flight/projectile", "--html", &html, "--"], command.as_slice()].concat());
        assert_eq!((run.code, run.output.as_str()), (3, ""), "{command:?}: {}", run.message);
        assert!(run.message.contains("could not be run"), "{}", run.message);
        assert!(folder.names().is_empty(), "nothing is written");
    }
}

#[test]
fn usage_errors_name_the_option_and_run_nothing() {
    gate(&["--only", "balls"], "moreau-jean").is_refused(&["balls"]);
    moreau(&["gate", "--steps", "0", "--", "true"]).is_refused(&["--steps", "0"]);
    moreau(&["gate", "--steps", "-1", "--", "true"]).is_refused(&["--steps", "-1"]);
    moreau(&["gate", "--steps", "0.1,1/10", "--", "true"]).is_refused(&["twice"]);
    gate(&["--jobs", "0"], "moreau-jean").is_refused(&["--jobs"]);
    gate(&["--option", "theta"], "moreau-jean").is_refused(&["NAME=VALUE"]);
    gate(&["--baseline", "/nowhere/b.toml"], "moreau-jean").is_refused(&["/nowhere/b.toml"]);
    for limit in ["-1", "0", "1e20", "nan"] {
        gate(&["--time-limit", limit], "moreau-jean").is_refused(&["`--time-limit`", "give a time above 0 and up to 1e9 seconds"]);
        gate(&["--start-limit", limit], "moreau-jean").is_refused(&["`--start-limit`", "up to 1e9 seconds"]);
        moreau(&["protocol-check", "--time-limit", limit, "--", "true"]).is_refused(&["`--time-limit`", "up to 1e9 seconds"]);
    }
    gate(&["--description", "d.json"], "moreau-jean").is_refused(&["--description", "without --trajectory", "leave it out"]);
    moreau(&["gate", "--list", "--steps", "0.1"]).is_refused(&["`--steps`: does nothing beside --list"]);
    let folder = Folder::new("gate-usage");
    let same = folder.path("same");
    gate(&["--html", &same, "--junit", &same], "moreau-jean").is_refused(&["same file"]);
    let broken = folder.file("broken.toml", "schema = \"gate-baseline/1\"\n");
    gate(&["--baseline", &broken], "moreau-jean").is_refused(&["broken.toml", "engine"]);
}

#[test]
fn a_time_step_that_is_longer_than_the_motion_is_told_by_its_option() {
    let engine = ["--", env!("CARGO_BIN_EXE_moreau"), "engine"];
    let run = moreau(&[&["gate", "--steps", "10", "--only", "incline/slide"][..], &engine].concat());
    let said = run.output.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("a time step of 10 s is longer than the motion of this check; take shorter ones with `--steps`"), "{said}");
    assert!(
        run.code == 1 && !said.contains("duration") && run.message.contains("answered with pass or difference: 0 of 1 check;"),
        "{}",
        run.message
    );
}

#[test]
fn a_cut_baseline_is_told_as_that_and_no_command_is_advised_for_it() {
    let folder = Folder::new("gate-cut-baseline");
    let baseline = folder.path("b.toml");
    assert_eq!(gate(&["--save-baseline", &baseline], "moreau-jean").code, 0);
    let whole = std::fs::read_to_string(&baseline).expect("written");
    for end in [whole.find("unit").expect("a value"), whole.len() / 2] {
        let cut = folder.file("cut.toml", &whole[..end]);
        let run = gate(&["--baseline", &cut], "moreau-jean");
        run.is_refused(&["cut.toml", "take a whole copy of the file, or make a new one"]);
        assert!(!run.message.contains("takes it"), "{}", run.message);
    }
}

#[test]
fn every_check_can_be_listed_and_explained() {
    let list = moreau(&["gate", "--list", "--format", "json"]).json();
    let names: Vec<&str> = list.as_array().expect("a list").iter().filter_map(|check| check["check"].as_str()).collect();
    assert!(names.len() >= 25, "{names:?}");
    for name in names {
        let check = moreau(&["gate", "--explain", name, "--format", "json"]).json();
        for field in ["question", "derivation", "source", "passed_by"] {
            assert!(check[field].as_str().is_some_and(|text| !text.is_empty()), "{name} has no {field}");
        }
        assert!(!check["failed_by"][0].as_str().unwrap_or("").is_empty(), "{name} names no planted mistake");
    }
    let refused = moreau(&["gate", "--explain", "ball/enrgy"]);
    refused.is_refused(&["ball/energy"]);
}

/// An entry of the index of written scenes.
#[derive(serde::Deserialize)]
struct Request {
    file: String,
    time_step: f64,
    sample_every: usize,
}

fn requests(folder: &str) -> Vec<Request> {
    let text = std::fs::read_to_string(format!("{folder}/index.json")).expect("an index");
    serde_json::from_str(&text).expect("a list of requests")
}

#[test]
fn every_written_scene_is_a_file_that_simulate_reads() {
    let folder = Folder::new("gate-scenes");
    let scenes = folder.path("scenes");
    let chosen = ["--only", "flight/,ball/,incline/stick,round/", "--steps", "1/60,1/240"];
    let run = moreau(&[&["gate", "--write-scenes", &scenes], &chosen[..]].concat());
    assert_eq!(run.code, 0, "{}", run.message);
    let requests = requests(&scenes);
    assert!(requests.len() > 8 && run.output.starts_with(&format!("{} scenes in ", requests.len())), "{}", run.output);
    for Request { file, time_step, sample_every } in &requests {
        assert!(file.chars().all(|letter| letter.is_ascii_alphanumeric() || "-.".contains(letter)), "{file}");
        assert!([1.0 / 60.0, 1.0 / 240.0].contains(time_step) && *sample_every >= 1, "{file}: {time_step} {sample_every}");
        let (step, scene) = (time_step.to_string(), format!("{scenes}/{file}"));
        let run = moreau(&["simulate", "--scene", &scene, "--step", &step, "--duration", &step]);
        assert_eq!(run.code, 0, "{file}: {}", run.message);
    }
}

#[test]
fn stored_trajectories_are_judged_like_a_program() {
    let folder = Folder::new("gate-stored");
    let scenes = folder.path("scenes");
    let run = moreau(&["gate", "--only", "flight/projectile", "--steps", "0.01", "--write-scenes", &scenes]);
    assert_eq!(run.code, 0, "{}", run.message);
    let scene = folder.path(&format!("scenes/{}", requests(&scenes)[0].file));
    let answer = folder.path("answer.json");
    let run = moreau(&["simulate", "--scene", &scene, "--step", "0.01", "--out", &answer]);
    assert_eq!(run.code, 0, "{}", run.message);
    let run = moreau(&["gate", "--only", "flight/projectile", "--steps", "0.01", "--trajectory", &answer]);
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    assert!(run.output.contains("pass        flight/projectile") && run.output.contains("pass        trajectory/answer"), "{}", run.output);
    // the audit of a file is no answer to what was selected
    let run = moreau(&["gate", "--only", "incline/", "--steps", "0.01", "--trajectory", &answer]);
    assert_eq!(run.code, 1, "{}{}", run.output, run.message);
    assert!(run.output.contains("pass        trajectory/answer") && run.message.contains("at least one is needed"), "{}", run.message);
    // what is answered at some of the steps only is told, and so is a run that answers nothing
    let run = moreau(&["gate", "--only", "flight/projectile", "--steps", "0.01,0.005", "--trajectory", &answer]);
    let partly = "flight/projectile is answered at h = 0.01 s only; no motion answers it at h = 0.005 s";
    assert!(run.code == 0 && run.message.contains(partly), "{}{}", run.output, run.message);
    let run = moreau(&["gate", "--steps", "0.005", "--trajectory", &answer]);
    assert!(run.code == 0 && run.message.contains("no check of the gate is answered by these motions"), "{}", run.message);
}

/// What the checks ask for depends on what the engine declares: Anitescu's law starts over the floor.
#[test]
fn scenes_are_those_that_the_description_asks_for() {
    let folder = Folder::new("gate-described");
    let description = moreau::gate::Engine::describe(&mut moreau::gate::own::by_name("anitescu").expect("built in"), &Default::default())
        .expect("describes itself");
    let described = folder.file("description.json", &serde_json::to_string(&description).expect("JSON"));
    let verdict = |name: &str, words: &[&str]| {
        let (scenes, answer) = (folder.path(name), folder.path(&format!("{name}-answer.json")));
        let chosen = ["gate", "--only", "incline/slide", "--steps", "0.01"];
        let run = moreau(&[&chosen[..], &["--write-scenes", &scenes], words].concat());
        assert_eq!(run.code, 0, "{}", run.message);
        let scene = format!("{scenes}/{}", requests(&scenes)[0].file);
        let run = moreau(&["simulate", "--scene", &scene, "--scheme", "anitescu", "--step", "0.01", "--out", &answer]);
        assert_eq!(run.code, 0, "{}", run.message);
        let judged = moreau(&[&chosen[..], &["--trajectory", &answer, "--description", &described, "--format", "json"]].concat());
        judged.json()["report"]["checks"][0]["verdict"].clone()
    };
    assert_eq!(verdict("rigid", &[]), "unsupported");
    // a motion of the right scene with a time that is none of its samples is told, and not only left out
    let motion = folder.path("described-answer.json");
    let text = || std::fs::read_to_string(&motion).expect("written");
    assert_eq!(verdict("described", &["--description", &described]), "pass");
    let mut changed: serde_json::Value = serde_json::from_str(&text()).expect("JSON");
    let end = changed["times"].as_array_mut().and_then(|times| times.last_mut()).expect("samples");
    *end = (end.as_f64().expect("a time") + 0.001).into();
    std::fs::write(&motion, changed.to_string()).expect("writable");
    let run = moreau(&["gate", "--steps", "0.01", "--trajectory", &motion, "--description", &described]);
    assert!(run.message.contains("remark: incline/slide is not answered: the stored trajectory of"), "{}{}", run.message, run.output);
}

#[test]
fn a_failure_that_the_baseline_has_is_an_answer_though_it_is_the_only_one() {
    let folder = Folder::new("gate-known-alone");
    let [answer, baseline] = [answered(&folder, "flight/projectile", "0.01", &[]), folder.path("b.toml")];
    let mut motion: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&answer).expect("written")).expect("JSON");
    let end = motion["bodies"][0]["position"].as_array_mut().and_then(|samples| samples.last_mut()).expect("samples");
    end[2] = 50.0.into();
    std::fs::write(&answer, motion.to_string()).expect("writable");
    let gate =
        |more: &[&str]| moreau(&[&["gate", "--steps", "0.01", "--only", "flight/projectile", "--trajectory", &answer], more].concat());
    assert_eq!(gate(&["--save-baseline", &baseline]).code, 1, "a failure is one before it is in a baseline");
    let run = gate(&["--baseline", &baseline]);
    assert!(run.code == 0 && run.output.contains("As the baseline."), "{}{}", run.output, run.message);
    let run = gate(&["--baseline", &baseline, "--require", "1"]);
    assert!(run.code == 1 && run.message.contains("answered with pass or difference: 0 of 1 check"), "{}", run.message);
}

#[test]
fn a_baseline_of_all_checks_is_not_replaced_by_one_of_some() {
    let folder = Folder::new("gate-partial-baseline");
    let baseline = folder.path("b.toml");
    let save = |only: &str| {
        moreau(&["gate", "--only", only, "--steps", "0.01", "--save-baseline", &baseline, "--", env!("CARGO_BIN_EXE_moreau"), "engine"])
    };
    assert_eq!(save("flight/projectile,ball/restitution").code, 0);
    save("flight/projectile").is_refused(&["`--save-baseline`", "checks that this run leaves out, such as ball/restitution"]);
    assert_eq!(save("flight/,ball/restitution").code, 0, "more checks are none less");
    std::fs::write(&baseline, "[package]").expect("writable");
    save("flight/projectile").is_refused(&["`--save-baseline`", "is no baseline"]);
    assert_eq!(std::fs::read_to_string(&baseline).expect("left as it was"), "[package]");
}

#[test]
fn scenes_of_another_call_are_not_left_among_those_that_are_asked_for() {
    let folder = Folder::new("gate-other-scenes");
    let scenes = folder.path("scenes");
    let write = |check: &str| moreau(&["gate", "--only", check, "--steps", "0.01", "--write-scenes", &scenes]);
    let first = || write("flight/projectile");
    assert_eq!((first().code, first().code), (0, 0), "the same scenes may be written again");
    write("incline/stick").is_refused(&["`--write-scenes`", "has scenes of another call, such as 000-projectile.json"]);
    let left = requests(&scenes);
    assert!(left.iter().all(|request| request.file.contains("projectile")));
}

#[test]
fn an_empty_name_of_a_check_is_no_name_of_all() {
    for words in [&["--only", ""][..], &["--only", "ball/,"], &["--skip", " "]] {
        moreau(&[&["gate", "--list"], words].concat()).is_refused(&[words[0], "has an empty name"]);
    }
}

/// The motion of the first of the scenes that a check asks for, as a file.
fn answered(folder: &Folder, check: &str, step: &str, duration: &[&str]) -> String {
    let scenes = folder.path("scenes");
    let run = moreau(&["gate", "--only", check, "--steps", step, "--write-scenes", &scenes]);
    assert_eq!(run.code, 0, "{}", run.message);
    let scene = folder.path(&format!("scenes/{}", requests(&scenes)[0].file));
    let answer = folder.path(if duration.is_empty() { "answer.json" } else { "short.json" });
    let run = moreau(&[&["simulate", "--scene", &scene, "--step", step, "--out", &answer], duration].concat());
    assert_eq!(run.code, 0, "{}", run.message);
    answer
}

#[test]
fn what_is_not_judged_by_files_has_no_scenes_to_write() {
    let folder = Folder::new("gate-no-scenes");
    let scenes = folder.path("scenes");
    let write = |words: &[&str]| moreau(&[&["gate", "--write-scenes", &scenes, "--steps", "10"], words].concat());
    for words in [&["--solver"][..], &["--projection"], &["--only", "solver/,projection/"], &["--solver", "--only", "ball/"]] {
        write(words).is_refused(&["`--write-scenes`", "no scene to write", "not judged by files", "`moreau gate --solver -- COMMAND`"]);
        assert!(folder.names().is_empty(), "{words:?}: {:?}", folder.names());
    }
    write(&["--only", "ball/", "--skip", "ball/"]).is_refused(&["`--only` and `--skip` and `--write-scenes`", "leave no check together"]);
    write(&["--only", "incline/slide"]).is_refused(&["no scene to write", "take shorter ones with `--steps`"]);
}

#[test]
fn a_longer_motion_beside_a_short_one_answers_in_any_order() {
    let folder = Folder::new("gate-two-lengths");
    let [whole, short] = [&[][..], &["--duration", "0.02"]].map(|duration| answered(&folder, "flight/projectile", "0.01", duration));
    for files in [[&whole, &short], [&short, &whole]] {
        let run = moreau(&["gate", "--only", "flight/projectile", "--steps", "0.01", "--trajectory", files[0], files[1]]);
        assert!(run.code == 0 && run.output.contains("pass        flight/projectile"), "{files:?}: {}{}", run.output, run.message);
    }
}

#[test]
fn a_check_that_was_asked_for_and_has_no_motion_is_shown_and_counts_for_what_is_required() {
    let folder = Folder::new("gate-unanswered");
    let answer = answered(&folder, "flight/projectile", "0.01", &[]);
    let gate = |only: &[&str], more: &[&str]| moreau(&[&["gate", "--steps", "0.01"], only, more, &["--trajectory", &answer]].concat());
    let run = gate(&["--only", "flight/projectile,ball/energy"], &["--require", "100"]);
    assert!(run.output.contains("unsupported ball/energy") && run.output.contains("no stored trajectory"), "{}", run.output);
    assert!(run.code == 1 && run.message.contains("answered with pass or difference: 1 of 2 checks;"), "{}", run.message);
    let json = gate(&["--only", "ball/energy"], &["--format", "json"]).json();
    let told = |k: usize| [&json["report"]["checks"][k]["check"], &json["report"]["checks"][k]["verdict"]].map(|word| word.as_str());
    assert_eq!([told(0), told(1)], [[Some("ball/energy"), Some("unsupported")], [Some("trajectory/answer"), Some("pass")]]);
    assert!(!gate(&[], &[]).output.contains("unsupported "), "what nobody asked for is left out");
    assert_eq!(gate(&[], &["--require", "50"]).code, 1, "of all checks of motions");
}

#[test]
fn a_baseline_of_stored_motions_is_met_by_them_and_misses_those_that_are_gone() {
    let folder = Folder::new("gate-stored-baseline");
    let baseline = folder.path("b.toml");
    let [whole, short] = [&[][..], &["--duration", "0.02"]].map(|duration| answered(&folder, "flight/projectile", "0.01", duration));
    for only in [&["--only", "flight/projectile"][..], &[]] {
        let gate = |more: &[&str]| moreau(&[&["gate", "--steps", "0.01"], only, more].concat());
        let run = gate(&["--save-baseline", &baseline, "--trajectory", &whole]);
        assert_eq!(run.code, 0, "{}{}", run.output, run.message);
        let run = gate(&["--baseline", &baseline, "--trajectory", &whole]);
        assert!(run.code == 0 && run.output.contains("As the baseline."), "{}{}", run.output, run.message);
        let run = gate(&["--baseline", &baseline, "--trajectory", &short]);
        let said = run.output.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(run.code == 1 && said.contains("flight/projectile: unsupported instead of pass"), "{said}");
        assert!(
            said.contains("trajectory/answer: is in the baseline, but no file `answer` is judged: give it to `--trajectory`"),
            "{said}"
        );
    }
}
