//! Differences between two folders of results, run by run and bit by bit.

use alloc::collections::{BTreeMap, BTreeSet};
use core::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use super::at::at;
use super::{Error, Fields, Run, runs_file};

/// Returns the differences between the `runs.jsonl` of two folders of results. Values have to agree
/// to the last bit; the order of lines does not matter. Other files in the folders are not read.
///
/// # Errors
/// - [`Error::File`] if a folder has no readable `runs.jsonl`.
/// - [`Error::NoRuns`] if a line of it is not a run, or repeats one.
pub fn compare(first: &Path, second: &Path) -> Result<Differences, Error> {
    let (a, b) = (runs_of(first)?, runs_of(second)?);
    let keys: BTreeSet<&Key> = a.keys().chain(b.keys()).collect();
    let mut differences = Differences {
        first: first.to_owned(),
        second: second.to_owned(),
        runs: keys.len(),
        rows: BTreeMap::new(),
    };
    for key in keys {
        for (what, change) in changes(a.get(key), b.get(key)) {
            let (table, row, run) = key;
            let rows = &mut differences.rows;
            let found = rows
                .entry((table.clone(), row.clone(), what))
                .or_insert_with(|| Found {
                    run: *run,
                    change,
                    runs: 0,
                });
            found.runs += 1;
        }
    }
    Ok(differences)
}

/// Table, row and index of a run.
type Key = (String, String, u32);

/// The differences between two folders of results. [`Display`](fmt::Display) writes a line for each
/// field of a row.
#[derive(Clone, Debug)]
pub struct Differences {
    first: PathBuf,
    second: PathBuf,
    runs: usize,
    /// Differences by table, row and field.
    rows: BTreeMap<(String, String, String), Found>,
}

/// A difference in one field of a row.
#[derive(Clone, Debug)]
struct Found {
    /// Index of the first run with the difference.
    run: u32,
    /// Difference in that run, in words.
    change: String,
    /// Number of runs with the difference.
    runs: usize,
}

impl Differences {
    /// Returns whether both folders hold the same runs with the same values.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}

impl fmt::Display for Differences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (first, second) = (self.first.display(), self.second.display());
        if self.is_empty() {
            return write!(f, "{first} and {second} agree in all {} runs", self.runs);
        }
        write!(f, "{first} and {second} differ:")?;
        for ((table, row, what), found) in &self.rows {
            let Found { run, change, runs } = found;
            write!(
                f,
                "\n  table {table}, row {row}: {what} {change} in run {run}"
            )?;
            if *runs > 1 {
                write!(f, " and {} more", runs - 1)?;
            }
        }
        Ok(())
    }
}

/// Returns the differences between two runs with the same key: the name of each field, or `the
/// run`, and the difference in words.
pub(super) fn changes(a: Option<&Run>, b: Option<&Run>) -> Vec<(String, String)> {
    let (Some(a), Some(b)) = (a, b) else {
        let what = told(a.map(|_| ""), b.map(|_| ""));
        return vec![("the run".to_owned(), what)];
    };
    if a.seed != b.seed {
        return vec![("seed".to_owned(), format!("is {} and {}", a.seed, b.seed))];
    }
    let fields = a.fields.iter().chain(b.fields.iter());
    let names: BTreeSet<&str> = fields.map(|(name, _)| name).collect();
    let changed = names.into_iter().filter_map(|name| {
        let (one, other) = (written(&a.fields, name), written(&b.fields, name));
        let is_changed = one != other;
        is_changed.then(|| (name.to_owned(), told(one.as_deref(), other.as_deref())))
    });
    changed.collect()
}

/// Returns the text of a field in the file, which has all its bits.
fn written(fields: &Fields, name: &str) -> Option<String> {
    let field = fields.get(name)?;
    Some(serde_json::to_string(field).unwrap_or_default())
}

fn told(one: Option<&str>, other: Option<&str>) -> String {
    match (one, other) {
        (Some(one), Some(other)) => {
            // Curves are long, so only their first difference is shown.
            let differs = |(a, b): &(&str, &str)| a != b;
            let parted = one.split(',').zip(other.split(',')).find(differs);
            let (one, other) = parted.unwrap_or((one, other));
            let plain = |text: &str| text.trim_matches(['[', ']']).to_owned();
            format!("is {} and {}", plain(one), plain(other))
        }
        (Some(_), None) => "stands only in the first".to_owned(),
        (None, _) => "stands only in the second".to_owned(),
    }
}

fn runs_of(folder: &Path) -> Result<BTreeMap<Key, Run>, Error> {
    let path = folder.join("runs.jsonl");
    let text = at("read", &path, fs::read_to_string(&path))?;
    let mut runs = BTreeMap::new();
    for (line, text) in (1..).zip(text.lines()) {
        let refuse = |what: String| Error::NoRuns {
            path: path.clone(),
            line,
            what,
        };
        let (run, intact) = runs_file::read_line::<Run>(text.as_bytes())
            .map_err(|error| refuse(error.to_string()))?;
        intact.map_err(refuse)?;
        let key = (run.table.clone(), run.row.clone(), run.run);
        if runs.insert(key, run).is_some() {
            return Err(refuse("it repeats a run".to_owned()));
        }
    }
    Ok(runs)
}

#[cfg(test)]
mod tests {
    use std::{env, process};

    use super::*;

    fn folder(name: &str, runs: &str) -> PathBuf {
        let folder = env::temp_dir().join(format!("tolman-compare-{}-{name}", process::id()));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("runs.jsonl"), runs).unwrap();
        folder
    }

    const ONE: &str = r#"{"table":"1","row":"a","run":0,"seed":7,"steps":12,"way":[1.0,2.5]}"#;

    #[test]
    fn equal_runs_in_any_order_agree() {
        let two = ONE.replace("\"run\":0", "\"run\":1");
        let a = folder("order-a", &format!("{ONE}\n{two}\n"));
        let b = folder("order-b", &format!("{two}\n{ONE}\n"));
        let found = compare(&a, &b).unwrap();
        assert!(found.is_empty(), "{found}");
        assert!(found.to_string().ends_with("agree in all 2 runs"));
    }

    #[test]
    fn what_differs_is_told_by_table_row_and_field() {
        let a = folder("differ-a", ONE);
        for (other, expect) in [
            (
                ONE.replace("2.5", "2.5000000000000004"),
                "table 1, row a: way is 2.5 and 2.5000000000000004 in run 0",
            ),
            (ONE.replace("12", "13"), "steps is 12 and 13 in run 0"),
            (ONE.replace("7", "8"), "seed is 7 and 8"),
            (
                ONE.replace("steps", "hops"),
                "hops stands only in the second",
            ),
            (String::new(), "the run stands only in the first in run 0"),
        ] {
            let b = folder("differ-b", &other);
            let found = compare(&a, &b).unwrap();
            assert!(!found.is_empty());
            assert!(found.to_string().contains(expect), "{found}");
        }
    }

    #[test]
    fn a_line_that_is_no_run_is_refused_with_its_number() {
        let a = folder("broken-a", ONE);
        for (text, number) in [(format!("{ONE}\n{{"), 2), (format!("{ONE}\n{ONE}"), 2)] {
            let b = folder("broken-b", &text);
            let error = compare(&a, &b).unwrap_err();
            assert!(
                matches!(&error, Error::NoRuns { line, .. } if *line == number),
                "{error}"
            );
        }
        assert!(matches!(
            compare(&a, Path::new("/nowhere")),
            Err(Error::File { .. })
        ));
    }
}
