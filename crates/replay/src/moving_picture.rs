//! A replay as an animated SVG.

use maud::{Markup, html};
use tolman_draw::{Figure, FloorPlan, KeyMark, Series, ZoneStyle};
use tolman_geom::Point;

use super::{Chapter, MapNode, Replay, RobotTrack, Shape, ZoneKind};

/// Number of frames per second.
const RATE: f64 = 25.0;

/// Pause after each chapter, s.
const PAUSE: f64 = 1.2;

/// Distance that takes as long as a turn by one radian, m.
const METRES_PER_RADIAN: f64 = 0.05;

/// Width of the picture, user units.
const WIDTH: f64 = 800.0;

/// Colours of the map and of the belief.
const MAP: Series = Series(0);
const BELIEF: Series = Series(3);

/// Returns the colour of the way of a chapter.
fn way_of(chapter: usize) -> Series {
    Series([1, 3, 2][chapter.min(2)])
}

/// Height for the caption below, user units.
const FOOT: f64 = 34.0;

/// Returns the first robot of a replay as an SVG that plays in a loop. It shows the robot's way,
/// its map as it grew and, after it was first lifted, its belief.
///
/// Its chapters are played in turn. Time is proportional to the driven distance, so that a slow
/// robot does not make a long animation. Nodes of the map are drawn at their last positions.
///
/// The SVG has no script and needs no network. A viewer that does not animate shows the end.
/// O(poses + map).
#[must_use]
pub fn moving_picture(replay: &Replay) -> String {
    let (scenery, chapters) = (&replay.scenery, &replay.chapters);
    let corners = scenery.zones.iter().flat_map(|zone| &zone.corners);
    let corners: Vec<Point> = corners.copied().collect();
    let mut plan = FloorPlan::of_walls_and(&scenery.walls, &corners, WIDTH);
    for zone in &replay.scenery.zones {
        let style = match zone.kind {
            ZoneKind::Destination => ZoneStyle::Destination,
            ZoneKind::Solid => ZoneStyle::Solid,
            ZoneKind::Start | ZoneKind::Region => continue,
        };
        plan.zone(&zone.corners, style);
    }
    let tracks = replay.tracks.iter();
    let mut tracks = tracks.filter(|track| !track.poses.is_empty());
    if let Some(track) = tracks.next() {
        let clock = Clock::of(track, chapters);
        let body = html! {
            (map(&plan, track, &clock))
            (ways(&plan, track, &clock))
            (beliefs(&plan, track, &clock))
            (robot(&plan, track, &clock))
        };
        plan.layer(body);
        plan.key(KeyMark::Disc, MAP, "its map");
        plan.key(KeyMark::Line, way_of(0), "its way");
        if !track.beliefs.is_empty() {
            plan.key(KeyMark::Disc, BELIEF, "where it may be");
        }
        let mut drawing = plan.drawing(format!("{}, played step by step.", replay.title));
        let captions = captions(chapters, &clock, drawing.height);
        drawing.height += FOOT;
        drawing.body = html! { (drawing.body) (captions) };
        return Figure::new("moving", &replay.title, drawing).standalone();
    }
    let drawing = plan.drawing(&replay.title);
    Figure::new("moving", &replay.title, drawing).standalone()
}

/// Steps that the frames of an animation show.
struct Clock {
    /// Step of each frame.
    steps: Vec<u32>,
    /// First frame of each chapter.
    begins: Vec<usize>,
}

impl Clock {
    fn of(track: &RobotTrack, chapters: &[Chapter]) -> Self {
        let last = track.poses.len().saturating_sub(1);
        let mut clock = Self {
            steps: Vec::new(),
            begins: Vec::new(),
        };
        for (number, chapter) in chapters.iter().enumerate() {
            let from = (chapter.from as usize).min(last);
            let next = chapters.get(number + 1).map(|next| next.from as usize);
            let to = next
                .map_or(last, |next| next.saturating_sub(1))
                .clamp(from, last);
            clock.begins.push(clock.steps.len());
            clock.play(track, from, to, chapter.seconds);
        }
        clock
    }

