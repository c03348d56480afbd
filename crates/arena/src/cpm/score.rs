use alloc::collections::{BTreeMap, BTreeSet};

use tolman_geom::Pose;
use tolman_maps::cpm::{CpMap, CpMapper, FragmentId, JunctionId, MapUpdate, Port, Sign, Turn};
use tolman_maze::{Cell, Maze};
use tolman_sim::World;
use tolman_systems::cpm::{FragmentStep, Layer3, Walker};

use super::fragments::{TrueFragments, WayOut};
use super::known_map::KnownMap;
use super::map_right::is_map_right;
use super::robots::SimulatedEpuck;
use super::run::CpmRun;

/// Loops closed in the first episode: arrivals by a way that was not on the map, at a fragment or
/// place that was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Closures {
    /// Number of right claims, on arrival or later: duplicates of that fragment, and loops to that
    /// place.
    pub right: u32,
    /// Number of arrivals at which a wrong or non-existent duplicate or loop was claimed, at once
    /// or by a map that became the likeliest later. Each counts once, even if it makes much of the
    /// map wrong or is corrected later.
    pub wrong: u32,
    /// Number of fragments that were walked again and are on the map at the end as another one.
    pub missed: u32,
}

/// Truth of a trial, for scoring.
pub(super) struct Score<'a> {
    fragments: TrueFragments,
    /// Number of loops closed rightly on arrival.
    right: u32,
    missed: u32,
    /// The numbers of the walks that closed a loop wrongly.
    wrong: BTreeSet<usize>,
    /// Starting point from which walks are retraced, or `None` if it is unknown.
    base: Option<Base>,
    /// All walks.
    walked: Vec<Walked>,
    /// The true way from − to + of each fragment of the map.
    pub(super) truth: BTreeMap<FragmentId, WayOut>,
    /// Cell of each place of the map.
    places: BTreeMap<JunctionId, Cell>,
    /// Number of observations of each true fragment on its first walk, by the fragment's number.
    pub(super) lengths: BTreeMap<u32, u32>,
    pub(super) known: KnownMap<'a>,
}

/// Common beginning of all maps that became the likeliest since. It is the start, or the point
/// where no hypothesis explained a walk and the mapper began again.
struct Base {
    /// The port behind the robot.
    at: Port,
    /// Number of walks before the starting point.
    walks: usize,
    truth: BTreeMap<FragmentId, WayOut>,
    places: BTreeMap<JunctionId, Cell>,
}

/// A walk to the end of a fragment, as it truly was.
struct Walked {
    turn: Turn,
    /// True fragment of the walk; `None` if the walk began on no fragment.
    way: Option<WayOut>,
    /// Cell where the walk ended.
    here: Option<Cell>,
}

impl<'a> Score<'a> {
    fn new(maze: &'a Maze) -> Self {
        Self {
            fragments: TrueFragments::of(maze),
            right: 0,
            missed: 0,
            wrong: BTreeSet::new(),
            base: None,
            walked: Vec::new(),
            truth: BTreeMap::new(),
            places: BTreeMap::new(),
            lengths: BTreeMap::new(),
            known: KnownMap::new(maze),
        }
    }

    /// Begins the score of a run at its start.
    pub(super) fn of(maze: &'a Maze, run: &CpmRun) -> Self {
        let body = run.walker.body();
        let start = body.path().first();
        let cell = start.and_then(|start| body.world().cell_at(start.position));
        let mut score = Self::new(maze);
        score.begin_at(run.layer.explorer.mapper.at(), cell);
        score
    }

    /// Adds a walk to the end of a fragment. A robot that looks for the goal never turns back
    /// inside one.
    pub(super) fn see(
        &mut self,
        layer: &Layer3,
        walker: &Walker<SimulatedEpuck>,
        step: &FragmentStep,
    ) {
        let Some(arrival) = step.arrival else {
            return;
        };
        let body = walker.body();
        let here = body.world().cell_at(body.truth().pose.position);
        let way = self.fragments.taken(walker);
        let length = (step.walked.observations.len() as u32).max(1);
        if let Some(here) = here {
            let way = way.filter(|way| way.to == here);
            let before = way.and_then(|way| self.lengths.get(&way.fragment));
            self.known.walk(way, here, *before.unwrap_or(&length));
        }
        let turn = step.leg.turn;
        let walked = Walked { turn, way, here };
        self.take_in(&layer.explorer.mapper, arrival, walked, length);
    }

    fn take_in(&mut self, mapper: &CpMapper, arrival: MapUpdate, walked: Walked, length: u32) {
        let Walked { way, here, .. } = walked;
        let number = self.walked.len();
        self.walked.push(walked);
        if let Some(way) = way {
            self.judge(mapper, arrival, number, way, here);
            self.lengths.entry(way.fragment).or_insert(length);
        }
        if arrival == MapUpdate::Contradiction {
            self.begin_at(mapper.at(), here);
        }
    }

