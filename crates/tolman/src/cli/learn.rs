//! `tolman learn`: a system learns a map of a maze.

use core::slice;
use core::sync::atomic::Ordering;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use serde_json::json;
use tolman_arena::Outing;
use tolman_arena::contest::{Claim, Evidence, TrueVisits};
use tolman_arena::run::{self, TaskEnd};
use tolman_robot::{Landmark, Standing, Task};

use super::looks::Looks;
use super::map::{of_text, text};
use super::outputs::{self, Output};
use super::send::{ARRIVE, Pursued, check_origin, send};
use super::sent_out::SentOut;
use super::unfinished::{Former, FormerMap, Keeper};
use super::words::words;
use super::{App, Failure, OrBadInput, Result, Unboxed, file, interrupt};
use tolman_arena::registry::{
    DrivesBy, LearnedMap, MapText, Schooling, Settings, Setup, Start, SystemEntry,
};

/// Lets a system learn a map of a maze or a world, and writes the map to a file
#[derive(clap::Args)]
#[command(after_help = "\
Exit code 1: no map was learned, or the map that was written is known to be wrong or unfinished.
`tolman systems` lists systems, presets and robots, `tolman systems NAME` also the settings for --set.

Ctrl-C writes the map so far, and saves the run beside it. --from FILE.unfinished continues that run. The map is
then the same, bit for bit, as without the interruption.

Examples:
  tolman learn --system mslst --preset j --maze mazes/j.maze --out j-map.json
  tolman learn --system cpm-better --maze mazes/cpm-3.maze --out map.json --replay learned.html
  tolman learn --system gng-slam-better --world mazes/worlds/pitch.json --out pitch-map.json --replay learned.html
  tolman learn --system diktiometry-better --maze mazes/j-long.maze --set moves=300 --out j-survey.json
  tolman learn --system diktiometry-better --maze mazes/j-long.maze --from j-survey.json --out j-survey.json
  tolman learn --system cpm-better --robot laser-pioneer --world mazes/worlds/corridors.json --out corridors-map.json")]
pub(super) struct Arguments {
    /// System that learns
    #[arg(long, value_name = "NAME")]
    system: String,
    #[command(flatten)]
    sent_out: SentOut,
    /// When to stop learning
    #[arg(long, default_value = "explored", value_parser = words(UNTIL))]
    until: Task,
    /// Continue from a map learned before, or from an interrupted run; for a run, repeat all other
    /// options as they were
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
    /// Continue the map in another maze, or with another robot
    #[arg(long, requires = "from")]
    anyway: bool,
    /// Map file to write
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["json"]))]
    out: Output,
    /// Save the run to this file once a second, to continue it after an interruption [default: the
    /// name of --out with .unfinished appended]
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["unfinished", "json"]))]
    unfinished: Option<Output>,
    #[command(flatten)]
    looks: Looks,
}

/// Map or run that learning continues from.
#[derive(Default)]
struct From {
    map: Option<MapText>,
    former: Option<Former>,
}

impl From {
    /// Reads a map, or an interrupted run with the map that it continued.
    fn read(path: &Path) -> Result<Self> {
        let text = text(path)?;
        let former = Former::of_text(path, &text)?;
        let map = match &former {
            Some(former) => former.map().map(|map| of_text(&map.name, &map.text)),
            None => Some(of_text(path, &text)),
        };
        Ok(Self {
            map: map.transpose()?,
            former,
        })
    }
}

impl Arguments {
    /// Returns the keeper that saves the run if it is interrupted.
    fn keeper(
        &self,
        outing: &dyn Outing,
        system: &str,
        from: Option<&MapText>,
        former: Option<Former>,
    ) -> Result<Keeper> {
        let until = UNTIL.iter().find(|(_, _, task)| *task == self.until);
        let call = self.sent_out.call("learn", system, outing);
        let call = call
            .with("--until", until.map(|(word, ..)| word))
            .with("--anyway", self.anyway.then_some("given"));
        let path = self.unfinished.as_deref().map(Path::to_owned);
        let path = path.unwrap_or_else(|| {
            let mut name = self.out.as_os_str().to_owned();
            name.push(".unfinished");
            name.into()
        });
        if self.unfinished.is_none() {
            outputs::note("unfinished", &path)?;
        }
        let map = from.map(|map| FormerMap {
            name: map.name.clone().into(),
            text: map.text.clone(),
        });
        Ok(Keeper::new(path, call, former)?.with_map(map))
    }
}

