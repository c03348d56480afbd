use core::error::Error;
use core::f64::consts::{FRAC_PI_2, TAU};

use tolman_control::heading_of;
use tolman_geom::{Heading, OutOfRange};
use tolman_maps::diktiometry::{MoveOutcome, Signature};
use tolman_maze::Direction;
use tolman_robot::{Compass, Landmark, Odometry, Ranges, Rolls, SensesLandmarks, TurnTranslate};

use super::{
    Around, Arrival, Beside, Eye, Odometer, Offset, RoutineConfig, RoutineError, Rover, SenseError,
    View, compass, offset, round_scan,
};

/// A robot with the paper's control routines: they follow corridors, end at corners and doorways,
/// and measure their displacement.
///
/// The robot may be a mutable reference: only the configuration is kept between two routines.
#[derive(Clone, Debug)]
pub struct Surveyor<R, E> {
    robot: R,
    eye: E,
    config: RoutineConfig,
    /// Odometer of the routine under way.
    odometer: Odometer,
    /// Number of time steps of the routine under way.
    steps: u32,
    /// Number of time steps in a row of which odometry told nothing.
    unseen: u32,
    /// Landmark at which the robot breaks off.
    sought: Option<Landmark>,
    /// Landmarks that were sensed.
    passed: Vec<Landmark>,
}

/// Maximum error of a turn, rad.
const ALIGNED: f64 = 0.02;
/// Maximum offset from the middle of a place that is not corrected, m.
const SETTLED: f64 = 0.01;
/// Number of time steps after which a routine is lost: the longest corridor of 60 cells.
const PATIENCE: u32 = 2000;
/// Number of time steps in a row in which a sensor may tell nothing before it counts as broken.
const MOST_SILENT: u32 = 20;

impl<R, E> Surveyor<R, E> {
    /// Returns `robot`, which stands at a place and tells places apart by `eye`.
    ///
    /// # Errors
    /// [`OutOfRange`] if a field of `config` is out of its range.
    pub fn new(robot: R, eye: E, config: RoutineConfig) -> Result<Self, OutOfRange> {
        config.check()?;
        Ok(Self {
            odometer: Odometer::new(config.odometry_share, config.compass_bound),
            robot,
            eye,
            config,
            steps: 0,
            unseen: 0,
            sought: None,
            passed: Vec::new(),
        })
    }

    /// Breaks off a routine with [`RoutineError::Found`] where the robot senses `landmark`.
    #[must_use]
    pub fn seeking(self, landmark: Option<Landmark>) -> Self {
        Self {
            sought: landmark,
            ..self
        }
    }

    /// Returns the robot.
    pub const fn robot(&self) -> &R {
        &self.robot
    }

    /// Returns the robot, to change its world. It must not be driven between two routines.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.robot
    }
}

