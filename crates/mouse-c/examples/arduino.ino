// A mouse with an Arduino-like loop: the library decides where to drive, while the motors go on. Put the header and the static
// library for your chip into the sketch's folder. Pins, thresholds and drives are yours.
#include "tolman_mouse.h"

static tolman_mouse mouse;
static tolman_move run_moves[128];
static uint8_t saved[TOLMAN_SAVED_BYTES];

static const tolman_cell GOALS[] = {{7, 7}, {7, 8}, {8, 7}, {8, 8}};

// As `tolman race --template` explains it; a first mouse, which stops and turns in place.
static tolman_config config() {
    tolman_config mine = {};
    mine.cell_mm = 180;
    mine.turn_speed_mm_s = 300;
    mine.straight_acceleration_mm_s2 = mine.straight_braking_mm_s2 = 3000;
    mine.straight_top_speed_mm_s = 1000;
    mine.diagonal_acceleration_mm_s2 = mine.diagonal_braking_mm_s2 = 3000;
    mine.diagonal_top_speed_mm_s = 1000;
    mine.in_place_ms = 300;
    return mine;
}

static bool sees_wall(int pin) { return analogRead(pin) > 400; }

// Drives half a cell at constant speed; yours follows the walls and counts the wheels.
static void half_cell() {
    analogWrite(5, 120);
    analogWrite(6, 120);
    delay(300);
}

static void turn(tolman_command side) {
    if (side == TOLMAN_AHEAD) return;
    digitalWrite(7, side == TOLMAN_TO_LEFT ? HIGH : LOW);
    delay(side == TOLMAN_BACK ? 600 : 300);
}

void setup() {
    Serial.begin(115200);
    const tolman_config mine = config();
    if (tolman_new(&mouse, &mine, GOALS, 4) != TOLMAN_OK) Serial.println("the configuration is impossible");
}

void loop() {
    // The walls of a cell are seen at its edge: half a cell is left to decide.
    const tolman_command next = tolman_arrive(&mouse, !sees_wall(A0), !sees_wall(A1), !sees_wall(A2));
    if (next == TOLMAN_READY) {
        const size_t bytes = tolman_save(&mouse, saved, sizeof saved);
        const size_t moves = tolman_run(&mouse, run_moves, 128);
        Serial.println(static_cast<unsigned long>(bytes + moves));
        // Yours: keep `saved`, wait for the button, and make the moves.
        while (true) delay(1000);
    }
    if (next == TOLMAN_CARRY_BACK) {
        delay(10000);
        tolman_carried_back(&mouse);
        return;
    }
    if (next > TOLMAN_TO_LEFT) {
        Serial.println("no way leads to the goal");
        while (true) delay(1000);
    }
    half_cell();
    turn(next);
    half_cell();
}
