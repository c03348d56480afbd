//! Experiments with rats, run with a robot: an experimenter shuts and opens doors, and watches
//! which way is taken.

use tolman_geom::Point;
use tolman_maze::{Cell, Direction};
use tolman_robot::{Goal, Landmark, Task};
use tolman_sim::DoorState;

use super::condition::door_name;
use super::play::{Bout, Contest, ContestError, Moment};
use super::whereabouts::Squares;
use crate::apparatus::{Apparatus, Opening};
use crate::registry::Schooling;
use crate::run::TaskEnd;
use crate::{BoxError, Outing};

/// An experiment with the contestant of a [`Contest`] in an [`Apparatus`].
#[derive(Clone, Copy, Debug)]
pub struct RatExperiment<'a> {
    /// Contestant, robot and seed. The drawing is that of the apparatus.
    pub contest: Contest<'a>,
    /// Where its doors and ways are.
    pub apparatus: &'a Apparatus,
    /// What is done, in this order.
    pub steps: &'a [RatStep],
}

/// A step of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RatStep {
    /// Shuts the door of this index.
    Shut(usize),
    /// Opens the door of this index.
    Open(usize),
    /// Lets it explore until it is done, without anything to look for.
    Explore,
    /// Sends it back to the start box. One that cannot be sent there, or does not come there, is
    /// carried, and told so, as rats are.
    Back,
    /// Sends it to the food.
    ToFood,
    /// Sends it to the food, and ends as soon as it has entered a way of the apparatus.
    Choose,
}

/// A drive: the result of [`Explore`](RatStep::Explore), [`ToFood`](RatStep::ToFood) or
/// [`Choose`](RatStep::Choose).
#[derive(Clone, Debug, PartialEq)]
pub struct RatTrip {
    /// Openings between cells that the robot went through, in order.
    pub crossed: Vec<Opening>,
    /// Distance driven, m.
    pub metres: f64,
    /// Distance driven until it was at the food, m; `None` if it did not arrive, or explored.
    pub arrived: Option<f64>,
    /// End of the drive.
    pub end: TaskEnd,
}

impl RatTrip {
    /// Returns the index of the first of these openings that it went through; `None` if it went
    /// through none.
    #[must_use]
    pub fn first_of(&self, openings: &[Opening]) -> Option<usize> {
        let mut crossed = self.crossed.iter();
        crossed.find_map(|way| openings.iter().position(|other| other == way))
    }

    /// Returns the number of times that it went through one of these openings.
    #[must_use]
    pub fn count_of(&self, openings: &[Opening]) -> u32 {
        let crossed = self.crossed.iter();
        crossed.filter(|way| openings.contains(way)).count() as u32
    }
}

/// Result of an experiment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RatRecord {
    /// Reason why the contestant abstained; `None` if it drove.
    pub abstained: Option<String>,
    /// Drives, in order.
    pub trips: Vec<RatTrip>,
    /// Number of times that it was carried to the start box.
    pub carried: u32,
    /// Length of a cell, m.
    pub pitch: f64,
}

