//! The colours of rows.

/// The colour of one row, the same in every plot and plan of an experiment.
///
/// Seven colours that colour-blind readers can tell apart, after Okabe and Ito ("Color universal
/// design", 2008). They are lighter on dark pages. From the eighth series on they repeat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Series(pub u32);

impl Series {
    /// Number of different colours. Later series repeat them.
    pub const COLOURS: u32 = 7;

    /// Returns the CSS class that gives an element its colour.
    pub const fn class(self) -> &'static str {
        const CLASSES: [&str; Series::COLOURS as usize] = [
            "series-0", "series-1", "series-2", "series-3", "series-4", "series-5", "series-6",
        ];
        CLASSES[(self.0 % Self::COLOURS) as usize]
    }
}