    fn judge(
        &mut self,
        mapper: &CpMapper,
        arrival: MapUpdate,
        number: usize,
        way: WayOut,
        here: Option<Cell>,
    ) {
        let is_old = self.lengths.contains_key(&way.fragment);
        let told = mapper.map().end_at(mapper.at());
        let known = told.and_then(|end| self.truth.get(&end.fragment).copied());
        let is_same = known.is_some_and(|known| known.fragment == way.fragment);
        // The place that the map says it is at, where that is a place of the map.
        let junction = mapper.at().junction;
        let stands = self.places.get(&junction).copied();
        if let Some(here) = here {
            self.places.entry(junction).or_insert(here);
        }
        match arrival {
            MapUpdate::Revised => self.retrace(mapper.map()),
            MapUpdate::Duplicate if is_same => self.right += 1,
            MapUpdate::Loop if stands == here => self.right += 1,
            MapUpdate::Duplicate | MapUpdate::Loop => {
                self.wrong.insert(number);
            }
            MapUpdate::New if is_old => self.missed += 1,
            _ => {}
        }
        if let Some(end) = told {
            self.truth.entry(end.fragment).or_insert(way);
        }
    }

    /// Starts a map at a port, in a cell; keeps its known fragments and places.
    fn begin_at(&mut self, at: Port, cell: Option<Cell>) {
        self.base = cell.map(|cell| {
            self.places.insert(at.junction, cell);
            Base {
                at,
                walks: self.walked.len(),
                truth: self.truth.clone(),
                places: self.places.clone(),
            }
        });
    }

    /// Retraces the walks on a new map, which has its own names of fragments and places. The first
    /// arrival after which a fragment or a place stands for two true ones has closed a loop
    /// wrongly. Walks of a robot that was lost before do not count, as their errors follow from
    /// that.
    fn retrace(&mut self, map: &CpMap) {
        let Some(base) = &self.base else {
            return;
        };
        self.truth.clone_from(&base.truth);
        self.places.clone_from(&base.places);
        let mut at = base.at;
        let (mut two_fragments, mut two_places) = (BTreeSet::new(), BTreeSet::new());
        let mut is_astray = false;
        for (number, walked) in self.walked.iter().enumerate().skip(base.walks) {
            let exit = walked.turn.exit(at.number, map.degree(at.junction));
            let exit = exit.map(|number| at.junction.port(number));
            // On a map that broke off somewhere the walks cannot be retraced further.
            let Some((end, beyond)) = exit
                .ok()
                .and_then(|exit| Some((map.end_at(exit)?.opposite(), map.beyond(exit)?)))
            else {
                break;
            };
            at = beyond;
            let was_astray = is_astray;
            let mut is_wrong = false;
            if let Some(here) = walked.here {
                is_astray = *self.places.entry(at.junction).or_insert(here) != here;
                is_wrong |= is_astray && two_places.insert((at.junction, here));
            }
            let from_minus = walked.way.and_then(|way| match end.sign {
                Sign::Plus => Some(way),
                Sign::Minus => self.fragments.reversed(way),
            });
            if let Some(way) = from_minus {
                let known = self.truth.entry(end.fragment).or_insert(way);
                let is_other = known.fragment != way.fragment;
                is_wrong |= is_other && two_fragments.insert((end.fragment, way.fragment));
            }
            if is_wrong && !was_astray {
                self.wrong.insert(number);
            }
        }
    }

    /// Returns the closures at the end. Loops closed after the arrival, by another fragment or
    /// another map, count as closed. Fragments that the final map has more than once count as
    /// missed.
    pub(super) fn closures_at_the_end(&self, map: &CpMap) -> Closures {
        let known = map.fragments().filter_map(|(id, _)| self.truth.get(&id));
        let mut fragments: Vec<u32> = known.map(|way| way.fragment).collect();
        let all = fragments.len();
        fragments.sort_unstable();
        fragments.dedup();
        let open = (all - fragments.len()) as u32;
        Closures {
            right: self.right + self.missed.saturating_sub(open),
            wrong: self.wrong.len() as u32,
            missed: open,
        }
    }

    /// Returns whether a map is right for the fragments that were walked: each thing once, and
    /// joined as in the maze.
    pub(super) fn is_map_right(&self, map: &CpMap, maze: &Maze) -> bool {
        let walked = self.lengths.keys().copied().collect();
        is_map_right(map, maze, &self.fragments, &walked)
    }

    /// Returns the length of the shortest way from start to goal over walked fragments, in
    /// observations.
    pub(super) fn shortest_as_it_lies(&self, maze: &Maze) -> Option<u32> {
        let length = |way: WayOut| self.lengths.get(&way.fragment).copied();
        self.fragments.shortest(maze, length)
    }

