use core::convert::Infallible;

use rand::{Rng, RngExt};
use tolman_control::{StuckBeams, heading_of, unit_of};
use tolman_geom::{Heading, Point, nearest_on_segment};
use tolman_maps::scan_map::{Advance, Clearings, CorridorMap, GroundWay, ScanMap, ScanMapConfig};
use tolman_maze::Direction;
use tolman_robot::{
    Goal, Guess, Landmark, MapView, Mapper, Position, Scan, Standing, Task, VisitNaming,
};

use super::reckoning::Reckoning;
use super::stop::Stop;
use super::tries::Tries;
use super::{BetterConfig, BetterPart};
use crate::{Brain, Doing, RolledStep};

/// Learns a [`ScanMap`]: goes to its gaps until none is left, then back to where the map begins.
///
/// Sent to a landmark, it goes there by the map so far, and looks for it in the gaps until it is on
/// the map. On such errands walls may come and go: it draws them again, and sees no sign of a lift
/// in them.
///
/// If the robot was moved meanwhile, the way back leads through walls or past openings that are not
/// on the map.
#[derive(Clone, Debug)]
pub struct BetterExplorer {
    config: BetterConfig,
    map: ScanMap,
    /// Known errors of the robot's laser.
    beams: StuckBeams,
    reckoning: Reckoning,
    /// Actions that failed since the robot last moved.
    failed: Vec<Direction>,
    /// Actions chosen lately.
    tries: Tries,
    /// Last action that was chosen; `None` before the first.
    last: Option<Direction>,
    plan: Plan,
    /// Believed position of the robot after each action, m.
    trail: Vec<Point>,
    /// Believed position of the robot after each time step, m.
    passed: Vec<Point>,
    /// Readings when the last action ended, until the robot sets off.
    stop: Option<Stop>,
    /// Number of dropped maps because the robot was lifted.
    dropped: u32,
    /// Number of time steps without a position on this map.
    forgotten: usize,
    /// Whether a dropped map had the start.
    knew_start: bool,
    /// Number of actions left to come back; `None` while there are gaps.
    homeward: Option<f64>,
    /// Landmark to which it is sent; `None` while it explores.
    sought: Option<Landmark>,
    /// What it sensed when the last action ended.
    sensed: Option<(Scan, Heading)>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Plan {
    /// Go to a gap.
    Go(Direction),
    /// No gap is left: go back to where the map begins; `None` if no action seems to lead nearer.
    Return(Option<Direction>),
    /// A gap is left, but no action seems to lead nearer.
    Stuck,
    /// No gap is left, and the robot is back.
    Finished,
    /// No gap is left, and the robot does not come back.
    Strayed,
    /// No gap is left, and the landmark that it is sent to is not on the map.
    Nowhere,
}

/// Probability that the map is right if something contradicts it; [`SURE`] if nothing does. Both
/// are from 250 maps of the arena.
const DOUBTFUL: f64 = 0.01;
const SURE: f64 = 0.98;
/// Number of dropped maps above which contradicting walls are no sign of a lift: walls of rooms may
/// contradict one another without a lift.
const MOST_DROPPED: u32 = 3;
/// Maximum number of actions until the robot is back: for each action of the shortest way, and in
/// addition.
const MOST_HOMEWARD: [f64; 2] = [3.0, 20.0];
/// Number of times that an action is chosen at a place before the robot acts at random there.
const ROUNDS: usize = 4;
/// Maximum way of an action, in usual ways of an action: round corners it is longer than usual.
const LONGEST: f64 = 2.5;
/// Cost of a quarter turn, as a distance, m.
const TURN: f64 = 0.35;

impl BetterExplorer {
    /// Returns an explorer without a map.
    #[must_use]
    pub fn new(config: BetterConfig) -> Self {
        let mut map = ScanMapConfig::for_robot(config.diameter);
        if !config.has(BetterPart::Fit) {
            map.farthest_fit = 0.0;
        }
        Self {
            map: ScanMap::new(map),
            config,
            beams: StuckBeams::default(),
            reckoning: Reckoning::default(),
            failed: Vec::new(),
            tries: Tries::default(),
            last: None,
            plan: Plan::Stuck,
            trail: Vec::new(),
            passed: Vec::new(),
            stop: None,
            dropped: 0,
            forgotten: 0,
            knew_start: false,
            homeward: None,
            sought: None,
            sensed: None,
        }
    }

