//! All readers with a few hundred files each that are almost valid; `cargo xtask fuzz` tries more.

use std::fs;
use std::path::Path;

use tests::fuzz::{Campaign, TARGETS, seed_folders};

/// The mutated files for each reader.
const FILES: u32 = 200;

#[test]
fn no_reader_panics_dawdles_or_devours_memory() {
    for target in TARGETS {
        let mut campaign = Campaign::new(target, 1).unwrap();
        campaign.go_on(FILES);
        let findings = campaign.findings();
        assert_eq!(findings.files, u64::from(FILES));
        if let Some((file, fault)) = findings.faults.first() {
            panic!(
                "{} {fault}: {:?}",
                target.name,
                String::from_utf8_lossy(file)
            );
        }
    }
}

#[test]
fn every_reader_takes_its_seeds() {
    for target in TARGETS {
        let campaign = Campaign::new(target, 1).unwrap();
        assert_eq!(campaign.refused_seed(), None, "{}", target.name);
    }
}

/// One table: the targets of libFuzzer and the folders of seeds are those of it.
#[test]
fn the_folder_fuzz_has_a_target_for_every_line_of_the_table() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz");
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
    let listed = |name: &str| manifest.contains(&format!("\npath = \"fuzz_targets/{name}.rs\"\n"));
    let mut names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    names.sort_unstable();
    for name in &names {
        let path = folder.join(format!("fuzz_targets/{name}.rs"));
        let text = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            text.contains(&format!("check(\"{name}\", bytes)")),
            "{name}"
        );
        assert!(listed(name), "{name} is not in fuzz/Cargo.toml");
    }
    let names_in = |folder: &Path| {
        let listed = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path());
        let stem =
            |path: std::path::PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
        let mut names: Vec<String> = listed.map(stem).collect();
        names.sort_unstable();
        names
    };
    assert_eq!(names_in(&folder.join("fuzz_targets")), names);
    assert_eq!(names_in(&seed_folders()), names);
}
