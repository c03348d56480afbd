//! What a robot sees while it wanders by the Avoid brain (phase I of MSLST).

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_control::{Stack, View};
use tolman_robot::Robot;
use tolman_sim::Solo;
use tolman_sim::robots::LaserPioneer;

use crate::agents::{Avoid, Brain, Perception};
use crate::course::Course;
use crate::experiment::BoxError;
use crate::pioneer;

/// The scan of every time step, free of the heading and in robot units.
pub(super) fn scans(course: &Course, steps: u32, seed: u64) -> Result<Vec<Vec<f64>>, BoxError> {
    let stream = |number| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(number);
        rng
    };
    let (mut layers, mut mind) = (stream(1), stream(2));
    let start = course.random_start(&pioneer::body(), &mut stream(3));
    let robot = LaserPioneer::new(pioneer::calibrated())?;
    let mut solo = Solo::new(course.world.clone(), robot, start, seed)?;
    let mut stack = Stack::paper(pioneer::ring(), pioneer::ROBOT_UNIT, course.corridor_width)?;
    let (mut avoid, mut last, mut acting) = (Avoid::default(), None, None);
    let mut scans = Vec::new();
    for _ in 0..steps {
        let sensing = solo.sensing();
        let (Some(scan), Some(heading)) = (&sensing.scan, sensing.compass) else {
            return Err("the calibrated robot has no drop-outs".into());
        };
        let action = acting.unwrap_or_else(|| {
            let perception = Perception {
                last,
                scan: Some(scan),
                heading: Some(heading),
            };
            let action = avoid.choose(&perception, &mut mind);
            stack.begin(action);
            action
        });
        acting = Some(action);
        let proposal = stack.correct(View { scan, heading }, &mut layers);
        solo.step(&proposal.command)?;
        if let Some(outcome) = proposal.ends {
            last = Some((action, outcome));
            acting = None;
        }
        let sensing = solo.sensing();
        if let (Some(scan), Some(heading)) = (&sensing.scan, sensing.compass) {
            scans.push(pioneer::heading_free(scan, heading));
        }
    }
    Ok(scans)
}