    /// Returns the map so far.
    #[must_use]
    pub const fn learned(&self) -> &ScanMap {
        &self.map
    }

    /// Returns the places and ways learned so far. O(cells · log cells).
    #[must_use]
    pub fn corridors(&self) -> CorridorMap {
        CorridorMap::of(&self.map.chart(), self.config.corridor_width)
    }

    /// Returns the reason why the map is unfinished or doubtful, as a sentence without a full stop;
    /// `None` if there is none.
    #[must_use]
    pub fn why_doubtful(&self) -> Option<&'static str> {
        match self.plan {
            Plan::Finished if self.knew_start && !self.knows_start() => {
                Some("the start is not on it, though it began there")
            }
            Plan::Finished if self.drove_through_a_wall() => {
                Some("the robot drove where the map has a wall")
            }
            Plan::Finished => self.map.chart().doubt(),
            Plan::Return(_) | Plan::Strayed => Some("it did not come back to where its map begins"),
            Plan::Go(_) | Plan::Stuck => Some("a gap is left that it did not come to"),
            Plan::Nowhere => Some("a landmark that it looked for is not on it"),
        }
    }

    fn drove_through_a_wall(&self) -> bool {
        let longest = LONGEST * self.config.action_way;
        !self.map.clearings().allow(&self.trail, longest)
    }

    fn knows_start(&self) -> bool {
        let first = self.map.places().first();
        let begins_there = first.is_some_and(|first| first.landmark == Some(Landmark::Start));
        begins_there || !self.map.start().is_empty()
    }

    /// Returns the learned map.
    #[must_use]
    pub fn into_learned(self) -> ScanMap {
        self.map
    }

    /// Begins another map, because the robot's position on the last one is unknown.
    fn begin_anew(&mut self) {
        *self = Self {
            beams: core::mem::take(&mut self.beams),
            dropped: self.dropped + 1,
            forgotten: self.visit_count(),
            knew_start: self.knew_start || self.knows_start(),
            sought: self.sought,
            ..Self::new(self.config)
        };
    }

    /// Returns whether it takes walls that contradict the map for a lift. On errands they have come
    /// or gone.
    fn heeds_lifts(&self) -> bool {
        self.config.has(BetterPart::Lifts) && self.sought.is_none()
    }

    fn arrived(&mut self, seen: &RolledStep, scan: Option<&Scan>) {
        self.stop = Stop::of(seen.step.heading, scan);
        let (Some(scan), Some(heading)) = (scan, seen.step.heading) else {
            return;
        };
        let (moved, sd) = self.reckoning.take();
        self.map.observe(&Advance {
            moved,
            sd,
            heading,
            scan,
            landmark: seen.step.landmark,
            walls_change: self.sought.is_some(),
        });
        let may_drop = self.heeds_lifts() && self.dropped < MOST_DROPPED;
        if may_drop && self.map.surprise() > ScanMap::DOUBTFUL {
            // It did not notice at once.
            self.begin_anew();
            return self.arrived(seen, Some(scan));
        }
        self.trail.push(self.map.position());
        self.sensed = Some((scan.clone(), heading));
        self.plan = self.consult(scan, heading.radians());
        self.break_a_round();
    }

    /// Lets the robot act at random if it goes to and fro, as a robot without noise does where no
    /// whole number of actions leads to a gap.
    fn break_a_round(&mut self) {
        let here = self.map.position();
        let (action, at_random) = match self.plan {
            Plan::Go(action) => (action, Plan::Stuck),
            Plan::Return(Some(action)) => (action, Plan::Return(None)),
            Plan::Return(None) | Plan::Stuck | Plan::Finished | Plan::Strayed | Plan::Nowhere => {
                return;
            }
        };
        if self.tries.count(here, action) >= ROUNDS {
            self.plan = at_random;
        } else {
            self.tries.add(here, action);
        }
    }

