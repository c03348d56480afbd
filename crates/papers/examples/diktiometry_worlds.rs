//! How the diktiometry learns abstract worlds: the tables of docs/diktiometry.md that need no
//! simulator.
//!
//! `cargo run --release -p tolman-papers --example diktiometry_worlds -- TABLE [RUNS]`, TABLE one
//! of those in `TABLES`.
#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "an example that cannot set itself up has failed, and its table is its result"
)]

extern crate alloc;

use core::num::NonZeroU64;

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../../maps/tests/it/diktiometry/abstract_world.rs"]
mod abstract_world;
#[path = "../../maps/tests/it/diktiometry/walk.rs"]
mod walk;

use abstract_world::{AbstractWorld, MoveNoise};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::diktiometry::{
    GeometricMerge, Identity, Percepts, PerceptualIndexing, Use, ViewRotation,
};
use tolman_maze::Direction;
use tolman_papers::diktiometry::{ABLATIONS, Change};
use walk::{
    COMPASS, ODOMETRY, ROUGH, Scripted, Walk, alike, blocks, braided_corridors, open, painted,
    rooms,
};

/// A table of the example.
struct Table {
    name: &'static str,
    /// Default number of runs of a row.
    runs: u64,
    print: fn(u64),
}

const TABLES: [Table; 6] = [
    Table {
        name: "parts",
        runs: 6,
        print: parts,
    },
    Table {
        name: "growth",
        runs: 20,
        print: growth,
    },
    Table {
        name: "doors",
        runs: 4,
        print: doors,
    },
    Table {
        name: "looks",
        runs: 10,
        print: looks,
    },
    Table {
        name: "braided",
        runs: 100,
        print: braided,
    },
    Table {
        name: "kidnapped",
        runs: 4,
        print: kidnapped,
    },
];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let asked = arguments.next();
    let runs = arguments
        .next()
        .map(|runs| runs.parse::<NonZeroU64>().unwrap());
    let known = |asked: &str| TABLES.iter().any(|table| table.name == asked);
    assert!(
        asked.as_deref().is_none_or(known),
        "no such table: {asked:?}"
    );
    for table in TABLES {
        if asked.as_deref().is_none_or(|asked| asked == table.name) {
            let runs = runs.map_or(table.runs, NonZeroU64::get);
            println!("\n{}, {runs} runs\n", table.name);
            (table.print)(runs);
        }
    }
}

