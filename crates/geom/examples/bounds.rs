//! Bounds on a pose: how dead reckoning loses its way, and how a known place brings it back.
#![expect(clippy::print_stdout, reason = "its table is its result")]

use tolman_geom::{Interval, IntervalError, Point, PointBox, Pose, PoseBox};

fn main() -> Result<(), IntervalError> {
    // Two metres ahead give or take 5 cm, then to the left by 90° give or take 1°.
    let degrees = |value: f64| value.to_radians();
    let leg = PoseBox::new(
        PointBox::new(Interval::about(2.0, 0.05)?, Interval::ZERO),
        Interval::about(degrees(90.0), degrees(1.0))?,
    );
    println!("legs  known to within");
    let mut world_from_robot = PoseBox::IDENTITY;
    for number in 1..=8 {
        world_from_robot = world_from_robot.compose(leg);
        let width = world_from_robot.position.width();
        println!("{number:4}  {width:.2} m");
    }
    // Twice round a square: it may be at the start, and nothing says that it is.
    let start = Pose::new(Point::origin(), world_from_robot.middle().heading);
    assert!(world_from_robot.contains(start));

    // A camera knows the start within 5 cm and 2°. What both say is narrower than either.
    let seen = PoseBox::about(start, 0.05, degrees(2.0))?;
    let known = world_from_robot.position.intersection(seen.position);
    let width = known.map(PointBox::width);
    println!("seen  {:.2} m", width.unwrap_or(f64::NAN));
    assert!(width.is_some_and(|width| width <= seen.position.width()));
    Ok(())
}
