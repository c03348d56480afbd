//! How the diktiometry learns abstract worlds: the tables of docs/diktiometry.md that need no simulator.
//!
//! `cargo run --release -p tolman-maps --example diktiometry_worlds -- TABLE [RUNS]`, TABLE one of those in `TABLES`.
#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "an example that cannot set itself up has failed, and its table is its result"
)]

extern crate alloc;

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../tests/diktiometry/walk.rs"]
mod walk;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maps::diktiometry::Config;
use tolman_sim::abstract_world::AbstractWorld;
use walk::{ODOMETRY, Scripted, Walk, blocks, open};

/// What can be asked for.
struct Table {
    name: &'static str,
    /// How many runs a row has unless told.
    runs: u64,
    print: fn(u64),
}

const TABLES: [Table; 1] = [Table {
    name: "growth",
    runs: 20,
    print: growth,
}];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let asked = arguments.next();
    let runs = arguments.next().and_then(|runs| runs.parse().ok());
    for table in TABLES {
        if asked.as_deref().is_none_or(|asked| asked == table.name) {
            let runs = runs.unwrap_or(table.runs);
            println!("\n{}, {runs} runs\n", table.name);
            (table.print)(runs);
        }
    }
}

fn alike() -> Config {
    Config::new(Config::compass_actions(), 1.0)
}

/// How many moves it takes until the map is the world, without advice and with.
fn growth(runs: u64) {
    println!(
        "| world | heed | moves until it is the world: least, quartiles, most | never | places at last per true one | least purity |"
    );
    println!("| --- | ---: | --- | ---: | ---: | ---: |");
    let corridors = |side: u16, seed: u64| {
        let maze = blocks(side, 0.25, &mut ChaCha8Rng::seed_from_u64(seed));
        AbstractWorld::from_corridors(&maze, 1.0)
    };
    type Build<'a> = &'a dyn Fn(u64) -> AbstractWorld;
    let worlds: [(&str, u32, Build<'_>); 4] = [
        ("5 × 5 corridors", 700, &|seed| corridors(5, seed)),
        ("7 × 7 corridors", 2000, &|seed| corridors(7, seed)),
        ("7 × 7 open", 2000, &|_| open(7)),
        ("10 × 10 open", 3000, &|_| open(10)),
    ];
    for (name, moves, world) in worlds {
        for heed in [0.0, 0.3, 1.0] {
            let mut found = Vec::new();
            let (mut share, mut purity) = (0.0, 1.0_f64);
            for seed in 0..runs {
                let mut errors = ODOMETRY;
                errors.stop = 0.0175;
                let mut config = alike();
                config.place_radius = errors.stop;
                let world = world(seed);
                let all = world.places().len();
                let mut walk = Walk::new(world, errors, config, seed);
                let mut planner = Scripted::new(heed, seed);
                let mut first = None;
                for number in 1..=moves {
                    planner.go(&mut walk);
                    let places = walk.observer.map().paths.places().count();
                    if first.is_none() && places == all && walk.score().visited == all {
                        first = Some(number);
                    }
                }
                let score = walk.score();
                share += score.places as f64 / score.visited as f64;
                purity = purity.min(score.purity);
                found.extend(first);
            }
            let never = runs as usize - found.len();
            found.resize(runs as usize, moves);
            found.sort_unstable();
            let at = |share: usize| found[(found.len() - 1) * share / 4];
            let quartiles = [0, 1, 2, 3, 4]
                .map(|share| at(share).to_string())
                .join(", ");
            let share = share / runs as f64;
            println!(
                "| {name}, {moves} moves | {heed} | {quartiles} | {never} | {share:.2} | {purity:.3} |"
            );
        }
    }
}
