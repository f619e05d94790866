//! §5, who wrote and who uses what: papers, simulators, and what scales.

use super::gradient::{grown, pressed_row};
use crate::claims::lookups::{self, looked_up};
use crate::claims::prelude::*;
use crate::mechanics::{Plane, PointMass, State};
use crate::problem::{Law, Lcp};
use crate::schemes::{SchemeParameters, assembled, by_name};
use crate::solvers::lemke::{LemkeOutcome, lemke};
use crate::solvers::{AcceleratedProjectedGradient, ContactSolver, Momentum};
use crate::stored::{RUNS, read_by};
use crate::tolerance::claims::thresholds::{FOLLOWS, TERABYTE};
use crate::trajectory::Trajectory;

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.cite",
        statement: "Anitescu, Math. Program. 105:113 (2006).",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated: Optimization-based simulation of nonsmooth rigid multibody dynamics, 105 (1), 113–143.",
        argument: "Volume, year and page as two others cite the paper: the documentation of Drake's contact models \
            (multibody/plant/contact_model_doxygen.h) and the contact kernel of waLBerla (HCSITSRelaxationStep.h). The DOI carries neither \
            volume nor page.",
        controls: &["Page 131, two digits exchanged."],
        sources: &["chapter §5, and the list of papers at its end", "doi:10.1007/s10107-005-0590-7"],
        check: looked_up!("S5.cite"),
    },
    Claim {
        id: "S5.apgd-credit",
        statement: "APGD, Nesterov's accelerated projected gradient, is of Tasora and Anitescu (2011), and Chrono's main solver.",
        verdict: ClaimVerdict::False,
        kind: Kind::Citation,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Measured,
        correct_statement: "The paper of 2011 has an iterated fixed point with separable projections, which its abstract calls a \
            contractive mapping. Accelerated gradients for these problems came with Mazhar, Heyn, Negrut and Tasora (2015). That they are \
            in Chrono is so.",
        argument: "A contractive mapping never moves away from the solution; were APGD the iteration of that paper, it would be one. On a \
            row of 40 pressed masses the plain projected gradient does not move away in 300 iterations; with Nesterov's momentum it does.",
        controls: &["The plain iteration in place of the accelerated one.", "The accelerated iteration in place of the plain one."],
        sources: &[
            "chapter §5, APGD; list of papers",
            "Tasora and Anitescu, A matrix-free cone complementarity approach (2011), abstract; Mazhar et al., ACM Trans. Graph. 34 \
                (2015), not read",
            "S10.path-chrono",
        ],
        check: check!(contraction),
    },
    Claim {
        id: "S5.who-uses",
        statement: "Drake's SAP uses the convex relaxation with second-order cones and no polyhedral ones, and Chrono's APGD the same; \
            Siconos supports both (read as: both kinds of cone).",
        verdict: ClaimVerdict::True,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: r"As stated; SAP with regularisation $R > 0$.",
        argument: r"The relaxation lifts a sliding block by $(h + \tau)\,\mu\,v$, Coulomb's law by nothing: Drake's own block under kSap
            rises so from 0.3 s to 0.9 s of the stored run, and under kLagged not at all. Chrono's source has the cone complementarity
            problem (S10.chrono-row). The pinned Siconos has, among its solvers for friction, FRICTION_3D_SOCLCP, over second-order cones,
            and FRICTION_3D_GAMS_LCP_PATH, over polyhedral ones.",
        controls: &[
            "Drake's stored run under kLagged in place of kSap.",
            "The names of MuJoCo's cones looked up in place of those of solvers.",
        ],
        sources: &[
            "chapter §5, table of cones",
            "Drake 1.51.1 (references/drake/block_slide__sap__h0.001.json and its kLagged counterpart)",
            "references/facts/siconos.json",
        ],
        check: check!(users),
    },
    Claim {
        id: "S5.pivot-scale",
        statement: r"On large scenes ($10^5$ contacts) pivoting algorithms such as Lemke's are less scalable than iterative methods
            (projected gradients, ADMM).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated, of Lemke's method over its dense tableau and of an iteration to a fixed accuracy that uses the
            zeros of $W$: the work of the first grows faster with the contacts. (Its answer is exact, that of an iteration is not.)",
        argument: r"Multiplications on a row of pressed masses, doubled from 10 to 20 and from 20 to 40: pivots times the $n\,(2n + 2)$
            entries of the tableau grow faster than accelerated gradients times the non-zeros of $W$. Stewart–Trinkle with four directions
            has 6 unknowns per contact: at $10^5$ contacts a tableau takes more than $10^{12}$ bytes.",
        controls: &["Plain gradients in place of accelerated ones, and a tableau of which a pivot touches one row."],
        sources: &["chapter §5, motivation"],
        check: check!(scaling),
    },
];

