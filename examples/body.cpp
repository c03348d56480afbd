// A complete body for `tolman brain`: a disc with a laser in a ring of corridors. It reads the brain's lines from stdin and
// writes its own to stdout:
//
//   g++ -std=c++17 -O2 -o body examples/body.cpp && mkfifo back
//   ./body < back | tolman brain --system mslst-better --robot examples/robot.toml --task explore --task reach-goal > back
//
// Your robot's driver goes in the place of `go` and `sense`.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

// The floor is 4 × 3 cells of 0.5 m; two of them are solid. The goal is the cell (3, 2).
const double SIDE = 0.5, RADIUS = 0.125, REACH = 1.0, PI = std::acos(-1.0);
const int BEAMS = 72;
double x = 0.5 * SIDE, y = 0.5 * SIDE, heading = 0;
long time_us = 0;

int cell(double at) { return static_cast<int>(std::floor(at / SIDE)); }

bool is_free(int column, int row) {
    bool is_solid = row == 1 && (column == 1 || column == 2);
    return column >= 0 && column < 4 && row >= 0 && row < 3 && !is_solid;
}

// Returns how far it is to the next wall, m, to the nearest 5 mm.
double room(double angle) {
    double far = 0;
    while (far < REACH && is_free(cell(x + far * std::cos(angle)), cell(y + far * std::sin(angle)))) far += 0.005;
    return std::min(far, REACH);
}

// Turns by `turn`, rad, and rolls `distance`, m, or as far as the wall lets it. Returns how far it rolled.
double go(double distance, double turn) {
    heading = std::remainder(heading + turn, 2 * PI);
    double way = distance > 0 ? heading : heading + PI;
    double free = std::min({room(way - 0.3), room(way), room(way + 0.3)}) - RADIUS;
    distance = std::copysign(std::min(std::abs(distance), std::max(free, 0.0)), distance);
    x += distance * std::cos(heading);
    y += distance * std::sin(heading);
    return distance;
}

std::string sense(double distance, double turn) {
    std::ostringstream line;
    line.precision(12);
    line << "{\"sensing\":{\"time_us\":" << (time_us += 100000) << ",\"compass\":" << heading;
    line << ",\"odometry\":{\"distance\":" << distance << ",\"turn\":" << turn << "},\"ranges\":[";
    for (int beam = 0; beam < BEAMS; ++beam) line << (beam ? "," : "") << room(heading + 2 * PI * beam / BEAMS);
    line << "]},\"landmark\":" << (cell(x) == 3 && cell(y) == 2 ? "\"Goal\"" : "null") << "}";
    return line.str();
}

// Returns the number after `"name":` in a line.
std::optional<double> number(const std::string& line, const std::string& name) {
    auto at = line.find("\"" + name + "\":");
    if (at == std::string::npos) return std::nullopt;
    return std::stod(line.substr(at + name.size() + 3));
}

int main() {
    for (std::string line; std::getline(std::cin, line);) {
        if (line.rfind("{\"go\"", 0) != 0) {
            std::cerr << line << "\n";
            continue;
        }
        auto distance = number(line, "distance"), turn = number(line, "turn");
        if (!distance || !turn) return 1;
        double rolled = go(*distance, *turn);
        std::cout << sense(rolled, *turn) << std::endl;
    }
    // The brain has ended: the robot stands still.
}
