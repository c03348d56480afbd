//! Solves the linear system of one step, (JᵀΩJ + λD) δ = −JᵀΩe, edge by edge without storing the
//! matrix.

use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::Pose;
use tolman_geom::nalgebra::{Matrix3, Vector3};

use super::PoseEdge;
use super::edge::Linearized;

/// One linear system. Pose 0 is fixed.
pub(super) struct LinearSystem<'a> {
    edges: &'a [PoseEdge],
    linearized: Vec<Linearized>,
    /// Each edge's information, scaled by its weight.
    information: Vec<Matrix3<f64>>,
    /// −JᵀΩe by pose.
    right_side: Vec<Vector3<f64>>,
    /// The blocks of JᵀΩJ on its diagonal.
    diagonal: Vec<Matrix3<f64>>,
}

impl<'a> LinearSystem<'a> {
    /// Returns the system about `poses`, in which `weight` gives each edge's weight. O(edges).
    pub(super) fn about(
        poses: &[Pose],
        edges: &'a [PoseEdge],
        weight: impl Fn(&PoseEdge, f64) -> f64,
    ) -> Self {
        let mut system = Self {
            edges,
            linearized: Vec::with_capacity(edges.len()),
            information: Vec::with_capacity(edges.len()),
            right_side: vec![Vector3::zeros(); poses.len()],
            diagonal: vec![Matrix3::zeros(); poses.len()],
        };
        for edge in edges {
            system.add(poses, edge, &weight);
        }
        system
    }

    fn add(&mut self, poses: &[Pose], edge: &PoseEdge, weight: impl Fn(&PoseEdge, f64) -> f64) {
        let (from, to) = (edge.from as usize, edge.to as usize);
        let linear = edge.linearize(poses[from], poses[to]);
        let squared = (edge.information * linear.error).dot(&linear.error);
        let information = edge.information * weight(edge, squared);
        let pull = information * linear.error;
        self.right_side[from] -= linear.by_from.tr_mul(&pull);
        self.right_side[to] -= linear.by_to.tr_mul(&pull);
        self.diagonal[from] += linear.by_from.tr_mul(&(information * linear.by_from));
        self.diagonal[to] += linear.by_to.tr_mul(&(information * linear.by_to));
        self.linearized.push(linear);
        self.information.push(information);
    }

    /// Returns the step of each pose, with the diagonal enlarged by the share `damping`. Uses
    /// conjugate gradients; the preconditioner is the inverse of the diagonal's blocks. O(edges)
    /// per iteration, at most `iterations` of them.
    pub(super) fn solve(&self, damping: f64, iterations: usize) -> Vec<Vector3<f64>> {
        let inverse: Vec<Matrix3<f64>> = (self.diagonal.iter())
            .map(|block| damped(block, damping).try_inverse().unwrap_or_default())
            .collect();
        let precondition = |residual: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            let pairs = inverse.iter().zip(residual);
            pairs.map(|(inverse, part)| inverse * part).collect()
        };
        let mut solution = vec![Vector3::zeros(); self.diagonal.len()];
        let mut residual = self.right_side.clone();
        if let Some(held) = residual.first_mut() {
            *held = Vector3::zeros();
        }
        let mut towards = precondition(&residual);
        let mut along = dot(&residual, &towards);
        let enough = along * ENOUGH;
        for _ in 0..iterations {
            if !(along > enough && along > 0.0) {
                break;
            }
            let changed = self.times(&towards, damping);
            let length = along / dot(&towards, &changed);
            add(&mut solution, length, &towards);
            add(&mut residual, -length, &changed);
            let steepest = precondition(&residual);
            let next = dot(&residual, &steepest);
            let kept = next / along;
            for (towards, steepest) in towards.iter_mut().zip(&steepest) {
                *towards = steepest + *towards * kept;
            }
            along = next;
        }
        solution
    }

    /// Returns the damped matrix times a vector.
    fn times(&self, vector: &[Vector3<f64>], damping: f64) -> Vec<Vector3<f64>> {
        let pairs = self.diagonal.iter().zip(vector);
        let mut product: Vec<Vector3<f64>> = pairs
            .map(|(block, part)| (damped(block, damping) - block) * part)
            .collect();
        let linearized = self.linearized.iter().zip(&self.information);
        for (edge, (linear, information)) in self.edges.iter().zip(linearized) {
            let (from, to) = (edge.from as usize, edge.to as usize);
            let change = linear.by_from * vector[from] + linear.by_to * vector[to];
            let pull = information * change;
            product[from] += linear.by_from.tr_mul(&pull);
            product[to] += linear.by_to.tr_mul(&pull);
        }
        if let Some(held) = product.first_mut() {
            *held = Vector3::zeros();
        }
        product
    }
}

/// Ratio of the squared residual, in the preconditioner's measure, to the first one at which the
/// iteration ends.
const ENOUGH: f64 = 1e-16;

fn damped(block: &Matrix3<f64>, damping: f64) -> Matrix3<f64> {
    block + Matrix3::from_diagonal(&block.diagonal()) * damping
}

fn dot(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}

fn add(sum: &mut [Vector3<f64>], length: f64, direction: &[Vector3<f64>]) {
    for (sum, direction) in sum.iter_mut().zip(direction) {
        *sum += direction * length;
    }
}
