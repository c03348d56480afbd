//! Whatever the text: no parser panics, and what parses comes back the same when written.

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{Braided, Format, MazeFile, parse_as, read, read_as, write};

fn survives(text: &str) -> Result<(), TestCaseError> {
    let _ = read(text);
    for format in Format::ALL {
        let parsed = parse_as(text, format);
        match &parsed {
            Ok(file) => {
                prop_assert_eq!(file.maze.check().is_ok(), read_as(text, format).is_ok());
                for format in Format::ALL {
                    let Ok(written) = write(file, format) else {
                        continue;
                    };
                    let again = parse_as(&written, format).expect("what was written parses");
                    prop_assert_eq!(&again.maze, &file.maze);
                    if format == Format::Tolman {
                        let marked = MazeFile {
                            goal_is_assumed: false,
                            ..file.clone()
                        };
                        prop_assert_eq!(&again, &marked);
                    }
                }
                // These have no room for all marks.
                let is_full = matches!(format, Format::Blocks | Format::Underscores);
                prop_assert!(
                    is_full || write(file, format).is_ok(),
                    "a maze fits the format it came in"
                );
            }
            Err(error) => {
                prop_assert!(error.line >= 1 && error.column >= 1);
                prop_assert!(error.line <= text.split(['\n', '\r']).count());
                prop_assert_eq!(read_as(text, format).unwrap_err(), error.clone());
            }
        }
    }
    Ok(())
}

/// Returns a valid file of any format.
fn valid() -> impl Strategy<Value = String> {
    // From 4 × 4 on the goals are the classic middle, which every format holds; the last format, a
    // binary one, has other sizes.
    (2_u16..=5, 0..Format::ALL.len() - 1, any::<u64>()).prop_map(|(half, format, seed)| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let braided = Braided {
            width: 2 * half,
            height: 2 * half,
            share: 0.5,
        };
        let mut file = MazeFile::from(braided.generate(&mut rng).expect("a fit size"));
        file.name = Some("Any".to_owned());
        file.corridor_width = Some(0.5);
        write(&file, Format::ALL[format]).expect("a classic maze fits every format")
    })
}

proptest! {
    #[test]
    fn any_text(text in ".{0,200}") {
        survives(&text)?;
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        survives(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn text_of_the_characters_that_matter(text in "[-o+|SG 0-9,=\n\r\t#ä]{0,120}") {
        survives(&text)?;
    }

    #[test]
    fn rows_that_could_be_a_drawing(rows in prop::collection::vec("([o+](---|   )){2}o|[| ] [SG ] [| ] [SG ] [| ]", 1..8)) {
        survives(&rows.join("\n"))?;
    }

    #[test]
    fn headers_that_could_be_right(
        lines in prop::collection::vec(
            "(format|name|corridor_width|start|destination) ?= ?(tolman maze 1|\"?J\"?|0\\.5|[0-2] [0-1]( (north|east))?|[0-2],[0-1])",
            0..5,
        ),
    ) {
        survives(&format!("{}\n+---+---+\n| S   G |\n+---+---+\n", lines.join("\n")))?;
    }

    #[test]
    fn valid_files_with_a_few_characters_changed(
        text in valid(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), "[-o+|SG 0-9,=\n\tä]{0,2}"), 0..4),
    ) {
        let mut text: Vec<char> = text.chars().collect();
        for (at, put) in edits {
            let at = at.index(text.len().max(1)).min(text.len());
            let end = (at + 1).min(text.len());
            text.splice(at..end, put.chars());
        }
        survives(&text.into_iter().collect::<String>())?;
    }

    #[test]
    fn valid_files_cut_short(text in valid(), at in any::<prop::sample::Index>()) {
        survives(&text.chars().take(at.index(text.len())).collect::<String>())?;
    }
}
