//! The files that a run writes. Before any work begins, each is known to be writable, and none is a
//! file that the run reads.

use core::ops::Deref;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::{Context, anyhow};
use clap::ArgMatches;
use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::parser::ValueSource;
use tolman_experiment::files;
use tolman_formats::input;

use super::kind::Kind;
use super::{Failure, OrBadInput, Result, replay_file};

/// A file or a folder that an option names as a place to write to.
#[derive(Clone, Debug)]
pub(super) struct Output {
    path: PathBuf,
    /// Names of the files that are written into the folder; `None` if this is a file itself.
    holds: Option<&'static [&'static str]>,
}

impl Output {
    /// Returns the folder at `path`, into which files with these names are written.
    pub(super) const fn folder(path: PathBuf, holds: &'static [&'static str]) -> Self {
        let holds = Some(holds);
        Self { path, holds }
    }
}

impl Deref for Output {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.path
    }
}

/// Endings that promise a format.
const KNOWN: &[&str] = &[
    "avif", "bag", "csv", "eps", "g2o", "gif", "gz", "htm", "html", "jpeg", "jpg", "json", "jsonl",
    "maze", "mcap", "mp4", "ndjson", "pdf", "pgm", "png", "rrd", "svg", "toml", "tum", "webm",
    "webp", "yaml", "yml", "zip",
];

/// Endings of replays, beside those of the formats that this program has.
pub(super) const REPLAYS: &[&str] = &["html", "htm", "mcap", "rrd"];

/// Returns a parser of file names. It refuses a name whose ending promises a format other than
/// `endings`.
pub(super) fn file(endings: &'static [&'static str]) -> impl TypedValueParser<Value = Output> {
    PathBufValueParser::new().try_map(move |path| {
        let ending = path.extension().unwrap_or_default();
        let ending = ending.to_string_lossy().to_lowercase();
        let is_replay = || endings == REPLAYS && replay_file::has_format(&ending);
        let fits = endings.contains(&&*ending) || is_replay();
        match KNOWN.contains(&&*ending) && !fits {
            true => Err(format!(
                "this option writes no .{ending} file; end the name in .{}",
                endings.join(" or .")
            )),
            false => Ok(Output { path, holds: None }),
        }
    })
}

/// Returns a parser of the name of a folder, into which files called `holds` are written.
pub(super) fn folder(holds: &'static [&'static str]) -> impl TypedValueParser<Value = Output> {
    PathBufValueParser::new().map(move |path| Output::folder(path, holds))
}

/// A file that the run reads or writes, and the option that names it.
struct Named {
    option: String,
    path: PathBuf,
    file: Option<FileId>,
}

/// Identity of a file, whatever its name.
#[derive(PartialEq)]
enum FileId {
    #[cfg(unix)]
    Inode(u64, u64),
    Path(PathBuf),
}

impl FileId {
    /// Returns the identity of the file at `path`, which need not exist; `None` for what can be
    /// read and written at once, such as a device.
    fn of(path: &Path) -> Option<Self> {
        match fs::metadata(path) {
            Ok(there) if !there.is_file() => None,
            #[cfg(unix)]
            Ok(there) => {
                use std::os::unix::fs::MetadataExt;
                Some(Self::Inode(there.dev(), there.ino()))
            }
            #[cfg(not(unix))]
            Ok(_) => Some(Self::Path(fs::canonicalize(path).ok()?)),
            Err(_) => {
                let folder = path.parent().filter(|folder| *folder != Path::new(""));
                let folder = fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()?;
                Some(Self::Path(folder.join(path.file_name()?)))
            }
        }
    }
}

impl Named {
    fn new(option: &str, path: &Path) -> Self {
        Self {
            option: option.to_owned(),
            file: FileId::of(path),
            path: path.to_owned(),
        }
    }

    fn is(&self, other: &Self) -> bool {
        self.file.is_some() && self.file == other.file
    }

    /// Returns whether the run continues from this file and may put what comes of it in its place.
    fn goes_on_in(&self, output: &Self) -> bool {
        let is_run = || input::text(&self.path).is_ok_and(|text| Kind::Unfinished.is_of(&text));
        self.option == "from"
            && match output.option.as_str() {
                "out" => !is_run(),
                "unfinished" => is_run(),
                _ => false,
            }
    }
}

/// The files that this run is known to read and to write.
#[derive(Default)]
struct Files {
    read: Vec<Named>,
    written: Vec<Named>,
}

static FILES: Mutex<Files> = Mutex::new(Files {
    read: Vec::new(),
    written: Vec::new(),
});

