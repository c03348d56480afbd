use tolman_maps::cpm::{CpMap, MapUpdate, Port, Turn};

/// The walks of a robot, from which its places on the present map follow. The map renames places
/// when it explains the walks in another way, or merges two places.
#[derive(Clone, Debug, Default)]
pub(super) struct Trail {
    /// Number of places visited on maps that the system has given up.
    forgotten: usize,
    /// Starting points from which walks can be retraced on the map.
    bases: Vec<Base>,
}

/// A starting point, and the walks that followed.
#[derive(Clone, Debug)]
struct Base {
    at: Port,
    walks: Vec<TrailStep>,
}

/// A walk to a place.
#[derive(Clone, Copy, Debug)]
struct TrailStep {
    turn: Turn,
    /// Port to which the walk led, by the map's names at that time.
    then: Port,
}

impl Trail {
    /// Begins at a port of a new map, which has no names for the earlier places.
    pub(super) fn begin(&mut self, at: Port) {
        let walks = Vec::new();
        self.forgotten += self.count();
        self.bases = vec![Base { at, walks }];
    }

    /// Returns the number of places that the robot came to on its map.
    fn count(&self) -> usize {
        self.bases.iter().map(|base| 1 + base.walks.len()).sum()
    }

    /// Adds a walk that led to the port `then`.
    pub(super) fn walked(&mut self, turn: Turn, then: Port, arrival: MapUpdate) {
        let is_apart = arrival == MapUpdate::Contradiction;
        if let Some(base) = self.bases.last_mut().filter(|_| !is_apart) {
            base.walks.push(TrailStep { turn, then });
            return;
        }
        // The trail continues from the place found, separate from the rest.
        let walks = Vec::new();
        self.bases.push(Base { at: then, walks });
    }

    /// Returns the places that the robot came to, with their present names on the map. O(walks ·
    /// log fragments).
    pub(super) fn places(&self, map: &CpMap) -> Vec<Option<u32>> {
        let mut places = vec![None; self.forgotten];
        let known = |at: Port| map.junction(at.junction).map(|_| at.junction.0);
        for base in &self.bases {
            let mut at = Some(base.at);
            places.push(known(base.at));
            for walk in &base.walks {
                at = at.and_then(|at| beyond(map, at, walk.turn));
                places.push(at.map_or_else(|| known(walk.then), known));
            }
        }
        places
    }
}

/// Returns the port to which a turn leads, from the port behind the robot.
fn beyond(map: &CpMap, at: Port, turn: Turn) -> Option<Port> {
    let exit = turn.exit(at.number, map.degree(at.junction)).ok()?;
    map.beyond(at.junction.port(exit))
}
