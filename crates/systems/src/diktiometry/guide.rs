use alloc::collections::BTreeMap;
use alloc::format;
use core::ops::ControlFlow;

use rand_chacha::ChaCha8Rng;
use tolman_geom::{Point, PointBox};
use tolman_maps::diktiometry::{
    Action, Config, FirstPlace, Identity, MapState, ObservedMove, Observer, PlaceId, PlanStep,
    Signature, WorldKind,
};
use tolman_maze::Direction;
use tolman_planners::path_to;
use tolman_robot::{Goal, Landmark, Standing, Task};

use super::{
    Approach, Arrival, ExploreUntil, LandmarkSpot, MapError, MappedMove, Planner, Reason,
    RefusedMove, Rover, approach, first_place, is_at_goal, observed,
};
use crate::brain::NO_POINTS;
use crate::stream;

/// Chooses the next move of a task by the map of a rover. It knows no robot.
#[derive(Clone, Debug)]
pub(super) struct Guide {
    observer: Option<Observer>,
    /// Whether a way leads on from the rover's place in each direction, by [`Direction::index`].
    exits: [bool; 4],
    /// View of the place where the rover stopped.
    look: Option<Signature>,
    until: ExploreUntil,
    whereabouts: Whereabouts,
    /// Direction in which a routine began that broke off between two places.
    under_way: Option<Direction>,
    /// Whether that routine has turned back.
    is_turned: bool,
    planner: Planner,
    walk: ChaCha8Rng,
    /// Reason of the walk for the direction chosen last.
    reason: Option<Reason>,
    /// Last move; `None` where the map begins.
    last: Option<MappedMove>,
    /// Places that the rover visited, by their ids at that time; `None` for places of a dropped
    /// map.
    visited: Vec<Option<PlaceId>>,
    /// Where each landmark was sensed, the last spot last, by the places' ids at that time.
    landmarks: BTreeMap<Landmark, Vec<LandmarkSpot>>,
    /// Number of moves so far.
    moves: u32,
    /// Number of the last move along each way, in either direction, by the place's id at that time.
    gone: BTreeMap<(PlaceId, Direction), u32>,
    /// Landmark that is looked for on known ground, and the move at which that began.
    patrol: Option<(Landmark, u32)>,
    /// Doubtful state of the map, and the move at which it began.
    doubt: Option<(MapState, u32)>,
    /// Whether the rover was carried elsewhere since the map began.
    is_carried: bool,
    /// Whether the guide began the map.
    is_own_map: bool,
}

/// Number of moves between two checks of what speaks against the map.
const CHECKED: u32 = 10;

/// Number of moves per place without folding after which a map is given up: nearly all maps that
/// fold do so sooner.
const PATIENCE: u32 = 5;
const MOST_PATIENCE: u32 = 300;

/// Number of moves for which a map may contradict itself before it is given up. Bounds that hold do
/// not repair contradictions.
const MOST_CONTRADICTED: u32 = 20;

/// Knowledge of the rover's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Whereabouts {
    /// The map has followed the rover long enough, or began at its place.
    Followed,
    /// The rover was set down at a place and has looked round.
    SetDown {
        /// Number of moves since.
        moves: usize,
    },
    /// The rover may be anywhere, and has not looked round yet.
    Unknown,
}

impl Whereabouts {
    /// Returns whether the rover moved since it was set down.
    const fn has_moved(self) -> bool {
        matches!(self, Self::Followed | Self::SetDown { moves: 1.. })
    }

    /// Returns the whereabouts after a move, where confidence rests on the last `history` matches.
    const fn after_a_move(self, history: usize) -> Self {
        match self {
            Self::SetDown { moves } if moves + 1 < history => Self::SetDown { moves: moves + 1 },
            Self::SetDown { .. } | Self::Followed | Self::Unknown => Self::Followed,
        }
    }
}

/// Direction to the next place, or the standing of the task if nothing is left to do.
pub(super) type Next = ControlFlow<Standing, Direction>;

/// Stream of the random walk.
const WALK_STREAM: u64 = 1;

