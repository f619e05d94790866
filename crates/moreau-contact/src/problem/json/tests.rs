//! Tests of the readers: what goes out comes back bit for bit, and every mistake is named.

use super::*;
use crate::Law;
use crate::contact::delassus::delassus;
use crate::operator::Sparse;
use crate::problem::{ContactKey, Dynamics, Solution};
use crate::tolerance::sharpness::roundings;
use nalgebra::DMatrix;

const BLOCK: &str = r#"{"schema":"contact-problem/1","name":"block","dimension":2,"law":"coulomb","friction":[0.5],
    "free_velocity":[-0.1,0.30000000000000004],"delassus":{"shape":[2,2],"rows":[[1,0.25],[0.25,3]]},
    "compliance":{"coordinates":"contact","diagonal":[0.125,0]},"provenance":{"by":"hand"}}"#;

fn refused(text: &str, words: &[&str]) {
    let message = ContactProblem::from_json(text).expect_err(text).to_string();
    for word in words {
        assert!(message.contains(word), "`{word}` not in: {message}");
    }
}

#[test]
fn a_problem_comes_back_bit_for_bit() {
    let problem = ContactProblem::from_json(BLOCK).expect("well formed");
    assert_eq!(problem.shift(), &DVector::zeros(2));
    assert_eq!(problem.free_velocity()[1].to_bits(), (0.1f64 + 0.2).to_bits());
    assert_eq!(ContactProblem::from_json(&problem.to_json()).expect("well formed"), problem);
}

