use tolman_arena::episode::Episode;

/// Sums over episodes in one world.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Played {
    episodes: u32,
    reached: u32,
    actions: u64,
    steps: u64,
    steps_arrived: u64,
}

impl Played {
    /// Returns the sums over the episodes of `starts` starts.
    pub(crate) fn of<E>(
        starts: u32,
        play: impl FnMut(u32) -> Result<Episode, E>,
    ) -> Result<Self, E> {
        let mut played = Self::default();
        for episode in (0..starts).map(play) {
            played.add(&episode?);
        }
        Ok(played)
    }

    /// Adds an episode.
    pub(crate) fn add(&mut self, episode: &Episode) {
        self.episodes += 1;
        self.actions += u64::from(episode.actions);
        self.steps += u64::from(episode.steps);
        if episode.reached {
            self.reached += 1;
            self.steps_arrived += u64::from(episode.steps);
        }
    }

    /// Returns the share of the episodes that reached the destination.
    pub(crate) fn success_percent(&self) -> f64 {
        100.0 * mean(self.reached.into(), self.episodes)
    }

    /// Returns the mean number of actions.
    pub(crate) fn actions(&self) -> f64 {
        mean(self.actions, self.episodes)
    }

    /// Returns the mean number of time steps.
    pub(crate) fn steps(&self) -> f64 {
        mean(self.steps, self.episodes)
    }

    /// Returns the mean number of time steps over the episodes that reached the destination; `None`
    /// if none did.
    pub(crate) fn steps_arrived(&self) -> Option<f64> {
        (self.reached > 0).then(|| mean(self.steps_arrived, self.reached))
    }
}

fn mean(sum: u64, count: u32) -> f64 {
    sum as f64 / f64::from(count)
}
