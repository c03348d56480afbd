//! `cargo xtask fuzz`: mutated files for all readers, or for one, as many as there is time for.
#![expect(clippy::print_stderr, reason = "it reports on stderr")]

use core::error::Error;
use core::time::Duration;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use std::{env, fs, panic};

use tests::fuzz::{Campaign, FuzzTarget, TARGETS};

/// The files between two looks at the clock.
const BATCH: u32 = 100;

/// A reader is told no further faults than these.
const MOST_FAULTS: usize = 5;

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Returns whether no reader is at fault. Arguments: the seconds, the seed, the folder for files
/// that show a fault, and the names of targets, all if there are none.
fn run() -> Result<bool, Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [seconds, seed, folder, names @ ..] = &arguments[..] else {
        return Err("give seconds, a seed, a folder, and names of targets".into());
    };
    let (seconds, seed): (u64, u64) = (seconds.parse()?, seed.parse()?);
    let mut targets: Vec<&'static FuzzTarget> = TARGETS.iter().collect();
    if !names.is_empty() {
        let named = names.iter().map(|name| {
            FuzzTarget::named(name).ok_or_else(|| format!("there is no target {name}"))
        });
        targets = named.collect::<Result<_, _>>()?;
    }
    limit_memory();
    // What panics is told in the table, once.
    panic::set_hook(Box::new(|_| {}));
    let share = Duration::from_secs(seconds) / targets.len().max(1) as u32;
    eprintln!(
        "{:<20} {:>9} {:>8} {:>11} {:>10}  faults",
        "target", "files", "taken, %", "slowest, ms", "most, KiB"
    );
    let (mut files, mut faults) = (0, 0);
    for target in targets {
        let began = Instant::now();
        let mut campaign = Campaign::new(target, seed)?;
        while began.elapsed() < share && campaign.findings().faults.len() < MOST_FAULTS {
            campaign.go_on(BATCH);
        }
        let findings = campaign.findings();
        eprintln!(
            "{:<20} {:>9} {:>8.1} {:>11.1} {:>10}  {}",
            target.name,
            findings.files,
            100.0 * findings.taken as f64 / findings.files.max(1) as f64,
            1000.0 * findings.slowest.as_secs_f64(),
            findings.most_memory >> 10,
            findings.faults.len()
        );
        for (number, (file, fault)) in findings.faults.iter().enumerate() {
            fs::create_dir_all(folder)?;
            let path = Path::new(folder).join(format!("{}-{number}", target.name));
            fs::write(&path, file)?;
            eprintln!("  {}: {fault}", path.display());
        }
        files += findings.files;
        faults += findings.faults.len();
    }
    eprintln!("{files} files, {faults} faults");
    Ok(faults == 0)
}

/// No process of this program gets more than 4 GiB. A reader that asks for more ends it; the target
/// whose line is missing is the one.
fn limit_memory() {
    #[cfg(target_os = "linux")]
    {
        use rustix::process::{Resource, Rlimit, setrlimit};
        let most = Some(4 << 30);
        let limit = Rlimit {
            current: most,
            maximum: most,
        };
        if let Err(error) = setrlimit(Resource::As, limit) {
            eprintln!("memory is not limited: {error}");
        }
    }
}
