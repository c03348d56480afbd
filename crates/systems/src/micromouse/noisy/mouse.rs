use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_control::heading_of;
use tolman_geom::Pose;
use tolman_maps::wall_belief::{PoseFilter, RangeReading, WallBelief};
use tolman_maze::{Cell, Direction, Walls};
use tolman_planners::moves::{
    Leap, MouseStep, MoveDecision, MoveExplorer, MoveExplorerConfig, MoveMap,
};
use tolman_planners::{Passages, Unknown};
use tolman_robot::{Bumps, Ranges, Robot, Rolls, Standing, TurnTranslate};

use super::system::{Choice, give_up};
use super::{MotionSource, NoisyMouseConfig, NoisyMouseError, PoseSource};
use crate::micromouse::{Brief, SIDE};

/// A robot that a noisy mouse can drive.
pub trait NoisyBody: Robot<Command = TurnTranslate, Sensing: Ranges + Bumps + Rolls> {}

impl<R: Robot<Command = TurnTranslate, Sensing: Ranges + Bumps + Rolls>> NoisyBody for R {}

/// A mouse that drives by its beliefs about walls and pose.
#[derive(Debug)]
pub struct NoisyMouse {
    pub(super) config: NoisyMouseConfig,
    pub(super) brief: Brief,
    pub(super) filter: PoseFilter,
    /// Pose by odometry alone.
    pub(super) reckoned: Pose,
    pub(super) belief: WallBelief<SIDE>,
    /// Whether the mouse was put down anywhere and has not localized yet. Then it drives by
    /// odometry from its likeliest place, and learns no walls.
    pub(super) is_lost: bool,
    explorer: MoveExplorer<SIDE>,
    pub(super) rng: ChaCha8Rng,
}

/// Minimum number of readings per stop, and maximum while a visible side of the cell is unknown.
const LOOKS: (u32, u32) = (4, 16);
/// Distance from the mouse's middle to a wall ahead at which it stops, as a share of the pitch. The
/// second value is the number of readings in a row that must agree.
const TOO_NEAR: (f64, u32) = (0.055 / 0.18, 3);
/// Range of positions ahead of the cell's middle, as shares of the pitch. A bump in it is with the
/// cell's wall, not with a post.
const AT_WALL: (f64, f64) = (0.1, 0.4);
/// Number of times that beliefs are doubted before the mouse gives up as stuck.
const DOUBTS: u32 = 12;
/// Tolerances at which a turn, rad, and a position, as a share of the pitch, are reached.
const CLOSE: (f64, f64) = (0.03, 0.004 / 0.18);
/// Share of its full speed with which the mouse drives. The errors of wheels and sensors are
/// independent between time steps. Shorter motions therefore average more of them out, and the
/// rules count no time.
const PACE: f64 = 0.25;
/// Number of time steps after which a step of the paper's rules is given up.
const PATIENCE: u32 = 800;
/// Reason for which the mouse gives up.
const NO_WAY: &str = "it believes that no way leads to the goal";

impl NoisyMouse {
    /// Returns a mouse at the start without observations; `seed` seeds its filter.
    ///
    /// # Errors
    /// If the maze is too large, or a number of the filter is out of its range.
    pub fn new(brief: Brief, config: NoisyMouseConfig, seed: u64) -> Result<Self, NoisyMouseError> {
        let belief = WallBelief::new(brief.grid, config.pitch, config.wall_thickness)?;
        let pose = Pose::new(belief.middle(brief.start), heading_of(brief.heading));
        Ok(Self {
            config,
            filter: PoseFilter::new(config.filter, pose)?,
            reckoned: pose,
            belief,
            is_lost: false,
            explorer: MoveExplorer::new(MoveExplorerConfig::tuned(), brief.start)?,
            rng: ChaCha8Rng::seed_from_u64(seed),
            brief,
        })
    }

    /// Returns the pose in which runs begin, in the frame of the belief.
    #[must_use]
    pub fn start(&self) -> Pose {
        let middle = self.belief.middle(self.brief.start);
        Pose::new(middle, heading_of(self.brief.heading))
    }

    /// Tells the mouse that it was put back to the start.
    pub fn put_back(&mut self) {
        let pose = self.start();
        self.filter.place(pose);
        self.reckoned = pose;
    }

    /// Returns the walls that it believes in.
    #[must_use]
    pub const fn belief(&self) -> &WallBelief<SIDE> {
        &self.belief
    }

    /// Returns the believed pose.
    #[must_use]
    pub fn pose(&self) -> Pose {
        match self.config.localization {
            PoseSource::ParticleFilter if !self.is_lost => self.filter.estimate(),
            PoseSource::DeadReckoning | PoseSource::ParticleFilter => self.reckoned,
        }
    }

