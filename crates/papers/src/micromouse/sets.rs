//! Sets of mazes: external ones if they are here, our own, and those that the caller names.

use std::path::{Path, PathBuf};

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_formats::input::{self, SourceError};
use tolman_maze::{Braided, Maze};

use crate::maze_file;
use tolman_experiment::files::files_in;
use tolman_experiment::{BoxError, Row};
use tolman_systems::micromouse::SIDE;

/// A set of mazes with a name.
#[derive(Debug)]
pub(super) struct MazeSet {
    /// Name of the row of this set.
    pub(super) name: String,
    /// Mazes with the names of their files, sorted by name.
    pub(super) mazes: Vec<(String, Maze)>,
    /// Numbers of files left out, by reason.
    pub(super) left_out: LeftOut,
}

/// Files of a folder in which no mouse can have a score.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct LeftOut {
    no_maze: usize,
    no_way: usize,
    no_fit: usize,
}

impl MazeSet {
    /// Returns a set without omissions.
    fn of(name: String, mazes: Vec<(String, Maze)>) -> Self {
        Self {
            name,
            mazes,
            left_out: LeftOut::default(),
        }
    }

    /// Returns our mazes with a few loops, the same ones every time.
    fn ours() -> Result<Self, BoxError> {
        let braided = Braided {
            width: 16,
            height: 16,
            share: 0.5,
        };
        let maze = |seed| -> Result<_, BoxError> {
            let maze = braided.generate(&mut ChaCha8Rng::seed_from_u64(seed))?;
            Ok((format!("seed {seed}"), maze))
        };
        let mazes = (0..OURS).map(maze).collect::<Result<_, _>>()?;
        Ok(Self::of("braided 16".to_owned(), mazes))
    }

    /// Returns all mazes of a folder that can be solved and fit a mouse, sorted by name.
    fn in_folder(name: String, folder: &Path) -> Result<Self, BoxError> {
        let files = files_in(folder)
            .map_err(|error| format!("the folder {} cannot be read: {error}", folder.display()))?;
        let mut set = Self::of(name, Vec::new());
        for path in &files {
            let text = match input::text(path) {
                Ok(text) => text,
                Err(SourceError::NoText { .. } | SourceError::Utf16) => {
                    set.left_out.no_maze += 1;
                    continue;
                }
                Err(error) => return Err(maze_file::in_file(path, error)),
            };
            match tolman_maze::read(&text) {
                Ok(file) if fits(&file.maze) => set.mazes.push((maze_file::stem(path), file.maze)),
                Ok(_) => set.left_out.no_fit += 1,
                // Many collections have a maze without a way to the goal, as a test of the mouse.
                // It has no score.
                Err(_) if tolman_maze::parse(&text).is_ok() => set.left_out.no_way += 1,
                Err(_) => set.left_out.no_maze += 1,
            }
        }
        Ok(set)
    }

    /// Returns its row, with one run for each maze.
    pub(super) fn row(&self) -> Row {
        Row::new(&self.name).run_each(self.mazes.len() as u32)
    }

    /// Returns the maze of a run, with its name.
    pub(super) fn maze(&self, run: u32) -> Result<&(String, Maze), BoxError> {
        let maze = self.mazes.get(run as usize);
        maze.ok_or_else(|| "there is no such run".into())
    }

    /// Returns a sentence about the mazes that were left out; `None` if none was.
    pub(super) fn complaint(&self) -> Option<String> {
        let LeftOut {
            no_maze,
            no_way,
            no_fit,
        } = self.left_out;
        let out = no_maze + no_way + no_fit;
        if out == 0 {
            return None;
        }
        let unfit = format!("without a start or of more than {SIDE} cells a side");
        let reasons = [
            (no_way, "without a way to the goal"),
            (no_fit, &unfit),
            (no_maze, "that are not mazes"),
        ];
        let reasons: Vec<String> = reasons
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, reason)| format!("{count} {reason}"))
            .collect();
        let all = out + self.mazes.len();
        Some(format!(
            "{}: {out} of {all} files left out, {}.",
            self.name,
            reasons.join(", ")
        ))
    }
}

/// Name of the set that is only for the competition model.
pub(super) const HALF_SIZE: &str = "half-size";

/// External sets, below the folder of external data.
const OTHERS: [(&str, &str); 7] = [
    ("classic", "mazes/classic"),
    (HALF_SIZE, "mazes/halfsize"),
    ("generated 12", "mazes/generated/12"),
    ("generated 14", "mazes/generated/14"),
    ("generated 16", "mazes/generated/16"),
    ("generated 18", "mazes/generated/18"),
    ("generated 20", "mazes/generated/20"),
];

/// Number of our own mazes.
const OURS: u64 = 20;

pub(super) fn all(folder: Option<&Path>, named: &[PathBuf]) -> Result<Vec<MazeSet>, BoxError> {
    let mut sets = Vec::new();
    for (name, path) in OTHERS {
        let path = folder.map(|folder| folder.join(path));
        if let Some(path) = path.filter(|path| path.is_dir()) {
            sets.push(MazeSet::in_folder(name.to_owned(), &path)?);
        }
    }
    sets.push(MazeSet::ours()?);
    for path in named {
        let is_taken = |name: &str| sets.iter().any(|set| set.name == name);
        let name = maze_file::told_apart(&maze_file::stem(path), is_taken);
        let set = if path.is_dir() {
            MazeSet::in_folder(name, path)?
        } else {
            MazeSet::of(name, vec![(maze_file::stem(path), maze(path)?)])
        };
        if set.mazes.is_empty() {
            return Err(format!("{} holds no maze: name another folder", path.display()).into());
        }
        sets.push(set);
    }
    Ok(sets)
}

fn maze(path: &Path) -> Result<Maze, BoxError> {
    let maze = maze_file::read(path)?.maze;
    if !fits(&maze) {
        let reason = format!("it has no start or more than {SIDE} cells a side");
        return Err(maze_file::in_file(path, reason));
    }
    Ok(maze)
}

fn fits(maze: &Maze) -> bool {
    let side = maze.grid().width().max(maze.grid().height());
    usize::from(side) <= SIDE && maze.start().is_some()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const SOUND: &str = "+---+---+\n| S   G |\n+---+---+\n";

    #[test]
    fn what_is_left_out_is_counted() {
        let folder = std::env::temp_dir().join(format!("tolman-sets-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let mut large = Maze::open(tolman_maze::Grid::new(33, 2));
        large.set_start(Some((
            tolman_maze::Cell::new(0, 0),
            tolman_maze::Direction::North,
        )));
        large.set_goals(vec![tolman_maze::Cell::new(9, 1)]);
        for (name, text) in [
            ("a.maze", SOUND.to_owned()),
            ("b.maze", SOUND.replace("S   G", "S | G")),
            ("c.maze", large.to_string()),
            ("d.maze", "no maze".to_owned()),
        ] {
            fs::write(folder.join(name), text).unwrap();
        }
        fs::write(folder.join("e.png"), b"\x89PNG\xff").unwrap();
        let set = MazeSet::in_folder("mine".to_owned(), &folder).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(
            set.complaint().unwrap(),
            "mine: 4 of 5 files left out, 1 without a way to the goal, 1 without a start or of more than 32 cells a side, \
             2 that are not mazes."
        );
        let whole = MazeSet {
            left_out: LeftOut::default(),
            ..set
        };
        assert_eq!(whole.complaint(), None);
    }
}
