use alloc::collections::BTreeMap;

use thiserror::Error;
use tolman_control::{CorridorDetector, RingError, View};
use tolman_geom::{Heading, Point, Pose, Vector, path_length};
use tolman_maps::pose_graph::PoseEdgeKind;
use tolman_maps::scan_matching::{ScanMatching, ScanMatchingError, ScanStep};
use tolman_robot::{Guess, MapLink, MapPlace, MapView, Mapper, VisitNaming};

use super::place::ways_on;
use super::site_way::{middle_of, ring};
use super::{PlacesConfig, Site, SiteKind, SitePlace, SiteStep, SiteWay};

/// Reason why a map of places cannot be made, or refuses a step.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlacesError {
    /// The corridor width is invalid.
    #[error("the corridor detector cannot be built; correct its ring or its width")]
    Corridors(#[from] RingError),
    /// A scan cannot be matched.
    #[error(transparent)]
    Matching(#[from] ScanMatchingError),
}

/// A map of places. See [the module](super).
#[derive(Clone, Debug)]
pub struct PlacesMapper {
    config: PlacesConfig,
    matching: ScanMatching,
    detector: CorridorDetector,
    /// Number of keyframes that have been judged.
    judged: usize,
    /// Keyframes without a corridor since the last with one.
    open: Vec<usize>,
    /// Places in the order of the visits.
    visits: Vec<Visit>,
}

#[derive(Clone, Debug)]
struct Visit {
    kind: SiteKind,
    /// The keyframe halfway through the place.
    keyframe: usize,
    /// Middle of the free ground there, relative to the keyframe.
    middle: Point,
}

/// Radius within which ground counts for the middle of a place, in corridor widths, and the number
/// of iterations of the search for it.
const MIDDLE_WIDTHS: f64 = 1.0;
const CLIMBED: u32 = 8;
/// Squared error above which a closure is not believed.
const DOUBT: f64 = 16.0;

impl PlacesMapper {
    /// Returns an empty map.
    ///
    /// # Errors
    /// If the corridors' width is not a positive length.
    pub fn new(config: PlacesConfig) -> Result<Self, PlacesError> {
        let width = config.corridor_width;
        Ok(Self {
            matching: ScanMatching::new(config.matching.clone()),
            detector: CorridorDetector::new(ring(width), width)?,
            config,
            judged: 0,
            open: Vec::new(),
            visits: Vec::new(),
        })
    }

    /// Returns the scans matched, and the poses.
    #[must_use]
    pub const fn matching(&self) -> &ScanMatching {
        &self.matching
    }

    /// Returns the places in the order of the visits. A recognized place, or one whose pose is at
    /// an earlier place, has the number of the earlier one. O(places² + edges).
    #[must_use]
    pub fn sites(&self) -> Vec<SitePlace> {
        let graph = self.matching.graph();
        let mut same: BTreeMap<usize, usize> = BTreeMap::new();
        for (number, edge) in graph.edges().iter().enumerate() {
            let is_believed = graph.squared_error(number).is_some_and(|off| off < DOUBT);
            if edge.kind == PoseEdgeKind::Closure && is_believed {
                same.insert(edge.to as usize, edge.from as usize);
            }
        }
        let mut ids: BTreeMap<usize, u32> = BTreeMap::new();
        let middles: Vec<Point> = (self.visits.iter())
            .map(|visit| self.middle(visit))
            .collect();
        let mut sites: Vec<SitePlace> = Vec::new();
        for (number, visit) in (0..).zip(&self.visits) {
            let here = middles[sites.len()];
            let recognized = same.get(&visit.keyframe).and_then(|old| ids.get(old));
            let there = || Some(sites[self.lies_at(here, &middles[..sites.len()])?].id);
            let id = recognized.copied().or_else(there).unwrap_or(number);
            ids.insert(visit.keyframe, id);
            sites.push(SitePlace {
                kind: visit.kind,
                keyframe: visit.keyframe,
                id,
            });
        }
        sites
    }

    /// Returns the number of visits to places.
    #[must_use]
    pub const fn visit_count(&self) -> usize {
        self.visits.len()
    }

    /// Returns the place of visit number `visit`, counted from 0, as far as it was seen. The way by
    /// which the robot left is known after the next visit. O(keyframes).
    #[must_use]
    pub fn site(&self, visit: usize) -> Option<Site> {
        let this = self.visits.get(visit)?;
        let keyframe = this.keyframe;
        let axis = self.matching.axis_about(keyframe)?;
        let around = self
            .matching
            .surroundings(keyframe, self.detector.ring(), axis)?;
        let came_from = match visit {
            0 => self.pose(keyframe).heading.reversed(),
            _ => Heading::of(self.far_off(keyframe, (0..keyframe).rev())),
        };
        let came_by = Site::quarter(from_axis(axis, came_from));
        // A way that the robot took leads on, whatever the scans show.
        let mut open = ways_on(&around, self.config.corridor_width);
        open[came_by] = true;
        if let Some(next) = self.visits.get(visit + 1) {
            open[self.left_by(axis, keyframe, next.keyframe)] = true;
        }
        Some(Site {
            keyframe,
            middle: self.middle(this),
            kind: this.kind,
            open,
            around,
            came_by,
        })
    }

    /// Returns the position of a visited place's middle by the poses.
    fn middle(&self, visit: &Visit) -> Point {
        self.pose(visit.keyframe).transform(visit.middle)
    }

    /// Returns the number of the first of some places whose middle is nearer than half a corridor's
    /// width.
    fn lies_at(&self, here: Point, middles: &[Point]) -> Option<usize> {
        let near = self.config.corridor_width / 2.0;
        middles
            .iter()
            .position(|middle| (*middle - here).norm() < near)
    }

    /// Climbs from the robot's position to the middle of the free ground there.
    fn climb(&self, keyframe: usize) -> Point {
        let ring = self.detector.ring();
        let reach = MIDDLE_WIDTHS * self.config.corridor_width;
        let mut middle = self.pose(keyframe).position;
        for _ in 0..CLIMBED {
            let matching = &self.matching;
            let Some(seen) = matching.surroundings_of(keyframe, middle, ring, Heading::EAST) else {
                break;
            };
            middle += middle_of(&seen, reach);
        }
        middle
    }

    /// Returns the quarter by which the robot left one place for the next.
    fn left_by(&self, axis: Heading, from: usize, to: usize) -> usize {
        let left = Heading::of(self.far_off(from, from + 1..=to));
        Site::quarter(from_axis(axis, left))
    }

    /// Returns the way to the place of visit number `visit`; `None` for the first. O(keyframes on
    /// the way · keyframes).
    #[must_use]
    pub fn way_to(&self, visit: usize) -> Option<SiteWay> {
        let (from, to) = (self.site(visit.checked_sub(1)?)?, self.site(visit)?);
        let poses = &self.matching.graph().poses()[from.keyframe..=to.keyframe];
        let mut moved = Vector::zeros();
        let mut steps = Vec::new();
        for (keyframe, pair) in (from.keyframe + 1..).zip(poses.windows(2)) {
            let axis = self.matching.axis_about(keyframe)?;
            let step = pair[1].position - pair[0].position;
            moved += Heading::from_radians(-axis.radians()).rotate(step);
            let (ring, ahead) = (self.detector.ring(), pair[1].heading);
            steps.push(SiteStep {
                moved: pair[0].between(pair[1]),
                around: self.matching.surroundings(keyframe, ring, ahead)?,
            });
        }
        let axis = self.matching.axis_about(from.keyframe)?;
        Some(SiteWay {
            left_by: self.left_by(axis, from.keyframe, to.keyframe),
            moved: moved + self.to_middle(&to)? - self.to_middle(&from)?,
            length: self.way_between(from.keyframe, to.keyframe),
            steps,
            from,
            to,
        })
    }

    /// Returns the displacement from the robot's position in a place to the place's middle, along
    /// the building's axes, m.
    fn to_middle(&self, site: &Site) -> Option<Vector> {
        let axis = self.matching.axis_about(site.keyframe)?;
        let off = site.middle - self.pose(site.keyframe).position;
        Some(from_axis(axis, Heading::EAST).rotate(off))
    }

    /// Returns the displacement to the first of `others` that is farther off than a corridor is
    /// wide, m, or to the last of them.
    fn far_off(&self, from: usize, others: impl Iterator<Item = usize>) -> Vector {
        let here = self.pose(from).position;
        let mut off = Vector::zeros();
        for other in others {
            off = self.pose(other).position - here;
            if off.norm() > self.config.corridor_width {
                break;
            }
        }
        off
    }

    /// Identifies the place of visit number `visit` with an earlier one if the scans match. Returns
    /// whether they do.
    ///
    /// # Errors
    /// If a measurement does not fit.
    pub fn recognize(&mut self, visit: usize, before: usize) -> Result<bool, PlacesError> {
        let keyframes =
            [visit, before].map(|visit| self.visits.get(visit).map(|visit| visit.keyframe));
        match keyframes {
            [Some(here), Some(there)] => Ok(self.matching.recognize(here, there)?),
            _ => Ok(false),
        }
    }

    /// Judges the remaining keyframes; their poses stay the same.
    ///
    /// # Errors
    /// If a measurement does not fit.
    pub fn come_to_rest(&mut self) -> Result<(), PlacesError> {
        let all = self.matching.graph().poses().len();
        self.judge_to(all)?;
        self.leave()
    }

    /// Judges the remaining keyframes, and makes the poses agree. The map does not change
    /// afterwards.
    ///
    /// # Errors
    /// If a measurement does not fit.
    pub fn finish(&mut self) -> Result<(), PlacesError> {
        self.come_to_rest()?;
        Ok(self.matching.finish()?)
    }

    /// Judges the keyframes before `end` that are not judged yet.
    fn judge_to(&mut self, end: usize) -> Result<(), PlacesError> {
        while self.judged < end {
            let keyframe = self.judged;
            self.judged += 1;
            if self.is_corridor(keyframe) {
                self.leave()?;
                continue;
            }
            self.open.push(keyframe);
            if self.way_of_open() > self.config.most_way {
                self.leave()?;
            }
        }
        Ok(())
    }

    fn way_of_open(&self) -> f64 {
        let poses = self.open.iter().map(|keyframe| self.pose(*keyframe));
        path_length(&poses.collect::<Vec<Pose>>())
    }

    /// Returns the heading of the building's first axis; east before scans show it.
    fn axis(&self) -> Heading {
        self.matching.axis().unwrap_or(Heading::EAST)
    }

    fn is_corridor(&self, keyframe: usize) -> bool {
        let ring = self.detector.ring();
        let seen = self.matching.surroundings(keyframe, ring, self.axis());
        seen.is_some_and(|scan| {
            let view = View {
                scan: &scan,
                heading: Heading::EAST,
            };
            self.detector.detect(view).is_some()
        })
    }

    /// Ends the present place, if there is one.
    fn leave(&mut self) -> Result<(), PlacesError> {
        let is_place = self.way_of_open() >= self.config.least_way;
        let middle = self.open.get(self.open.len() / 2).copied();
        self.open.clear();
        match middle {
            Some(keyframe) if is_place => self.come_to(keyframe),
            _ => Ok(()),
        }
    }

    /// Adds a place, or recognizes it.
    fn come_to(&mut self, keyframe: usize) -> Result<(), PlacesError> {
        let ring = self.detector.ring();
        let seen = self.matching.surroundings(keyframe, ring, self.axis());
        let width = self.config.corridor_width;
        let here = self.climb(keyframe);
        let last = self.visits.last().map(|visit| self.middle(visit));
        if self.lies_at(here, last.as_slice()).is_some() {
            // The robot has not left the place.
            return Ok(());
        }
        let kind = seen.map_or(SiteKind::DeadEnd, |scan| SiteKind::of(&scan, width));
        for old in self.near(keyframe) {
            if self.matching.recognize(keyframe, old)? {
                break;
            }
        }
        self.visits.push(Visit {
            kind,
            keyframe,
            middle: self.pose(keyframe).inverse().transform(here),
        });
        Ok(())
    }

    /// Returns the places at which a keyframe may be, the nearest first.
    fn near(&self, keyframe: usize) -> Vec<usize> {
        let here = self.pose(keyframe).position;
        let reach = self.config.apart + self.matching.doubt(keyframe);
        let mut near: Vec<(f64, usize)> = (self.visits.iter())
            .map(|visit| visit.keyframe)
            .filter(|old| self.way_between(*old, keyframe) > self.config.least_absence)
            .map(|old| ((self.pose(old).position - here).norm(), old))
            .filter(|(off, _)| *off < reach)
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(self.config.most_compared);
        near.into_iter().map(|(_, old)| old).collect()
    }

    fn pose(&self, keyframe: usize) -> Pose {
        let pose = self.matching.graph().poses().get(keyframe);
        pose.copied().unwrap_or(Pose::IDENTITY)
    }

    fn way_between(&self, from: usize, to: usize) -> f64 {
        path_length(&self.matching.graph().poses()[from..=to])
    }
}

/// Returns a heading relative to an axis.
fn from_axis(axis: Heading, heading: Heading) -> Heading {
    heading.turned(-axis.radians())
}

impl Mapper for PlacesMapper {
    type Observation = ScanStep;
    type Error = PlacesError;

    fn observe(&mut self, step: &ScanStep) -> Result<(), PlacesError> {
        self.matching.observe(step)?;
        let known = self.matching.graph().poses().len();
        self.judge_to(known.saturating_sub(self.config.lag))
    }

    fn map(&self) -> MapView {
        let sites = self.sites();
        let firsts = (0..)
            .zip(&sites)
            .filter(|(number, site)| site.id == *number);
        let place = |(id, site): (u32, &SitePlace)| MapPlace {
            id,
            position: Some(self.pose(site.keyframe).position),
            landmark: None,
        };
        let steps = sites.windows(2).filter(|pair| pair[0].id != pair[1].id);
        let mut links: Vec<MapLink> = steps
            .flat_map(|pair| MapLink::both_ways(pair[0].id, pair[1].id))
            .collect();
        links.sort_unstable();
        links.dedup();
        MapView {
            places: firsts.map(place).collect(),
            links,
            ..MapView::default()
        }
    }

    fn belief(&self) -> Vec<Guess> {
        self.matching.belief()
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachArrival
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.sites().iter().map(|site| Some(site.id)).collect()
    }
}
