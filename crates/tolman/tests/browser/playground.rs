//! The playground: `TOLMAN_PLAYGROUND=FILE cargo test -p tolman --test browser -- --ignored
//! playground` tries the page that `cargo xtask playground` wrote. `cargo xtask ci --thorough` does
//! both.

use core::time::Duration;
use std::env;
use std::path::{Path, PathBuf};

use tolman_playground::{Playground, Sketch};

use crate::tab::Tab;
use crate::{folder, tab, tell};

/// The page has a program to compile and robots to run, on machines that do other things besides.
pub(crate) const PATIENCE: Duration = Duration::from_secs(90);

/// Returns the page, opened, with a folder for pictures; none, said on stderr, where there is none.
pub(crate) fn opened(name: &str) -> Option<(Tab, PathBuf)> {
    let Some(page) = env::var_os("TOLMAN_PLAYGROUND") else {
        tell("left out: TOLMAN_PLAYGROUND names no page");
        return None;
    };
    let mut tab = tab()?;
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    tab.load(&root.join(page), "");
    tab.until_within("!!window.tolmanPlayground", PATIENCE);
    Some((tab, folder(name)))
}

/// Returns the text of the page's caption.
fn told(tab: &mut Tab) -> String {
    let told = tab.eval("document.querySelector('#told').textContent");
    told.as_str().unwrap().to_owned()
}

/// Sets a choice or a number as a reader does.
fn set(tab: &mut Tab, id: &str, value: &str) {
    tab.eval(&format!(
        "(() => {{ const part = document.getElementById('{id}'); part.value = '{value}';
           part.dispatchEvent(new Event('input')); part.dispatchEvent(new Event('change')); }})()"
    ));
}

/// Returns the fingerprint of what MSLST Better learns of the demo's maze on this machine.
fn fingerprint(seed: u64) -> String {
    let sketch = Sketch::read(include_str!("../../mazes/demo.maze")).unwrap();
    let session = Playground::default().begin(&sketch, "MSLST Better", seed);
    let mut session = session.unwrap();
    while session.advance(1000).is_busy {}
    session.fingerprint()
}

/// Waits until the task is over and shown, and returns what is told of it.
fn over(tab: &mut Tab) -> String {
    let over = "document.querySelector('#player').dataset.over === 'true'";
    tab.until_within(over, PATIENCE);
    told(tab)
}

