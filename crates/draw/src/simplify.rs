//! Simplifies lines without visible change.

/// Maximum distance between a line and its simplification, user units: less than the eye sees.
const BESIDE: f64 = 0.3;

/// Returns the corners of a line that matter; the ends are kept. No position left out lies farther
/// than [`BESIDE`] from the line through those that are kept.
///
/// Douglas and Peucker, "Algorithms for the reduction of the number of points required to represent
/// a digitized line or its caricature", 1973. O(n log n) for most lines, O(n²) at worst.
pub(super) fn simplified(line: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut kept = vec![false; line.len()];
    if let (Some(first), Some(last)) = (kept.first_mut(), line.len().checked_sub(1)) {
        *first = true;
        kept[last] = true;
    }
    let mut open = vec![(0, line.len().saturating_sub(1))];
    while let Some((from, to)) = open.pop() {
        let between = line.iter().enumerate().take(to).skip(from + 1);
        let distances = between.map(|(i, at)| (i, distance(*at, line[from], line[to])));
        let farthest = distances.max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((i, distance)) = farthest
            && distance > BESIDE
        {
            kept[i] = true;
            open.extend([(from, i), (i, to)]);
        }
    }
    let pairs = line.iter().zip(kept);
    pairs.filter(|(_, kept)| *kept).map(|(at, _)| *at).collect()
}

/// Returns the distance of a point from the segment between two others.
fn distance(point: (f64, f64), from: (f64, f64), to: (f64, f64)) -> f64 {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = dx * dx + dy * dy;
    let along = ((point.0 - from.0) * dx + (point.1 - from.1) * dy) / length;
    let along = if length > 0.0 {
        along.clamp(0.0, 1.0)
    } else {
        0.0
    };
    libm::hypot(point.0 - from.0 - along * dx, point.1 - from.1 - along * dy)
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn straight_stretches_lose_what_lies_between() {
        let line = [
            (0.0, 0.0),
            (1.0, 0.1),
            (2.0, -0.1),
            (3.0, 0.0),
            (3.0, 5.0),
            (3.0, 1.0),
        ];
        assert_eq!(
            simplified(&line),
            [(0.0, 0.0), (3.0, 0.0), (3.0, 5.0), (3.0, 1.0)]
        );
        assert_eq!(simplified(&[]), []);
        assert_eq!(simplified(&[(1.0, 2.0)]), [(1.0, 2.0)]);
        assert_eq!(simplified(&[(1.0, 2.0); 5]), [(1.0, 2.0); 2]);
    }

    proptest! {
        #[test]
        fn nothing_is_far_from_what_is_kept(line in vec((-20.0..20.0, -20.0..20.0), 2..60)) {
            let kept = simplified(&line);
            prop_assert_eq!((kept.first(), kept.last()), (line.first(), line.last()));
            for at in &line {
                let near = kept.windows(2).map(|ends| distance(*at, ends[0], ends[1]));
                prop_assert!(near.fold(f64::INFINITY, f64::min) <= BESIDE + 1e-9);
            }
        }
    }
}
