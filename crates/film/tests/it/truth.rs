//! Replays tell the truth about every system.

use tolman_arena::contest::{Condition, Contest, Moment, ShowRecord};
use tolman_arena::course::Course;
use tolman_arena::registry::{Registry, Schooling, SystemEntry};
use tolman_film::Film;
use tolman_geom::Point;
use tolman_replay::{MapEdge, MapGrowth, MapNode, Replay, json};

const FORK: &str = "\
name = Fork
o---o---o---o
|         G |
o   o---o---o
|           |
o   o---o   o
| S |   |   |
o---o---o---o
";

const RING: &str = "\
name = Ring
o---o---o---o
|           |
o   o---o   o
|   |   |   |
o   o---o   o
| S       G |
o---o---o---o
";

/// A system that was shown in a world.
struct Shown {
    record: ShowRecord,
    replay: Replay,
    course: Course,
}

fn shown(contestant: &'static dyn SystemEntry, world: &str, schooling: &Schooling) -> Shown {
    let file = tolman_maze::read(world).unwrap();
    let (maze, name) = (file.maze, file.name.unwrap());
    let contest = Contest {
        contestant,
        robot: None,
        maze: &maze,
        name: &name,
        condition: Condition::AsMade,
        starts: 1,
        seed: 3,
        stopwatch: None,
    };
    let (mut film, mut ended) = (None, None);
    let record = contest.show(schooling, |outing, moment| match moment {
        Moment::Begun => film = Some(Film::new(outing)),
        Moment::Acted => film.iter_mut().for_each(|film| film.see(outing)),
        Moment::PutDown => film.iter_mut().for_each(|film| film.lifted(outing)),
        Moment::Over => {
            let replay = film.take().map(|film| film.replay(outing, name.clone()));
            ended = replay.map(|replay| (replay, outing.course().clone()));
        }
    });
    let (replay, course) = ended.unwrap();
    Shown {
        record: record.unwrap(),
        replay,
        course,
    }
}

/// Calls `test` with every system that learns, shown in a world.
fn each(world: &str, mut test: impl FnMut(&str, &Shown)) {
    let schooling = Schooling::default();
    for system in Registry::current().learners() {
        test(system.name(), &shown(system, world, &schooling));
    }
}

fn place(node: &MapNode, step: u32) -> Point {
    let moved = node.moves.iter().rfind(|moved| moved.step <= step);
    moved.map_or(node.position, |moved| moved.position)
}

/// Returns the corners of an edge when it was born, with its ends.
fn line(map: &MapGrowth, edge: &MapEdge) -> Vec<Point> {
    let end = |id: u32| {
        place(
            map.nodes.iter().find(|node| node.id == id).unwrap(),
            edge.born,
        )
    };
    let way = edge.way.iter().copied();
    [end(edge.a)]
        .into_iter()
        .chain(way)
        .chain([end(edge.b)])
        .collect()
}

/// Returns whether two lines cross at one point inside both.
fn crosses([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |from: Point, to: Point, at: Point| (to - from).perp(&(at - from));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[test]
fn what_is_shown_of_a_map_is_where_the_robot_was() {
    each(RING, |told, Shown { replay, course, .. }| {
        let track = &replay.tracks[0];
        let map = &track.maps[0];
        assert!(!map.nodes.is_empty(), "{told}");
        for node in &map.nodes {
            let at = node.latest();
            let far = track.poses.iter().map(|pose| (pose.position - at).norm());
            let far = far.fold(f64::INFINITY, f64::min);
            assert!(
                far < 0.5 * course.corridor_width,
                "{told}: {far} m at {node:?}"
            );
        }
        let growth = track.maps.iter().flat_map(|map| &map.nodes);
        let births: Vec<u32> = growth.map(|node| node.born).collect();
        assert!(
            births.iter().any(|born| *born != births[0]),
            "{told}: {births:?}"
        );
        for edge in &map.edges {
            for piece in line(map, edge).windows(2) {
                let piece = [piece[0], piece[1]];
                let mut walls = replay.scenery.walls.iter();
                let wall = walls.find(|wall| crosses(piece, **wall));
                assert!(wall.is_none(), "{told}: {piece:?} crosses {wall:?}");
            }
        }
    });
}

#[test]
fn a_goal_is_labelled_once_it_was_found_and_no_way_to_it_is_shorter_than_the_shortest() {
    each(
        FORK,
        |name,
         Shown {
             record,
             replay,
             course,
         }| {
            let track = &replay.tracks[0];
            let mut poses = track.poses.iter();
            let there = poses.position(|pose| course.is_destination(pose.position));
            let labels = track.maps[0].nodes.iter().flat_map(|node| &node.labels);
            let first = labels.map(|label| label.step as usize).min();
            // Mice are told where the goal is.
            let is_told = ["micromouse", "wall-belief"].contains(&name);
            assert!(
                is_told || first.is_none_or(|first| Some(first) >= there),
                "{name}: {first:?}"
            );
            if let Some(home) = record.home {
                assert!(record.shortest <= home, "{name}: {record:?}");
                assert!(
                    // It may have found itself at the goal.
                    first.is_some() && (record.shortest > 0.0) == (home > 0.0),
                    "{name}: {record:?}"
                );
            }
        },
    );
}

#[test]
fn a_replay_with_fewer_steps_tells_the_same() {
    let mslst = Registry::current().system("mslst").unwrap();
    let Shown { replay, .. } = shown(mslst, FORK, &Schooling::default());
    let thinned = replay.clone().thinned(20);
    assert!(thinned.steps() <= 20 && thinned.steps() > 10);
    let [before, after] = [&replay, &thinned].map(|replay| &replay.tracks[0]);
    assert_eq!(before.poses.last(), after.poses.last());
    assert_eq!(before.maps[0].nodes.len(), after.maps[0].nodes.len());
    assert_eq!(before.lifts.len(), after.lifts.len());
    // The pose after a lift is one from where the robot was put down.
    let lift = thinned.nanos(after.lifts[0]);
    assert!(lift >= replay.nanos(before.lifts[0]));
    json(&thinned).unwrap();
    assert_eq!(replay.clone().thinned(replay.steps()), replay);
}
