use core::fmt::Write;

use tolman_robot::{MapPlace, MapView};

/// Returns a map of places in the language of Graphviz, each place pinned at its position.
/// `neato -n2` draws it to scale, 72 points per metre.
///
/// ```
/// use tolman_formats::dot;
/// use tolman_formats::robot::MapView;
/// assert_eq!(dot(&MapView::default()), "digraph places {\n}\n");
/// ```
#[must_use]
pub fn dot(map: &MapView) -> String {
    let mut text = "digraph places {\n".to_owned();
    for MapPlace { id, position, .. } in &map.places {
        // Writing to a String cannot fail.
        let _ = match position {
            Some(at) => writeln!(
                text,
                "  {id} [pos=\"{:.2},{:.2}!\"];",
                72.0 * at.x,
                72.0 * at.y
            ),
            None => writeln!(text, "  {id};"),
        };
    }
    for link in &map.links {
        let _ = writeln!(text, "  {} -> {};", link.from, link.to);
    }
    text.push_str("}\n");
    text
}
