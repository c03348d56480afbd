//! The skeleton of the floor: the middles of all passages, as thin lines.

use alloc::collections::BTreeSet;
use core::f64::consts::PI;

use super::raster::Raster;

/// Angle between the nearest walls from which on a point is in the middle of a passage. In a
/// straight one it is 180°, at a right-angled bend 135°; on a line into a right-angled corner 90°.
const AMID: f64 = 120.0 / 180.0 * PI;

/// Returns the points of a skeleton of `floor`. It joins what the floor joins, and leaves holes
/// where the floor has some.
///
/// Points are taken away from the walls inward, as long as the rest stays joined. First the middles
/// of passages stay (homotopic thinning with anchors); then of these, where they form steps, the
/// ends. O(points · log points).
pub(super) fn skeleton(raster: &Raster, floor: &[bool]) -> BTreeSet<usize> {
    let mut order: Vec<(u64, usize)> = (0..raster.len())
        .filter(|point| floor[*point])
        .map(|point| (raster.clearance(point).to_bits(), point))
        .collect();
    order.sort_unstable();
    let mut skeleton: BTreeSet<usize> = order.iter().map(|(_, point)| *point).collect();
    thin(raster, &mut skeleton, &order, |point, _| {
        raster.is_between(point, AMID)
    });
    order.retain(|(_, point)| skeleton.contains(point));
    thin(raster, &mut skeleton, &order, |_, around| {
        around.iter().filter(|is_there| **is_there).count() < 2
    });
    skeleton
}

/// Takes points away in this order until none can go, but those that `stays` names: a point, and
/// which of its neighbours are there.
fn thin(
    raster: &Raster,
    left: &mut BTreeSet<usize>,
    order: &[(u64, usize)],
    stays: impl Fn(usize, &[bool; 8]) -> bool,
) {
    // Points become free when others have gone, so one pass is not enough.
    loop {
        let before = left.len();
        for (_, point) in order {
            let around = raster.around(*point);
            let around = around.map(|next| next.is_some_and(|next| left.contains(&next)));
            if left.contains(point) && is_simple(&around) && !stays(*point, &around) {
                left.remove(point);
            }
        }
        if left.len() == before {
            return;
        }
    }
}

/// Returns whether a point can go without parting or joining anything: its neighbours hang
/// together without it, and it lies on a rim.
fn is_simple(around: &[bool; 8]) -> bool {
    let is_rim = [0, 2, 4, 6].iter().any(|side| !around[*side]);
    is_rim && parts(around) == 1
}

/// Returns the number of parts in which the neighbours of a point hang together without it, where
/// those at a corner touch those beside them.
fn parts(around: &[bool; 8]) -> usize {
    // Yokoi's number for 8-connected figures.
    let background = |side: usize| usize::from(!around[side % 8]);
    (0..8)
        .step_by(2)
        .map(|side| {
            background(side) - background(side) * background(side + 1) * background(side + 2)
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_neighbours() {
        let around = |there: &[usize]| core::array::from_fn(|side| there.contains(&side));
        assert_eq!(parts(&around(&[])), 0);
        assert_eq!(parts(&around(&[0])), 1);
        assert_eq!(parts(&around(&[0, 1, 2])), 1);
        assert_eq!(parts(&around(&[0, 4])), 2);
        assert_eq!(parts(&around(&[1, 3, 5])), 3);
        assert!(is_simple(&around(&[0, 1, 2])));
        assert!(!is_simple(&around(&[0, 4])));
    }
}
