//! Reads the file with a mouse's driving parameters.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use std::path::Path;

use anyhow::anyhow;
use tolman_formats::input;
use tolman_maze::Maze;
use tolman_planners::speed_run::{Side, Slalom, SlalomTurn, SpeedRunConfig, SpeedRunTimes};

use crate::cli::{OrBadInput, Result};

/// Maximum number of columns or rows of a classic maze.
const CLASSIC: u16 = 16;

/// Driving parameters of the file, if one was named.
pub(super) struct Params {
    config: Option<SpeedRunConfig>,
    /// Whether the mouse drives without diagonals.
    has_no_diagonals: bool,
}

impl Params {
    /// Reads a file, if one is named.
    ///
    /// # Errors
    /// Bad input if it cannot be read, or no mouse can drive with its values.
    pub(super) fn read(path: Option<&Path>, has_no_diagonals: bool) -> Result<Self> {
        let Some(path) = path else {
            return Ok(Self {
                config: None,
                has_no_diagonals,
            });
        };
        let config = input::text(path)
            .map_err(anyhow::Error::from)
            .and_then(|text| Ok(toml::from_str::<SpeedRunConfig>(&text)?))
            .and_then(|config| Ok(SpeedRunTimes::<32>::new(&config).map(|_| config)?));
        let repair = |error: anyhow::Error| {
            let (path, why) = (path.display(), error.to_string());
            let why = why.trim_end();
            anyhow!("{path}: {why}; `tolman race --template` prints a file that is sound")
        };
        let mut config = config.map_err(repair).or_bad_input()?;
        if has_no_diagonals {
            config = config.without_diagonals();
            if config.turn_ms(Slalom::Fs90, Side::Left) == Ok(None) {
                let path = path.display();
                return Err(anyhow!(
                    "{path}: without diagonals the mouse needs a turn within a cell: add `fs90` or \
                     `in_place_ms` to its [slalom], or leave --no-diagonals out"
                ))
                .or_bad_input();
            }
        }
        Ok(Self {
            config: Some(config),
            has_no_diagonals,
        })
    }

    /// Returns the values with which the mouse drives in this maze.
    pub(super) fn config_for(&self, maze: &Maze) -> SpeedRunConfig {
        let side = maze.grid().width().max(maze.grid().height());
        self.config
            .unwrap_or(match (side <= CLASSIC, self.has_no_diagonals) {
                (true, false) => SpeedRunConfig::classic(),
                (false, false) => SpeedRunConfig::half_size(),
                (true, true) => SpeedRunConfig::beginner(),
                (false, true) => SpeedRunConfig::beginner_half_size(),
            })
    }
}

/// Returns the text of a file with these values, and with the meaning of each. Values come from
/// `source`.
pub(super) fn template(config: SpeedRunConfig, source: &str) -> String {
    let SpeedRunConfig {
        cell_mm,
        turn_speed_mm_s,
        straight,
        diagonal,
        slalom,
        ..
    } = config;
    let turn = |name: &str, turn: Option<SlalomTurn>| match turn {
        Some(SlalomTurn::Timed { time_ms }) => format!("{name} = {time_ms}"),
        _ => format!("# {name} = 400"),
    };
    format!(
        "\
# How a micromouse drives its fast run: for `tolman race --mouse FILE`.
# Lengths are in mm, speeds in mm/s, accelerations in mm/s², times in ms.
# {source}

# From the middle of a cell to that of the next: 180 in classic mazes, 90 in half-size ones.
cell_mm = {cell_mm:.1}
# The speed at the ends of all turns and straights.
turn_speed_mm_s = {turn_speed_mm_s:.1}
# From where the mouse stands at the start, its back to the wall, to the middle of the cell; and
# the room it has to stop beyond the middle of the goal. Without these the run begins and ends in
# the middle of a cell, at the speed of the turns.
# start_mm = 50
# stop_mm = 50

# Straights from cell to cell: faster until the top speed is reached, and slower again.
[straight]
acceleration_mm_s2 = {:.1}
# braking_mm_s2 = 5000  # If it differs.
# Not below the speed at the ends of the turns.
top_speed_mm_s = {:.1}

# Straights from wall to wall at 45°, the same.
[diagonal]
acceleration_mm_s2 = {:.1}
top_speed_mm_s = {:.1}

# How long each turn takes, from where one straight ends to where the next begins; whole numbers.
# A turn that is left out is never made. Instead of its time a turn may have its curve:
# f90 = {{ speed_mm_s = 700, radius_mm = 150, run_in_mm = 30, run_out_mm = 30 }}
# (length_mm instead of radius_mm). No turn is faster than its shortest way at its speed.
[slalom]
# 45°: from the middle of a cell, through the next, onto the middle of its side. And back.
{}
# 90°: from the middle of a cell, through the next, into the middle of the one beside that.
{}
# 135°: from the middle of a cell, through two more, onto the near side of the second. And back.
{}
# 180°: from the middle of a cell, through two more, into the middle of the cell beside the first.
{}
# 90° from one diagonal into another.
{}
# 90° within a cell, from side to side.
{}
# 90° in place, from rest to rest, for a mouse without fs90: it stops in the middle of the cell.
# in_place_ms = 300

# Turns to the left, if they differ: as [slalom].
# [slalom_left]

# Times of a cell in the search: straight on, with a turn, and back. Without them the search is told
# in cells only.
# [search]
# ahead_ms = 500
# turn_ms = 600
# back_ms = 1500
",
        straight.acceleration_mm_s2,
        straight.top_speed_mm_s,
        diagonal.acceleration_mm_s2,
        diagonal.top_speed_mm_s,
        turn("f45", slalom.f45),
        turn("f90", slalom.f90),
        turn("f135", slalom.f135),
        turn("f180", slalom.f180),
        turn("fv90", slalom.fv90),
        turn("fs90", slalom.fs90),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_template_says_what_the_presets_are() {
        for config in [
            SpeedRunConfig::classic(),
            SpeedRunConfig::half_size(),
            SpeedRunConfig::beginner(),
        ] {
            let text = template(config, "Where they come from.");
            assert_eq!(toml::from_str::<SpeedRunConfig>(&text).unwrap(), config);
            // What is commented out can be taken as it is.
            let all = text
                .replace("# in_place", "in_place")
                .replace("# start", "start");
            let all = all
                .replace("# stop", "stop")
                .replace("# [", "[")
                .replace("# brak", "brak");
            let all = all
                .replace("# ahead", "ahead")
                .replace("# turn_ms", "turn_ms");
            let all = all.replace("# back_ms", "back_ms").replace("# f", "f");
            let all = all.replace("f90 = { speed_mm_s = 700", "# ");
            let read: SpeedRunConfig = toml::from_str(&all).unwrap();
            assert!(read.search.is_some() && read.slalom.in_place_ms == Some(300));
        }
    }
}
