//! The code of README and of the guides in `docs/`, compiled and run. For [fuzzing](fuzz), also
//! what every reader must keep to, whatever the file.

pub mod fuzz;

#[doc = include_str!("../../docs/own-robot.md")]
mod own_robot {}

#[doc = include_str!("../../docs/extend.md")]
mod extend {}

#[doc = include_str!("../../README.md")]
mod readme {}

/// The front pages of the packages.
mod packages {
    #[doc = include_str!("../../crates/arena/README.md")]
    mod arena {}

    #[doc = include_str!("../../crates/control/README.md")]
    mod control {}

    #[doc = include_str!("../../crates/draw/README.md")]
    mod draw {}

    #[doc = include_str!("../../crates/experiment/README.md")]
    mod experiment {}

    #[doc = include_str!("../../crates/firmware/README.md")]
    mod firmware {}

    #[doc = include_str!("../../crates/formats/README.md")]
    mod formats {}

    #[doc = include_str!("../../crates/geom/README.md")]
    mod geom {}

    #[doc = include_str!("../../crates/maps/README.md")]
    mod maps {}

    #[doc = include_str!("../../crates/maze/README.md")]
    mod maze {}

    #[doc = include_str!("../../crates/papers/README.md")]
    mod papers {}

    #[doc = include_str!("../../crates/planners/README.md")]
    mod planners {}

    #[doc = include_str!("../../crates/quantizers/README.md")]
    mod quantizers {}

    #[doc = include_str!("../../crates/replay/README.md")]
    mod replay {}

    #[doc = include_str!("../../crates/robot/README.md")]
    mod robot {}

    #[doc = include_str!("../../crates/sim/README.md")]
    mod sim {}

    #[doc = include_str!("../../crates/stats/README.md")]
    mod stats {}

    #[doc = include_str!("../../crates/systems/README.md")]
    mod systems {}

    #[doc = include_str!("../../crates/tolman/README.md")]
    mod tolman {}
}
