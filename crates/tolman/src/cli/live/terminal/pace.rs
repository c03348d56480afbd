//! Speed at which a run is shown.

use core::time::Duration;

/// Speeds to choose from, time steps per second.
const SPEEDS: [u32; 10] = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

/// Speed of a run, and whether the run is paused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pace {
    speed: usize,
    pub(super) motion: Motion,
}

/// Whether a run continues by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    Running,
    /// Stands still until told to continue.
    Paused,
}

impl Default for Pace {
    /// Returns a speed of ten steps per second: real time for a robot with ten steps per second.
    fn default() -> Self {
        Self {
            speed: 3,
            motion: Motion::Running,
        }
    }
}

impl Pace {
    pub(super) fn steps_per_second(self) -> u32 {
        SPEEDS[self.speed]
    }

    /// Returns the time from one step to the next.
    pub(super) fn period(self) -> Duration {
        Duration::from_secs(1) / self.steps_per_second()
    }

    pub(super) fn faster(&mut self) {
        self.speed = (self.speed + 1).min(SPEEDS.len() - 1);
    }

    pub(super) fn slower(&mut self) {
        self.speed = self.speed.saturating_sub(1);
    }

    pub(super) fn pause_or_go_on(&mut self) {
        self.motion = match self.motion {
            Motion::Running => Motion::Paused,
            Motion::Paused => Motion::Running,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_stays_within_its_bounds() {
        let mut pace = Pace::default();
        assert_eq!(pace.period(), Duration::from_millis(100));
        for _ in 0..20 {
            pace.faster();
        }
        assert_eq!(pace.period(), Duration::from_millis(1));
        for _ in 0..20 {
            pace.slower();
        }
        assert_eq!(pace.period(), Duration::from_secs(1));
    }
}
