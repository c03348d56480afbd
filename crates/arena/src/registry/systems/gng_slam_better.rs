use serde_json::{Value, json};
use tolman_draw::Drawing;
use tolman_geom::{Point, Pose};
use tolman_robot::{
    Body, Bumps, Landmark, MapView, Mapper, Ring, Rolls, TakesSnapshots, TurnTranslate, pioneer_2dx,
};
use tolman_sim::Model;
use tolman_systems::gngslam::{ExplorationPolicy, MapFile, OnlineSlam, OnlineSlamConfig};

use super::WIDE;
use crate::course::{Course, Terrain};
use crate::drawing::places_over_world;
use crate::gngslam::LaidOver;
use crate::outing::moved;
use crate::pioneer::body;
use crate::registry::any_robot::any;
use crate::registry::{
    DemoWorld, DrivesBy, LearnedMap, LogMapper, MapText, Registry, RobotEntry, RobotKind, Setup,
    SystemEntry, SystemFacts,
};
use crate::{BoxError, Depicted, Founding, HasSimulated, Outing, Sent, Simulated};

/// The [online system of GNG-SLAM](OnlineSlam) on a robot with sonars and a camera, or with a
/// laser.
#[derive(Clone, Copy, Debug)]
pub(super) struct GngSlamBetterEntry;

const PRESETS: [(&str, &str); 2] = [
    (
        "to-the-unknown",
        "Goes where the floor goes on beyond its map, then by chance",
    ),
    (
        BY_CHANCE,
        "Straight on until something is near, then elsewhere, as in the tables",
    ),
];

/// Preset for contests.
const BY_CHANCE: &str = "by-chance";

/// Beams of its laser robot's ring, and their reach, m.
const RING: (u32, f64) = (90, 4.0);

/// Default number of time steps after which a robot that learns, or drives, has failed.
const LEARNING_STEPS: u32 = 60_000;
const DRIVING_STEPS: u32 = 20_000;

impl SystemEntry for GngSlamBetterEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            title: "GNG-SLAM Better",
            about: "maps places by image, sonar or laser, and corrects its pose by them while it learns",
            needs: "needs snapshots of what is around, by sonars or a laser ring",
            kinds: &[RobotKind::Pioneer2dx, RobotKind::Laser],
            own_robot: RobotEntry::PIONEER_2DX.name,
            presets: &PRESETS,
            arena_preset: Some(BY_CHANCE),
            log_mapper: Some(LogMapper::PlaceGraph),
            for_robot: Ok(|measures, robot, seed| {
                any(OnlineSlam::for_robot(measures, robot, seed))
            }),
            drives: DrivesBy::AnyMap,
            claims: false,
            tried: true,
            demo: (DemoWorld::Small, 1),
            ..SystemFacts::new("gng-slam-better")
        }
    }

    fn sees_cells(&self, _kind: RobotKind) -> u32 {
        3
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let ways = [ExplorationPolicy::ToTheUnknown, ExplorationPolicy::ByChance];
        let explore = setup.settings.preset(&PRESETS, ways)?;
        let before = (setup.from).map(|map| map.parsed(MapFile::from_json));
        let before = before.transpose()?;
        let mut preset = match &before {
            Some(before) => before.config,
            None => usual(&setup.robot),
        };
        preset.explore = explore;
        let config: OnlineSlamConfig = setup.settings.over(&preset)?;
        let mission = match before {
            None => Mission {
                system: OnlineSlam::new(config, setup.seed),
                sites: Vec::new(),
                world_from_map: None,
                config,
                steps: LEARNING_STEPS,
            },
            Some(before) => Mission::on(before, config, setup.seed, LEARNING_STEPS),
        };
        mission.begin(setup)
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let [map] = maps else {
            return Err("gng-slam-better drives by one map: give --map once".into());
        };
        let mut file = map.parsed(MapFile::from_json)?;
        let config: OnlineSlamConfig = setup.settings.over(&file.config)?;
        file.graph = file.graph.put_down(false);
        Mission::on(file, config, setup.seed, DRIVING_STEPS).begin(setup)
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, BoxError> {
        Ok(Box::new(map.parsed(MapFile::from_json)?))
    }
}

/// Returns our usual configuration for a robot.
fn usual(robot: &RobotEntry) -> OnlineSlamConfig {
    match robot.kind().can_be(RobotKind::Laser) {
        true => OnlineSlamConfig::laser(robot.laser_config().translate_per_step),
        false => OnlineSlamConfig::pioneer_2dx(),
    }
}

fn body_of(kind: RobotKind) -> Body {
    match kind {
        RobotKind::Laser | RobotKind::Camera => body(),
        _ => pioneer_2dx::body(),
    }
}

/// Task, robot and world of an outing.
struct Mission {
    system: OnlineSlam,
    /// True position of the robot when each place that it already knows was made, m.
    sites: Vec<Point>,
    /// True pose of the origin of the system's map in the world; `None` for where the robot begins.
    world_from_map: Option<Pose>,
    config: OnlineSlamConfig,
    /// Default maximum number of time steps.
    steps: u32,
}

impl Mission {
    /// Returns a mission on a map.
    fn on(file: MapFile, config: OnlineSlamConfig, seed: u64, steps: u32) -> Self {
        let laid = LaidOver::of(&file.graph, &file.sites);
        let system = OnlineSlam::on(file.graph, config, seed);
        Self {
            system: system.with_sightings(file.sightings),
            sites: file.sites,
            world_from_map: Some(laid.map_or(Pose::IDENTITY, |laid| laid.world_from_map)),
            config,
            steps,
        }
    }

