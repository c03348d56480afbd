use alloc::collections::BTreeMap;

use tolman_geom::Pose;
use tolman_maze::{Cell, Direction, Maze};
use tolman_robot::Landmark;

use super::fragments::{
    Quarters, TrueFragments, WayOut, along, bends, headings, landmark_at, quarters,
};
use crate::course::Course;
use tolman_systems::cpm::Approach;

/// Possible pose of a robot that is put down: in the middle of a cell inside a fragment, looking
/// along it.
#[derive(Clone, Debug)]
pub(super) struct Spot {
    cell: Cell,
    heading: Direction,
    /// Fragment and direction in which the robot walks.
    pub(super) way: WayOut,
    /// The place behind.
    behind: PlaceAtEnd,
    /// Bend of every cell between the places.
    bends: Vec<Quarters>,
    /// Number of the fragment's cells behind the spot.
    passed: usize,
    /// The place ahead.
    ahead: PlaceAtEnd,
}

/// Place at an end of a fragment, as seen along the fragment.
#[derive(Clone, Debug, PartialEq)]
struct PlaceAtEnd {
    /// Ways out of the place, relative to the direction of travel.
    open: Vec<Quarters>,
    landmark: Option<Landmark>,
}

/// Observations of an ideal observer along a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Looks {
    /// The observer sees the corridor's bends, and where the corridor begins.
    AtBends,
    /// The observer also sees the place ahead, and whether the one behind has ways to its sides.
    AtPlaces,
}

/// View from a spot up to where the end of the fragment comes into sight.
#[derive(Clone, Debug, PartialEq)]
struct View<'a> {
    /// The place behind; `None` if it is out of sight.
    behind: Option<PlaceAtEnd>,
    /// The bends of the cells in sight.
    bends: &'a [Quarters],
    /// The place ahead.
    ahead: PlaceAtEnd,
}

impl PlaceAtEnd {
    fn of(maze: &Maze, cell: Cell, heading: Direction) -> Self {
        let ways = maze.neighbours(cell);
        let mut open: Vec<Quarters> = ways.map(|(way, _)| quarters(heading, way)).collect();
        open.sort_unstable();
        Self {
            open,
            landmark: landmark_at(maze, cell),
        }
    }

    /// Returns the view of the place from the cell beside it: no landmark, and only ways to the
    /// sides. With [`Looks::AtBends`] no way is seen.
    fn beside(&self, looks: Looks) -> Self {
        let open = match looks {
            Looks::AtBends => Vec::new(),
            Looks::AtPlaces => {
                let open = self.open.iter().copied();
                open.filter(|quarters| quarters % 2 == 1).collect()
            }
        };
        Self {
            open,
            landmark: None,
        }
    }
}

impl Spot {
    /// Returns the spots of a maze, on the ways that count.
    pub(super) fn all(maze: &Maze, counts: impl Fn(&WayOut) -> bool) -> Vec<Self> {
        let fragments = TrueFragments::of(maze);
        let mut spots = Vec::new();
        for (from, out, way) in fragments.ways().filter(|(.., way)| counts(way)) {
            let Some((cells, came)) = along(maze, from, out) else {
                continue;
            };
            let headings = headings(maze, &cells);
            let bends = bends(&headings);
            // The places at both ends are not part of the fragment.
            let amid = cells.iter().zip(&headings).skip(1).enumerate();
            spots.extend(amid.map(|(passed, (cell, heading))| Self {
                cell: *cell,
                heading: *heading,
                way,
                behind: PlaceAtEnd::of(maze, from, out),
                bends: bends.clone(),
                passed,
                ahead: PlaceAtEnd::of(maze, way.to, came),
            }));
        }
        spots
    }

    pub(super) fn pose(&self, course: &Course) -> Pose {
        course.in_cell(self.cell, self.heading)
    }

    fn view(&self, approach: Approach, looks: Looks) -> View<'_> {
        let ahead = match looks {
            Looks::AtBends => self.ahead.beside(looks),
            Looks::AtPlaces => self.ahead.clone(),
        };
        match approach {
            // Walls are seen as far as a corridor is wide: up to the middle of the cell behind.
            Approach::StraightOn => View {
                behind: (self.passed == 0).then(|| self.behind.beside(looks)),
                bends: self
                    .bends
                    .get(self.passed.saturating_sub(1)..)
                    .unwrap_or_default(),
                ahead,
            },
            Approach::ToAndFro => View {
                behind: Some(self.behind.clone()),
                bends: &self.bends,
                ahead,
            },
        }
    }
}

