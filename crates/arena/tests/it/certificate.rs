//! Certificates of a mouse's best run.

use tolman_arena::micromouse::{CertificateError, check};
use tolman_maze::{Cell, Knowledge, Maze};
use tolman_systems::micromouse::Certificate;
use tolman_systems::micromouse::Searcher;

use tolman_arena::micromouse::{MouseTrial, brief};

fn maze() -> Maze {
    let text = "\
o---o---o---o---o---o
|                   |
o   o---o---o---o   o
|   |       | G |   |
o   o   o   o   o   o
|   |   |       |   |
o   o   o---o---o   o
| S |               |
o---o---o---o---o---o
";
    tolman_maze::read(text).unwrap().maze
}

fn certificate(maze: &Maze) -> Certificate {
    let mut mouse = Searcher::Certify.mouse(&brief(maze).unwrap(), 0).unwrap();
    MouseTrial::play(maze, &mut mouse, |_, _| {}).unwrap();
    mouse.certificate().unwrap().clone()
}

/// Returns the checker's error after `change` to the certificate.
fn refuse(change: impl FnOnce(&mut Certificate)) -> CertificateError {
    let maze = maze();
    let mut certificate = certificate(&maze);
    assert_eq!(check(&certificate, &maze), Ok(()));
    change(&mut certificate);
    check(&certificate, &maze).unwrap_err()
}

#[test]
fn a_certificate_that_is_tampered_with_is_refused() {
    let other = refuse(|certificate| certificate.goals = vec![Cell::new(0, 1)]);
    assert_eq!(other, CertificateError::OtherMaze);
    let other = refuse(|certificate| certificate.start = Cell::new(1, 1));
    assert_eq!(other, CertificateError::OtherMaze);
    let flipped = refuse(|certificate| {
        let (_, known) = &mut certificate.walls[3];
        *known = Knowledge::of_standing(*known == Knowledge::Open);
    });
    assert!(matches!(flipped, CertificateError::FalseWall { .. }));
    let unknown = refuse(|certificate| certificate.walls[0].1 = Knowledge::Unknown);
    assert!(matches!(unknown, CertificateError::FalseWall { .. }));
    let short = refuse(|certificate| certificate.run.truncate(2));
    assert_eq!(short, CertificateError::Ends);
    let jump = refuse(|certificate| certificate.run[1] = certificate.run[2]);
    assert!(matches!(
        jump,
        CertificateError::Impossible { index: 1, .. }
    ));
    let long = refuse(|certificate| certificate.closed_cost += 1);
    assert!(matches!(long, CertificateError::Costs { .. }));
    let cheap = refuse(|certificate| certificate.open_cost -= 1);
    assert!(matches!(cheap, CertificateError::Costs { .. }));
    let few = refuse(|certificate| certificate.at_least.truncate(3));
    assert!(matches!(few, CertificateError::Size { .. }));
    let high = refuse(|certificate| certificate.at_least[1] += 50);
    assert!(matches!(high, CertificateError::Bound { .. }));
    let goal = refuse(|certificate| certificate.at_least.fill(certificate.open_cost));
    assert!(matches!(
        goal,
        CertificateError::Bound { at_least: 1.., .. }
    ));
}

#[test]
fn forgetting_walls_forgets_the_proof() {
    // Without any wall of the bound or the run nothing is left of either.
    let bare = refuse(|certificate| certificate.walls.clear());
    assert!(matches!(bare, CertificateError::Impossible { .. }));
    let only_open = refuse(|certificate| {
        certificate
            .walls
            .retain(|(_, known)| *known == Knowledge::Open);
    });
    assert!(matches!(only_open, CertificateError::Bound { .. }));
}
