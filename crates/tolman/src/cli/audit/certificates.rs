//! The file of certificates. It names cycles by the ids and lines of the graph's file, so that
//! other programs can check them.

use alloc::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_maps::audit::{
    Audit, AuditConfig, AuditCycle, AuditedClosure, ClosureVerdict, CycleStep, RefutedBy,
};
use tolman_maps::pose_graph::PoseEdgeKind;
use tolman_papers::real::GraphFile;

use super::Audited;

pub(super) const NAME: &str = "certificates.json";

const FORMAT: &str = "tolman-audit";
const VERSION: u32 = 1;

/// Contents of the file. Undecided closures have no certificate and are left out.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CertificateFile {
    format: String,
    version: u32,
    /// Factor by which every standard deviation is multiplied.
    sigma_scale: f64,
    /// Number of standard deviations within which a cycle agrees.
    k: f64,
    poses: usize,
    closures: usize,
    runs: u32,
    refuted: Vec<RefutedLine>,
    supported: Vec<SupportedLine>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RefutedLine {
    line: usize,
    from: u64,
    to: u64,
    run: u32,
    by: RefutedBy,
    cycle: CycleLine,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SupportedLine {
    line: usize,
    from: u64,
    to: u64,
    run: u32,
    cycles: Vec<CycleLine>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CycleLine {
    steps: Vec<StepLine>,
    /// Logarithm of the product of all steps: x and y, m; heading, rad.
    residual: [f64; 3],
    /// Upper triangle of the residual's covariance, row by row.
    covariance: [f64; 6],
    chi2: f64,
}

/// A step of a cycle: along odometry, or over the closure on a line of the file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StepLine {
    from: u64,
    to: u64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
}

/// Reason why a file is not an audit of a graph.
#[derive(Debug, Error)]
pub(super) enum CertificateFileError {
    #[error("it is not a file of certificates: {0}; audit again without --verify")]
    Json(#[from] serde_json::Error),
    #[error(
        "it has format `{format}`, version {version}; this program reads `{FORMAT}`, version {VERSION}"
    )]
    Version { format: String, version: u32 },
    #[error("it says {told} {what}, but the graph has {found}: name the graph it was made from")]
    OtherGraph {
        what: &'static str,
        told: usize,
        found: usize,
    },
    #[error("k is {told}; this program audits with {expected}: audit again without --verify")]
    Bound { told: f64, expected: f64 },
    #[error(
        "line {line} of the graph holds no edge from {from} to {to}: name the graph it was made from"
    )]
    NoEdge { line: usize, from: u64, to: u64 },
    #[error("the graph has no pose {id}: name the graph it was made from")]
    NoPose { id: u64 },
}

impl CertificateFile {
    pub(super) fn of(audited: &Audited<'_>) -> Self {
        let names = Names(audited.file);
        let (mut refuted, mut supported) = (Vec::new(), Vec::new());
        for closure in &audited.audit.closures {
            let edge = audited.edge(closure);
            let (line, from, to, run) = (edge.line, edge.from, edge.to, closure.run);
            match &closure.verdict {
                ClosureVerdict::Refuted { by, cycle } => refuted.push(RefutedLine {
                    line,
                    from,
                    to,
                    run,
                    by: *by,
                    cycle: names.cycle(cycle),
                }),
                ClosureVerdict::Supported { witnesses } => supported.push(SupportedLine {
                    line,
                    from,
                    to,
                    run,
                    cycles: witnesses.iter().map(|cycle| names.cycle(cycle)).collect(),
                }),
                ClosureVerdict::Undecided(_) => {}
            }
        }
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            sigma_scale: audited.config.sigma_scale,
            k: audited.config.bound,
            poses: audited.file.file.poses.len(),
            closures: audited.audit.closures.len(),
            runs: audited.audit.runs,
            refuted,
            supported,
        }
    }

    pub(super) fn read(text: &str) -> Result<Self, CertificateFileError> {
        let file: Self = serde_json::from_str(text)?;
        if (file.format.as_str(), file.version) != (FORMAT, VERSION) {
            return Err(CertificateFileError::Version {
                format: file.format,
                version: file.version,
            });
        }
        Ok(file)
    }

    /// Returns the audit that the file describes, and the configuration it was made with.
    pub(super) fn audit(
        &self,
        file: &GraphFile,
    ) -> Result<(Audit, AuditConfig), CertificateFileError> {
        let mut config = AuditConfig::standard();
        config.sigma_scale = self.sigma_scale;
        if (self.k - config.bound).abs() > 0.0 {
            let (told, expected) = (self.k, config.bound);
            return Err(CertificateFileError::Bound { told, expected });
        }
        let closures = file.graph.edges().iter();
        let closures = closures.filter(|edge| edge.kind == PoseEdgeKind::Closure);
        for (what, told, found) in [
            ("poses", self.poses, file.file.poses.len()),
            ("closures", self.closures, closures.count()),
        ] {
            if told != found {
                return Err(CertificateFileError::OtherGraph { what, told, found });
            }
        }
        let places = Places::of(file);
        let mut all = Vec::new();
        for one in &self.refuted {
            all.push(AuditedClosure {
                edge: places.edge(one.line, one.from, one.to)?,
                run: one.run,
                verdict: ClosureVerdict::Refuted {
                    by: one.by,
                    cycle: places.cycle(&one.cycle)?,
                },
            });
        }
        for one in &self.supported {
            let cycles = one.cycles.iter().map(|cycle| places.cycle(cycle));
            all.push(AuditedClosure {
                edge: places.edge(one.line, one.from, one.to)?,
                run: one.run,
                verdict: ClosureVerdict::Supported {
                    witnesses: cycles.collect::<Result<_, _>>()?,
                },
            });
        }
        let runs = self.runs;
        Ok((
            Audit {
                closures: all,
                runs,
            },
            config,
        ))
    }
}

