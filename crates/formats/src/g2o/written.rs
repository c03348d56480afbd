//! Writes a graph as the text of a file.

use core::fmt::Write;

use super::{G2o, G2oEdge, G2oPose};

impl G2o {
    /// Returns the text of a file: poses, edges, and `FIX` last, since some readers stop there. If
    /// no pose is fixed, the first one becomes fixed. Numbers are written exactly. O(poses +
    /// edges).
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        for pose in &self.poses {
            pose.write(&mut text);
        }
        for edge in &self.edges {
            edge.write(&mut text);
        }
        let first = self.poses.first().map(|pose| pose.id);
        let fixed = self.fixed.iter().copied();
        let none = self.fixed.is_empty().then_some(first).flatten();
        for id in fixed.chain(none) {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "FIX {id}");
        }
        text
    }
}

impl G2oPose {
    fn write(&self, text: &mut String) {
        let Self { id, pose } = self;
        let (x, y, heading) = (pose.position.x, pose.position.y, pose.heading.radians());
        let _ = writeln!(text, "VERTEX_SE2 {id} {x} {y} {heading}");
    }
}

impl G2oEdge {
    fn write(&self, text: &mut String) {
        let Self { from, to, .. } = self;
        let at = self.measured;
        let (x, y, heading) = (at.position.x, at.position.y, at.heading.radians());
        let _ = write!(text, "EDGE_SE2 {from} {to} {x} {y} {heading}");
        let matrix = &self.information;
        let upper = [
            matrix.m11, matrix.m12, matrix.m13, matrix.m22, matrix.m23, matrix.m33,
        ];
        for entry in upper {
            let _ = write!(text, " {entry}");
        }
        text.push('\n');
    }
}
