use core::ops::ControlFlow;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Pose;
use tolman_maps::cpm::{Arrival, CpMap, Location};
use tolman_robot::Landmark;
use tolman_systems::cpm::{
    Aim, Approach, Begun, CommonPatterns, CpmConfig, Done, Episode, Layer3, Search, Step, Walker,
    Whereabouts,
};

use super::fragments::TrueFragments;
use super::robots::SimulatedEpuck;
use super::trial::{Trial, TrialError};

/// One episode by itself: of a robot that learns a map to be kept, or drives by one that was kept.
#[derive(Clone, Debug)]
pub struct Errand {
    /// What became of it.
    pub episode: Episode,
    /// The map at its end.
    pub map: CpMap,
    /// The common patterns that it is written in.
    pub patterns: CommonPatterns,
    /// Where the robot was after every step.
    pub path: Vec<Pose>,
    /// Time steps in which its body touched a wall.
    pub bumps: u32,
}

/// How far a robot has come with a map that it learns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Fragments walked, each as often as it was.
    pub walks: u32,
    /// How many of them it entered by a way that was not on its map.
    pub untried: u32,
    /// How many of those it knew again at their end.
    pub recognized: u32,
    /// Fragments on its map.
    pub fragments: u32,
    /// How long it has walked, s.
    pub seconds: f64,
}

impl Progress {
    fn see(&mut self, layer: &Layer3, walker: &Walker<SimulatedEpuck>, step: &Step) {
        self.walks = layer.explorer().mapper.traversals();
        self.fragments = layer.map().fragments().len() as u32;
        self.seconds = walker.time_us() as f64 * 1e-6;
        if step.leg.known.is_none() {
            self.untried += 1;
            let is_new = matches!(
                step.arrival,
                None | Some(Arrival::New | Arrival::Contradiction)
            );
            self.recognized += u32::from(!is_new);
        }
    }
}

/// What came of learning.
#[derive(Clone, Debug)]
pub struct Learned {
    /// The walk and the map.
    pub errand: Errand,
    /// How far it had come in the end.
    pub progress: Progress,
}

/// What came of a drive from anywhere.
#[derive(Clone, Debug)]
pub struct DriveFrom {
    /// What the robot found out; again each time that it came to another place than its map has there.
    pub found: Vec<Whereabouts>,
    /// Where it believed to be when it began its last drive.
    pub believed: Location,
    /// The drive from where it was put down on, and the map that it went by.
    pub errand: Errand,
}

/// After so many places it drives where it most likely is right.
const MOST_PLACES: u32 = 12;

/// So often it may find itself at another place than its map has there.
const SEARCHES: usize = 3;

/// After so many walks for each fragment of the maze a robot gives up. A way through all fragments takes at most two for each, there and back,
/// and robots that find it by themselves walked 1.3 times as many as the best: whoever walks four times as many no longer knows again where
/// he was.
const PATIENCE: u32 = 8;