impl<R, E> Surveyor<R, E>
where
    R: SensesLandmarks<Command = TurnTranslate, Error: Error + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing>,
{
    /// Turns in place until the robot looks `ahead`.
    fn turn_to(&mut self, ahead: Heading) -> Result<(), RoutineError<R::Error>> {
        for _ in 0..PATIENCE {
            let turn = self.heading()?.turn_to(ahead);
            if turn.abs() < ALIGNED {
                break;
            }
            self.command(turn, 0.0)?;
        }
        Ok(())
    }

    /// Follows the corridor `direction` to the middle of the next opening or doorway, or to a wall.
    fn follow(&mut self, direction: Direction) -> Result<(), RoutineError<R::Error>> {
        let (gauge, ahead) = (self.config, heading_of(direction));
        let mut beside = Beside::at_start(self.view(ahead)?, &gauge);
        let mut along = 0.0;
        self.steps = 0;
        loop {
            let view = self.view(ahead)?;
            if let Some(middle) = beside.see(view, along, &gauge) {
                // Beginning and end are noticed half a stride late.
                let middle = middle - 0.5 * gauge.stride();
                return self.back_up(direction, along, middle);
            }
            let room = view.ahead - gauge.half();
            if room < 0.2 * gauge.stride() {
                return Ok(());
            }
            along += self.drive(ahead, view, gauge.stride().min(room))?;
            self.check_patience(direction)?;
        }
    }

    /// Drives backward against `direction`, from `along` to `middle`. Both are positions on the
    /// way, m.
    fn back_up(
        &mut self,
        direction: Direction,
        mut along: f64,
        middle: f64,
    ) -> Result<(), RoutineError<R::Error>> {
        let (stride, ahead) = (self.config.stride(), heading_of(direction));
        while along - middle > 0.2 * stride {
            let view = self.view(ahead)?;
            along += self.drive(ahead, view, -stride.min(along - middle))?;
            self.check_patience(direction)?;
        }
        Ok(())
    }

    fn check_patience(&self, direction: Direction) -> Result<(), RoutineError<R::Error>> {
        let steps = self.steps;
        if steps > PATIENCE {
            return Err(RoutineError::Lost { direction, steps });
        }
        Ok(())
    }

    /// Drives `distance`, m, keeping to the middle between the walls. Returns the distance by
    /// odometry, m.
    fn drive(
        &mut self,
        ahead: Heading,
        view: View,
        distance: f64,
    ) -> Result<f64, RoutineError<R::Error>> {
        let gauge = self.config;
        // Metres to the right of the middle.
        let aside = match (gauge.is_closed(view.left), gauge.is_closed(view.right)) {
            (true, true) => 0.5 * (view.left - view.right),
            // It may be a jamb: little is made of one side alone.
            (true, false) => (view.left - gauge.half()).clamp(-gauge.stride(), gauge.stride()),
            (false, true) => (gauge.half() - view.right).clamp(-gauge.stride(), gauge.stride()),
            (false, false) => 0.0,
        };
        let lean = (4.0 * aside).clamp(-0.4, 0.4) * distance.signum();
        let turn = view.heading.turn_to(ahead.turned(lean));
        self.command(turn.clamp(-0.2, 0.2), distance)
    }

    /// Makes one time step and returns its distance by odometry, m. Adds odometry and compass to
    /// the box of this routine.
    fn command(&mut self, turn: f64, distance: f64) -> Result<f64, RoutineError<R::Error>> {
        let before = self.heading()?;
        let command = TurnTranslate {
            turn: (turn / self.config.turn_per_step).clamp(-1.0, 1.0),
            translate: (distance / self.config.translate_per_step).clamp(-1.0, 1.0),
        };
        self.step(&command)?;
        self.steps += 1;
        let rolled = self.robot.sensing().odometry();
        let after = self.heading()?;
        if let Some(Odometry { distance, .. }) = rolled {
            self.unseen = 0;
            self.odometer.roll(distance, before, after)?;
            return Ok(distance);
        }
        self.unseen += 1;
        if self.unseen > MOST_SILENT {
            return Err(SenseError::Blind { sensor: "odometry" }.into());
        }
        let asked = command.translate * self.config.translate_per_step;
        self.odometer.roll_unseen(asked, before, after)?;
        Ok(asked)
    }

    /// Makes one time step, and breaks off at the landmark that is sought.
    fn step(&mut self, command: &TurnTranslate) -> Result<(), RoutineError<R::Error>> {
        self.robot.step(command).map_err(RoutineError::Robot)?;
        let here = self.robot.landmark();
        if let Some(landmark) = here.filter(|landmark| !self.passed.contains(landmark)) {
            self.passed.push(landmark);
        }
        match here {
            Some(_) if here == self.sought => Err(RoutineError::Found),
            _ => Ok(()),
        }
    }

    /// Returns the heading, once compass and laser give readings.
    fn heading(&mut self) -> Result<Heading, RoutineError<R::Error>> {
        self.once_told(|this| {
            round_scan(this.robot.sensing())?;
            Ok(compass(this.robot.sensing())?)
        })
    }

    /// Returns the result of `read`. If a reading is missing, the robot stands still and waits for
    /// it, up to [`MOST_SILENT`] time steps.
    fn once_told<T>(
        &mut self,
        read: impl Fn(&Self) -> Result<T, RoutineError<R::Error>>,
    ) -> Result<T, RoutineError<R::Error>> {
        for _ in 0..MOST_SILENT {
            match read(self) {
                Err(RoutineError::Sense(SenseError::Blind { .. })) => {
                    self.step(&TurnTranslate::STOP)?;
                }
                told => return told,
            }
        }
        read(self)
    }

    /// Moves to the middle of the place, as far as walls and corners around it show it.
    fn settle(&mut self, ahead: Heading) -> Result<(), RoutineError<R::Error>> {
        let Offset { along, .. } = self.offset(ahead)?;
        if along.abs() > SETTLED {
            let view = self.view(ahead)?;
            self.drive(ahead, view, -along)?;
        }
        let Offset { aside, .. } = self.offset(ahead)?;
        if aside.abs() > SETTLED {
            let left = ahead.turned(FRAC_PI_2);
            self.turn_to(left)?;
            self.command(0.0, -aside)?;
        }
        Ok(())
    }

    /// Ends a routine standing still, and returns the arrival with the view of the place.
    fn arrive(&mut self, outcome: MoveOutcome) -> Result<Arrival, RoutineError<R::Error>> {
        self.step(&TurnTranslate::STOP)?;
        let moved = self.odometer.moved();
        self.once_told(|this| {
            Ok(Arrival {
                outcome,
                moved,
                exits: this.exits()?,
                look: this.signature()?,
            })
        })
    }

    /// Returns the signature of the place, whose column 0 looks east.
    fn signature(&self) -> Result<Option<Signature>, RoutineError<R::Error>> {
        let sensing = self.robot.sensing();
        let heading = compass(sensing)?;
        let Some(mut columns) = self.eye.columns(sensing)? else {
            return Ok(None);
        };
        let count = columns.len().max(1);
        let width = TAU / count as f64;
        let turn = libm::round(heading.radians() / width) as i64;
        columns.rotate_right(turn.rem_euclid(count as i64) as usize);
        let rows = columns.first().map_or(0, Vec::len);
        Ok(Some(Signature::new(rows, columns.concat())?))
    }

    fn exits(&self) -> Result<[bool; 4], SenseError> {
        let around = Around::of(self.robot.sensing())?;
        let views = Direction::ALL.map(|direction| around.view(heading_of(direction)));
        Ok(views.map(|view| self.config.is_open(view.ahead)))
    }

    fn view(&self, ahead: Heading) -> Result<View, SenseError> {
        Ok(Around::of(self.robot.sensing())?.view(ahead))
    }

    fn offset(&self, ahead: Heading) -> Result<Offset, SenseError> {
        let around = Around::of(self.robot.sensing())?;
        Ok(offset(around, ahead, &self.config))
    }
}

impl<R, E> Rover for Surveyor<R, E>
where
    R: SensesLandmarks<Command = TurnTranslate, Error: Error + Send + Sync + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing>,
{
    type Error = RoutineError<R::Error>;

    fn look(&mut self) -> Result<Arrival, Self::Error> {
        self.odometer.begin();
        self.arrive(MoveOutcome::Arrived)
    }

    /// Follows the corridor in `direction` to the next corner or doorway and returns the arrival.
    /// It turns, drives between the walls, and stops before a wall or in the middle of an opening
    /// or doorway. It takes at most some thousand time steps.
    fn go(&mut self, direction: Direction) -> Result<Arrival, Self::Error> {
        self.odometer.begin();
        let ahead = heading_of(direction);
        self.turn_to(ahead)?;
        if self.config.is_closed(self.view(ahead)?.ahead) {
            return self.arrive(MoveOutcome::Blocked);
        }
        self.follow(direction)?;
        self.settle(ahead)?;
        self.arrive(MoveOutcome::Arrived)
    }

    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }

    fn passed(&self) -> &[Landmark] {
        &self.passed
    }
}
