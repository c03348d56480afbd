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
    routine: Routine,
    /// Number of time steps of the routine since it began or went on.
    steps: u32,
    /// Number of time steps in a row of which odometry told nothing.
    unseen: u32,
    /// Landmark at which the robot breaks off.
    sought: Option<Landmark>,
    /// Landmarks that were sensed.
    passed: Vec<Landmark>,
}

/// Progress of a routine. One that broke off goes on with it.
#[derive(Clone, Debug)]
pub(super) struct Routine {
    /// Direction of the way; `None` if no routine is under way.
    direction: Option<Direction>,
    odometer: Odometer,
    /// Position on the way, m.
    along: f64,
    /// Openings and doorways beside the way; `None` before the robot drives.
    beside: Option<Beside>,
    /// Position of the next place on the way, m, once it is known.
    end: Option<f64>,
}

impl Routine {
    /// Begins a routine in `direction`; in none, the robot only looks.
    fn begin(&mut self, direction: Option<Direction>) {
        self.odometer.begin();
        (self.direction, self.along) = (direction, 0.0);
        (self.beside, self.end) = (None, None);
    }

    /// Turns back to where the routine began.
    fn turn_back(&mut self) {
        self.direction = self.direction.map(Direction::opposite);
        self.along *= -1.0;
        let is_beside = self.beside.as_mut().is_some_and(Beside::turn_back);
        self.end = is_beside.then_some(0.0);
    }
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
            routine: Routine {
                direction: None,
                odometer: Odometer::new(config.odometry_share, config.compass_bound),
                along: 0.0,
                beside: None,
                end: None,
            },
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

    /// Goes on with a routine that broke off when it is asked for the same direction.
    #[must_use]
    pub(super) fn going_on(self, routine: Option<Routine>) -> Self {
        Self {
            routine: routine.unwrap_or(self.routine),
            ..self
        }
    }

    /// Returns the routine that broke off; `None` if the last one ended.
    pub(super) fn broken_off(self) -> Option<Routine> {
        self.routine.direction.is_some().then_some(self.routine)
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
    /// Returns whether there is a way at all.
    fn follow(&mut self, direction: Direction) -> Result<bool, RoutineError<R::Error>> {
        let (gauge, ahead) = (self.config, heading_of(direction));
        self.steps = 0;
        self.turn_to(ahead)?;
        if self.routine.beside.is_none() && gauge.is_closed(self.view(ahead)?.ahead) {
            return Ok(false);
        }
        while self.routine.end.is_none() {
            let view = self.view(ahead)?;
            let along = self.routine.along;
            let at_start = || Beside::at_start(view, &gauge);
            let beside = self.routine.beside.get_or_insert_with(at_start);
            let room = view.ahead - gauge.half();
            if let Some(middle) = beside.see(view, along, &gauge) {
                // Beginning and end are noticed half a stride late.
                self.routine.end = Some(middle - 0.5 * gauge.stride());
            } else if room < 0.2 * gauge.stride() {
                self.routine.end = Some(along);
            } else {
                self.drive_on(direction, view, gauge.stride().min(room))?;
            }
        }
        self.drive_to_end(direction)?;
        self.settle(ahead)?;
        Ok(true)
    }

    /// Drives to the end of the way, backward if the robot is past it.
    fn drive_to_end(&mut self, direction: Direction) -> Result<(), RoutineError<R::Error>> {
        let stride = self.config.stride();
        loop {
            let Routine { along, end, .. } = self.routine;
            let left = end.map_or(0.0, |end| end - along);
            let view = self.view(heading_of(direction))?;
            let is_shut = left > 0.0 && view.ahead - self.config.half() < 0.2 * stride;
            if left.abs() <= 0.2 * stride || is_shut {
                return Ok(());
            }
            self.drive_on(direction, view, left.clamp(-stride, stride))?;
        }
    }

    /// Breaks off at the landmark that is sought.
    fn break_off(&self) -> Result<(), RoutineError<R::Error>> {
        match self.sought {
            Some(_) if self.sought == self.robot.landmark() => Err(RoutineError::Found),
            _ => Ok(()),
        }
    }

    /// Drives `distance`, m, along the way, and breaks off at the landmark that is sought.
    fn drive_on(
        &mut self,
        direction: Direction,
        view: View,
        distance: f64,
    ) -> Result<(), RoutineError<R::Error>> {
        self.routine.along += self.drive(heading_of(direction), view, distance)?;
        self.break_off()?;
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
            self.routine.odometer.roll(distance, before, after)?;
            return Ok(distance);
        }
        self.unseen += 1;
        if self.unseen > MOST_SILENT {
            return Err(SenseError::Blind { sensor: "odometry" }.into());
        }
        let asked = command.translate * self.config.translate_per_step;
        self.routine.odometer.roll_unseen(asked, before, after)?;
        Ok(asked)
    }

    /// Makes one time step, and notes the landmark that the robot senses then.
    fn step(&mut self, command: &TurnTranslate) -> Result<(), RoutineError<R::Error>> {
        self.robot.step(command).map_err(RoutineError::Robot)?;
        let here = self.robot.landmark();
        if let Some(landmark) = here.filter(|landmark| !self.passed.contains(landmark)) {
            self.passed.push(landmark);
        }
        Ok(())
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
            self.break_off()?;
        }
        let Offset { aside, .. } = self.offset(ahead)?;
        if aside.abs() > SETTLED {
            let left = ahead.turned(FRAC_PI_2);
            self.turn_to(left)?;
            self.command(0.0, -aside)?;
            self.break_off()?;
        }
        Ok(())
    }

    /// Ends a routine standing still, and returns the arrival with the view of the place.
    fn arrive(&mut self, outcome: MoveOutcome) -> Result<Arrival, RoutineError<R::Error>> {
        self.step(&TurnTranslate::STOP)?;
        let moved = self.routine.odometer.moved();
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
        self.routine.begin(None);
        self.arrive(MoveOutcome::Arrived)
    }

    /// Follows the corridor in `direction` to the next corner or doorway and returns the arrival.
    /// It turns, drives between the walls, and stops before a wall or in the middle of an opening
    /// or doorway. It takes at most some thousand time steps.
    fn go(&mut self, direction: Direction) -> Result<Arrival, Self::Error> {
        match self.routine.direction {
            Some(way) if way == direction => {}
            Some(way) if way == direction.opposite() && self.left_behind().is_some() => {
                self.routine.turn_back();
            }
            _ => self.routine.begin(Some(direction)),
        }
        let outcome = match self.follow(direction)? {
            true => MoveOutcome::Arrived,
            false => MoveOutcome::Blocked,
        };
        let arrival = self.arrive(outcome)?;
        self.routine.direction = None;
        Ok(arrival)
    }

    fn left_behind(&self) -> Option<f64> {
        let Routine {
            direction,
            end,
            along,
            ..
        } = self.routine;
        (direction.is_some() && end.is_none()).then_some(along)
    }

    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }

    fn passed(&self) -> &[Landmark] {
        &self.passed
    }
}
