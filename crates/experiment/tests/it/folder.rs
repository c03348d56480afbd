//! The folder of results: resumed, mended, set aside, refused.

use core::sync::atomic::Ordering;
use std::fs;

use serde::{Deserialize, Serialize};
use tolman_experiment::{
    BoxError, Build, Column, Entry, Error, Experiment, Fields, Job, Metric, Options, Procedure,
    Progress, ProgressEvent, Record, Silent, Table, execute, open, record, verify,
};

use crate::darts::{DARTS_ENTRY, Darts, Throws};
use crate::support::{Listener, build, fresh, options, read, run};

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let folder = fresh("threads");
    let files: Vec<(String, String)> = [1, 2, 5]
        .map(|jobs| {
            let out = folder.join(jobs.to_string());
            let options = Options {
                jobs: Some(jobs),
                ..options(&out)
            };
            run(&Darts::new(), &options).0.unwrap();
            (read(&out, "runs.jsonl"), read(&out, "summary.json"))
        })
        .into();
    assert_eq!(files[0].0.lines().count(), 240);
    assert_eq!(files[0], files[1]);
    assert_eq!(files[0], files[2]);
}

#[test]
fn rows_of_a_table_meet_the_same_seeds_and_tables_do_not() {
    let out = fresh("seeds").join("out");
    let outcome = run(&Darts::new(), &options(&out)).0.unwrap();
    let seeds = |table: &str, row: &str| -> Vec<u64> {
        let runs = outcome
            .runs
            .iter()
            .filter(|run| run.table == table && run.row == row);
        runs.map(|run| run.seed).collect()
    };
    assert_eq!(seeds("1 (near)", "Novice"), seeds("1 (near)", "Master"));
    assert_ne!(seeds("1 (near)", "Novice"), seeds("2 (far)", "Novice"));
}

#[test]
fn an_interrupted_experiment_goes_on_where_it_stopped() {
    let folder = fresh("interrupted");
    let (whole, parts) = (folder.join("whole"), folder.join("parts"));
    run(&Darts::new(), &options(&whole)).0.unwrap();
    // An earlier, smaller summary must not be taken for that of the interrupted experiment.
    let few = Options {
        runs: Some(2),
        ..options(&parts)
    };
    run(&Darts::new(), &few).0.unwrap();

    let listener = Listener::stopping_after(100);
    let stopped = execute(
        &(&Darts::new()).into(),
        &options(&parts),
        &build(),
        &listener,
    );
    let Err(
        error @ Error::Interrupted {
            done, total: 240, ..
        },
    ) = stopped
    else {
        panic!("{stopped:?}");
    };
    assert!((100..240).contains(&done) && !error.is_bad_input());
    assert!(
        error
            .to_string()
            .contains("from there with: tolman experiment darts --seed 7 --runs 40")
    );
    assert!(!parts.join("summary.json").exists(), "no summary of a part");

    let (outcome, listener) = run(&Darts::new(), &options(&parts));
    assert_eq!(outcome.unwrap().played, 240 - done);
    assert_eq!(listener.played(), 240 - done);
    assert_eq!(listener.messages(), [format!("{done} of 240")]);
    for file in ["runs.jsonl", "summary.json"] {
        assert_eq!(read(&whole, file), read(&parts, file));
    }
}

