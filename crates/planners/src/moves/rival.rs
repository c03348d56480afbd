use tolman_maze::Cell;

/// A stop that is compared with another one, or with stopping at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rival {
    pub(super) stop: Cell,
    /// Sum, over the mazes, of the steps that it costs more.
    pub(super) sum: f32,
    squares: f32,
    mazes: f32,
}

impl Rival {
    pub(super) const fn new(stop: Cell) -> Self {
        Self {
            stop,
            sum: 0.0,
            squares: 0.0,
            mazes: 0.0,
        }
    }

    pub(super) fn add(&mut self, more: f32) {
        self.sum += more;
        self.squares += more * more;
        self.mazes += 1.0;
    }

    /// Returns the average number of steps it costs more.
    pub(super) fn mean(&self) -> f32 {
        self.sum / self.mazes
    }

    /// Returns the average number of steps it costs more, plus `confidence` standard errors.
    pub(super) fn at_worst(&self, confidence: f32) -> f32 {
        let mean = self.mean();
        let variance = (self.squares / self.mazes - mean * mean).max(LEAST_VARIANCE);
        mean + confidence * libm::sqrtf(variance / self.mazes)
    }
}

/// Minimum variance, for steps in few mazes that happen to be equal.
const LEAST_VARIANCE: f32 = 0.25;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rival_is_better_only_by_more_than_its_standard_error() {
        let mut rival = Rival::new(Cell::new(0, 0));
        for more in [-3.0, 1.0, -3.0, 1.0] {
            rival.add(more);
        }
        // Mean −1, variance 4, of four mazes: the standard error is 1.
        assert!((rival.mean() + 1.0).abs() < 1e-6);
        assert!(rival.at_worst(0.9) < 0.0);
        assert!(rival.at_worst(1.1) > 0.0);
    }

    #[test]
    fn its_worst_is_the_mean_and_standard_errors() {
        let mut rival = Rival::new(Cell::new(0, 0));
        for more in [1.0, 5.0] {
            rival.add(more);
        }
        // Mean 3, variance 4, of two mazes.
        assert!((rival.at_worst(1.0) - 3.0 - f32::sqrt(2.0)).abs() < 1e-6);
        assert!((rival.at_worst(-2.0) - 3.0 + 2.0 * f32::sqrt(2.0)).abs() < 1e-6);
    }
}
