//! Tests properties that hold for every sample.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::*;

/// Samples with many ties.
fn tied(max: usize) -> impl Strategy<Value = Vec<f64>> {
    vec((0..12_i32).prop_map(f64::from), 1..max)
}

fn finite(max: usize) -> impl Strategy<Value = Vec<f64>> {
    vec(-1e6..1e6, 1..max)
}

/// Returns the two-sided p-value by going through every way to choose the first sample.
fn mann_whitney_by_enumeration(a: &[f64], b: &[f64]) -> f64 {
    let pooled = [a, b].concat();
    let u_of = |chosen: u32| -> i32 {
        let is_first = |i: usize| chosen >> i & 1 == 1;
        let mut u = 0;
        for (i, x) in pooled.iter().enumerate() {
            for (j, y) in pooled.iter().enumerate() {
                u += i32::from(is_first(i) && !is_first(j) && x > y);
            }
        }
        u
    };
    let size = u32::try_from(a.len()).unwrap();
    let pairs = i32::try_from(a.len() * b.len()).unwrap();
    let observed = u_of((1 << size) - 1);
    let extreme = observed.max(pairs - observed);
    let choices: Vec<u32> = (0..1_u32 << pooled.len())
        .filter(|chosen| chosen.count_ones() == size)
        .collect();
    let tail = choices
        .iter()
        .filter(|&&chosen| u_of(chosen) >= extreme)
        .count();
    (2.0 * tail as f64 / choices.len() as f64).min(1.0)
}

/// Returns the two-sided p-value by going through every choice of signs.
fn wilcoxon_by_enumeration(differences: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = differences.iter().map(|d| d.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let rank = |d: f64| sizes.iter().filter(|size| **size <= d.abs()).count();
    let all: usize = differences.iter().map(|d| rank(*d)).sum();
    let observed: usize = differences
        .iter()
        .filter(|d| **d > 0.0)
        .map(|d| rank(*d))
        .sum();
    let extreme = observed.max(all - observed);
    let signs = 0..1_u32 << differences.len();
    let total = signs.len();
    let tail = signs.filter(|signs| {
        let chosen = (1..=differences.len()).filter(|rank| signs >> (rank - 1) & 1 == 1);
        chosen.sum::<usize>() >= extreme
    });
    (2.0 * tail.count() as f64 / total as f64).min(1.0)
}

proptest! {
    #[test]
    fn exact_mann_whitney_is_the_share_of_all_choices(a in finite(6), b in finite(6)) {
        if let Ok(test) = mann_whitney(&a, &b, Method::Exact) {
            prop_assert!((test.p.value() - mann_whitney_by_enumeration(&a, &b)).abs() < 1e-12);
        }
    }

    #[test]
    fn exact_wilcoxon_is_the_share_of_all_signs(differences in finite(9)) {
        let zeros = vec![0.0; differences.len()];
        if let Ok(test) = wilcoxon(&differences, &zeros, Method::Exact) {
            prop_assert!((test.p.value() - wilcoxon_by_enumeration(&differences)).abs() < 1e-12);
        }
    }

    #[test]
    fn tests_do_not_care_which_sample_is_first(a in tied(30), b in tied(30)) {
        let (ab, ba) = (
            mann_whitney(&a, &b, Method::Auto).unwrap(),
            mann_whitney(&b, &a, Method::Auto).unwrap(),
        );
        prop_assert!((ab.p.ln() - ba.p.ln()).abs() < 1e-9);
        let effects = a12(&a, &b).unwrap() + a12(&b, &a).unwrap();
        prop_assert!((effects - 1.0).abs() < 1e-12);
    }

    #[test]
    fn quantiles_grow_and_stay_within_the_sample(sample in finite(40), p in 0.0..1.0, q in 0.0..1.0) {
        let (low, high) = (f64::min(p, q), f64::max(p, q));
        let [least, low, high, most] = [0.0, low, high, 1.0].map(|p| quantile(&sample, p).unwrap());
        prop_assert!(least <= low && low <= high && high <= most);
    }

    #[test]
    fn the_five_numbers_are_in_order(sample in tied(40)) {
        let five = five_numbers(&sample).unwrap();
        prop_assert!(five.lower_whisker <= five.lower_quartile);
        prop_assert!(five.lower_quartile <= five.median && five.median <= five.upper_quartile);
        prop_assert!(five.upper_quartile <= five.upper_whisker);
    }

    #[test]
    fn success_intervals_hold_the_rate(trials in 1_u64..2000, share in 0.0..=1.0) {
        let successes = (share * trials as f64) as u64;
        let rate = successes as f64 / trials as f64;
        for interval in [
            exact_binomial_interval(successes, trials, 0.95).unwrap(),
            wilson_interval(successes, trials, 0.95).unwrap(),
        ] {
            prop_assert!(0.0 <= interval.low && interval.low <= rate + 1e-12);
            prop_assert!(rate - 1e-12 <= interval.high && interval.high <= 1.0);
        }
    }

    #[test]
    fn corrections_only_raise_and_holm_is_never_above_bonferroni(lns in vec(-1000.0..0.0, 1..12)) {
        let raw: Vec<PValue> = lns.into_iter().map(PValue::from_ln).collect();
        let (holm, bonferroni) = (holm(&raw), bonferroni(&raw));
        for ((raw, holm), bonferroni) in raw.iter().zip(&holm).zip(&bonferroni) {
            prop_assert!(raw <= holm && holm <= bonferroni && bonferroni.ln() <= 0.0);
        }
    }

    #[test]
    fn bca_intervals_lie_within_the_sample(sample in tied(30), seed in 0..u64::MAX) {
        use rand::SeedableRng;
        prop_assume!(sample.len() > 1);
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
        let interval = bca_interval(&sample, moments::of, 200, 0.95, &mut rng).unwrap();
        let (least, most) = (quantile(&sample, 0.0).unwrap(), quantile(&sample, 1.0).unwrap());
        prop_assert!(least <= interval.low && interval.low <= interval.high && interval.high <= most);
    }

    #[test]
    fn median_intervals_hold_the_median_and_grow_with_the_level(sample in tied(80)) {
        prop_assume!(sample.len() > 7);
        let median = quantile(&sample, 0.5).unwrap();
        let [narrow, wide] = [0.9, 0.99].map(|level| median_interval(&sample, level).unwrap());
        prop_assert!(narrow.contains(median));
        prop_assert!(wide.low <= narrow.low && narrow.high <= wide.high);
    }
}
