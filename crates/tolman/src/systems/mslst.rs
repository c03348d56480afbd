use alloc::sync::Arc;

use anyhow::{Context, Error, anyhow};
use serde_json::{Value, json};
use tolman_arena::course::Terrain;
use tolman_arena::pioneer::{LASER_PIONEER, body};
use tolman_arena::{Outing, Sent};
use tolman_draw::Drawing;
use tolman_papers::mslst::drawing::whole_graph_over_maze;
use tolman_systems::mslst::{self, GrowthRecord, Learned, MapFile, MslstConfig};
use tolman_systems::{Actor, Origin};

use crate::system::{LearnedMap, MapText, Setup, SystemEntry, laser_pioneer};

/// [`mslst`] on the laser Pioneer.
#[derive(Clone, Copy, Debug)]
pub struct MslstEntry;

const PRESETS: [(&str, &str); 2] = [
    (
        "large",
        "As in the paper's Large maze, with a threshold of 50",
    ),
    ("j", "As in the paper's J maze"),
];

impl SystemEntry for MslstEntry {
    fn name(&self) -> &'static str {
        "mslst"
    }

    fn about(&self) -> &'static str {
        "Learns states from laser scans and a graph of them, and localizes by its recent history"
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &PRESETS
    }

    fn robots(&self) -> &'static [&'static str] {
        &[LASER_PIONEER]
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error> {
        setup.anew(self.name())?;
        let presets = [MslstConfig::large(50.0), MslstConfig::j()];
        let names = PRESETS.map(|(name, _)| name);
        let preset = setup.settings.preset(names.into_iter().zip(presets))?;
        let config: MslstConfig = setup.settings.over(&preset)?;
        let (course, robot, stack) = laser_pioneer(setup)?;
        let origin = setup.origin(&course, LASER_PIONEER);
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
            })
            .judged(|actor, _| {
                let map = actor.brain().learned();
                map.and_then(|map| complaint(map))
            });
        Ok(Box::new(sent))
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error> {
        let [map] = maps else {
            return Err(anyhow!("mslst drives by one map: give --map once"));
        };
        let MapFile {
            config, learned, ..
        } = MapFile::from_json(&map.text).with_context(|| map.name.clone())?;
        let config: MslstConfig = setup.settings.over(&config)?;
        let (course, robot, stack) = laser_pioneer(setup)?;
        let sites = learned.survey.positions;
        let mslst = mslst::Mslst::knowing(Arc::new(learned.map), config);
        let actor = Actor::seeded(mslst, stack, setup.seed);
        let steps = setup.steps.unwrap_or_else(|| course.step_limit());
        let sent = Sent::new(course, robot, steps, actor)
            .lying(move |_| (0..).zip(sites.iter().copied()).collect());
        Ok(Box::new(sent))
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, Error> {
        let file = MapFile::from_json(&map.text).with_context(|| map.name.clone())?;
        Ok(Box::new(file))
    }
}

fn complaint(map: &mslst::MslstMap) -> Option<String> {
    let graph = &map.graph;
    let lost = graph
        .ids()
        .filter(|id| graph.distance(*id).is_none())
        .count();
    if !graph.ids().any(|id| graph.is_destination(id)) {
        let why =
            "the robot never came to the destination: learn longer, --set graph_actions=20000";
        return Some(why.to_owned());
    }
    (2 * lost > graph.len()).then(|| {
        format!(
            "no way to the destination is known from {lost} of {} nodes: learn longer, --set graph_actions=20000",
            graph.len()
        )
    })
}

impl LearnedMap for MapFile {
    fn lines(&self) -> Vec<String> {
        let Self {
            origin: Origin { world, seed, .. },
            config,
            learned,
        } = self;
        let graph = &learned.map.graph;
        let destinations = graph.ids().filter(|id| graph.is_destination(*id)).count();
        let furthest = graph.ids().filter_map(|id| graph.distance(id)).max();
        vec![
            format!("{world}, seed {seed}"),
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
                None => "no way to the destination is known: learn longer".to_owned(),
            },
        ]
    }

    fn json(&self) -> Value {
        let Self {
            origin: Origin { world, seed, .. },
            config,
            learned,
        } = self;
        let graph = &learned.map.graph;
        json!({
            "system": MslstEntry.name(),
            "maze": world,
            "seed": seed,
            "config": config,
            "states": learned.map.states.models().len(),
            "nodes": graph.len(),
            "destination_nodes": graph.ids().filter(|id| graph.is_destination(*id)).count(),
            "furthest_node": graph.ids().filter_map(|id| graph.distance(id)).max(),
        })
    }

    fn drawing(&self, terrain: &Terrain) -> Result<Drawing, Error> {
        let course = terrain.course(&self.origin.world, &body())?;
        Ok(whole_graph_over_maze(&course, &self.learned))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, Error> {
        if to.is_some() {
            return Err(anyhow!(
                "mslst's graph only leads to the goal: leave --to out"
            ));
        }
        let graph = &self.learned.map.graph;
        let from = from.unwrap_or(0);
        if graph.node(from).is_none() {
            let last = graph.len().saturating_sub(1);
            return Err(anyhow!(
                "there is no node {from}: they are numbered from 0 to {last}"
            ));
        }
        let path = graph.path_to_destination(from, &[]);
        Ok(path.map(|path| path.iter().map(ToString::to_string).collect()))
    }

    fn complaint(&self, _terrain: &Terrain) -> Result<Option<String>, Error> {
        Ok(complaint(&self.learned.map))
    }
}
