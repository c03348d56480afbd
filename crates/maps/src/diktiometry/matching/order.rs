use crate::diktiometry::config::{Order, Tracking};

use super::Matcher;

/// The meta-knowledge that the order depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::diktiometry) struct Standing {
    /// How often the region just traversed was traversed before.
    pub(in crate::diktiometry) traversed: Traversal,
    /// The track's confidence.
    pub(in crate::diktiometry) confidence: f64,
    /// Whether the place that α-MATCH would grow is young.
    pub(in crate::diktiometry) age: Age,
}

/// Whether "the region just traversed has been well traversed (hence probably mapped) in the past".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::diktiometry) enum Traversal {
    Well,
    Poorly,
}

/// Whether a place was visited often.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::diktiometry) enum Age {
    Young,
    Old,
}

/// Whether matcher `a` takes precedence over `b`: the *dynamic partial order*.
///
/// Source: paper, *Dynamic priorities*, for CONTINUE over LINK, and α-MATCH and new places against β-MATCH. Beyond it:
/// what needs no mapping error goes before what posits one, and α-MATCH goes before a new place at young places.
pub(in crate::diktiometry) fn precedes(
    a: Matcher,
    b: Matcher,
    standing: &Standing,
    tracking: &Tracking,
    order: Order,
) -> bool {
    use Matcher::{Alpha, Beta, Continue, Link, NewPlace};
    if order == Order::Static {
        return a < b;
    }
    match (a, b) {
        (Continue, Link) => standing.traversed == Traversal::Well,
        (Continue | Link, Alpha | NewPlace | Beta) => true,
        (Alpha, NewPlace) => standing.age == Age::Young,
        (Alpha | NewPlace, Beta) => standing.confidence >= tracking.high,
        (Beta, Alpha | NewPlace) => standing.confidence <= tracking.low,
        _ => false,
    }
}