#[test]
#[ignore = "needs a browser, and TOLMAN_PLAYGROUND"]
fn playground_a_robot_learns_is_put_elsewhere_and_drives_home() {
    let Some((mut tab, folder)) = opened("playground-learns") else {
        return;
    };
    set(&mut tab, "seed", "8");
    tab.click("#start");
    tab.until_within("tolmanReplay.step > 5 && tolmanReplay.playing", PATIENCE);
    assert!(told(&mut tab).contains("explores"));
    // Its map grows while it drives.
    let places = "tolmanReplay.run.tracks[0].maps[0].nodes.length";
    let before = tab.whole(places);
    tab.until_within(&format!("{places} > {before} + 3"), PATIENCE);
    tab.click("#pause");
    tab.until("!tolmanReplay.playing");
    let step = tab.whole("tolmanReplay.step");
    tab.click("#step");
    tab.until(&format!("tolmanReplay.step === {step} + 1"));
    set(&mut tab, "speed", "12");
    tab.click("#pause");
    let learned = over(&mut tab);
    assert!(learned.contains("The map is right"), "{learned}");

    // The module comes to the same bits as the library on this machine.
    let print = "tolmanPlayground.page.fingerprint()";
    let first = tab.eval(print);
    assert_eq!(first, fingerprint(8));

    // Where it is put it does not know: it believes in many places, and then in one.
    set(&mut tab, "speed", "4");
    tab.click("#lift");
    tab.click("[data-part=canvas]");
    tab.until("tolmanPlayground.run.state.task === 'localize'");
    let found = over(&mut tab);
    assert!(found.contains("It found out where it is"), "{found}");
    let shapes = tab.eval(
        "(() => { const [belief] = tolmanReplay.run.tracks[0].beliefs, lift = Math.min(...tolmanReplay.run.tracks[0].lifts);
           const counts = belief.steps.flatMap((step, i) => step >= lift ? [belief.shapes[i].length] : []);
           return [Math.max(...counts), counts.at(-1)]; })()",
    );
    assert!(shapes[0].as_u64() > Some(1), "{shapes}");
    assert!(shapes[1].as_u64() <= Some(2), "{shapes}");
    set(&mut tab, "speed", "12");
    tab.click("#home");
    let home = over(&mut tab);
    assert!(home.contains("It is at the goal"), "{home}");
    tab.look(&folder.join("home.png"));

    // The same again.
    tab.click("#redraw");
    tab.until("document.querySelector('#player').hidden");
    tab.click("#start");
    tab.until("tolmanPlayground.run !== null");
    set(&mut tab, "speed", "12");
    assert_eq!(over(&mut tab), learned);
    assert_eq!(tab.eval(print), first);
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser, and TOLMAN_PLAYGROUND"]
fn playground_a_maze_is_drawn() {
    let Some((mut tab, _)) = opened("playground-draws") else {
        return;
    };
    set(&mut tab, "family", "empty");
    set(&mut tab, "size", "5");
    let walls = "document.querySelectorAll('#sketch .wall').length";
    assert_eq!(tab.whole(walls), 20);
    tab.click("[data-wall='1 1 north']");
    tab.until(&format!("{walls} === 21"));
    tab.click("[data-wall='1 1 north']");
    tab.until(&format!("{walls} === 20"));
    // The goal is moved and walled in: nobody can be sent there, and the page says so.
    tab.click("[name=tool][value=goal]");
    tab.click("[data-cell='4 0']");
    tab.click("[name=tool][value=wall]");
    tab.click("[data-wall='4 0 north']");
    tab.until(&format!("{walls} === 21"));
    assert!(told(&mut tab).starts_with("Click"));
    tab.click("[data-wall='3 0 east']");
    tab.until("document.querySelector('#start').disabled");
    assert!(told(&mut tab).contains("No robot can be sent"));
    tab.click("[data-wall='3 0 east']");
    tab.until("!document.querySelector('#start').disabled");
    // CPM refuses open squares, and says why.
    set(&mut tab, "system", "CPM Better");
    tab.click("#start");
    tab.until("document.querySelector('#told').dataset.tone === 'bad'");
    assert!(told(&mut tab).contains("open square"), "{}", told(&mut tab));
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser, and TOLMAN_PLAYGROUND"]
fn playground_every_system_learns() {
    let Some((mut tab, _)) = opened("playground-systems") else {
        return;
    };
    set(&mut tab, "family", "star");
    set(&mut tab, "size", "5");
    let systems =
        tab.eval("[...document.querySelectorAll('#system option')].map(one => one.value)");
    let systems = systems.as_array().unwrap().clone();
    assert!(systems.len() >= 10, "{systems:?}");
    for system in systems {
        let system = system.as_str().unwrap();
        set(&mut tab, "system", system);
        tab.click("#start");
        tab.until(&format!(
            "tolmanPlayground.run?.player.run.title.startsWith('{system} in')"
        ));
        set(&mut tab, "speed", "12");
        // A slow browser is given its time: the run is made here, not by its frames.
        tab.eval(
            "(() => { const { page, run } = tolmanPlayground;
               while (run.state.is_busy) run.state = JSON.parse(page.advance(1000));
               run.said.push({ step: run.state.steps, told: run.state.told, tone: run.state.tone });
               run.isShort = true; run.player.growing = false; run.player.extend(page.replay()); run.isShort = false;
               run.player.seek(run.player.run.last); })()",
        );
        let learned = over(&mut tab);
        assert!(learned.contains(" map"), "{system}: {learned}");
        tab.click("#redraw");
    }
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser, and TOLMAN_PLAYGROUND"]
fn playground_is_seen_in_every_light_and_on_every_width() {
    let Some((mut tab, folder)) = opened("playground-look") else {
        return;
    };
    for stage in ["draws", "drives"] {
        if stage == "drives" {
            set(&mut tab, "seed", "8");
            tab.click("#start");
            tab.until_within("tolmanReplay.step > 60", PATIENCE);
            tab.click("#pause");
        }
        tab.assert_seen_everywhere(&folder, stage);
    }
    tab.assert_content();
}
