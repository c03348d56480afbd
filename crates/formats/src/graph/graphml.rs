use core::fmt::Write;

use tolman_robot::{MapPlace, MapView};

const HEAD: &str = "\
<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">
  <key id=\"x\" for=\"node\" attr.name=\"x\" attr.type=\"double\"/>
  <key id=\"y\" for=\"node\" attr.name=\"y\" attr.type=\"double\"/>
  <graph id=\"places\" edgedefault=\"directed\">
";

/// Returns a map of places as GraphML, with `x` and `y`, m, of each place with a known position.
///
/// Source: <http://graphml.graphdrawing.org>.
#[must_use]
pub fn graphml(map: &MapView) -> String {
    let mut text = HEAD.to_owned();
    for MapPlace { id, position, .. } in &map.places {
        // Writing to a String cannot fail.
        let _ = match position {
            Some(at) => writeln!(
                text,
                "    <node id=\"{id}\"><data key=\"x\">{:.6}</data><data key=\"y\">{:.6}</data></node>",
                at.x, at.y
            ),
            None => writeln!(text, "    <node id=\"{id}\"/>"),
        };
    }
    for link in &map.links {
        let (from, to) = (link.from, link.to);
        let _ = writeln!(text, "    <edge source=\"{from}\" target=\"{to}\"/>");
    }
    text.push_str("  </graph>\n</graphml>\n");
    text
}