    /// Stands still and takes in the readings of the range sensors.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn look<R: NoisyBody>(&mut self, robot: &mut R) -> Result<(), R::Error> {
        if self.is_lost {
            return self.look_for_itself(robot);
        }
        for looks in 0..LOOKS.1 {
            if looks >= LOOKS.0 && self.knows_its_cell() {
                break;
            }
            self.time_step(robot, TurnTranslate::STOP)?;
            for reading in readings(robot.sensing()) {
                self.belief
                    .observe(self.pose(), reading, &self.config.filter.sensor);
            }
        }
        Ok(())
    }

    /// Returns whether the mouse knows all sides of its cell at which a sensor looks.
    fn knows_its_cell(&self) -> bool {
        let (cell, looks) = (self.cell(), self.looks_to());
        let mut seen = [looks.left(), looks, looks.right()].into_iter();
        seen.all(|side| self.belief.knowledge(cell, side).is_known())
    }

    /// Makes a step of the first run, which is done when the mouse believes that its run is proven.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn explore<R: NoisyBody>(&mut self, robot: &mut R) -> Result<Standing, R::Error> {
        let choice = match self.unless_stuck(MoveDecision::Stuck, Self::decide) {
            MoveDecision::Drive(leap) => Choice::Drive(leap),
            MoveDecision::Turn => Choice::Turn(self.looks_to().right()),
            MoveDecision::Finished { .. } | MoveDecision::Enough { .. } => {
                Choice::End(Standing::Done)
            }
            MoveDecision::Stuck => give_up(NO_WAY),
        };
        self.carry_out(robot, choice)
    }

    /// Makes a step of the second run, which is planned again at every stop. It is done when the
    /// mouse believes that it is at a goal.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn run<R: NoisyBody>(&mut self, robot: &mut R) -> Result<Standing, R::Error> {
        let choice = self.choose_to_reach(&self.brief.goals.clone(), NO_WAY);
        self.carry_out(robot, choice)
    }

    /// Chooses how to reach the nearest of `targets`. `no_way` is why the mouse gives up if it
    /// believes that no way leads there.
    pub(super) fn choose_to_reach(&mut self, targets: &[Cell], no_way: &str) -> Choice {
        if targets.contains(&self.cell()) {
            return Choice::End(Standing::Done);
        }
        let leap = self.unless_stuck(None, |mouse| mouse.leap_to(targets));
        leap.map_or_else(|| give_up(no_way), Choice::Drive)
    }

    /// Makes the chosen step.
    pub(super) fn carry_out<R: NoisyBody>(
        &mut self,
        robot: &mut R,
        choice: Choice,
    ) -> Result<Standing, R::Error> {
        match choice {
            Choice::Drive(leap) => self.leap(robot, leap)?,
            Choice::Turn(side) => self.turn_to(robot, side)?,
            Choice::End(standing) => return Ok(standing),
        }
        Ok(Standing::UnderWay)
    }

    fn decide(&mut self) -> MoveDecision {
        let at = self.cell();
        let decision = self.explorer.decide(&self.belief, &self.brief.goals, at);
        // `new` has refused a maze that is too large.
        decision.unwrap_or(MoveDecision::Stuck)
    }

    /// Returns the first result of `plan` that is not `stuck`, or `stuck` after [`DOUBTS`]
    /// attempts.
    ///
    /// Every maze has a way to its goal. So while `plan` returns `stuck`, the mouse believes in
    /// some wall that does not stand. It then doubts all walls, and looks again at those with the
    /// least evidence.
    pub(super) fn unless_stuck<T: PartialEq>(
        &mut self,
        stuck: T,
        plan: impl Fn(&mut Self) -> T,
    ) -> T {
        for _ in 0..DOUBTS {
            let planned = plan(self);
            if planned != stuck {
                return planned;
            }
            self.belief.doubt_walls();
        }
        stuck
    }

    /// Returns the next leap towards the nearest of `targets`: through walls believed open, or else
    /// through those not believed to stand.
    pub(super) fn leap_to(&self, targets: &[Cell]) -> Option<Leap> {
        [Unknown::Closed, Unknown::Open]
            .into_iter()
            .find_map(|unknown| self.first_leap(unknown, targets.iter().copied()))
    }

    /// Returns the next leap towards the nearest of `targets`. `unknown` says how to treat unknown
    /// walls.
    pub(super) fn first_leap(
        &self,
        unknown: Unknown,
        targets: impl IntoIterator<Item = Cell>,
    ) -> Option<Leap> {
        // `new` has refused a maze that is too large.
        let passages = Passages::<SIDE>::new(&self.belief, unknown).ok()?;
        let map = MoveMap::new(&passages, targets);
        map.way(&passages, self.cell()).next()
    }

    /// Returns the cell of the mouse's believed position; the start, if that is outside the maze.
    pub(super) fn cell(&self) -> Cell {
        self.belief
            .cell_at(self.pose().position)
            .unwrap_or(self.brief.start)
    }

    /// Returns the direction nearest to its heading.
    pub(super) fn looks_to(&self) -> Direction {
        let pose = self.pose();
        let off = |side: &Direction| pose.heading.turn_to(heading_of(*side)).abs();
        Direction::ALL
            .into_iter()
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .unwrap_or(self.brief.heading)
    }

    /// Makes one step of the paper's rules: a turn, then cells ahead or back.
    pub(super) fn leap<R: NoisyBody>(&mut self, robot: &mut R, leap: Leap) -> Result<(), R::Error> {
        let mut looks = self.looks_to();
        let MouseStep { cells, .. } = MouseStep::of_leap(&mut looks, leap);
        self.turn_to(robot, looks)?;
        let ahead = if cells < 0 { -1.0 } else { 1.0 };
        let target = self.belief.middle(leap.end);
        let along = heading_of(looks).unit();
        let left = heading_of(looks.left()).unit();
        let mut near = 0;
        for _ in 0..PATIENCE {
            let pose = self.pose();
            let away = target - pose.position;
            let way = ahead * away.dot(&along);
            let front = front_range(robot.sensing());
            let too_near = TOO_NEAR.0 * self.config.pitch;
            let is_near = ahead > 0.0 && front.is_some_and(|range| range < too_near);
            near = if is_near { near + 1 } else { 0 };
            if way < CLOSE.1 * self.config.pitch || near >= TOO_NEAR.1 {
                return Ok(());
            }
            // Steer to the middle of the corridor, the more the farther away it is.
            let aside = (3.0 * away.dot(&left) / self.belief.pitch()).clamp(-0.4, 0.4);
            let wanted = heading_of(looks).turned(ahead * aside);
            let off = pose.heading.turn_to(wanted);
            let command = TurnTranslate {
                turn: (off / self.config.turn_per_step).clamp(-1.0, 1.0),
                translate: ahead * (way / self.config.translate_per_step).min(PACE),
            };
            if self.time_step(robot, command)? {
                self.bumped(if ahead > 0.0 { looks } else { looks.opposite() });
                // Back off from the wall, and look.
                let back = TurnTranslate {
                    turn: 0.0,
                    translate: -0.5 * ahead,
                };
                self.time_step(robot, back)?;
                return Ok(());
            }
        }
        Ok(())
    }

    /// Takes in a bump while driving to `side`. The bump proves the wall of the mouse's cell on
    /// that side, unless that wall would be too near or too far.
    fn bumped(&mut self, side: Direction) {
        if self.is_lost {
            return;
        }
        let cell = self.cell();
        let off = self.pose().position - self.belief.middle(cell);
        let ahead = off.dot(&heading_of(side).unit()) / self.belief.pitch();
        if (AT_WALL.0..AT_WALL.1).contains(&ahead) {
            self.belief.bump(cell, side);
        }
    }

    pub(super) fn turn_to<R: NoisyBody>(
        &mut self,
        robot: &mut R,
        side: Direction,
    ) -> Result<(), R::Error> {
        for _ in 0..PATIENCE {
            let off = self.pose().heading.turn_to(heading_of(side));
            if off.abs() < CLOSE.0 {
                break;
            }
            let command = TurnTranslate {
                turn: (off / self.config.turn_per_step).clamp(-PACE, PACE),
                translate: 0.0,
            };
            self.time_step(robot, command)?;
        }
        Ok(())
    }

    /// Makes one time step, and returns whether the mouse touched a wall.
    pub(super) fn time_step<R: NoisyBody>(
        &mut self,
        robot: &mut R,
        command: TurnTranslate,
    ) -> Result<bool, R::Error> {
        robot.step(&command)?;
        let sensing = robot.sensing();
        let (turn, distance) = match (self.config.motion, sensing.odometry()) {
            (MotionSource::Encoders, Some(rolled)) => (rolled.turn, rolled.distance),
            _ => (
                command.turn * self.config.turn_per_step,
                command.translate * self.config.translate_per_step,
            ),
        };
        self.reckoned = self.reckoned.displaced(distance, turn);
        if self.config.localization == PoseSource::ParticleFilter {
            let readings = readings(sensing);
            self.filter.drive(distance, turn, &mut self.rng);
            if !self.is_lost {
                self.filter.sense(&self.belief, &readings, &mut self.rng);
            }
        }
        Ok(sensing.bump() == Some(true))
    }
}

/// Returns the range of the beam that points most nearly ahead.
fn front_range(sensing: &impl Ranges) -> Option<f64> {
    let scan = sensing.scan()?;
    let off = |beam: u32| scan.ring.bearing(beam).abs();
    let beams = (0..).zip(&scan.ranges);
    let ahead = beams.min_by(|(a, _), (b, _)| off(*a).total_cmp(&off(*b)));
    ahead.map(|(_, range)| *range)
}

pub(super) fn readings(sensing: &impl Ranges) -> Vec<RangeReading> {
    let Some(scan) = sensing.scan() else {
        return Vec::new();
    };
    let beams = (0..).zip(&scan.ranges);
    let read = beams.filter(|(_, range)| range.is_finite());
    read.map(|(beam, range)| RangeReading {
        bearing: scan.ring.bearing(beam),
        range: *range,
        max_range: scan.ring.max_range,
    })
    .collect()
}
