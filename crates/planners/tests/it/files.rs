//! Configurations of planners, saved and loaded; what has no sense is refused where a planner takes
//! it.

use core::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use tolman_maze::Cell;
use tolman_planners::Unknown;
use tolman_planners::moves::{MoveExplorer, MoveExplorerConfig, RolloutConfig};
use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunTimes};

/// Returns a value with one field changed, as it is read.
fn changed<T: Serialize + DeserializeOwned>(
    value: &T,
    field: &str,
    to: Value,
) -> Result<T, serde_json::Error> {
    let mut json = serde_json::to_value(value).unwrap();
    json[field] = to;
    serde_json::from_value(json)
}

#[track_caller]
fn round_trip<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let text = serde_json::to_string(value).unwrap();
    assert_eq!(&serde_json::from_str::<T>(&text).unwrap(), value);
    let error = changed(value, "widht", json!(1)).map(|_| ()).unwrap_err();
    assert!(
        error.to_string().contains("unknown field `widht`"),
        "{error}"
    );
}

#[test]
fn what_is_saved_is_read_again() {
    round_trip(&SpeedRunConfig::classic());
    round_trip(&SpeedRunConfig::half_size());
    round_trip(&SpeedRunConfig::beginner());
    round_trip(&MoveExplorerConfig::tuned());
    round_trip(&RolloutConfig::tuned());
    for unknown in [Unknown::Open, Unknown::Closed] {
        let text = serde_json::to_string(&unknown).unwrap();
        assert_eq!(serde_json::from_str::<Unknown>(&text).unwrap(), unknown);
    }
}

#[test]
fn planners_refuse_what_has_no_sense() {
    let config = changed(&SpeedRunConfig::classic(), "cell_mm", json!(-180.0)).unwrap();
    assert!(SpeedRunTimes::<16>::new(&config).is_err());
    let weights = changed(&MoveExplorerConfig::tuned(), "nearness", json!(0.0)).unwrap();
    assert!(MoveExplorer::<16>::new(weights, Cell::new(0, 0)).is_err());
}