    /// Returns the length of a drive, in observations of its fragments, or `None` if one of them
    /// was never walked.
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
    use tolman_maps::cpm::{CpMapperConfig, Dictionary, PatternId, Sighting, Traversal};

    use super::*;

    /// Walks from the start to a fork, from there to the goal, back, and home.
    #[test]
    fn a_walk_retraced_on_its_map_says_what_is_what() {
        let text = "start = 0 0 east\n\no---o---o---o\n|   |   |   |\no---o   o---o\n| S       G |\no---o---o---o\n";
        let maze = tolman_maze::read(text).unwrap().maze;
        let mut dictionary = Dictionary::new(1);
        let wall = dictionary.learn(&[1.0], &[1.0], 0.1).unwrap();
        let door = dictionary.learn(&[0.0], &[0.0], 0.1).unwrap();
        let mut mapper = CpMapper::new(CpMapperConfig::robust(), Sighting::plain(1)).unwrap();
        let mut score = Score::new(&maze);
        let start = maze.start().unwrap().0;
        score.begin_at(mapper.at(), Some(start));
        let fork = Cell::new(1, 0);
        let mut walk = |turn: Turn, patterns: &[PatternId], degree, from, heading| {
            let patterns = patterns.to_vec();
            let sighting = Sighting::plain(degree);
            let walk = Traversal {
                patterns,
                motion: None,
                sighting,
                bearings: None,
            };
            mapper.arrive(turn, &walk, &dictionary).unwrap();
            let way = score.fragments.way(from, Heading::from_degrees(heading));
            let here = way.map(|way| way.to);
            score.walked.push(Walked { turn, way, here });
        };
        walk(Turn::BACK, &[wall, wall, wall], 3, start, 0.0);
        walk(Turn(2), &[door, door, door], 1, fork, 0.0);
        walk(Turn::BACK, &[door, door, door], 3, Cell::new(2, 0), 180.0);
        walk(Turn(1), &[wall, wall, wall], 1, fork, 180.0);
        let map = mapper.map().clone();
        score.retrace(&map);
        assert_eq!(map.fragments().len(), 2);
        assert_eq!(score.truth.len(), 2);
        for (id, _) in map.fragments() {
            let (from, heading) = [(start, 0.0), (fork, 0.0)][id.0 as usize];
            let way = score.fragments.way(from, Heading::from_degrees(heading));
            assert_eq!(score.truth.get(&id).copied(), way);
        }
        assert!(score.wrong.is_empty());

        // Had the robot truly gone to the third corridor, the map would have taken two for one, and
        // their ends.
        let third = score.fragments.way(fork, Heading::from_degrees(90.0));
        let home = (score.walked[3].way, score.walked[3].here);
        (score.walked[3].way, score.walked[3].here) = (third, third.map(|way| way.to));
        score.retrace(&map);
        assert_eq!(score.wrong, BTreeSet::from([3]));

        // Had it come to another fork, all else would follow from that.
        score.wrong.clear();
        score.walked[2].here = Some(Cell::new(1, 1));
        score.retrace(&map);
        assert_eq!(score.wrong, BTreeSet::from([2]));

        // The place alone may be another.
        score.wrong.clear();
        (score.walked[3].way, score.walked[3].here) = home;
        score.retrace(&map);
        assert_eq!(score.wrong, BTreeSet::from([2]));

        // Home again, that is of two ways now: nothing explains it, and the mapper begins again.
        score.walked[2].here = Some(fork);
        score.wrong.clear();
        score.retrace(&map);
        let mut take_in = |turn: Turn, degree, from, heading| {
            let walk = Traversal {
                patterns: vec![wall, wall, wall],
                motion: None,
                sighting: Sighting::plain(degree),
                bearings: None,
            };
            let arrival = mapper.arrive(turn, &walk, &dictionary).unwrap();
            let way = score.fragments.way(from, Heading::from_degrees(heading));
            let here = way.map(|way| way.to);
            score.take_in(&mapper, arrival, Walked { turn, way, here }, 3);
            arrival
        };
        assert_eq!(take_in(Turn::BACK, 3, start, 0.0), MapUpdate::Known);
        let strange = take_in(Turn::BACK, 2, fork, 90.0);
        assert_eq!(strange, MapUpdate::Contradiction);
        take_in(Turn::BACK, 3, Cell::new(1, 1), 270.0);
        let before = score.truth.clone();
        assert_eq!(before.len(), 3);
        score.retrace(mapper.map());
        assert!(score.wrong.is_empty(), "{:?}", score.wrong);
        assert_eq!(score.truth, before);
        assert_eq!(score.places.get(&mapper.at().junction), Some(&fork));
    }
}
