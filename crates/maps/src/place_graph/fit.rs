//! Fits a robot's view to the map, starting from its pose by odometry.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Pose, Vector};
use tolman_robot::Sounding;

use super::surfaces::{CELL, Surface};
use super::{Outline, OutlinePoint};
use crate::tangent::{difference, moved};

/// Pose of a robot that sees an outline, found by fitting it to the map.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fit {
    /// Pose of the robot, by the map and by its wheels.
    pub(super) pose: Pose,
    /// Information by the map alone: ahead, left, heading.
    pub(super) information: Matrix3<f64>,
    /// Covariance of the pose by the map and by the wheels.
    pub(super) covariance: Matrix3<f64>,
    /// Squared distance from the pose by the wheels, in standard deviations.
    pub(super) surprise: f64,
    /// Share of the outline's points that lie on surfaces of the map.
    pub(super) share: f64,
    /// Share of the outline's points where the map has surfaces, but none of their colour and
    /// direction.
    pub(super) contradicted: f64,
    /// Log-likelihood of the view at this pose, up to a constant.
    pub(super) likelihood: f64,
    /// Information about the pose from the surfaces of each place, by the place that saw them
    /// first.
    pub(super) by_place: BTreeMap<u32, f64>,
}

/// Number of rounds. Each finds the nearest surfaces and then moves the pose towards them.
const ROUNDS: u32 = 8;

/// Search distance for surfaces in the first round, m.
const FIRST_GATE: f64 = 0.5;
/// Search distance for surfaces in the last round, m.
const LAST_GATE: f64 = 0.12;
/// Factor of the gate from round to round.
const GATE_SHRINKS: f64 = 0.75;

/// Maximum difference of colour between views of one surface, because light changes.
const COLOUR_GATE: f64 = 0.12;

/// Minimum scalar product of the normals of one surface.
const NORMAL_GATE: f64 = 0.88;

/// Residual, in standard deviations, at which a point weighs a quarter.
const DOUBT: f64 = 2.5;

/// Number of standard deviations above which a residual counts as no match.
const MOST_OFF: f64 = 3.0;

/// Angle beyond a sonar's cone in which the sonar still hears, rad: the uncertainty of its mount.
const CONE_SLACK: f64 = 0.03;

/// Weight of each point of an outline relative to an independent one: points of one outline err
/// together.
const INDEPENDENT: f64 = 0.3;

/// Weight of an arc relative to a point; an arc may be a miss or another sonar's echo.
const ARC_SHARE: f64 = 0.5;

/// One residual: the distance of a measurement from the map, in standard deviations, and its
/// derivative by the pose.
struct Residual {
    off: f64,
    by_pose: Vector3<f64>,
    place: u32,
    share: f64,
}

/// Minimum margin by which omitted surfaces lie beyond those that matter, m, whatever the rounding.
const SLACK: f64 = 1e-6;

/// Distances from the robot within which surfaces can matter to an outline, m.
struct Reach {
    points: f64,
    arcs: f64,
}

impl Reach {
    /// Returns the distances for an outline whose points and arcs find surfaces within `gate`, m.
    fn of(outline: &Outline, gate: f64) -> Self {
        let points = outline.points.iter();
        let points = points.map(|point| point.position.coords.norm() + gate_of(point, gate));
        let arcs = outline.arcs.iter();
        let arcs = arcs.map(|arc| arc.mount.position.coords.norm() + arc.range + arc_gate(gate));
        Self {
            points: points.fold(0.0, f64::max),
            arcs: arcs.fold(0.0, f64::max),
        }
    }
}

/// Returns the distance within which a point's surface is searched, m; it grows with the point's
/// deviation.
fn gate_of(point: &OutlinePoint, gate: f64) -> f64 {
    gate + 2.0 * point.deviation
}

/// Returns the distance within which an arc's surface is searched, m.
const fn arc_gate(gate: f64) -> f64 {
    gate.max(0.15)
}

/// Returns the `surfaces` that lie within `radius` of the robot, m, in their order.
fn near<'a>(surfaces: &[&'a Surface], pose: Pose, radius: f64) -> Vec<&'a Surface> {
    let within = (radius + SLACK) * (radius + SLACK);
    let x = pose.position.x;
    let surfaces = between(surfaces, x - radius, x + radius).iter().copied();
    let is_near = |surface: &&Surface| (surface.position() - pose.position).norm_squared() < within;
    surfaces.filter(is_near).collect()
}

