//! A mouse learns a maze, and a page plays how:
//! `cargo run -p tolman-film --example film_a_mouse > mouse.html`
#![expect(clippy::print_stdout, reason = "the page is its result")]

use tolman_arena::BoxError;
use tolman_arena::contest::{Condition, Contest, Moment};
use tolman_arena::registry::{Registry, RobotEntry, Schooling};
use tolman_film::Film;

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
    let mouse = Registry::current().system("micromouse");
    let contest = Contest {
        contestant: mouse.ok_or("there is no such system")?,
        robot: Some(RobotEntry::LASER_PIONEER),
        maze: &maze,
        name: "two loops",
        condition: Condition::AsMade,
        starts: 1,
        seed: 7,
        stopwatch: None,
    };
    let (mut film, mut replay) = (None, None);
    contest.play(&Schooling::default(), |outing, moment| match moment {
        Moment::Begun => film = Some(Film::new(outing)),
        Moment::Acted => film.iter_mut().for_each(|film| film.see(outing)),
        Moment::PutDown => film.iter_mut().for_each(|film| film.lifted(outing)),
        Moment::Over => {
            let title = "A mouse learns a maze".to_owned();
            replay = film.take().map(|film| film.replay(outing, title));
        }
    })?;
    let replay = replay.ok_or("the contest has ended")?;
    println!("{}", tolman_replay::page(&replay)?);
    Ok(())
}
