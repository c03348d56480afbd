//! `tolman maze distinct`: whether an e-puck can tell the fragments of mazes apart.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, anyhow};
use tolman_arena::cpm::{WalkPair, distinctness, epuck_course};
use tolman_arena::registry::Schooling;
use tolman_maps::cpm::Sense;

use super::{OrBadInput, Result, name, read};
use crate::cli::Unboxed;
use crate::cli::share::share;

/// Lets an e-puck walk every fragment of mazes both ways; exits 2 if two of them look alike
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman maze distinct mazes/cpm-1.maze mazes/cpm-2.maze mazes/cpm-3.maze")]
pub(crate) struct Arguments {
    /// Maze files of any format, with a start
    #[arg(required = true)]
    mazes: Vec<PathBuf>,
    /// Seed with which the common patterns are learned
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Number of times that each fragment is walked in each direction
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..))]
    walks: u16,
    /// Maximum similarity f_S of two fragments; the paper treats two fragments above 0.9 as one
    #[arg(long, value_name = "F_S", default_value_t = 0.8, value_parser = share)]
    below: f64,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let patterns = Schooling::of_epuck_by(arguments.seed).unboxed()?;
    for path in &arguments.mazes {
        let course = epuck_course(&name(path), read(path)?);
        let course = course.with_context(|| name(path)).or_bad_input()?;
        let (name, seeds) = (&course.name, 0..u64::from(arguments.walks));
        let found = distinctness(&course, &patterns, seeds).unboxed();
        let found = found.or_bad_input()?;
        if let Some(most) = found.most_alike {
            let told = told(&most);
            if most.score >= arguments.below {
                let below = arguments.below;
                let error = anyhow!(
                    "{name}: two different fragments look alike: {told}, not below {below}; bend one of them"
                );
                return Err(error).or_bad_input();
            }
            writeln!(out, "{name}: most alike of different fragments: {told}")?;
        }
        if let Some(least) = found.least_alike {
            writeln!(
                out,
                "{name}: least alike walks of one fragment: {}",
                told(&least)
            )?;
        }
        out.flush()?;
    }
    Ok(())
}

fn told(pair: &WalkPair) -> String {
    let WalkPair {
        one,
        other,
        sense,
        score,
    } = pair;
    let sense = match sense {
        Sense::Same => "",
        Sense::Inverted => ", inverted,",
    };
    format!(
        "{} to {} and {} to {}{sense} have f_S = {score:.3}",
        one.0, one.1, other.0, other.1
    )
}
