use alloc::vec::Vec;

use tolman_robot::{Sounding, Soundings};

/// Number of readings over which the mean is taken. Paper: 3.
const READINGS: usize = 3;

/// The mean of the last three readings of each range sensor (section 3.2), or of as many as there
/// were.
#[derive(Clone, Debug, Default)]
pub struct RunningMean {
    sensors: Vec<Recent>,
}

/// The last readings of one sensor.
#[derive(Clone, Debug)]
struct Recent {
    latest: Sounding,
    /// Last ranges of the sensor, m, in a ring buffer.
    ranges: [f64; READINGS],
    /// Number of readings taken in so far.
    count: usize,
}

impl RunningMean {
    /// Takes in the readings of a time step. After a drop-out, the earlier readings remain.
    pub fn take_in(&mut self, sensing: &impl Soundings) {
        for (index, sounding) in sensing.soundings().enumerate() {
            match self.sensors.get_mut(index) {
                Some(recent) => recent.take_in(sounding),
                None => self.sensors.push(Recent::new(sounding)),
            }
        }
    }

    /// Returns each sensor with the mean of its last readings as its range.
    pub fn means(&self) -> impl Iterator<Item = Sounding> + '_ {
        self.sensors.iter().map(Recent::mean)
    }
}

impl Recent {
    fn new(sounding: Sounding) -> Self {
        Self {
            latest: sounding,
            ranges: [sounding.range; READINGS],
            count: 1,
        }
    }

    fn take_in(&mut self, sounding: Sounding) {
        self.latest = sounding;
        self.ranges[self.count % READINGS] = sounding.range;
        self.count += 1;
    }

    fn mean(&self) -> Sounding {
        let taken = &self.ranges[..self.count.min(READINGS)];
        Sounding {
            range: taken.iter().sum::<f64>() / taken.len() as f64,
            ..self.latest
        }
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use tolman_robot::pioneer_2dx::Pioneer2dxSensing;

    use super::*;

    fn reading(range: Option<f64>) -> Pioneer2dxSensing {
        Pioneer2dxSensing {
            sonars: range.map(|range| [range; 16]),
            ..Pioneer2dxSensing::SILENT
        }
    }

    #[test]
    fn the_last_three_readings_count_and_drop_outs_do_not() {
        let mut mean = RunningMean::default();
        assert_eq!(mean.means().count(), 0);
        for (range, expect) in [
            (Some(4.0), 4.0),
            (None, 4.0),
            (Some(2.0), 3.0),
            (Some(3.0), 3.0),
            (Some(1.0), 2.0),
            (Some(2.0), 2.0),
        ] {
            mean.take_in(&reading(range));
            let means: Vec<Sounding> = mean.means().collect();
            assert_eq!(means.len(), 16);
            assert!((means[5].range - expect).abs() < 1e-12, "{range:?}");
        }
    }
}
