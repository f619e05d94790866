//! How many velocities `moreau certify --prove` counts.

use super::{Folder, moreau};

/// A contact in space, pushed along by a normal impulse twice as much as away: Painlevé's.
fn pushed(law: &str, free: [f64; 3]) -> String {
    format!(
        r#"{{"schema": "contact-problem/1", "name": "pushed", "dimension": 3, "law": "{law}", "directions": 4, "friction": [1],
            "free_velocity": {free:?}, "delassus": {{"shape": [3, 3], "rows": [[1, 2, 0], [2, 5, 0], [0, 0, 1]]}}}}"#
    )
}

#[test]
fn velocities_under_polyhedral_friction_are_counted_in_text_and_json() {
    let folder = Folder::new("certify-polyhedral-count");
    let zero = folder.file("zero.json", r#"{"schema": "solution/1", "impulse": [0, 0, 0]}"#);
    let told = |free: [f64; 3]| {
        let problem = folder.file("problem.json", &pushed("polyhedral-coulomb", free));
        let text = moreau(&["certify", &problem, &zero, "--prove"]).output;
        (text, moreau(&["certify", &problem, &zero, "--prove", "--format", "json"]).json()["solutions"].clone())
    };
    let (text, solutions) = told([1.0, 4.0, 0.0]);
    let all = &solutions["all"];
    assert_eq!((&all["velocities"], &all["patterns"], &all["continuum"]), (&3.into(), &64.into(), &false.into()), "{solutions}");
    assert!(solutions["unique"] == "unknown" && all["sets"].as_u64().is_some() && text.contains("exactly 3 velocities"), "{text}");
    let (text, solutions) = told([-1.0, 1.0, 0.0]);
    assert_eq!((&solutions["unique"], &solutions["all"]["velocities"]), (&"solution".into(), &1.into()), "{solutions}");
    assert!(text.contains("all 2^6 complementary cones") && !text.contains("not known"), "{text}");
    // four contacts have 24 unknowns: why it is not known, and no count
    let rows_of = |joined: f64| -> Vec<Vec<f64>> {
        (0..12)
            .map(|i: usize| {
                (0..12)
                    .map(|j: usize| {
                        if i == j {
                            1.0
                        } else if i % 3 + j % 3 == 0 {
                            joined
                        } else {
                            0.0
                        }
                    })
                    .collect()
            })
            .collect()
    };
    let many = |joined: f64| {
        format!(
            r#"{{"schema": "contact-problem/1", "name": "many", "dimension": 3, "law": "polyhedral-coulomb", "directions": 4,
            "friction": [1, 1, 1, 1], "free_velocity": {:?}, "delassus": {{"shape": [12, 12], "rows": {:?}}}}}"#,
            [1; 12],
            rows_of(joined)
        )
    };
    let zero = folder.file("zeros.json", &format!(r#"{{"schema": "solution/1", "impulse": {:?}}}"#, [0; 12]));
    let solutions = |joined: f64| {
        let problem = folder.file("many.json", &many(joined));
        moreau(&["certify", &problem, &zero, "--prove", "--format", "json"]).json()["solutions"].clone()
    };
    // of contacts that share nothing each is small enough
    let apart = solutions(0.0);
    assert_eq!((&apart["unique"], &apart["all"]["parts"][3]["contacts"][0]), (&"solution".into(), &3.into()), "{apart}");
    let solutions = solutions(0.125);
    assert!(solutions["unique"] == "unknown" && solutions["reason"].as_str().is_some_and(|why| why.contains("24 unknowns")), "{solutions}");
    assert!(solutions.get("all").is_none() && solutions.get("several").is_none(), "{solutions}");
}

#[test]
fn a_continuum_of_velocities_is_told_by_its_two_ends() {
    let folder = Folder::new("certify-continuum");
    // between two walls, moving along them: as jammed as one likes, at every speed between
    for (law, more) in [("coulomb", ""), ("polyhedral-coulomb", r#""directions": 2,"#)] {
        let text = format!(
            r#"{{"schema": "contact-problem/1", "name": "slot", "dimension": 2, "law": "{law}", {more} "friction": [0.5, 0.5],
                "free_velocity": [0, 2, 0, 2],
                "delassus": {{"shape": [4, 4], "rows": [[1, 0, -1, 0], [0, 1, 0, 1], [-1, 0, 1, 0], [0, 1, 0, 1]]}}}}"#
        );
        let problem = folder.file("slot.json", &text);
        let answer = folder.file("free.json", r#"{"schema": "solution/1", "impulse": [0, 0, 0, 0], "velocity": [0, 2, 0, 2]}"#);
        let run = moreau(&["certify", &problem, &answer, "--prove"]);
        let shown = |start: &str, unit: &str| run.output.lines().any(|line| line.trim_start().starts_with(start) && line.ends_with(unit));
        assert!(run.output.contains("are a continuum") && shown("one end", ") m/s") && shown("other end", ") m/s"), "{}", run.output);
        assert_eq!(run.output.lines().filter(|line| line.trim_start().starts_with("r = (")).count(), 2, "{}", run.output);
        let solutions = moreau(&["certify", &problem, &answer, "--prove", "--format", "json"]).json()["solutions"].clone();
        let numbers =
            |end: usize, of: &str| -> Vec<f64> { serde_json::from_value(solutions["continuum"][end][of].clone()).expect("numbers") };
        assert_eq!(solutions["all"]["continuum"], true, "{solutions}");
        assert_ne!(numbers(0, "velocity"), numbers(1, "velocity"));
        // both ends, and the mean of their impulses, are solutions
        let mean: Vec<f64> = numbers(0, "impulse").iter().zip(numbers(1, "impulse")).map(|(one, other)| 0.5 * (one + other)).collect();
        for impulse in [numbers(0, "impulse"), numbers(1, "impulse"), mean] {
            let file = folder.file("end.json", &format!(r#"{{"schema": "solution/1", "impulse": {impulse:?}}}"#));
            assert_eq!(moreau(&["certify", &problem, &file]).code, 0, "{law} {impulse:?}");
        }
    }
}

#[test]
fn several_velocities_are_counted_by_disjoint_enclosures_and_one_is_not() {
    let folder = Folder::new("certify-several");
    // seven rods of Painlevé: each lifts off, slides or is jammed, or sticks at once; where they touch each other, however lightly, they
    // are more contacts than all patterns are tried for
    let entry = |i: usize, j: usize, joined: f64| match (i / 2).abs_diff(j / 2) {
        0 => [[1.0, 2.0], [2.0, 5.0]][i % 2][j % 2],
        1 if i % 2 + j % 2 == 0 => joined,
        _ => 0.0,
    };
    let rows = |joined: f64| -> Vec<Vec<f64>> { (0..14).map(|i| (0..14).map(|j| entry(i, j, joined)).collect()).collect() };
    let of = |name: &str, joined: f64, free: &[f64]| {
        let text = format!(
            r#"{{"schema": "contact-problem/1", "name": "rods", "dimension": 2, "law": "coulomb", "friction": {:?},
                "free_velocity": {free:?}, "delassus": {{"shape": [14, 14], "rows": {:?}}}}}"#,
            [1; 7],
            rows(joined)
        );
        folder.file(name, &text)
    };
    let free = [1.0, 4.0].repeat(7);
    let open = folder.file("open.json", &format!(r#"{{"schema": "solution/1", "impulse": {:?}, "velocity": {free:?}}}"#, [0; 14]));
    let several = of("several.json", 0.0009765625, &free);
    let run = moreau(&["certify", &several, &open, "--prove", "--format", "json"]);
    let least = run.json()["solutions"]["several"]["at_least"].as_u64();
    assert!(run.code == 0 && least.is_some_and(|least| (2..=3u64.pow(7)).contains(&least)), "{}{}", run.output, run.message);
    let run = moreau(&["certify", &several, &open, "--prove"]);
    assert!(run.output.contains("different velocities: so many answers have disjoint enclosures"), "{}", run.output);
    let apart = moreau(&["certify", &of("apart.json", 0.0, &free), &open, "--prove"]);
    assert!(apart.code == 0 && apart.output.contains("exactly 2187 velocities, those of 7 parts"), "{}", apart.output);
    let impulse = [7.0, -3.0].repeat(7);
    let stuck = folder.file("stuck.json", &format!(r#"{{"schema": "solution/1", "impulse": {impulse:?}, "velocity": {:?}}}"#, [0; 14]));
    for joined in [0.0, 0.0009765625] {
        let free: Vec<f64> = rows(joined).iter().map(|row| -row.iter().zip(&impulse).map(|(w, r)| w * r).sum::<f64>()).collect();
        let run = moreau(&["certify", &of("one.json", joined, &free), &stuck, "--prove", "--format", "json"]);
        assert!(run.code == 0 && run.json()["solutions"].get("several").is_none(), "{}{}", run.output, run.message);
    }
}