impl Trial<'_> {
    /// After how many walks a robot that learns a map of this maze [gives up](tolman_systems::cpm::Done::OutOfPatience): eight for each
    /// fragment that there is. The robot does not know how many there are; who sends it does.
    #[must_use]
    pub fn patience(&self) -> u32 {
        PATIENCE * self.true_fragments().max(1)
    }

    /// How many fragments the maze has.
    #[must_use]
    pub fn true_fragments(&self) -> u32 {
        TrueFragments::of(&self.course.maze).count()
    }

    /// Walks from the start until the aim is reached, and optimizes the map. `watch` is told after every fragment how far it has come, and may
    /// break off.
    ///
    /// # Errors
    /// [`TrialError`]; [`TrialError::BrokenOff`] if `watch` did.
    pub fn learn(
        &self,
        aim: Aim,
        mut watch: impl FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Learned, TrialError> {
        let config = CpmConfig {
            most_traversals: self.patience(),
            ..self.mode.config()
        };
        let mut walker = self.walker_at(self.course.start()?)?;
        let mut layer = self.begin(&mut walker, config)?;
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let (begun, mut progress) = (Begun::now(&walker), Progress::default());
        let done = loop {
            match layer.advance(&mut walker, aim, &mut rng)? {
                ControlFlow::Break(done) => break done,
                ControlFlow::Continue(step) => progress.see(&layer, &walker, &step),
            }
            if watch(&progress).is_break() {
                return Err(TrialError::BrokenOff {
                    walks: progress.walks,
                });
            }
        };
        let episode = begun.ended(done, &walker);
        layer.optimize()?;
        let errand = Errand::of(&layer, &walker, episode);
        Ok(Learned { errand, progress })
    }

    /// Drives from the start to the goal by a map that was learned before.
    ///
    /// # Errors
    /// [`TrialError`], also if the map has no way to a goal, or does not begin where the robot stands.
    pub fn drive(&self, map: CpMap) -> Result<Errand, TrialError> {
        let mut walker = self.walker_at(self.course.start()?)?;
        let (patterns, config) = (self.patterns.clone(), self.mode.config());
        let layer = Layer3::resume(&mut walker, patterns, config, map)?;
        let plan = layer.explorer().mapper.plan(Landmark::Goal);
        let episode = layer.drive_plan(&mut walker, &plan.ok_or(TrialError::NoPlan)?)?;
        Ok(Errand::of(&layer, &walker, episode))
    }

    /// Put down anywhere in the maze, also amid a fragment, finds out which of some maps is that of the maze and where on it the robot is, and
    /// drives to the goal from there (section 8). Where it comes to another place than that map has, it looks again where it is, twice at most.
    ///
    /// # Errors
    /// [`TrialError`], also if the maps have no way to a goal, or are other patterns', or the robot cannot stand there.
    pub fn drive_from(&self, maps: &[CpMap], start: Pose) -> Result<DriveFrom, TrialError> {
        let mut walker = self.walker_at(start)?;
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let begun = Begun::now(&walker);
        let mut found = Vec::new();
        loop {
            let search = Search::new(maps, self.patterns, Approach::ToAndFro, MOST_PLACES)?;
            let whereabouts = search.find_out(&mut walker, &mut rng, |_| {})?;
            let believed = whereabouts.here().ok_or(TrialError::NoPlan)?;
            found.push(whereabouts);
            let map = maps.get(believed.map).ok_or(TrialError::NoPlan)?.clone();
            let has_these_ways =
                map.degree(believed.ahead.junction) as usize == walker.branches().len();
            let (patterns, config) = (self.patterns.clone(), self.mode.config());
            let layer = Layer3::resume_at(patterns, config, map, believed.ahead)?;
            let plan = layer.explorer().mapper.plan(Landmark::Goal);
            let plan = plan.ok_or(TrialError::NoPlan)?;
            let done = if has_these_ways {
                layer.drive_plan(&mut walker, &plan)?.done
            } else {
                Done::NotThere
            };
            if done == Done::Reached || found.len() == SEARCHES {
                let episode = begun.ended(done, &walker);
                let errand = Errand::of(&layer, &walker, episode);
                return Ok(DriveFrom {
                    found,
                    believed,
                    errand,
                });
            }
        }
    }
}

impl Errand {
    fn of(layer: &Layer3, walker: &Walker<SimulatedEpuck>, episode: Episode) -> Self {
        Self {
            episode,
            map: layer.map().clone(),
            patterns: layer.patterns().clone(),
            path: walker.body().path().to_vec(),
            bumps: walker.body().bumps(),
        }
    }
}

#[cfg(test)]
mod tests {
    use tolman_maps::cpm::{Matching, Similarity};
    use tolman_systems::cpm::{Done, Mode};

    use super::super::robots::epuck;
    use super::super::trial::tests::{PATTERNS, maze_1};
    use super::*;

    #[test]
    fn a_robot_that_knows_nothing_again_gives_up_and_one_that_is_told_to_breaks_off() {
        let maze = maze_1();
        // Nothing is similar to anything.
        let matching = Matching::Positions(Similarity {
            mu: 2.0,
            ..Similarity::paper()
        });
        let blind = CpmConfig {
            matching,
            ..CpmConfig::online()
        };
        let trial = Trial {
            course: &maze,
            patterns: &PATTERNS,
            robot: epuck(),
            mode: Mode::Paper(blind),
            seed: 1,
        };
        let mut walks = Vec::new();
        let learned = trial.learn(Aim::Explore, |progress| {
            walks.push(progress.walks);
            ControlFlow::Continue(())
        });
        let Learned { errand, progress } = learned.unwrap();
        assert_eq!(errand.episode.done, Done::OutOfPatience);
        assert_eq!(trial.true_fragments(), 3);
        assert_eq!((progress.walks, progress.recognized), (24, 0));
        assert_eq!(walks, (1..=24).collect::<Vec<u32>>());
        assert!(progress.fragments > 3 && progress.untried >= progress.fragments);
        let broken_off = trial.learn(Aim::Explore, |_| ControlFlow::Break(()));
        assert!(matches!(
            broken_off,
            Err(TrialError::BrokenOff { walks: 1 })
        ));
    }
}
