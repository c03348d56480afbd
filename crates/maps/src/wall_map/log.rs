use tolman_maze::Wall;

/// Log of the last walls learned, so that they can be forgotten again: a ring buffer of `LOG`
/// entries. When it is full, new entries replace the oldest.
#[derive(Clone, Copy, Debug, Eq)]
pub(super) struct Log<const LOG: usize> {
    entries: [Entry; LOG],
    /// Index at which the next entry is written.
    next: usize,
    len: usize,
}

/// Entry of the log: one wall that an observation revealed. Walls of a map of at most 32 × 32 have
/// numbers below 2112.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Entry {
    wall: u16,
    /// Index of the wall among those that the same observation revealed, from 0.
    place: u16,
}

impl<const LOG: usize> Log<LOG> {
    pub(super) const fn new() -> Self {
        Self {
            entries: [Entry { wall: 0, place: 0 }; LOG],
            next: 0,
            len: 0,
        }
    }

    /// Adds the wall that `place` others of the same observation precede.
    pub(super) fn push(&mut self, wall: Wall, place: u16) {
        let wall = u16::try_from(wall.0).unwrap_or(u16::MAX);
        if let Some(entry) = self.entries.get_mut(self.next) {
            *entry = Entry { wall, place };
            self.next = (self.next + 1) % LOG;
            self.len = (self.len + 1).min(LOG);
        }
    }

    /// Returns whether the last observation is still there as a whole.
    pub(super) fn holds_last(&self) -> bool {
        self.last()
            .is_some_and(|last| usize::from(last.place) < self.len)
    }

    /// Removes and returns the last wall, with whether it was the first of its observation.
    pub(super) fn pop(&mut self) -> Option<(Wall, bool)> {
        let last = self.last()?;
        self.next = (self.next + LOG - 1) % LOG;
        self.len -= 1;
        Some((Wall(u32::from(last.wall)), last.place == 0))
    }

    /// Returns the observations that are still complete, the oldest first.
    #[cfg(feature = "serde")]
    pub(super) fn observations(&self) -> alloc::vec::Vec<alloc::vec::Vec<Wall>> {
        let mut left = *self;
        let mut observations = alloc::vec::Vec::new();
        while left.holds_last() {
            let mut walls = alloc::vec::Vec::new();
            while let Some((wall, first)) = left.pop() {
                walls.push(wall);
                if first {
                    break;
                }
            }
            walls.reverse();
            observations.push(walls);
        }
        observations.reverse();
        observations
    }

    fn last(&self) -> Option<Entry> {
        if self.len == 0 {
            return None;
        }
        self.entries.get((self.next + LOG - 1) % LOG).copied()
    }
}

/// Two logs are equal if undoing them has the same effect. Observations that were overwritten,
/// wholly or in part, do not count.
impl<const LOG: usize> PartialEq for Log<LOG> {
    fn eq(&self, other: &Self) -> bool {
        let (mut left, mut right) = (*self, *other);
        while left.holds_last() && right.holds_last() {
            loop {
                let (one, two) = (left.pop(), right.pop());
                if one != two {
                    return false;
                }
                if one.is_none_or(|(_, first)| first) {
                    break;
                }
            }
        }
        left.holds_last() == right.holds_last()
    }
}
