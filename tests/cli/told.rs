//! What newcomers and experts met at the command line: each mistake is told by what it is, with what cures it.

use super::{Folder, PROBLEM, moreau};

const LCP: &str = r#"{"schema": "lcp/1", "name": "two", "matrix": {"shape": [2, 2], "rows": [[2, 1], [0, 1]]}, "vector": [-1, 2]}"#;
const ANSWER: &str = r#"{"schema": "solution/1", "problem": "block", "impulse": [1, -0.5]}"#;
const BASELINE: &str = "schema = \"gate-baseline/1\"\nengine = \"none\"\n";

/// A ball on a belt, which needs schemes that take infinite masses.
const BELT: &str = r#"{"schema": "scene/1", "name": "belt", "gravity": [0, 0, -9.81], "duration": 0.05,
  "material": {"friction": 0.5, "restitution": 0},
  "bodies": [{"name": "belt", "box": {"half_extents": [1, 1, 0.1]}, "position": [0, 0, 0], "prescribed": {"velocity": [1, 0, 0]}},
             {"name": "ball", "sphere": {"radius": 0.1}, "mass": 1, "position": [0, 0, 0.2]}]}"#;

#[test]
fn a_file_for_another_command_is_told_with_that_command() {
    let folder = Folder::new("told-kinds");
    let motion = folder.path("motion.json");
    assert_eq!(moreau(&["simulate", "--scene", "ball-drop", "--step", "0.1", "--out", &motion]).code, 0);
    let numbers = "2\n1 0\n0 1\n-1 2\n0.5\n";
    let [problem, lcp, answer, scene, baseline, dat, report] = [
        ("problem.json", PROBLEM),
        ("lcp.json", LCP),
        ("answer.json", ANSWER),
        ("scene.json", BELT),
        ("baseline.toml", BASELINE),
        ("numbers.dat", numbers),
        ("report.json", r#"{"schema": "gate-report/1"}"#),
    ]
    .map(|(name, text)| folder.file(name, text));
    let hdf5 = folder.path("problem.hdf5");
    assert_eq!(moreau(&["convert", &problem, "--out", &folder.path("copy.json")]).code, 0);
    let space = PROBLEM.replace("\"dimension\": 2", "\"dimension\": 3").replace("[-1, 2]", "[-1, 2, 0]");
    let space = space.replace("[2, 2]", "[3, 3]").replace("[[1, 0], [0, 1]]", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
    assert_eq!(moreau(&["convert", &folder.file("space.json", &space), "--out", &hdf5]).code, 0);
    // what each file is for, by a word of its command
    let files = [
        (&problem, "`moreau solve "),
        (&lcp, "`moreau solve "),
        (&answer, "`moreau certify PROBLEM "),
        (&scene, "`moreau simulate --scene "),
        (&motion, "`moreau gate --trajectory "),
        (&baseline, "`moreau gate --baseline "),
        (&report, "no command takes it"),
        (&dat, "`moreau solve "),
        (&hdf5, "`moreau solve "),
    ];
    type Command<'a> = (&'a dyn Fn(&str) -> Vec<String>, &'a [&'a String]);
    let words = |words: &[&str]| words.iter().map(|word| word.to_string()).collect::<Vec<_>>();
    // the answer to a problem has its own message where it stands for one, and the other way about
    let posed = [&problem, &lcp, &dat, &hdf5, &answer];
    let commands: [Command; 9] = [
        (&|file| words(&["solve", file]), &posed),
        (&|file| words(&["convert", file, "--out", &folder.path("never.json")]), &posed[..4]),
        (&|file| words(&["new", "solution", file]), &posed),
        (&|file| words(&["certify", file, &answer]), &posed),
        (&|file| words(&["certify", &problem, file]), &[&answer, &problem, &lcp, &dat, &hdf5]),
        (&|file| words(&["solve", &problem, "--start", file]), &[&answer, &hdf5]),
        (&|file| words(&["simulate", "--scene", file]), &[&scene]),
        (&|file| words(&["compare", file]), &[&scene]),
        (&|file| words(&["gate", "--trajectory", file]), &[&motion]),
    ];
    let mut told = 0;
    for (command, taken) in commands {
        for (file, advice) in files.iter().filter(|(file, _)| !taken.contains(file)) {
            let arguments = command(file);
            let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
            moreau(&arguments).is_refused(&[file, advice]);
            told += 1;
        }
    }
    assert!(told > 45, "{told}");
    moreau(&["gate", "--baseline", &scene, "--", "none"]).is_refused(&["scene.json", "`moreau simulate --scene"]);
    let folder_of_scenes = folder.path("several");
    std::fs::create_dir(&folder_of_scenes).expect("a writable folder");
    std::fs::write(format!("{folder_of_scenes}/scene.json"), BELT).expect("a writable folder");
    let run = moreau(&["solve", &folder_of_scenes, "--out", &folder.path("answers")]);
    let line = run.output.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(run.code == 2 && line.contains("`moreau simulate --scene"), "{}", run.output);
    // a mistake in a file that the command takes is no matter of the kind
    let wrong = moreau(&["solve", &folder.file("wrong.json", &PROBLEM.replace("[0.5]", "[-0.5]"))]);
    assert!(!wrong.message.contains("takes it"), "{}", wrong.message);
}

