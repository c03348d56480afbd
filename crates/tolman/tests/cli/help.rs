use crate::tolman;

#[test]
fn help_names_every_verb_and_the_exit_codes() {
    let help = tolman(&["--help"]).done();
    for part in [
        "run",
        "maze",
        "experiment",
        "completions",
        "man",
        "Examples:",
        "Exit codes:",
        "did not arrive",
        "130 interrupted",
    ] {
        assert!(help.contains(part), "no `{part}` in:\n{help}");
    }
}

#[test]
fn every_verb_explains_itself() {
    for verb in [
        &["run"][..],
        &["replay"],
        &["demo"],
        &["completions"],
        &["man"],
        &["experiment"],
        &["trial"],
        &["merge"],
        &["maze", "show"],
        &["maze", "check"],
        &["maze", "convert"],
        &["maze", "generate"],
        &["pitch", "world"],
        &["pitch", "gather"],
        &["pitch", "show"],
        &["pitch", "score"],
        &["learn"],
        &["arena"],
        &["audit"],
        &["drive"],
        &["systems"],
        &["maze", "distinct"],
        &["map", "check"],
        &["map", "show"],
        &["map", "plan"],
    ] {
        let help = tolman(&[verb, &["--help"]].concat()).done();
        assert!(
            help.contains("Usage: tolman") && help.contains("Example"),
            "{help}"
        );
    }
}

#[test]
fn no_verb_is_refused_with_the_help() {
    tolman(&[]).refused(2, &["Usage: tolman", "maze"]);
}

#[test]
fn completions_and_man_page_know_the_verbs() {
    for shell in ["bash", "zsh", "fish"] {
        let script = tolman(&["completions", shell]).done();
        assert!(script.contains("convert"));
    }
    let page = tolman(&["man"]).done();
    assert!(
        page.contains(".TH tolman 1") && page.contains("maze"),
        "{page}"
    );
}

#[test]
fn every_verb_has_a_man_page() {
    let folder = crate::folder("man");
    crate::tolman_in(&folder, &["man", "--out", "pages"]).done();
    for page in ["tolman.1", "tolman-experiment.1", "tolman-maze-show.1"] {
        assert!(folder.join("pages").join(page).is_file(), "{page}");
    }
}
