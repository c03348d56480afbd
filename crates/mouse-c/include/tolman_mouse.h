#ifndef TOLMAN_MOUSE_H
#define TOLMAN_MOUSE_H

// Written by cbindgen from crates/mouse-c: `cargo xtask c` compares it with the code.

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#if !defined(TOLMAN_SIDE_32)
// Number of columns and rows of the maze.
#define TOLMAN_SIDE 16
#endif

#if defined(TOLMAN_SIDE_32)
// Number of columns and rows of the maze.
#define TOLMAN_SIDE 32
#endif

#if !(defined(TOLMAN_SIDE_32) || defined(TOLMAN_SMALL))
// Size of a mouse, in 8 bytes.
#define TOLMAN_MOUSE_WORDS 1600
#endif

#if (defined(TOLMAN_SMALL) && !defined(TOLMAN_SIDE_32))
// Size of a mouse, in 8 bytes.
#define TOLMAN_MOUSE_WORDS 1344
#endif

#if defined(TOLMAN_SIDE_32)
// Size of a mouse, in 8 bytes.
#define TOLMAN_MOUSE_WORDS 5000
#endif

// Maximum number of goal cells.
#define TOLMAN_GOALS 9

// Maximum size of a saved map, bytes.
#define TOLMAN_SAVED_BYTES 1024

// What the mouse does next. Sides are as the mouse sees them.
typedef enum tolman_command {
  // Drive to the next cell ahead.
  TOLMAN_AHEAD = 0,
  // Turn right and drive to the next cell.
  TOLMAN_TO_RIGHT = 1,
  // Turn back and drive to the next cell.
  TOLMAN_BACK = 2,
  // Turn left and drive to the next cell.
  TOLMAN_TO_LEFT = 3,
  // Stay: the mouse is at the start, and `tolman_run` gives the fastest run.
  TOLMAN_READY = 4,
  // Stay, to be carried back to the start: then call `tolman_carried_back`.
  TOLMAN_CARRY_BACK = 5,
  // Stay: no way leads to the goal.
  TOLMAN_GIVE_UP = 6,
  // The mouse was not begun here by `tolman_new`, or was moved or copied.
  TOLMAN_NO_MOUSE = 7,
} tolman_command;

// A kind of move.
typedef enum tolman_move_kind {
  // Straight on, by half cells.
  TOLMAN_STRAIGHT = 0,
  // Straight on along a diagonal, by half diagonals of a cell.
  TOLMAN_DIAGONAL = 1,
  // 45° onto a diagonal or off it.
  TOLMAN_F45 = 2,
  // 90° over two cells.
  TOLMAN_F90 = 3,
  // 135° onto a diagonal or off it.
  TOLMAN_F135 = 4,
  // 180° into the cells beside.
  TOLMAN_F180 = 5,
  // 90° from diagonal to diagonal.
  TOLMAN_FV90 = 6,
  // 90° within a cell, from side to side.
  TOLMAN_FS90 = 7,
} tolman_move_kind;

// Result of a call that can fail.
typedef enum tolman_status {
  // It was done.
  TOLMAN_OK = 0,
  // A number of the configuration is impossible: `tolman race --mouse` names it.
  TOLMAN_BAD_CONFIG = 1,
  // There are no goals, too many, or one outside of the maze.
  TOLMAN_BAD_GOALS = 2,
  // The bytes are no map that was saved by this library, or are damaged.
  TOLMAN_BAD_MAP = 3,
  // A pointer is null, or the mouse was not begun here by `tolman_new`.
  TOLMAN_BAD_POINTER = 4,
} tolman_status;

// The side to which a turn goes: the amount of its move.
typedef enum tolman_turn_side {
  // Counter-clockwise.
  TOLMAN_LEFT = 0,
  // Clockwise.
  TOLMAN_RIGHT = 1,
} tolman_turn_side;

// Memory of a mouse. Do not move or copy it: begin with `tolman_new` wherever it lies.
typedef struct tolman_mouse {
  uint64_t memory[TOLMAN_MOUSE_WORDS];
} tolman_mouse;

