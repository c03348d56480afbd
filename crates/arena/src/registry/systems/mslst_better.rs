use alloc::sync::Arc;

use serde_json::{Value, json};
use tolman_control::heading_of;
use tolman_draw::Drawing;
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::scan_map::{CorridorMap, ScanChart, ScanPlace};
use tolman_maze::Direction;
use tolman_robot::{Landmark, MapView};
use tolman_systems::Actor;
use tolman_systems::mslst::BetterMslst;
use tolman_systems::mslst::better::{BetterConfig, BetterMap, BetterMapFile, BetterNavigator};

use crate::course::Terrain;
use crate::drawing::places_over_world;
use crate::gngslam::LaidOver;
use crate::mslst::{better_config, better_driver, own_heading};
use crate::outing::moved;
use crate::pioneer::body;
use crate::registry::any_robot::any;
use crate::registry::{
    DemoWorld, DrivesBy, LearnedMap, MapText, RobotEntry, Setup, SystemEntry, SystemFacts, because,
};
use crate::{BoxError, Founding, Outing, Sent};

/// The [better MSLST](BetterMslst) on the laser Pioneer.
#[derive(Clone, Copy, Debug)]
pub(super) struct MslstBetterEntry;

const PRESETS: [(&str, &str); 1] = [("pioneer", "As in the tables, row Better")];

impl SystemEntry for MslstBetterEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            title: "MSLST Better",
            about: "draws walls from laser scans, explores where its map has gaps, and navigates by a belief over where it can stand",
            own_robot: RobotEntry::NOISY_PIONEER.name,
            presets: &PRESETS,
            for_robot: Ok(|measures, robot, seed| {
                any(BetterMslst::for_robot(measures, robot, seed))
            }),
            delivers: true,
            drives: DrivesBy::AnyMap,
            demo: (DemoWorld::Large, 8),
            ..SystemFacts::new("mslst-better")
        }
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name())?;
        setup.settings.preset(&PRESETS, [()])?;
        let (course, robot, stack) = setup.laser_robot()?;
        let preset = better_config(course.corridor_width, &setup.robot.laser_config());
        let config: BetterConfig = setup.settings.over(&preset)?;
        config.check().map_err(|error| because("--set", error))?;
        let origin = setup.origin(&course);
        // The map's origin is where the robot starts; its axes are those of the compass.
        let start = robot.truth().pose.position;
        let world_from_map = Pose::new(start, Heading::EAST);
        let ring = setup.robot.laser_config().ring;
        let actor = better_driver(config, ring, stack, setup.seed);
        let steps = setup
            .steps
            .unwrap_or_else(|| course.step_limit().saturating_mul(10));
        let sent = Sent::new(course, robot, steps, actor)
            .laid_at(world_from_map)
            .counting(|actor| actor.brain().place_count())
            .keeping(move |actor, made| {
                let file = BetterMapFile {
                    origin: origin.clone(),
                    config,
                    chart: actor.brain().chart(),
                    sites: sites(start, made),
                };
                Ok(Some(file.to_json()?))
            });
        Ok(Box::new(sent))
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let [map] = maps else {
            return Err(format!("{} drives by one map: give --map once", self.name()).into());
        };
        let file = map.parsed(BetterMapFile::from_json)?;
        let config: BetterConfig = setup.settings.over(&file.config)?;
        config.check().map_err(|error| because("--set", error))?;
        let (course, robot, stack) = setup.laser_robot()?;
        let laid = laid(&file);
        let map = BetterMap::of(file.chart, setup.robot.laser_config().ring, &config)?;
        let actor = Actor::seeded(BetterNavigator::new(Arc::new(map)), stack, setup.seed);
        let actor = own_heading(actor);
        let steps = setup.steps.unwrap_or_else(|| course.step_limit());
        let sent = Sent::new(course, robot, steps, actor);
        Ok(Box::new(match laid {
            Some(laid) => sent.laid_at(laid.world_from_map),
            None => sent,
        }))
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, BoxError> {
        Ok(Box::new(map.parsed(BetterMapFile::from_json)?))
    }
}

