//! Meanings of keys.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// Request of a key press.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wish {
    PauseOrGoOn,
    /// Make one step, and then pause.
    Step,
    Faster,
    Slower,
    /// Show or hide the laser's beams.
    Beams,
    /// Close the view and let the run go on.
    Close,
    /// End the program.
    Interrupt,
}

impl Wish {
    /// Keys with their meanings, as the panel shows them.
    pub(super) const KEYS: [&str; 3] = ["space pause   → step", "+/- speed   b beams", "q quit"];

    /// Returns the wish behind a key press, or `None` if the key has no meaning.
    pub(super) fn of(key: &KeyEvent) -> Option<Self> {
        if key.kind == KeyEventKind::Release {
            return None;
        }
        if key.modifiers.contains(KeyModifiers::CONTROL) {
            return (key.code == KeyCode::Char('c')).then_some(Self::Interrupt);
        }
        match key.code {
            KeyCode::Char(' ') => Some(Self::PauseOrGoOn),
            KeyCode::Right => Some(Self::Step),
            // `=` is `+` without shift.
            KeyCode::Char('+' | '=') => Some(Self::Faster),
            KeyCode::Char('-') => Some(Self::Slower),
            KeyCode::Char('b') => Some(Self::Beams),
            KeyCode::Char('q') | KeyCode::Esc => Some(Self::Close),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_what_they_mean() {
        let key = |code, modifiers| Wish::of(&KeyEvent::new(code, modifiers));
        let plain = |code| key(code, KeyModifiers::NONE);
        assert_eq!(plain(KeyCode::Char(' ')), Some(Wish::PauseOrGoOn));
        assert_eq!(plain(KeyCode::Right), Some(Wish::Step));
        assert_eq!(plain(KeyCode::Char('=')), plain(KeyCode::Char('+')));
        assert_eq!(plain(KeyCode::Char('c')), None);
        assert_eq!(plain(KeyCode::Left), None);
        let control = |letter| key(KeyCode::Char(letter), KeyModifiers::CONTROL);
        assert_eq!(control('c'), Some(Wish::Interrupt));
        assert_eq!(control('q'), None);
    }
}
