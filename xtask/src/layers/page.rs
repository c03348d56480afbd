//! Reads the architecture page: two tables and the list of stable crates.

use anyhow::{Context, Result, bail, ensure};

/// The parts of the page that are checked.
#[derive(Debug)]
pub(crate) struct Page {
    /// Rows of the table `crate | layer | library | may use | what`, one per crate.
    pub(crate) crates: Vec<CrateRow>,
    /// Rows of the table `outside crate | seen by | why`.
    pub(super) outside: Vec<OutsideRow>,
    /// Names of the crates with semantic versioning, without `tolman-`; empty if the page has no
    /// such sentence.
    pub(super) stable: Vec<String>,
}

/// A crate of the workspace.
#[derive(Debug)]
pub(crate) struct CrateRow {
    pub(crate) name: String,
    /// Layer of the crate; `None` for a member outside the layers, on which no crate may depend.
    pub(super) layer: Option<u8>,
    pub(crate) library: Library,
    pub(super) may_use: Vec<String>,
}

/// Part of the standard library that a crate needs with its default features off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Library {
    /// The crate builds for bare metal, with or without an allocator.
    NoStd,
    Std,
}

/// An outside crate that only some crates may use.
#[derive(Debug)]
pub(super) struct OutsideRow {
    /// A package name; a `*` at its end stands for anything.
    pub(super) pattern: String,
    pub(super) seen_by: Vec<String>,
}

impl OutsideRow {
    pub(super) fn matches(&self, name: &str) -> bool {
        self.pattern
            .strip_suffix('*')
            .map_or(name == self.pattern, |beginning| {
                name.starts_with(beginning)
            })
    }
}

impl Page {
    /// Reads both tables.
    ///
    /// # Errors
    /// If a table is missing or empty, or a row is not understood.
    pub(super) fn parse(text: &str) -> Result<Self> {
        let crates = ["crate", "layer", "library", "may use", "what"];
        let outside = ["outside crate", "seen by", "why"];
        Ok(Self {
            crates: rows(text, crates, crate_row)?,
            outside: rows(text, outside, outside_row)?,
            stable: stable(text),
        })
    }
}

/// Returns the names in backticks between "Semantic versioning applies" and "The rest".
fn stable(text: &str) -> Vec<String> {
    let sentence = text
        .split_once("Semantic versioning applies")
        .and_then(|(_, after)| after.split_once("The rest"))
        .map_or("", |(sentence, _)| sentence);
    let names = sentence.split('`').skip(1).step_by(2);
    names.map(str::to_owned).collect()
}

fn outside_row([pattern, seen_by, _]: [&str; 3]) -> Result<OutsideRow> {
    Ok(OutsideRow {
        pattern: bare(pattern).to_owned(),
        seen_by: names(seen_by)?,
    })
}

fn crate_row([name, layer, library, may_use, _]: [&str; 5]) -> Result<CrateRow> {
    let layer = match layer {
        "–" => None,
        _ => Some(
            layer
                .strip_prefix('L')
                .and_then(|number| number.parse().ok())
                .with_context(|| format!("layer `{layer}`: write L0, L1, … or –"))?,
        ),
    };
    let library = match library {
        "no_std" | "no_std + alloc" => Library::NoStd,
        "std" => Library::Std,
        _ => bail!("library `{library}`: write no_std, no_std + alloc or std"),
    };
    Ok(CrateRow {
        name: bare(name).to_owned(),
        layer,
        library,
        may_use: names(may_use)?,
    })
}

/// Returns the rows below the header with these columns, each with its line, counted from 1.
pub(super) fn rows<T, const N: usize>(
    text: &str,
    columns: [&str; N],
    read: fn([&str; N]) -> Result<T>,
) -> Result<Vec<T>> {
    let mut lines = (1..).zip(text.lines());
    lines
        .find(|(_, line)| cells(line).is_ok_and(|cells| cells == columns))
        .with_context(|| format!("there is no table | {} |", columns.join(" | ")))?;
    let rows: Vec<_> = lines
        .skip(1) // the rule below the header
        .take_while(|(_, line)| line.starts_with('|'))
        .map(|(line, row)| {
            cells(row)
                .and_then(read)
                .with_context(|| format!("line {line}"))
        })
        .collect::<Result<_>>()?;
    ensure!(
        !rows.is_empty(),
        "the table | {} | has no rows",
        columns.join(" | ")
    );
    Ok(rows)
}

fn cells<const N: usize>(row: &str) -> Result<[&str; N]> {
    let row = row.trim();
    let inner = row.strip_prefix('|').and_then(|row| row.strip_suffix('|'));
    let cells: Vec<_> = inner
        .context("a row begins and ends with |")?
        .split('|')
        .map(str::trim)
        .collect();
    let found = cells.len();
    cells
        .try_into()
        .ok()
        .with_context(|| format!("{found} cells where {N} are expected"))
}

/// Returns the names of a list like `` `a`, `b` ``; a dash stands for none.
pub(super) fn names(cell: &str) -> Result<Vec<String>> {
    if cell == "–" {
        return Ok(Vec::new());
    }
    cell.split(',')
        .map(|name| {
            let name = bare(name.trim());
            ensure!(!name.is_empty(), "an empty name; write – for none");
            Ok(name.to_owned())
        })
        .collect()
}

pub(super) fn bare(code: &str) -> &str {
    code.trim_matches('`')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(row: &str) -> Result<Page> {
        Page::parse(&format!(
            "words\n\n| crate | layer | library | may use | what |\n| --- | --- | --- | --- | --- |\n{row}\n\n\
             | outside crate | seen by | why |\n| --- | --- | --- |\n| `parry2d*` | `sim` | walls |\n"
        ))
    }

    #[test]
    fn reads_both_tables() {
        let page = parse("| `sim` | L2 | std | `geom`, `maze` | worlds |").unwrap();
        assert_eq!(page.crates[0].name, "sim");
        assert_eq!(page.crates[0].layer, Some(2));
        assert_eq!(page.crates[0].library, Library::Std);
        assert_eq!(page.crates[0].may_use, ["geom", "maze"]);
        assert!(page.outside[0].matches("parry2d-f64"));
        assert!(!page.outside[0].matches("parry3d"));
    }

    #[test]
    fn a_row_it_does_not_understand_is_named_with_its_line() {
        let check = |row, expected: &str| {
            let error = format!("{:#}", parse(row).unwrap_err());
            assert!(
                error.contains("line 5") && error.contains(expected),
                "{error}"
            );
        };
        check("| `sim` | 2 | std | – | worlds |", "layer `2`");
        check("| `sim` | L2 | core | – | worlds |", "library `core`");
        check("| `sim` | L2 | std | `geom`, | worlds |", "empty name");
        check("| `sim` | L2 | std | worlds |", "4 cells where 5");
    }
}