#[test]
fn figures_and_replays_are_made_once_however_often_they_are_stopped() {
    let folder = fresh("pictures");
    let (whole, parts) = (folder.join("whole"), folder.join("parts"));
    let in_one_go = Darts::new();
    run(&in_one_go, &options(&whole)).0.unwrap();
    let all = in_one_go.made.load(Ordering::SeqCst);

    // The first stop is after one of two figures, the second after some of the replays.
    let darts = Darts::new();
    for limit in [1, 12] {
        let listener = Listener::stopping_at(&darts.made, limit);
        let stopped = execute(&(&darts).into(), &options(&parts), &build(), &listener);
        let Err(Error::Interrupted { done: 240, .. }) = stopped else {
            panic!("{stopped:?}");
        };
        let made = darts.made.load(Ordering::SeqCst);
        assert!((limit..all).contains(&made), "{made} of {all}");
        assert!(!parts.join("report.html").exists());
    }
    run(&darts, &options(&parts)).0.unwrap();
    assert_eq!(darts.made.load(Ordering::SeqCst), all);
    for file in [
        "pictures.jsonl",
        "figures/first-run.svg",
        "figures/first-far-run.svg",
    ] {
        assert_eq!(read(&whole, file), read(&parts, file), "{file}");
    }

    // Nothing is left to do, until a line is broken or the figures show other runs.
    run(&darts, &options(&parts)).0.unwrap();
    assert_eq!(darts.made.load(Ordering::SeqCst), all);
    let kept = read(&parts, "pictures.jsonl");
    let broken = kept.replacen("Ring: first dart", "Ring: last dart", 1);
    fs::write(parts.join("pictures.jsonl"), broken).unwrap();
    run(&darts, &options(&parts)).0.unwrap();
    assert_eq!(darts.made.load(Ordering::SeqCst), all + 1);
    assert_eq!(read(&parts, "pictures.jsonl"), kept);
    let fewer = Options {
        runs: Some(30),
        ..options(&parts)
    };
    run(&darts, &fewer).0.unwrap();
    assert_eq!(darts.made.load(Ordering::SeqCst), all + 3);
}

#[test]
fn a_table_that_is_left_out_is_not_drawn() {
    let out = fresh("left out").join("out");
    let far = Options {
        tables: vec!["2 (far)".to_owned()],
        ..options(&out)
    };
    let darts = open(&[DARTS_ENTRY], "darts", &far).unwrap();
    run(darts, &far).0.unwrap();
    let kept = read(&out, "pictures.jsonl");
    assert!(kept.contains("figures far") && !kept.contains("figures near"));
}

/// Returns a line as versions without checksums wrote it.
fn without_checksum(line: &str) -> String {
    let (values, _) = line.split_once(",\"checksum\"").unwrap();
    format!("{values}}}")
}

#[test]
fn broken_lines_are_told_and_played_again() {
    let out = fresh("broken").join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let whole = read(&out, "runs.jsonl");
    let mut lines: Vec<Vec<u8>> = whole.lines().map(|line| line.as_bytes().to_vec()).collect();
    lines[2].truncate(30);
    lines[5] = vec![0xff, 0xfe, b'{'];
    lines[9] = String::from_utf8(lines[9].clone())
        .unwrap()
        .replace("Novice", "Nobody")
        .into();
    lines[11] = String::from_utf8(lines[11].clone())
        .unwrap()
        .replace("\"seed\":", "\"seed\":1")
        .into();
    let older = without_checksum(whole.lines().next().unwrap());
    lines.push(older.replace("\"miss\":0", "\"miss\":1").into());
    // As if a process had died while writing a line.
    lines.push(b"{\"table\":\"1 (n".to_vec());
    fs::write(out.join("runs.jsonl"), lines.join(&b'\n')).unwrap();

    let (outcome, listener) = run(&Darts::new(), &options(&out));
    assert_eq!(outcome.unwrap().played, 5);
    let messages = listener.messages();
    let expect = [
        ("runs.jsonl:3: ", "EOF", "MissingPlayed"),
        ("runs.jsonl:6: ", "", "MissingPlayed"),
        ("runs.jsonl:10: ", "no row \"Nobody\"", "MissingPlayed"),
        ("runs.jsonl:12: ", "seed", "PlayedAgain"),
        ("runs.jsonl:241: ", "contradicts", "PlayedAgain"),
        ("runs.jsonl:242: ", "EOF", "MissingPlayed"),
    ];
    assert_eq!(messages.len(), expect.len() + 1, "{messages:?}");
    for (message, (place, what, remedy)) in messages.iter().zip(expect) {
        assert!(
            message.starts_with(place) && message.contains(what) && message.ends_with(remedy),
            "{message}"
        );
    }
    assert_eq!(read(&out, "runs.jsonl"), whole);
}

