//! Runs the process between us and a foreign program, which kills everything that the program
//! leaves behind.

use core::time::Duration;
use std::io;
use std::os::unix::net::UnixStream;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus};
use std::{fs, thread};

use rustix::event::{PollFd, PollFlags, poll};
use rustix::process::{self, Pid, PidfdFlags, Signal, WaitOptions, pidfd_open};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

/// Time that processes have to die of `SIGKILL` before the keeper stops waiting for them.
const PATIENCE: Duration = Duration::from_secs(5);

/// Runs `words[0]` with the other words as arguments. It runs until it ends, the process `parent`
/// ends, or a signal asks for the end (TERM, INT, HUP). Then kills all processes that are left of
/// it.
///
/// Returns the exit code by the shells' convention:
///
/// - the program's own code;
/// - 128 plus the number of the signal that ended it;
/// - 127 if there is no such program;
/// - 126 if it does not start.
///
/// Call it in a process of its own, whose parent is `parent`: it leaves its session and inherits
/// the program's orphans.
///
/// # Errors
/// If the system refuses a session, a signal or a descriptor. Nothing was started then.
pub fn keep(parent: u32, words: &[String]) -> io::Result<u8> {
    // A session of its own: no Ctrl-C reaches it, and no group of it is anybody else's.
    process::setsid()?;
    process::set_child_subreaper(Some(process::getpid()))?;
    let asked = signals()?;
    let Some(parent) = pid(parent) else {
        return Err(io::ErrorKind::InvalidInput.into());
    };
    let host = pidfd_open(parent, PidfdFlags::empty())?;
    if process::getppid() != Some(parent) {
        return Ok(0);
    }
    let Some((program, arguments)) = words.split_first() else {
        return Err(io::ErrorKind::InvalidInput.into());
    };
    let started = Command::new(program)
        .args(arguments)
        .process_group(0)
        .spawn();
    let mut child = match started {
        Ok(child) => child,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(127),
        Err(_) => return Ok(126),
    };
    let waited = release_pipes().and_then(|()| wait(&mut child, &[&host, &asked.into()]));
    end_descendants();
    Ok(match waited? {
        Some(status) => code(status),
        None => 128 + SIGTERM as u8,
    })
}

fn pid(raw: u32) -> Option<Pid> {
    i32::try_from(raw).ok().and_then(Pid::from_raw)
}

/// Returns a stream that can be read once a signal asks for the end.
fn signals() -> io::Result<UnixStream> {
    let (asked, told) = UnixStream::pair()?;
    for signal in [SIGHUP, SIGINT, SIGTERM] {
        signal_hook::low_level::pipe::register(signal, told.try_clone()?)?;
    }
    Ok(asked)
}

/// Closes the keeper's copies of the program's pipes. Otherwise a pipe that the program closes
/// would stay open.
fn release_pipes() -> io::Result<()> {
    let nothing = fs::OpenOptions::new()
        .read(true)
        .write(true)
        .open("/dev/null")?;
    rustix::stdio::dup2_stdin(&nothing)?;
    rustix::stdio::dup2_stdout(&nothing)?;
    Ok(())
}

/// Waits until the child ends, and returns its exit; `None` if one of the others is ready first.
fn wait(child: &mut Child, others: &[&std::os::fd::OwnedFd]) -> io::Result<Option<ExitStatus>> {
    let Some(id) = pid(child.id()) else {
        return Ok(None);
    };
    let ended = pidfd_open(id, PidfdFlags::empty())?;
    let mut events: Vec<PollFd<'_>> = others
        .iter()
        .copied()
        .chain([&ended])
        .map(|descriptor| PollFd::new(descriptor, PollFlags::IN))
        .collect();
    loop {
        match poll(&mut events, None) {
            Ok(_) => {}
            Err(rustix::io::Errno::INTR) => continue,
            Err(error) => return Err(error.into()),
        }
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if events[..others.len()]
            .iter()
            .any(|event| !event.revents().is_empty())
        {
            return Ok(None);
        }
    }
}

/// Kills children until none is left. The children of a dead one become ours, so that all
/// descendants are killed in the end.
fn end_descendants() {
    let pause = Duration::from_millis(1);
    for _ in 0..PATIENCE.as_millis() {
        while let Ok(Some(_)) = process::wait(WaitOptions::NOHANG) {}
        let children = children();
        if children.is_empty() {
            return;
        }
        for child in children {
            // One that is gone by now needs no signal.
            if let Ok(group) = process::getpgid(Some(child))
                && group != process::getpid()
            {
                let _ = process::kill_process_group(group, Signal::KILL);
            }
            let _ = process::kill_process(child, Signal::KILL);
        }
        thread::sleep(pause);
    }
}

fn children() -> Vec<Pid> {
    let listed = fs::read_to_string("/proc/thread-self/children").unwrap_or_default();
    listed
        .split_whitespace()
        .filter_map(|id| Pid::from_raw(id.parse().ok()?))
        .collect()
}

fn code(status: ExitStatus) -> u8 {
    let code = status
        .code()
        .or_else(|| status.signal().map(|signal| 128 + signal));
    code.and_then(|code| u8::try_from(code).ok())
        .unwrap_or(u8::MAX)
}
