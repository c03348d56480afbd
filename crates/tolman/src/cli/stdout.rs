//! Standard output that is named in its errors.

use std::io::{self, BufWriter, StdoutLock, Write};

use tolman_draw::visible;
use tolman_experiment::Ink;

/// Writer of results, in which everything is [`visible`]. Unlike `println!` it does not panic when
/// the reader has gone.
pub(super) struct Stdout(BufWriter<StdoutLock<'static>>);

impl Stdout {
    pub(super) fn lock() -> Self {
        Self(BufWriter::new(io::stdout().lock()))
    }
}

impl Write for Stdout {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // All results are text, and none is cut within a character.
        let text = String::from_utf8_lossy(bytes);
        let written = self.0.write_all(visible(&text).as_bytes());
        written.map(|()| bytes.len()).map_err(|error| named(&error))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(|error| named(&error))
    }
}

fn named(error: &io::Error) -> io::Error {
    io::Error::new(
        error.kind(),
        format!("cannot write to standard output: {error}"),
    )
}

/// Writes `tables` to standard output after all that was written to `out`. Of their control
/// characters, only the colours stay.
pub(super) fn write_coloured(tables: &str, out: &mut dyn Write) -> io::Result<()> {
    let mut parts = tables.split(ESCAPE);
    let mut shown = visible(parts.next().unwrap_or_default()).into_owned();
    for part in parts {
        let code = part.strip_prefix('[').and_then(|rest| rest.split_once('m'));
        let is_code = |code: &str| {
            code.bytes()
                .all(|byte| byte.is_ascii_digit() || byte == b';')
        };
        match code.filter(|(code, _)| is_code(code)) {
            Some((code, rest)) => shown += &format!("{ESCAPE}[{code}m{}", visible(rest)),
            None => shown += &visible(&format!("{ESCAPE}{part}")),
        }
    }
    out.flush()?;
    let mut raw = io::stdout().lock();
    raw.write_all(shown.as_bytes())
        .and_then(|()| raw.flush())
        .map_err(|error| named(&error))
}

const ESCAPE: char = '\u{1b}';

/// Returns whether standard output is coloured.
pub(super) fn ink() -> Ink {
    match anstream::AutoStream::choice(&io::stdout()) {
        anstream::ColorChoice::Never => Ink::Plain,
        _ => Ink::Coloured,
    }
}
