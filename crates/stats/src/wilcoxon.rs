//! Wilcoxon's signed-rank test of paired samples.

use super::moments::count;
use super::normal::ln_upper_tail;
use super::ranks::ranks;
use super::{Method, PValue, SampleError, error::check};

/// The outcome of a signed-rank test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wilcoxon {
    /// The sum of the ranks of positive differences.
    pub rank_sum: f64,
    /// The two-sided p-value.
    pub p: PValue,
    /// Method of the p-value: exact or asymptotic.
    pub method: Method,
}

/// Returns the result of Wilcoxon's signed-rank test of the differences `a[i] - b[i]`, two-sided.
/// Source: "Individual comparisons by ranking methods" (1945). Pairs without a difference are left
/// out.
///
/// [`Method::Auto`] is exact for at most 50 pairs without ties or zero differences, and otherwise
/// asymptotic with corrections for ties and continuity. O(n log n), and O(n³) if exact.
///
/// ```
/// use tolman_stats::{Method, wilcoxon};
///
/// // The same six mazes, before and after.
/// let before = [12.0, 15.0, 18.0, 21.0, 24.0, 27.0];
/// let after = [11.0, 13.0, 15.0, 17.0, 19.0, 21.0];
/// let test = wilcoxon(&before, &after, Method::Exact)?;
/// assert_eq!((test.rank_sum, test.p.to_string().as_str()), (21.0, "0.031"));
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If the samples are empty, unequally long or not finite, or all differences are zero. Also if an
/// exact test is asked for and the differences have ties or zeros.
pub fn wilcoxon(a: &[f64], b: &[f64], method: Method) -> Result<Wilcoxon, SampleError> {
    check(a, 1)?;
    check(b, 1)?;
    if a.len() != b.len() {
        return Err(SampleError::Unpaired {
            first: a.len(),
            second: b.len(),
        });
    }
    let mut differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    differences.retain(|difference| difference.abs() > 0.0);
    check(&differences, 0)?; // Two finite values may lie infinitely far apart.
    if differences.is_empty() {
        return Err(SampleError::NoDifference);
    }
    let sizes: Vec<f64> = differences
        .iter()
        .map(|difference| difference.abs())
        .collect();
    let ranked = ranks(&sizes);
    let positive = differences
        .iter()
        .zip(&ranked.ranks)
        .filter(|(difference, _)| **difference > 0.0);
    let rank_sum: f64 = positive.map(|(_, rank)| rank).sum();
    let n = count(&differences);
    let greater = rank_sum.max(n * (n + 1.0) / 2.0 - rank_sum);

    let uneven = ranked.ties > 0.0 || differences.len() < a.len();
    let method = method.of(uneven, differences.len() <= 50)?;
    let ln_tail = if method == Method::Exact {
        libm::log(exact_tail(differences.len(), greater))
    } else {
        let variance = (n * (n + 1.0) * (2.0 * n + 1.0) - ranked.ties / 2.0) / 24.0;
        let distance = greater - n * (n + 1.0) / 4.0;
        // At the very middle there is nothing to correct.
        let corrected = if distance > 0.0 { distance - 0.5 } else { 0.0 };
        ln_upper_tail(corrected / variance.sqrt())
    };
    Ok(Wilcoxon {
        rank_sum,
        p: PValue::two_sided(ln_tail),
        method,
    })
}

/// Returns the probability that the rank sum of `n` differences is `sum` or more under the null
/// hypothesis. It is the share of subsets of the ranks 1 to n whose sum is that large.
fn exact_tail(n: usize, sum: f64) -> f64 {
    // Shares rather than numbers of subsets, which would overflow beyond a thousand pairs.
    let mut share = vec![0.0_f64; n * (n + 1) / 2 + 1];
    share[0] = 1.0;
    let mut reach = 0;
    for rank in 1..=n {
        reach += rank;
        for sum in (0..=reach).rev() {
            let with = if sum >= rank { share[sum - rank] } else { 0.0 };
            share[sum] = 0.5 * (share[sum] + with);
        }
    }
    // Without ties the sum is a whole number.
    share[sum as usize..].iter().sum()
}
