use std::cell::RefCell;
use std::fs;
use std::rc::Rc;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, anyhow};
use ros2_client::RmwRequestId;
use ros2_client::action::GoalStatusEnum;
use serde_json::{Value, json};
use tolman_arena::foreign::{NamedTask, Told};
use tolman_arena::registry::{SystemEntry, SystemFacts};
use tolman_geom::{Heading, Point, Pose};
use tolman_papers::real::ros_map;
use tolman_robot::{
    Goal, LaserMeasures, Position, RobotMeasures, RoverConfig, Standing, Task, VelocityRover,
};
use tolman_systems::AnyOnRobot;

use crate::drawing::{markers, occupancy};
use crate::link::{Asked, Link};
use crate::messages::{LaserScan, NavigateFeedback, PoseStamped, Text};
use crate::mounts::Mount;
use crate::params::Params;
use crate::robot::{Base, RosRobot};
use crate::sightings::{Sightings, position_of};

/// Lets a system drive the robot, as services and goals want it.
pub(crate) struct Pilot {
    link: Rc<RefCell<Link>>,
    facts: SystemFacts,
    system: Box<dyn AnyOnRobot>,
    sightings: Rc<RefCell<Sightings>>,
    laser: Pose,
    errand: Option<Errand>,
    standing: Standing,
    actions: u64,
    /// When the map was last published.
    drawn: Option<Instant>,
}

/// What the robot is doing.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Errand {
    /// What a service asked for.
    Asked(NamedTask),
    /// To a place or a point of the map, for a client of the action.
    Navigate(Goal),
}

/// Least weight of a belief that moves the frame `odom` on the map: likelier than all others.
const LIKELY: f64 = 0.5;

impl Pilot {
    /// Puts a system on the robot of `link`, whose laser gave `scan` and is mounted so.
    ///
    /// # Errors
    /// If the system does not suit the robot.
    pub(crate) fn new(
        entry: &dyn SystemEntry,
        link: Link,
        scan: &LaserScan,
        mount: Mount,
    ) -> Result<Self> {
        let params = link.params.clone();
        let measures = measures(&params, scan, mount);
        measures
            .check()
            .context("the parameters and the laser contradict each other")?;
        let mut config = RoverConfig::small(measures.step());
        config.fastest = tolman_geom::Twist::new(params.max_vel_x, params.max_vel_theta);
        config.braking = tolman_geom::Twist::new(params.acc_lim_x, params.acc_lim_theta);
        config.latency_us = (1e6 * params.latency) as u64;
        let link = Rc::new(RefCell::new(link));
        let sightings = Rc::new(RefCell::new(Sightings::default()));
        let ring = measures.laser.ring();
        let robot = RosRobot {
            rover: VelocityRover::new(Base(Rc::clone(&link)), ring, config)?,
            link: Rc::clone(&link),
            sightings: Rc::clone(&sightings),
            motions: 0,
        };
        let facts = entry.facts();
        let unfit = || format!("{} cannot drive this robot", facts.name);
        let put = facts
            .for_robot
            .map_err(|why| anyhow!(why))
            .with_context(unfit)?;
        let system = put(&measures, Box::new(robot), params.seed).with_context(unfit)?;
        Ok(Self {
            link,
            facts,
            system,
            sightings,
            laser: Pose::new(mount.robot_from_laser.position, Heading::from_radians(0.0)),
            errand: params
                .explore_on_start
                .then_some(Errand::Asked(NamedTask::Explore)),
            standing: Standing::UnderWay,
            actions: 0,
            drawn: None,
        })
    }

    /// Does what is asked, until the robot fails or somebody interrupts.
    ///
    /// # Errors
    /// Always: with the reason why it ends. The robot stands still.
    pub(crate) fn run(&mut self) -> Result<()> {
        loop {
            self.take_orders();
            match self.errand {
                None => self.link.borrow_mut().idle()?,
                Some(errand) => self.go_on(errand)?,
            }
        }
    }

    /// Carries out what came by services and by the action.
    fn take_orders(&mut self) {
        loop {
            let next = self.link.borrow_mut().asked.pop_front();
            let Some(asked) = next else {
                break;
            };
            self.obey(asked);
        }
        let is_called_off = self.link.borrow().navigation.is_called_off();
        let new_goal = self.link.borrow_mut().navigation.new_goal();
        if let Some(pose) = new_goal {
            self.errand = Some(Errand::Navigate(self.goal_at(pose.position)));
        } else if is_called_off {
            self.end_navigation(GoalStatusEnum::Canceled, "called off");
        }
    }

