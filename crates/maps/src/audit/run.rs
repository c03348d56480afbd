//! Finds runs: closures that come from one drive along a stretch driven before. They err together,
//! so they are one witness.

use alloc::vec::Vec;

use super::groups::Groups;

/// A closure's poses, and the way driven up to each, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ends {
    pub(super) poses: [u32; 2],
    pub(super) driven: [f64; 2],
}

/// Maximum difference between the ways driven at both ends on one stretch: a share, and m.
const UNEVEN: (f64, f64) = (0.3, 1.0);

/// Multiple of the spacing of closures within which they are of one run.
const SPACINGS: f64 = 3.0;

/// Way within which closures of a robot that laps are of one run, m. Two look-alike stretches are
/// not driven as laps, where each leads into the next.
const OF_LAPS: f64 = 6.0;

/// Returns the run of each closure, given by its lower and its higher pose, in the order of the
/// lower. Two closures are of one run if at most `gap` poses lie between them at both ends. They
/// are also of one run if about the same way was driven between them at both ends, at most `most` m
/// and three times the spacing of closures there; or if other closures link them like that. Where
/// the lower poses of such a run reach its higher ones, the robot drove laps, and `most` is 6 m.
/// Two closures for which `agree` is false do not err together, so they do not link a run.
///
/// # Complexity
/// O(n · m) for n closures of which at most m begin within `most` m.
pub(super) fn runs(
    ends: &[Ends],
    gap: u32,
    most: f64,
    agree: impl Fn(usize, usize) -> bool,
) -> Vec<u32> {
    let mut groups = Groups::new(ends.len());
    let mut along: Vec<(usize, usize, f64)> = Vec::new();
    let mut spacing = alloc::vec![f64::INFINITY; ends.len()];
    for (index, one) in ends.iter().enumerate() {
        for (other, next) in ends.iter().enumerate().skip(index + 1) {
            let poses = [0, 1].map(|end| next.poses[end].abs_diff(one.poses[end]));
            let [first, second] = [0, 1].map(|end| (next.driven[end] - one.driven[end]).abs());
            if poses[0] > gap && first > most {
                break;
            }
            let is_near = poses[0] <= gap && poses[1] <= gap;
            let way = first.max(second);
            let is_even = (first - second).abs() <= UNEVEN.0 * way + UNEVEN.1;
            let is_along = way <= most && is_even;
            if !(is_near || is_along) || !agree(index, other) {
                continue;
            }
            if is_near {
                groups.join(index, other);
            }
            // Closures of the same poses tell nothing of the spacing.
            if is_along && poses != [0, 0] {
                along.push((index, other, way));
                spacing[index] = spacing[index].min(way);
                spacing[other] = spacing[other].min(way);
            }
        }
    }
    along.retain(|(one, other, way)| *way <= SPACINGS * spacing[*one].min(spacing[*other]));
    let mut drives = groups.clone();
    for (one, other, _) in &along {
        drives.join(*one, *other);
    }
    // Highest lower pose and lowest higher pose of each drive.
    let mut reach = alloc::vec![[0, u32::MAX]; ends.len()];
    for (index, one) in ends.iter().enumerate() {
        let [low, high] = &mut reach[drives.find(index)];
        *low = (*low).max(one.poses[0]);
        *high = (*high).min(one.poses[1]);
    }
    for (one, other, way) in along {
        let [low, high] = reach[drives.find(one)];
        if low < high || way <= OF_LAPS {
            groups.join(one, other);
        }
    }
    groups.numbers()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(all: &[(u32, u32)]) -> Vec<Ends> {
        let ends = all.iter().map(|(first, second)| Ends {
            poses: [*first, *second],
            driven: [f64::from(*first), f64::from(*second)],
        });
        ends.collect()
    }

    #[test]
    fn a_run_is_linked_by_steps_of_three_either_way() {
        let ends = ends(&[(0, 100), (3, 97), (6, 100), (10, 100), (10, 300), (11, 303)]);
        assert_eq!(runs(&ends, 3, 0.0, |_, _| true), [0, 0, 0, 1, 2, 2]);
        let apart = |a: usize, b: usize| a.min(b) != 1;
        assert_eq!(runs(&ends, 3, 0.0, apart), [0, 0, 1, 2, 3, 3]);
    }

    #[test]
    fn a_drive_that_closes_now_and_then_is_one_run() {
        for spacing in [4, 5, 9, 15] {
            let drive: Vec<(u32, u32)> = (0..8)
                .map(|step| (step * spacing, 300 + step * spacing))
                .collect();
            assert_eq!(runs(&ends(&drive), 3, 20.0, |_, _| true), [0; 8]);
        }
        // Laps of a hundred poses.
        let laps: Vec<(u32, u32)> = (0..28).map(|step| (step * 7, 100 + step * 7)).collect();
        let apart: Vec<u32> = (0..28).collect();
        assert_eq!(runs(&ends(&laps), 3, 20.0, |_, _| true), apart);
        // Dense closures, and one far behind them: of its own, as is what crosses the stretch.
        let dense = ends(&[(0, 100), (1, 101), (2, 102), (17, 117), (18, 400)]);
        assert_eq!(runs(&dense, 3, 20.0, |_, _| true), [0, 0, 0, 1, 2]);
    }
}
