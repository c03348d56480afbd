//! Bodies that move until they touch.
//!
//! A step's arc is followed along chords of at most a tenth of a radian, each swept as a whole, so
//! that nothing is passed through however far a step goes.

use core::f64::consts::FRAC_PI_2;

use tolman_geom::{Point, Pose, Vector};
use tolman_robot::Body;

use crate::scene::{Placed, Scene};
use crate::{Motion, Wall, World};

/// What happens where a body meets something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Contact {
    /// It stays where it touched. A disc still turns.
    Stop,
    /// What is left of its path goes along what it touched.
    Slide,
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outcome {
    pub(crate) pose: Pose,
    /// Whether the motion was cut.
    pub(crate) bump: bool,
}

/// Bodies keep this far apart, m: more than a step's rounding, less than any sensor sees.
const SKIN: f64 = 1e-6;

/// A motion cut by less than this, m, met nothing: it is the rounding of a slide.
const CUT: f64 = 1e-12;

/// The longest turn along one chord, rad.
const CHORD_TURN: f64 = 0.1;

/// How far `body` at `pose` is from the nearest wall of `world`, m; 0 or less where it overlaps one.
pub(crate) fn clearance(world: &World, body: &Body, pose: Pose) -> f64 {
    let placed = Placed::new(body.clone(), pose);
    world
        .walls()
        .iter()
        .map(|wall| gap_to_wall(&placed, wall))
        .fold(f64::INFINITY, f64::min)
}

/// The distance between a body and a wall, m; 0 or less where they overlap.
pub(crate) fn gap_to_wall(body: &Placed, wall: &Wall) -> f64 {
    if body.corners().is_empty() {
        return wall.distance(body.pose().position) - body.radius();
    }
    if body.encloses(wall.start) || body.sides().any(|side| crosses(&side, wall)) {
        return 0.0;
    }
    let corners = body.corners().iter().map(|corner| wall.distance(*corner));
    let ends = body
        .sides()
        .map(|side| side.distance(wall.start).min(side.distance(wall.end)));
    corners.chain(ends).fold(f64::INFINITY, f64::min)
}

/// The distance between two bodies, m; 0 or less where they overlap.
pub(crate) fn gap_between(a: &Placed, b: &Placed) -> f64 {
    match (a.corners().is_empty(), b.corners().is_empty()) {
        (true, true) => (a.pose().position - b.pose().position).norm() - a.radius() - b.radius(),
        (false, _) if b.encloses(a.corners()[0]) || a.encloses(b.pose().position) => 0.0,
        (false, _) => a
            .sides()
            .map(|side| gap_to_wall(b, &side))
            .fold(f64::INFINITY, f64::min),
        (true, false) => gap_between(b, a),
    }
}

fn crosses(a: &Wall, b: &Wall) -> bool {
    let side = |of: &Wall, point: Point| (of.end - of.start).perp(&(point - of.start));
    side(a, b.start) * side(a, b.end) <= 0.0 && side(b, a.start) * side(b, a.end) <= 0.0
}

/// Moves the body of robot `robot` until it has carried out `motion` or met something.
pub(crate) fn moved(scene: &Scene<'_>, robot: usize, motion: Motion, contact: Contact) -> Outcome {
    let body = &scene.bodies[robot];
    let start = body.pose();
    let free = start.displaced(motion.distance, motion.turn);
    let reach = body.radius() + motion.distance.abs() + 2.0 * SKIN;
    let obstacles = Obstacles::near(scene, robot, start.position, reach);
    if obstacles.is_empty() {
        return Outcome {
            pose: free,
            bump: false,
        };
    }
    let chords = (motion.turn.abs() / CHORD_TURN).ceil().max(1.0);
    let mut mover = Mover {
        body: body.clone(),
        obstacles,
        cut: 0.0,
    };
    let mut met = false;
    for chord in 0..chords as u32 {
        let before = start.displaced(
            motion.distance * f64::from(chord) / chords,
            motion.turn * f64::from(chord) / chords,
        );
        let after = start.displaced(
            motion.distance * f64::from(chord + 1) / chords,
            motion.turn * f64::from(chord + 1) / chords,
        );
        let half_turn = 0.5 * motion.turn / chords;
        mover.turn(half_turn);
        if !(met && contact == Contact::Stop) {
            met |= mover.translate(after.position - before.position, contact);
        }
        mover.turn(half_turn);
    }
    if mover.cut <= CUT {
        return Outcome {
            pose: free,
            bump: false,
        };
    }
    Outcome {
        pose: mover.body.pose(),
        bump: true,
    }
}

