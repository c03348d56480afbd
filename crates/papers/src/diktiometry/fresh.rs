//! Runs that are each in a new world of their kind. Claims about maps in general need this.

use alloc::sync::Arc;

use rand_chacha::ChaCha8Rng;
use serde::Serialize;
use tolman_arena::contest::MapJudgement;
use tolman_arena::diktiometry::{
    Office, OfficeConfig, PlaceCue, Survey, SurveyConfig, SurveyorConfig, TruePlace, blocks,
};
use tolman_experiment::{BoxError, Fields, Metric, Options, Record, Row, Table, record, require};
use tolman_maps::diktiometry::{
    CertifiedMerges, Config, Identity, JournalLength, MapState, MergeProof, certify_merges,
    verify_merges,
};
use tolman_maze::drawings::{eight, ladder_of, office, ring, spiral};
use tolman_maze::{GenerateError, Maze};
use tolman_systems::stream;

use super::ablations::{Change, papers_rule};
use super::objection::{Listener, Statement};
use super::settings::{BARE, FURNISHED, HEED, WALLED_UP};
use super::share;
use super::standstill::Standstill;
use crate::metrics::UsualMetrics as _;

/// Name of the table.
pub(super) const FRESH: &str = "fresh worlds";

/// Default number of worlds of a row.
pub(super) const WORLDS: u32 = 100;

/// Default number of the largest worlds.
const LARGE_WORLDS: u32 = 20;

/// Number of worlds of a row for a first look.
pub(super) const QUICK: u32 = 2;

/// Stream of a run's seed from which its world is drawn. The walk uses other streams.
pub(super) const WORLD_STREAM: u64 = 20;

/// Walls of eight colours, without doorways.
pub(super) const PAINTED: OfficeConfig = {
    let mut config = BARE;
    config.colours = 8;
    config
};

/// Generator of a row's worlds.
pub(super) type Draw = fn(&mut ChaCha8Rng) -> Result<Maze, GenerateError>;

/// A row: a kind of world, a robot and a mapper.
#[derive(Clone, Copy, Debug)]
pub(super) struct FreshRow {
    pub(super) row: &'static str,
    pub(super) draw: Draw,
    pub(super) furniture: OfficeConfig,
    pub(super) moves: u32,
    /// Exploration probability, 0 … 1.
    pub(super) heed: f64,
    pub(super) worlds: u32,
    /// Changes the errors of the robot.
    pub(super) robot: fn(&mut SurveyorConfig),
    /// Changes the mapper.
    pub(super) change: Change,
}

impl FreshRow {
    /// Returns the row of a passive walk by the robot of the paper's figures, with our mapper.
    const fn new(row: &'static str, draw: Draw, moves: u32) -> Self {
        Self {
            row,
            draw,
            furniture: BARE,
            moves,
            heed: 0.0,
            worlds: WORLDS,
            robot: |_| {},
            change: |_| {},
        }
    }

    pub(super) const fn heed(self, heed: f64) -> Self {
        Self { heed, ..self }
    }

    pub(super) const fn furnished(self, furniture: OfficeConfig) -> Self {
        Self { furniture, ..self }
    }

    /// Returns the row with looks and turns as evidence.
    pub(super) const fn by_looks(self) -> Self {
        Self {
            change: |config| config.restructuring.merge_by_looks_and_turns(),
            ..self
        }
    }

    /// Returns the row with views that only show which ways lead on. They count as evidence.
    const fn by_exits(self) -> Self {
        Self {
            robot: |robot| robot.sight = PlaceCue::Exits,
            ..self.by_looks()
        }
    }

    pub(super) const fn papers_rule(self, row: &'static str) -> Self {
        Self {
            row,
            change: papers_rule,
            ..self
        }
    }
}

pub(super) const fn five() -> FreshRow {
    FreshRow::new("5x5 passive", |rng| Ok(blocks(5, WALLED_UP, rng)), 700)
}

const fn seven() -> FreshRow {
    FreshRow::new("7x7 passive", |rng| Ok(blocks(7, WALLED_UP, rng)), 3000)
}

pub(super) const fn painted(row: &'static str, draw: Draw) -> FreshRow {
    FreshRow::new(row, draw, 1000)
        .heed(HEED)
        .furnished(PAINTED)
        .by_looks()
}

/// Returns a row of walls of one colour, where the robot always begins scripts.
const fn alike(row: &'static str, draw: Draw) -> FreshRow {
    FreshRow::new(row, draw, 1000).heed(1.0).by_exits()
}

const fn twenty(row: &'static str, moves: u32) -> FreshRow {
    FreshRow {
        worlds: LARGE_WORLDS,
        ..FreshRow::new(row, |rng| Ok(blocks(20, WALLED_UP, rng)), moves)
            .heed(1.0)
            .by_exits()
    }
}

