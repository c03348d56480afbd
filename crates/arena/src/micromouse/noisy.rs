//! Runs the paper's mouse on the continuous simulator (its section 6): walls have a thickness,
//! wheels slip, ranges are noisy.
//!
//! Rules and score are those of the paper. The mouse is a [`NoisyMouse`]; here are its body, its
//! maze, and the referee that knows its true pose.

use tolman_maps::wall_belief::{PoseFilterConfig, RangeModel};
use tolman_maze::Maze;
use tolman_robot::{Ring, Standing};
use tolman_sim::noise::{Fault, Gaussian};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{CorridorSize, StepError, World};
use tolman_systems::micromouse::noisy::{NoisyMouse, NoisyMouseConfig, PoseSource};

use super::{MAX_STEPS, ScoreSheet, brief};
use crate::course::Course;
use crate::run::{TaskEnd, within};
use crate::{BoxError, Simulated};

/// Errors of a mouse's wheels and sensors, and the source of its pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NoisyConfig {
    /// Source of the mouse's pose.
    pub localization: PoseSource,
    /// Maximum slip of the wheels, as a share of distances and turns, uniform in ±. ≥ 0.
    pub slip: f64,
    /// Standard deviation of unwanted turns, rad per metre. ≥ 0.
    pub drift: f64,
    /// Standard deviation of a range, m. ≥ 0.
    pub range: f64,
    /// Standard deviation of a range as a share of the range, at least 0.
    pub relative_range: f64,
    /// Size of the mouse and of its maze.
    pub size: MouseSize,
}

/// Size of a mouse and of its maze. A half-size mouse has half the lengths of a classic one: its
/// body, its steps, the reach of its sensors. So noise of a given length hurts it twice as much.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MouseSize {
    /// Cells of 18 cm, walls of 12 mm.
    #[default]
    Classic,
    /// Cells of 9 cm, walls of 6 mm.
    Half,
}

impl MouseSize {
    /// Returns its lengths as a share of a classic mouse's.
    const fn scale(self) -> f64 {
        match self {
            Self::Classic => 1.0,
            Self::Half => 0.5,
        }
    }

    fn corridors(self) -> CorridorSize {
        CorridorSize {
            corridor_width: 0.168 * self.scale(),
            wall_thickness: 0.012 * self.scale(),
        }
    }
}

impl NoisyConfig {
    /// Returns ordinary noise times `level`. Wheels slip by up to a tenth, like those of Webots,
    /// and drift by 0.2 rad/m; ranges err by 3 mm and 2 %. The mouse is a classic one.
    #[must_use]
    pub fn ordinary(localization: PoseSource, level: f64) -> Self {
        Self {
            size: MouseSize::Classic,
            localization,
            slip: 0.1 * level,
            drift: 0.2 * level,
            range: 0.003 * level,
            relative_range: 0.02 * level,
        }
    }

    /// Returns a classic mouse: a body of 8 cm, three range sensors that reach 1 m, 2 cm and 0.2
    /// rad in a time step of 20 ms. A half-size one has half of each length.
    fn robot(&self) -> LaserPioneerConfig {
        let scale = self.size.scale();
        let slip = Fault::Slip { share: self.slip };
        let mut robot = LaserPioneerConfig::noiseless();
        robot.radius = 0.04 * scale;
        robot.ring = Ring::fan(3, core::f64::consts::PI, scale);
        robot.turn_per_step = 0.2;
        robot.translate_per_step = 0.02 * scale;
        robot.motor_noise.drift_sd = self.drift;
        robot.scan_noise = Gaussian {
            absolute_sd: self.range,
            relative_sd: self.relative_range,
        };
        robot.step_us = 20_000;
        robot.faults.motor_turn.push(slip);
        robot.faults.motor_distance.push(slip);
        robot
    }

    /// Returns the mouse's configuration: its model of its body and its maze.
    fn mouse(&self, robot: &LaserPioneerConfig) -> NoisyMouseConfig {
        let corridors = self.size.corridors();
        let mut mouse = NoisyMouseConfig::new(
            corridors.pitch(),
            robot.turn_per_step,
            robot.translate_per_step,
        );
        mouse.localization = self.localization;
        mouse.filter = self.filter();
        mouse.wall_thickness = corridors.wall_thickness;
        mouse
    }

