//! Bodies that move until they touch.
//!
//! A step's arc is followed along chords of at most a tenth of a radian. Each chord is swept as a
//! whole, so nothing is passed through however long a step is.

use core::f64::consts::FRAC_PI_2;

use tolman_geom::{Point, Pose, Vector};

use crate::scene::{Crowd, Disc, Placed, Scene};
use crate::{Motion, WallSegment, World};

/// Behaviour where a body meets something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Contact {
    /// The robot stops where it touched something. A disc still turns.
    Stop,
    /// The robot slides along what it touched for the rest of its path.
    Slide,
}

/// Gap that bodies keep, m: more than the rounding of a step, less than any sensor detects.
const SKIN: f64 = 1e-6;

/// Shortening of a motion below which it met nothing, m: the rounding of a slide.
const CUT: f64 = 1e-12;

/// Maximum turn along one chord, rad.
const CHORD_TURN: f64 = 0.1;
/// Maximum number of chords of one motion, so that a step ends however large a disturbance's turn
/// is.
const MOST_CHORDS: f64 = 10_000.0;

/// Returns whether `body` overlaps no wall of `world` and none of the doors that are `shut`.
pub(crate) fn is_clear(world: &World, shut: &[WallSegment], body: &Placed) -> bool {
    let clear = |walls: &[WallSegment]| walls.iter().all(|wall| gap_to_wall(body, wall) > 0.0);
    let mut all_clear = clear(shut);
    world
        .index()
        .near(body.pose().position, body.radius(), |walls| {
            all_clear &= clear(walls);
        });
    all_clear
}

/// Returns the distance between a body and a wall, m; 0 or less where they overlap.
pub(crate) fn gap_to_wall(body: &Placed, wall: &WallSegment) -> f64 {
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

/// Returns the distance between a body and a disc, m; 0 or less where they overlap.
fn gap_to_disc(body: &Placed, centre: Point, radius: f64) -> f64 {
    if body.corners().is_empty() {
        return (body.pose().position - centre).norm() - body.radius() - radius;
    }
    if body.encloses(centre) {
        return 0.0;
    }
    body.sides()
        .map(|side| side.distance(centre))
        .fold(f64::INFINITY, f64::min)
        - radius
}

/// Returns whether two bodies overlap.
pub(crate) fn overlap(a: &Placed, b: &Placed) -> bool {
    match (a.corners(), b.corners()) {
        (_, []) => gap_to_disc(a, b.pose().position, b.radius()) <= 0.0,
        ([], _) => overlap(b, a),
        ([corner, ..], _) => {
            b.encloses(*corner) || b.sides().any(|side| gap_to_wall(a, &side) <= 0.0)
        }
    }
}

fn crosses(a: &WallSegment, b: &WallSegment) -> bool {
    let side = |of: &WallSegment, point: Point| (of.end - of.start).perp(&(point - of.start));
    let apart = |(a, b): (f64, f64), (c, d): (f64, f64)| a.max(b) < c.min(d) || c.max(d) < a.min(b);
    // Of walls in one line no end is on any side.
    let in_reach = !apart((a.start.x, a.end.x), (b.start.x, b.end.x))
        && !apart((a.start.y, a.end.y), (b.start.y, b.end.y));
    in_reach && side(a, b.start) * side(a, b.end) <= 0.0 && side(b, a.start) * side(b, a.end) <= 0.0
}

/// Obstacles that a body may meet in one step. Kept between steps for the memory.
#[derive(Debug, Default)]
pub(crate) struct Obstacles {
    /// Walls, shut doors and the sides of polygons.
    walls: Vec<WallSegment>,
    /// Other robots: centre and radius.
    discs: Vec<Disc>,
}

impl Obstacles {
    fn gather(&mut self, scene: &Scene<'_>, robot: usize, position: Point, reach: f64) {
        self.walls.clear();
        self.discs.clear();
        let near = |wall: &&WallSegment| wall.distance(position) <= reach;
        scene.world.index().near(position, reach, |walls| {
            self.walls.extend(walls.iter().filter(near));
        });
        self.walls.extend(scene.shut.iter().filter(near));
        for other in scene.bodies.near(robot, position, reach) {
            if other.corners().is_empty() {
                self.discs.push(other.disc());
            } else {
                self.walls.extend(other.sides());
            }
        }
    }

    fn is_empty(&self) -> bool {
        self.walls.is_empty() && self.discs.is_empty()
    }

    /// Returns the gap between `body` and the nearest obstacle, m.
    fn gap(&self, body: &Placed) -> f64 {
        let walls = self.walls.iter().map(|wall| gap_to_wall(body, wall));
        let discs = self
            .discs
            .iter()
            .map(|(centre, radius)| gap_to_disc(body, *centre, *radius));
        walls.chain(discs).fold(f64::INFINITY, f64::min)
    }
}

/// Moves the body of robot `robot` until it has carried out `motion` or met something. Returns
/// whether the motion was cut.
pub(crate) fn advance(
    world: &World,
    shut: &[WallSegment],
    bodies: &mut Crowd,
    robot: usize,
    motion: Motion,
    contact: Contact,
    obstacles: &mut Obstacles,
) -> bool {
    let start = bodies.body(robot).pose();
    let reach = bodies.body(robot).radius() + motion.distance.abs() + 2.0 * SKIN;
    obstacles.gather(
        &Scene {
            world,
            shut,
            bodies,
        },
        robot,
        start.position,
        reach,
    );
    bodies.change(robot, |body| {
        let free = start.displaced(motion.distance, motion.turn);
        let bump = !obstacles.is_empty() && follow(body, obstacles, motion, contact) > CUT;
        if !bump {
            body.move_to(free);
        }
        bump
    })
}

/// Moves a body along an arc as far as the obstacles let it. Returns the missing length, m.
fn follow(body: &mut Placed, obstacles: &Obstacles, motion: Motion, contact: Contact) -> f64 {
    let start = body.pose();
    let chords = (motion.turn.abs() / CHORD_TURN)
        .ceil()
        .clamp(1.0, MOST_CHORDS);
    let along = |chord: u32| {
        let share = f64::from(chord) / chords;
        start
            .displaced(motion.distance * share, motion.turn * share)
            .position
    };
    let half_turn = 0.5 * motion.turn / chords;
    let mut mover = Mover {
        body,
        obstacles,
        cut: 0.0,
    };
    let mut met = false;
    for chord in 0..chords as u32 {
        mover.turn(half_turn);
        if !(met && contact == Contact::Stop) {
            met |= mover.translate(along(chord + 1) - along(chord), contact);
        }
        mover.turn(half_turn);
    }
    mover.cut
}

/// A touch: the share of a displacement before it, and the unit normal away from the touched thing.
#[derive(Clone, Copy)]
struct Touch {
    share: f64,
    normal: Vector,
}

struct Mover<'a> {
    body: &'a mut Placed,
    obstacles: &'a Obstacles,
    /// Length of the motion that was not carried out, m.
    cut: f64,
}