#[test]
fn lines_of_what_no_run_measures_are_told_and_played_again() {
    let out = fresh("wrong").join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let whole = read(&out, "runs.jsonl");
    let first = whole.lines().next().unwrap();
    let throws = first.find("\"throws\":").unwrap();
    let end = throws + first[throws..].find(['}', ',']).unwrap();
    let with = |value: &str| format!("{}\"throws\":{value}{}", &first[..throws], &first[end..]);
    for wrong in [
        with("\"many\""),
        with("-5"),
        with("1.5"),
        with("1e300"),
        with("true"),
        with("null"),
        with("[3]"),
        with("0"),
        with("11"),
        with("3,\"luck\":1"),
        first.replace("\"throws\"", "\"thrown\""),
        first
            .replace("\"success\":", "\"success\":1")
            .replace("1true", "\"yes\"")
            .replace("1false", "\"no\""),
    ] {
        fs::write(out.join("runs.jsonl"), whole.replacen(first, &wrong, 1)).unwrap();
        let (outcome, listener) = run(&Darts::new(), &options(&out));
        assert_eq!(outcome.unwrap().played, 1, "{wrong}");
        let told = &listener.messages()[0];
        assert!(
            told.starts_with("runs.jsonl:1: ") && told.ends_with("; PlayedAgain"),
            "{wrong}: {told}"
        );
        assert_eq!(read(&out, "runs.jsonl"), whole);

        // It does no harm beside a good line, or if nobody asks for its run.
        fs::write(out.join("runs.jsonl"), format!("{whole}{wrong}\n")).unwrap();
        let (outcome, listener) = run(&Darts::new(), &options(&out));
        assert_eq!(outcome.unwrap().played, 0, "{wrong}");
        assert!(listener.messages()[0].ends_with("; Ignored"), "{wrong}");
    }
}

#[test]
fn a_flipped_digit_is_told_and_its_run_played_again() {
    let out = fresh("flipped").join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let whole = read(&out, "runs.jsonl");
    let verified = |options: &Options| {
        verify(&(&Darts::new()).into(), options, &build(), &out, &Silent).unwrap()
    };
    let found = verified(&options(&out));
    assert_eq!((found.played, found.runs), (240, 240));
    assert!(found.faults.is_empty(), "{found}");

    // The line has another possible value.
    let line = whole.lines().nth(7).unwrap();
    let flipped = match line.contains("\"throws\":3,") {
        true => line.replace("\"throws\":3,", "\"throws\":4,"),
        false => {
            let at = line.find("\"throws\":").unwrap() + 9;
            format!(
                "{}3{}",
                &line[..at],
                &line[at + line[at..].find(',').unwrap()..]
            )
        }
    };
    assert_ne!(flipped, line);
    fs::write(out.join("runs.jsonl"), whole.replacen(line, &flipped, 1)).unwrap();
    let found = verified(&options(&out));
    assert!(
        found.faults[0].starts_with("runs.jsonl, line 8: its values do not have its checksum"),
        "{found}"
    );
    let (outcome, listener) = run(&Darts::new(), &options(&out));
    assert_eq!(outcome.unwrap().played, 1);
    let told = &listener.messages()[0];
    assert!(
        told.starts_with("runs.jsonl:8: ") && told.ends_with("; PlayedAgain"),
        "{told}"
    );
    assert_eq!(read(&out, "runs.jsonl"), whole);
}