fn files() -> MutexGuard<'static, Files> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Checks all outputs that the command line names.
///
/// # Errors
/// Bad input if one cannot be written, is read as well, or is named twice.
pub(super) fn check(mut matches: &ArgMatches) -> Result {
    *files() = Files::default();
    while let Some((_, of_verb)) = matches.subcommand() {
        matches = of_verb;
    }
    // What verifies a folder reads it.
    let verify = matches
        .try_contains_id("verify")
        .is_ok_and(|_| matches.value_source("verify") == Some(ValueSource::CommandLine));
    if verify {
        return Ok(());
    }
    for id in matches.ids() {
        let inputs = matches.try_get_many::<PathBuf>(id.as_str()).ok().flatten();
        for path in inputs.into_iter().flatten() {
            reads(id.as_str(), path)?;
        }
    }
    for id in matches.ids() {
        let outputs = matches.try_get_many::<Output>(id.as_str()).ok().flatten();
        for output in outputs.into_iter().flatten() {
            writes(id.as_str(), output)?;
        }
    }
    Ok(())
}

/// Notes that the run reads `path`: a file, standard input, or the files of a folder.
///
/// # Errors
/// Bad input if the run writes the same file.
pub(super) fn reads(option: &str, path: &Path) -> Result {
    let paths = match path {
        _ if path.is_dir() => files::files_in(path).unwrap_or_default(),
        _ if path.as_os_str() == "-" => vec!["/dev/stdin".into()],
        _ => vec![path.to_owned()],
    };
    let mut files = files();
    for path in paths.into_iter().filter(|path| path.exists()) {
        let input = Named::new(option, &path);
        files
            .written
            .iter()
            .try_for_each(|output| refuse_same(&input, output))?;
        files.read.push(input);
    }
    Ok(())
}

/// Notes that the run writes `output`, and checks that it can.
///
/// # Errors
/// Bad input if it cannot, or if the run reads the same file or writes it for another option.
pub(super) fn writes(option: &str, output: &Output) -> Result {
    let path = &output.path;
    match output.holds {
        None => note(option, path)?,
        Some(names) => names
            .iter()
            .try_for_each(|name| note(option, &path.join(name)))?,
    }
    let probe = match output.holds {
        None => path.clone(),
        Some(_) => {
            let there = path.ancestors().find(|folder| folder.exists());
            there.unwrap_or(Path::new(".")).join(".tolman.tmp")
        }
    };
    let what = if output.holds.is_some() { "into " } else { "" };
    files::check_writable(&probe)
        .with_context(|| {
            format!(
                "cannot write {what}{}: give a path in a folder that can be written to",
                path.display()
            )
        })
        .or_bad_input()
}

/// Notes that the run may write the file at `path`, for an option that has a default.
///
/// # Errors
/// Bad input if the run reads the same file or writes it for another option.
pub(super) fn note(option: &str, path: &Path) -> Result {
    let output = Named::new(option, path);
    let mut files = files();
    files
        .read
        .iter()
        .try_for_each(|input| refuse_same(input, &output))?;
    if let Some(other) = files.written.iter().find(|other| other.is(&output)) {
        return Err(Failure::BadInput(anyhow!(
            "--{} and --{option} both write {}: name two files",
            other.option,
            path.display()
        )));
    }
    files.written.push(output);
    Ok(())
}