#[test]
fn mass_and_jacobian_make_the_delassus_operator_and_are_kept() {
    let text = r#"{"schema":"contact-problem/1","name":"two balls","dimension":1,"law":"frictionless","friction":[0,0],
        "free_velocity":[-1,0],"mass":{"shape":[2,2],"triplets":{"row":[0,1],"column":[0,1],"value":[2,4]}},
        "jacobian":{"shape":[2,2],"rows":[[1,0],[-1,1]]}}"#;
    let problem = ContactProblem::from_json(text).expect("well formed");
    assert_eq!(problem.dense(), &DMatrix::from_row_slice(2, 2, &[0.5, -0.5, -0.5, 0.75]));
    assert_eq!(ContactProblem::from_json(&problem.to_json()).expect("well formed"), problem);
    refused(&text.replace("[2,4]", "[2,-4]"), &["mass", "positive"]);
    refused(&text.replace(r#""row":[0,1],"column":[0,1],"value":[2,4]"#, r#""row":[0,1,0],"column":[0,1,1],"value":[2,4,1]"#), &["mass"]);
    refused(&text.replace("\"shape\":[2,2],\"trip", "\"shape\":[9999999999,9999999999],\"trip"), &["mass"]);
    refused(&text.replace("\"row\":[0,1],", "\"row\":[0,2],"), &["mass.triplets.row[1]", "is 2"]);
    refused(&text.replace("\"column\":[0,1],", "\"column\":[0],"), &["mass.triplets", "three lists of one length"]);
    refused(&text.replace("\"row\":[0,1],\"column\":[0,1]", "\"row\":[0,0],\"column\":[1,1]"), &["mass.triplets", "(0, 1)"]);
}

#[test]
fn a_large_matrix_with_few_entries_is_written_by_them_and_comes_back_bit_for_bit() {
    let build = |w: DMatrix<f64>| {
        let free = DVector::from_element(w.nrows(), -1.0);
        ContactProblem::new(w, free).law(Law::Frictionless).rows_per_contact(1).friction(vec![0.0; 300]).build().expect("valid")
    };
    let mut w = DMatrix::identity(300, 300);
    w[(7, 9)] = -0.0;
    let (few, many) = (build(w), build(DMatrix::identity(300, 300).add_scalar(1.0)));
    assert!(few.to_json().contains("triplets") && few.to_json().len() < 20_000 && many.to_json().contains("\"rows\":[["));
    for problem in [&few, &many] {
        let back = ContactProblem::from_json(&problem.to_json()).expect("well formed");
        let bits = |problem: &ContactProblem| problem.dense().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert!(back == *problem && bits(&back) == bits(problem));
    }
    // of a mass with many velocities and few rows, and where both are large: W stays as it was
    for rows in [1, 300] {
        let dynamics = Dynamics { mass: DMatrix::identity(600, 600) * 2.0, jacobian: DMatrix::identity(rows, 600) };
        let w = delassus(&dynamics.mass, &dynamics.jacobian).expect("SPD");
        let problem = ContactProblem::new(w, DVector::from_element(rows, -1.0)).law(Law::Frictionless).rows_per_contact(1);
        let problem = problem.friction(vec![0.0; rows]).dynamics(dynamics).build().expect("valid");
        let text = problem.to_json();
        assert!(text.contains(r#""mass":{"shape":[600,600],"triplets""#), "{}", &text[..200]);
        assert_eq!(ContactProblem::from_json(&text).expect("well formed"), problem);
    }
}

#[test]
fn shift_directions_and_edge_compliance_come_back() {
    let text = r#"{"schema":"contact-problem/1","name":"edges","dimension":3,"law":"polyhedral-associated","directions":4,"friction":[0.5],
        "free_velocity":[-1,0,2],"shift":[0.25,0,-0.5],"delassus":{"shape":[3,3],"rows":[[1,0,0],[0,1,0],[0,0,1]]},
        "compliance":{"coordinates":"edge","diagonal":[0.5,0,0.25,1]}}"#;
    let problem = ContactProblem::from_json(text).expect("well formed");
    assert_eq!(problem.law(), Law::PolyhedralAssociated { directions: 4 });
    assert_eq!(problem.shift().as_slice(), [0.25, 0.0, -0.5]);
    assert_eq!(problem.compliance().expect("valid by construction").coordinates, Coordinates::Edge);
    assert_eq!(ContactProblem::from_json(&problem.to_json()).expect("well formed"), problem);
}

#[test]
fn an_operator_that_does_not_follow_from_mass_and_jacobian_is_written_itself() {
    let dynamics = Dynamics { mass: DMatrix::identity(2, 2), jacobian: DMatrix::identity(2, 2) };
    let problem = ContactProblem::from_json(BLOCK).expect("well formed").into_builder().dynamics(dynamics).build().expect("sizes fit");
    let back = ContactProblem::from_json(&problem.to_json()).expect("well formed");
    assert_eq!((back.dense(), back.dynamics()), (problem.dense(), None));
}

const CHAIN: &str = r#"{"schema":"contact-problem/1","name":"chain","dimension":2,"law":"coulomb","friction":[0.5,0.25],
    "free_velocity":[-1,2,-0.5,0],"delassus":{"shape":[4,4],"blocks":{"row":[1,0,0],"column":[1,1,0],
    "value":[3,0.5,0.5,4, -1,0.125,0.25,0, 2,0,0,2]}}}"#;

#[test]
fn blocks_are_read_row_by_row_kept_as_blocks_and_come_back() {
    let problem = ContactProblem::from_json(CHAIN).expect("well formed");
    let blocks = problem.delassus().blocks().expect("they are kept");
    assert_eq!((blocks.block_count(), problem.entry(0, 3), problem.entry(1, 2), problem.entry(2, 0)), (3, 0.125, 0.25, 0.0));
    assert_eq!(ContactProblem::from_json(&problem.to_json()).expect("well formed"), problem);
    let written_out = problem.clone().into_builder().delassus(problem.dense().clone()).build().expect("sizes fit");
    let impulse = DVector::from_vec(vec![1.0, 0.5, 2.0, -0.25]);
    assert_eq!(problem.velocity(&impulse), written_out.velocity(&impulse));
    refused(&CHAIN.replace("[1,0,0]", "[2,0,0]"), &["delassus", "(2, 1)"]);
    refused(&CHAIN.replace("[1,0,0]", "[0,0,0]"), &["repeats the block (0, 1)"]);
    refused(&CHAIN.replace("[1,0,0]", "[0,0]"), &["delassus.blocks", "2 rows, 3 columns"]);
    refused(&CHAIN.replace("2,0,0,2]", "2,0,0]"), &["delassus.blocks", "11 values"]);
    refused(&CHAIN.replace("[4,4]", "[2,2]"), &["delassus", "4×4"]);
    refused(&CHAIN.replace("\"blocks\"", "\"rows\":[],\"blocks\""), &["delassus", "more than one"]);
}

/// A ball of 2 kg on the floor and a plate of 4 kg on it, planar: the ball has two velocities, the plate one.
const BODIES: &str = r#"{"schema":"contact-problem/1","name":"bodies","dimension":2,"law":"coulomb","friction":[0.5,0.25],
    "free_velocity":[-1,2,-0.5,0.125],"mass":{"shape":[3,3],"diagonal_blocks":[[2,0.5,0.5,1],[4]]},
    "jacobian":{"shape":[4,3],"sparse_rows":{"starts":[0,1,2,4,5],"column":[0,1,0,2,1],"value":[1,0.1,-1,1,-0.30000000000000004]}},
    "keys":[{"bodies":[0,null],"features":[0,0]},{"bodies":[1,0],"features":[3,1]}]}"#;

