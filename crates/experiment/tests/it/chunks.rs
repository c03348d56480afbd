//! An experiment played in chunks and merged.

use std::fs;

use tolman_experiment::{Chunk, Error, Options, Silent, command_of_chunks, merge, play_chunk};

use crate::darts::Darts;
use crate::support::{Listener, build, fresh, options, read, run};

#[test]
fn merged_chunks_are_what_one_machine_makes() {
    let folder = fresh("chunks");
    let (one, many) = (folder.join("one"), folder.join("many"));
    run(&Darts::new(), &options(&one)).0.unwrap();

    let (darts, options) = ((&Darts::new()).into(), options(&many));
    let play = |number, progress: &Listener| {
        let chunk = Chunk::new(number, 3).unwrap();
        play_chunk(&darts, &options, &build(), chunk, progress)
    };
    assert!(matches!(
        merge(&darts, &options, &build(), &Silent),
        Err(Error::NoChunks { .. })
    ));
    play(1, &Listener::default()).unwrap();
    play(3, &Listener::default()).unwrap();
    let command = command_of_chunks(&many).unwrap();
    assert!(command.starts_with("tolman experiment darts --seed 7 --runs 40"));

    // A machine that is killed leaves what it has; the same command goes on from there.
    let killed = play(2, &Listener::stopping_after(10)).unwrap_err();
    assert!(
        killed
            .to_string()
            .contains("tolman trial --experiment darts --chunk 2/3")
    );
    let error = merge(&darts, &options, &build(), &Silent).unwrap_err();
    assert!(error.to_string().ends_with("again: 2/3"), "{error}");
    let again = Listener::default();
    play(2, &again).unwrap();
    assert!(again.played() < 80);

    let merged = merge(&darts, &options, &build(), &Silent).unwrap();
    assert_eq!(merged.played, 0);
    for name in ["runs.jsonl", "summary.json", "figures/first-run.svg"] {
        assert_eq!(read(&one, name), read(&many, name), "{name}");
    }
}

#[test]
fn chunks_of_another_seed_are_refused() {
    let out = fresh("other chunks");
    let darts = (&Darts::new()).into();
    let other = Options {
        seed: 8,
        ..options(&out)
    };
    for (number, options) in [(1, options(&out)), (2, other)] {
        let chunk = Chunk::new(number, 2).unwrap();
        play_chunk(&darts, &options, &build(), chunk, &Silent).unwrap();
    }
    let error = merge(&darts, &options(&out), &build(), &Silent).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("chunk-2-of-2 holds results of seed 8")
    );
    assert!(fs::exists(out.join("chunk-1-of-2/runs.jsonl")).unwrap());
}
