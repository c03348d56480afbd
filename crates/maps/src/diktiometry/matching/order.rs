use crate::diktiometry::{Matcher, Order, Situation, Tracking};

/// Whether "the region just traversed has been well traversed (hence probably mapped) in the past".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Traversal {
    Well,
    Poorly,
}

/// Whether a place was visited often.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Age {
    Young,
    Old,
}

impl Situation<'_> {
    /// Whether matcher `a` takes precedence over `b`: the *dynamic partial order*. `age` is that of the place that α-MATCH would grow.
    ///
    /// Source: paper, *Dynamic priorities*, for CONTINUE over LINK, and α-MATCH and new places against β-MATCH. Beyond it:
    /// what needs no mapping error goes before what posits one, and α-MATCH goes before a new place at young places.
    pub(super) fn precedes(&self, a: Matcher, b: Matcher, age: Age) -> bool {
        use Matcher::{Alpha, Beta, Continue, Link, NewPlace};
        let Tracking { high, low, .. } = self.config.tracks;
        if self.config.matching.order == Order::Static {
            return a < b;
        }
        match (a, b) {
            (Continue, Link) => self.traversed == Traversal::Well,
            (Continue | Link, Alpha | NewPlace | Beta) => true,
            (Alpha, NewPlace) => age == Age::Young,
            (Alpha | NewPlace, Beta) => self.confidence >= high,
            (Beta, Alpha | NewPlace) => self.confidence <= low,
            _ => false,
        }
    }
}