    fn obey(&mut self, (asked, id): (Asked, RmwRequestId)) {
        let begin = |task: NamedTask, word: &str| {
            let word = format!("{word}; ~/state tells when it ends");
            (Some(Errand::Asked(task)), word)
        };
        let (errand, word) = match asked {
            Asked::Explore => begin(NamedTask::Explore, "exploring"),
            Asked::ReachGoal => begin(NamedTask::ReachGoal, "on the way to the goal"),
            Asked::Localize => begin(NamedTask::Localize, "finding its place"),
            Asked::Stop => (None, "stopped".to_owned()),
            Asked::PutDown => {
                self.system.put_down();
                return self.answer(
                    (asked, id),
                    Ok("it no longer counts on its place".to_owned()),
                );
            }
            Asked::SaveMap => {
                let saved = self.save_map();
                return self.answer((asked, id), saved);
            }
            Asked::Report => {
                let report = self.report().to_string();
                return self.answer((asked, id), Ok(report));
            }
        };
        self.end_navigation(GoalStatusEnum::Aborted, "something else was asked for");
        self.errand = errand;
        self.answer((asked, id), Ok(word));
    }

    fn answer(&self, asked: (Asked, RmwRequestId), answer: Result<String>) {
        let (success, message) = match answer {
            Ok(message) => (true, message),
            Err(error) => (false, format!("{error:#}")),
        };
        self.link.borrow().answer(asked, success, message);
    }

    /// Makes the next action of an errand.
    fn go_on(&mut self, errand: Errand) -> Result<()> {
        let acted = self.system.act(errand.task());
        self.standing = acted
            .map_err(|error| anyhow!(error))
            .with_context(|| format!("{} cannot go on", self.facts.name))?;
        self.actions += 1;
        self.follow();
        self.tell(errand);
        if let Errand::Navigate(goal) = errand {
            self.feed_back(goal);
        }
        let standing = self.standing.clone();
        let is_over = standing != Standing::UnderWay;
        if is_over {
            let (status, why) = match &standing {
                Standing::GaveUp { why } => (GoalStatusEnum::Aborted, why.as_str()),
                _ => (GoalStatusEnum::Succeeded, ""),
            };
            match why {
                "" => eprintln!("tolman: {} done", errand.name()),
                why => eprintln!("tolman: {}: gave up: {why}", errand.name()),
            }
            self.end_navigation(status, why);
            self.errand = None;
        }
        let interval = Duration::from_secs_f64(self.link.borrow().params.map_update_interval);
        let is_due = self.drawn.is_none_or(|at| at.elapsed() > interval);
        if is_due || is_over {
            self.draw();
        }
        Ok(())
    }

    /// Lays the frame `odom` on the map by what the system believes, and anchors the new scans.
    fn follow(&mut self) {
        let odom = self.link.borrow().odom;
        if let Some((odom, _)) = odom
            && let Some(pose) = self.believed(odom)
        {
            self.link.borrow_mut().map_from_odom = pose.compose(odom.inverse());
        }
        let map_from_odom = self.link.borrow().map_from_odom;
        self.sightings
            .borrow_mut()
            .anchor(map_from_odom, &*self.system);
    }

    /// Returns the robot's pose on the map, if one is likelier than all others. A system without a
    /// heading of its own has that of odometry, its compass.
    fn believed(&self, odom: Pose) -> Option<Pose> {
        let belief = self.system.belief();
        let first = belief.first().filter(|guess| guess.weight > LIKELY)?;
        let position = match first.at {
            Position::Point(at) => at,
            Position::Place(place) => position_of(&self.system.map(), place)?,
        };
        let heading = self.system.heading().unwrap_or(odom.heading);
        Some(Pose::new(position, heading))
    }

    /// Returns the place within half a corridor of a point, or else the point itself.
    fn goal_at(&self, goal: Point) -> Goal {
        let map = self.system.map();
        let places = map.places.iter();
        let far = |at: Point| (at - goal).norm();
        let places = places.filter_map(|place| Some((far(place.position?), place.id)));
        let nearest = places.min_by(|a, b| a.0.total_cmp(&b.0));
        let within = 0.5 * self.link.borrow().params.corridor_width;
        let near = nearest.filter(|(far, _)| *far <= within);
        near.map_or(Goal::Point(goal), |(_, place)| Goal::Place(place))
    }

    fn end_navigation(&mut self, status: GoalStatusEnum, why: &str) {
        self.link.borrow_mut().navigation.end(status, why);
        if matches!(self.errand, Some(Errand::Navigate(_))) {
            self.errand = None;
        }
    }

