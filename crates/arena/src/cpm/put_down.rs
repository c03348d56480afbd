use core::ops::ControlFlow;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::{CpMap, End, Environments, FragmentId, Location, Sign};
use tolman_robot::Standing;
use tolman_sim::robots::{Epuck, EpuckConfig};
use tolman_systems::cpm::{
    Approach, CommonPatterns, CpmFailure, Relocalization, Walker, Whereabouts,
};

use super::fragments::{TrueFragments, WayOut};
use super::robots::walker_config;
use super::spots::{Looks, Spot, knowable};
use super::trial::TrialRecord;
use crate::BoxError;
use crate::course::Course;
use crate::run::until_done;

/// Puts a robot that knows some mazes down in the middle of a fragment of one of them. The robot
/// has to find its place.
///
/// [`play`](Self::play) puts the robot into maze `here` by its seed. It stands in the middle of a
/// cell inside a fragment that the map has, and looks along it.
#[derive(Clone, Debug)]
pub struct PutDown<'a> {
    /// The mazes that the robot knows, all with one width of corridors and learned with the same
    /// patterns.
    pub known: &'a [KnownMaze<'a>],
    /// Number of the maze into which the robot is put, an index into `known`.
    pub here: usize,
    /// Patterns that the robot learned before.
    pub patterns: &'a CommonPatterns,
    /// Configuration of the robot.
    pub robot: EpuckConfig,
    /// Way of the robot to the first place.
    pub approach: Approach,
    /// Number of places, from the one ahead on, after which the robot has to know where it is; at
    /// least 1.
    pub most_places: u32,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// A maze that a robot knows.
#[derive(Clone, Copy, Debug)]
pub struct KnownMaze<'a> {
    /// Maze that the robot knows.
    pub course: &'a Course,
    /// The trial in which the robot learned its map of the maze.
    pub learned: &'a TrialRecord,
}

/// Result of a put-down.
#[derive(Clone, Debug)]
pub struct PutDownRecord {
    /// Belief of the robot.
    pub whereabouts: Whereabouts,
    /// Probability that an ideal observer would know maze, fragment and direction before the first
    /// place, by the corridor's bends, 0 to 1.
    pub knowable_by_bends: f64,
    /// Probability that such an observer would know maze, fragment and direction if it saw more, 0
    /// to 1. It also sees the place ahead, and the side ways of a place behind that it stands
    /// beside. No robot knows more on average.
    pub knowable_by_places: f64,
    /// Whether the robot knew maze, fragment and direction before the first place; false if it had
    /// observed nothing.
    pub is_right_under_way: bool,
    /// Whether the robot was right at the first place.
    pub is_right_at_first_place: bool,
    /// Whether the robot was right within one further fragment (section 8). A robot that was sure
    /// at the first place is judged there, others before the next place.
    pub is_right_within_one_further: bool,
    /// Whether the robot was right at the last place, where it was sure or gave up.
    pub is_right_at_last: bool,
    /// Whether SOINN-AM recalled the right maze of the first fragment walked whole, or `None` if
    /// the robot knew before where it was.
    pub is_recalled: Option<bool>,
    /// Duration of the search, s.
    pub seconds: f64,
}

impl KnownMaze<'_> {
    /// Returns the spots inside the fragments that the map knows, where a robot may be put down.
    fn spots(&self) -> Vec<Spot> {
        Spot::all(&self.course.maze, |way| {
            let mut known = self.learned.truth.values();
            known.any(|truth| truth.fragment == way.fragment)
        })
    }
}

