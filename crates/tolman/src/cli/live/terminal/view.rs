//! Collects the run so far, and draws the frame that shows it.

use alloc::collections::VecDeque;
use std::io::{self, IsTerminal};

use ratatui::Frame;
use ratatui::crossterm::terminal;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Style, Stylize};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Padding, Paragraph, Wrap};
use tolman_experiment::Ink;
use tolman_film::Glimpse;
use tolman_geom::{Point, Pose};
use tolman_robot::Scan;

use super::pace::{Motion, Pace};
use super::palette::{BELIEF, BUMP, LABEL, MAP, inked};
use super::picture;
use super::wish::Wish;
use crate::cli::live::{Now, Scene};

/// Size of the smallest terminal that is drawn on, characters.
const LEAST_COLUMNS: u16 = 50;
const LEAST_ROWS: u16 = 16;

/// Width of the panel with the numbers, columns.
const PANEL: u16 = 27;

/// Number of steps that the trail goes back.
const TRAIL: usize = 2000;

/// Returns whether stdout is a terminal that is large enough and can be drawn on.
pub(super) fn fits_the_terminal() -> bool {
    // On Unix, TERM names the terminal; without a name it counts as a dumb one.
    let able = std::env::var_os("TERM").map_or(cfg!(windows), |terminal| terminal != "dumb");
    let large = |(columns, rows)| columns >= LEAST_COLUMNS && rows >= LEAST_ROWS;
    able && io::stdout().is_terminal() && terminal::size().is_ok_and(large)
}

/// A run so far.
#[derive(Debug)]
pub(super) struct View {
    pub(super) scene: Scene,
    pub(super) ink: Ink,
    /// Number of steps made.
    step: u32,
    time_us: u64,
    bumps: u32,
    pub(super) pose: Pose,
    /// Whether the last step ended at a wall.
    pub(super) bump: bool,
    /// Action in progress, or just ended.
    action: String,
    /// Outcome of the last action.
    ended: String,
    pub(super) scan: Option<Scan>,
    pub(super) trail: VecDeque<Point>,
    pub(super) beams: Beams,
    /// Map learned so far, and the robot's believed position.
    pub(super) known: Glimpse,
    /// Outcome in words; `None` until the run is over.
    pub(super) told: Option<String>,
}

/// Whether the laser's beams are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Beams {
    Shown,
    Hidden,
}

impl View {
    /// Returns a run that has not begun.
    pub(super) fn new(scene: Scene, ink: Ink) -> Self {
        let start = scene.start;
        Self {
            scene,
            ink,
            step: 0,
            time_us: 0,
            bumps: 0,
            pose: start,
            bump: false,
            action: none(),
            ended: none(),
            scan: None,
            trail: VecDeque::from([start.position]),
            beams: Beams::Hidden,
            known: Glimpse::default(),
            told: None,
        }
    }

    /// Adds one more step.
    pub(super) fn take(&mut self, now: &Now<'_>) {
        self.step += 1;
        self.time_us += self.scene.step_us;
        self.bumps += u32::from(now.bump);
        self.bump = now.bump;
        self.pose = now.pose;
        now.action.clone_into(&mut self.action);
        if let Some(ended) = now.ended {
            ended.clone_into(&mut self.ended);
        }
        self.scan = now.scan.cloned();
        if self.trail.len() > TRAIL {
            self.trail.pop_front();
        }
        self.trail.push_back(now.pose.position);
    }

    pub(super) fn show_or_hide_beams(&mut self) {
        self.beams = match self.beams {
            Beams::Shown => Beams::Hidden,
            Beams::Hidden => Beams::Shown,
        };
    }

    /// Draws a frame: the maze on the left, the panel on the right.
    pub(super) fn draw(&self, frame: &mut Frame<'_>, pace: Pace) {
        let area = frame.area();
        if area.width < LEAST_COLUMNS || area.height < LEAST_ROWS {
            let needed = format!("needs {LEAST_COLUMNS} × {LEAST_ROWS} characters");
            frame.render_widget(Paragraph::new(needed).wrap(Wrap { trim: true }), area);
            return;
        }
        let [maze, panel] =
            Layout::horizontal([Constraint::Fill(1), Constraint::Length(PANEL)]).areas(area);
        picture::draw(self, frame, maze);
        self.draw_panel(frame, panel, pace);
    }