    /// Adds the frames for the steps `from` to `to`, which take `seconds` in all.
    fn play(&mut self, track: &RobotTrack, from: usize, to: usize, seconds: f64) {
        let mut way = vec![0.0];
        for pair in track.poses[from..=to].windows(2) {
            if let [before, after] = pair {
                let turn = before.heading.turn_to(after.heading).abs();
                let moved = (after.position - before.position).norm();
                let so_far = way.last().copied().unwrap_or(0.0);
                way.push(so_far + moved + METRES_PER_RADIAN * turn);
            }
        }
        let whole = way.last().copied().unwrap_or(0.0);
        let pictures = (seconds * RATE) as usize;
        for picture in 0..pictures {
            let at = whole * picture as f64 / pictures as f64;
            self.steps
                .push((from + way.partition_point(|way| *way < at)) as u32);
        }
        for _ in 0..(PAUSE * RATE) as usize {
            self.steps.push(to as u32);
        }
    }

    /// Returns the pictures of each chapter: its first, and the first after it.
    fn chapters(&self) -> impl Iterator<Item = (usize, usize)> {
        let ends = self.begins.iter().skip(1).copied();
        let ends = ends.chain([self.steps.len()]);
        self.begins.iter().copied().zip(ends)
    }

    /// Returns the first frame that shows `step` or a later one; the number of frames if there is
    /// none.
    fn picture(&self, step: u32) -> usize {
        self.steps.partition_point(|shown| *shown < step)
    }

    fn seconds(&self) -> String {
        format!("{:.2}s", self.steps.len() as f64 / RATE)
    }

    /// Returns the number of a frame as a share of the whole.
    fn key(&self, picture: usize) -> String {
        short(picture as f64 / self.steps.len().max(1) as f64, 4)
    }

    /// Returns the animation that shows an element only between two frames.
    fn shown(&self, from: usize, to: usize) -> Markup {
        let (mut values, mut keys) = (
            vec![if from == 0 { "1" } else { "0" }],
            vec!["0".to_owned()],
        );
        if from > 0 {
            values.push("1");
            keys.push(self.key(from));
        }
        if to < self.steps.len() {
            values.push("0");
            keys.push(self.key(to));
        }
        html! {
            animate attributeName="opacity" calcMode="discrete" values=(values.join(";"))
                keyTimes=(keys.join(";")) dur=(self.seconds()) repeatCount="indefinite" {}
        }
    }
}

/// Path data of things that appear and disappear together, by the frames between which they are
/// shown.
#[derive(Default)]
struct Fates(alloc::collections::BTreeMap<(usize, usize), String>);

impl Fates {
    fn add(&mut self, clock: &Clock, born: u32, died: Option<u32>, path: &str) {
        let from = clock.picture(born);
        let to = died.map_or(clock.steps.len(), |died| clock.picture(died));
        if from < to {
            self.0.entry((from, to)).or_default().push_str(path);
        }
    }

    fn markup(&self, clock: &Clock, width: &str) -> Markup {
        html! {
            @for ((from, to), path) in &self.0 {
                @let stays = (*to < clock.steps.len()).then_some("0");
                path d=(path) opacity=[stays] fill="none" stroke="currentColor"
                    stroke-linecap="round" stroke-width=(width)
                    { (clock.shown(*from, *to)) }
            }
        }
    }
}

fn map(plan: &FloorPlan, track: &RobotTrack, clock: &Clock) -> Markup {
    let (mut nodes, mut edges) = (Fates::default(), Fates::default());
    for map in &track.maps {
        let at = |id: u32| {
            let node = map.nodes.iter().find(|node| node.id == id);
            node.map(|node| place(plan, node.latest()))
        };
        for node in &map.nodes {
            let dot = format!("M{}h0", place(plan, node.latest()));
            nodes.add(clock, node.born, node.died, &dot);
        }
        for edge in &map.edges {
            if let (Some(a), Some(b)) = (at(edge.a), at(edge.b)) {
                let corners = edge.way.iter().map(|corner| place(plan, *corner));
                let corners: Vec<String> = corners.chain([b]).collect();
                let path = format!("M{a}L{}", corners.join("L"));
                edges.add(clock, edge.born, edge.died, &path);
            }
        }
    }
    html! {
        g class=(MAP.class()) {
            g stroke-opacity="0.55" { (edges.markup(clock, "2")) }
            (nodes.markup(clock, "8"))
        }
    }
}

