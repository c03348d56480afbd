//! All searches for parameters. They are kept while the experiment runs, because each map depends
//! on those before it.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use std::sync::{Mutex, PoisonError};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::gngslam::PlaceScore;
use tolman_experiment::{BoxError, run_seed};
use tolman_maps::place_map::PlaceMap;

use super::MapRun;
use super::annealing::{Annealing, Tried};
use super::places::Places;
use super::search_space::Parameters;
use super::sets::{SOURCES, Setting, settings};

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
    started: Mutex<BTreeMap<(usize, u32), Shared>>,
}

type Shared = Arc<Mutex<Annealing<Learned>>>;

/// A learned map and its score.
#[derive(Clone, Copy, Debug)]
struct Learned {
    nodes: usize,
    /// Score; `None` for a useless map.
    score: Option<PlaceScore>,
}

impl Searches {
    pub(super) fn new(seed: u64) -> Self {
        let records = run_seed(seed, "records", 0);
        Self {
            seed,
            places: SOURCES.map(|source| Places::new(records, source)),
            started: Mutex::default(),
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
        let shared = self.shared(row, run / MAPS);
        let mut search = shared.lock().unwrap_or_else(PoisonError::into_inner);
        let tried = search.map(
            run % MAPS,
            |step| stream(seed(step), 0),
            |step, parameters| self.scored(&setting, parameters, seed(step)),
        )?;
        Ok(record(&tried))
    }

    fn shared(&self, row: usize, number: u32) -> Shared {
        let mut started = self.started.lock().unwrap_or_else(PoisonError::into_inner);
        let search = started.entry((row, number));
        Arc::clone(search.or_insert_with(|| Arc::new(Mutex::new(Annealing::new(MAPS)))))
    }

    /// Learns a map and returns it with its scores.
    fn scored(
        &self,
        setting: &Setting,
        parameters: &Parameters,
        seed: u64,
    ) -> Result<(Learned, f64), BoxError> {
        let map = self.learn(setting, parameters, seed)?;
        let places = self.places(setting);
        let scorer = places.scorer(setting.stretch)?;
        let table = places.table(setting.set.image())?;
        let score = scorer.score(&map, table, &mut stream(seed, 2))?;
        let nodes = map.network().len();
        let centre = score.map_or(0.0, |score| score.mean.by_centre);
        Ok((Learned { nodes, score }, centre))
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
        Ok(PlaceMap::learn(table, 0..places.count()?, config, rng)?)
    }
}

fn record(tried: &Tried<Learned>) -> MapRun {
    let Learned { nodes, score } = tried.map;
    MapRun {
        score: score.map(|score| score.mean.by_centre),
        border_score: score.map(|score| score.mean.by_border),
        useless: score.is_none(),
        mirrored: score.map(|score| score.mirrored),
        nodes: Some(nodes),
        parameters: tried.parameters.0.into(),
    }
}

/// Returns a stream of random numbers of a run: 0 for parameters, 1 for learning, 2 for the records
/// that are asked about.
fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(number);
    rng
}
