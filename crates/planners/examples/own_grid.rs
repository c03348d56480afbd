//! A grid of your own: a floor plan on which a robot goes straight or diagonally.

use tolman_planners::{Graph, a_star};

/// `#` is a wall; a step costs 10, a diagonal one 14.
struct Floor(Vec<&'static [u8]>);

impl Floor {
    fn width(&self) -> u32 {
        self.0[0].len() as u32
    }

    fn place(&self, node: u32) -> (i64, i64) {
        (
            i64::from(node % self.width()),
            i64::from(node / self.width()),
        )
    }

    fn is_free(&self, (x, y): (i64, i64)) -> bool {
        let row = usize::try_from(y).ok().and_then(|y| self.0.get(y));
        let square = row.and_then(|row| row.get(usize::try_from(x).ok()?));
        square.is_some_and(|square| *square != b'#')
    }
}

impl Graph for Floor {
    fn node_count(&self) -> usize {
        self.0.len() * self.0[0].len()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let (x, y) = self.place(node);
        let steps = [-1, 0, 1].map(|dx| [-1, 0, 1].map(|dy| (dx, dy)));
        for (dx, dy) in steps.into_iter().flatten().filter(|step| *step != (0, 0)) {
            // It does not cut corners.
            let ends = [(x + dx, y + dy), (x + dx, y), (x, y + dy)];
            if ends.iter().all(|end| self.is_free(*end)) {
                let head = (y + dy) * i64::from(self.width()) + x + dx;
                visit(head as u32, if dx == 0 || dy == 0 { 10 } else { 14 });
            }
        }
    }
}

fn main() {
    let floor = Floor(vec![b"......", b".####.", b"......"]);
    let goal = floor.place(17);
    let never_too_high = |node| {
        let (x, y) = floor.place(node);
        10 * (goal.0 - x).abs().max((goal.1 - y).abs()) as u32
    };
    // From the north-west corner straight down, then along the wall.
    let found = a_star(&floor, 0, |node| node == 17, never_too_high);
    let found = found.map(|found| (found.cost, found.path.len()));
    assert_eq!(found, Some((70, 8)));
}
