//! The mouse of `tolman-firmware` for C and C++.
//!
//! `include/tolman_mouse.h` is made of this file. A program links the static library, gives the
//! mouse memory of its own, and calls `tolman_arrive` in each cell. No call allocates, blocks or
//! panics, and none keeps a pointer that it was given, except the mouse itself: its memory must not
//! be moved or copied.
#![cfg_attr(target_os = "none", no_std)]
#![allow(non_camel_case_types, reason = "the names are those of C")]

mod saved;

use core::mem::{MaybeUninit, align_of, size_of};
use core::{ptr, slice};

use tolman_firmware::{Command, Mouse, Sides};
use tolman_maze::{Cell, Direction};
use tolman_planners::speed_run::{
    RunMove, Side, Slalom, SlalomTurn, SlalomTurns, SpeedRunConfig, SpeedRunMap, SpeedRunTimes,
};

/// Number of columns and rows of the maze.
#[cfg(not(feature = "side-32"))]
pub const TOLMAN_SIDE: usize = 16;
/// Number of columns and rows of the maze.
#[cfg(feature = "side-32")]
pub const TOLMAN_SIDE: usize = 32;

/// Size of a mouse, in 8 bytes.
#[cfg(not(any(feature = "side-32", feature = "small")))]
pub const TOLMAN_MOUSE_WORDS: usize = 1600;
/// Size of a mouse, in 8 bytes.
#[cfg(all(feature = "small", not(feature = "side-32")))]
pub const TOLMAN_MOUSE_WORDS: usize = 1344;
/// Size of a mouse, in 8 bytes.
#[cfg(feature = "side-32")]
pub const TOLMAN_MOUSE_WORDS: usize = 5000;

/// Maximum number of goal cells.
pub const TOLMAN_GOALS: usize = 9;

/// Maximum size of a saved map, bytes.
pub const TOLMAN_SAVED_BYTES: usize = 1024;

/// With four states of each cell for turns within it, if there is memory for them.
#[cfg(not(any(feature = "side-32", feature = "small")))]
type Times = [u16; 16];
#[cfg(any(feature = "side-32", feature = "small"))]
type Times = [u16; 12];

/// Memory of a mouse. Do not move or copy it: begin with `tolman_new` wherever it lies.
#[repr(C)]
pub struct tolman_mouse {
    memory: [MaybeUninit<u64>; TOLMAN_MOUSE_WORDS],
}

/// A cell, counted from the south-west corner, where the mouse starts.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tolman_cell {
    /// Column, from 0 in the west.
    pub x: u8,
    /// Row, from 0 in the south.
    pub y: u8,
}

/// How the mouse drives. The command `tolman race --template` explains each number.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tolman_config {
    /// Distance between the middles of two cells, mm.
    pub cell_mm: f32,
    /// Speed at the ends of turns and straights, mm/s.
    pub turn_speed_mm_s: f32,
    /// Acceleration on straights, mm/s².
    pub straight_acceleration_mm_s2: f32,
    /// Deceleration on straights, mm/s².
    pub straight_braking_mm_s2: f32,
    /// Top speed on straights, mm/s.
    pub straight_top_speed_mm_s: f32,
    /// Acceleration on diagonals, mm/s².
    pub diagonal_acceleration_mm_s2: f32,
    /// Deceleration on diagonals, mm/s².
    pub diagonal_braking_mm_s2: f32,
    /// Top speed on diagonals, mm/s.
    pub diagonal_top_speed_mm_s: f32,
    /// Durations of the turns, ms, by `tolman_move_kind` from `TOLMAN_F45` on. 0: never made.
    pub turn_ms: [u16; 6],
    /// Duration of a turn of 90° in place, ms, for a mouse without FS90. 0: never made.
    pub in_place_ms: u16,
}

