//! An auditor of loop closures: finds which closures of a pose graph are right, by its odometry and
//! its other closures.
//!
//! [`audit`] finds each closure *supported* by independent cycles, *refuted* by a cycle that can be
//! measured again, or *undecided*, with the reason. Nothing is optimized: a false closure bends a
//! map, and the errors of a bent map are not evidence.
//!
//! - **Cycle**: a closure with a way back over odometry and other closures. Its error is χ² of the
//!   logarithm of its product, with 3 degrees of freedom, by first-order propagation of its edges'
//!   covariances. The *bound* is k², k = 5. A cycle is *tight* if the region of k standard
//!   deviations fills at most 3 ‰ of all poses within 5 m.
//! - **Run**: closures of one drive along a stretch driven before. They do not contradict each
//!   other, and about the same way was driven between one and the next at both ends. They err
//!   together, so a run is one witness, however long.
//! - **Witness**: a tight cycle within its bound. Witnesses of one closure share no run with it or
//!   each other. Odometry alone is one.
//!
//! The steps: closures that odometry alone refutes are found in O(1) by sums of its covariance
//! (`chain`). The others are compared in pairs (`consistency`), and the greatest group without
//! conflicts is believed first. A closure then stays believed only as long as the surest way over
//! odometry and other believed closures agrees with it (`belief`, `search`). The result is a
//! greatest fixed point.
//!
//! [`verify`] measures every cycle of an audit again. [`SigmaScale::estimate`] tells whether the
//! stated covariances are those of the graph.

mod auditor;
mod belief;
mod chain;
mod config;
mod consistency;
mod cycle;
mod error;
mod groups;
mod layout;
mod link;
mod motion;
mod run;
mod scale;
mod search;
mod verdict;
mod verify;
mod way;

pub use auditor::{audit, errors_of_witnesses};
pub use config::AuditConfig;
pub use cycle::{AuditCycle, CycleError, CycleStep};
pub use error::AuditError;
pub use layout::supported_graph;
pub use scale::SigmaScale;
pub use verdict::{Audit, AuditedClosure, ClosureVerdict, RefutedBy, UndecidedBecause};
pub use verify::{AuditCertificateError, verify};
