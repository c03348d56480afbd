//! What the judge knows of a map beside the map: where the robot truly was. No system sees it.

use alloc::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use tolman_geom::{Point, Vector};
use tolman_maze::Cell;
use tolman_robot::{MapPlace, MapView, VisitNaming};

use super::judgement::{MapJudgement, judge, stands_for};
use super::spots::Spots;
use super::true_graph::{PlaceRule, TrueGraph};
use super::whereabouts::{PlaceVisit, Squares, believed};
use crate::Outing;
use crate::course::Course;
use crate::gngslam::LaidOver;

/// True positions of a robot while it learns, noted after each action.
#[derive(Clone, Debug, Default)]
pub struct TrueVisits {
    /// Where the robot truly was whenever it came to a place.
    arrivals: Vec<Point>,
    /// Places that the system believed in after each action, with the true positions.
    beliefs: Vec<(u32, Point)>,
}

/// The judge's evidence of a learned map.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// The cell for which each place stands: place, column, row.
    stands_for: Vec<(u32, u16, u16)>,
    /// Share of the visits in the cell for which the place stands; `None` without visits.
    purity: Option<f64>,
    /// Cells that the robot drove through, in order: columns and rows.
    way: Vec<(u16, u16)>,
    /// Mean of the robot's true positions at its visits to each place, m. A visit may be aside.
    founded: Vec<(u32, [f64; 2])>,
    /// Mean of the positions at which the map has those visits, m; missing where it has not all.
    #[serde(default)]
    mapped: Vec<(u32, [f64; 2])>,
}

impl TrueVisits {
    /// Notes the result of an action, before which the robot was at `before`.
    pub fn note(&mut self, outing: &dyn Outing, before: Point) {
        let after = outing.path().last().map_or(before, |pose| pose.position);
        let place = || believed(&outing.belief(), || outing.map());
        self.add(
            outing.visit_naming(),
            outing.visit_count(),
            place,
            [before, after],
        );
    }

    /// Adds the result of an action that led the robot from one point to another. The system has
    /// named `count` visits since then; `place` is where it believes to be.
    pub(super) fn add(
        &mut self,
        naming: VisitNaming,
        count: usize,
        place: impl FnOnce() -> Option<u32>,
        [before, after]: [Point; 2],
    ) {
        match naming {
            // The path has them.
            VisitNaming::EachStep => {}
            VisitNaming::EachArrival => {
                while self.arrivals.len() + 1 < count {
                    self.arrivals.push(before);
                }
                if self.arrivals.len() < count {
                    self.arrivals.push(after);
                }
            }
            VisitNaming::Never => {
                self.beliefs.extend(place().map(|place| (place, after)));
            }
        }
    }

    /// Returns the evidence of the outing's map. `from` is the index of the first pose of its path
    /// that belongs to learning. O(visits · log places).
    #[must_use]
    pub fn evidence(self, outing: &dyn Outing, from: usize) -> Evidence {
        let path: Vec<Point> = outing.path().iter().map(|pose| pose.position).collect();
        let named = (outing.visit_naming(), outing.visits());
        self.of_map(
            &outing.map(),
            named,
            &path,
            from,
            (Squares::of(outing.course()), Spots::of(outing.course())),
        )
    }

    /// Returns the evidence of a map, whose system named visits so.
    pub(super) fn of_map(
        self,
        map: &MapView,
        (naming, visits): (VisitNaming, Vec<Option<u32>>),
        path: &[Point],
        from: usize,
        (squares, spots): (Squares, Spots),
    ) -> Evidence {
        let trail = visits.iter().copied().zip(map.trail.iter().copied());
        let trail: Vec<(u32, Point)> = trail.filter_map(|(place, at)| place.zip(at)).collect();
        let named = |points: Vec<Point>| {
            let named = visits.into_iter().zip(points);
            named.filter_map(|(place, at)| Some((place?, at))).collect()
        };
        let visits: Vec<(u32, Point)> = match naming {
            VisitNaming::Never => self.beliefs,
            VisitNaming::EachArrival => named(self.arrivals),
            VisitNaming::EachStep => named(path.to_vec()),
        };
        let cells: Vec<PlaceVisit> = (visits.iter())
            .map(|(place, at)| PlaceVisit {
                place: *place,
                cell: squares.cell_at(*at),
            })
            .collect();
        let (stands_for, purity) = stands_for(map, &cells, squares, &spots);
        let driven = path.iter().skip(from);
        let mut way: Vec<Cell> = driven.map(|at| squares.cell_at(*at)).collect();
        way.dedup();
        let founded = means(&visits);
        let has_all = trail.len() == visits.len();
        Evidence {
            stands_for: (stands_for.iter())
                .map(|(place, cell)| (*place, cell.x, cell.y))
                .collect(),
            purity,
            way: way.iter().map(|cell| (cell.x, cell.y)).collect(),
            founded,
            mapped: if has_all { means(&trail) } else { Vec::new() },
        }
    }
}

