//! Q-learning, with which both the micromouse's and the e-puck's paper compare themselves.

use rand::{Rng, RngExt};

/// A task to learn: the cheapest way from the start to a goal.
pub trait LearningTask {
    /// Returns the state each episode begins in.
    fn start(&self) -> usize;
    /// Returns the number of states.
    fn states(&self) -> usize;
    /// Returns the number of actions of a state, at least 1.
    fn actions(&self, state: usize) -> u32;
    /// Returns the transition of an action.
    fn act(&self, state: usize, action: u32) -> Transition;
    /// Returns whether an episode ends in a state.
    fn is_goal(&self, state: usize) -> bool;
}

/// Result of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition {
    /// State after the transition.
    pub next: usize,
    /// Cost of the action, in the task's own unit.
    pub cost: u32,
}

/// Parameters of learning. Neither paper names any of these values.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct QLearningConfig {
    /// Learning rate α: weight of a new estimate against the old value, 0 … 1.
    pub learning_rate: f64,
    /// Discount γ: weight of the next state's value, 0 … 1.
    pub discount: f64,
    /// Share of random actions, 0 to 1.
    pub exploration: f64,
}

impl QLearningConfig {
    /// Returns usual values for a deterministic world, chosen in favour of the learner.
    #[must_use]
    pub const fn usual() -> Self {
        Self {
            learning_rate: 1.0,
            discount: 1.0,
            exploration: 0.05,
        }
    }
}

/// A table of values *Q*(state, action), learned action by action. Each action is rewarded with
/// minus its cost. At a goal the learner is put back to the start. Values begin at zero, which no
/// experience exceeds, so the learner tries everything.
///
/// ```
/// use rand::SeedableRng;
/// use rand_chacha::ChaCha8Rng;
/// use tolman_systems::baselines::q_learning::{LearningTask, QLearner, QLearningConfig, Transition};
///
/// /// Three states in a row, the last of which is the goal: action 0 leads back, 1 on.
/// struct Row;
/// impl LearningTask for Row {
///     fn start(&self) -> usize { 0 }
///     fn states(&self) -> usize { 3 }
///     fn actions(&self, _: usize) -> u32 { 2 }
///     fn act(&self, state: usize, action: u32) -> Transition {
///         let next = if action == 0 { state.saturating_sub(1) } else { state + 1 };
///         Transition { next, cost: 1 }
///     }
///     fn is_goal(&self, state: usize) -> bool { state == 2 }
/// }
///
/// let mut learner = QLearner::new(QLearningConfig::usual(), Row);
/// assert_eq!(learner.greedy_cost(), None, "it knows nothing yet");
/// let mut rng = ChaCha8Rng::seed_from_u64(1);
/// for _ in 0..100 {
///     learner.step(&mut rng);
/// }
/// assert_eq!(learner.greedy_cost(), Some(2));
/// ```
#[derive(Clone, Debug)]
pub struct QLearner<T> {
    config: QLearningConfig,
    task: T,
    /// Values by state, then action.
    values: Vec<Vec<f64>>,
    at: usize,
}

impl<T: LearningTask> QLearner<T> {
    /// Returns a learner at the start, without experience.
    #[must_use]
    pub fn new(config: QLearningConfig, task: T) -> Self {
        let values = (0..task.states()).map(|state| vec![0.0; task.actions(state) as usize]);
        Self {
            config,
            values: values.collect(),
            at: task.start(),
            task,
        }
    }

    /// Takes one action and returns its result; after the goal the learner is at the start again.
    pub fn step(&mut self, rng: &mut impl Rng) -> Transition {
        let (state, action) = (self.at, self.action(rng));
        let outcome = self.task.act(state, action);
        let done = self.task.is_goal(outcome.next);
        let future = if done {
            0.0
        } else {
            let values = self.values[outcome.next].iter();
            values.copied().fold(f64::MIN, f64::max)
        };
        let QLearningConfig {
            learning_rate,
            discount,
            ..
        } = self.config;
        if let Some(value) = self.values[state].get_mut(action as usize) {
            *value += learning_rate * (discount * future - f64::from(outcome.cost) - *value);
        }
        self.at = if done {
            self.task.start()
        } else {
            outcome.next
        };
        outcome
    }

    fn action(&self, rng: &mut impl Rng) -> u32 {
        #[expect(clippy::manual_clamp, reason = "`max` first makes 0 of NaN")]
        let exploration = self.config.exploration.max(0.0).min(1.0);
        if rng.random_bool(exploration) {
            return rng.random_range(0..self.task.actions(self.at).max(1));
        }
        self.best(self.at)
    }

    /// Returns the action of greatest value; of equals the first.
    fn best(&self, state: usize) -> u32 {
        let values = &self.values[state];
        let mut best = 0;
        for (action, value) in values.iter().enumerate() {
            if *value > values[best] {
                best = action;
            }
        }
        best as u32
    }

    /// Returns the cost of the learned way from the start to a goal, or `None` if it does not reach
    /// one.
    #[must_use]
    pub fn greedy_cost(&self) -> Option<u32> {
        let (mut at, mut cost) = (self.task.start(), 0);
        for _ in 0..=self.task.states() {
            if self.task.is_goal(at) {
                return Some(cost);
            }
            let outcome = self.task.act(at, self.best(at));
            cost += outcome.cost;
            at = outcome.next;
        }
        None
    }
}
