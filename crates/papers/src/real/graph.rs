//! Pose graphs from files.

use std::path::{Path, PathBuf};

use thiserror::Error;
use tolman_formats::input::{self, SourceError};
use tolman_formats::{G2o, G2oError};
use tolman_geom::Pose;
use tolman_maps::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph, PoseGraphError};

/// A pose graph with the file it was read from. Pose n of the graph is pose n of the file, sorted
/// by id. Edge n is edge n of the file.
#[derive(Clone, Debug)]
pub struct GraphFile {
    /// Contents of the file.
    pub file: G2o,
    /// The graph. The first edge between neighbours in the order of ids is odometry; any other edge
    /// is a closure.
    pub graph: PoseGraph,
}

/// Reason why a file is not a pose graph.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GraphFileError {
    /// The file cannot be read.
    #[error("cannot read {}; give a pose graph as g2o writes it, plain or gzipped", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Reason why the file cannot be read.
        source: SourceError,
    },
    /// The file holds no pose graph.
    #[error("{}", path.display())]
    G2o {
        /// Path of the file.
        path: PathBuf,
        /// Fault of the file, with its line.
        source: G2oError,
    },
    /// An edge of the file cannot be part of a graph.
    #[error("{}: line {line}", path.display())]
    Edge {
        /// Path of the file.
        path: PathBuf,
        /// Number of the edge's line, from 1.
        line: usize,
        /// Reason why the edge is refused.
        source: PoseGraphError,
    },
}

impl GraphFile {
    /// Reads a file.
    ///
    /// # Errors
    /// [`GraphFileError`] with the file and its fault.
    pub fn read(path: &Path) -> Result<Self, GraphFileError> {
        let bytes = input::bytes(path).map_err(|source| GraphFileError::File {
            path: path.to_owned(),
            source,
        })?;
        let file = G2o::read(&bytes).map_err(|source| GraphFileError::G2o {
            path: path.to_owned(),
            source,
        })?;
        Self::of(file).map_err(|(line, source)| GraphFileError::Edge {
            path: path.to_owned(),
            line,
            source,
        })
    }

    /// Returns the graph of a file's contents. An error has the number of the line.
    pub(super) fn of(file: G2o) -> Result<Self, (usize, PoseGraphError)> {
        let mut graph = PoseGraph::new();
        for pose in &file.poses {
            graph.add_pose(pose.pose);
        }
        let number = |id: u64| file.poses.partition_point(|pose| pose.id < id) as u32;
        let mut has_step = vec![false; file.poses.len()];
        for edge in &file.edges {
            let (from, to) = (number(edge.from), number(edge.to));
            let is_step = from.abs_diff(to) == 1;
            let seen = core::mem::replace(&mut has_step[from.max(to) as usize], true);
            let kind = match is_step && !seen {
                true => PoseEdgeKind::Odometry,
                false => PoseEdgeKind::Closure,
            };
            if !is_step {
                has_step[from.max(to) as usize] = seen;
            }
            let edge = PoseEdge {
                from,
                to,
                measured: edge.measured,
                information: edge.information,
                kind,
            };
            let line = file.edges[graph.edges().len()].line;
            graph.add_edge(edge).map_err(|error| (line, error))?;
        }
        Ok(Self { file, graph })
    }

    /// Returns the poses as the file has them.
    #[must_use]
    pub fn poses(&self) -> Vec<Pose> {
        self.file.poses.iter().map(|pose| pose.pose).collect()
    }
}