    fn consult(&mut self, scan: &Scan, heading: f64) -> Plan {
        if let Some(landmark) = self.sought {
            let found = self.seek(landmark, scan, heading);
            // What barred the way may have gone again.
            return match found {
                None if self.map.reopen() => self.seek(landmark, scan, heading),
                found => found,
            }
            .unwrap_or(Plan::Nowhere);
        }
        let clearings = self.map.clearings();
        if let Some(way) = clearings.way_to_gap(self.map.position()) {
            self.homeward = None;
            let action = self.towards(&clearings, &way, scan, heading);
            return action.map_or(Plan::Stuck, Plan::Go);
        }
        let places = self.map.places().iter().map(|place| place.position);
        if clearings.has_gap(places) {
            return Plan::Stuck;
        }
        let was_back = self.plan == Plan::Finished;
        if was_back || !self.config.has(BetterPart::Lifts) || self.is_back() {
            return Plan::Finished;
        }
        let Some(way) = clearings.way_to(self.map.position(), Point::origin()) else {
            return Plan::Strayed;
        };
        let [each, more] = MOST_HOMEWARD;
        let left = way.metres(self.map.position()).unwrap_or(0.0) / self.config.action_way;
        let homeward = self.homeward.unwrap_or(more + each * left);
        self.homeward = Some(homeward - 1.0);
        if homeward < 0.0 {
            return Plan::Strayed;
        }
        Plan::Return(self.towards(&clearings, &way, scan, heading))
    }

    /// Returns the plan to come to a landmark by the map, or to the nearest gap if it has none.
    /// `None` if there is no gap either.
    fn seek(&self, landmark: Landmark, scan: &Scan, heading: f64) -> Option<Plan> {
        let here = self.map.position();
        let (clearings, hopeful) = (self.map.clearings(), self.map.clearings().hopeful());
        let way = hopeful.way_to_any(here, &self.map.spots(landmark));
        let way = way.filter(|way| way.metres(here).is_some());
        let way = way.or_else(|| clearings.way_to_gap(here))?;
        let action = self.towards(&clearings, &way, scan, heading);
        Some(action.map_or(Plan::Stuck, Plan::Go))
    }

    /// Returns whether the robot's last action passed where its map begins, at most an action's way
    /// aside: it may have been put down off the middle of a corridor.
    fn is_back(&self) -> bool {
        let here = self.map.position();
        let before = *self.trail.iter().nth_back(1).unwrap_or(&here);
        let nearest = nearest_on_segment(Point::origin(), here, before);
        nearest.coords.norm() <= self.config.action_way
            && self.map.grid().sees(here, Point::origin())
    }

    /// Returns the action that leads nearest to a way's end; `None` if all lead away.
    fn towards(
        &self,
        clearings: &Clearings<'_>,
        way: &GroundWay<'_>,
        scan: &Scan,
        heading: f64,
    ) -> Option<Direction> {
        let here = way.metres(self.map.position());
        let worth = |action: Direction| {
            if self.failed.contains(&action) || self.is_blocked(action, scan, heading) {
                return None;
            }
            let turn = match self.last {
                Some(last) if last == action || last == action.opposite() => 0.0,
                _ => TURN,
            };
            Some((self.left_after(action, clearings, way)? + turn, action))
        };
        let best = Direction::ALL.into_iter().filter_map(worth);
        let (left, action) = best.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let leads_nearer = here.is_none_or(|here| left < here + TURN + 0.2);
        leads_nearer.then_some(action)
    }

    /// Returns the average distance to a way's end after an action, m.
    fn left_after(
        &self,
        action: Direction,
        clearings: &Clearings<'_>,
        way: &GroundWay<'_>,
    ) -> Option<f64> {
        let reach = self.config.action_way;
        let free = clearings.straight(self.map.position(), unit_of(action), 1.3 * reach);
        if free < 0.1 {
            return None;
        }
        let ends = [0.7, 1.0, 1.3].map(|share| {
            let end = self.map.position() + unit_of(action) * (share * reach).min(free);
            way.metres(end)
        });
        let [a, b, c] = ends;
        Some((a? + 2.0 * b? + c?) / 4.0)
    }

    /// Returns whether the layers will refuse.
    fn is_blocked(&self, action: Direction, scan: &Scan, heading: f64) -> bool {
        let bearing = heading_of(action).radians() - heading;
        [-1, 0, 1].into_iter().any(|beside| {
            let range = scan.range_towards(bearing, beside);
            range.is_some_and(|range| range < self.config.buffer)
        })
    }
}

