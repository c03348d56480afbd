//! Pose graphs in the plane as g2o, GTSAM, TORO and RTAB-Map write them. The lines are `VERTEX_SE2
//! id x y θ`, `EDGE_SE2 from to x y θ …` and `FIX id`. An edge ends with the upper triangle of its
//! information matrix, row by row. TORO's `VERTEX2` and `EDGE2` are the same with the matrix in
//! another order. `VERTEX_SE3:QUAT` and `EDGE_SE3:QUAT` are read if they lie in the plane.
//!
//! Source: R. Kümmerle, G. Grisetti, H. Strasdat, K. Konolige, W. Burgard: g2o: A General Framework
//! for Graph Optimization, 2011, and
//! <https://github.com/RainerKuemmerle/g2o/wiki/File-Format-SLAM-2D>.

mod fault;
mod line;
mod space;
mod written;

use std::io::Read;

use alloc::collections::BTreeMap;

use flate2::read::GzDecoder;
use thiserror::Error;
use tolman_geom::Pose;
use tolman_geom::nalgebra::Matrix3;

pub use fault::{G2oFault, G2oFaultKind};
use line::Entry;

use crate::input::{self, MOST_BYTES};

/// A pose graph in the plane, and the unusable parts of its file.
///
/// ```
/// use tolman_formats::G2o;
///
/// let text = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 100 0 0 100 0 400\nEDGE_SE2 0 7 1 0 0 1 0 0 1 0 1\n";
/// let graph = G2o::parse(text)?;
/// assert_eq!((graph.poses.len(), graph.edges.len()), (2, 1));
/// assert_eq!(graph.left_out[0].to_string(), "line 4: it needs pose 7, which has no VERTEX_SE2; add it");
/// assert!(graph.text().ends_with("FIX 0\n"));
/// # Ok::<(), tolman_formats::G2oError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct G2o {
    /// The poses, in the order of their ids.
    pub poses: Vec<G2oPose>,
    /// The edges, in the order of the file.
    pub edges: Vec<G2oEdge>,
    /// Ids of the poses that are fixed.
    pub fixed: Vec<u64>,
    /// Lines that were left out, in the order of the file.
    pub left_out: Vec<G2oFault>,
}

/// One `VERTEX_SE2` line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct G2oPose {
    /// Id of the pose in the file.
    pub id: u64,
    /// Pose as the file gives it.
    pub pose: Pose,
}

/// One `EDGE_SE2` line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct G2oEdge {
    /// Id of the pose from which the other was measured.
    pub from: u64,
    /// Id of the pose that was measured.
    pub to: u64,
    /// Pose of `to` relative to `from`.
    pub measured: Pose,
    /// Inverse of the measurement's covariance, for x (m), y (m) and heading (rad); symmetric and
    /// positive definite.
    pub information: Matrix3<f64>,
    /// Number of the edge's line in the file, from 1; 0 for an edge that is from no file.
    pub line: usize,
}

/// Reason why a file is not a pose graph at all.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum G2oError {
    /// No edge could be read.
    #[error("no EDGE_SE2 could be read{}; give a 2D pose graph as g2o writes it, plain or gzipped", of_first(.first))]
    NoEdges {
        /// First item that was left out; `None` if all were used.
        first: Option<Box<str>>,
    },
    /// The file is compressed, and not even its beginning can be unpacked.
    #[error("the gzip file cannot be unpacked: {why}; pack it again, or give it plain")]
    Gzip {
        /// Error of the unpacker.
        why: String,
    },
    /// The text of the compressed file is longer than the program accepts.
    #[error("the gzip file holds more than {} MB of text; give it in parts", MOST_BYTES >> 20)]
    TooLarge,
}

fn of_first(fault: &Option<Box<str>>) -> String {
    fault
        .as_ref()
        .map_or(String::new(), |fault| format!(" ({fault})"))
}

