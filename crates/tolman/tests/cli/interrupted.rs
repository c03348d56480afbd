//! Runs that are interrupted, or killed, and gone on with: what comes of them is the same, byte by
//! byte, as if nobody had.

use core::time::Duration;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{CORRIDOR, Ended, command_in, folder, tolman_in};

/// Way in which a program is ended.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    /// By Ctrl-C after this time.
    Interrupt(Duration),
    /// Without a chance to save anything, once something was saved.
    Kill,
    /// Without a chance to save anything, after this time.
    KillAfter(Duration),
}

/// The code of a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

fn words(command: &str) -> Vec<&str> {
    command.split_whitespace().collect()
}

/// Returns the end of a command that was ended by `end`, unless it had ended by itself.
fn ended(folder: &Path, command: &str, unfinished: &Path, end: End) -> Ended {
    let mut spawned = command_in(folder, &words(command));
    let spawned = spawned.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = spawned.spawn().unwrap();
    let signal = match end {
        End::Interrupt(after) => {
            sleep(after);
            "-INT"
        }
        End::Kill => {
            while !unfinished.exists() && child.try_wait().unwrap().is_none() {
                sleep(Duration::from_millis(5));
            }
            "-KILL"
        }
        End::KillAfter(after) => {
            sleep(after);
            "-KILL"
        }
    };
    // It may have ended by itself.
    let mut kill = Command::new("kill");
    kill.args([signal, &child.id().to_string()]);
    kill.stderr(Stdio::null()).status().unwrap();
    child.wait_with_output().unwrap().into()
}

/// A command whose outcome is looked at.
struct Run {
    folder: PathBuf,
    command: String,
    /// The files that the command writes.
    files: Vec<&'static str>,
    unfinished: PathBuf,
    /// Exit code, output and files of the command if nobody interrupts it.
    whole: (Option<i32>, String, Vec<Vec<u8>>),
    /// Duration of the command if nobody interrupts it.
    takes: Duration,
}