#[test]
fn masses_and_sparse_rows_make_an_operator_that_is_not_formed_and_come_back_bit_for_bit() {
    let problem = ContactProblem::from_json(BODIES).expect("well formed");
    let free = problem.delassus().matrix_free().expect("W is not formed");
    assert_eq!(
        (free.jacobian().bodies(1), free.mass(0)[(0, 1)], problem.keys().expect("valid by construction")[1].features),
        (&[0, 1][..], 0.5, [3, 1])
    );
    let back = ContactProblem::from_json(&problem.to_json()).expect("well formed");
    assert_eq!((&back, back.delassus().entries()), (&problem, problem.delassus().entries()));
    let mass = DMatrix::from_row_slice(3, 3, &[2.0, 0.5, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 4.0]);
    let jacobian = DMatrix::from_row_slice(4, 3, &[1.0, 0.0, 0.0, 0.0, 0.1, 0.0, -1.0, 0.0, 1.0, 0.0, -0.1 - 0.2, 0.0]);
    let dense = delassus(&mass, &jacobian).expect("valid by construction");
    assert!((problem.dense() - &dense).amax() <= moreau_exact::tolerance::rounding(16, dense.amax()));
    refused(&BODIES.replace("[4]]", "[4,1]]"), &["mass.diagonal_blocks[1]", "2 entries"]);
    refused(&BODIES.replace(",[4]]", "]"), &["mass.diagonal_blocks", "2 rows"]);
    refused(&BODIES.replace("[4]]", "[-4]]"), &["mass", "positive definite"]);
    refused(&BODIES.replace("0.5,0.5", "0.5,0.25"), &["mass.diagonal_blocks[0]", "(1, 0) is 0.25 and (0, 1) is 0.5", "give a symmetric"]);
    assert!(ContactProblem::from_json(&BODIES.replace("0.5,0.5", "0.5,0.5000000000000001")).is_ok(), "what is rounded is no asymmetry");
    refused(&BODIES.replace("[0,1,2,4,5]", "[0,1,2,4]"), &["jacobian.sparse_rows", "4 starts"]);
    refused(&BODIES.replace("[0,1,2,4,5]", "[0,2,1,4,5]"), &["jacobian.sparse_rows.starts"]);
    refused(&BODIES.replace("[0,1,0,2,1]", "[0,1,0,3,1]"), &["jacobian.sparse_rows.column[3]", "below 3"]);
    refused(&BODIES.replace("[0,1,0,2,1]", "[0,1,0,0,1]"), &["jacobian.sparse_rows", "(2, 0)"]);
    refused(&BODIES.replace("\"diagonal_blocks\":[[2,0.5,0.5,1],[4]]", "\"rows\":[[2,0,0],[0,1,0],[0,0,4]]"), &["mass", "both"]);
    refused(&BODIES.replace("\"sparse_rows\"", "\"rows\":[],\"sparse_rows\""), &["jacobian", "more than one"]);
    refused(&BODIES.replace("[1,0],\"features\":[3,1]", "[0,null],\"features\":[0,0]"), &["keys[1]"]);
}

