//! How CPM explores random mazes of corridors and junctions: the table in docs/cpm.md.
//!
//! `cargo run --release -p tolman-arena --example cpm_worlds`
//!
//! With `-- lost [MAZES]` instead: in how many mazes without noise (6000 if not told) hypotheses lose the truth for good.
#![expect(clippy::print_stdout, reason = "its table is its result")]

use core::error::Error;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::cpm::world::{
    MapCheck, MazeConfig, PlaneMaze, PlaneWalker, Reckoning, WalkerNoise,
};
use tolman_maps::cpm::{Alignment, FragmentMatching, Mapping, Similarity};
use tolman_systems::cpm::{Aim, CpmConfig, Explorer, Onward};

const MAZES: u32 = 200;

/// What became of all mazes.
#[derive(Default)]
struct Tally {
    right: u32,
    wrong: u32,
    ratio: f64,
}

/// Mazes without noise to look for the truth lost in, if not told.
const MANY: u32 = 6000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    match arguments.next().as_deref() {
        None => table(),
        Some("lost") => lost(match arguments.next() {
            Some(mazes) => mazes.parse()?,
            None => MANY,
        }),
        Some(other) => Err(format!("{other:?} is no mode: give none, or `lost [MAZES]`").into()),
    }
}

/// Explores mazes without noise, with as many hypotheses as usual and with one, with dead reckoning.
fn lost(mazes: u32) -> Result<(), Box<dyn Error>> {
    for width in [16, 1] {
        let config = CpmConfig {
            mapping: Mapping::Hypotheses { width },
            ..CpmConfig::robust()
        };
        for alike in [false, true] {
            let tally = explore(config, Reckoning::Bounded, WalkerNoise::NONE, alike, mazes)?;
            let kind = if alike { "alike" } else { "distinctive" };
            println!(
                "{width} hypotheses, {kind}: of {mazes} maps {} are right, {} wrong, {} were explored without end",
                tally.right,
                tally.wrong,
                mazes - tally.right - tally.wrong
            );
        }
    }
    Ok(())
}

fn table() -> Result<(), Box<dyn Error>> {
    let literal = CpmConfig {
        matching: FragmentMatching::Positions(Similarity::literal()),
        ..CpmConfig::online()
    };
    let go_on = CpmConfig {
        onward: Onward::GoOn,
        ..CpmConfig::online()
    };
    let aligned = CpmConfig {
        matching: FragmentMatching::Alignment(Alignment::tuned()),
        mapping: Mapping::Online,
        ..CpmConfig::online()
    };
    let robust = CpmConfig::robust();
    let explorers = [
        ("online, (3)–(5) to the letter", literal, Reckoning::None),
        ("online, \"go on\"", go_on, Reckoning::None),
        ("online", CpmConfig::online(), Reckoning::None),
        ("online, aligned", aligned, Reckoning::None),
        ("hypotheses, no dead reckoning", robust, Reckoning::None),
        ("hypotheses", robust, Reckoning::Bounded),
    ];
    let calm = WalkerNoise {
        substitution: 0.05,
        slip: 0.05,
        heading: 0.05,
        ..WalkerNoise::NONE
    };
    let wild = WalkerNoise {
        substitution: 0.2,
        insertion: 0.05,
        deletion: 0.05,
        slip: 0.2,
        heading: 0.2,
    };
    println!("| explorer | mazes | no noise | calm | noisy | wild |");
    println!("| --- | --- | --- | --- | --- | --- |");
    for (name, config, reckoning) in explorers {
        for alike in [false, true] {
            let cells: Result<Vec<String>, _> = [WalkerNoise::NONE, calm, WalkerNoise::NOISY, wild]
                .map(|noise| {
                    explore(config, reckoning, noise, alike, MAZES).map(|tally| tally.cell(MAZES))
                })
                .into_iter()
                .collect();
            let mazes = if alike { "alike" } else { "distinctive" };
            println!("| {name} | {mazes} | {} |", cells?.join(" | "));
        }
    }
    Ok(())
}

fn explore(
    config: CpmConfig,
    reckoning: Reckoning,
    noise: WalkerNoise,
    alike: bool,
    mazes: u32,
) -> Result<Tally, Box<dyn Error>> {
    let mut tally = Tally::default();
    for number in 0..mazes {
        let mut rng = ChaCha8Rng::seed_from_u64(number.into());
        let maze = if alike {
            MazeConfig::any_alike(number)
        } else {
            MazeConfig::any(number)
        };
        let world = PlaneMaze::random(&maze, &mut rng)?;
        let mut rover = PlaneWalker::new(&world, noise, reckoning);
        let most_traversals = 8 * world.corridors().len() as u32;
        let mut explorer = Explorer::new(
            CpmConfig {
                most_traversals,
                ..config
            },
            rover.sighting(),
        )?;
        rover.pursue(&mut explorer, Aim::Explore, &mut rng, |_, _, _, _| {})?;
        let finished = explorer.mapper.traversals() < most_traversals;
        match world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at()) {
            MapCheck::Right => {
                tally.right += 1;
                let best = world.shortest_covering_walk().unwrap_or(1);
                tally.ratio += f64::from(explorer.mapper.traversals()) / f64::from(best);
            }
            _ if finished => tally.wrong += 1,
            _ => {}
        }
    }
    Ok(tally)
}

impl Tally {
    /// As the table has it.
    fn cell(&self, mazes: u32) -> String {
        let percent = |count: u32| 100.0 * f64::from(count) / f64::from(mazes);
        let ratio = self.ratio / f64::from(self.right.max(1));
        let (right, wrong) = (percent(self.right), percent(self.wrong));
        format!("{right:.1} / {wrong:.1} / {ratio:.2}")
    }
}