/// What is near enough to be met in one step.
struct Obstacles<'a> {
    walls: Vec<Wall>,
    bodies: Vec<&'a Placed>,
}

impl<'a> Obstacles<'a> {
    fn near(scene: &Scene<'a>, robot: usize, position: Point, reach: f64) -> Self {
        let near = |wall: &&Wall| wall.distance(position) <= reach;
        Self {
            walls: scene
                .world
                .walls()
                .iter()
                .chain(scene.shut)
                .filter(near)
                .copied()
                .collect(),
            bodies: scene
                .others(robot)
                .filter(|other| (other.pose().position - position).norm() <= reach + other.radius())
                .collect(),
        }
    }

    fn is_empty(&self) -> bool {
        self.walls.is_empty() && self.bodies.is_empty()
    }

    /// The gap between `body` and the nearest of them, m.
    fn gap(&self, body: &Placed) -> f64 {
        let walls = self.walls.iter().map(|wall| gap_to_wall(body, wall));
        let bodies = self.bodies.iter().map(|other| gap_between(body, other));
        walls.chain(bodies).fold(f64::INFINITY, f64::min)
    }
}

/// A touch: after what share of a displacement, and the unit normal away from what was touched.
#[derive(Clone, Copy)]
struct Touch {
    share: f64,
    normal: Vector,
}

struct Mover<'a> {
    body: Placed,
    obstacles: Obstacles<'a>,
    /// How much of the motion was not carried out, m.
    cut: f64,
}

impl Mover<'_> {
    /// Turns in place as far as possible.
    fn turn(&mut self, turn: f64) {
        let pose = self.body.pose();
        if self.body.corners().is_empty() {
            self.body
                .move_to(Pose::new(pose.position, pose.heading.turned(turn)));
            return;
        }
        // Conservative advancement: no point of the body moves further than its radius times the turn.
        let mut turned = 0.0;
        while turned < turn.abs() {
            let room = self.obstacles.gap(&self.body) - SKIN;
            if room < SKIN {
                self.cut += (turn.abs() - turned) * self.body.radius();
                break;
            }
            turned = (turned + room / self.body.radius()).min(turn.abs());
            let heading = pose.heading.turned(turned.copysign(turn));
            self.body.move_to(Pose::new(pose.position, heading));
        }
    }

    /// Moves by `displacement` as far as possible; says whether something was met.
    fn translate(&mut self, displacement: Vector, contact: Contact) -> bool {
        let mut left = displacement;
        let mut met = false;
        // A disc in a corner touches two walls, and slides along a third at most.
        for _ in 0..4 {
            let Some(touch) = self.first_touch(left) else {
                met |= !self.advance(left);
                return met;
            };
            met = true;
            if !self.advance(left * touch.share) {
                return true;
            }
            left *= 1.0 - touch.share;
            if contact == Contact::Stop {
                break;
            }
            let into = left.dot(&touch.normal);
            self.cut += into.abs();
            left -= touch.normal * into;
            // Never back against the way the motors push.
            if left.dot(&displacement) <= 0.0 {
                return true;
            }
        }
        self.cut += left.norm();
        met
    }

    /// Moves the body, unless rounding would let it overlap something. Where it was, it was clear.
    fn advance(&mut self, displacement: Vector) -> bool {
        let before = self.body.pose();
        self.body
            .move_to(Pose::new(before.position + displacement, before.heading));
        let clear = self.obstacles.gap(&self.body) > 0.0;
        if !clear {
            self.cut += displacement.norm();
            self.body.move_to(before);
        }
        clear
    }

    fn first_touch(&self, displacement: Vector) -> Option<Touch> {
        let mut first: Option<Touch> = None;
        let mut keep = |touch: Option<Touch>| {
            if let Some(touch) = touch
                && first.is_none_or(|first| touch.share < first.share)
            {
                first = Some(touch);
            }
        };
        for wall in &self.obstacles.walls {
            self.touch_wall(wall, displacement, &mut keep);
        }
        for other in &self.obstacles.bodies {
            if other.corners().is_empty() {
                self.touch_disc(
                    other.pose().position,
                    other.radius(),
                    displacement,
                    &mut keep,
                );
            } else {
                for side in other.sides() {
                    self.touch_wall(&side, displacement, &mut keep);
                }
            }
        }
        first
    }

    fn touch_wall(&self, wall: &Wall, displacement: Vector, keep: &mut impl FnMut(Option<Touch>)) {
        if self.body.corners().is_empty() {
            let disc = self.body.pose().position;
            keep(disc_meets_wall(
                disc,
                self.body.radius() + SKIN,
                displacement,
                wall,
            ));
            return;
        }
        for corner in self.body.corners() {
            keep(disc_meets_wall(*corner, SKIN, displacement, wall));
        }
        self.touch_disc(wall.start, 0.0, displacement, keep);
        self.touch_disc(wall.end, 0.0, displacement, keep);
    }

    fn touch_disc(
        &self,
        centre: Point,
        radius: f64,
        displacement: Vector,
        keep: &mut impl FnMut(Option<Touch>),
    ) {
        if self.body.corners().is_empty() {
            let reach = self.body.radius() + radius + SKIN;
            keep(disc_meets_point(
                self.body.pose().position,
                reach,
                displacement,
                centre,
            ));
            return;
        }
        // Seen from the body, the disc comes the other way.
        for side in self.body.sides() {
            let touch = disc_meets_wall(centre, radius + SKIN, -displacement, &side);
            keep(touch.map(|touch| Touch {
                normal: -touch.normal,
                ..touch
            }));
        }
    }
}

