use alloc::collections::BTreeMap;

use thiserror::Error;
use tolman_control::{CorridorDetector, RingError, View};
use tolman_geom::{Heading, Pose};
use tolman_maps::pose_graph::PoseEdgeKind;
use tolman_maps::scan_matching::{ScanMatching, ScanMatchingError, ScanStep};
use tolman_robot::{Guess, MapLink, MapPlace, MapView, Mapper, Ring};

use super::{PlacesConfig, SiteKind, SitePlace};

/// Why a map of places cannot be made, or refuses a step.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlacesError {
    /// The corridors are none.
    #[error("the corridors cannot be told from junctions")]
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
    /// Keyframes that have been judged.
    judged: usize,
    /// Keyframes without a corridor since the last with one.
    open: Vec<usize>,
    /// The places in the order that they were come to: what each is, and the keyframe in its middle.
    visits: Vec<(SiteKind, usize)>,
}

/// The ring that the detector reads: the paper's 72 beams.
const BEAMS: u32 = 72;
/// A closure of a greater squared error is not believed.
const DOUBT: f64 = 16.0;
/// Their reach, in corridor widths.
const REACH_WIDTHS: f64 = 4.0;

impl PlacesMapper {
    /// Returns a map of nothing.
    ///
    /// # Errors
    /// If the corridors' width is no length.
    pub fn new(config: PlacesConfig) -> Result<Self, PlacesError> {
        let width = config.corridor_width;
        let ring = Ring::full(BEAMS, REACH_WIDTHS * width);
        Ok(Self {
            matching: ScanMatching::new(config.matching.clone()),
            detector: CorridorDetector::new(ring, width)?,
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

    /// Returns the places in the order that they were come to; one that was recognized stands again, with the number of the first.
    /// O(places · log places + edges).
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
        let visits = (0..).zip(&self.visits);
        let site = visits.map(|(number, (kind, keyframe))| {
            let known = same.get(keyframe).and_then(|old| ids.get(old));
            let id = known.copied().unwrap_or(number);
            ids.insert(*keyframe, id);
            SitePlace {
                kind: *kind,
                keyframe: *keyframe,
                id,
            }
        });
        site.collect()
    }

    /// Judges what is left, and makes the poses agree; then the map does not change any more.
    ///
    /// # Errors
    /// If a measurement does not fit.
    pub fn finish(&mut self) -> Result<(), PlacesError> {
        let all = self.matching.graph().poses().len();
        self.judge_to(all)?;
        self.leave()?;
        Ok(self.matching.finish()?)
    }

    /// Judges the keyframes before `end` that have not been.
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
        let poses = self.matching.graph().poses();
        let pairs = self.open.windows(2);
        let steps = pairs.map(|pair| poses[pair[1]].position - poses[pair[0]].position);
        steps.map(|step| step.norm()).sum()
    }

    /// The axes of the building, as a compass has them.
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

    /// Ends the place that the robot was at, if it was at one.
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
        let kind = seen.map_or(SiteKind::DeadEnd, |scan| SiteKind::of(&scan, width));
        for old in self.near(keyframe) {
            if self.matching.recognize(keyframe, old)? {
                break;
            }
        }
        self.visits.push((kind, keyframe));
        Ok(())
    }

    /// The places that a keyframe may be at, the nearest first.
    fn near(&self, keyframe: usize) -> Vec<usize> {
        let here = self.pose(keyframe).position;
        let reach = self.config.apart + self.matching.doubt(keyframe);
        let mut near: Vec<(f64, usize)> = (self.visits.iter())
            .map(|(_, old)| *old)
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
        let poses = &self.matching.graph().poses()[from..=to];
        let steps = poses.windows(2);
        steps
            .map(|pair| (pair[1].position - pair[0].position).norm())
            .sum()
    }
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
            .flat_map(|pair| {
                let (from, to) = (pair[0].id, pair[1].id);
                [MapLink { from, to }, MapLink { from: to, to: from }]
            })
            .collect();
        links.sort_unstable();
        links.dedup();
        MapView {
            places: firsts.map(place).collect(),
            links,
        }
    }

    fn belief(&self) -> Vec<Guess> {
        self.matching.belief()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.sites().iter().map(|site| Some(site.id)).collect()
    }
}
