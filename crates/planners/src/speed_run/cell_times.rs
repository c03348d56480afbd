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

    /// Sets the duration of a state, ms, if it can be held, and returns whether it can.
    fn set(&mut self, state: usize, time: u32) -> bool;
}

impl<const S: usize> CellTimes for [u32; S] {
    const NOWHERE: Self = [NEVER; S];

    #[inline(always)]
    fn of(&self, state: usize) -> u32 {
        self.get(state).copied().unwrap_or(NEVER)
    }

    #[inline(always)]
    fn set(&mut self, state: usize, time: u32) -> bool {
        self.get_mut(state).map(|slot| *slot = time).is_some()
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
    fn set(&mut self, state: usize, time: u32) -> bool {
        match self.get_mut(state) {
            Some(slot) if time < u32::from(u16::MAX) => {
                *slot = time as u16;
                true
            }
            _ => false,
        }
    }
}
