use super::map::NEVER;

/// Durations of the runs from the states of one cell: how a [`SpeedRunMap`](super::SpeedRunMap)
/// keeps them.
///
/// `[u32; 16]` holds everything. `[u16; 16]` takes half the memory, and runs of 65.535 s or more
/// count as out of reach. `[u16; 12]` has no states for turns within a cell either.
pub trait CellTimes: Copy {
    /// No goal is in reach.
    const NOWHERE: Self;

    /// Number of states of a cell.
    const STATES: usize;

    /// Returns the duration of a state, ms, or 2³⁰ if no goal is in reach from it. States are
    /// numbered from cell to cell.
    fn of(cells: &[Self], state: usize) -> u32;

    /// Returns the time before which a state has to be reached to be reached sooner than it was,
    /// ms: its duration, or the least time that cannot be held.
    fn limit(cells: &[Self], state: usize) -> u32;

    /// Sets the duration of a state to one below its [`limit`](Self::limit), ms.
    fn set(cells: &mut [Self], state: usize, time: u32);
}

impl<const S: usize> CellTimes for [u32; S] {
    const NOWHERE: Self = [NEVER; S];
    const STATES: usize = S;

    #[inline(always)]
    fn of(cells: &[Self], state: usize) -> u32 {
        let time = cells.as_flattened().get(state);
        time.copied().unwrap_or(NEVER)
    }

    #[inline(always)]
    fn limit(cells: &[Self], state: usize) -> u32 {
        let time = cells.as_flattened().get(state);
        time.copied().unwrap_or(0)
    }

    #[inline(always)]
    fn set(cells: &mut [Self], state: usize, time: u32) {
        if let Some(slot) = cells.as_flattened_mut().get_mut(state) {
            *slot = time;
        }
    }
}

impl<const S: usize> CellTimes for [u16; S] {
    const NOWHERE: Self = [u16::MAX; S];
    const STATES: usize = S;

    #[inline(always)]
    fn of(cells: &[Self], state: usize) -> u32 {
        match cells.as_flattened().get(state).copied() {
            None | Some(u16::MAX) => NEVER,
            Some(time) => time.into(),
        }
    }

    #[inline(always)]
    fn limit(cells: &[Self], state: usize) -> u32 {
        // The largest number stands for all times that cannot be held.
        let time = cells.as_flattened().get(state);
        time.copied().map_or(0, u32::from)
    }

    #[inline(always)]
    fn set(cells: &mut [Self], state: usize, time: u32) {
        if let Some(slot) = cells.as_flattened_mut().get_mut(state) {
            *slot = time as u16;
        }
    }
}
