//! Compares the page with the packages.

use super::page::{CrateRow, Page};

/// A member of the workspace and its direct dependencies.
#[derive(Debug)]
pub(super) struct Package {
    pub(super) name: String,
    pub(super) dependencies: Vec<(String, Kind)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Needed to build the crate, or by its build script.
    Normal,
    /// Needed only by its tests, benches and examples.
    Development,
}

impl Package {
    /// Returns the names of the crates that it needs to be built.
    pub(super) fn uses(&self) -> impl Iterator<Item = &str> {
        let normal = self
            .dependencies
            .iter()
            .filter(|(_, kind)| *kind == Kind::Normal);
        normal.map(|(name, _)| name.as_str())
    }

    /// Returns whether `name` is needed to build it or its tests.
    fn depends_on(&self, name: &str) -> bool {
        self.dependencies.iter().any(|(used, _)| used == name)
    }
}

/// Returns every breach of the page, each with the crate, the dependency and the repair; empty if
/// there are none.
pub(super) fn faults(page: &Page, packages: &[Package]) -> Vec<String> {
    let mut faults = census(page, packages);
    faults.extend(page.crates.iter().flat_map(|row| row_faults(page, row)));
    for package in packages {
        let Some(row) = page.row(&package.name) else {
            continue;
        };
        faults.extend(
            package
                .uses()
                .filter_map(|used| edge_fault(page, row, used)),
        );
    }
    faults.extend(circle(packages));
    faults
}

impl Page {
    fn row(&self, name: &str) -> Option<&CrateRow> {
        self.crates.iter().find(|row| row.name == name)
    }
}

/// Checks that the table lists exactly the crates that exist, each once.
fn census(page: &Page, packages: &[Package]) -> Vec<String> {
    let mut faults = Vec::new();
    for package in packages {
        let rows = page
            .crates
            .iter()
            .filter(|row| row.name == package.name)
            .count();
        if rows != 1 {
            let name = &package.name;
            faults.push(format!(
                "{name} has {rows} rows in the layer table: give it one"
            ));
        }
    }
    for row in &page.crates {
        if !packages.iter().any(|package| package.name == row.name) {
            faults.push(format!(
                "{} stands in the layer table but is not a crate of the workspace: remove its row",
                row.name
            ));
        }
    }
    faults
}

/// Checks that a row allows only crates of lower layers.
fn row_faults(page: &Page, row: &CrateRow) -> Vec<String> {
    let upward = |used: &String| {
        let below = page.row(used).and_then(|used| used.layer);
        let allowed = match (row.layer, below) {
            (_, None) => false,
            (None, Some(_)) => true,
            (Some(layer), Some(below)) => below < layer,
        };
        (!allowed).then(|| {
            format!(
                "the layer table lets {} ({}) use {used} ({}), which is not strictly downward: \
                 move what they share to a lower crate, or change a layer",
                row.name,
                layer_name(row.layer),
                page.row(used)
                    .map_or_else(|| "not in the table".into(), |row| layer_name(row.layer)),
            )
        })
    };
    row.may_use.iter().filter_map(upward).collect()
}

/// Checks one dependency that is needed to build `row`'s crate.
fn edge_fault(page: &Page, row: &CrateRow, used: &str) -> Option<String> {
    let name = &row.name;
    if page.row(used).is_some() {
        return (!row.may_use.iter().any(|allowed| allowed == used)).then(|| {
            format!(
                "{name} → {used} is not in {name}'s `may use`: remove the dependency, or, if {used} \
                 lies below {name} and has to be known there, add it to the table"
            )
        });
    }
    let rule = page.outside.iter().find(|rule| rule.matches(used))?;
    (!rule.seen_by.contains(name)).then(|| {
        format!(
            "{name} → {used}: {} is for {} alone: keep it behind a type of theirs",
            rule.pattern,
            rule.seen_by.join(" and ")
        )
    })
}

/// Checks that development dependencies do not lead back to their own crate.
///
/// Such a crate would be compiled twice in one test, as two crates with the same name and different
/// types.
fn circle(packages: &[Package]) -> Option<String> {
    let mut left: Vec<&Package> = packages.iter().collect();
    loop {
        // A package that depends on no other is on no cycle. Nor is one on which no other depends.
        let inside = |name: &str| left.iter().any(|other| other.name == name);
        let lies_on_none = |package: &Package| {
            package.dependencies.iter().all(|(name, _)| !inside(name))
                || left.iter().all(|other| !other.depends_on(&package.name))
        };
        let kept: Vec<&Package> = left
            .iter()
            .copied()
            .filter(|package| !lies_on_none(package))
            .collect();
        if kept.len() == left.len() {
            break;
        }
        left = kept;
    }
    let names: Vec<_> = left.iter().map(|package| package.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "dependencies, those for tests included, run in a circle among {}: move the test that \
             needs the upper crate to `tests/`",
            names.join(", ")
        )
    })
}

