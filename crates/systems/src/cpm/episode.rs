use super::decision::Done;
use super::robot::CpmRobot;
use super::walker::Walker;

/// Result of an episode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EpisodeSummary {
    /// Reason why the episode ended.
    pub done: Done,
    /// Duration, s.
    pub seconds: f64,
    /// Number of observations.
    pub observations: u32,
}

/// State of the robot at the beginning of an episode.
#[derive(Clone, Copy, Debug)]
pub struct Begun {
    time_us: u64,
    observations: u32,
}

impl Begun {
    /// Returns the beginning of an episode that starts now.
    pub fn now<B: CpmRobot>(walker: &Walker<B>) -> Self {
        Self {
            time_us: walker.time_us(),
            observations: walker.observations(),
        }
    }

    /// Returns the summary of the episode, which ends now.
    pub fn ended<B: CpmRobot>(&self, done: Done, walker: &Walker<B>) -> EpisodeSummary {
        EpisodeSummary {
            done,
            seconds: (walker.time_us() - self.time_us) as f64 * 1e-6,
            observations: walker.observations() - self.observations,
        }
    }
}
