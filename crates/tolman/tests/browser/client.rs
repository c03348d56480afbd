//! The tests' own eyes, ears and hands: what they find on a page that is known.

use crate::{folder, tab};

const PAGE: &str = "<!doctype html><meta charset=utf-8>
<meta name=viewport content='width=device-width'><title>known</title>
<button onclick='count += 1'>press</button>
<script>
let count = 0, keys = '';
addEventListener('keydown', event => keys += event.key);
</script>
<p style='width: 700px'>wide</p>";

#[test]
#[ignore = "needs a browser"]
fn clicks_keys_and_widths_are_those_of_the_page() {
    let Some(mut tab) = tab() else { return };
    let file = folder("client").join("page.html");
    std::fs::write(&file, PAGE).unwrap();
    tab.load(&file, "");
    tab.click("button");
    tab.strike("x", 88);
    tab.strike("ArrowRight", 39);
    tab.until("count === 1 && keys === 'xArrowRight'");
    assert!(tab.overflow() <= 0.0);
    tab.resize(375, 667);
    assert!(tab.overflow() > 100.0);
    assert!(tab.look(&file.with_extension("png")).ground > 0.9);
    tab.assert_content();
}

#[test]
#[ignore = "needs a browser"]
fn what_goes_wrong_on_a_page_is_heard() {
    let Some(mut tab) = tab() else { return };
    let file = folder("client-wrong").join("page.html");
    let mut heard = 0;
    for wrong in [
        "console.error('oh')",
        "setTimeout(() => nothing.there, 0)",
        "fetch('http://127.0.0.1:9/').catch(() => 0)",
    ] {
        std::fs::write(&file, format!("{PAGE}<script>{wrong}</script>")).unwrap();
        tab.load(&file, "");
        tab.eval("new Promise(done => setTimeout(done, 50))");
        let now = tab.complaints().len();
        assert!(now > heard, "{wrong}");
        heard = now;
    }
}
