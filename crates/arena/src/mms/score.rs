//! Score of a mouse, as in mms.

use serde::Serialize;

/// Unit in which a straight is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Straights are measured in half-steps, as in the code of mms.
    HalfSteps,
    /// Straights are measured in cells, as in the README of mms.
    Cells,
}

/// The figures that mms keeps of a mouse, in its single precision.
///
/// A *run* goes from the start cell to the goal. The effective distance of a movement counts every
/// unit after the second by half. The score is the best run's turns and effective distance, and a
/// tenth of all turns and effective distance; less is better.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Score {
    #[serde(skip)]
    unit: Unit,
    /// Whether a run was finished.
    pub solved: bool,
    #[serde(skip)]
    running: bool,
    #[serde(skip)]
    penalty: f32,
    /// Counts of all movements.
    pub total: Figures,
    /// The run under way, or the last.
    pub current: Figures,
    /// The finished run with the fewest turns and effective distance.
    pub best: Option<Figures>,
}

/// Counts of movements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Distance that the mouse went.
    pub distance: f32,
    /// Distance that the mouse went, with every unit of a straight after the second counted by
    /// half.
    pub effective_distance: f32,
    /// Number of turns.
    pub turns: f32,
}

/// Score of an unsolved maze.
const UNSOLVED: f32 = 2000.0;
/// Addition of a reset to the next run's effective distance.
const RESET_PENALTY: f32 = 15.0;

impl Score {
    /// Returns the score before the first movement.
    #[must_use]
    pub fn new(unit: Unit) -> Self {
        Self {
            unit,
            solved: false,
            running: false,
            penalty: 0.0,
            total: Figures::default(),
            current: Figures::default(),
            best: None,
        }
    }

    /// Starts a run: the mouse moves on from the start cell.
    pub(super) fn start_run(&mut self) {
        self.current = Figures {
            effective_distance: self.penalty,
            ..Figures::default()
        };
        self.total.effective_distance += self.penalty;
        self.penalty = 0.0;
        self.running = true;
    }

    /// Counts a straight of `half_steps` half-steps.
    pub(super) fn move_on(&mut self, half_steps: i32) {
        let distance = match self.unit {
            Unit::HalfSteps => half_steps as f32,
            Unit::Cells => half_steps as f32 / 2.0,
        };
        let effective_distance = if distance > 2.0 {
            distance / 2.0 + 1.0
        } else {
            distance
        };
        self.count(Figures {
            distance,
            effective_distance,
            turns: 0.0,
        });
    }

    /// Counts a turn by any angle.
    pub(super) fn turn(&mut self) {
        self.count(Figures {
            turns: 1.0,
            ..Figures::default()
        });
    }

    fn count(&mut self, more: Figures) {
        self.total.add(more);
        if self.running {
            self.current.add(more);
        }
    }

    /// Ends a run that came to stand in the goal.
    pub(super) fn finish_run(&mut self) {
        self.running = false;
        self.solved = true;
        if self
            .best
            .is_none_or(|best| self.current.cost() < best.cost())
        {
            self.best = Some(self.current);
        }
    }

    /// Ends a run as the mouse is back in the start cell.
    pub(super) fn end_run(&mut self) {
        self.running = false;
    }

    /// Ends a run as the mouse was carried back to the start.
    pub(super) fn reset(&mut self) {
        self.penalty = RESET_PENALTY;
        self.end_run();
    }

    /// Returns the score; less is better, 2000 if no run was finished.
    #[must_use]
    pub fn value(&self) -> f32 {
        let Some(best) = self.best else {
            return UNSOLVED;
        };
        // In the precision in which mms adds it up.
        (f64::from(best.cost()) + 0.1 * f64::from(self.total.cost())) as f32
    }

    /// Returns the reply to `getStat`: the figure of that name, or −1 if there is none yet. `None`
    /// for a name that mms does not know.
    #[must_use]
    pub fn stat(&self, name: &str) -> Option<String> {
        if name == "score" {
            return Some(six_digits(self.value()));
        }
        let of = [
            ("total-", Some(self.total)),
            ("current-run-", Some(self.current)),
            ("best-run-", self.best),
        ];
        let (figures, what) = of
            .into_iter()
            .find_map(|(prefix, figures)| Some((figures, name.strip_prefix(prefix)?)))?;
        let figure: fn(Figures) -> f32 = match what {
            "distance" => |figures| figures.distance,
            "turns" => |figures| figures.turns,
            "effective-distance" => |figures| figures.effective_distance,
            _ => return None,
        };
        let text = figures.map(|figures| six_digits(figure(figures)));
        // mms reads these back from its own text as whole numbers, which 1e+06 is not.
        let text = text.filter(|text| what == "effective-distance" || text.parse::<i32>().is_ok());
        Some(text.unwrap_or_else(|| "-1".to_owned()))
    }
}

impl Figures {
    fn add(&mut self, more: Self) {
        self.distance += more.distance;
        self.effective_distance += more.effective_distance;
        self.turns += more.turns;
    }

    fn cost(&self) -> f32 {
        self.turns + self.effective_distance
    }
}

/// Returns a number as C's `%g` writes it: at most six significant digits.
fn six_digits(value: f32) -> String {
    let scientific = format!("{value:.5e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..6).contains(&exponent) {
        let decimals = (5 - exponent) as usize;
        return trimmed(&format!("{value:.decimals$}")).to_owned();
    }
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{}e{sign}{:02}", trimmed(digits), exponent.abs())
}

/// Returns a decimal number without the zeros at its end.
fn trimmed(number: &str) -> &str {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_by_printf() {
        for (value, expected) in [
            (0.0, "0"),
            (2000.0, "2000"),
            (12.5, "12.5"),
            (123.456_7, "123.457"),
            (99_999.95, "100000"),
            (1_234_567.0, "1.23457e+06"),
            (0.000_012_5, "1.25e-05"),
        ] {
            assert_eq!(six_digits(value), expected);
        }
    }

    #[test]
    fn the_unit_decides_where_straights_begin_to_count_by_half() {
        for (unit, half_steps, effective) in [
            (Unit::HalfSteps, 2, 2.0),
            (Unit::HalfSteps, 6, 4.0),
            (Unit::Cells, 1, 0.5),
            (Unit::Cells, 6, 2.5),
        ] {
            let mut score = Score::new(unit);
            score.move_on(half_steps);
            assert!((score.total.effective_distance - effective).abs() < 1e-6);
        }
    }

    #[test]
    fn names_that_mms_does_not_know_have_no_figure() {
        let score = Score::new(Unit::HalfSteps);
        for name in [
            "",
            "-",
            "distance",
            "worst-run-turns",
            "total-effective-distance-",
        ] {
            assert_eq!(score.stat(name), None, "{name}");
        }
        for (name, expected) in [
            ("total-distance", "0"),
            ("best-run-turns", "-1"),
            ("best-run-effective-distance", "-1"),
            ("current-run-effective-distance", "0"),
            ("score", "2000"),
        ] {
            assert_eq!(score.stat(name).as_deref(), Some(expected), "{name}");
        }
    }
}