fn refuse_same(input: &Named, output: &Named) -> Result {
    if !input.is(output) || input.goes_on_in(output) {
        return Ok(());
    }
    Err(Failure::BadInput(anyhow!(
        "--{} {}: this run reads that file, {}; give another name",
        output.option,
        output.path.display(),
        input.path.display()
    )))
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use alloc::collections::BTreeSet;
    use core::any::TypeId;
    use std::env;
    use std::os::unix::fs::symlink;

    use clap::{Arg, Command, CommandFactory};

    use super::*;
    use crate::cli::Arguments;

    /// Command lines that are complete, and the options and arguments by which each verb reads
    /// files. All others that name a file must be an [`Output`].
    const VERBS: &[(&str, &str)] = &[
        ("arena", "mazes"),
        ("arena --maze other", "maze_files"),
        ("arena --league other", "league"),
        ("audit other", "graph"),
        ("brain --system mslst --robot other", "robot"),
        ("demo --maze other", "maze_file"),
        ("demo other", "maze"),
        ("drive --map other --maze other", "map maze_file from"),
        ("drive --map map other", "maze"),
        ("drive --map other --world other", "world"),
        ("experiment baselines --maze other", "mazes compare verify"),
        ("host --maze other -- true", "maze_file"),
        ("host other -- true", "maze"),
        ("host --world other -- true", "world"),
        ("judge other --system mslst --maze other", "run maze"),
        (
            "learn --system cpm --maze other --out new",
            "maze_file from",
        ),
        ("learn --system cpm other --out new", "maze"),
        ("learn --system cpm --world other --out new", "world"),
        ("man", ""),
        ("map --log other --out new", "log closures list"),
        ("map check other --maze other", "file maze_file"),
        ("map check map other", "maze"),
        ("map check other --world other", "world"),
        ("map plan other", "file"),
        ("map show other --maze other", "file maze_file"),
        ("map show map other", "maze"),
        ("map show other --world other", "world"),
        ("maze check other", "files"),
        ("maze convert other", "file"),
        ("maze diff other other", "one other"),
        ("maze distinct other", "mazes"),
        ("maze generate perfect", ""),
        ("maze show other", "file"),
        ("merge other", "results"),
        ("mms-host --mouse true --maze other", "maze_file"),
        ("mms-host --mouse true other", "maze"),
        ("mouse --maze other", "maze_file"),
        ("mouse other", "maze"),
        ("pitch gather pitch --out new", ""),
        ("pitch score other", "file"),
        ("pitch show other", "file"),
        ("pitch world pitch", ""),
        ("race --maze other", "maze_file"),
        ("race other", "maze mouse"),
        ("replay other", "traces"),
        ("run --system avoid --maze other", "maze_file from"),
        ("run avoid other", "maze"),
        ("run avoid --world other", "world"),
        ("score --trajectory other --truth other", "trajectory truth"),
        ("score --trajectory other --relations other", "relations"),
        ("trial --experiment baselines --chunk 1/1", "mazes"),
    ];

    /// Returns the command of a verb, and of each verb below it, with the verb's name.
    fn verbs(name: &str, command: &Command, into: &mut Vec<(String, Command)>) {
        into.push((name.trim_start().to_owned(), command.clone()));
        for below in command.get_subcommands() {
            verbs(&format!("{name} {}", below.get_name()), below, into);
        }
    }

    fn is_of<T: 'static>(arg: &Arg) -> bool {
        arg.get_value_parser().type_id() == TypeId::of::<T>()
    }

    /// Returns `words` with this value of an option.
    fn with(words: &[String], arg: &Arg, value: &str) -> Vec<String> {
        let mut words = words.to_vec();
        let Some(long) = arg.get_long() else {
            let place = words.iter().position(|word| word == "other");
            match place {
                Some(place) => words[place] = value.to_owned(),
                None => words.push(value.to_owned()),
            }
            return words;
        };
        let option = format!("--{long}");
        let place = words.iter().position(|word| *word == option);
        if let Some(place) = place {
            words[place + 1] = value.to_owned();
            return words;
        }
        let end = words.iter().position(|word| word == "--");
        let end = end.unwrap_or(words.len());
        words.splice(end..end, [option, value.to_owned()]);
        words
    }

    #[test]
    fn no_output_of_any_verb_takes_the_place_of_an_input() {
        let folder = env::temp_dir().join(format!("tolman-outputs-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = |name: &str| folder.join(name).display().to_string();
        fs::write(path("input"), "precious").unwrap();
        fs::hard_link(path("input"), path("hard")).unwrap();
        symlink("input", path("soft")).unwrap();
        let mut all = Vec::new();
        verbs("", &Arguments::command(), &mut all);
        let mut tried = 0;
        for (verb, command) in &all {
            let mut inputs = BTreeSet::new();
            for (line, names) in VERBS {
                let is_of_verb = line.strip_prefix(verb.as_str());
                let is_of_verb =
                    is_of_verb.is_some_and(|rest| rest.is_empty() || rest.starts_with(' '));
                let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
                // A verb below this one has a line of its own.
                let below = verb.split(' ').count();
                let is_below = words
                    .get(below)
                    .is_some_and(|word| command.find_subcommand(word).is_some());
                if !is_of_verb || is_below || verb.is_empty() {
                    continue;
                }
                for input in names.split_whitespace() {
                    inputs.insert(input);
                    let input = command
                        .get_arguments()
                        .find(|arg| arg.get_id() == input)
                        .unwrap();
                    for output in command.get_arguments().filter(|arg| is_of::<Output>(arg)) {
                        for name in ["input", "hard", "soft"] {
                            let words = with(&words, input, &path("input"));
                            let words = with(&words, output, &path(name));
                            let words = ["tolman".to_owned()].into_iter().chain(words);
                            let Ok(matches) =
                                Arguments::command().try_get_matches_from(words.clone())
                            else {
                                // The two exclude each other.
                                continue;
                            };
                            let checked = check(&matches);
                            let goes_on = input.get_id() == "from" && output.get_id() == "out";
                            let words: Vec<String> = words.collect();
                            match checked {
                                Ok(()) => assert!(goes_on, "{words:?}"),
                                Err(Failure::BadInput(_)) => tried += 1,
                                Err(failure) => panic!("{words:?}: {failure:?}"),
                            }
                        }
                    }
                }
            }
            let known = command.get_arguments().filter(|arg| is_of::<PathBuf>(arg));
            let known: BTreeSet<&str> = known.map(|arg| arg.get_id().as_str()).collect();
            assert_eq!(inputs, known, "{verb}: which of these does it read?");
        }
        assert!(tried > 100, "{tried}");
        assert_eq!(fs::read_to_string(path("input")).unwrap(), "precious");
        fs::remove_dir_all(&folder).unwrap();
    }
}
