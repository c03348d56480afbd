//! `tolman map --log`: estimates the trajectory of a robot from its log.

use alloc::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use tolman_arena::registry::SystemEntry;
use tolman_draw::{Figure, Page, PageTable};
use tolman_formats::{
    G2o, G2oEdge, G2oPose, LogOptions, LogTimes, LogTopic, WholeLog, dot, graphml, input,
    node_link_json, route_geojson, tum,
};
use tolman_geom::path_length;
use tolman_maps::pose_graph::PoseGraph;
use tolman_papers::real::{GraphFile, LogMapper, MapPicture, MappedLog, RobotLog, ros_map};
use tolman_robot::MapLink;

use crate::cli::bar::bar;
use crate::cli::kind::Kind;
use crate::cli::outputs::{self, Output};
use crate::cli::replay_file::{self, Overwrite};
use crate::cli::{App, Failure, OrBadInput, Result, Unboxed, called, file};

pub(super) const EXAMPLES: &str = "\
The folder gets:
  report.html                     pictures and figures
  replay.html                     the log played beside its map
  map.svg                         occupancy, the trajectory and the odometry
  trajectory.tum                  the estimated trajectory, as evo reads it: time x y z qx qy qz qw
  odometry.tum, noted.tum         the wheels' trajectory and the one noted in the log, in the same format
  graph.g2o                       keyframes, odometry and closures, for `tolman audit`
  map.yaml, map.pgm               the map for map_server of ROS, and for `tolman run --world`
A map of places adds:
  places.graphml, places.dot
  places.json                     node-link, as networkx reads it
  places.geojson                  for nav2_route

Examples:
  tolman map --list logs/office.clf.gz
  tolman map --log logs/office.clf.gz --out office
  tolman map --log logs/office.clf.gz --system matching --out office-open
  tolman audit office/graph.g2o --out office-audit
  tolman map --log logs/office.clf.gz --closures office-audit/cleaned.g2o --out office-again
  tolman score --trajectory office/trajectory.tum --truth office/noted.tum";

/// Settings for mapping a log.
#[derive(clap::Args)]
#[group(skip)]
pub(super) struct Arguments {
    /// Log: lines of CARMEN or of Wean Hall, or a bag of ROS 1 or 2 (.bag, .mcap, .db3, or a
    /// folder); plain or packed by gzip, bzip2, xz or zstd
    #[arg(long, value_name = "FILE", required_unless_present = "list")]
    log: Option<PathBuf>,
    /// List the topics of a bag, or the kinds of lines of a log, instead of mapping it
    #[arg(long, value_name = "FILE", exclusive = true)]
    list: Option<PathBuf>,
    /// Topic of a bag's laser; repeat it to use several lasers [default: the one that saw most]
    #[arg(long, value_name = "TOPIC")]
    scan_topic: Vec<String>,
    /// Topic of a bag's odometry, or `/tf` [default: the one that moves]
    #[arg(long, value_name = "TOPIC")]
    odom_topic: Option<String>,
    /// Times of a bag's messages: those in their headers, or of their receipt [default: header, if
    /// they can be used]
    #[arg(long, value_enum, value_name = "WHICH")]
    times: Option<Times>,
    /// Maximum size of the log, unpacked
    #[arg(long, value_name = "MIB", default_value_t = input::MOST_BYTES >> 20, value_parser = clap::value_parser!(u64).range(1..=1 << 20))]
    most_mib: u64,
    /// System that estimates the trajectory; `tolman systems` lists those that map logs
    #[arg(long, value_name = "NAME", default_value = "scan-matching")]
    system: String,
    /// Use the closures of this graph instead of searching for them: the graph.g2o of an earlier
    /// run, as `tolman audit` cleaned it
    #[arg(long, value_name = "FILE")]
    closures: Option<PathBuf>,
    /// Folder for the results; made if it does not exist
    #[arg(long, value_name = "DIR", required_unless_present = "list", value_parser = outputs::folder(FILES))]
    out: Option<Output>,
}

/// Times of a bag's messages.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Times {
    Header,
    Receipt,
}

impl Arguments {
    fn options(&self) -> LogOptions {
        let mut options = LogOptions::whole();
        options.most = self.most_mib << 20;
        options.scan_topics.clone_from(&self.scan_topic);
        options.odom_topic.clone_from(&self.odom_topic);
        options.times = self.times.map(|times| match times {
            Times::Header => LogTimes::Header,
            Times::Receipt => LogTimes::Receipt,
        });
        options
    }
}

