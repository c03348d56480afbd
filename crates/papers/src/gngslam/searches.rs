//! All searches for parameters. They are kept while the experiment runs, because each map depends
//! on those before it.

use std::sync::{Mutex, PoisonError};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_experiment::{BoxError, run_seed};
use tolman_maps::place_map::PlaceMap;

use super::MapRun;
use super::annealing::Annealing;
use super::places::Places;
use super::search_space::Parameters;
use super::sets::{SOURCES, Setting, settings};
use crate::kept::Kept;

/// Number of maps of a search: the paper's n. Runs 0 to 99 of a row are its first search, runs 100
/// to 199 its second, and so on.
pub(super) const MAPS: u32 = 100;

/// The searches of all rows.
#[derive(Debug)]
pub(super) struct Searches {
    /// Master seed of the experiment.
    seed: u64,
    /// Records by source.
    places: [Places; SOURCES.len()],
    /// Searches by row and number. A caller waits while another one works on the same search.
    started: Kept<(usize, u32), Mutex<Annealing<MapRun>>>,
}

impl Searches {
    pub(super) fn new(seed: u64) -> Self {
        let records = run_seed(seed, "records", 0);
        Self {
            seed,
            places: SOURCES.map(|source| Places::new(records, source)),
            started: Kept::default(),
        }
    }

    /// Returns the records of a row.
    pub(super) fn places(&self, setting: &Setting) -> &Places {
        &self.places[setting.source]
    }

    /// Returns the settings of the records of all rows.
    pub(super) fn configs(&self) -> Result<Vec<super::places::Config>, BoxError> {
        self.places.iter().map(Places::config).collect()
    }

    /// Plays a run of a row, after those before it in its search.
    pub(super) fn map(&self, row: usize, run: u32) -> Result<MapRun, BoxError> {
        let setting = settings()[row];
        let first = run - run % MAPS;
        let seed = |step: u32| run_seed(self.seed, setting.table, first + step);
        let kept = self.started.get((row, run / MAPS), || {
            Ok::<_, BoxError>(Mutex::new(Annealing::new(MAPS)))
        })?;
        let mut search = kept.lock().unwrap_or_else(PoisonError::into_inner);
        let tried = search.map(
            run % MAPS,
            |step| stream(seed(step), 0),
            |step, parameters| self.scored(&setting, parameters, seed(step)),
        )?;
        Ok(tried.map)
    }

    /// Learns a map and returns it with its scores.
    fn scored(
        &self,
        setting: &Setting,
        parameters: &Parameters,
        seed: u64,
    ) -> Result<(MapRun, f64), BoxError> {
        let map = self.learn(setting, parameters, seed)?;
        let places = self.places(setting);
        let scorer = places.scorer(setting.stretch)?;
        let table = places.table(setting.set.image())?;
        let score = scorer.score(&map, &table, &mut stream(seed, 2))?;
        let run = MapRun {
            score: score.map(|score| score.mean.by_centre),
            border_score: score.map(|score| score.mean.by_border),
            useless: score.is_none(),
            mirrored: score.map(|score| score.mirrored),
            nodes: Some(map.network().len()),
            parameters: parameters.0.into(),
        };
        let centre = run.score.unwrap_or(0.0);
        Ok((run, centre))
    }

    /// Learns the map of a run.
    pub(super) fn learn(
        &self,
        setting: &Setting,
        parameters: &Parameters,
        seed: u64,
    ) -> Result<PlaceMap, BoxError> {
        let places = self.places(setting);
        let table = places.table(setting.set.image())?;
        let config = parameters.config(setting.set.with_sonar);
        let rng = &mut stream(seed, 1);
        Ok(PlaceMap::learn(&table, 0..places.count()?, config, rng)?)
    }
}

/// Returns a stream of random numbers of a run: 0 for parameters, 1 for learning, 2 for the records
/// that are asked about.
fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(number);
    rng
}
