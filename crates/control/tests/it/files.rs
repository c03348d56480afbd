//! Layers and configurations, saved and loaded; numbers without sense are refused.

use core::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use tolman_control::epuck::{
    ForwardConfig, KeepOff, MeetPointConfig, PilotConfig, RangeCurve, SegmentConfig,
};
use tolman_control::{Avoid, Center, Move, Orient};

/// Checks that a value reads back as it was. A missing or an unknown field must be refused.
#[track_caller]
fn round_trip<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let json = serde_json::to_value(value).unwrap();
    assert_eq!(&serde_json::from_value::<T>(json.clone()).unwrap(), value);
    if let Value::Object(fields) = json {
        for name in fields.keys() {
            let mut less = fields.clone();
            less.remove(name);
            // JSON has no infinity and says null.
            if fields[name] != Value::Null {
                assert!(serde_json::from_value::<T>(less.into()).is_err(), "{name}");
            }
        }
        let mut more = fields;
        more.insert("widht".to_owned(), json!(1.0));
        let error = serde_json::from_value::<T>(more.into()).unwrap_err();
        assert!(
            error.to_string().contains("unknown field `widht`"),
            "{error}"
        );
    }
}

/// Checks that a value is refused if `field` holds `number`.
#[track_caller]
fn refuses<T: Serialize + DeserializeOwned + Debug>(value: &T, field: &str, number: &Value) {
    let mut json = serde_json::to_value(value).unwrap();
    assert!(json.get(field).is_some(), "{field}");
    json[field] = number.clone();
    let read = serde_json::from_value::<T>(json);
    assert!(read.is_err(), "{field} = {number}: {read:?}");
}

fn pilot() -> PilotConfig {
    let mut config = PilotConfig::paper(RangeCurve::cpm(), 10_000, 0.2);
    config.sweep_speed = 4.9;
    config.most_wheel_speed = 6.0;
    config.turn_tolerance = 1e-6;
    config
}

#[test]
fn what_is_saved_is_read_again() {
    round_trip(&Move::paper());
    round_trip(&Orient::paper(72, 0.95));
    round_trip(&Center::paper());
    round_trip(&Avoid::paper(72, 0.5));
    round_trip(&ForwardConfig::for_width(0.2));
    round_trip(&KeepOff::ours());
    round_trip(&MeetPointConfig::for_width(0.2));
    round_trip(&RangeCurve::cpm());
    round_trip(&SegmentConfig::paper());
    round_trip(&SegmentConfig::joined());
    round_trip(&pilot());
}

#[test]
fn numbers_without_sense_are_refused() {
    let (zero, less, none) = (json!(0.0), json!(-1.0), Value::Null);
    refuses(&Move::paper(), "turn_per_degree", &none);
    refuses(&Move::paper(), "tolerance_deg", &less);
    refuses(&Orient::paper(72, 0.95), "square_beams", &zero);
    refuses(&Orient::paper(72, 0.95), "nudge", &less);
    refuses(&Center::paper(), "ratio", &zero);
    refuses(&Avoid::paper(72, 0.5), "ahead", &json!(u64::MAX));
    refuses(&Avoid::paper(72, 0.5), "beside", &json!(-1));
    refuses(&Avoid::paper(72, 0.5), "buffer", &less);
    refuses(&ForwardConfig::for_width(0.2), "half_width", &zero);
    refuses(&KeepOff::ours(), "least", &json!(0.03));
    refuses(&MeetPointConfig::for_width(0.2), "resolution", &json!(1e-9));
    refuses(&MeetPointConfig::for_width(0.2), "resolution", &zero);
    refuses(&SegmentConfig::cut(), "window", &json!(0));
    refuses(&SegmentConfig::cut(), "ceiling", &less);
    refuses(&pilot(), "step_us", &json!(0));
    refuses(&pilot(), "samples", &json!(0));
    refuses(&pilot(), "sweep_speed", &zero);
    refuses(&pilot(), "curve", &json!([[0.0, 1.0], [0.1, 2.0]]));
}
