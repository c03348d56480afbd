//! The worked examples of the figures.

use core::ops::ControlFlow;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Point;
use tolman_maps::cpm::{
    Dictionary, End, FragmentId, MapUpdate, Mapping, PatternId, Sighting, Sign, Traversal, Turn,
};
use tolman_robot::Landmark;
use tolman_systems::cpm::{Aim, CpmConfig, Done, Explorer, Onward};

use super::explorations::pursue;
use super::world::{
    MapCheck, PlaneMaze, PlaneWalker, Reckoning, WalkOutcome, WalkerNoise, WorldBuilder,
};

/// Patterns far from each other; each seen the other way is the next or the one before.
pub(crate) fn dictionary() -> Dictionary {
    let mut dictionary = Dictionary::new(40);
    for pair in 0..20 {
        let mut features = [[0.0; 40]; 2];
        features[0][2 * pair] = 1.0;
        features[1][2 * pair + 1] = 1.0;
        let [one, other] = features;
        dictionary.learn(&one, &other, 0.0).unwrap();
    }
    dictionary
}

/// Returns the patterns of a fragment, which no other has: A is 0 2 4 6, B is 8 10 12 14, and so
/// on.
fn fragment(name: u32, length: u32) -> Vec<PatternId> {
    (0..length)
        .map(|place| PatternId((8 * name + 2 * (place % 4)) % 40))
        .collect()
}

fn walk(patterns: &[PatternId], degree: u32) -> Traversal {
    Traversal {
        patterns: patterns.to_vec(),
        motion: None,
        sighting: Sighting::plain(degree),
        bearings: None,
    }
}

fn end(fragment: u32, sign: Sign) -> End {
    End {
        fragment: FragmentId(fragment),
        sign,
    }
}

/// A dead end in the west, from which a corridor leads to a fork.
#[test]
fn a_walker_observes_what_it_walks_along() {
    let (wall, door) = (PatternId(0), PatternId(4));
    let mut drawing = WorldBuilder::new(dictionary());
    let west = drawing.place(Point::new(0.0, 0.0), Some(Landmark::Start));
    let fork = drawing.place(Point::new(1.0, 0.0), None);
    let north = drawing.place(Point::new(1.0, 1.0), None);
    let goal = drawing.place(Point::new(1.0, -1.0), Some(Landmark::Goal));
    for (from, to, patterns) in [
        (west, fork, &[wall, wall, door][..]),
        (fork, north, &[wall, door]),
        (fork, goal, &[door]),
    ] {
        drawing.corridor(from, to, &[], patterns).unwrap();
    }
    let world = drawing.finish(west).unwrap();
    let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let arrived = rover.go(Turn::BACK, None, &mut rng).unwrap();
    let expected = walk(&[wall, wall, door], 3);
    assert_eq!(arrived, WalkOutcome::Arrived(expected));
    // Counter-clockwise from the way it came, the first port is the right hand one.
    rover.go(Turn(1), None, &mut rng).unwrap();
    assert_eq!(rover.sighting().landmark, Some(Landmark::Goal));
}

