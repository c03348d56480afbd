//! A table of your own, beside the values of a paper: tosses of a coin until it shows heads.
#![expect(clippy::print_stdout, reason = "its table is its result")]

use tolman_experiment::{BoxError, Build, Entry, Experiment, Fields, Ink, Job, Metric, Options};
use tolman_experiment::{Procedure, Record, Row, Silent, Table, Tolerance, execute, open, record};

record! {
    /// One game.
    struct Game {
        /// Number of tosses until the coin showed heads.
        tosses: u32 => neither("tosses").at_least(1).tolerance(CLOSE),
    }
}

#[derive(Debug)]
struct Coins;

impl Procedure for Coins {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let at_once = if job.row == "one by one" { 1 } else { 2 };
        let tosses = (job.seed.trailing_zeros() + 1).next_multiple_of(at_once);
        Ok(Game { tosses }.fields()?)
    }
}

const CLOSE: Tolerance = Tolerance::absolute(0.3, "a third of a toss is little");
const COINS: Entry = Entry {
    name: "coins",
    title: "Tosses until heads",
    source: "",
    runs: 1000,
    quick_runs: 10,
    main: &[],
    tour: &[],
    open: |_| {
        let table = Table::of::<Game>("1", "A fair coin")
            .metric(Metric::mean(Game::tosses))
            .paper_runs(1000)
            .row(Row::new("one by one").paper(Game::tosses, 2.0))
            .row(Row::new("two by two").paper(Game::tosses, 8.0 / 3.0));
        let config = toml::Table::new();
        Ok(Experiment::new(COINS, vec![table], config, Coins))
    },
};

fn main() -> Result<(), BoxError> {
    let folder = std::env::temp_dir().join(format!("coins-{}", std::process::id()));
    let options = Options {
        out: Some(folder.clone()),
        ..Options::default()
    };
    let coins = open(&[COINS], "coins", &options)?;
    let outcome = execute(&coins, &options, &Build::current("", ""), &Silent)?;
    let text = tolman_experiment::tables_as_text(&outcome.analysis, Ink::Plain);
    println!("{text}");
    assert_eq!(outcome.analysis.disagreements().count(), 0);
    std::fs::remove_dir_all(folder)?;
    Ok(())
}
