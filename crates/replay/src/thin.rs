//! Replays of long runs with fewer steps.

use super::{Replay, RobotTrack};

impl Replay {
    /// Returns the replay with at most `most` steps, each as long as several of the run's if it has
    /// more. What happened in between happens at the next step that is kept.
    #[must_use]
    pub fn thinned(mut self, most: usize) -> Self {
        let every = self.steps().div_ceil(most.max(1)).max(1);
        if every == 1 {
            return self;
        }
        self.step_s *= every as f64;
        let step = |step: &mut u32| *step = step.div_ceil(every as u32);
        self.chapters
            .iter_mut()
            .for_each(|chapter| step(&mut chapter.from));
        for door in &mut self.scenery.doors {
            door.changes
                .iter_mut()
                .for_each(|change| step(&mut change.step));
            keep_last(&mut door.changes, |change| change.step);
        }
        let marks = self.marks.iter_mut();
        let of_tracks = self.tracks.iter_mut().flat_map(|track| &mut track.marks);
        for marks in marks.chain(of_tracks) {
            marks.steps.iter_mut().for_each(step);
            marks.steps.dedup();
        }
        self.tracks
            .iter_mut()
            .for_each(|track| thin(track, every, step));
        self
    }
}

fn thin(track: &mut RobotTrack, every: usize, step: impl Fn(&mut u32) + Copy) {
    let last = track.poses.len().saturating_sub(1);
    let kept = 0..=last.div_ceil(every);
    let poses = kept.filter_map(|kept| track.poses.get((kept * every).min(last)).copied());
    track.poses = poses.collect();
    track.lifts.iter_mut().for_each(step);
    track.lifts.dedup();
    if let Some(scans) = &mut track.scans {
        scans.steps.iter_mut().for_each(step);
        let mut read: Vec<_> = scans.steps.drain(..).zip(scans.ranges.drain(..)).collect();
        keep_last(&mut read, |(step, _)| *step);
        (scans.steps, scans.ranges) = read.into_iter().unzip();
    }
    for map in &mut track.maps {
        for node in &mut map.nodes {
            let died = node.died.as_mut();
            died.into_iter().chain([&mut node.born]).for_each(step);
            node.visits.iter_mut().for_each(step);
            node.visits.dedup();
            node.moves
                .iter_mut()
                .for_each(|moved| step(&mut moved.step));
            keep_last(&mut node.moves, |moved| moved.step);
            node.labels
                .iter_mut()
                .for_each(|label| step(&mut label.step));
            keep_last(&mut node.labels, |label| label.step);
        }
        map.edges.iter_mut().for_each(|edge| {
            let died = edge.died.as_mut();
            died.into_iter().chain([&mut edge.born]).for_each(step);
        });
        map.edges
            .retain(|edge| edge.died.is_none_or(|died| edge.born < died));
    }
    for belief in &mut track.beliefs {
        belief
            .entries
            .iter_mut()
            .for_each(|entry| step(&mut entry.step));
        keep_last(&mut belief.entries, |entry| entry.step);
    }
    for field in &mut track.fields {
        field
            .changes
            .iter_mut()
            .for_each(|change| step(&mut change.step));
    }
    for series in &mut track.series {
        series
            .samples
            .iter_mut()
            .for_each(|sample| step(&mut sample.step));
        keep_last(&mut series.samples, |sample| sample.step);
    }
    for notes in &mut track.notes {
        notes.notes.iter_mut().for_each(|note| step(&mut note.step));
        keep_last(&mut notes.notes, |note| note.step);
    }
}

/// Removes all things but the last of each step.
fn keep_last<T>(things: &mut Vec<T>, step: impl Fn(&T) -> u32) {
    things.reverse();
    things.dedup_by_key(|thing| step(thing));
    things.reverse();
}
