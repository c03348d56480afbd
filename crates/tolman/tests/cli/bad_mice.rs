//! Mice and simulators that misbehave, and hosts that are ended: no process is left behind.

use core::time::Duration;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::time::Instant;
use std::{fs, thread};

use crate::mms_host::MIDDLE;
use crate::{Ended, command_in, folder};

/// All processes of a test have this in their environment, with its name.
const MARK: &str = "TOLMAN_TEST_MARK";

fn host(folder: &Path, mark: &str, script: &str, time_limit: &str) -> Command {
    fs::write(folder.join("mouse.sh"), script).unwrap();
    fs::write(folder.join("a.maze"), MIDDLE).unwrap();
    let mut command = command_in(
        folder,
        &[
            "mms-host",
            "--mouse",
            "sh mouse.sh",
            "--maze",
            "a.maze",
            "--json",
            "--move-limit",
            "50",
            "--time-limit",
            time_limit,
        ],
    );
    command.env(MARK, mark);
    command
}

/// Returns the running processes of a test.
fn marked(mark: &str) -> Vec<PathBuf> {
    let mark = format!("{MARK}={mark}\0");
    let mut found = Vec::new();
    for entry in fs::read_dir("/proc").unwrap() {
        let path = entry.unwrap().path();
        // A process that ends meanwhile is not there.
        let environment = fs::read(path.join("environ")).unwrap_or_default();
        if environment
            .windows(mark.len())
            .any(|window| window == mark.as_bytes())
        {
            found.push(path);
        }
    }
    found
}

/// Time in which all processes have to be gone. A mouse ends after its decision, which takes
/// seconds on a busy machine.
const LONGEST_END: Duration = Duration::from_secs(60);

#[track_caller]
fn nothing_is_left(mark: &str) {
    let started = Instant::now();
    while !marked(mark).is_empty() {
        assert!(
            started.elapsed() < LONGEST_END,
            "{mark}: {:?} is left",
            marked(mark)
        );
        thread::sleep(Duration::from_millis(10));
    }
}

const SHORT: &str = "0.5";
const LONG: &str = "60";

/// Name, script, seconds it is given, how it is to have ended.
const BAD_MICE: [(&str, &str, &str, &str); 20] = [
    ("sleeps", "sleep 1000", SHORT, "out_of_time"),
    ("spins", "while :; do :; done", SHORT, "out_of_time"),
    ("never-ends-a-line", "cat /dev/zero", LONG, "line_too_long"),
    ("floods-with-lines", "yes", LONG, "too_much_output"),
    (
        "floods-with-long-lines",
        "yes $(head -c 4000 /dev/zero | tr '\\0' x)",
        LONG,
        "too_much_output",
    ),
    (
        "asks-and-never-listens",
        "exec yes wallFront",
        SHORT,
        "out_of_time",
    ),
    (
        "closes-stdout",
        "exec >&-; sleep 1000",
        LONG,
        "closed_output",
    ),
    ("closes-stdin", "exec <&-; sleep 1000", SHORT, "out_of_time"),
    (
        "ignores-signals",
        "trap '' TERM INT HUP; while :; do sleep 1; done",
        SHORT,
        "out_of_time",
    ),
    (
        "wraps",
        "sh -c 'sh -c \"sleep 1000; :\"; :'; :",
        SHORT,
        "out_of_time",
    ),
    ("leaves-children", "sleep 1000 & exit 0", LONG, "done"),
    (
        "forks-twice",
        "(setsid sh -c 'setsid sleep 1000 & exit' &); exit 0",
        LONG,
        "done",
    ),
    (
        "becomes-a-daemon",
        "setsid sleep 1000 <&- >&- 2>&- & exit 0",
        LONG,
        "done",
    ),
    (
        "forks-a-tree",
        "for i in 1 2 3 4 5 6; do setsid sh -c 'sleep 1000 & sleep 1000 & wait' & done; wait",
        SHORT,
        "out_of_time",
    ),
    ("stops-itself", "kill -STOP $$", SHORT, "out_of_time"),
    ("kills-its-group", "sleep 1000 & kill -9 0", LONG, "failed"),
    (
        "ends-its-parent",
        "kill $PPID; exec >&-; sleep 1000",
        LONG,
        "failed",
    ),
    ("crashes", "kill -SEGV $$", LONG, "failed"),
    (
        "speaks-bytes",
        "printf '\\377\\376\\000\\n'; sleep 1000",
        SHORT,
        "out_of_time",
    ),
    (
        "turns-for-ever",
        "while :; do echo turnLeft; read -r _; done",
        LONG,
        "out_of_movements",
    ),
];

