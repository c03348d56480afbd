/* Explores the mazes of mazes.h with the library, and prints each command and the moves of each
   run. In the middle of the search the chip is reset: the map is saved, and loaded by another
   mouse. Or it is carried to another cell. Built for the host and for an emulated chip. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "tolman_mouse.h"
/* It needs the types of the header. */
#include "mazes.h"

#ifdef CHIP
#include "chip.h"
#else
#define MEASURED(worst, call) call
#endif

static tolman_mouse mouse;
static uint8_t saved[TOLMAN_SAVED_BYTES];

/* Columns and rows to north, east, south and west. */
static const int STEP[4][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};

static bool is_open(const uint8_t *maze, int x, int y, int side) {
    return maze[y * TOLMAN_SIDE + x] >> (side % 4) & 1;
}

/* What happens after 60 cells. */
typedef enum { NOTHING, RESET, CARRIED } event;

static const tolman_config CONFIG = {
#ifdef TOLMAN_SIDE_32
    .cell_mm = 90,
    .turn_speed_mm_s = 420,
    .turn_ms = {257, 375, 465, 563, 388, 0},
#else
    .cell_mm = 180,
    .turn_speed_mm_s = 594,
    .turn_ms = {364, 531, 658, 797, 549, 0},
#endif
    .straight_acceleration_mm_s2 = 4200,
    .straight_braking_mm_s2 = 4200,
    .straight_top_speed_mm_s = 1500,
    .diagonal_acceleration_mm_s2 = 3600,
    .diagonal_braking_mm_s2 = 3600,
    .diagonal_top_speed_mm_s = 1200,
};

static int explore(const uint8_t *maze, event event) {
    static const tolman_cell goals[4] = {GOALS};
    static tolman_move run[512];
    int x = 0, y = 0, heading = 0;
    tolman_status begun;
    MEASURED(other, begun = tolman_new(&mouse, &CONFIG, goals, 4));
    if (begun != TOLMAN_OK) return 1;
    for (int cells = 0; cells < 5000; cells++) {
        tolman_command next;
        MEASURED(arrive, next = tolman_arrive(&mouse, is_open(maze, x, y, heading + 3),
                                              is_open(maze, x, y, heading),
                                              is_open(maze, x, y, heading + 1)));
        printf("%d", (int)next);
        if (next == TOLMAN_READY) {
            size_t count;
            MEASURED(other, count = tolman_run(&mouse, run, 512));
            printf("\n");
            for (size_t i = 0; i < count; i++)
                printf("%d %d %d\n", run[i].kind, run[i].amount, run[i].time_ms);
            return 0;
        }
        if (next == TOLMAN_CARRY_BACK) {
            MEASURED(other, tolman_carried_back(&mouse));
            x = y = heading = 0;
        } else if (next > TOLMAN_TO_LEFT) {
            return 1;
        } else if (is_open(maze, x, y, heading + (int)next)) {
            heading = (heading + (int)next) % 4;
            x += STEP[heading][0];
            y += STEP[heading][1];
        } else {
            MEASURED(other, tolman_crashed(&mouse));
        }
        if (cells == 60 && event == RESET) {
            size_t bytes = tolman_save(&mouse, saved, sizeof saved);
            memset(&mouse, 0, sizeof mouse);
            if (tolman_arrive(&mouse, true, true, true) != TOLMAN_NO_MOUSE) return 1;
            if (tolman_new(&mouse, &CONFIG, goals, 4) != TOLMAN_OK) return 1;
            saved[40] ^= 1;
            if (tolman_load(&mouse, saved, bytes) != TOLMAN_BAD_MAP) return 1;
            saved[40] ^= 1;
            tolman_status loaded;
            MEASURED(other, loaded = tolman_load(&mouse, saved, bytes));
            if (loaded != TOLMAN_OK) return 1;
            x = y = heading = 0;
        }
        if (cells == 60 && event == CARRIED) {
            x = 3;
            y = 1;
            for (heading = 0; !is_open(maze, x, y, heading + 2);) heading++;
            heading %= 4;
        }
    }
    return 1;
}

int main(void) {
    for (size_t i = 0; i < sizeof MAZES / sizeof MAZES[0]; i++)
        if (explore(MAZES[i], NOTHING) || explore(MAZES[i], RESET) || explore(MAZES[i], CARRIED)) {
            printf("maze %d failed\n", (int)i);
            return 1;
        }
#ifdef CHIP
    fprintf(stderr, "{\"mouse\":%d,\"stack\":%d,\"arrive\":%d}\n", (int)sizeof mouse,
            (int)stack_bytes, (int)worst_arrive);
#endif
    return 0;
}
