//! The entrants of this experiment's tables. A new one is added here.

use alloc::sync::Arc;

use serde::Serialize;

use crate::venue::Venue;
use tolman_arena::Mind;
use tolman_arena::cast::Agent;
use tolman_arena::episode::EpisodeError;
use tolman_arena::mslst::{BetterLearned, better_config, learn, learn_better};
use tolman_arena::pioneer::{ENCODER_SD, calibrated, with_sensor_noise};
use tolman_experiment::BoxError;
use tolman_geom::Point;
use tolman_sim::robots::LaserPioneerConfig;
use tolman_systems::mslst::better::{BetterConfig, BetterNavigator};
use tolman_systems::mslst::{Learned, MslstConfig, Navigator};

/// A brain that competes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Entrant {
    /// An agent that learns nothing beforehand.
    Agent(Agent),
    /// MSLST, which learns a map first.
    Mslst(MslstConfig),
    /// MSLST that overlays a second graph to localize.
    Overlay(MslstConfig),
    /// The better system, on sensors with errors.
    Better,
}

/// An entrant that has finished learning and is ready for any number of runs.
#[derive(Debug)]
pub(super) enum Ready {
    Agent(Agent),
    Mslst {
        learned: Box<Learned>,
        config: MslstConfig,
        overlays: bool,
    },
    Better(Box<BetterLearned>),
}

/// Configuration of a learner.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(untagged)]
pub(super) enum LearnerConfig {
    Mslst(MslstConfig),
    Better(BetterConfig),
}

impl Entrant {
    /// Returns the entrants in order: the paper's baselines, `learners`, the oracles.
    pub(super) fn lineup(learners: impl IntoIterator<Item = Self>) -> Vec<Self> {
        let baselines = [Agent::Avoid, Agent::WallFollow].map(Self::Agent);
        let oracles = [Agent::Oracle, Agent::UnlocalizedOracle].map(Self::Agent);
        baselines
            .into_iter()
            .chain(learners)
            .chain(oracles)
            .collect()
    }

    /// Returns the name of its row.
    pub(super) fn row(self) -> String {
        match self {
            Self::Agent(agent) => agent.name().to_owned(),
            Self::Mslst(config) => format!("MSLST {}", config.threshold),
            Self::Overlay(config) => format!("MSLST {}, overlay", config.threshold),
            Self::Better => "Better".to_owned(),
        }
    }

    /// Returns whether it is compared with the others: whether it is not a baseline.
    pub(super) const fn competes(self) -> bool {
        !matches!(self, Self::Agent(Agent::Oracle | Agent::UnlocalizedOracle))
    }

    /// Returns whether it learns a map before it runs.
    pub(super) const fn learns(self) -> bool {
        !matches!(self, Self::Agent(_))
    }

    /// Returns the configuration of its learner in corridors `corridor_width` m wide, or `None` if
    /// it does not learn.
    pub(super) fn config(self, corridor_width: f64) -> Option<LearnerConfig> {
        match self {
            Self::Agent(_) => None,
            Self::Mslst(config) | Self::Overlay(config) => Some(LearnerConfig::Mslst(config)),
            Self::Better => {
                let robot = with_sensor_noise(&calibrated(), ENCODER_SD);
                let config = better_config(corridor_width, &robot);
                Some(LearnerConfig::Better(config))
            }
        }
    }

    /// Returns its robot. The better system's robot has sensors with errors.
    pub(super) fn robot(self, venue: &Venue) -> LaserPioneerConfig {
        match self {
            Self::Agent(_) | Self::Mslst(_) | Self::Overlay(_) => venue.robot.clone(),
            Self::Better => with_sensor_noise(&venue.robot, ENCODER_SD),
        }
    }

    /// Lets it learn in a world; `seed` seeds all random numbers.
    pub(super) fn ready(self, venue: &Venue, seed: u64) -> Result<Ready, BoxError> {
        Ok(match self {
            Self::Agent(agent) => Ready::Agent(agent),
            Self::Mslst(config) | Self::Overlay(config) => Ready::Mslst {
                learned: Box::new(learn(&venue.course, &venue.robot, &config, seed)?),
                config,
                overlays: matches!(self, Self::Overlay(_)),
            },
            Self::Better => {
                let learned = learn_better(&venue.course, &self.robot(venue), 1, seed)?;
                Ready::Better(Box::new(learned))
            }
        })
    }
}

impl Ready {
    /// Returns a mind for one run, without memory of other runs.
    pub(super) fn mind(&self, venue: &Venue) -> Result<Mind, EpisodeError> {
        Ok(match self {
            Self::Agent(agent) => venue.mind(*agent)?,
            Self::Mslst {
                learned,
                config,
                overlays,
            } => {
                let map = Arc::new(learned.map.clone());
                let navigator = Navigator::new(map, config);
                Mind::Brain(Box::new(match overlays {
                    true => navigator.overlaying(),
                    false => navigator,
                }))
            }
            Self::Better(learned) => {
                Mind::Rolling(Box::new(BetterNavigator::new(Arc::clone(&learned.map))))
            }
        })
    }

    /// Returns the true positions of its map's nodes, by id, m.
    pub(super) fn nodes(&self) -> &[Point] {
        match self {
            Self::Agent(_) => &[],
            Self::Mslst { learned, .. } => &learned.survey.positions,
            Self::Better(learned) => &learned.positions,
        }
    }

    /// Returns the map of MSLST; `None` for other entrants.
    pub(super) fn learned(&self) -> Option<&Learned> {
        match self {
            Self::Agent(_) | Self::Better(_) => None,
            Self::Mslst { learned, .. } => Some(learned),
        }
    }
}
