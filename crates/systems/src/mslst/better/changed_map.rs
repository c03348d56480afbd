use alloc::sync::Arc;

use tolman_geom::Point;

use super::BetterMap;

/// A learned map, and a copy with the walls that have barred the way since.
#[derive(Clone, Debug)]
pub(super) struct ChangedMap {
    learned: Arc<BetterMap>,
    now: Arc<BetterMap>,
    /// Number of times that such a wall has blocked the way.
    barred: u32,
    /// Whether such walls block every way, so that the map as learned is used.
    is_cut_off: bool,
}

/// Number of times that a wall has to bar the way before it is drawn.
const ENOUGH: u32 = 2;

impl ChangedMap {
    pub(super) fn new(learned: Arc<BetterMap>) -> Self {
        Self {
            now: Arc::clone(&learned),
            learned,
            barred: 0,
            is_cut_off: false,
        }
    }

    /// Returns the map as it was learned.
    pub(super) const fn learned(&self) -> &Arc<BetterMap> {
        &self.learned
    }

    /// Returns the map with the new walls.
    pub(super) const fn now(&self) -> &Arc<BetterMap> {
        &self.now
    }

    /// Records that these walls bar the way at a standpoint. Draws them once they have done so
    /// often enough and another way leads to the goal. Returns whether it drew them. O(1), or the
    /// cost of preparing a map.
    pub(super) fn bar(&mut self, walls: &[Point], at: Point) -> bool {
        self.barred += 1;
        if self.barred < ENOUGH || self.is_cut_off {
            return false;
        }
        self.barred = 0;
        let changed = self.now.with_walls(walls);
        let changed = changed.filter(|map| map.leads_on(at));
        match changed {
            Some(map) => {
                self.now = Arc::new(map);
                true
            }
            None => {
                let had_walls = self.forget();
                self.is_cut_off = true;
                had_walls
            }
        }
    }

    /// Forgets all walls, and returns whether there were any.
    pub(super) fn forget(&mut self) -> bool {
        let has_changed = !Arc::ptr_eq(&self.now, &self.learned);
        *self = Self::new(Arc::clone(&self.learned));
        has_changed
    }
}