/// Values of `--until`: when a system has learned enough.
const UNTIL: [(&str, &str, Task); 2] = [
    ("explored", "It has nothing left to learn", Task::Explore),
    ("goal", "The goal is found", ARRIVE),
];

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let system = app.system(&arguments.system, |system| system.learns())?;
    let from = arguments.from.as_deref().map(From::read).transpose()?;
    let From { map: from, former } = from.unwrap_or_default();
    let terrain = arguments.sent_out.terrain()?;
    let schooling = Schooling::default();
    // A map is continued by the robot that learned it.
    let usual = match &from {
        Some(map) => &map.origin.robot,
        None => system.facts().own_robot,
    };
    let robot = arguments.sent_out.robot(app, system, usual)?;
    let mut setup = arguments.sent_out.setup(&terrain, robot, &schooling);
    setup.from = from.as_ref();
    let context = || format!("{} cannot learn {}", system.name(), setup.world);
    let outing = system.learner(&setup);
    let mut outing = outing.unboxed().with_context(context).or_bad_input()?;
    if let (Some(from), false) = (&from, arguments.anyway) {
        check_origin(from, &*outing)?;
    }
    let task = arguments.until;
    let keeper = arguments.keeper(&*outing, system.name(), from.as_ref(), former)?;
    let looks = &arguments.looks;
    let mut been = TrueVisits::default();
    let see = |outing: &dyn Outing, before| been.note(outing, before);
    let pursued = send(
        &mut *outing,
        task,
        &setup,
        system.name(),
        looks,
        keeper,
        see,
    );
    let truth = been.evidence(&*outing, 0);
    // The judge has to know where the robot was before, too.
    let is_known = from.as_ref().is_none_or(|map| map.truth.is_some());
    let truth = match from.as_ref().and_then(|map| map.truth.clone()) {
        Some(before) => before.then(truth),
        None => truth,
    };
    let text = outing.map_file().unboxed()?;
    let text = text.map(|text| MapText::with_truth(&text, &truth));
    let text = text.transpose()?;
    if let (Err(Failure::Interrupted(_)), Some(text)) = (&pursued, &text) {
        file::write(&arguments.out, text)?;
    }
    let Pursued {
        ended, told, saved, ..
    } = pursued?;
    let own = Claim::complaint(&ended.end, task, &*outing);
    let Some(text) = text else {
        saved.remove();
        let why = own.unwrap_or_else(|| "it keeps none".to_owned());
        return Err(Failure::Failed(anyhow!(
            "no map of {} was learned: {why}",
            setup.world
        )));
    };
    let map = of_text(&arguments.out, &text)?;
    let map = system.map(&map).unboxed()?;
    if let Err(Failure::Failed(error)) = file::write(&arguments.out, &text) {
        return Err(Failure::Failed(anyhow!("{error:#}; {}", saved.told())));
    }
    saved.remove();
    let own = match system.facts().tried && task == Task::Explore && own.is_none() {
        true => tried(system, &of_text(&arguments.out, &text)?, &setup)?,
        false => own,
    };
    let is_judged = task == Task::Explore && is_known;
    let verdict = Verdict::of(system, &*outing, &*map, is_judged.then_some(&truth), own);
    let json = || {
        json!({
            "system": system.name(),
            "maze": setup.world,
            "seed": setup.seed,
            "steps": ended.steps,
            "actions": ended.actions,
            "bumps": outing.bumped().len(),
            "right": verdict.judged.as_ref().map(Option::is_none),
            "complaint": verdict.complaint,
            "map": map.json(),
        })
    };
    looks.tell(out, json, |out| {
        writeln!(out, "{told}")?;
        for line in map.lines().iter().take(MOST_LINES) {
            writeln!(out, "{line}")?;
        }
        if system.facts().drives != DrivesBy::AnyMap {
            let name = system.name();
            writeln!(out, "{name} does not drive by a map from a file")?;
        }
        match (&verdict.judged, &verdict.complaint) {
            (Some(Some(found)), None) => writeln!(out, "as a map of places: {found}"),
            _ => Ok(()),
        }
    })?;
    match verdict.complaint {
        None => Ok(()),
        Some(complaint) => Err(Failure::Failed(anyhow!(
            "the map in {} is wrong or unfinished: {complaint}",
            arguments.out.display()
        ))),
    }
}

