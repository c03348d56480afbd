use alloc::borrow::Cow;
use alloc::collections::{BTreeMap, BTreeSet};
use core::error::Error;
use std::path::Path;

use tolman_arena::registry::LogMapper;
use tolman_experiment::BoxError;
use tolman_formats::{LogError, LogOptions, LogReport, LogScan, WholeLog};
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::pose_graph::PoseGraph;
use tolman_maps::scan_matching::{ScanMatching, ScanMatchingConfig, ScanStep};
use tolman_robot::{MapView, Mapper, TimedPose, Trajectory};
use tolman_systems::cpm::CpmOfSites;
use tolman_systems::diktiometry::DiktiometryOfSites;
use tolman_systems::gngslam::PlaceGraphOfSites;
use tolman_systems::places::{OfSites, PlacesConfig, PlacesMapper, SiteMapper};

/// Distance below which two places are one, m: half a corridor's width.
const DOUBLED_M: f64 = 1.0;

/// A robot's log: its scans, and the report on reading it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotLog {
    /// Scans of the log, in the order of time.
    pub scans: Vec<LogScan>,
    /// Report on reading the file.
    pub report: LogReport,
}

/// Result of mapping a log.
#[derive(Clone, Debug, Default)]
pub struct MappedLog {
    /// Pose of each scan, in the order of the log.
    pub poses: Vec<Pose>,
    /// Number of places that were recognized again.
    pub closures: usize,
    /// Indices of the scans that the map keeps.
    pub keyframes: Vec<usize>,
    /// Loop closures found.
    pub closed: Vec<FoundClosure>,
    /// Map of places; empty for a system without one.
    pub places: MapView,
    /// Scan at which each place was first visited, by the place's id.
    pub founded: BTreeMap<u32, usize>,
    /// Visits to places: the keyframe in the middle of the place, and the place's id if the map
    /// knows it.
    pub visits: Vec<(usize, Option<u32>)>,
    /// Keyframes with their odometry and closures; empty for a system without them.
    pub graph: PoseGraph,
    /// Probability that the map is right, by the mapper's own estimate; `None` if it gives none.
    pub certainty: Option<f64>,
}

/// A loop closure: a place that was seen again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundClosure {
    /// Index of the earlier keyframe.
    pub earlier: usize,
    /// Index of the later keyframe.
    pub later: usize,
    /// Measured pose of the later keyframe relative to the earlier one.
    pub measured: Pose,
}

impl RobotLog {
    /// Reads a log of lines or a bag of ROS, packed or not: see [`WholeLog`].
    ///
    /// # Errors
    /// If there is no such file, or no scan of it can be used.
    pub fn read(path: &Path) -> Result<Self, LogError> {
        Self::read_as(path, &LogOptions::whole())
    }

