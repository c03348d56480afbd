// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_geom::Point;
use tolman_maps::mslst_graph::{ActionEdge, GraphError, MslstGraph, Node, NodeZone};
use tolman_maze::Direction;

use super::{GrowthRecord, Learned, MslstConfig, MslstMap, States, StatesError};
use crate::{FileError, MapFiles, Origin};

const FILES: MapFiles = MapFiles { system: "mslst" };

/// Contents of a learned map's file: JSON, read back bit for bit.
#[derive(Clone, Debug)]
pub struct MapFile {
    /// Maze, robot and seed of its origin.
    pub origin: Origin,
    /// Configuration with which the map was learned.
    pub config: MslstConfig,
    /// Map that the robot learned.
    pub learned: Learned,
}

/// Reason why a file holds no map.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// The header or the JSON is invalid, or names another system.
    #[error(transparent)]
    File(#[from] FileError),
    /// The states are invalid.
    #[error("its states are invalid; learn the map again")]
    States(#[from] StatesError),
    /// The graph is invalid.
    #[error("its nodes do not form a graph; learn the map again")]
    Graph(#[from] GraphError),
    /// A node's state is not among the states.
    #[error(
        "node {node} has state {state}, but there are only {count} states; learn the map again"
    )]
    NoSuchState {
        /// Number of the node, from 0.
        node: usize,
        /// State that the node names.
        state: u32,
        /// Number found.
        count: usize,
    },
}

#[derive(Serialize, Deserialize)]
struct Body {
    config: MslstConfig,
    /// Ranges in robot units, beam 0 to the north, then counter-clockwise.
    states: Vec<Vec<f64>>,
    nodes: Vec<SavedNode>,
}

#[derive(Serialize, Deserialize)]
struct SavedNode {
    state: u32,
    destination: bool,
    /// Action and head; a failed action has none.
    edges: Vec<(Direction, Option<u32>)>,
    /// True position of the robot, m, if it was recorded; for pictures only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    made_at: Option<[f64; 2]>,
    /// Action of Phase II that made the node; `None` if it was not recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    made_by: Option<u32>,
}

impl MapFile {
    /// Returns the text of the file, with a line end.
    ///
    /// # Errors
    /// [`MapFileError::File`] if it cannot be written.
    pub fn to_json(&self) -> Result<String, MapFileError> {
        let Learned { map, survey } = &self.learned;
        let nodes = map.graph.nodes().iter().enumerate();
        let body = Body {
            config: self.config,
            states: map.states.models().to_vec(),
            nodes: nodes
                .map(|(id, node)| SavedNode {
                    state: node.state,
                    destination: node.zone == NodeZone::Destination,
                    edges: node
                        .edges
                        .iter()
                        .map(|edge| (edge.action, edge.head))
                        .collect(),
                    made_at: survey.positions.get(id).map(|point| [point.x, point.y]),
                    made_by: survey.made_by.get(id).copied(),
                })
                .collect(),
        };
        Ok(FILES.write(&self.origin, &body)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MapFileError`] with the place and the repair.
    pub fn from_json(text: &str) -> Result<Self, MapFileError> {
        let (origin, body): (_, Body) = FILES.read(text)?;
        let count = body.states.len();
        for (index, node) in body.nodes.iter().enumerate() {
            if node.state as usize >= count {
                return Err(MapFileError::NoSuchState {
                    node: index,
                    state: node.state,
                    count,
                });
            }
        }
        let survey = surveyed(&body.nodes);
        let nodes = body.nodes.into_iter().map(restored).collect();
        let map = MslstMap {
            states: States::from_models(body.states)?,
            graph: MslstGraph::from_nodes(nodes)?,
        };
        Ok(Self {
            origin,
            config: body.config,
            learned: Learned { map, survey },
        })
    }
}

/// Returns the growth record of the nodes. A list stays empty if any node lacks its value.
fn surveyed(nodes: &[SavedNode]) -> GrowthRecord {
    let positions: Option<Vec<Point>> = nodes
        .iter()
        .map(|node| node.made_at.map(Point::from))
        .collect();
    let made_by: Option<Vec<u32>> = nodes.iter().map(|node| node.made_by).collect();
    GrowthRecord {
        positions: positions.unwrap_or_default(),
        made_by: made_by.unwrap_or_default(),
    }
}

fn restored(node: SavedNode) -> Node {
    let edges = node.edges.into_iter();
    Node {
        state: node.state,
        zone: if node.destination {
            NodeZone::Destination
        } else {
            NodeZone::Elsewhere
        },
        edges: edges
            .map(|(action, head)| ActionEdge { action, head })
            .collect(),
    }
}
