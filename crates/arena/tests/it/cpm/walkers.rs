//! What a robot sees where it is put down, and where its walks lead.

use tolman_arena::course::Course;
use tolman_arena::cpm::{SimulatedEpuck, TrueFragments, epuck, survey, walker_config};
use tolman_robot::epuck::{EpuckSensing, PROXIMITY_SENSORS, WheelSpeeds};
use tolman_robot::{Landmark, Robot, SensesLandmarks};
use tolman_sim::StepError;
use tolman_sim::robots::Epuck;
use tolman_systems::cpm::Walker;

use super::trials::maze_1;

/// An e-puck whose sensors still report the hand that carried it, until its next time step.
struct Carried {
    body: SimulatedEpuck,
    sensed: Option<EpuckSensing>,
}

impl Robot for Carried {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = StepError;

    fn sensing(&self) -> &EpuckSensing {
        self.sensed.as_ref().unwrap_or_else(|| self.body.sensing())
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), StepError> {
        self.sensed = None;
        self.body.step(command)
    }
}

impl SensesLandmarks for Carried {
    fn landmark(&self) -> Option<Landmark> {
        self.body.landmark()
    }
}

#[test]
fn what_it_sensed_before_it_was_put_down_is_no_part_of_what_it_sees() {
    let course = maze_1();
    let config = walker_config(&epuck(), 0.25).unwrap();
    for (from, out, _) in TrueFragments::of(&course.maze).ways() {
        let start = course.in_cell(from, out.opposite());
        let carried = Carried {
            body: course
                .robot_at(start, Epuck::new(epuck()).unwrap(), 1)
                .unwrap(),
            sensed: Some(EpuckSensing {
                proximity: Some([3800.0; PROXIMITY_SENSORS]),
                ..EpuckSensing::default()
            }),
        };
        let seen = Walker::new(carried, config.clone()).begin().unwrap();
        assert_eq!(seen.degree, course.maze.degree(from) as u32, "at {from:?}");
    }
}

/// Consecutive sightings of a junction are one, none is passed unseen, and the number of
/// branches is right.
#[test]
fn every_walk_leads_to_the_next_place() {
    for text in [
        include_str!("../../../mazes/cpm-1.maze"),
        include_str!("../../../mazes/cpm-2.maze"),
        include_str!("../../../mazes/cpm-3.maze"),
    ] {
        let course = Course::new("", tolman_maze::read(text).unwrap().maze, 0.25).unwrap();
        let config = walker_config(&epuck(), 0.25).unwrap();
        for walk in survey(&course, &epuck(), &config, 4).unwrap() {
            assert_eq!(walk.to, Some(walk.way.to), "from {:?}", walk.from);
            let degree = course.maze.degree(walk.way.to) as u32;
            assert_eq!(walk.sighting.degree, degree, "at {:?}", walk.to);
        }
    }
}

/// Branches are counted from the one by which the robot came, even if a bend leaves it askew in
/// a junction.
#[test]
fn the_first_branch_leads_back() {
    let text = "start = 0 0 north\n\n\
        o---o---o---o---o---o\n\
        |       |           |\n\
        o   o   o   o   o---o\n\
        |   |       |       |\n\
        o   o---o   o   o   o\n\
        |       |   | G |   |\n\
        o   o   o   o---o   o\n\
        |   |   |           |\n\
        o   o   o---o---o   o\n\
        | S |               |\n\
        o---o---o---o---o---o\n";
    let course = Course::new("", tolman_maze::read(text).unwrap().maze, 0.25).unwrap();
    let config = walker_config(&epuck(), 0.25).unwrap();
    let fragments = TrueFragments::of(&course.maze);
    for (from, out, way) in fragments.ways() {
        let start = course.in_cell(from, out.opposite());
        let body = course
            .robot_at(start, Epuck::new(epuck()).unwrap(), 2)
            .unwrap();
        let mut walker = Walker::new(body, config.clone());
        walker.begin().unwrap();
        for to in [way.to, from] {
            walker.walk(0, 0, None).unwrap();
            let end = walker.body().truth().pose.position;
            assert_eq!(course.world.cell_at(end), Some(to), "{from:?} by {way:?}");
        }
    }
}