/// What the mouse does next. Sides are as the mouse sees them.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum tolman_command {
    /// Drive to the next cell ahead.
    TOLMAN_AHEAD = 0,
    /// Turn right and drive to the next cell.
    TOLMAN_TO_RIGHT = 1,
    /// Turn back and drive to the next cell.
    TOLMAN_BACK = 2,
    /// Turn left and drive to the next cell.
    TOLMAN_TO_LEFT = 3,
    /// Stay: the mouse is at the start, and `tolman_run` gives the fastest run.
    TOLMAN_READY = 4,
    /// Stay, to be carried back to the start: then call `tolman_carried_back`.
    TOLMAN_CARRY_BACK = 5,
    /// Stay: no way leads to the goal.
    TOLMAN_GIVE_UP = 6,
    /// The mouse was not begun here by `tolman_new`, or was moved or copied.
    TOLMAN_NO_MOUSE = 7,
}

/// Result of a call that can fail.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum tolman_status {
    /// It was done.
    TOLMAN_OK = 0,
    /// A number of the configuration is impossible: `tolman race --mouse` names it.
    TOLMAN_BAD_CONFIG = 1,
    /// There are no goals, too many, or one outside of the maze.
    TOLMAN_BAD_GOALS = 2,
    /// The bytes are no map that was saved by this library, or are damaged.
    TOLMAN_BAD_MAP = 3,
    /// A pointer is null, or the mouse was not begun here by `tolman_new`.
    TOLMAN_BAD_POINTER = 4,
}

/// A kind of move.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum tolman_move_kind {
    /// Straight on, by half cells.
    TOLMAN_STRAIGHT = 0,
    /// Straight on along a diagonal, by half diagonals of a cell.
    TOLMAN_DIAGONAL = 1,
    /// 45° onto a diagonal or off it.
    TOLMAN_F45 = 2,
    /// 90° over two cells.
    TOLMAN_F90 = 3,
    /// 135° onto a diagonal or off it.
    TOLMAN_F135 = 4,
    /// 180° into the cells beside.
    TOLMAN_F180 = 5,
    /// 90° from diagonal to diagonal.
    TOLMAN_FV90 = 6,
    /// 90° within a cell, from side to side.
    TOLMAN_FS90 = 7,
}

/// The side to which a turn goes: the amount of its move.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum tolman_turn_side {
    /// Counter-clockwise.
    TOLMAN_LEFT = 0,
    /// Clockwise.
    TOLMAN_RIGHT = 1,
}

/// A move of the fastest run.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct tolman_move {
    /// A `tolman_move_kind`.
    pub kind: u8,
    /// Half cells, half diagonals, or a `tolman_turn_side`.
    pub amount: u8,
    /// Duration, ms.
    pub time_ms: u16,
}

type Map = SpeedRunMap<TOLMAN_SIDE, Times>;

/// The mouse, with the map of its runs beside it: so large a map is never passed over the stack.
type Begun = Mouse<'static, TOLMAN_SIDE, Times, &'static mut Map>;

struct Inner {
    /// Where the mouse was begun. Elsewhere its references lead astray.
    at: *const tolman_mouse,
    times: SpeedRunTimes<TOLMAN_SIDE>,
    goals: [Cell; TOLMAN_GOALS],
    map: Map,
    mouse: Begun,
}

const _: () = assert!(size_of::<Inner>() <= size_of::<tolman_mouse>());
const _: () = assert!(align_of::<Inner>() <= align_of::<tolman_mouse>());

