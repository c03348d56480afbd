//! CPM: comparing fragments, exploring, localizing.
#![expect(clippy::unwrap_used, reason = "a bench that cannot go on fails")]

extern crate alloc;

#[path = "../tests/it/cpm/world/mod.rs"]
#[expect(dead_code, unused_imports, reason = "the tests use the rest")]
mod world;

use core::hint::black_box;
use core::ops::ControlFlow;
use criterion::{Criterion, criterion_group, criterion_main};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::{Alignment, FragmentMatching, Localizer, LocalizerConfig, Similarity, Turn};
use tolman_systems::cpm::{Aim, CpmConfig, Explorer};
use world::{Likeness, MazeConfig, PlaneMaze, PlaneWalker, Reckoning, WalkOutcome, WalkerNoise};

fn world(columns: u32, rows: u32) -> PlaneMaze {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut maze = MazeConfig::small();
    maze.columns = columns;
    maze.rows = rows;
    maze.diagonals = 0.3;
    PlaneMaze::random(&maze, &mut rng).unwrap()
}

fn explored(world: &PlaneMaze, config: CpmConfig, reckoning: Reckoning) -> Explorer {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut rover = PlaneWalker::new(world, WalkerNoise::NONE, reckoning);
    let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
    rover
        .pursue(&mut explorer, Aim::Explore, &mut rng, |_, _, _, _| {})
        .unwrap();
    explorer
}

/// Returns a maze of many loops and corridors of four kinds, as long as an e-puck sees them.
fn confusing(side: u32) -> PlaneMaze {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut maze = MazeConfig::small();
    maze.columns = side;
    maze.rows = side;
    maze.patterns = 100;
    maze.observations_per_cell = 8.0;
    maze.likeness = Likeness::Kinds(4);
    PlaneMaze::random(&maze, &mut rng).unwrap()
}

/// Returns a robot that sees one way too many at one place of thirty, as in an open room. So no map
/// explains all that it meets.
fn miscounted(world: &PlaneMaze, walks: u32) -> Explorer {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut rover = PlaneWalker::new(world, WalkerNoise::NOISY, Reckoning::Bounded);
    let mut config = CpmConfig::robust();
    config.most_traversals = walks;
    let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
    while let ControlFlow::Continue(leg) = explorer.decide(Aim::Explore, &mut rng) {
        // A way that is not there leads back.
        let is_there = leg.turn.0 < rover.sighting().degree;
        let turn = if is_there { leg.turn } else { Turn::BACK };
        if let WalkOutcome::Arrived(mut walk) = rover.go(turn, None, &mut rng).unwrap() {
            if rng.random_range(0..30_u32) == 0 {
                walk.sighting.degree += 1;
                walk.bearings = None;
            }
            let dictionary = world.dictionary();
            explorer.arrive(leg.turn, &walk, dictionary).unwrap();
        }
    }
    explorer
}

fn cpm(criterion: &mut Criterion) {
    let small = world(4, 4);
    let longest = |world: &PlaneMaze| {
        let sequences = world
            .corridors()
            .iter()
            .map(|corridor| corridor.patterns.clone());
        sequences.max_by_key(Vec::len).unwrap_or_default()
    };
    let sequence = longest(&small);
    let mut matching =
        criterion.benchmark_group(format!("cpm/match {} observations", sequence.len()));
    for (name, how) in [
        (
            "positions",
            FragmentMatching::Positions(Similarity::paper()),
        ),
        ("alignment", FragmentMatching::Alignment(Alignment::tuned())),
    ] {
        let dictionary = small.dictionary();
        matching.bench_function(name, |bench| {
            bench.iter(|| how.matches(dictionary, black_box(&sequence), black_box(&sequence)));
        });
    }
    matching.finish();

    let large = world(16, 16);
    let corridors = large.corridors().len();
    let mut exploring = criterion.benchmark_group("cpm/explore");
    exploring.sample_size(10);
    for (name, world, config, reckoning) in [
        ("4×4, online", &small, CpmConfig::online(), Reckoning::None),
        (
            "4×4, robust",
            &small,
            CpmConfig::robust(),
            Reckoning::Bounded,
        ),
        (
            "16×16, online",
            &large,
            CpmConfig::online(),
            Reckoning::None,
        ),
    ] {
        exploring.bench_function(name, |bench| {
            bench.iter(|| explored(world, config, reckoning));
        });
    }
    let rooms = confusing(12);
    exploring.bench_function("12×12, robust, ways miscounted, 200 walks", |bench| {
        bench.iter(|| miscounted(&rooms, 200));
    });
    exploring.finish();

    let map = explored(&large, CpmConfig::online(), Reckoning::None)
        .mapper
        .map()
        .clone();
    let maps = [map];
    let mut localizer =
        Localizer::new(&maps, large.dictionary(), LocalizerConfig::usual()).unwrap();
    criterion.bench_function(
        &format!("cpm/localize, an observation among {corridors} fragments"),
        |bench| {
            bench.iter(|| localizer.observe(black_box(sequence[0])));
        },
    );
}

criterion_group!(benches, cpm);
criterion_main!(benches);