/// Translates the numbers of a graph into those of its file.
struct Names<'a>(&'a GraphFile);

impl Names<'_> {
    fn cycle(&self, cycle: &AuditCycle) -> CycleLine {
        let file = &self.0.file;
        let step = |step: &CycleStep| StepLine {
            from: file.poses[step.from as usize].id,
            to: file.poses[step.to as usize].id,
            line: step.over.map(|over| file.edges[over as usize].line),
        };
        CycleLine {
            steps: cycle.steps.iter().map(step).collect(),
            residual: cycle.residual,
            covariance: cycle.covariance,
            chi2: cycle.chi2,
        }
    }
}

/// Translates the numbers of a file into those of its graph.
struct Places<'a> {
    file: &'a GraphFile,
    edge_of_line: BTreeMap<usize, u32>,
}

impl<'a> Places<'a> {
    fn of(file: &'a GraphFile) -> Self {
        let lines = (0..).zip(&file.file.edges);
        Self {
            file,
            edge_of_line: lines.map(|(index, edge)| (edge.line, index)).collect(),
        }
    }

    fn pose(&self, id: u64) -> Result<u32, CertificateFileError> {
        let place = self
            .file
            .file
            .poses
            .binary_search_by_key(&id, |pose| pose.id);
        let place = place.map_err(|_| CertificateFileError::NoPose { id })?;
        Ok(place as u32)
    }

    /// Returns the edge on `line`, which joins the poses `from` and `to` in either direction.
    fn edge_between(&self, line: usize, from: u64, to: u64) -> Result<u32, CertificateFileError> {
        let found = self.edge_of_line.get(&line).copied().filter(|index| {
            let edge = &self.file.file.edges[*index as usize];
            [(edge.from, edge.to), (edge.to, edge.from)].contains(&(from, to))
        });
        found.ok_or(CertificateFileError::NoEdge { line, from, to })
    }

    /// Returns the edge on `line`, which leads from the pose `from` to the pose `to`.
    fn edge(&self, line: usize, from: u64, to: u64) -> Result<u32, CertificateFileError> {
        let index = self.edge_between(line, from, to)?;
        match self.file.file.edges[index as usize].from == from {
            true => Ok(index),
            false => Err(CertificateFileError::NoEdge { line, from, to }),
        }
    }

    fn cycle(&self, cycle: &CycleLine) -> Result<AuditCycle, CertificateFileError> {
        let step = |step: &StepLine| {
            let over = step
                .line
                .map(|line| self.edge_between(line, step.from, step.to));
            Ok(CycleStep {
                from: self.pose(step.from)?,
                to: self.pose(step.to)?,
                over: over.transpose()?,
            })
        };
        Ok(AuditCycle {
            steps: cycle
                .steps
                .iter()
                .map(step)
                .collect::<Result<_, CertificateFileError>>()?,
            residual: cycle.residual,
            covariance: cycle.covariance,
            chi2: cycle.chi2,
        })
    }
}