/// Tells a mapper that places are farther apart than they are by `factor`.
fn tell_separation(config: &mut Config, factor: f64) {
    config.separation *= factor;
    config.alike_separation *= factor;
}

/// Returns all rows.
pub(super) fn rows() -> Vec<FreshRow> {
    let five_scripted = FreshRow {
        row: "5x5 with scripts",
        ..five().heed(HEED)
    };
    let seven_scripted = FreshRow {
        row: "7x7 with scripts",
        ..seven().heed(HEED)
    };
    let complicated = FreshRow {
        row: "7x7 doorways with scripts",
        ..seven_scripted.furnished(FURNISHED)
    };
    vec![
        five(),
        five().papers_rule("5x5 passive (paper's rule)"),
        five_scripted,
        five_scripted.papers_rule("5x5 with scripts (paper's rule)"),
        FreshRow {
            row: "5x5 constant error",
            robot: |robot| robot.hold_steps = u32::MAX,
            ..five_scripted
        },
        FreshRow {
            row: "5x5 constant error, split told",
            robot: |robot| {
                robot.hold_steps = u32::MAX;
                (robot.odometry_share, robot.shared_share) = (0.02, 0.1);
            },
            ..five_scripted
        },
        FreshRow {
            row: "5x5 separation told × 0.5",
            change: |config| tell_separation(config, 0.5),
            ..five_scripted
        },
        FreshRow {
            row: "5x5 separation told × 2",
            change: |config| tell_separation(config, 2.0),
            ..five_scripted
        },
        seven(),
        seven().papers_rule("7x7 passive (paper's rule)"),
        seven_scripted,
        seven_scripted.papers_rule("7x7 with scripts (paper's rule)"),
        complicated,
        complicated.papers_rule("7x7 doorways with scripts (paper's rule)"),
        twenty("20x20 with scripts", 6000),
        twenty("20x20 with scripts, 3000 moves", 3000),
        FreshRow {
            row: "outliers 1 %",
            moves: 5000,
            draw: |rng| Ok(blocks(10, WALLED_UP, rng)),
            robot: |robot| robot.outliers = 0.01,
            ..seven_scripted
        },
        painted("ladder 7", |rng| ladder_of(7, rng)),
        painted("ladder 11", |rng| ladder_of(11, rng)),
        painted("ladder 15", |rng| ladder_of(15, rng)),
        painted("eight", |rng| eight((8, 8), rng)),
        painted("spiral", |rng| spiral((8, 8), rng)),
        painted("ring", |rng| ring((8, 8), rng)),
        alike("office floor", |rng| office((8, 6), rng)),
        alike("ladder 7, one colour", |rng| ladder_of(7, rng)),
        alike("eight, one colour", |rng| eight((8, 8), rng)),
        alike("spiral, one colour", |rng| spiral((8, 8), rng)),
        alike("ring, one colour", |rng| ring((8, 8), rng)),
    ]
}

record! {
    /// A walk through a world drawn for the run, and the map at its end.
    #[check(FreshRun::relations)]
    struct FreshRun {
        /// Whether the map matches the seen places and ways of the world one to one, and has at
        /// least 95 % of all.
        right: bool => higher("map right"),
        /// Whether the map matches the seen places and ways one to one, however many those are.
        right_of_visited: bool => higher("right as far as visited"),
        /// Share of the visits that were to the true place that their place on the map stands for.
        purity: f64 => higher("purity").share().decimals(4),
        /// Number of places on the map per visited true place.
        places_over_true: f64 => lower("places / true places").at_least(0),
        /// Whether no place is confused with another, and at least 95 % of the visited places are
        /// on the map once.
        places_once: bool => higher("places once"),
        /// Share of the true places that were visited.
        seen: f64 => higher("true places visited").share().decimals(3),
        /// Most moves in a row without a new way, while there was one that was never driven.
        standstill: u32 => lower("moves without a new way"),
        /// Share of the true ways of the whole world that are on the map.
        link_recall: f64 => higher("link recall").share().decimals(3),
        /// Share of the map's links that lead where their action truly leads.
        link_precision: f64 => higher("link precision").share().decimals(4),
        /// Number of merges proven by bounds or by turns, each checked against the journal.
        geometric_certificates: Option<usize> => neither("geometric proofs"),
        /// Number of these that join two true places.
        false_geometric: Option<usize> => lower("false geometric proofs"),
        /// Number of merges proven by bounds or by turns through places that are one by looks.
        bounds_after_looks: Option<usize> => neither("geometric proofs after looks"),
        /// Number of these that join two true places.
        false_after_looks: Option<usize> => lower("false geometric proofs after looks"),
        /// Number of merges by looks, each with its probability, checked against the journal.
        look_certificates: Option<usize> => neither("proofs by looks"),
        /// Number of these that join two true places.
        false_looks: Option<usize> => lower("false proofs by looks"),
        /// Sum of the probabilities of error that those merges state.
        stated_chances: Option<f64> => neither("false proofs, as stated").decimals(4),
        /// Number of merges with neither kind of proof.
        unproven: Option<usize> => lower("merges without proof"),
        /// Whether the mapper says at the end that its map is not folded.
        said_unfolded: Option<bool> => neither("said to be not folded"),
        /// Whether the mapper says at the end that its map contradicts itself.
        said_contradictory: Option<bool> => neither("said to contradict itself"),
        /// Whether the mapper objects to a map at the end, if and only if it does not match what
        /// was visited.
        verdict_right: Option<bool> => higher("own verdict right"),
        /// Whether the mapper objects to a wrong map at the end, and did so within 200 moves after
        /// the map became wrong for good. Wrong maps only.
        objected_soon: Option<bool> => higher("wrong map objected to soon"),
        /// Number of moves from when a map became wrong for good until the mapper objected to it.
        objection_delay: Option<u32> => lower("moves until objection"),
    }
}

