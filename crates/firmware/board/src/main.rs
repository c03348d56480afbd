//! A classic micromouse on a Cortex-M4. QEMU emulates the chip; its sensors and motors are
//! simulated on drawings. For each maze it prints a line of JSON: how many instructions the longest
//! decision took while the mouse knew its place, and while it did not, and what the moves of the
//! run took. The last line says how many bytes of memory were used.
#![no_std]
#![no_main]

use core::panic::PanicInfo;
use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{entry, exception};
use cortex_m_semihosting::{debug, hprintln};
use tolman_firmware::{Command, Mouse, Sides};
use tolman_maze::{Cell, Direction};
use tolman_planners::speed_run::{RunStep, SpeedRunConfig, SpeedRunTimes};

/// Name, goals and open sides of each maze.
static MAZES: &[(&str, &[Cell], [u8; 256])] = include!(concat!(env!("OUT_DIR"), "/mazes.rs"));

/// Number of cells after which the mouse is put down elsewhere.
const CARRIED: u32 = 60;

/// Where it is put down. It is turned until the side behind it is open.
const ELSEWHERE: Cell = Cell::new(3, 1);

/// A word that the stack has not reached.
const PAINT: u32 = 0xcafe_f00d;

/// Instructions in two ticks of the timer, which ticks at 25 MHz. An instruction takes 16 ns.
const HALF_INSTRUCTIONS: u32 = 5;

/// Where the stack grows, from the end, and what it has not reached, from the beginning. All but
/// the last kilobyte of the chip's memory, and above all other variables.
#[unsafe(link_section = ".uninit.STACK")]
static STACK: [AtomicU32; 63 << 8] = [const { AtomicU32::new(0) }; 63 << 8];

/// A simulated mouse.
struct Body {
    /// Open sides of each cell.
    open: &'static [u8; 256],
    cell: Cell,
    heading: Direction,
}

impl Body {
    fn is_open(&self, side: Direction) -> bool {
        let sides = self.open.get(usize::from(self.cell.y * 16 + self.cell.x));
        sides.is_some_and(|sides| sides >> self.heading.turned(side).index() & 1 == 1)
    }

    fn look(&self) -> Sides {
        Sides::read(|side| self.is_open(side))
    }

    fn drive(&mut self, side: Direction) -> bool {
        let is_open = self.is_open(side);
        if is_open {
            self.heading = self.heading.turned(side);
            let (east, north) = self.heading.step();
            self.cell.x = self.cell.x.wrapping_add_signed(east.into());
            self.cell.y = self.cell.y.wrapping_add_signed(north.into());
        }
        is_open
    }

    fn put(&mut self, cell: Cell) {
        self.cell = cell;
        self.heading = Direction::North;
        while !self.is_open(Direction::South) {
            self.heading = self.heading.right();
        }
    }
}

/// Returns what a computation returns, and the number of instructions it took.
fn timed<T>(timer: &mut SYST, compute: impl FnOnce() -> T) -> (T, u32) {
    timer.clear_current();
    let result = compute();
    let ticks = SYST::get_reload() - SYST::get_current();
    (result, ticks / 2 * HALF_INSTRUCTIONS)
}

/// Most instructions of a decision.
#[derive(Default)]
struct Worst {
    located: u32,
    lost: u32,
}

fn explore(
    timer: &mut SYST,
    mouse: &mut Mouse<'_>,
    body: &mut Body,
    carried: Option<u32>,
) -> Option<(u32, u32, Worst)> {
    let mut worst = Worst::default();
    for cells in 0..5000 {
        let seen = body.look();
        let was_lost = mouse.is_lost();
        let (command, instructions) = timed(timer, || mouse.arrive(seen));
        let kind = if was_lost || mouse.is_lost() {
            &mut worst.lost
        } else {
            &mut worst.located
        };
        *kind = instructions.max(*kind);
        match command.ok()? {
            Command::Drive(side) if body.drive(side) => {}
            Command::Drive(_) => mouse.crash().ok()?,
            Command::Ready { run_ms } => return Some((run_ms, cells, worst)),
            Command::CarryBack => {
                body.cell = Cell::new(0, 0);
                body.heading = Direction::North;
                mouse.carried_back();
            }
            Command::GiveUp => return None,
        }
        if carried == Some(cells) {
            body.put(ELSEWHERE);
        }
    }
    None
}

/// Explores a maze and prints what it took. Returns the duration of the fastest run, ms.
fn trial(
    timer: &mut SYST,
    times: &SpeedRunTimes<16>,
    maze: usize,
    carried: Option<u32>,
) -> Option<u32> {
    let (name, goals, open) = MAZES.get(maze)?;
    let mut mouse = Mouse::new(times, goals);
    let mut body = Body {
        open,
        cell: Cell::new(0, 0),
        heading: Direction::North,
    };
    let (run_ms, cells, worst) = explore(timer, &mut mouse, &mut body, carried)?;
    let mut moves = 0;
    let (run, moves_took) = timed(timer, || mouse.run(|_: RunStep| moves += 1));
    run.ok()?;
    hprintln!(
        "{{\"maze\":\"{}\",\"carried\":{},\"cells\":{},\"run_ms\":{},\"moves\":{},\"located\":{},\"lost\":{},\"run\":{}}}",
        name,
        carried.is_some(),
        cells,
        run_ms,
        moves,
        worst.located,
        worst.lost,
        moves_took
    );
    Some(run_ms)
}

#[inline(never)]
fn run() -> Option<()> {
    let mut timer = cortex_m::Peripherals::take()?.SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(0x00ff_ffff);
    timer.enable_counter();
    let times = SpeedRunTimes::new(&SpeedRunConfig::classic()).ok()?;
    for maze in 0..MAZES.len() {
        let undisturbed = trial(&mut timer, &times, maze, None)?;
        let carried = trial(&mut timer, &times, maze, Some(CARRIED))?;
        if undisturbed != carried {
            hprintln!("a mouse that was carried found another run");
            return None;
        }
    }
    Some(())
}

fn end(status: debug::ExitStatus) -> ! {
    debug::exit(status);
    loop {
        cortex_m::asm::wfi();
    }
}

#[entry]
fn main() -> ! {
    for word in &STACK {
        word.store(PAINT, Ordering::Relaxed);
    }
    let done = run();
    let is_painted = |word: &&AtomicU32| word.load(Ordering::Relaxed) == PAINT;
    let free = STACK.iter().take_while(is_painted).count() * 4;
    hprintln!("{{\"memory\":{}}}", (64 << 10) - free);
    end(done.map_or(debug::EXIT_FAILURE, |()| debug::EXIT_SUCCESS))
}

/// A fault of the chip ends the program.
#[exception]
unsafe fn HardFault(_: &cortex_m_rt::ExceptionFrame) -> ! {
    end(debug::EXIT_FAILURE)
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    end(debug::EXIT_FAILURE)
}