/// Sends a robot from a random place to the goal by a learned map, and returns why it does not
/// arrive; `None` if it does.
///
/// # Errors
/// If the drive fails, or is interrupted.
fn tried(system: &dyn SystemEntry, map: &MapText, setup: &Setup<'_>) -> Result<Option<String>> {
    let setup = Setup {
        start: Some(Start::Random),
        steps: None,
        from: None,
        settings: Settings::default(),
        ..setup.clone()
    };
    let stop = interrupt::flag()?;
    let mut outing = system.driver(slice::from_ref(map), &setup).unboxed()?;
    let ended = run::until_done(&mut *outing, |outing| match stop.load(Ordering::Relaxed) {
        true => Ok(Standing::gave_up("interrupted")),
        false => outing.act(ARRIVE),
    });
    let ended = ended.unboxed()?;
    if stop.load(Ordering::Relaxed) {
        return Err(Failure::Interrupted(anyhow!(
            "interrupted while a drive by the map in {} was tried",
            map.name
        )));
    }
    let has_arrived = ended.end == TaskEnd::Done && outing.landmark() == Some(Landmark::Goal);
    Ok((!has_arrived).then(|| {
        let why = match ended.end.why() {
            "" => String::new(),
            why => format!(": {why}"),
        };
        let steps = ended.steps;
        format!(
            "a drive by it from a random place did not arrive at the goal in {steps} steps{why}"
        )
    }))
}

/// What is known of a learned map.
struct Verdict {
    /// The judge's: `Some(None)` if the map is right, or why not; `None` if it was not judged.
    judged: Option<Option<String>>,
    /// Why the map is wrong or unfinished; `None` if it is neither, as far as anyone can tell.
    complaint: Option<String>,
}

impl Verdict {
    /// Returns the verdict on the map of `outing` by the evidence `truth`, and by the system's own
    /// complaint.
    fn of(
        system: &dyn SystemEntry,
        outing: &dyn Outing,
        map: &dyn LearnedMap,
        truth: Option<&Evidence>,
        own: Option<String>,
    ) -> Self {
        let course = outing.course();
        let view = outing.map();
        let judged = truth.map(|truth| {
            let judge = || truth.complaint(&view, course, system.facts().places);
            map.judged_apart().unwrap_or_else(judge)
        });
        // A system that does not claim that its map is whole is not reproached for it, unless the
        // map is a chart.
        let is_chart = view.places.iter().any(|place| place.position.is_some());
        let claims = system.facts().claims || course.is_free() && is_chart;
        let found = judged.clone().flatten().filter(|_| claims);
        let unfit = system.abstains(&course.maze);
        let unfit = unfit
            .filter(|_| !course.is_free())
            .map(|why| why.to_string());
        let complaint = match (own.or(found), unfit) {
            (Some(complaint), Some(unfit)) => Some(format!("{complaint}; {unfit}")),
            (complaint, unfit) => complaint.or(unfit),
        };
        Self { judged, complaint }
    }
}

/// Maximum number of lines printed about a map; `tolman map show` prints all.
const MOST_LINES: usize = 4;
