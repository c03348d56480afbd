use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Vector};
use tolman_robot::Scan;

use super::Standpoints;

/// What a robot believes of where it is: a Bayes filter over the [`Standpoints`] of its map.
#[derive(Clone, Debug)]
pub struct StandpointBelief {
    /// The probability of each standpoint.
    mass: Vec<f32>,
    /// How often in a row nothing it believes in has fitted what it saw.
    surprises: u32,
}

/// By how much a range may differ from what is seen at the nearest standpoint, m (standard deviation).
const RANGE_SD: f64 = 0.075;
/// Beyond so many standard deviations a beam met something else; how far off says no more.
const OUTLIER: f64 = 3.0;
/// Beams see the same walls, so that all of them together say no more than so many.
const INDEPENDENT_BEAMS: f64 = 8.0;
/// A better fit than that tells no more: the map's own errors are as large, and are met at every look.
const GOOD: f64 = 0.6;
/// What the map does not show fits as a place does that is not the right one, but like it.
const UNSHOWN: f64 = 2.0;
/// Standpoints less probable than that are not followed.
const NEGLIGIBLE: f32 = 1e-9;
/// What the probability of a way through a wall is worth.
const THROUGH_A_WALL: f64 = 0.01;
/// A scan fits nowhere where it is off by so much, mean square.
const SURPRISE: f64 = 3.0;
/// How likely the landmark of the goal is not sensed where the map has it: near its border.
const UNSENSED: f32 = 0.05;
/// It begins anew after so many such scans in a row.
const MOST_SURPRISES: u32 = 3;

impl StandpointBelief {
    /// Returns the belief of a robot that has no idea.
    #[must_use]
    pub fn anywhere(on: &Standpoints) -> Self {
        Self {
            mass: vec![1.0 / on.len().max(1) as f32; on.len()],
            surprises: 0,
        }
    }

    /// Returns the probability of each standpoint, by number.
    #[must_use]
    pub fn probabilities(&self) -> &[f32] {
        &self.mass
    }

    /// Returns the most probable standpoint; the first of equals.
    #[must_use]
    pub fn likeliest(&self) -> Option<u32> {
        let likelier = |best: (u32, f32), next: (u32, f32)| {
            if next.1 > best.1 { next } else { best }
        };
        let numbered = (0..).zip(self.mass.iter().copied());
        numbered.reduce(likelier).map(|(number, _)| number)
    }

    /// Returns how much of the belief lies within `radius` m of its likeliest standpoint, 0 … 1.
    #[must_use]
    pub fn certainty(&self, on: &Standpoints, radius: f64) -> f64 {
        let Some(best) = self.likeliest() else {
            return 0.0;
        };
        let Some(centre) = on.position(best) else {
            return 0.0;
        };
        let near = on.positions().zip(&self.mass);
        let near = near.filter(|(at, _): &(Point, &f32)| (at - centre).norm() <= radius);
        near.map(|(_, mass)| f64::from(*mass)).sum()
    }

    /// Follows a robot that came `moved` along the compass's axes, m, give or take `sd`. O(standpoints believed in).
    pub fn moved(&mut self, on: &Standpoints, moved: Vector, sd: Vector) {
        let ground = on.chart().ground();
        let mut after = vec![0.0; self.mass.len()];
        for (from, mass) in on.positions().zip(&self.mass) {
            if *mass < NEGLIGIBLE {
                continue;
            }
            for (offset, share) in spread(sd) {
                let to = from + moved + offset;
                let passes = if ground.sees(from, to) {
                    1.0
                } else {
                    THROUGH_A_WALL
                };
                for (number, part) in on.around(to) {
                    if let Some(number) = number {
                        after[number as usize] += mass * (share * part * passes) as f32;
                    }
                }
            }
        }
        self.mass = after;
    }

    /// Weighs what it believes by what a scan shows. O(standpoints believed in · beams · range).
    pub fn saw(&mut self, on: &Standpoints, heading: Heading, scan: &Scan) {
        let Some(north) = on.northward(scan, heading) else {
            return;
        };
        let mut best = f64::INFINITY;
        for (cell, mass) in on.cells().zip(&mut self.mass) {
            if *mass < NEGLIGIBLE {
                *mass = 0.0;
                continue;
            }
            let misfit = on.misfit(cell, &north, RANGE_SD, OUTLIER);
            best = best.min(misfit.unwrap_or(f64::INFINITY));
            let misfit = misfit.unwrap_or(UNSHOWN);
            *mass *= libm::exp(-0.5 * INDEPENDENT_BEAMS * misfit.max(GOOD)) as f32;
        }
        // Where the map shows nothing that could fit, it is as surprised.
        self.surprises = if best > SURPRISE {
            self.surprises + 1
        } else {
            0
        };
        self.normalize(on);
    }

    /// Weighs what it believes by the landmark of the goal, which the robot does not sense. O(standpoints).
    pub fn missed_the_goal(&mut self, on: &Standpoints) {
        for number in on.sensing_goal() {
            if let Some(mass) = self.mass.get_mut(*number as usize) {
                *mass *= UNSENSED;
            }
        }
        self.normalize(on);
    }

    fn normalize(&mut self, on: &Standpoints) {
        let sum: f64 = self.mass.iter().copied().map(f64::from).sum();
        if sum > 0.0 && self.surprises < MOST_SURPRISES {
            for mass in &mut self.mass {
                *mass = (f64::from(*mass) / sum) as f32;
            }
        } else {
            *self = Self::anywhere(on);
        }
    }
}

/// Where a way that is sure to `sd` may have ended, from where it should have, each with its share.
fn spread(sd: Vector) -> impl Iterator<Item = (Vector, f64)> {
    let fine = 0.5 * Standpoints::SPACING;
    let offsets = move |sd: f64| {
        let wide = sd > fine;
        let steps: &[(f64, f64)] = if wide {
            &[
                (-1.5, 0.12),
                (-0.75, 0.23),
                (0.0, 0.3),
                (0.75, 0.23),
                (1.5, 0.12),
            ]
        } else {
            &[(0.0, 1.0)]
        };
        steps.iter().map(move |(at, share)| (at * sd, *share))
    };
    offsets(sd.x)
        .flat_map(move |(x, a)| offsets(sd.y).map(move |(y, b)| (Vector::new(x, y), a * b)))
}
