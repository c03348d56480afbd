use alloc::sync::Arc;
use core::sync::atomic::AtomicBool;
use std::ffi::OsString;

use tolman_geom::{Heading, Pose};
use tolman_sim::robots::Epuck;

use super::{Budget, ForeignBrain, ForeignMapper, Hello, Launch, Log};
use crate::cpm::{epuck, epuck_course_on};
use crate::mslst::{better_config, better_driver};
use crate::registry::{RobotKind, Setup, SystemEntry, SystemFacts, slug};
use crate::{BoxError, Outing, RobotFacts};

/// A program as a contestant. Each world has a process of its own.
#[derive(Clone, Debug)]
pub struct ForeignEntry {
    /// The program and its arguments, as typed.
    pub name: &'static str,
    /// The program and its arguments, as words.
    pub words: Vec<String>,
    /// Whether it drives.
    pub role: Role,
    /// Command that keeps the program; see [`Launch::keeper`].
    pub keeper: Vec<OsString>,
    /// Destination of the program's stderr.
    pub log: Log,
    /// Resources that each process may use.
    pub budget: Budget,
}

/// Part of a program in a contest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It watches a robot that MSLST Better drives: a [`ForeignMapper`].
    Mapper,
    /// It drives: a [`ForeignBrain`].
    Brain,
}

impl ForeignEntry {
    fn hello(facts: &RobotFacts, corridor_width: f64) -> Hello {
        Hello {
            robot: slug(facts.name),
            radius: facts.body.radius(),
            step_us: facts.step_us,
            step_limit: None,
            corridor_width,
        }
    }

    fn brain(&self, hello: Hello) -> Result<ForeignBrain, BoxError> {
        self.started(|launch| Ok(ForeignBrain::learning(launch, self.budget, hello)?))
    }

    /// Returns what `start` makes of the program.
    fn started<T>(
        &self,
        start: impl FnOnce(&Launch<'_>) -> Result<T, BoxError>,
    ) -> Result<T, BoxError> {
        start(&Launch {
            words: &self.words,
            keeper: &self.keeper,
            log: self.log,
            stop: &Arc::new(AtomicBool::new(false)),
        })
    }
}

impl SystemEntry for ForeignEntry {
    fn facts(&self) -> SystemFacts {
        let facts = SystemFacts {
            about: "is a program in any language",
            ..SystemFacts::new(self.name)
        };
        match self.role {
            Role::Mapper => SystemFacts {
                watches: true,
                ..facts
            },
            Role::Brain => SystemFacts {
                kinds: &[RobotKind::Laser, RobotKind::Epuck],
                needs: "is told what a laser robot or an e-puck senses",
                ..facts
            },
        }
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name)?;
        setup.settings.none()?;
        if setup.robot.kind() == RobotKind::Epuck {
            let course = setup.with_doors(epuck_course_on(setup.world, setup.terrain)?)?;
            let model = Epuck::new(setup.condition.epuck(epuck()))?;
            let start = setup.start_off_centre(&course, tolman_sim::Model::body(&model))?;
            let robot = course.robot_at(start, model, setup.seed)?;
            let hello = Self::hello(&RobotFacts::of(&robot), course.corridor_width);
            let laid = laid_at(start);
            let sent = setup.sent(self.name, course, robot, self.brain(hello)?);
            return Ok(Box::new(sent.laid_at(laid)));
        }
        let (course, robot, stack) = setup.laser_robot()?;
        let hello = Self::hello(&RobotFacts::of(&robot), course.corridor_width);
        let laid = laid_at(robot.truth().pose);
        match self.role {
            Role::Brain => {
                let sent = setup.sent(self.name, course, robot, self.brain(hello)?);
                Ok(Box::new(sent.laid_at(laid)))
            }
            Role::Mapper => {
                let config = setup.robot.laser_config();
                let better = better_config(course.corridor_width, &config);
                let driver = better_driver(better, config.ring, stack, setup.seed);
                let mapper = self.started(|launch| {
                    Ok(ForeignMapper::watching(launch, self.budget, hello, driver)?)
                })?;
                let sent = setup.sent(self.name, course, robot, mapper);
                Ok(Box::new(
                    sent.laid_at(laid).thinking_for(ForeignMapper::waited),
                ))
            }
        }
    }
}

/// Returns where a program's map begins: where its robot starts, along the compass.
fn laid_at(start: Pose) -> Pose {
    Pose::new(start.position, Heading::EAST)
}
