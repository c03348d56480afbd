use alloc::sync::Arc;

use serde_json::{Value, json};
use tolman_draw::Drawing;
use tolman_robot::MapView;
use tolman_systems::Actor;
use tolman_systems::mslst::{self, GrowthRecord, Learned, MapFile, MslstConfig};

use crate::course::{Course, Terrain};
use crate::drawing::mslst::whole_graph_over_maze;
use crate::pioneer::body;
use crate::registry::any_robot::any;
use crate::registry::{DemoWorld, DrivesBy, LearnedMap, MapText, Setup, SystemEntry, SystemFacts};
use crate::{BoxError, Outing, Sent};

/// [`mslst`] on a laser robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct MslstEntry;

const PRESETS: [(&str, &str); 3] = [
    (
        "large",
        "As in the paper's Large maze, with a threshold of 50",
    ),
    ("j", "As in the paper's J maze"),
    (
        ARENA,
        "As in the arena: scans and actions by the number of cells",
    ),
];

/// Preset for contests.
const ARENA: &str = "arena";

/// Number of time steps per cell for which MSLST records scans in the arena. It also maps for this
/// many actions per cell. Together they use most of the distance that it may drive.
const SCANS_A_CELL: u32 = 10;
const ACTIONS_A_CELL: u32 = 6;

/// Returns the configuration for a contest.
fn by_size(course: &Course) -> MslstConfig {
    let cells = course.maze.reachable().count() as u32;
    let mut config = MslstConfig::large(50.0);
    config.scan_steps = SCANS_A_CELL * cells;
    config.graph_actions = ACTIONS_A_CELL * cells;
    config
}

impl SystemEntry for MslstEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            title: "MSLST",
            about: "learns states from laser scans and a graph of them, and localizes by its recent history",
            is_paper: true,
            presets: &PRESETS,
            arena_preset: Some(ARENA),
            for_robot: Ok(|measures, robot, seed| {
                any(mslst::Mslst::for_robot(measures, robot, seed))
            }),
            drives: DrivesBy::AnyMap,
            // It is done when it has used up its actions.
            claims: false,
            demo: (DemoWorld::Small, 42),
            ..SystemFacts::new("mslst")
        }
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name())?;
        let (course, robot, stack) = setup.laser_robot()?;
        let presets = [MslstConfig::large(50.0), MslstConfig::j(), by_size(&course)];
        let preset = setup.settings.preset(&PRESETS, presets)?;
        let config: MslstConfig = setup.settings.over(&preset)?;
        let origin = setup.origin(&course);
        let actor = Actor::seeded(mslst::Mslst::new(config), stack, setup.seed);
        let steps = setup.steps.unwrap_or(u32::MAX);
        let sent = Sent::new(course, robot, steps, actor)
            .counting(|actor| actor.brain().node_count())
            .keeping(move |actor, sites| {
                let Some(map) = actor.brain().learned() else {
                    return Ok(None);
                };
                let survey = GrowthRecord {
                    positions: sites.iter().map(|site| site.position).collect(),
                    made_by: sites.iter().map(|site| site.action).collect(),
                };
                let learned = Learned {
                    map: (**map).clone(),
                    survey,
                };
                let origin = origin.clone();
                let file = MapFile {
                    origin,
                    config,
                    learned,
                };
                Ok(Some(file.to_json()?))
            });
        Ok(Box::new(sent))
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let [map] = maps else {
            return Err("mslst drives by one map: give --map once".into());
        };
        let MapFile {
            config, learned, ..
        } = map.parsed(MapFile::from_json)?;
        let config: MslstConfig = setup.settings.over(&config)?;
        let (course, robot, stack) = setup.laser_robot()?;
        let sites = learned.survey.positions;
        let mslst = mslst::Mslst::knowing(Arc::new(learned.map), config);
        let actor = Actor::seeded(mslst, stack, setup.seed);
        let steps = setup.steps.unwrap_or_else(|| course.step_limit());
        let sent = Sent::new(course, robot, steps, actor)
            .lying(move |_, _| (0..).zip(sites.iter().copied()).collect());
        Ok(Box::new(sent))
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, BoxError> {
        Ok(Box::new(map.parsed(MapFile::from_json)?))
    }
}

impl LearnedMap for MapFile {
    fn lines(&self) -> Vec<String> {
        let Self {
            origin,
            config,
            learned,
        } = self;
        let graph = &learned.map.graph;
        let destinations = graph.ids().filter(|id| graph.is_destination(*id)).count();
        let furthest = graph.ids().filter_map(|id| graph.distance(id)).max();
        vec![
            format!("{}, seed {}", origin.world, origin.seed),
            format!(
                "{} states: threshold {}, {} steps",
                learned.map.states.models().len(),
                config.threshold,
                config.scan_steps
            ),
            format!(
                "{} nodes, {destinations} of them in the destination: {} actions",
                graph.len(),
                config.graph_actions
            ),
            match furthest {
                Some(furthest) => format!("the furthest node is {furthest} actions from one"),
                None => "no way to the destination is known".to_owned(),
            },
        ]
    }

    fn json(&self) -> Value {
        let Self {
            origin,
            config,
            learned,
        } = self;
        let graph = &learned.map.graph;
        json!({
            "system": MslstEntry.name(),
            "maze": origin.world,
            "seed": origin.seed,
            "config": config,
            "states": learned.map.states.models().len(),
            "nodes": graph.len(),
            "destination_nodes": graph.ids().filter(|id| graph.is_destination(*id)).count(),
            "furthest_node": graph.ids().filter_map(|id| graph.distance(id)).max(),
        })
    }

    fn drawing(&self, terrain: &Terrain) -> Result<Drawing, BoxError> {
        let course = terrain.course(&self.origin.world, &body())?;
        Ok(whole_graph_over_maze(&course, &self.learned))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, BoxError> {
        if to.is_some() {
            return Err("mslst's graph only leads to the goal: leave --to out".into());
        }
        let graph = &self.learned.map.graph;
        let from = from.unwrap_or(0);
        if graph.node(from).is_none() {
            let last = graph.len().saturating_sub(1);
            return Err(
                format!("there is no node {from}: they are numbered from 0 to {last}").into(),
            );
        }
        let path = graph.path_to_destination(from, &[]);
        Ok(path.map(|path| path.iter().map(ToString::to_string).collect()))
    }

    fn view(&self) -> Result<MapView, BoxError> {
        Ok(self.learned.map.view())
    }
}
