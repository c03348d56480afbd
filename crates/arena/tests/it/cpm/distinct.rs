//! How alike the fragments of a maze are.

use tolman_arena::cpm::{distinctness, epuck_course};

use super::trials::PATTERNS;

#[test]
fn a_straight_corridor_is_the_same_from_both_ends() {
    let text = "\
start = 0 0 east

o---o---o---o---o---o
| S               G |
o---o---o---o---o---o
";
    let course = epuck_course("", tolman_maze::read(text).unwrap()).unwrap();
    let found = distinctness(&course, &PATTERNS, 0..2).unwrap();
    let most = found.most_alike.unwrap();
    assert!(most.score > 0.9, "{most:?}");
    let least = found.least_alike.unwrap();
    assert!(least.score > 0.8 && least.score < 1.0, "{least:?}");
}

#[test]
fn a_fragment_without_anything_to_see_is_refused() {
    let text = "start = 0 0 east\n\no---o---o\n| S   G |\no---o---o\n";
    let course = epuck_course("", tolman_maze::read(text).unwrap()).unwrap();
    let refused = distinctness(&course, &PATTERNS, 0..1).unwrap_err();
    assert!(refused.to_string().contains("saw nothing"), "{refused}");
}
