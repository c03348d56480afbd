use alloc::vec::Vec;

/// Feature by which a view is indexed: some of its columns, or a triangle of its edges.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Feature {
    /// Values; all features of a tree have the same number of values.
    pub(super) values: Vec<f64>,
    /// Number of the view.
    pub(super) view: u32,
    /// Number of the feature's column, or of its first column.
    pub(super) column: u32,
}

/// Maximum number of features outside the balanced trees.
const LOOSE: usize = 32;

/// A growing k-d tree of features. It consists of several balanced trees, one for each binary digit
/// of their number, and some loose features. Each balanced tree splits every range at its median,
/// by the coordinates in turn.
///
/// Source: J. L. Bentley, J. B. Saxe, "Decomposable searching problems I: Static-to-dynamic
/// transformation", the logarithmic method.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FeatureTree {
    features: Vec<Feature>,
}

impl FeatureTree {
    /// Adds a feature. Trees of one size become one, as digits are carried: amortized O(log² n).
    pub(super) fn insert(&mut self, feature: Feature) {
        self.features.push(feature);
        let count = self.features.len();
        let carried = 1 << count.trailing_zeros();
        if carried >= LOOSE {
            balance(&mut self.features[count - carried..], 0);
        }
    }

    /// Visits the features that differ from `middle` nowhere by more than `half_sizes`, value by
    /// value. O(n^(1 − 1/d) + visited) for features of d values.
    pub(super) fn within(
        &self,
        middle: &[f64],
        half_sizes: &[f64],
        mut visit: impl FnMut(&Feature),
    ) {
        let cube = Hypercube { middle, half_sizes };
        let mut rest = self.features.as_slice();
        while rest.len() >= LOOSE {
            let (tree, behind) = rest.split_at(1 << rest.len().ilog2());
            cube.search(tree, 0, &mut visit);
            rest = behind;
        }
        for feature in rest.iter().filter(|feature| cube.holds(feature)) {
            visit(feature);
        }
    }
}

/// "A hypercube around the input column."
struct Hypercube<'a> {
    middle: &'a [f64],
    half_sizes: &'a [f64],
}

impl Hypercube<'_> {
    fn holds(&self, feature: &Feature) -> bool {
        let pairs = feature.values.iter().zip(self.middle);
        let mut all = pairs.zip(self.half_sizes);
        all.all(|((a, b), half_size)| (a - b).abs() <= *half_size)
    }

    /// Visits the features of a balanced range that lie in the hypercube.
    fn search(&self, range: &[Feature], axis: usize, visit: &mut impl FnMut(&Feature)) {
        let middle = range.len() / 2;
        let Some(feature) = range.get(middle) else {
            return;
        };
        if self.holds(feature) {
            visit(feature);
        }
        let (value, next) = (feature.values[axis], (axis + 1) % feature.values.len());
        if self.middle[axis] - self.half_sizes[axis] <= value {
            self.search(&range[..middle], next, visit);
        }
        if self.middle[axis] + self.half_sizes[axis] >= value {
            self.search(&range[middle + 1..], next, visit);
        }
    }
}

/// Sorts every range so that its median lies in the middle, between the smaller and the larger
/// values.
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
