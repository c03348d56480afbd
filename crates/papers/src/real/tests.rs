//! Tests on the small log, which is always available.

use tolman_geom::Pose;

use super::small::Small;
use super::trajectories::aligned;
use super::{LogMapper, RobotLog};

/// Returns every third scan of the small log: one per second.
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
    let found = log.map(LogMapper::Places, &odometry, |_| {}).unwrap();
    let rms = aligned(&found.poses, &truth).unwrap().rms;
    assert!(wheels > 2.0 && rms < 0.2, "{wheels} {rms}");
    assert!(found.closures > 1, "{}", found.closures);
    // There are fewer places than visits, because the robot went round twice.
    assert!(found.places.places.len() > 3, "{:?}", found.places);
}

#[test]
fn every_mapper_that_is_told_of_the_places_knows_them_again() {
    let log = Small::read().unwrap().log;
    let odometry = log.odometry();
    let truth: Vec<Pose> = log.scans.iter().map(|scan| scan.noted).collect();
    let places = log.map(LogMapper::Places, &odometry, |_| {}).unwrap();
    for system in [LogMapper::Diktiometry, LogMapper::Cpm] {
        let found = log.map(system, &odometry, |_| {}).unwrap();
        assert_eq!(found.places.places.len(), places.places.places.len());
        assert_eq!(found.doubled(), 0, "{system:?}");
        for [before, here] in found.recognized() {
            let [there, here] = [before, here].map(|keyframe| truth[found.keyframes[keyframe]]);
            let off = (there.position - here.position).norm();
            assert!(off < 2.0, "{system:?}: {off} m apart");
        }
    }
}

#[test]
fn a_mapper_that_meets_places_again_and_does_not_know_them_says_so() {
    let log = Small::read().unwrap().log;
    let found = log
        .map(LogMapper::PlaceGraph, &log.odometry(), |_| {})
        .unwrap();
    assert!(found.doubled() > 0 && found.places.places.len() > 8);
}