/// A tower of bodies of two velocities, each on the one below, of three contacts each: more rows than make a dense W.
fn tower(bodies: usize) -> [Sparse; 2] {
    let entry = |seed: usize| ((seed * 7919 + 13) % 101) as f64 / 37.0 - 1.0;
    let mass = (0..bodies)
        .flat_map(|b| [(2 * b, 2 * b, 2.0 + b as f64), (2 * b, 2 * b + 1, 0.5), (2 * b + 1, 2 * b, 0.5), (2 * b + 1, 2 * b + 1, 3.0)]);
    let mut rows = Vec::new();
    for row in 0..3 * bodies {
        let body = row / 3;
        rows.extend((2 * body.saturating_sub(1)..2 * body + 2).map(|v| (row, v, entry(5 * row + v))));
    }
    [Sparse { shape: [2 * bodies; 2], entries: mass.collect() }, Sparse { shape: [3 * bodies, 2 * bodies], entries: rows }]
}

#[test]
fn mass_and_jacobian_are_kept_however_they_are_spelled_and_come_back_in_lists_where_w_has_blocks() {
    let [mass, jacobian] = tower(100);
    let spelled = |field: &str, of: &Sparse| {
        let part = |pick: &dyn Fn(&(usize, usize, f64)) -> String| of.entries.iter().map(pick).collect::<Vec<_>>().join(",");
        let (row, column, value) = (part(&|e| e.0.to_string()), part(&|e| e.1.to_string()), part(&|e| e.2.to_string()));
        format!(
            r#""{field}": {{"shape": [{}, {}], "triplets": {{"row": [{row}], "column": [{column}], "value": [{value}]}}}}"#,
            of.shape[0], of.shape[1]
        )
    };
    let friction = vec!["0"; 300].join(",");
    let text = format!(
        r#"{{"schema": "contact-problem/1", "name": "tower", "dimension": 1, "law": "frictionless", "friction": [{friction}],
            "free_velocity": [{friction}], {}, {}}}"#,
        spelled("mass", &mass),
        spelled("jacobian", &jacobian)
    );
    let problem = ContactProblem::from_json(&text).expect("well formed");
    assert!(problem.delassus().blocks().is_some());
    let known = Dynamics { mass: mass.to_dense(), jacobian: jacobian.to_dense() };
    assert_eq!(problem.dynamics(), Some(&known));
    let written = problem.to_json();
    assert!(written.contains("triplets") && !written.contains("delassus"));
    assert_eq!(ContactProblem::from_json(&written).expect("it was written"), problem);
    // row by row they make the same W to rounding, and are the same
    let rows = ContactProblem::from_dynamics(known.mass.clone(), known.jacobian.clone(), &DVector::zeros(200)).rows_per_contact(1);
    let rows = rows.law(Law::Frictionless).friction(vec![0.0; 300]).build().expect("valid by construction");
    assert_eq!(rows.dynamics(), problem.dynamics());
    assert!((rows.dense() - problem.dense()).amax() <= moreau_exact::tolerance::rounding(16, rows.dense().amax()));
    // another W is written itself
    let other = problem.clone().into_builder().delassus(problem.dense() * 2.0).build().expect("valid by construction");
    assert!(other.to_json().contains("delassus"));
}

