//! The arena, a file's check and the tables ask one judge.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::contest::{Condition, Contest, Moment, TrueGraph};
use tolman_arena::course::Terrain;
use tolman_arena::family::Family;
use tolman_arena::registry::{MapText, Registry, Schooling};
use tolman_maze::MazeFile;

/// Number of worlds in which each system learns a map, and number of all maps at the least.
const WORLDS: u64 = 7;
const MAPS: usize = 60;

#[test]
fn a_map_in_a_file_is_right_exactly_if_the_arena_called_it_right() {
    let schooling = Schooling::default();
    let registry = Registry::current();
    let (mut maps, mut right) = (0, 0);
    for system in registry.learners() {
        for (seed, name) in (1..=WORLDS).zip([
            "perfect", "braided", "office", "star", "eight", "comb", "pillars",
        ]) {
            let family = Family::named(&registry.families, name).unwrap();
            let maze =
                (family.draw)(family.sizes[0], &mut ChaCha8Rng::seed_from_u64(seed)).unwrap();
            let contest = Contest {
                contestant: system,
                robot: None,
                maze: &maze,
                name,
                condition: Condition::AsMade,
                starts: 0,
                seed,
                stopwatch: None,
            };
            let mut file = None;
            let record = contest.play(&schooling, |outing, moment| {
                if moment == Moment::Over {
                    file = outing.map_file().unwrap();
                }
            });
            let Some(learned) = record.unwrap().learned else {
                continue;
            };
            let what = format!("{} in {name}", system.name());
            let Some(file) = file else {
                assert!(!learned.judgement.is_right, "{what} keeps no map");
                continue;
            };
            let text = MapText::with_truth(&file, &learned.evidence).unwrap();
            let text = MapText::read(what.clone(), text).unwrap();
            assert_eq!(text.system, system.name(), "{what}");
            let terrain = Terrain::Maze(MazeFile::from(maze.clone()));
            let complaint = text.complaint(system, &terrain).unwrap();
            assert_eq!(
                complaint.is_none(),
                learned.judgement.is_right,
                "{what}: {complaint:?} {:?}",
                learned.judgement
            );
            let view = system.map(&text).unwrap().view().unwrap();
            let truth = TrueGraph::of(&maze, system.facts().places);
            let again = text.truth.unwrap().judge(&view, &truth);
            assert_eq!(again, learned.judgement, "{what}");
            maps += 1;
            right += usize::from(learned.judgement.is_right);
        }
    }
    assert!(maps >= MAPS, "{maps} maps");
    assert!(right > MAPS / 4 && right < maps, "{right} of {maps}");
}
