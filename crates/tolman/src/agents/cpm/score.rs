use alloc::collections::{BTreeMap, BTreeSet};

use tolman_geom::Pose;
use tolman_maps::cpm::{Arrival, CpMap, FragmentId, JunctionId, Port, Sign, Turn};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::{Arcs, costs_from};
use tolman_sim::World;

use super::agent::{Cpm, Step};
use super::body::SimulatedEpuck;
use super::fragments::{TrueFragments, Way};
use super::known_map::KnownMap;
use super::walker::Walk;

/// Loops closed in the first episode: arrivals by a way that was not on the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Closures {
    /// A duplicate was told, and it was that one; on arrival, or by what was met later.
    pub right: u32,
    /// A duplicate was told, and it was another or none.
    pub wrong: u32,
    /// A fragment was walked again, and still is on the map at the end as another one.
    pub missed: u32,
}

/// What really happened, for scoring.
pub(super) struct Score<'a> {
    fragments: TrueFragments,
    closures: Closures,
    /// The place where the map begins, and its cell.
    start: Option<(Port, Cell)>,
    /// All walks since: the turn, and the true way.
    walked: Vec<(Turn, Option<Way>)>,
    /// The true way from − to + of each fragment of the map.
    pub(super) truth: BTreeMap<FragmentId, Way>,
    /// The cell of each place of the map.
    places: BTreeMap<JunctionId, Cell>,
    /// Observations of each true fragment when it was first walked.
    pub(super) lengths: BTreeMap<u32, u32>,
    pub(super) known: KnownMap<'a>,
}

impl<'a> Score<'a> {
    pub(super) fn of(maze: &'a Maze) -> Self {
        Self {
            fragments: TrueFragments::of(maze),
            closures: Closures::default(),
            start: None,
            walked: Vec::new(),
            truth: BTreeMap::new(),
            places: BTreeMap::new(),
            lengths: BTreeMap::new(),
            known: KnownMap::new(maze),
        }
    }

    pub(super) fn begin(&mut self, agent: &Cpm<'_, SimulatedEpuck>, start: Pose) {
        if let Some(cell) = agent.walker().body().world().cell_at(start.position) {
            let at = agent.explorer().at();
            self.places.insert(at.junction, cell);
            self.start = Some((at, cell));
        }
    }

    /// Takes in a walk to the end of a fragment; a robot that looks for the goal never turns back amid one.
    pub(super) fn see(&mut self, agent: &Cpm<'_, SimulatedEpuck>, step: &Step) {
        let (Some(arrival), Walk::Arrived { observations, .. }) = (step.arrival, &step.walk) else {
            return;
        };
        let body = agent.walker().body();
        let here = body.world().cell_at(body.truth().pose.position);
        let way = agent.walker().departed_at(body.path()).and_then(|from| {
            let cell = body.world().cell_at(from.position)?;
            self.fragments.way(cell, from.heading)
        });
        self.walked.push((step.leg.turn, way));
        let length = (observations.len() as u32).max(1);
        if let Some(here) = here {
            let way = way.filter(|way| way.to == here);
            let before = way.and_then(|way| self.lengths.get(&way.fragment));
            self.known.walk(way, here, *before.unwrap_or(&length));
        }
        let Some(way) = way else {
            return;
        };
        let is_old = self.lengths.contains_key(&way.fragment);
        let told = agent.explorer().map().end_at(agent.explorer().at());
        let known = told.and_then(|end| self.truth.get(&end.fragment).copied());
        let is_same = known.is_some_and(|known| known.fragment == way.fragment);
        // The place that the map says it is at, where that is a place of the map.
        let junction = agent.explorer().at().junction;
        let stands = self.places.get(&junction).copied();
        if let Some(here) = here {
            self.places.entry(junction).or_insert(here);
        }
        match arrival {
            Arrival::Revised => self.retrace(agent.explorer().map()),
            Arrival::Duplicate if is_same => self.closures.right += 1,
            Arrival::Duplicate => self.closures.wrong += 1,
            Arrival::Loop if stands == here => self.closures.right += 1,
            Arrival::Loop => self.closures.wrong += 1,
            Arrival::New if is_old => self.closures.missed += 1,
            _ => {}
        }
        if let Some(end) = told {
            self.truth.entry(end.fragment).or_insert(way);
        }
        self.lengths.entry(way.fragment).or_insert(length);
    }

    /// Another map has its own names of fragments and places: what they are follows from the same walk on it. A fragment that was walked along
    /// two true ones has closed a loop wrongly.
    fn retrace(&mut self, map: &CpMap) {
        let Some((mut at, cell)) = self.start else {
            return;
        };
        self.truth.clear();
        self.places = BTreeMap::from([(at.junction, cell)]);
        let mut confused = BTreeSet::new();
        for (turn, way) in &self.walked {
            let exit = turn.exit(at.number, map.degree(at.junction));
            let exit = exit.map(|number| Port { number, ..at });
            // On a map that broke off somewhere the walk cannot be retraced further.
            let Some((end, beyond)) = exit
                .ok()
                .and_then(|exit| Some((map.end_at(exit)?.opposite(), map.beyond(exit)?)))
            else {
                break;
            };
            at = beyond;
            let Some(way) = way else {
                continue;
            };
            self.places.entry(at.junction).or_insert(way.to);
            let from_minus = match end.sign {
                Sign::Plus => Some(*way),
                Sign::Minus => self.fragments.reversed(*way),
            };
            let Some(from_minus) = from_minus else {
                continue;
            };
            let known = self.truth.entry(end.fragment).or_insert(from_minus);
            if known.fragment != way.fragment {
                confused.insert(end.fragment);
            }
        }
        self.closures.wrong = self.closures.wrong.max(confused.len() as u32);
    }