impl PutDown<'_> {
    /// Plays the run and returns the record; `None` if the map has no fragment that is long enough
    /// to be put down in.
    ///
    /// # Errors
    /// If the robot cannot be put down, or cannot go on.
    pub fn play(&self) -> Result<Option<PutDownRecord>, BoxError> {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let Some(known) = self.known.get(self.here) else {
            return Ok(None);
        };
        let course = known.course;
        let fragments = TrueFragments::of(&course.maze);
        let mazes: Vec<Vec<Spot>> = self.known.iter().map(KnownMaze::spots).collect();
        let spots = mazes.get(self.here).map(Vec::as_slice).unwrap_or_default();
        if spots.is_empty() {
            return Ok(None);
        }
        let spot = &spots[rng.random_range(0..spots.len() as u32) as usize];
        let body = course.robot_at(
            spot.pose(course),
            Epuck::new(self.robot.clone())?,
            self.seed,
        )?;
        let config = walker_config(&self.robot, course.corridor_width)?;
        let mut walker = Walker::new(body, config);
        let maps = self.known.iter().map(|known| known.learned.map.clone());
        let maps: Vec<CpMap> = maps.collect();
        let mut search =
            Relocalization::new(&maps, self.patterns, self.approach, self.most_places)?;
        // The ways that it came by to each place. Those to the first place, from mid-fragment, are
        // not compared.
        let mut onward = Vec::new();
        until_done(&mut walker, |walker| {
            let flow = search.advance(walker, &mut rng)?;
            onward.push(fragments.taken(walker));
            Ok::<_, CpmFailure<_>>(match flow {
                ControlFlow::Continue(()) => Standing::UnderWay,
                ControlFlow::Break(()) => Standing::Done,
            })
        })?;
        let whereabouts = search.found().clone();
        let begun = WayOut {
            is_forward: spot.way.is_forward != whereabouts.has_turned_round,
            ..spot.way
        };
        let way_to = |place: usize| match place {
            0 => Some(begun),
            place => onward.get(place).copied().flatten(),
        };
        let is_right = |location: Option<Location>, place: usize| {
            let (Some(location), Some(way)) = (location, way_to(place)) else {
                return false;
            };
            let truth = known.learned.truth.get(&location.enter.fragment);
            location.map == self.here
                && truth.is_some_and(|truth| {
                    let is_along = truth.is_forward == way.is_forward;
                    truth.fragment == way.fragment
                        && is_along == (location.enter.sign == Sign::Minus)
                })
        };
        let is_right_at = |place: usize| is_right(whereabouts.at_places.get(place).copied(), place);
        let is_right_before =
            |place: usize| is_right(whereabouts.under_way.get(place).copied().flatten(), place);
        let is_right_at_first_place = is_right_at(0);
        let last = whereabouts.at_places.len().saturating_sub(1);
        let knowable_by = |looks| knowable(&mazes, self.here, spot, self.approach, looks);
        Ok(Some(PutDownRecord {
            knowable_by_bends: knowable_by(Looks::AtBends),
            knowable_by_places: knowable_by(Looks::AtPlaces),
            is_right_under_way: is_right_before(0),
            is_right_at_first_place,
            is_right_within_one_further: if last == 0 {
                is_right_at_first_place
            } else {
                is_right_before(1)
            },
            is_right_at_last: is_right_at(last),
            is_recalled: self.recalled(&whereabouts)?,
            seconds: walker.time_us() as f64 * 1e-6,
            whereabouts,
        }))
    }

    /// Returns whether the fourth layer recalls the maze.
    fn recalled(&self, whereabouts: &Whereabouts) -> Result<Option<bool>, BoxError> {
        let Some(walked) = whereabouts.walks.first() else {
            return Ok(None);
        };
        let dictionary = self.patterns.dictionary();
        let mut memory = Environments::new(dictionary)?;
        for (environment, known) in (0_u32..).zip(self.known) {
            let map = &known.learned.map;
            let fragments = map.fragments();
            let seen = fragments.filter(|(_, fragment)| !fragment.patterns.is_empty());
            let ids: Vec<FragmentId> = seen.map(|(id, _)| id).collect();
            // One fragment alone is associated with nothing.
            if ids.len() < 2 {
                return Ok(None);
            }
            for sign in Sign::BOTH {
                let path: Vec<End> = ids.iter().map(|id| id.end(sign)).collect();
                memory.learn(environment, map, &path, dictionary)?;
            }
        }
        let sequence = self.patterns.patterns(walked);
        if sequence.is_empty() {
            return Ok(None);
        }
        let recalled = memory.recall(&sequence, dictionary)?;
        Ok(Some(recalled.environment as usize == self.here))
    }
}