impl Guide {
    pub(super) fn new(
        observer: Option<Observer>,
        until: ExploreUntil,
        heed: f64,
        seed: u64,
    ) -> Self {
        Self {
            observer,
            exits: [false; 4],
            look: None,
            until,
            whereabouts: Whereabouts::Unknown,
            under_way: None,
            is_turned: false,
            planner: Planner::new(heed),
            walk: stream(seed, WALK_STREAM),
            reason: None,
            last: None,
            visited: Vec::new(),
            landmarks: BTreeMap::new(),
            moves: 0,
            gone: BTreeMap::new(),
            patrol: None,
            doubt: None,
            is_carried: false,
            is_own_map: false,
        }
    }

    pub(super) const fn observer(&self) -> Option<&Observer> {
        self.observer.as_ref()
    }

    pub(super) const fn last(&self) -> Option<&MappedMove> {
        self.last.as_ref()
    }

    pub(super) fn visited(&self) -> &[Option<PlaceId>] {
        &self.visited
    }

    /// Takes in a move that the guide did not choose. Without a map it begins one of this
    /// configuration, at an unknown place.
    pub(super) fn observe(
        &mut self,
        seen: &ObservedMove,
        config: &Config,
    ) -> Result<(), RefusedMove> {
        self.whereabouts = Whereabouts::Unknown;
        let observer = match &mut self.observer {
            Some(observer) => observer,
            none => none.insert(Observer::new(config.clone(), FirstPlace::default())?),
        };
        if self.visited.is_empty() {
            self.visited.push(Some(observer.place()));
        }
        observer.step(seen)?;
        self.visited.push(Some(observer.place()));
        Ok(())
    }

    /// Makes the next move of `task` with `rover`.
    pub(super) fn act<V: Rover>(
        &mut self,
        rover: &mut V,
        config: &Config,
        task: Task,
    ) -> Result<Standing, MapError<V::Error>> {
        let begins_again = task == Task::Explore && self.drops_map();
        self.find_footing(rover, config)?;
        let place = self.observer().map(Observer::place);
        if begins_again {
            self.visited.fill(None);
            self.visited.push(place);
            return Ok(Standing::UnderWay);
        }
        if self.visited.is_empty() && place.is_some() {
            self.visited.push(place);
        }
        let before = rover.landmark();
        let direction = match self.under_way {
            Some(_) if is_at_goal(task, before) => return Ok(Standing::Done),
            Some(way) => {
                let left_behind = rover.left_behind();
                self.is_turned |= left_behind.is_some_and(|off| self.turns_back(task, way, off));
                way
            }
            None => {
                self.recognize(before);
                match self.next(task, before) {
                    Next::Continue(direction) => direction,
                    Next::Break(standing) => return Ok(standing),
                }
            }
        };
        let end = place.and_then(|place| self.end_of(place, direction));
        if !self.go(rover, direction)? {
            return Ok(Standing::UnderWay);
        }
        let arrived = self.observer().map(Observer::place);
        self.visited.push(arrived);
        let here = rover.landmark();
        if let Some(place) = place {
            let passed = rover.passed();
            let amid = passed
                .iter()
                .filter(|passed| ![before, here].contains(&Some(**passed)));
            for landmark in amid {
                self.remember(*landmark, LandmarkSpot::Way(place, direction));
            }
            if let (Task::Reach(Goal::Landmark(landmark)), Some(end)) = (task, end)
                && arrived == Some(end)
                && !passed.contains(&landmark)
            {
                self.forget(landmark, LandmarkSpot::Way(place, direction));
                self.forget(landmark, LandmarkSpot::Way(end, direction.opposite()));
            }
        }
        self.recognize(here);
        if self.is_done(task, here) {
            return Ok(Standing::Done);
        }
        Ok(Standing::UnderWay)
    }

    /// Lets `rover` look round if its place is unknown. From mid-corridor it first goes to a place,
    /// without the map. A rover that makes a number of moves is at a place.
    fn find_footing<V: Rover>(
        &mut self,
        rover: &mut V,
        config: &Config,
    ) -> Result<(), MapError<V::Error>> {
        if self.whereabouts != Whereabouts::Unknown {
            return Ok(());
        }
        if self.until == ExploreUntil::Whole {
            leave_corridor(rover).map_err(MapError::Robot)?;
        }
        let seen = rover.look().map_err(MapError::Robot)?;
        if self.observer.is_none() {
            let start = first_place(config, &seen);
            self.observer = Some(Observer::new(config.clone(), start)?);
            self.is_own_map = true;
            self.whereabouts = Whereabouts::Followed;
        } else {
            self.whereabouts = Whereabouts::SetDown { moves: 0 };
        }
        (self.exits, self.look) = (seen.exits, seen.look);
        Ok(())
    }