    /// Reads a log as [`read`](Self::read), as the options tell.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_as(path: &Path, options: &LogOptions) -> Result<Self, LogError> {
        WholeLog::open(path, options).map(Self::from)
    }

    /// Reads a log in memory.
    ///
    /// # Errors
    /// In words, if no scan of it can be used.
    pub fn of_text(text: &[u8]) -> Result<Self, String> {
        WholeLog::of_bytes(text.to_vec(), &LogOptions::whole()).map(Self::from)
    }

    /// Returns the odometry, one pose per scan.
    #[must_use]
    pub fn odometry(&self) -> Vec<Pose> {
        self.scans.iter().map(|scan| scan.odometry).collect()
    }

    /// Returns the odometry, aligned with the start of the trajectory `found`.
    #[must_use]
    pub fn odometry_over(&self, found: &[Pose]) -> Vec<Pose> {
        let odometry = self.odometry();
        let over = match (found.first(), odometry.first()) {
            (Some(found), Some(raw)) => found.compose(raw.inverse()),
            _ => Pose::IDENTITY,
        };
        odometry.iter().map(|pose| over.compose(*pose)).collect()
    }

    /// Estimates the robot's trajectory by `system`, from the poses of `odometry`, and returns it.
    /// If these never move, the scans alone tell how the robot moved. Calls `see` after each scan
    /// with the number of scans so far.
    ///
    /// # Errors
    /// If a scan is invalid.
    pub fn map(
        &self,
        system: LogMapper,
        odometry: &[Pose],
        see: impl FnMut(usize),
    ) -> Result<MappedLog, BoxError> {
        let odometry = &*self.moved(odometry)?;
        let corridors = PlacesConfig::indoor().corridor_width;
        let mut config = ScanMatchingConfig::indoor();
        let mut mapper = match system {
            LogMapper::Odometry => {
                return Ok(MappedLog {
                    poses: odometry.to_vec(),
                    ..MappedLog::default()
                });
            }
            LogMapper::Places => {
                let mut mapper = PlacesMapper::new(PlacesConfig::indoor())?;
                self.show(&mut mapper, odometry, see)?;
                mapper.finish()?;
                let visits = mapper.sites().into_iter();
                let visits = visits.map(|site| (site.keyframe, Some(site.id)));
                return Ok(MappedLog::of(mapper.matching()).with_places(mapper.map(), visits));
            }
            LogMapper::Diktiometry => {
                return self.map_sites(DiktiometryOfSites::indoor(corridors), odometry, see);
            }
            LogMapper::Cpm => return self.map_sites(CpmOfSites::indoor(corridors), odometry, see),
            LogMapper::PlaceGraph => {
                return self.map_sites(PlaceGraphOfSites::indoor(), odometry, see);
            }
            LogMapper::Matching => {
                config.closures = None;
                ScanMatching::new(config)
            }
            LogMapper::ScanMatching => ScanMatching::new(config),
        };
        self.show(&mut mapper, odometry, see)?;
        mapper.finish()?;
        Ok(MappedLog::of(&mapper))
    }

    /// Maps the log by scan matching, with the closures of `audited` in place of those that it
    /// finds.
    ///
    /// # Errors
    /// If a scan is invalid, or the graph is not of this log's keyframes.
    pub fn map_with_closures(
        &self,
        audited: &PoseGraph,
        odometry: &[Pose],
        see: impl FnMut(usize),
    ) -> Result<MappedLog, BoxError> {
        let odometry = self.moved(odometry)?;
        let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
        self.show(&mut mapper, &odometry, see)?;
        let (poses, keyframes) = (audited.poses().len(), mapper.keyframes().len());
        if poses != keyframes {
            return Err(format!("the graph has {poses} poses, and the log {keyframes} keyframes; give the graph.g2o of this log, or what `tolman audit` made of it").into());
        }
        mapper.close_by(audited.closures().copied())?;
        Ok(MappedLog::of(&mapper))
    }

    /// Returns how the robot moved: `odometry`, or what the scans tell if it never moves.
    fn moved<'a>(&self, odometry: &'a [Pose]) -> Result<Cow<'a, [Pose]>, BoxError> {
        let stands = odometry.iter().all(|pose| Some(pose) == odometry.first());
        Ok(match stands {
            true => Cow::Owned(self.found_from_scans()?),
            false => Cow::Borrowed(odometry),
        })
    }

    /// Returns how the robot moved, one pose per scan, by matching each scan to those before. The
    /// robot is expected to go on as it went.
    fn found_from_scans(&self) -> Result<Vec<Pose>, BoxError> {
        let mut mapper = ScanMatching::new(ScanMatchingConfig::without_odometry());
        let mut poses: Vec<Pose> = Vec::new();
        let mut going = (Pose::IDENTITY, 0.0);
        for (index, scan) in self.scans.iter().enumerate() {
            let before = index
                .checked_sub(1)
                .and_then(|before| self.scans.get(before));
            let duration = before.map_or(0.0, |before| scan.time - before.time);
            let share = match going.1 > 0.0 {
                true => (duration / going.1).clamp(0.0, 2.0),
                false => 1.0,
            };
            let step: Pose = going.0;
            mapper.observe(&ScanStep {
                moved: Pose::new(
                    Point::from(step.position.coords * share),
                    Heading::from_radians(step.heading.radians() * share),
                ),
                scan: scan.scan.clone(),
                robot_from_laser: scan.robot_from_laser,
            })?;
            let pose = mapper.pose().unwrap_or(Pose::IDENTITY);
            going = poses
                .last()
                .map_or(going, |last| (last.between(pose), duration));
            poses.push(pose);
        }
        Ok(poses)
    }

    /// Passes the places of the log to a mapper.
    fn map_sites<O>(
        &self,
        of_sites: O,
        odometry: &[Pose],
        see: impl FnMut(usize),
    ) -> Result<MappedLog, BoxError>
    where
        O: OfSites<Error: Error + Send + Sync + 'static>,
        O::Mapper: Mapper<Error: Error + Send + Sync + 'static>,
    {
        let mut mapper = SiteMapper::new(PlacesConfig::indoor(), of_sites)?;
        self.show(&mut mapper, odometry, see)?;
        mapper.finish()?;
        let visits = mapper.keyframes_of_visits().into_iter();
        let found = MappedLog::of(mapper.matching()).with_places(mapper.map(), visits);
        Ok(MappedLog {
            certainty: mapper.certainty(),
            ..found
        })
    }

    /// Passes the log to a mapper, step by step.
    pub(super) fn show<M: Mapper<Observation = ScanStep>>(
        &self,
        mapper: &mut M,
        odometry: &[Pose],
        mut see: impl FnMut(usize),
    ) -> Result<(), M::Error> {
        let mut before = odometry.first().copied().unwrap_or(Pose::IDENTITY);
        for (index, (scan, odometry)) in self.scans.iter().zip(odometry).enumerate() {
            mapper.observe(&ScanStep {
                moved: before.between(*odometry),
                scan: scan.scan.clone(),
                robot_from_laser: scan.robot_from_laser,
            })?;
            before = *odometry;
            see(index + 1);
        }
        Ok(())
    }

    /// Returns poses, one per scan, as a trajectory.
    #[must_use]
    pub fn trajectory(&self, poses: &[Pose]) -> Trajectory {
        let timed = self.scans.iter().zip(poses);
        Trajectory::new(timed.map(|(scan, pose)| TimedPose {
            time: scan.time,
            pose: *pose,
        }))
    }
}