    fn feed_back(&self, goal: Goal) {
        let link = self.link.borrow();
        let Some((odom, stamp)) = link.odom else {
            return;
        };
        let pose = link.map_from_odom.compose(odom);
        let goal = match goal {
            Goal::Place(place) => position_of(&self.system.map(), place),
            Goal::Point(at) => Some(at),
            Goal::Landmark(_) => None,
        };
        let left = goal.map_or(0.0, |goal| (goal - pose.position).norm());
        link.navigation.feed_back(NavigateFeedback {
            current_pose: PoseStamped {
                header: link.on_map(stamp),
                pose: pose.into(),
            },
            distance_remaining: left as f32,
            ..NavigateFeedback::default()
        });
    }

    fn told(&self) -> Told<'_> {
        Told {
            facts: &self.facts,
            pilot: &*self.system,
        }
    }

    /// Publishes how the errand stands.
    fn tell(&self, errand: Errand) {
        let mut state = self.told().standing(&self.standing);
        state["task"] = errand.name().into();
        state["actions"] = self.actions.into();
        state["belief"] = self.told().belief().get(0).cloned().unwrap_or(Value::Null);
        if self.standing != Standing::UnderWay {
            state["verdict"] = self.told().verdict(&self.standing);
        }
        let data = state.to_string();
        // A picture that is not seen does not stop the robot.
        let _ = self.link.borrow().states.publish(Text { data });
    }

    /// Returns what a judge of the map wants to know.
    fn report(&self) -> Value {
        let told = self.told();
        json!({ "map": told.map(), "visits": told.visits(), "verdict": told.verdict(&self.standing) })
    }

    /// Publishes the map.
    fn draw(&mut self) {
        self.drawn = Some(Instant::now());
        let link = self.link.borrow();
        let header = link.on_map(link.now());
        let grid =
            self.sightings
                .borrow_mut()
                .grid(&*self.system, self.laser, link.params.resolution);
        let size = 0.3 * link.params.corridor_width;
        let _ = link
            .maps
            .publish(occupancy(&ros_map(&grid), header.clone()));
        let _ = link
            .markers
            .publish(markers(&self.system.map(), &header, size));
    }

    /// Writes the map as ROS's `map_server` reads it.
    fn save_map(&self) -> Result<String> {
        let link = self.link.borrow();
        let name = &link.params.map_file_name;
        let grid =
            self.sightings
                .borrow_mut()
                .grid(&*self.system, self.laser, link.params.resolution);
        let map = ros_map(&grid);
        let [picture, header] = ["pgm", "yaml"].map(|ending| format!("{name}.{ending}"));
        let image = picture.rsplit('/').next().unwrap_or(&picture);
        for (file, bytes) in [
            (&picture, map.pgm()),
            (&header, map.yaml(image).into_bytes()),
        ] {
            fs::write(file, bytes).with_context(|| format!("cannot write {file}"))?;
        }
        let doubt = self.system.doubt();
        let doubt = doubt.map_or_else(String::new, |doubt| {
            format!("; the map may be wrong: {doubt}")
        });
        Ok(format!("saved {header}{doubt}"))
    }
}

impl Errand {
    const fn task(self) -> Task {
        match self {
            Self::Asked(task) => task.task(),
            Self::Navigate(goal) => Task::Reach(goal),
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Asked(task) => task.name(),
            Self::Navigate(_) => "navigate",
        }
    }
}

/// Returns the robot's measures, by its parameters and by its laser.
fn measures(params: &Params, scan: &LaserScan, mount: Mount) -> RobotMeasures {
    let max_range = f64::from(scan.range_max);
    let max_range = params
        .max_laser_range
        .unwrap_or(f64::INFINITY)
        .min(max_range);
    let beams = scan.ranges.len() as u32;
    let mut laser = LaserMeasures::all_round(beams, f64::from(scan.range_min), max_range);
    laser.first_bearing = f64::from(scan.angle_min);
    laser.spacing = Some(f64::from(scan.angle_increment));
    let at = mount.robot_from_laser;
    (laser.x, laser.y) = (at.position.x, at.position.y);
    laser.heading = at.heading.radians();
    laser.upside_down = mount.is_upside_down;
    let mut measures = RobotMeasures::new(params.diameter, params.corridor_width, laser);
    measures.corridor_spacing = params.corridor_spacing;
    measures.compass_error = params.compass_error;
    measures.odometry_error = Some(params.odometry_error);
    measures
}
