//! The value types as JSON: other programs read these names.

use tolman_maze::{Cell, Direction, Grid, Wall};

#[test]
fn value_types_have_stable_json() {
    fn check<T>(value: &T, json: &str)
    where
        T: serde::Serialize + serde::de::DeserializeOwned + PartialEq + core::fmt::Debug,
    {
        assert_eq!(serde_json::to_string(value).unwrap(), json);
        assert_eq!(serde_json::from_str::<T>(json).unwrap(), *value);
    }
    check(&Cell::new(3, 5), r#"{"x":3,"y":5}"#);
    check(&Direction::ALL, r#"["north","east","south","west"]"#);
    check(&Grid::new(16, 12), r#"{"width":16,"height":12}"#);
    check(&Wall(7), "7");
}
