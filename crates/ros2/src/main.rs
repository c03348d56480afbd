//! A ROS 2 node in which any system of tolman drives a robot: it explores, maps, and drives to
//! goals. `docs/ros2.md` says how.

mod drawing;
mod link;
mod messages;
mod mounts;
mod navigation;
mod params;
mod pilot;
mod robot;
mod sightings;
mod watch;

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context as _, Result};
use tolman_arena::registry::Registry;

use crate::link::Link;
use crate::params::RosArguments;
use crate::pilot::Pilot;

const HELP: &str = "\
A ROS 2 node in which a system of tolman drives a robot, maps and goes to goals.

Usage: tolman-ros2 --ros-args --params-file FILE [-p NAME:=VALUE]… [-r FROM:=TO]…

It hears /scan, /odom and /tf_static, and drives by /cmd_vel. Ask it to explore:
  ros2 service call /tolman/explore std_srvs/srv/Trigger
It publishes /map, map → odom on /tf, /tolman/places and /tolman/state, and takes goals of nav2's
navigate_to_pose. docs/ros2.md lists all parameters. Exit codes: 0 help, 1 the robot or the system
failed, 2 bad parameters, 130 interrupted.";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words.iter().any(|word| word == "--help" || word == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        // Without a handler, Ctrl-C ends the node as it ends any program.
        let _ = signal_hook::flag::register(signal, Arc::clone(&stop));
    }
    let made = made(words, &stop);
    let (error, code) = match made {
        Ok(mut pilot) => match pilot.run() {
            Ok(()) => return ExitCode::SUCCESS,
            Err(error) => (error, 1),
        },
        Err(error) => (error, 2),
    };
    if stop.load(Ordering::Relaxed) {
        return ExitCode::from(130);
    }
    eprintln!("tolman: error: {error:#}");
    ExitCode::from(code)
}

/// Returns the pilot of the robot that the command line describes.
fn made(words: Vec<String>, stop: &Arc<AtomicBool>) -> Result<Pilot> {
    let arguments = RosArguments::parse(words)?;
    let params = arguments.params()?;
    let registry = Registry::tolman();
    let unknown = || {
        format!(
            "there is no system {}: `tolman systems` lists them",
            params.system
        )
    };
    let entry = registry.system(&params.system).with_context(unknown)?;
    let mut link = Link::join(&arguments, params.clone(), Arc::clone(stop))?;
    let (scan, mount) = link.first_scan()?;
    Pilot::new(entry, link, &scan, mount)
}