#[test]
fn a_scheme_that_needs_finite_masses_names_itself_the_bodies_and_the_file() {
    let folder = Folder::new("told-masses");
    let scene = folder.file("belt.json", BELT);
    for scheme in ["variational", "drake-similar", "drake-lagged", "drake-tamsi"] {
        let run = moreau(&["simulate", "--scene", &scene, "--scheme", scheme, "--step", "0.01"]);
        run.is_refused(&["belt.json", "of body `belt` is infinite", &scheme[..5], "needs finite masses", "finite mass", "`moreau-jean`"]);
        assert!(!run.message.contains("ball"), "{}", run.message);
    }
    let two = BELT.replace("\"mass\": 1,", "\"static\": true,");
    let run = moreau(&["simulate", "--scene", &folder.file("two.json", &two), "--scheme", "variational", "--step", "0.01"]);
    run.is_refused(&["two.json", "of bodies `belt`, `ball` are infinite"]);
    let run = moreau(&["compare", &scene, "--schemes", "moreau-jean,drake-tamsi", "--step", "0.01"]);
    let said = run.output.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(run.code == 0 && said.contains("drake-tamsi: unsupported: field `mass`: of body `belt` is infinite"), "{}", run.output);
    assert_eq!(moreau(&["simulate", "--scene", &scene, "--step", "0.01"]).code, 0);
}

#[test]
fn names_that_nothing_has_are_answered_with_those_that_are_meant() {
    let folder = Folder::new("told-names");
    moreau(&["simulate", "--scene", "bounce"]).is_refused(&["did you mean `bouncing-ball`"]);
    moreau(&["compare", "stack"]).is_refused(&["did you mean `box-stack`"]);
    moreau(&["simulate", "--scene", "ball-drop", "--scheme", "trinkle"]).is_refused(&["did you mean `stewart-trinkle`"]);
    let problem = folder.file("p.json", PROBLEM);
    moreau(&["solve", &problem, "--solver", "newton-raphson"]).is_refused(&["did you mean `newton"]);
    moreau(&["bench", &problem, "--solver", "interior"]).is_refused(&["did you mean `interior-point`"]);
    let field = |wrong: &str, right: &str| {
        let text = PROBLEM.replace(&format!("\"{right}\""), &format!("\"{wrong}\""));
        moreau(&["solve", &folder.file("field.json", &text)])
            .is_refused(&[&format!("field `{wrong}`: unknown"), &format!("did you mean `{right}`")]);
    };
    field("velocity", "free_velocity");
    field("frictions", "friction");
    field("dimensions", "dimension");
    moreau(&["engine", "--scheme", "anitesku"]).is_refused(&["--scheme", "did you mean `anitescu`"]);
    moreau(&["engine", "--scheme", "chrono"]).is_refused(&[
        "is chrono, which is not served",
        "declares its contact law",
        "stewart-trinkle",
    ]);
    moreau(&["engine", "--planted", "restitution"]).is_refused(&["no planted mistake `restitution`; "]);
}

#[test]
fn numbers_that_are_too_large_are_told_so_and_no_time_is_told_as_0() {
    let folder = Folder::new("told-numbers");
    let problem = folder.file("p.json", PROBLEM);
    let scene = ["simulate", "--scene", "bouncing-ball"];
    for (option, value) in [("--step", "1e400"), ("--duration", "-1e999"), ("--step", "1/1e400"), ("--theta", "1e400")] {
        let run = moreau(&[&scene[..], &[option, value]].concat());
        assert!(run.code == 2 && run.message.contains("give a smaller number") && run.message.contains(option), "{}", run.message);
        assert!(!run.message.contains("is inf"), "{}", run.message);
    }
    let run = moreau(&["solve", &problem, "--tolerance", "1e400"]);
    assert!(run.code == 2 && run.message.contains("give a smaller number"), "{}", run.message);
    moreau(&["solve", &problem, "--time-limit", "0"]).is_refused(&["`--time-limit`: is 0;"]);
}

#[test]
fn a_number_that_the_end_of_the_file_cuts_is_told_as_a_cut_file() {
    let folder = Folder::new("told-cut");
    for cut in ["0.", "-", "1e"] {
        let text = PROBLEM.replace("[-1, 2], \"delassus\"", &format!("[{cut}"));
        let text = &text[..text.rfind(&format!("[{cut}")).expect("u_free") + 1 + cut.len()];
        let run = moreau(&["solve", &folder.file("cut.json", text)]);
        run.is_refused(&["cut.json", "`free_velocity`", "ends early, at line 2 column", "again, whole"]);
    }
}

