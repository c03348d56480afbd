//! `tolman maze generate`: seeded mazes.

use std::io::Write;

use anyhow::anyhow;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::family::{Family, FamilySize};
use tolman_maze::{Braided, Maze, Rooms};

use super::output::MazeOutput;
use super::{Failure, OrBadInput, Result};
use crate::cli::{App, Unboxed};

/// Makes a random maze; the same seed makes the same maze
#[derive(clap::Args)]
#[command(after_help = "\
Families: perfect, braided, braided-rooms, office, blocks, ladder, eight, ring, wings, comb, spiral, star, pillars, papers, rooms

Example:
  tolman maze generate braided --size 12x8 --share 0.5 --seed 3 --out mine.maze
  tolman maze generate office --size large")]
pub(crate) struct Arguments {
    /// Family of mazes; --list describes them
    #[arg(required_unless_present = "list")]
    family: Option<String>,
    /// List the families with the difficulty of each
    #[arg(long)]
    list: bool,
    /// Columns and rows, as in 16x16; or small, middle or large
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "large", value_parser = size)]
    size: Size,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// For `braided`: share of dead ends to open, 0 to 1 [default: 1]
    #[arg(long, value_name = "SHARE")]
    share: Option<f64>,
    /// For `rooms`: number of tries to place a room [default: 20]
    #[arg(long, value_name = "N")]
    attempts: Option<u32>,
    /// For `rooms`: shortest side of a room, cells [default: 2]
    #[arg(long, value_name = "CELLS")]
    smallest: Option<u16>,
    /// For `rooms`: longest side of a room, cells [default: 4]
    #[arg(long, value_name = "CELLS")]
    largest: Option<u16>,
    /// For `rooms`: doors beyond those that join all rooms; each closes a loop [default: 2]
    #[arg(long, value_name = "N")]
    extra_doors: Option<u32>,
    #[command(flatten)]
    output: MazeOutput,
}

#[derive(Clone, Copy)]
enum Size {
    Named(FamilySize),
    Cells(u16, u16),
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    if arguments.list {
        return list(app, out);
    }
    let family = app.family(arguments.family.as_deref().unwrap_or_default())?;
    let size = match arguments.size {
        Size::Named(size) => family.size(size),
        Size::Cells(width, height) => (width, height),
    };
    let maze = arguments.draw(family, size)?;
    arguments.output.write(&maze.into(), out)
}

fn list(app: &App, out: &mut dyn Write) -> Result {
    for family in &app.registry().families {
        let Family {
            name, about, hard, ..
        } = family;
        write!(out, "{name:14} {about}")?;
        match hard.is_empty() {
            true => writeln!(out)?,
            false => writeln!(out, "; hard: {hard}")?,
        }
    }
    Ok(())
}

impl Arguments {
    fn draw(&self, family: &Family, (width, height): (u16, u16)) -> Result<Maze> {
        let rng = &mut ChaCha8Rng::seed_from_u64(self.seed);
        self.check(family.name)?;
        if let Some(share) = self.share {
            let braided = Braided {
                width,
                height,
                share,
            };
            return braided.generate_corridors(rng).or_bad_input();
        }
        if self.has_rooms() {
            let rooms = Rooms {
                width,
                height,
                attempts: self.attempts.unwrap_or(20),
                smallest: self.smallest.unwrap_or(2),
                largest: self.largest.unwrap_or(4),
                extra_doors: self.extra_doors.unwrap_or(2),
            };
            return rooms.generate(rng).or_bad_input();
        }
        let drawn = (family.draw)((width, height), rng);
        drawn.unboxed().or_bad_input()
    }

    const fn has_rooms(&self) -> bool {
        self.attempts.is_some()
            || self.smallest.is_some()
            || self.largest.is_some()
            || self.extra_doors.is_some()
    }

    /// Refuses options that `family` does not have.
    fn check(&self, family: &str) -> Result {
        if self.share.is_some() && family != "braided" {
            let why =
                anyhow!("--share belongs to the family braided, not to {family}: leave it out");
            return Err(Failure::BadInput(why));
        }
        if self.has_rooms() && family != "rooms" {
            let why = anyhow!(
                "--attempts, --smallest, --largest and --extra-doors belong to the family rooms, not to {family}: leave them out"
            );
            return Err(Failure::BadInput(why));
        }
        Ok(())
    }
}

fn size(text: &str) -> Result<Size, String> {
    match text {
        "small" => return Ok(Size::Named(FamilySize::Small)),
        "middle" => return Ok(Size::Named(FamilySize::Middle)),
        "large" => return Ok(Size::Named(FamilySize::Large)),
        _ => {}
    }
    text.split_once('x')
        .and_then(|(width, height)| Some(Size::Cells(width.parse().ok()?, height.parse().ok()?)))
        .ok_or_else(|| "expected columns x rows, as in 16x16, or small, middle or large".to_owned())
}