    /// Drops a map of its own during which the rover was carried elsewhere, and returns whether it
    /// did. The next map begins at the rover's place. Not by the paper's rule of matching.
    fn drops_map(&mut self) -> bool {
        let is_by_the_paper = self.observer().is_some_and(is_by_the_paper);
        if !(self.is_carried && self.is_own_map) || is_by_the_paper {
            return false;
        }
        self.observer = None;
        (self.under_way, self.last, self.doubt, self.is_carried) = (None, None, None, false);
        self.whereabouts = Whereabouts::Unknown;
        self.landmarks.clear();
        self.gone.clear();
        self.patrol = None;
        self.planner.drop_script();
        true
    }

    /// Remembers that the rover senses `landmark` at its place.
    fn recognize(&mut self, landmark: Option<Landmark>) {
        if let (Some(landmark), Some(observer)) = (landmark, self.observer()) {
            let place = observer.place();
            self.remember(landmark, LandmarkSpot::Place(place));
        }
    }

    /// Remembers that the rover broke off at `landmark`, on the way that is under way.
    pub(super) fn broke_off_at(&mut self, landmark: Landmark) {
        if let (Some(way), Some(observer)) = (self.under_way, self.observer()) {
            let place = observer.place();
            self.remember(landmark, LandmarkSpot::Way(place, way));
        }
    }

    /// Remembers where `landmark` is, beside where else it was.
    pub(super) fn remember(&mut self, landmark: Landmark, spot: LandmarkSpot) {
        self.forget(landmark, spot);
        self.landmarks.entry(landmark).or_default().push(spot);
    }

    /// Lets `rover` go in `direction`, and updates the map. Returns whether it went. If its view
    /// has changed since it stopped, it was carried elsewhere and does not go. Nobody carries a
    /// rover that makes a number of moves.
    fn go<V: Rover>(
        &mut self,
        rover: &mut V,
        direction: Direction,
    ) -> Result<bool, MapError<V::Error>> {
        let begins = self.under_way.is_none();
        if begins && self.until == ExploreUntil::Whole && !self.is_where_it_was(rover)? {
            self.is_carried = true;
            self.whereabouts = Whereabouts::Unknown;
            return Ok(false);
        }
        let Some(observer) = &mut self.observer else {
            return Ok(false);
        };
        // If the rover breaks off, it stands between two places.
        self.under_way = Some(direction);
        let way = match self.is_turned {
            true => direction.opposite(),
            false => direction,
        };
        let arrival = rover.go(way).map_err(MapError::Robot)?;
        self.under_way = None;
        if core::mem::take(&mut self.is_turned) && is_back(&arrival, observer.config()) {
            (self.exits, self.look) = (arrival.exits, arrival.look);
            return Ok(true);
        }
        let from = observer.place();
        let report = observer.step(&observed(observer.config(), direction, &arrival))?;
        let ends = [(from, direction), (observer.place(), direction.opposite())];
        (self.exits, self.look) = (arrival.exits, arrival.look.clone());
        self.last = Some(MappedMove {
            direction,
            reason: self.reason.take(),
            arrival,
            report,
        });
        let history = observer.config().tracks.history;
        self.whereabouts = self.whereabouts.after_a_move(history);
        self.moves = self.moves.saturating_add(1);
        self.gone.extend(ends.map(|end| (end, self.moves)));
        if self.moves.is_multiple_of(CHECKED) {
            self.doubt = self.doubted();
        }
        Ok(true)
    }

    /// Lets `rover` look, and returns whether it sees the same as when it stopped. Views are
    /// compared if it has any. Ways that lead on are compared if the world is static.
    fn is_where_it_was<V: Rover>(&self, rover: &mut V) -> Result<bool, MapError<V::Error>> {
        let seen = rover.look().map_err(MapError::Robot)?;
        Ok(self.observer().is_none_or(|observer| {
            let config = observer.config();
            let has_other_exits = config.world == WorldKind::Static && seen.exits != self.exits;
            let (now, before) = (seen.look.as_ref(), self.look.as_ref());
            !has_other_exits && config.percepts.are_alike(now, before)
        }))
    }