/// Returns the true position of the robot when each place was made. The first place was made before
/// the first action.
fn sites(start: Point, made: &[Founding]) -> Vec<Point> {
    let first = made.first().map(|_| start);
    let others = made.iter().skip(1).map(|site| site.position);
    first.into_iter().chain(others).collect()
}

/// Returns the placement of a map over the world; `None` if the true poses were not recorded.
fn laid(file: &BetterMapFile) -> Option<LaidOver> {
    let places = file.chart.places().iter().map(|place| place.position);
    LaidOver::of_places(places, &file.sites)
}

/// Returns the numbers of the places where the goal was sensed.
fn goals(chart: &ScanChart) -> impl Iterator<Item = u32> + '_ {
    let is_goal = |place: &ScanPlace| place.landmark == Some(Landmark::Goal);
    let numbered = (0..).zip(chart.places());
    numbered
        .filter(move |(_, place)| is_goal(place))
        .map(|(number, _)| number)
}

/// Returns the number of ways between places, each counted once.
fn ways(chart: &ScanChart) -> usize {
    chart.view().links.len() / 2
}

impl LearnedMap for BetterMapFile {
    fn lines(&self) -> Vec<String> {
        let goals: Vec<String> = goals(&self.chart).map(|place| place.to_string()).collect();
        let goal = match goals.as_slice() {
            [] => "the goal was never sensed".to_owned(),
            goals => format!("the goal was sensed at place {}", goals.join(", ")),
        };
        vec![
            format!("{}, seed {}", self.origin.world, self.origin.seed),
            format!(
                "{} places, {} ways between them",
                self.chart.places().len(),
                ways(&self.chart)
            ),
            goal,
        ]
    }

    fn json(&self) -> Value {
        let goals: Vec<u32> = goals(&self.chart).collect();
        json!({
            "system": MslstBetterEntry.name(),
            "maze": self.origin.world,
            "seed": self.origin.seed,
            "config": self.config,
            "places": self.chart.places().len(),
            "links": ways(&self.chart),
            "goal_places": goals,
            "error_m": laid(self).map(|laid| laid.error_m),
        })
    }

    fn drawing(&self, terrain: &Terrain) -> Result<Drawing, BoxError> {
        let course = terrain.course(&self.origin.world, &body())?;
        let laid = laid(self).ok_or(
            "the map has no true positions of its places, so it cannot be drawn over a world: leave --svg out",
        )?;
        let map = moved(self.chart.view(), laid.world_from_map);
        Ok(places_over_world(&course, &map))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, BoxError> {
        let places = self.chart.places();
        let known = |place: u32| match (place as usize) < places.len() {
            true => Ok(place),
            false => Err(format!(
                "there is no place {place}: they are numbered from 0 to {}",
                places.len().saturating_sub(1)
            )),
        };
        let from = known(from.unwrap_or(0))?;
        let to: Vec<u32> = match to {
            Some(to) => vec![known(to)?],
            None => goals(&self.chart).collect(),
        };
        let way = self.chart.way(from, &to);
        Ok(way.map(|way| way.windows(2).map(|step| leg(places, step)).collect()))
    }

    fn view(&self) -> Result<MapView, BoxError> {
        Ok(CorridorMap::of(&self.chart, self.config.corridor_width).view())
    }
}

/// Returns a step of the way from place to place in words.
fn leg(places: &[ScanPlace], step: &[u32]) -> String {
    let [a, b] = [step[0], step[1]].map(|place| places[place as usize].position);
    let way = b - a;
    let along = |direction: &Direction| way.dot(&heading_of(*direction).unit());
    let towards = Direction::ALL.into_iter();
    let towards = towards.max_by(|a, b| along(a).total_cmp(&along(b)));
    let towards = towards
        .map(|towards| format!("{towards}, "))
        .unwrap_or_default();
    format!("{towards}{:.2} m, to place {}", way.norm(), step[1])
}