/// Figure 1: A → B → C → D → A closes a loop round a junction of four ports. B lies between two of
/// them, C goes round the corner, and D comes from a third. The drawing gives Δ_AB, Δ_BC, Δ_CD,
/// Δ_DA; reasoning gives the rest.
#[test]
fn figure_1() {
    use Sign::{Minus, Plus};
    let dictionary = dictionary();
    let [a, b, c, d] =
        [(0, 5), (1, 10), (2, 4), (3, 3)].map(|(name, length)| fragment(name, length));
    // A ends at a fork with B and D; C lies between the far ends of B and D, in a fork each.
    let mut config = CpmConfig::online();
    config.mapping = Mapping::Offline { patience: u32::MAX };
    let start = Sighting {
        degree: 1,
        landmark: Some(Landmark::Start),
    };
    let mut explorer = Explorer::new(config, start).unwrap();
    explorer
        .mapper
        .arrive(Turn::BACK, &walk(&a, 3), &dictionary)
        .unwrap();
    explorer
        .mapper
        .arrive(Turn(1), &walk(&b, 3), &dictionary)
        .unwrap();
    explorer
        .mapper
        .arrive(Turn(2), &walk(&c, 3), &dictionary)
        .unwrap();
    explorer
        .mapper
        .arrive(Turn(2), &walk(&d, 3), &dictionary)
        .unwrap();
    // Back in A, from its far end.
    let mut back = walk(&dictionary.inverse(&a).unwrap(), 1);
    back.sighting = start;
    explorer.arrive(Turn(1), &back, &dictionary).unwrap();
    assert_eq!(explorer.mapper.map().fragments().len(), 5);
    assert_eq!(explorer.mapper.optimize(&dictionary), Ok(1));
    let map = explorer.mapper.map();
    assert_eq!(map.fragments().len(), 4);
    let [a, b, c, d] = [0, 1, 2, 3];
    let turn = |from, to| map.transition(from, to).map(|turn| turn.0);
    // Δ_AB, Δ_BC, Δ_CD, Δ_DA: walked.
    assert_eq!(turn(end(a, Plus), end(b, Minus)), Some(1));
    assert_eq!(turn(end(b, Plus), end(c, Minus)), Some(2));
    assert_eq!(turn(end(c, Plus), end(d, Minus)), Some(2));
    assert_eq!(turn(end(d, Plus), end(a, Plus)), Some(1));
    // Δ_BA, Δ_CB, Δ_DC, Δ_AD: inverted.
    assert_eq!(turn(end(b, Minus), end(a, Plus)), Some(2));
    assert_eq!(turn(end(c, Minus), end(b, Plus)), Some(1));
    assert_eq!(turn(end(d, Minus), end(c, Plus)), Some(1));
    assert_eq!(turn(end(a, Plus), end(d, Plus)), Some(2));
    // Δ_DB, Δ_BD: composed, (1 + 1) mod 3 and its inverse.
    assert_eq!(turn(end(d, Plus), end(b, Minus)), Some(2));
    assert_eq!(turn(end(b, Minus), end(d, Plus)), Some(1));
    // Not at one junction.
    assert_eq!(turn(end(a, Plus), end(c, Minus)), None);
    // "C → D → A" is shorter than "C → B → A".
    let from_c = map.fragment(FragmentId(c)).unwrap().plus;
    let plan = map
        .plan(from_c, |id| map.junction(id).unwrap().landmark.is_some())
        .unwrap();
    let enters: Vec<End> = plan.legs.iter().map(|leg| leg.enter).collect();
    assert_eq!(enters, [end(d, Minus), end(a, Plus)]);
    let observations: Vec<u32> = plan.legs.iter().map(|leg| leg.observations).collect();
    assert_eq!((observations, plan.length), (vec![3, 5], 8));
    assert!(!explorer.mapper.map().is_complete());
}

/// Returns the environment of figure 10, as far as its walk and its text tell. A1 leads from P to
/// Q, A2 from Q to R, A3 from R to S, A4 from S back to Q. X2 leads from R to the goal, and X3 from
/// S to a junction T, from which X4 and X5 lead to P.
fn figure_10_world() -> PlaneMaze {
    let mut drawing = WorldBuilder::new(dictionary());
    let place = |x: f64, y: f64| Point::new(x, y);
    let p = drawing.place(place(0.0, 0.0), Some(Landmark::Start));
    let q = drawing.place(place(1.0, 0.0), None);
    let r = drawing.place(place(2.0, 1.0), None);
    let s = drawing.place(place(2.0, -1.0), None);
    let t = drawing.place(place(1.0, -2.0), None);
    let goal = drawing.place(place(3.0, 2.0), Some(Landmark::Goal));
    let looks = |name: u32| -> Vec<PatternId> {
        (0..4 + name)
            .map(|place| PatternId((5 * name + 2 * place * (1 + name % 3)) % 40))
            .collect()
    };
    let mut corridor =
        |from, to, via: &[Point], name| drawing.corridor(from, to, via, &looks(name)).unwrap();
    corridor(p, q, &[], 1);
    corridor(q, r, &[], 2);
    corridor(r, s, &[], 3);
    corridor(s, q, &[], 4);
    corridor(r, goal, &[], 5);
    corridor(s, t, &[], 6);
    corridor(t, p, &[place(0.5, -1.0)], 7);
    corridor(t, p, &[place(-1.0, -2.0)], 8);
    drawing.finish(p).unwrap()
}

/// Returns the turn that takes a rover into a corridor.
fn turn_into(world: &PlaneMaze, rover: &PlaneWalker<'_>, corridor: u32) -> Turn {
    let at = rover.at();
    let ports = &world.places()[at.place as usize].ports;
    let exit = ports
        .iter()
        .position(|end| end.corridor == corridor)
        .unwrap() as u32;
    Turn::between(at.number, exit, ports.len() as u32).unwrap()
}