    /// Returns the objection to the map and the number of moves when it arose, or `None` without
    /// one.
    fn doubted(&self) -> Option<(MapState, u32)> {
        let observer = self.observer()?;
        let state = match self.until {
            ExploreUntil::Whole => objection(observer)?,
            ExploreUntil::Moves(_) if observer.grows_without_end() => MapState::Endless,
            ExploreUntil::Moves(_) | ExploreUntil::Never => return None,
        };
        let before = self.doubt.filter(|(before, _)| *before == state);
        Some(before.unwrap_or((state, self.moves)))
    }

    /// Returns the next step of `task`, if the rover senses the landmark `here`.
    fn next(&mut self, task: Task, here: Option<Landmark>) -> Next {
        self.reason = None;
        if self.is_done(task, here) {
            return Next::Break(Standing::Done);
        }
        match task {
            Task::Explore if self.is_carried => give_up(
                "the robot was carried elsewhere while it learned: what it saw where it stopped is not what it saw when it set off again",
            ),
            Task::Explore if self.is_out_of_patience() => self.give_the_map_up(),
            Task::Explore | Task::Localize => self.wander(),
            Task::Reach(Goal::Place(id)) => self.reach(PlaceId(id)),
            Task::Reach(Goal::Point(_)) => give_up(NO_POINTS),
            Task::Reach(Goal::Landmark(landmark)) => self.seek(landmark),
        }
    }

    /// Returns whether `task` is done, if the rover senses the landmark `here`.
    fn is_done(&self, task: Task, here: Option<Landmark>) -> bool {
        let Some(observer) = self.observer() else {
            return false;
        };
        match task {
            Task::Explore => match self.until {
                ExploreUntil::Whole => {
                    !self.is_carried && is_explored(observer) && objection(observer).is_none()
                }
                ExploreUntil::Moves(moves) => self.moves >= moves,
                ExploreUntil::Never => false,
            },
            Task::Localize => self.whereabouts == Whereabouts::Followed && is_sure(observer),
            Task::Reach(Goal::Point(_)) => false,
            Task::Reach(Goal::Landmark(_)) => is_at_goal(task, here),
            Task::Reach(Goal::Place(id)) => {
                let place = observer.map().paths.resolve(PlaceId(id));
                self.whereabouts.has_moved() && place == Some(observer.place())
            }
        }
    }

    fn is_out_of_patience(&self) -> bool {
        let Some(((state, since), observer)) = self.doubt.zip(self.observer()) else {
            return false;
        };
        let places = observer.map().paths.places().count() as u32;
        let patience = match state {
            MapState::Contradictory => MOST_CONTRADICTED,
            MapState::Endless => 0,
            _ => (PATIENCE * places).min(MOST_PATIENCE),
        };
        self.moves - since >= patience
    }

    fn give_the_map_up(&self) -> Next {
        let complaint = self
            .observer()
            .and_then(|observer| observer.self_check().complaint());
        give_up(&complaint.unwrap_or_default())
    }

    /// Takes the next step of the planner's walk. While the map is not folded, the walk turns back
    /// in dead ends only: a loop folds for who goes round it.
    fn wander(&mut self) -> Next {
        let goes_round = matches!(self.doubt, Some((MapState::Unfolded, _)));
        let decision = self.observer.as_ref().and_then(|observer| {
            let mut exits = self.exits;
            let came = self.last.as_ref().filter(|_| goes_round);
            if let Some(back) = came.map(|last| last.direction.opposite().index())
                && exits.iter().filter(|is_open| **is_open).count() > 1
            {
                exits[back] = false;
            }
            self.planner.choose(observer, &exits, &mut self.walk)
        });
        let Some(decision) = decision else {
            return give_up("no way leads on from where it stands");
        };
        self.reason = Some(decision.reason);
        Next::Continue(decision.direction)
    }

    /// Follows the plan to a place of the map.
    fn reach(&mut self, to: PlaceId) -> Next {
        let Some(observer) = self.observer() else {
            return give_up("it has no map");
        };
        let paths = &observer.map().paths;
        let Some(to) = paths.resolve(to) else {
            return give_up(&format!("place {} is not on the map", to.0));
        };
        let from = observer.place();
        if from == to {
            // It was put down and believes that it is there: a move will tell.
            return self.wander();
        }
        let plan = observer.plan(from, to).unwrap_or_default();
        let Some(direction) = first_direction(&plan) else {
            let (from, to) = (from.0, to.0);
            return give_up(&format!("no way is known from place {from} to place {to}"));
        };
        self.planner.drop_script();
        Next::Continue(direction)
    }