#[test]
fn a_folder_is_verified_by_playing_its_runs_again() {
    let out = fresh("verified").join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let verified =
        |options: &Options| verify(&(&Darts::new()).into(), options, &build(), &out, &Silent);
    let one = Options {
        runs: None,
        ..options(&out)
    };
    assert_eq!(
        verified(&one).unwrap().played,
        6,
        "one of each of two tables' rows"
    );

    // Without its checksum a line counts as that of an older version, and only playing reveals the
    // value.
    let whole = read(&out, "runs.jsonl");
    let older: String = whole
        .lines()
        .map(|line| {
            let line = line.replace("\"throws\":2,", "\"throws\":3,");
            format!("{}\n", without_checksum(&line))
        })
        .collect();
    fs::write(out.join("runs.jsonl"), older).unwrap();
    let found = verified(&options(&out)).unwrap();
    assert!(
        found
            .faults
            .iter()
            .any(|fault| fault.contains("throws is 3 and 2 when played")),
        "{found}"
    );
    assert!(
        found.to_string().contains("summary.json does not follow"),
        "{found}"
    );

    let other = Options {
        seed: 8,
        ..options(&out)
    };
    let error = verified(&other).unwrap_err();
    assert!(
        matches!(&error, Error::NotVerifiable { reason, .. } if reason == "seed 7"),
        "{error}"
    );
}

#[test]
fn fewer_or_more_runs_reuse_what_is_there() {
    let folder = fresh("counts");
    let (out, alone) = (folder.join("out"), folder.join("alone"));
    let with = |runs, out| Options {
        runs: Some(runs),
        ..options(out)
    };
    run(&Darts::new(), &with(20, &alone)).0.unwrap();
    run(&Darts::new(), &with(40, &out)).0.unwrap();
    let forty = read(&out, "runs.jsonl");

    assert_eq!(run(&Darts::new(), &with(20, &out)).0.unwrap().played, 0);
    for file in ["runs.jsonl", "summary.json"] {
        assert_eq!(
            read(&out, file),
            read(&alone, file),
            "as if there had never been more"
        );
    }
    assert_eq!(run(&Darts::new(), &with(40, &out)).0.unwrap().played, 0);
    assert_eq!(read(&out, "runs.jsonl"), forty);
    assert!(!out.join("spare.jsonl").exists());
    assert_eq!(run(&Darts::new(), &with(50, &out)).0.unwrap().played, 60);
}

#[test]
fn results_of_another_configuration_are_set_aside_whole() {
    let folder = fresh("aside");
    let out = folder.join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let first = read(&out, "runs.jsonl");

    let seed = Options {
        seed: 8,
        ..options(&out)
    };
    let (outcome, listener) = run(&Darts::new(), &seed);
    assert_eq!(outcome.unwrap().played, 240);
    assert_eq!(listener.messages()[0], "out.1 has seed 7");
    assert_eq!(read(&folder.join("out.1"), "runs.jsonl"), first);

    let wide = Darts {
        reach: 1.5,
        ..Darts::new()
    };
    let (_, listener) = run(&wide, &seed);
    assert_eq!(
        listener.messages()[0],
        "out.2 has another configuration, see config.toml there"
    );

    // A slash at the end of the path does not put the copy inside the folder.
    let slashed = Options {
        out: Some(out.join("")),
        ..seed
    };
    let other = Build {
        executable: "11".into(),
        ..build()
    };
    let listener = Listener::default();
    execute(&(&wide).into(), &slashed, &other, &listener).unwrap();
    assert_eq!(
        listener.messages()[0],
        "out.3 has another build, of commit 0123456789"
    );
    assert!(folder.join("out.3").join("report.html").exists());
}

