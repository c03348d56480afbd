use tolman_maze::Cell;

/// Stage of a simulated proof. Plays of one maze that are at the same stage continue alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stage {
    pub(super) at: Cell,
    /// Fingerprint of the sides seen so far: [`Chart::learned`](super::chart::Chart::learned).
    pub(super) learned: u64,
}

/// Stages of the explorer's own play, each with the number of steps until then. Only the first
/// stages are kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Play {
    stages: [Option<(Stage, f32)>; Self::MOST],
    count: usize,
}

impl Play {
    /// Maximum number of stages kept.
    const MOST: usize = 64;

    pub(super) const fn new() -> Self {
        Self {
            stages: [None; Self::MOST],
            count: 0,
        }
    }

    pub(super) fn record(&mut self, stage: Stage, steps: f32) {
        if let Some(slot) = self.stages.get_mut(self.count) {
            *slot = Some((stage, steps));
            self.count += 1;
        }
    }

    /// Returns the number of steps until a stage, or `None` if the play did not reach it.
    pub(super) fn steps_at(&self, stage: Stage) -> Option<f32> {
        let mut stages = self.stages.iter().map_while(|stage| *stage);
        stages
            .find(|(known, _)| *known == stage)
            .map(|(_, steps)| steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_play_keeps_its_first_stages() {
        let stage = |number: u16| Stage {
            at: Cell::new(number % 16, 3),
            learned: u64::from(number) * 7,
        };
        let mut play = Play::new();
        assert_eq!(play.steps_at(stage(0)), None);
        for number in 0..100 {
            play.record(stage(number), f32::from(number) + 0.5);
        }
        for number in 0..100 {
            let kept = usize::from(number) < Play::MOST;
            let steps = kept.then(|| f32::from(number) + 0.5);
            assert_eq!(play.steps_at(stage(number)), steps, "{number}");
        }
        // The same cell with other sides seen is another stage.
        let other = Stage {
            learned: 1,
            ..stage(0)
        };
        assert_eq!(play.steps_at(other), None);
    }
}