/// Counts the moves until the map is the world, with and without advice.
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
    let worlds: [(&str, u32, MoveNoise, Build<'_>); 5] = [
        ("7 × 7 corridors", 2000, ODOMETRY, &|seed| {
            corridors(7, seed)
        }),
        ("7 × 7 open", 2000, ODOMETRY, &|_| open(7)),
        ("7 × 7 corridors, wider boxes", 2000, ROUGH, &|seed| {
            corridors(7, seed)
        }),
        ("7 × 7 open, wider boxes", 2000, ROUGH, &|_| open(7)),
        ("10 × 10 open", 3000, ODOMETRY, &|_| open(10)),
    ];
    for (name, moves, errors, world) in worlds {
        for heed in [0.0, 0.3, 1.0] {
            let mut found = Vec::new();
            let (mut share, mut purity) = (0.0, 1.0_f64);
            for seed in 0..runs {
                let mut errors = errors;
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

/// Shows the map without each part of the mapper, where the mapper's assumptions hold and where
/// they do not.
fn parts(runs: u64) {
    let outliers = |share: f64, factor: f64| {
        let mut errors = ODOMETRY;
        errors.outliers = share;
        errors.outlier_factor = factor;
        errors
    };
    let seen = |look: f64| {
        let mut errors = ODOMETRY;
        errors.look = look;
        errors
    };
    let meets: Change = |config| {
        config.matching.identity = Identity::Meets;
        config.restructuring.geometric_merge = GeometricMerge::Estims;
    };
    let signatures: Change = |config| config.percepts = painted().percepts;
    let told: Change = |_| {};
    let worlds: [(&str, u16, f64, u32, MoveNoise, Change); 5] = [
        ("as told", 10, 0.3, 1500, ODOMETRY, told),
        (
            "1 % of moves wrong by 4 times the bounds",
            5,
            0.3,
            2000,
            outliers(0.01, 4.0),
            told,
        ),
        ("10 % by 3 times", 5, 0.3, 1000, outliers(0.1, 3.0), told),
        (
            "painted, seen with 3 times the error told",
            6,
            0.3,
            1000,
            seen(0.6),
            signatures,
        ),
        (
            "boxes that meet are the same, random walk",
            10,
            0.0,
            700,
            ODOMETRY,
            meets,
        ),
    ];
    print!("| |");
    for (name, ..) in &worlds {
        print!(" {name} |");
    }
    println!("\n| --- | --- | --- | --- | --- | --- |");
    for (name, ablate) in ABLATIONS {
        print!("| {name} |");
        for &(_, side, heed, moves, errors, adapt) in &worlds {
            let (mut purity, mut places) = (0.0, 0.0);
            for seed in 0..runs {
                let mut config = alike();
                adapt(&mut config);
                ablate(&mut config);
                let world = open(side).painted(5, seed);
                let mut walk = Walk::new(world, errors, config, seed);
                let mut planner = Scripted::new(heed, seed);
                for _ in 0..moves {
                    planner.go(&mut walk);
                }
                let score = walk.score();
                purity += score.purity / runs as f64;
                places += score.places as f64 / score.visited as f64 / runs as f64;
            }
            print!(" {purity:.3}, {places:.2} |");
        }
        println!();
    }
}

/// Shows a world that changes: after a number of moves a random door is shut or opened.
fn doors(runs: u64) {
    println!(
        "| moves between changes | fading | link precision | of links not seen shut | plans that work |"
    );
    println!("| ---: | ---: | ---: | ---: | ---: |");
    const SIDE: u16 = 7;
    for (period, moves) in [(25, 6000), (2000, 20_000)] {
        for fading in [1.0, 0.98, 0.92] {
            let (mut precision, mut open_precision, mut works, mut plans) = (0.0, 0.0, 0, 0);
            for seed in 0..runs {
                let mut config = alike();
                config.transients.fading = fading;
                let mut walk = Walk::new(open(SIDE), ODOMETRY, config, seed);
                let mut planner = Scripted::new(0.3, seed);
                let mut rng = ChaCha8Rng::seed_from_u64(seed);
                let cells = u32::from(SIDE) * u32::from(SIDE);
                let inner = |place: &u32| open(SIDE).neighbour(*place, Direction::East).is_some();
                // Every third place has a door to its east, if a way leads there.
                let doors: Vec<u32> = (0..cells).step_by(3).filter(inner).collect();
                for number in 1..=moves {
                    if number % period == 0 {
                        let door = doors[rng.random_range(0..doors.len() as u32) as usize];
                        let world = walk.robot.world().clone();
                        let shut = world.neighbour(door, Direction::East).is_none();
                        let to = shut.then_some(door + 1);
                        let world = world.with_way(door, Direction::East, to);
                        walk.robot.find_itself_in(world.into());
                    }
                    planner.go(&mut walk);
                    if number > moves / 2 && number % 20 == 0 {
                        plans += 1;
                        works += u32::from(plan_works(&walk, rng.random_range(0..cells)));
                    }
                    if number > moves / 2 && number % 100 == 0 {
                        let (all, seen) = link_precision(&walk);
                        precision += all;
                        open_precision += seen;
                    }
                }
            }
            let checks = f64::from(moves / 200) * runs as f64;
            println!(
                "| {period} | {fading} | {:.3} | {:.3} | {:.3} |",
                precision / checks,
                open_precision / checks,
                f64::from(works) / f64::from(plans)
            );
        }
    }
}

/// Measures what merges by looks are worth, and whether they confuse places, where boxes are too
/// wide for geometry. Worlds have more and more colours, or rooms that are furnished alike.
fn looks(runs: u64) {
    println!(
        "| world, walls | places for each true one: without | with merges by looks | least purity: without | with |"
    );
    println!("| --- | ---: | ---: | ---: | ---: |");
    const SIDE: u16 = 9;
    let mut rough = ODOMETRY;
    rough.distance = 0.2;
    rough.compass = 2.0 * COMPASS;
    rough.look = 0.2;
    type Build<'a> = &'a dyn Fn(u32, u64) -> AbstractWorld;
    let corridors: Build<'_> = &|colours, seed| {
        let maze = blocks(SIDE, 0.25, &mut ChaCha8Rng::seed_from_u64(seed));
        AbstractWorld::from_corridors(&maze, 1.0).painted(colours, seed)
    };
    let plain: Build<'_> = &|colours, seed| open(SIDE).painted(colours, seed);
    let small: Build<'_> = &|colours, seed| rooms(SIDE, 3, colours, seed);
    let hotel: Build<'_> = &|colours, seed| rooms(20, 4, colours, seed);
    let worlds = [
        ("corridors", corridors, &[1, 2, 3, 5, 8][..]),
        ("open", plain, &[1, 2, 3, 5, 8]),
        ("rooms of 3 × 3 places alike", small, &[3, 8]),
        ("20 × 20, rooms of 4 × 4 alike", hotel, &[3, 8]),
    ];
    for (name, world, walls) in worlds {
        for &colours in walls {
            let measured = [Use::Off, Use::On].map(|merge| {
                let (mut share, mut purity) = (0.0, 1.0_f64);
                for seed in 0..runs {
                    let mut config = painted();
                    config.restructuring.look_merge = merge;
                    let mut walk = Walk::new(world(colours, seed), rough, config, seed);
                    let mut planner = Scripted::new(0.3, seed);
                    for _ in 0..1500 {
                        planner.go(&mut walk);
                    }
                    let score = walk.score();
                    share += score.places as f64 / score.visited as f64 / runs as f64;
                    purity = purity.min(score.purity);
                }
                (share, purity)
            });
            let [(before, pure), (share, purity)] = measured;
            println!(
                "| {name}, {colours} colours | {before:.2} | {share:.2} | {pure:.4} | {purity:.4} |"
            );
        }
    }
}

/// Measures whether merges by looks make the map match the world in corridors of braided mazes, up
/// to six cells long. The mazes have fewer and fewer colours.
fn braided(runs: u64) {
    println!(
        "| walls | places for each true one | most | maps with each place once | least purity |"
    );
    println!("| ---: | ---: | ---: | ---: | ---: |");
    for colours in [8, 4, 3, 2, 1] {
        let (mut share, mut most, mut once, mut purity) = (0.0, 0.0_f64, 0, 1.0_f64);
        for seed in 0..runs {
            let score = braided_corridors(colours, seed).score();
            let places = score.places as f64 / score.visited as f64;
            share += places / runs as f64;
            most = most.max(places);
            once += u32::from(score.places == score.visited);
            purity = purity.min(score.purity);
        }
        println!("| {colours} | {share:.2} | {most:.2} | {once} | {purity:.4} |");
    }
}

/// Measures how soon a kidnapped robot localizes, with each form of perceptual indexing. It is
/// kidnapped after every hundred moves on a map that is known.
fn kidnapped(runs: u64) {
    const SIDE: u16 = 8;
    const AFTER: [usize; 3] = [2, 4, 8];
    println!("| walls, robot | indexing | at its true place after 2 moves | 4 | 8 |");
    println!("| --- | --- | ---: | ---: | ---: |");
    let turned: Change = |config| {
        if let Percepts::Signatures(kind) = &mut config.percepts {
            kind.rotation = ViewRotation::Free;
        }
    };
    let worlds: [(&str, u32, Change); 3] = [
        ("five colours", 5, |_| {}),
        ("three colours", 3, |_| {}),
        ("five colours, no heading in what is seen", 5, turned),
    ];
    let forms = [
        PerceptualIndexing::Columns,
        PerceptualIndexing::Triangles,
        PerceptualIndexing::Off,
    ];
    for (name, colours, change) in worlds {
        for form in forms {
            let (mut found, mut times) = ([0.0; AFTER.len()], 0.0);
            for seed in 0..runs {
                let mut config = painted();
                config.indexing.perceptual = form;
                change(&mut config);
                let mut errors = ODOMETRY;
                errors.look = 0.2;
                let world = open(SIDE).painted(colours, seed);
                let mut walk = Walk::new(world, errors, config, seed);
                walk.heed(1.0, 2000);
                let truths = walk.truths();
                let mut rng = ChaCha8Rng::seed_from_u64(seed);
                for _ in 0..20 {
                    walk.wander(100);
                    let cells = u32::from(SIDE) * u32::from(SIDE);
                    walk.robot.kidnap(rng.random_range(0..cells));
                    times += 1.0;
                    for moves in 1..=AFTER[AFTER.len() - 1] {
                        walk.wander(1);
                        let at = AFTER.iter().position(|after| *after == moves);
                        let right = truths.get(&walk.observer.place()) == Some(&walk.robot.at());
                        if let (Some(at), true) = (at, right) {
                            found[at] += 1.0;
                        }
                    }
                }
            }
            let shares = found.map(|count| format!("{:.0} %", 100.0 * count / times));
            println!("| {name} | {form:?} | {} |", shares.join(" | "));
        }
    }
}

/// Returns whether a plan leads to the place of the map that stands for a true one.
fn plan_works(walk: &Walk, to: u32) -> bool {
    let truths = walk.truths();
    let Some((goal, _)) = truths.iter().find(|(_, truth)| **truth == to) else {
        return false;
    };
    let Some(plan) = walk.observer.plan(walk.observer.place(), *goal) else {
        return false;
    };
    let end = plan.iter().try_fold(walk.robot.at(), |at, step| {
        let direction = Direction::ALL[step.action.0 as usize];
        walk.robot.world().neighbour(at, direction)
    });
    end == Some(to)
}

/// Returns the share of links that lead where their action leads: of all, and of those that were
/// not seen shut.
fn link_precision(walk: &Walk) -> (f64, f64) {
    let (truths, paths) = (walk.truths(), &walk.observer.map().paths);
    let (mut all, mut open) = ([0, 0], [0, 0]);
    for (_, link) in paths.links() {
        let [Some(from), Some(to)] = [link.from, link.to].map(|end| truths.get(&end)) else {
            continue;
        };
        let direction = Direction::ALL[link.action.0 as usize];
        let right = usize::from(walk.robot.world().neighbour(*from, direction) == Some(*to));
        all[right] += 1;
        if paths
            .place(link.from)
            .is_some_and(|place| place.is_open(link.action))
        {
            open[right] += 1;
        }
    }
    let share = |counts: [u32; 2]| f64::from(counts[1]) / f64::from(counts[0] + counts[1]);
    (share(all), share(open))
}
