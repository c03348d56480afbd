use tolman_systems::Actor;
use tolman_systems::baselines::{AvoidBrain, Random, WallFollow};

use crate::cast::Agent;
use crate::pioneer::CORRIDOR_WIDTH;
use crate::registry::any_robot::any;
use crate::registry::{ForRobot, MapText, Setup, SystemEntry, SystemFacts};
use crate::{BoxError, Outing};

/// A baseline, which learns no map.
#[derive(Clone, Copy, Debug)]
pub(super) struct BaselineEntry(pub(super) Agent, pub(super) &'static str);

impl SystemEntry for BaselineEntry {
    fn facts(&self) -> SystemFacts {
        let Self(agent, name) = *self;
        SystemFacts {
            title: agent.name(),
            about: agent.description(),
            is_paper: true,
            learns: false,
            baseline: Some(agent),
            why_no_log: "it learns no map",
            for_robot: for_robot(agent),
            delivers: matches!(agent, Agent::Random | Agent::WallFollow),
            claims: false,
            ..SystemFacts::new(name)
        }
    }

    fn learner(&self, _setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let name = self.name();
        Err(format!("{name} learns no map: see it drive with `tolman run {name}`").into())
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let name = self.name();
        if let [map, ..] = maps {
            return Err(format!("{name} drives by no map: leave {} out", map.name).into());
        }
        setup.settings.none()?;
        let (course, robot, stack) = setup.laser_robot()?;
        let width = course.corridor_width;
        let Self(agent, _) = *self;
        let seed = setup.seed;
        Ok(match agent {
            Agent::Avoid => {
                let actor = Actor::seeded(AvoidBrain::default(), stack, seed);
                setup.send(name, course, robot, actor)
            }
            Agent::WallFollow => {
                let actor = Actor::seeded(WallFollow::new(width), stack, seed);
                setup.send(name, course, robot, actor)
            }
            Agent::Random => setup.send(name, course, robot, Actor::seeded(Random, stack, seed)),
            Agent::Oracle | Agent::UnlocalizedOracle => {
                return Err(format!("{name} knows the way to the goal alone").into());
            }
        })
    }
}

fn for_robot(agent: Agent) -> Result<ForRobot, &'static str> {
    Ok(match agent {
        Agent::Avoid => |measures, robot, seed| {
            let brain = |_, _| AvoidBrain::default();
            any(Actor::for_robot(brain, measures, robot, seed))
        },
        Agent::WallFollow => |measures, robot, seed| {
            let brain = |_, _| WallFollow::new(CORRIDOR_WIDTH);
            any(Actor::for_robot(brain, measures, robot, seed))
        },
        Agent::Random => {
            |measures, robot, seed| any(Actor::for_robot(|_, _| Random, measures, robot, seed))
        }
        Agent::Oracle | Agent::UnlocalizedOracle => {
            return Err("it is told the maze, and the measures do not give it");
        }
    })
}
