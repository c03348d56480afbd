use super::map::NEVER;

/// Durations of the runs from the states of one cell: how a [`SpeedRunMap`](super::SpeedRunMap)
/// keeps them.
///
/// `[u32; 16]` holds everything. `[u16; 16]` takes half the memory, and runs of 65.535 s or more
/// count as out of reach. `[u16; 12]` has no states for turns within a cell either.
pub trait CellTimes: Copy {
    /// No goal is in reach.
    const NOWHERE: Self;

    /// Returns the duration of a state, ms, or 2³⁰ if no goal is in reach from it.
    fn of(&self, state: usize) -> u32;

    /// Returns whether a state was reached later than at this time, ms, or never. No state was if
    /// the time cannot be held.
    fn is_later(&self, state: usize, time: u32) -> bool;

    /// Sets the duration of a state that was reached later, ms.
    fn set(&mut self, state: usize, time: u32);
}

impl<const S: usize> CellTimes for [u32; S] {
    const NOWHERE: Self = [NEVER; S];

    #[inline(always)]
    fn of(&self, state: usize) -> u32 {
        self.get(state).copied().unwrap_or(NEVER)
    }

    #[inline(always)]
    fn is_later(&self, state: usize, time: u32) -> bool {
        self.get(state).is_some_and(|slot| time < *slot)
    }

    #[inline(always)]
    fn set(&mut self, state: usize, time: u32) {
        if let Some(slot) = self.get_mut(state) {
            *slot = time;
        }
    }
}

impl<const S: usize> CellTimes for [u16; S] {
    const NOWHERE: Self = [u16::MAX; S];

    #[inline(always)]
    fn of(&self, state: usize) -> u32 {
        match self.get(state).copied() {
            None | Some(u16::MAX) => NEVER,
            Some(time) => time.into(),
        }
    }

    #[inline(always)]
    fn is_later(&self, state: usize, time: u32) -> bool {
        // The largest number stands for all times that cannot be held.
        self.get(state).is_some_and(|slot| time < u32::from(*slot))
    }

    #[inline(always)]
    fn set(&mut self, state: usize, time: u32) {
        if let Some(slot) = self.get_mut(state) {
            *slot = time as u16;
        }
    }
}
