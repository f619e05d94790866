//! Tests of the page of a motion: its numbers are the recording's, its texts are escaped, and nothing is fetched.

use super::super::steps::StepSummary;
use super::*;
use crate::certificate::{Judgement, StepResidual};
use crate::scenes::named;
use crate::schemes::{MoreauJean, simulate};
use crate::solvers::Auto;
use crate::trajectory::Recording;
use serde_json::Value;

/// A drop of some steps, with the residuals of its steps changed.
fn page(steps: usize, change: impl Fn(&mut Recording)) -> (String, Value) {
    let scene = named("ball-drop").expect("built in");
    let (mechanism, start) = scene.mechanism().expect("planar");
    let mut recording = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 0.001, steps).expect("a solvable scene");
    change(&mut recording);
    let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: None, gravity: 9.81 };
    let steps = StepSummary::of(&recording, mechanism.as_ref());
    let summary = MotionSummary {
        scene: "drop",
        scheme: "s",
        solver: "x",
        note: Some("a <note>"),
        closed_form: None,
        plastic_form: false,
        quantities: motion.summary(),
        remarks: vec!["deep <i>".into()],
        steps,
        reproducible: true,
        cut: None,
    };
    let html = MotionPage { motion: &motion, scene: &scene, summary: &summary }.html().expect("a page");
    let json = Data::new(&motion, &scene).and_then(|data| data.json()).expect("data");
    assert!(html.contains(&json));
    (html, serde_json::from_str(&json).expect("JSON"))
}

fn residual(relative: f64, rule: &'static str) -> StepResidual {
    StepResidual { rule, residual: "normal", relative, limit: 1e-8, contact: None, pair: None }
}

#[test]
fn the_worst_of_the_steps_since_the_sample_before_is_told_and_what_is_no_number_is_worse_than_any() {
    let (html, data) = page(2400, |recording| {
        recording.residuals.iter_mut().for_each(|one| *one = None);
        for (step, relative, judgement, rule) in [
            (10, 1e-9, Judgement::Accepted, "certificate"),
            (11, 2e-3, Judgement::Rejected, "certificate"),
            (12, 1e-3, Judgement::Unconverged, "stopping rule"),
            (15, f64::NAN, Judgement::Rejected, "certificate"),
            (16, 1.0, Judgement::Rejected, "certificate"),
        ] {
            recording.residuals[step] = Some(residual(relative, rule));
            recording.judgements[step] = judgement;
        }
    });
    assert_eq!(data["every"], 3);
    let told = |sample: usize| data["certificates"][sample].to_string();
    // counted from 1, the steps 10 to 12 end at sample 4, 13 to 15 at 5 and 16 to 18 at 6
    let expected = ["null", "null", "[1,0,0.002,1e-8,0,12]", "[0,1,0.001,1e-8,1,13]", "[2,0,null,1e-8,0,16]"];
    assert_eq!([1, 3, 4, 5, 6].map(told), expected);
    assert_eq!(data["residuals"], serde_json::json!(["normal", "normal of the stopping rule"]));
    assert!(html.contains("<p class=\"steps fail\">") && html.contains("Note: a &lt;note&gt;.") && html.contains("Remark: deep &lt;i&gt;"));
}

#[test]
fn the_program_and_the_style_end_no_element_and_open_no_comment() {
    for text in [PLAYER, STYLE] {
        assert!(!text.contains("</") && !text.contains("<!--"));
    }
    assert!(PLAYER.lines().all(|line| line.chars().count() <= 140));
}
