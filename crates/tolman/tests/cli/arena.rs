use crate::{CORRIDOR, folder, tolman, tolman_in};

#[test]
fn a_system_is_judged_in_a_family_and_the_same_again() {
    let arguments = ["arena", "--system", "cpm-better", "--family", "star"];
    let table = tolman(&arguments).done();
    assert!(table.contains("CPM Better"), "{table}");
    assert!(table.contains("e-puck"), "{table}");
    assert_eq!(tolman(&arguments).done(), table);
}

#[test]
fn what_a_system_cannot_do_it_says_before_it_drives() {
    let table = tolman(&["arena", "--system", "cpm", "--family", "pillars"]).done();
    assert!(
        table.contains("CPM abstained, first in pillars 0: it follows corridors"),
        "{table}"
    );
}

#[test]
fn files_are_worlds_too_and_every_world_is_a_line_of_json() {
    let folder = folder("arena");
    std::fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let json = tolman_in(
        &folder,
        &["arena", "corridor.maze", "--json", "--starts", "2"],
    )
    .failed(0, &["corridor_width = 0.95 of Corridor is ignored"]);
    let lines: Vec<serde_json::Value> = json
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines.len(), 15);
    let cpm = lines
        .iter()
        .find(|line| line["system"] == "cpm-better")
        .unwrap();
    assert_eq!(
        (&cpm["right"], &cpm["world"]),
        (&true.into(), &"Corridor".into())
    );
    assert_eq!(cpm["home_over_shortest"].as_array().unwrap().len(), 2);
}

#[test]
fn rows_of_many_entrants_become_one_page() {
    let folder = folder("arena-league");
    let arena = |more: &[&str]| {
        let star = ["arena", "--family", "star", "--json"];
        tolman_in(&folder, &[&star[..], more].concat()).done()
    };
    let write = |name: &str, rows: String| std::fs::write(folder.join(name), rows).unwrap();
    let cpm = arena(&["--system", "cpm-better"]);
    write("cpm.jsonl", cpm.clone() + &cpm);
    write("mslst.jsonl", arena(&["--system", "mslst"]));
    write("notes.txt", "seed 1".to_owned());
    let league = || tolman_in(&folder, &["arena", "--league", "."]);
    let told = league().failed(0, &["notes.txt is left out"]);
    assert!(told.starts_with("4 rows on "), "{told}");
    let page = || std::fs::read_to_string(folder.join("league.html")).unwrap();
    let alike = page();
    assert!(alike.contains("All were in the same 2 worlds."), "{alike}");
    let place = |entrant: &str| {
        alike
            .find(&format!("<th scope=\"row\">{entrant} on "))
            .unwrap()
    };
    assert!(place("cpm-better") < place("mslst"), "the best is first");
    assert!(
        alike.contains("<b>100</b><small>34 to 100, 2 worlds</small>"),
        "{alike}"
    );
    assert!(alike.contains("--system mslst</code>"));
    write("mslst.jsonl", arena(&["--system", "mslst", "--seed", "2"]));
    write(
        "errands.jsonl",
        arena(&["--system", "cpm-better", "--task", "errands"]),
    );
    league().failed(0, &[]);
    assert!(page().contains("They were not all in the same worlds"));
    assert!(page().contains("Errands: deliveries, % of an oracle"));
    let pillars = ["arena", "--family", "pillars", "--json"];
    for system in ["cpm", "oracle"] {
        let rows = tolman_in(&folder, &[&pillars[..], &["--system", system]].concat()).done();
        write(&format!("{system}-in-pillars.jsonl"), rows);
    }
    league().failed(0, &[]);
    let page = page();
    let task = |task: &str| {
        page.split("<h2>")
            .find(|part| part.starts_with(task))
            .unwrap()
    };
    assert!(task("Home").contains("<th scope=\"row\">oracle on "));
    assert!(
        !task("Learn: right").contains(">oracle on "),
        "a baseline learns no map"
    );
    let abstained = task("Locate")
        .split("<tr")
        .find(|row| row.contains(">cpm on "));
    assert!(
        abstained
            .unwrap()
            .contains("<b>0</b><small>0 to 66, 2 worlds"),
        "who abstains stays in the denominator"
    );
    write("bad.jsonl", "{\"system\": \"mine\"}".to_owned());
    league().refused(2, &["bad.jsonl, line 1: no row", "missing field"]);
    tolman(&["arena", "--league", "nowhere"]).refused(2, &["nowhere"]);
    std::fs::create_dir(folder.join("empty")).unwrap();
    tolman_in(&folder, &["arena", "--league", "empty"]).refused(2, &["no rows", "mine.jsonl"]);
}

