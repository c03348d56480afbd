//! The lessons of the playground, as a pupil does them. They run with the playground's tests: see
//! `playground`.

use crate::playground::{PATIENCE, opened};
use crate::tab::Tab;

/// Opens a task of a lesson by its address.
fn open(tab: &mut Tab, lesson: u64, task: u64) {
    tab.eval(&format!("location.hash = '#lesson-{lesson}-{task}'"));
    let at = "[tolmanPlayground.lessons.at?.lesson, tolmanPlayground.lessons.at?.task].join()";
    tab.until(&format!("{at} === '{lesson},{task}'"));
}

/// Sets the lines of the rule.
fn rule(tab: &mut Tab, sides: [&str; 4]) {
    for (line, side) in sides.into_iter().enumerate() {
        tab.eval(&format!(
            "(() => {{ const line = document.querySelector('[data-line=\"{line}\"]'); line.value = '{side}';
               line.dispatchEvent(new Event('change')); }})()"
        ));
    }
}

fn cells(tab: &mut Tab, cells: &[(u16, u16)]) {
    for (x, y) in cells {
        tab.click(&format!("#board [data-cell='{x} {y}']"));
    }
}

fn moves(tab: &mut Tab, moves: &[&str]) {
    for side in moves {
        tab.click(&format!("#keys [data-move='{side}']"));
    }
}

/// Presses the button that marks the answer, and returns what is told.
#[track_caller]
fn marked(tab: &mut Tab, tone: &str) -> String {
    tab.click("#check");
    let mark = "document.querySelector('#mark')";
    tab.until_within(&format!("!{mark}.hidden"), PATIENCE);
    let told = tab.eval(&format!(
        "[{mark}.dataset.tone, {mark}.textContent].join(': ')"
    ));
    let told = told.as_str().unwrap().to_owned();
    assert!(told.starts_with(tone), "{told}");
    told
}

/// Lets a wrong answer fail twice: then there is a hint, and not before.
#[track_caller]
fn fail_twice(tab: &mut Tab) {
    for is_hidden in [true, false] {
        marked(tab, "bad");
        assert_eq!(
            tab.eval("document.querySelector('#hint').hidden"),
            is_hidden
        );
    }
    let hint = tab.eval("document.querySelector('#hint-words').textContent");
    assert!(hint.as_str().is_some_and(|hint| hint.len() > 20), "{hint}");
    tab.eval("document.querySelector('#to-maze').click()");
}

/// Answers rightly, and goes where the page then leads.
#[track_caller]
fn pass(tab: &mut Tab, next: &str) -> String {
    let told = marked(tab, "good");
    assert_eq!(tab.eval("document.querySelector('#hint').hidden"), true);
    tab.click("#next");
    tab.until(&format!("location.hash === '{next}'"));
    told
}

/// Waits until a film of a robot plays.
#[track_caller]
fn filmed(tab: &mut Tab) {
    tab.until_within("tolmanPlayground.lessons.player?.step > 2", PATIENCE);
}

/// Drives the lost robot along the wall on its right until one cell is left, and chooses it. Which
/// cell that is the module says: it marks each.
#[track_caller]
fn find(tab: &mut Tab) {
    let found = "(() => {
        const { answer } = tolmanPlayground.lessons.at;
        for (let x = 0; x < 5; x++) for (let y = 0; y < 5; y++) {
          const chosen = JSON.stringify({ ...answer, cells: [{ x, y }] });
          if (JSON.parse(wasm_bindgen.mark_task(4, 1, chosen)).passed) return x + ' ' + y;
        }
        return null; })()";
    let open = "['east', 'north', 'west', 'south'].find(side =>
        !document.querySelector(`#keys [data-move=${side}]`).disabled)";
    for _ in 0..40 {
        if let Some(cell) = tab.eval(found).as_str() {
            tab.click(&format!("#board [data-cell='{cell}']"));
            return;
        }
        let side = tab.eval(open);
        moves(tab, &[side.as_str().unwrap()]);
    }
    assert_eq!(
        tab.eval("JSON.stringify(tolmanPlayground.lessons.at.answer)"),
        "found"
    );
}