fn layer_name(layer: Option<u8>) -> String {
    layer.map_or_else(
        || "outside the layers".to_owned(),
        |layer| format!("L{layer}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "\
| crate | layer | library | may use | what |
| --- | --- | --- | --- | --- |
| `geom` | L0 | no_std | – | points |
| `control` | L1 | no_std + alloc | `geom` | layers |
| `sim` | L1 | std | `geom` | worlds |
| `app` | L2 | std | `geom`, `control`, `sim` | all of it |
| `tests` | – | std | `app` | scenarios |

| outside crate | seen by | why |
| --- | --- | --- |
| `parry2d*` | `sim` | collisions |
";

    /// Returns the faults of the packages of the page above, with `more` dependencies; a `+` in a
    /// name marks one for tests.
    fn faults_with(more: &[(&str, &str)]) -> Vec<String> {
        faults_of(PAGE, more)
    }

    fn faults_of(page: &str, more: &[(&str, &str)]) -> Vec<String> {
        let mut packages: Vec<Package> = ["geom", "control", "sim", "app", "tests"]
            .map(|name| Package {
                name: name.to_owned(),
                dependencies: Vec::new(),
            })
            .into();
        let usual = [
            ("control", "geom"),
            ("sim", "geom"),
            ("sim", "parry2d-f64"),
            ("app", "sim"),
        ];
        for (user, used) in usual.iter().chain(more) {
            let (used, kind) = match used.strip_prefix('+') {
                Some(used) => (used, Kind::Development),
                None => (*used, Kind::Normal),
            };
            match packages.iter_mut().find(|package| package.name == *user) {
                Some(package) => package.dependencies.push((used.to_owned(), kind)),
                None => packages.push(Package {
                    name: (*user).to_owned(),
                    dependencies: vec![(used.to_owned(), kind)],
                }),
            }
        }
        faults(&Page::parse(page).unwrap(), &packages)
    }

    #[track_caller]
    fn check(faults: &[String], expected: &[&str]) {
        let [fault] = faults else {
            panic!("one fault expected, not {faults:#?}")
        };
        for part in expected {
            assert!(fault.contains(part), "no `{part}` in: {fault}");
        }
    }

    #[test]
    fn the_page_and_what_it_describes_agree() {
        assert_eq!(faults_with(&[]), [""; 0]);
    }

    #[test]
    fn a_sideways_edge_is_caught() {
        check(
            &faults_with(&[("control", "sim")]),
            &["control → sim", "remove the dependency"],
        );
    }

    #[test]
    fn a_sideways_edge_cannot_be_allowed() {
        let page = PAGE.replace("| L1 | std | `geom` |", "| L1 | std | `geom`, `control` |");
        check(
            &faults_of(&page, &[]),
            &["sim (L1)", "control (L1)", "not strictly downward"],
        );
    }

    #[test]
    fn nothing_depends_on_a_member_outside_the_layers() {
        let page = PAGE.replace("| `geom`, `control`, `sim` |", "| `sim`, `tests` |");
        check(
            &faults_of(&page, &[]),
            &["app (L2)", "tests (outside the layers)"],
        );
    }

    #[test]
    fn an_outside_crate_is_seen_by_its_owner_alone() {
        check(
            &faults_with(&[("app", "parry2d-f64")]),
            &["app → parry2d-f64", "for sim alone"],
        );
    }

    #[test]
    fn tests_may_use_what_they_like() {
        assert_eq!(
            faults_with(&[("control", "+sim"), ("app", "+parry2d-f64")]),
            [""; 0]
        );
    }

    #[test]
    fn tests_may_not_lead_back_to_their_crate() {
        check(
            &faults_with(&[("geom", "+sim")]),
            &["circle among geom, sim:"],
        );
    }

    #[test]
    fn a_crate_without_a_row_is_caught() {
        check(&faults_with(&[("maps", "geom")]), &["maps has 0 rows"]);
    }

    #[test]
    fn a_row_without_a_crate_is_caught() {
        let page = PAGE.replace(
            "| `tests` |",
            "| `maps` | L2 | std | – | maps |\n| `tests` |",
        );
        check(
            &faults_of(&page, &[]),
            &["maps stands in the layer table but is not a crate"],
        );
    }
}