fn contraction(reading: Reading) -> Result<Vec<Finding>> {
    let problem = pressed_row(40);
    let accelerated = grown(&problem, reading.only(0).pick(Momentum::Nesterov, Momentum::Plain))?;
    let plain = grown(&problem, reading.only(1).pick(Momentum::Plain, Momentum::Nesterov))?;
    Ok(vec![
        Finding::decision("the accelerated iteration moves away from the solution at times", accelerated > 0, true)
            .experiment()
            .says(false),
        Finding::count("iterations of the plain one that do", plain, 0).experiment(),
    ])
}

fn users(reading: Reading) -> Result<Vec<Finding>> {
    let law = |scheme: &str| -> Result<Option<Law>> {
        let block = PointMass::new("block", 1.0, dvector![0.0, 0.0, -9.81], vec![Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0)?])?;
        let state = State { time: 0.0, position: dvector![0.0, 0.0, -0.001], velocity: dvector![1.0, 0.0, 0.0] };
        let scheme = by_name(scheme, SchemeParameters::default())?;
        let waist = scheme.waist().ok_or_else(|| Error::Unsupported("the scheme does not pass the waist".into()))?;
        Ok(assembled(waist, &block, &state, 0.01)?.problem.map(|problem| problem.law()))
    };
    let relaxed = Some(Law::Associated);
    let run = reading.only(0).pick("drake/block_slide__sap__h0.001.json", "drake/block_slide__lagged__h0.001.json");
    let mut findings = vec![
        Finding::at_least("rise of Drake's block with its speed, over that of the relaxation", rise(run)?, FOLLOWS, "1").experiment(),
        Finding::decision("Chrono poses the associated law over round cones", law("chrono")? == relaxed, true).context(),
    ];
    findings.extend(lookups::check("S5.who-uses", reading)?);
    Ok(findings)
}

/// How much a stored block of Drake's rises from its slope while it slides from 0.3 s to 0.9 s, over (h + τ) μ Δv: 1 under the
/// relaxation, where φ = (h + τ) μ v and a constant, 0 under Coulomb's law.
fn rise(run: &str) -> Result<f64> {
    let relaxation_time = 0.005;
    let run = read_by(&RUNS, run, Trajectory::from_json)?;
    let normal = run.scene.ground.as_ref().map_or([0.0, 0.0, 1.0], |ground| ground.normal);
    let along = |vector: [f64; 3]| (0..3).map(|k| normal[k] * vector[k]).sum::<f64>();
    let at = |time: f64| {
        let sample = run.times.iter().take_while(|sampled| **sampled < time).count();
        let block = &run.bodies[0];
        (along(block.position[sample]), block.linear_velocity[sample].iter().map(|v| v * v).sum::<f64>().sqrt())
    };
    let ((low, slow), (high, fast)) = (at(0.3), at(0.9));
    Ok((high - low) / ((run.time_step + relaxation_time) * run.scene.material.friction * (fast - slow)))
}

/// Multiplications of Lemke's method on a pressed row of n masses, `touched` entries per pivot.
fn pivoting_work(masses: usize, touched: usize) -> Result<f64> {
    let row = pressed_row(masses);
    match lemke(&Lcp::new(row.dense().clone(), row.free_velocity().clone()), &DVector::from_element(masses, 1.0))? {
        LemkeOutcome::Solution { pivots, .. } => Ok((pivots * touched) as f64),
        LemkeOutcome::Ray { .. } => Err(Error::Unsupported("a row of masses has a solution".into())),
    }
}

/// Multiplications of projected gradients to the library's stopping rule, 3n − 2 non-zeros of W per iteration.
fn gradient_work(masses: usize, momentum: Momentum) -> Result<f64> {
    let solver = AcceleratedProjectedGradient { momentum, ..AcceleratedProjectedGradient::default() };
    Ok((solver.solve(&pressed_row(masses), None)?.iterations * (3 * masses - 2)) as f64)
}

fn scaling(reading: Reading) -> Result<Vec<Finding>> {
    let momentum = reading.pick(Momentum::Restarted, Momentum::Plain);
    let touched = |masses: usize| reading.pick(masses * (2 * masses + 2), 2 * masses + 2);
    let mut findings = Vec::new();
    for masses in [10, 20] {
        let pivoting = pivoting_work(2 * masses, touched(2 * masses))? / pivoting_work(masses, touched(masses))?;
        let gradients = gradient_work(2 * masses, momentum)? / gradient_work(masses, momentum)?;
        let name = format!("growth of the work from {masses} masses to {}, pivots over gradients", 2 * masses);
        findings.push(Finding::at_least(name, pivoting / gradients, 1.0, "1").experiment());
    }
    let unknowns: f64 = 6.0 * 1e5;
    findings.push(Finding::at_least("dense tableau of 1e5 contacts", 8.0 * unknowns * unknowns, TERABYTE, "B").context());
    Ok(findings)
}