/// Begins a mouse at the start of a maze that it has never seen, in `mouse`.
///
/// # Safety
/// `mouse` and `config` must point to one each, and `goals` to `goal_count` cells, or be null.
#[no_mangle]
pub unsafe extern "C" fn tolman_new(
    mouse: *mut tolman_mouse,
    config: *const tolman_config,
    goals: *const tolman_cell,
    goal_count: usize,
) -> tolman_status {
    if mouse.is_null() || config.is_null() || goals.is_null() {
        return tolman_status::TOLMAN_BAD_POINTER;
    }
    // SAFETY: the caller promises one configuration.
    let config = unsafe { *config };
    if goal_count == 0 || goal_count > TOLMAN_GOALS {
        return tolman_status::TOLMAN_BAD_GOALS;
    }
    // SAFETY: the caller promises as many cells.
    let given = unsafe { slice::from_raw_parts(goals, goal_count) };
    let mut goals = [Cell::new(0, 0); TOLMAN_GOALS];
    for (goal, given) in goals.iter_mut().zip(given) {
        if usize::from(given.x.max(given.y)) >= TOLMAN_SIDE {
            return tolman_status::TOLMAN_BAD_GOALS;
        }
        *goal = Cell::new(given.x.into(), given.y.into());
    }
    let Ok(times) = SpeedRunTimes::new(&run_config(&config)) else {
        return tolman_status::TOLMAN_BAD_CONFIG;
    };
    let inner = mouse.cast::<Inner>();
    // SAFETY: the memory is large enough and aligned, and belongs to the caller, who does not touch
    // it meanwhile. Times, goals and map are written before the mouse that refers to them, and stay
    // where they are as long as `at` says so. The map consists of integers, which zeros are.
    unsafe {
        ptr::addr_of_mut!((*inner).times).write(times);
        ptr::addr_of_mut!((*inner).goals).write(goals);
        let times: &'static SpeedRunTimes<TOLMAN_SIDE> = &*ptr::addr_of!((*inner).times);
        let goals = slice::from_raw_parts(ptr::addr_of!((*inner).goals).cast::<Cell>(), goal_count);
        let map = ptr::addr_of_mut!((*inner).map);
        map.write_bytes(0, 1);
        let map = &mut *map;
        map.clear();
        ptr::addr_of_mut!((*inner).mouse).write(Begun::with_map(times, goals, map));
        ptr::addr_of_mut!((*inner).at).write(mouse);
    }
    tolman_status::TOLMAN_OK
}

/// Tells the mouse which sides of its cell are open, and returns what it does next. Call it in the
/// start first, and then in each cell, as soon as the mouse sees its walls: it may drive on
/// meanwhile. The answer has to come before the mouse reaches the middle of the cell, where it may
/// turn.
///
/// # Safety
/// `mouse` must be null or point to memory for a mouse.
#[no_mangle]
pub unsafe extern "C" fn tolman_arrive(
    mouse: *mut tolman_mouse,
    left_is_open: bool,
    ahead_is_open: bool,
    right_is_open: bool,
) -> tolman_command {
    // SAFETY: as the caller promises.
    let Some(mouse) = (unsafe { begun(mouse) }) else {
        return tolman_command::TOLMAN_NO_MOUSE;
    };
    let seen = Sides {
        left: left_is_open,
        ahead: ahead_is_open,
        right: right_is_open,
    };
    match mouse.arrive(seen) {
        Ok(Command::Drive(Direction::North)) => tolman_command::TOLMAN_AHEAD,
        Ok(Command::Drive(Direction::East)) => tolman_command::TOLMAN_TO_RIGHT,
        Ok(Command::Drive(Direction::South)) => tolman_command::TOLMAN_BACK,
        Ok(Command::Drive(Direction::West)) => tolman_command::TOLMAN_TO_LEFT,
        Ok(Command::Ready { .. }) => tolman_command::TOLMAN_READY,
        Ok(Command::CarryBack) => tolman_command::TOLMAN_CARRY_BACK,
        Ok(Command::GiveUp) | Err(_) => tolman_command::TOLMAN_GIVE_UP,
    }
}

