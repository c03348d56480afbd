//! Compares everything with SciPy's values, which `tests/data/stats.py` makes.

use serde::Deserialize;

use crate::*;

#[derive(Deserialize)]
struct Golden {
    pairs: Vec<Pair>,
    ln_upper_tail: Vec<[f64; 2]>,
    normal_quantile: Vec<[f64; 2]>,
    beta: Vec<[f64; 4]>,
    bca: Vec<Bca>,
    medians: Vec<Median>,
    proportions: Vec<Proportion>,
    corrections: Vec<Corrections>,
}

#[derive(Deserialize)]
struct Pair {
    a: Vec<f64>,
    b: Vec<f64>,
    mann_whitney_asymptotic: Test,
    mann_whitney_exact: Option<Test>,
    wilcoxon_rank_sum: f64,
    wilcoxon_asymptotic: f64,
    wilcoxon_exact: Option<f64>,
    a12: f64,
    mean: f64,
    sd: Option<f64>,
    quantiles: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
struct Test {
    u: f64,
    p: f64,
}

#[derive(Deserialize)]
struct Bca {
    data: Vec<f64>,
    estimate: f64,
    replicates: Vec<f64>,
    jackknife: Vec<f64>,
    low: f64,
    high: f64,
}

#[derive(Deserialize)]
struct Median {
    data: Vec<f64>,
    level: f64,
    interval: Option<[f64; 2]>,
}

#[derive(Deserialize)]
struct Proportion {
    successes: u64,
    trials: u64,
    level: f64,
    exact: [f64; 2],
    wilson: [f64; 2],
}

#[derive(Deserialize)]
struct Corrections {
    p: Vec<f64>,
    holm: Vec<f64>,
    bonferroni: Vec<f64>,
}

fn golden() -> Golden {
    serde_json::from_str(include_str!("../../tests/data/stats.json")).unwrap()
}

#[track_caller]
fn close(ours: f64, theirs: f64, tolerance: f64) {
    let scale = theirs.abs().max(1e-290);
    assert!(
        (ours - theirs).abs() <= tolerance * scale,
        "{ours} is not {theirs}"
    );
}

#[test]
fn mann_whitney_is_scipys() {
    for pair in golden().pairs {
        let test = mann_whitney(&pair.a, &pair.b, Method::Asymptotic).unwrap();
        close(test.u, pair.mann_whitney_asymptotic.u, 0.0);
        close(test.p.value(), pair.mann_whitney_asymptotic.p, 1e-11);
        match pair.mann_whitney_exact {
            Some(exact) => {
                let test = mann_whitney(&pair.a, &pair.b, Method::Exact).unwrap();
                close(test.u, exact.u, 0.0);
                close(test.p.value(), exact.p, 1e-11);
            }
            None => {
                let large_or_tied = mann_whitney(&pair.a, &pair.b, Method::Auto).unwrap();
                assert_eq!(large_or_tied.method, Method::Asymptotic);
            }
        }
    }
}

#[test]
fn wilcoxon_is_scipys() {
    for pair in golden().pairs {
        let n = pair.a.len().min(pair.b.len());
        let (a, b) = (&pair.a[..n], &pair.b[..n]);
        let test = wilcoxon(a, b, Method::Asymptotic).unwrap();
        close(test.rank_sum, pair.wilcoxon_rank_sum, 0.0);
        close(test.p.value(), pair.wilcoxon_asymptotic, 1e-11);
        if let Some(exact) = pair.wilcoxon_exact {
            close(
                wilcoxon(a, b, Method::Exact).unwrap().p.value(),
                exact,
                1e-11,
            );
        }
    }
}

#[test]
fn descriptions_are_numpys() {
    for pair in golden().pairs {
        close(a12(&pair.a, &pair.b).unwrap(), pair.a12, 1e-14);
        close(mean(&pair.a).unwrap(), pair.mean, 1e-13);
        match pair.sd {
            Some(sd) => close(standard_deviation(&pair.a).unwrap(), sd, 1e-13),
            None => assert!(standard_deviation(&pair.a).is_err()),
        }
        for [probability, value] in pair.quantiles {
            close(quantile(&pair.a, probability).unwrap(), value, 1e-14);
        }
    }
}

#[test]
fn distributions_are_scipys() {
    let golden = golden();
    for [z, ln_tail] in golden.ln_upper_tail {
        close(normal::ln_upper_tail(z), ln_tail, 1e-14);
    }
    for [probability, z] in golden.normal_quantile {
        // Around the median the value is small and its rounding is not.
        assert!((normal::quantile(probability) - z).abs() < 1e-13 * z.abs().max(1.0));
    }
    for [a, b, x, value] in golden.beta {
        close(beta::regularized_incomplete_beta(a, b, x), value, 1e-11);
    }
}

#[test]
fn success_intervals_are_scipys() {
    for case in golden().proportions {
        let exact = exact_binomial_interval(case.successes, case.trials, case.level).unwrap();
        let wilson = wilson_interval(case.successes, case.trials, case.level).unwrap();
        for (ours, theirs) in [(exact, case.exact), (wilson, case.wilson)] {
            assert!((ours.low - theirs[0]).abs() < 1e-12, "{ours:?} {theirs:?}");
            assert!((ours.high - theirs[1]).abs() < 1e-12, "{ours:?} {theirs:?}");
        }
    }
}

#[test]
fn intervals_of_medians_are_scipys() {
    for case in golden().medians {
        let ours = median_interval(&case.data, case.level);
        match case.interval {
            Some([low, high]) => {
                let ours = ours.unwrap();
                close(ours.low, low, 0.0);
                close(ours.high, high, 0.0);
            }
            None => assert!(
                matches!(ours, Err(SampleError::TooSmall { .. })),
                "{ours:?}"
            ),
        }
    }
    // 6 values hold the median in 1 - 2/64 of all samples.
    let needed = |level| median_interval(&[1.0], level).unwrap_err();
    let count = 1;
    assert_eq!(needed(0.95), SampleError::TooSmall { count, needed: 6 });
    assert_eq!(needed(0.75), SampleError::TooSmall { count, needed: 3 });
}

#[test]
fn bca_from_scipys_replicates_is_scipys() {
    for case in golden().bca {
        let ours =
            bootstrap::from_replicates(case.estimate, &case.replicates, &case.jackknife, 0.95)
                .unwrap();
        close(ours.low, case.low, 1e-12);
        close(ours.high, case.high, 1e-12);
    }
}

/// Our own resamples give SciPy's interval, up to the random numbers of both.
#[test]
fn bca_from_our_replicates_is_near_scipys() {
    use rand::SeedableRng;
    for case in golden().bca.iter().take(2) {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        let ours = bca_interval(&case.data, moments::of, 5000, 0.95, &mut rng).unwrap();
        let width = case.high - case.low;
        assert!((ours.low - case.low).abs() < 0.1 * width, "{ours:?}");
        assert!((ours.high - case.high).abs() < 0.1 * width, "{ours:?}");
    }
}

#[test]
fn corrections_follow_their_definitions() {
    for case in golden().corrections {
        let p: Vec<PValue> = case.p.iter().map(|p| PValue::from_ln(p.ln())).collect();
        for (ours, theirs) in [(holm(&p), &case.holm), (bonferroni(&p), &case.bonferroni)] {
            for (ours, theirs) in ours.iter().zip(theirs) {
                close(ours.value(), *theirs, 1e-11);
            }
        }
    }
}

/// Two samples of 2000 that do not overlap: p is far below the least double and still shown.
#[test]
fn deep_tails_do_not_underflow() {
    let a: Vec<f64> = (0..2000).map(f64::from).collect();
    let b: Vec<f64> = (3000..5000).map(f64::from).collect();
    let p = mann_whitney(&a, &b, Method::Auto).unwrap().p;
    close(p.value(), 0.0, 0.0);
    // ln 2 + scipy.stats.norm.logsf((2e6 - 0.5) / sqrt(4e6 / 12 * 4001))
    close(p.ln(), -1_503.853_526_955_58, 1e-13);
    assert_eq!(p.to_string(), "7.7e-654");
}

#[test]
fn p_values_are_shown_with_two_digits() {
    for (p, expect) in [
        (1.0, "1.00"),
        (0.0996, "0.10"),
        (0.0994, "0.099"),
        (0.05, "0.050"),
        (0.0042, "0.0042"),
        (0.00031, "3.1e-4"),
        (9.99e-7, "1.0e-6"),
    ] {
        assert_eq!(PValue::from_ln(f64::ln(p)).to_string(), expect);
    }
}

#[test]
fn samples_that_cannot_be_measured_are_refused() {
    let nan = [1.0, f64::NAN];
    assert_eq!(
        mean(&[]),
        Err(SampleError::TooSmall {
            count: 0,
            needed: 1
        })
    );
    assert_eq!(
        standard_deviation(&[1.0]),
        Err(SampleError::TooSmall {
            count: 1,
            needed: 2
        })
    );
    assert!(matches!(
        quantile(&nan, 0.5),
        Err(SampleError::NotFinite { index: 1, .. })
    ));
    assert!(matches!(
        a12(&[1.0], &nan),
        Err(SampleError::NotFinite { index: 1, .. })
    ));
    assert!(matches!(
        five_numbers(&nan),
        Err(SampleError::NotFinite { .. })
    ));
    assert!(matches!(
        quantile(&[1.0], 1.5),
        Err(SampleError::Probability { .. })
    ));
    assert!(matches!(
        mann_whitney(&[], &[1.0], Method::Auto),
        Err(SampleError::TooSmall { count: 0, .. })
    ));
    assert_eq!(
        mann_whitney(&[1.0], &[1.0], Method::Exact),
        Err(SampleError::Ties)
    );
    assert_eq!(
        wilcoxon(&[1.0], &[1.0, 2.0], Method::Auto),
        Err(SampleError::Unpaired {
            first: 1,
            second: 2
        })
    );
    assert_eq!(
        wilcoxon(&[1.0, 2.0], &[1.0, 2.0], Method::Auto),
        Err(SampleError::NoDifference)
    );
    assert!(matches!(
        wilcoxon(&[f64::MAX], &[f64::MIN], Method::Auto),
        Err(SampleError::NotFinite { .. })
    ));
    assert_eq!(
        exact_binomial_interval(3, 2, 0.95),
        Err(SampleError::Successes {
            successes: 3,
            trials: 2
        })
    );
    assert!(matches!(
        wilson_interval(0, 0, 0.95),
        Err(SampleError::TooSmall { .. })
    ));
}

#[test]
fn equal_samples_show_no_difference() {
    let test = mann_whitney(&[2.0; 30], &[2.0; 30], Method::Auto).unwrap();
    assert_eq!(test.p, PValue::ONE);
}
