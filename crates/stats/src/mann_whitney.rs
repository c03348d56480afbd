//! Mann and Whitney's U test of two independent samples.

use super::moments::count;
use super::normal::ln_upper_tail;
use super::ranks::{Ranks, ranks};
use super::{Method, PValue, SampleError, error::check};

/// The outcome of a Mann–Whitney test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MannWhitney {
    /// U of the first sample: pairs in which its value is the greater, ties counted half.
    pub u: f64,
    /// The two-sided p-value.
    pub p: PValue,
    /// Method of the p-value: exact or asymptotic.
    pub method: Method,
}

/// Returns the result of Mann and Whitney's U test, two-sided. Source: "On a test of whether one of
/// two random variables is stochastically larger than the other" (1947).
///
/// [`Method::Auto`] is exact if one sample has at most 8 values and there are no ties. Otherwise it
/// is asymptotic with corrections for ties and continuity, as in SciPy. O(N log N), and for the
/// exact distribution O(n² m²) with n the smaller sample.
///
/// ```
/// use tolman_stats::{Method, mann_whitney};
///
/// let test = mann_whitney(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0], Method::Auto)?;
/// assert_eq!(test.u, 0.0);
/// assert_eq!(test.p.to_string(), "0.10");
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If a sample is empty or not finite, or an exact test is asked for samples with ties.
pub fn mann_whitney(a: &[f64], b: &[f64], method: Method) -> Result<MannWhitney, SampleError> {
    let (u, ties) = u_statistic(a, b)?;
    let (n, m) = (count(a), count(b));
    let greater = u.max(n * m - u);
    let method = method.of(ties > 0.0, a.len().min(b.len()) <= 8)?;
    let p = if method == Method::Exact {
        PValue::two_sided(libm::log(exact_tail(a.len(), b.len(), greater)))
    } else {
        let total = n + m;
        let variance = n * m / 12.0 * (total + 1.0 - ties / (total * (total - 1.0)));
        if variance > 0.0 {
            PValue::two_sided(ln_upper_tail(
                (greater - n * m / 2.0 - 0.5) / variance.sqrt(),
            ))
        } else {
            PValue::ONE // All values are equal.
        }
    };
    Ok(MannWhitney { u, p, method })
}

/// Returns U of the first sample, as in [`MannWhitney`], and the ties among the values of both, as
/// in `Ranks`.
pub(super) fn u_statistic(a: &[f64], b: &[f64]) -> Result<(f64, f64), SampleError> {
    check(a, 1)?;
    check(b, 1)?;
    let Ranks { ranks, ties } = ranks(&[a, b].concat());
    let n = count(a);
    let u = ranks[..a.len()].iter().sum::<f64>() - n * (n + 1.0) / 2.0;
    Ok((u, ties))
}

/// Returns the probability that U is `u` or more under the hypothesis, for samples of `n` and `m`
/// values without ties.
///
/// N(u; n, m) arrangements have U = u. The greatest value is of one sample or of the other, so N(u;
/// n, m) = N(u; n, m − 1) + N(u − m; n − 1, m). These are sums only, so nothing cancels.
fn exact_tail(n: usize, m: usize, u: f64) -> f64 {
    let (n, m) = (n.min(m), n.max(m));
    let mut ways = vec![vec![0.0_f64; n * m + 1]; n + 1];
    for of_size in &mut ways {
        of_size[0] = 1.0;
    }
    for second in 1..=m {
        for first in 1..=n {
            let (smaller, same) = ways.split_at_mut(first);
            for u in second..=first * second {
                same[0][u] += smaller[first - 1][u - second];
            }
        }
    }
    let ways = &ways[n];
    // U is a whole number where there are no ties.
    ways[u as usize..].iter().sum::<f64>() / ways.iter().sum::<f64>()
}