impl RatExperiment<'_> {
    /// Plays the experiment and returns its record. Calls `watch` with the contestant at every
    /// [`Moment`]; nothing depends on it.
    ///
    /// # Errors
    /// [`ContestError`].
    pub fn play(
        &self,
        schooling: &Schooling,
        mut watch: impl FnMut(&dyn Outing, Moment),
    ) -> Result<RatRecord, ContestError> {
        let contest = Contest {
            maze: &self.apparatus.maze,
            ..self.contest
        };
        if let Some(why) = contest.abstains() {
            return Ok(RatRecord {
                abstained: Some(why),
                ..RatRecord::default()
            });
        }
        let outing = contest.enter_by(schooling, &self.apparatus.doors)?;
        let mut bout = Bout::new(&contest, outing);
        let mut record = RatRecord {
            pitch: bout.squares.pitch,
            ..RatRecord::default()
        };
        watch(&*bout.outing, Moment::Begun);
        for step in self.steps {
            self.step(*step, &mut bout, &mut record, &mut watch)
                .map_err(|source| contest.enter_error(source))?;
        }
        watch(&*bout.outing, Moment::Over);
        Ok(record)
    }

    fn step(
        &self,
        step: RatStep,
        bout: &mut Bout,
        record: &mut RatRecord,
        watch: &mut impl FnMut(&dyn Outing, Moment),
    ) -> Result<(), BoxError> {
        let food = Task::Reach(Goal::Landmark(Landmark::Goal));
        match step {
            RatStep::Shut(door) => bout.outing.set_door(&door_name(door), DoorState::Shut)?,
            RatStep::Open(door) => bout.outing.set_door(&door_name(door), DoorState::Open)?,
            // A baseline learns nothing, however long it drives about.
            RatStep::Explore if !self.contest.contestant.learns() => {}
            RatStep::Explore => record.trips.push(drive(bout, Task::Explore, &[], watch)),
            RatStep::ToFood => record.trips.push(drive(bout, food, &[], watch)),
            RatStep::Choose => {
                let ways = &self.apparatus.ways;
                record.trips.push(drive(bout, food, ways, watch));
            }
            RatStep::Back => {
                if !self.comes_back(bout, watch) {
                    let start = self.apparatus.maze.start();
                    let start = start.ok_or("the drawing marks no start; mark one")?;
                    // One that gives up where it was put down shows that in its next drive.
                    let _standing = bout.put_down(start)?;
                    record.carried += 1;
                    watch(&*bout.outing, Moment::PutDown);
                }
            }
        }
        Ok(())
    }

    /// Sends the robot to the start box. Returns whether it came there.
    fn comes_back(&self, bout: &mut Bout, watch: &mut impl FnMut(&dyn Outing, Moment)) -> bool {
        let contestant = self.contest.contestant;
        let start_box = Landmark::Numbered(Apparatus::BOX);
        let back = Task::Reach(Goal::Landmark(start_box));
        contestant.learns()
            && contestant.facts().delivers
            && drive(bout, back, &[], watch).arrived.is_some()
    }
}

/// Lets the robot pursue a task, at most until it has gone through one of the openings `until`.
fn drive(
    bout: &mut Bout,
    task: Task,
    until: &[Opening],
    watch: &mut impl FnMut(&dyn Outing, Moment),
) -> RatTrip {
    let mut pursuit = bout.set_out(task, Contest::LIMIT * bout.corridors(), None);
    let mut track = Track::new(bout.squares, bout.here());
    let mut seen = bout.outing.path().len();
    loop {
        let end = bout.go_on(&mut pursuit, |outing, _| watch(outing, Moment::Acted));
        let path = bout.outing.path();
        for pose in &path[seen..] {
            track.come_to(pose.position);
        }
        seen = path.len();
        let has_entered = track.crossed.iter().any(|way| until.contains(way));
        let end = end.or_else(|| has_entered.then_some(TaskEnd::Done));
        if let Some(end) = end {
            let driven = bout.driven(&pursuit, end);
            return RatTrip {
                crossed: track.crossed,
                metres: driven.metres,
                arrived: driven.arrived,
                end: driven.end,
            };
        }
    }
}

/// The cells of a drive.
struct Track {
    squares: Squares,
    at: Cell,
    crossed: Vec<Opening>,
}

/// Distance that a robot is beyond a cell's border when it counts as gone through, in cells: one
/// that turns on the border goes through once.
const BEYOND: f64 = 0.1;

impl Track {
    fn new(squares: Squares, from: Point) -> Self {
        let (at, crossed) = (squares.cell_at(from), Vec::new());
        Self {
            squares,
            at,
            crossed,
        }
    }

    fn come_to(&mut self, point: Point) {
        let cell = self.squares.cell_at(point);
        let off = point - self.squares.middle(cell);
        if cell == self.at || off.amax() > (0.5 - BEYOND) * self.squares.pitch {
            return;
        }
        let mut ways = Direction::ALL.into_iter();
        if let Some(way) = ways.find(|way| self.at.beyond(*way) == Some(cell)) {
            self.crossed.push((self.at, way));
        }
        self.at = cell;
    }
}
