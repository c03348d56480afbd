//! A mapper on a robot of your own: scans correct wheels that count 8 % too much.

use tolman_geom::{Heading, Point, Pose};
use tolman_maps::scan_matching::{ScanMatching, ScanMatchingConfig, ScanStep};
use tolman_robot::{LaserSensing, Mapper, Odometry, Ring, Robot, Scan, TurnTranslate};

/// A rover in a room of 5 m × 3 m, south-west corner at the origin.
struct Rover(Pose, LaserSensing);

/// Returns the range at `bearing`, m.
fn range(pose: Pose, bearing: f64) -> f64 {
    let ray = pose.heading.turned(bearing).unit();
    let along = |from: f64, to: f64, step: f64| (if step > 0.0 { to } else { 0.0 } - from) / step;
    along(pose.position.x, 5.0, ray.x).min(along(pose.position.y, 3.0, ray.y))
}

impl Robot for Rover {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = core::convert::Infallible;

    fn sensing(&self) -> &LaserSensing {
        &self.1
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Self::Error> {
        let turn = command.turn;
        self.0 = self.0.displaced(command.translate, turn);
        let ring = Ring::full(180, 8.0);
        let ranges = (0..ring.beams).map(|beam| range(self.0, ring.bearing(beam)));
        let ranges = ranges.collect();
        self.1.scan = Some(Scan { ring, ranges });
        let distance = 1.08 * command.translate;
        self.1.odometry = Some(Odometry { distance, turn });
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let pose = Pose::new(Point::new(0.5, 1.2), Heading::EAST);
    let mut rover = Rover(pose, LaserSensing::silent(Ring::full(180, 8.0)));
    let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
    let (turn, translate) = (0.01, 0.09);
    for _ in 0..40 {
        rover.step(&TurnTranslate { turn, translate })?;
        let sensed = rover.sensing();
        if let (Some(scan), Some(odometry)) = (&sensed.scan, sensed.odometry) {
            mapper.observe(&ScanStep {
                moved: odometry.applied_to(Pose::IDENTITY),
                scan: scan.clone(),
                robot_from_laser: Pose::IDENTITY,
            })?;
        }
    }
    let way = mapper.trajectory();
    let mapped = (way[39].position - way[0].position).norm();
    // 39 steps along an arc, of which the wheels count 3.79 m.
    assert!((mapped - 3.49).abs() < 0.03, "{mapped}");
    Ok(())
}