impl Run {
    fn new(folder: &Path, command: &str, files: &[&'static str], unfinished: &str) -> Self {
        let began = Instant::now();
        let told = tolman_in(folder, &words(command));
        let takes = began.elapsed();
        let mut run = Self {
            folder: folder.to_owned(),
            command: command.to_owned(),
            files: files.to_vec(),
            unfinished: folder.join(unfinished),
            whole: (None, String::new(), Vec::new()),
            takes,
        };
        run.whole = run.outcome(told);
        run
    }

    /// Returns a run's exit code, output and files, which it removes.
    fn outcome(&self, told: Ended) -> (Option<i32>, String, Vec<Vec<u8>>) {
        assert_ne!(told.code, Some(INTERRUPTED), "{}", told.err);
        let take = |name: &&str| {
            let path = self.folder.join(name);
            let bytes = fs::read(&path).unwrap();
            fs::remove_file(path).unwrap();
            bytes
        };
        let files = self.files.iter().map(take).collect();
        assert!(!self.unfinished.exists(), "{} is done", self.command);
        (told.code, told.out, files)
    }

    /// Interrupts it in each way in turn, continues each time, and lets it finish. Returns how
    /// often it was truly interrupted.
    #[track_caller]
    fn survives(&self, ends: &[End]) -> usize {
        let name = self.unfinished.file_name().unwrap().to_str().unwrap();
        let mut count = 0;
        for end in ends {
            let told = ended(&self.folder, &self.again(name), &self.unfinished, *end);
            let is_interrupted = told.code == Some(INTERRUPTED);
            // Before it has begun, there is nothing to go on with.
            if is_interrupted && self.unfinished.exists() {
                assert!(told.err.contains("go on with: tolman"), "{}", told.err);
                assert!(told.err.contains(&format!("--from {name}")), "{}", told.err);
            }
            if told.code.is_none() || is_interrupted || self.unfinished.exists() {
                count += 1;
            } else {
                // It was faster.
                self.is_whole(told, ends);
                return count;
            }
        }
        let told = tolman_in(&self.folder, &words(&self.again(name)));
        self.is_whole(told, ends);
        count
    }

    /// Asks for the same as if nobody had ended it.
    #[track_caller]
    fn is_whole(&self, told: Ended, ends: &[End]) {
        let (whole, err) = (&self.whole, told.err.clone());
        let (code, out, files) = self.outcome(told);
        let context = format!("{}: {ends:?}: {err}", self.command);
        assert_eq!((code, &out), (whole.0, &whole.1), "{context}");
        for (name, (now, then)) in self.files.iter().zip(files.iter().zip(&whole.2)) {
            assert!(now == then, "{name} of {context}");
        }
    }

    /// Returns the command, which continues an unfinished run if there is one.
    fn again(&self, name: &str) -> String {
        match self.unfinished.exists() {
            true => format!("{} --from {name}", self.command),
            false => self.command.clone(),
        }
    }

    /// Returns an interrupt after `share` of the run's duration.
    fn at(&self, share: f64) -> End {
        End::Interrupt(self.takes.mul_f64(share))
    }

    /// Returns a kill at a random moment of the run.
    fn any_time(&self, rng: &mut ChaCha8Rng) -> End {
        End::KillAfter(self.takes.mul_f64(rng.random()))
    }

    /// Interrupts it at several moments, twice, and kills it.
    #[track_caller]
    fn survives_all(&self) {
        // From the second time on while or after it makes again what it had made.
        let interrupted = self.survives(&[self.at(0.3), self.at(0.5), self.at(0.8)]);
        assert!(interrupted > 0, "{} was never interrupted", self.command);
        self.survives(&[End::Kill, self.at(0.6)]);
    }
}

/// Returns a folder with a maze of some corridors.
fn maze(name: &str, size: &str) -> PathBuf {
    let folder = folder(name);
    let generate = format!("maze generate braided --size {size} --seed 3 --out a.maze");
    tolman_in(&folder, &words(&generate)).done();
    folder
}

#[test]
fn mslst_goes_on_with_an_interrupted_run() {
    let folder = maze("interrupted-mslst", "6x6");
    let learn = "learn --system mslst --maze a.maze --set scan_steps=60000 --set graph_actions=9000 --out map.json";
    Run::new(&folder, learn, &["map.json"], "map.json.unfinished").survives_all();
}

#[test]
fn mslst_better_goes_on_with_an_interrupted_run() {
    let folder = maze("interrupted-better", "8x8");
    let learn = "learn --system mslst-better --maze a.maze --out map.json --svg map.svg";
    Run::new(
        &folder,
        learn,
        &["map.json", "map.svg"],
        "map.json.unfinished",
    )
    .survives_all();
}

#[test]
fn cpm_goes_on_with_an_interrupted_run() {
    let folder = maze("interrupted-cpm", "7x7");
    let learn =
        "learn --system cpm-better --maze a.maze --start random --out map.json --svg map.svg";
    let files = ["map.json", "map.svg"];
    Run::new(&folder, learn, &files, "map.json.unfinished").survives_all();
}

#[test]
fn gngslam_goes_on_with_an_interrupted_run() {
    let folder = maze("interrupted-gngslam", "4x4");
    let learn = "learn --system gng-slam-better --maze a.maze --steps 3000 --out map.json";
    Run::new(&folder, learn, &["map.json"], "map.json.unfinished").survives_all();
}

#[test]
fn the_diktiometry_goes_on_with_an_interrupted_run() {
    let folder = maze("interrupted-survey", "6x6");
    let learn = "learn --system diktiometry-better --maze a.maze --set moves=500 --out map.json";
    Run::new(&folder, learn, &["map.json"], "map.json.unfinished").survives_all();
}

#[test]
fn a_map_that_was_gone_on_with_is_kept_with_the_interrupted_run() {
    let folder = maze("interrupted-from-a-map", "6x6");
    let first = "learn --system diktiometry-better --maze a.maze --set moves=40 --out first.json";
    tolman_in(&folder, &words(first));
    let on =
        "learn --system diktiometry-better --maze a.maze --set moves=1000 --seed 5 --out map.json";
    let from_map = format!("{on} --from first.json");
    let began = Instant::now();
    tolman_in(&folder, &words(&from_map));
    let half = End::Interrupt(began.elapsed() / 2);
    let whole = fs::read(folder.join("map.json")).unwrap();
    let unfinished = folder.join("map.json.unfinished");
    let told = ended(&folder, &from_map, &unfinished, half);
    assert_eq!(told.code, Some(INTERRUPTED), "{}", told.err);
    assert_ne!(fs::read(folder.join("map.json")).unwrap(), whole);
    fs::remove_file(folder.join("first.json")).unwrap();
    let from_run = format!("{on} --from map.json.unfinished");
    tolman_in(&folder, &words(&from_run));
    assert_eq!(fs::read(folder.join("map.json")).unwrap(), whole);
    assert!(!unfinished.exists());
}

#[test]
fn a_run_goes_on_when_it_was_interrupted() {
    let folder = maze("interrupted-run", "48x48");
    // Nobody arrives, so that it takes its time.
    let run = "run random --maze a.maze --steps 150000 --svg run.svg --unfinished run.part";
    Run::new(&folder, run, &["run.svg"], "run.part").survives_all();
    let run = "run avoid --maze a.maze --steps 300000 --svg run.svg";
    let run = Run::new(&folder, run, &["run.svg"], "run.unfinished");
    run.survives(&[run.at(0.5)]);
}

#[test]
fn a_drive_goes_on_when_it_was_interrupted() {
    let folder = maze("interrupted-drive", "5x5");
    // So short a map that the robot looks for the goal until its time is up.
    let learn = "learn --system gng-slam-better --maze a.maze --steps 300 --out map.json";
    tolman_in(&folder, &words(learn));
    let drive =
        "drive --map map.json --maze a.maze --steps 4000 --svg a.svg --unfinished a.unfinished";
    Run::new(&folder, drive, &["a.svg"], "a.unfinished").survives_all();
}

/// Runs of a second or some: every system that learns, a drive, a brain, and an experiment.
fn runs_of_all_kinds() -> Vec<Run> {
    let learned = |system: &str, size: &str, more: &str| {
        let folder = maze(&format!("killed-{system}"), size);
        let learn = format!("learn --system {system} --maze a.maze {more} --out map.json");
        Run::new(&folder, &learn, &["map.json"], "map.json.unfinished")
    };
    let driven = maze("killed-drive", "5x5");
    let learn = "learn --system gng-slam-better --maze a.maze --steps 300 --out map.json";
    tolman_in(&driven, &words(learn));
    let drive =
        "drive --map map.json --maze a.maze --steps 4000 --svg a.svg --unfinished a.unfinished";
    let run = "run random --maze a.maze --steps 150000 --svg run.svg --unfinished run.part";
    let played = folder("killed-experiment");
    fs::write(played.join("corridor.maze"), CORRIDOR).unwrap();
    let play = "experiment baselines --maze corridor.maze --runs 300 --json --out out";
    // It goes on by itself, from the runs that are there.
    let (results, no_file) = (["out/runs.jsonl", "out/summary.json"], "out.unfinished");
    vec![
        learned(
            "mslst",
            "6x6",
            "--set scan_steps=60000 --set graph_actions=9000",
        ),
        learned("mslst-better", "8x8", ""),
        learned("cpm-better", "9x9", ""),
        learned("gng-slam-better", "4x4", "--steps 3000"),
        learned("diktiometry-better", "6x6", "--set moves=500"),
        Run::new(&driven, drive, &["a.svg"], "a.unfinished"),
        Run::new(&maze("killed-run", "48x48"), run, &["run.svg"], "run.part"),
        Run::new(&played, play, &results, no_file),
    ]
}

#[test]
#[ignore = "takes minutes: cargo test -p tolman --test cli -- --ignored a_hundred_kills"]
fn a_hundred_kills_at_random_change_nothing() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let runs = runs_of_all_kinds();
    let mut kills = 0;
    while kills < 100 {
        for run in &runs {
            let ends = [(); 4].map(|()| run.any_time(&mut rng));
            kills += run.survives(&ends);
        }
    }
}