/// Name of the row of all runs.
const ALL_RUNS: &str = "all runs";

impl FreshRun {
    fn relations(&self) -> Result<(), String> {
        let told = "a map is right only of what was visited, and if it is whole";
        let right = self.right_of_visited && is_whole(self.seen, self.link_recall);
        require(self.right == right, told)?;
        let told = "an objection is late or soon only where a map is wrong";
        require(
            !(self.right_of_visited && self.objected_soon.is_some()),
            told,
        )
    }
}

/// Returns whether these shares of the places and ways of a world are enough for a right map.
fn is_whole(places: f64, ways: f64) -> bool {
    places.min(ways) >= MapJudgement::ENOUGH
}

/// Returns the table of the fresh worlds.
pub(super) fn table(rows: &[FreshRow], options: &Options) -> Table {
    let runs = |row: &FreshRow| options.runs_else(row.worlds, QUICK);
    Table::of::<FreshRun>(FRESH, "Fresh worlds: each run another drawing")
        .metrics([
            FreshRun::right,
            FreshRun::right_of_visited,
            FreshRun::purity,
            FreshRun::places_over_true,
            FreshRun::places_once,
            FreshRun::seen,
        ])
        .metric(Metric::greatest("longest_standstill", FreshRun::standstill))
        .metrics([FreshRun::link_recall, FreshRun::link_precision])
        .metric(Metric::total(FreshRun::geometric_certificates))
        .metric(Metric::total(FreshRun::false_geometric))
        .metric(Metric::total(FreshRun::bounds_after_looks))
        .metric(Metric::total(FreshRun::false_after_looks))
        .metric(Metric::total(FreshRun::look_certificates))
        .metric(Metric::total(FreshRun::false_looks))
        .metric(Metric::total(FreshRun::stated_chances))
        .metric(Metric::total(FreshRun::unproven))
        .metrics([
            FreshRun::said_unfolded,
            FreshRun::said_contradictory,
            FreshRun::verdict_right,
            FreshRun::objected_soon,
        ])
        .metric(Metric::greatest("slowest_objection", FreshRun::objection_delay))
        .rows(rows.iter().map(|row| Row::new(row.row).runs(runs(row))))
        .row(Row::of_all(ALL_RUNS))
        .note(
            "Each run draws its own world from its seed, the same for all rows of a kind. 5x5, 7x7 \
             and 20x20 are blocks with a quarter of the ways walled up and all places alike, with \
             700, 3000 and 6000 moves. Doorways: a fifth of the passages, and walls of eight \
             colours. Ladders (the number is the length of their corridors), eights, spirals and \
             rings have walls of eight colours, the office floor has one colour; 1000 moves with \
             scripts. Scripts are begun with a probability of 30 %, in 20x20 and in the office floor \
             always. Constant error: odometry and compass have the same error all along. \
             Separation told: the mapper is told that places are half or twice as far apart as they \
             are. Every ten moves the mapper is asked whether its map is folded and free of \
             contradictions; soon is within 200 moves. Paper's rule: a place is recognized if boxes meet, and places merge by their estims. The row of \
             all runs includes those by the paper's rule.",
        )
}

impl FreshRow {
    /// Returns the configuration of the runs, without the mapper's knowledge of each drawing.
    pub(super) fn config(&self) -> impl Serialize {
        #[derive(Serialize)]
        struct Settings {
            moves: u32,
            heed: f64,
            furniture: OfficeConfig,
            robot: SurveyorConfig,
        }
        Settings {
            moves: self.moves,
            heed: self.heed,
            furniture: self.furniture,
            robot: self.surveyor(),
        }
    }