#[test]
fn the_folder_of_rejected_steps_is_made_with_the_first_of_them() {
    let folder = Folder::new("told-dumps");
    let rejected = folder.path("new/rejected");
    let scene = ["simulate", "--scene", "box-stack", "--step", "0.02"];
    assert_eq!(moreau(&[&scene[..], &["--dump-rejected", &rejected]].concat()).code, 0);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
    let run = moreau(&[&scene[..], &["--dump-rejected", &rejected, "--solver", "pgs", "--certify-tolerance", "0"]].concat());
    assert_eq!(run.code, 1);
    assert!(std::fs::read_dir(&rejected).expect("made").count() > 0);
    let file = folder.file("file", "");
    moreau(&[&scene[..], &["--dump-rejected", &format!("{file}/below")]].concat())
        .is_refused(&["--dump-rejected", "is a file; name a folder"]);
}

#[test]
fn a_solver_that_does_not_take_a_law_is_told_alike_by_solve_simulate_and_compare() {
    let folder = Folder::new("told-solvers");
    let problem = folder.file("p.json", PROBLEM);
    let solve = moreau(&["solve", &problem, "--solver", "murty"]);
    let simulate = moreau(&["simulate", "--scene", "incline-slide", "--solver", "murty", "--step", "0.01"]);
    for run in [&solve, &simulate] {
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.message);
        assert!(run.message.contains("solver `murty` (refused): is for the law `frictionless`"), "{}", run.message);
        assert!(run.message.contains("use `auto`, `lemke` or ") && run.message.contains("which take this problem"), "{}", run.message);
    }
    let compare = moreau(&["compare", "incline-slide", "--schemes", "moreau-jean", "--solver", "murty", "--step", "0.01"]);
    let said = compare.output.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(compare.code == 1 && said.contains("which take this problem"), "{}", compare.output);
}

#[test]
fn a_cut_motion_is_told_by_who_reads_its_trajectory() {
    let folder = Folder::new("told-motions");
    let motion = folder.path("motion.json");
    let words = ["simulate", "--scene", "ball-drop", "--step", "0.1", "--out", &motion];
    assert_eq!(moreau(&words).code, 0);
    let audit = || moreau(&["gate", "--trajectory", &motion, "--quick"]).message;
    assert!(!audit().contains("the motion is cut"), "{}", audit());
    assert_eq!(moreau(&[&words[..], &["--time-limit", "1e-9"]].concat()).code, 1);
    let said = audit();
    for word in
        ["remark: ", "motion.json: the motion is cut, it ends at t = 0 s of ", "the time limit of `moreau simulate` ended it in step 1 of"]
    {
        assert!(said.contains(word), "{word}: {said}");
    }
    // v² is above the largest double from 1.341e154 m/s: in the 135th step of 1e152 m/s each
    let scene = folder.path("thrown.json");
    let thrown = r#"{"schema": "scene/1", "name": "thrown", "duration": 300, "gravity": [0, 0, 1e152],
        "material": {"friction": 0, "restitution": 0},
        "bodies": [{"name": "ball", "mass": 1, "sphere": {"radius": 1}, "position": [0, 0, 2]}]}"#;
    std::fs::write(&scene, thrown).expect("writes");
    assert_eq!(moreau(&["simulate", "--scene", &scene, "--step", "1", "--out", &motion]).code, 1);
    assert!(audit().contains("it ends at t = 134 s of 300 s: step 135 of 300 could not be made by `moreau simulate`"), "{}", audit());
}

#[test]
fn compare_says_from_which_closed_form_it_measures_where_simulate_measures_from_another() {
    let simulate = |scheme| moreau(&["simulate", "--scene", "two-ball-impact", "--scheme", scheme, "--step", "0.01"]).output;
    assert!(simulate("anitescu").contains("(v₁ − v₂), with e = 0"), "{}", simulate("anitescu"));
    assert!(!simulate("moreau-jean").contains("e = 0"), "{}", simulate("moreau-jean"));
    let compare = |scene, schemes| moreau(&["compare", scene, "--schemes", schemes, "--step", "0.01"]).output;
    let said = |scene, schemes| compare(scene, schemes).split_whitespace().collect::<Vec<_>>().join(" ");
    let plastic = said("two-ball-impact", "moreau-jean,anitescu,stewart-trinkle");
    assert!(plastic.contains("anitescu, stewart-trinkle: this scheme has no restitution"), "{plastic}");
    assert!(plastic.contains("measured from the closed form with the scene's e; `moreau simulate` measures"), "{plastic}");
    for (scene, schemes) in [("two-ball-impact", "moreau-jean"), ("incline-slide", "anitescu")] {
        assert!(!said(scene, schemes).contains("restitution:"), "{}", said(scene, schemes));
    }
}
