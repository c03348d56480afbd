use alloc::vec::Vec;

/// One column of a view.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Column {
    pub(super) values: Vec<f64>,
    /// The number of the view.
    pub(super) view: u32,
    /// The number of the column in it.
    pub(super) column: u32,
}

/// A k-d tree of columns: the first part of the list is a balanced tree (the middle of every range splits it, by one
/// coordinate after the other), the rest are columns that came since it was balanced.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ColumnTree {
    columns: Vec<Column>,
    balanced: usize,
}

impl ColumnTree {
    /// Adds a column. The tree is balanced anew when more than its square root have come, so that neither queries nor
    /// insertions take long: amortized O(√n · log n).
    pub(super) fn insert(&mut self, column: Column) {
        self.columns.push(column);
        let new = self.columns.len() - self.balanced;
        if new > 32 && new * new > self.columns.len() {
            balance(&mut self.columns, 0);
            self.balanced = self.columns.len();
        }
    }

    /// Visits the columns that differ from `middle` nowhere by more than `half_size`. O(√n + visited), for columns of few rows.
    pub(super) fn within(&self, middle: &[f64], half_size: f64, mut visit: impl FnMut(&Column)) {
        let near = |column: &Column| {
            let mut pairs = column.values.iter().zip(middle);
            pairs.all(|(a, b)| (a - b).abs() <= half_size)
        };
        // Ranges of the tree that are still to be searched, with the coordinate that splits them.
        let mut ranges = Vec::from([(0, self.balanced, 0)]);
        while let Some((from, to, axis)) = ranges.pop() {
            if from >= to {
                continue;
            }
            let split = usize::midpoint(from, to);
            let column = &self.columns[split];
            if near(column) {
                visit(column);
            }
            let value = column.values[axis];
            let next = (axis + 1) % column.values.len();
            if middle[axis] + half_size >= value {
                ranges.push((split + 1, to, next));
            }
            if middle[axis] - half_size <= value {
                ranges.push((from, split, next));
            }
        }
        for column in &self.columns[self.balanced..] {
            if near(column) {
                visit(column);
            }
        }
    }
}

/// Puts the middle of every range between the smaller and the larger.
fn balance(columns: &mut [Column], axis: usize) {
    if columns.len() < 2 {
        return;
    }
    let middle = columns.len() / 2;
    columns.select_nth_unstable_by(middle, |a, b| {
        let value = a.values[axis].total_cmp(&b.values[axis]);
        value.then((a.view, a.column).cmp(&(b.view, b.column)))
    });
    let next = (axis + 1) % columns[middle].values.len();
    let (smaller, rest) = columns.split_at_mut(middle);
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
            let mut tree = ColumnTree::default();
            for (view, point) in (0..).zip(&points) {
                tree.insert(Column { values: values(*point), view, column: 0 });
            }
            let mut found = Vec::new();
            tree.within(&values(middle), f64::from(half), |column| found.push(column.view));
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