impl From<WholeLog> for RobotLog {
    fn from(log: WholeLog) -> Self {
        let WholeLog { scans, report } = log;
        Self { scans, report }
    }
}

impl MappedLog {
    fn of(matching: &ScanMatching) -> Self {
        let closures = matching.graph().closures();
        Self {
            poses: matching.trajectory(),
            closures: matching.closures(),
            keyframes: matching.keyframes(),
            graph: matching.graph().clone(),
            closed: closures
                .map(|edge| FoundClosure {
                    earlier: edge.from as usize,
                    later: edge.to as usize,
                    measured: edge.measured,
                })
                .collect(),
            ..Self::default()
        }
    }

    /// Returns, for each visit to a place that the map knows already, the keyframes of the previous
    /// visit and of this one. O(visits · log places).
    #[must_use]
    pub fn recognized(&self) -> Vec<[usize; 2]> {
        let mut last = BTreeMap::new();
        let visits = self.visits.iter();
        let visits = visits.filter_map(|(keyframe, place)| Some((*keyframe, (*place)?)));
        visits
            .filter_map(|(keyframe, place)| Some([last.insert(place, keyframe)?, keyframe]))
            .collect()
    }

    /// Returns the number of places within 1 m of an earlier one: the same place, visited again and
    /// not recognized. O(places²).
    #[must_use]
    pub fn doubled(&self) -> usize {
        let scans: BTreeSet<_> = self.founded.values().copied().collect();
        let at: Vec<_> = scans
            .iter()
            .filter_map(|scan| Some(self.poses.get(*scan)?.position))
            .collect();
        let is_doubled = |number: &usize| {
            let before = &at[..*number];
            before
                .iter()
                .any(|place| (*place - at[*number]).norm() < DOUBLED_M)
        };
        (0..at.len()).filter(is_doubled).count()
    }

    fn with_places(
        mut self,
        places: MapView,
        visits: impl Iterator<Item = (usize, Option<u32>)>,
    ) -> Self {
        self.places = places;
        self.visits = visits.collect();
        for (keyframe, place) in &self.visits {
            let scan = self.keyframes.get(*keyframe).copied().unwrap_or(0);
            if let Some(place) = place {
                self.founded.entry(*place).or_insert(scan);
            }
        }
        self
    }
}
