use crate::diktiometry::{Matcher, Precedence, Situation, Tracking, WorldKind};

impl Situation<'_> {
    /// Returns whether matcher `a` takes precedence over `b`: the *dynamic partial order*. `visits`
    /// are those of the place that α-MATCH would grow.
    ///
    /// Source: paper, *Dynamic priorities*, for CONTINUE over LINK, and α-MATCH and new places
    /// against β-MATCH. Beyond it, matchers without a mapping error precede those that posit one.
    /// α-MATCH precedes a new place at young places. In a static world β-MATCH precedes a new
    /// place, as an action leads to one place there.
    pub(super) fn precedes(&self, a: Matcher, b: Matcher, visits: u32) -> bool {
        use Matcher::{Alpha, Beta, Continue, Link, NewPlace};
        let Tracking { high, low, .. } = self.config.tracks;
        let matching = &self.config.matching;
        if matching.order == Precedence::Static {
            return a < b;
        }
        match (a, b) {
            // "The region just traversed has been well traversed (hence probably mapped) in the
            // past."
            (Continue, Link) => self.traversals >= matching.well_traversed,
            (Continue | Link, Alpha | NewPlace | Beta) => true,
            (Alpha, NewPlace) => visits < matching.alpha_visits,
            (Beta, NewPlace) if self.config.world == WorldKind::Static => true,
            (NewPlace, Beta) if self.config.world == WorldKind::Static => false,
            (Alpha | NewPlace, Beta) => self.confidence >= high,
            (Beta, Alpha | NewPlace) => self.confidence <= low,
            _ => false,
        }
    }
}