impl Mapper for BetterExplorer {
    type Observation = RolledStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &RolledStep) -> Result<(), Infallible> {
        if seen.step.doing == Doing::PutDown {
            *self = Self {
                beams: core::mem::take(&mut self.beams),
                ..Self::new(self.config)
            };
        }
        let scan = seen.step.scan.as_ref();
        let scan = scan.map(|scan| self.beams.mended(scan));
        if self.heeds_lifts()
            && let Some(stop) = self.stop.take()
            && stop.was_left_by_a_lift(seen, scan.as_ref())
        {
            self.begin_anew();
        }
        self.reckoning.add(seen, &self.config);
        match seen.step.doing {
            Doing::PutDown => self.arrived(seen, scan.as_ref()),
            Doing::UnderWay(_) => {
                if let Some(landmark) = seen.step.landmark {
                    self.map.pass(self.reckoning.since(), landmark);
                }
            }
            Doing::Ended(action, outcome) => {
                if outcome.moved() {
                    self.failed.clear();
                    self.last = Some(action);
                } else {
                    self.failed.push(action);
                }
                self.arrived(seen, scan.as_ref());
            }
        }
        match self.map.at() {
            Some(_) => {
                let here = self.map.position() + self.reckoning.since();
                self.passed.push(here);
            }
            None => self.forgotten += 1,
        }
        Ok(())
    }

    fn map(&self) -> MapView {
        let mut trail = vec![None; self.forgotten];
        trail.extend(self.passed.iter().copied().map(Some));
        MapView {
            trail,
            ..self.corridors().view()
        }
    }

    fn belief(&self) -> Vec<Guess> {
        let guess = |_| Guess {
            at: Position::Point(self.map.position()),
            weight: 1.0,
        };
        self.map.at().map(guess).into_iter().collect()
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachStep
    }

    fn visits(&self) -> Vec<Option<u32>> {
        let mut visits = vec![None; self.forgotten];
        visits.extend(self.corridors().visits(&self.passed));
        visits
    }

    fn certainty(&self) -> Option<f64> {
        let is_doubtful = self.why_doubtful().is_some();
        Some(if is_doubtful { DOUBTFUL } else { SURE })
    }

    fn visit_count(&self) -> usize {
        self.forgotten + self.passed.len()
    }

    fn doubt(&self) -> Option<String> {
        self.why_doubtful().map(ToOwned::to_owned)
    }

    fn map_bytes(&self) -> Option<usize> {
        Some(self.map.bytes())
    }
}

impl Brain for BetterExplorer {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        match self.plan {
            Plan::Go(action) | Plan::Return(Some(action)) => action,
            Plan::Return(None) | Plan::Stuck | Plan::Finished | Plan::Strayed | Plan::Nowhere => {
                Direction::ALL[rng.random_range(0..4)]
            }
        }
    }

    fn aim(&mut self, task: Task) {
        let sought = match task {
            Task::Reach(Goal::Landmark(landmark)) => Some(landmark),
            Task::Reach(Goal::Place(_) | Goal::Point(_)) | Task::Explore | Task::Localize => None,
        };
        if sought != self.sought {
            self.sought = sought;
            self.tries = Tries::default();
            if let Some((scan, heading)) = self.sensed.take() {
                self.plan = self.consult(&scan, heading.radians());
                self.sensed = Some((scan, heading));
            }
        }
    }

    fn standing(&self, task: Task) -> Standing {
        match task {
            Task::Explore if self.plan == Plan::Strayed => {
                Standing::gave_up("it did not come back to where its map begins")
            }
            Task::Explore if self.plan != Plan::Finished => Standing::UnderWay,
            Task::Explore if self.map.goal().is_empty() => {
                let everywhere = "it has been everywhere and the goal was nowhere";
                Standing::gave_up(self.why_doubtful().unwrap_or(everywhere))
            }
            Task::Explore => Standing::Done,
            Task::Reach(Goal::Landmark(_)) if self.plan == Plan::Nowhere => {
                Standing::gave_up("it has been everywhere, and the landmark was nowhere")
            }
            Task::Reach(Goal::Landmark(_)) => Standing::UnderWay,
            Task::Reach(Goal::Place(_) | Goal::Point(_)) | Task::Localize => {
                Standing::gave_up("its map is not finished yet: let it explore first")
            }
        }
    }

    fn sees_straight(&self) -> bool {
        self.config.has(BetterPart::Straightening)
    }

    fn words(&self) -> String {
        let places = self.map.places().len();
        match self.plan {
            Plan::Go(_) => format!("{places} places, on the way to a gap"),
            Plan::Stuck => format!("{places} places, a gap is left but nothing leads there"),
            Plan::Return(_) => format!("{places} places, no gap is left, on the way back"),
            Plan::Finished => format!("{places} places, no gap is left"),
            Plan::Strayed => format!("{places} places, it does not come back"),
            Plan::Nowhere => format!("{places} places, the landmark is nowhere"),
        }
    }
}
