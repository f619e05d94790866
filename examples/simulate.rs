//! Simulate and look: `cargo run --example simulate`.
//!
//! A ball bounces, in steps of 1 ms of Moreau and Jean's scheme. Every step is certified; the summary and the picture hold the motion
//! against its closed form.

use moreau::prelude::*;
use moreau::report::motion::{MotionReport, lines};
use moreau::report::plot;
use moreau::report::steps::StepSummary;

/// Writes the picture into the folder for temporary files.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = scenes::named("bouncing-ball")?;
    let (mechanism, start) = scene.mechanism()?;
    let exact = scene.exact_motion(&start);
    let steps = (scene.duration / 1e-3).round() as usize;
    let recording = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 1e-3, steps)?;

    let gravity = -scene.gravity[2];
    let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: exact.as_ref(), gravity };
    print!("{}", lines(&motion.summary()));
    print!("{}", StepSummary::of(&recording, mechanism.as_ref()).text());

    let picture = std::env::temp_dir().join("moreau-bouncing-ball.svg");
    std::fs::write(&picture, plot::svg("a bouncing ball", &motion.panels())?)?;
    println!("look at {}", picture.display());
    Ok(())
}