#[test]
fn every_mistake_is_named() {
    refused(&BLOCK.replace("0.30000000000000004", "1e999"), &["free_velocity", "finite"]);
    refused(&BLOCK.replace("[0.5]", "[-0.5]"), &["friction[0]", "negative"]);
    refused(&BLOCK.replace("\"coulomb\"", "\"culomb\""), &["law", "culomb", "associated"]);
    refused(&BLOCK.replace("\"coulomb\"", "\"polyhedral-coulomb\""), &["directions", "missing"]);
    refused(&BLOCK.replace("\"dimension\":2", "\"dimension\":2,\"directions\":4"), &["directions", "coulomb"]);
    refused(&BLOCK.replace("\"dimension\":2", "\"dimension\":4"), &["dimension", "is 4"]);
    refused(&BLOCK.replace("\"dimension\":2", "\"dimension\":3"), &["dimension", "is 3", "2 rows"]);
    refused(&BLOCK.replace("[0.5]", "[0.5,0.5]"), &["field `friction`: has size 2; give 1"]);
    refused(&BLOCK.replace("[0.5]", "[]"), &["field `friction`: has size 0; give 1"]);
    let others = "give size 2, for 1 contact with 2 rows each: `friction` has 1 entry, `dimension` is 2 and `delassus` has 2 rows";
    for (velocity, size) in [("[-0.1]", 1), ("[-0.1,1,2]", 3), ("[]", 0)] {
        let short = BLOCK.replace("[-0.1,0.30000000000000004]", velocity);
        refused(&short, &[&format!("field `free_velocity`: has size {size}; {others}")]);
        refused(&short.replace("[0.5]", "[0.5,0.5,0.5]"), &["`free_velocity`", "`friction` has 3 entries", "do not fit each other either"]);
    }
    refused(&BLOCK.replace("contact-problem/1", "lcp"), &["\"lcp\"", "\"contact-problem/1\" or \"lcp/1\""]);
    refused(&BLOCK.replace("\"name\"", "\"nome\""), &["nome"]);
    refused(&BLOCK.replace("[0.25,3]", "[0.25]"), &["delassus.rows[1]", "1 entry"]);
    refused(
        &BLOCK.replace("{\"shape\":[2,2],\"rows\":[[1,0.25],[0.25,3]]}", "[[1,0.25],[0.25,3]]"),
        &["`delassus`", "as {\"shape\": [2, 2], \"rows\": [["],
    );
    refused(&BLOCK.replace("{\"shape\":[2,2],\"rows\":[[1,0.25],[0.25,3]]}", "null"), &["`delassus`: is missing"]);
    refused(&BLOCK.replace("\"shape\":[2,2],", ""), &["missing field `shape`"]);
    refused(&BLOCK.replace("\"shape\":[2,2]", "\"shape\":[2,3]"), &["delassus", "2×3"]);
    refused(&BLOCK.replace("[0.125,0]", "[0.125]"), &["compliance.diagonal", "give size 2"]);
    refused(&BLOCK.replace("[0.125,0]", "[-1,0]"), &["compliance.diagonal[0]"]);
    refused(&BLOCK.replace("\"contact\"", "\"edge\""), &["compliance.coordinates"]);
    refused(&BLOCK.replace("contact-problem/1", "contact-problem/2"), &["schema", "contact-problem/1"]);
    refused(&BLOCK.replace("[-0.1,", "[NaN,"), &["not valid JSON"]);
    refused(&BLOCK.replace("[-0.1,", "[\"-0.1\","), &["free_velocity"]);
    refused(&BLOCK[..BLOCK.len() - 40], &["ends early, at line 3 column 51"]);
    refused(&BLOCK.replace("\"friction\":[0.5],", ""), &["friction"]);
    let normal = r#"{"schema":"contact-problem/1","name":"n","dimension":1,"law":"coulomb","friction":[0.5],"free_velocity":[-1],
        "delassus":{"shape":[1,1],"rows":[[1]]}}"#;
    refused(normal, &["friction", "no tangential row"]);
    assert!(ContactProblem::from_json(&normal.replace("[0.5]", "[0]")).is_ok());
}