/// Returns the mean of the positions at each place, m.
fn means(visits: &[(u32, Point)]) -> Vec<(u32, [f64; 2])> {
    let mut sums: BTreeMap<u32, (Vector, f64)> = BTreeMap::new();
    for (place, at) in visits {
        let (sum, count) = sums.entry(*place).or_default();
        (*sum, *count) = (*sum + at.coords, *count + 1.0);
    }
    let means = sums.into_iter();
    let means = means.map(|(place, (sum, count))| (place, (sum / count).into()));
    means.collect()
}

/// Limit of the places' error in a right map of a free world, root mean square, m.
const MOST_ERROR: f64 = 0.2;

/// Distance within which a place or a way covers the floor of a free world, m.
const NEAR: f64 = 1.0;

/// Minimum share of the floor that a right map of a free world covers.
const LEAST_COVERED: f64 = 0.95;

impl Evidence {
    /// Returns the cell for which each place of the map stands.
    pub(super) fn cells(&self) -> BTreeMap<u32, Cell> {
        let cells = self.stands_for.iter();
        cells
            .map(|(place, x, y)| (*place, Cell::new(*x, *y)))
            .collect()
    }

    /// Returns the evidence of a map that was continued, as `later` has it.
    #[must_use]
    pub fn then(mut self, later: Self) -> Self {
        add_new(&mut self.stands_for, later.stands_for, |(place, ..)| *place);
        add_new(&mut self.founded, later.founded, |(place, _)| *place);
        add_new(&mut self.mapped, later.mapped, |(place, _)| *place);
        self.way.extend(later.way);
        self.purity = match (self.purity, later.purity) {
            (Some(one), Some(other)) => Some(one.min(other)),
            (one, other) => one.or(other),
        };
        self
    }

    /// Returns the judgement of a map of a maze, of which this is the evidence.
    ///
    /// O(cells driven · ways + links · ways).
    #[must_use]
    pub fn judge(&self, map: &MapView, truth: &TrueGraph) -> MapJudgement {
        let way = self.way.iter().map(|(x, y)| Cell::new(*x, *y));
        judge(map, &self.cells(), self.purity, truth, &truth.gone(way))
    }

    /// Returns why a map is wrong or unfinished as one of the course, in a sentence without a full
    /// stop; `None` if it is right.
    ///
    /// The [judgement](Self::judge) decides. In a world of free walls a map is also right if its
    /// places lie where they truly are, and its places, ways and rooms cover the floor: a chart
    /// needs no graph of passages. O(cells · points of the map).
    pub fn complaint(&self, map: &MapView, course: &Course, rule: PlaceRule) -> Option<String> {
        let complaint = self
            .judge(map, &TrueGraph::of_course(course, rule))
            .complaint()?;
        match self
            .complaint_of_chart(map, course)
            .filter(|_| course.is_free())
        {
            Some(of_chart) => of_chart,
            None => Some(complaint),
        }
    }

    /// Returns whether a map is a chart of a free world: its places lie where they truly are, and
    /// cover the floor.
    pub(super) fn is_chart(&self, map: &MapView, course: &Course) -> bool {
        course.is_free() && self.complaint_of_chart(map, course) == Some(None)
    }