impl G2o {
    /// Reads a file's bytes, plain or gzipped, and returns the graph. Of a truncated gzip file the
    /// beginning is used, and a fault reported.
    ///
    /// # Errors
    /// [`G2oError`] if nothing in it is usable; single unusable lines are
    /// [left out](Self::left_out).
    pub fn read(bytes: &[u8]) -> Result<Self, G2oError> {
        if !bytes.starts_with(&[0x1f, 0x8b]) {
            return Self::parse(&String::from_utf8_lossy(bytes));
        }
        let mut text = Vec::new();
        let unpacked = GzDecoder::new(bytes)
            .take(MOST_BYTES + 1)
            .read_to_end(&mut text);
        if text.len() as u64 > MOST_BYTES {
            return Err(G2oError::TooLarge);
        }
        match unpacked {
            Err(error) if text.is_empty() => Err(G2oError::Gzip {
                why: error.to_string(),
            }),
            Err(_) => Self::of(&String::from_utf8_lossy(&text), true),
            Ok(_) => Self::parse(&String::from_utf8_lossy(&text)),
        }
    }

    /// Reads the text of a file. A file without any `VERTEX_SE2` has the poses that its edges name,
    /// all at the origin.
    ///
    /// # Errors
    /// [`G2oError::NoEdges`]; single lines that are of no use are [left out](Self::left_out).
    ///
    /// # Complexity
    /// O(n log n) for n lines.
    pub fn parse(text: &str) -> Result<Self, G2oError> {
        Self::of(input::without_mark(text), false)
    }

    fn of(text: &str, is_cut: bool) -> Result<Self, G2oError> {
        let mut reading = Reading::default();
        let mut lines = (1..).zip(text.lines()).peekable();
        while let Some((number, line)) = lines.next() {
            // The last number of a truncated file may have lost digits.
            if is_cut && lines.peek().is_none() {
                reading.leave_out(number, G2oFaultKind::Cut);
            } else {
                reading.take(number, line);
            }
        }
        reading.graph()
    }
}

/// Contents read so far.
#[derive(Default)]
struct Reading {
    poses: BTreeMap<u64, (Pose, usize)>,
    edges: Vec<G2oEdge>,
    fixed: Vec<(u64, usize)>,
    left_out: Vec<G2oFault>,
}

impl Reading {
    fn leave_out(&mut self, line: usize, kind: G2oFaultKind) {
        self.left_out.push(G2oFault { line, kind });
    }

    fn take(&mut self, number: usize, line: &str) {
        match Entry::of(number, line) {
            Ok(Entry::Nothing) => {}
            Ok(Entry::Pose(id, pose)) => self.take_pose(number, id, pose),
            Ok(Entry::Edge(edge)) => self.edges.push(edge),
            Ok(Entry::Fix(ids)) => self.fixed.extend(ids.into_iter().map(|id| (id, number))),
            Err(kind) => self.leave_out(number, kind),
        }
    }

    fn take_pose(&mut self, number: usize, id: u64, pose: Pose) {
        match self.poses.get(&id) {
            Some((_, first)) => {
                let first = *first;
                self.leave_out(number, G2oFaultKind::Twice { id, first });
            }
            None => {
                self.poses.insert(id, (pose, number));
            }
        }
    }

    fn graph(mut self) -> Result<G2o, G2oError> {
        if self.poses.is_empty() {
            let named = self.edges.iter().flat_map(|edge| [edge.from, edge.to]);
            self.poses = named.map(|id| (id, (Pose::IDENTITY, 0))).collect();
        }
        let edges = self.sound_edges();
        let fixed = self.sound_fixed();
        self.left_out.sort_by_key(|fault| fault.line);
        if edges.is_empty() {
            let first = self.left_out.first();
            return Err(G2oError::NoEdges {
                first: first.map(|fault| fault.to_string().into()),
            });
        }
        let poses = self.poses.into_iter();
        Ok(G2o {
            poses: poses.map(|(id, (pose, _))| G2oPose { id, pose }).collect(),
            edges,
            fixed,
            left_out: self.left_out,
        })
    }

    /// Returns the edges whose poses exist.
    fn sound_edges(&mut self) -> Vec<G2oEdge> {
        let mut sound = Vec::with_capacity(self.edges.len());
        for edge in core::mem::take(&mut self.edges) {
            let missing = [edge.from, edge.to]
                .into_iter()
                .find(|id| !self.poses.contains_key(id));
            match missing {
                Some(id) => self.leave_out(edge.line, G2oFaultKind::NoPose { id }),
                None => sound.push(edge),
            }
        }
        sound
    }

