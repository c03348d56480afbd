//! Finds runs: closures that come from one drive along a stretch driven before. They err together,
//! so they are one witness.

use alloc::vec::Vec;

use super::groups::Groups;

/// Returns the run of each closure, given its lower and its higher pose, sorted. Two closures are
/// of one run if their lower poses lie at most `gap` apart, and their higher poses too. They are
/// also of one run if other closures link them like that. Two closures for which `agree` is false
/// do not err together, so they do not link a run.
///
/// # Complexity
/// O(n · m) for n closures of which at most m begin within `gap` poses.
pub(super) fn runs(
    ends: &[(u32, u32)],
    gap: u32,
    agree: impl Fn(usize, usize) -> bool,
) -> Vec<u32> {
    let mut groups = Groups::new(ends.len());
    for (index, (first, second)) in ends.iter().enumerate() {
        for (other, (next, end)) in ends.iter().enumerate().skip(index + 1) {
            if next - first > gap {
                break;
            }
            if end.abs_diff(*second) <= gap && agree(index, other) {
                groups.join(index, other);
            }
        }
    }
    groups.numbers()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_linked_by_steps_of_three_either_way() {
        let ends = [(0, 100), (3, 97), (6, 100), (10, 100), (10, 300), (11, 303)];
        assert_eq!(runs(&ends, 3, |_, _| true), [0, 0, 0, 1, 2, 2]);
        let apart = |a: usize, b: usize| a.min(b) != 1;
        assert_eq!(runs(&ends, 3, apart), [0, 0, 1, 2, 3, 3]);
    }
}
