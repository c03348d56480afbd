//! Sends several systems into one maze, and judges the maps that they learn of it.
#![expect(clippy::print_stdout, reason = "its table is its result")]

use tolman_arena::BoxError;
use tolman_arena::contest::{Condition, Contest};
use tolman_arena::registry::{Registry, RobotEntry, Schooling};

const MAZE: &str = "\
o---o---o---o---o
|               |
o   o---o---o   o
|   | G         |
o   o---o---o   o
| S |           |
o---o---o---o---o
";

fn main() -> Result<(), BoxError> {
    let maze = tolman_maze::read(MAZE)?.maze;
    let schooling = Schooling::default();
    println!("system          map    driven  home");
    for name in ["micromouse", "mslst-better", "gng-slam-better"] {
        let system = Registry::current().system(name);
        let contestant = system.ok_or("there is no such system")?;
        let contest = Contest {
            contestant,
            robot: Some(RobotEntry::LASER_PIONEER),
            maze: &maze,
            name: "two loops",
            condition: Condition::AsMade,
            starts: 1,
            seed: 7,
            stopwatch: None,
        };
        let record = contest.play(&schooling, |_, _| {})?;
        let learned = record.learned.ok_or("none of them abstains")?;
        let map = if learned.judgement.is_right {
            "right"
        } else {
            "wrong"
        };
        let way = record.homes.first().and_then(|home| home.over_shortest);
        let way = way.map_or("not reached".to_owned(), |way| {
            format!("{way:.2} of the shortest")
        });
        println!(
            "{:15} {map:6} {:5.1} m  {way}",
            contestant.title(),
            learned.driven
        );
    }
    Ok(())
}
