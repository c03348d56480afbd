use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Vector};
use tolman_robot::Scan;

use super::Standpoints;
use super::evidence::{Evidence, Explanation};

/// Belief of a robot about its position: a Bayes filter over the [`Standpoints`] of its map.
#[derive(Clone, Debug)]
pub struct StandpointBelief {
    /// Probability of each standpoint.
    mass: Vec<f32>,
    /// Number of consecutive scans that nothing explained.
    surprises: u32,
}

/// Probability below which standpoints are not followed.
const NEGLIGIBLE: f32 = 1e-9;
/// Factor on the probability of a move through a wall.
const THROUGH_A_WALL: f64 = 0.01;
/// Likelihood of a look under the belief below which the look is suspect.
const SUSPECT: f64 = 1e-3;
/// Probability, at each look, that the robot was lifted since the look before.
const LIFTED: f64 = 1e-7;
/// Probability, at each look, that a wall in sight is newer than the map.
const NEW_WALLS: f64 = 1e-2;
/// Minimum share of the belief near the likeliest standpoint at which the robot is sure of its
/// place.
const SURE: f64 = 0.9;
const SURE_WITHIN: f64 = 0.5;
/// Probability that the goal's landmark is not sensed where the map has it, which happens near its
/// border.
const UNSENSED: f32 = 0.05;
/// Number of unexplained scans in a row after which the belief starts again.
const MOST_SURPRISES: u32 = 3;

impl StandpointBelief {
    /// Returns a uniform belief.
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

    /// Returns the most probable standpoint. Of equally probable ones, it is the first.
    #[must_use]
    pub fn likeliest(&self) -> Option<u32> {
        let likelier = |best: (u32, f32), next: (u32, f32)| {
            if next.1 > best.1 { next } else { best }
        };
        let numbered = (0..).zip(self.mass.iter().copied());
        numbered.reduce(likelier).map(|(number, _)| number)
    }

    /// Returns the share of the belief within `radius` m of its likeliest standpoint, 0 to 1.
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

    /// Returns the same belief on other standpoints, near those for which it was made, `on`.
    /// O(standpoints · log standpoints).
    #[must_use]
    pub fn carried_over(&self, on: &Standpoints, to: &Standpoints) -> Self {
        let mut carried = Self {
            mass: vec![0.0; to.len()],
            surprises: self.surprises,
        };
        for (position, mass) in on.positions().zip(&self.mass) {
            if let Some(number) = to.at(position) {
                carried.mass[number as usize] += mass;
            }
        }
        carried.normalize(to);
        carried
    }

    /// Moves the belief by `moved` along the compass's axes, m, with standard deviations `sd`.
    /// O(standpoints believed in).
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

    /// Weighs the belief by a scan and returns its best explanation. If nothing believed fits, it
    /// also considers walls that are newer than the map, and being lifted.
    ///
    /// O(standpoints believed in · beams · range); O(standpoints · beams · range) if nothing fits.
    pub fn saw(&mut self, on: &Standpoints, heading: Heading, scan: &Scan) -> Explanation {
        let Some(north) = on.northward(scan, heading) else {
            return Explanation::AsKnown;
        };
        for mass in &mut self.mass {
            if *mass < NEGLIGIBLE {
                *mass = 0.0;
            }
        }
        let before = self.clone();
        let mut evidence = Evidence::default();
        let believed = on.cells().zip(&mut self.mass);
        for (cell, mass) in believed.filter(|(_, mass)| **mass > 0.0) {
            let misfit = on.misfit(cell, &north);
            *mass *= misfit.likelihood() as f32;
            evidence.as_known += f64::from(*mass);
            evidence.see(misfit);
        }
        if evidence.as_known < SUSPECT {
            self.doubt(on, &north, &before, &mut evidence);
        }
        self.surprises = if evidence.fits_somewhere() {
            0
        } else {
            self.surprises + 1
        };
        self.normalize(on);
        evidence.explanation()
    }

    /// Adds the explanations by new walls and by being lifted. `before` is the belief before the
    /// scan.
    fn doubt(&mut self, on: &Standpoints, north: &[f64], before: &Self, evidence: &mut Evidence) {
        let anywhere = LIFTED / on.len().max(1) as f64;
        // A robot that is not sure of its position cannot decide whether a wall is new.
        let new_walls = match before.certainty(on, SURE_WITHIN) > SURE {
            true => NEW_WALLS,
            false => 0.0,
        };
        for ((cell, mass), before) in on.cells().zip(&mut self.mass).zip(&before.mass) {
            let misfit = on.misfit(cell, north);
            let lifted = anywhere * misfit.likelihood();
            let new_walls = new_walls * f64::from(*before) * misfit.likelihood_with_new_walls();
            *mass += (lifted + new_walls) as f32;
            evidence.lifted += lifted;
            evidence.new_walls += new_walls;
            evidence.see(misfit);
        }
    }

    /// Weighs the belief by the goal's landmark, which the robot does not sense. O(standpoints).
    pub fn missed_the_goal(&mut self, on: &Standpoints) {
        for number in on.sensing_goal() {
            if let Some(mass) = self.mass.get_mut(*number as usize) {
                *mass *= UNSENSED;
            }
        }
        self.normalize(on);
    }

    /// Weighs the belief by the goal's landmark, which the robot senses. O(standpoints).
    pub fn sensed_the_goal(&mut self, on: &Standpoints) {
        let senses = |number: &u32| {
            on.goals().binary_search(number).is_ok()
                || on.sensing_goal().binary_search(number).is_ok()
        };
        for (number, mass) in (0..).zip(&mut self.mass) {
            if !senses(&number) {
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

/// Returns the errors of a way with standard deviations `sd`, m, each with its probability.
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
