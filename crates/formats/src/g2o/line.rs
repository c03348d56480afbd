//! Parses one line of a file.

use tolman_geom::nalgebra::Matrix3;
use tolman_geom::{Heading, Point, Pose};

use super::{G2oEdge, G2oFaultKind};

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
            POSE => pose(&words),
            EDGE => edge(line, &words),
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

fn pose(words: &[&str]) -> Result<Entry, G2oFaultKind> {
    let [named, at @ ..] = exactly::<4>(POSE, words)?;
    Ok(Entry::Pose(id(named)?, placed(at)?))
}

fn edge(line: usize, words: &[&str]) -> Result<Entry, G2oFaultKind> {
    let [from, to, x, y, heading, information @ ..] = exactly::<11>(EDGE, words)?;
    let (from, to) = (id(from)?, id(to)?);
    if from == to {
        return Err(G2oFaultKind::Loop { id: from });
    }
    Ok(Entry::Edge(G2oEdge {
        from,
        to,
        measured: placed([x, y, heading])?,
        information: matrix(information)?,
        line,
    }))
}

fn exactly<'a, const N: usize>(
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
fn matrix([xx, xy, xt, yy, yt, tt]: [&str; 6]) -> Result<Matrix3<f64>, G2oFaultKind> {
    let (xx, xy, xt) = (number(xx)?, number(xy)?, number(xt)?);
    let (yy, yt, tt) = (number(yy)?, number(yt)?, number(tt)?);
    let matrix = Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt);
    let inverse = matrix.cholesky().map(|root| root.inverse());
    match inverse {
        Some(inverse) if inverse.iter().all(|number| number.is_finite()) => Ok(matrix),
        _ => Err(G2oFaultKind::Information),
    }
}

fn number(text: &str) -> Result<f64, G2oFaultKind> {
    let number = text.parse::<f64>().ok();
    let finite = number.filter(|number| number.is_finite());
    finite.ok_or_else(|| G2oFaultKind::Number { text: shown(text) })
}

fn id(text: &str) -> Result<u64, G2oFaultKind> {
    text.parse()
        .map_err(|_| G2oFaultKind::Id { text: shown(text) })
}

/// Returns the beginning of a word, short enough for a message.
fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}
