use crate::Grid;

/// Reason why a maze cannot be generated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GenerateError {
    /// Too small for a start and a goal, or beyond [`Grid::MAX_SIDE`].
    #[error(
        "a maze of {width} × {height} cells cannot be generated: it needs at least 2 cells, and at \
         most {} a side",
        Grid::MAX_SIDE
    )]
    Size {
        /// Number of columns asked for.
        width: u16,
        /// Number of rows asked for.
        height: u16,
    },
    /// The share of dead ends to open is invalid.
    #[error("a share of {share} dead ends cannot be opened: give a number from 0 to 1")]
    Share {
        /// The share asked for.
        share: f64,
    },
    /// No room with such sides fits into the maze.
    #[error(
        "rooms with sides of {smallest} to {largest} cells do not fit a maze of {width} × {height}: \
         the shortest is at least 1, the longest no shorter, and no longer than the maze either way"
    )]
    RoomSide {
        /// Shortest side asked for, cells.
        smallest: u16,
        /// Longest side asked for, cells.
        largest: u16,
        /// Number of columns of the maze.
        width: u16,
        /// Number of rows of the maze.
        height: u16,
    },
    /// No drawing had the requested features.
    #[error(
        "none of {tries} drawings has all features that were asked for: ask for fewer dead ends or longer corridors, or a larger maze"
    )]
    Features {
        /// Number of drawings tried.
        tries: u32,
    },
    /// A drawing does not fit into this few cells.
    #[error(
        "{drawing}: {width} × {height} cells are too few: it needs at least {} × {}",
        least.0, least.1
    )]
    Small {
        /// Name of the drawing.
        drawing: &'static str,
        /// Number of columns asked for.
        width: u16,
        /// Number of rows asked for.
        height: u16,
        /// Minimum number of columns and rows.
        least: (u16, u16),
    },
}
