// A mouse for the simulator mms in C++: it explores with the library, drives home, and makes the fastest run with diagonals.
//
//   cargo build --release --manifest-path crates/mouse-c/Cargo.toml
//   c++ -I crates/mouse-c/include crates/mouse-c/examples/mms.cpp libtolman_mouse.a -lpthread -ldl -lm -o mms
//   tolman mms-host --mouse ./mms --maze mazes/grid/braided-1.txt
#include <iostream>
#include <string>
#include <vector>

#include "tolman_mouse.h"

namespace {

std::string ask(const std::string &line) {
    std::cout << line << std::endl;
    std::string reply;
    if (!(std::cin >> reply)) std::exit(0); // The simulator is gone.
    return reply;
}

bool is_open(const char *side) { return ask(side) == "false"; }

// Quarter turns to the right of where the mouse looked at first.
int heading = 0;

void turn(int quarters) {
    quarters &= 3;
    heading = (heading + quarters) & 3;
    if (quarters == 3) {
        ask("turnLeft");
        return;
    }
    for (; quarters > 0; quarters--) ask("turnRight");
}

// Makes a turn by half steps: 1 stands for 45° and 2 for 90°, with half a step before and after each.
void slalom(const char *eighths, bool to_right) {
    const std::string side = to_right ? "turnRight" : "turnLeft";
    ask("moveForwardHalf");
    for (; *eighths; eighths++) {
        ask(*eighths == '1' ? side + "45" : side);
        ask("moveForwardHalf");
    }
}

void run(const std::vector<tolman_move> &moves) {
    bool is_diagonal = false;
    for (const tolman_move &move : moves) {
        const bool to_right = move.amount == TOLMAN_RIGHT;
        switch (move.kind) {
        case TOLMAN_STRAIGHT:
        case TOLMAN_DIAGONAL:
            ask("moveForwardHalf " + std::to_string(move.amount));
            break;
        case TOLMAN_F45:
            slalom("1", to_right);
            is_diagonal = !is_diagonal;
            break;
        case TOLMAN_F90:
            slalom("11", to_right);
            break;
        case TOLMAN_F135:
            slalom(is_diagonal ? "21" : "12", to_right);
            is_diagonal = !is_diagonal;
            break;
        case TOLMAN_F180:
            slalom("121", to_right);
            break;
        default: // TOLMAN_FV90 and TOLMAN_FS90.
            slalom("2", to_right);
        }
    }
}

} // namespace

int main() {
    const int width = std::stoi(ask("mazeWidth")), height = std::stoi(ask("mazeHeight"));
    if (width > TOLMAN_SIDE || height > TOLMAN_SIDE) {
        std::cerr << "the library was built for smaller mazes" << std::endl;
        return 1;
    }
    std::vector<tolman_cell> goals;
    for (int x = (width - 1) / 2; x <= width / 2; x++)
        for (int y = (height - 1) / 2; y <= height / 2; y++)
            goals.push_back({static_cast<uint8_t>(x), static_cast<uint8_t>(y)});

    tolman_config config = {};
    config.cell_mm = 180;
    config.turn_speed_mm_s = 594;
    config.straight_acceleration_mm_s2 = config.straight_braking_mm_s2 = 4200;
    config.straight_top_speed_mm_s = 1500;
    config.diagonal_acceleration_mm_s2 = config.diagonal_braking_mm_s2 = 3600;
    config.diagonal_top_speed_mm_s = 1200;
    const uint16_t turns[] = {364, 531, 658, 797, 549, 0};
    for (int i = 0; i < 6; i++) config.turn_ms[i] = turns[i];

    static tolman_mouse mouse;
    if (tolman_new(&mouse, &config, goals.data(), goals.size()) != TOLMAN_OK) return 1;
    for (;;) {
        const bool left = is_open("wallLeft"), ahead = is_open("wallFront");
        const tolman_command next = tolman_arrive(&mouse, left, ahead, is_open("wallRight"));
        if (next == TOLMAN_READY) break;
        if (next > TOLMAN_TO_LEFT) return 1;
        turn(next);
        if (ask("moveForward") == "crash") tolman_crashed(&mouse);
    }
    turn(4 - heading);
    std::vector<tolman_move> moves(tolman_run(&mouse, nullptr, 0));
    tolman_run(&mouse, moves.data(), moves.size());
    run(moves);
}
