//! Parses one line of a file.

use tolman_geom::nalgebra::Matrix3;
use tolman_geom::{Heading, Point, Pose};

use super::{G2oEdge, G2oFaultKind, space};

/// Contents of a line.
pub(super) enum Entry {
    Nothing,
    Pose(u64, Pose),
    Edge(G2oEdge),
    Fix(Vec<u64>),
}

const POSE: &str = "VERTEX_SE2";
const EDGE: &str = "EDGE_SE2";

impl Entry {
    pub(super) fn of(line: usize, text: &str) -> Result<Self, G2oFaultKind> {
        let mut words = text.split_ascii_whitespace();
        let Some(word) = words.next().filter(|word| !word.starts_with('#')) else {
            return Ok(Self::Nothing);
        };
        let words: Vec<&str> = words.collect();
        match word {
            POSE => pose(POSE, &words),
            EDGE => edge(EDGE, line, &words, row_by_row),
            // What TORO called them, with the matrix in an order of its own.
            "VERTEX2" => pose("VERTEX2", &words),
            "EDGE2" => edge("EDGE2", line, &words, toro),
            space::POSE => space::pose(&words),
            space::EDGE => space::edge(line, &words),
            "FIX" => words
                .iter()
                .map(|word| id(word))
                .collect::<Result<_, _>>()
                .map(Self::Fix),
            _ => Err(G2oFaultKind::Unknown {
                word: word.chars().take(40).collect(),
            }),
        }
    }
}

fn pose(word: &'static str, words: &[&str]) -> Result<Entry, G2oFaultKind> {
    let [named, at @ ..] = exactly::<4>(word, words)?;
    Ok(Entry::Pose(id(named)?, placed(at)?))
}

fn edge(
    word: &'static str,
    line: usize,
    words: &[&str],
    matrix: fn([f64; 6]) -> Result<Matrix3<f64>, G2oFaultKind>,
) -> Result<Entry, G2oFaultKind> {
    let [from, to, x, y, heading, information @ ..] = exactly::<11>(word, words)?;
    let (from, to) = ends(from, to)?;
    Ok(Entry::Edge(G2oEdge {
        from,
        to,
        measured: placed([x, y, heading])?,
        information: matrix(numbers(information)?)?,
        line,
    }))
}

/// Returns the ids of the poses that an edge joins.
pub(super) fn ends(from: &str, to: &str) -> Result<(u64, u64), G2oFaultKind> {
    let (from, to) = (id(from)?, id(to)?);
    match from == to {
        true => Err(G2oFaultKind::Loop { id: from }),
        false => Ok((from, to)),
    }
}

pub(super) fn exactly<'a, const N: usize>(
    word: &'static str,
    words: &[&'a str],
) -> Result<[&'a str; N], G2oFaultKind> {
    words.try_into().map_err(|_| G2oFaultKind::Count {
        word,
        found: words.len(),
        expected: N,
    })
}

fn placed([x, y, heading]: [&str; 3]) -> Result<Pose, G2oFaultKind> {
    let position = Point::new(number(x)?, number(y)?);
    let heading = Heading::from_radians(number(heading)?);
    Ok(Pose::new(position, heading))
}

/// Returns a symmetric matrix by its upper triangle, row by row.
pub(super) fn row_by_row([xx, xy, xt, yy, yt, tt]: [f64; 6]) -> Result<Matrix3<f64>, G2oFaultKind> {
    let matrix = Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt);
    let inverse = matrix.cholesky().map(|root| root.inverse());
    match inverse {
        Some(inverse) if inverse.iter().all(|number| number.is_finite()) => Ok(matrix),
        _ => Err(G2oFaultKind::Information),
    }
}

/// Returns a matrix in the order of TORO, or, as some programs write it, row by row.
fn toro([xx, xy, yy, tt, xt, yt]: [f64; 6]) -> Result<Matrix3<f64>, G2oFaultKind> {
    row_by_row([xx, xy, xt, yy, yt, tt]).or_else(|_| row_by_row([xx, xy, yy, tt, xt, yt]))
}

pub(super) fn numbers<const N: usize>(words: [&str; N]) -> Result<[f64; N], G2oFaultKind> {
    let mut numbers = [0.0; N];
    for (parsed, word) in numbers.iter_mut().zip(words) {
        *parsed = number(word)?;
    }
    Ok(numbers)
}

fn number(text: &str) -> Result<f64, G2oFaultKind> {
    let number = text.parse::<f64>().ok();
    let finite = number.filter(|number| number.is_finite());
    finite.ok_or_else(|| G2oFaultKind::Number { text: shown(text) })
}

pub(super) fn id(text: &str) -> Result<u64, G2oFaultKind> {
    text.parse()
        .map_err(|_| G2oFaultKind::Id { text: shown(text) })
}

/// Returns the beginning of a word, short enough for a message.
fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}