/// Tells the mouse that it has crashed and may have lost its way. It forgets what it saw last, and
/// looks for its place. It must stand in a cell, with an open side behind it.
///
/// # Safety
/// `mouse` must be null or point to memory for a mouse.
#[no_mangle]
pub unsafe extern "C" fn tolman_crashed(mouse: *mut tolman_mouse) -> tolman_status {
    // SAFETY: as the caller promises.
    match unsafe { begun(mouse) }.map(Begun::crash) {
        Some(Ok(())) => tolman_status::TOLMAN_OK,
        _ => tolman_status::TOLMAN_BAD_POINTER,
    }
}

/// Tells the mouse that it was carried back to the start.
///
/// # Safety
/// `mouse` must be null or point to memory for a mouse.
#[no_mangle]
pub unsafe extern "C" fn tolman_carried_back(mouse: *mut tolman_mouse) -> tolman_status {
    // SAFETY: as the caller promises.
    match unsafe { begun(mouse) }.map(Begun::carried_back) {
        Some(()) => tolman_status::TOLMAN_OK,
        None => tolman_status::TOLMAN_BAD_POINTER,
    }
}

/// Writes the moves of the fastest run to `moves`, as many as `capacity` allows, and returns how
/// many it has. Call it when the mouse is ready. 0: no run is known.
///
/// # Safety
/// `mouse` must be null or point to memory for a mouse, and `moves` to room for `capacity` moves.
#[no_mangle]
pub unsafe extern "C" fn tolman_run(
    mouse: *mut tolman_mouse,
    moves: *mut tolman_move,
    capacity: usize,
) -> usize {
    // SAFETY: as the caller promises; the times lie beside the mouse.
    let (Some(begun), true) = (unsafe { begun(mouse) }, !moves.is_null() || capacity == 0) else {
        return 0;
    };
    // SAFETY: the mouse was begun here, so its times were written.
    let times = unsafe { &*ptr::addr_of!((*mouse.cast::<Inner>()).times) };
    let mut count = 0;
    let result = begun.run(|step| {
        if count < capacity {
            let (kind, amount) = told(step.run_move);
            let time_ms = times.of(step.run_move).unwrap_or(0) as u16;
            // SAFETY: `count` is within the caller's room.
            unsafe {
                moves.add(count).write(tolman_move {
                    kind: kind as u8,
                    amount,
                    time_ms,
                })
            };
        }
        count += 1;
    });
    if result.is_ok() { count } else { 0 }
}

/// Writes the mouse's map to `bytes`, to be kept over a reset, and returns how many bytes it has:
/// at most `TOLMAN_SAVED_BYTES`. 0: `capacity` is too small.
///
/// # Safety
/// `mouse` must be null or point to memory for a mouse, and `bytes` to room for `capacity` bytes.
#[no_mangle]
pub unsafe extern "C" fn tolman_save(
    mouse: *mut tolman_mouse,
    bytes: *mut u8,
    capacity: usize,
) -> usize {
    // SAFETY: as the caller promises.
    let (Some(mouse), false) = (unsafe { begun(mouse) }, bytes.is_null()) else {
        return 0;
    };
    if capacity < saved::BYTES {
        return 0;
    }
    // SAFETY: the caller promises that much room, which may be uninitialized.
    unsafe { ptr::write_bytes(bytes, 0, saved::BYTES) };
    // SAFETY: it was just written.
    saved::save(mouse.walls(), unsafe {
        slice::from_raw_parts_mut(bytes, saved::BYTES)
    });
    saved::BYTES
}

/// Puts the mouse at the start with the map that was saved. A damaged map changes nothing.
///
/// # Safety
/// `mouse` must be null or point to memory for a mouse, and `bytes` to `count` bytes.
#[no_mangle]
pub unsafe extern "C" fn tolman_load(
    mouse: *mut tolman_mouse,
    bytes: *const u8,
    count: usize,
) -> tolman_status {
    // SAFETY: as the caller promises.
    let (Some(mouse), false) = (unsafe { begun(mouse) }, bytes.is_null()) else {
        return tolman_status::TOLMAN_BAD_POINTER;
    };
    // SAFETY: the caller promises as many bytes.
    let bytes = unsafe { slice::from_raw_parts(bytes, count) };
    let restored =
        saved::is_whole(bytes).then(|| mouse.restore(|cell, side| saved::wall(bytes, cell, side)));
    match restored {
        Some(Ok(())) => tolman_status::TOLMAN_OK,
        _ => tolman_status::TOLMAN_BAD_MAP,
    }
}

