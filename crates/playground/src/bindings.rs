//! Interface of the playground for JavaScript: texts and JSON in both directions.

use serde::Serialize;
use tolman_arena::family::Family;
use tolman_maze::{Cell, Direction};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::lessons::{self, Answer};
use crate::{Playground, PlaygroundError, Session, Sketch};

fn json(value: &impl Serialize) -> String {
    // Writing fails only for a key that is not text, or a type that refuses. Neither exists here.
    serde_json::to_string(value).unwrap_or_default()
}

fn told<T>(done: Result<T, PlaygroundError>) -> Result<T, String> {
    done.map_err(|error| error.to_string())
}

/// State of the page: a maze, and a session in it once one has begun.
#[wasm_bindgen]
#[derive(Debug)]
pub struct PlaygroundPage {
    playground: Playground,
    sketch: Sketch,
    session: Option<Session>,
}

#[wasm_bindgen]
impl PlaygroundPage {
    /// Opens the page with a maze.
    #[wasm_bindgen(constructor)]
    pub fn new(maze: &str) -> Result<PlaygroundPage, String> {
        Ok(Self {
            playground: Playground::default(),
            sketch: told(Sketch::read(maze))?,
            session: None,
        })
    }

    /// Returns the systems that can be chosen.
    pub fn systems() -> String {
        json(&Playground::systems())
    }

    /// Returns the families of mazes that can be drawn, by name and description.
    pub fn families() -> String {
        let families = Family::all();
        let told = families.iter().map(|family| [family.name, family.about]);
        json(&told.collect::<Vec<_>>())
    }

    /// Replaces the maze by that of a text.
    pub fn read(&mut self, maze: &str) -> Result<(), String> {
        self.sketch = told(Sketch::read(maze))?;
        Ok(())
    }

    /// Replaces the maze by a drawing of a family.
    pub fn draw(&mut self, family: &str, size: u16, seed: u32) -> Result<(), String> {
        self.sketch = told(Sketch::drawn(family, size, seed.into()))?;
        Ok(())
    }

    /// Replaces the maze by one without inner walls.
    pub fn clear(&mut self, size: u16) {
        self.sketch = Sketch::empty(size);
    }

    /// Builds or removes a wall on the `side` of a cell: `north`, `east`, `south` or `west`.
    pub fn set_wall(&mut self, x: u16, y: u16, side: &str, stands: bool) {
        let side = Direction::ALL
            .into_iter()
            .find(|known| json(known) == json(&side));
        if let Some(side) = side {
            self.sketch.set_wall(Cell::new(x, y), side, stands);
        }
    }

    /// Moves the start to a cell.
    pub fn set_start(&mut self, x: u16, y: u16) {
        self.sketch.set_start(Cell::new(x, y));
    }

    /// Moves the goal to a cell.
    pub fn set_goal(&mut self, x: u16, y: u16) {
        self.sketch.set_goal(Cell::new(x, y));
    }

    /// Returns the maze as text.
    pub fn text(&self) -> String {
        self.sketch.text()
    }

    /// Returns the drawing of the maze.
    pub fn plan(&self) -> String {
        json(&self.sketch.plan())
    }

    /// Sends a system into the maze.
    pub fn begin(&mut self, system: &str, seed: u32) -> Result<String, String> {
        let session = told(self.playground.begin(&self.sketch, system, seed.into()))?;
        let state = json(&session.state());
        self.session = Some(session);
        Ok(state)
    }

    /// Lets the system act for `steps` time steps.
    pub fn advance(&mut self, steps: u32) -> Result<String, String> {
        Ok(json(&self.session()?.advance(steps as usize)))
    }

    /// Lifts the robot and puts it down at a position, m.
    pub fn put_down(&mut self, x: f64, y: f64) -> Result<String, String> {
        let state = told(self.session()?.put_down(x, y))?;
        Ok(json(&state))
    }

    /// Sends the robot to the goal.
    pub fn go_home(&mut self) -> Result<String, String> {
        Ok(json(&self.session()?.go_home()))
    }

    /// Returns the run so far.
    pub fn replay(&mut self) -> Result<String, String> {
        told(self.session()?.replay())
    }

    /// Returns a fingerprint of the run so far.
    pub fn fingerprint(&mut self) -> Result<String, String> {
        Ok(self.session()?.fingerprint())
    }

    fn session(&mut self) -> Result<&mut Session, String> {
        self.session
            .as_mut()
            .ok_or_else(|| "nobody was sent into the maze yet".to_owned())
    }
}

fn answer(text: &str) -> Result<Answer, PlaygroundError> {
    Ok(serde_json::from_str(text)?)
}

/// Returns what a pupil sees of a task of a lesson. Both count from 1.
#[wasm_bindgen]
#[expect(unreachable_pub, reason = "JavaScript calls it")]
pub fn task_view(lesson: usize, task: usize, text: &str) -> Result<String, String> {
    let view = answer(text).and_then(|answer| lessons::view(lesson, task, &answer));
    Ok(json(&told(view)?))
}

/// Marks a pupil's answer to a task of a lesson. Both count from 1.
#[wasm_bindgen]
#[expect(unreachable_pub, reason = "JavaScript calls it")]
pub fn mark_task(lesson: usize, task: usize, text: &str) -> Result<String, String> {
    let mark = answer(text).and_then(|answer| lessons::mark(lesson, task, &answer));
    Ok(json(&told(mark)?))
}