/// Names of the files in the folder.
const FILES: &[&str] = &[
    "trajectory.tum",
    "odometry.tum",
    "noted.tum",
    "graph.g2o",
    "places.graphml",
    "places.json",
    "places.geojson",
    "places.dot",
    "map.yaml",
    "map.pgm",
    "map.svg",
    "report.html",
    "replay.html",
];

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    if let Some(path) = &arguments.list {
        return list(path, arguments.most_mib << 20, out);
    }
    let Arguments {
        log: Some(path),
        out: Some(folder),
        system,
        ..
    } = arguments
    else {
        return Err(Failure::BadInput(anyhow!("give --log FILE and --out DIR")));
    };
    let mapper = mapper(app, system)?;
    let log = RobotLog::read_as(path, &arguments.options())
        .map_err(|error| explain(path, error.into()))
        .or_bad_input()?;
    for sentence in log.report.sentences() {
        writeln!(out, "{sentence}")?;
    }
    let found = found(&log, mapper, arguments.closures.as_deref())?;
    let picture = MapPicture::of(&log, &found.poses);
    let told = sentences(&found);
    let mapped = Mapped {
        path,
        log: &log,
        found: &found,
        picture: &picture,
        told: &told,
    };
    mapped.write_all(folder)?;
    for line in &told {
        writeln!(out, "{line}")?;
    }
    writeln!(out, "The report: {}", folder.join("report.html").display())?;
    match doubt(&found, &picture) {
        None => Ok(()),
        Some(doubt) => Err(Failure::Failed(anyhow!("the map is doubtful: {doubt}"))),
    }
}

/// Prints what a log holds.
fn list(path: &Path, most: u64, out: &mut dyn Write) -> Result {
    let topics = WholeLog::list(path, most).or_bad_input()?;
    for topic in topics {
        let LogTopic {
            name,
            kind,
            count,
            rate_hz,
            frame,
            ..
        } = &topic;
        let rate = rate_hz.map_or_else(String::new, |rate| format!("{rate:.1} Hz"));
        let line = format!("{name:<28} {kind:<34} {count:>8} ×  {rate:<10} {frame}");
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}

/// Returns the reason to doubt a map, by the mapper's own verdict or by the laser's readings;
/// `None` if there is none.
fn doubt(found: &MappedLog, picture: &MapPicture) -> Option<String> {
    let is_doubtful = found.certainty.is_some_and(|certainty| certainty < 0.5);
    let by_itself = is_doubtful.then(|| {
        "two of its places may be the same, or one of them may be two: the ways between them do not decide"
            .to_owned()
    });
    let doubled = found.doubled();
    let by_its_places = (doubled > 0).then(|| {
        let all = found.founded.len();
        format!("{doubled} of its {all} places lie where another one is: the robot did not recognize it when it came back")
    });
    by_itself.or(by_its_places).or_else(|| picture.doubt())
}

/// Returns the findings, one line each.
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
        let ends = |link: &MapLink| (link.from.min(link.to), link.from.max(link.to));
        let ways: BTreeSet<_> = places.links.iter().map(ends).collect();
        let (places, links) = (places.places.len(), ways.len());
        told.push(format!("places: {places}, ways between them: {links}"));
    }
    told
}

/// Returns the error of a file that is not a log, with the kind that it is, if known.
fn explain(path: &Path, error: anyhow::Error) -> anyhow::Error {
    match input::text(path) {
        Ok(text) if Kind::Log.is_not_of(&text) => {
            Kind::Log.explain(&text, &path.display().to_string(), error)
        }
        _ => error,
    }
}

/// Returns how the system called `name` maps a log.
fn mapper(app: &App, name: &str) -> Result<LogMapper> {
    let maps_logs = |system: &dyn SystemEntry| system.facts().log_mapper.is_some();
    let system = app
        .system(name, |_| true)
        .or_else(|_| app.system(name, maps_logs))?;
    system.facts().log_mapper.ok_or_else(|| {
        let maps = app.registry().systems.iter();
        let maps = maps.filter(|system| maps_logs(**system));
        let names: Vec<&str> = maps.map(|system| system.name()).collect();
        Failure::BadInput(anyhow!(
            "{name} maps no logs: {}; give --system with one of: {}",
            system.facts().why_no_log,
            names.join(", ")
        ))
    })
}

