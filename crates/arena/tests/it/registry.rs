//! The list of systems and robots.

use alloc::collections::BTreeSet;

use tolman_arena::registry::{Registry, slug};

#[test]
fn every_name_is_typed_as_it_stands_and_means_one_thing() {
    let registry = Registry::tolman();
    let systems = registry.systems.iter().map(|system| system.name());
    let robots = registry.robots.iter().map(|robot| robot.name);
    for names in [systems.collect::<Vec<_>>(), robots.collect()] {
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
        assert!(names.iter().all(|name| slug(name) == *name), "{names:?}");
    }
    for system in &registry.systems {
        for name in [system.name(), system.title()] {
            let found = registry.system(name).unwrap();
            assert_eq!(found.name(), system.name(), "{name}");
        }
    }
    let now = Registry::former_name("gngslam").unwrap();
    assert!(registry.system("gngslam").is_none() && registry.system(now).is_some());
}

#[test]
fn a_system_can_be_carried_by_its_own_robot_and_says_why_not_by_others() {
    let registry = Registry::tolman();
    for system in registry.learners() {
        let robots = registry.robots_of(system);
        assert_eq!(
            robots[0].name,
            system.facts().own_robot,
            "{}",
            system.name()
        );
        for robot in &registry.robots {
            let can = robots.iter().any(|one| one.name == robot.name);
            assert_eq!(system.why_not(robot).is_none(), can);
            if let Some(why) = system.why_not(robot) {
                assert!(why.contains(robot.title) && !why.ends_with('.'), "{why}");
            }
        }
    }
}
