//! An auditor of loop closures: which of a pose graph's closures are right, as far as its odometry
//! and its other closures tell.
//!
//! [`audit`] finds each closure *supported* by independent cycles, *refuted* by a cycle that can be
//! measured again, or *undecided*, with the reason. Nothing is optimized: a map bends to a false
//! closure, and what it errs by then is no evidence.
//!
//! - **Cycle**: a closure with a way back over odometry and other closures. Its *bound* is χ² of
//!   the logarithm of its product, 3 degrees of freedom, by first-order propagation of its edges'
//!   covariances: at most k², k = 5. It is *tight* if the region of k standard deviations fills at
//!   most 3 ‰ of all poses within 5 m.
//! - **Run**: closures linked by at most 3 poses at both ends, one by one, that do not contradict
//!   each other. They err together, so a run is one witness, however long.
//! - **Witness**: a tight cycle within its bound. Witnesses of one closure share no run with it or
//!   each other. Odometry alone is one.
//!
//! How: closures that odometry alone refutes are told in O(1) by sums of its covariance (`chain`).
//! The others are held against each other in pairs (`consistency`); the greatest group without
//! conflicts is believed first. Then a closure stays believed only as long as the surest way over
//! odometry and other believed closures agrees with it (`belief`, `search`): a greatest fixed
//! point.
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
