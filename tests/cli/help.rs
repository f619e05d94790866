//! What `--help` explains.

use super::moreau;

fn help(command: &[&str]) -> String {
    let run = moreau(&[command, &["--help"]].concat());
    assert_eq!(run.code, 0);
    run.output
}

#[test]
fn bench_explains_its_columns_and_sums() {
    let text = help(&["bench"]);
    for word in
        ["performance profile", "shifted geometric mean", "exp(mean ln(t + s)) − s", "s = 0.1 ms", "τ = 1, 1.5, 2, 5, 10, 100, 1000"]
    {
        assert!(text.contains(word), "{word} in {text}");
    }
    for column in ["contacts", "time", "residual", "ρ = 1", "iterations"] {
        assert!(text.lines().any(|line| line.trim_start().starts_with(&format!("{column} "))), "{column} in {text}");
    }
}

#[test]
fn residuals_are_explained_with_units_where_they_are_shown() {
    for command in ["certify", "solve"] {
        let text = help(&[command]);
        for (name, unit) in [("primal", "N·s"), ("dual", "m/s"), ("complementarity", "J"), ("tangential", "N·s"), ("natural_map", "N·s")]
        {
            let line = text.lines().find(|line| line.trim_start().starts_with(&format!("{name} ")));
            assert!(line.is_some_and(|line| line.contains(&format!("[{unit}]"))), "{command}: {name}");
        }
    }
}

#[test]
fn every_list_of_solvers_says_which_law_each_takes() {
    for command in ["solve", "bench", "simulate", "compare"] {
        let text = help(&[command]);
        let line = |name: &str| text.lines().find(|line| line.split_whitespace().next() == Some(name)).unwrap_or_default().to_string();
        assert_eq!(line("lemke").split_whitespace().collect::<Vec<_>>(), ["lemke", "yes", "plane", "plane", "yes", "yes"], "{command}");
    }
}

#[test]
fn the_list_of_problems_explains_columns_and_groups() {
    let text = help(&["problems", "list"]);
    for word in ["Columns:", "velocity", "radius", "sweeps", "failed", "Groups, for --group:", "painleve", "no-solution"] {
        assert!(text.contains(word), "{word} in {text}");
    }
}

#[test]
fn the_exit_code_of_an_interrupt_stands_beside_the_others() {
    for command in [&[][..], &["gate"], &["protocol-check"], &["scoreboard"]] {
        let text = help(command);
        let codes = text.split("Exit code").last().unwrap_or_default();
        assert!(codes.contains("130") && codes.contains("interrupt"), "{command:?}: {codes}");
    }
}

#[test]
fn no_tolerance_is_written_out_in_zeros() {
    for command in ["certify", "solve", "bench", "simulate", "compare"] {
        let text = help(&[command]);
        assert!(text.contains("1e-8") && !text.contains("0.0000"), "{command}");
    }
}
