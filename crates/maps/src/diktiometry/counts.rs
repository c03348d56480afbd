/// Number of times that something was expected, and how often it was met. Both fade, since the
/// world may change: each expectation makes earlier ones weigh less by a factor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    expected: f64,
    met: f64,
}

/// Outcome of an expectation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Expected {
    Met,
    InVain,
}

impl Counts {
    /// Expected and met once.
    pub(super) const ONCE: Self = Self {
        expected: 1.0,
        met: 1.0,
    };

    /// Returns the weighted number of expectations.
    #[must_use]
    pub const fn expected(&self) -> f64 {
        self.expected
    }

    /// Returns the weighted number of expectations that were met.
    #[must_use]
    pub const fn met(&self) -> f64 {
        self.met
    }

    /// Counts one more expectation. Earlier ones weigh less by the factor `fading`, in (0, 1].
    pub(super) fn expect(&mut self, outcome: Expected, fading: f64) {
        let met = match outcome {
            Expected::Met => 1.0,
            Expected::InVain => 0.0,
        };
        self.expected = self.expected * fading + 1.0;
        self.met = self.met * fading + met;
    }

    /// Adds the counts of another thing that turned out to be the same.
    pub(super) fn join(&mut self, other: Self) {
        self.expected += other.expected;
        self.met += other.met;
    }

    /// Returns the greatest plausible share of expectations that are met: the upper end of Wilson's
    /// score interval at 99 %. 1 for something never expected.
    ///
    /// Fading expectations are worth n_eff = (Σw)² / Σw² that do not fade (Kish). From the sum
    /// alone, E = Σw, that is n_eff = E (1 + f) / (2 − (1 − f) E). Without fading it is E. In the
    /// long run it is (1 + f) / (1 − f), about 2 E.
    pub(super) fn rate_at_most(&self, fading: f64) -> f64 {
        if self.expected <= 0.0 {
            return 1.0;
        }
        // Counts that were joined may be more than fading lets one have.
        let weight = (2.0 - (1.0 - fading) * self.expected).max(1.0);
        let trials = self.expected * (1.0 + fading) / weight;
        wilson_upper(self.met / self.expected, trials)
    }
}

/// Returns the upper end of Wilson's score interval at 99 % for a `rate` seen in `trials` trials.
pub(super) fn wilson_upper(rate: f64, trials: f64) -> f64 {
    /// The 99.5th percentile of the standard normal.
    const Z: f64 = 2.575_829_303_548_901;
    let square = Z * Z / trials;
    let spread = libm::sqrt(rate * (1.0 - rate) / trials + square / (4.0 * trials));
    (rate + 0.5 * square + Z * spread) / (1.0 + square)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::diktiometry::{Config, Transients};

    fn transients() -> Transients {
        Config::new(Config::compass_actions(), 1.0).transients
    }

    fn is_transient(counts: &Counts) -> bool {
        counts.rate_at_most(transients().fading) < transients().rate
    }

    /// Returns the number of vain expectations after which something met `met` times is a
    /// transient.
    fn vain_after(met: u32) -> u32 {
        let mut counts = Counts::default();
        for _ in 0..met {
            counts.expect(Expected::Met, transients().fading);
            assert!(!is_transient(&counts));
        }
        let mut vain = 0;
        while !is_transient(&counts) && vain < 1000 {
            counts.expect(Expected::InVain, transients().fading);
            vain += 1;
        }
        vain
    }

    #[test]
    fn wilson_agrees_with_the_textbook() {
        // 0 of n: z² / (n + z²).
        assert!((wilson_upper(0.0, 20.0) - 6.634_896_6 / 26.634_896_6).abs() < 1e-8);
        // n / 2 of n: 1/2 + z / (2 √(n + z²)).
        assert!((wilson_upper(0.5, 10.0) - 0.815_774_5).abs() < 1e-7);
    }

    #[test]
    fn expectations_that_do_not_fade_all_count() {
        let mut counts = Counts::default();
        for number in 0..50 {
            let outcome = if number % 5 == 0 {
                Expected::Met
            } else {
                Expected::InVain
            };
            counts.expect(outcome, 1.0);
        }
        assert!((counts.rate_at_most(1.0) - wilson_upper(0.2, 50.0)).abs() < 1e-12);
    }

    #[test]
    fn fading_expectations_are_as_good_as_kish_says() {
        let fading = 0.9_f64;
        let mut counts = Counts::default();
        for trials in 1..60 {
            counts.expect(Expected::InVain, fading);
            let weights = (0..trials).map(|age| fading.powi(age));
            let (sum, squares) = weights.fold((0.0, 0.0), |(sum, squares), weight| {
                (sum + weight, squares + weight * weight)
            });
            let kish = wilson_upper(0.0, sum * sum / squares);
            assert!(
                (counts.rate_at_most(fading) - kish).abs() < 1e-9,
                "{trials}"
            );
        }
    }

    #[test]
    fn what_is_gone_is_a_transient_after_twenty_to_forty_vain_expectations() {
        for met in [1, 2, 10, 100, 10_000] {
            let vain = vain_after(met);
            assert!((20..=40).contains(&vain), "{vain} after {met}");
        }
    }

    #[test]
    fn what_works_half_the_time_is_never_a_transient() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut counts = Counts::ONCE;
        for _ in 0..300_000 {
            let met = rng.random_range(0_u32..2) == 0;
            let outcome = if met { Expected::Met } else { Expected::InVain };
            counts.expect(outcome, transients().fading);
            assert!(!is_transient(&counts));
        }
    }
}