/// Walks some corridors and tells what was made of the last.
fn follow(
    explorer: &mut Explorer,
    rover: &mut PlaneWalker<'_>,
    world: &PlaneMaze,
    corridors: &[u32],
) -> MapUpdate {
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let arrivals = corridors.iter().map(|corridor| {
        let turn = turn_into(world, rover, *corridor);
        let WalkOutcome::Arrived(walk) = rover.go(turn, None, &mut rng).unwrap() else {
            unreachable!("it was not told to give up");
        };
        explorer
            .mapper
            .arrive(turn, &walk, world.dictionary())
            .unwrap()
    });
    arrivals.last().unwrap()
}

/// Corridors are numbered from 0: A1, A2, A3, A4, X2, X3 = A5, X4, X5.
const X2: u32 = 4;
const X3: u32 = 5;
const X4: u32 = 6;

#[test]
fn figure_10() {
    let world = figure_10_world();
    let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
    let mut explorer = Explorer::new(CpmConfig::online(), rover.sighting()).unwrap();
    // A1 to A4 are new; that A4 leads to junc(A1⁺) is not known yet.
    assert_eq!(
        follow(&mut explorer, &mut rover, &world, &[0, 1, 2, 3]),
        MapUpdate::New
    );
    // (a) Duplication detected.
    assert_eq!(
        follow(&mut explorer, &mut rover, &world, &[1]),
        MapUpdate::Duplicate
    );
    assert_eq!(explorer.mapper.before_duplicate(), Some(4));
    // (b) "Connects path-fragment A4 to junc(A1⁺) = junc(A2⁻) and localizes itself at the
    // path-fragment A2 where it is going to make a decision at junc(A2⁺)."
    let [a1, a2, a3, a4] =
        [0, 1, 2, 3].map(|id| explorer.mapper.map().fragment(FragmentId(id)).unwrap());
    assert_eq!(a4.plus.junction, a1.plus.junction);
    assert_eq!(a2.minus.junction, a1.plus.junction);
    assert_eq!(explorer.mapper.at(), a2.plus);
    // What is unexplored: X1 at junc(A1⁻), which is two ports here; X2 at junc(A2⁺); X3 at
    // junc(A3⁺).
    let open: Vec<_> = explorer
        .mapper
        .map()
        .open_ports()
        .map(|port| port.junction)
        .collect();
    let [x1, x2, x3] = [a1.minus.junction, a2.plus.junction, a3.plus.junction];
    assert_eq!(open, [x1, x1, x2, x3]);
    // "We let the robot move forward": X2 is all that is unknown here; A3 "is not available as a
    // choice".
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let ControlFlow::Continue(leg) = explorer.decide(Aim::Find(Landmark::Goal), &mut rng) else {
        panic!("there is more to explore");
    };
    assert_eq!((leg.turn, leg.known), (turn_into(&world, &rover, X2), None));
    // (c) If X2 is chosen: the goal.
    let (mut lucky, mut lucky_rover) = (explorer.clone(), rover.clone());
    follow(&mut lucky, &mut lucky_rover, &world, &[X2]);
    let done = lucky.decide(Aim::Find(Landmark::Goal), &mut rng);
    assert_eq!(done, ControlFlow::Break(Done::Reached));
    assert!(lucky.mapper.map().has_goal() && !lucky.mapper.map().is_complete());
    // (d) If X3 is: A5, which finds X4 and X5.
    assert_eq!(
        follow(&mut explorer, &mut rover, &world, &[2, X3]),
        MapUpdate::New
    );
    assert_eq!(explorer.mapper.map().open_ports().count(), 5);
    // (f) X4 leads to junc(A1⁻), as A1 tells, and X5 has both its ends on the map then.
    assert_eq!(
        follow(&mut explorer, &mut rover, &world, &[X4, 0]),
        MapUpdate::Duplicate
    );
    assert_eq!(explorer.mapper.map().open_ports().count(), 3);
    // (e) The complete optimized map.
    assert_eq!(
        pursue(&mut explorer, &mut rover, Aim::Explore, &mut rng),
        Done::Reached
    );
    assert!(explorer.mapper.map().is_complete());
    assert!(
        explorer
            .mapper
            .map()
            .is_optimized(&CpmConfig::online().matching, world.dictionary())
    );
    assert_eq!(
        world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at()),
        MapCheck::Right
    );
}

