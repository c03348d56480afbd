use alloc::vec::Vec;

/// What a view is indexed by: one of its columns, or a triangle of its edges.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Feature {
    /// As many in all features of a tree.
    pub(super) values: Vec<f64>,
    /// The number of the view.
    pub(super) view: u32,
    /// The number of the column it is, or begins at.
    pub(super) column: u32,
}

/// A k-d tree of features: the first part of the list is a balanced tree (the middle of every range splits it, by one
/// coordinate after the other), the rest are features that came since it was balanced.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FeatureTree {
    features: Vec<Feature>,
    balanced: usize,
}

impl FeatureTree {
    /// Adds a feature. The tree is balanced anew when more than its square root have come, so that neither queries nor
    /// insertions take long: amortized O(√n · log n).
    pub(super) fn insert(&mut self, feature: Feature) {
        self.features.push(feature);
        let new = self.features.len() - self.balanced;
        if new > 32 && new * new > self.features.len() {
            balance(&mut self.features, 0);
            self.balanced = self.features.len();
        }
    }

    /// Visits the features that differ from `middle` nowhere by more than `half_sizes`, value by value. O(√n + visited), for
    /// features of few values.
    pub(super) fn within(
        &self,
        middle: &[f64],
        half_sizes: &[f64],
        mut visit: impl FnMut(&Feature),
    ) {
        let near = |feature: &Feature| {
            let pairs = feature.values.iter().zip(middle);
            let mut all = pairs.zip(half_sizes);
            all.all(|((a, b), half_size)| (a - b).abs() <= *half_size)
        };
        // Ranges of the tree that are still to be searched, with the coordinate that splits them.
        let mut ranges = Vec::from([(0, self.balanced, 0)]);
        while let Some((from, to, axis)) = ranges.pop() {
            if from >= to {
                continue;
            }
            let split = usize::midpoint(from, to);
            let feature = &self.features[split];
            if near(feature) {
                visit(feature);
            }
            let value = feature.values[axis];
            let next = (axis + 1) % feature.values.len();
            if middle[axis] + half_sizes[axis] >= value {
                ranges.push((split + 1, to, next));
            }
            if middle[axis] - half_sizes[axis] <= value {
                ranges.push((from, split, next));
            }
        }
        for feature in &self.features[self.balanced..] {
            if near(feature) {
                visit(feature);
            }
        }
    }
}

/// Puts the middle of every range between the smaller and the larger.
fn balance(features: &mut [Feature], axis: usize) {
    if features.len() < 2 {
        return;
    }
    let middle = features.len() / 2;
    features.select_nth_unstable_by(middle, |a, b| {
        let value = a.values[axis].total_cmp(&b.values[axis]);
        value.then((a.view, a.column).cmp(&(b.view, b.column)))
    });
    let next = (axis + 1) % features[middle].values.len();
    let (smaller, rest) = features.split_at_mut(middle);
    balance(smaller, next);
    balance(&mut rest[1..], next);
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn it_finds_what_a_list_finds(
            points in prop::collection::vec((0_i8..6, 0_i8..6), 0..200),
            middle in (0_i8..6, 0_i8..6),
            half in 0_i8..4,
        ) {
            let values = |point: (i8, i8)| vec![f64::from(point.0), f64::from(point.1)];
            let mut tree = FeatureTree::default();
            for (view, point) in (0..).zip(&points) {
                tree.insert(Feature { values: values(*point), view, column: 0 });
            }
            let mut found = Vec::new();
            tree.within(&values(middle), &[f64::from(half); 2], |feature| found.push(feature.view));
            found.sort_unstable();
            let near = |point: &(i8, i8)| {
                (point.0 - middle.0).abs() <= half && (point.1 - middle.1).abs() <= half
            };
            let all = (0..).zip(&points).filter(|(_, point)| near(point));
            let expected: Vec<u32> = all.map(|(view, _)| view).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