/// Starts the bad mouse of this number for the `round`-th time.
fn try_mouse(number: usize, round: usize) {
    let (name, script, time_limit, ended) = BAD_MICE[number];
    let mark = format!("bad-mouse-{name}-{round}");
    let folder = folder(&mark);
    let mut host = host(&folder, &mark, script, time_limit);
    let told = Ended::from(host.output().unwrap()).failed(1, &["did not solve a.maze"]);
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!(told["ended"], ended, "{name}");
    nothing_is_left(&mark);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn bad_mice_leave_nothing_behind() {
    for number in 0..BAD_MICE.len() {
        try_mouse(number, 0);
    }
}

/// Replies to what a mouse asks: about walls, movements, turns and the reset button.
const REPLIES: &str = "\
play() {
    while read -r asked; do case $asked in
        maze*) echo 8 ;; wall*) echo $1 ;; move*) echo $2 ;; turn* | ack*) echo $3 ;; was*) echo $4 ;;
    esac; done
}
";

/// Name, script, the mouse's exit code, a part of what it complains of.
const BAD_SIMULATORS: [(&str, &str, i32, &str); 17] = [
    ("goes-away", "exit 0", 1, WENT_AWAY),
    ("crashes", "kill -SEGV $$", 1, WENT_AWAY),
    ("is-silent", "exec sleep 1000", 1, WENT_AWAY),
    ("stops-itself", "kill -STOP $$", 1, WENT_AWAY),
    ("closes-its-output", "exec >&-; sleep 1000", 1, WENT_AWAY),
    ("never-reads", "exec <&-; sleep 1000", 1, WENT_AWAY),
    (
        "answers-ahead-and-goes",
        "printf '8\\n8\\nfalse\\nfalse\\n'",
        1,
        WENT_AWAY,
    ),
    (
        "is-killed-at-work",
        "(sleep 0.02; kill -KILL $$) & play false ack ack true",
        1,
        WENT_AWAY,
    ),
    (
        "resets-again-and-again",
        "play false ack ack true",
        1,
        "was reset 9 times",
    ),
    ("never-ends-a-line", "cat /dev/zero", 2, "a number of cells"),
    ("floods-with-lines", "yes 16", 2, "true or false"),
    (
        "speaks-bytes",
        "printf '\\377\\376\\000\\n'; sleep 1000",
        2,
        "a number of cells",
    ),
    ("has-no-maze", "yes 0", 2, "a number of cells"),
    ("has-a-huge-maze", "yes 65535", 2, "32 × 32"),
    ("walls-the-mouse-in", "play true ack ack false", 1, "no way"),
    ("hides-walls", "play false crash ack false", 1, "crashed"),
    (
        "forbids-turns",
        "play false ack no false",
        2,
        "ack was expected",
    ),
];

/// Part of the complaint of a mouse whose simulator was killed, or ended by itself.
const WENT_AWAY: &str = "went away";
/// Time after which a simulator is killed, if its mouse waits for the simulator's end.
const PATIENCE: Duration = Duration::from_millis(300);
/// Time after which a simulator is killed, if its mouse should have ended by itself.
const LONG_PATIENCE: Duration = Duration::from_secs(20);

/// Starts a mouse with the bad simulator of this number for the `round`-th time.
fn try_simulator(number: usize, round: usize) {
    let (name, script, code, part) = BAD_SIMULATORS[number];
    let mark = format!("bad-simulator-{name}-{round}");
    let mut mouse = command_in(Path::new("."), &["mouse", "--mms"])
        .env(MARK, &mark)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut simulator = Command::new("sh")
        .args(["-c", &format!("{REPLIES}{script}")])
        .env(MARK, &mark)
        .stdin(mouse.stdout.take().unwrap())
        .stdout(mouse.stdin.take().unwrap())
        .stderr(Stdio::null())
        .process_group(0)
        .spawn()
        .unwrap();
    let started = Instant::now();
    let patience = match part {
        WENT_AWAY => PATIENCE,
        _ => LONG_PATIENCE,
    };
    // What it says is read all along: a mouse that is reset again and again fills a pipe.
    let ended = thread::spawn(|| mouse.wait_with_output());
    while !ended.is_finished() && started.elapsed() < patience {
        thread::sleep(Duration::from_millis(2));
    }
    // With all that it started: they hold the pipes, too.
    let group = format!("-{}", simulator.id());
    let mut kill = Command::new("kill");
    kill.args(["-s", "KILL", "--", &group])
        .stderr(Stdio::null())
        .status()
        .unwrap();
    simulator.wait().unwrap();
    nothing_is_left(&mark);
    Ended::from(ended.join().unwrap().unwrap()).failed(code, &[part]);
}

