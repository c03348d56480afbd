//! Checks that every public name means one thing: no two types have the same name, except for those
//! in the glossary's table.

use alloc::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result};

use super::page::{bare, names, rows};
use crate::workspace::{entries, read};

/// A name that several types may have, as the table `name | where | why it is one thing` says.
#[derive(Debug)]
struct Allowed {
    name: String,
    /// Modules that define the name, such as `maps::cpm`; once each.
    places: Vec<String>,
}

/// The modules that define each name, such as `maps::cpm::map_file`.
type Definitions = BTreeMap<String, Vec<String>>;

/// Returns the breaches, each with the name and the places where it is defined.
///
/// # Errors
/// If a folder or a file cannot be read, or a row of the glossary's table is not understood.
pub(super) fn faults(crates: &Path, glossary: &Path) -> Result<Vec<String>> {
    let mut definitions = Definitions::new();
    for entry in entries(crates)? {
        let source = entry.join("src");
        let name = entry.file_name().and_then(|name| name.to_str());
        if let (true, Some(name)) = (source.is_dir(), name) {
            collect(&source, name, &mut definitions)?;
        }
    }
    let allowed = allowed(&read(glossary)?).with_context(|| glossary.display().to_string())?;
    Ok(compare(&definitions, &allowed))
}

/// Adds the names defined in a folder, which is the module `module`.
fn collect(folder: &Path, module: &str, definitions: &mut Definitions) -> Result<()> {
    for path in entries(folder)? {
        let Some(stem) = path.file_stem().and_then(|stem| stem.to_str()) else {
            continue;
        };
        let inner = match stem {
            "lib" | "main" | "mod" => module.to_owned(),
            _ => format!("{module}::{stem}"),
        };
        if path.is_dir() {
            collect(&path, &inner, definitions)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = read(&path)?;
            for name in text.lines().filter_map(defined) {
                let places = definitions.entry(name.to_owned()).or_default();
                places.push(inner.clone());
            }
        }
    }
    Ok(())
}

/// Returns the name of the public type that a line of code begins to define.
fn defined(line: &str) -> Option<&str> {
    let (kind, rest) = line.trim_start().strip_prefix("pub ")?.split_once(' ')?;
    let name = rest
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .next()?;
    (["struct", "enum", "trait", "type", "union"].contains(&kind) && !name.is_empty())
        .then_some(name)
}

fn allowed(glossary: &str) -> Result<Vec<Allowed>> {
    rows(
        glossary,
        ["name", "where", "why it is one thing"],
        |[name, places, _]| {
            Ok(Allowed {
                name: bare(name).to_owned(),
                places: names(places)?,
            })
        },
    )
}

fn compare(definitions: &Definitions, allowed: &[Allowed]) -> Vec<String> {
    let row_of = |name: &str| allowed.iter().find(|row| row.name == name);
    let mut faults = Vec::new();
    for (name, places) in definitions.iter().filter(|(_, places)| places.len() > 1) {
        if row_of(name).is_none_or(|row| !row.is_of(places)) {
            faults.push(format!(
                "`{name}` is defined in {}: rename all but one, or give the \
                 glossary's table a row that names them all",
                places.join(" and in ")
            ));
        }
    }
    for Allowed { name, .. } in allowed {
        if definitions.get(name).is_none_or(|places| places.len() < 2) {
            faults.push(format!(
                "`{name}` stands in the glossary's table but is defined once at most: remove \
                 its row"
            ));
        }
    }
    faults
}

impl Allowed {
    /// Returns whether exactly the row's modules define the name, once each.
    fn is_of(&self, definitions: &[String]) -> bool {
        let lies_in = |definition: &str, place: &str| {
            let below = definition.strip_prefix(place);
            below.is_some_and(|below| below.is_empty() || below.starts_with("::"))
        };
        let once = |place: &String| {
            let inside = definitions.iter().filter(|found| lies_in(found, place));
            inside.count() == 1
        };
        self.places.len() == definitions.len() && self.places.iter().all(once)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLOSSARY: &str = "\
- **file**: what is kept.

| name | where | why it is one thing |
| --- | --- | --- |
| `MapFile` | `maps::cpm`, `maps::grid` | each map has one |
";

    /// Returns the faults if these names are defined in these modules.
    fn faults_of(found: &[(&str, &[&str])]) -> Vec<String> {
        let of = |(name, places): &(&str, &[&str])| {
            let places = places.iter().map(|&place| place.to_owned()).collect();
            ((*name).to_owned(), places)
        };
        compare(&found.iter().map(of).collect(), &allowed(GLOSSARY).unwrap())
    }

    const TWO: (&str, &[&str]) = ("MapFile", &["maps::cpm::map_file", "maps::grid"]);

    #[test]
    fn the_definitions_of_a_text_are_found() {
        assert_eq!(defined("pub struct Wall(pub u32);"), Some("Wall"));
        assert_eq!(defined("    pub enum Event<'a> {"), Some("Event"));
        assert_eq!(defined("pub type Pair<T> = (T, T);"), Some("Pair"));
        assert_eq!(defined("pub trait Mapper {"), Some("Mapper"));
        for other in [
            "pub(crate) struct Wall;",
            "struct Wall;",
            "/// pub struct Wall;",
            "pub fn wall() {}",
            "pub const WALL: u32 = 1;",
        ] {
            assert_eq!(defined(other), None, "{other}");
        }
    }

    #[test]
    fn a_name_of_two_things_is_told_with_both_places() {
        let found = faults_of(&[
            TWO,
            ("Wall", &["maze::grid", "sim::wall"]),
            ("Cell", &["maze"]),
        ]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains("`Wall` is defined in maze::grid and in sim::wall"));
    }

    #[test]
    fn the_table_allows_what_it_names_and_no_more() {
        assert!(faults_of(&[TWO]).is_empty());
        let third = ["maps::cpm::map_file", "maps::grid", "systems"];
        assert!(faults_of(&[("MapFile", &third)])[0].contains("and in systems"));
        let elsewhere = ["maps::cpm_two", "maps::grid"];
        assert!(faults_of(&[("MapFile", &elsewhere)])[0].contains("maps::cpm_two"));
    }

    #[test]
    fn a_row_whose_name_is_no_longer_double_is_told() {
        let found = faults_of(&[("MapFile", &["maps::cpm"])]);
        assert!(found[0].contains("remove its row"), "{found:?}");
        assert!(faults_of(&[])[0].contains("remove its row"));
    }
}