/// Returns the mouse, if it was begun here.
///
/// # Safety
/// `mouse` must be null or point to memory for a mouse, which nothing else uses meanwhile.
unsafe fn begun<'a>(mouse: *mut tolman_mouse) -> Option<&'a mut Begun> {
    if mouse.is_null() {
        return None;
    }
    let inner = mouse.cast::<Inner>();
    // SAFETY: `at` is read as any bits, and equals this address only after `tolman_new`.
    unsafe {
        let at = ptr::addr_of!((*inner).at).read();
        (at == mouse.cast_const()).then(|| &mut *ptr::addr_of_mut!((*inner).mouse))
    }
}

fn run_config(config: &tolman_config) -> SpeedRunConfig {
    let mut run = SpeedRunConfig::classic();
    let wide = f64::from;
    run.cell_mm = wide(config.cell_mm);
    run.turn_speed_mm_s = wide(config.turn_speed_mm_s);
    run.straight.acceleration_mm_s2 = wide(config.straight_acceleration_mm_s2);
    run.straight.braking_mm_s2 = Some(wide(config.straight_braking_mm_s2));
    run.straight.top_speed_mm_s = wide(config.straight_top_speed_mm_s);
    run.diagonal.acceleration_mm_s2 = wide(config.diagonal_acceleration_mm_s2);
    run.diagonal.braking_mm_s2 = Some(wide(config.diagonal_braking_mm_s2));
    run.diagonal.top_speed_mm_s = wide(config.diagonal_top_speed_mm_s);
    let turn = |ms: u16| (ms > 0).then_some(SlalomTurn::Timed { time_ms: ms.into() });
    let [f45, f90, f135, f180, fv90, fs90] = config.turn_ms.map(turn);
    let mut slalom = SlalomTurns::NONE;
    (slalom.f45, slalom.f90, slalom.f135) = (f45, f90, f135);
    (slalom.f180, slalom.fv90, slalom.fs90) = (f180, fv90, fs90);
    slalom.in_place_ms = (config.in_place_ms > 0).then_some(config.in_place_ms.into());
    run.slalom = slalom;
    run
}

fn told(run_move: RunMove) -> (tolman_move_kind, u8) {
    match run_move {
        // At most 63 half cells, or half diagonals, fit into the largest maze.
        RunMove::Straight { half_cells } => (tolman_move_kind::TOLMAN_STRAIGHT, half_cells as u8),
        RunMove::Diagonal { cells } => (tolman_move_kind::TOLMAN_DIAGONAL, cells as u8),
        RunMove::Turn { slalom, side } => {
            let kind = match slalom {
                Slalom::F45 => tolman_move_kind::TOLMAN_F45,
                Slalom::F90 => tolman_move_kind::TOLMAN_F90,
                Slalom::F135 => tolman_move_kind::TOLMAN_F135,
                Slalom::F180 => tolman_move_kind::TOLMAN_F180,
                Slalom::Fv90 => tolman_move_kind::TOLMAN_FV90,
                Slalom::Fs90 => tolman_move_kind::TOLMAN_FS90,
            };
            let side = match side {
                Side::Left => tolman_turn_side::TOLMAN_LEFT,
                Side::Right => tolman_turn_side::TOLMAN_RIGHT,
            };
            (kind, side as u8)
        }
    }
}

/// Nothing here panics; what the compiler cannot see stops the mouse.
#[cfg(all(target_os = "none", not(test)))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
