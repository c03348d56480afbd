//! Midranks, the common ground of the rank tests.

/// The ranks of values, and how much they are tied.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ranks {
    /// The rank of every value, from 1; equal values share the mean of their ranks.
    pub(super) ranks: Vec<f64>,
    /// The sum of t³ − t over groups of t equal values; 0 without ties.
    pub(super) ties: f64,
}

/// Ranks finite values. O(n log n).
pub(super) fn ranks(values: &[f64]) -> Ranks {
    let mut order: Vec<usize> = (0..values.len()).collect();
    // -0.0 and 0.0 are ranked as equals, so not by total_cmp.
    order.sort_by(|&a, &b| {
        values[a]
            .partial_cmp(&values[b])
            .unwrap_or(core::cmp::Ordering::Equal)
    });
    let mut ranks = vec![0.0; values.len()];
    let mut ties = 0.0;
    let mut before = 0;
    for group in order.chunk_by(|&a, &b| values[a] >= values[b]) {
        let size = group.len() as f64;
        let rank = before as f64 + (size + 1.0) / 2.0;
        for &place in group {
            ranks[place] = rank;
        }
        ties += size * size * size - size;
        before += group.len();
    }
    Ranks { ranks, ties }
}

#[cfg(test)]
mod tests {
    use super::ranks;

    #[test]
    fn equal_values_share_their_mean_rank() {
        let ranked = ranks(&[3.0, 1.0, 3.0, 0.0, 3.0, -0.0]);
        assert_eq!(ranked.ranks, [5.0, 3.0, 5.0, 1.5, 5.0, 1.5]);
        assert!((ranked.ties - (24.0 + 6.0)).abs() < 1e-12);
    }
}