    /// Returns the place to which the way in a direction led; `None` if it was never gone.
    fn end_of(&self, place: PlaceId, way: Direction) -> Option<PlaceId> {
        let mut links = self.observer()?.map().paths.likely(place);
        let link = links.find(|(_, link)| link.action == Action(way.index() as u32));
        link.map(|(_, link)| link.to)
    }

    /// Returns whether a rover that broke off on its way in a direction, `off` m from the rover's
    /// place, is nearer to the goal of `task` by that place than by the end of the way.
    fn turns_back(&self, task: Task, way: Direction, off: f64) -> bool {
        let (Task::Reach(goal), Some(observer)) = (task, self.observer()) else {
            return false;
        };
        let place = observer.place();
        let Some(end) = self.end_of(place, way) else {
            return false;
        };
        let metres = |from| match goal {
            Goal::Place(id) => approach(observer, &self.exits, from, PlaceId(id)),
            Goal::Landmark(landmark) => self.route(from, landmark),
            Goal::Point(_) => None,
        };
        let ahead = observer.map().distance(place, end) - off;
        let ways = metres(place).zip(metres(end));
        ways.is_some_and(|(back, on)| off + back.metres < ahead + on.metres)
    }

    /// Follows the plan to the nearest spot of a landmark that is not sensed here. If none is
    /// known, goes where it has never been.
    fn seek(&mut self, landmark: Landmark) -> Next {
        if let Some(place) = self.observer().map(Observer::place) {
            self.forget(landmark, LandmarkSpot::Place(place));
            let route = self.route(place, landmark);
            if let Some(direction) = route.and_then(|route| route.first) {
                self.planner.drop_script();
                return Next::Continue(direction);
            }
        }
        if self.observer().is_some_and(is_explored) {
            return self.patrol(landmark);
        }
        self.go_to_unknown().unwrap_or_else(|| self.wander())
    }

    /// Looks for a landmark where it was not for longest. Gives up once it has gone all ways from a
    /// place since it began.
    fn patrol(&mut self, landmark: Landmark) -> Next {
        let moves = self.moves;
        let begun = match self.patrol {
            Some((sought, begun)) if sought == landmark => begun,
            _ => self.patrol.insert((landmark, moves)).1,
        };
        let Some(place) = self.observer().map(Observer::place) else {
            return give_up("it has no map");
        };
        let open = Direction::ALL
            .into_iter()
            .filter(|way| self.exits[way.index()]);
        let gone = |way: &Direction| self.gone.get(&(place, *way)).copied().unwrap_or(0);
        match open.min_by_key(gone) {
            Some(way) if gone(&way) <= begun => {
                self.planner.drop_script();
                Next::Continue(way)
            }
            _ => {
                self.patrol = None;
                give_up("the landmark is nowhere that it can reach")
            }
        }
    }

    /// Returns the shortest route from a place to a spot of a landmark, up to the last place before
    /// it; `None` if there is none to any.
    fn route(&self, from: PlaceId, landmark: Landmark) -> Option<Approach> {
        let observer = self.observer()?;
        let routes = self.spots_of(landmark).filter_map(|spot| {
            let (place, last) = match spot {
                LandmarkSpot::Place(place) => (place, None),
                LandmarkSpot::Way(place, way) => (place, Some(way)),
            };
            let Approach { first, metres } = approach(observer, &self.exits, from, place)?;
            let first = first.or(last);
            Some(Approach { first, metres })
        });
        routes.min_by(|one, other| one.metres.total_cmp(&other.metres))
    }

    /// Forgets that a landmark is at a spot.
    fn forget(&mut self, landmark: Landmark, spot: LandmarkSpot) {
        let left = self.spots_of(landmark).filter(|known| *known != spot);
        let left = left.collect();
        self.landmarks.insert(landmark, left);
    }

    /// Takes the next step to an action that was never tried; `None` if no such step leads on from
    /// here.
    fn go_to_unknown(&mut self) -> Option<Next> {
        let advice = self.observer()?.go_to_unknown()?;
        let Action(first) = *advice.script.first()?;
        let direction = *Direction::ALL.get(first as usize)?;
        if !self.exits[direction.index()] {
            return None;
        }
        self.planner.drop_script();
        self.reason = Some(Reason::Advice(advice));
        Some(Next::Continue(direction))
    }

