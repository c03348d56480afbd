//! The small log, which is always here.

use tolman_geom::Pose;

use super::small::Small;
use super::trajectories::aligned;
use super::{LogSystem, RobotLog};

/// Every third scan of the small log, which is as far as a robot comes in a second.
fn log() -> RobotLog {
    let log = Small::read().unwrap().log;
    RobotLog {
        scans: log.scans.into_iter().step_by(3).collect(),
        report: log.report,
    }
}

#[test]
fn places_seen_again_are_recognized_and_none_that_were_not() {
    let log = log();
    let truth: Vec<Pose> = log.scans.iter().map(|scan| scan.noted).collect();
    let odometry = log.odometry();
    let wheels = aligned(&odometry, &truth).unwrap().rms;
    let found = log.map(LogSystem::Places, &odometry, |_| {}).unwrap();
    let rms = aligned(&found.poses, &truth).unwrap().rms;
    assert!(wheels > 2.0 && rms < 0.2, "{wheels} {rms}");
    assert!(found.closures > 1, "{}", found.closures);
    // Fewer places than visits, since it went round twice.
    assert!(found.places.places.len() > 3, "{:?}", found.places);
}