/// Returns the run of `surfaces` that contains all with an x within these bounds, m, and some
/// others. O(log surfaces).
///
/// Surfaces are sorted by column of their grid, but not within a column, so the bounds are a column
/// wider.
fn between<'a, 'b>(surfaces: &'b [&'a Surface], low: f64, high: f64) -> &'b [&'a Surface] {
    let slack = CELL + SLACK;
    let x = |surface: &Surface| surface.position().x;
    let first = surfaces.partition_point(|surface| x(surface) < low - slack);
    let (_, from) = surfaces.split_at(first);
    let (run, _) = from.split_at(from.partition_point(|surface| x(surface) <= high + slack));
    run
}

/// Returns the fitted pose of a robot that sees `outline` and was predicted at `predicted`. `None`
/// if the covariance is singular. `surfaces` are sorted as
/// [`Surfaces::all`](super::surfaces::Surfaces::all) has them. O(rounds · outline · surfaces near
/// each of its points).
pub(super) fn fit(
    outline: &Outline,
    surfaces: &[&Surface],
    predicted: Pose,
    covariance: &Matrix3<f64>,
) -> Option<Fit> {
    let prior = covariance.try_inverse()?;
    let mut pose = predicted;
    let mut gate = FIRST_GATE;
    for _ in 0..ROUNDS {
        let residuals = residuals(outline, surfaces, pose, gate);
        let (information, pull) = normal_equations(&residuals);
        let off = difference(predicted, pose);
        let step = (information + prior).try_inverse()? * -(pull + prior * off);
        pose = moved(pose, &step);
        gate = (gate * GATE_SHRINKS).max(LAST_GATE);
    }
    let residuals = residuals(outline, surfaces, pose, LAST_GATE);
    let (information, _) = normal_equations(&residuals);
    let mut by_place = BTreeMap::new();
    for residual in &residuals {
        *by_place.entry(residual.place).or_insert(0.0) += residual.share;
    }
    let off = difference(predicted, pose);
    let on_map = residuals
        .iter()
        .filter(|residual| residual.share >= 1.0 && residual.off.abs() < MOST_OFF);
    Some(Fit {
        pose,
        information,
        covariance: (information + prior).try_inverse()?,
        share: on_map.count() as f64 / outline.points.len().max(1) as f64,
        contradicted: contradicted(outline, surfaces, pose),
        surprise: (prior * off).dot(&off),
        likelihood: likelihood(outline, &residuals) - 0.5 * (prior * off).dot(&off),
        by_place,
    })
}

fn residuals(outline: &Outline, surfaces: &[&Surface], pose: Pose, gate: f64) -> Vec<Residual> {
    let reach = Reach::of(outline, gate);
    let surfaces = near(surfaces, pose, reach.points.max(reach.arcs));
    let points = outline.points.iter();
    let points = points.filter_map(|point| of_point(point, &surfaces, pose, gate));
    let within = near(&surfaces, pose, reach.arcs);
    let arcs = outline.arcs.iter();
    let arcs = arcs.filter_map(|arc| of_arc(arc, &within, pose, gate));
    points.chain(arcs).collect()
}

/// Returns the residual of a point: its distance from the nearest surface of its colour and
/// direction, along the surface's normal.
fn of_point(
    point: &OutlinePoint,
    surfaces: &[&Surface],
    pose: Pose,
    gate: f64,
) -> Option<Residual> {
    let there = pose.transform(point.position);
    let normal = point.normal.map(|normal| pose.heading.rotate(normal));
    let mut nearest: Option<&Surface> = None;
    let reach = gate_of(point, gate);
    let mut within = reach * reach;
    for surface in between(surfaces, there.x - reach, there.x + reach) {
        let squared = (surface.position() - there).norm_squared();
        if squared < within && is_alike(surface, point, normal) {
            within = squared;
            nearest = Some(surface);
        }
    }
    let surface = nearest?;
    let across = surface.normal();
    let sight = (there - pose.position).normalize();
    let along_sight = point.deviation * across.dot(&sight).abs();
    let deviation = libm::sqrt(along_sight * along_sight + surface.variance());
    let lever = pose
        .heading
        .rotate(Vector::new(-point.position.y, point.position.x));
    let in_robot = Vector::new(across.dot(&pose.heading.unit()), across.dot(&left(pose)));
    Some(Residual {
        off: across.dot(&(there - surface.position())) / deviation,
        by_pose: Vector3::new(in_robot.x, in_robot.y, across.dot(&lever)) / deviation,
        place: surface.place,
        share: 1.0,
    })
}

