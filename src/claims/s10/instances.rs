//! §10, the table of what each mathematical object is used for, and by whom.

use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::scenes::named;
use crate::schemes::{Chrono, Scheme, StewartTrinkle, simulate};
use crate::solvers::Auto;
use crate::tolerance::claims::rolling_hop;
use crate::tolerance::convergence::slide_rounding;
use crate::trajectory::metrics::largest_gap;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S10.table-instances",
    statement: "Who uses what: Moreau–Jean in Siconos, Pinocchio 3 and RaiSim; Stewart–Trinkle in early Drake, Bullet's MLCP and ODE; \
        Anitescu for rolling contact and large systems in Chrono's APGD; sequential impulses in Bullet, PhysX, Havok and ODE.",
    verdict: ClaimVerdict::Ambiguous,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Cited,
    correct_statement: "Which release of which software runs what was not checked here for RaiSim, early Drake, PhysX, Havok and ODE, \
        which stands in two rows (it has two solvers). Of the use that is named, rolling contact, Anitescu's relaxation is right about \
        the end and wrong on the way: a sphere thrown along the floor rolls at 5/7 of its speed, but hops first, by a height that no \
        smaller step removes. Chrono itself was not run: its step is rebuilt here.",
    argument: r"Chrono's step, rebuilt, of a sphere with $\mu = 0.2$ thrown at 1 m/s: it rolls at 5/7 m/s to rounding, friction keeping
        the angular momentum about the floor. At the first step $u_n = \mu|u_t|$ with $W_{tt} = 7/(2m)$ makes it leave at
        $w = \mu\,v/(1 + 7/2\,\mu^2)$, to $w^2/(2g) = \text{1.57e-3}$ m. Stewart–Trinkle's sphere ends at the same speed and stays on the
        floor.",
    controls: &[
        "Stewart–Trinkle in the place of Chrono's step.",
        "A run that ends before the sphere rolls; each package asked for what the other has.",
    ],
    sources: &["chapter §10, table of mathematical objects, instances and simulators"],
    check: check!(rolling),
}];

fn rolling(reading: Reading) -> Result<Vec<Finding>> {
    let (h, steps, friction, gravity) = (1.0 / 4096.0, 2048, 0.2, 9.81);
    let staged = named("rolling-sphere")?.staged()?;
    let (chrono, stewart_trinkle) = (Chrono::default(), StewartTrinkle::default());
    let scheme: &dyn Scheme = reading.only(0).pick(&chrono, &stewart_trinkle);
    let run = simulate(scheme, &Auto, staged.mechanism.as_ref(), staged.start, h, reading.only(1).pick(steps, 256))?;
    let gaps: Vec<f64> = run.samples.iter().map(|state| staged.mechanism.contacts(&state.position)[0].gap).collect();
    let launch = friction / (1.0 + 3.5 * friction * friction);
    let hop = launch * launch / (2.0 * gravity);
    let last = &run.last().velocity;
    let mut findings = vec![
        Finding::equal("height of the hop", largest_gap(&gaps), hop, rolling_hop(launch, friction, gravity, h), "m")
            .says(0.0)
            .reading("as the motion all the way"),
        Finding::equal("speed at the end", last[0], 5.0 / 7.0, slide_rounding(steps), "m/s").reading("as the rolling at the end"),
        Finding::equal("surface speed at the end", 0.1 * last[2], 5.0 / 7.0, slide_rounding(steps), "m/s")
            .reading("as the rolling at the end"),
    ];
    findings.extend(lookups::check("S10.table-instances", reading)?);
    Ok(findings)
}
