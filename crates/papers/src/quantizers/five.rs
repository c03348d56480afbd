//! Two Gaussians, two rings and a sine curve in noise: how often SOINN finds five clusters.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_quantizers::{Quantizer, SecondLayerConfig, Soinn, SoinnConfig};

use super::streams::{self, Order, Point, REGIONS};
use tolman_experiment::{BoxError, Fields, Job, Metric, Record, Row, Table, record, require};

/// Name of the table with the paper's own experiment; further ones vary it.
pub(super) const NAME: &str = "five clusters";
pub(super) const ONE_AFTER_ANOTHER: &str = "five clusters, one region after another";
const OTHER_STREAMS: &str = "five clusters, other streams";

/// Row with the paper's parameters, its text taken literally.
pub(super) const LITERAL: &str = "SOINN literal";
/// Row with the documented choice of parameters.
pub(super) const CHOSEN: &str = "SOINN";

/// Number of points and share of noise in the paper.
const POINTS: u32 = 100_000;
const NOISE: f64 = 0.1;

/// Variants of the paper's stream: the row, the order of the regions, the share of noise, the
/// number of points.
const STREAMS: [(&str, Order, f64, u32); 6] = [
    ("no noise", Order::Stationary, 0.0, POINTS),
    ("5 % noise", Order::Stationary, 0.05, POINTS),
    ("20 % noise", Order::Stationary, 0.2, POINTS),
    (IN_TURN, Order::OneAfterAnother, 0.2, POINTS),
    ("30,000 points", Order::Stationary, NOISE, 30_000),
    ("300,000 points", Order::Stationary, NOISE, 300_000),
];

const IN_TURN: &str = "20 % noise, one region after another";

/// Number of points of each region that are compared with the clusters.
const PROBES: u32 = 200;

pub(super) fn tables() -> Vec<Table> {
    let rows = [LITERAL, CHOSEN].map(Row::new);
    vec![
        measured(NAME, "Five clusters in 10 % noise, points drawn from all")
        .rows(rows.clone())
        .note(format!(
            "{POINTS} points per run. A run is right if the points of each region, except for 5 %, \
             are in a cluster of their own. SOINN literal: Shen and Hasegawa 2006, λ = age_dead = \
             100, c = 1, second layer's threshold by algorithm 3.3. SOINN: units judged by their age \
             and age_dead = 20 in the first layer; in the second, λ = 500 and a threshold of four \
             mean edges of the first layer."
        )),
        measured(
            ONE_AFTER_ANOTHER,
            "The same, one region after another, in seven phases",
        )
        .rows(rows),
        measured(OTHER_STREAMS, "Five clusters in other streams")
            .rows(STREAMS.map(|(row, ..)| Row::new(row)))
            .note("The same SOINN; the row says what differs from the first table."),
    ]
}

record! {
    /// A SOINN of two layers and its result.
    #[check(FiveRun::relations)]
    struct FiveRun {
        /// Whether the second layer has five clusters.
        five: bool => higher("five clusters"),
        /// Whether each of these holds the points of one region, except for 5 %.
        right: bool => higher("each cluster in its region"),
        /// Number of clusters of the second layer.
        clusters: usize => neither("clusters").decimals(1),
        /// Number of units of the second layer.
        units: usize => neither("units").decimals(0),
        /// Number of clusters of the first layer.
        first_clusters: usize => neither("clusters, first layer").decimals(1),
        /// Number of units of the first layer.
        first_units: usize => neither("units, first layer").decimals(0),
    }
}

impl FiveRun {
    fn relations(&self) -> Result<(), String> {
        let is_five = self.clusters == REGIONS as usize;
        require(
            self.five == is_five,
            "five is not whether there are five clusters",
        )?;
        require(
            self.five || !self.right,
            "a run that is right has five clusters",
        )
    }
}

fn measured(name: &str, title: &str) -> Table {
    Table::of::<FiveRun>(name, title)
        .metric(Metric::count_of("five_of_twenty", FiveRun::five, 20))
        .metric(Metric::count_of("right_of_twenty", FiveRun::right, 20))
        .metrics_from(FiveRun::clusters)
}

/// Networks of one run.
pub(super) struct Learned {
    pub(super) data: Vec<Point>,
    pub(super) first: Soinn<f64>,
    pub(super) second: Soinn<f64>,
}

/// Returns whether the table belongs here.
pub(super) fn has(table: &str) -> bool {
    [NAME, ONE_AFTER_ANOTHER, OTHER_STREAMS].contains(&table)
}

pub(super) fn learn(job: &Job<'_>) -> Result<Learned, BoxError> {
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    let other = STREAMS.into_iter().find(|(row, ..)| *row == job.row);
    let (order, noise, points) = match (job.table, other) {
        (ONE_AFTER_ANOTHER, _) => (Order::OneAfterAnother, NOISE, POINTS),
        (OTHER_STREAMS, Some((_, order, noise, points))) => (order, noise, points),
        _ => (Order::Stationary, NOISE, POINTS),
    };
    let data = streams::five_clusters(order, noise, points, &mut rng);
    let (config, second) = match job.row {
        LITERAL => (
            SoinnConfig::shen_hasegawa(),
            SecondLayerConfig::shen_hasegawa(),
        ),
        _ => (SoinnConfig::noisy(), SecondLayerConfig::noisy()),
    };
    let mut first = Soinn::new(2, config)?;
    for point in &data {
        first.observe(point)?;
    }
    first.remove_noise();
    let second = first.second_layer(&second, &mut rng)?;
    Ok(Learned {
        data,
        first,
        second,
    })
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let Learned { first, second, .. } = learn(job)?;
    let clusters = second.network().clusters().count();
    let run = FiveRun {
        five: clusters == REGIONS as usize,
        right: is_right(&second, job.seed)?,
        clusters,
        first_clusters: first.network().clusters().count(),
        units: second.network().len(),
        first_units: first.network().len(),
    };
    Ok(run.fields()?)
}

/// Returns whether there are five clusters, each with at least 95 % of one region's points.
fn is_right(second: &Soinn<f64>, seed: u64) -> Result<bool, BoxError> {
    let clusters = second.network().clusters();
    if clusters.count() != REGIONS as usize {
        return Ok(false);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(1);
    let mut taken = [false; REGIONS as usize];
    for region in 0..REGIONS {
        let mut votes = [0_u32; REGIONS as usize];
        for _ in 0..PROBES {
            let unit = second.nearest(&streams::of_region(region, &mut rng))?.id;
            votes[clusters.label(unit)? as usize] += 1;
        }
        for (votes, taken) in votes.iter().zip(&mut taken) {
            if 100 * votes >= 95 * PROBES && !*taken {
                *taken = true;
                break;
            }
        }
    }
    Ok(taken.iter().all(|taken| *taken))
}