#[test]
fn a_condition_makes_it_harder() {
    let arguments = ["arena", "--system", "cpm-better", "--family", "ladder"];
    let table = tolman(&[&arguments[..], &["--condition", "wheels-5"]].concat()).done();
    assert!(table.contains("CPM Better"), "{table}");
}

#[test]
fn the_tables_are_the_same_for_any_number_of_jobs() {
    let folder = folder("arena-jobs");
    std::fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let made = |jobs: &str| {
        let arguments = [
            "experiment",
            "arena",
            "--maze",
            "corridor.maze",
            "--runs",
            "1",
            "--table",
            "learn",
            "--table",
            "home",
            "--table",
            "locate",
            "--jobs",
            jobs,
            "--out",
            jobs,
        ];
        tolman_in(&folder, &arguments).done();
        ["runs.jsonl", "summary.json"].map(|file| {
            let path = folder.join(jobs).join(file);
            std::fs::read(path).unwrap()
        })
    };
    assert!(made("1") == made("2"));
}

#[test]
fn what_is_unknown_is_refused() {
    tolman(&["arena", "--system", "dog"]).refused(2, &["dog", "cpm-better"]);
    tolman(&["arena", "--family", "dog"]).refused(2, &["dog", "spiral"]);
    tolman(&["arena", "--condition", "dog"]).refused(2, &["dog", "kidnapping"]);
    tolman(&["arena", "--robot", "dog"]).refused(2, &["dog", "laser-pioneer"]);
    tolman(&["arena", "nowhere.maze"]).refused(2, &["nowhere.maze"]);
}

#[test]
fn what_a_system_costs_is_measured_where_it_is_asked() {
    let arguments = ["arena", "--system", "micromouse", "--family", "star"];
    let table = tolman(&[&arguments[..], &["--cost"]].concat()).done();
    assert!(
        table.contains("µs a step") && table.contains("bytes a place"),
        "{table}"
    );
    let json = tolman(&[&arguments[..], &["--json"]].concat()).done();
    assert!(json.contains("bytes_per_place") && !json.contains("us_per_step"));
}

#[test]
fn what_a_system_makes_of_its_maps_is_judged_by_right_and_wrong_ones() {
    let arguments = [
        "arena",
        "--system",
        "micromouse",
        "--family",
        "star",
        "--own-verdict",
        "--worlds",
        "2",
    ];
    let table = tolman(&arguments).done();
    // It errs in none, so that worlds become harder.
    let small = "  small: worlds 1; right maps 1, called wrong 0; ";
    assert!(
        table.contains(small) && table.contains("  middle: worlds 1; "),
        "{table}"
    );
    assert!(table.contains("too few: 100 right"), "{table}");
    assert_eq!(tolman(&arguments).done(), table);
}

#[test]
#[cfg(unix)]
fn a_mapper_in_another_language_has_its_row_beside_one_that_crashes() {
    if std::process::Command::new("python3")
        .arg("-V")
        .output()
        .is_err()
    {
        // Past the test harness, which would keep it to itself.
        let _ =
            std::io::Write::write_all(&mut std::io::stderr(), b"SKIPPED: python3 is not there\n");
        return;
    }
    let folder = folder("arena-mapper");
    let mapper = tolman(&["host", "--template", "mapper"]).done();
    std::fs::write(folder.join("mine.py"), mapper).unwrap();
    std::fs::write(folder.join("bad.py"), "raise SystemExit(7)").unwrap();
    let [mine, bad] = ["python3 mine.py", "python3 bad.py"];
    let star = ["arena", "--family", "star", "--worlds", "1"];
    let arena = |more: &[&str]| tolman_in(&folder, &[&star[..], more].concat()).done();
    let alone = arena(&["--mapper", mine, "--replay", "worst.html"]);
    let row = alone.lines().find(|line| line.starts_with(mine)).unwrap();
    let columns: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(
        columns[2..],
        ["laser", "Pioneer", "1", "0", "1", "1", "1.00", "0/1", "–"]
    );
    assert!(alone.contains("replay: file://"), "{alone}");
    let page = std::fs::read_to_string(folder.join("worst.html")).unwrap();
    assert!(page.contains("python3 mine.py in star 0"));
    let both = arena(&["--mapper", bad, "--mapper", mine, "--brain", bad]);
    assert!(both.contains(row), "{both}");
    let why = "python3 bad.py gave up or doubts its map, first in star 0: the program ended with exit status: 7";
    assert_eq!(both.matches(why).count(), 2, "{both}");
    let costs = arena(&["--mapper", mine, "--cost"]);
    let cost = costs.lines().find(|line| line.starts_with(mine)).unwrap();
    let cost: f64 = cost.split_whitespace().nth(4).unwrap().parse().unwrap();
    assert!(cost > 1.0, "{costs}");
    let json = arena(&["--mapper", bad, "--json"]);
    let line: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(line["why"], "the program ended with exit status: 7");
    assert_eq!(
        (&line["right"], &line["says"]),
        (&false.into(), &"wrong".into())
    );
}