/// Figure 8: an unlucky first episode goes round and round. The optimized map has each fragment
/// once. The second episode has a short way, along fragments that were walked only the other way.
#[test]
fn figure_8() {
    let world = figure_10_world();
    let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
    let mut explorer = Explorer::new(CpmConfig::offline(), rover.sighting()).unwrap();
    let start = explorer.mapper.at();
    let unlucky = [6, X3, 2, 1, 3, 2, 1, 3, 2, 1, 3, 2, X2];
    follow(&mut explorer, &mut rover, &world, &unlucky);
    assert_eq!(explorer.mapper.map().fragments().len(), unlucky.len());
    assert!(
        !explorer
            .mapper
            .map()
            .is_optimized(&CpmConfig::offline().matching, world.dictionary())
    );
    explorer.mapper.optimize(world.dictionary()).unwrap();
    assert_eq!(explorer.mapper.map().fragments().len(), 6);
    assert!(
        explorer
            .mapper
            .map()
            .is_optimized(&CpmConfig::offline().matching, world.dictionary())
    );
    // "It is noteworthy that some trials exist for which CPM is not complete."
    assert!(!explorer.mapper.map().is_complete());
    let way = explorer.mapper.map().plan(start, |id| {
        explorer.mapper.map().junction(id).unwrap().landmark == Some(Landmark::Goal)
    });
    let way = way.unwrap();
    assert_eq!(way.legs.len(), 4);
    // The plan drives to the goal.
    explorer.mapper.place(start).unwrap();
    rover.place(world.start());
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    for leg in &way.legs {
        rover.go(leg.turn, None, &mut rng).unwrap();
    }
    assert_eq!(rover.sighting().landmark, Some(Landmark::Goal));
}

/// "It continues forward until reaching a junction that has some remaining unknown ports" can go
/// round for long.
#[test]
fn to_go_on_takes_longer_than_the_shortest_known_way() {
    let world = figure_10_world();
    let mean = |onward: Onward| {
        let walked = (0..200).map(|seed| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let mut config = CpmConfig::online();
            config.onward = onward;
            let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
            let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
            pursue(&mut explorer, &mut rover, Aim::Explore, &mut rng);
            explorer.mapper.traversals()
        });
        f64::from(walked.sum::<u32>()) / 200.0
    };
    let (way, on) = (mean(Onward::ShortestKnownWay), mean(Onward::GoOn));
    assert!(on > 1.1 * way, "{on} and {way}");
}

/// From a dead end along A to a fork, out of which B leads round to itself. Two walks along B that
/// differ by three observations of 25 are less similar than μ and stay two. A, walked from both
/// their ends, shows that they are one.
#[test]
fn what_is_missing_to_mu_others_make_up_for() {
    let dictionary = dictionary();
    let [a, b, strange] = [fragment(0, 8), fragment(1, 25), fragment(2, 25)];
    let differing_by = |observations: usize| {
        let mut again = b.clone();
        again[..observations].copy_from_slice(&strange[..observations]);
        again
    };
    let back = |patterns: &[PatternId]| dictionary.inverse(patterns).unwrap();
    // How many fragments are on the map at the end.
    let fragments = |again: &[PatternId]| {
        let mut explorer = Explorer::new(CpmConfig::online(), Sighting::plain(1)).unwrap();
        let mut arrive = |turn: Turn, patterns: &[PatternId], degree: u32| {
            explorer
                .mapper
                .arrive(turn, &walk(patterns, degree), &dictionary)
                .unwrap()
        };
        assert_eq!(arrive(Turn::BACK, &a, 3), MapUpdate::New);
        assert_eq!(arrive(Turn(1), &b, 3), MapUpdate::New);
        // Straight on, into B again.
        let second = arrive(Turn(2), again, 3);
        // Home from there: the fork of this end of B is that of the first.
        arrive(Turn(1), &back(&a), 1);
        assert_eq!(arrive(Turn::BACK, &a, 3), MapUpdate::Known);
        assert_eq!(arrive(Turn(2), &back(again), 3), MapUpdate::Known);
        // The fork of B's other end has A as well.
        arrive(Turn(2), &back(&a), 1);
        (second, explorer.mapper.map().fragments().len())
    };
    assert_eq!(fragments(&differing_by(2)), (MapUpdate::Duplicate, 2));
    assert_eq!(fragments(&differing_by(3)), (MapUpdate::New, 2));
    assert_eq!(fragments(&differing_by(4)).1, 4);
}
