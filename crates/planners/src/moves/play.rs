use tolman_maze::Cell;

/// Stage of a play: plays of one maze that are at the same stage continue alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stage {
    pub(super) at: Cell,
    /// [`Chart::learned`](super::chart::Chart::learned).
    pub(super) learned: u64,
}

/// The stages of the explorer's own play, each with the number of steps until then; the first
/// stages only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Play {
    stages: [Option<(Stage, f32)>; Self::MOST],
    count: usize,
}

impl Play {
    /// Number of stages that are kept.
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
