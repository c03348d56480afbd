use pyo3::prelude::*;
use tolman_quantizers::{
    Denoising, ErrorInsertion, ErrorKind, GngConfig, GrowthGate, QuantizerConfigError, Removal,
    ReplayConfig, ReplayMemory, SimilarityThreshold, SoinnConfig, StepOrder, Utility,
};

use crate::errors::{refused, wrong};
use crate::params::Params;

/// Makes a gate from its threshold.
type Gate = fn(f64) -> GrowthGate;

/// Returns the configuration of a growing neural gas from Python's parameters.
pub(crate) fn gng_config(params: &Params<'_, '_>) -> PyResult<GngConfig> {
    let gate = match params.is_given("gate")? {
        false => GrowthGate::Open,
        true => {
            let gates: [(&str, Gate); 2] = [
                ("mean_error", |threshold| GrowthGate::MeanError {
                    threshold,
                }),
                ("rate", |threshold| GrowthGate::Rate { threshold }),
            ];
            let gate = params.choice("gate", &gates)?;
            gate(params.number("threshold")?)
        }
    };
    let utility = match params.optional("utility_threshold")? {
        None => None,
        Some(threshold) => Some(Utility {
            threshold,
            removal: params.choice(
                "removal",
                &[
                    ("every_input", Removal::EveryInput),
                    ("when_full", Removal::WhenFull),
                ],
            )?,
        }),
    };
    let max_units = params.optional_count("max_units")?;
    let mut config = GngConfig::fritzke();
    config.winner_rate = params.number("winner_rate")?;
    config.neighbour_rate = params.number("neighbour_rate")?;
    config.max_age = params.count("max_age")?;
    config.growth_period = params.count("growth_period")?;
    config.split_factor = params.number("split_factor")?;
    config.decay = params.number("decay")?;
    config.max_units = max_units.map_or(usize::MAX, |units| units as usize);
    config.order = params.choice(
        "order",
        &[("fritzke", StepOrder::Fritzke), ("mslst", StepOrder::Mslst)],
    )?;
    config.error = params.choice(
        "error",
        &[
            ("squared", ErrorKind::Squared),
            ("absolute", ErrorKind::Absolute),
            ("relative", ErrorKind::Relative),
        ],
    )?;
    config.gate = gate;
    config.utility = utility;
    Ok(config)
}

/// Returns the memory of past inputs that Python's parameters ask for, or `None`.
pub(super) fn replay_config(params: &Params<'_, '_>) -> PyResult<Option<ReplayConfig>> {
    let Some(per_input) = params.optional_count("replay")? else {
        return Ok(None);
    };
    let mut config = ReplayConfig::measured(0);
    config.per_input = per_input;
    config.capacity = params.count("replay_capacity")?;
    config.memory = params.choice(
        "replay_memory",
        &[
            ("reservoir", ReplayMemory::Reservoir),
            ("recent", ReplayMemory::Recent),
        ],
    )?;
    Ok(Some(config))
}

/// Returns the configuration of a SOINN from Python's parameters.
pub(crate) fn soinn_config(params: &Params<'_, '_>) -> PyResult<SoinnConfig> {
    let c = params.number("noise_factor")?;
    let threshold = match params.optional("threshold")? {
        None => SimilarityThreshold::Adaptive,
        Some(distance) => SimilarityThreshold::Constant(distance),
    };
    let mut config = SoinnConfig::shen_hasegawa();
    config.max_age = params.count("max_age")?;
    config.period = params.count("period")?;
    config.insertion = params.choice(
        "insertion",
        &[
            ("unless_one_grew", ErrorInsertion::UnlessOneGrew),
            ("unless_all_grew", ErrorInsertion::UnlessAllGrew),
            ("off", ErrorInsertion::Off),
        ],
    )?;
    config.denoising = params.choice(
        "denoising",
        &[
            ("few_wins", Denoising::FewWins { c }),
            ("low_rate", Denoising::LowRate { c }),
            ("off", Denoising::Off),
        ],
    )?;
    config.threshold = threshold;
    Ok(config)
}

/// Returns a `ValueError` that names the parameter instead of the field.
pub(crate) fn named(error: QuantizerConfigError) -> PyErr {
    match error {
        QuantizerConfigError::OutOfRange {
            field,
            value,
            range,
        } => {
            let parameter = match field {
                "gate.threshold" => "threshold",
                "utility.threshold" => "utility_threshold",
                "denoising.c" => "noise_factor",
                "per_input" => "replay",
                "capacity" => "replay_capacity",
                field => field,
            };
            wrong(format!("{parameter} is {value} but has to be {range}"))
        }
        error => refused("X", &error),
    }
}