    /// Returns the noise model of the filter: the true noise, plus a little for what the model
    /// leaves out.
    fn filter(&self) -> PoseFilterConfig {
        let mut filter = PoseFilterConfig::for_pitch(self.size.corridors().pitch());
        // The standard deviation of a uniform number in ± 1.
        filter.slip = 0.577 * self.slip + 0.01;
        filter.drift = self.drift + 0.02;
        filter.spread = 0.0005 * self.size.scale();
        filter.sensor = RangeModel {
            absolute: self.range + 0.004 * self.size.scale(),
            relative: self.relative_range + 0.01,
            outliers: 0.1,
        };
        filter
    }
}

/// Result of a noisy mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoisyTrial {
    /// Number of steps of each run at whose end the mouse was at the goal.
    pub verdict: ScoreSheet,
    /// Number of time steps in which the mouse touched a wall.
    pub bumps: u32,
    /// Mean distance between true and believed position at the mouse's stops, m.
    pub mean_error: f64,
}

/// Sends a mouse through `maze` and returns the trial. It explores until it believes that its run
/// is proven, is put back to the start, and makes that run.
///
/// # Errors
/// If the maze or the mouse is invalid.
pub fn send(maze: &Maze, config: &NoisyConfig, seed: u64) -> Result<NoisyTrial, BoxError> {
    let robot = config.robot();
    let mouse = NoisyMouse::new(brief(maze)?, config.mouse(&robot), seed)?;
    let corridors = config.size.corridors();
    let world = World::from_maze(maze, &corridors)?;
    let course = Course::in_world("", maze.clone(), corridors.corridor_width, world);
    let mut trial = Refereed {
        body: course.robot_at(mouse.start(), LaserPioneer::new(robot)?, seed)?,
        course,
        mouse,
        stops: 0,
        errors: 0.0,
        was_at_goal: false,
    };
    Ok(NoisyTrial {
        verdict: trial.both_runs()?,
        bumps: trial.body.bumps(),
        mean_error: trial.errors / f64::from(trial.stops.max(1)),
    })
}

/// A mouse under the paper's rules, and what the referee notes of it.
struct Refereed {
    course: Course,
    body: Simulated<LaserPioneer>,
    mouse: NoisyMouse,
    stops: u32,
    errors: f64,
    was_at_goal: bool,
}

impl Refereed {
    fn both_runs(&mut self) -> Result<ScoreSheet, BoxError> {
        let mut sheet = ScoreSheet::default();
        let run_1 = self.steps_of(MAX_STEPS, NoisyMouse::explore)?;
        let Some(run_1) = run_1.filter(|_| self.was_at_goal) else {
            return Ok(sheet);
        };
        sheet.run_1 = Some(run_1 + 1);
        self.body.place(self.mouse.start())?;
        self.mouse.put_back();
        let run_2 = self.steps_of(MAX_STEPS - run_1 - 1, NoisyMouse::run)?;
        sheet.run_2 = run_2.filter(|_| self.is_at_goal());
        Ok(sheet)
    }

    /// Lets the mouse make at most `most` steps, and returns how many it made until it believed
    /// that it was done; `None` if it never did.
    fn steps_of(
        &mut self,
        most: u32,
        act: fn(&mut NoisyMouse, &mut Simulated<LaserPioneer>) -> Result<Standing, StepError>,
    ) -> Result<Option<u32>, StepError> {
        let ended = within(most, || {
            self.stop()?;
            act(&mut self.mouse, &mut self.body)
        })?;
        Ok((ended.end == TaskEnd::Done).then_some(ended.actions - 1))
    }

    /// Lets the mouse look, and records the distance of its believed position from the true one.
    fn stop(&mut self) -> Result<(), StepError> {
        self.mouse.look(&mut self.body)?;
        let off = self.mouse.pose().position - self.body.truth().pose.position;
        self.errors += off.norm();
        self.stops += 1;
        self.was_at_goal |= self.is_at_goal();
        Ok(())
    }

    /// Returns whether the mouse really is in a goal.
    fn is_at_goal(&self) -> bool {
        self.course.is_destination(self.body.truth().pose.position)
    }
}
