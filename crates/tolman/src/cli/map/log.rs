//! `tolman map --log`: the way of a robot, found in its log.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::ValueEnum;
use tolman_draw::Figure;
use tolman_formats::{dot, graphml, node_link_json, route_geojson, tum};
use tolman_papers::real::{LogSystem, MapPicture, MappedLog, RobotLog, ros_map};

use crate::cli::bar::bar;
use crate::cli::{Failure, OrBadInput, file};

pub(super) const EXAMPLES: &str = "\
Into the folder go map.svg (occupancy, and both ways over it), trajectory.tum, odometry.tum and noted.tum (the way found, by the wheels, and as
the log notes it: time x y z qx qy qz qw, as evo reads them), and map.yaml with map.pgm, as map_server of ROS and `tolman run --world` read them; of a map of
places also places.graphml, places.dot, places.json (node-link, as networkx reads it) and places.geojson (for nav2_route).

Examples:
  tolman map --log logs/office.clf.gz --out office
  tolman map --log logs/office.clf.gz --system matching --out office-open
  tolman score --trajectory office/trajectory.tum --truth office/noted.tum";

/// What a log is mapped with.
#[derive(clap::Args)]
#[group(skip)]
pub(super) struct Arguments {
    /// The log, in the format of CARMEN, plain or packed by gzip
    #[arg(long, value_name = "FILE", required = true)]
    log: Option<PathBuf>,
    /// What finds the way
    #[arg(long, value_enum, default_value = "scan-matching")]
    system: System,
    /// The folder that the results go to; made if it is not there
    #[arg(long, value_name = "DIR", required = true)]
    out: Option<PathBuf>,
}

/// What finds the way of a robot in its log.
#[derive(Clone, Copy, ValueEnum)]
enum System {
    /// Scans are matched to those before, and to places seen before: the dense baseline
    ScanMatching,
    /// Scans are matched to those before; junctions, bends, dead ends and rooms are places, and recognized
    Places,
    /// Scans are matched to those before alone
    Matching,
    /// The wheels alone
    Odometry,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let Arguments {
        log: Some(path),
        out: Some(folder),
        system,
    } = arguments
    else {
        return Err(Failure::BadInput(anyhow!("give --log FILE and --out DIR")));
    };
    let log = RobotLog::read(path)
        .map_err(anyhow::Error::from_boxed)
        .or_bad_input()?;
    for sentence in log.report.sentences() {
        writeln!(out, "{sentence}")?;
    }
    let found = found(&log, *system)?;
    write_all(folder, &log, &found)?;
    for line in sentences(&found) {
        writeln!(out, "{line}")?;
    }
    writeln!(out, "The map: {}", folder.join("map.svg").display())?;
    Ok(())
}

/// What was found, a line each.
fn sentences(found: &MappedLog) -> Vec<String> {
    let MappedLog {
        closures,
        keyframes,
        places,
        ..
    } = found;
    let mut told = vec![format!(
        "keyframes: {}, closures: {closures}",
        keyframes.len()
    )];
    if !places.places.is_empty() {
        let (places, links) = (places.places.len(), places.links.len() / 2);
        told.push(format!("places: {places}, ways between them: {links}"));
    }
    told
}

/// Finds the way, with a bar on the terminal.
fn found(log: &RobotLog, system: System) -> Result<MappedLog, Failure> {
    let system = match system {
        System::ScanMatching => LogSystem::ScanMatching,
        System::Places => LogSystem::Places,
        System::Matching => LogSystem::Matching,
        System::Odometry => LogSystem::Odometry,
    };
    let template = "{bar:30} scan {pos} of {len}, {eta} to go";
    let progress = bar(u32::try_from(log.scans.len()).unwrap_or(u32::MAX), template);
    let found = log.map(system, &log.odometry(), |scans| {
        progress.set_position(scans as u64);
    });
    progress.finish_and_clear();
    found.or_bad_input()
}

fn write_all(folder: &Path, log: &RobotLog, found: &MappedLog) -> Result<(), Failure> {
    fs::create_dir_all(folder).with_context(|| {
        let folder = folder.display();
        format!("cannot make {folder}: give a folder in one that can be written to")
    })?;
    let write = |name: &str, contents: &[u8]| file::write(&folder.join(name), contents);
    let noted: Vec<_> = log.scans.iter().map(|scan| scan.noted).collect();
    for (name, poses) in [
        ("trajectory.tum", &found.poses),
        ("odometry.tum", &log.odometry()),
        ("noted.tum", &noted),
    ] {
        write(name, tum(&log.trajectory(poses)).as_bytes())?;
    }
    if !found.places.places.is_empty() {
        write("places.graphml", graphml(&found.places).as_bytes())?;
        write("places.json", node_link_json(&found.places).as_bytes())?;
        write("places.geojson", route_geojson(&found.places).as_bytes())?;
        write("places.dot", dot(&found.places).as_bytes())?;
    }
    let picture = MapPicture::of(log, &found.poses);
    let map = ros_map(&picture.occupancy);
    write("map.yaml", map.yaml("map.pgm").as_bytes())?;
    write("map.pgm", &map.pgm())?;
    let figure = Figure::new("map", "The way found in a log", picture.drawing(WIDTH)?);
    write("map.svg", figure.standalone().as_bytes())
}

/// Of the picture, in user units.
const WIDTH: f64 = 960.0;