    /// Returns the spot where `landmark` was sensed last, by the place's present id: a place, if
    /// there is one.
    pub(super) fn spot_of(&self, landmark: Landmark) -> Option<LandmarkSpot> {
        let is_place = |spot: &LandmarkSpot| matches!(spot, LandmarkSpot::Place(_));
        let spots = || self.spots_of(landmark);
        spots().filter(is_place).last().or_else(|| spots().last())
    }

    /// Returns all spots where `landmark` was sensed, by the places' present ids.
    fn spots_of(&self, landmark: Landmark) -> impl Iterator<Item = LandmarkSpot> + '_ {
        let paths = self.observer().map(|observer| &observer.map().paths);
        let spots = self.landmarks.get(&landmark).into_iter().flatten();
        spots.filter_map(move |spot| {
            Some(match *spot {
                LandmarkSpot::Place(place) => LandmarkSpot::Place(paths?.resolve(place)?),
                LandmarkSpot::Way(place, way) => LandmarkSpot::Way(paths?.resolve(place)?, way),
            })
        })
    }

    /// Returns the landmarks at places, with the present ids of the places.
    pub(super) fn landmarks(&self) -> impl Iterator<Item = (Landmark, PlaceId)> + '_ {
        let all = self.landmarks.keys();
        all.filter_map(|landmark| match self.spot_of(*landmark)? {
            LandmarkSpot::Place(place) => Some((*landmark, place)),
            LandmarkSpot::Way(..) => None,
        })
    }

    /// Returns a description of its situation in a few words.
    pub(super) fn words(&self) -> String {
        let Some(observer) = self.observer() else {
            return String::new();
        };
        let place = observer.place().0;
        let is_between = self.under_way.is_some() || self.whereabouts == Whereabouts::Unknown;
        let at = match observer.tracks().len() {
            _ if is_between => "between places".to_owned(),
            1 => format!("at place {place}"),
            tracks => format!("at place {place}, or at one of {} others", tracks - 1),
        };
        match self.doubt.and_then(|_| observer.self_check().complaint()) {
            Some(complaint) => format!("{at}; {complaint}"),
            None => at,
        }
    }
}

/// Goes to another place from a place that is a doorway at best: only two ways lead on, in opposite
/// directions.
fn leave_corridor<V: Rover>(rover: &mut V) -> Result<(), V::Error> {
    let way = match rover.look()?.exits {
        [true, false, true, false] => Direction::North,
        [false, true, false, true] => Direction::East,
        _ => return Ok(()),
    };
    rover.go(way).map(|_| ())
}

pub(super) fn give_up(why: &str) -> Next {
    Next::Break(Standing::gave_up(why))
}

/// Returns whether places are matched by the paper's rule.
fn is_by_the_paper(observer: &Observer) -> bool {
    observer.config().matching.identity == Identity::Meets
}

/// Returns the state of the map if it is doubtful; `None` by the paper's rule of matching, which
/// does not check it.
fn objection(observer: &Observer) -> Option<MapState> {
    if is_by_the_paper(observer) {
        return None;
    }
    let state = observer.self_check().state();
    match state {
        MapState::Whole | MapState::Unfinished => None,
        MapState::Unfolded | MapState::Endless | MapState::Contradictory => Some(state),
    }
}

/// Returns whether a rover that turned back is where it began. Else the way back has been shut, and
/// it has come to a dead end.
fn is_back(arrival: &Arrival, config: &Config) -> bool {
    let around = PointBox::about(Point::origin(), 2.0 * config.place_radius);
    around.is_ok_and(|around| (arrival.moved + around).contains(Point::origin()))
}

/// Returns whether nothing is left to try at any place that a plan leads to. O(places + links ·
/// log places).
fn is_explored(observer: &Observer) -> bool {
    let is_new = |place| !observer.untried(PlaceId(place)).is_empty();
    path_to(&observer.map().paths, observer.place().0, is_new).is_none()
}

/// Returns whether exactly one hypothesis of the robot's place is confident.
fn is_sure(observer: &Observer) -> bool {
    let high = observer.config().tracks.high;
    let confident = observer.tracks().iter();
    let confident = confident.take_while(|track| track.confidence >= high);
    confident.count() == 1
}

/// Returns the first direction of a plan.
fn first_direction(plan: &[PlanStep]) -> Option<Direction> {
    let Action(action) = plan.first()?.action;
    Direction::ALL.get(action as usize).copied()
}
