//! Sends contestants into worlds of all families:
//! `cargo run --release -p tolman-arena --example contest [SYSTEM] [WORLDS] [own|pioneer] [SIZE]`.
#![expect(clippy::print_stdout, reason = "its table is its result")]

use std::time::Instant;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::contest::{Condition, Contest, ContestRobot, Contestant, Located, Schooling};
use tolman_arena::family::Family;

fn main() -> Result<(), tolman_arena::BoxError> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |at: usize| arguments.get(at).map(String::as_str);
    let wanted = argument(0).and_then(Contestant::named);
    let worlds: u64 = argument(1).unwrap_or("1").parse()?;
    let robot = match argument(2) {
        Some("pioneer") => ContestRobot::Pioneer,
        _ => ContestRobot::Own,
    };
    let size: usize = argument(3).unwrap_or("0").parse()?;
    let schooling = Schooling::default();
    for contestant in Contestant::ALL {
        if wanted.is_some_and(|wanted| wanted != contestant) {
            continue;
        }
        for family in Family::ARENA {
            for seed in 0..worlds {
                let rng = &mut ChaCha8Rng::seed_from_u64(seed);
                let maze = (family.draw)(family.sizes[size], rng)?;
                let contest = Contest {
                    contestant,
                    robot,
                    maze: &maze,
                    name: family.name,
                    condition: Condition::AsMade,
                    starts: 1,
                    seed,
                    stopwatch: None,
                };
                let began = Instant::now();
                let record = contest.play(&schooling, |_, _| {})?;
                let homes: Vec<String> = (record.homes.iter())
                    .map(|home| format!("{:?} {}", home.over_shortest, home.gave_up))
                    .collect();
                let found: Vec<&Located> = record.found.iter().collect();
                let learned = record.learned.map(|l| {
                    let j = l.judgement;
                    format!(
                        "right {} visited {} purity {:?} places {:.2} ({}) links {:?} {:.2} driven {:.1} steps {} {:?}",
                        j.is_right, j.is_right_of_visited, j.purity, j.places, l.places, j.link_precision, j.link_recall, l.driven, l.steps, l.end
                    )
                });
                println!(
                    "{:18} {:13} {seed}: {:.1} s {} {} home {homes:?} found {found:?}",
                    contestant.name(),
                    family.name,
                    began.elapsed().as_secs_f64(),
                    record.abstained.unwrap_or_default(),
                    learned.unwrap_or_default(),
                );
            }
        }
    }
    Ok(())
}
