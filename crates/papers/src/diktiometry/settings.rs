//! Office, mapper and number of moves of every row of every table.

use alloc::sync::Arc;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use super::ablations::{ABLATIONS, Change, papers_rule};
use tolman_arena::diktiometry::{Office, OfficeConfig, SurveyConfig, SurveyorConfig, blocks};
use tolman_arena::pioneer;
use tolman_experiment::BoxError;
use tolman_maps::diktiometry::WorldKind;

/// Exploration probability in the paper: "Generally 30% of the time".
pub(super) const HEED: f64 = 0.3;

/// A table: a world and the rows that are tried in it.
#[derive(Debug)]
pub(super) struct Trial {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    pub(super) note: &'static str,
    pub(super) rows: Rows,
    pub(super) settings: Vec<Setting>,
}

/// Relation between a table's rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rows {
    /// All rows are in one world, and are compared with the first.
    OneWorld,
    /// Each row is in a world of its own.
    OwnWorlds,
}

/// A row: an office, a walk through it, and the quantity to measure.
#[derive(Debug)]
pub(super) struct Setting {
    pub(super) row: &'static str,
    pub(super) office: Arc<Office>,
    pub(super) config: SurveyConfig,
    pub(super) subject: Subject,
}

impl Setting {
    /// Returns a row that measures the map of a survey that follows scripts.
    fn scripted(row: &'static str, office: &Arc<Office>, mut config: SurveyConfig) -> Self {
        config.heed = HEED;
        Self {
            row,
            office: Arc::clone(office),
            config,
            subject: Subject::Map,
        }
    }

    /// Returns the configuration that the runs depend on.
    pub(super) fn config(&self) -> impl Serialize {
        #[derive(Serialize)]
        struct Row<'a> {
            #[serde(flatten)]
            survey: &'a SurveyConfig,
            maze: String,
            furniture: &'a OfficeConfig,
        }
        Row {
            survey: &self.config,
            maze: self.office.course.maze.to_string(),
            furniture: self.office.config(),
        }
    }
}

/// Quantity that a row measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    /// Quality of the learned map.
    Map,
    /// Error of the odometry alone on the passive walk.
    Odometry,
}

/// Returns an office. The paper shows its worlds only in figures. Ours are corridors between
/// blocks, with a share of the passages walled up.
fn office(side: u16, seed: u64, furniture: &OfficeConfig) -> Result<Arc<Office>, BoxError> {
    let maze = blocks(side, WALLED_UP, &mut ChaCha8Rng::seed_from_u64(seed));
    Ok(Arc::new(Office::new(&maze, furniture)?))
}

/// Share of the passages that are walled up.
pub(super) const WALLED_UP: f64 = 0.25;

/// Configuration of an office in which all places look alike.
pub(super) const BARE: OfficeConfig = OfficeConfig::bare();

/// Configuration of an office with doorways, and with walls of many colours.
pub(super) const FURNISHED: OfficeConfig = {
    let mut config = OfficeConfig::bare();
    config.doorway_share = 0.2;
    config.colours = 8;
    config
};

pub(super) fn all() -> Result<Vec<Trial>, BoxError> {
    let small = office(5, 1, &BARE)?;
    let large = office(7, 2, &BARE)?;
    let complicated = office(7, 3, &FURNISHED)?;
    Ok(vec![
        Trial {
            name: "3b",
            title: "A small world in which every place looks the same (figure 3b), 700 moves, one drawing",
            note: "5 × 5 cells.",
            rows: Rows::OneWorld,
            settings: compared(&small, 700),
        },
        Trial {
            name: "3c",
            title: "A larger world, random walk and exploration scripts (figure 3c), 5000 moves, one drawing",
            note: "7 × 7 cells, all places alike.",
            rows: Rows::OneWorld,
            settings: compared(&large, 5000),
        },
        Trial {
            name: "4",
            title: "A complicated world (figure 4), 3000 moves, one drawing",
            note: "7 × 7 cells with doorways and walls of eight colours.",
            rows: Rows::OneWorld,
            settings: compared(&complicated, 3000),
        },
        Trial {
            name: ABLATION,
            title: "The complicated world with a part of the mapper left out, 1000 moves with scripts",
            note: "7 × 7 cells with doorways and walls of eight colours.",
            rows: Rows::OneWorld,
            settings: ablations(&complicated),
        },
        Trial {
            name: "changing",
            title: "The complicated world while doors shut and open, 3000 moves with scripts",
            note: "After every 25 moves a doorway by chance is shut or opened. A plan works if its actions lead where it says.",
            rows: Rows::OneWorld,
            settings: changing(&complicated),
        },
        Trial {
            name: "mslst worlds",
            title: "The mazes and the robot of MSLST, 300 moves with scripts",
            note: "The robot of MSLST tells places apart by its laser, and looks are evidence.",
            rows: Rows::OwnWorlds,
            settings: vec![
                mslst("J", include_str!("../../mazes/j-long.maze"))?,
                mslst("Large", include_str!("../../mazes/large-hard.maze"))?,
            ],
        },
    ])
}

fn compared(office: &Arc<Office>, moves: u32) -> Vec<Setting> {
    let config = SurveyConfig::paper(office, moves);
    let mut meeting = config.clone();
    papers_rule(&mut meeting.mapper);
    let passive = |row, config: &SurveyConfig, subject| Setting {
        row,
        office: Arc::clone(office),
        config: config.clone(),
        subject,
    };
    vec![
        passive("passive", &config, Subject::Map),
        Setting::scripted("with scripts", office, config.clone()),
        passive("odometry", &config, Subject::Odometry),
        passive("passive (paper's rule)", &meeting, Subject::Map),
        Setting::scripted("with scripts (paper's rule)", office, meeting),
    ]
}

/// Name of the table in which parts are left out.
pub(super) const ABLATION: &str = "ablation";

fn ablations(office: &Arc<Office>) -> Vec<Setting> {
    let setting = |(row, change): (&'static str, Change)| {
        let mut config = SurveyConfig::paper(office, 1000);
        change(&mut config.mapper);
        Setting::scripted(row, office, config)
    };
    ABLATIONS.map(setting).into()
}

/// Returns a row with a maze and the robot of MSLST's paper.
fn mslst(row: &'static str, text: &str) -> Result<Setting, BoxError> {
    let file = tolman_maze::read(text)?;
    let mut furniture = OfficeConfig::bare();
    furniture.corridor_width = file.corridor_width.unwrap_or(pioneer::CORRIDOR_WIDTH);
    furniture.wall_thickness = 0.0;
    let office = Arc::new(Office::new(&file.maze, &furniture)?);
    let mut config = SurveyConfig::of(&office, SurveyorConfig::mslst(), 300);
    // Corridors of thirteen cells leave room for several places: geometry alone proves no loop.
    config.mapper.restructuring.merge_by_looks_and_turns();
    Ok(Setting::scripted(row, &office, config))
}

fn changing(office: &Arc<Office>) -> Vec<Setting> {
    let setting = |row, door_period: u32, change: Change| {
        let mut config = SurveyConfig::paper(office, 3000);
        config.door_period = door_period;
        config.mapper.world = WorldKind::Changing;
        change(&mut config.mapper);
        Setting::scripted(row, office, config)
    };
    vec![
        setting("doors stand open", 0, |_| {}),
        setting("doors move", 25, |config| config.transients.fading = 1.0),
        setting("doors move, counts fade", 25, |_| {}),
    ]
}
