use super::places::Gathered;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_arena::gngslam::GoalRecords;
use tolman_geom::*;
use tolman_maps::place_map::PlaceRecord;
use tolman_maze::Cell;
use tolman_robot::*;
const COLOURS: [[u8; 3]; 4] = [[220, 20, 20], [230, 220, 30], [20, 200, 60], [20, 40, 220]];
fn meet(from: Point, d: Vector) -> (usize, f64) {
    let to = |a: f64, s: f64| if s > 1e-9 { a / s } else { 1e9 };
    let t = [
        to(4.0 - from.x, d.x),
        to(4.6 - from.y, d.y),
        to(from.x, -d.x),
        to(from.y, -d.y),
    ];
    let w = (1..4).fold(0, |a, b| if t[b] < t[a] { b } else { a });
    (w, t[w])
}
fn record(pose: Pose, odo: Pose, rng: &mut ChaCha8Rng) -> PlaceRecord {
    let mut p = Picture::black(160, 120, pioneer_2dx::CAMERA);
    for c in 0..160 {
        let (w, d) = meet(
            pose.position,
            pose.heading.turned(p.leftward(c).atan()).unit(),
        );
        for r in 0..120 {
            let up = p.upward(r) * d;
            let mut col = if up > 0.1 {
                COLOURS[w]
            } else if up > -0.3 {
                [230, 230, 230]
            } else {
                [30, 120, 30]
            };
            for v in &mut col {
                *v = v.saturating_add(rng.random_range(0..12u8));
            }
            p.pixels[(r * 160 + c) as usize] = col;
        }
    }
    let s = pioneer_2dx::sonar_mounts().map(|m| Sounding {
        mount: m,
        half_width: 0.1,
        range: (meet(
            pose.position,
            pose.heading.turned(m.heading.radians()).unit(),
        )
        .1 + rng.random_range(-0.1..0.1))
        .min(5.0),
        max_range: 5.0,
    });
    PlaceRecord {
        odometry: odo,
        snapshot: Snapshot {
            soundings: s.into(),
            picture: Some(p),
        },
    }
}
pub(super) fn gather(seed: u64) -> Gathered {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut pose = Pose::new(Point::new(2.0, 2.0), Heading::from_degrees(30.0));
    let start = pose;
    let mut drift = Vector::new(0.0, 0.0);
    let (mut records, mut cells) = (vec![], vec![]);
    let mut odo_of =
        |p: Pose, d: Vector| Pose::new(start.inverse().transform(p.position + d), p.heading);
    for _ in 0..1006 {
        let h = loop {
            let h = Heading::from_degrees(rng.random_range(-180.0..180.0));
            if meet(pose.position, h.unit()).1 > 1.2 {
                break h;
            }
        };
        let (_, d) = meet(pose.position, h.unit());
        let stop = rng.random_range(0.4..1.1);
        pose = Pose::new(pose.position + (d - stop) * h.unit(), h);
        drift += Vector::new(rng.random_range(-0.03..0.03), rng.random_range(-0.03..0.03));
        let o = odo_of(pose, drift);
        records.push(record(pose, o, &mut rng));
        cells.push(Cell::new(
            (pose.position.x / 0.5) as u16,
            (pose.position.y / 0.575) as u16,
        ));
    }
    for (y, deg) in [(0.8, -90.0), (3.8, 90.0)] {
        let p = Pose::new(Point::new(2.0, y), Heading::from_degrees(deg));
        let o = odo_of(p, Vector::zeros());
        records.push(record(p, o, &mut rng));
    }
    Gathered {
        records,
        cells,
        goals: GoalRecords {
            blue: 1006,
            yellow: 1007,
        },
    }
}
