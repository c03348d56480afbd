use core::fmt;

use super::{Finding, Verdict};

/// Number of the paper's values by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VerdictTally {
    /// Number of values that match.
    pub matches: usize,
    /// Number of values that differ by less than the tolerance.
    pub close: usize,
    /// Number of values of our own systems that are better.
    pub better: usize,
    /// Number of values that differ.
    pub differs: usize,
    /// Number of values that cannot be judged.
    pub cannot_tell: usize,
}

impl VerdictTally {
    /// Returns the number of the paper's values.
    #[must_use]
    pub const fn all(&self) -> usize {
        self.judged() + self.cannot_tell
    }

    /// Returns the number of values that could be judged.
    #[must_use]
    pub const fn judged(&self) -> usize {
        self.matches + self.close + self.better + self.differs
    }

    /// Counts one more verdict.
    fn add(&mut self, finding: &Finding) {
        *match finding {
            Finding::Matches => &mut self.matches,
            Finding::Close => &mut self.close,
            Finding::Better => &mut self.better,
            Finding::Differs => &mut self.differs,
            Finding::CannotTell(_) => &mut self.cannot_tell,
        } += 1;
    }
}

impl<'a> FromIterator<&'a Verdict> for VerdictTally {
    fn from_iter<I: IntoIterator<Item = &'a Verdict>>(verdicts: I) -> Self {
        let mut tally = Self::default();
        for verdict in verdicts {
            tally.add(&verdict.finding);
        }
        tally
    }
}

impl VerdictTally {
    /// Returns the values that do not match, by verdict: `2 close, 3 differ, 8 cannot tell`.
    pub(super) fn others(&self) -> String {
        let better = match self.better {
            0 => String::new(),
            better => format!("{better} better, "),
        };
        let Self {
            close,
            differs,
            cannot_tell,
            ..
        } = self;
        format!("{close} close, {better}{differs} differ, {cannot_tell} cannot tell")
    }
}

/// `5 of 18 match, 2 close, 3 differ, 8 cannot tell`.
impl fmt::Display for VerdictTally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} match, {}",
            self.matches,
            self.all(),
            self.others()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::Doubt;
    use super::*;

    #[test]
    fn a_headline_counts_every_value_once() {
        let verdict = |finding| Verdict {
            finding,
            ..Verdict::unknown(Doubt::NoRuns)
        };
        let findings = [
            Finding::Matches,
            Finding::Differs,
            Finding::Matches,
            Finding::CannotTell(Doubt::OneRun),
        ];
        let verdicts = findings.map(verdict);
        let mut tally: VerdictTally = verdicts.iter().collect();
        assert_eq!(
            tally.to_string(),
            "2 of 4 match, 0 close, 1 differ, 1 cannot tell"
        );
        tally.add(&Finding::Better);
        tally.add(&Finding::Close);
        assert_eq!((tally.all(), tally.judged()), (6, 5));
        assert_eq!(
            tally.to_string(),
            "2 of 6 match, 1 close, 1 better, 1 differ, 1 cannot tell"
        );
    }
}
