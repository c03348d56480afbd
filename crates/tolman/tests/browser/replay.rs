//! The player of replays.

use core::fmt;
use std::path::{Path, PathBuf};

use crate::tab::{Scheme, Tab};
use crate::{ended, folder, tab, tell, tolman};

/// Returns a folder with the demo in it, and the demo.
fn demo(name: &str) -> (PathBuf, PathBuf) {
    let folder = folder(name);
    let page = folder.join("demo.html");
    tolman(&["demo", "--out", page.to_str().unwrap()]);
    (folder, page)
}

/// Returns a replay of `steps` steps in a maze of this size, which a robot without a plan does not
/// leave in that time.
fn long_run(folder: &Path, size: &str, steps: u32) -> PathBuf {
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (maze, page) = (path("large-hard.maze"), path("run.html"));
    let generate = ["maze", "generate", "perfect", "--size", size];
    let text = tolman(&[&generate[..], &["--seed", "3"]].concat());
    std::fs::write(&maze, text).unwrap();
    let steps = steps.to_string();
    let run = [
        "run", "random", "--maze", &maze, "--steps", &steps, "--replay", &page,
    ];
    ended(&run, 1);
    page.into()
}

#[test]
#[ignore = "needs a browser"]
fn a_replay_plays_pauses_and_goes_where_it_is_told() {
    let Some(mut tab) = tab() else { return };
    let (_, page) = demo("replay-plays");
    tab.load(&page, "");
    let last = tab.whole("tolmanReplay.run.last");
    assert!(last > 50, "the demo takes {last} steps");
    // It plays by itself, and says what it shows.
    tab.until("tolmanReplay.playing && tolmanReplay.step > 3");
    tab.until("tolmanReplay.caption.textContent.includes('explores')");
    tab.strike(" ", 32);
    tab.until("!tolmanReplay.playing");
    tab.click("[data-part=play]");
    tab.until("tolmanReplay.playing");
    tab.strike(" ", 32);
    tab.until("!tolmanReplay.playing");

    tab.strike("Home", 36);
    tab.strike("ArrowRight", 39);
    tab.strike("ArrowRight", 39);
    tab.strike("ArrowLeft", 37);
    tab.until("tolmanReplay.step === 1");
    tab.strike("End", 35);
    tab.until("tolmanReplay.step === tolmanReplay.run.last");

    tab.click("[data-part=slider]");
    tab.until("Math.abs(tolmanReplay.step / tolmanReplay.run.last - 0.5) < 0.05");
    // The address follows, and leads there again.
    tab.until("location.hash === '#t=' + tolmanReplay.step");
    tab.load(&page, "#t=7");
    tab.until("tolmanReplay.step === 7");
    tab.assert_content();
}

/// Waits until what was asked for is on the screen.
const DRAWN: &str = "(async () => {
  do for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame);
  while (tolmanReplay.asked);
})()";

