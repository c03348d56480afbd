//! The HTML file of a replay.

use maud::{DOCTYPE, PreEscaped, html};
use tolman_draw::visible;

use super::{EncodeError, Replay, json};

/// Generator named in the page, by which the command recognizes its own files.
const GENERATOR: &str = "tolman replay";

/// Returns the player, for a page that opens replays itself. It defines `TolmanReplay`. Comments
/// are removed.
#[must_use]
pub fn script() -> String {
    compact(include_str!("player.js"))
}

/// Returns the player's style rules. All of them apply below `.tolman-replay`.
#[must_use]
pub const fn style() -> &'static str {
    include_str!("player.css")
}

/// Returns the whole HTML file, which opens in any browser and needs no network.
///
/// # Errors
/// As [`json`].
pub fn page(replay: &Replay) -> Result<String, EncodeError> {
    let data = json(replay)?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="generator" content=(GENERATOR);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'";
                title { (replay.title) }
                style { "html,body{margin:0;height:100%}" (PreEscaped(style())) }
            }
            body {
                div #replay {}
                noscript { "This replay is drawn by a script: allow scripts for this file." }
                script #replay-data type="application/json" { (PreEscaped(data)) }
                script { (PreEscaped(script())) }
                script {
                    "TolmanReplay.open(document.getElementById('replay'), \
                        JSON.parse(document.getElementById('replay-data').textContent), \
                        { autoplay: " (!replay.chapters.is_empty()) " });"
                }
            }
        }
    };
    Ok(visible(&page.into_string()).into_owned())
}

/// Returns whether [`page`] made a file that begins with these bytes. The first thousand are
/// enough.
#[must_use]
pub fn is_replay(beginning: &[u8]) -> bool {
    let mark = format!("name=\"generator\" content=\"{GENERATOR}\"");
    beginning
        .windows(mark.len())
        .any(|window| window == mark.as_bytes())
}

/// Removes comments on lines of their own, indentation, and spaces and line ends that separate
/// nothing. Strings must be in double quotes and on one line.
fn compact(source: &str) -> String {
    let lines = source.lines().map(str::trim);
    let code: Vec<&str> = lines
        .filter(|line| !line.is_empty() && !line.starts_with("//"))
        .collect();
    let mut out = String::new();
    let (mut quoted, mut escaped) = (false, false);
    let mut rest = code
        .join("\n")
        .chars()
        .collect::<Vec<char>>()
        .into_iter()
        .peekable();
    while let Some(c) = rest.next() {
        let last = out.chars().next_back().unwrap_or(';');
        let drop = match c {
            _ if quoted => false,
            ' ' => separates(last) || rest.peek().is_some_and(|next| separates(*next)),
            '\n' => {
                let closes = |next: &char| "})],;.?:".contains(*next);
                ";,{([".contains(last) || rest.peek().is_some_and(closes)
            }
            _ => false,
        };
        if !drop {
            out.push(c);
        }
        if c == '"' && !escaped {
            quoted = !quoted;
        }
        escaped = quoted && c == '\\' && !escaped;
    }
    out
}

/// Returns whether no space is needed beside this character. Plus and minus always need one: two of
/// them are another operator.
fn separates(c: char) -> bool {
    ",;:{}()[]?=<>*&|!".contains(c)
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Point, Pose};
    use tolman_robot::Body;

    use super::*;
    use crate::{RobotTrack, Scenery};

    /// Returns a replay in which every text tries to end the script that contains it.
    fn hostile() -> Replay {
        let text = "</script><script>alert(1)</script><!--";
        let poses = vec![Pose::new(Point::origin(), Heading::EAST)];
        let track = RobotTrack::new(text, Body::Circle { radius: 0.1 }, poses);
        Replay::new(text, 0.1, Scenery::default(), vec![track]).fact(text, text)
    }

    #[test]
    fn no_text_ends_the_script_it_stands_in() {
        let page = page(&hostile()).unwrap();
        assert_eq!(page.matches("<script").count(), 3, "data, player, start");
        assert_eq!(page.matches("</script>").count(), 3);
        assert!(!page.contains("<!--"));
        let data = json(&hostile()).unwrap();
        let read: serde_json::Value = serde_json::from_str(&data).unwrap();
        assert_eq!(read["title"], hostile().title);
    }

    #[test]
    fn a_page_knows_itself_and_nothing_else() {
        let page = page(&hostile()).unwrap();
        assert!(is_replay(&page.as_bytes()[..1000]));
        assert!(!is_replay(b"<!DOCTYPE html><meta name=\"generator\">"));
        assert!(!is_replay(b""));
    }

    #[test]
    fn the_source_is_one_that_can_be_compacted() {
        let source = include_str!("player.js");
        assert!(!source.contains("</"), "nothing that could end its element");
        let lines = source.lines().map(str::trim);
        let code = lines.filter(|line| !line.starts_with("//"));
        for line in code {
            assert!(!line.contains("//"), "a comment behind code: {line}");
            assert!(!line.contains(['`', '\'']), "not in double quotes: {line}");
        }
    }

    #[test]
    fn compact_code_means_the_same() {
        let source = "// why\nconst a = [1, 2];\nif (a) {\n  f(\"a , \\\" b\", x + +y);\n}\ng();\n";
        let compacted = "const a=[1,2];if(a){f(\"a , \\\" b\",x + +y);}\ng();";
        assert_eq!(compact(source), compacted);
    }
}