#[test]
fn a_program_that_is_not_there_is_refused() {
    tolman(&["arena", "--mapper", "no-such-program mine.py"])
        .refused(2, &["there is no program no-such-program"]);
    tolman(&["arena", "--brain", "'python3 mine.py"]).refused(2, &["a quotation mark"]);
    tolman(&["arena", "--mapper", ""]).refused(2, &["--mapper is empty"]);
    tolman(&["arena", "--replay", "worst.html"]).refused(2, &["a single contestant"]);
}

/// A drawing of blocks, as others make them.
const BLOCKS: &str = "#######\n#S    #\n# ### #\n#   #G#\n#######\n";

#[test]
fn a_folder_of_others_has_worlds_of_all_kinds_and_its_other_files_are_named() {
    let folder = folder("arena-others");
    let given = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mazes/worlds");
    for file in ["hall.yaml", "hall.pgm", "rooms.json"] {
        std::fs::copy(given.join(file), folder.join(file)).unwrap();
    }
    std::fs::write(folder.join("blocks.txt"), BLOCKS).unwrap();
    std::fs::write(folder.join("notes.md"), "Where it is from").unwrap();
    // Two metres of floor, and a robot half a metre across.
    std::fs::write(
        folder.join("slit.pgm"),
        format!("P2 40 4 255{}", " 0".repeat(160)),
    )
    .unwrap();
    let slit = "image: slit.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    std::fs::write(folder.join("slit.yaml"), slit).unwrap();
    let arguments = [
        "arena",
        ".",
        "--system",
        "mslst-better",
        "--starts",
        "0",
        "--json",
    ];
    let json =
        tolman_in(&folder, &arguments).failed(0, &["notes.md", "slit", "robot 0.5 m across"]);
    let lines = json.lines().map(|line| serde_json::from_str(line).unwrap());
    let lines: Vec<serde_json::Value> = lines.collect();
    let worlds: Vec<&str> = lines
        .iter()
        .map(|line| line["world"].as_str().unwrap())
        .collect();
    assert_eq!(worlds, ["blocks", "hall", "rooms"]);
    for line in &lines {
        assert_eq!(line["right"], true, "{line}");
    }
    let refused = |more: &[&str], parts: &[&str]| {
        let ended = tolman_in(&folder, &[&["arena"], more].concat());
        assert_eq!(ended.failed(2, parts), "");
    };
    refused(&["notes.md"], &["notes.md"]);
    refused(&["slit.yaml"], &["slit", "robot 0.5 m across"]);
    refused(
        &["hall.yaml", "--condition", "doors"],
        &["--condition doors"],
    );
}

#[test]
fn errands_begin_with_an_empty_map_and_count_deliveries() {
    let errands = [
        "arena",
        "--task",
        "errands",
        "--system",
        "diktiometry-better",
    ];
    let worlds = ["--family", "ring", "--worlds", "1"];
    let table = tolman(&[&errands[..], &worlds].concat()).done();
    assert!(
        table.contains("Diktiometry Better, learns first"),
        "{table}"
    );
    let json = tolman(&[&errands[..], &worlds, &["--json"]].concat()).done();
    let first: serde_json::Value = serde_json::from_str(json.lines().next().unwrap()).unwrap();
    assert_eq!(first["oracle"].as_array().unwrap().len(), 60);
    assert!(
        first["deliveries"].as_array().unwrap().len() > 10,
        "{first}"
    );
    let doors = ["--condition", "moving-doors"];
    let table = tolman(&[&errands[..], &worlds, &doors].concat()).done();
    assert!(table.contains("Diktiometry Better"), "{table}");
    tolman(&[&["arena", "--system", "cpm"][..], &doors].concat())
        .refused(2, &["there is no condition moving-doors"]);
}

#[test]
fn who_cannot_run_errands_is_named() {
    let errands = ["arena", "--task", "errands"];
    tolman(&[&errands[..], &["--system", "oracle"]].concat())
        .refused(2, &["oracle runs no errands"]);
    let folder = folder("errands");
    std::fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let sent = ["corridor.maze", "--system", "mslst-better"];
    tolman_in(&folder, &[&errands[..], &sent].concat()).failed(1, &["mark 1 to 8"]);
}