    fn draw_panel(&self, frame: &mut Frame<'_>, area: Rect, pace: Pace) {
        let rim = Block::new().borders(Borders::LEFT).border_style(LABEL);
        let inside = rim.inner(area);
        frame.render_widget(rim, area);
        let [above, below] = Layout::vertical([
            Constraint::Fill(1),
            Constraint::Length(Wish::KEYS.len() as u16),
        ])
        .areas(inside);
        let numbers = self.numbers(pace);
        let [numbers_area, told_area] = Layout::vertical([
            Constraint::Length(numbers.len() as u16 + 1),
            Constraint::Fill(1),
        ])
        .areas(above);
        frame.render_widget(Paragraph::new(numbers), numbers_area);
        if let Some(told) = &self.told {
            let told = Paragraph::new(Line::from(told.as_str()).bold()).wrap(Wrap { trim: true });
            frame.render_widget(
                told.block(Block::new().padding(Padding::left(1))),
                told_area,
            );
        }
        let keys = Wish::KEYS.map(|keys| Line::styled(format!(" {keys}"), LABEL));
        frame.render_widget(Paragraph::new(Vec::from(keys)), below);
    }

    fn numbers(&self, pace: Pace) -> Vec<Line<'static>> {
        let Point { coords: at, .. } = self.pose.position;
        let bumps = if self.bump {
            Style::new().fg(inked(BUMP, self.ink)).bold()
        } else {
            Style::new()
        };
        let speed = match (&self.told, pace.motion) {
            (Some(_), _) => "the run is over".to_owned(),
            (None, Motion::Paused) => "paused".to_owned(),
            (None, Motion::Running) => format!("{} steps/s", pace.steps_per_second()),
        };
        let line = |label: &str, value: String| field(label, Span::raw(value));
        let mut lines = vec![
            Line::from(format!(" {}", tail(&self.scene.course.name))).bold(),
            Line::from(format!(" {}, seed {}", self.scene.word, self.scene.seed)),
            line(
                "step",
                match self.scene.step_limit {
                    Some(limit) => format!("{} of {limit}", self.step),
                    None => self.step.to_string(),
                },
            ),
            line("time", format!("{:.1} s", self.time_us as f64 / 1e6)),
            line("action", self.action.clone()),
            line("last", self.ended.clone()),
            line("pose", format!("{:.2}, {:.2} m", at.x, at.y)),
            line("heading", format!("{:.0}°", self.pose.heading.degrees())),
            field("bumps", Span::styled(self.bumps.to_string(), bumps)),
            line("speed", speed),
        ];
        let Glimpse { places, belief, .. } = &self.known;
        if !places.is_empty() {
            let value = format!("{} places", places.len());
            let style = Style::new().fg(inked(MAP, self.ink));
            lines.push(field("map", Span::styled(value, style)));
        }
        if !belief.is_empty() {
            let value = match belief.len() {
                1 => "1 place".to_owned(),
                count => format!("{count} places"),
            };
            let style = Style::new().fg(inked(BELIEF, self.ink));
            lines.push(field("may be", Span::styled(format!("at {value}"), style)));
        }
        lines
    }
}