/// Returns the trajectory estimated from the log. Shows a progress bar on the terminal.
fn found(log: &RobotLog, mapper: LogMapper, closures: Option<&Path>) -> Result<MappedLog> {
    let audited = closures.map(GraphFile::read).transpose().or_bad_input()?;
    if audited.is_some() && mapper != LogMapper::ScanMatching {
        return Err(Failure::BadInput(anyhow!(
            "--closures goes with the system scan-matching alone; leave one of them out"
        )));
    }
    let template = "{bar:30} scan {pos} of {len}, {eta} to go";
    let progress = bar(u32::try_from(log.scans.len()).unwrap_or(u32::MAX), template);
    let see = |scans| progress.set_position(scans as u64);
    let found = match &audited {
        Some(audited) => log.map_with_closures(&audited.graph, &log.odometry(), see),
        None => log.map(mapper, &log.odometry(), see),
    };
    progress.finish_and_clear();
    found.unboxed().or_bad_input()
}

/// Results to write.
struct Mapped<'a> {
    path: &'a Path,
    log: &'a RobotLog,
    found: &'a MappedLog,
    picture: &'a MapPicture,
    /// Findings, one line each.
    told: &'a [String],
}

impl Mapped<'_> {
    fn write_all(&self, folder: &Path) -> Result {
        file::make_folder(folder, "give a folder in one that can be written to")?;
        let Self { log, found, .. } = self;
        let write = |name: &str, contents: &[u8]| file::write(&folder.join(name), contents);
        let noted: Vec<_> = log.scans.iter().map(|scan| scan.noted).collect();
        for (name, poses) in [
            ("trajectory.tum", &found.poses),
            ("odometry.tum", &log.odometry()),
            ("noted.tum", &noted),
        ] {
            write(name, tum(&log.trajectory(poses)).as_bytes())?;
        }
        if !found.graph.edges().is_empty() {
            write("graph.g2o", graph(&found.graph).text().as_bytes())?;
        }
        if !found.places.places.is_empty() {
            write("places.graphml", graphml(&found.places).as_bytes())?;
            write("places.json", node_link_json(&found.places).as_bytes())?;
            write("places.geojson", route_geojson(&found.places).as_bytes())?;
            write("places.dot", dot(&found.places).as_bytes())?;
        }
        let map = ros_map(&self.picture.occupancy);
        write("map.yaml", map.yaml("map.pgm").as_bytes())?;
        write("map.pgm", &map.pgm())?;
        let title = format!("The way found in {}", self.name());
        let figure = Figure::new("map", title, self.picture.drawing(WIDTH)?);
        write("map.svg", figure.standalone().as_bytes())?;
        write("report.html", self.report(&figure).as_bytes())?;
        let replay = found.replay(log, self.picture, &self.name());
        replay_file::write(&folder.join("replay.html"), replay, Overwrite::Anything)
    }

    fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    fn report(&self, figure: &Figure) -> String {
        let Self { log, found, .. } = self;
        let verdict = match doubt(found, self.picture) {
            None => "Nothing that the laser read speaks against the map.".to_owned(),
            Some(doubt) => format!("The map is doubtful: {doubt}."),
        };
        let way = path_length(&found.poses);
        let mut page = Page::new(format!("The map of {}", self.name()))
            .fact("scans", log.scans.len().to_string())
            .fact("way", format!("{way:.0} m"))
            .fact("closures", found.closures.to_string())
            .fact(
                "beams that end on floor",
                format!("{:.1} %", 100.0 * self.picture.contradicted),
            )
            .text(verdict)
            .figure(figure)
            .text("replay.html plays the log: what the laser read, the map as it grew, and the way by the wheels.");
        let all = self.told.iter().cloned().chain(log.report.sentences());
        let rows = all.fold(
            PageTable::new("What was read and found", ["in words"]),
            |table, line| table.row([line]),
        );
        page = page.table(&rows);
        page.text(format!("Made by {}", called::command())).html()
    }
}

/// Returns a pose graph as the contents of a file.
fn graph(graph: &PoseGraph) -> G2o {
    let poses = (0..).zip(graph.poses());
    let edges = graph.edges().iter();
    G2o {
        poses: poses
            .map(|(id, pose)| G2oPose { id, pose: *pose })
            .collect(),
        edges: edges
            .map(|edge| G2oEdge {
                from: edge.from.into(),
                to: edge.to.into(),
                measured: edge.measured,
                information: edge.information,
                line: 0,
            })
            .collect(),
        fixed: Vec::new(),
        left_out: Vec::new(),
    }
}

/// Width of the picture, user units.
const WIDTH: f64 = 960.0;