    fn surveyor(&self) -> SurveyorConfig {
        let mut robot = SurveyorConfig::paper();
        (self.robot)(&mut robot);
        robot
    }

    /// Returns a run's world, and how it is surveyed.
    pub(super) fn draw(&self, seed: u64) -> Result<(Arc<Office>, SurveyConfig), BoxError> {
        let mut rng = stream(seed, WORLD_STREAM);
        let maze = (self.draw)(&mut rng)?;
        let mut furniture = self.furniture;
        furniture.seed = seed;
        let office = Arc::new(Office::new(&maze, &furniture)?);
        let mut config = SurveyConfig::of(&office, self.surveyor(), self.moves);
        config.heed = self.heed;
        (self.change)(&mut config.mapper);
        Ok((office, config))
    }

    /// Surveys a new world and returns the record.
    pub(super) fn run(&self, seed: u64) -> Result<Fields, BoxError> {
        let (office, mut config) = self.draw(seed)?;
        config.mapper.journal = JournalLength::All;
        let is_by_the_paper = config.mapper.matching.identity == Identity::Meets;
        let mut listener = Listener::default();
        let mut standstill = Standstill::default();
        let ways: usize = office.places(&[]).values().map(TruePlace::way_count).sum();
        let survey = Survey::run(&office, config, seed, |survey, moved| {
            standstill.note(survey, moved.direction, ways);
            if !is_by_the_paper {
                listener.listen(survey);
            }
            Ok(())
        })?;
        let score = survey.score();
        let places = office.places(&[]).len();
        let seen = share(score.visited, places).unwrap_or(1.0);
        let run = FreshRun {
            right: score.is_isomorphic && is_whole(seen, score.link_recall),
            right_of_visited: score.is_isomorphic,
            purity: score.purity,
            places_over_true: score.places as f64 / score.visited as f64,
            places_once: score.purity >= 1.0 && score.share_once >= MapJudgement::ENOUGH,
            seen,
            standstill: standstill.longest(),
            link_recall: score.link_recall,
            link_precision: score.link_precision,
            ..FreshRun::default()
        };
        // The paper's rule gives no proofs, and does not check its map.
        if is_by_the_paper {
            return Ok(run.fields()?);
        }
        let statement = listener.statement(&survey);
        Ok(run.certified(&survey)?.stated(statement).fields()?)
    }
}

impl FreshRun {
    /// Returns the record with what the mapper said of its map.
    fn stated(self, statement: Statement) -> Self {
        let is_wrong = !self.right_of_visited;
        Self {
            said_unfolded: Some(statement.says_unfolded()),
            said_contradictory: Some(statement.state == MapState::Contradictory),
            verdict_right: Some(statement.objects() == is_wrong),
            objected_soon: is_wrong.then(|| statement.objected_soon()),
            objection_delay: statement.delay.filter(|_| is_wrong),
            ..self
        }
    }

    /// Returns the record with the numbers of proofs for the map's merges, and of false ones, after
    /// checking them.
    fn certified(self, survey: &Survey) -> Result<Self, BoxError> {
        let observer = survey.observer().ok_or("no map is kept")?;
        let config = observer.config();
        let journal = observer.journal().ok_or("no journal is kept")?;
        let CertifiedMerges {
            certificates,
            unproven,
        } = certify_merges(config, journal)?;
        verify_merges(config, journal, &certificates)?;
        let site = |visit: usize| survey.sites()[visit];
        // All proofs of a kind, and the false ones.
        let (mut geometric, mut after_looks, mut by_looks) = ([0, 0], [0, 0], [0, 0]);
        let mut stated_chances = 0.0;
        for certificate in &certificates {
            let [one, other] = certificate.visits.map(site);
            let [all, wrong] = match &certificate.proof {
                MergeProof::Looks(evidence) => {
                    stated_chances += evidence.chance;
                    &mut by_looks
                }
                _ if certificate.rests_on_looks => &mut after_looks,
                MergeProof::Bounds(_) | MergeProof::Winding(_) => &mut geometric,
            };
            *all += 1;
            *wrong += usize::from(one != other);
        }
        Ok(Self {
            geometric_certificates: Some(geometric[0]),
            false_geometric: Some(geometric[1]),
            bounds_after_looks: Some(after_looks[0]),
            false_after_looks: Some(after_looks[1]),
            look_certificates: Some(by_looks[0]),
            false_looks: Some(by_looks[1]),
            stated_chances: Some(stated_chances),
            unproven: Some(unproven.len()),
            ..self
        })
    }
}