#[test]
fn folders_of_others_are_left_alone() {
    let folder = fresh("foreign");
    let documents = folder.join("documents");
    fs::create_dir(&documents).unwrap();
    fs::write(documents.join("thesis.txt"), "years of work").unwrap();
    let error = run(&Darts::new(), &options(&documents)).0.unwrap_err();
    assert!(matches!(error, Error::ForeignFolder { .. }) && error.is_bad_input());
    assert!(error.to_string().contains("thesis.txt"), "{error}");

    let project = folder.join("project");
    fs::create_dir(&project).unwrap();
    fs::write(project.join("config.toml"), "title = \"not ours\"").unwrap();
    let error = run(&Darts::new(), &options(&project)).0.unwrap_err();
    assert!(matches!(error, Error::ForeignFolder { .. }));
    assert_eq!(read(&project, "config.toml"), "title = \"not ours\"");

    let file = folder.join("file");
    fs::write(&file, "").unwrap();
    for path in [file.clone(), file.join("below")] {
        let error = run(&Darts::new(), &options(&path)).0.unwrap_err();
        let Error::File { path: place, .. } = error else {
            panic!("{error:?}")
        };
        assert_eq!(place, path);
    }
}

#[test]
fn a_folder_is_open_only_once_at_a_time() {
    /// Runs the same experiment again while the first one has begun.
    struct Intruder<'a>(&'a Options);
    impl Progress for Intruder<'_> {
        fn event(&self, event: &ProgressEvent<'_>) {
            if matches!(event, ProgressEvent::Started { .. }) {
                let error =
                    execute(&(&Darts::new()).into(), self.0, &build(), &Silent).unwrap_err();
                assert!(matches!(error, Error::Busy { .. }), "{error:?}");
            }
        }
    }
    let out = fresh("busy").join("out");
    let options = options(&out);
    execute(
        &(&Darts::new()).into(),
        &options,
        &build(),
        &Intruder(&options),
    )
    .unwrap();
    execute(&(&Darts::new()).into(), &options, &build(), &Silent).unwrap();
}

#[test]
fn options_that_run_nothing_or_too_much_are_refused_before_anything_is_written() {
    let out = fresh("zero").join("out");
    for (options, option) in [
        (
            Options {
                runs: Some(0),
                ..options(&out)
            },
            "--runs",
        ),
        (
            Options {
                runs: Some(Options::MOST_RUNS + 1),
                ..options(&out)
            },
            "--runs 100000 or fewer",
        ),
        (
            Options {
                runs: Some(u32::MAX),
                ..options(&out)
            },
            "4294967295 runs",
        ),
        (
            Options {
                jobs: Some(0),
                ..options(&out)
            },
            "--jobs",
        ),
        (
            Options {
                seed: 1 << 63,
                ..options(&out)
            },
            "seed",
        ),
    ] {
        let error = run(&Darts::new(), &options).0.unwrap_err();
        assert!(
            error.is_bad_input() && error.to_string().contains(option),
            "{error}"
        );
        assert!(!out.exists());
    }
}

#[test]
fn tables_that_contradict_themselves_are_refused() {
    let out = fresh("unsound").join("out");
    type Spoil = fn(&mut Vec<Table>);
    let spoil: [(Spoil, &str); 13] = [
        (|tables| tables.clear(), "no table"),
        (|tables| tables[1].name = "1 (near)".into(), "two tables"),
        (
            |tables| tables[0].rows[1].name = "Novice".into(),
            "two rows",
        ),
        (
            |tables| tables[0].metrics[1].name = "miss".into(),
            "two metrics",
        ),
        (
            |tables| tables[0].rows[0].paper[0].metric = "luck".into(),
            "not a metric",
        ),
        (
            |tables| tables[0].rows[1].name = "Expert".into(),
            "not a row",
        ),
        (
            |tables| tables[1].metrics[2].name = "THROWS".into(),
            "two figures",
        ),
        (
            |tables| tables[1].metrics[2].name = "m".repeat(200),
            "cannot name a figure",
        ),
        (
            |tables| tables[0].metrics.push(Metric::mean("luck")),
            "not a field",
        ),
        (
            |tables| tables[0].metrics.push(Metric::mean("success")),
            "not a field of kind [Count, Number]",
        ),
        (
            |tables| tables[0].record = Table::of::<Twice>("", "").record,
            "two fields",
        ),
        (
            |tables| tables[0].record = Table::of::<Named>("", "").record,
            "identifies a run",
        ),
        (
            |tables| tables[0] = tables[0].clone().at_most(Throws::throws, 0),
            "leaves no value",
        ),
    ];
    for (spoil, what) in spoil {
        let mut darts = Darts::new();
        spoil(&mut darts.tables);
        let error = run(&darts, &options(&out)).0.unwrap_err();
        assert!(
            matches!(error, Error::Tables { .. }) && error.to_string().contains(what),
            "{error}"
        );
        assert!(!out.exists(), "refused before the first run");
    }
}