    /// Puts the robot down and returns it ready.
    fn begin(self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let kind = setup.robot.kind();
        let course = setup.course(&body_of(kind), WIDE)?;
        let start = setup.start_off_centre(&course, &body_of(kind))?;
        match kind {
            RobotKind::Laser | RobotKind::Camera => {
                let mut config = setup.robot.laser_config();
                config.ring = Ring::full(RING.0, RING.1);
                let robot = setup.laser_at(&course, start, config)?;
                self.send(setup, course, start, robot)
            }
            _ => {
                let robot = setup.pioneer_2dx_at(&course, start)?;
                self.send(setup, course, start, robot)
            }
        }
    }

    fn send<M>(
        self,
        setup: &Setup<'_>,
        course: Course,
        start: Pose,
        robot: Simulated<M>,
    ) -> Result<Box<dyn Outing>, BoxError>
    where
        M: Depicted
            + Model<Command = TurnTranslate, Sensing: TakesSnapshots + Rolls + Bumps>
            + 'static,
        Simulated<M>: HasSimulated,
    {
        let origin = setup.origin(&course);
        let Self {
            system,
            sites,
            world_from_map,
            config,
            steps,
        } = self;
        let sent = Sent::new(course, robot, setup.steps.unwrap_or(steps), system)
            .laid_at(world_from_map.unwrap_or(start))
            .counting(|system| system.graph().places().len())
            .keeping(move |system, made| {
                let file = MapFile {
                    origin: origin.clone(),
                    config,
                    graph: system.graph().clone(),
                    sightings: system.sightings().to_vec(),
                    sites: with(&sites, made),
                };
                Ok(Some(file.to_json()?))
            });
        Ok(Box::new(sent))
    }
}

/// Returns the true positions of the robot when each place was made: `before`, then those of
/// `made`.
fn with(before: &[Point], made: &[Founding]) -> Vec<Point> {
    let new = made.iter().skip(before.len()).map(|site| site.position);
    before.iter().copied().chain(new).collect()
}

impl LearnedMap for MapFile {
    fn lines(&self) -> Vec<String> {
        let goal = match goal_of(self) {
            Some(place) => format!(
                "the goal was sensed at {} places, with place {place} in the middle",
                goals(self)
            ),
            None => "the goal was never sensed".to_owned(),
        };
        vec![
            format!("{}, seed {}", self.origin.world, self.origin.seed),
            format!(
                "{} places, {} ways between them, {} edges of the pose graph",
                self.graph.places().len(),
                self.graph.map().links.len() / 2,
                self.graph.poses().edges().len()
            ),
            goal,
        ]
    }

    fn json(&self) -> Value {
        let laid = LaidOver::of(&self.graph, &self.sites);
        json!({
            "system": GngSlamBetterEntry.name(),
            "maze": self.origin.world,
            "seed": self.origin.seed,
            "config": self.config,
            "places": self.graph.places().len(),
            "links": self.graph.map().links.len() / 2,
            "edges": self.graph.poses().edges().len(),
            "goal_places": goals(self),
            "error_m": laid.map(|laid| laid.error_m),
        })
    }

    fn drawing(&self, terrain: &Terrain) -> Result<Drawing, BoxError> {
        let course = self.course(&self.origin.world, terrain)?;
        let laid = LaidOver::of(&self.graph, &self.sites).ok_or(
            "the map has no true positions of its places, so it cannot be drawn over a world: leave --svg out",
        )?;
        let map = moved(system(self).map(), laid.world_from_map);
        Ok(places_over_world(&course, &map))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, BoxError> {
        let count = self.graph.places().len();
        let known = |place: u32| match (place as usize) < count {
            true => Ok(place),
            false => Err(format!(
                "there is no place {place}: they are numbered from 0 to {}",
                count.saturating_sub(1)
            )),
        };
        let from = known(from.unwrap_or(0))?;
        let to = match to {
            Some(to) => known(to)?,
            None => goal_of(self).ok_or("the goal is not on this map: give --to PLACE")?,
        };
        let system = OnlineSlam::on(self.graph.clone(), self.config, 0);
        let poses = self.graph.poses().poses();
        let way = system.plan(from, to).map(|places| {
            let steps = places.windows(2).map(|step| {
                let [a, b] = [step[0], step[1]].map(|place| poses[place as usize].position);
                format!("{:.2} m to place {}", (b - a).norm(), step[1])
            });
            steps.collect()
        });
        Ok(way)
    }

    fn view(&self) -> Result<MapView, BoxError> {
        Ok(system(self).map())
    }

    fn course(&self, world: &str, terrain: &Terrain) -> Result<Course, BoxError> {
        let robot = Registry::current().robot(&self.origin.robot);
        let kind = robot.map_or(RobotKind::Pioneer2dx, |robot| robot.kind());
        Ok(terrain.course_with(world, &body_of(kind), WIDE)?)
    }
}

/// Returns the system with this map.
fn system(file: &MapFile) -> OnlineSlam {
    OnlineSlam::on(file.graph.clone(), file.config, 0).with_sightings(file.sightings.clone())
}

/// Returns the number of places where the goal was sensed.
fn goals(file: &MapFile) -> usize {
    let sightings = file.sightings.iter();
    sightings
        .filter(|sighting| sighting.landmark == Landmark::Goal)
        .count()
}

/// Returns the place in the middle of those where the goal was sensed.
fn goal_of(file: &MapFile) -> Option<u32> {
    system(file).place_with(Landmark::Goal)
}
