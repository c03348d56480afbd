//! Bodies in random worlds, under random commands.

use proptest::prelude::*;
use tolman_geom::{Heading, Point, Pose};
use tolman_maze::{Cell, Maze};
use tolman_robot::Body;
use tolman_sim::{
    Chance, CommandError, Contact, Door, DoorState, Model, Motion, Simulation, Surroundings,
    WallSegment, World,
};

use crate::worlds::{maze, size};

/// A robot that does as it is told and senses nothing.
#[derive(Clone, Debug)]
struct Blind {
    body: Body,
    contact: Contact,
}

impl Model for Blind {
    type Command = Motion;
    type Sensing = ();

    fn body(&self) -> &Body {
        &self.body
    }

    fn contact(&self) -> Contact {
        self.contact
    }

    fn step_us(&self) -> u64 {
        100_000
    }

    fn check(&self, _: &Motion) -> Result<(), CommandError> {
        Ok(())
    }

    fn motion(&mut self, command: &Motion, _: &Chance) -> Motion {
        *command
    }

    fn silent(&self) {}

    fn sense(&mut self, _: &Surroundings<'_>, _: &Chance, (): &mut ()) {}
}

/// Discs and convex polygons that fit a corridor of 0.6 m.
fn body() -> impl Strategy<Value = Body> {
    let polygon = (3_u32..8, 0.05..0.25, 0.3..1.0).prop_map(|(count, radius, squeeze)| {
        let corner = |index: u32| {
            let turn = core::f64::consts::TAU / f64::from(count);
            let unit = Heading::from_radians(f64::from(index) * turn).unit();
            Point::new(radius * unit.x, radius * squeeze * unit.y)
        };
        Body::Polygon {
            corners: (0..count).map(corner).collect(),
        }
    });
    prop_oneof![
        (0.02..0.28).prop_map(|radius| Body::Circle { radius }),
        polygon
    ]
}

fn blind() -> impl Strategy<Value = Blind> {
    (
        body(),
        prop_oneof![Just(Contact::Stop), Just(Contact::Slide)],
    )
        .prop_map(|(body, contact)| Blind { body, contact })
}

/// Returns short and very long steps, straight, turning or both.
fn motion() -> impl Strategy<Value = Motion> {
    let distance = prop_oneof![Just(0.0), -0.3..0.3, -4.0..4.0];
    let turn = prop_oneof![Just(0.0), -0.5..0.5, -6.0..6.0];
    (distance, turn).prop_map(|(distance, turn)| Motion { distance, turn })
}

fn reaches(maze: &Maze, from: Cell, to: Cell) -> bool {
    let mut goal = maze.clone();
    goal.set_goals(vec![to]);
    goal.steps_to_goal()[maze.grid().index(from)].is_some()
}

fn differ(a: Pose, b: Pose, body: &Body) -> f64 {
    let turn = if matches!(body, Body::Circle { .. }) {
        0.0
    } else {
        a.heading.turn_to(b.heading)
    };
    (a.position - b.position).norm() + turn.abs() * body.radius()
}

proptest! {
    /// Whatever the commands and step lengths, robots overlap neither walls nor each other and stay
    /// in the cells they can reach. They bump exactly when their motion was cut.
    #[test]
    fn bodies_pass_through_nothing(
        maze in maze(),
        size in size(),
        robots in prop::collection::vec(blind(), 1..4),
        motions in prop::collection::vec(motion(), 3..60),
    ) {
        let world = World::from_maze(&maze, &size).unwrap();
        let mut sim = Simulation::new(world, 1);
        let mut starts = Vec::new();
        for (robot, cell) in robots.into_iter().zip(maze.grid().cells()) {
            let pose = Pose::new(sim.world().cell_centre(cell), Heading::EAST);
            starts.push((sim.add(robot, pose).unwrap(), cell));
        }
        for motions in motions.chunks_exact(starts.len()) {
            let before: Vec<Pose> = starts.iter().map(|(robot, _)| sim.truth(*robot).pose).collect();
            sim.step(motions).unwrap();
            for (((robot, _), before), motion) in starts.iter().zip(before).zip(motions) {
                let truth = *sim.truth(*robot);
                let body = sim.model(*robot).body();
                prop_assert!(sim.world().clear_for(body, truth.pose), "{:?}", truth);
                let free = before.displaced(motion.distance, motion.turn);
                let cut = differ(free, truth.pose, body);
                if truth.bump {
                    prop_assert!(cut > 1e-13, "{:?} {}", truth, cut);
                } else {
                    prop_assert!(cut <= 0.0, "{:?} {}", truth, cut);
                }
            }
            for (index, (robot, _)) in starts.iter().enumerate() {
                // Standing still, a robot can be put down where it is: it overlaps no other.
                let pose = sim.truth(*robot).pose;
                prop_assert!(sim.place(*robot, pose).is_ok(), "robot {index} overlaps another");
            }
        }
        for (robot, start) in &starts {
            let here = sim.world().cell_at(sim.truth(*robot).pose.position).unwrap();
            prop_assert!(reaches(&maze, *start, here), "from {start} through a wall to {here}");
        }
    }

    /// A body that touches a wall can always leave it.
    #[test]
    fn contact_does_not_hold(robot in blind(), heading in -0.7..0.7_f64) {
        let (body, contact) = (robot.body.clone(), robot.contact);
        let wall = WallSegment::between(Point::new(2.0, -5.0), Point::new(2.0, 5.0));
        let world = World::from_segments(vec![wall]).unwrap();
        let mut sim = Simulation::new(world, 1);
        let start = Pose::new(Point::new(0.0, 0.0), Heading::from_radians(heading));
        let id = sim.add(robot, start).unwrap();
        sim.step(&[Motion { distance: 4.0, turn: 0.0 }]).unwrap();
        prop_assert!(sim.truth(id).bump);
        let touching = sim.truth(id).pose.position.x;
        prop_assert!(touching > 2.0 - body.radius() - 1e-5);
        if contact == Contact::Slide {
            let along = 4.0 * start.heading.unit().y;
            prop_assert!((sim.truth(id).pose.position.y - along).abs() < 1e-9);
        }
        sim.step(&[Motion { distance: -0.5, turn: 0.0 }]).unwrap();
        prop_assert!(!sim.truth(id).bump, "{:?}", sim.truth(id));
    }
}

#[test]
fn a_door_waits_for_the_body_in_it() {
    let walls = vec![WallSegment::between(
        Point::new(0.0, 0.0),
        Point::new(4.0, 0.0),
    )];
    let door = Door {
        name: "north".to_owned(),
        start: Point::new(2.0, 0.0),
        end: Point::new(2.0, 1.0),
        material: tolman_sim::Material::default(),
        state: DoorState::Open,
        schedule: vec![tolman_sim::DoorEvent {
            time_us: 200_000,
            state: DoorState::Shut,
        }],
    };
    let world = World::from_segments(walls)
        .unwrap()
        .with_door(door)
        .unwrap();
    let mut sim = Simulation::new(world, 1);
    let blind = Blind {
        body: Body::Circle { radius: 0.2 },
        contact: Contact::Stop,
    };
    let start = Pose::new(Point::new(1.5, 0.5), Heading::EAST);
    let robot = sim.add(blind, start).unwrap();
    let ahead = [Motion {
        distance: 0.32,
        turn: 0.0,
    }];
    let mut states = Vec::new();
    for _ in 0..3 {
        sim.step(&ahead).unwrap();
        states.push((sim.door("north").unwrap(), sim.truth(robot).bump));
    }
    // At 0.2 s the robot stands in the door; at 0.3 s it has stepped out of it.
    sim.step(&[Motion::default()]).unwrap();
    states.push((sim.door("north").unwrap(), sim.truth(robot).bump));
    let (open, shut) = (DoorState::Open, DoorState::Shut);
    assert_eq!(
        states,
        [(open, false), (open, false), (open, false), (shut, false)]
    );

    sim.step(&[Motion {
        distance: -2.0,
        turn: 0.0,
    }])
    .unwrap();
    assert!(sim.truth(robot).bump, "a shut door is a wall");
    sim.set_door("north", open).unwrap();
    sim.step(&[Motion {
        distance: -2.0,
        turn: 0.0,
    }])
    .unwrap();
    assert!(!sim.truth(robot).bump);
    assert_eq!(sim.door("south").unwrap_err().name, "south");
}