#[test]
fn bad_simulators_leave_nothing_behind() {
    for number in 0..BAD_SIMULATORS.len() {
        try_simulator(number, 0);
    }
}

#[test]
#[ignore = "takes minutes: cargo test -p tolman --test cli -- --ignored a_thousand_starts"]
fn a_thousand_starts_leave_nothing_behind() {
    let tries = |count, start: fn(usize, usize), kinds| {
        (0..count).map(move |number| (start, number % kinds, 1 + number / kinds))
    };
    let mice = tries(650, try_mouse, BAD_MICE.len());
    let simulators = tries(350, try_simulator, BAD_SIMULATORS.len());
    let starts = Mutex::new(mice.chain(simulators));
    let next = || starts.lock().unwrap().next();
    // Most of them wait.
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                while let Some((start, number, round)) = next() {
                    start(number, round);
                }
            });
        }
    });
    assert!(next().is_none());
}

/// Returns a host whose mouse has moved once and has started processes in other sessions.
fn busy_host(mark: &str) -> Child {
    let script =
        "echo turnLeft; read -r _; (setsid sleep 1000 &); touch ready; sh -c 'sleep 1000; :'";
    let folder = folder(&format!("host-{mark}"));
    let child = host(&folder, mark, script, LONG)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let started = Instant::now();
    while !folder.join("ready").exists() {
        assert!(started.elapsed() < Duration::from_secs(30), "{mark}");
        thread::sleep(Duration::from_millis(5));
    }
    child
}

#[test]
fn a_host_that_is_ended_takes_its_mice_along() {
    for (signal, code) in [
        ("INT", Some(130)),
        ("TERM", Some(130)),
        ("HUP", None),
        ("KILL", None),
    ] {
        let child = busy_host(signal);
        assert!(marked(signal).len() >= 4, "{signal}");
        let sent = Command::new("kill")
            .args(["-s", signal, &child.id().to_string()])
            .status();
        assert!(sent.unwrap().success());
        let told: Ended = child.wait_with_output().unwrap().into();
        assert_eq!(told.code, code, "{signal}: {}", told.err);
        nothing_is_left(signal);
        if code.is_some() {
            let score: serde_json::Value = serde_json::from_str(&told.out).unwrap();
            assert_eq!(score["ended"], "interrupted", "{signal}");
            assert_eq!(score["movements"], 1, "{signal}");
            assert!(told.err.contains("interrupted after 0 of 1 mazes"));
        }
    }
}

#[test]
fn mazes_until_an_interruption_are_scored() {
    let folder = folder("host-many");
    fs::create_dir(folder.join("mazes")).unwrap();
    for maze in ["a", "b", "c"] {
        fs::write(folder.join(format!("mazes/{maze}.maze")), MIDDLE).unwrap();
    }
    // The first mouse is done at once, the second asks for the end of the host, two processes up.
    let script = "mkdir done && exit 0; kill -INT $(ps -o ppid= $PPID); sleep 1000";
    fs::write(folder.join("mouse.sh"), script).unwrap();
    let mouse = ["mms-host", "--mouse", "sh mouse.sh", "--maze", "mazes"];
    let told: Ended = command_in(&folder, &[&mouse[..], &["--jobs", "1"]].concat())
        .env(MARK, "many")
        .output()
        .unwrap()
        .into();
    let told = told.failed(130, &["interrupted after 1 of 3 mazes"]);
    let lines: Vec<&str> = told.lines().collect();
    assert!(lines[0].ends_with("done"), "{told}");
    assert!(lines[1].ends_with("interrupted"), "{told}");
    assert!(lines[2].contains("0 of 1 solved"), "{told}");
    nothing_is_left("many");
}
