//! `ours|ours-plain|scirs2 FILE UNITS PERIOD`: inputs per second of processor time at the end, mean
//! squared error, units.

use cpu_time::ThreadTime;
use tolman_quantizers::{ErrorKind, Gng, GngConfig, Lanes, Quantizer, UnitSearch};

type Failure = Box<dyn std::error::Error>;

/// Results of one training, as they are printed.
struct Outcome {
    rate: f64,
    mse: f64,
    units: usize,
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [learner, file, units, period] = arguments.as_slice() else {
        return Err("usage: against-peers ours|ours-plain|scirs2 FILE UNITS PERIOD".into());
    };
    let text = std::fs::read_to_string(file)?;
    let row = |line: &str| line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>();
    let inputs = text.lines().map(row).collect::<Result<Vec<_>, _>>()?;
    let (units, period) = (units.parse()?, period.parse()?);
    let outcome = match learner.as_str() {
        "ours" => ours(&inputs, units, period, Lanes::Widest)?,
        "ours-plain" => ours(&inputs, units, period, Lanes::Baseline)?,
        "scirs2" => scirs2(&inputs, units, period as usize)?,
        other => return Err(format!("{other} is not a learner").into()),
    };
    println!("{} {} {}", outcome.rate, outcome.mse, outcome.units);
    Ok(())
}

fn ours(inputs: &[Vec<f64>], units: usize, period: u32, lanes: Lanes) -> Result<Outcome, Failure> {
    let narrow = |input: &Vec<f64>| input.iter().map(|value| *value as f32).collect();
    let inputs: Vec<Vec<f32>> = inputs.iter().map(narrow).collect();
    let mut config = GngConfig::fritzke();
    config.max_units = units;
    config.growth_period = period;
    // As MDP sums them.
    config.error = ErrorKind::Absolute;
    let mut gng = Gng::<f32>::new(inputs[0].len(), config)?;
    gng.set_search(UnitSearch::Automatic, lanes);
    for input in &inputs {
        gng.observe(input)?;
    }
    let mse = gng.network().quantization_error(&inputs)?.mean_squared;
    let units = gng.network().len();
    // A fifth of the inputs is over before a clock has ticked: often enough for a second.
    let last = &inputs[inputs.len() * 4 / 5..];
    let (begun, mut learnt) = (ThreadTime::now(), 0);
    while begun.elapsed().as_secs_f64() < 1.0 {
        for input in last {
            gng.observe(input)?;
        }
        learnt += last.len();
    }
    Ok(Outcome {
        rate: learnt as f64 / begun.elapsed().as_secs_f64(),
        mse,
        units,
    })
}

#[cfg(not(feature = "scirs2"))]
fn scirs2(_: &[Vec<f64>], _: usize, _: usize) -> Result<Outcome, Failure> {
    Err("built without the feature scirs2".into())
}

/// Trains scirs2's network on as many inputs as there are, drawn at random. Measures the rate of
/// the last fifth.
#[cfg(feature = "scirs2")]
fn scirs2(inputs: &[Vec<f64>], units: usize, period: usize) -> Result<Outcome, Failure> {
    use scirs2_cluster::competitive_learning::GrowingNeuralGas;

    let (count, features) = (inputs.len(), inputs[0].len());
    let data = ndarray::Array2::from_shape_vec((count, features), inputs.concat())?;
    let fit = |steps| {
        let gas = GrowingNeuralGas::new(0.2, 0.006, 50, period, 0.5, 0.995, units, steps, 42);
        let begun = ThreadTime::now();
        let model = gas.fit(data.view()).map_err(|error| error.to_string());
        (begun.elapsed().as_secs_f64(), model)
    };
    let (without, _) = fit(count * 4 / 5);
    let (seconds, model) = fit(count);
    let model = model?;
    Ok(Outcome {
        rate: (count / 5) as f64 / (seconds - without),
        mse: model.quantization_error,
        units: model.prototypes.nrows(),
    })
}