/// A record with fewer fields than columns: [`Throws`] and others.
macro_rules! miscast {
    ($name:ident, $columns:expr) => {
        #[derive(Serialize, Deserialize)]
        struct $name {
            success: bool,
            throws: u64,
        }
        impl Record for $name {
            fn columns() -> Vec<Column> {
                [$columns, Throws::columns()].concat()
            }
        }
    };
}
miscast!(Twice, vec![Column::of::<u64>("throws", "")]);
miscast!(Named, vec![Column::of::<u64>("run", "")]);

record! {
    /// A run with a field that no table has.
    struct Strange {
        /// The field that it has twice.
        seed: u64 => neither("seed"),
    }
}

/// Darts whose run 3 of Adept from far away gives the fields of the test.
#[derive(Debug)]
struct Spoilt(Fields);

impl From<Spoilt> for Experiment {
    fn from(spoilt: Spoilt) -> Self {
        let entry = Entry {
            runs: 5,
            ..DARTS_ENTRY
        };
        Self::new(entry, Darts::new().tables, toml::Table::new(), spoilt)
    }
}

impl Procedure for Spoilt {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        if (job.table, job.row, job.run) == ("2 (far)", "Adept", 3) {
            return Ok(self.0.clone());
        }
        Darts::new().run(job)
    }
}

/// Returns a hit without any other facts.
fn hit() -> Throws {
    Throws {
        success: true,
        throws: 1,
        outcome: None,
        miss: None,
    }
}

#[test]
fn a_run_that_measures_nonsense_is_named() {
    let missed = |miss: f64| {
        let miss = Some(miss);
        Throws { miss, ..hit() }.fields().unwrap()
    };
    for (i, (fields, what)) in [
        (missed(f64::NAN), "NaN"),
        (missed(f64::INFINITY), "inf"),
        (missed(-1.0), "expected 0 or more"),
        (Strange { seed: 3 }.fields().unwrap(), "seed"),
    ]
    .into_iter()
    .enumerate()
    {
        let out = fresh(&format!("nonsense-{i}")).join("out");
        let error = run(
            Spoilt(fields),
            &Options {
                runs: None,
                ..options(&out)
            },
        )
        .0
        .unwrap_err();
        let Error::Run {
            table,
            row,
            run: 3,
            source,
            ..
        } = &error
        else {
            panic!("{error:?}")
        };
        assert_eq!((table.as_str(), row.as_str()), ("2 (far)", "Adept"));
        assert!(source.to_string().contains(what), "{source}");
        assert!(out.join("runs.jsonl").exists(), "what was finished is kept");
    }
}

#[test]
fn a_field_that_some_runs_lack_is_measured_on_the_others() {
    let out = fresh("lacking").join("out");
    let outcome = run(
        Spoilt(hit().fields().unwrap()),
        &Options {
            runs: None,
            ..options(&out)
        },
    )
    .0
    .unwrap();
    let n = |metric: &str| {
        let mut rows = outcome.summary.rows.iter();
        rows.find(|row| row.table == "2 (far)" && row.row == "Adept" && row.metric == metric)
            .unwrap()
            .n
    };
    assert_eq!((n("throws"), n("miss")), (5, 4));
}