/// Returns the share of an outline's points that lie where the map has surfaces, but no similar
/// ones.
fn contradicted(outline: &Outline, surfaces: &[&Surface], pose: Pose) -> f64 {
    let gate = FIRST_GATE * 0.5;
    let surfaces = near(surfaces, pose, Reach::of(outline, gate).points);
    let is_contradicted = |point: &&OutlinePoint| {
        let there = pose.transform(point.position);
        let normal = point.normal.map(|normal| pose.heading.rotate(normal));
        let reach = gate_of(point, gate);
        let near = |surface: &&&Surface| {
            surface.colour().is_some() == point.colour.is_some()
                && (surface.position() - there).norm() < reach
        };
        let column = between(&surfaces, there.x - reach, there.x + reach);
        let mut near = column.iter().filter(near).peekable();
        near.peek().is_some() && !near.any(|surface| is_alike(surface, point, normal))
    };
    let count = outline.points.iter().filter(is_contradicted).count();
    count as f64 / outline.points.len().max(1) as f64
}

fn is_alike(surface: &Surface, point: &OutlinePoint, normal: Option<Vector>) -> bool {
    if normal.is_some_and(|normal| normal.dot(&surface.normal()) < NORMAL_GATE) {
        return false;
    }
    match (surface.colour(), point.colour) {
        (Some(a), Some(b)) => (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < COLOUR_GATE,
        // A surface that was only heard says nothing about what is seen.
        (heard, seen) => heard.is_none() && seen.is_none(),
    }
}

/// Returns the residual of a sonar's range and the nearest surface in its cone, or `None` if no
/// surface fits.
fn of_arc(arc: &Sounding, surfaces: &[&Surface], pose: Pose, gate: f64) -> Option<Residual> {
    let ear = pose.compose(arc.mount);
    let axis = ear.heading.unit();
    let cone = libm::cos(arc.half_width + CONE_SLACK);
    // A surface farther away is not a match, and hides none.
    let farthest = arc.range + arc_gate(gate) + SLACK;
    let (low, high) = extent(ear, arc.half_width + CONE_SLACK, farthest);
    let mut nearest: Option<(f64, Vector, &Surface)> = None;
    for surface in between(surfaces, low, high) {
        let towards = surface.position() - ear.position;
        let squared = towards.norm_squared();
        if squared > farthest * farthest {
            continue;
        }
        let ahead = towards.dot(&axis);
        if ahead <= 0.0 || ahead > arc.max_range || surface.normal().dot(&towards) > 0.0 {
            continue;
        }
        if ahead * ahead >= cone * cone * squared
            && nearest
                .as_ref()
                .is_none_or(|(least, ..)| squared < least * least)
        {
            nearest = Some((libm::sqrt(squared), towards, surface));
        }
    }
    let (range, towards, surface) = nearest?;
    if (arc.range - range).abs() > arc_gate(gate) {
        return None;
    }
    let deviation = 0.02 + 0.01 * range;
    let towards = towards / range;
    let at = arc.mount.position;
    let lever = pose.heading.rotate(Vector::new(-at.y, at.x));
    Some(Residual {
        off: (arc.range - range) / deviation,
        by_pose: Vector3::new(
            towards.dot(&pose.heading.unit()),
            towards.dot(&left(pose)),
            towards.dot(&lever),
        ) / deviation,
        place: surface.place,
        share: ARC_SHARE,
    })
}

/// Returns the minimum and the maximum x of a sector that opens by `half_width`, rad, to either
/// side of `ear` and reaches `reach`, m.
fn extent(ear: Pose, half_width: f64, reach: f64) -> (f64, f64) {
    let axis = ear.heading.radians();
    let [one, other] = [axis - half_width, axis + half_width].map(libm::cos);
    let ahead = ear.heading.unit().x;
    let cone = libm::cos(half_width);
    // A cone that contains the direction of x reaches farthest there.
    let low = if -ahead >= cone {
        -1.0
    } else {
        one.min(other).min(0.0)
    };
    let high = if ahead >= cone {
        1.0
    } else {
        one.max(other).max(0.0)
    };
    (ear.position.x + reach * low, ear.position.x + reach * high)
}

fn left(pose: Pose) -> Vector {
    pose.heading.rotate(Vector::new(0.0, 1.0))
}

/// Returns the normal equations of the residuals: JᵀWJ and JᵀWr.
fn normal_equations(residuals: &[Residual]) -> (Matrix3<f64>, Vector3<f64>) {
    let mut information = Matrix3::zeros();
    let mut pull = Vector3::zeros();
    for Residual {
        off,
        by_pose,
        share,
        ..
    } in residuals
    {
        let kept = DOUBT * DOUBT / (DOUBT * DOUBT + off * off);
        let weight = INDEPENDENT * share * kept * kept;
        information += by_pose * by_pose.transpose() * weight;
        pull += by_pose * (off * weight);
    }
    (information, pull)
}

/// Returns the log-likelihood of an outline. Matched points count by their residuals, others as the
/// worst residual.
fn likelihood(outline: &Outline, residuals: &[Residual]) -> f64 {
    let worst = MOST_OFF * MOST_OFF;
    let of = outline.points.len() as f64 + ARC_SHARE * outline.arcs.len() as f64;
    let saved =
        |residual: &Residual| residual.share * (worst - (residual.off * residual.off).min(worst));
    let saved: f64 = residuals.iter().map(saved).sum();
    0.5 * INDEPENDENT * (saved - worst * of)
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use proptest::prelude::*;
    use tolman_geom::{Heading, Point};

    use super::super::surfaces::Surfaces;
    use super::*;

    /// Returns the outline of walls 2 m away all round, seen from the middle, and of a sonar that
    /// hears the wall ahead.
    fn room() -> Outline {
        let point = |number: u32| {
            let heading = Heading::from_radians(f64::from(number) * 0.26);
            OutlinePoint {
                position: Point::from(heading.unit() * 2.0),
                normal: Some(-heading.unit()),
                deviation: 0.02,
                colour: Some([0.5, 0.3]),
            }
        };
        Outline {
            points: (0..24).map(point).collect(),
            arcs: vec![Sounding {
                mount: Pose::IDENTITY,
                half_width: 0.2,
                max_range: 5.0,
                range: 2.0,
            }],
            faced: Vec::new(),
        }
    }

    #[test]
    fn what_was_seen_and_what_was_heard_are_not_alike() {
        let painted = |colour| {
            let mut outline = room();
            for point in &mut outline.points {
                point.colour = colour;
            }
            outline
        };
        let kinds = [None, Some([0.5, 0.3]), Some([0.1, 0.9])];
        for (one, of_surface) in kinds.iter().enumerate() {
            for (other, of_point) in kinds.iter().enumerate() {
                let mut known = Surfaces::default();
                known.add(0, Pose::IDENTITY, &painted(*of_surface));
                let point = painted(*of_point).points[0];
                let surface = known.all().next().unwrap();
                let alike = is_alike(surface, &point, Some(surface.normal()));
                assert_eq!(alike, one == other, "{of_surface:?} {of_point:?}");
                assert!(!is_alike(surface, &point, Some(-surface.normal())));
            }
        }
    }

    /// Returns the surfaces of a room, and of one that was seen from another pose.
    fn two_rooms() -> Surfaces {
        let mut known = Surfaces::default();
        known.add(0, Pose::IDENTITY, &room());
        known.add(1, pose(0.7, 0.4, 1.0), &room());
        known
    }

    fn pose(x: f64, y: f64, turn: f64) -> Pose {
        Pose::new(Point::new(x, y), Heading::from_radians(turn))
    }

    /// Returns the derivative of `off` by the pose.
    fn derivative(at: Pose, off: impl Fn(Pose) -> f64) -> Vector3<f64> {
        const STEP: f64 = 1e-6;
        Vector3::from_fn(|axis, _| {
            let mut step = Vector3::zeros();
            step[axis] = STEP;
            (off(moved(at, &step)) - off(moved(at, &-step))) / (2.0 * STEP)
        })
    }

    #[test]
    fn a_residual_weighs_less_the_farther_it_is_off() {
        let residual = |off, share| Residual {
            off,
            by_pose: Vector3::new(2.0, -1.0, 0.5),
            place: 0,
            share,
        };
        // At 2.5 standard deviations the weight is a quarter.
        for (off, share, weight) in [(0.0, 1.0, 0.3), (2.5, 1.0, 0.075), (2.5, 0.5, 0.0375)] {
            let (information, pull) = normal_equations(&[residual(off, share)]);
            for (row, a) in [2.0, -1.0, 0.5].into_iter().enumerate() {
                for (column, b) in [2.0, -1.0, 0.5].into_iter().enumerate() {
                    assert!((information[(row, column)] - weight * a * b).abs() < 1e-12);
                }
                assert!((pull[row] - weight * off * a).abs() < 1e-12);
            }
        }
        // 24 points and an arc that is worth half a point. What is off by 3 or more saves nothing.
        let likelihood = |all: &[Residual]| likelihood(&room(), all);
        assert!((likelihood(&[]) + 0.15 * 9.0 * 24.5).abs() < 1e-9);
        for (off, share, saved) in [(1.0, 1.0, 8.0), (-2.0, 0.5, 2.5), (7.0, 1.0, 0.0)] {
            let found = likelihood(&[residual(off, share)]) - likelihood(&[]);
            assert!((found - 0.15 * saved).abs() < 1e-9, "{off} {found}");
        }
    }

    proptest! {
        #[test]
        fn an_arc_is_off_by_the_nearest_surface_that_it_may_hear(
            x in -0.9..0.9, y in -0.9..0.9, turn in -3.2..3.2, ahead in -0.3..0.3, aside in -0.3..0.3,
            side in -3.2..3.2, half_width in 0.05..0.6, range in 0.5..2.5, max_range in 1.0..3.0, gate in 0.05..0.5,
        ) {
            let known = two_rooms();
            let all: Vec<&Surface> = known.all().collect();
            let (at, mount) = (pose(x, y, turn), pose(ahead, aside, side));
            let arc = Sounding { mount, half_width, max_range, range };
            let ear = at.compose(mount);
            let far = |surface: &Surface| (surface.position() - ear.position).norm();
            let gate_of_arc = f64::max(gate, 0.15);
            let may_hear = |surface: &&&Surface| {
                let there = surface.position() - ear.position;
                let bearing = ear.heading.turned(-there.y.atan2(there.x)).radians().abs();
                let is_in_front = bearing <= half_width + 0.03 && there.norm() * bearing.cos() <= max_range;
                is_in_front && surface.normal().dot(&there) <= 0.0 && there.norm() <= range + gate_of_arc
            };
            let nearest = all.iter().filter(may_hear).min_by(|a, b| far(a).total_cmp(&far(b)));
            let nearest = nearest.filter(|surface| (far(surface) - range).abs() <= gate_of_arc);
            let found = of_arc(&arc, &all, at, gate);
            prop_assert_eq!(found.is_some(), nearest.is_some());
            if let (Some(found), Some(surface)) = (found, nearest) {
                let deviation = 0.02 + 0.01 * far(surface);
                let off = |at: Pose| (range - (surface.position() - at.compose(mount).position).norm()) / deviation;
                prop_assert!((found.off - off(at)).abs() < 1e-9);
                prop_assert!((found.by_pose - derivative(at, off)).norm() < 1e-3);
                prop_assert_eq!((found.place, found.share.to_bits()), (surface.place, 0.5_f64.to_bits()));
            }
        }

        #[test]
        fn a_point_is_off_by_the_nearest_surface_that_is_alike(
            x in -0.9..0.9, y in -0.9..0.9, turn in -3.2..3.2, ahead in -2.2..2.2, aside in -2.2..2.2,
            side in -3.2..3.2, deviation in 0.01..0.2, gate in 0.05..0.8,
        ) {
            let known = two_rooms();
            let all: Vec<&Surface> = known.all().collect();
            let at = pose(x, y, turn);
            let normal = Some(Heading::from_radians(side).unit());
            let point = OutlinePoint { position: Point::new(ahead, aside), normal, deviation, colour: Some([0.45, 0.35]) };
            let there = at.transform(point.position);
            let far = |surface: &Surface| (surface.position() - there).norm();
            // Within 28° of its direction; all are of its colour.
            let is_near = |surface: &&&Surface| {
                let turned = at.heading.rotate(point.normal.unwrap());
                turned.dot(&surface.normal()) >= 0.88 && far(surface) < gate + 2.0 * deviation
            };
            let nearest = all.iter().filter(is_near).min_by(|a, b| far(a).total_cmp(&far(b)));
            let found = of_point(&point, &all, at, gate);
            prop_assert_eq!(found.is_some(), nearest.is_some());
            if let (Some(found), Some(surface)) = (found, nearest) {
                let sight = (there - at.position).normalize();
                let along = deviation * sight.dot(&surface.normal());
                let deviation = (along * along + surface.variance()).sqrt();
                let off = |at: Pose| surface.normal().dot(&(at.transform(point.position) - surface.position())) / deviation;
                prop_assert!((found.off - off(at)).abs() < 1e-9);
                prop_assert!((found.by_pose - derivative(at, off)).norm() < 1e-3);
                prop_assert_eq!((found.place, found.share.to_bits()), (surface.place, 1.0_f64.to_bits()));
            }
        }

        #[test]
        fn surfaces_out_of_reach_make_no_residual(x in -2.5..2.5, y in -2.5..2.5, turn in -3.2..3.2, gate in 0.05..0.5, far in 0.3..2.0) {
            let known = two_rooms();
            let all: Vec<&Surface> = known.all().collect();
            let at = pose(x, y, turn);
            let mut outline = room();
            outline.points.truncate(9);
            // A sonar beside the middle, heard from beyond the points.
            outline.arcs[0].mount = pose(0.2, -0.2, 2.0);
            for (point, number) in outline.points.iter_mut().zip(1..) {
                point.position = Point::from(point.position.coords * 0.2 * far);
                point.deviation = 0.02 * f64::from(number);
                point.normal = None;
            }
            let points = outline.points.iter().filter_map(|point| of_point(point, &all, at, gate));
            let arcs = outline.arcs.iter().filter_map(|arc| of_arc(arc, &all, at, gate));
            let expected: Vec<(u64, u32)> = points.chain(arcs).map(|one| (one.off.to_bits(), one.place)).collect();
            let found = residuals(&outline, &all, at, gate);
            let found: Vec<(u64, u32)> = found.iter().map(|one| (one.off.to_bits(), one.place)).collect();
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn no_surface_is_missed_that_lies_between_two_bounds(low in -3.0..3.0, width in 0.0..2.0, x in -0.3..0.3, turn in -3.0..3.0) {
            let mut known = Surfaces::default();
            known.add(0, Pose::new(Point::new(x, 0.0), Heading::from_radians(turn)), &room());
            let all: Vec<&Surface> = known.all().collect();
            let high = low + width;
            let is_in = |surface: &&&Surface| (low..=high).contains(&surface.position().x);
            let run = between(&all, low, high);
            prop_assert_eq!(run.iter().filter(is_in).count(), all.iter().filter(is_in).count());
        }

        #[test]
        fn a_sector_is_no_wider_than_its_extent(x in -1.0..1.0, heading in -4.0..4.0, half_width in 0.01..1.0, reach in 0.1..5.0, off in -1.0..1.0, far in 0.0..1.0) {
            let ear = Pose::new(Point::new(x, 0.0), Heading::from_radians(heading));
            let (low, high) = extent(ear, half_width, reach);
            let towards = Heading::from_radians(heading + off * half_width).unit();
            let at = ear.position.x + far * reach * towards.x;
            prop_assert!((low - 1e-9..=high + 1e-9).contains(&at), "{} {} {}", low, at, high);
        }

        #[test]
        fn what_is_far_changes_no_fit(x in -0.3..0.3, y in -0.3..0.3, turn in -0.2..0.2, away in 5.0..50.0) {
            let outline = room();
            let (mut near, mut all) = (Surfaces::default(), Surfaces::default());
            near.add(0, Pose::IDENTITY, &outline);
            all.add(0, Pose::IDENTITY, &outline);
            all.add(1, Pose::new(Point::new(away, -away), Heading::EAST), &outline);
            let predicted = Pose::new(Point::new(x, y), Heading::from_radians(turn));
            let covariance = Matrix3::from_diagonal(&Vector3::new(0.1, 0.1, 0.1));
            let fitted = |surfaces: &Surfaces| {
                let surfaces: Vec<&Surface> = surfaces.all().collect();
                fit(&outline, &surfaces, predicted, &covariance)
            };
            let fitted = [fitted(&near), fitted(&all)];
            prop_assert!(fitted[0].is_some());
            prop_assert_eq!(&fitted[0], &fitted[1]);
        }
    }
}