// How the mouse drives. The command `tolman race --template` explains each number.
typedef struct tolman_config {
  // Distance between the middles of two cells, mm.
  float cell_mm;
  // Speed at the ends of turns and straights, mm/s.
  float turn_speed_mm_s;
  // Acceleration on straights, mm/s².
  float straight_acceleration_mm_s2;
  // Deceleration on straights, mm/s².
  float straight_braking_mm_s2;
  // Top speed on straights, mm/s.
  float straight_top_speed_mm_s;
  // Acceleration on diagonals, mm/s².
  float diagonal_acceleration_mm_s2;
  // Deceleration on diagonals, mm/s².
  float diagonal_braking_mm_s2;
  // Top speed on diagonals, mm/s.
  float diagonal_top_speed_mm_s;
  // Durations of the turns, ms, by `tolman_move_kind` from `TOLMAN_F45` on. 0: never made.
  uint16_t turn_ms[6];
  // Duration of a turn of 90° in place, ms, for a mouse without FS90. 0: never made.
  uint16_t in_place_ms;
} tolman_config;

// A cell, counted from the south-west corner, where the mouse starts.
typedef struct tolman_cell {
  // Column, from 0 in the west.
  uint8_t x;
  // Row, from 0 in the south.
  uint8_t y;
} tolman_cell;

// A move of the fastest run.
typedef struct tolman_move {
  // A `tolman_move_kind`.
  uint8_t kind;
  // Half cells, half diagonals, or a `tolman_turn_side`.
  uint8_t amount;
  // Duration, ms.
  uint16_t time_ms;
} tolman_move;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Begins a mouse at the start of a maze that it has never seen, in `mouse`.
//
// # Safety
// `mouse` and `config` must point to one each, and `goals` to `goal_count` cells, or be null.
enum tolman_status tolman_new(struct tolman_mouse *mouse,
                              const struct tolman_config *config,
                              const struct tolman_cell *goals,
                              size_t goal_count);

// Tells the mouse which sides of its cell are open, and returns what it does next. Call it in the
// start first, and then in each cell, as soon as the mouse sees its walls: it may drive on
// meanwhile. The answer has to come before the mouse reaches the middle of the cell, where it may
// turn.
//
// # Safety
// `mouse` must be null or point to memory for a mouse.
enum tolman_command tolman_arrive(struct tolman_mouse *mouse,
                                  bool left_is_open,
                                  bool ahead_is_open,
                                  bool right_is_open);

// Tells the mouse that it has crashed and may have lost its way. It forgets what it saw last, and
// looks for its place. It must stand in a cell, with an open side behind it.
//
// # Safety
// `mouse` must be null or point to memory for a mouse.
enum tolman_status tolman_crashed(struct tolman_mouse *mouse);

// Tells the mouse that it was carried back to the start.
//
// # Safety
// `mouse` must be null or point to memory for a mouse.
enum tolman_status tolman_carried_back(struct tolman_mouse *mouse);

// Writes the moves of the fastest run to `moves`, as many as `capacity` allows, and returns how
// many it has. Call it when the mouse is ready. 0: no run is known.
//
// # Safety
// `mouse` must be null or point to memory for a mouse, and `moves` to room for `capacity` moves.
size_t tolman_run(struct tolman_mouse *mouse, struct tolman_move *moves, size_t capacity);

// Writes the mouse's map to `bytes`, to be kept over a reset, and returns how many bytes it has:
// at most `TOLMAN_SAVED_BYTES`. 0: `capacity` is too small.
//
// # Safety
// `mouse` must be null or point to memory for a mouse, and `bytes` to room for `capacity` bytes.
size_t tolman_save(struct tolman_mouse *mouse, uint8_t *bytes, size_t capacity);

// Puts the mouse at the start with the map that was saved. A damaged map changes nothing.
//
// # Safety
// `mouse` must be null or point to memory for a mouse, and `bytes` to `count` bytes.
enum tolman_status tolman_load(struct tolman_mouse *mouse, const uint8_t *bytes, size_t count);

#ifdef __cplusplus
} // extern "C"
#endif // __cplusplus

#endif /* TOLMAN_MOUSE_H */