#[test]
fn a_solution_comes_back_bit_for_bit() {
    let solution = Solution {
        impulse: DVector::from_vec(vec![0.1 + 0.2, -1.0 / 3.0]),
        velocity: DVector::from_vec(vec![0.0, f64::from_bits(1)]),
        beta: Some(DVector::from_vec(vec![0.0, 1.0])),
        sigma: None,
        solver: "pgs".into(),
        iterations: 7,
        keys: Some(vec![ContactKey { bodies: [Some(3), None], features: [1, 0] }]),
        reproducible: Some(false),
    };
    let text = solution.to_json(Some("block"), Some(serde_json::json!({"primal": 0})));
    assert_eq!(Solution::from_json(&text).expect("well formed"), solution);
    let message = Solution::from_json(&text.replace("\"velocity\"", "\"velocities\"")).expect_err("refused").to_string();
    assert!(message.contains("velocities"), "{message}");
}

#[test]
fn an_answer_without_velocity_has_that_of_its_impulses() {
    let file = std::env::temp_dir().join(format!("moreau-impulse-alone-{}.json", std::process::id()));
    let write = |impulse: &str| {
        std::fs::write(&file, format!(r#"{{"schema":"solution/1","impulse":{impulse}}}"#)).expect("a folder for temporary files")
    };
    write("[2,1]");
    // three terms up to 4 each: W r + u_free = (2 + 1/4 − 1/10, 1/2 + 3 + 3/10)
    let contacts = ContactProblem::from_json(BLOCK).expect("well formed");
    let expected = DVector::from_vec(vec![2.15, 3.8]);
    assert!((Solution::read(&file, &contacts).expect("well formed").velocity - &expected).amax() <= roundings(12.0));
    assert!(
        (Solution::read_posed(&file, &Posed::contacts(contacts.clone())).expect("well formed").velocity - &expected).amax()
            <= roundings(12.0)
    );
    let message = Solution::from_json(r#"{"schema":"solution/1","impulse":[1]}"#).expect_err("refused").to_string();
    assert!(message.contains("field `velocity`: is missing"), "{message}");
    write("[2]");
    assert!(Solution::read(&file, &contacts).expect_err("refused").to_string().contains("field `impulse`: has size 1; give size 2"));
    std::fs::remove_file(&file).expect("it was written");
}

#[test]
fn a_kind_that_is_none_is_named_with_those_there_are() {
    let rod = r#"{"schema":"contact-problem/1","name":"rod","dimension":1,"law":"frictionless","friction":[0,0],"kinds":["contact",KIND],
        "free_velocity":[-3,-1],"delassus":{"shape":[2,2],"rows":[[1,0],[0,1]]}}"#;
    let of = |kind: &str| Posed::from_json(&rod.replace("KIND", kind));
    assert!(matches!(of(r#"{"bilateral":1}"#), Ok(Posed::Jointed(_))) && of("\"limit\"").is_ok() && of("\"contact\"").is_ok());
    for kind in [
        r#"{"bilateral":1,"x":2}"#,
        "\"bilateral\"",
        "\"weld\"",
        "7",
        "null",
        r#"{"bilateral":"one"}"#,
        r#"{"bilateral":1.5}"#,
        "{}",
        "[1]",
    ] {
        let message = of(kind).expect_err(kind).to_string();
        assert!(message.starts_with(&format!("field `kinds[1]`: is {kind}; use ")) && message.contains("{\"bilateral\": N}"), "{message}");
    }
}

#[test]
fn a_file_that_is_named_as_another_format_gets_the_cure_of_that_format() {
    let folder = std::env::temp_dir().join(format!("moreau-named-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("valid by construction");
    let message = |name: &str, bytes: &[u8]| {
        let file = folder.join(name);
        std::fs::write(&file, bytes).expect("a folder for temporary files");
        let message = ContactProblem::read(&file).expect_err(name).to_string();
        assert!(message.contains(name) && !message.contains("start with"), "{message}");
        message
    };
    for text in ["garbage", "", "# a remark\n3\n", "-1 2"] {
        assert!(message("a.dat", text.as_bytes()).contains("give Siconos's text whole"), "{text}");
    }
    for (name, bytes) in [("a.hdf5", &b"garbage"[..]), ("a.h5", b"\0\x01"), ("a.HDF5", b""), ("b.hdf5", b"\x89HDF\r")] {
        assert!(message(name, bytes).contains("HDF5 file of FCLIB"), "{name}");
    }
    std::fs::write(folder.join("block.dat"), BLOCK).expect("a folder for temporary files");
    assert!(ContactProblem::read(&folder.join("block.dat")).is_ok(), "what a file holds decides, where it holds something");
    std::fs::remove_dir_all(&folder).expect("valid by construction");
}

#[test]
fn files_name_themselves_in_errors() {
    let missing = std::env::temp_dir().join("moreau-no-such-problem.json");
    assert!(ContactProblem::read(&missing).expect_err("refused").to_string().contains("moreau-no-such-problem.json"));
}

#[test]
fn a_start_finds_its_contacts_by_keys_and_other_answers_go_by_position() {
    let folder = std::env::temp_dir().join(format!("moreau-start-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let key = |body: usize| ContactKey { bodies: [Some(body), None], features: [0, 0] };
    let balls = |name: &str, bodies: &[usize]| {
        let n = bodies.len();
        let problem = ContactProblem::new(DMatrix::identity(n, n), DVector::zeros(n)).name(name).rows_per_contact(1);
        problem.keys(Some(bodies.iter().copied().map(key).collect())).build().expect("valid")
    };
    let before = balls("before", &[5, 7, 8]);
    let mut answer = Solution::new("by hand", DVector::from_vec(vec![1.0, 2.0, 3.0]), DVector::zeros(3), 0);
    answer.keys = before.keys().map(<[_]>::to_vec);
    let file = |name: &str, text: &str| {
        let file = folder.join(name);
        std::fs::write(&file, text).expect("a folder for temporary files");
        file
    };
    let keyed = file("keyed.json", &answer.to_json(Some("before"), None));
    let after = Posed::contacts(balls("after", &[8, 9, 5, 6]));
    let start = WarmStart::read(&keyed, &after).expect("keys match");
    assert_eq!((start.impulse.as_slice(), start.matched), (&[3.0, 0.0, 1.0, 0.0][..], Some(2)));
    // an answer stands in the order of its problem
    let message = Solution::read(&keyed, &balls("before", &[5, 8, 7])).expect_err("another order").to_string();
    assert!(message.contains("keys[1]") && message.contains("--start"), "{message}");
    assert_eq!(Solution::read(&keyed, &before).expect("its own"), answer);
    let message = WarmStart::read(&file("short.json", &answer.to_json(None, None).replace("1.0,2.0,3.0", "1.0,2.0")), &after);
    assert!(message.expect_err("too short").to_string().contains("`impulse`: has size 2; give size 3, for 3 keys"));
    answer.keys = None;
    let bare = file("bare.json", &answer.to_json(None, None));
    assert_eq!(WarmStart::read(&bare, &Posed::contacts(before)).expect("by position").matched, None);
    let message = WarmStart::read(&bare, &after).expect_err("too short").to_string();
    assert!(message.contains("bare.json") && message.contains("has size 3; give size 4"), "{message}");
    answer.keys = Some(vec![key(5); 3]);
    let twice = file("twice.json", &answer.to_json(None, None));
    assert!(WarmStart::read(&twice, &after).expect_err("one key twice").to_string().contains("keys[1]"));
    std::fs::remove_dir_all(&folder).expect("it was made");
}
