/* Explores the mazes of mazes.h with the library, and prints each command and the moves of each
   run. In the middle of the search the chip is reset: the map is saved, and loaded by another
   mouse. Built for the host and for an emulated chip. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "mazes.h"
#include "tolman_mouse.h"

static tolman_mouse mouse;
static uint8_t saved[TOLMAN_SAVED_BYTES];

/* Columns and rows to north, east, south and west. */
static const int STEP[4][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};

static bool is_open(const uint8_t *maze, int x, int y, int side) {
    return maze[y * TOLMAN_SIDE + x] >> (side % 4) & 1;
}

static const tolman_config CLASSIC = {
    .cell_mm = 180,
    .turn_speed_mm_s = 594,
    .straight_acceleration_mm_s2 = 4200,
    .straight_braking_mm_s2 = 4200,
    .straight_top_speed_mm_s = 1500,
    .diagonal_acceleration_mm_s2 = 3600,
    .diagonal_braking_mm_s2 = 3600,
    .diagonal_top_speed_mm_s = 1200,
    .turn_ms = {364, 531, 658, 797, 549, 0},
};

static int explore(const uint8_t *maze, int reset_after) {
    static const tolman_cell goals[4] = {{7, 7}, {7, 8}, {8, 7}, {8, 8}};
    static tolman_move run[256];
    int x = 0, y = 0, heading = 0;
    if (tolman_new(&mouse, &CLASSIC, goals, 4) != TOLMAN_OK) return 1;
    for (int cells = 0; cells < 5000; cells++) {
        tolman_command next =
            tolman_arrive(&mouse, is_open(maze, x, y, heading + 3), is_open(maze, x, y, heading),
                          is_open(maze, x, y, heading + 1));
        printf("%d", (int)next);
        if (next == TOLMAN_READY) {
            size_t count = tolman_run(&mouse, run, 256);
            printf("\n");
            for (size_t i = 0; i < count; i++)
                printf("%d %d %d\n", run[i].kind, run[i].amount, run[i].time_ms);
            return 0;
        }
        if (next > TOLMAN_TO_LEFT) return 1;
        heading = (heading + (int)next) % 4;
        if (!is_open(maze, x, y, heading)) return 1;
        x += STEP[heading][0];
        y += STEP[heading][1];
        if (cells == reset_after) {
            size_t bytes = tolman_save(&mouse, saved, sizeof saved);
            memset(&mouse, 0, sizeof mouse);
            if (tolman_arrive(&mouse, true, true, true) != TOLMAN_NO_MOUSE) return 1;
            if (tolman_new(&mouse, &CLASSIC, goals, 4) != TOLMAN_OK) return 1;
            saved[40] ^= 1;
            if (tolman_load(&mouse, saved, bytes) != TOLMAN_BAD_MAP) return 1;
            saved[40] ^= 1;
            if (tolman_load(&mouse, saved, bytes) != TOLMAN_OK) return 1;
            x = y = heading = 0;
        }
    }
    return 1;
}

int main(void) {
    for (size_t i = 0; i < sizeof MAZES / sizeof MAZES[0]; i++)
        if (explore(MAZES[i], -1) || explore(MAZES[i], 60)) {
            printf("maze %d failed\n", (int)i);
            return 1;
        }
    return 0;
}