    /// Loops count as closed too that were closed after the arrival, by another fragment or another map, and as missed those that are open on
    /// the map at the end, where a fragment is on it more than once.
    pub(super) fn closures_at_the_end(&self, map: &CpMap) -> Closures {
        let known = map.fragments().filter_map(|(id, _)| self.truth.get(&id));
        let mut fragments: Vec<u32> = known.map(|way| way.fragment).collect();
        let all = fragments.len();
        fragments.sort_unstable();
        fragments.dedup();
        let open = (all - fragments.len()) as u32;
        Closures {
            right: self.closures.right + self.closures.missed.saturating_sub(open),
            missed: open,
            ..self.closures
        }
    }

    /// The length of the shortest way from start to goal over the fragments that were walked, by observations.
    pub(super) fn shortest_as_it_lies(&self, maze: &Maze) -> Option<u32> {
        let (start, _) = maze.start()?;
        let node = |cell: Cell| maze.grid().index(cell) as u32;
        let walked = |(from, _, way): (Cell, Direction, Way)| {
            let length = self.lengths.get(&way.fragment)?;
            Some((node(from), node(way.to), *length))
        };
        let arcs: Vec<_> = self.fragments.ways().filter_map(walked).collect();
        let costs = costs_from(&Arcs::new(maze.grid().cell_count(), &arcs), [node(start)]);
        let goals = maze.goals().iter();
        goals.filter_map(|goal| costs[node(*goal) as usize]).min()
    }

    /// The length of a drive, in observations of the fragments it was along; none if one of them was not walked before.
    pub(super) fn length_of(&self, world: &World, path: &[Pose]) -> Option<u32> {
        let cells = path.iter().filter_map(|pose| world.cell_at(pose.position));
        let driven = self.fragments.driven(cells)?;
        let lengths = driven
            .iter()
            .map(|way| self.lengths.get(&way.fragment).copied());
        lengths.sum()
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::Heading;
    use tolman_maps::cpm::{CpmConfig, Dictionary, Explorer, PatternId, Sighting, Traversal};

    use super::*;

    /// A way from the start to a fork, from there to the goal, back, and home.
    #[test]
    fn a_walk_retraced_on_its_map_says_what_is_what() {
        let text = "start = 0 0 east\n\no---o---o---o\n|   |   |   |\no---o   o---o\n| S       G |\no---o---o---o\n";
        let maze = tolman_maze::read(text).unwrap().maze;
        let mut dictionary = Dictionary::new(1);
        let wall = dictionary.learn(&[1.0], &[1.0], 0.1).unwrap();
        let door = dictionary.learn(&[0.0], &[0.0], 0.1).unwrap();
        let mut explorer = Explorer::new(CpmConfig::robust(), Sighting::plain(1)).unwrap();
        let mut score = Score::of(&maze);
        let start = maze.start().unwrap().0;
        score.start = Some((explorer.at(), start));
        let fork = Cell::new(1, 0);
        let mut walk = |turn: Turn, patterns: &[PatternId], degree, from, heading| {
            let patterns = patterns.to_vec();
            let sighting = Sighting::plain(degree);
            let walk = Traversal {
                patterns,
                motion: None,
                sighting,
            };
            explorer.arrive(turn, &walk, &dictionary).unwrap();
            let way = score.fragments.way(from, Heading::from_degrees(heading));
            score.walked.push((turn, way));
        };
        walk(Turn::BACK, &[wall, wall, wall], 3, start, 0.0);
        walk(Turn(2), &[door, door, door], 1, fork, 0.0);
        walk(Turn::BACK, &[door, door, door], 3, Cell::new(2, 0), 180.0);
        walk(Turn(1), &[wall, wall, wall], 1, fork, 180.0);
        let map = explorer.map().clone();
        score.retrace(&map);
        assert_eq!(map.fragments().len(), 2);
        assert_eq!(score.truth.len(), 2);
        for (id, _) in map.fragments() {
            let (from, heading) = [(start, 0.0), (fork, 0.0)][id.0 as usize];
            let way = score.fragments.way(from, Heading::from_degrees(heading));
            assert_eq!(score.truth.get(&id).copied(), way);
        }
        assert_eq!(score.closures.wrong, 0);

        // Had the robot truly gone to the third corridor, the map would have taken two for one.
        score.walked[3].1 = score.fragments.way(fork, Heading::from_degrees(90.0));
        score.retrace(&map);
        assert_eq!(score.closures.wrong, 1);
    }
}