/// When a disc on its way first comes within `radius` of a wall.
fn disc_meets_wall(centre: Point, radius: f64, displacement: Vector, wall: &Wall) -> Option<Touch> {
    let nearest = wall.nearest(centre);
    let away = centre - nearest;
    let along = wall.end - wall.start;
    let across = Vector::new(-along.y, along.x) / along.norm();
    let distance = away.norm();
    if distance <= radius {
        // Touching already: what leads away from a convex thing never meets it again.
        let normal = if distance > 0.0 {
            away / distance
        } else {
            across
        };
        return (displacement.dot(&normal) < 0.0).then_some(Touch { share: 0.0, normal });
    }
    let offset = across.dot(&(centre - wall.start));
    let normal = if offset < 0.0 { -across } else { across };
    let approach = -displacement.dot(&normal);
    let side = (approach > 0.0 && offset.abs() >= radius)
        .then(|| (offset.abs() - radius) / approach)
        .filter(|share| {
            let foot = along.dot(&(centre + displacement * *share - wall.start));
            *share <= 1.0 && foot >= 0.0 && foot <= along.norm_squared()
        })
        .map(|share| Touch { share, normal });
    let ends = [wall.start, wall.end]
        .into_iter()
        .filter_map(|end| disc_meets_point(centre, radius, displacement, end));
    ends.chain(side).min_by(|a, b| a.share.total_cmp(&b.share))
}

/// When a disc on its way first comes within `radius` of a point.
fn disc_meets_point(
    centre: Point,
    radius: f64,
    displacement: Vector,
    point: Point,
) -> Option<Touch> {
    let from_point = centre - point;
    let half_b = from_point.dot(&displacement);
    if half_b >= 0.0 {
        return None;
    }
    let square = displacement.norm_squared();
    let apart = from_point.norm_squared() - radius * radius;
    let root = half_b * half_b - square * apart;
    if root < 0.0 {
        return None;
    }
    // The stable form of the smaller root.
    let share = (apart / (root.sqrt() - half_b)).max(0.0);
    let normal = (from_point + displacement * share).try_normalize(0.0)?;
    (share <= 1.0).then_some(Touch { share, normal })
}

/// The path a body took between two poses, as wheels would count it.
pub(crate) fn motion_between(before: Pose, after: Pose) -> Motion {
    let turn = before.heading.turn_to(after.heading);
    let chord = before
        .heading
        .turned(0.5 * turn)
        .unit()
        .dot(&(after.position - before.position));
    let half = 0.5 * turn.clamp(-FRAC_PI_2, FRAC_PI_2);
    let arc = if half.abs() < 1e-9 {
        1.0
    } else {
        half / libm::sin(half)
    };
    Motion {
        distance: chord * arc,
        turn,
    }
}