impl Mover<'_> {
    /// Turns in place as far as possible, by a small angle: every point goes along the chord of its
    /// arc.
    fn turn(&mut self, turn: f64) {
        let pose = self.body.pose();
        let turned = |share: f64| Pose::new(pose.position, pose.heading.turned(share * turn));
        if self.body.corners().is_empty() {
            self.body.move_to(turned(1.0));
            return;
        }
        let free = self.first_touch_turning(turn);
        self.body.move_to(turned(free));
        if free < 1.0 || self.obstacles.gap(self.body) <= 0.0 {
            // Between the chords and the arcs lies less than a millimetre; halve it.
            let (mut clear, mut blocked) = (0.0, free);
            for _ in 0..24 {
                let middle = 0.5 * (clear + blocked);
                self.body.move_to(turned(middle));
                if self.obstacles.gap(self.body) > 0.5 * SKIN {
                    clear = middle;
                } else {
                    blocked = middle;
                }
            }
            self.body.move_to(turned(clear));
            self.cut += (1.0 - clear) * turn.abs() * self.body.radius();
        }
    }

    /// Returns the share of a small turn after which a polygon first touches something, at most 1.
    fn first_touch_turning(&self, turn: f64) -> f64 {
        let pivot = self.body.pose().position;
        let (sin, cos) = libm::sincos(turn);
        // The chord of a point that turns about the pivot.
        let chord = |point: Point, sin: f64| {
            let arm = point - pivot;
            Vector::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y) - arm
        };
        let mut free: f64 = 1.0;
        let mut keep =
            |touch: Option<Touch>| free = free.min(touch.map_or(1.0, |touch| touch.share));
        for wall in &self.obstacles.walls {
            for corner in self.body.corners() {
                keep(disc_meets_wall(*corner, SKIN, chord(*corner, sin), wall));
            }
            for side in self.body.sides() {
                for end in [wall.start, wall.end] {
                    keep(disc_meets_wall(end, SKIN, chord(end, -sin), &side));
                }
            }
        }
        for (centre, radius) in &self.obstacles.discs {
            for side in self.body.sides() {
                keep(disc_meets_wall(
                    *centre,
                    radius + SKIN,
                    chord(*centre, -sin),
                    &side,
                ));
            }
        }
        free
    }

    /// Moves by `displacement` as far as possible, and returns whether it met something.
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

    /// Moves the body, unless rounding would let it overlap something. Its old pose is clear.
    fn advance(&mut self, displacement: Vector) -> bool {
        let before = self.body.pose();
        self.body
            .move_to(Pose::new(before.position + displacement, before.heading));
        let clear = self.obstacles.gap(self.body) > 0.0;
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
        for (centre, radius) in &self.obstacles.discs {
            self.touch_disc(*centre, *radius, displacement, &mut keep);
        }
        first
    }

    fn touch_wall(
        &self,
        wall: &WallSegment,
        displacement: Vector,
        keep: &mut impl FnMut(Option<Touch>),
    ) {
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

/// Returns the first touch of a disc on its way with a wall, at distance `radius`; `None` if it
/// stays farther off.
fn disc_meets_wall(
    centre: Point,
    radius: f64,
    displacement: Vector,
    wall: &WallSegment,
) -> Option<Touch> {
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
    // Rounding may find the side of the wall a little nearer than its nearest point.
    let side = (approach > 0.0)
        .then(|| (offset.abs() - radius).max(0.0) / approach)
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

/// Returns the first touch of a disc on its way with a point, at distance `radius`; `None` if it
/// stays farther off.
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

/// Returns the path a body took between two poses, as wheels would count it.
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
