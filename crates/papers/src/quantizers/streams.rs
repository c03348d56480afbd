//! Streams of points in the plane to learn from.

use core::f64::consts::{PI, TAU};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// A point of the plane.
pub(super) type Point = [f64; 2];

/// The order of the regions of [`five_clusters`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// Each point is from a region drawn at random.
    Stationary,
    /// The regions come in turn, the sine curve in three parts.
    OneAfterAnother,
}

/// Number of regions.
pub(super) const REGIONS: u32 = 5;

/// Side of the square that holds the regions and the noise.
const SIDE: f64 = 10.0;

/// Returns the artificial data of Shen and Hasegawa 2006: two Gaussians, two concentric rings and a
/// sine curve. A share of all points is noise over the whole square. Their figure has no scales;
/// the gaps here are at least a tenth of the square.
pub(super) fn five_clusters(
    order: Order,
    noise: f64,
    points: u32,
    rng: &mut ChaCha8Rng,
) -> Vec<Point> {
    let place = |number: u32, rng: &mut ChaCha8Rng| match order {
        Order::Stationary => (rng.random_range(0..REGIONS), 0.0, 1.0),
        Order::OneAfterAnother => {
            let phase = (u64::from(number) * 7 / u64::from(points.max(1))) as u32;
            let part = f64::from(phase.saturating_sub(REGIONS - 1)) / 3.0;
            (phase.min(REGIONS - 1), part, part + 1.0 / 3.0)
        }
    };
    let point = |number| {
        if rng.random::<f64>() < noise {
            return [SIDE * rng.random::<f64>(), SIDE * rng.random::<f64>()];
        }
        let (region, from, to) = place(number, rng);
        in_region(region, from, to, rng)
    };
    (0..points).map(point).collect()
}

/// Returns a point of a region: 0 and 1 are the Gaussians, 2 and 3 the rings, 4 the sine curve.
pub(super) fn of_region(region: u32, rng: &mut ChaCha8Rng) -> Point {
    in_region(region, 0.0, 1.0, rng)
}

/// Returns a point of a region; for the sine curve, only from between two shares of its length.
fn in_region(region: u32, from: f64, to: f64, rng: &mut ChaCha8Rng) -> Point {
    match region {
        0 => gaussian([1.6, 8.2], 0.35, rng),
        1 => gaussian([1.6, 5.2], 0.35, rng),
        2 => on_ring([6.7, 6.7], 1.0, 0.15, rng),
        3 => on_ring([6.7, 6.7], 2.4, 0.15, rng),
        _ => {
            let along = from + (to - from) * rng.random::<f64>();
            let height = libm::sin(3.0 * PI * along) + spread(0.15, rng);
            [0.8 + 8.4 * along, 1.8 + height]
        }
    }
}

/// Returns a uniform random number between −`half` and `half`.
fn spread(half: f64, rng: &mut ChaCha8Rng) -> f64 {
    half * (2.0 * rng.random::<f64>() - 1.0)
}

fn gaussian(centre: Point, sd: f64, rng: &mut ChaCha8Rng) -> Point {
    // Method of Box and Muller.
    let radius = sd * libm::sqrt(-2.0 * libm::log(1.0 - rng.random::<f64>()));
    let angle = TAU * rng.random::<f64>();
    [
        centre[0] + radius * libm::cos(angle),
        centre[1] + radius * libm::sin(angle),
    ]
}

fn on_ring(centre: Point, radius: f64, half_width: f64, rng: &mut ChaCha8Rng) -> Point {
    let angle = TAU * rng.random::<f64>();
    let radius = radius + spread(half_width, rng);
    [
        centre[0] + radius * libm::cos(angle),
        centre[1] + radius * libm::sin(angle),
    ]
}

/// Returns a point of two rings and two full squares, which are common in demonstrations of GNG.
pub(super) fn rings_and_squares(rng: &mut ChaCha8Rng) -> Point {
    match rng.random_range(0..4_u32) {
        0 => on_ring([2.5, 7.5], 1.8, 0.1, rng),
        1 => on_ring([7.5, 2.5], 1.2, 0.4, rng),
        2 => [7.5 + spread(1.6, rng), 7.5 + spread(1.6, rng)],
        _ => [2.5 + spread(1.0, rng), 2.5 + spread(1.0, rng)],
    }
}

/// Brings inputs into a random order.
pub(super) fn shuffle(order: &mut [usize], rng: &mut ChaCha8Rng) {
    for end in (1..order.len()).rev() {
        order.swap(end, rng.random_range(0..=end as u32) as usize);
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    #[test]
    fn regions_keep_their_distance() {
        let mut rng = ChaCha8Rng::seed_from_u64(0);
        let points: Vec<Vec<Point>> = (0..REGIONS)
            .map(|region| (0..400).map(|_| of_region(region, &mut rng)).collect())
            .collect();
        for (region, own) in points.iter().enumerate() {
            for other in points[..region].iter().flatten() {
                for point in own {
                    let gap = libm::hypot(point[0] - other[0], point[1] - other[1]);
                    assert!(gap > 0.5, "{point:?} {other:?}");
                }
            }
        }
    }

    #[test]
    fn one_region_comes_after_the_other() {
        let mut rng = ChaCha8Rng::seed_from_u64(0);
        let points = five_clusters(Order::OneAfterAnother, 0.0, 700, &mut rng);
        assert!(
            points[..100]
                .iter()
                .all(|point| point[1] > 6.0 && point[0] < 4.0)
        );
        // The sine curve comes last, from left to right.
        for (part, third) in points[400..].chunks(100).enumerate() {
            let left = 0.8 + 2.8 * part as f64;
            assert!(
                third
                    .iter()
                    .all(|p| p[0] >= left && p[0] <= left + 2.8 + 1e-9)
            );
        }
        let noise = five_clusters(Order::Stationary, 1.0, 2000, &mut rng);
        let left = noise.iter().filter(|point| point[0] < 5.0).count();
        assert!((900..1100).contains(&left));
    }
}
