//! What is refused, and how rows of contacts and limits stand in the problem without joints.

use super::*;
use nalgebra::{dmatrix, dvector};

const KINDS: [ConstraintKind; 3] = [ConstraintKind::Limit, ConstraintKind::Bilateral { rows: 2 }, ConstraintKind::Contact];

fn six() -> JointedProblem {
    let w = DMatrix::from_fn(6, 6, |i, j| if i == j { 2.0 + i as f64 } else { 0.125 * (i + j) as f64 });
    JointedProblem::new(3, KINDS.to_vec(), w, dvector![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).expect("valid by construction")
}

#[test]
fn limits_are_contacts_without_friction_whose_tangents_move_nothing_else() {
    let problem = six().law(Law::Coulomb, vec![0.0, 0.0, 0.5]).expect("valid by construction");
    let alone = problem.unilateral(problem.delassus(), problem.free_velocity()).expect("valid by construction");
    assert_eq!((alone.contacts(), alone.friction(), problem.pushing()), (2, &[0.0, 0.5][..], vec![0, 2]));
    assert_eq!(alone.free_velocity(), &dvector![1.0, 0.0, 0.0, 4.0, 5.0, 6.0]);
    let w = alone.dense();
    assert_eq!((w[(0, 0)], w[(0, 3)], w[(3, 5)]), (2.0, problem.delassus()[(0, 3)], problem.delassus()[(3, 5)]));
    for tangent in [1, 2] {
        assert_eq!((w[(tangent, tangent)], w.row(tangent).sum(), w.column(tangent).sum()), (2.0, 2.0, 2.0));
    }
    let mut all = dvector![0.0, -1.0, -2.0, 0.0, 0.0, 0.0];
    problem.gather(&problem.spread(&dvector![1.0, 9.0, 9.0, 3.0, 4.0, 5.0]), &mut all);
    assert_eq!(all, dvector![1.0, -1.0, -2.0, 3.0, 4.0, 5.0]);
}

#[test]
fn no_problem_is_made_that_cannot_be_meant() {
    let refused = |problem: Result<JointedProblem>, field: &str| {
        let message = problem.expect_err(field).to_string();
        assert!(message.contains(&format!("`{field}")), "{field}: {message}");
    };
    let bilateral = |rows| JointedProblem::new(1, vec![ConstraintKind::Bilateral { rows }], dmatrix![1.0], dvector![1.0]);
    refused(bilateral(0), "kinds[0]");
    refused(bilateral(7), "kinds[0]");
    refused(bilateral(2), "delassus");
    refused(JointedProblem::new(1, vec![ConstraintKind::Limit], dmatrix![1.0], dvector![1.0, 2.0]), "free_velocity");
    let beside = dmatrix![1.0, f64::NAN; 0.0, 1.0];
    refused(JointedProblem::new(1, vec![ConstraintKind::Limit; 2], beside, dvector![1.0, 1.0]), "delassus[0, 1]");
    refused(six().law(Law::Coulomb, vec![0.0, 0.5, 0.5]), "friction[1]");
    refused(six().law(Law::Coulomb, vec![0.5, 0.0, 0.5]), "friction[0]");
    refused(six().law(Law::Coulomb, vec![0.0, 0.0, -0.5]), "friction[2]");
    refused(six().law(Law::Coulomb, vec![0.5]), "friction");
    refused(six().law(Law::PolyhedralCoulomb { directions: 2 }, vec![0.0; 3]), "directions");
    refused(six().shift(dvector![1.0]), "shift");
    refused(six().softness(dvector![0.0, 0.0, -1.0, 0.0, 0.0, 0.0]), "compliance.diagonal[2]");
    refused(six().between(Some(vec![[Some(0), None], [Some(1), Some(1)], [None, Some(2)]]), None), "bodies[1]");
    refused(six().between(Some(vec![[Some(0), None]]), None), "bodies");
    let key = |body| ContactKey { bodies: [Some(body), None], features: [0, 0] };
    refused(six().between(None, Some(vec![key(0), key(1), key(0)])), "keys");
}

#[cfg(feature = "files")]
#[test]
fn a_file_with_kinds_is_read_back_to_the_last_bit() {
    use crate::problem::Posed;
    let bodies = vec![[Some(0), None], [Some(0), Some(1)], [None, Some(1)]];
    let problem = six()
        .named("gate")
        .law(Law::Coulomb, vec![0.0, 0.0, 0.1])
        .expect("valid by construction")
        .between(Some(bodies), None)
        .expect("valid by construction");
    let problem = problem
        .shift(dvector![0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
        .expect("valid by construction")
        .softness(dvector![0.1, 0.0, 0.7, 0.0, 0.0, 0.0])
        .expect("valid by construction");
    let text = problem.to_json();
    assert!(text.contains(r#""kinds":["limit",{"bilateral":2},"contact"]"#), "{text}");
    assert_eq!(Posed::from_json(&text).expect("well formed"), Posed::Jointed(Box::new(problem)));
    let message = ContactProblem::from_json(&text).expect_err("no contact problem").to_string();
    assert!(message.contains("`kinds`") && message.contains("moreau solve"), "{message}");
}

#[cfg(feature = "files")]
#[test]
fn kinds_that_are_all_contacts_are_as_no_kinds() {
    use crate::problem::Posed;
    let block = r#"{"schema": "contact-problem/1", "name": "b", "dimension": 1, "law": "frictionless", "friction": [0, 0],
        "free_velocity": [-1, 2], KINDS "delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}}"#;
    let read = |kinds: &str| Posed::from_json(&block.replace("KINDS", kinds));
    assert_eq!(read(r#""kinds": ["contact", "contact"],"#).expect("well formed"), read("").expect("well formed"));
    let refused = |kinds: &str, word: &str| {
        let message = read(kinds).expect_err(word).to_string();
        assert!(message.contains(word), "{message}");
    };
    refused(r#""kinds": ["contact"],"#, "`kinds`");
    refused(r#""kinds": ["contact", {"bilateral": 2}],"#, "give 3, as the 2 `kinds` have");
    refused(r#""kinds": ["contact", {"bilateral": 9}],"#, "kinds[1]");
    refused(r#""kinds": ["contact", "weld"],"#, "weld");
    let blocks = r#""delassus": {"shape": [2, 2], "blocks": {"row": [0], "column": [0], "value": [1]}}"#;
    let text = block.replace(r#""delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#, blocks);
    let message = Posed::from_json(&text.replace("KINDS", r#""kinds": ["contact", {"bilateral": 1}],"#)).expect_err("blocks").to_string();
    assert!(message.contains("`blocks`"), "{message}");
}

#[cfg(feature = "files")]
#[test]
fn every_form_of_mass_and_rows_makes_the_same_w() {
    use crate::problem::Posed;
    let head = r#"{"schema": "contact-problem/1", "name": "bob", "dimension": 1, "law": "frictionless", "friction": [0, 0],
        "free_velocity": [-3, -1], "kinds": ["contact", {"bilateral": 1}], "#;
    let forms = [
        r#""mass": {"shape": [2, 2], "rows": [[2, 0], [0, 2]]}, "jacobian": {"shape": [2, 2], "rows": [[1, 0], [0.5, 0.75]]}}"#,
        r#""mass": {"shape": [2, 2], "diagonal_blocks": [[2, 0, 0, 2]]}, "jacobian": {"shape": [2, 2],
            "sparse_rows": {"starts": [0, 1, 3], "column": [0, 0, 1], "value": [1, 0.5, 0.75]}}}"#,
        r#""delassus": {"shape": [2, 2], "triplets": {"row": [0, 0, 1, 1], "column": [0, 1, 0, 1], "value": [0.5, 0.25, 0.25, 0.40625]}}}"#,
    ];
    let read = forms.map(|form| match Posed::from_json(&format!("{head}{form}")).expect("well formed") {
        Posed::Jointed(problem) => *problem,
        Posed::Contacts(_) => panic!("it has a joint"),
    });
    assert!(read.iter().all(|problem| problem.delassus() == read[0].delassus()));
    // M̂ and H are kept however they are spelled, and written again
    assert_eq!(read[0], read[1]);
    assert!(read[0].dynamics().is_some() && read[2].dynamics().is_none());
    for problem in &read {
        assert_eq!(Posed::from_json(&problem.to_json()).expect("it was written"), Posed::Jointed(Box::new(problem.clone())));
    }
}
