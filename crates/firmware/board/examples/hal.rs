//! The mouse on any chip whose pins and motors have `embedded-hal`: three sensors, two motors, a
//! clock. Embassy's drivers have these traits, too. Speeds and times are yours.
#![no_std]
#![no_main]

use core::panic::PanicInfo;

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::InputPin;
use embedded_hal::pwm::SetDutyCycle;
use tolman_firmware::{Command, Mouse, Sides};
use tolman_maze::{Cell, Direction};
use tolman_planners::speed_run::{RunStep, SpeedRunTimes};

/// The hardware. A sensor's pin is low where it sees a wall.
pub struct Body<S, M, D> {
    left: S,
    ahead: S,
    right: S,
    wheels: [M; 2],
    delay: D,
}

impl<S: InputPin, M: SetDutyCycle, D: DelayNs> Body<S, M, D> {
    fn look(&mut self) -> Result<Sides, S::Error> {
        Ok(Sides {
            left: self.left.is_high()?,
            ahead: self.ahead.is_high()?,
            right: self.right.is_high()?,
        })
    }

    fn drive(&mut self, percent: [u8; 2], ms: u32) -> Result<(), M::Error> {
        for (wheel, percent) in self.wheels.iter_mut().zip(percent) {
            wheel.set_duty_cycle_percent(percent)?;
        }
        self.delay.delay_ms(ms);
        Ok(())
    }

    fn turn(&mut self, side: Direction) -> Result<(), M::Error> {
        match side {
            Direction::North => Ok(()),
            Direction::East => self.drive([40, 0], 300),
            Direction::South => self.drive([40, 0], 600),
            Direction::West => self.drive([0, 40], 300),
        }
    }
}

/// What ends an exploration.
pub enum End<S, M> {
    /// The mouse is at the start, and was told the moves of its fastest run.
    Ready,
    /// No way leads to the goal.
    Lost,
    /// A sensor failed.
    Sensor(S),
    /// A motor failed.
    Motor(M),
}

/// Explores a classic maze, and tells the moves of the fastest run.
pub fn explore<S: InputPin, M: SetDutyCycle, D: DelayNs>(
    body: &mut Body<S, M, D>,
    times: &SpeedRunTimes<16>,
    goals: &[Cell],
    each: impl FnMut(RunStep),
) -> End<S::Error, M::Error> {
    let mut mouse = Mouse::new(times, goals);
    loop {
        let seen = match body.look() {
            Ok(seen) => seen,
            Err(error) => return End::Sensor(error),
        };
        // The walls are seen at the cell's side, and half a cell is left to decide.
        let side = match mouse.arrive(seen) {
            Ok(Command::Drive(side)) => side,
            Ok(Command::Ready { .. }) => {
                return mouse.run(each).map_or(End::Lost, |()| End::Ready);
            }
            Ok(Command::CarryBack) => {
                body.delay.delay_ms(10_000);
                mouse.carried_back();
                continue;
            }
            Ok(Command::GiveUp) | Err(_) => return End::Lost,
        };
        let driven = body
            .drive([40, 40], 300)
            .and_then(|()| body.turn(side))
            .and_then(|()| body.drive([40, 40], 300));
        if let Err(error) = driven {
            return End::Motor(error);
        }
    }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}