#[test]
#[ignore = "needs a browser"]
fn layers_can_be_hidden() {
    let Some(mut tab) = tab() else { return };
    let (folder, page) = demo("replay-layers");
    tab.load(&page, "#t=60");
    let mut looks = Vec::new();
    for layer in ["", "trajectory", "beams"] {
        if !layer.is_empty() {
            tab.click(&format!("[data-layer={layer}]"));
        }
        tab.eval(DRAWN);
        looks.push(
            tab.look(&folder.join(format!("without-{layer}.png")))
                .ground,
        );
    }
    // Each leaves more of the page bare.
    assert!(looks[0] < looks[1] && looks[1] < looks[2], "{looks:?}");
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser"]
fn a_replay_is_seen_in_every_light_and_on_every_width() {
    let Some(mut tab) = tab() else { return };
    let (folder, page) = demo("replay-look");
    tab.load(&page, "#t=80");
    tab.until("tolmanReplay.step === 80");
    for (width, height) in [(1200, 800), (375, 667), (320, 480)] {
        tab.resize(width, height);
        for scheme in [Scheme::Light, Scheme::Dark] {
            tab.prefer(scheme);
            let theme = format!("{scheme:?}").to_lowercase();
            tab.until(&format!("tolmanReplay.root.dataset.theme === '{theme}'"));
            tab.eval(DRAWN);
            tab.assert_seen(&folder, scheme, width);
            // Nothing of the controls is cut off, and the slider can be got hold of.
            tab.until("[...document.querySelectorAll('footer *')].every(part => part.getBoundingClientRect().right <= innerWidth)");
            assert!(tab.number("tolmanReplay.slider.clientWidth / innerWidth") > 0.5);
        }
    }
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser"]
fn a_run_of_5000_steps_is_small_and_smooth() {
    let Some(mut tab) = tab() else { return };
    let page = long_run(&folder("replay-5000"), "16x16", 5000);
    let bytes = std::fs::metadata(&page).unwrap().len();
    tab.load(&page, "");
    assert_eq!(tab.whole("tolmanReplay.run.last"), 5000);
    let frames = frames(&mut tab);
    tell(&format!("5000 steps: {bytes} bytes, {frames}"));
    assert!(bytes < 102_000, "{bytes} bytes");
    // 16 are wanted, and 3 seen; a machine with ten other things to do at once is forgiven.
    assert!(frames.median < 60.0, "{frames}");
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser"]
fn a_run_of_200_000_steps_can_be_used() {
    let Some(mut tab) = tab() else { return };
    let page = long_run(&folder("replay-200000"), "100x100", 200_000);
    tab.load(&page, "");
    assert_eq!(tab.whole("tolmanReplay.run.last"), 200_000);
    let frames = frames(&mut tab);
    tell(&format!("200000 steps: {frames}"));
    assert!(frames.median < 500.0, "{frames}");
    tab.strike("End", 35);
    tab.until("tolmanReplay.step === 200000 && !tolmanReplay.asked");
    tab.strike("ArrowLeft", 37);
    tab.until("tolmanReplay.step === 199999 && !tolmanReplay.asked");
    tab.assert_content();
}

/// Durations of drawing a frame, ms.
struct Frames {
    median: f64,
    slowest: f64,
}

impl fmt::Display for Frames {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { median, slowest } = self;
        write!(
            formatter,
            "{median:.1} ms a frame in the median, {slowest:.1} ms the slowest"
        )
    }
}

/// Returns the durations of sixty frames all over a run, to and fro.
fn frames(tab: &mut Tab) -> Frames {
    let times = tab.eval(
        "(async () => {
           const times = [];
           for (let i = 1; i <= 60; i++) {
             tolmanReplay.seek(tolmanReplay.run.last * (i * 37 % 60) / 60);
             const frames = tolmanReplay.frames;
             while (tolmanReplay.frames === frames) await new Promise(requestAnimationFrame);
             times.push(tolmanReplay.frameMs);
           }
           return times.sort((a, b) => a - b);
         })()",
    );
    let time = |index: usize| times[index].as_f64().unwrap();
    Frames {
        median: time(30),
        slowest: time(59),
    }
}

#[test]
#[ignore = "needs a browser"]
fn two_traces_play_side_by_side_and_part_where_they_are_said_to() {
    let Some(mut tab) = tab() else { return };
    let folder = folder("replay-two");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    // A name that would end the script it stands in.
    let (first, second) = (path("one.jsonl"), path("<script>alert(1)<!--.jsonl"));
    for (trace, brain) in [(&first, "wall-follow"), (&second, "avoid")] {
        tolman(&[
            "run",
            brain,
            "--maze",
            "mazes/large-hard.maze",
            "--seed",
            "7",
            "--steps",
            "5000",
            "--trace",
            trace,
        ]);
    }
    let page = path("both.html");
    let told = tolman(&["replay", &first, &second, "--out", &page]);
    tab.load(Path::new(&page), "");
    assert_eq!(tab.whole("tolmanReplay.run.tracks.length"), 2);
    tab.click("[data-mark=difference] button:last-of-type");
    tab.until("tolmanReplay.step > 0");
    let step = format!("step {}", tab.whole("tolmanReplay.step"));
    assert!(told.contains(&step), "{told} is shown at {step}");
    tab.assert_content();
}

/// A log whose map closes no loop has a series of closures without a value.
#[test]
#[ignore = "needs a browser"]
fn a_series_without_values_is_played() {
    let Some(mut tab) = tab() else { return };
    let map = folder("replay-no-closures").join("map");
    let log = "logs/office.clf.gz";
    let out = map.to_str().unwrap();
    tolman(&["map", "--log", log, "--system", "matching", "--out", out]);
    tab.load(&map.join("replay.html"), "");
    let values = "tolmanReplay.run.tracks[0].series.map(series => series.values.length)";
    assert_eq!(tab.eval(values), serde_json::json!([0]));
    tab.assert_content();
}
