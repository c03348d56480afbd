use core::convert::Infallible;

use rand::Rng;
use tolman_maze::Direction;
use tolman_robot::{Mapper, Standing, Task};

use super::north_scan::north_scan;
use crate::baselines::AvoidBrain;
use crate::{Brain, Doing, TimeStep};

/// Phase I: "the robot wanders the maze at random, using the Avoid brain … It records its input
/// vector at every time step."
///
/// Each scan is [turned to the north](super::heading_free). Time steps in which ranges or heading
/// drop out record nothing.
#[derive(Clone, Debug)]
pub struct ScanRecorder {
    scans: Vec<Vec<f64>>,
    steps: u32,
    wanted: u32,
    wander: AvoidBrain,
}

impl ScanRecorder {
    /// Returns a recorder of `steps` time steps.
    #[must_use]
    pub fn new(steps: u32) -> Self {
        Self {
            scans: Vec::new(),
            steps: 0,
            wanted: steps,
            wander: AvoidBrain::default(),
        }
    }

    /// Returns the recorded scans, robot units, beam 0 to the north, in the order of time.
    #[must_use]
    pub fn scans(&self) -> &[Vec<f64>] {
        &self.scans
    }

    /// Returns the scans.
    #[must_use]
    pub fn into_scans(self) -> Vec<Vec<f64>> {
        self.scans
    }

    /// Returns whether all time steps are recorded.
    #[must_use]
    pub const fn is_complete(&self) -> bool {
        self.steps >= self.wanted
    }
}

impl Mapper for ScanRecorder {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Infallible> {
        self.wander.learn(seen.doing);
        if seen.doing == Doing::PutDown {
            return Ok(());
        }
        // The action under way is finished beyond the last step that counts.
        if !self.is_complete() {
            self.scans.extend(north_scan(seen));
        }
        self.steps += 1;
        Ok(())
    }
}

impl Brain for ScanRecorder {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        self.wander.wander(rng)
    }

    fn standing(&self, task: Task) -> Standing {
        let why = "it has learned no states yet: let it explore first";
        standing_of_phase(task, self.is_complete(), why)
    }

    fn words(&self) -> String {
        format!("records scan {} of {}", self.steps, self.wanted)
    }
}

/// Returns the standing of a task in a phase that only explores. `why` is the reason given for
/// other tasks.
pub(super) fn standing_of_phase(task: Task, is_complete: bool, why: &str) -> Standing {
    match task {
        Task::Explore if is_complete => Standing::Done,
        Task::Explore => Standing::UnderWay,
        Task::Reach(_) | Task::Localize => Standing::gave_up(why),
    }
}
