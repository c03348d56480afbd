use tolman_maps::cpm::{CpMap, MapUpdate, Port, Turn};

/// The walks of a robot, from which its places on the present map follow. After a new explanation,
/// or the merge of two places, the map has other names for them.
#[derive(Clone, Debug, Default)]
pub(super) struct Trail {
    /// Places that it came to before a map that it has given up.
    forgotten: usize,
    /// Starting points of walks that can be retraced from one another.
    bases: Vec<Base>,
}

/// Walks from a place on.
#[derive(Clone, Debug)]
struct Base {
    at: Port,
    walks: Vec<TrailStep>,
}

/// A walk to a place.
#[derive(Clone, Copy, Debug)]
struct TrailStep {
    turn: Turn,
    /// Port at which the map had it then.
    then: Port,
}

impl Trail {
    /// Begins at a port of a new map, which has no names for the places before.
    pub(super) fn begin(&mut self, at: Port) {
        let walks = Vec::new();
        self.forgotten += self.count();
        self.bases = vec![Base { at, walks }];
    }

    /// Returns how many places the robot came to on its map.
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
        // It goes on with what it found, apart from the rest.
        let walks = Vec::new();
        self.bases.push(Base { at: then, walks });
    }

    /// Returns the places that the robot came to, each as the map has it now. O(walks · log
    /// fragments).
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

/// Returns where a turn leads from a port that lies behind the robot.
fn beyond(map: &CpMap, at: Port, turn: Turn) -> Option<Port> {
    let exit = turn.exit(at.number, map.degree(at.junction)).ok()?;
    map.beyond(at.junction.port(exit))
}