    /// Returns why a map is no chart of a free world, `Some(None)` if it is one, and `None` if its
    /// places have no positions.
    fn complaint_of_chart(&self, map: &MapView, course: &Course) -> Option<Option<String>> {
        let points = |means: &[(u32, [f64; 2])]| -> BTreeMap<u32, Point> {
            let means = means.iter();
            means
                .map(|(place, at)| (*place, Point::from(*at)))
                .collect()
        };
        let (founded, mapped) = (points(&self.founded), points(&self.mapped));
        // A robot may be aside of a place that it visits. Where the map knows how far, that counts.
        let both = |place: &MapPlace| {
            let position = place.position?;
            let visited = mapped.get(&place.id).copied();
            let visited = visited.filter(|at| (at - position).norm() <= NEAR);
            Some((visited.unwrap_or(position), *founded.get(&place.id)?))
        };
        let (places, sites): (Vec<Point>, Vec<Point>) = map.places.iter().filter_map(both).unzip();
        let laid = LaidOver::of_places(places.into_iter(), &sites)?;
        if laid.error_m > MOST_ERROR {
            return Some(Some(format!(
                "its places lie {:.1} m from where they truly are",
                laid.error_m
            )));
        }
        let cells: Vec<Point> = course
            .starts()
            .map(|cell| course.cell_centre(cell))
            .collect();
        let gone = map.ways.iter().flatten().chain(&map.floor);
        let gone = gone.map(|at| laid.world_from_map.transform(*at));
        let points: Vec<Point> = founded.into_values().chain(gone).collect();
        let is_near = |cell: &&Point| points.iter().any(|at| (at - **cell).norm() <= NEAR);
        let covered = cells.iter().filter(is_near).count();
        let share = covered as f64 / cells.len().max(1) as f64;
        Some((share < LEAST_COVERED).then(|| {
            format!(
                "it has places and ways near {:.0} % of the floor alone",
                100.0 * share
            )
        }))
    }
}

/// Adds those that `all` has none of the same place of.
fn add_new<T>(all: &mut Vec<T>, later: Vec<T>, place: fn(&T) -> u32) {
    let known: BTreeSet<u32> = all.iter().map(place).collect();
    let new = later.into_iter();
    all.extend(new.filter(|one| !known.contains(&place(one))));
}

#[cfg(test)]
mod tests {
    use tolman_robot::Body;
    use tolman_sim::World;

    use super::*;

    /// Returns a hall of 2 × 2 m with a destination.
    fn hall() -> Course {
        let text = r#"{"format": "tolman-world", "version": 1,
            "polylines": [{"points": [[0, 0], [2, 0], [2, 2], [0, 2]], "closed": true}],
            "zones": [{"name": "destination",
                       "areas": [{"disc": {"centre": [1, 1], "radius": 0.2}}]}]}"#;
        let body = Body::Circle { radius: 0.1 };
        Course::in_free_world("hall", World::from_json(text).unwrap(), 0.5, &body).unwrap()
    }

    #[test]
    fn a_place_that_was_visited_in_passing_lies_where_the_map_has_it() {
        let course = hall();
        // The robot was 0.4 m aside of each place, to the west and to the east in turn.
        let places = [[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]];
        let aside =
            |[x, y]: [f64; 2], id: u32| [x + if id.is_multiple_of(2) { 0.4 } else { -0.4 }, y];
        let numbered = || (0..).zip(places);
        let map = MapView {
            places: numbered()
                .map(|(id, at)| MapPlace {
                    id,
                    position: Some(at.into()),
                    landmark: None,
                })
                .collect(),
            ..MapView::default()
        };
        let visits: Vec<(u32, [f64; 2])> = numbered().map(|(id, at)| (id, aside(at, id))).collect();
        let known = Evidence {
            founded: visits.clone(),
            mapped: visits,
            ..Evidence::default()
        };
        assert!(known.is_chart(&map, &course));
        let unknown = Evidence {
            mapped: Vec::new(),
            ..known.clone()
        };
        let complaint = unknown.complaint_of_chart(&map, &course).unwrap().unwrap();
        assert!(complaint.contains("0.4 m"), "{complaint}");
        // What the map has far from the place was no visit of it.
        let far = (known.mapped.iter()).map(|(id, [x, y])| (*id, [x + 2.0, *y]));
        let far = Evidence {
            mapped: far.collect(),
            ..known.clone()
        };
        assert!(!far.is_chart(&map, &course));
    }
}
