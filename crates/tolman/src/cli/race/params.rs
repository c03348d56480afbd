//! Reads the file with a mouse's driving parameters.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use std::path::Path;

use anyhow::anyhow;
use tolman_formats::input;
use tolman_maze::Maze;
use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunTimes};

use crate::cli::{OrBadInput, Result};

/// Maximum number of columns or rows of a classic maze.
const CLASSIC: u16 = 16;

/// Driving parameters of the file; `None` if no file was named.
pub(super) struct Params(Option<SpeedRunConfig>);

impl Params {
    /// Reads a file, if one is named.
    ///
    /// # Errors
    /// Bad input if it cannot be read, or no mouse can drive with its values.
    pub(super) fn read(path: Option<&Path>) -> Result<Self> {
        let Some(path) = path else {
            return Ok(Self(None));
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
        Ok(Self(Some(config.map_err(repair).or_bad_input()?)))
    }

    /// Returns the values with which the mouse drives in this maze.
    pub(super) fn config_for(&self, maze: &Maze) -> SpeedRunConfig {
        let side = maze.grid().width().max(maze.grid().height());
        self.0.unwrap_or(if side <= CLASSIC {
            SpeedRunConfig::classic()
        } else {
            SpeedRunConfig::half_size()
        })
    }
}

/// Returns the text of a file with these values, and with the meaning of each.
pub(super) fn template(config: SpeedRunConfig) -> String {
    let SpeedRunConfig {
        cell_mm,
        turn_speed_mm_s,
        straight,
        diagonal,
        slalom,
        ..
    } = config;
    format!(
        "\
# How a micromouse drives its fast run: for `tolman race --mouse FILE`.
# Lengths are in mm, speeds in mm/s, accelerations in mm/s², times in ms.

# From the middle of a cell to that of the next: 180 in classic mazes, 90 in half-size ones.
cell_mm = {cell_mm:.1}
# The speed in all slalom turns. Straights begin and end with it, and so does the run.
turn_speed_mm_s = {turn_speed_mm_s:.1}

# Straights from cell to cell: faster until the top speed is reached, and slower again.
[straight]
acceleration_mm_s2 = {:.1}
# Not below the speed in the turns.
top_speed_mm_s = {:.1}

# Straights from wall to wall at 45°, the same.
[diagonal]
acceleration_mm_s2 = {:.1}
top_speed_mm_s = {:.1}

# How long each turn takes, from where one straight ends to where the next begins; whole numbers.
[slalom]
# 45°: from the middle of a cell, through the next, onto the middle of its side. And back.
f45_ms = {}
# 90°: from the middle of a cell, through the next, into the middle of the one beside that.
f90_ms = {}
# 135°: from the middle of a cell, through two more, onto the near side of the second. And back.
f135_ms = {}
# 180°: from the middle of a cell, through two more, into the middle of the cell beside the first.
f180_ms = {}
# 90° from one diagonal into another.
fv90_ms = {}
",
        straight.acceleration_mm_s2,
        straight.top_speed_mm_s,
        diagonal.acceleration_mm_s2,
        diagonal.top_speed_mm_s,
        slalom.f45_ms,
        slalom.f90_ms,
        slalom.f135_ms,
        slalom.f180_ms,
        slalom.fv90_ms,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_template_says_what_the_presets_are() {
        for config in [SpeedRunConfig::classic(), SpeedRunConfig::half_size()] {
            let read: SpeedRunConfig = toml::from_str(&template(config)).unwrap();
            assert_eq!(read, config);
        }
    }
}