/// Returns the probability, 0 to 1, that an ideal observer guesses maze, fragment and direction
/// correctly. The robot is at a spot of the maze `here`.
///
/// It knows the true mazes, and that each maze, and each spot of it, is equally likely. It
/// recognizes all it looks at without error, from the cell behind on. The robot sees only a part of
/// that cell and of the places. So on average no robot knows more than this observer.
pub(super) fn knowable(
    mazes: &[Vec<Spot>],
    here: usize,
    spot: &Spot,
    approach: Approach,
    looks: Looks,
) -> f64 {
    let view = spot.view(approach, looks);
    let mut alike = BTreeMap::<(usize, u32, bool), u64>::new();
    for (maze, spots) in mazes.iter().enumerate() {
        for other in spots
            .iter()
            .filter(|other| other.view(approach, looks) == view)
        {
            *alike.entry(key(maze, &other.way)).or_default() += 1;
        }
    }
    let truth = key(here, &spot.way);
    let spots = |maze: usize| mazes.get(maze).map_or(1, |spots| spots.len() as u64);
    let count = alike.get(&truth).copied().unwrap_or(0);
    // Compared without a division, so that equals are equal.
    let against = |maze: usize, others: u64| (others * spots(here)).cmp(&(count * spots(maze)));
    let mut equals = 0_u32;
    for ((maze, ..), others) in alike {
        match against(maze, others) {
            core::cmp::Ordering::Greater => return 0.0,
            core::cmp::Ordering::Equal => equals += 1,
            core::cmp::Ordering::Less => {}
        }
    }
    1.0 / f64::from(equals.max(1))
}

const fn key(maze: usize, way: &WayOut) -> (usize, u32, bool) {
    (maze, way.fragment, way.is_forward)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a corridor from start to goal with `between` cells between them.
    fn straight(between: usize) -> Vec<Spot> {
        let wall = "o---".repeat(between + 2);
        let cells = "    ".repeat(between);
        let text = format!("start = 0 0 east\n\n{wall}o\n| S  {cells} G |\n{wall}o\n");
        spots(&text)
    }

    fn spots(text: &str) -> Vec<Spot> {
        Spot::all(&tolman_maze::read(text).unwrap().maze, |_| true)
    }

    fn shares(mazes: &[Vec<Spot>], here: usize, approach: Approach) -> Vec<f64> {
        let each = mazes[here].iter();
        each.map(|spot| knowable(mazes, here, spot, approach, Looks::AtBends))
            .collect()
    }

    fn check(mazes: &[Vec<Spot>], here: usize, approach: Approach, expected: &[f64]) {
        let found = shares(mazes, here, approach);
        let is_equal = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(expected).all(is_equal), "{found:?}");
    }

    #[test]
    fn a_symmetrical_corridor_is_known_by_what_is_behind() {
        let mazes = [straight(2)];
        check(&mazes, 0, Approach::StraightOn, &[0.5; 4]);
        check(&mazes, 0, Approach::ToAndFro, &[1.0; 4]);
    }

    #[test]
    fn a_bend_tells_which_way() {
        let bend = "\
start = 0 0 east

o---o---o---o
|       | G |
o---o---o   o
| S         |
o---o---o---o
";
        check(&[spots(bend)], 0, Approach::StraightOn, &[1.0; 4]);
    }

    #[test]
    fn a_way_to_the_side_of_the_place_ahead_tells_which_it_is() {
        let sides = "\
start = 0 0 east

o---o---o---o---o---o
|   |   |   |   |   |
o---o---o---o   o---o
| S               G |
o---o---o---o---o---o
";
        let mazes = [spots(sides)];
        check(&mazes, 0, Approach::StraightOn, &[0.5; 4]);
        let known = |spot| knowable(&mazes, 0, spot, Approach::StraightOn, Looks::AtPlaces);
        assert!(mazes[0].iter().all(|spot| known(spot) > 0.99));
    }

    /// Checks that looking at places too does not reduce the hits, over all spots of each maze.
    #[test]
    fn places_tell_no_less_than_bends() {
        let texts = [
            include_str!("../../mazes/cpm-1.maze"),
            include_str!("../../mazes/cpm-2.maze"),
            include_str!("../../mazes/cpm-3.maze"),
        ];
        let mazes = texts.map(spots);
        for here in 0..mazes.len() {
            let mean = |looks| {
                let each = mazes[here].iter();
                let known =
                    each.map(|spot| knowable(&mazes, here, spot, Approach::StraightOn, looks));
                known.sum::<f64>() / mazes[here].len() as f64
            };
            let (bends, places) = (mean(Looks::AtBends), mean(Looks::AtPlaces));
            assert!(places >= bends, "maze {here}: {places} and {bends}");
            assert!((0.5..0.99).contains(&bends), "maze {here}: {bends}");
        }
    }

    #[test]
    fn of_two_mazes_the_smaller_one_is_likelier_where_they_look_alike() {
        let mazes = [straight(2), straight(3)];
        check(&mazes, 0, Approach::StraightOn, &[0.5; 4]);
        // The last cell but the goal looks as in the smaller one.
        let of_larger = [0.5, 0.5, 0.0, 0.5, 0.5, 0.0];
        check(&mazes, 1, Approach::StraightOn, &of_larger);
    }
}
