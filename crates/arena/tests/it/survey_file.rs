//! Files of surveys.

use alloc::sync::Arc;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::diktiometry::{
    Office, OfficeConfig, PlaceCue, SurveyFile, Surveyed, SurveyorConfig, blocks, mapper,
};
use tolman_maps::diktiometry::JournalLength;
use tolman_robot::Task;
use tolman_systems::diktiometry::Diktiometer;
use tolman_systems::diktiometry::ExploreUntil;

use tolman_arena::Outing;
use tolman_arena::run::{TaskEnd, until_done};

fn survey(moves: u32) -> SurveyFile {
    let maze = blocks(4, 0.3, &mut ChaCha8Rng::seed_from_u64(1));
    let mut furniture = OfficeConfig::bare();
    furniture.doorway_share = 0.3;
    furniture.colours = 4;
    let office = Arc::new(Office::new(&maze, &furniture).unwrap());
    let robot = SurveyorConfig::paper();
    let mut mapper = mapper(&office, &robot);
    mapper.journal = JournalLength::All;
    let mut config = office.diktiometer(&robot, mapper);
    config.until = ExploreUntil::Moves(moves);
    let system = Diktiometer::new(config, robot.sight, 3);
    learned(
        Surveyed::begin("blocks", office, robot, 0.0, 3).unwrap(),
        system,
    )
}

fn learned(surveyed: Surveyed, system: Diktiometer<PlaceCue>) -> SurveyFile {
    let mut outing = surveyed.sent(system, u32::MAX, 3).unwrap();
    let ended = until_done(&mut outing, |outing| outing.act(Task::Explore)).unwrap();
    assert_eq!(ended.end, TaskEnd::Done);
    SurveyFile::from_json(&outing.map_file().unwrap().unwrap()).unwrap()
}

#[test]
fn a_survey_comes_back_and_goes_on() {
    let written = survey(30);
    let text = written.to_json().unwrap();
    let read = SurveyFile::from_json(&text).unwrap();
    assert_eq!(read.observer, written.observer);
    assert_eq!(read.surveyed.visits, written.surveyed.visits);
    assert_eq!(read.surveyed.origin.robot, "camera Pioneer");
    assert_eq!(read.system(), "diktiometry");
    assert_eq!(read.to_json().unwrap(), text);
    let SurveyFile { surveyed, observer } = read;
    let robot = &surveyed.robot;
    let mut config = surveyed
        .office
        .diktiometer(robot, observer.config().clone());
    config.until = ExploreUntil::Moves(20);
    let system = Diktiometer::with_map(config, robot.sight, observer, 5);
    let on = learned(surveyed, system);
    assert_eq!(on.observer.moves(), 50);
    assert_eq!(on.surveyed.visits.len(), 51);
    let score = on.score();
    assert!((score.purity - 1.0).abs() < 1e-12, "{score:?}");
}

#[test]
fn what_is_no_survey_is_refused_with_a_reason() {
    let text = survey(5).to_json().unwrap();
    let check = |changed: String, expect: &str| {
        let error = SurveyFile::from_json(&changed).unwrap_err();
        let told = format!("{error:?}");
        assert!(told.contains(expect), "{told} for {expect}");
    };
    check(text[..text.len() / 2].to_owned(), "CutOff");
    check(text.replacen("diktiometry", "mslst", 1), "System");
    check(text.replacen("\"heed\":", "\"heel\":", 1), "Body");
    check(
        text.replacen("\"moves\":5,", "\"moves\":6,", 1),
        "Truncated",
    );
    check(text.replacen("o---o", "o~~~o", 1), "its maze is invalid");
    for colours in ["0", "4294967295"] {
        let colours = format!("\"colours\":{colours}");
        check(
            text.replacen("\"colours\":4", &colours, 1),
            "no world can be built from its maze",
        );
    }
}
