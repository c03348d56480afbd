//! The search for good parameters: "a method, based on Simulated Annealing" (section 3.4, "Finding
//! good parameter values").

use rand::Rng;
use tolman_experiment::BoxError;

use super::search_space::Parameters;

/// Width of the window at the last step, as a share of the search space: "to less than 1 %".
const LAST: f64 = 0.0099;

/// A map of a search.
#[derive(Clone, Debug)]
pub(super) struct Tried<T> {
    pub(super) parameters: Parameters,
    /// Map that was learned.
    pub(super) map: T,
    /// Score of the map, 0 … 1; 0 for a useless map.
    pub(super) score: f64,
}

/// A search in progress. The parameters of each map are near those of the better of the two maps
/// before it.
#[derive(Debug)]
pub(super) struct Annealing<T> {
    /// Number of maps over which the window shrinks.
    steps: u32,
    tried: Vec<Tried<T>>,
}

impl<T: Clone> Annealing<T> {
    pub(super) const fn new(steps: u32) -> Self {
        Self {
            steps,
            tried: Vec::new(),
        }
    }

    /// Returns the map with this number, after learning those before it. `rng` returns the
    /// generator for a map's parameters, and `learn` makes the map of a number with parameters.
    pub(super) fn map<R: Rng>(
        &mut self,
        number: u32,
        rng: impl Fn(u32) -> R,
        learn: impl Fn(u32, &Parameters) -> Result<(T, f64), BoxError>,
    ) -> Result<Tried<T>, BoxError> {
        for step in self.tried.len() as u32..=number {
            let parameters = self.next(&mut rng(step));
            let (map, score) = learn(step, &parameters)?;
            self.tried.push(Tried {
                parameters,
                map,
                score,
            });
        }
        Ok(self.tried[number as usize].clone())
    }

    /// Returns the parameters of the next map.
    fn next(&self, rng: &mut impl Rng) -> Parameters {
        let share = self.share(self.tried.len() as u32);
        match self.tried.as_slice() {
            // 1: "a random value within 100 % of their range".
            [] => Parameters::anywhere(rng),
            [first] => first.parameters.near(share, rng),
            // 3b: "the current network and the previous created network".
            [.., previous, current] => {
                let current_wins = current.score >= previous.score;
                let best = if current_wins { current } else { previous };
                best.parameters.near(share, rng)
            }
        }
    }

    /// Returns the width of a step's window, as a share of the search space. Each step narrows it
    /// by the same factor.
    fn share(&self, step: u32) -> f64 {
        let last = self.steps.saturating_sub(1).max(1);
        libm::pow(LAST, f64::from(step.min(last)) / f64::from(last))
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    fn rng(step: u32) -> ChaCha8Rng {
        ChaCha8Rng::seed_from_u64(u64::from(step))
    }

    /// Returns a score that is highest with all parameters in the middle of their search space.
    fn learn(_: u32, parameters: &Parameters) -> Result<((), f64), BoxError> {
        let aim = Parameters([500.0, 500.0, 0.45, 0.5, 5000.0, 0.45, 0.45, 0.5, 0.5, 0.5]);
        let off = parameters.0.iter().zip(aim.0);
        let squares: f64 = off.map(|(a, b)| (a / b - 1.0) * (a / b - 1.0)).sum();
        Ok(((), 1.0 / (1.0 + squares)))
    }

    #[test]
    fn the_search_closes_in() {
        let mut search = Annealing::new(500);
        let scores: Vec<f64> = (0..500)
            .map(|number| search.map(number, rng, learn).unwrap().score)
            .collect();
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (first, last) = (mean(&scores[..50]), mean(&scores[450..]));
        assert!(last > first + 0.1, "{first} {last}");
        assert!((search.share(0) - 1.0).abs() < 1e-12);
        assert!(search.share(499) < 0.01);
    }

    #[test]
    fn a_map_is_the_same_whichever_was_asked_for_first() {
        let mut forth = Annealing::new(20);
        let mut at_once = Annealing::new(20);
        let last = at_once.map(19, rng, learn).unwrap();
        for number in 0..20 {
            let map = forth.map(number, rng, learn).unwrap();
            let same = at_once.map(number, rng, learn).unwrap();
            assert_eq!(map.parameters, same.parameters);
        }
        let again = forth.map(19, rng, learn).unwrap();
        assert_eq!(again.parameters, last.parameters);
    }

    #[test]
    fn the_better_of_the_last_two_goes_on() {
        let mut search = Annealing::new(1000);
        let scores = [0.3, 0.2, 0.1];
        let learn = |step: u32, _: &Parameters| Ok(((), scores[step as usize]));
        let maps: Vec<Parameters> = (0..3)
            .map(|number| search.map(number, rng, learn).unwrap().parameters)
            .collect();
        // Map 1 is better than map 2, though map 0 was better than both.
        let next = search.next(&mut rng(3));
        assert_eq!(next, maps[1].near(search.share(3), &mut rng(3)));
    }
}