fn field(label: &str, value: Span<'static>) -> Line<'static> {
    Line::from(vec![Span::styled(format!(" {label:<8}"), LABEL), value])
}

/// Returns the last part of a name that is too long for the panel; of a path, the file name.
fn tail(name: &str) -> String {
    let most = usize::from(PANEL) - 3;
    let characters = name.chars().count();
    if characters <= most {
        return name.to_owned();
    }
    let kept: String = name.chars().skip(characters - most + 1).collect();
    format!("…{kept}")
}

/// Returns the placeholder for a value that is not known yet.
fn none() -> String {
    "–".to_owned()
}

#[cfg(test)]
mod tests {
    use ratatui::Terminal;
    use ratatui::backend::TestBackend;
    use ratatui::style::Color;
    use tolman_arena::cast::{Agent, Cast};
    use tolman_arena::course::Course;
    use tolman_arena::episode::{self, Trial};
    use tolman_arena::pioneer::{body, calibrated};
    use tolman_geom::Heading;

    use super::*;
    use crate::cli::live::see;

    const MAZE: &str = "\
name = Hook

o---o---o
| S     |
o---o   o
| G     |
o---o---o
";

    fn course() -> Course {
        let file = tolman_maze::read(MAZE).unwrap();
        Course::for_body("hook.maze", &file, &body()).unwrap()
    }

    fn trial(course: &Course) -> Trial<'_> {
        let start = Pose::new(Point::new(0.5, 1.4), Heading::NORTH);
        Trial {
            course,
            robot: calibrated(),
            start,
            step_limit: 100,
            seed: 4,
        }
    }

    /// Returns a terminal of this size as it is at the end of the trial's run.
    fn seen(trial: &Trial<'_>, ink: Ink, columns: u16, rows: u16) -> Terminal<TestBackend> {
        let mut mind = Cast::default()
            .mind(Agent::WallFollow, trial.course, &trial.robot)
            .unwrap();
        let mut view = View::new(Scene::of(trial, "wall-follow"), ink);
        episode::run(trial, &mut mind, |step| see(step, |now| view.take(now))).unwrap();
        view.told = Some("wall-follow reached the destination".to_owned());
        let mut terminal = Terminal::new(TestBackend::new(columns, rows)).unwrap();
        terminal
            .draw(|frame| view.draw(frame, Pace::default()))
            .unwrap();
        terminal
    }

    #[test]
    fn a_map_and_a_belief_are_drawn_and_told() {
        let course = course();
        let trial = trial(&course);
        let mut view = View::new(Scene::of(&trial, "mslst"), Ink::Coloured);
        let mut shown = |known: Glimpse| {
            view.known = known;
            let mut terminal = Terminal::new(TestBackend::new(60, 18)).unwrap();
            let frame = terminal.draw(|frame| view.draw(frame, Pace::default()));
            let buffer = frame.unwrap().buffer.clone();
            let maze = |colour| {
                let cells = buffer.content().chunks(60).flat_map(|row| &row[..33]);
                cells.filter(|cell| cell.fg == colour).count()
            };
            let text: String = buffer
                .content()
                .iter()
                .map(ratatui::buffer::Cell::symbol)
                .collect();
            (maze(MAP), maze(BELIEF), text)
        };
        let (map, belief, text) = shown(Glimpse::default());
        assert_eq!((map, belief), (0, 0));
        assert!(!text.contains("places") && !text.contains("may be"));
        let (map, belief, text) = shown(Glimpse {
            places: vec![Point::new(0.5, 0.5), Point::new(1.5, 0.5)],
            ways: vec![[Point::new(0.5, 0.5), Point::new(1.5, 0.5)]],
            belief: vec![Point::new(1.2, 1.4)],
        });
        assert!(map > 3 && belief > 0, "{map} {belief}");
        assert!(
            text.contains("map     2 places") && text.contains("may be  at 1 place"),
            "{text}"
        );
    }

    const FRAME: &str = "\
⢀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀│ hook.maze
⢸                               ⢸│ wall-follow, seed 4
⢸                               ⢸│ step    17 of 100
⢸                               ⢸│ time    1.7 s
⢸                               ⢸│ action  west
⢸        ⠁⠁⠁⠁⠁⠁⠁⠁⠁⠂⠂⠂⠂⠢         ⢸│ last    west: done
⢸                     ⠨         ⢸│ pose    0.74, 0.68 m
⢸                     ⠨         ⢸│ heading 179°
⢸⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀     ⠨         ⢸│ bumps   3
⢸⢈ ⡁⢈⢈ ⡁⢈⢠⡕⢋⠉⡉⢉⠳⣅     ⠨         ⢸│ speed   the run is over
⢸⠠ ⠄⠠⠠ ⠄⢠⡏⠄⠠←⠄⠠ ⢜⣆⢀⢀⠠⠠⠘         ⢸│
⢸⠐ ⠂⠐⠐ ⠂⠘⡆⠂⠐ ⠊⠘⠈⢂⡇              ⢸│ wall-follow reached the
⢸⢈ ⡁⢈⢈ ⡁⢈⠙⣅⣈ ⡁⢈⣠⡟               ⢸│ destination
⢸⠠ ⠄⠠⠠ ⠄⠠ ⠄⠩⠉⠍⠩ ⠄               ⢸│
⢸⠐ ⠂⠐⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂               ⢸│
⢸⢈ ⡁⢈⢈ ⡁⢈ ⡁⢈ ⡁⢈ ⡁               ⢸│ space pause   → step
⢸⣠⣀⣄⣠⣠⣀⣄⣠⣀⣄⣠⣀⣄⣠⣀⣄⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣸│ +/- speed   b beams
                                 │ q quit
";

    #[test]
    fn a_frame() {
        let course = course();
        let shown = seen(&trial(&course), Ink::Plain, 60, 18);
        // The test backend quotes the rows of the terminal.
        let shown = shown.backend().to_string().replace('"', "");
        let rows: Vec<_> = shown.lines().map(str::trim_end).collect();
        assert_eq!(rows.join("\n"), FRAME.trim_end());
    }

    #[test]
    fn without_colours_there_are_none() {
        let course = course();
        let colours = |ink| {
            let terminal = seen(&trial(&course), ink, 60, 18);
            let cells = terminal.backend().buffer().content().iter();
            cells.filter(|cell| cell.fg != Color::Reset).count()
        };
        assert_eq!(colours(Ink::Plain), 0);
        assert!(colours(Ink::Coloured) > 10);
    }

    #[test]
    fn a_terminal_that_has_shrunk_says_what_is_needed() {
        let course = course();
        for (columns, rows) in [(49, 16), (50, 15), (30, 2), (1, 1)] {
            let shown = seen(&trial(&course), Ink::Plain, columns, rows);
            let shown = shown.backend().to_string();
            assert!(!shown.contains("seed") && (columns < 30 || shown.contains("50 × 16")));
        }
    }

    #[test]
    fn of_a_long_path_the_end_is_kept() {
        assert_eq!(tail("mazes/j.maze"), "mazes/j.maze");
        let long = "competitions/all-japan/2016/hard.maze";
        assert_eq!(tail(long), "…ll-japan/2016/hard.maze");
    }
}