    fn sound_fixed(&mut self) -> Vec<u64> {
        let mut sound = Vec::new();
        for (id, line) in core::mem::take(&mut self.fixed) {
            match self.poses.contains_key(&id) {
                true => sound.push(id),
                false => self.leave_out(line, G2oFaultKind::NoPose { id }),
            }
        }
        sound
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;
    use proptest::prelude::*;
    use tolman_geom::{Heading, Point};

    use super::*;

    const GRAPH: &str = "\
# two poses and a closure
VERTEX_SE2 0 0 0 0
VERTEX_SE2 1 1 0 0.5
VERTEX_SE2 2 2.5 -1e-3 0
FIX 0
EDGE_SE2 0 1 1 0 0.5 100 1 2 200 3 400
EDGE_SE2 1 2 1.5 0 -0.5 100 0 0 100 0 400
EDGE_SE2 2 0 -2.5 0 0 10 0 0 10 0 40
";

    #[test]
    fn every_line_is_read() {
        let graph = G2o::parse(GRAPH).unwrap();
        assert_eq!(graph.left_out, []);
        assert_eq!(graph.fixed, [0]);
        let ids: Vec<u64> = graph.poses.iter().map(|pose| pose.id).collect();
        assert_eq!(ids, [0, 1, 2]);
        let edge = graph.edges[0];
        assert_eq!((edge.from, edge.to, edge.line), (0, 1, 6));
        let rows = [[100.0, 1.0, 2.0], [1.0, 200.0, 3.0], [2.0, 3.0, 400.0]];
        assert_eq!(
            edge.information,
            Matrix3::from_fn(|row, column| rows[row][column])
        );
    }

    #[test]
    fn what_is_wrong_is_left_out_and_told_with_its_line() {
        for (line, told) in [
            (
                "EDGE_SE2 0 9 1 0 0 1 0 0 1 0 1",
                "it needs pose 9, which has no VERTEX_SE2",
            ),
            (
                "EDGE_SE2 0 2 1 0 NaN 1 0 0 1 0 1",
                "`NaN` is not a finite number",
            ),
            ("EDGE_SE2 0 2 1 0 0 1 0 0 -1 0 1", "not positive definite"),
            ("EDGE_SE2 0 2 1 0 0 0 0 0 0 0 0", "not positive definite"),
            (
                "EDGE_SE2 0 2 1 0 0 1 0 0",
                "EDGE_SE2 has 8 numbers; expected 11",
            ),
            (
                "EDGE_SE2 0 2 1 0 0 1 0 0 1 0 1 7",
                "EDGE_SE2 has 12 numbers; expected 11",
            ),
            ("EDGE_SE2 1 1 1 0 0 1 0 0 1 0 1", "joins pose 1 with itself"),
            (
                "EDGE_SE2 0 -2 1 0 0 1 0 0 1 0 1",
                "`-2` is not the id of a pose",
            ),
            (
                "VERTEX_SE2 1 0 0 0",
                "pose 1 is given a second time, first in line 3",
            ),
            ("FIX 12", "needs pose 12"),
            (
                "EDGE_SE3:QUAT 0 1 0 0 0",
                "EDGE_SE3:QUAT has 5 numbers; expected 30",
            ),
            (
                "VERTEX_SE3:QUAT 7 0 0 1 0.7 0 0 0.7",
                "does not lie in the plane: it leans",
            ),
            ("EDGE_SE2 0 2 1 0 0", "the information matrix is missing"),
            (
                "EDGE_SE2 0 2 1,5 0 0 1 0 0 1 0 1",
                "`1,5` is not a finite number; write decimal points",
            ),
            ("ODOM 1 2 3", "`ODOM` is not read"),
        ] {
            let graph = G2o::parse(&format!("{GRAPH}{line}\n")).unwrap();
            assert_eq!(graph.edges.len(), 3);
            let fault = graph.left_out[0].to_string();
            assert!(
                fault.starts_with("line 9: ") && fault.contains(told),
                "{fault}"
            );
        }
    }

    #[test]
    fn graphs_of_toro_and_planar_ones_in_space_are_the_same_graph() {
        let plane = G2o::parse(GRAPH).unwrap();
        let toro = GRAPH
            .replace("VERTEX_SE2", "VERTEX2")
            .replace(
                "EDGE_SE2 0 1 1 0 0.5 100 1 2 200 3 400",
                "EDGE2 0 1 1 0 0.5 100 1 200 400 2 3",
            )
            .replace("EDGE_SE2", "EDGE2");
        assert_eq!(G2o::parse(&toro).unwrap(), plane);
        let space = "VERTEX_SE3:QUAT 0 0 0 9 0 0 0 1\nVERTEX_SE3:QUAT 1 1 2 9 0 0 1 0\n\
            EDGE_SE3:QUAT 0 1 1 2 0 0 0 1 0 10 1 0 0 0 2 20 0 0 0 3 1 0 0 0 1 0 0 1 0 40\n";
        let edge = G2o::parse(space).unwrap().edges[0];
        let information = [10.0, 1.0, 2.0, 1.0, 20.0, 3.0, 2.0, 3.0, 40.0];
        assert_eq!(edge.information, Matrix3::from_row_slice(&information));
        assert!((edge.measured.heading.radians().abs() - core::f64::consts::PI).abs() < 1e-9);
    }

    #[test]
    fn a_file_of_nothing_says_so() {
        for text in ["", "\u{0}\u{1}\u{2}", "VERTEX_SE2 0 0 0 0\n", "hello\n"] {
            let error = G2o::read(text.as_bytes()).unwrap_err();
            assert!(error.to_string().contains("no EDGE_SE2"), "{error}");
        }
        let error = G2o::read(&[0x1f, 0x8b, 1, 2]).unwrap_err();
        assert!(error.to_string().contains("gzip"), "{error}");
    }

    #[test]
    fn a_file_without_poses_has_those_of_its_edges() {
        let edges: String = GRAPH
            .lines()
            .skip(5)
            .map(|line| format!("{line}\n"))
            .collect();
        let graph = G2o::parse(&edges).unwrap();
        assert_eq!((graph.poses.len(), graph.edges.len()), (3, 3));
    }

    #[test]
    fn gzip_is_unpacked_and_a_cut_file_used_as_far_as_it_goes() {
        let mut long = GRAPH.to_owned();
        for id in 3_u64..2000 {
            long += &format!(
                "VERTEX_SE2 {id} {} 0 0\n",
                id.wrapping_mul(0x9e37_79b9) % 1013
            );
        }
        let mut packer = GzEncoder::new(Vec::new(), Compression::default());
        packer.write_all(long.as_bytes()).unwrap();
        let packed = packer.finish().unwrap();
        assert_eq!(G2o::read(&packed), G2o::parse(&long));
        let cut = G2o::read(&packed[..packed.len() / 2]).unwrap();
        assert!(cut.poses.len() < 2000);
        let told = cut.left_out.last().unwrap().to_string();
        assert!(told.contains("the file is cut off here"), "{told}");
    }

    #[test]
    fn the_fixed_pose_is_written_last() {
        let text = G2o::parse(GRAPH).unwrap().text();
        assert!(text.ends_with("EDGE_SE2 2 0 -2.5 0 0 10 0 0 10 0 40\nFIX 0\n"));
    }

    fn edge() -> impl Strategy<Value = G2oEdge> {
        let numbers = prop::array::uniform6(-9.0..9.0);
        (0..5_u64, 1..5_u64, numbers).prop_map(|(from, by, n)| {
            let root = Matrix3::new(n[3], n[4], n[5], 0.0, n[0], n[1], 0.0, 0.0, n[2]);
            let information = root * root.transpose() + Matrix3::identity();
            G2oEdge {
                from,
                to: (from + by) % 5,
                measured: Pose::new(Point::new(n[0], n[1]), Heading::from_radians(n[2])),
                information: (information + information.transpose()) * 0.5,
                line: 0,
            }
        })
    }

    proptest! {
        #[test]
        fn what_is_written_is_read_again(edges in prop::collection::vec(edge(), 1..9)) {
            let poses = (0..5).map(|id| G2oPose { id, pose: Pose::IDENTITY }).collect();
            let graph = G2o { poses, edges, fixed: vec![2], left_out: Vec::new() };
            let mut read = G2o::parse(&graph.text()).unwrap();
            for edge in &mut read.edges {
                edge.line = 0;
            }
            prop_assert_eq!(read, graph);
        }

        #[test]
        fn no_text_is_too_strange(text in "(?s).{0,80}", cut in 0..300_usize) {
            let _ = G2o::parse(&text);
            let cut = cut.min(GRAPH.len());
            let _ = G2o::parse(&format!("{}{text}{}", &GRAPH[..cut], &GRAPH[cut..]));
        }

        #[test]
        fn no_bytes_are_too_strange(bytes in prop::collection::vec(any::<u8>(), 0..80)) {
            let _ = G2o::read(&bytes);
            let _ = G2o::read(&[&[0x1f, 0x8b], &bytes[..]].concat());
        }
    }
}
