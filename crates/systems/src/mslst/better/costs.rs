use tolman_maze::Direction;
use tolman_planners::Decisions;

/// Average cost of each action until an end, at each standpoint and along either axis: ten bytes
/// per standpoint.
///
/// The plan's decisions take thirty times as much, and are not needed afterwards.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ActionCosts {
    /// The least cost at each standpoint, in [`LEAST_UNIT`]s.
    least: Vec<u16>,
    /// Additional cost of each action, in [`MORE_UNIT`]s.
    more: Vec<[u8; OPTIONS]>,
}

/// Axes and actions at a standpoint.
const OPTIONS: usize = 8;
/// Cost of a standpoint from which no way leads to the goal, time steps.
pub(super) const HOPELESS: f32 = 1e4;
/// Resolution of the stored least costs, time steps.
const LEAST_UNIT: f64 = 0.25;
/// Resolution of the other costs, relative to the least, time steps. Costs more than 32 above the
/// least count as equal.
const MORE_UNIT: f64 = 0.125;

impl ActionCosts {
    /// Returns the costs of [`OPTIONS`] in turn for every standpoint, where `states` are the costs
    /// of the states of `decisions`. O(ends of decisions).
    pub(super) fn of(decisions: &Decisions, states: &[f32]) -> Self {
        let standpoints = states.len() * decisions.actions() / OPTIONS;
        let mut costs = Self {
            least: Vec::with_capacity(standpoints),
            more: Vec::with_capacity(standpoints),
        };
        for standpoint in 0..standpoints {
            let options = core::array::from_fn(|option| {
                let index = standpoint * OPTIONS + option;
                let (state, action) = (index / decisions.actions(), index % decisions.actions());
                let cost = decisions.cost(states, state, action);
                f64::from(cost.min(HOPELESS))
            });
            costs.add(options);
        }
        costs
    }

    fn add(&mut self, options: [f64; OPTIONS]) {
        let least = options.iter().copied().fold(f64::from(HOPELESS), f64::min);
        self.least.push(libm::round(least / LEAST_UNIT) as u16);
        self.more
            .push(options.map(|cost| libm::round((cost - least) / MORE_UNIT) as u8));
    }

    /// Returns the mean number of time steps to the end of the ways from a standpoint by an action,
    /// facing along an axis; [`HOPELESS`] if no way leads there.
    pub(super) fn cost(&self, standpoint: u32, axis: usize, action: Direction) -> f64 {
        let option = axis * Direction::ALL.len() + action.index();
        let standpoint = standpoint as usize;
        let (Some(least), Some(more)) = (self.least.get(standpoint), self.more.get(standpoint))
        else {
            return f64::from(HOPELESS);
        };
        f64::from(*least) * LEAST_UNIT + f64::from(more[option]) * MORE_UNIT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_are_kept_as_exactly_as_they_matter() {
        let mut costs = ActionCosts {
            least: Vec::new(),
            more: Vec::new(),
        };
        let options = [70.05, 71.0, 75.3, 80.0, 70.1, 1e4, 101.0, 72.0];
        costs.add(options);
        let chosen = [0, 1]
            .into_iter()
            .flat_map(|axis| Direction::ALL.map(|action| (axis, action)));
        for ((axis, action), expected) in chosen.zip(options) {
            let cost = costs.cost(0, axis, action);
            let most = 70.05 + 255.0 * MORE_UNIT;
            assert!((cost - expected.min(most)).abs() < 0.2, "{cost}");
        }
        assert!(costs.cost(1, 0, Direction::ALL[0]) >= f64::from(HOPELESS));
    }
}