#[test]
fn what_is_not_this_run_is_not_gone_on_with() {
    let folder = maze("interrupted-otherwise", "64x64");
    let run = "run random --maze a.maze --steps 4000000";
    let file = folder.join("run.unfinished");
    let saving = format!("{run} --unfinished run.unfinished");
    let told = ended(&folder, &saving, &file, End::Kill);
    assert_eq!(told.code, None, "{}", told.out);
    let text = fs::read_to_string(&file).unwrap();

    let refused = |arguments: &str, code: i32, parts: &[&str]| {
        tolman_in(&folder, &words(arguments)).refused(code, parts);
    };
    let from = "--from run.unfinished";
    let parts = ["run.unfinished is another run", "--seed was 1, and is 2"];
    refused(&format!("{run} --seed 2 {from}"), 2, &parts);
    let avoid = format!("run avoid --maze a.maze --steps 4000000 {from}");
    refused(&avoid, 2, &["the brain was random, and is avoid"]);
    let parts = ["--steps was 4000000, and is not given"];
    refused(&format!("run random --maze a.maze {from}"), 2, &parts);
    let learn = "learn --system cpm-better --maze a.maze --out map.json";
    refused(
        &format!("{learn} {from}"),
        2,
        &["the verb was run, and is learn"],
    );
    let parts = ["a.maze is a maze", "Ctrl-C"];
    refused(&format!("{run} --from a.maze"), 2, &parts);
    let parts = ["run.unfinished is an interrupted run"];
    refused("map show run.unfinished", 2, &parts);

    let mut read: serde_json::Value = serde_json::from_str(&text).unwrap();
    read["checksum"] = "0123456789abcdef".into();
    fs::write(&file, read.to_string()).unwrap();
    let parts = ["repeated, gave another result", "without --from"];
    refused(&format!("{run} {from}"), 1, &parts);
    assert!(file.exists(), "it is still what it was");
    read["version"] = 2.into();
    fs::write(&file, read.to_string()).unwrap();
    refused(
        &format!("{run} {from}"),
        2,
        &["run.unfinished", "its version is 2"],
    );
    fs::write(&file, &text[..text.len() / 2]).unwrap();
    refused(&format!("{run} {from}"), 2, &["run.unfinished"]);
}
