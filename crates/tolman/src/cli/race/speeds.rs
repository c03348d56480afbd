//! The speeds of a run over time, as a picture.

use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_planners::speed_run::{RunMove, Side, Slalom, SlalomTurn, SpeedProfile, SpeedRunConfig};
use tolman_systems::micromouse::competition::RunLeg;

/// Returns the picture of the speeds of mice in one maze, each with its name.
pub(super) fn picture(mice: Vec<(String, Vec<(f64, f64)>)>) -> String {
    let mut chart = Chart::new(
        Axis::linear("time, s"),
        Axis::linear("speed, m/s").from_zero(),
    );
    chart = chart.sized(760.0, 320.0);
    let told = "Speed over time on the fastest run. Turns whose time alone is given have the speed of their ends.";
    for (number, (name, speeds)) in (0_u32..).zip(mice) {
        let points = speeds.into_iter().map(|(seconds, speed)| LinePoint {
            x: seconds,
            y: speed / 1000.0,
            spread: None,
        });
        chart.line(Line::new(name, Series(number), points.collect()));
    }
    Figure::new("speeds", "Speeds of the run", chart.drawing(told)).standalone()
}

/// Returns times of a run, s, and the speeds then, mm/s. The speed changes evenly in between.
pub(super) fn over_time(run: &[RunLeg], config: &SpeedRunConfig) -> Vec<(f64, f64)> {
    let ends = config.turn_speed_mm_s;
    let seconds = |ms: u32| f64::from(ms) / 1000.0;
    let mut at = seconds(config.start_ms());
    let mut speeds = Vec::new();
    if at > 0.0 {
        speeds.push((0.0, 0.0));
    }
    speeds.push((at, ends));
    for leg in run {
        let end = at + seconds(leg.time_ms);
        let half_cells = config.cell_mm / 2.0;
        let (way, profile) = match leg.step.run_move {
            RunMove::Straight { half_cells: n } => (half_cells * f64::from(n), config.straight),
            RunMove::Diagonal { cells } => (
                half_cells * f64::from(cells) * core::f64::consts::SQRT_2,
                config.diagonal,
            ),
            RunMove::Turn { slalom, side } => {
                let profile = match slalom {
                    Slalom::Fv90 => config.diagonal,
                    _ => config.straight,
                };
                let inside = turning(slalom, side, config);
                speeds.extend(between((at, end), ends, inside, profile));
                speeds.push((end, ends));
                at = end;
                continue;
            }
        };
        let (up, down) = (profile.acceleration_mm_s2, profile.braking());
        let gain = 2.0 * up * down / (up + down);
        let peak = (ends * ends + gain * way)
            .sqrt()
            .min(profile.top_speed_mm_s);
        speeds.extend(between((at, end), ends, peak, profile));
        speeds.push((end, ends));
        at = end;
    }
    if config.stop_ms() > 0 {
        speeds.push((at + seconds(config.stop_ms()), 0.0));
    }
    speeds
}

/// Returns when the speed inside a move is reached and left.
fn between(
    (start, end): (f64, f64),
    ends: f64,
    inside: f64,
    profile: SpeedProfile,
) -> [(f64, f64); 2] {
    let (up, down) = (profile.acceleration_mm_s2, profile.braking());
    let (first, last) = if inside >= ends {
        (up, down)
    } else {
        (down, up)
    };
    let change = (inside - ends).abs();
    let reached = (start + change / first).min(end);
    [
        (reached, inside),
        ((end - change / last).max(reached), inside),
    ]
}

/// Returns the speed in a turn, mm/s.
fn turning(slalom: Slalom, side: Side, config: &SpeedRunConfig) -> f64 {
    let turns = match side {
        Side::Left => config.slalom_left.as_ref().unwrap_or(&config.slalom),
        Side::Right => &config.slalom,
    };
    let turn = match slalom {
        Slalom::F45 => turns.f45,
        Slalom::F90 => turns.f90,
        Slalom::F135 => turns.f135,
        Slalom::F180 => turns.f180,
        Slalom::Fv90 => turns.fv90,
        Slalom::Fs90 => turns.fs90,
    };
    match turn {
        Some(SlalomTurn::Driven(turn)) => turn.speed_mm_s,
        // In place.
        None => 0.0,
        Some(_) => config.turn_speed_mm_s,
    }
}