#[test]
#[ignore = "needs a browser, and TOLMAN_PLAYGROUND"]
fn playground_a_pupil_does_all_lessons() {
    let Some((mut tab, _)) = opened("playground-lessons") else {
        return;
    };
    let tab = &mut tab;
    tab.click("#pages a[href='#lesson-1']");
    tab.until("!document.querySelector('#lesson').hidden");

    fail_twice(tab);
    rule(tab, ["north", "east", "west", "south"]);
    assert!(marked(tab, "bad").contains("circles"));
    filmed(tab);
    rule(tab, ["east", "north", "west", "south"]);
    let told = pass(tab, "#lesson-2");
    assert!(told.contains("never seen"), "{told}");

    tab.click("#board [data-wall='0 0 east']");
    fail_twice(tab);
    tab.click("#board [data-wall='0 0 east']");
    tab.click("#board [data-wall='2 2 north']");
    marked(tab, "good");
    filmed(tab);
    pass(tab, "#lesson-2-2");
    tab.click("#board [data-wall='4 0 east']");
    fail_twice(tab);
    tab.click("#again");
    tab.click("#board [data-wall='2 0 north']");
    pass(tab, "#lesson-3");

    cells(tab, &[(2, 0), (1, 1)]);
    fail_twice(tab);
    cells(tab, &[(1, 1), (3, 1), (0, 2)]);
    pass(tab, "#lesson-3-2");
    moves(tab, &["east", "west"]);
    fail_twice(tab);
    tab.click("#back-move");
    moves(tab, &["north", "east"]);
    let told = pass(tab, "#lesson-4");
    assert!(told.contains("20 places"), "{told}");

    cells(tab, &[(4, 4)]);
    fail_twice(tab);
    find(tab);
    pass(tab, "#lesson-4-2");
    moves(tab, &["south"]);
    fail_twice(tab);
    moves(tab, &["west", "north", "north"]);
    marked(tab, "good");
    filmed(tab);
    pass(tab, "#lesson-5");

    cells(tab, &[(0, 1), (0, 2)]);
    fail_twice(tab);
    cells(
        tab,
        &[
            (0, 3),
            (0, 2),
            (1, 2),
            (1, 3),
            (1, 4),
            (1, 5),
            (2, 5),
            (3, 5),
            (3, 4),
            (3, 3),
            (2, 3),
            (2, 2),
            (2, 1),
            (2, 0),
        ],
    );
    pass(tab, "#lesson-5-2");
    let proof = [
        (0, 1),
        (1, 0),
        (1, 2),
        (1, 3),
        (1, 4),
        (2, 1),
        (2, 5),
        (3, 4),
    ];
    cells(tab, &proof);
    // One too many is a proof too, but not the one that is asked for.
    cells(tab, &[(5, 5)]);
    fail_twice(tab);
    cells(tab, &[(5, 5)]);
    pass(tab, "#play");
    // Every lesson is ticked off, and the playground is there.
    let ticked = "[...document.querySelectorAll('#pages a')].filter(a => a.textContent.includes('✓')).length";
    assert_eq!(tab.whole(ticked), 5);
    assert_eq!(tab.eval("document.querySelector('#free').hidden"), false);
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser, and TOLMAN_PLAYGROUND"]
fn playground_lessons_are_seen_in_every_light_and_on_every_width() {
    let Some((mut tab, folder)) = opened("playground-lessons-look") else {
        return;
    };
    let tab = &mut tab;
    for lesson in 1..=5 {
        let tasks = tab.whole(&format!("LESSONS[{lesson} - 1].tasks.length"));
        for task in 1..=tasks {
            open(tab, lesson, task);
            // The last task of each lesson is also seen when it has failed twice.
            let stages: &[&str] = match task == tasks {
                true => &["asked", "failed"],
                false => &["asked"],
            };
            for stage in stages {
                if *stage == "failed" {
                    fail_twice(tab);
                    marked(tab, "bad");
                }
                tab.assert_seen_everywhere(&folder, &format!("{lesson}-{task}-{stage}"));
            }
        }
    }
    tab.assert_content();
}