/// Returns the way of each chapter, drawn as it is driven.
fn ways(plan: &FloorPlan, track: &RobotTrack, clock: &Clock) -> Markup {
    let chapters = clock.chapters().enumerate();
    html! {
        @for (number, (from, to)) in chapters {
            @let steps = &clock.steps[from..to];
            @let at = |step: &u32| plan.at(track.poses[*step as usize].position);
            @let points: Vec<(f64, f64)> = steps.iter().map(at).collect();
            @let path: Vec<String> = points.iter().map(|at| pair(*at)).collect();
            g class=(way_of(number).class()) {
                path d={ "M" (path.join("L")) } fill="none" stroke="currentColor"
                    stroke-width=(if number == 0 { "1.6" } else { "3.5" })
                    stroke-opacity=(if number == 0 { "0.35" } else { "0.9" })
                    stroke-linejoin="round" pathLength="1" stroke-dasharray="1 1"
                {
                    (drawn(&points, from, clock))
                }
            }
        }
    }
}

/// Returns a line that grows as it is driven.
fn drawn(points: &[(f64, f64)], from: usize, clock: &Clock) -> Markup {
    let mut so_far = vec![0.0];
    for pair in points.windows(2) {
        if let [(x, y), (next_x, next_y)] = *pair {
            let before = so_far.last().copied().unwrap_or(0.0);
            so_far.push(before + libm::hypot(next_x - x, next_y - y));
        }
    }
    let whole = so_far.last().copied().filter(|whole| *whole > 0.0);
    let left = |way: &f64| short(1.0 - way / whole.unwrap_or(1.0), 3);
    let before = core::iter::repeat_n("1".to_owned(), from);
    let after = clock.steps.len() - from - points.len();
    let after = core::iter::repeat_n("0".to_owned(), after);
    let values: Vec<String> = before.chain(so_far.iter().map(left)).chain(after).collect();
    html! {
        animate attributeName="stroke-dashoffset" values=(values.join(";"))
            dur=(clock.seconds()) repeatCount="indefinite" {}
    }
}

/// Returns the believed positions since the robot was first lifted.
fn beliefs(plan: &FloorPlan, track: &RobotTrack, clock: &Clock) -> Markup {
    let Some(lifted) = track.lifts.first() else {
        return html! {};
    };
    let entries = track.beliefs.iter().flat_map(|belief| {
        let ends = belief.entries.iter().skip(1).map(|next| Some(next.step));
        belief.entries.iter().zip(ends.chain([None]))
    });
    let entries = entries.filter_map(|(entry, end)| {
        let from = clock.picture(entry.step.max(*lifted));
        let to = end.map_or(clock.steps.len(), |end| clock.picture(end));
        (from < to).then_some((entry, from, to))
    });
    let latest = |id| track.node(id).map(MapNode::latest);
    let middle = |shape: &Shape| shape.middle(latest);
    html! {
        g class=(BELIEF.class()) fill="currentColor" {
            @for (entry, from, to) in entries {
                g opacity="0" {
                    @for (position, weight) in entry.shapes.iter().filter_map(middle) {
                        @let (x, y) = plan.at(position);
                        circle cx=(short(x, 1)) cy=(short(y, 1))
                            r=(short(6.0 + 12.0 * libm::sqrt(weight), 1))
                            fill-opacity=(short(0.2 + 0.6 * weight, 2)) {}
                    }
                    (clock.shown(from, to))
                }
            }
        }
    }
}

fn robot(plan: &FloorPlan, track: &RobotTrack, clock: &Clock) -> Markup {
    let poses: Vec<_> = clock
        .steps
        .iter()
        .map(|step| track.poses[*step as usize])
        .collect();
    let Some(last) = poses.last() else {
        return html! {};
    };
    let places: Vec<String> = poses
        .iter()
        .map(|pose| place(plan, pose.position))
        .collect();
    // Counter-clockwise in the world is clockwise where y grows downwards. Every turn takes the
    // short way.
    let mut angle = -poses[0].heading.degrees();
    let mut angles = vec![short(angle, 0)];
    for pair in poses.windows(2) {
        if let [before, after] = pair {
            angle -= before.heading.turn_to(after.heading).to_degrees();
            angles.push(short(angle, 0));
        }
    }
    html! {
        g transform={ "translate(" (place(plan, last.position)) ")" } {
            animateTransform attributeName="transform" type="translate" values=(places.join(";"))
                dur=(clock.seconds()) repeatCount="indefinite" {}
            g transform={ "rotate(" (short(angle, 0)) ")" } {
                animateTransform attributeName="transform" type="rotate" values=(angles.join(";"))
                    dur=(clock.seconds()) repeatCount="indefinite" {}
                path class="robot" d="M11 0L-8 8L-4 0L-8 -8Z" stroke-width="1.5"
                    style="stroke: var(--page)" {}
            }
        }
    }
}

