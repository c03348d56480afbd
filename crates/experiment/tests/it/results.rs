//! Tests of what is written and shown.

use std::fs;

use tolman_experiment::{
    Better, Correction, Doubt, Error, Finding, Ink, Metric, Options, Pairwise, Program, Row,
    RowPair, Run, Tolerance, tables_as_text, write_replay,
};
use tolman_stats::Method;

use crate::darts::{Darts, HITS, LENGTH, Throws};
use crate::support::{fresh, options, read, run};

fn throws_of(run: &Run) -> f64 {
    run.record::<Throws>().unwrap().throws as f64
}

#[test]
fn summary_json_has_one_row_for_each_value_and_the_agreed_keys() {
    let out = fresh("summary").join("out");
    let outcome = run(&Darts::new(), &options(&out)).0.unwrap();
    let summary: serde_json::Value = serde_json::from_str(&read(&out, "summary.json")).unwrap();
    let keys = |value: &serde_json::Value| -> Vec<String> {
        value.as_object().unwrap().keys().cloned().collect()
    };
    assert_eq!(keys(&summary), ["experiment", "rows", "seed", "version"]);
    assert_eq!(
        (&summary["experiment"], &summary["version"]),
        (&"darts".into(), &1.into())
    );
    let rows = summary["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2 * 3 * 4);
    assert_eq!(
        keys(&rows[0]),
        [
            "metric",
            "n",
            "paper",
            "resolution",
            "row",
            "sd",
            "table",
            "tolerance",
            "value",
            "verdict"
        ]
    );
    assert_eq!(rows[0]["tolerance"], "±15: darts scatter");
    assert!(rows[0]["sd"].is_null(), "a percentage has no spread");
    assert_eq!(rows[0]["paper"], 60.0);
    assert_eq!(
        keys(&rows[2]),
        ["metric", "n", "paper", "row", "sd", "table", "value"]
    );
    assert!(
        rows[2]["paper"].is_null(),
        "the paper does not say how far novices miss"
    );

    // By hand from the runs.
    let novice: Vec<&Run> = outcome
        .runs
        .iter()
        .filter(|run| run.table == "1 (near)" && run.row == "Novice")
        .collect();
    let throws = |run: &&Run| throws_of(run);
    let mean = novice.iter().map(throws).sum::<f64>() / 40.0;
    assert!((rows[1]["value"].as_f64().unwrap() - mean).abs() < 1e-12);
    let variance = novice
        .iter()
        .map(throws)
        .map(|t| (t - mean) * (t - mean))
        .sum::<f64>()
        / 39.0;
    assert!((rows[1]["sd"].as_f64().unwrap() - variance.sqrt()).abs() < 1e-12);
    let miss: f64 = novice
        .iter()
        .map(|run| run.record::<Throws>().unwrap().miss.unwrap())
        .sum();
    assert!((rows[3]["value"].as_f64().unwrap() - miss / (40.0 * mean)).abs() < 1e-12);
}

#[test]
fn medians_and_counts_are_those_of_the_runs() {
    let out = fresh("medians").join("out");
    let mut darts = Darts::new();
    let table = darts.tables.swap_remove(0);
    let table = table
        .metric(
            Metric::median("median_throws", "throws")
                .tolerance(Tolerance::factor(1.5, "nobody counts")),
        )
        .metric(Metric::count_of("hits_of_twenty", "success", 20).titled("hits"));
    darts.tables = vec![table];
    darts.tables[0].rows[0] = Row::new("Novice")
        .paper("median_throws", 1000.0)
        .paper("hits_of_twenty", 12.0);
    let outcome = run(&darts, &options(&out)).0.unwrap();
    let novice = |metric: &str| {
        let mut values = outcome.analysis.values();
        let found = values.find(|(_, of, measured)| of.name == metric && measured.row == "Novice");
        found.unwrap().2.clone()
    };
    let mut throws: Vec<f64> = outcome.runs[..40].iter().map(throws_of).collect();
    throws.sort_by(f64::total_cmp);

    let median = novice("median_throws");
    assert!((median.value - f64::midpoint(throws[19], throws[20])).abs() < 1e-12);
    assert_eq!(
        (median.sd, median.mean),
        (novice("throws").sd, novice("throws").mean)
    );
    // Fewer than 14 of 40 coins show heads with probability 0.019, fewer than 15 with 0.040.
    let interval = median.interval.unwrap();
    assert!((interval.low - throws[13]).abs() < 1e-12);
    assert!((interval.high - throws[26]).abs() < 1e-12);
    assert_eq!(median.verdict.unwrap().finding, Finding::Differs);

    let (count, percent) = (novice("hits_of_twenty"), novice("success_percent"));
    assert!((5.0 * count.value - percent.value).abs() < 1e-12);
    assert!((5.0 * count.interval.unwrap().high - percent.interval.unwrap().high).abs() < 1e-9);
    let page = read(&out, "report.html");
    let text = tables_as_text(&outcome.analysis, Ink::Plain);
    assert!(page.contains("hits of 20") && text.contains("hits of 20"));
    // The mean and the median of throws share one plot.
    assert_eq!(outcome.figures.len(), 3);
}

#[test]
fn rows_are_compared_each_with_each_and_with_one_among_them() {
    let out = fresh("pairs").join("out");
    let mut darts = Darts::new();
    let table = darts.tables.swap_remove(0);
    let rows = ["Novice", "Adept", "Master"].map(String::from);
    darts.tables = vec![
        table
            .metric(Metric::multiple("throws_of_master", "throws", "Master"))
            .pairwise(Pairwise {
                field: "throws".into(),
                rows: rows.to_vec(),
                correction: Correction::Bonferroni,
                paper: vec![("Master".into(), "Novice".into(), 0.004)],
            }),
    ];
    let outcome = run(&darts, &options(&out)).0.unwrap();
    let throws = |row: &str| -> Vec<f64> {
        let of_row = outcome.runs.iter().filter(|run| run.row == row);
        of_row.map(throws_of).collect()
    };
    let pairs = &outcome.analysis.tables[0].pairs;
    let names: Vec<String> = pairs.iter().map(RowPair::name).collect();
    assert_eq!(
        names,
        ["Novice – Adept", "Novice – Master", "Adept – Master"]
    );
    assert_eq!(
        pairs[1].paper,
        Some(0.004),
        "whichever row the paper names first"
    );
    let alone =
        tolman_stats::mann_whitney(&throws("Novice"), &throws("Adept"), Method::Auto).unwrap();
    assert!((pairs[0].contrast.p.value() - (3.0 * alone.p.value()).min(1.0)).abs() < 1e-12);

    let summary: serde_json::Value = serde_json::from_str(&read(&out, "summary.json")).unwrap();
    let rows = summary["rows"].as_array().unwrap();
    let p: Vec<_> = rows.iter().filter(|row| row["table"] == "p").collect();
    assert_eq!(p.len(), 3);
    assert_eq!(
        (&p[1]["row"], &p[1]["metric"], &p[1]["paper"]),
        (
            &"1 (near): Novice – Master".into(),
            &"p".into(),
            &0.004.into()
        )
    );
    let multiple = |row: &str| {
        let mut values = outcome.analysis.values();
        let found = values.find(|(_, of, m)| of.name == "throws_of_master" && m.row == row);
        found.unwrap().2.value
    };
    let sum = |row: &str| throws(row).iter().sum::<f64>();
    assert!((multiple("Novice") - sum("Novice") / sum("Master")).abs() < 1e-12);
    assert!((multiple("Master") - 1.0).abs() < 1e-12);
    for text in [
        read(&out, "report.html"),
        tables_as_text(&outcome.analysis, Ink::Plain),
    ] {
        assert!(text.contains("Novice – Master"));
    }
}

#[test]
fn rows_that_are_not_there_are_compared_with_nothing() {
    for table in [
        Darts::new().tables[0]
            .clone()
            .metric(Metric::multiple("of", "throws", "Nobody")),
        Darts::new().tables[0].clone().pairwise(Pairwise {
            field: "throws".into(),
            rows: vec!["Nobody".into()],
            correction: Correction::Holm,
            paper: vec![],
        }),
    ] {
        let mut darts = Darts::new();
        darts.tables = vec![table];
        let error = run(&darts, &options(&fresh("nobody").join("out")))
            .0
            .unwrap_err();
        assert!(error.to_string().contains("Nobody"), "{error}");
    }
}

#[test]
fn tables_without_values_of_a_paper_speak_of_none() {
    let out = fresh("no-paper").join("out");
    let mut darts = Darts::new();
    for row in darts.tables.iter_mut().flat_map(|table| &mut table.rows) {
        row.paper.clear();
    }
    let outcome = run(&darts, &options(&out)).0.unwrap();
    let text = tables_as_text(&outcome.analysis, Ink::Plain);
    assert!(!text.contains("paper") && text.contains("ours"));
    let page = read(&out, "report.html");
    for column in ["<th>paper</th>", "<th>verdict</th>"] {
        assert!(!page.contains(column), "{column}");
    }
}

#[test]
fn metrics_that_judge_or_count_by_nothing_are_refused() {
    for (metric, what) in [
        (Metric::count_of("hits", "success", 0), "0 runs"),
        (
            Metric::mean("throws").tolerance(Tolerance::factor(0.5, "")),
            "factor 0.5",
        ),
        (
            Metric::mean("throws").tolerance(Tolerance::relative(f64::NAN, "")),
            "NaN",
        ),
    ] {
        let out = fresh("unsound-metric").join("out");
        let mut darts = Darts::new();
        darts.tables[0].metrics = vec![metric];
        darts.tables[0]
            .rows
            .iter_mut()
            .for_each(|row| row.paper.clear());
        let error = run(&darts, &options(&out)).0.unwrap_err();
        assert!(matches!(error, Error::Tables { .. }));
        assert!(error.to_string().contains(what), "{error}");
        assert!(!out.exists());
    }
}

#[test]
fn a_run_is_one_line_that_names_what_plays_it_again() {
    let out = fresh("line").join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let text = read(&out, "runs.jsonl");
    let line = text.lines().next().unwrap();
    assert!(
        line.starts_with(r#"{"table":"1 (near)","row":"Novice","run":0,"seed":"#),
        "{line}"
    );
    let (values, checksum) = line.split_once(r#","checksum":"#).unwrap();
    assert_eq!(checksum.len(), "\"0123456789abcdef\"}".len());
    let parsed: Run = serde_json::from_str(&format!("{values}}}")).unwrap();
    use tolman_experiment::Procedure;
    assert_eq!(Darts::new().run(&parsed.job()).unwrap(), parsed.fields);
}

#[test]
fn config_toml_holds_all_that_is_needed_to_run_again() {
    let out = fresh("config").join("my out");
    let options = Options {
        mazes: vec!["a maze.txt".into()],
        program: Program::Xtask,
        ..options(&out)
    };
    run(&Darts::new(), &options).0.unwrap();
    let config: toml::Table = read(&out, "config.toml").parse().unwrap();
    assert_eq!(config["seed"].as_integer(), Some(7));
    assert_eq!(config["runs"].as_integer(), Some(40));
    assert_eq!(config["configuration"]["reach"].as_float(), Some(1.0));
    assert_eq!(config["build"]["commit"].as_str(), Some("0123456789"));
    let command = config["command"].as_str().unwrap();
    assert!(command.starts_with(
        "cargo xtask experiment darts --seed 7 --runs 40 --maze 'a maze.txt' --out '"
    ));
}

#[test]
fn metrics_are_titled_explained_and_judged_by_their_columns() {
    let out = fresh("columns").join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let page = read(&out, "report.html");
    for (explanation, heading) in [
        ("Whether a dart hit. Higher is better.", "success %"),
        (
            "Distance of the last dart from the middle. Lower is better.",
            "last miss (m)",
        ),
        ("Lower is better.", "miss a throw"),
    ] {
        assert!(
            page.contains(&format!("title=\"{explanation}\">{heading}")),
            "{heading}"
        );
    }
    let table = &Darts::new().tables[0];
    assert_eq!(table.metrics[1].tolerance, Some(LENGTH));
    let own = Metric::mean(Throws::throws).tolerance(HITS).titled("darts");
    let own = &table.clone().metric(own.named("darts")).metrics[4];
    assert_eq!(
        (own.tolerance, own.title.as_str(), own.better),
        (Some(HITS), "darts", Some(Better::Lower))
    );
}

#[test]
fn disagreements_are_the_values_outside_their_tolerance() {
    let out = fresh("check").join("out");
    let mut darts = Darts::new();
    let agreeing = run(&darts, &options(&out)).0.unwrap();
    let steps = agreeing.summary.rows[1].value;
    assert!(
        agreeing
            .analysis
            .disagreements()
            .all(|(table, metric, measured)| {
                metric.name != "throws" || measured.row != "Novice" || table.name != "1 (near)"
            })
    );

    darts.tables[0].rows[0].paper[1].value = 2.0 * steps;
    let analysis = run(&darts, &options(&out)).0.unwrap().analysis;
    let (_, metric, found) = analysis
        .disagreements()
        .find(|(table, _, measured)| table.name == "1 (near)" && measured.row == "Novice")
        .unwrap();
    assert_eq!(metric.name, "throws");
    let accepted = found.verdict.as_ref().unwrap().accepted.unwrap();
    assert!((accepted.low - 0.65 * 2.0 * steps).abs() < 1e-9);
}

#[test]
fn every_value_of_the_paper_is_judged_or_says_why_not() {
    let out = fresh("judged").join("out");
    let outcome = run(&Darts::new(), &options(&out)).0.unwrap();
    let with_paper = outcome
        .summary
        .rows
        .iter()
        .filter(|row| row.paper.is_some());
    let mut counted = 0;
    for row in with_paper {
        counted += 1;
        let verdict = row.verdict.unwrap();
        assert_eq!(verdict == "cannot tell", row.why.is_some(), "{row:?}");
        assert!(row.why.is_some() || row.resolution.is_some(), "{row:?}");
    }
    let tally = outcome.analysis.tally();
    assert_eq!((tally.all(), counted), (9, 9));
    // The miss has no tolerance.
    assert!(tally.cannot_tell >= 1 && tally.judged() >= 1, "{tally}");
    let text = tables_as_text(&outcome.analysis, Ink::Plain);
    assert!(
        text.ends_with(&format!("Of the paper's values {tally}.\n")),
        "{text}"
    );
    let page = read(&out, "report.html");
    assert!(page.contains(&format!("{} of 9 match", tally.matches)));
    let differs = outcome.analysis.disagreements().count() > 0;
    assert_eq!(
        page.contains("What differs most is"),
        differs,
        "the abstract"
    );
    assert!(
        page.contains(&format!("of the paper's values {tally}."))
            && page.contains("nobody can tell: ")
    );
    assert!(page.contains(LENGTH.reason) && page.contains("no tolerance is stated"));
}

#[test]
fn a_table_without_its_files_stands_with_the_papers_values() {
    let out = fresh("no-files").join("out");
    let mut darts = Darts::new();
    let needs = "board.txt is not here: ask the club";
    for row in &mut darts.tables[0].rows {
        *row = row.clone().missing(needs);
    }
    let outcome = run(&darts, &options(&out)).0.unwrap();
    let mut values = outcome.analysis.values();
    let (_, _, measured) = values.find(|(table, ..)| table.name == "1 (near)").unwrap();
    assert!(measured.n == 0 && measured.value.is_nan());
    let finding = measured.verdict.as_ref().unwrap().finding.clone();
    assert_eq!(
        finding,
        Finding::CannotTell(Doubt::NoData(needs.to_owned()))
    );
    assert!(outcome.runs.iter().all(|run| run.table == "2 (far)"));
    for told in [
        tables_as_text(&outcome.analysis, Ink::Plain),
        read(&out, "report.html"),
        read(&out, "summary.json"),
    ] {
        assert!(told.contains(needs), "{told}");
    }
}

#[test]
fn a_few_runs_say_how_many_would_do() {
    let out = fresh("few-runs").join("out");
    let few = Options {
        runs: Some(2),
        ..options(&out)
    };
    let mut darts = Darts::new();
    // Two novices of the near table miss by far more than any tolerance.
    darts.tables[0].rows[0].paper[1].value = 1.0;
    let outcome = run(&darts, &few).0.unwrap();
    assert_eq!(outcome.analysis.disagreements().count(), 0);
    let mut rows = outcome.summary.rows.iter();
    let throws = rows.find(|row| row.row == "Novice" && row.metric == "throws");
    let throws = throws.unwrap();
    let needed = throws.runs_needed.unwrap();
    let why = format!("too few runs: {needed} would do");
    assert_eq!(throws.why.as_ref(), Some(&why));
    let text = tables_as_text(&outcome.analysis, Ink::Plain);
    for told in [text, read(&out, "report.html"), read(&out, "summary.json")] {
        assert!(told.contains(&why), "{told}");
    }
}

#[test]
fn a_quantity_has_one_tolerance() {
    let out = fresh("two-tolerances").join("out");
    let mut darts = Darts::new();
    darts.tables[1].metrics[1].tolerance = Some(HITS);
    let error = run(&darts, &options(&out)).0.unwrap_err();
    assert!(error.to_string().contains("a quantity has one"), "{error}");
}

#[test]
fn tables_show_ours_beside_the_papers() {
    let out = fresh("text").join("out");
    let outcome = run(&Darts::new(), &options(&out)).0.unwrap();
    let text = tables_as_text(&outcome.analysis, Ink::Plain);
    let head: Vec<&str> = text.lines().take(3).collect();
    assert_eq!(head[0], "Table 1 (near): From two metres, at most 10 darts");
    assert!(head[1].contains("success %"));
    assert!(text.contains("last miss (m)"));
    // Every value stands below the end of its column's word.
    let column = |line: &str, word: &str| {
        let byte = line.find(word).unwrap() + word.len();
        line[..byte].chars().count()
    };
    let novice = text
        .lines()
        .find(|line| line.starts_with("Novice"))
        .unwrap();
    assert_eq!(column(head[2], "paper"), column(novice, " 60.0"));
    assert!(!text.contains('\u{1b}'));
    let widest = text.lines().map(|line| line.chars().count()).max();
    assert!(widest.unwrap() <= 80, "{text}");
    // The tolerance is beside the word, the reasons are below.
    assert!(
        text.contains("matches ±15 (") && text.contains("cannot tell (0.03) [1]"),
        "{text}"
    );
    assert!(text.contains("\n[1] no tolerance is stated\n"), "{text}");
    assert!(
        text.contains("\n±15 for success %: darts scatter.\n"),
        "{text}"
    );
    assert!(text.contains("\n±35% for throws: arms tire.\n"), "{text}");
    assert!(tables_as_text(&outcome.analysis, Ink::Coloured).contains("\u{1b}[32mmatches"));
}

#[test]
fn the_report_is_one_file_without_network() {
    let out = fresh("report").join("out");
    let outcome = run(&Darts::new(), &options(&out)).0.unwrap();
    let page = read(&out, "report.html");
    assert!(page.starts_with("<!DOCTYPE html>"));
    for outside in ["http://", "https://", "src=", "<link", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("Throws until a hit, &lt;by&gt; skill &amp; distance"));

    for element in [
        "table", "tbody", "tr", "td", "section", "figure", "svg", "g", "circle", "ul", "li",
    ] {
        let opened = page.matches(&format!("<{element} ")).count()
            + page.matches(&format!("<{element}>")).count();
        let closed = page.matches(&format!("</{element}>")).count();
        assert!(
            opened > 0 && opened == closed,
            "{element}: {opened} {closed}"
        );
    }
    let mut ids: Vec<&str> = page
        .split(" id=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap())
        .collect();
    for named in [
        "table-1",
        "table-2",
        "theme",
        "replay-dialog",
        "box-1-throws",
        "box-1-throws-title",
    ] {
        assert!(ids.contains(&named), "{named}");
    }
    let all = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), all, "no id twice");

    // Every run is a dot in each of the two plots of its table.
    for run in &outcome.runs {
        let dot = format!("data-run=\"{}\" data-seed=\"{}\"", run.run, run.seed);
        assert_eq!(page.matches(&dot).count(), 2 * 3, "{dot}");
    }
}

#[test]
fn the_report_carries_the_replays_of_the_first_runs_of_each_row() {
    let out = fresh("replays").join("out");
    let darts = Darts::new();
    let outcome = run(&darts, &options(&out)).0.unwrap();
    assert_eq!(outcome.replays.of_each_row, 25);
    assert!(outcome.replays.tables.iter().eq(["1 (near)"]));
    let page = read(&out, "report.html");
    assert_eq!(page.matches(" data-replay ").count(), 3 * 25);
    assert!(page.contains("carries the replays of runs 0 to 24 of each row"));
    // A replay in the page equals that in a file of its own.
    let run_7 = page
        .split("data-row=\"Adept\" data-run=\"7\">")
        .nth(1)
        .unwrap();
    let run_7 = run_7.split("</script>").next().unwrap();
    let written = write_replay(&(&darts).into(), &options(&out), "1 (near)", "Adept", 7).unwrap();
    assert!(written.ends_with("replays/1-2-7.html"));
    assert!(fs::read_to_string(written).unwrap().contains(run_7));
    // The script knows the command that plays the others.
    assert!(page.contains(r#""shell":"'1 (near)'""#));

    let few = Options {
        runs: Some(3),
        ..options(&fresh("replays").join("few"))
    };
    run(&darts, &few).0.unwrap();
    let page = read(few.out.as_ref().unwrap(), "report.html");
    assert!(page.contains("This page carries the replay of every run."));
}

#[test]
fn replays_that_are_long_are_fewer_so_that_a_page_stays_below_its_size() {
    let out = fresh("long-replays").join("out");
    let mut darts = Darts::new();
    darts.replay_length = 7000;
    let outcome = run(&darts, &options(&out)).0.unwrap();
    let replays = outcome.replays;
    assert!(
        (1..25).contains(&replays.of_each_row),
        "{}",
        replays.of_each_row
    );
    // Rows have their replays in turn, so that some have one more than others.
    let whole_turns = 3 * replays.of_each_row as usize;
    assert!((whole_turns..whole_turns + 3).contains(&replays.recorded.len()));
    let bytes: usize = replays.recorded.iter().map(|one| one.json.len()).sum();
    assert!(bytes <= replays.budget);
    assert!(read(&out, "report.html").len() < 5_000_000);
}

#[test]
fn a_replay_can_be_written_before_the_experiment_is_run() {
    let out = fresh("replay-first").join("out");
    let (darts, options) = (Darts::new(), options(&out));
    write_replay(&(&darts).into(), &options, "1 (near)", "Master", 1000).unwrap();
    for (table, row, what) in [
        ("9", "Adept", "choose one of: 1 (near), 2 (far)"),
        (
            "1 (near)",
            "adept",
            "did you mean Adept? Known are: Novice, Adept, Master",
        ),
        ("2 (far)", "Adept", "not recorded"),
    ] {
        let error = write_replay(&(&darts).into(), &options, table, row, 0).unwrap_err();
        assert!(
            error.is_bad_input() && error.to_string().contains(what),
            "{error}"
        );
    }
    run(&darts, &options).0.unwrap();
    assert!(out.join("replays/1-3-1000.html").exists());
}

#[test]
fn tables_can_be_sorted_and_read_without_their_head() {
    let out = fresh("sorting").join("out");
    run(&Darts::new(), &options(&out)).0.unwrap();
    let page = read(&out, "report.html");
    let table = page
        .split("<table")
        .nth(1)
        .unwrap()
        .split("</table>")
        .next()
        .unwrap();
    let sorts = ["row", "paper", "ours", "p", "effect", "verdict"];
    for column in sorts {
        let head = format!(
            "scope=\"col\" data-sort=\"{column}\" aria-sort=\"none\"><button type=\"button\""
        );
        assert!(table.contains(&head), "{column} in {table}");
        let cell = format!("data-column=\"{column}\" data-value=\"");
        assert!(table.contains(&cell), "{column}");
    }
    assert_eq!(table.matches("data-sort").count(), sorts.len());
    assert_eq!(table.matches("data-place").count(), 3 * 4);
    // On a phone a cell stands without its column's head: it names itself, or is left out.
    for cell in table.split("<td").skip(1) {
        let tag = cell.split('>').next().unwrap();
        let named = ["data-label=", "verdict", "none"]
            .iter()
            .any(|name| tag.contains(name));
        assert!(named, "{tag}");
    }
}

#[test]
fn figures_are_xml_files_of_their_own() {
    let out = fresh("figures").join("out");
    let figures = out.join("figures");
    run(&Darts::new(), &options(&out)).0.unwrap();
    // An older figure is removed.
    fs::write(figures.join("old.svg"), "<svg/>").unwrap();
    run(&Darts::new(), &options(&out)).0.unwrap();

    let mut names: Vec<String> = fs::read_dir(&figures)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort_unstable();
    let expect = [
        "box-1-miss",
        "box-1-throws",
        "box-2-miss",
        "box-2-throws",
        "first-far-run",
        "first-run",
    ];
    assert_eq!(names, expect.map(|name| format!("{name}.svg")));
    for name in names {
        let text = read(&figures, &name);
        let document = roxmltree::Document::parse(&text).unwrap();
        let svg = document.root_element();
        assert_eq!(
            svg.tag_name().namespace(),
            Some("http://www.w3.org/2000/svg")
        );
        let labels = svg.attribute("aria-labelledby").unwrap();
        for label in labels.split(' ') {
            let node = document
                .descendants()
                .find(|node| node.attribute("id") == Some(label))
                .unwrap();
            assert!(!node.text().unwrap().is_empty());
        }
    }
}

#[test]
fn tables_of_any_name_have_figures() {
    let names: [String; 4] = ["日本".into(), "…".into(), "1 NEAR".into(), "a".repeat(5000)];
    for (i, name) in names.into_iter().enumerate() {
        let out = fresh(&format!("any-name-{i}")).join("out");
        let mut darts = Darts::new();
        darts.tables.truncate(1);
        darts.tables.push(darts.tables[0].clone());
        darts.tables[1].name = name;
        run(&darts, &options(&out)).0.unwrap();
        assert_eq!(fs::read_dir(out.join("figures")).unwrap().count(), 5);
    }
}