fn captions(chapters: &[Chapter], clock: &Clock, height: f64) -> Markup {
    html! {
        @for (chapter, (from, to)) in chapters.iter().zip(clock.chapters()) {
            @let hidden = (to < clock.steps.len()).then_some("0");
            text x=(short(0.5 * WIDTH, 0)) y=(short(height + 0.6 * FOOT, 1)) text-anchor="middle"
                font-size="17" opacity=[hidden]
            {
                (chapter.caption)
                (clock.shown(from, to))
            }
        }
    }
}

fn place(plan: &FloorPlan, position: Point) -> String {
    pair(plan.at(position))
}

fn pair((x, y): (f64, f64)) -> String {
    format!("{} {}", short(x, 1), short(y, 1))
}

/// Returns a number with at most `decimals` decimals.
fn short(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    match text {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Pose};
    use tolman_robot::Body;

    use super::*;
    use crate::{BeliefAt, MapGrowth, MapNode, Scenery};

    /// Returns the replay of a robot that drives 4 m east, is put back, and drives 1 m of it again.
    fn replay() -> Replay {
        let steps = (0..=4).chain(0..=1);
        let poses = steps.map(|x| Pose::new(Point::new(f64::from(x), 0.5), Heading::EAST));
        let mut track = RobotTrack::new("r", Body::Circle { radius: 0.1 }, poses.collect());
        track.lifts = vec![5];
        let node = |id, born| MapNode::new(id, Point::new(f64::from(id), 0.5), born);
        track.maps = vec![MapGrowth {
            name: "map".to_owned(),
            nodes: vec![node(0, 0), node(4, 4)],
            edges: vec![crate::MapEdge::new(0, 4, 4)],
        }];
        let shapes = vec![Shape::Node { id: 4, weight: 1.0 }];
        track.beliefs = vec![crate::Belief {
            name: "belief".to_owned(),
            entries: [2, 5]
                .map(|step| BeliefAt {
                    step,
                    shapes: shapes.clone(),
                })
                .into(),
        }];
        let scenery = Scenery {
            walls: vec![[Point::new(0.0, 0.0), Point::new(5.0, 1.0)]],
            ..Scenery::default()
        };
        let mut replay = Replay::new("Twice", 0.1, scenery, vec![track]);
        let chapter = |from, caption: &str| Chapter {
            from,
            caption: caption.to_owned(),
            seconds: 2.0,
        };
        replay.chapters = vec![chapter(0, "away"), chapter(5, "again")];
        replay
    }

    #[test]
    fn time_passes_as_the_robot_gets_on() {
        let replay = replay();
        let clock = Clock::of(&replay.tracks[0], &replay.chapters);
        assert_eq!(clock.steps.len(), 2 * (50 + 30));
        assert!(clock.steps.is_sorted());
        // Half of the first chapter's time shows half of its way.
        assert_eq!(clock.steps[25], 2);
        assert_eq!((clock.steps[79], clock.begins[1]), (4, 80));
        assert_eq!((clock.steps[80], clock.steps[159]), (5, 6));
    }

    #[test]
    fn maps_grow_and_beliefs_are_shown_once_the_robot_was_lifted() {
        let svg = moving_picture(&replay());
        assert!(svg.contains(">away<") && svg.contains(">again<"));
        // Of the two beliefs, the one before the robot was lifted is not shown.
        // Two discs are in the key.
        assert_eq!(svg.matches("<circle").count(), 2 + 1);
        // The second node and the link appear together.
        let born = "keyTimes=\"0;0.2375\"";
        assert_eq!(svg.matches(born).count(), 2, "{svg}");
    }

    #[test]
    fn nothing_to_show_is_an_empty_plan() {
        let replay = Replay::new("Nothing", 0.1, Scenery::default(), Vec::new());
        assert!(moving_picture(&replay).starts_with("<svg"));
        let mut still = self::replay();
        still.tracks[0].poses.truncate(1);
        assert!(moving_picture(&still).contains(">away<"));
        still.tracks[0].poses.clear();
        assert!(moving_picture(&still).starts_with("<svg"));
    }
}
